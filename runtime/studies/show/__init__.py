"""Display studies as tables, CSV, JSON and figures."""
