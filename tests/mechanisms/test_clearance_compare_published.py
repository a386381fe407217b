"""Test benchmarks/clearance/compare_published.py: the equations of published programs that print no numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import tests.benches  # noqa: F401
from benchmarks.clearance import compare_published, drawn
from benchmarks.clearance.compare_published import (
    COMPARED,
    Figure,
    carried,
    far,
    film_difference,
    found,
    kept,
    whirling,
)
from tests.programs import needs_compiler

PAGE = (Path(compare_published.__file__).parent / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("eps", [0.01, 0.3, 0.95])
def test_a_film_of_closed_forms_beside_a_quadrature(eps: float) -> None:
    """1e-10 are added to ε there: 3.1e-10/ε where ε is small, and what (1 − ε²)^−5/2 makes of it where it is large."""
    assert film_difference(eps) < 3.2e-10 / eps + 5e-10 / (1.0 - eps**2)


def test_a_rigid_rotor_falls_in_its_film() -> None:
    times, e = kept("rotor_rigid")
    early = times <= 0.03
    y = found(drawn.rigid_rotor, np.zeros(4), times[early], method="Radau", rtol=1e-8, atol=1e-13)
    assert early.sum() > 4 and far(y[:2].T, e[early, 0], 15e-6).max() < 1e-6


def test_a_rotor_against_its_stator() -> None:
    times, e = kept("rotor_stator")
    early = times <= 20e-3 + 1e-9
    y = found(drawn.stator(False), [0.01, 0.0, 0.0, 0.0], 1e3 * times[early])
    assert early.sum() == 51 and far(y[:2].T, 1e3 * e[early, 0], 1.0).max() < 2e-10


def test_a_drill_collar_until_it_touches() -> None:
    times, e = kept("drill_collar")
    free = times < 4.26
    own, first = whirling(drawn.Collar(1e-3), times[free])
    assert far(own, e[free, 0], drawn.Collar.gap).max() < 5e-12
    assert first == np.inf or first > times[free][-1] - 0.01


def test_a_bearing_without_mass_under_a_constant_load() -> None:
    """Booker's formula comes to rest within a few percent of where Ocvirk's film carries the load."""
    assert [carried(load) for load in (200.0, 2e3, 1e4)] == pytest.approx([1.0, 1.0, 1.0], abs=0.03)
    assert carried(-2e3) == pytest.approx(-carried(2e3))  # of both directions of the load


def test_figures_are_told_with_their_own_digits() -> None:
    assert Figure("", "0.014", 0.01376).holds and not Figure("", "0.014", 0.0136 - 0.0002).holds
    assert Figure("", "2e-9", 2.4e-9).holds and Figure("", "2e-9", 5e-9, 3.0).holds
    assert not Figure("", "2e-9", 7e-9, 3.0).holds and Figure("", "0", 0.0).holds and not Figure("", "0", 1e-30).holds


@pytest.mark.slow
@needs_compiler
@pytest.mark.parametrize("name", COMPARED)
def test_the_page_tells_what_is_found(name: str) -> None:
    figures = list(COMPARED[name]())
    assert [(one.what, one.now_printed) for one in figures if not one.holds] == []
    bullets = PAGE[
        PAGE.index("- **Nowald's rotors.**") : PAGE.index("`python -m benchmarks.clearance.compare_published`")
    ]
    assert [one.printed for one in figures if one.printed not in bullets] == []
