"""Parse and check numbers, units, names, expressions and arguments that users write, without YAML or SymPy."""
