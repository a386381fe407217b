"""Reads a file's tree into a Mechanism, section by section; all errors are reported at once."""
