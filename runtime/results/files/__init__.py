"""Results as files: NetCDF written and read back, CSV, MATLAB, tables of other programs."""
