"""A further run knows whose state it starts from, a simulation whether its file is still the one it was made from."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import AssemblyError, BadValueError, InputError, SolverError
from gudgeon.results.results import State
from tests.programs import needs_compiler

pytestmark = needs_compiler
METHODS: list[dict[str, Any]] = [
    {},
    {"method": "rk4", "step": 1e-3},
    {"method": "dop853"},
    {"method": "rodas5p"},
    {"method": "scipy:DOP853"},
]
FILE = """\
format: gudgeon/1
name: swing
gravity: [0, -g]
parameters: {g: 9.81 m/s^2, l: 1 m}
bodies: {bob: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {rod: {distance: [ground.O, bob.origin], length: l}}
start: {set: {bob.x: l, bob.theta: 0}, rates: {bob.omega: 0}}
scenes: {other: {}}
"""


@pytest.fixture
def swing(tmp_path: Path) -> Path:
    file = tmp_path / "swing.yaml"
    file.write_text(FILE)
    return file


@pytest.mark.parametrize("options", METHODS)
def test_a_state_keeps_the_numbers_of_its_run(options: dict[str, Any], tmp_path: Path) -> None:
    """g was the file's again from the second run on: −2.874 for −1.908."""
    pendulum = gudgeon.load("pendulum")
    whole = pendulum.simulate(output=np.linspace(0.0, 1.0, 11), parameters={"g": 1.62}, **options)
    first = pendulum.simulate(output=np.linspace(0.0, 0.5, 6), parameters={"g": 1.62}, **options)
    first.save(tmp_path / "first.nc")
    for state in (first.final, gudgeon.Result.load(tmp_path / "first.nc").final):
        rest = pendulum.simulate(output=np.linspace(0.5, 1.0, 6), start=state, **options)
        assert rest.parameters["g"] == 1.62 and rest.final.parameters == {"parameters.g": 1.62}
        np.testing.assert_allclose(rest.q, whole.q[5:], rtol=0, atol=2e-7)
        assert not [note for note in rest.diagnostics.notes if "resumed at" in note]


@pytest.mark.parametrize("options", METHODS)
def test_other_numbers_are_taken_and_told(options: dict[str, Any]) -> None:
    pendulum = gudgeon.load("pendulum")
    state = pendulum.simulate(0.5, output=1, parameters={"g": 1.62}).final
    run = pendulum.simulate(1.0, output=1, start=state, parameters={"parameters.g": "9.81 m/s^2"}, **options)
    assert run.parameters["g"] == 9.81
    message = "resumed at t = 0.5 s with other parameter values: parameters.g 9.81 m/s^2 (before 1.62 m/s^2)"
    assert message in run.diagnostics.notes
    same = pendulum.simulate(1.0, output=1, start=state, parameters={"g": 1.62}, **options)
    assert not same.diagnostics.notes and same.parameters["g"] == 1.62


@pytest.mark.parametrize("part", ["q", "v"])
def test_a_state_off_its_constraints_is_told(part: str) -> None:
    """One run alone and one of a batch; what a run leaves is on them, whatever its rounding."""
    pendulum = gudgeon.load("pendulum")
    final = pendulum.simulate(0.5, output=1).final
    off = replace(final, **{part: getattr(final, part) + 0.01})
    for simulation, used in ((pendulum, "for the others"), (pendulum.full, "begins with this state unchanged")):
        run = simulation.simulate(0.51, output=1, start=off)
        batch = simulation.simulate_many([{}], 0.51, output=1, start=[off])
        for notes in (run.diagnostics.notes, batch[0].diagnostics.notes):
            start = "the state at t = 0.5 s violates constraint equations "
            assert notes[0].startswith(start) and used in notes[0]
        assert not simulation.simulate(0.51, output=1, start=final).diagnostics.notes


def test_a_state_far_beyond_all_numbers_fails_without_a_warning(recwarn: pytest.WarningsRecorder) -> None:
    crank = gudgeon.load("slider_crank", "dry")
    final = crank.simulate(1e-3, output=1).final
    with pytest.raises(SolverError, match="no longer finite"):
        crank.simulate(2e-3, output=1, start=replace(final, q=1e300 * final.q))
    assert not list(recwarn)


@pytest.mark.parametrize("scene", ["ideal", "dry"])
def test_numbers_that_the_state_does_not_fit_are_refused(scene: str) -> None:
    """A crank driven by phi + omega t stands elsewhere at the same time with another omega."""
    press = gudgeon.load("nine_bar_press", scene=scene)
    state = press.simulate(0.01, output=1).final
    with pytest.raises(AssemblyError, match=r"constraint equations with these parameter values: \S+ \(.*rad\)"):
        press.simulate(0.02, output=1, start=state, parameters={"omega": "3*pi rad/s"})
    with pytest.raises(AssemblyError, match="violates constraint equations with these parameter values"):
        press.simulate(0.02, output=1, start=state, parameters={"l5": 0.31})
    press.simulate(0.011, output=1, start=state, parameters={"gravity.y": -1.62})


def test_an_event_on_the_seam_of_two_runs_without_freedom(tmp_path: Path) -> None:
    """It belongs to the first of them, and only to it."""
    text = (Path(gudgeon.__file__).resolve().parents[1] / "mechanisms" / "four_bar.yaml").read_text(encoding="utf-8")
    text = text.replace("90 deg + omega * t", "omega * t").replace("omega: 60 rpm", "omega: 120 rpm")
    file = tmp_path / "bar.yaml"
    file.write_text(f"{text}\nevents: {{turn: {{zero: sin(crank.theta), direction: both}}}}\n", encoding="utf-8")
    bar = gudgeon.load(file)
    whole = bar.simulate(2.0, output=20).events_of("turn")
    assert len(whole) >= 3
    for seam in np.round(whole[:-1], 6):
        first = bar.simulate(float(seam), output=10)
        rest = bar.simulate(2.0, output=10, start=first.final)
        times = [*first.events_of("turn"), *rest.events_of("turn")]
        np.testing.assert_allclose(times, whole, rtol=0.0, atol=1e-12)


SWING = """format: gudgeon/1
name: swing
gravity: [0, -9.81 m/s^2]
bodies:
  a: {length: 0.1 m, mass: 0.3 kg, inertia: 1e-3 kg*m^2}
  b: {length: 0.2 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}, A: {revolute: [a.head, b.tail]}}
drives: {d: {angle: a, value: 120 rpm * t}}
events: {turn: {zero: sin(a.theta), direction: both}}
"""


@pytest.mark.parametrize("formulation", ["reduced", "full"])
@pytest.mark.parametrize("options", METHODS[:4])  # the cross-checks know no events
def test_an_event_on_the_seam_of_two_runs(options: dict[str, Any], formulation: str, tmp_path: Path) -> None:
    """It is rounded to either side of the end; a batch finds what a run alone does."""
    file = tmp_path / "swing.yaml"
    file.write_text(SWING, encoding="utf-8")
    swing = gudgeon.load(file, formulation=formulation)
    for seam in (0.25, 0.5, 1.0):
        first = swing.simulate(seam, output=4, **options)
        rest = swing.simulate(1.3, output=4, start=first.final, **options)
        times = [*first.events_of("turn"), *rest.events_of("turn")]
        np.testing.assert_allclose(times, [0.25, 0.5, 0.75, 1.0, 1.25], rtol=0.0, atol=1e-10)
        assert len(first.events_of("turn")) == round(seam / 0.25)
        batch = swing.simulate_many({"gravity.y": np.array([-9.81] * 5)}, seam, output=4, **options)
        assert all(run.events.tobytes() == first.events.tobytes() for run in (batch[i] for i in range(5)))


def test_a_state_of_another_mechanism_of_the_same_size(swing: Path) -> None:
    state = gudgeon.load("pendulum").simulate(0.1, output=1).final
    simulation = gudgeon.load(swing)
    with pytest.raises(BadValueError, match="another mechanism or scene, pendulum / ideal; this is swing / ideal"):
        simulation.simulate(1.0, start=state)
    other = gudgeon.load(swing, scene="other").simulate(0.1, output=1).final
    with pytest.raises(BadValueError, match="swing / other; this is swing / ideal"):
        simulation.simulate(1.0, start=other)
    with pytest.raises(BadValueError, match="start is a Result.*\n.*its `final`"):
        simulation.simulate(1.0, start=simulation.simulate(0.1, output=1))  # type: ignore[arg-type]


@pytest.mark.parametrize("options", METHODS[:1])
def test_a_state_of_another_version_of_the_file(swing: Path, options: dict[str, Any]) -> None:
    state = gudgeon.load(swing).simulate(0.1, output=1).final
    swing.write_text(FILE.replace("mass: 1 kg", "mass: 2 kg"))
    with pytest.raises(BadValueError, match="another mechanism: the file of swing has changed"):
        gudgeon.load(swing).simulate(0.2, output=1, start=state, **options)


def test_a_state_of_other_overrides(swing: Path) -> None:
    plain, heavy = gudgeon.load(swing), gudgeon.load(swing, overrides={"bodies.bob.mass": "3 kg"})
    state = heavy.simulate(0.1, output=1).final
    assert state.overrides == (("bodies.bob.mass", "3 kg"),)
    with pytest.raises(BadValueError, match=r"computed with overrides.*3 kg.*\n.*load the mechanism with"):
        plain.simulate(0.2, output=1, start=state)
    with pytest.raises(BadValueError, match="computed with overrides"):
        heavy.simulate(0.2, output=1, start=plain.simulate(0.1, output=1).final)
    again = gudgeon.load(swing, overrides={"bodies.bob.mass": "3 kg"}).simulate(0.2, output=1, start=state)
    assert again.t[0] == 0.1


def test_either_formulation_goes_on_from_the_other(swing: Path) -> None:
    reduced, full = gudgeon.load(swing), gudgeon.load(swing, formulation="full")
    ends = {}
    for first, second in ((reduced, full), (full, reduced)):
        state = first.simulate(0.1, output=1, rtol=1e-11).final
        assert state.formulation == first.source.formulation
        ends[state.formulation] = second.simulate(0.2, output=1, rtol=1e-11, start=state).q[-1]
    np.testing.assert_allclose(ends["full"], ends["reduced"], rtol=0, atol=1e-8)


def test_a_state_made_by_hand_says_no_more_than_it_knows(swing: Path) -> None:
    simulation = gudgeon.load(swing)
    q, v = np.array([0.6, -0.8, 0.0]), np.zeros(3)
    made = State("", "", 0.0, q, v, np.zeros(0), np.zeros(0), {"g": 5.0})
    assert simulation.simulate(0.1, output=1, start=made).parameters["g"] == 5.0
    with pytest.raises(gudgeon.InputError, match="no run-time number has the address 'h'"):
        simulation.simulate(0.1, output=1, start=replace(made, parameters={"h": 1.0}))


ASKS: dict[str, Any] = {
    "model": lambda s: s.model,
    "full": lambda s: s.full,
    "jacobian": lambda s: s.jacobian(0.0, np.ones(6)),
    "scipy": lambda s: s.simulate(0.01, output=1, method="scipy:DOP853"),
}


@pytest.mark.parametrize("ask", ASKS)
def test_equations_of_an_edited_file_are_refused(ask: str, swing: Path) -> None:
    simulation = gudgeon.load(swing)
    swing.write_text(FILE.replace("mass: 1 kg", "mass: 2 kg"))
    with pytest.raises(InputError, match=r"swing\.yaml was edited after it was loaded(?s:.*)load it again"):
        ASKS[ask](simulation)
    simulation.simulate(0.01, output=1)  # the kernels are there
    swing.write_text("no mechanism any more")
    with pytest.raises(InputError, match="was edited"):
        ASKS[ask](simulation)
    swing.unlink()
    with pytest.raises(InputError, match="cannot read"):
        ASKS[ask](simulation)
    swing.write_text(FILE)
    assert ASKS[ask](simulation) is not None


def test_what_was_derived_before_an_edit_stays(swing: Path) -> None:
    simulation = gudgeon.load(swing)
    full = simulation.full
    before = simulation.jacobian(0.0, np.ones(6))
    swing.write_text(FILE.replace("mass: 1 kg", "mass: 2 kg"))
    assert simulation.full is full and (simulation.jacobian(0.0, np.ones(6)) == before).all()


@pytest.mark.parametrize(("name", "scene"), [("pendulum", "ideal"), ("slider_crank", "dry")])
def test_many_states_give_the_runs_of_each(name: str, scene: str) -> None:
    """States that are copied together equal states that are copied one by one, bit for bit; none is shared."""
    simulation = gudgeon.load(name, scene)
    final = simulation.simulate(2e-3, output=1).final
    states = [replace(final, v=(1.0 + 0.01 * k) * final.v) for k in range(4)]
    batch = simulation.simulate_many({}, 4e-3, output=3, start=states)
    mixed = simulation.simulate_many(
        {}, 4e-3, output=3, start=[replace(states[0], v=states[0].v.tolist()), *states[1:]]
    )
    for k, state in enumerate(states):
        run = simulation.simulate(4e-3, output=3, start=state)
        np.testing.assert_array_equal(batch.q[k], run.q)
        np.testing.assert_array_equal(mixed.v[k], run.v)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"q": np.full(9, np.nan)}, r"start\.q\[0\] is nan"),
        ({"v": np.zeros(3)}, r"start\.v has shape \(3,\)"),
        ({"state": np.array([3], np.int8)}, r"start\.state: expected 0"),
        ({"memory": np.array([0.5])}, r"start\.memory\[0\] of joint .* is 0\.5 m/s"),
        ({"mechanism": "pendulum"}, "another mechanism or scene"),
        ({"t": 0.001}, "the runs of a batch start at one time"),
    ],
)
def test_one_wrong_state_of_many_is_an_error(change: dict[str, Any], message: str) -> None:
    crank = gudgeon.load("slider_crank", "dry")
    final = crank.simulate(2e-3, output=1).final
    free = replace(final, state=np.zeros_like(final.state), memory=np.full_like(final.memory, np.nan))
    with pytest.raises(BadValueError, match=message):
        crank.simulate_many({}, 4e-3, output=1, start=[free, free, replace(free, **change)])
