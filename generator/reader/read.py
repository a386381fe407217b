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
from gudgeon.generator.reader.declared_names import read_names
from gudgeon.generator.reader.drives import read_drives
from gudgeon.generator.reader.expressions import read_expressions
from gudgeon.generator.reader.joints_and_forces import read_forces, read_joints
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.parameters import infer_dimensions, read_parameters
from gudgeon.generator.reader.scenes import SceneParts, check_peaks, read_events, read_scenes
from gudgeon.generator.yaml import Map, kind_of, parse_yaml
from gudgeon.language.names import check_name
from gudgeon.language.tree import Number

_MAX_TITLE = 200
# no control characters, line ends or marks that change the direction of the text after them
_SHOWN = r"\x20-\x7e\u00a0-\u2027\u202f-\u2065\u206a-\ud7ff\ue000-\uffef\U00010000-\U0010ffff"


def read_mechanism(data: bytes, file: str, overrides: Mapping[str, str | float | bool] | None = None) -> Mechanism:
    """Return the mechanism that a file describes.

    data: the file's bytes; file: its name, for messages and for `Mechanism.file`;
    overrides: address -> text or number that replaces the file's value there.
    Raises an InputError at file:line:column, or InputErrors with all errors of the file.
    """
    reader = Reader(file)
    root = apply_overrides(parse_yaml(data, file, reader.errors), overrides or {})
    try:
        mechanism = _read(reader, reader.check_shape(root), hashlib.sha256(data).hexdigest())
    except TooManyErrors:
        mechanism = None
    reader.raise_errors()
    assert mechanism is not None
    return mechanism


def _read(reader: Reader, root: Map, sha256: str) -> Mechanism:
    """Read all sections in the order of their dependencies and check the values; errors are collected in the reader."""
    point_names, results = read_names(reader, root)
    title, curves = _read_title(reader, root), read_curves(reader, root)
    parameters, expressions = read_parameters(reader, root.part("parameters")), read_expressions(reader, root)
    gravity, materials = read_gravity(reader, root), Materials(reader, root.part("materials"))
    bodies, ground = read_bodies(reader, root, materials), read_ground(reader, root)
    joints, drives = read_joints(reader, root, point_names), read_drives(reader, root, point_names)
    forces, start = read_forces(reader, root, point_names), read_start(reader, root, point_names)
    bearings_and_guides, contacts = read_bearings_and_guides(reader, root, materials), read_contacts(reader, root)
    events = read_events(reader, root.part("events"), "events")
    scenes = read_scenes(reader, SceneParts(joints, bearings_and_guides, contacts, parameters, events, root, materials))
    results.unread |= {*root.part("joints"), *root.part("drives"), *root.part("forces")} - {*joints, *drives, *forces}
    outputs = _read_outputs(reader, root)
    check_peaks(reader, scenes, results, root.part("outputs"))
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
        freedoms=_read_freedoms(reader, root),
        curves=curves,
        expressions=expressions,
        materials=materials.known,
        choices=materials.choices,
        tables=reader.tables,
        laws=reader.laws,
    )


def _read_title(reader: Reader, root: Map) -> str:
    """Return the title as one line that is safe in comments of emitted code; the mechanism's name if there is none."""
    with reader.collect():
        check_name(root["name"], "mechanism", root["name"].where)
    title = root.get("title", root["name"])
    with reader.collect():
        bad = re.search(rf"[^{_SHOWN}]|\\|\*/|/\*|\?\?/", title)
        if bad or len(title) > _MAX_TITLE:
            what = f"has {bad[0]!r}" if bad else f"has {len(title)} characters"
            hint = f"expected one line of at most {_MAX_TITLE} characters without backslashes or comment signs"
            raise BadValueError(f"the title {what}", title.where, hint)
    return str(title)


def _read_freedoms(reader: Reader, root: Map) -> Quantity | None:
    """Return the expected degrees of freedom, a whole number that is compared with a rank; None if not given."""
    if "freedoms" not in root:
        return None
    with reader.collect():
        text = root["freedoms"]
        number = reader.quantity(text, "freedoms", SECTIONS["freedoms"].dimension)
        value = number.value.value if isinstance(number.value, Number) else -1.0
        if not (value >= 0.0 and value % 1.0 == 0.0) and not math.isnan(value):  # NaN: reported already
            raise BadValueError(f"freedoms is {kind_of(text)}", text.where, "expected a whole number: 0, 1, 2")
        return number
    return None


def _read_outputs(reader: Reader, root: Map) -> dict[str, Quantity]:
    """Read `outputs:`: named expressions of t, parameters and results."""
    return {
        str(name): reader.quantity(text, f"outputs.{name}", OUTPUT.dimension, OUTPUT.varies)
        for name, text in root.part("outputs").pairs()
    }


Overrides = Mapping[str, str | float | bool]
Seconds = dict[str, float]


def read_scene(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Scene:
    """Return one scene of a mechanism file; the seconds of this stage are added to `seconds`."""
    with stage("reading", seconds):
        return make_scene(read_mechanism(data, file, overrides), scene)


def overrides_change_scene(data: bytes, file: str, scene: str, overrides: Overrides) -> bool:
    """Return whether overrides change any input from which a scene's equations are derived. Raises InputError."""
    with_them, without = (read_scene(data, file, scene, given) for given in (overrides, None))
    return _without_other_scenes(with_them) != _without_other_scenes(without)


def _without_other_scenes(scene: Scene) -> Scene:
    """Return the scene with a mechanism that contains no other scenes."""
    return replace(scene, mechanism=replace(scene.mechanism, scenes={}))


@contextmanager
def stage(name: str, seconds: Seconds | None) -> Iterator[None]:
    """Return a context manager that stores the seconds of a stage of the compiler in `seconds`, if it is given."""
    begun = perf_counter()
    yield
    if seconds is not None:
        seconds[name] = perf_counter() - begun
