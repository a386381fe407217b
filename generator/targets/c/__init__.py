"""Writes a scene as C: printers, templates and the description for the runtime."""
