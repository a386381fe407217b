"""Events: expressions whose zeros a run records, or at which it ends."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError
from gudgeon.expression_tree import Expr, names
from gudgeon.generator.mechanism import GROUND, EventSpec
from gudgeon.generator.names import check_label, known_hint
from gudgeon.generator.reading import Reader, ResultDimension
from gudgeon.generator.schema import EventShape
from gudgeon.generator.yaml_tree import Text, kind_of

# the first of each is the default
DIRECTIONS = ("both", "rising", "falling")
ACTIONS = ("record", "stop")


def read_events(
    reader: Reader, section: Mapping[Text, EventShape], owner: str, motion: ResultDimension
) -> dict[str, EventSpec]:
    """The events of a section; `motion` gives the dimensions of the coordinates and velocities that they may use."""
    events = {}
    for name, shape in section.items():
        with reader.collect():
            check_label(name, "event", name.where)
        with reader.collect():
            events[str(name)] = _event(reader, name, shape, f"{owner}.{name}", motion)
    return events


def _event(reader: Reader, name: Text, shape: EventShape, owner: str, motion: ResultDimension) -> EventSpec:
    told = len(reader.errors)
    zero = reader.quantity(shape.zero, f"{owner}.zero", None, time=True, result=motion)
    if len(reader.errors) == told and not _varies(zero.value):
        hint = "expected an expression of t, or of coordinates and velocities: S9.y, L1.omega - 20 rad/s"
        raise BadValueError(f"{owner}.zero never changes: it crosses zero at no time", shape.zero.where, hint)
    with reader.collect():
        direction = _word(shape.direction, "direction", DIRECTIONS)
        return EventSpec(str(name), zero, direction, _word(shape.action, "action", ACTIONS), name.where)
    return EventSpec(str(name), zero, DIRECTIONS[0], ACTIONS[0], name.where)


def _varies(expr: Expr) -> bool:
    """Whether a name in it stands for time or motion; points of the ground rest."""
    paths = [name.path for name in names(expr)]
    return any(path == "t" or "." in path and path.partition(".")[0] != GROUND for path in paths)


def _word(text: Text | None, key: str, words: tuple[str, ...]) -> str:
    """One of some words; the first, where nothing is written."""
    if text is None:
        return words[0]
    if text not in words:
        raise BadValueError(f"{key} is {kind_of(text)}", text.where, known_hint(text, words))
    return str(text)
