"""Declares what a mechanism file may contain, checks its structure, and replaces values by their path."""
