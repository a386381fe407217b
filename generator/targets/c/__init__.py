"""C: printing, which templates, names for the runtime."""
