"""Φ, loads, play and events of one scene in SymPy: the Model and the System."""
