"""Exercise sheets: what they ask has these answers, by SymPy, by differences, by a solution of the whole system."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import gudgeon
from gudgeon.commands.exercise import make_exercise
from gudgeon.errors import BadValueError, Location, OutputError
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text
from gudgeon.generator.targets.latex.document import Document
from gudgeon.generator.targets.latex.printers import format_number
from gudgeon.generator.targets.latex.render import render_document
from gudgeon.language.output_units import find_angle_power
from gudgeon.language.parser import parse
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.simulation.simulation import Simulation
from gudgeon.teaching.draw_parameters import ExerciseData, draw_parameters
from gudgeon.teaching.notebook import format_document
from gudgeon.teaching.questions import make_questions
from gudgeon.teaching.sheet import Question, Subject, make_subject
from gudgeon.web.parameter_panel import build_parameter_sections
from tests.programs import needs_compiler
from tests.pump import Gudgeon, written
from tests.targets_latex.equations_reader import value

pytestmark = needs_compiler
SCENES = [("four_bar", "ideal"), ("slider_crank", "dry"), ("scotch_yoke", "ideal"), ("n_four_bar", "ideal")]


@cache
def subject(name: str, scene: str, seed: int = 3) -> Subject:
    simulation = gudgeon.load(name, scene)
    drawn = draw_parameters(simulation, seed, None)
    return make_subject(derive_scene(find_shipped_file(name).read_bytes(), name, scene), simulation, drawn, seed)


@cache
def questions(name: str, scene: str, seed: int = 3) -> Mapping[str, Question]:
    return {question.title: question for question in make_questions(subject(name, scene, seed))}


def at(of: Subject, matrix: sp.Matrix) -> np.ndarray:
    """A matrix of q, q̇ and t as the sheet has them, by SymPy, with the numbers of the run."""
    slots = {entry.symbol: of.exercise.p[k] for k, entry in enumerate(of.model.parameter_table.entries.values())}
    values = dict(zip((*of.model.q, *of.model.v), (*of.exercise.q, *of.exercise.v), strict=True)) | {
        of.model.t: of.exercise.t
    }
    return np.array(matrix.subs(slots | values).evalf(20), float)


def test_the_position_meets_the_rows_that_are_asked_for() -> None:
    """Whole turns too, which rows of drives and gears count: after 0.95 s the crank has begun another one."""
    simulation = gudgeon.load("four_bar", "ideal")
    drawn = draw_parameters(simulation, 3, "0.95 s")
    crank = drawn.q[list(simulation.source.coordinates).index("crank.theta")]
    assert crank > np.pi
    size = np.ptp(drawn.q.reshape(-1, 3)[:, :2])
    assert np.abs(simulation.compiled.phi(drawn.t, drawn.q, drawn.p)).max() < 2e-4 * max(size, 1.0)


def test_a_sheet_and_its_solutions_are_written_together(
    tmp_path: Path, call: Gudgeon, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that takes the one and not the other leaves the older pair."""
    from gudgeon.files.writing import AtomicFiles

    monkeypatch.chdir(tmp_path)
    assert call("exercise", "pendulum", "-o", "s.txt", "--seed", "1").exit_code == 0
    before = {name: (tmp_path / name).read_bytes() for name in ("s.txt", "s-solutions.txt")}
    whole = AtomicFiles.write

    def write(self: AtomicFiles, name: str, data: bytes) -> None:
        if "solutions" in name:
            raise OutputError(self.folder / name, "no space left")
        whole(self, name, data)

    monkeypatch.setattr(AtomicFiles, "write", write)
    assert call("exercise", "pendulum", "-o", "s.txt", "--seed", "2").exit_code != 0
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_jacobian_and_gamma_by_sympy_from_phi_alone(name: str, scene: str) -> None:
    of, found = subject(name, scene), questions(name, scene)
    model, names = of.model, [row.name for row in of.model.rows]
    q, v = sp.Matrix(model.q), sp.Matrix(model.v)
    phi_q = model.Phi.jacobian(q)
    gamma = -(phi_q * v).jacobian(q) * v - 2 * phi_q.diff(model.t) * v - model.Phi.diff(model.t, 2)
    entries, right = at(of, phi_q), at(of, gamma)
    coordinates = of.simulation.source.coordinates
    requested = {
        f"{names[r]} {coordinates[k]}": entries[r, k]
        for r, row in enumerate(model.rows)
        for k in range(len(coordinates))
        if row.owner in of.owners and model.q[k] in row.phi_q
    }
    assert found["The Jacobian at a position"].numbers == pytest.approx(requested, rel=1e-12, abs=1e-15)
    owned = {row.name: right[r, 0] for r, row in enumerate(model.rows) if row.owner in of.owners}
    assert found["γ"].numbers == pytest.approx(owned, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_forces_and_accelerations_by_the_whole_system(name: str, scene: str) -> None:
    """From positions and rates as they are printed, by SymPy's matrices: M q̈ + Φ_qᵀ λ = g, Φ_q q̈ = γ."""
    of, found = subject(name, scene), questions(name, scene)
    drawn, source = of.exercise, of.simulation.source
    phi_q, mass = at(of, of.model.Phi_q), np.diag(at(of, of.model.M))
    if source.degrees_of_freedom == 0:
        q_dd = np.linalg.lstsq(phi_q, at(of, of.model.gamma)[:, 0], rcond=None)[0]
        ((coordinate, a),) = found["Accelerations"].numbers.items()
        k = source.coordinates.index(coordinate)
        assert q_dd[k] == pytest.approx(a, rel=2e-3)
        assert not any(set(row.phi_q) == {of.model.q[k]} for row in of.model.rows)  # no drive says it
    force = found["The force in a joint"]
    shown = force.requested[-1].text[-1]  # type: ignore[union-attr]
    joint, second = re.search(r"what force does (\w+) exert on (\w+),", str(shown)).groups()  # type: ignore[union-attr]
    lambdas = np.array([drawn.run[f"lambda.{row.name}"][-1] for row in of.model.rows])
    own = np.array([row.owner == joint for row in of.model.rows])
    k = source.coordinates.index(f"{second}.x")
    # Q = -Φ_qᵀ λ of the joint's own rows, on the centre of mass of its second body
    F = -(phi_q[own][:, k : k + 2].T @ lambdas[own])
    assert (force.numbers["Fx"], force.numbers["Fy"]) == pytest.approx(tuple(F), rel=1e-3, abs=1e-3 * np.abs(F).max())
    rest = mass * drawn.run.a[-1] + phi_q.T @ lambdas  # = g, in which gravity alone has a closed form
    if not (source.clearances or of.model.elements):
        gx, gy = at(of, sp.Matrix(of.model.gravity))[:, 0]
        weights = mass.reshape(-1, 3) * [gx, gy, 0.0]
        assert rest == pytest.approx(weights.ravel(), abs=2e-3 * np.abs(lambdas).max())


def test_dots_stand_over_the_letter_alone() -> None:
    shown = repr(questions("four_bar", "ideal")["Accelerations"].solved).replace("\\\\", "\\")
    accents = re.findall(r"\\ddot\{([^}]*)\}(\S*)", shown)
    assert {letters for letters, _ in accents} <= {r"\theta", "x", "y", "q"}
    assert any(re.match(r"_\{\\text\{\w+\}\}", behind) for letters, behind in accents if letters == r"\theta")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.1 + 0.55, "1.65"),
        (0.1 + 0.2, "0.3"),
        (-0.3 - 0.6, "-0.9"),
        (1.0 / 3.0, "0.3333333333333333"),
        (1.65 + 1e-14, "1.65000000000001"),
        (7e10, "7e10"),
        (0.0, "0"),
    ],
)
def test_numbers_without_what_a_sum_rounded(value: float, text: str) -> None:
    """Two units of the last digit at most; what differs by more is read back as it was."""
    assert format_number(value) == text
    assert abs(float(text) - value) <= 2.0 * np.spacing(abs(value))


