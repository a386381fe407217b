"""Simulate a loaded scene: one run, many runs, restarts, audits, predictability, Lyapunov exponents, wear."""
