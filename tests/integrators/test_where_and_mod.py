"""where and mod: forces that jump against closed forms, motion laws in pieces against what they are made of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputError, SolverError
from gudgeon.simulation.hidden_jumps import find_hidden_jumps
from tests.scenes import loader
from tests.slow import slow_but

SLUG = """
parameters: {k: 300 N/m, soft: 100 N/m, T: 0.15 s, F: 20 N, m: 0.5 kg}
bodies: {slug: {mass: m, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, slug.origin], axis: [1, 0]}}
forces: {push: {force: slug.com, value: ["%s", 0]}}
start: {rates: {slug.vx: 1 m/s}}
"""
LINKAGE = """
gravity: [0, -9.81 m/s^2]
bodies:
  crank: {length: 0.1 m, mass: 1 kg, inertia: auto}
  rod: {length: 0.3 m, mass: 1 kg, inertia: auto}
  slider: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  bob: {length: 0.2 m, mass: 0.4 kg, inertia: auto}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  pin: {revolute: [crank.head, rod.tail]}
  wrist: {revolute: [rod.head, slider.com]}
  guide: {translational: [ground.O, slider.com], axis: [1, 0]}
  hook: {revolute: [slider.com, bob.tail]}
drives: {motor: {angle: crank, value: "%s"}}
start: {guess: {bob.theta: -90 deg}}
"""
# what is asked of the drive alone needs no loop
ARM = """
gravity: [0, -9.81 m/s^2]
bodies:
  crank: {length: 0.1 m, mass: 1 kg, inertia: auto}
  bob: {length: 0.2 m, mass: 0.4 kg, inertia: auto}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  hook: {revolute: [crank.head, bob.tail]}
