"""The entries of `joints`, `drives` and `forces`: one key says the kind, the others are the kind's own fields."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from gudgeon.errors import BadValueError, InputError, JoinError, MissingKeyError, UnknownKeyError
from gudgeon.generator.kinds.forces.force_type import ElementField
from gudgeon.generator.kinds.joints.joint_type import JointField
from gudgeon.generator.mechanism.mechanism import GROUND, PointRef, Quantity, Vector
from gudgeon.generator.reader.bodies import Places
from gudgeon.generator.reader.collector import Reader, ResultDimension
from gudgeon.generator.yaml.shapes import missing_key, unknown_key
from gudgeon.generator.yaml.tree import Items, Map, Text, kind_of
from gudgeon.language.suggestions import known_hint, nearest

Field = JointField | ElementField


@dataclass(frozen=True)
class Values:
    """What an entry's own fields hold; options are filled in with their defaults."""

    quantities: dict[str, Quantity] = field(default_factory=dict)
    vectors: dict[str, Vector] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)


def kind_key(node: Map, known: Iterable[str], also: Iterable[str], owner: str) -> Text:
    """The key that says what kind of thing a mapping is: exactly one."""
    found = [key for key in node.names() if key in known]
    if len(found) == 1:
        return found[0]
    if found:
        raise UnknownKeyError(f"{owner} is both {found[0]} and {found[1]}", found[1].where, "expected one kind")
    strange = next((key for key in node.names() if key not in also), None)
    if strange is None:
        raise MissingKeyError(f"{owner} has no kind", node.where, known_hint("", known))
    raise unknown_key(strange, known, owner)


def check_keys(reader: Reader, node: Map, known: Sequence[str], owner: str) -> set[str | None]:
    """Collect an error for every key that an entry does not know; what they probably stand for is returned."""
    strange = [key for key in node.names() if key not in known]
    reader.errors.extend(unknown_key(key, known, owner) for key in strange)
    return {nearest(key, known) for key in strange}


def text_of(node: object, key: Text, owner: str) -> Text:
    """A scalar. Raises BadValueError at its key."""
    if not isinstance(node, Text):
        raise BadValueError(f"{owner}.{key} is {kind_of(node)}", key.where, "expected a number or a text")
    return node


def places_of(
    reader: Reader, node: Map, kind: Text, targets: str, counts: Sequence[int], places: Places
) -> tuple[PointRef, ...]:
    """The points (`targets` "points") or bodies that an entry lists; all are looked at before an error is raised."""
    found = node[kind]
    items = list(found) if isinstance(found, Items) else [found]
    if len(items) not in counts or isinstance(found, Items) and len(items) == 1:
        what = f"{len(items)} {targets}" if isinstance(found, Items) else kind_of(found)
        place = found.where if isinstance(found, Items) else kind.where
        raise BadValueError(f"{kind} takes {what}", place, _wanted(targets, counts))
    refs: list[PointRef] = []
    errors: list[InputError] = []
    for item in items:
        place = getattr(item, "where", kind.where)
        try:
            refs.append(places.point(item, place) if targets == "points" else places.body(item, place))
        except InputError as error:
            errors.append(error)
    if errors:
        reader.errors.extend(errors[:-1])
        raise errors[-1]
    return tuple(refs)


def _wanted(targets: str, counts: Sequence[int]) -> str:
    one, two = ("L1.head", "[L1.head, L2.tail]") if targets == "points" else ("L1", "[L1, L2]")
    examples = {1: f"one {'point' if targets == 'points' else 'body'}: {one}", 2: f"two {targets}: {two}"}
    return f"expected {' or '.join(examples[count] for count in counts)}"


