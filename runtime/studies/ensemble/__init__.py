"""Run the ensembles of a study file (`gudgeon study`), and collect their measures in one xarray Dataset."""
