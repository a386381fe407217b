"""Example: an exercise sheet draws its numbers from a seed: the same seed, the same sheet."""

from __future__ import annotations

import pytest

import gudgeon
from gudgeon.teaching.draw_parameters import draw_parameters
from tests.programs import needs_compiler

pytestmark = [needs_compiler, pytest.mark.plain]


def test_a_seed_draws_the_same_numbers_again() -> None:
    simulation = gudgeon.load("four_bar")
    first, again, other = (draw_parameters(simulation, seed, None) for seed in (3, 3, 4))
    assert (first.p == again.p).all() and (first.p != other.p).any()
