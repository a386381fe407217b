"""The audit of a run: quiet where a run is right; each grave fault of the past, put back into C, is reported."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.audit import CHECKS
from gudgeon.errors import BadValueError
from gudgeon.model.reference import check_reference_values
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.simulation.simulation import Simulation
from tests.audit_mutants import mutant
from tests.programs import needs_compiler
from tests.random_contacts import HEAD, SLIDER_CRANK
from tests.scenes import loader

pytestmark = needs_compiler

SPRING = """
parameters: {{K: 40 N/m}}
bodies: {{b: {{mass: 1 kg, inertia: 1e-3 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{g: {{translational: [ground.O, b.origin], axis: [1, 0]}}}}
forces: {{coil: {{force: b.origin, value: [-K*b.x, 0 N]}}}}
start: {{set: {{b.x: 0.3 m}}}}
events: {{{events}}}
"""
LINK = """
gravity: [0, -9.81]
bodies: {{arm: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, arm.tail]}}}}
start: {{set: {{arm.theta: {theta}}}}}
"""
FILM = """
gravity: [0, -9.81]
materials: {s: {E: 2e11, nu: 0.3}}
bodies:
  a: {length: 0.1, mass: 0.2, inertia: auto}
  b: {length: 0.3, mass: 0.4, inertia: auto}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, a.tail]}, B: {revolute: [a.head, b.tail]}}
