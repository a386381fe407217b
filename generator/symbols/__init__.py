"""Names, corners and run-time numbers of the equations."""
