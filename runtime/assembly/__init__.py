"""The start of a motion: the linkage closed, what moves, which branches there are, why it does not close."""
