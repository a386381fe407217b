"""Reports of results: a run's report as page and text, scenes beside each other in tables."""
