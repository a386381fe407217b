"""Graphs of a matrix: elimination order, block triangular form; no SymPy."""
