"""Mutated expressions and files: a value or an InputError, and soon. `python -m tests.fuzz` goes on for longer."""

from __future__ import annotations

import pytest

from tests.fuzz.mutate import Mutator, run
from tests.fuzz.targets import TARGETS, timed
from tests.slow import slow_but

SOME = ("expression", 1000), ("reader", 100), ("expression", 4000), ("reader", 400)


@pytest.mark.parametrize("of", slow_but(SOME[:2], SOME), ids="{0[0]}-{0[1]}".format)
def test_some_inputs(of: tuple[str, int]) -> None:
    name, count = of
    target, tokens, seeds = TARGETS[name]
    assert run(lambda data: timed(target, data), seeds(), tokens, count) > 0


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), [("expression", 200_000), ("reader", 20_000)])
def test_many_inputs(name: str, count: int) -> None:
    target, tokens, seeds = TARGETS[name]
    assert run(lambda data: timed(target, data), seeds(), tokens, count, seed=2) > 0


@pytest.mark.parametrize("name", TARGETS)
def test_seeds(name: str) -> None:
    target, _, seeds = TARGETS[name]
    for data in seeds():
        timed(target, data)


def test_same_seed_same_inputs() -> None:
    _, tokens, seeds = TARGETS["expression"]
    first, second = (Mutator(seeds(), tokens, 7) for _ in range(2))
    assert [first.next() for _ in range(50)] == [second.next() for _ in range(50)]


def test_a_failure_carries_its_input() -> None:
    def target(data: bytes) -> None:
        if b"(" in data:
            raise ValueError("no")

    with pytest.raises(AssertionError, match=r"ValueError: no for the input b'.*\("):
        run(target, [b"1 + 2"], ("(", ")"), 1000)
