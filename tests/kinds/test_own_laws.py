"""Laws of the user's own: how they are made known, what they may not do, what the cache keeps under which key."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import InputError, LawError, UnknownNameError
from gudgeon.generator.kinds.laws import registered
from gudgeon.generator.kinds.laws.law import Law, find_all_laws, find_laws_of_role
from gudgeon.generator.pipeline import derive_scene, generate_kernel_source
from gudgeon.generator.targets.json_schema import make_schema
from gudgeon.generator.targets.latex import render_equations_text
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.studies.show.map import list_law_display_paths
from tests.kinds.own import example_text, forgotten
from tests.programs import needs_compiler
from tests.pump import Gudgeon

TEXT = """\
format: gudgeon/1
name: disc
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {disc: {mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
freedoms: 1
parameters: {radius: 15 mm, speed: 3 m/s}
joints: {pin: {revolute: [ground.O, disc.com]}}
start: {rates: {disc.omega: speed/radius}}
bearings: {b: {radius: radius, clearance: 1 mm, length: 40 mm, bearing_material: steel, journal_material: steel}}
contacts: {wall: {normal: {law: dashpot, stiffness: 1e6 N/m, damping: 50 N*s/m}}}
scenes: {wall: {play: {pin: {bearing: b, contact: wall}}, simulate: {t_end: 1 ms, output: 4}}}
"""
BUILD = '    return {"F_n": K * s.variables["delta"] + D * s.variables["deltadot"]}\n'
SP = "    import sympy as sp\n"
DERIVED = '    return {"F_n": s.derive("h", K * s.variables["delta"], "x")}\n'


@pytest.fixture(autouse=True)
def alone() -> Iterator[None]:
    with forgotten():
        yield


@pytest.fixture
def disc(tmp_path: Path) -> Path:
    (tmp_path / "disc.yaml").write_text(TEXT, encoding="utf-8")
    return tmp_path / "disc.yaml"


def law_file(folder: Path, old: str = "", new: str = "") -> Path:
    """The example with a change."""
    assert old in example_text()
    (folder / "dashpot.py").write_text(example_text().replace(old, new, 1), encoding="utf-8")
    return folder / "dashpot.py"


def test_without_it_the_name_is_unknown_and_what_to_do_is_told(disc: Path) -> None:
    with pytest.raises(UnknownNameError, match=r"unknown normal law 'dashpot'\n(.*\n)*.*--laws FILE.py") as error:
        derive_scene(disc.read_bytes(), str(disc), "wall")
    assert error.value.where is not None and error.value.where.line == 11


@pytest.mark.parametrize("name", ["memory", "g", "corner", "side_1", "F_n_out", "double", "lambda", "bent"])
def test_names_of_emitted_code_do_not_change_a_number(name: str, disc: Path) -> None:
    """An abbreviation, a number and a derived number that are called as something in the C, or as a keyword."""
    found = []
    for word in ("plain", name):
        with forgotten():
            step = f'''    x = sp.Symbol("{word}", real=True)
    own = s.derive("{word}_too", K * 2, "x")
    return {{"{word}": own * s.variables["delta"], "F_n": x / 2 + D * s.variables["deltadot"]}}
'''
            gudgeon.register(law_file(disc.parent, BUILD, SP + step))
            q = np.array([1.2e-3, 0.3e-3, 0.1])
            scene = gudgeon.load(disc, scene="wall")
            found.append(scene.rhs(0.0, np.concatenate([q, [0.2, -0.1, 3.0]])))
    np.testing.assert_array_equal(found[1], found[0])
    assert np.abs(found[0]).max() > 10.0


def test_a_name_that_ends_as_those_of_emitted_code_is_refused(disc: Path) -> None:
    with pytest.raises(LawError, match="'a_' ends in '_'") as error:
        gudgeon.register(law_file(disc.parent, BUILD, '    return {"a_": K, "F_n": K * s.variables["delta"]}\n'))
        derive_scene(disc.read_bytes(), str(disc), "wall")
    assert error.value.hint.startswith("write a;")


def test_among_the_laws_it_is_the_last(disc: Path) -> None:
    before = list(find_laws_of_role("normal"))
    gudgeon.register(law_file(disc.parent))
    assert list(find_laws_of_role("normal")) == [*before, "dashpot"] and "dashpot" not in before


def test_everything_follows_from_it(disc: Path) -> None:
    law = gudgeon.register(law_file(disc.parent))
    assert find_all_laws()["dashpot"] is law
    source = generate_kernel_source(disc.read_bytes(), str(disc), "wall")
    text = "".join(source.files.values())
    assert "static inline void own_dashpot__(double delta, double ratio, double deltadot, double stiffness__" in text
    assert {slot.address for slot in source.parameters} >= {
        "contacts.wall.normal.stiffness",
        "contacts.wall.normal.damping",
    }
    assert next(s for s in source.parameters if s.address.endswith("damping")).unit == "kg/s"
    shown = render_equations_text(derive_scene(disc.read_bytes(), str(disc), "wall"))
    assert "W. Goldsmith, Impact (1960)" in shown and "F_n = δ·K + δ̇·D" in shown
    assert "dashpot" in json.dumps(make_schema()) and list_law_display_paths() == [str(disc.parent / "dashpot.py")]


def test_a_number_without_a_symbol_is_called_by_its_name(disc: Path) -> None:
    gudgeon.register(law_file(disc.parent, ', symbol="K"'))
    assert "F_n = δ·stiffness + δ̇·D" in render_equations_text(derive_scene(disc.read_bytes(), str(disc), "wall"))


WRONG = [
    ("return {", "raise SystemExit(0)\n    return {", r"law dashpot: build raised SystemExit: 0"),
    ("LAW = Law(", "class Odd(BaseException): pass\nraise Odd\nLAW = Law(", r"the law cannot be read: Odd"),
    ("build=build,", "build=build, also=None,", r"law dashpot: the declaration is invalid: TypeError"),
    ('"F_n": K', '"F_n": J', r"dashpot.py:8:1: law dashpot: build raised NameError: name 'J' is not defined"),
    ('s.parameters["damping"]', 's.parameters["dumping"]', r"(?s)build raised KeyError: 'dumping'.*stiffness, damping"),
    ("build=build,", "build=build, role_='x',", r"dashpot.py:11:1: the law cannot be read: TypeError: .*role_"),
    ("def build(s):", "def build(s)", r"dashpot.py:6:13: the law cannot be read: SyntaxError: expected ':'"),
    ("LAW = Law(", "MINE = Law(", r"(?s)dashpot.py has no LAW.*expected LAW = Law\("),
    ("LAW = Law(", "LAW = 3\nMINE = Law(", r"dashpot.py has a LAW of type int"),
    ("from gudgeon.language", "raise SystemExit\nfrom gudgeon.language", r"dashpot.py:3:1: .*SystemExit"),
    ('"normal"', '"tangential"', r"(?s)dashpot.py: law dashpot: unknown role 'tangential'.*normal, friction, film"),
    ('name="dashpot"', 'name="hertz"', "law hertz: hertz is the name of a law of gudgeon"),
    ('name="dashpot"', 'name="flores"', "flores is the name of a law of gudgeon"),
    ('name="dashpot"', 'name="dash pot"', "'dash pot' cannot name this law: it is not an identifier"),
    ('"stiffness", "force', '"damping", "force', "'damping' names two keys"),
    ('"stiffness", "force', '"law", "force', "'law' names two keys"),
    ("bounds=POSITIVE)", "varies='t')", "stiffness is not a key of a law"),
    (BUILD, "    return K * 3\n", r"(?s)build returns \w+, not forces by name.*expected \{'F_n'"),
    (BUILD, '    return {"F_t": K}\n', "build returns no F_n"),
    (BUILD, '    return {"F_n": "K"}\n', "F_n is of type str"),
    (BUILD, '    return {"F_n": K > 0}\n', "F_n is of type"),
    (BUILD, SP + '    return {"F_n": K * sp.Symbol("w")}\n', r"(?s)F_n uses the symbol w\n.*delta, ratio"),
    (BUILD, SP + '    return {"a": K, "F_n": sp.Symbol("a")}\n', r"(?s)uses the symbol a\n.*real=True"),
    (BUILD, SP + '    return {"F_n": sp.gamma(K)}\n', r"(?s)F_n uses gamma, .*Min, Max"),
    (
        BUILD,
        SP + '    return {"F_n": sp.Piecewise((K, s.variables["delta"] > 1), (D, True))}\n',
        "F_n uses Piecewise",
    ),
    (BUILD, SP + '    return {"F_n": K * sp.sqrt(-1)}\n', "F_n is not real"),
    (BUILD, SP + '    return {"F_n": K * sp.zoo}\n', "F_n is not finite"),
    (
        BUILD,
        '    return {"F_n": K * s.pair.c**2 / s.variables["delta"]}\n',
        r"F_n is inf at delta = 0 m, ratio = 1, with the file's",
    ),
    (BUILD, '    return {"F_n": K * s.variables["ratio"] ** 0.5 * s.pair.c}\n', r"F_n is nan at .*ratio = -0.4"),
    (BUILD, '    return {"F_n": K * s.variables["deltadot"]}\n', r"F_n is a quantity .*expected a force \(N\)"),
    (
        BUILD,
        '    return {"F_n": 1e6 * s.variables["delta"]}\n',
        r"(?s)F_n is a length .*declare a number with a unit as a field",
    ),
    (
        BUILD,
        '    return {"F_n": K * s.variables["delta"] + D * s.variables["delta"]}\n',
        r"F_n adds a .* and .*: D\*delta \+ K\*delta|F_n adds .*: damping\*delta \+ delta\*stiffness",
    ),
    (
        BUILD,
        '    return {"F_n": K * (s.variables["delta"] + 1)}\n',
        r"(?s)F_n adds a length \(m\) and 1, a pure number: delta \+ 1.*as a field of the law",
    ),
    (
        BUILD,
        SP + '    return {"F_n": sp.Max(K * s.variables["delta"], 1e-9)}\n',
        r"F_n takes Max of a force \(N\) and 1e-09, a pure number",
    ),
    (BUILD, SP + '    return {"F_n": K * s.pair.c * sp.exp(s.variables["delta"])}\n', "has an exponent of a length"),
    (BUILD, SP + '    return {"F_n": K * s.pair.c * sp.sin(s.variables["delta"])}\n', "F_n has sin of a length"),
    ("STIFFNESS, symbol", "'N/m', symbol", "(?s)the dimension of stiffness is 'N/m'.*expected one of"),
    ("required=True", "default=0.0", "the default of stiffness is 0.0, which violates its bound > 0.0"),
    ("required=True", "default='1 N/m'", "(?s)the default of stiffness is '1 N/m'.*expected a number in SI units"),
    ("required=True", "default=float('nan')", "the default of stiffness is nan"),
    ("bounds=POSITIVE)", "bounds=3)", "the bounds of stiffness are not a tuple of Bound"),
    ("bounds=POSITIVE)", "bounds=(Bound('>>', 0.0),))", "a bound of stiffness is invalid: '>>' 0.0"),
    ("fields=(", "fields=(word('mode', 'how', ('a', 'b'), 'c'),", "(?s)the default of mode is 'c'.*: a, b"),
    (BUILD, DERIVED, r"derive\('h', …\) uses the symbol delta"),
    (BUILD, '    return {"damping": K, "F_n": K}\n', "build returns 'damping', which is an input"),
    (BUILD, '    return {"delta": K, "F_n": K}\n', "build returns 'delta', which is an input"),
]


@pytest.mark.parametrize(("old", "new", "message"), WRONG)
def test_what_it_may_not_be_is_told(
    old: str, new: str, message: str, disc: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(disc.parent)
    file = law_file(disc.parent, old, new)
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("import POSITIVE, number", "import POSITIVE, Bound, number, word"), encoding="utf-8")
    with pytest.raises(LawError, match=message) as error:
        gudgeon.register("dashpot.py")
        derive_scene(disc.read_bytes(), str(disc), "wall")
    assert error.value.exit_code == 2 and "dashpot.py" in str(error.value)


def test_files_that_are_none(tmp_path: Path) -> None:
    for name in ("nowhere.py", "."):
        with pytest.raises(LawError, match="cannot read the law"):
            gudgeon.register(tmp_path / name)
    with pytest.raises(InputError, match="law is 3"):
        gudgeon.register(3)  # type: ignore[arg-type]


def test_names_of_two_laws(tmp_path: Path) -> None:
    """Edited it may be registered again; another file's, or one that is made here, is another law."""
    (tmp_path / "other").mkdir()
    first = gudgeon.register(law_file(tmp_path))
    key = registered.find_law_key("dashpot")
    gudgeon.register(law_file(tmp_path, "D * s", "2 * D * s"))
    assert registered.find_law_key("dashpot") != key
    gudgeon.register(law_file(tmp_path))
    assert registered.find_law_key("dashpot") == key
    for other in (law_file(tmp_path / "other"), first):
        with pytest.raises(LawError, match="another law of this name is registered from .*dashpot.py"):
            gudgeon.register(other)
    with pytest.raises(LawError, match="dashpot is the name of another registered law"):
        gudgeon.register(replace(first, name="second", also={"dashpot": {}}))


def test_the_key_of_a_law_is_what_it_derives_to() -> None:
    """One made in Python: the same for the same law, another one for another number in a closure."""

    def made(factor: int) -> Law:
        def build(s: object) -> dict[str, object]:
            return {"F_n": factor * s.parameters["stiffness"] * s.variables["delta"]}  # type: ignore[attr-defined]

        return replace(find_all_laws()["kelvin_voigt"], name="made", build=build)

    keys = []
    for factor in (2, 3, 2):
        gudgeon.register(made(factor))
        keys.append(registered.find_law_key("made"))
    assert keys[0] == keys[2] != keys[1] and len(keys[0]) == 64


def test_what_a_file_imports_from_beside_it_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    law = law_file(tmp_path, "from gudgeon.generator.field", "import beside_a_law\nfrom gudgeon.generator.field")
    keys = []
    for text in ("K = 1\n", "K = 2\n"):
        (tmp_path / "beside_a_law.py").write_text(text, encoding="utf-8")
        sys.modules.pop("beside_a_law", None)
        gudgeon.register(law)
        keys.append(registered.find_law_key("dashpot"))
    sys.modules.pop("beside_a_law")
    assert keys[0] != keys[1]


def test_scenes_without_it_are_as_they_were(tmp_path: Path) -> None:
    """Its states and keys are nobody's names elsewhere."""
    data = find_shipped_file("slider_crank").read_bytes().replace(b"parameters:\n", b"parameters:\n  spam: 1 m\n", 1)
    data += b"  more: spam\n"
    before = generate_kernel_source(data, "f.yaml", "dry")
    text = (
        example_text()
        .replace('"normal"', '"friction"')
        .replace('"stiffness"', '"spam"')
        .replace(
            BUILD, '    z = s.variables["eggs"]\n    return {"F_t": K * z, "eggs_rate": s.variables["v_t"] + 0 * D}\n'
        )
        .replace("    build=build,\n", '    build=build,\n    states=(State("eggs", "what"),),\n')
    )
    (tmp_path / "dashpot.py").write_text(text.replace("import Law\n", "import Law, State\n"), encoding="utf-8")
    gudgeon.register(tmp_path / "dashpot.py")
    assert generate_kernel_source(data, "f.yaml", "dry") == before and before.laws == ()


def test_numbers_that_are_called_as_its_abbreviations(disc: Path) -> None:
    """A parameter `speed` and an abbreviation `speed` are two things."""
    steps = (
        SP
        + """    speed = sp.Symbol("speed", real=True)
    return {"speed": 2 * s.variables["deltadot"], "F_n": K * s.variables["delta"] + D * speed / 2}
"""
    )
    gudgeon.register(law_file(disc.parent, BUILD, steps))
    text = disc.read_text(encoding="utf-8").replace("50 N*s/m", "speed * 50 kg/m")
    model = derive_scene(text.encode(), "disc.yaml", "wall")
    law = model.clearances[0].normal
    assert law is not None and "speed" not in {symbol.name for symbol in model.parameter_table.list_symbols()}
    assert law.equations_by_name["speed__"] == 2 * law.variables[2]


def test_two_laws_of_one_contact_keep_their_abbreviations_apart(disc: Path) -> None:
    """Their slopes are one function of C."""
    both = (
        SP
        + """    a1 = sp.Symbol("a1", real=True)
    return {"a1": D * s.variables["deltadot"], "F_n": K * s.variables["delta"] + a1}
"""
    )
    gudgeon.register(law_file(disc.parent, BUILD, both))
    rubs = law_file(
        disc.parent,
        BUILD,
        SP
        + """    a1 = sp.Symbol("a1", real=True)
    return {"a1": D * s.variables["v_t"], "F_t": -a1 + 0 * K}
""",
    ).read_text(encoding="utf-8")
    (disc.parent / "rubs.py").write_text(
        rubs.replace('"normal"', '"friction"').replace('"dashpot"', '"rubs"'), encoding="utf-8"
    )
    gudgeon.register(disc.parent / "rubs.py")
    text = TEXT.replace("N*s/m}}", "N*s/m}, friction: {law: rubs, stiffness: 1 N/m, damping: 1 N*s/m}}")
    with pytest.raises(LawError, match="law dashpot: 'a1' is also a name in the contact's other law, rubs"):
        derive_scene(text.encode(), "disc.yaml", "wall")


@needs_compiler
def test_from_the_command_line(disc: Path, call: Gudgeon) -> None:
    law_file(disc.parent)
    for command in (
        ("check", "disc.yaml"),
        ("run", "disc.yaml"),
        ("emit", "disc.yaml", "-o", "c"),
        ("schema",),
        ("equations", "disc.yaml", "--scene", "wall", "-o", "disc.txt"),
    ):
        done = call(*command, "--laws", "dashpot.py")
        assert done.exit_code == 0, done.output
    assert "dashpot" in done.output or (disc.parent / "disc.txt").exists()
    law_file(disc.parent, BUILD, f'    print("deriving")\n{BUILD}').open("a").write('print("read")\n')
    done = CliRunner().invoke(app, ["run", "disc.yaml", "--json", "--laws", "dashpot.py"])
    assert done.exit_code == 0 and json.loads(done.stdout)["scenes"] and "read" in done.stderr
    law_file(disc.parent, BUILD, '    return {"F_n": 1 / 0}\n')
    done = CliRunner().invoke(app, ["check", "disc.yaml", "--laws", "dashpot.py"])
    assert done.exit_code == 2 and "error: dashpot.py:8:1: law dashpot: build raised ZeroDivisionError" in done.stderr
    assert "run as Python" in " ".join(CliRunner().invoke(app, ["run", "--help"]).output.replace("│", " ").split())


CODE = """
import sys
import gudgeon
gudgeon.register("dashpot.py")
disc = gudgeon.load("disc.yaml", "wall")
print(disc.loading.origin, *sys.modules)
"""


@pytest.mark.slow
@needs_compiler
def test_a_warm_start_runs_the_file_and_imports_no_sympy(disc: Path) -> None:
    def start() -> tuple[str, set[str]]:
        done = subprocess.run(
            [sys.executable, "-c", CODE],
            env={**os.environ, "GUDGEON_CACHE": str(disc.parent / "cache")},
            cwd=disc.parent,
            capture_output=True,
            text=True,
            check=True,
        )
        origin, *modules = done.stdout.split()
        return origin, set(modules)

    law_file(disc.parent)
    assert start()[0] == "derived"
    origin, modules = start()
    assert origin == "cache" and not modules & {"sympy", "jinja2", "ruamel.yaml", "cffi"}
    law_file(disc.parent, "D * s", "2 * D * s")
    assert start()[0] == "derived"
    law_file(disc.parent)
    assert start()[0] == "cache"


OTHER = """
import pickle, sys
import gudgeon
with open("disc.pickle", "rb") as file:
    disc, run = pickle.load(file)
again = disc.simulate(1e-3)
print((again.q == run.q).all())
try:
    disc.model
except gudgeon.InputError as error:
    print(error)
gudgeon.Result.load("disc.nc")
"""


@needs_compiler
def test_edited_it_is_another_one_and_other_processes_need_it_for_equations_alone(disc: Path) -> None:
    gudgeon.register(law_file(disc.parent))
    simulation = gudgeon.load(disc, "wall")
    run = simulation.simulate()
    run.save(disc.parent / "disc.nc")
    (disc.parent / "disc.pickle").write_bytes(pickle.dumps((simulation, run)))
    done = subprocess.run([sys.executable, "-c", OTHER], cwd=disc.parent, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("True\nthe law dashpot of this simulation is not registered in")
    gudgeon.register(law_file(disc.parent, "D * s", "2 * D * s"))
    with pytest.raises(InputError, match="the law dashpot of this simulation has changed"):
        simulation.full  # noqa: B018
    edited = gudgeon.load(disc, "wall")
    assert edited.source.files != simulation.source.files
    with pytest.raises(InputError, match="this state was computed with another law dashpot"):
        edited.simulate(2e-3, start=run.final)
