"""Builds all functions of a scene (motion, constraints, outputs, events) as statements, before any text is printed."""
