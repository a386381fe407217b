"""A mechanism as engineers draw it: lines and discs in metres first, then a picture."""
