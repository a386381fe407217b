"""A contact whose elastic force the file writes as an expression: what others of that force do, what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputError, SolverError
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.reader.read import read_mechanism
from tests.equations.subjects import NAN, make
from tests.programs import needs_compiler
from tests.slow import slow_but

FILE = """
format: gudgeon/1
name: ball
parameters: {{k1: 1e7 N/m, k3: 1e18 N/m^3, n: 1.5, d1: 5 um, F_0: 0 N, hysteresis: 2}}
curves:
  pressed: {{x: um, y: N, points: [[0, 0], [10, 60], [40, 400], [100, 2000]], ends: natural, extrapolate: line}}
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{ball: {{mass: 0.2 kg, inertia: 1e-5 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, ball.com]}}}}
start: {{play: {{A: {{rate: [0.5, {across}], e: [0.099 mm, 0]}}}}}}
bearings: {{b: {{radius: 10 mm, clearance: 0.1 mm, length: 5 mm, bearing_material: steel, journal_material: steel}}}}
contacts: {{pad: {{normal: {{law: {law}, restitution: 0.8}}{more}}}}}
scenes: {{dry: {{play: {{A: {{bearing: b, contact: pad}}}}}}}}
"""
CUBIC = "expression, force: k1*delta + k3*delta**3, dissipation: flores"
BENT = '"where(delta < d1, k1*delta, k1*d1 + 4*k1*(delta - d1))"'
FILM = ", film: {law: ocvirk, viscosity: 0.05}, "
MIXED = "mixed: {law: christensen, roughness: 1 um}"
RUBS = ", friction: {law: coulomb, mu: 0.1, v0: 1 mm/s}"


def text(law: str, more: str = "", across: float = 0.02) -> str:
    return FILE.format(law=law, more=more, across=across)


def loaded(folder: Path, law: str, more: str = "", across: float = 0.02, **how: Any) -> gudgeon.Simulation:
    path = folder / "ball.yaml"
    path.write_text(text(law, more, across))
    return gudgeon.load(path, scene="dry", **how)


def at_depth(n: int, depth: float) -> np.ndarray:
    """The ball at a penetration, on its way, turning."""
    e, y = 1e-4 + depth, np.zeros(2 * n)
    y[:2], y[n : n + 3] = (0.6 * e, -0.8 * e), (0.01, 0.03, 2.0)
    return y


@needs_compiler
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_it_is_hertz_where_its_force_is_that(formulation: str, tmp_path: Path) -> None:
    """The same rates to rounding, and states within the tolerance of methods without and with a Jacobian."""
    both = [
        "hertz, stiffness: k1*d1/d1**1.5, dissipation: flores",
        "expression, force: k1*d1*(delta/d1)**n, dissipation: flores",
    ]
    scenes = [loaded(tmp_path, law, RUBS, formulation=formulation) for law in both]
    for method in ("dop853", "rodas5p"):
        one, other = (scene.simulate(t_end=9e-4, method=method, rtol=1e-9) for scene in scenes)
        assert len(one.impacts) == len(other.impacts) >= 1
        for name in ("ball.vx", "ball.vy", "ball.omega", "A.Fn", "A.delta"):
            size = np.abs(one[name]).max()
            np.testing.assert_allclose(other[name], one[name], rtol=0.0, atol=1e-7 * size, err_msg=name)
    hertz, own = (make(text(law, RUBS).encode(), "ball", "dry") for law in both)
    for depth in np.geomspace(1e-9, 5e-5, 12):
        y = at_depth(hertz.n, depth)
        for memory in (np.array([NAN]), np.array([0.02])):
            want = hertz.library.rhs(0.0, y, hertz.p, memory)
            got = own.library.rhs(0.0, y, own.p, memory)
            np.testing.assert_allclose(got, want, rtol=0.0, atol=1e-13 * np.abs(want).max())


@needs_compiler
@pytest.mark.parametrize("force", slow_but([BENT], ["k1*delta + k3*delta**3", BENT, "pressed(delta)"]))
def test_exact_delivers_its_restitution_whatever_the_force(force: str, tmp_path: Path) -> None:
    """A ball that bounces to and fro across its clearance, along one line: .8 of the speed at each bounce."""
    scene = loaded(tmp_path, f"expression, force: {force}, dissipation: exact", across=0.0)
    for method, rtol in (("dop853", 1e-11), ("rodas5p", 1e-10)):
        run = scene.simulate(t_end=1.6e-3, method=method, rtol=rtol)
        assert run["A.delta"][-1] < 0.0 and len(run.impacts) >= 2
        assert abs(run["ball.vx"][-1]) == pytest.approx(0.5 * 0.8 ** len(run.impacts), rel=1e-6)


@needs_compiler
@pytest.mark.parametrize(
    ("law", "more"),
    [
        (CUBIC, FILM + "transition: 2 um"),
        (f"expression, force: {BENT}", RUBS),
        ("expression, force: pressed(delta)", FILM + MIXED),
    ],
)
def test_slopes_are_those_of_the_force(law: str, more: str) -> None:
    """The Jacobian beside central differences of the right-hand side, on both sides of a branch and of a knot."""
    subject = make(text(law, more).encode(), "ball", "dry")
    n, memory, library = subject.n, np.array([0.02]), subject.library
    for depth in (4e-6, 6e-6, 2.3e-5)["mixed" in more :]:  # where the film has a share, differences are no oracle
        y = at_depth(n, depth)
        J = library.jacobian(0.0, y, subject.p, memory)[0][n : 2 * n]
        for column in (0, 1, n, n + 1):
            step = np.zeros(2 * n)
            step[column] = 1e-9 if column < n else 1e-6
            ahead, behind = (library.rhs(0.0, y + way * step, subject.p, memory)[n : 2 * n] for way in (1.0, -1.0))
            want = (ahead - behind) / (2.0 * step[column])
            np.testing.assert_allclose(J[:, column], want, rtol=0.0, atol=1e-6 * np.abs(want).max())


WRONG = {
    "k1*delta + 5 N": ("at_0 is 5 N", "jump at every onset", 0),
    "k1*(d1 - delta)": ("at_0 is 50 N", "jump at every onset", 0),
    "k1*delta + 0 N/s*t": ("'t' is time", "penetration only", 17),
    "k1*deltadot*1 s": ("'deltadot' is not allowed", "dissipation", 3),
    "k1*delta*A.delta": ("'A.delta' is not allowed", "delta, the penetration", 9),
    "k9*delta": ("unknown name 'k9'", "k1", 0),
    "k1*delta**2": ("expected a force (N)", "", 0),
    "k1*d1": ("does not depend on delta", "1e8 N/m * delta", 0),
    "k1*delta - k1*delta": ("does not depend on delta", "cancel", 0),
    "k1*delta - k1*delta**2/d1": ("N at delta =", "deepest", 0),
    "k1*sqrt(delta*d1)": ("no slope at delta = 0", "n >= 1", 0),
    "log(delta/d1)*1 N": ("at_0 is -inf", "finite number", 0),
}


@pytest.mark.parametrize("force", WRONG)
def test_what_is_no_such_force_is_told_where_it_stands(force: str) -> None:
    message, hint, offset = WRONG[force]
    lines = text(f'expression, force: "{force}"').encode()
    with pytest.raises(InputError) as error:
        derive_scene(lines, "ball.yaml", "dry")
    where = error.value.where
    assert message in str(error.value) and hint in str(error.value)
    assert where is not None and where.line == 13
    assert where.column == lines.decode().splitlines()[12].index(force) + 1 + offset


def test_a_parameter_called_delta_is_told() -> None:
    lines = text("expression, force: k1*delta").replace("d1: 5 um", "delta: 5 um")
    with pytest.raises(InputError, match="'delta' is the penetration here, and a parameter"):
        read_mechanism(lines.encode(), "ball.yaml")
    read_mechanism(lines.replace("expression, force: k1*delta", "hertz").encode(), "ball.yaml")  # it may be elsewhere


@needs_compiler
def test_numbers_of_a_run_are_those_of_its_force(tmp_path: Path) -> None:
    """k1 four times is half the penetration; a force that would jump is refused, and one too deep stops."""
    law = "expression, force: k1*delta + F_0*(1 + delta/d1) + 0*hysteresis*d1*k1, dissipation: none, deepest: 80 um"
    scene = loaded(tmp_path, law)
    took = []
    for stiff in (1e7, 4e7):
        run = scene.simulate(t_end=1e-3, method="dop853", rtol=1e-10, parameters={"k1": stiff})
        deepest = run["A.delta"].max()
        assert deepest == pytest.approx(0.5 * np.sqrt(0.2 / stiff), rel=2e-2)
        took.append(run.impacts[0])
    assert len(took) == 2
    with pytest.raises(BadValueError, match=r"force_at_0 is 3 .* with F_0 = 3 .*: a force that is not 0 at delta = 0"):
        scene.simulate(t_end=1e-4, parameters={"F_0": 3.0})
    with pytest.raises(SolverError, match="deep|penetrat"):
        scene.simulate(t_end=1e-3, method="dop853", parameters={"k1": 1e5})
