"""Studies as tables, CSV, JSON and figures."""
