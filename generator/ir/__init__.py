"""Straight-line functions: statements, passes over them, derivatives."""
