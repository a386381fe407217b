"""What a file says, names resolved: frozen values, no SymPy."""
