"""One declaration a field: it is whole, and reader, overrides, JSON Schema and the page of tables follow it."""

from __future__ import annotations

import importlib
import importlib.util
import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import gudgeon.generator.kinds.forces as forces
import gudgeon.generator.kinds.joints as joints
import gudgeon.generator.kinds.laws as laws
from gudgeon.errors import BadValueError, MissingKeyError, UnknownKeyError, UnknownNameError
from gudgeon.generator.equations.play import VELOCITY_FLOOR
from gudgeon.generator.field import BODY, FLAG, KINDS, LAW, MAPPING, NUMBER, RECORD, VECTOR, WORD, Field
from gudgeon.generator.format.sections import CONTACT, MECHANISM_FILE, SIMULATE
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.kinds.laws import law
from gudgeon.generator.mechanism import Mechanism
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.format_tables import print_format_tables
from gudgeon.generator.targets.json_schema import make_schema
from gudgeon.language.quantities import parse_quantity
from gudgeon.language.tree import evaluate
from gudgeon.model.default_step import T_END
from gudgeon.simulation.arguments import DEFAULT_OUTPUT

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "format.md"
CRANK = ROOT / "mechanisms" / "slider_crank.yaml"


def below(of: Field, path: str = "") -> Iterator[tuple[str, tuple[Field, ...]]]:
    """Every mapping with known keys in a declaration: where, and its fields."""
    if of.kind == RECORD:
        yield path, of.fields
        for field in of.fields:
            yield from below(field, f"{path}.{field.name}")
    elif of.kind == MAPPING and of.entry is not None:
        yield from below(of.entry, f"{path}.NAME")
    elif of.kinds is not None:
        yield from ((f"{path}({name})", kind.fields) for name, kind in of.kinds().items())


MAPPINGS = dict(below(MECHANISM_FILE))


def test_every_place_is_looked_at() -> None:
    kinds = [*find_joint_types(), *find_element_types(), *law.find_all_laws(), "angle", "coordinate", "distance"]
    assert [kind for kind in kinds if not any(f"({kind})" in path for path in MAPPINGS)] == []
    assert {"", ".start", ".scenes.NAME.simulate", ".scenes.NAME.play.NAME", ".bodies.NAME"} <= set(MAPPINGS)


@pytest.mark.parametrize("path", MAPPINGS)
def test_declarations_are_whole(path: str) -> None:
    fields = MAPPINGS[path]
    names = [field.name for field in fields]
    assert len(set(names)) == len(names)
    for field in fields:
        assert field.meaning and not field.meaning.endswith(".")
        specified = field.required + (field.default is not None) + bool(field.otherwise)
        assert (
            specified == 1 if path.endswith(")") else specified <= 1
        )  # one says what holds; of joints, forces, laws one does
        assert all(bound.limit in names for bound in field.bounds if isinstance(bound.limit, str))
        assert not field.bounds or field.kind in (NUMBER, VECTOR)
        assert (field.kind in (WORD, FLAG)) == bool(field.values) and (field.kind in (KINDS, LAW)) == bool(field.kinds)
        if field.kind in (WORD, FLAG) and not field.required:
            assert field.default_option in field.values
        elif field.kind == BODY:
            assert field.default_option == "ground"


def test_what_is_said_to_hold_otherwise_does() -> None:
    specified = {field.name: field.otherwise for field in (*SIMULATE.fields, *CONTACT.fields)}
    assert parse_quantity(specified["t_end"], "t_end", (0, 0, 1)) == T_END
    assert float(specified["output"]) == DEFAULT_OUTPUT
    assert parse_quantity(specified["velocity_floor"], "velocity_floor", (1, 0, -1)) == VELOCITY_FLOOR


def test_the_page_is_current() -> None:
    """If this fails: make tables."""
    spec = importlib.util.spec_from_file_location("tables", ROOT / "tools" / "tables.py")
    assert spec is not None and spec.loader is not None
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    text = PAGE.read_text(encoding="utf-8")
    assert tool.replace_generated_part(text, tool.PAGES["format.md"]()) == text
    assert text.count("\n| ") > 100


JOINT = """
from gudgeon.generator.field import POSITIVE, flag, number
from gudgeon.generator.kinds.joints.joint_type import JointType
from gudgeon.language.units import LENGTH

FIELDS = (number("reach", "how far it reaches", LENGTH, required=True, bounds=POSITIVE), flag("bent", "whether it is"))
JOINT = JointType(
    "strut", "a strut", FIELDS, "", ("length",), ("m",),
    lambda first, second, fields: [first.x - second.x + fields.quantity("reach", 0)], __doc__,
)
"""
FORCE = """
import sympy as sp
from gudgeon.generator.field import OF_MOTION, number, word
from gudgeon.generator.kinds.forces.force_type import ElementType, Load, Loads
from gudgeon.language.units import FORCE

def build(targets, fields):
    push = fields.quantity("push") * (1 if fields.option("way") == "right" else -1)
    return Loads((Load(0, push, sp.Integer(0), sp.Integer(0)),), sp.Integer(0), push * targets[0].velocity[0], {})

FIELDS = (
    number("push", "how hard it pushes", FORCE, required=True, varies=OF_MOTION),
    word("way", "which way", ("right", "left"), "right"),
)
ELEMENT = ElementType("fan", "a fan", "points", (1,), FIELDS, (), build, __doc__)
"""
LAW_FILE = """
from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.language.units import DIMENSIONLESS, STIFFNESS

def build(s):
    import sympy as sp
    spring, loss = s.parameters["spring"], s.parameters["loss"]
    return {"F_n": spring * s.variables["delta"] * sp.Max(1 + loss * s.variables["ratio"], 0)}

LAW = Law(
    "lossy_spring", "normal", "a spring that loses", "a test", "never",
    (
        number("spring", "force by penetration", STIFFNESS, symbol="K", required=True, bounds=(Bound(">", 0.0),)),
        number("loss", "of what is lost", DIMENSIONLESS, symbol="a", default=0.25, bounds=(Bound(">=", 0.0),)),
    ),
    build,
)
"""


