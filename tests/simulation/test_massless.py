"""Kinematics without masses: the same motion, nothing that would follow from masses; dynamics says what is missing."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import gudgeon
from gudgeon.commands.check import check_mechanism
from gudgeon.errors import MissingKeyError, UnknownNameError
from gudgeon.results import results
from tests.slow import slow_but

ROOT = Path(__file__).resolve().parents[2]
KINEMATIC = (
    "mechanisms/four_bar.yaml",
    "mechanisms/nine_bar_press.yaml",
    "mechanisms/slider_crank.yaml",
    "mechanisms/gallery/peaucellier.yaml",
)


def stripped(name: str, tmp_path: Path, keys: str = "mass|inertia", body: str = "") -> Path:
    """The file without these keys: of all bodies, or of one."""
    lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
    for i, line in enumerate(lines):
        if re.match(rf"  {body or '[A-Za-z0-9_]+'}: {{.*(mass|inertia): ", line):
            lines[i] = re.sub(rf"(, )?\b({keys}): [^,}}]*", "", line).replace("{, ", "{")
    file = tmp_path / Path(name).name
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


@pytest.mark.parametrize("name", slow_but(KINEMATIC[:3:2], KINEMATIC))
def test_the_motion_is_the_same_to_the_bit(name: str, tmp_path: Path) -> None:
    """But for the start's rates, which the metric of M rounds another way."""
    requested: dict[str, Any] = {"t_end": 0.1, "output": 200}
    with_masses = gudgeon.load(ROOT / name).simulate(**requested)
    without = gudgeon.load(stripped(name, tmp_path)).simulate(**requested)
    assert without.source.massless_bodies and without.diagnostics.method == "kinematic"
    np.testing.assert_array_equal(without.q, with_masses.q)
    for ours, theirs in ((without.v, with_masses.v), (without.a, with_masses.a)):
        np.testing.assert_array_equal(ours[1:], theirs[1:])
        np.testing.assert_allclose(ours[0], theirs[0], rtol=0, atol=1e-14 * np.abs(theirs).max())


@pytest.mark.parametrize("scale", [1e-6, pytest.param(1e3, marks=pytest.mark.slow)])
def test_small_and_large_machines(scale: float, tmp_path: Path) -> None:
    """What stands in place of inertias is as large as the machine: a crank's rates by a closed form."""
    text = f"""format: gudgeon/1
name: slide
bodies:
  crank: {{length: {50e-3 * scale!r} m}}
  rod: {{length: {120e-3 * scale!r} m}}
  slider: {{}}
ground: {{O: [0, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  pin: {{revolute: [crank.head, rod.tail]}}
  wrist: {{revolute: [rod.head, slider.origin]}}
  guide: {{translational: [ground.O, slider.origin], axis: [1, 0]}}
drives: {{motor: {{angle: crank, value: 10 rad/s * t}}}}
start: {{guess: {{rod.theta: 0, slider.x: {0.17 * scale!r}}}}}
"""
    (tmp_path / "slide.yaml").write_text(text)
    r, rod = 50e-3 * scale, 120e-3 * scale

    def rate(turn: NDArray[Any]) -> NDArray[Any]:
        return -10.0 * r * np.sin(turn) * (1 + r * np.cos(turn) / np.sqrt(rod**2 - (r * np.sin(turn)) ** 2))

    for formulation in ("reduced", "full"):
        run = gudgeon.load(tmp_path / "slide.yaml", formulation=formulation).simulate(t_end=1.0, output=100)
        turn = 10.0 * run.t
        there = r * np.cos(turn) + np.sqrt(rod**2 - (r * np.sin(turn)) ** 2)
        np.testing.assert_allclose(run["slider.x"], there, rtol=1e-13)
        np.testing.assert_allclose(run["slider.vx"], rate(turn), rtol=0, atol=1e-11 * r * 10)
        slope = 10.0 * rate(turn + 1e-30j).imag / 1e-30  # a complex step
        np.testing.assert_allclose(run["slider.ax"], slope, rtol=0, atol=1e-11 * r * 100)


