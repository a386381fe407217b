"""Coefficients of the integrators: facts, with their sources; the steps are in templates/c."""
