"""Checks the names that a file declares: each must be allowed and used once.

The pass runs first, so that sections can refer to each other and be read in any order.
"""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import BadNameError, Location
from gudgeon.generator.field import OF_MOTION, OF_RESULTS
from gudgeon.generator.format.sections import MECHANISM_FILE
from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reader.collector import UNREADABLE_EXPRESSION, NamedExpression, Reader
from gudgeon.generator.reader.point_names import CORNERS_OF_SIDES, IMPLIED_POINTS, PointNames
from gudgeon.generator.reader.result_names import MotionNames, ResultNames
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import check_label, check_name

# sections whose names index the results
_RESULT_SECTIONS = {"bodies": "body", "joints": "joint", "drives": "drive", "forces": "force", "outputs": "output"}
# sections whose names are used in expressions without a dot; of two equal names the later section's is refused
_EXPRESSION_SECTIONS = {"parameters": "parameter", "outputs": "output", "curves": "curve", "expressions": "expression"}
# sections whose names are labels that only the file uses
_LABEL_SECTIONS = {
    section.name: section.entry.name
    for section in MECHANISM_FILE.fields
    if section.entry is not None and section.name not in {*_RESULT_SECTIONS, *_EXPRESSION_SECTIONS, GROUND}
}
# reserved names of points: `L1.x` is a coordinate of the body
_COORDINATES = ("x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha")


def read_declared_names(reader: Reader, root: Map) -> tuple[PointNames, ResultNames]:
    """Return the names of points and of results, and register all other names of the file in the reader.

    Parameters go to reader.parameters, named expressions to reader.expressions. reader.result_scopes gets the names of
    motion and of results. A BadNameError is collected for each name that is not allowed or used twice. Nothing else of
    the sections is read.
    """
    reader.parameters.update(dict.fromkeys(map(str, root.get_mapping("parameters"))))
    expressions = (name for name in root.get_mapping("expressions").list_keys() if name != "t")
    reader.expressions.update(
        (str(name), NamedExpression(UNREADABLE_EXPRESSION, UNREADABLE_EXPRESSION, None, name.where))
        for name in expressions
    )
    _check_labels(reader, root)
    _check_expression_names(reader, root)
    _check_point_names(reader, root)
    point_names, repeated_names = PointNames(root), frozenset(_check_result_names(reader, root))
    kind_by_name = dict.fromkeys(reader.parameters, "a parameter") | dict.fromkeys(reader.expressions, "an expression")
    results = ResultNames(point_names, root, kind_by_name, repeated_names)
    reader.result_scopes |= {OF_MOTION: MotionNames(point_names, root, kind_by_name), OF_RESULTS: results}
    return point_names, results


def _check_labels(reader: Reader, root: Map) -> None:
    """Collect an error for each label (scene, event, contact and others) that is not allowed."""
    for section, kind in _LABEL_SECTIONS.items():
        for name in root.get_mapping(section).list_keys():
            with reader.collect_errors():
                check_label(name, kind, name.where)
    for scene in root.get_mapping("scenes").values():
        for name in scene.get_mapping("events").list_keys():
            with reader.collect_errors():
                check_label(name, "event", name.where)


def _check_expression_names(reader: Reader, root: Map) -> None:
    """Collect an error for each name of a parameter, curve or expression that is not allowed or used twice.

    Names of outputs count as used. Names that are not allowed are recorded in reader.invalid_names.
    """
    users_of_names: dict[str, str] = {}
    for section, kind in _EXPRESSION_SECTIONS.items():
        names = root.get_mapping(section).list_keys()
        for name in names if section != "outputs" else ():  # names of outputs are checked with the results
            with reader.collect_errors():
                reader.invalid_names.add(str(name))
                check_name(name, kind, name.where)
                reader.invalid_names.remove(str(name))
                if name in users_of_names:
                    message = f"{name!r} names this {kind} and {users_of_names[name]}"
                    raise BadNameError(message, name.where, "expected another name: expressions may contain both")
        users_of_names = dict.fromkeys(names, f"a{'n' * (kind == 'output')} {kind}") | users_of_names


def _check_result_names(reader: Reader, root: Map) -> Iterator[str]:
    """Check the names that index results, and yield those that two entries have.

    An error is collected for each name that is not allowed or used twice: bodies, joints, drives, forces and outputs
    share one namespace.
    """
    users_of_names: dict[str, tuple[str, Location]] = {}
    for section, kind in _RESULT_SECTIONS.items():
        for name in root.get_mapping(section).list_keys():
            with reader.collect_errors():
                check_name(name, kind, name.where)
                if name in users_of_names:
                    yield str(name)
                    other_kind, location = users_of_names[name]
                    hint = "expected another name: bodies, joints, drives, forces and outputs share one namespace"
                    message = f"{name!r} names this {kind} and the {other_kind} at {location}"
                    raise BadNameError(message, name.where, hint)
                users_of_names[name] = kind, name.where


def _check_point_names(reader: Reader, root: Map) -> None:
    """Collect an error for each point whose name is reserved or not allowed.

    Reserved are coordinates, implied points, and on a body with `sides` the corners P, Q and R.
    """
    for body, node in root["bodies"].list_entries():
        reasons = dict.fromkeys(CORNERS_OF_SIDES, "the key sides defines it") if "sides" in node else {}
        reasons |= {name: f"{body}.{name} is a coordinate" for name in _COORDINATES}
        reasons |= dict.fromkeys(IMPLIED_POINTS, "every body has a point of this name")
        for point in node.get_mapping("points").list_keys():
            with reader.collect_errors():
                _check_point_name(point, reasons.get(point, ""), "expected another name")
    for point in root.get_mapping("ground").list_keys():
        with reader.collect_errors():
            _check_point_name(point, "a coordinate has this name" if point in _COORDINATES else "")


def _check_point_name(point: Text, reason: str, hint: str = "") -> None:
    """Raise BadNameError for a point's name that is not allowed; `reason` says why it is reserved, "" if it is not."""
    check_name(point, "point", point.where)
    if reason:
        raise BadNameError(f"{str(point)!r} cannot name a point: {reason}", point.where, hint)
