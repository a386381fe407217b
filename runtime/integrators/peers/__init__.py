"""Integrate a scene's compiled right-hand side by SciPy and SUNDIALS, as independent checks of gudgeon's methods."""