def test_freedoms_are_counted_and_ranked() -> None:
    assert questions("four_bar", "ideal")["Count the degrees of freedom"].numbers == {
        "coordinates": 9,
        "rows": 9,
        "freedoms": 0,
    }
    assert questions("slider_crank", "dry")["Count the degrees of freedom"].numbers == {
        "coordinates": 9,
        "rows": 7,
        "freedoms": 2,
    }


PARALLEL = """format: gudgeon/1
name: parallel
bodies:
  one: {length: 50 mm}
  two: {length: 50 mm}
  three: {length: 50 mm}
  coupler: {points: {A: [0, 0], B: [100 mm, 0], C: [200 mm, 0]}}
ground: {A: [0, 0], B: [100 mm, 0], C: [200 mm, 0]}
joints:
  A: {revolute: [ground.A, one.tail]}
  B: {revolute: [ground.B, two.tail]}
  C: {revolute: [ground.C, three.tail]}
  D: {revolute: [one.head, coupler.A]}
  E: {revolute: [two.head, coupler.B]}
  F: {revolute: [three.head, coupler.C]}
drives: {motor: {angle: one, value: 60 deg + t * 1 rad/s}}
start: {guess: {two.theta: 60 deg, three.theta: 60 deg, coupler.theta: 0}}
"""


