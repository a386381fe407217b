"""Example: one random design with one set of numbers, against the independent simulator and itself.

`python -m tests.random_machines --count 40` tries more; a seed that finds a fault joins `test_random_machines.py`.
"""

from __future__ import annotations

from pathlib import Path

from tests.programs import needs_compiler
from tests.random_machines.trial import try_seeds

pytestmark = needs_compiler


def test_one_machine(tmp_path: Path) -> None:
    tally = try_seeds(range(1), tmp_path, 1)
    assert tally.counts["machines"] == 1 and not tally.failures, [*map(str, tally.failures)]
