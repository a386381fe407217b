"""Writes the equations of a scene in other languages: C, NumPy, JavaScript, documents; also a JSON Schema."""
