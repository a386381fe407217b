"""Assemble a linkage at its start: closed positions, velocities, mobility, assembly branches, causes of failure."""
