"""Example: random bytes give a value or an InputError with a place, never another exception."""

from __future__ import annotations

from tests.fuzz.mutate import run
from tests.fuzz.targets import TARGETS


def test_fifty_mutated_expressions() -> None:
    target, tokens, seeds = TARGETS["expression"]
    run(target, seeds(), tokens, count=50, seed=1)
