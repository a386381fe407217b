"""Random files through the compiler; `python -m tests.fuzz compile` goes on for longer."""

from __future__ import annotations

from pathlib import Path

import pytest
import sympy as sp

from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.symbols.switches import Magnitude, Switches
from tests.fuzz.through_c import check_syntax, library, try_files
from tests.slow import slow_but


@pytest.mark.parametrize("files", slow_but([8], [8, 20, 60, 300]))
def test_hundreds_of_files(files: int) -> None:
    """In one formulation each, in turn; some in both, with numbers, and run by every method."""
    few = files < 20  # both formulations of a file take longer than ten others
    tally = try_files(range(files), compared=files if few else files // 5, ran=files if few else files // 2)
    assert tally.counts["files"] > 0.83 * files
    assert tally.counts["with numbers"] >= max(files // 100, 1)
    assert tally.counts["runs"] > 0


HEAD = "format: gudgeon/1\nname: fuzz\nparameters: {needs_scalar: 1.3, Lanes: 0.2 m, broadcast: 2, sine_0: 1}\n"
BAR = (
    HEAD
    + """bodies: {a: {length: 0.2 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}}
"""
)
MASS = HEAD + "bodies: {s: {mass: 1 kg, inertia: 1e-3 kg*m^2}}\nground: {O: [0, 0]}\n"
FAILED = {
    "a driven bar's event": BAR
    + """drives: {d: {angle: a, value: 2*pi*t}}
events: {e: {zero: "needs_scalar + a.head.y * 2 1/m"}}
""",
    "names of the C of lanes": BAR
    + """events:
  e: {zero: cos(a.theta) + needs_scalar * broadcast * sin(sine_0 * t) + a.x / Lanes}
""",
    "a corner that only the event has": MASS
    + """joints: {G: {translational: [ground.O, s.origin], axis: [1, 0]}}
events: {e: {zero: "abs(s.x) - Lanes"}}
""",
    "no rows at all, a force with a corner": MASS
    + """forces: {f: {torque: s, value: "-abs(s.x * 150 N)"}}
events: {e: {zero: cos(s.theta)}}
""",
    "a factor of Newton's matrix that is eta": HEAD
    + """bodies:
  a: {length: 0.1 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}
  b: {length: 0.3 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}
  s: {mass: 1 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, a.tail]}
  A: {revolute: [a.head, b.tail]}
  W: {revolute: [b.head, s.origin]}
  G: {translational: [ground.O, s.origin], axis: [1, 0]}
forces: {f: {torque: s, value: a.vy * 1 kg*m/s}}
start: {guess: {a.theta: 40 deg, s.x: 0.35 m}}
""",
}
APART = "names of the C of lanes", "no rows at all, a force with a corner", "a factor of Newton's matrix that is eta"


@pytest.mark.parametrize("name", slow_but(APART, FAILED))
def test_files_that_failed_once(name: str, tmp_path: Path) -> None:
    for formulation in ("reduced", "full"):
        source = generate_kernel_source(FAILED[name].encode(), "f", "ideal", None, formulation)
        check_syntax(source, tmp_path)
        if formulation == "reduced":
            library(source, tmp_path, "failed")


def test_what_is_no_number_stays_none() -> None:
    """The root of a held corner was that of its magnitude: a number where there is none."""
    sides: dict[sp.Symbol, sp.Expr] = {}
    x = sp.Symbol("x", real=True)
    held = Switches().freeze_branches(sp.sqrt(sp.Abs(x) - 1), "", sides)
    assert not held.has(Magnitude)
    assert Switches().freeze_branches(sp.sqrt(sp.Abs(x)), "", {}).has(Magnitude)
