"""NumPy: the same functions as plain Python, for a class, and for what needs numbers before there is C."""
