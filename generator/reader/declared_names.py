"""The pass over names: what a file declares can be a name, and nothing else has that name.

After it all names are known, so that the sections that refer to them can be read in any order.
"""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import BadNameError, Location
from gudgeon.generator.field import OF_MOTION, OF_RESULTS
from gudgeon.generator.format.sections import FILE
from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reader.collector import BROKEN, NamedExpression, Reader
from gudgeon.generator.reader.places import CORNERS_OF_SIDES, IMPLIED_POINTS, Places
from gudgeon.generator.reader.result_names import MotionNames, ResultNames
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import check_label, check_name

# results are indexed by these names
_INDEXED = {"bodies": "body", "joints": "joint", "drives": "drive", "forces": "force", "outputs": "output"}
# these names stand in expressions without a dot; in a pair of equal ones that of the later section is refused
_IN_EXPRESSIONS = {"parameters": "parameter", "outputs": "output", "curves": "curve", "expressions": "expression"}
# nothing but the file itself calls its entries by these
_LABELS = {
    section.name: section.entry.name
    for section in FILE.fields
    if section.entry is not None and section.name not in {*_INDEXED, *_IN_EXPRESSIONS, GROUND}
}
# `L1.x` is a coordinate of the body: a point of that name could not be told from it
_COORDINATES = ("x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha")


def read_names(reader: Reader, root: Map) -> tuple[Places, ResultNames]:
    """Return the names of points and of results; reader.parameters, .expressions and .scopes hold the others.

    A BadNameError is collected for each name that cannot be.
    """
    reader.parameters.update(dict.fromkeys(map(str, root.part("parameters"))))
    expressions = (name for name in root.part("expressions").names() if name != "t")
    reader.expressions.update((str(name), NamedExpression(BROKEN, BROKEN, None, name.where)) for name in expressions)
    _check_labels(reader, root)
    _check_in_expressions(reader, root)
    _check_points(reader, root)
    places, twice = Places(root), frozenset(_check_indexed(reader, root))
    numbers = dict.fromkeys(reader.parameters, "a parameter") | dict.fromkeys(reader.expressions, "an expression")
    results = ResultNames(places, root, numbers, twice)
    reader.scopes |= {OF_MOTION: MotionNames(places, root, numbers), OF_RESULTS: results}
    return places, results


def _check_labels(reader: Reader, root: Map) -> None:
    for section, what in _LABELS.items():
        for name in root.part(section).names():
            with reader.collect():
                check_label(name, what, name.where)
    for scene in root.part("scenes").values():
        for name in scene.part("events").names():
            with reader.collect():
                check_label(name, "event", name.where)


def _check_in_expressions(reader: Reader, root: Map) -> None:
    used: dict[str, str] = {}
    for section, what in _IN_EXPRESSIONS.items():
        names = root.part(section).names()
        for name in names if section != "outputs" else ():  # those of outputs are results, too
            with reader.collect():
                reader.refused.add(str(name))
                check_name(name, what, name.where)
                reader.refused.remove(str(name))
                if name in used:
                    message = f"{name!r} names this {what} and {used[name]}"
                    raise BadNameError(message, name.where, "expected a name of its own: both stand in expressions")
        used = dict.fromkeys(names, f"a{'n' * (what == 'output')} {what}") | used


def _check_indexed(reader: Reader, root: Map) -> Iterator[str]:
    used: dict[str, tuple[str, Location]] = {}
    for section, what in _INDEXED.items():
        for name in root.part(section).names():
            with reader.collect():
                check_name(name, what, name.where)
                if name in used:
                    yield str(name)
                    other, place = used[name]
                    hint = "expected a name of its own: bodies, joints, drives, forces and outputs share one namespace"
                    message = f"{name!r} names two things: this {what}, and the {other} at {place}"
                    raise BadNameError(message, name.where, hint)
                used[name] = what, name.where


def _check_points(reader: Reader, root: Map) -> None:
    for body, node in root["bodies"].pairs():
        reasons = dict.fromkeys(CORNERS_OF_SIDES, "it is one of sides") if "sides" in node else {}
        reasons |= {name: f"{body}.{name} is a coordinate" for name in _COORDINATES}
        reasons |= dict.fromkeys(IMPLIED_POINTS, "every body has it")
        for point in node.part("points").names():
            with reader.collect():
                _check_point(point, reasons.get(point, ""), "expected another name")
    for point in root.part("ground").names():
        with reader.collect():
            _check_point(point, "it names a coordinate" if point in _COORDINATES else "")


def _check_point(point: Text, reason: str, hint: str = "") -> None:
    check_name(point, "point", point.where)
    if reason:
        raise BadNameError(f"{str(point)!r} cannot name a point: {reason}", point.where, hint)