def test_a_third_parallel_crank_is_one_too_many_for_gruebler(tmp_path: Path) -> None:
    (tmp_path / "parallel.yaml").write_text(PARALLEL, encoding="utf-8")
    _, solved, _ = make_exercise(str(tmp_path / "parallel.yaml"), "ideal", 1, None)
    shown = " ".join(render_document(solved, "txt").split())
    assert "f = 12 - 13 = -1." in shown and "the rank is 12, f = 0." in shown


def test_a_journal_is_where_the_run_has_it() -> None:
    of, found = subject("slider_crank", "dry"), questions("slider_crank", "dry")["A joint with play"].numbers
    run = of.exercise.run
    assert found["e"] == pytest.approx(run["wristpin.e"][-1], rel=1e-3)
    assert found["ratio"] == pytest.approx(run["wristpin.eps"][-1], rel=1e-3)


def documents(name: str, seed: int) -> tuple[Document, Document, ExerciseData]:
    return make_exercise(name, "ideal", seed, None)


def test_a_seed_is_a_sheet_and_another_is_another() -> None:
    first, again, other = (documents("four_bar", seed) for seed in (5, 5, 6))
    assert [render_document(d, "txt") for d in first[:2]] == [render_document(d, "txt") for d in again[:2]]
    assert render_document(first[0], "txt") != render_document(other[0], "txt")
    assert first[2].parameters and first[2].parameters != other[2].parameters
    assert not any("Solution" in section.title for section in first[0].sections)


def test_every_form_has_the_same_sections(call: Gudgeon, tmp_path: Path) -> None:
    """A file with no masses is asked for no force."""
    text = re.sub(r", mass: [^,]*, inertia: [^,}]*", "", find_shipped_file("four_bar").read_text(encoding="utf-8"))
    (tmp_path / "bare.yaml").write_text(text, encoding="utf-8")
    for suffix in ("txt", "tex", "html", "md"):
        done = call("exercise", "bare.yaml", "-o", f"sheet.{suffix}", "--seed", "2", "--at", "120ms")
        assert done.exit_code == 0, done.output
        sheet, solved = ((tmp_path / f"sheet{x}.{suffix}").read_text("utf-8") for x in ("", "-solutions"))
        assert "Accelerations" in sheet and "The force in a joint" not in sheet
        assert (
            "0.12" in sheet
            and "Solution" in solved
            and ("Grübler" in sheet or suffix == "tex" and r"Gr\"{u}bler" in sheet)
        )
    assert "<svg" in (tmp_path / "sheet.html").read_text("utf-8")
    assert written(tmp_path) >= {"sheet.md", "sheet-solutions.md"}
    for line in ("-o x.pdf", "-o x.txt --at -1s", "-o x.txt --scene worn", "-o x.txt --seed -1"):
        done = call("exercise", "bare.yaml", *line.split())
        assert done.exit_code == 2 and "error" in done.stderr.lower()
    assert not (tmp_path / "x.txt").exists()


TURNING = """format: gudgeon/1
name: turning
parameters: {speed: 120 rpm}
gravity: [0, -9.81 m/s^2]
bodies: {arm: {length: 50 mm, mass: 80 g, inertia: auto}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, arm.tail]}}
drives: {motor: {angle: arm, value: pi/2 + speed * t}}
"""


def test_numbers_stand_as_people_write_them(tmp_path: Path) -> None:
    """Units of the file, angles with their whole turns, drives and units typeset, the paper by its name."""
    (tmp_path / "turning.yaml").write_text(TURNING, encoding="utf-8")
    sheet, solved, drawn = make_exercise(str(tmp_path / "turning.yaml"), "ideal", 2, "4.1 s")
    assert np.abs(drawn.q[2]) > np.pi and drawn.q[2] == pytest.approx(drawn.run.q[-1, 2], abs=1e-5)
    speed = drawn.parameters["parameters.speed"]
    assert speed.endswith(" rpm") and drawn.run.v[-1, 2] == pytest.approx(float(speed[:-4]) * 2 * np.pi / 60)
    text, latex = render_document(sheet, "txt"), render_document(sheet, "tex")
    assert f"{speed} = " in text and f"parameters.speed = {speed}" in render_document(solved, "txt")
    assert "m/s²" in text and "kg·m²" in text and "Φ_q at" not in text and "textasciicircum" not in latex
    assert r"\text{speed} \, t + \tfrac{\pi}{2}" in latex and "pi / 2" not in text
    assert "the paper" not in text and re.search(r"l_arm = [\d.]+ mm", text)
    assert re.search(rf"= {drawn.run.v[-1, 2]:.6g} +rad/s", text)


