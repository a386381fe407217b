"""Writes functions of a scene as JavaScript, which a page evaluates in addition to its simulator."""