drives: {motor: {angle: crank, value: "%s"}}
start: {guess: {bob.theta: -90 deg}}
"""


def test_a_push_that_ends(tmp_path: Path) -> None:
    """A force in pieces of time: the momentum is theirs, to rounding, by every method that chooses its step."""
    slug = loader(tmp_path)(SLUG % "where(t < 0.3 s, F, where(t >= 0.7 s, -F / 2, 0 N))")
    t = np.linspace(0.0, 1.0, 41)
    v = 1.0 + 40.0 * np.minimum(t, 0.3) - 20.0 * np.maximum(t - 0.7, 0.0)
    for method in ("dop853", "rodas5p"):
        run = slug.simulate(1.0, output=40, method=method, rtol=1e-9)
        np.testing.assert_allclose(run["slug.vx"], v, rtol=1e-11)


@pytest.mark.parametrize("method", ["auto", "rodas5p"])
def test_rest_where_branches_meet_but_for_rounding(method: str, tmp_path: Path) -> None:
    """A spring that is three times as stiff on one side, by a curve whose value at its knot is 0 to the last digits."""
    spring = "curves: {f: {points: [[-1, 1], [-0.5, 0.7], [0, 0], [0.5, -2], [1, -3]]}}\n" + SLUG
    push = "soft * f(slug.x / (1 m^1)) * (1 + 0.5 * sign(slug.x)) * (1 m^1) - 20 N*s/m^1 * slug.vx"
    run = loader(tmp_path)(spring % push).simulate(30.0, output=30, method=method)
    assert np.abs(run["slug.x"][20:]).max() < 1e-12 and np.abs(run["slug.vx"][20:]).max() < 1e-12


@pytest.mark.parametrize(
    ("push", "order"), [("where(t < T, F, 0 N)", 1), ("F * max(t - T, 0 s) / (1 s)", 2), ("F * max(t - T, 0 s)**2", 3)]
)
def test_rk4_at_a_jump_and_at_a_corner_of_a_force(push: str, order: int, tmp_path: Path) -> None:
    """A step ends there. It did not: the order was 1 where the force jumps, one more for each rate that does not."""
    slug = loader(tmp_path)(SLUG % (push + " / (1 s)**2" * (order == 3)))
    T = np.linspace(0.3, 0.31, 33)[:-1] + 1e-5
    momentum = {1: 20.0 * T, 2: 10.0 * (1.0 - T) ** 2, 3: 20.0 / 3.0 * (1.0 - T) ** 3}[order]
    for step in (1e-2, 1.25e-3):  # the push is a polynomial of time on either side
        batch = slug.simulate_many({"T": T}, 1.0, output=1, method="rk4", step=step)
        assert np.abs(batch["slug.vx"][:, -1] - 1.0 - momentum / 0.5).max() < 1e-9


def test_a_sawtooth(tmp_path: Path) -> None:
    """F(t) = F mod(t, T)/T: each period adds F T/2."""
    slug = loader(tmp_path)(SLUG % "F * mod(t, T) / T")
    t = np.linspace(0.0, 2.0, 33)
    whole, rest = np.divmod(t, 0.15)
    v = 1.0 + 40.0 * (0.075 * whole + rest**2 / 0.3)
    for method in ("dop853", "rodas5p"):
        np.testing.assert_allclose(slug.simulate(2.0, output=32, method=method, rtol=1e-9)["slug.vx"], v, rtol=1e-11)
    batch = slug.simulate_many({"parameters.T": [0.15, 0.4]}, t_end=2.0, output=32, method="dop853", rtol=1e-9)
    np.testing.assert_allclose(batch["slug.vx"][0], v, rtol=1e-11)
    whole, rest = np.divmod(t, 0.4)
    np.testing.assert_allclose(batch["slug.vx"][1], 1.0 + 40.0 * (0.2 * whole + rest**2 / 0.8), rtol=1e-11)


def test_two_springs(tmp_path: Path) -> None:
    """One on each side of x = 0: half a period of each, π √(m/k), and the same speed at each passage."""
    slug = loader(tmp_path)(SLUG % "where(slug.x > 0 m, -k, -soft) * slug.x" + "events: {zero: {zero: slug.x}}\n")
    run = slug.simulate(3.0, rtol=1e-11)
    period = np.pi * (np.sqrt(0.5 / 300.0) + np.sqrt(0.5 / 100.0))
    found = np.array(run.events_of("zero"))
    expected = np.concatenate([np.arange(1, 20) * period, np.arange(20) * period + np.pi * np.sqrt(0.5 / 300.0)])
    expected = np.sort(expected[expected < 3.0])
    np.testing.assert_allclose(found[found > 0.0], expected, rtol=1e-9)
    assert run.diagnostics.energy_residual < 1e-9


def test_a_turning_angle_within_one_turn(tmp_path: Path) -> None:
    """A push over a part of each turn only, mod of an angle that grows without bound: steady torque, known work."""
    text = """
