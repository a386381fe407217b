"""Studies of many runs: benchmarks of methods, maps and boxes of verdicts, ensembles of a study file."""
