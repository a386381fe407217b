"""Former name of batch.py, which simulation/simulate_many.py still imports."""

from gudgeon.results.batch import STATES, parts_of, wanted_names  # noqa: F401
