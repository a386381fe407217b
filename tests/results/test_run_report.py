"""The report of a run against closed forms of a bouncing journal, independent quadratures, and its file."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, simpson
from scipy.optimize import brentq
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError
from gudgeon.generator.kinds.laws.law import Limits, find_all_laws
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.loading.kernel_sources import find_mechanism
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.reports.run_report import find_exceeded_limits, read_laws
from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler
M, K, G, H = 0.092, 1.4e8, 9.81, 1.0  # of mechanisms/bouncing_ball.yaml
V = math.sqrt(2 * G * H)
DEEPEST = brentq(lambda d: M * V**2 / 2 + M * G * d - 0.4 * K * d**2.5, 1e-5, 1e-2)  # m, of K δ^1.5 and gravity


def over_a_bounce(of: Callable[[float], float]) -> float:
    """∫ of(δ) dt from onset to separation; with δ = δm sin² φ the rate's zero at δm is no singularity."""

    def part(angle: float) -> float:
        d = DEEPEST * math.sin(angle) ** 2
        rate = math.sqrt(max(V**2 + 2 * G * d - 0.8 * K * d**2.5 / M, 1e-300))
        return of(d) * 2 * DEEPEST * math.sin(angle) * math.cos(angle) / rate

    return 2 * float(quad(part, 0.0, math.pi / 2 - 1e-6)[0])


@pytest.fixture(scope="module")
def bounces() -> dict[str, Result]:
    found = {}
    for scene in ("elastic", "damped"):
        simulation = gudgeon.load("bouncing_ball", scene)
        found[scene] = gudgeon.examine(simulation, simulation.simulate(rtol=1e-10))
    return found


@pytest.fixture(scope="module")
def press() -> tuple[Result, Result]:
    """With a film, examined beside the ideal scene; that one's run."""
    simulation, ideal = gudgeon.load("nine_bar_press", "lubricated"), gudgeon.load("nine_bar_press")
    run = simulation.simulate(t_end=0.2, output=400)
    return gudgeon.examine(simulation, run, ideal), ideal.simulate(output=run.t)


def test_an_elastic_bounce_is_hertzs(bounces: dict[str, Result]) -> None:
    """Shares of time, approach, depth, energy and RMS force of two bounces, gravity included."""
    joint = bounces["elastic"].report().to_dict()["joints"]["fall"]
    assert joint["contacts"] == 2 and joint["still_closed"] == 0
    assert joint["approach"]["median"] == pytest.approx(V, rel=1e-8)
    assert joint["restitution"]["min"] == pytest.approx(1.0, abs=1e-7)
    assert joint["penetration"] == pytest.approx(DEEPEST, rel=1e-6)
    touching = joint["time"]["impacting"] + joint["time"]["contact"]
    assert touching == pytest.approx(2 * over_a_bounce(lambda d: 1.0) / 2.0, rel=1e-5) and joint["time"]["film"] == 0.0
    assert joint["time"]["free"] == pytest.approx(1.0 - touching, abs=1e-15)
    assert joint["time"]["impacting"] == pytest.approx(touching / 2, rel=1e-3)
    assert joint["work"]["taken"] == pytest.approx(2 * (M * V**2 / 2 + M * G * DEEPEST), rel=1e-6)
    assert joint["work"]["returned"] == pytest.approx(joint["work"]["taken"], rel=1e-7)
    square = 2 * over_a_bounce(lambda d: K**2 * d**3)
    assert joint["rms"] == pytest.approx(math.sqrt(square / 2.0), rel=1e-5)


def test_a_damped_bounce_gives_back_what_its_law_delivers(bounces: dict[str, Result]) -> None:
    """a (1 + e) = ln[(1 + a)/(1 − a e)] (docs/physics.md, section 3), and three bounces lose ½ m v² (1 − e⁶)."""
    run = bounces["damped"]
    a = run.constants["fall.hysteresis"]
    e = brentq(lambda e: a * (1 + e) - math.log((1 + a) / (1 - a * e)), 0.1, 1.0)
    found = run.report().to_dict()
    joint = found["joints"]["fall"]
    assert joint["contacts"] == 3
    assert joint["restitution"]["median"] == pytest.approx(e, rel=3e-4)
    assert joint["work"]["damping"] == pytest.approx(M * V**2 / 2 * (1 - e**6), rel=1e-3)
    assert found["energy"]["clearances"] == pytest.approx(-joint["work"]["damping"], rel=1e-7)
    assert abs(found["energy"]["not_told_apart"]) < 1e-7 and joint["work"]["friction"] == 0.0