def refuse_same_body(kind: str, refs: Sequence[PointRef]) -> None:
    """Raise JoinError unless there are two different bodies, or one that is not the ground."""
    last = refs[-1]
    if len(refs) == 1 and last.body == GROUND:
        raise JoinError(f"{kind} acts on the ground", last.where, "expected a body: the ground does not move")
    if len(refs) == 2 and refs[0].body == last.body:
        what = "the ground to the ground" if last.body == GROUND else f"body {last.body} to itself"
        raise JoinError(f"{kind} joins {what}", last.where, "expected two different bodies")


def read_fields(
    reader: Reader,
    node: Map,
    fields: Sequence[Field],
    owner: str,
    places: Places,
    mistyped: set[str | None],
    motion: ResultDimension | None = None,
) -> Values:
    """An entry's own fields. A missing one is not told if a `mistyped` key stands in its place.

    `motion` gives the dimensions of the names that a field that is `variable` may use.
    """
    values = Values()
    for wanted in fields:
        with reader.collect():
            if wanted.name in node:
                _read_field(reader, node, wanted, owner, places, values, motion)
            elif wanted.required and wanted.name not in mistyped:
                raise missing_key(wanted.name, node.where, owner)
            elif wanted.kind == "option":
                values.options[wanted.name] = wanted.values[0]
            elif isinstance(wanted, JointField) and wanted.kind == "body":
                values.options[wanted.name] = wanted.default
    return values


def _read_field(
    reader: Reader, node: Map, wanted: Field, owner: str, places: Places, values: Values, motion: ResultDimension | None
) -> None:
    address = f"{owner}.{wanted.name}"
    if wanted.kind == "vector":
        values.vectors[wanted.name] = vector = _vector(reader, node, wanted, address, motion)
        _bound(reader, wanted, *vector)
        return
    text = text_of(node[wanted.name], node.key(wanted.name), owner)
    if wanted.kind == "body":
        values.options[wanted.name] = places.check_body(text, text.where)
    elif wanted.kind == "option":
        if text not in wanted.values:
            raise BadValueError(f"{wanted.name} is {kind_of(text)}", text.where, known_hint(text, wanted.values))
        values.options[wanted.name] = str(text)
    else:
        values.quantities[wanted.name] = _number(reader, text, wanted, address, motion)
        _bound(reader, wanted, values.quantities[wanted.name])


def _number(reader: Reader, text: Text, wanted: Field, address: str, motion: ResultDimension | None) -> Quantity:
    if isinstance(wanted, ElementField) and wanted.variable:
        return reader.quantity(text, address, wanted.dimension, time=True, result=motion)
    return reader.quantity(text, address, wanted.dimension)


def _vector(reader: Reader, node: Map, wanted: Field, address: str, motion: ResultDimension | None) -> Vector:
    pair = node[wanted.name]
    if not isinstance(pair, Items) or len(pair) != 2 or not all(isinstance(item, Text) for item in pair):
        message = f"{address} is {kind_of(pair)}"
        raise BadValueError(message, node.key(wanted.name).where, "expected a list of two: [x, y]")
    x, y = (_number(reader, text, wanted, f"{address}.{a}", motion) for text, a in zip(pair, "xy", strict=True))
    if isinstance(wanted, JointField) and wanted.nonzero:
        reader.vectors_not_zero.append((x, y))
    return x, y


def _bound(reader: Reader, wanted: Field, *numbers: Quantity) -> None:
    """What a field's declaration says of its sign, as conditions."""
    for number in numbers:
        if isinstance(wanted, JointField) and wanted.positive:
            reader.require(number, ">", 0.0, f"{wanted.name} is positive")
        elif isinstance(wanted, ElementField) and wanted.not_negative:
            reader.require(number, ">=", 0.0, f"{wanted.name} is not negative")


def field_names(fields: Iterable[Field]) -> list[str]:
    """The keys of an entry's own fields."""
    return [wanted.name for wanted in fields]


def all_names(kinds: Mapping[str, Sequence[Field]]) -> set[str]:
    """The keys of all kinds' fields."""
    return {name for fields in kinds.values() for name in field_names(fields)}
