"""Reads study files: the runs of a mechanism and their measures; nothing is derived or loaded."""