@cache
def clamp() -> tuple[str, str, ExerciseData]:
    sheet, solved, drawn = make_exercise("toggle_clamp", "ideal", 3, None)
    return render_document(sheet, "txt"), render_document(solved, "txt"), drawn


def test_a_sheet_gives_no_answer_away() -> None:
    """What is asked stands on the solutions alone; equations there are solved by what is said to solve them."""
    sheet, solved, drawn = clamp()
    requested = "θ\u0308_link = "
    assert requested in solved and requested not in sheet and "how large is the angular acceleration of link?" in sheet
    a = drawn.run.a[-1]
    assert not any(f"{abs(x):.5g}" in sheet for x in a if abs(x) > 1e-9)
    letters = [f"{x}\u0308_{body}" for body in ("arm", "handle", "link") for x in "xyθ"]
    for rows, known in ((r"  (-?[\d.e-]+) = (.*\u0308.*)", dict(zip(letters, a, strict=True))),):
        found = re.findall(rows, solved)
        assert len(found) == 9
        for left, right in found:
            assert value(right, known) == pytest.approx(float(left), abs=2e-3 * np.abs(a).max())
    lambdas = {f"λ_{k}": x for k, x in enumerate((drawn.run[f"lambda.{row}"][-1] for row in ROWS), 1)}
    found = re.findall(r"  \(g - M·q̈\)_\S+ = (\S+) = (.*)", solved)
    assert len(found) == 9
    for left, right in found:
        assert value(right, lambdas) == pytest.approx(float(left), abs=2e-3 * max(map(abs, lambdas.values())))


ROWS = [*(f"{joint}.{axis}" for joint in "BKHG" for axis in "xy"), "hand"]


def test_a_step_is_written_by_how_far_it_is() -> None:
    """f stands with Φ and f̈ with γ, in s from 0 to 1: smooth_step's own quintic, and its second derivative."""
    _, solved, drawn = clamp()
    phi, gamma = (solved[solved.index(a) : solved.index(b)] for a, b in (("2. Write", "3. The"), ("4. γ", "5. Acc")))
    assert "where(" not in solved and "f_hand = " in phi and "f\u0308" not in phi and "s = t/shut" in phi
    shut = float(drawn.parameters["parameters.shut"].split()[0])
    known = {"s": drawn.t / shut, "shut": shut, "dead_centre": np.pi + np.arctan2(4, 3)}
    f, second = (re.search(rf"  {sign} = (.*)", text)[1] for sign, text in (("f_hand", phi), ("f\u0308_hand", gamma)))  # type: ignore[index]
    handle = drawn.run["handle.theta"][-1], drawn.run["handle.alpha"][-1]
    assert (value(f, known), value(second, known)) == pytest.approx(handle, rel=1e-9)
    assert "pi + atan2(4, 3) = 4.06889   rad" in solved


SIDES = """format: gudgeon/1
name: sides
parameters: {phase: pi/6}
bodies: {plate: {sides: {PQ: 80 mm, QR: 60 mm, PR: 90 mm, side: right}, points: {far: [20 mm, 0]}, mass: 1 g}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, plate.R]}}
drives: {motor: {angle: plate, value: phase + t * 1 rad/s}}
"""


def test_a_triangle_of_sides_fits_on_a_line() -> None:
    """What stands under a root that is too long for a line has a letter; names are upright; zeros have theirs."""
    model = derive_scene(SIDES.encode(), "sides.yaml", "ideal")
    text, latex = render_equations_text(model), render_equations_tex(model)
    known = {"l_plate.PQ": 0.08, "l_plate.QR": 0.06, "l_plate.PR": 0.09}
    for name in ("D_plate.R", "η_plate.R"):
        known[name] = value(" ".join(re.search(rf"  {name} = ([^=]*?)\n(?:  \S+ =|\n)", text)[1].split()), known)  # type: ignore[index]
    # the cosine law
    angle = np.arccos((0.08**2 + 0.09**2 - 0.06**2) / (2 * 0.08 * 0.09))
    assert known["η_plate.R"] == pytest.approx(-0.09 * np.sin(angle), rel=1e-9)
    assert r"\eta_{\text{plate,R}}" in latex and r"l_{\text{plate,PQ}}" in latex and r"^{\tfrac{1}{2}}" not in latex
    assert "ξ_plate.far = 20 mm,  η_plate.far = 0" in text and "phase       phase    π/6                 rad" in text
    assert r"\text{phase}" in latex and "mathit" not in latex


