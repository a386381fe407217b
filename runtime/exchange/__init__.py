"""Linkages of other programs, read as mechanisms."""
