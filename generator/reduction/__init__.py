"""Reduces the equations of motion to tree coordinates, the relative coordinates of a spanning tree of joints."""