@pytest.mark.parametrize(
    ("text", "power"),
    [
        ("pi/6", 1),
        ("-20 deg", 1),
        ("90 rpm", 1),
        ("pi + atan2(4, 3)", 1),
        ("90 deg / (45 deg)", 0),
        ("0.3", 0),
        ("2 * pi rad / 1 s", 1),
        ("3 N*m/rad", -1),
        ("sin(20 deg)", 0),
    ],
)
def test_what_is_an_angle(text: str, power: int) -> None:
    assert find_angle_power(parse(text, Location("file", 1, 1))) == power


def test_text_of_a_file_is_no_markup() -> None:
    sheet, _, _ = documents("four_bar", 1)
    shown = format_document(sheet)
    assert r"# Exercise: four-bar linkage, a crank-rocker" in shown and r"mechanism four\_bar" in shown
    assert shown.count("$") % 2 == 0


def test_a_slider_of_a_share_of_pi_is_in_degrees(tmp_path: Path) -> None:
    (tmp_path / "sides.yaml").write_text(SIDES, encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "sides.yaml", "ideal")
    p = np.array([slot.default for slot in simulation.source.parameters])
    ((phase, *_), *_) = (section["numbers"] for section in build_parameter_sections(simulation, p))
    assert (phase["name"], phase["unit"]) == ("phase", "deg") and np.pi / 6 / phase["factor"] == pytest.approx(30)


def test_moments_are_before_the_event_that_ends_the_motion(tmp_path: Path) -> None:
    """The crank's 45 degrees take 0.125 s with the file's numbers; a scene runs for 1 s where it does not say."""
    text = find_shipped_file("four_bar").read_text(encoding="utf-8")
    file = tmp_path / "stopped.yaml"
    file.write_text(f"{text}events: {{part: {{zero: crank.theta - 135 deg, action: stop}}}}\n", encoding="utf-8")
    simulation = gudgeon.load(file)
    crank = list(simulation.source.coordinates).index("crank.theta")
    for seed in range(3):
        drawn = draw_parameters(simulation, seed, None)
        assert 0.0 < drawn.t == drawn.run.t[-1] and np.pi / 2 < drawn.q[crank] < np.radians(135)
    assert draw_parameters(simulation, 1, "0.1 s").t == 0.1
    with pytest.raises(BadValueError, match=r"--at is 0.2 s: event part \(action: stop\) ends the motion at 0.125 s"):
        draw_parameters(simulation, 1, "0.2 s")


PUMP = """
format: gudgeon/1
name: pump
parameters: {n: 120 rpm}
bodies:
  crank: {length: 60 mm, mass: 0.4 kg, inertia: 2e-4 kg*m^2}
  rod: {length: 250 mm, mass: 0.5 kg, inertia: 2.6e-3 kg*m^2}
  plunger: {mass: 0.9 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, plunger.origin]}
  barrel: {translational: [ground.O, plunger.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 60 deg + n * t}}
start: {guess: {plunger.x: 280 mm}}
"""


def test_given_data_hold_no_rounding_and_values_no_more_digits_than_they_carry(tmp_path: Path) -> None:
    (tmp_path / "pump.yaml").write_text(PUMP, encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "pump.yaml")
    for seed in range(1, 9):
        drawn = draw_parameters(simulation, seed, None)
        for values, least in ((drawn.q, 1e-8), (drawn.v, 1e-8 * np.abs(drawn.v).max())):
            assert all(x == 0.0 or abs(x) > least for x in values)
        _check_uncertainty(simulation, drawn, seed)
    of = subject("four_bar", "ideal")
    for x, off, text in ((-0.001782, 9e-6, "-0.00178"), (-0.001782, 0.0, "-0.001782"), (3e-7, 1e-6, "0")):
        assert of.format_number(x, uncertainty=off).text == text


def _check_uncertainty(simulation: Simulation, drawn: ExerciseData, seed: int) -> None:
    """Of other data that would be printed the same, γ differs by no more."""

    def gamma(q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return simulation.compiled.gamma(drawn.t, q, v, drawn.p)

    off, n, rng = drawn.estimate_rounding_uncertainty(gamma), len(drawn.q), np.random.default_rng(seed)
    exact, both = gamma(drawn.q, drawn.v), np.concatenate([drawn.q, drawn.v])
    for _ in range(20):
        other = both + drawn.units * rng.uniform(-0.5, 0.5, 2 * n)
        assert (np.abs(gamma(other[:n], other[n:]) - exact) <= 1.01 * off + 1e-12).all()
