"""What a study file says: which runs of a mechanism, and what is measured of them; no SymPy, nothing loaded."""
