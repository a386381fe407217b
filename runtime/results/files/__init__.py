"""Results as files: NetCDF written and read, CSV, MATLAB, tables for other programs."""
