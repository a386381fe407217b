"""Drives that stay finite while e^u in them overflows: their rates against mpmath, and runs by all methods."""

from __future__ import annotations

import math
import re
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest

from gudgeon.simulation.simulation import Simulation
from tests.kernels.test_finite_slopes import FAR, FORMS, MODERATE, WIDTH
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.slow import slow_but

pytestmark = needs_compiler
U = "((t/(1 s) - 5)/1e-3)"
FEW = "step_up", "bump", "angle_of_two", "twice", "within"  # test_finite_slopes has all of them


def text(forms: list[str], beside: str = "") -> str:
    """A mass on the x axis driven along each form; `beside` hangs on the first one."""
    lines = ["ground: {o: [0, 0]}", "gravity: [0, -9.81]", "bodies:"]
    lines += [f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}" for name in forms]
    lines += ["  bar: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}"] * bool(beside)
    lines += ["joints:", *(f"  on_{n}: {{translational: [ground.o, {n}.origin], axis: [1, 0]}}" for n in forms)]
    lines += [f"  pin: {{revolute: [{beside}.origin, bar.tail]}}"] * bool(beside) + ["drives:"]
    for name in forms:
        value = re.sub(r"\bu\b", U, FORMS[name][0])
        lines.append(f'  by_{name}: {{coordinate: {name}.x, value: "1 m*({value})"}}')
    return "\n".join(lines)


@pytest.fixture(scope="module", params=slow_but([FEW], [FEW, tuple(FORMS)]), ids=len)
def driven(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Simulation, list[str]]:
    """A scene, and by which forms its masses are driven."""
    return loader(tmp_path_factory.mktemp("drives"))(text([*request.param])), [*request.param]


@pytest.mark.parametrize("u", [*MODERATE, *FAR])
def test_rates_are_those_of_thirty_digits(driven: tuple[Simulation, list[str]], u: float) -> None:
    """They are ∞/∞ or 0 · ∞ as they are written, from e^355 on: it was said that a root has no slope there."""
    full, names = driven[0].full, driven[1]
    compiled, p = full.compiled, full.p
    t, none = 5.0 + WIDTH * u, np.zeros(compiled.n)
    rows = [row.name for row in compiled.source.start_equations]
    nu, gamma = compiled.closed_nu(t, none, p), compiled.closed_gamma(t, none, none, p)
    for name in names:
        form = FORMS[name][1]
        row = rows.index(f"by_{name}")
        with mp.workdps(40):

            def at(s: mp.mpf, form: object = form) -> mp.mpf:
                return form((s - 5) / mp.mpf(WIDTH))  # type: ignore[operator]

            rate, second = (mp.diff(at, mp.mpf(t), k, h=mp.mpf(10) ** -14) for k in (1, 2))
        assert abs(nu[row]) == pytest.approx(abs(float(rate)), rel=1e-9, abs=1e-9), name
        assert abs(gamma[row]) == pytest.approx(abs(float(second)), rel=1e-9, abs=1e-6), name


@pytest.mark.parametrize("forms", slow_but([("step_up", "flat")], [("step_up", "flat"), tuple(FORMS)]), ids=len)
@pytest.mark.parametrize("formulation", slow_but(["reduced"], ["full", "reduced"]))
def test_without_freedom_the_linkage_follows(formulation: str, forms: tuple[str, ...], tmp_path: Path) -> None:
    scene = loader(tmp_path, formulation)(text(list(forms)))
    run = scene.simulate(10.0, output=4)
    for name in forms:
        expected = [float(FORMS[name][1]((mp.mpf(t) - 5) / mp.mpf(WIDTH))) for t in (0.0, 2.5, 5.0, 7.5, 10.0)]
        assert run[f"{name}.x"] == pytest.approx(expected, rel=1e-12, abs=1e-12), name
        assert np.isfinite(run[f"{name}.vx"]).all() and np.isfinite(run[f"{name}.ax"]).all(), name
    assert np.isfinite(run.diagnostics.energy_residual)


@pytest.mark.parametrize("method", ["dop853", "rodas5p", "auto", "rk4"])
@pytest.mark.parametrize("form", slow_but(["bump", "twice"], ["step_up", "bump", "twice"]))
def test_what_hangs_on_it_is_integrated(tmp_path: Path, form: str, method: str) -> None:
    """In both formulations; eight runs of rk4 at once do as one alone, to the bit."""
    simulation = loader(tmp_path)(text([form], form))
    step = 1e-3 if method == "rk4" else None
    runs = [s.simulate(0.5, output=5, method=method, step=step) for s in (simulation, simulation.full)]
    for run in runs:
        assert np.isfinite(run.q).all() and run["bar.theta"] == pytest.approx(runs[0]["bar.theta"], abs=1e-6)
        assert run[f"{form}.vx"] == pytest.approx(0.0, abs=1e-300)
    if method == "rk4":
        many = simulation.simulate_many([{}] * 8, 0.5, output=5, method=method, step=step)
        assert not many.failures and np.array_equal(many[7].q, runs[0].q)


CORNERS = [
    *(f"1/(1 + exp({half} - {2 * half}*abs(t/(1 s))))" for half in (800, 5000)),
    "exp(-exp(max(500 - 1000*t/(1 s), -9)*10))",
]


@pytest.mark.parametrize("value", slow_but(CORNERS[2:], CORNERS))
def test_corners_within_are_where_they_are(tmp_path: Path, value: str) -> None:
    """Not a little ahead and behind too."""
    block = f"""
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    drives: {{d: {{coordinate: a.x, value: "1 m*({value})"}}}}
    """
    run = loader(tmp_path)(block).simulate(1.0, output=4)
    assert np.isfinite(run["a.ax"]).all() and run["a.vx"][[0, 1, 3, 4]] == pytest.approx(0.0, abs=1e-3)
    assert run["a.x"][-1] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(
    "value", ["exp(5000 - 1000*t/(1 s))*exp(1000*t/(1 s) - 4999)", "exp(5000*t/(1 s))/exp(5000*t/(1 s) - 1)"]
)
def test_exponentials_of_which_one_overflows_are_one(tmp_path: Path, value: str) -> None:
    block = f"""
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    drives: {{d: {{coordinate: a.x, value: "1 m*({value})"}}}}
    """
    run = loader(tmp_path)(block).simulate(1.0, output=4)
    assert run["a.x"] == pytest.approx(math.e, rel=1e-12) and not run["a.vx"].any() and not run["a.ax"].any()
