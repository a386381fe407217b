"""SciPy's integrators and CVODE on the compiled equations agree with the methods in C, written apart from them."""

from __future__ import annotations

import json
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.linkage import compute_residuals, project_state
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = [needs_compiler, pytest.mark.plain]
KNOWN: dict[str, dict[str, Any]] = json.loads(
    (Path(__file__).parent.parent / "data" / "reference_problems.json").read_text(encoding="utf-8")
)

HERE = python_driver.NAMES if find_spec("sksundae") else python_driver.SCIPY
IMPLICIT = tuple(name for name in HERE if name.split(":")[1] in ("Radau", "BDF", "LSODA", "cvode"))


@cache
def reference(name: str, scene: str | None, t_end: float) -> Result:
    return gudgeon.load(name, scene=scene).simulate(t_end, output=40, method="dop853", rtol=1e-13)


def run(name: str, scene: str | None, t_end: float, method: str, rtol: float) -> Result:
    return gudgeon.load(name, scene=scene).simulate(t_end, output=40, method=method, rtol=rtol)


@pytest.mark.parametrize("method", HERE)
def test_pendulum(method: str) -> None:
    """A tolerance of 1e-9 a step leaves at most some hundred times as much after a second; Φ is at rounding."""
    found, want = run("pendulum", None, 1.0, method, 1e-9), reference("pendulum", None, 1.0)
    assert abs(found.q - want.q).max() < 2e-7
    assert abs(found.v - want.v).max() < 1e-6
    assert abs(found.a - want.a).max() < 1e-6 * abs(want.a).max()
    assert found.diagnostics.phi_max < 1e-14 and found.diagnostics.phi_dot_max < 1e-14
    assert found.diagnostics.method == method and found.diagnostics.rtol == 1e-9


@pytest.mark.parametrize("method", slow_but(["scipy:DOP853", "scipy:LSODA", "scipy:RK45"], HERE))
def test_smaller_tolerances_give_smaller_errors(method: str) -> None:
    want = reference("pendulum", None, 1.0)
    errors = [abs(run("pendulum", None, 1.0, method, rtol).q - want.q).max() for rtol in (1e-5, 1e-7, 1e-9)]
    assert errors[0] > 5.0 * errors[1] > 25.0 * errors[2]


def test_a_drive_whose_rate_jumps_is_refused() -> None:
    """The impulse there belongs to the C methods: silently wrong numbers would follow."""
    jump = gudgeon.load(Path(__file__).parent.parent / "mechanisms/methods/jump.yaml")
    with pytest.raises(BadValueError, match="a jump of the rate of crank needs an impulse"):
        jump.simulate(0.2, method="scipy:DOP853")


