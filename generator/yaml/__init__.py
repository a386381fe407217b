"""Bytes to text, lists and mappings with their places; the shapes they must have."""
