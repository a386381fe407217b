"""One-file extensions, found by being in their folder."""
