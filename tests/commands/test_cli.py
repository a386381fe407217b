"""The other commands as a user types them: exit codes, what is told, what is written."""

from __future__ import annotations

import io
import json
import os
import re
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from hashlib import sha256
from pathlib import Path

import pytest

import gudgeon
from gudgeon.commands import check
from gudgeon.commands.check import check_mechanism
from gudgeon.commands.emit import emit_c
from gudgeon.commands.equations import write_equations
from gudgeon.commands.studies import MeasurementRequest, load_scenes
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.deprecations import STRESS
from gudgeon.loading.kernel_sources import derive_kernel_source
from gudgeon.loading.shipped import read_committed_source
from gudgeon.studies import map as maps
from gudgeon.studies import stress
from tests.programs import needs_compiler
from tests.pump import TEXT, Gudgeon, written


@pytest.fixture
def derived_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """`check -v` derives each time; of the same bytes a test's second one is told of the first one's derivation."""
    known: dict[tuple[bytes, str], tuple[KernelSource, dict[str, float]]] = {}

    def once(data: bytes, file: Path, scene: str, seconds: dict[str, float]) -> KernelSource:
        if (data, scene) not in known:
            shipped = read_committed_source(
                file.stem, scene, sha256(data).hexdigest()
            )  # the same: tests/test_generated.py
            known[data, scene] = shipped or derive_kernel_source(data, file, scene, seconds=seconds), seconds
        seconds |= known[data, scene][1]
        return known[data, scene][0]

    monkeypatch.setattr(check, "derive_kernel_source", once)


CHECKED = """\
valid: 3 bodies, 4 joints, 1 drive; scenes ideal, worn; degrees of freedom 0 (ideal), 2 (worn)
"""


@needs_compiler
@pytest.mark.usefixtures("derived_once")
def test_check_counts_and_verbose_tells_of_each_scene(call: Gudgeon, pump: str) -> None:
    done = call("check", pump)
    assert (done.exit_code, done.stdout) == (0, CHECKED)
    found = json.loads(call("check", pump, "-v", "--json").stdout)["scenes"]
    assert (found["ideal"]["unknowns"], found["ideal"]["rows"], found["ideal"]["degrees of freedom"]) == (9, 9, 0)
    assert (found["worn"]["rows"], found["worn"]["degrees of freedom"]) == (7, 2)
    # O: x, θ and y, θ; A: x, θ, x, θ and y, θ, y, θ; B: x, θ, x and y, θ, y (the piston's pin is its origin);
    # bore: y of the piston and its angle; motor: one angle
    assert (found["ideal"]["non-zeros of Φ_q"], found["worn"]["non-zeros of Φ_q"]) == (4 + 8 + 6 + 2 + 1, 4 + 8 + 2 + 1)
    shown = call("check", pump, "-v").stdout
    assert "degrees of freedom" in shown and "operations" in shown
    stages = ("reading", "equations", "rank of the rows", "functions", "C")
    assert all(scene["seconds"][name] > 0 for scene in found.values() for name in stages)
    assert re.search(r"seconds +(loading SymPy [\d.]+, )?reading [\d.]+, equations [\d.]+, rank of the rows", shown)


@needs_compiler
@pytest.mark.usefixtures("derived_once")
def test_check_tells_the_story_of_the_reduction(call: Gudgeon) -> None:
    """The press turns round two driven cranks: five angles and one row of the guide are left of 24 and 20."""
    document = call("check", "nine_bar_press", "-v", "--json").stdout
    found = json.loads(document)["scenes"]
    dry, film, ideal = found["dry"], found["lubricated"], found["ideal"]
    assert dry["formulation"] == "reduced" and sorted(dry["tree"]) == ["L2", "L3", "L6", "L7", "L8"]
    assert (dry["closures"], dry["driven"]) == (["guide.offset"], ["crank1", "crank4"])
    operations = dry["operations of the accelerations"]
    assert operations == {"full": dry["operations in dynamics"], "reduced": dry["operations in reduced_dynamics"]}
    assert dry["methods"] == ["rk4", "dop853", "dopri5", "rodas5p", "scipy:*", "sundials:*"]
    assert film["methods"] == ["rk4", "dop853", "dopri5", "rodas5p", "radau5", "radau9", "scipy:*", "sundials:*"]
    assert [scene["auto begins with"] for scene in (ideal, dry, film)] == ["kinematic", "dop853", "radau9"]
    shown = call("check", "nine_bar_press", "-v").stdout
    assert max(map(len, shown.splitlines())) <= 100
    ideal_told, dry_message = " ".join(shown.split()).split("scene dry ")
    assert "24 24 x, y and angle of every body; no joint has play 22 22 crank1, crank4 prescribe" in ideal_told
    assert "without masses, 2 of 2×2, 1 of 1×1 one after the other: L3 + L2, L7 + L6, L8" in ideal_told
    assert "24 20 A, B have play" in dry_message and "closures guide.offset: the row that stays" in dry_message
    assert "44 × 44 with 132 non-zeros" in dry_message and "→ 6 × 6 with 21" in dry_message
    fewer = f"{operations['full'] / operations['reduced']:.2g} times fewer"
    assert f"accelerations {operations['full']:,} → {operations['reduced']:,}, {fewer}" in dry_message
    assert "scene lubricated: as dry, but" in dry_message
    assert dry["story"]["steps"][-1]["coordinates left"] == 5 and dry["story"]["steps"][-1]["rows left"] == 1


