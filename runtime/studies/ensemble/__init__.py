"""`gudgeon study`: a file of many runs as blocks on disk, and what was measured of them as one Dataset."""