def test_what_follows_from_masses_is_left_out(tmp_path: Path) -> None:
    run = gudgeon.load(stripped(KINEMATIC[0], tmp_path)).simulate(t_end=0.1, output=10)
    message = [name for name in run.names if re.search(r"\.(F|Fx|Fy|M|torque)$|^(lambda|energy|work)\.", name)]
    assert not message
    joint, row = run.source.joints[0].name, run.source.equations[0].name
    for name in ("energy.kinetic", "work.drives", f"{joint}.F", f"lambda.{row}"):
        with pytest.raises(UnknownNameError, match="have no mass or no inertia\n  give every body mass: and inertia:"):
            run[name]
    for unknown in (run.evaluation.reactions, run.evaluation.multipliers, run.evaluation.energy, run.work):
        assert np.isnan(unknown).all()
    assert np.isfinite(run.evaluation.a).all()
    assert any("reactions, torques, energies and works are not known" in note for note in run.diagnostics.notes)
    run.save(tmp_path / "run.nc")
    again = results.read(tmp_path / "run.nc")
    assert again.names == run.names and np.isnan(again.work).all()
    np.testing.assert_array_equal(again.q, run.q)


def test_many_runs(tmp_path: Path) -> None:
    """A sweep of a length, each run as it goes alone; no works."""
    linkage = gudgeon.load(stripped(KINEMATIC[2], tmp_path), scene="ideal")
    lengths = [0.11, 0.12, 0.13]
    batch = linkage.simulate_many({"bodies.rod.length": lengths}, t_end=0.1, output=20)
    assert not batch.failures and np.isnan(batch.work).all()
    for i, length in enumerate(lengths):
        alone = linkage.simulate(parameters={"bodies.rod.length": length}, t_end=0.1, output=20)
        np.testing.assert_array_equal(batch["slider.ax"][i], alone["slider.ax"])


@pytest.mark.parametrize(
    ("keys", "lacks"), [("mass", "mass"), ("inertia", "inertia"), ("mass|inertia", "mass and no inertia")]
)
@pytest.mark.parametrize("driven", [True, False])
def test_dynamics_says_which_is_missing(driven: bool, keys: str, lacks: str, tmp_path: Path) -> None:
    """Play, or a freedom: an error at the body, of that alone which is missing."""
    file, scene, why = stripped("mechanisms/slider_crank.yaml", tmp_path, keys, "rod"), "dry", "has play in wristpin"
    if not driven:
        text = file.read_text()
        file.write_text(text.replace("  motor: {angle: crank, value: omega * t}\n", "").replace("drives:\n", ""))
        scene, why = "ideal", "has 1 degree of freedom"
    with pytest.raises(MissingKeyError, match=f"body rod has no {lacks}, and scene {scene} {why}\n") as caught:
        gudgeon.load(file, scene=scene)
    line = next(i for i, text in enumerate(file.read_text().splitlines(), 1) if text.startswith("  rod: "))
    where = caught.value.where
    assert where is not None and (where.line, where.column) == (line, 3)
    requested = [key for key in ("mass", "inertia") if f"{key}:" in caught.value.hint.partition(" of rod")[0]]
    assert requested == lacks.split(" and no ")


def test_all_that_is_missing_is_told_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = stripped("mechanisms/slider_crank.yaml", tmp_path)
    text = file.read_text(encoding="utf-8").splitlines()
    line = {
        name: k
        for k, message in enumerate(text, 1)
        for name in ("rod", "slider")
        if message.startswith(f"  {name}: {{")
    }
    listed = rf"bodies crank, rod \(line {line['rod']}\), slider \(line {line['slider']}\) have no mass and no inertia"
    with pytest.raises(MissingKeyError, match=listed):
        gudgeon.load(file, scene="dry")
    assert check_mechanism(str(file), verbose=False, as_json=False) == 2  # as run has it
    message = " ".join(capsys.readouterr().out.split())
    assert message.startswith("valid, but scene dry cannot be run: 3 bodies,")
    assert "masses: scene dry has degrees of freedom and cannot be run: crank has no mass and no inertia" in message


def test_mass_without_inertia_asks_for_nothing_where_nothing_moves_by_forces(tmp_path: Path) -> None:
    """And no mass of the others is a number of a run: it would change nothing."""
    file = stripped("mechanisms/slider_crank.yaml", tmp_path, "inertia", "rod")
    source = gudgeon.load(file, scene="ideal").source
    assert source.massless_bodies == ("rod",)
    assert not [slot.address for slot in source.parameters if slot.address.endswith((".mass", ".inertia"))]


def test_auto_without_a_mass_lacks_the_mass_alone(tmp_path: Path) -> None:
    file = stripped("mechanisms/slider_crank.yaml", tmp_path, "mass|inertia", "rod")
    file.write_text(file.read_text().replace("rod: {length: 120 mm", "rod: {length: 120 mm, inertia: auto"))
    with pytest.raises(MissingKeyError, match="body rod has no mass, and"):
        gudgeon.load(file, scene="dry")
