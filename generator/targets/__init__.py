"""Writes a Model in other languages: C, NumPy, JavaScript, documents, a JSON Schema."""
