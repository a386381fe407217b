"""Former name of results.py, which simulation/simulate_many.py still imports."""

from gudgeon.results.results import Bare, bare, blank  # noqa: F401
