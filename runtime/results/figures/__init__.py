"""Figures of results: one run, several scenes, the mechanism, animations."""
