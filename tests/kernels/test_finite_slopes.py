"""Forces that stay finite while e^u in them overflows: their slopes against mpmath, and runs that need the slopes."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from gudgeon.errors import Location, NonFiniteError
from gudgeon.generator.ir.differentiation import compute_partial_derivative
from gudgeon.generator.ir.finite_slopes import Slope
from gudgeon.generator.symbols.from_expressions import convert_to_sympy
from gudgeon.language.parser import parse
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
WIDTH = 1e-3  # s or m, of the step at 5
U = {"t": "((t/(1 s) - 5)/1e-3)", "x": "(({}.x/(1 m) - 5)/1e-3)"}
FORMS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "step_up": ("1/(1 + exp(-u))", lambda u: 1 / (1 + mp.exp(-u))),
    "step_down": ("1/(1 + exp(u))", lambda u: 1 / (1 + mp.exp(u))),
    "bump": ("1/cosh(u)", mp.sech),
    "bump_squared": ("1/cosh(u)**2", lambda u: mp.sech(u) ** 2),
    "step_squared": ("(1 + exp(u))**-2", lambda u: (1 + mp.exp(u)) ** -2),
    "step_root": ("1/sqrt(1 + exp(u))", lambda u: 1 / mp.sqrt(1 + mp.exp(u))),
    "angle": ("atan(exp(u))", lambda u: mp.atan(mp.exp(u))),
    "angle_of_two": ("atan2(1, exp(u))", lambda u: mp.atan2(1, mp.exp(u))),
    "twice": ("exp(-exp(u))", lambda u: mp.exp(-mp.exp(u))),
    "flat": ("tanh(u)", mp.tanh),
    "power": ("1/(1 + 2**u)", lambda u: 1 / (1 + mp.mpf(2) ** u)),
    "within": ("3*sin(1/(1 + exp(u))) + u/5000", lambda u: 3 * mp.sin(1 / (1 + mp.exp(u))) + u / 5000),
}
NAMES = [f"{form}_{by}" for by in U for form in FORMS]
MODERATE, FAR = (-30.0, -3.0, -0.4, 0.5, 3.0, 30.0), (-5000.0, -800.0, 800.0, 5000.0)


def text() -> str:
    """A mass of 1 kg on the x axis for each form, by time and by its own place."""
    lines = ["ground: {o: [0, 0]}", "bodies:"]
    lines += [f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}" for name in NAMES]
    lines += ["joints:", *(f"  on_{n}: {{translational: [ground.o, {n}.origin], axis: [1, 0]}}" for n in NAMES)]
    lines += ["start:", "  set:", *(f"    {name}.x: 0" for name in NAMES), "forces:"]
    for name in NAMES:
        form, _, by = name.rpartition("_")
        value = re.sub(r"\bu\b", U[by].format(name), FORMS[form][0])
        lines.append(f'  of_{name}: {{force: {name}.origin, value: ["1 N*({value})", 0]}}')
    return "\n".join(lines)


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    return loader(tmp_path_factory.mktemp("slopes"))(text())


@pytest.mark.parametrize("u", [*MODERATE, *FAR])
def test_slopes_are_those_of_thirty_digits(scene: Simulation, u: float) -> None:
    full = scene.full
    place = 5.0 + WIDTH * u
    y = np.zeros(2 * full.compiled.n)
    y[: full.compiled.n : 3] = place
    slopes, by_time = full.compiled.jacobian(place, y, full.p)
    for k, name in enumerate(NAMES):
        form, _, by = name.rpartition("_")
        row = full.compiled.n + 3 * k
        found = by_time[row] if by == "t" else slopes[row, 3 * k]
        with mp.workdps(30):
            expected = mp.diff(
                lambda s, f=form: FORMS[f][1]((s - 5) / mp.mpf(WIDTH)), mp.mpf(place), h=mp.mpf(10) ** -18
            )
        assert float(found) == pytest.approx(float(expected), rel=1e-10, abs=1e-12), name


def test_the_stiff_method_agrees_with_the_explicit_one(scene: Simulation) -> None:
    """Each force acts, or begins to, within the run; at its start every e^u but tanh's is beyond all numbers."""
    stiff, explicit = (scene.simulate(10.0, output=4, method=method) for method in ("rodas5p", "dop853"))
    assert np.isfinite(stiff.q).all()
    assert stiff.q == pytest.approx(explicit.q, rel=1e-6, abs=1e-6)
    assert explicit["step_up_t.x"][-1] == pytest.approx(12.5 + WIDTH**2 * np.pi**2 / 6, abs=1e-6)


@pytest.mark.parametrize("method", ["dop853", "rodas5p", "auto"])
def test_an_exponential_of_a_sum_is_not_taken_apart(tmp_path: Path, method: str) -> None:
    """e^(5000 − 1000 t) as e^5000 e^(−1000 t) was ∞ · 0 from t = 0.745 on; e^(100 t − 750) was 0 up to t = 7."""
    load = loader(tmp_path)
    block = """
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    forces: {{f: {{force: a.origin, value: ["{}", 0]}}}}
    """
    run = load(block.format("1 N*exp(100*(t/(1 s) - 7.5))")).simulate(7.5, output=3, method=method)
    assert run["f.Fx"][1] == pytest.approx(np.exp(-500.0), rel=1e-9)
    assert run["a.vx"][-1] == pytest.approx(0.01, rel=1e-6)


@pytest.mark.parametrize("of", ["t/(1 s)", "a.x/(1 m)", "a.vx*(1 s/m)"])
def test_a_slope_that_is_none_is_told(tmp_path: Path, of: str) -> None:
    load = loader(tmp_path)
    block = f"""
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    forces: {{pull: {{force: a.origin, value: ["1 N + 1 N*sqrt({of})", 0]}}}}
    """
    simulation = load(block)
    name = of.partition("/")[0].partition("*")[0]
    message = rf"slope of forces.pull.value.x \(line \d+, column \d+\) by {name} is not"
    with pytest.raises(NonFiniteError, match=message):
        simulation.simulate(1.0, output=2, method="rodas5p")
    assert f"by {name} is not" in str(simulation.simulate_many([{}], 1.0, output=2, method="rodas5p").failures[0])
    assert simulation.simulate(1.0, output=2, method="dop853")["a.x"][-1] > 0.5


@pytest.mark.parametrize(
    ("form", "guarded"),
    [
        ("exp(x)", False),
        ("1/x", False),
        ("sin(x)/(2 + x**2)", False),
        ("sqrt(1 + x**2)", False),
        ("x**20", False),
        ("exp(-x**2)", False),
        ("tanh(x)", False),
        ("1/(1 + exp(x))", True),
        ("exp(-1/x)", True),
    ],
)
def test_only_what_may_overflow_is_guarded(form: str, guarded: bool) -> None:
    x = sp.Symbol("x", real=True)
    value = convert_to_sympy(parse(form, Location("f", 1, 1)), lambda _: x)
    assert compute_partial_derivative(value, x).has(Slope) == guarded
