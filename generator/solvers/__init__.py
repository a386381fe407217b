"""Writes solutions of linear systems as straight-line statements: KKT systems, Newton's matrix, square systems."""