start: {set: {a.theta: 0.3, b.theta: -0.7}, rates: {a.omega: 3, b.omega: -5}}
bearings: {g: {radius: 25 mm, clearance: 5 um, length: 40 mm, bearing_material: s, journal_material: s}}
contacts: {f: {film: {law: ocvirk, viscosity: 0.03}}}
scenes: {f: {play: {B: {bearing: g, contact: f}}}}
"""
# steps are not made so short that forces of films are right inside them
NO_FILM_ERROR = ("engine/methods/defect.c", "return run->films.error;", "return 0.0;")


@pytest.mark.parametrize(
    "name, scene, t_end",
    [
        ("nine_bar_press", "dry", 0.05),
        ("nine_bar_press", "lubricated", 0.1),
        ("slider_crank_spring", "ideal", 0.5),
        ("four_bar", "ideal", 1.0),
        ("belt_block", "ideal", 1.0),
        ("bouncing_ball", "damped", 0.5),
    ],
)
@pytest.mark.parametrize("method", ["auto", "dop853", "rk4"])
def test_right_runs_stay_far_below_every_limit(name: str, scene: str, t_end: float, method: str) -> None:
    simulation = gudgeon.load(name, scene)
    if simulation.source.degrees_of_freedom == 0 and method != "auto":
        pytest.skip("nothing is integrated")
    run = simulation.simulate(t_end, output=50, method=method, step=1e-6 if method == "rk4" else None, audit="full")
    assert not [note for note in run.diagnostics.notes if note.startswith("audit:")]
    assert max(one.worst for one in run.diagnostics.audit) < 1.0, run.diagnostics.audit


def test_the_audit_changes_no_number() -> None:
    press = gudgeon.load("nine_bar_press", "dry")
    runs = [press.simulate(0.02, output=50, audit=level) for level in (True, False, "full")]
    for other in runs[1:]:
        np.testing.assert_array_equal(runs[0].q, other.q)
        for name in ("t_on", "t_off", "F_peak"):
            np.testing.assert_array_equal(runs[0].impacts[name], other.impacts[name])
    assert runs[0].diagnostics.right_hand_sides == runs[1].diagnostics.right_hand_sides
    assert runs[1].diagnostics.audit == ()
    assert Diagnostics.from_json(runs[0].diagnostics.to_json()).audit


IN_C = {check.name for check in CHECKS}


@pytest.mark.parametrize(
    "name, scene, method, checked",
    [
        (
            "nine_bar_press",
            "dry",
            "auto",
            {"defect", "gap", "free", "position", "velocity", "acceleration", "branch", "step"},
        ),
        (
            "nine_bar_press",
            "lubricated",
            "auto",
            {"defect", "gap", "position", "velocity", "acceleration", "branch", "force", "step"},
        ),
        ("andrews_squeezer", "ideal", "auto", {"defect", "rate", "position", "velocity", "acceleration", "step"}),
        ("nine_bar_press", "dry", "rk4", {"gap", "free", "position", "velocity", "acceleration", "branch"}),
        ("pendulum", "ideal", "rk4", {"position", "velocity", "acceleration"}),
    ],
)
def test_what_was_not_checked_is_not_listed(name: str, scene: str, method: str, checked: set[str]) -> None:
    run = gudgeon.load(name, scene).simulate(
        0.03, output=20, method=method, step=1e-5 if method == "rk4" else None, audit="full"
    )
    assert {one.check for one in run.diagnostics.audit} & IN_C == checked


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_a_batch_lists_what_a_single_run_lists(method: str) -> None:
    press, step = gudgeon.load("nine_bar_press", "dry"), 1e-5 if method == "rk4" else None
    for audit in (True, False):
        batch = press.simulate_many([{}], 0.005, output=20, audit=audit, side_by_side=False, method=method, step=step)
        run = press.simulate(0.005, output=20, audit=audit, method=method, step=step)
        assert batch[0].diagnostics.audit == run.diagnostics.audit
        assert bool(batch[0].diagnostics.audit) == audit


def test_other_levels_are_refused() -> None:
    with pytest.raises(BadValueError, match="expected True, False or 'full'"):
        gudgeon.load("pendulum").simulate(0.1, audit="all")


def test_a_batch_counts_failed_audits(tmp_path: Path) -> None:
    """A run that fails its audit is a failed row with the reason; what is right beside it is not."""
    broken = mutant(
        gudgeon.load("pendulum"),
        tmp_path,
        ("engine/scalar_simd/motion.h", "dy[k] = y[N_X + k]", "dy[k] = 1.1 * y[N_X + k]"),
    )
    batch = broken.simulate_many({}, np.array([0.5, 1.0]), output=20, side_by_side=False)
    assert len(batch.failures) == 2
    assert all("audit: check" in str(failure.error) for failure in batch.failures)


# Each fault: the scene, what is put back, what the audit has to name.
def crank(tmp_path: Path) -> Simulation:
    numbers = ", r: 50 mm, L: 150 mm, m1: 0.3 kg, m2: 0.2 kg, m3: 0.3 kg"
    numbers += ", J1: 1e-4 kg*m^2, J2: 4e-4 kg*m^2, J3: 1e-4 kg*m^2"
    text = HEAD.format(name="machine", numbers=numbers, law="flores", play="crankpin: {bearing: pin, contact: dry}")
    file = tmp_path / "machine.yaml"
    file.write_text(text.replace("gravity: [0, -9.81]\n", "") + SLIDER_CRANK)
    return gudgeon.load(file, "dry")


def reported(simulation: Simulation, t_end: float, **settings: object) -> str:
    """The message of the audit, from an error or from notes."""
    try:
        run = simulation.simulate(t_end, output=500, **settings)  # type: ignore[arg-type]
    except gudgeon.SolverError as error:
        return str(error)
    return "; ".join(note for note in run.diagnostics.notes if note.startswith("audit:"))


def test_a_contact_that_is_missed(tmp_path: Path) -> None:
    """Every third contact is not looked for."""
    right = crank(tmp_path)
    assert not reported(right, 0.05)
    wrong = mutant(
        right,
        tmp_path,
        (
            "engine/watch/events.c",
            "is_gap ? bracket_gap_zero(run",
            "is_gap ? (run->discrete.contact[event].closed || run->contacts.onsets % 3 != 2) && bracket_gap_zero(run",
        ),
        ("engine/methods/step_length.c", "!run->discrete.contact[i].closed && joint->deltadot < 0.0)", "0)"),
    )
    found = reported(wrong, 0.05)
    assert found


def test_torques_that_are_wrong(tmp_path: Path) -> None:
    """A reaction of the wrong sign: the library is held against values of the NumPy target."""
    spring = gudgeon.load("slider_crank", "ideal")
    text = next(line for line in spring.source.files["constraints.c"].splitlines() if "torques[0] =" in line)
    wrong = mutant(spring, tmp_path, ("constraints.c", text, text.replace("= ", "= 2.0*")))
    with pytest.raises(gudgeon.AuditError, match="torques"):
        check_reference_values(wrong.compiled)
    assert "check torque" in reported(wrong, 0.1) or "check power" in reported(wrong, 0.1)


def test_film_forces_between_the_ends_of_steps(tmp_path: Path) -> None:
    """Interpolated with accelerations, which have the errors of velocities many times over."""
    right = loader(tmp_path)(FILM, "f")
    assert not reported(right, 0.05, method="radau5")
    wrong = mutant(
        right,
        tmp_path,
        ("engine/methods/radau.c", "i < N_X && !has_films()", "i < N_X"),
        (
            "engine/scalar_simd/radau_step.h",
            "& (convergence_rate * force_change <= run->newton.film_force_tol * (1.0 - convergence_rate))",
            "",
        ),
        NO_FILM_ERROR,
    )
    assert "check force" in reported(wrong, 0.05, method="radau5")


def test_an_event_that_is_lost(tmp_path: Path) -> None:
    """Every zero is taken for a pole."""
    right = loader(tmp_path)(SPRING.format(events="zero: {zero: b.x}"))
    assert not reported(right, 2.0)
    edit = ("engine/watch/events.c", "&& is_pole(run, step, fraction, user_event, p));", ");")
    assert "check event" in reported(mutant(right, tmp_path, edit), 2.0)


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_taylor_whose_steps_are_endless(rtol: float, tmp_path: Path) -> None:
    """From a symmetric start the last terms of the series vanish; the defect shows it."""
    link = loader(tmp_path)(LINK.format(theta="0 rad")).of_method("taylor")
    assert not reported(link, 10.0, method="taylor", rtol=rtol)
    (tmp_path / "mutant").mkdir()
    wrong = mutant(
        link,
        tmp_path / "mutant",
        (
            "engine/scalar_simd/taylor.h",
            "return real_exp2(-real_max(real_log2(largest) / n, real_log2(largest_before) / (n - 1)));",
            "(void)largest, (void)largest_before, (void)n;\n    return make_real(0.9);",
        ),
        (
            "engine/scalar_simd/taylor.h",
            "status ? make_real(INFINITY) : taylor_compute_defect(run, step, rate)",
            "make_real(0.0)",
        ),
    )
    found = reported(wrong, 10.0, method="taylor", rtol=rtol)
    assert any(x in found for x in ("check defect", "check rate", "check step", "no step is small enough")), found


def test_a_dense_output_that_is_wrong(tmp_path: Path) -> None:
    """A coefficient of the interpolant: ends of steps are right, samples are not."""
    press = gudgeon.load("nine_bar_press", "lubricated")
    wrong = mutant(
        press,
        tmp_path,
        (
            "engine/scalar_simd/radau.h",
            "r * (d[1][i] + s * (d[2][i]",
            "r * (1.01 * d[1][i] + s * (d[2][i]",
        ),
        NO_FILM_ERROR,
    )
    found = reported(wrong, 0.1, audit="full")
    assert any(check in found for check in ("check defect", "check step", "check sample")), found


def test_a_symbol_of_the_file_in_place_of_another(tmp_path: Path) -> None:
    """The right-hand side reads another parameter: values of the NumPy target differ."""
    spring = loader(tmp_path)(SPRING.format(events="zero: {zero: b.x}"))
    wrong = mutant(spring, tmp_path, ("dynamics.c", "p->K", "p->b_mass"))
    with pytest.raises(gudgeon.AuditError, match="expected"):
        check_reference_values(wrong.compiled)