@pytest.fixture
def one_file_each(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A joint, a force element and a law more: a file in the folder of each, and nothing else."""
    caches = (find_joint_types, find_element_types, law.find_bundled_laws)
    for package, name, text in (joints, "strut", JOINT), (forces, "fan", FORCE), (laws, "lossy_spring", LAW_FILE):
        folder = tmp_path / name
        folder.mkdir()
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
        monkeypatch.setattr(package, "__path__", [*package.__path__, str(folder)])
    for cache in caches:
        cache.cache_clear()
    yield
    for package, name in (joints, "strut"), (forces, "fan"), (laws, "lossy_spring"):
        sys.modules.pop(f"{package.__name__}.{name}", None)
    for cache in caches:
        cache.cache_clear()


TEXT = CRANK.read_text(encoding="utf-8")
assert TEXT.count("\njoints:\n") == 1 and TEXT.count("law: lankarani_nikravesh, restitution: 0.9") == 1
WITH = TEXT.replace("\njoints:\n", "\nforces: {wind: {fan: rod.head, push: 2 N * sin(t*1 rad/s)}}\njoints:\n")
WITH = WITH.replace("law: lankarani_nikravesh, restitution: 0.9", "law: lossy_spring, spring: 1 kN/mm")
STRUT = WITH.replace("\njoints:\n", "\njoints:\n  bar: {strut: [ground.O, rod.head], reach: 20 cm}\n")


def read(text: str, **overrides: str | float | bool) -> Mechanism:
    return read_mechanism(text.encode(), "f", {name.replace("__", "."): value for name, value in overrides.items()})


def value(mechanism: Mechanism, name: str) -> float:
    (found,) = (q for thing in mechanism.joints.values() for q in thing.quantities.values() if q.address == name)
    return float(evaluate(found.value, dict[str, float]().__getitem__))


@pytest.mark.usefixtures("one_file_each")
def test_the_reader_reads_by_it() -> None:
    mechanism = read(STRUT)
    assert value(mechanism, "joints.bar.reach") == 0.2
    assert mechanism.joints["bar"].options == {"bent": "false"}
    assert mechanism.forces["wind"].options == {"way": "right"}
    normal = mechanism.scenes["dry"].play["wristpin"].contact.normal
    assert normal is not None and normal.law == "lossy_spring" and set(normal.quantities) == {"spring", "loss"}
    with pytest.raises(MissingKeyError, match="joints.bar has no reach"):
        read(STRUT.replace(", reach: 20 cm", ""))
    with pytest.raises(UnknownKeyError, match="did you mean 'reach'"):
        read(STRUT.replace("reach: 20 cm", "reech: 20 cm"))
    with pytest.raises(BadValueError, match=r"joints.bar.reach is -0.2 m: reach is positive"):
        read(STRUT.replace("reach: 20 cm", "reach: -20 cm"))


@pytest.mark.usefixtures("one_file_each")
def test_overrides_resolve_by_it() -> None:
    changed = read(STRUT, joints__bar__reach="30 cm", joints__bar__bent=True, forces__wind__way="left")
    assert value(changed, "joints.bar.reach") == 0.3
    assert changed.joints["bar"].options == {"bent": "true"} and changed.forces["wind"].options == {"way": "left"}
    with pytest.raises(UnknownNameError, match=r"unknown address 'joints.bar.bent.x'"):
        read(STRUT, joints__bar__bent__x=1)


@pytest.mark.usefixtures("one_file_each")
def test_schema_and_page_show_it() -> None:
    text, page = json.dumps(make_schema()), print_format_tables()
    for words in ("how far it reaches", "whether it is", "how hard it pushes", "which way", "force by penetration"):
        assert words in text and words in page
    assert "| `loss` | number, no unit or an angle | `0.25` | >= 0 | of what is lost |" in page


@pytest.mark.usefixtures("one_file_each")
def test_equations_follow() -> None:
    model = derive_scene(WITH.encode(), "f", "dry")
    assert [clearance.normal.law.name for clearance in model.clearances if clearance.normal] == ["lossy_spring"]
    assert "wind" in model.elements


def test_the_scene_that_is_always_there_may_be_brought_in() -> None:
    text = TEXT[: TEXT.index("\nscenes:")] + "\n"
    simulate = read(text, scenes__ideal__simulate__t_end="2 s").scenes["ideal"].simulate
    assert simulate["t_end"].address == "scenes.ideal.simulate.t_end"
    for address in ("scenes__dry__simulate__t_end", "scenes"):
        with pytest.raises(UnknownNameError, match="unknown address 'scenes"):
            read(text, **{address: 1})


def test_a_parameter_named_like_an_axis_is_no_axis() -> None:
    changed = read(TEXT.replace("\nparameters:", "\nparameters:\n  x: 1 m"), scenes__dry__parameters__x="2 m")
    assert set(changed.scenes["dry"].parameters) == {"x"}
