"""Materials by name, for roles of bearings and shapes, of a file, a scene or a run: Hertz and masses by hand."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.results.batch import Batch
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import make_axis, parse_axis
from gudgeon.studies.ensemble.notes import group_notes
from gudgeon.studies.show.map import format_axis_value

STEEL, BRONZE = (206e9, 0.3, 7850.0), (110e9, 0.34, 8800.0)
R, C, DISC, THICK = 10e-3, 0.3e-3, 12e-3, 15e-3
TEXT = f"""
format: gudgeon/1
name: drop
gravity: [0, -9.81 m/s^2]
parameters: {{soft: 110 GPa}}
materials:
  steel: {{E: {STEEL[0]}, nu: {STEEL[1]}, density: {STEEL[2]}}}
  bronze: {{E: soft, nu: {BRONZE[1]}, density: {BRONZE[2]}}}
  foam: {{density: 30 kg/m^3}}
  glue: {{E: 2 GPa, nu: 0}}
bodies: {{ball: {{shape: {{disc: {DISC} m, thickness: {THICK} m, material: steel}}}}}}
ground: {{o: [0, 0]}}
joints: {{A: {{revolute: [ground.o, ball.origin]}}}}
bearings:
  pin: {{radius: {R} m, clearance: {C} m, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {{dry: {{normal: {{law: lankarani_nikravesh, restitution: 0.9}}}}}}
scenes:
  dry: {{play: {{A: {{bearing: pin, contact: dry}}}}, simulate: {{t_end: 10 ms, output: 20}}}}
  soft: {{extends: dry, materials: {{bearings.pin.journal_material: bronze, bodies.ball.shape.material: bronze}}}}
"""
JOURNAL, HOLE, SHAPE = "bearings.pin.journal_material", "bearings.pin.bearing_material", "bodies.ball.shape.material"


@dataclass
class Scenes:
    """Loaded once for all tests here."""

    dry: Simulation
    soft: Simulation
    file: Path


@pytest.fixture(scope="module")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> Scenes:
    file = tmp_path_factory.mktemp("materials") / "drop.yaml"
    file.write_text(TEXT, encoding="utf-8")
    return Scenes(gudgeon.load(file, "dry"), gudgeon.load(file, "soft"), file)


def stiffness(i: tuple[float, float, float], j: tuple[float, float, float]) -> float:
    """Hertz, external, of bearing i and journal j."""
    sigma = sum((1 - nu**2) / E for E, nu, _ in (i, j))
    return 4 / (3 * sigma) * math.sqrt(R * (R - C) / (2 * R - C))


def weight(density: float) -> tuple[float, float]:
    """Mass and moment of inertia of the disc."""
    mass = math.pi * DISC**2 * THICK * density
    return mass, mass * DISC**2 / 2


def found(simulation: Simulation, parameters: dict[str, Any]) -> tuple[float, float, float]:
    """K, and the body's mass and moment of inertia."""
    p = compute_parameter_values(simulation.compiled, parameters)[0]
    mass = simulation.compiled.mass(p)
    return float(p[simulation.source.clearances[0].constants["K"]]), float(mass[0]), float(mass[2])


@pytest.mark.parametrize(
    ("scene", "parameters", "i", "j", "density"),
    [
        ("dry", {}, STEEL, STEEL, STEEL[2]),
        ("dry", {JOURNAL: "bronze"}, STEEL, BRONZE, STEEL[2]),
        ("dry", {HOLE: "bronze", SHAPE: "foam"}, BRONZE, STEEL, 30.0),
        ("dry", {HOLE: " bronze", JOURNAL: "glue"}, BRONZE, (2e9, 0.0, 0.0), STEEL[2]),
        ("soft", {}, STEEL, BRONZE, BRONZE[2]),
        ("soft", {JOURNAL: "steel"}, STEEL, STEEL, BRONZE[2]),
        ("dry", {JOURNAL: "bronze", "materials.bronze.E": "50 GPa"}, STEEL, (50e9, 0.34, 0.0), STEEL[2]),
        ("dry", {JOURNAL: "bronze", "soft": 60e9}, STEEL, (60e9, 0.34, 0.0), STEEL[2]),
        ("soft", {"soft": 60e9, "materials.bronze.density": 9000.0}, STEEL, (60e9, 0.34, 0.0), 9000.0),
        ("dry", {JOURNAL: "glue", "materials.glue.nu": 0.2}, STEEL, (2e9, 0.2, 0.0), STEEL[2]),
        ("dry", {JOURNAL: "bronze", f"{JOURNAL}.E": 70e9}, STEEL, (70e9, 0.34, 0.0), STEEL[2]),
        ("dry", {"materials.steel.E": 1e11}, (1e11, 0.3, 0.0), (1e11, 0.3, 0.0), STEEL[2]),
    ],
)
def test_numbers_are_those_of_what_is_chosen(
    scenes: Scenes, scene: str, parameters: dict[str, Any], i: Any, j: Any, density: float
) -> None:
    K, mass, inertia = found(getattr(scenes, scene), parameters)
    assert pytest.approx(stiffness(i, j), rel=1e-14) == K
    assert (mass, inertia) == pytest.approx(weight(density), rel=1e-14)


def test_two_roles_of_one_material_have_the_bits_of_one_number(tmp_path: Path) -> None:
    """A file with a choice and one without compute the same contact, whatever the material."""
    file, lines = tmp_path / "one.yaml", TEXT.splitlines()
    kept = [line for line in lines if not line.startswith(("  bronze:", "  foam:", "  glue:", "  soft:"))]
    file.write_text("\n".join(kept))
    one = gudgeon.load(file, "dry")
    file.write_text(TEXT)
    two, rng = gudgeon.load(file, "dry"), np.random.default_rng(9)
    assert not any(slot.words for slot in one.source.parameters)
    for E, nu in zip(rng.uniform(1e9, 4e11, 500), rng.uniform(-0.5, 0.49, 500), strict=True):
        given = {"materials.steel.E": float(E), "materials.steel.nu": float(nu)}
        assert found(one, given)[0] == found(two, given)[0]


def test_a_scene_a_run_and_the_file_say_the_same(scenes: Scenes) -> None:
    """And the run tells what it was told to choose, in its record too."""
    selected = {JOURNAL: "bronze", SHAPE: "bronze"}
    runs = [
        scenes.dry.simulate(parameters=selected),
        scenes.soft.simulate(),
        gudgeon.load(scenes.file, "dry", overrides=selected).simulate(),
    ]
    assert len(runs[0].impacts)
    for run in runs[1:]:
        np.testing.assert_array_equal(run.q, runs[0].q)
        assert run.impacts.tobytes() == runs[0].impacts.tobytes()
    assert f"{JOURNAL} is bronze (the scene's is steel)" in runs[0].diagnostics.notes
    message = [note.text for note in group_notes([(0, (*runs[0].diagnostics.notes, "another"))]).values()]
    assert "another" in message and JOURNAL not in " ".join(message)  # a study's coordinates say what it chooses
    assert all(run.parameters[JOURNAL] == "bronze" and run.parameters[HOLE] == "steel" for run in runs)


def test_it_goes_on_and_is_kept(scenes: Scenes, tmp_path: Path) -> None:
    """A further run has the choice, by its name; so has a file that is read back."""
    pytest.importorskip("h5py")
    run = scenes.dry.simulate(5e-3, output=5, parameters={JOURNAL: "bronze"})
    assert dict(run.final.parameters) == {JOURNAL: "bronze"}
    other = scenes.dry.simulate(7e-3, output=2, start=run.final, parameters={"soft": 50e9})
    assert other.constants["A.K"] == pytest.approx(stiffness(STEEL, (50e9, 0.34, 0.0)), rel=1e-14)
    run.save(tmp_path / "run.nc")
    back = gudgeon.Result.load(tmp_path / "run.nc")
    assert back.parameters == run.parameters
    assert back.final.parameters == run.final.parameters
    assert any(JOURNAL in note for note in back.diagnostics.notes)


@pytest.mark.parametrize(
    "options",
    [
        {"method": "rk4", "step": 1e-5},
        pytest.param({"method": "dop853"}, marks=pytest.mark.slow),
        {"method": "scipy:DOP853"},
    ],
)
def test_a_column_of_names(scenes: Scenes, options: dict[str, Any], tmp_path: Path) -> None:
    names = np.array(["bronze", "steel", "glue", "bronze"])
    batch = scenes.dry.simulate_many({JOURNAL: names, SHAPE: ["foam", "steel", "bronze", "steel"]}, **options)
    assert not batch.failures
    for i, name in enumerate(names.tolist()):
        alone = scenes.dry.simulate(parameters={JOURNAL: name, SHAPE: batch.parameters[SHAPE][i]}, **options)
        np.testing.assert_array_equal(batch.q[i], alone.q)
        assert batch[i].parameters == alone.parameters
        assert any(JOURNAL in note for note in batch[i].diagnostics.notes) == (name != "steel")  # the scene's own
    assert batch.parameters[JOURNAL].tolist() == names.tolist()
    batch.to_csv(tmp_path / "batch.csv", ["A.e"])
    first, second = (tmp_path / "batch.csv").read_text().splitlines()[:2]
    assert dict(zip(first.split(","), second.split(","), strict=True))[JOURNAL] == "bronze"
    batch.save(tmp_path / "batch.nc")
    back = Batch.load(tmp_path / "batch.nc")
    assert {name: x.tolist() for name, x in back.parameters.items()} == {
        name: x.tolist() for name, x in batch.parameters.items()
    }
    assert back.to_xarray()[JOURNAL].values.tolist() == names.tolist()


def test_what_is_no_choice_is_told(scenes: Scenes) -> None:
    with pytest.raises(UnknownNameError, match="bronse") as caught:
        scenes.dry.simulate(parameters={JOURNAL: "bronse"})
    assert "bronze" in str(caught.value)
    with pytest.raises(UnknownNameError, match="foam"):  # it has no E
        scenes.dry.simulate(parameters={JOURNAL: "foam"})
    with pytest.raises(BadValueError, match="expected one of: steel, bronze, glue"):
        scenes.dry.simulate(parameters={JOURNAL: 1})
    with pytest.raises(BadValueError, match="Young's modulus is positive"):
        scenes.dry.simulate(parameters={f"{JOURNAL}.E": -1.0})
    with pytest.raises(BadValueError, match="expected a list of names, of steel, bronze, glue"):
        make_axis(scenes.dry, JOURNAL, [0.0, 1.0])
    with pytest.raises(BadValueError, match="a choice by name has no range"):
        parse_axis(scenes.dry, f"{JOURNAL}=steel..glue")
    with pytest.raises(UnknownNameError, match="bronse"):
        parse_axis(scenes.dry, f"{JOURNAL}=steel,bronse")


def test_an_axis_of_names(scenes: Scenes, tmp_path: Path) -> None:
    """As columns of a map: each cell is run with its material, which is what is told of it."""
    one = parse_axis(scenes.dry, f"{JOURNAL}=glue, steel")
    assert [one.build_parameters(x) for x in one.values] == [{JOURNAL: "steel"}, {JOURNAL: "glue"}]
    assert [format_axis_value(one, x) for x in one.values] == ["steel", "glue"]
    message = ["map", str(scenes.file), "--scene", "dry", "--quick", "--t-end", "0.2 ms", "--out", str(tmp_path)]
    ran = CliRunner().invoke(app, [*message, "--axis", f"{JOURNAL}=glue,steel", "--axis", "rtol=1e-6"])
    assert ran.exit_code == 0, ran.output
    assert "steel" in ran.output and f"{JOURNAL}=glue" in (tmp_path / "drop_map.csv").read_text()


@pytest.mark.parametrize("scene", ["dry", "soft"])
@pytest.mark.parametrize(
    "parameters",
    [
        {},
        {JOURNAL: "bronze"},
        {HOLE: "glue", SHAPE: "foam"},
        {JOURNAL: "bronze", "soft": 60e9, f"{JOURNAL}.nu": 0.2},
    ],
)
def test_equations_in_numpy_take_names(scenes: Scenes, scene: str, parameters: dict[str, Any]) -> None:
    simulation = getattr(scenes, scene)
    model = simulation.model.numpy()
    given, here = compute_parameter_values(simulation.compiled, parameters)[0], model.prepare(parameters)
    slots = model.model.parameter_table
    for k, slot in enumerate(simulation.source.parameters):
        if not slot.words:
            assert getattr(here, slots.find_member_name(slots.entries[slot.address].symbol)) == given[k], slot.address
    np.testing.assert_array_equal(model.mass(here), simulation.compiled.mass(given))
    with pytest.raises(UnknownNameError, match="bronse"):
        model.prepare({JOURNAL: "bronse"})


def test_a_stiffness_axis_moves_what_the_run_has(scenes: Scenes) -> None:
    """The first of them by its value, others by their ratio; not what nothing is of."""
    assert make_axis(scenes.dry, "stiffness", [1e9]).ratios == (("materials.steel.E", 1.0),)
    moved = dict(make_axis(scenes.dry, "stiffness", [1e9], {JOURNAL: "bronze"}).ratios)
    assert moved == {"materials.steel.E": 1.0, "materials.bronze.E": BRONZE[0] / STEEL[0]}
    only = make_axis(scenes.dry, "stiffness", [1e9], {JOURNAL: "bronze", HOLE: "bronze"}).ratios
    assert only == (("materials.bronze.E", 1.0),)


def test_on_the_command_line(scenes: Scenes, tmp_path: Path) -> None:
    """The ideal run has the choice of the body too, and nothing of the bearing."""
    message = ["run", str(scenes.file), "--scene", "dry", "--out", str(tmp_path / "out"), "--t-end", "2ms"]
    ran = CliRunner().invoke(app, [*message, "--set", f"{JOURNAL}=bronze", "--set", f"{SHAPE}=foam"])
    assert ran.exit_code == 0, ran.output
    assert f"{JOURNAL} is bronze" in ran.output
    assert f"{SHAPE} is foam" in ran.output
    ran = CliRunner().invoke(app, [*message, "--set", f"{JOURNAL}=bronse"])
    assert ran.exit_code == 2


def test_errors_against_another_scene_take_what_is_chosen(scenes: Scenes) -> None:
    """The scene beside has the run's materials: against itself the error is none, whatever was chosen."""
    dry = gudgeon.load("nine_bar_press", scene="dry")
    selected = {"bearings.pin.bearing_material": "aluminium", "bearings.pin.journal_material": "steel_45"}
    run = dry.simulate(2e-4, parameters=selected, output=2, peaks=["S9.y"], against=gudgeon.load("nine_bar_press"))
    assert 0.0 < run.peak_error("S9.y").abs < 1e-6
    beside = dry.simulate(2e-4, parameters=selected, output=2, peaks=["S9.y"], against=dry)
    assert beside.peak_error("S9.y").abs < 1e-12
    with pytest.raises(UnknownNameError, match="nothing named 'typo'"):
        _ = dry.simulate_many([selected], 1e-4, output=2)["typo"]
