"""Reports of results: the report of a run as page and text, and tables of several scenes."""