bodies: {wheel: {mass: 1 kg, inertia: 0.1 kg*m^2}}
ground: {O: [0, 0]}
joints: {axle: {revolute: [ground.O, wheel.com]}}
forces: {motor: {torque: wheel, value: "where(mod(wheel.theta, 2*pi) < 90 deg, 3 N*m, 0 N*m)"}}
start: {rates: {wheel.omega: 1 rad/s}}
outputs: {within: "mod(wheel.theta, 2*pi)"}
"""
    run = loader(tmp_path)(text).simulate(4.0, output=400, rtol=1e-10)
    theta = run["wheel.theta"]
    turns, rest = np.divmod(theta, 2 * np.pi)
    work = 3.0 * (turns * np.pi / 2 + np.minimum(rest, np.pi / 2))
    np.testing.assert_allclose(0.05 * run["wheel.omega"] ** 2, 0.05 + work, rtol=1e-8)
    assert theta[-1] > 20.0
    np.testing.assert_allclose(run["within"], rest, atol=1e-12)


@pytest.mark.parametrize("method", slow_but(["rk4", "dop853"], ["rk4", "dop853", "rodas5p"]))
def test_a_motion_law_in_pieces(method: str, tmp_path: Path) -> None:
    """min and max say the same as where: the same impulses at the same corners, and the energy balance holds."""
    load = loader(tmp_path)
    pieces = "where(t < 0.2 s, 2 rad/s * t, where(t <= 0.5 s, 0.4 - 3 rad/s * (t - 0.2 s), -0.5))"
    plain = "2 rad/s * min(t, 0.2 s) - 3 rad/s * (max(0.2 s, min(t, 0.5 s)) - 0.2 s)"
    step, rtol = (1e-3, None) if method == "rk4" else (None, 1e-10)
    linkages = (load(LINKAGE % value) for value in (pieces, plain))
    runs = [linkage.simulate(0.8, output=64, method=method, step=step, rtol=rtol) for linkage in linkages]
    np.testing.assert_allclose(runs[0]["bob.theta"], runs[1]["bob.theta"], atol=1e-9)
    assert runs[0].diagnostics.energy_residual < 1e-8
    assert np.ptp(runs[0]["bob.theta"]) > 0.1


def test_a_motion_law_that_repeats(tmp_path: Path) -> None:
    """A rise and a return in each period, by mod: what the same law says in a later period, to rounding."""
    text = ARM.replace("start:", "parameters: {T: 0.25 s}\nstart:")
    law = "where(mod(t, T) < T/2, smooth_step(mod(t, T), 0 s, T/2), 1 - smooth_step(mod(t, T), T/2, T/2)) * 60 deg"
    run = loader(tmp_path)(text % law).simulate(1.0, output=400, rtol=1e-9)
    crank = run["crank.theta"].copy()
    np.testing.assert_allclose(crank[:101], crank[300:], atol=1e-12)
    assert abs(crank.max() - np.pi / 3) < 1e-12 and abs(crank[100]) < 1e-12
    assert run.diagnostics.energy_residual < 1e-7


def test_a_drive_must_not_jump(tmp_path: Path) -> None:
    """Branches that do not meet: the run ends there and says so, also without freedom, in batches, at small jumps."""
    load = loader(tmp_path)
    cases = (
        ("where(t < 0.3 s, t * 1 rad/s, 0.5)", "0.2", 0.3),
        ("mod(t * 1 rad/s, 0.25)", "0.25", 0.25),
        ("where(t < 0.3 s, t * 1 rad/s, t * 1 rad/s + 1e-7)", "1e-07", 0.3),
    )
    for value, size, at in cases:
        linkage = load(ARM % value)
        with pytest.raises(SolverError, match=f"motor: it jumps by {size}.* at t = {at}") as caught:
            linkage.simulate(1.0)
        assert caught.value.partial.t[-1] <= at
        batch = linkage.simulate_many([{"gravity.y": -9.0}, {}], t_end=1.0)
        assert len(batch.failures) == 2
        assert len(linkage.simulate(0.24).t)
    bare = ARM.replace("  bob: {length: 0.2 m, mass: 0.4 kg, inertia: auto}\n", "")
    bare = bare.replace("  hook: {revolute: [crank.head, bob.tail]}\n", "").replace("start:", "x:").partition("x:")[0]
    with pytest.raises(SolverError, match=r"it jumps by 0.2 at t = 0.3"):
        load(bare % "where(t < 0.3 s, t * 1 rad/s, 0.5)").simulate(1.0)


@pytest.mark.parametrize(
    ("value", "message", "hint"),
    [
        ("where(t, F, 0 N)", "expected a comparison, got ','", "where(t < 1 s, then, otherwise)"),
        ("where(t < 1 s, F)", "where takes 3 arguments, got 2", "then, otherwise"),
        ("where(t < 1 m, F, 0 N)", "cannot compare", "expected a time"),
        ("where(t < 1 s, F, 1 m)", "where of unlike quantities", "expected a force"),
        ("F * (t < 1 s)", "expected ')', got '<'", "only in where(a < b, then, otherwise)"),
        ("where(t < 1 s and t > 0 s, F, 0 N)", "'and' is not a number", "where(a < b, where(c < d, x, y), y)"),
        ("where(t < 1 s or t > 2 s, F, 0 N)", "'or' is not a number", "where(a < b, x, where(c < d, x, y))"),
        ("where(0 s < t < 1 s, F, 0 N)", "expected ',', got '<'", "where(a < b, where(c < d, x, y), y)"),
        ("where(t < 1 s && t > 0 s, F, 0 N)", "unexpected character '&'", "where(a < b, where(c < d, x, y), y)"),
        ("F if t < 1 s else 0 N", "'if' is not a number", "where(a < b, then, otherwise)"),
        ("mod(t, 1 m) * 1 N/s", "mod of unlike quantities", "expected a time"),
        ("mod(t) * 1 N/s", "mod takes 2 arguments, got 1", "each second"),
        ("F % 2", "unexpected character '%'", "mod(a, b)"),
        ("F * mod(t, 0 s) / 1 s", "has a part that is inf", "a division by zero"),
        ("F * smooth_step(t, 0, -1 s)", "has a smooth_step with the negative duration -1", "above zero"),
        (
            "F * (1 - 0.5 * ramp(t, 1 s, (1 - 3) * 1 s))",
            "has a ramp with the negative duration -2",
            "ramp(t, start, duration)",
        ),
        ("F * smooth_step(t, 0, 0 s)", "has a part that is inf", "a division by zero"),
    ],
)
def test_what_is_refused(value: str, message: str, hint: str, tmp_path: Path) -> None:
    path = tmp_path / "slug.yaml"
    path.write_text("format: gudgeon/1\nname: slug\n" + SLUG % value)
    with pytest.raises(InputError) as caught:
        gudgeon.load(path)
    assert message in str(caught.value) and hint in str(caught.value) and "slug.yaml:8:" in str(caught.value)


def test_how_long_a_step_lasts_is_a_number_of_the_run(tmp_path: Path) -> None:
    """Of one that is given later the condition holds too, alone and in batches; a scene's own is looked at as read."""
    text = SLUG % "F * smooth_step(t, 0, T)"
    simulation = loader(tmp_path)(text)
    with pytest.raises(
        BadValueError, match=r"parameters.T is -1 s: the duration of a ramp or smooth_step is positive; .* > 0"
    ):
        simulation.simulate(0.1, parameters={"T": -1.0})
    batch = simulation.simulate_many({"T": [1.0, -1.0]}, t_end=0.1, output=1)
    assert [failure.run for failure in batch.failures] == [1]
    with pytest.raises(
        InputError, match=r"forces.push.value.x has a smooth_step with the negative duration -2 in scene quick"
    ):
        loader(tmp_path)(text + "scenes: {quick: {parameters: {T: -2 s}}}\n", "quick")


