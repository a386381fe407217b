"""Bytes to text, lists and mappings with their places."""
