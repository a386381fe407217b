"""Run many simulations: benchmarks of methods, maps of stability over parameters, ensembles of a study file."""