@pytest.mark.parametrize(
    ("value", "jumps"),
    [
        ("where(mod(t, T) < 0.3*T, A*mod(t, T)/(0.3*T), A*(1 - mod(t, T)/T)/0.7)", False),
        ("A*min(mod(t, T)/T, 3*(1 - mod(t, T)/T))", False),
        ("where(t < 3.3*T, A*t/T, 1.0003*A*t/T)", True),
    ],
)
@pytest.mark.parametrize("drawn", [2, pytest.param(60, marks=pytest.mark.slow)])
def test_corners_anywhere_on_the_grid_are_no_jumps(value: str, jumps: bool, drawn: int, tmp_path: Path) -> None:
    """Of periods at random 1 % had a corner just beside a place of the grid, which was taken for a jump by 1e-11."""
    cart = """
parameters: {T: 0.1 s, A: 50 mm}
bodies: {cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}, bob: {length: 0.3 m, mass: 0.5 kg, inertia: auto}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, cart.com], axis: [1, 0]}, pin: {revolute: [cart.com, bob.tail]}}
drives: {push: {coordinate: cart.x, value: "%s"}}
"""
    scene, rng = loader(tmp_path)(cart % value), np.random.default_rng(1)
    period = [slot.address for slot in scene.source.parameters].index("parameters.T")
    known = [(0.12213540426256936, t_end) for t_end in (1.0, 2.0, 5.0, 10.0)] if "min" in value else []  # all, once
    for T, t_end in (*known, *rng.uniform((0.05, 2.0), (0.5, 5.0), (drawn, 2)).tolist()):
        p = scene.p.copy()
        p[period] = T
        assert bool(find_hidden_jumps(scene.source, p, 0.0, t_end)) == jumps