def test_a_film_takes_what_the_engine_integrates(press: tuple[Result, Result]) -> None:
    """Two films by F · v at Gauss's points; together the work that the time loop integrates beside the motion."""
    run, ideal = press
    found = run.report().to_dict()
    used = sum(joint["work"]["film"] for joint in found["joints"].values())
    assert used > 1e-4 and found["energy"]["clearances"] == pytest.approx(-used, rel=1e-6)
    for name, joint in found["joints"].items():
        assert joint["time"]["film"] == 1.0 and joint["contacts"] == 0 and joint["work"]["taken"] == 0.0
        assert joint["film_least"] == pytest.approx(joint["c"] - run.diagnostics.peak(name).e_max, rel=1e-14)
        assert joint["ideal"]["F"] == ideal[f"{name}.F"].max()
        mean = simpson(ideal[f"{name}.F"] ** 2, x=ideal.t) / 0.2
        assert joint["ideal"]["rms"] == pytest.approx(math.sqrt(mean), rel=1e-4)
        assert joint["rms"] == pytest.approx(math.sqrt(simpson(run[f"{name}.F"] ** 2, x=run.t) / 0.2), rel=2e-3)


def test_its_energies_are_integrals_of_powers(press: tuple[Result, Result]) -> None:
    """The drives' work by Simpson's rule over torque and rate; with the joints' it is what kinetic and potential
    energy gained, and the residual is no less than what is missing."""
    run, _ = press
    energy = run.report().to_dict()["energy"]
    names = [drive.name for drive in run.source.drives]
    rates = {part.name: part.ends[0].partition(".")[0] for part in run.source.parts if part.section == "drives"}
    power = sum(run[f"{name}.torque"] * run[f"{rates[name]}.omega"] for name in names)
    assert energy["drives"] == pytest.approx(simpson(power, x=run.t), rel=5e-4)  # the film settles within samples
    missing = energy["change"] - energy["drives"] - energy["forces"] - energy["clearances"]
    assert abs(missing) <= energy["residual"] * (1 + 1e-6) < 1e-6
    assert energy["residual"] == run.diagnostics.energy_residual


def test_the_step_is_halved(bounces: dict[str, Result]) -> None:
    """rk4's difference to half the step is 15/16 of its error, here beside a run with a hundredth of the tolerance."""
    simulation = gudgeon.load("nine_bar_press", "lubricated")
    run = simulation.simulate(t_end=0.02, output=20, method="rk4", step=2e-5)
    exact = simulation.simulate(output=run.t, rtol=1e-12)
    found = gudgeon.examine(simulation, run).diagnostics.examined
    assert found is not None and found.compared_with == "steps half as long"
    (y,) = (one for one in found.differences if one.name == "S9.y")
    assert y.largest == pytest.approx(15 / 16 * np.abs(run["S9.y"] - exact["S9.y"]).max(), rel=0.1)


@pytest.mark.parametrize("which", ["elastic", "press"])
def test_a_file_has_the_same_report(
    which: str, bounces: dict[str, Result], press: tuple[Result, Result], tmp_path: Path
) -> None:
    run = press[0] if which == "press" else bounces[which]
    run.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc").report()
    assert again.to_html() == run.report().to_html() and str(again) == str(run.report())
    assert again.to_dict() == run.report().to_dict()
    json.dumps(again.to_dict(), allow_nan=False)
    message = run.diagnostics.to_json()
    assert Diagnostics.from_json(message).to_json() == message


def test_what_was_not_asked_for_is_named(bounces: dict[str, Result]) -> None:
    run = replace(bounces["damped"], diagnostics=replace(bounces["damped"].diagnostics, examined=None))
    joint = run.report().to_dict()["joints"]["fall"]
    assert joint["restitution"] is None and joint["work"] is None and joint["contacts"] == 3
    assert str(run.report()).count("not requested: gudgeon run --report") == 4
    with pytest.raises(BadValueError, match="expected the simulation of the run"):
        gudgeon.examine(gudgeon.load("bouncing_ball", "elastic"), run)


def test_titles_are_text_and_a_page_needs_no_other(tmp_path: Path) -> None:
    """By the command, of a file whose title is HTML; a page that asks for nothing, and the result beside it."""
    text = find_mechanism("bouncing_ball").read_text(encoding="utf-8")
    title = "</title><script>alert(1)</script>&"
    (tmp_path / "ball.yaml").write_text(re.sub("title: .*", f"title: {title!r}", text), encoding="utf-8")
    out = str(tmp_path / "out")
    arguments = ["run", str(tmp_path / "ball.yaml"), "--scene", "damped", "--t-end", "0.5", "--report", "--out", out]
    message = CliRunner().invoke(app, [*arguments, "--json"])
    assert message.exit_code == 0, message.output
    files: dict[str, Any] = json.loads(message.stdout)["files"]
    page = Path(files["report damped"]).read_text(encoding="utf-8")
    assert "<script" not in page and "&lt;script&gt;" in page and page.count("<svg") == 1
    assert not re.search(r"(src|href)=|url\(|@import|https?:", page)
    assert page == Result.load(files["damped"]).report().to_html()
    assert "no contact" not in Path(files["report ideal"]).read_text(encoding="utf-8")


