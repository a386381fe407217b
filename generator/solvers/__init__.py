"""Linear systems as statements: KKT, Newton, square blocks."""