def test_a_jump_at_the_very_end_and_the_first_of_many(tmp_path: Path) -> None:
    """One turn by mod ends where it jumps; of 300 jumps the first one is told; a rate's corner there is none."""
    load = loader(tmp_path)
    for value, t_end, at in (
        ("mod(20*pi * t / (1 s), 2*pi)", 0.1, 0.1),
        ("where(t < 0.1 s, t * 1 rad/s, 0)", 0.1, 0.1),
        ("mod(t * 1 rad/s, 0.003)", 0.9, 0.003),
    ):
        with pytest.raises(SolverError, match=f"it jumps by .* at t = {at} s"):
            load(ARM % value).simulate(t_end)
    corner = "where(mod(t, 0.2 s) < 0.1 s, mod(t, 0.2 s), 0.2 s - mod(t, 0.2 s)) * 1 rad/s"
    for t_end in (0.1, 0.2, 0.4):
        assert load(ARM % corner).simulate(t_end).t[-1] == t_end


@pytest.mark.parametrize("sign", ["", "-"])
def test_samples_at_corners_of_periods(sign: str, tmp_path: Path) -> None:
    """A zigzag has no acceleration on either side, at its corners too, whichever side rounding puts them on."""
    cart = """
parameters: {T: 0.3 s}
bodies: {cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, cart.com], axis: [1, 0]}}
drives: {motor: {coordinate: cart.x, value: "0.05 m * where(PHASE < T/2, PHASE/T, 1 - PHASE/T)"}}
""".replace("PHASE", f"mod({sign}t, T)")
    run = loader(tmp_path)(cart).simulate(0.6, output=8, peaks=["cart.ax"])
    assert np.abs(run["cart.ax"]).max() < 1e-11 and run.peak("cart.ax").abs < 1e-11
    np.testing.assert_allclose(np.abs(run["cart.vx"]), 0.05 / 0.3, rtol=1e-12)


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_steps_longer_than_periods_hold_none_of_them(formulation: str, tmp_path: Path) -> None:
    """A bob on a zigzagging cart: what drives it jumps in rate alone, so nothing bounds a step. It lost joules."""
    cart = """
gravity: [0, -9.81]
parameters: {T: 0.011 s}
bodies:
  cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  bob: {length: 0.4, com: [0.4, 0], mass: 0.5 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.com], axis: [1, 0]}
  pin: {revolute: [cart.com, bob.tail]}
start: {set: {bob.theta: -1.2}}
drives: {motor: {coordinate: cart.x, value: "0.05 m * where(PHASE < T/2, PHASE/T, 1 - PHASE/T)"}}
""".replace("PHASE", "mod(t, T)")
    linkage = loader(tmp_path, formulation=formulation)(cart)
    exact = linkage.simulate(0.6, output=2, method="rk4", step=1e-4)["bob.theta"][-1]  # each corner ends a part
    for method, rtol in (("dop853", 1e-8), ("dop853", 1e-10), ("rodas5p", 1e-8)):
        run = linkage.simulate(0.6, output=2, method=method, rtol=rtol)
        assert run.diagnostics.energy_residual < 1e-6
        assert run["bob.theta"][-1] == pytest.approx(exact, abs=1e-7)
    for step in (1e-3, 1e-4):  # a rate jumps, no acceleration is there on either side
        run = linkage.simulate(0.2, output=2, method="rk4", step=step, peaks=["cart.ax"], parameters={"T": 0.05})
        assert run.peak("cart.ax").abs < 1e-8


