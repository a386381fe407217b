"""The same motion in the coordinates of a tree."""
