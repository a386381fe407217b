"""Film laws beside the solver, and the page that tells of both."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from gudgeon.errors import InputError
from gudgeon.generator.kinds.laws.law import find_laws_of_role
from gudgeon.reynolds import deviation
from tests.oracles import film

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "reynolds.md").read_text(encoding="utf-8")


def test_a_law_is_computed_as_it_stands() -> None:
    """The film of a long bearing in units of μ R³ L/c², by its two branches; ε̇ = W cos α, ½ ε ω_s = W sin α."""
    motion = np.array([0.3, 1.2, 2.0, 3.0])
    found = deviation("pinkus_sternlicht", 1.0, eps=[0.2, 0.8], motion=motion, cells=(64, 8))
    assert found.share.shape == found.error.shape == (2, 4)
    for (row, column), share in np.ndenumerate(found.share):
        eps, alpha = float(found.eps[row]), float(motion[column])
        want = np.array(film.pinkus_sternlicht(eps, math.cos(alpha), 2.0 * math.sin(alpha) / eps))
        assert found.law_force[row, column] == pytest.approx(want, rel=1e-10)
        largest = np.hypot(*found.force[row].T).max()
        assert share == pytest.approx(np.hypot(*(want - found.force[row, column])) / largest, rel=1e-10)


def test_the_long_film_is_the_limit_of_long_bearings() -> None:
    """Half film in rotation: what is left goes with D/L, the share of both ends."""
    how = {"eps": [0.5], "motion": [0.5 * math.pi], "cavitation": "half_sommerfeld"}
    found = [deviation("pinkus_sternlicht", k, **how) for k in (5.0, 10.0, 20.0)]  # type: ignore[arg-type]
    shares = [float(one.share[0, 0]) for one in found]
    assert shares[2] < 0.05
    assert shares[0] / shares[1] == pytest.approx(2.0, rel=0.15)
    assert shares[1] / shares[2] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize("law", sorted(find_laws_of_role("film")))
def test_every_film_law_can_be_held_against_it(law: str) -> None:
    found = deviation(law, 0.5, eps=[0.6], motion=[0.0, 1.5, 3.0], cells=(64, 8))
    assert np.isfinite(found.law_force).all() and (found.share >= 0.0).all()


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ({"law": "pinkus"}, "did you mean 'pinkus_sternlicht'"),
        ({"law": "hertz"}, "unknown film law"),
        ({"eps": [0.0]}, "above 0"),
        ({"eps": [1.0]}, "below 1"),
        ({"motion": []}, "at least one"),
        ({"l_over_d": math.inf}, "l_over_d"),
        ({"stiffness": 1.0}, "no key 'stiffness'"),
        ({"eps": 0.5}, "eps has shape"),
        ({"extra_clearance": "1 um"}, "extra_clearance: '1 um'"),
        ({"as_printed": 3}, "expected False or True"),
        ({"extra_clearance": -1e-5}, "expected >= 0"),
        ({"viscosity": 0.0}, "expected > 0"),
        ({"law": ["ocvirk"]}, "law is list"),
        ({"shear": np.zeros(2)}, "expected False or True"),
        ({"l_over_d": -1.0}, "l_over_d is -1"),
        ({"l_over_d": 1e300}, "expected 1e-6 to 1e6"),
    ],
)
def test_what_is_no_question(how: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        deviation(**{"law": "pinkus_sternlicht", "l_over_d": 1.0, **how})  # type: ignore[arg-type]


def test_the_map_is_drawn() -> None:
    ax = deviation("pinkus_sternlicht", 1.0, eps=[0.2, 0.5], motion=[0.0, 1.0], cells=(64, 8)).plot()
    assert "L/D = 1" in ax.get_title()


def test_the_pages_table_is_of_every_law() -> None:
    """`make deviations` writes it; looked at in one column."""
    rows = re.findall(r"^\| `(\w+)`, ([\d.]+) \| .* \| .* \| ([\d.]+) % \| .* \| .* \|$", PAGE, re.MULTILINE)
    assert sorted({law for law, _, _ in rows}) == sorted(find_laws_of_role("film"))
    solved = {ratio: deviation("ocvirk", float(ratio), eps=[0.5]) for ratio in {ratio for _, ratio, _ in rows}}
    for law, ratio, shown in rows:
        worst = 100.0 * float(solved[ratio].of(law).share.max())
        assert worst == pytest.approx(float(shown), rel=0.01, abs=0.06), (law, ratio)


def test_another_law_at_the_same_states() -> None:
    how = {"eps": [0.3, 0.6], "motion": [0.4, 2.0], "cells": (64, 8)}
    first = deviation("ocvirk", 0.5, **how)  # type: ignore[arg-type]
    own = deviation("pinkus_sternlicht", 0.5, as_printed=True, **how)  # type: ignore[arg-type]
    other = first.of("pinkus_sternlicht", as_printed=True)
    assert (other.law_force == own.law_force).all() and (other.share == own.share).all() and other.law == own.law
    with pytest.raises(InputError, match="did you mean 'ocvirk'"):
        first.of("ocvirc")


def test_the_page_prints_what_it_shows(capsys: pytest.CaptureFixture[str]) -> None:
    codes = re.findall(r"^```python\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    outputs = re.findall(r"^```text\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    assert codes
    for code, shown in zip(codes, outputs, strict=True):
        exec(compile(code, "reynolds.md", "exec"), {})
        assert capsys.readouterr().out == shown