@needs_compiler
def test_check_begins_a_new_table_where_a_line_is_full(
    call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Twelve scenes do not fit beside each other; none is cut off. They differ by numbers, and are derived once."""
    first = cache(lambda data, file: derive_kernel_source(data, file, "ideal"))
    monkeypatch.setattr(
        check, "derive_kernel_source", lambda data, file, scene, seconds: replace(first(data, file), scene=scene)
    )
    scenes = [f"scene_number_{k}" for k in range(12)]
    listed = "".join(f"  {name}: {{parameters: {{omega: {k + 1} rad/s}}}}\n" for k, name in enumerate(scenes))
    head, _, tail = TEXT.partition("scenes:\n")
    (tmp_path / "many.yaml").write_text(f"{head}scenes:\n{listed}{tail}")
    shown = call("check", "many.yaml", "-v").stdout
    assert max(map(len, shown.splitlines())) <= 100
    heads = [line.split() for line in shown.splitlines()[1:] if line.startswith("   ") and "scene_" in line]
    heads = [line for line in heads if set(line) <= {"ideal", *scenes, "worn"}]
    assert sum(heads, []) == ["ideal", *scenes, "worn"] and len(heads) > 1


@pytest.mark.parametrize("contour", ["16", f"[{', '.join(['0 mm'] * 15)}, 0.01 mm]"])
def test_check_and_draw_take_a_bearing_with_a_contour(contour: str, call: Gudgeon, pump: str) -> None:
    text = Path(pump).read_text().replace("contact: dry}}", f"contact: dry, contour: {contour}}}}}")
    Path("worn.yaml").write_text(text)
    for line in ("check worn.yaml", "draw worn.yaml -s worn -o x.svg"):
        done = call(*line.split())
        assert (done.exit_code, done.stderr) == (0, ""), line


def test_check_tells_the_place_of_every_mistake(call: Gudgeon, pump: str) -> None:
    broken = TEXT.replace("mass: 0.25 kg", "mass: -0.25 kg").replace("omega * t", "omegaa * t")
    Path(pump).write_text(broken)
    done = call("check", pump)
    assert done.exit_code == 2
    for text in ("mass: -0.25", "omegaa"):
        line = next(k for k, line in enumerate(broken.splitlines(), 1) if text in line)
        assert f"pump.yaml:{line}:" in done.stderr
    found = json.loads(call("check", pump, "--json").stdout)
    assert found["valid"] is False and len(found["errors"]) == 2
    assert all(error["line"] and error["column"] for error in found["errors"])


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_file_that_is_not_there(command: str, call: Gudgeon) -> None:
    for name in ("no/such.yaml", "nine_bar_pres"):
        done = call(command, name)
        assert done.exit_code == 2 and done.stderr.startswith("error: ")
    assert "nine_bar_press" in done.stderr
    assert "comes with gudgeon is called nine_bar_press" in call(command, "nine_bar_press.yaml").stderr


@needs_compiler
def test_emit_writes_c_again_and_again_but_never_over_other_files(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    assert call("emit", pump, "-o", "c", "--scene", "worn").exit_code == 0
    first = {path.name: path.read_bytes() for path in (tmp_path / "c/worn").iterdir()}
    assert any(name.endswith(".c") for name in first)
    assert call("emit", pump, "-o", "c").exit_code == 0
    assert {path.name: path.read_bytes() for path in (tmp_path / "c/worn").iterdir()} == first
    (tmp_path / "c/worn/notes.txt").write_text("mine")
    done = call("emit", pump, "-o", "c")
    assert done.exit_code == 2 and "notes.txt" in done.stderr
    (tmp_path / "c/worn/notes.txt").unlink()
    (tmp_path / "c/worn/scene.c").write_text("/* changed by hand */\n")
    done = call("emit", pump, "-o", "c")
    assert done.exit_code == 2 and "scene.c" in done.stderr
    (tmp_path / "d/ideal").mkdir(parents=True)
    (tmp_path / "d/ideal/scene.c").write_text("int main(void) { return 0; }\n")
    done = call("emit", pump, "-o", "d")
    assert done.exit_code == 2 and "scene.c" in done.stderr
    assert written(tmp_path / "d") == {"ideal/scene.c"}


def test_equations_wants_a_known_suffix(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("equations", pump, "-o", "x.pdf")
    assert done.exit_code == 2 and ".tex" in done.stderr
    assert written(tmp_path) == set()


@pytest.mark.parametrize(
    "line",
    [
        "equations PUMP -o FILE/x.tex",
        "equations PUMP -o LONG.tex",
        "equations PUMP -o LONG/x.html",
        "draw PUMP -o LONG.svg",
        "draw PUMP -o FILE/x.svg",
        "draw PUMP -o x.gif",
        "draw pipe.yaml",
        "emit PUMP -o FILE",
        "emit PUMP -o FILE/x",
        "emit PUMP -o LONG",
        "run PUMP --out FILE",
        "run PUMP --out LONG",
        "run PUMP --out x/LONG/y",
        "run LONG.yaml",
        "check LONG.yaml",
        "bench PUMP --csv LONG.csv",
        "map PUMP --csv FILE/x.csv",
        "map PUMP --out LONG",
        "run /dev/zero",
        "check /dev",
        "check pipe.yaml",
        "emit pipe.yaml -o c",
        "equations pipe.yaml -o x.txt",
    ],
)
def test_names_that_cannot_be_are_told(line: str, call: Gudgeon, pump: str, tmp_path: Path) -> None:
    """A file in a folder's place, a name too long, a file that is none: a sentence, exit code 2, nothing written."""
    (tmp_path / "FILE").write_text("mine")
    os.mkfifo(tmp_path / "pipe.yaml")
    done = call(*line.replace("PUMP", pump).replace("LONG", "n" * 300).split())
    assert done.exit_code == 2 and done.stderr.startswith("error: "), done.output
    assert isinstance(done.exception, SystemExit) and len(done.stderr) < 600
    assert written(tmp_path) == {"FILE"} and (tmp_path / "FILE").read_text() == "mine"
    assert sorted(os.listdir(tmp_path)) == ["FILE", "pipe.yaml", "pump.yaml"]


@pytest.mark.parametrize(
    ("name", "value"), [("CC", "'gcc"), ("GUDGEON_CACHE", "~no-such-user"), ("GUDGEON_CACHE", "~no-such-user/x")]
)
def test_a_variable_that_cannot_be_is_told(
    name: str, value: str, call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(name, value)
    done = call("run", "pendulum", "--t-end", "0.01")
    assert done.exit_code == 2 and name in done.stderr and value in done.stderr, done.output
    assert isinstance(done.exception, SystemExit) and written(tmp_path) == set()


def test_version_and_help(call: Gudgeon) -> None:
    assert call("--version").stdout == f"gudgeon {gudgeon.__version__}\n"
    every = [one.strip() for one in call("--help").stdout.partition("Commands:")[2].splitlines()]
    assert "to x.fmu as an FMU (FMI 3.0) of a scene." in " ".join(every) and not any(x.endswith("...") for x in every)


def test_stress_is_another_name_of_map(call: Gudgeon, pump: str) -> None:
    """Listed once, and the same but for a word on its end: what it was called before."""
    shown = call("--help").stdout
    assert " map " in shown and "stress" not in shown
    assert call("stress", "--help").stdout.splitlines()[4:] == call("map", "--help").stdout.splitlines()[4:]
    message = [call(name, pump, "--range", "c=1mm..2mm") for name in ("map", "stress")]
    assert message[1].stderr == f"warning: {STRESS}\n{message[0].stderr}" and [done.exit_code for done in message] == [
        2,
        2,
    ]
    assert (stress.stress, stress.stress_box) == (maps.compute_verdict_map, maps.compute_verdict_box)


def test_schema_is_json_schema(call: Gudgeon) -> None:
    done = call("schema")
    assert done.exit_code == 0
    document = json.loads(done.stdout)
    assert document["$schema"].endswith("2020-12/schema")
    assert {"bodies", "joints", "forces", "scenes"} <= set(document["properties"])


class Screen(io.StringIO):
    """A terminal that keeps what is written to it."""

    def isatty(self) -> bool:
        return True


@needs_compiler
def test_a_terminal_is_told_what_is_derived_and_compiled(
    pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """64 bars showed nothing for 9 s. The line is gone at the end; a warm start and a pipe have none."""
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cold"))
    monkeypatch.setattr("gudgeon.loading.build._libraries", {})  # another test of this process may have the library
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")

    def shown(task: Callable[[], object], screen: io.StringIO) -> str:
        with monkeypatch.context() as context:
            context.setattr(sys, "stderr", screen)
            task()
        return screen.getvalue()

    tasks: list[tuple[Callable[[], object], list[str]]] = [
        (lambda: emit_c(pump, tmp_path / "c", ("worn",)), ["deriving pump, scene worn"]),
        (
            lambda: load_scenes(MeasurementRequest(pump, ("ideal",))),
            ["deriving pump, scene ideal", "compiling pump, scene ideal"],
        ),
    ]
    for task, message in tasks:
        cold = shown(task, Screen())
        plain = re.sub(r"\x1b\[[?0-9;]*[A-Za-z]", "\n", cold)
        assert list(dict.fromkeys(re.findall(r"\w+ \w+, scene \w+", plain)))[: len(message)] == message
        assert "\x1b[2K" in cold and not re.search(r"\x1b\[[0-9;]*m", cold)
        assert shown(task, Screen()) == ""
    equations = partial(write_equations, pump, tmp_path / "x.txt", ("worn",))
    for anew, scene in ((equations, "worn"), (lambda: check_mechanism(pump, True, False), "ideal")):
        assert f"deriving pump, scene {scene}" in shown(anew, Screen())
        assert shown(anew, io.StringIO()) == ""


@needs_compiler
@pytest.mark.parametrize("line", ["run PUMP --t-end 1ms --output 2 --scene ideal", "check PUMP", "draw PUMP -o x.svg"])
def test_quiet_leaves_files_and_errors(line: str, call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch) -> None:
    words = line.replace("PUMP", pump).split()
    assert call(*words).stdout
    monkeypatch.setattr("gudgeon.commands.progress.is_terminal", lambda: True)
    files = {path.name for path in Path().rglob("*") if path.is_file()}
    done = call(*words, "--quiet")
    assert (done.exit_code, done.stdout, done.stderr) == (0, "", "")
    assert {path.name for path in Path().rglob("*") if path.is_file()} == files
    wrong = call(*words, "-q", "--laws", "none.py")
    assert wrong.exit_code == 2 and not wrong.stdout and wrong.stderr.startswith("error: ")
    if words[0] != "draw":
        message, quietly = (json.loads(call(*words, *more).stdout) for more in (["--json"], ["--json", "--quiet"]))
        assert message.keys() == quietly.keys()


@pytest.mark.parametrize(
    ("line", "files"),
    [
        ("new engine", {"mechanism": "engine.yaml"}),
        ("new many --study", {"study": "many.yaml"}),
        ("draw PUMP -o x.svg", {"picture": "x.svg"}),
        ("emit PUMP -o c -s worn", {"worn": "c/worn", "engine": "c/engine"}),
        ("equations PUMP -o x.txt -s worn", {"equations": "x.txt"}),
    ],
)
def test_files_that_are_written_are_told_as_json(line: str, files: dict[str, str], call: Gudgeon, pump: str) -> None:
    done = call(*line.replace("PUMP", pump).split(), "--json")
    message = json.loads(done.stdout)
    assert done.exit_code == 0 and message["files"] == files and all(Path(name).exists() for name in files.values())
    assert all(isinstance(note, str) for note in message["notes"])
    if line.startswith("equations"):
        shown = json.loads(call("equations", pump, "-o", "-", "-s", "worn", "--json").stdout)
        assert shown == {"files": {}, "notes": [], "equations": Path("x.txt").read_text().removesuffix("\n")}
    more = ["--like", "x"] if line.startswith("new") else []
    wrong = call(*line.replace("PUMP", "nowhere.yaml").split(), "--json", *more)
    assert wrong.exit_code == 2 and not wrong.stdout and wrong.stderr.startswith("error: ")
