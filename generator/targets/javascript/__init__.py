"""Functions of a scene as JavaScript: what a page evaluates beside its simulator."""
