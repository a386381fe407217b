"""Represents generated functions as straight-line statements, with passes that transform or differentiate them."""
