"""Parameters of a run that make an expression undefined as it is written are refused, as they are in the file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gudgeon.errors import BadValueError, InputError
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler

BAR = """\
parameters: {{d: {d}, a: "{a}", e: "2*a"}}
bodies: {{b: {{length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, b.tail]}}}}
drives: {{m: {{angle: b, value: "{value}"}}}}
"""
DRIVE = "1 rad/s*t"

# expression, a value at which it is defined, one at which it is not; SymPy simplifies each
CASES = [
    ("cos(acos(d))", 0.5, 2.0),
    ("sin(asin(d))", 0.5, -2.0),
    ("acos(d)*0 + 1", 0.5, 2.0),
    ("sqrt(d)**2", 4.0, -4.0),
    ("sqrt(d)*sqrt(d)", 4.0, -4.0),
    ("(d**(1/3))**3", 4.0, -4.0),
    ("d**1.5/d**0.5", 4.0, -4.0),
    ("exp(log(d))", 4.0, -4.0),
    ("log(d)/log(d)", 4.0, -4.0),
    ("0*log(d)", 4.0, -4.0),
    ("d/d", 1.0, 0.0),
    ("1/d*d", 1.0, 0.0),
    ("d**2/d", 1.0, 0.0),
    ("1/(1/d)", 1.0, 0.0),
    ("where(d < 1, 2, log(d - 1))", 3.0, 1.0),
    ("where(sqrt(d) < 1, 2, 3)", 4.0, -4.0),
]


@pytest.mark.parametrize("text, good, bad", CASES)
def test_a_run_is_refused_what_the_file_is_refused(text: str, good: float, bad: float, tmp_path: Path) -> None:
    """The formula that C has may lack the part that is undefined: cos(acos(2)) was 2."""
    load = loader(tmp_path)
    with pytest.raises(InputError):
        load(BAR.format(d=bad, a=text, value=DRIVE))
    bar = load(BAR.format(d=good, a=text, value=DRIVE))
    with pytest.raises(BadValueError, match=r"(parameters\.a|a) "):
        bar.simulate(1.0, output=1, parameters={"d": bad})
    assert np.isfinite(bar.simulate(1.0, output=1, parameters={"d": 1.1 * good if good > 1 else good}).parameters["a"])
    assert bar.simulate(1.0, output=1, parameters={"d": bad, "a": 7.0}).parameters["e"] == 14.0  # a does not follow d


def test_rows_of_a_batch_and_drives(tmp_path: Path) -> None:
    """A row of a batch fails with the reason; a drive's constant parts are looked at as well."""
    bar = loader(tmp_path)(BAR.format(d=0.5, a="cos(acos(d))", value=DRIVE))
    many = bar.simulate_many({"d": [0.5, 2.0, 0.7, -3.0]}, 1.0, output=1)
    assert [one.run for one in many.failures] == [1, 3] and "d = 2" in str(many.failures[0].error)
    driven = loader(tmp_path)(BAR.format(d=0.5, a="1", value="cos(acos(d))*1 rad/s*t"))
    with pytest.raises(BadValueError, match=r"drives\.m\.value has a part that is nan with d = 2"):
        driven.simulate(1.0, output=1, parameters={"d": 2.0})


def test_the_branch_that_is_not_taken_may_be_undefined(tmp_path: Path) -> None:
    """As in a file: `where` is written to keep clear of it."""
    bar = loader(tmp_path)(BAR.format(d=4.0, a="where(d < 0, 0, sqrt(d))", value=DRIVE))
    assert bar.simulate(1.0, output=1, parameters={"d": -1.0}).parameters["a"] == 0.0
    assert not bar.simulate_many({"d": [4.0, -1.0]}, 1.0, output=1).failures
