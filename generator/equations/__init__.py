"""Derives the equations of one scene in SymPy: constraints Φ, applied forces, joints with play, events."""
