"""Results of runs: their data here; files, figures and reports of results in the folders below."""
