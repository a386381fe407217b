"""Reads YAML text into a frozen Mechanism or Scene, section by section, without SymPy."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from time import perf_counter

from gudgeon.errors import BadValueError
from gudgeon.generator.format.overrides import apply_overrides
from gudgeon.generator.format.sections import OUTPUT, SECTIONS
from gudgeon.generator.mechanism import Mechanism, Quantity, Scene, make_scene
from gudgeon.generator.reader.bodies import read_bodies, read_gravity, read_ground, read_start
from gudgeon.generator.reader.checks import check_values
from gudgeon.generator.reader.collector import Reader, TooManyErrors
from gudgeon.generator.reader.contacts import read_bearings_and_guides, read_contacts
from gudgeon.generator.reader.curves import read_curves
from gudgeon.generator.reader.declared_names import read_declared_names
from gudgeon.generator.reader.drives import read_drives
from gudgeon.generator.reader.expressions import read_expressions
from gudgeon.generator.reader.joints_and_forces import read_forces, read_joints
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.parameters import infer_dimensions, read_parameters
from gudgeon.generator.reader.scenes import SceneParts, check_peaks, read_events, read_scenes
from gudgeon.generator.yaml import Map, describe_node, parse_yaml
from gudgeon.language.names import check_name
from gudgeon.language.tree import Number

_MAX_TITLE = 200
# no control characters, line ends or marks that change the direction of the text after them
_VISIBLE_CHARACTERS = r"\x20-\x7e\u00a0-\u2027\u202f-\u2065\u206a-\ud7ff\ue000-\uffef\U00010000-\U0010ffff"


def read_mechanism(data: bytes, file: str, overrides: Mapping[str, str | float | bool] | None = None) -> Mechanism:
    """Return the mechanism that a file describes, after all checks that need no equations.

    data: the file's bytes; file: its name, for messages and for `Mechanism.file`; overrides: address -> text or number
    that replaces the file's value there; None for none. Raises an InputError at file:line:column, or InputErrors with
    all errors of the file (at most MAX_ERRORS).
    """
    reader = Reader(file)
    root = apply_overrides(parse_yaml(data, file, reader.errors), overrides or {})
    try:
        mechanism = _read_sections(reader, reader.remove_invalid_entries(root), hashlib.sha256(data).hexdigest())
    except TooManyErrors:
        mechanism = None
    reader.raise_errors()
    assert mechanism is not None
    return mechanism


def _read_sections(reader: Reader, root: Map, sha256: str) -> Mechanism:
    """Read all sections of the tree and return the mechanism; errors are collected in the reader.

    Names are read first, so that sections can refer to each other. Values and conditions are checked last, with the
    file's parameters and with those of each scene. `sha256` is that of the file's bytes. Raises TooManyErrors.
    """
    point_names, results = read_declared_names(reader, root)
    title, curves = _read_title(reader, root), read_curves(reader, root)
    parameters, expressions = read_parameters(reader, root.get_mapping("parameters")), read_expressions(reader, root)
    gravity, materials = read_gravity(reader, root), Materials(reader, root.get_mapping("materials"))
    bodies, ground = read_bodies(reader, root, materials), read_ground(reader, root)
    joints, drives = read_joints(reader, root, point_names), read_drives(reader, root, point_names)
    forces, start = read_forces(reader, root, point_names), read_start(reader, root, point_names)
    bearings_and_guides, contacts = read_bearings_and_guides(reader, root, materials), read_contacts(reader, root)
    events = read_events(reader, root.get_mapping("events"), "events")
    scenes = read_scenes(reader, SceneParts(joints, bearings_and_guides, contacts, parameters, events, root, materials))
    results.unreadable_owners |= {
        *root.get_mapping("joints"),
        *root.get_mapping("drives"),
        *root.get_mapping("forces"),
    } - {*joints, *drives, *forces}
    outputs = _read_outputs(reader, root)
    check_peaks(reader, scenes, results, root.get_mapping("outputs"))
    check_values(reader, parameters, scenes)
    return Mechanism(
        name=str(root["name"]),
        title=title,
        gravity=gravity,
        parameters=infer_dimensions(reader, parameters),
        bodies=bodies,
        ground=ground,
        joints=joints,
        drives=drives,
        start=start,
        scenes=scenes,
        outputs=outputs,
        conditions=tuple(reader.conditions),
        file=reader.file,
        sha256=sha256,
        forces=forces,
        freedoms=_read_expected_dof(reader, root),
        curves=curves,
        expressions=expressions,
        materials=materials.by_name,
        choices=materials.choices,
        tables=reader.tables,
        laws=reader.laws,
    )


def _read_title(reader: Reader, root: Map) -> str:
    """Return the title, which is safe in comments of emitted code; the mechanism's name if there is no title.

    Errors are collected for a name that is not allowed, and for a title of several lines, of more than _MAX_TITLE
    characters, or with backslashes or comment signs.
    """
    with reader.collect_errors():
        check_name(root["name"], "mechanism", root["name"].where)
    title = root.get("title", root["name"])
    with reader.collect_errors():
        invalid = re.search(rf"[^{_VISIBLE_CHARACTERS}]|\\|\*/|/\*|\?\?/", title)
        if invalid or len(title) > _MAX_TITLE:
            fault = f"has {invalid[0]!r}" if invalid else f"has {len(title)} characters"
            hint = f"expected one line of at most {_MAX_TITLE} characters without backslashes or comment signs"
            raise BadValueError(f"the title {fault}", title.where, hint)
    return str(title)


def _read_expected_dof(reader: Reader, root: Map) -> Quantity | None:
    """Return the expected degrees of freedom (`freedoms:`) as a quantity; None if the file does not give them.

    The run compares them with the rank of the Jacobian. An error is collected, and None is returned, unless the value
    is a whole number ≥ 0. NaN, an expression that was already reported, is returned as it is.
    """
    if "freedoms" not in root:
        return None
    with reader.collect_errors():
        text = root["freedoms"]
        number = reader.read_quantity(text, "freedoms", SECTIONS["freedoms"].dimension)
        value = number.value.value if isinstance(number.value, Number) else -1.0
        if not (value >= 0.0 and value % 1.0 == 0.0) and not math.isnan(value):  # NaN: reported already
            raise BadValueError(f"freedoms is {describe_node(text)}", text.where, "expected a whole number: 0, 1, 2")
        return number
    return None


def _read_outputs(reader: Reader, root: Map) -> dict[str, Quantity]:
    """Return the section `outputs:` by name: expressions of t, parameters and results; errors are collected."""
    return {
        str(name): reader.read_quantity(text, f"outputs.{name}", OUTPUT.dimension, OUTPUT.varies)
        for name, text in root.get_mapping("outputs").list_entries()
    }


Overrides = Mapping[str, str | float | bool]
Seconds = dict[str, float]


def read_scene(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Scene:
    """Read a mechanism file and return one of its scenes.

    The seconds of this stage are stored in `seconds` under "reading", if it is given. Raises InputError or InputErrors,
    and UnknownNameError for a scene that the file does not have.
    """
    with measure_stage("reading", seconds):
        return make_scene(read_mechanism(data, file, overrides), scene)


def overrides_change_scene(data: bytes, file: str, scene: str, overrides: Overrides) -> bool:
    """Return whether overrides change any input from which a scene's equations are derived.

    The file is read twice, with and without the overrides; other scenes are not compared. Raises InputError.
    """
    scene_with_overrides, scene_of_file = (read_scene(data, file, scene, values) for values in (overrides, None))
    return _remove_other_scenes(scene_with_overrides) != _remove_other_scenes(scene_of_file)


def _remove_other_scenes(scene: Scene) -> Scene:
    """Return a copy of the scene whose mechanism contains no scenes, for a comparison of two scenes."""
    return replace(scene, mechanism=replace(scene.mechanism, scenes={}))


@contextmanager
def measure_stage(name: str, seconds: Seconds | None) -> Iterator[None]:
    """Return a context manager that stores the elapsed seconds of a compiler stage in `seconds[name]`.

    Nothing is stored if `seconds` is None or if the block raises.
    """
    start_time = perf_counter()
    yield
    if seconds is not None:
        seconds[name] = perf_counter() - start_time
