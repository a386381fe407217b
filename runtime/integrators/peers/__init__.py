"""Others' integrators on our right-hand side: cross-checks."""
