"""The JSON Schema: what reads is valid, shapes that do not read are invalid, and it is a schema."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from gudgeon.generator.format.sections import DRIVES
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.kinds.laws.law import find_all_laws
from gudgeon.generator.targets.json_schema import make_schema
from gudgeon.generator.yaml import Items, Map, Text, parse_yaml
from tests.mechanisms.invalid import MISTAKES

jsonschema = pytest.importorskip("jsonschema")

MECHANISMS = Path(__file__).resolve().parents[1] / "mechanisms"
SHIPPED = Path(str(resources.files("gudgeon.mechanisms")))
FILES = [*sorted(SHIPPED.rglob("*.yaml")), *sorted((MECHANISMS / "valid").glob("*.yaml"))]


def plain(node: Any) -> Any:
    """Our tree as JSON would hold it."""
    if isinstance(node, Map):
        return {str(key): plain(value) for key, value in node.items()}
    if isinstance(node, Items):
        return [plain(value) for value in node]
    assert isinstance(node, Text)
    return None if node.is_null else str(node)


def read(path: Path) -> Any:
    return plain(parse_yaml(path.read_bytes(), path.name))


@pytest.fixture(scope="module")
def validator() -> Any:
    return jsonschema.Draft202012Validator(make_schema())


def test_it_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(make_schema())
    assert json.loads(json.dumps(make_schema())) == make_schema()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_reads_is_valid(path: Path, validator: Any) -> None:
    validator.validate(read(path))


def test_as_an_editor_reads_it(validator: Any) -> None:
    """YAML's own numbers and booleans, where no comma stands in parentheses."""
    path = MECHANISMS / "valid" / "slider_crank.yaml"
    validator.validate(YAML(typ="safe", pure=True).load(path.read_text()))


# rows of tests/mechanisms/invalid.py whose mistake is one of shape
SHAPES = (
    "axis_missing drive_without_value event_unknown_action event_unknown_key event_unknown_word event_without_zero "
    "format_missing format_of_the_future law_in_wrong_role law_number_missing "
    "list_for_number name_no_identifier no_bodies number_for_mapping peaks_without_names point_without_body "
    "start_unknown_coordinate "
    "three_points two_joint_types unknown_joint_type unknown_key unknown_law unknown_option unknown_section "
    "value_missing vector_of_three yaml_null"
)


@pytest.mark.parametrize("name", SHAPES.split())
def test_wrong_shapes_are_invalid(name: str, validator: Any) -> None:
    (mistake,) = (row for row in MISTAKES if row.name == name)
    assert not validator.is_valid(plain(parse_yaml(mistake.data, mistake.file)))


def test_every_kind_is_in_it() -> None:
    """What a new file in joints/, force_elements/ or forces/ declares is in the schema without further ado."""
    text = json.dumps(make_schema())
    for kind in (*find_joint_types(), *find_element_types(), *find_all_laws(), *DRIVES):
        assert f'"{kind}"' in text
    for role in (law.role for law in find_all_laws().values()):
        assert f"{role}_whole" in make_schema()["$defs"]
