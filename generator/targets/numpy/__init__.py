"""Writes functions of a scene as Python with NumPy, for teaching and for numbers before the C is compiled."""