def test_films_say_where_they_are_left(press: tuple[Result, Result]) -> None:
    """Of the law that the joint's C calls."""
    run, _ = press
    p = {slot.address: x for slot, x in zip(run.source.parameters, run.p, strict=False)}
    radius, c, length = (p[f"bearings.pin.{key}"] for key in ("radius", "clearance", "length"))
    files = run.source.files["clearance.c"]
    message = {}
    for law in ("pinkus_sternlicht", "ocvirk", "finite_length"):
        text = {**run.source.files, "clearance.c": files.replace("pinkus_sternlicht(", f"{law}(")}
        found = replace(run, source=replace(run.source, files=text)).report().to_dict()["warnings"]
        message[law] = [note for note in found if note.startswith("A: ")]
    ratio = f"A: L/D is {length / (2 * (radius - c)):.3g}: "
    assert message["pinkus_sternlicht"][0].startswith(ratio) and "ω" in message["pinkus_sternlicht"][1]
    assert [note.startswith(ratio) for note in message["ocvirk"]] == [True] and not message["finite_length"]


def test_films_that_grow_thin_are_told(press: tuple[Result, Result], monkeypatch: pytest.MonkeyPatch) -> None:
    run, _ = press
    film = run.p[run.source.clearances[0].constants["film_clearance"]]
    law = replace(find_all_laws()["finite_length"], limits=Limits(epsilon=float(np.quantile(run["A.e"] / film, 0.75))))
    monkeypatch.setattr("gudgeon.results.reports.run_report._find_film_law", lambda source, joint: law)
    notes = [note for note in run.report().to_dict()["warnings"] if note.startswith("A: ")]
    assert len(notes) == 1 and float(notes[0].split()[2]) == pytest.approx(25.0, abs=0.5)  # 401 samples
    most = run.diagnostics.peak("A").e_max / film
    assert notes[0].endswith(f"; it reaches {most:.4g}")
    between = replace(law, limits=Limits(epsilon=1.01 * most))
    monkeypatch.setattr("gudgeon.results.reports.run_report._find_film_law", lambda source, joint: between)
    assert not find_exceeded_limits(run)
    peaks = tuple(replace(peak, e_max=1.02 * peak.e_max) for peak in run.diagnostics.peaks)  # of steps, which see more
    (note, *_) = find_exceeded_limits(replace(run, diagnostics=replace(run.diagnostics, peaks=peaks)))
    assert note.startswith("A: between samples ε is over") and note.endswith(f"; it reaches {1.02 * most:.4g}")


@pytest.mark.usefixtures("no_pictures")
def test_a_run_at_the_command_line_tells_what_a_film_is_beyond(tmp_path: Path) -> None:
    """Without a report: the press's films are finite ones, L/D = 40 mm/(2 · 14.7 mm), by a law of long ones."""
    arguments = ["run", "nine_bar_press", "--scene", "lubricated", "--t-end", "1 ms", "--out", str(tmp_path)]
    message = CliRunner().invoke(app, arguments)
    assert message.exit_code == 0
    for joint in "AB":
        assert f"note: lubricated: {joint}: L/D is 1.36: pinkus_sternlicht is valid for L/D above 4" in message.output
    document = json.loads(CliRunner().invoke(app, [*arguments, "--json"]).stdout)
    beyond = {name: scene["beyond"] for name, scene in document["scenes"].items()}
    assert len(beyond["lubricated"]) >= 2 and beyond.get("ideal", []) == []


def test_stiffness_and_what_its_damping_delivers_are_told(press: tuple[Result, Result]) -> None:
    """K by physics.md section 3 from the file's materials and radii, c_e = .9 as asked, .91318 delivered."""
    run, _ = press
    joint = run.report().to_dict()["joints"]["A"]
    sigma, outer, inner = 2.0 * (1.0 - 0.3**2) / 70e9, 15e-3, 14.7e-3
    K_of = 4.0 / (3.0 * sigma) * math.sqrt(outer * inner / (outer + inner))
    assert joint["stiffness"] == {"K": pytest.approx(K_of, rel=1e-12), "unit": "N/m^1.5"}
    assert joint["asked"] == 0.9 and joint["free_impact"] == pytest.approx(0.91318, abs=5e-6)
    text = str(run.report())
    assert f"{K_of:.4g} N/m^1.5" in text and "0.9, delivered in a free impact 0.91318" in text


LAWS = """
format: gudgeon/1
name: disc
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {disc: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, disc.com]}}
bearings: {b: {radius: 15 mm, clearance: 0.1 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  oil:
    normal: {law: esdu_78035}
    film: {law: ocvirk, viscosity: 0.01, cavitation: full, angular_velocity: relative}
    mixed: {law: greenwood_tripp, roughness: 1 um}
scenes: {oil: {play: {A: {bearing: b, contact: oil}}}}
"""


def test_every_law_is_told_with_its_conventions() -> None:
    """However long its source and validity are, and that of mixed lubrication, which is no function of C, too."""
    message = read_laws(generate_kernel_source(LAWS.encode(), "disc.yaml", "oil"))
    assert [law["title"].split(":")[0] for law in message] == ["ESDU 78035", "Ocvirk", "Greenwood and Tripp"]
    for law, name in zip(message, ("esdu_78035", "ocvirk", "greenwood_tripp"), strict=True):
        own = find_all_laws()[name]
        assert (law["title"], law["source"], law["valid"]) == (own.title, own.source, own.validity)
    assert "cavitation: full" in message[1]["options"] and "angular_velocity: relative" in message[1]["options"]