@pytest.mark.parametrize("method", slow_but(["scipy:RK45"], HERE))
def test_andrews_squeezer(method: str) -> None:
    """Against the published angles."""
    known = KNOWN["andrews_squeezer"]
    found = run("andrews_squeezer", None, known["t"], method, 1e-10)
    angles = [found[name][-1] for name in ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")]
    assert angles == pytest.approx(known["angles"], rel=1e-7)


@pytest.mark.parametrize("method", slow_but(["scipy:LSODA"], IMPLICIT))
def test_lubricated_press(method: str) -> None:
    """Stiff: the film's rate is 1e5 1/s. Positions to 1e-4 of the clearance of .3 mm, forces to 1e-4."""
    want = reference("nine_bar_press", "lubricated", 0.01)
    found = run("nine_bar_press", "lubricated", 0.01, method, 1e-8)
    assert abs(found.q - want.q).max() < 1e-4 * 0.3e-3
    assert abs(found["A.F"] - want["A.F"]).max() < 1e-4 * want["A.F"].max()
    assert found.diagnostics.onsets == 0
    assert found.diagnostics.jacobians > 0


@pytest.mark.parametrize("method", slow_but(["scipy:RK45"], HERE))
def test_first_contacts_of_the_dry_press(method: str) -> None:
    """Three contacts: onset and separation, impact velocity, peak force, against roots that other code finds."""
    rtol = 1e-9
    found, want = run("nine_bar_press", "dry", 0.009, method, rtol), reference("nine_bar_press", "dry", 0.009)
    assert found.impacts["joint"].tolist() == want.impacts["joint"].tolist() == [0, 1, 0]
    assert abs(found.impacts["t_on"] - want.impacts["t_on"]).max() < 2e-9
    assert abs(found.impacts["t_off"] - want.impacts["t_off"]).max() < 5e-9
    assert found.impacts["deltadot"] == pytest.approx(want.impacts["deltadot"], rel=2e-6)
    assert found.impacts["F_peak"] == pytest.approx(want.impacts["F_peak"], rel=2e-5)
    assert found.impacts["t_peak"] == pytest.approx(want.impacts["t_peak"], abs=2e-6)
    assert [p.F for p in found.diagnostics.peaks] == pytest.approx([p.F for p in want.diagnostics.peaks], rel=2e-5)
    assert found.diagnostics.energy_residual < 1e-6 * want.diagnostics.energy_turned_over
    assert (found.state == want.state).all()


@pytest.mark.slow
def test_onsets_at_a_tight_tolerance() -> None:
    """To the 1e-12 s that both locate them to."""
    found, want = run("nine_bar_press", "dry", 0.009, "scipy:DOP853", 1e-12), reference("nine_bar_press", "dry", 0.009)
    assert abs(found.impacts["t_on"] - want.impacts["t_on"]).max() < 3e-12


def test_a_run_goes_on_inside_a_contact() -> None:
    """Latch and code are taken over: the second half of a run is the second half of the whole one.

    At rtol = 1e-10 the last digit of a clearance changes the end by 1e-12 to 2.5e-10 rad, as steps pass kinks of the
    friction law; at 1e-13 by less than 1e-11.
    """
    press, want = gudgeon.load("nine_bar_press", scene="dry"), reference("nine_bar_press", "dry", 0.009)
    half = press.simulate(0.007, output=1, method="scipy:DOP853", rtol=1e-13)
    assert half.state[-1].tolist() == [1, 0] or half.state[-1].tolist() == [2, 0]
    rest = press.simulate(0.009, output=10, method="scipy:DOP853", rtol=1e-13, start=half.final)
    assert abs(rest.q[-1] - want.q[-1]).max() < 1e-11
    assert rest.impacts["t_off"][0] == pytest.approx(want.impacts["t_off"][0], abs=1e-10)


def test_projection_is_the_nearest_state_in_the_metric_of_the_mass() -> None:
    """What is moved is M⁻¹Φ_qᵀ times something; a state that fits stays."""
    squeezer = gudgeon.load("andrews_squeezer")
    compiled, p, start = squeezer.compiled, squeezer.p, squeezer.start()
    rng = np.random.default_rng(3)
    q0, v0 = start.q + 1e-7 * rng.normal(size=compiled.n), start.v + 1e-3 * rng.normal(size=compiled.n)
    q, v = project_state(compiled, 0.0, q0, v0, p)
    assert max(compute_residuals(compiled, 0.0, q, v, p)) < 1e-13
    again = project_state(compiled, 0.0, q, v, p)
    assert abs(again[0] - q).max() < 1e-15 and abs(again[1] - v).max() < 1e-12
    rows = compiled.phi_q(0.0, q, p)
    free = np.linalg.svd(rows)[2][len(rows) :]  # directions that keep the constraints
    change = compiled.mass(p) * (v - v0)
    assert abs(free @ change).max() < 1e-9 * abs(change).max()


def test_an_unknown_name_is_told_what_there_is() -> None:
    with pytest.raises(BadValueError) as message:
        gudgeon.load("pendulum").simulate(1.0, method="scipy:RK7")
    for name in ("rk4", "dop853", *python_driver.NAMES):
        assert name in str(message.value)


def test_what_the_backends_refuse() -> None:
    with pytest.raises(BadValueError, match="dry_friction.*C methods"):
        gudgeon.load("belt_block").simulate(1.0, method="scipy:BDF")
    with pytest.raises(BadValueError, match="controls its step"):
        gudgeon.load("pendulum").simulate(1.0, method="scipy:BDF", step=1e-3)
    with pytest.raises(BadValueError, match="kinematic"):
        gudgeon.load("nine_bar_press").simulate(0.1, method="scipy:BDF")


def test_without_scikit_sundae_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sksundae", None)
    monkeypatch.setitem(sys.modules, "sksundae.cvode", None)
    with pytest.raises(GudgeonError, match="pip install scikit-sundae"):
        gudgeon.load("pendulum").simulate(0.1, method="sundials:cvode")
