"""Run the ensembles of a study file in blocks on disk, and collect the measures in one Dataset: `gudgeon study`."""
