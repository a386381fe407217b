"""Faults of the past of which the audit knew nothing, put back: the audit of a run, or the check at load, reports each.

Others are in test_audit.py; tests/audit_mutants.py makes random ones.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.reference import check_reference_values
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals
from tests.audit_mutants import mutant
from tests.programs import needs_compiler
from tests.scenes import loader, patched
from tests.simulation.test_audit import reported

pytestmark = needs_compiler

CYLINDER = """
gravity: [0, -9.81]
materials: {steel: {E: 207 GPa, nu: 0.3}}
bodies:
  boom: {length: 4 m, mass: 200 kg, inertia: auto, points: {lug: [1.2 m, -0.2 m]}}
  hook: {mass: 100 kg, inertia: 10 kg*m^2, com: [0, -0.5 m]}
ground: {O: [0, 1.5 m], foot: [0.8 m, 0.2 m]}
joints:
  O: {revolute: [ground.O, boom.tail]}
  wrist: {revolute: [boom.head, hook.origin]}
drives:
  c1: {distance: [ground.foot, boom.lug], value: 1.35 m + 0.2 m*smooth_step(t, 1 s, 4 s)}
forces: {pull: {force: hook.com, value: [1 kN*ramp(t, 3 s, 1 s), 0 N]}}
start: {guess: {boom.theta: 20 deg}}
bearings: {pin: {radius: 35 mm, clearance: 0.3 mm, length: 80 mm, bearing_material: steel, journal_material: steel}}
contacts:
  dry: {normal: {law: lankarani_nikravesh, restitution: 0.8}}
scenes: {worn: {play: {wrist: {bearing: pin, contact: dry}}}}
"""
STUCK = """
bodies: {b: {mass: 2.5 kg, inertia: 1e-2 kg*m^2}}
ground: {O: [0, 0]}
joints: {way: {translational: [ground.O, b.origin], axis: [1, 0]}}
forces: {rub: {dry_friction: [ground.O, b.origin], direction: [1, 0], static: 9 N, kinetic: 7 N}}
freedoms: 1
start: {rates: {b.vx: 1.3 m/s}}
events: {halt: {zero: b.vx, direction: falling}, any: {zero: b.vx}}
"""
TORSION = """
parameters: {k: 3 N*m}
bodies: {rod: {length: 300 mm, mass: 1 kg, inertia: 8e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, rod.tail]}}
forces: {twist: {torque: rod, value: -k*sin(rod.theta)}}
start: {set: {rod.theta: 40 deg}}
"""
BRISTLES = """
parameters: {c: 0.3 mm, g_v: 8 N}
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, j.origin]}}
forces: {load: {force: j.origin, value: [0, -g_v]}, turn: {torque: j, value: 1e-2 N*m}}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings: {p: {radius: 10 mm, clearance: c, length: 20 mm, bearing_material: s, journal_material: s}}
contacts:
  c:
    normal: {law: lankarani_nikravesh, restitution: 0.8}
    friction: {law: lugre, mu: 0.15, mu_s: 0.2, v_s: 1 cm/s, stiffness: 2e4 1/m, damping: 3 s/m}
