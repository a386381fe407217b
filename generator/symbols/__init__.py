"""Symbols of the equations: names, storage, derivatives, switching functions, run-time parameters."""
