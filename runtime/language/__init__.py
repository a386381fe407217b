"""Numbers, units, names, expressions and arguments as people give them; no YAML, no SymPy."""