@pytest.mark.parametrize(
    ("law", "method"),
    [
        ("where(t < 0.3 s, 1, sin(U)/U)", "rk4"),
        pytest.param("where(t < 0.3 s, sin(U)/U, 1)", "dop853", marks=pytest.mark.slow),
    ],
)
def test_a_branch_that_is_no_number_at_its_own_corner_is_named(law: str, method: str, tmp_path: Path) -> None:
    """It was a second rate that grows beyond all bounds, or no step was small enough: rates are 0/0 in binary64."""
    linkage = loader(tmp_path)(ARM % law.replace("U", "(t/(1 s) - 0.3)"))
    step = 1e-2 if method == "rk4" else None
    with pytest.raises(
        SolverError, match=r"drives\.motor\.value \(line .* at t = 0\.3 s.*nan: 0 divided by 0"
    ) as message:
        linkage.simulate(0.6, method=method, step=step)
    assert 0.29 < message.value.partial.t[-1] < 0.3
    assert linkage.simulate(0.29, method=method, step=step).t[-1] == 0.29


def test_a_corner_that_is_not_reached_is_no_matter(tmp_path: Path) -> None:
    """The inner where changes over at 0.3 s, where the outer one does not ask it."""
    law = "where(t < 0.5 s, 1, where(t < 0.3 s, sin(U)/U, 1))".replace("U", "(t/(1 s) - 0.3)")
    plain, requested = (loader(tmp_path)(ARM % value).simulate(0.6, output=2) for value in ("1", law))
    np.testing.assert_allclose(requested.q, plain.q, rtol=0, atol=1e-9)


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
def test_an_event_where_a_step_begins(method: str, tmp_path: Path) -> None:
    """A jump of the force and an event of the file at one place, beside mod: v² is 2 W/m more, whatever the speed."""
    push = "where(slug.x > 0.3 m, 5 N, 1 N * mod(slug.x, 0.07 m) / (0.07 m))"
    slug = loader(tmp_path)(SLUG % push + "events: {edge: {zero: slug.x - 0.3 m}}\n")
    first = np.linspace(1.0, 1.5, 41)
    batch = slug.simulate_many({"start.rates.slug.vx": first}, 0.5, output=20, method=method, rtol=1e-9)
    x, v = batch["slug.x"], batch["slug.vx"]
    whole, rest = np.divmod(np.minimum(x, 0.3), 0.07)
    work = whole * 0.035 + rest**2 / 0.14 + 5.0 * np.maximum(x - 0.3, 0.0)
    assert not batch.failures
    np.testing.assert_allclose(v**2, first[:, None] ** 2 + 4.0 * work, rtol=1e-9)
    assert x.min() < 0.01 and x[:, -1].min() > 0.4


def test_a_comparison_with_what_is_no_number_is_told(tmp_path: Path) -> None:
    """The force had one of its branches, without a word; a branch that is not picked may be no number."""
    message = loader(tmp_path)(SLUG % "where(sqrt(slug.x/(1 m) - 1) < 1, 2 N, 3 N)").simulate(1.5, output=100)
    assert [note.split(":")[0] for note in message.diagnostics.notes] == [
        "forces.push.value.x is not finite (nan) at t = 0 s"
    ]
    law = "where(slug.x < 1 m, 2 N, where(sqrt(slug.x/(1 m) - 1) < 0.1, 2 N, 3 N))"
    assert not loader(tmp_path)(SLUG % law).simulate(1.5, output=100).diagnostics.notes
