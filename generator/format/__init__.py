"""Declares what a mechanism file may contain, checks the shape of files, and applies overrides by address."""
