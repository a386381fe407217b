"""Former name of samples.py, which simulation/simulate_many.py still imports."""

from gudgeon.results.samples import with_start, without_start  # noqa: F401