scenes: {m: {play: {A: {bearing: p, contact: c}}}}
"""


def part_of(text: str, begin: str, start: str, end: str) -> str:
    """The part of a text from `start`, behind `begin`, to `end`, which is left out."""
    first = text.index(start, text.index(begin))
    return text[first : text.index(end, first)]


def test_switches_of_driven_chains_that_nobody_evaluates(tmp_path: Path) -> None:
    """Fault 02: switches of drives inside a step are those of its beginning, ranges are what was in memory."""
    right = loader(tmp_path)(CYLINDER, "worn")
    assert not reported(right, 6.0)
    heading = "    /* directions, arms, drives */"
    ranges = part_of(right.source.files["watched.c"], "bound_monitored_functions", heading, "}\n")
    values = part_of(right.source.files["reduced.c"], "void monitored_functions", heading, "\n}")
    garbage = "    out[0] = out[1] = (Interval){-INFINITY, INFINITY, -INFINITY, INFINITY, 0};\n"  # whatever lies there
    stale = "    rhs->g[0] = rhs->g[1] = -1.0;"
    wrong = mutant(right, tmp_path, ("watched.c", ranges, garbage), ("reduced.c", values, stale))
    specified = reported(wrong, 6.0)  # whichever comes first
    assert "check branch" in specified or "changes its branch without end" in specified


@pytest.mark.parametrize("method", ["auto", "dop853", "rodas5p"])
def test_events_that_are_rounding(method: str, tmp_path: Path) -> None:
    """Fault 07: velocities that stick are not put at rest and have no uncertainty: changes of their sign are events."""
    right = loader(tmp_path)(STUCK)
    assert not reported(right, 2.5, method=method)
    known = "    estimate_monitored_function_errors(run, t, y, error, p, uncertainty);\n"
    exact = "    for (int i = 0; i < N_MONITORED; i++)\n        uncertainty[i] = 0.0;\n"
    drifts = ("engine/run/slips.c", "fabs(v) <= MIN_SLIP", "fabs(v) <= INFINITY")
    wrong = mutant(right, tmp_path, ("engine/run/uncertainty.c", known, exact), drifts)
    assert "check event" in reported(wrong, 2.5, method=method)


def test_a_parameter_that_is_taken_for_the_order_of_a_series(tmp_path: Path) -> None:
    """Fault 20: terms of the series read the order k in place of the parameter k. Defects stay within the tolerance."""
    right = loader(tmp_path)(TORSION).of_method("taylor")
    assert not reported(right, 2.0, method="taylor")
    terms = part_of(right.source.files["taylor.c"], "", "static void taylor_terms", "/* right-hand side */")
    (tmp_path / "mutant").mkdir()
    wrong = mutant(right, tmp_path / "mutant", ("taylor.c", terms, terms.replace("-p->k_*", "-k*")))
    run = wrong.simulate(2.0, output=20, method="taylor", audit=False)
    assert abs(run.q[-1, 2] - 0.6484685601913911) > 1e-3  # SciPy
    found = reported(wrong, 2.0, method="taylor")
    assert "check rate" in found or "check step" in found


def test_a_parameter_that_is_taken_for_an_abbreviation_of_a_law(tmp_path: Path) -> None:
    """Fault 20: the friction of bristles reads the parameter g_v in place of its own g(v)."""
    right = loader(tmp_path)(BRISTLES, "m")
    check_reference_values(right.compiled)
    own = part_of(right.source.files["clearance.c"], "", "    const double g_v = ", "\n")
    wrong = mutant(right, tmp_path, ("clearance.c", own, "    const double g_v = 8.0;"))
    with pytest.raises(gudgeon.AuditError, match="compiled library .* is wrong"):
        check_reference_values(wrong.compiled)


@pytest.mark.parametrize("first", [0, 1])
def test_a_parameter_that_is_not_taken_over(first: int, tmp_path: Path) -> None:
    """What is given for every second slot arrives, or the library is refused."""
    right = gudgeon.load("slider_crank", "dry")
    line = next(x for x in right.source.files["parameters.c"].splitlines() if f"is_given[{first}]" in x)
    stale = line.replace(f"is_given[{first}]", f"is_given[{first + 1}]")
    with pytest.raises(gudgeon.AuditError, match=f"parameter {first}"):
        check_reference_values(mutant(right, tmp_path, ("parameters.c", line, stale)).compiled)


@pytest.mark.parametrize(
    "text, wrong",
    [
        ("smaller_1 = 1.0;", "smaller_1 = 1.1;"),
        ("smaller_2 = 1.0;", "smaller_2 = 1.1;"),
        ("smaller_1 = friction_slope*(-v0 - v_t);", "smaller_1 = friction_slope*(-v0 + v_t);"),
        ("larger_2 = smaller_2;", "larger_2 = 0.0;"),
    ],
)
def test_a_branch_of_a_law_that_is_wrong(text: str, wrong: str, tmp_path: Path) -> None:
    """Stored values have contacts that slip either way, fully and in the transition."""
    broken = mutant(gudgeon.load("slider_crank", "dry"), tmp_path, ("clearance.c", text, wrong))
    with pytest.raises(gudgeon.AuditError, match="compiled library .* is wrong"):
        check_reference_values(broken.compiled)


def test_a_method_that_is_not_consistent(tmp_path: Path) -> None:
    """A stage less: the steps become so short that their errors pass, and add up to another motion."""
    edit = ("engine/scalar_simd/dop853.h", "step->k[0][i] = run->dy[i];", "step->k[0][i] = 0.9 * run->dy[i];")
    broken = mutant(gudgeon.load("pendulum"), tmp_path, edit)
    found = reported(broken, 1e-3, method="dop853")
    assert "check rate" in found or "check step" in found


def test_a_force_that_is_not_a_number_is_reported(tmp_path: Path) -> None:
    press = gudgeon.load("nine_bar_press", "lubricated")
    edit = ("clearance.c", "W = sqrt((w_n * w_n) + (w_t * w_t))", "W = sqrt((w_n * w_n) + (w_t + w_t))")
    broken = mutant(press, tmp_path, edit)
    found = reported(broken, 0.05)
    assert any(text in found for text in ("check finite", "check force", "no longer finite")), found  # by the sign of 0
    right = press.simulate(0.05, output=50)
    assert {one.worst for one in right.diagnostics.audit if one.check == "finite"} == {0.0}
    assert np.isfinite(right["A.F"]).all()


def test_a_step_control_that_is_too_loose(tmp_path: Path) -> None:
    """The estimate of order 3 in other units: steps become so long that they err by many tolerances."""
    right = gudgeon.load("slider_crank", "dry")
    assert not reported(right, 0.02, audit="full")
    edit = (
        "engine/scalar_simd/dop853.h",
        "error_3 = real_max(real_abs(sum_3) * weight",
        "error_3 = real_max(real_abs(sum_3) + weight",
    )
    assert "check step" in reported(mutant(right, tmp_path, edit), 0.02, audit="full")


@pytest.mark.parametrize(
    "method, edit",
    [
        ("rodas5p", ("engine/scalar_simd/rodas5p.h", "real_abs(step->k[7][i])", "1e-4 * real_abs(step->k[7][i])")),
        (
            "dop853",
            (
                "engine/scalar_simd/dop853.h",
                "error_5 = real_max(real_abs(sum_5)",
                "error_5 = real_max(1e-4 * real_abs(sum_5)",
            ),
        ),
    ],
)
def test_an_error_estimate_that_is_too_small(method: str, edit: tuple[str, str, str], tmp_path: Path) -> None:
    right = gudgeon.load("andrews_squeezer")
    assert not reported(right, 0.03, method=method)
    # the distance from the constraint equations would refuse the worst of these steps
    also = (
        "engine/scalar_simd/distance.h",
        "#define MAX_CONSTRAINT_DRIFT 10.0",
        "#define MAX_CONSTRAINT_DRIFT INFINITY",
    )
    assert "audit: check" in reported(mutant(right, tmp_path, edit, also), 0.03, method=method)


@pytest.mark.parametrize(
    "name, t_end, edit",
    [
        ("andrews_squeezer", 0.02, ("if (s + 1 == DOP853_STAGES)", "if (s - 1 == DOP853_STAGES)")),
        ("slider_crank_spring", 1.0, ("- 43.48988418106996 * k[7][i]);", "* k[7][i]);")),
    ],
)
def test_a_method_that_loses_its_order(name: str, t_end: float, edit: tuple[str, str], tmp_path: Path) -> None:
    """A stage of DOP853 at another place: many short steps, of which each alone errs by less than the tolerance."""
    right = gudgeon.load(name)
    broken = mutant(right, tmp_path, ("engine/scalar_simd/dop853.h", *edit))
    run = broken.simulate(t_end, output=20, audit=False)
    assert run.diagnostics.steps > 20 * right.simulate(t_end, output=20).diagnostics.steps
    assert "check step" in reported(broken, t_end)


def test_a_start_that_is_changed(tmp_path: Path) -> None:
    """A rate of the tree is read from another body: the motion is right, and that of another start."""
    right = gudgeon.load("slider_crank", "dry")
    broken = mutant(right, tmp_path, ("reduced.c", "rod_omega_ = v[5];", "rod_omega_ = v[6];"))
    assert "check start" in reported(broken, 0.01)


def test_a_start_that_is_not_the_one_of_the_file(tmp_path: Path) -> None:
    """A given position is written to another coordinate: closed all the same, and another motion."""
    right = gudgeon.load("pendulum")
    assert not reported(right, 0.1)
    broken = mutant(right, tmp_path, ("constraints.c", "set[0] = p->set_bob_x_;", "set[1] = p->set_bob_x_;"))
    assert "check start" in reported(broken, 0.1)


def test_positions_that_are_not_projected(tmp_path: Path) -> None:
    edit = ("engine/scalar_simd/project.h", "pass < 3 && N_LOOPS > 0", "pass < 3 && N_LOOPS < 0")
    broken = mutant(gudgeon.load("slider_crank_spring"), tmp_path, edit)
    assert "check rows" in reported(broken, 1.0)


@pytest.mark.parametrize("part", ["reactions", "a", "clearance", "series", "torques", "friction"])
def test_equations_of_single_bodies(part: str) -> None:
    """Newton's and Euler's equations hold to rounding with what a run reports, and with nothing else."""
    shown = 0.0
    scenes = [("nine_bar_press", "dry"), ("nine_bar_press", "ideal"), ("andrews_squeezer", "ideal")]
    for name, scene in [*scenes, ("slider_crank_spring", "ideal"), ("belt_block", "ideal")]:
        run = gudgeon.load(name, scene).simulate(0.02, output=20)
        values = run.evaluation
        assert run.compiled is not None
        assert compute_newton_euler_residuals(run.compiled, run.p, run.q, values).max() < 1e-12
        changed = np.array(getattr(values, part))
        if changed.size == 0 or not changed.any():
            continue
        changed *= 1.01
        other = compute_newton_euler_residuals(run.compiled, run.p, run.q, replace(values, **{part: changed}))
        shown = max(shown, other.max())
    assert shown > 1e-6


def test_moments_of_forces_without_an_arm(tmp_path: Path) -> None:
    """All forces on the slider act at its centre of mass: the rounding of its moments does not fail the audit."""
    file = tmp_path / "slider_first.yaml"
    text = find_shipped_file("slider_crank").read_text(encoding="utf-8")
    other_order = ("[rod.head, slider.origin]", "[slider.origin, rod.head]")
    file.write_text(patched(text, other_order, ("play: {wristpin:", "play: {crankpin:")), encoding="utf-8")
    scene = gudgeon.load(file, "dry")
    for speed in (500.0, 600.0, 1500.0, 3000.0):
        for samples in (1001, 1501):
            run = scene.simulate(0.1, parameters={"omega": f"{speed} rpm"}, output=samples)
            assert max(one.worst for one in run.diagnostics.audit if one.check == "body") < 1e-3


@pytest.mark.parametrize("body", ["crank", "rod", "slider"])
def test_the_check_of_bodies_names_the_body(body: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The acceleration of one body is changed, in a run and in a batch."""
    scene = gudgeon.load("slider_crank", "ideal")
    k = [one.name for one in scene.source.bodies].index(body)

    def shifted(compiled: CompiledModel, p: Array, q: Array, evaluation: Evaluation) -> Array:
        a = evaluation.a + 10.0 * (np.arange(q.shape[1]) == 3 * k)
        return compute_newton_euler_residuals(compiled, p, q, replace(evaluation, a=a))

    monkeypatch.setattr("gudgeon.simulation.audit.compute_newton_euler_residuals", shifted)
    with pytest.raises(gudgeon.AuditError, match=f"check body of .* at body {body}"):
        scene.simulate(0.1, audit="full")
    with pytest.raises(gudgeon.AuditError, match=f"check body of .* at body {body}"):
        scene.simulate_many([{}, {}], 0.1, audit="full")[1]
