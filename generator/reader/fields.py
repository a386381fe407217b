"""What a mapping of the file holds, read by the declaration of its fields; and the key that says a thing's kind."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Protocol

from gudgeon.errors import BadValueError, InputError, JoinError, Location, MissingKeyError, UnknownKeyError
from gudgeon.generator.field import (
    BODY,
    FLAG,
    NUMBER,
    VECTOR,
    WORD,
    Bound,
    Field,
)
from gudgeon.generator.format.shapes import missing_key, unknown_key
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, PointRef, Quantity, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.places import Places
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import known_hint, nearest
from gudgeon.language.shown import counted
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS

_NOWHERE: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class Values:
    """What the numbers, vectors and choices of a mapping are; defaults are filled in."""

    quantities: dict[str, Quantity] = field(default_factory=dict)
    vectors: dict[str, Vector] = field(default_factory=dict)
    options: dict[str, str | bool] = field(default_factory=dict)

    def words(self) -> dict[str, str]:
        """The choices as a file writes them."""
        return {name: str(value).lower() if isinstance(value, bool) else value for name, value in self.options.items()}


class _Kind(Protocol):
    """A kind, its keys, and what others call it."""

    @property
    def fields(self) -> tuple[Field, ...]: ...

    @property
    def also(self) -> tuple[str, ...]: ...


def read_kind(
    reader: Reader, node: Map, kinds: Mapping[str, _Kind], owner: str, elsewhere: Mapping[str, str] = _NOWHERE
) -> tuple[Text, frozenset[str | None]]:
    """Return the kind of an entry, and what its unknown keys probably stand for (`check_keys`)."""
    kind = kind_key(node, kinds, [key for of in kinds.values() for key in field_names(of.fields)], owner)
    return kind, check_keys(reader, node, [kind, *field_names(kinds[kind].fields)], owner, elsewhere)


def kind_key(node: Map, known: Mapping[str, _Kind], also: Iterable[str], owner: str) -> Text:
    """The key that says what kind of thing a mapping is: exactly one."""
    found = [key for key in node.names() if key in known]
    if len(found) == 1:
        return found[0]
    if found:
        raise UnknownKeyError(f"{owner} is both {found[0]} and {found[1]}", found[1].where, "expected one kind")
    strange = next((key for key in node.names() if key not in also), None)
    otherwise = {other: kind for kind, of in known.items() for other in of.also}
    for key in node.names():
        if key.lower() in otherwise:
            raise unknown_key(key, known, owner, f"{str(key)!r} is called {otherwise[key.lower()]} here")
    if strange is None:
        raise MissingKeyError(f"{owner} has no kind", node.where, known_hint("", known))
    raise unknown_key(strange, known, owner)


def check_keys(
    reader: Reader, node: Map, known: Sequence[str], owner: str, elsewhere: Mapping[str, str] = _NOWHERE
) -> frozenset[str | None]:
    """Collect an error for every key that an entry does not know; what they probably stand for is returned.

    `elsewhere` says of keys that stand in another section what to write there.
    """
    strange = [key for key in node.names() if key not in known]
    reader.errors.extend(unknown_key(key, known, owner, elsewhere.get(key, "")) for key in strange)
    return frozenset(nearest(key, known) for key in strange)


def places_of(
    reader: Reader, node: Map, kind: Text, targets: str, counts: Sequence[int], places: Places
) -> tuple[PointRef, ...]:
    """The points (`targets` "points") or bodies that an entry lists; all are looked at before an error is raised."""
    found = node[kind]
    items = list(found) if isinstance(found, Items) else [found]
    if len(items) not in counts or isinstance(found, Items) and len(items) == 1:
        one, many = ("point", "points") if targets == "points" else ("body", "bodies")
        what = counted(len(items), one, many) if isinstance(found, Items) else kind_of(found)
        place = found.where if isinstance(found, Items) else kind.where
        hint = _wanted(targets, counts)
        joint = joint_types().get(kind)
        if len(items) > 2 and joint and joint.is_pivot and all(isinstance(item, Text) for item in items):
            hint += f"; {_pairs(kind, items)}"
        raise BadValueError(f"{kind} has {what}", place, hint)
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


def _pairs(kind: Text, points: Sequence[object]) -> str:
    """What to write where several bodies turn on one pin."""
    first, *others = (str(point)[:60] for point in points[:4])
    lines = ", ".join(f"{name}: {{{kind}: [{first}, {other}]}}" for name, other in zip("ABC", others, strict=False))
    return f"{len(points)} bodies on one pin are {len(points) - 1} joints: {lines}"


def refuse_same_body(kind: str, refs: Sequence[PointRef]) -> None:
    """Raise JoinError unless there are two different bodies, or one that is not the ground."""
    last = refs[-1]
    if len(refs) == 1 and last.body == GROUND:
        raise JoinError(f"{kind} acts on the ground", last.where, "expected a body: the ground does not move")
    if len(refs) == 2 and refs[0].body == last.body:
        what = "the ground to the ground" if last.body == GROUND else f"body {last.body} to itself"
        raise JoinError(f"{kind} joins {what}", last.where, "expected two different bodies")


@dataclass(frozen=True)
class Around:
    """What fields are read with, beside their mapping."""

    owner: str  # address of the mapping
    why: str = ""  # what a broken condition without words of its own is told with: the law
    place: Location | None = None  # of what is filled in; the mapping's, if there is none
    mistyped: frozenset[str | None] = frozenset()  # what strange keys probably stand for: not told as missing
    places: Places | None = None  # of bodies


def read_fields(reader: Reader, node: Map, fields: Sequence[Field], around: Around) -> Values:
    """The numbers, vectors, words, flags and bodies among the fields of a mapping, and their conditions."""
    values = Values()
    for wanted in fields:
        with reader.collect():
            if wanted.name in node:
                _read_field(reader, node, wanted, around, values)
            elif wanted.required and wanted.name not in around.mistyped:
                raise missing_key(wanted.name, node.where, around.owner)
            elif wanted.default is not None:
                _fill_in(reader, wanted, f"{around.owner}.{wanted.name}", around.place or node.where, values)
    _bound(reader, fields, around, values)
    return values


def _fill_in(reader: Reader, wanted: Field, address: str, place: Location, values: Values) -> None:
    if wanted.kind == NUMBER:
        number = Number(float(wanted.default or 0.0), repr(wanted.default))
        dimension = wanted.dimension or DIMENSIONLESS
        values.quantities[wanted.name] = reader.keep(Quantity(address, number, dimension, place))
    else:
        values.options[wanted.name] = wanted.choice


def _read_field(reader: Reader, node: Map, wanted: Field, around: Around, values: Values) -> None:
    address, text = f"{around.owner}.{wanted.name}", node[wanted.name]
    if wanted.kind in (NUMBER, BODY) and not isinstance(text, Text):
        where = node.key(wanted.name).where
        raise BadValueError(f"{address} is {kind_of(text)}", where, "expected a number or a text")
    if wanted.kind == VECTOR:
        values.vectors[wanted.name] = read_vector(reader, text, node.key(wanted.name), wanted, address)
    elif wanted.kind == NUMBER:
        values.quantities[wanted.name] = reader.quantity(text, address, wanted.dimension, wanted.varies)
        if wanted.whole:
            reader.wholes[address] = wanted.meaning
    elif wanted.kind in (WORD, FLAG):
        values.options[wanted.name] = _word(text, node.key(wanted.name), wanted, address)
    elif wanted.kind == BODY and around.places is not None:
        values.options[wanted.name] = around.places.check_body(text, text.where)


def read_vector(reader: Reader, pair: object, key: Text, wanted: Field, address: str) -> Vector:
    """Two numbers `address`.x and `address`.y as their field declares them; `key` is what stands before them."""
    if not isinstance(pair, Items) or len(pair) != 2 or not all(isinstance(item, Text) for item in pair):
        raise BadValueError(f"{address} is {kind_of(pair)}", key.where, "expected a list of two: [x, y]")
    x, y = (
        reader.quantity(text, f"{address}.{axis}", wanted.dimension, wanted.varies)
        for text, axis in zip(pair, "xy", strict=True)
    )
    if wanted.nonzero:
        reader.vectors_not_zero.append((x, y))
    return x, y


def _word(text: object, key: Text, wanted: Field, address: str) -> str | bool:
    """One of some words, or true or false."""
    words = {str(value).lower() if isinstance(value, bool) else value: value for value in wanted.values}
    if not isinstance(text, Text) or text not in words:
        place = text.where if isinstance(text, Text) and not text.is_nothing else key.where
        hint = "expected true or false" if wanted.kind == FLAG else known_hint(str(text), words)
        raise BadValueError(f"{address} is {kind_of(text)}", place, hint)
    return words[text]


def _bound(reader: Reader, fields: Sequence[Field], around: Around, values: Values) -> None:
    """What the declarations say of numbers, or of both of a vector, as conditions: the limits' own come first."""
    seen: set[str] = set()
    waiting: list[tuple[Field, Bound]] = []
    for wanted in fields:
        seen.add(wanted.name)
        waiting = [*((wanted, bound) for bound in wanted.bounds), *waiting]
        for bounded, bound in waiting:
            if not isinstance(bound.limit, str) or bound.limit in seen:
                _require(reader, bounded, bound, around, values)
        waiting = [(f, bound) for f, bound in waiting if isinstance(bound.limit, str) and bound.limit not in seen]


def _require(reader: Reader, wanted: Field, bound: Bound, around: Around, values: Values) -> None:
    own = values.quantities.get(wanted.name)
    limit = values.quantities.get(bound.limit) if isinstance(bound.limit, str) else bound.limit
    for number in values.vectors.get(wanted.name, ()) if own is None else (own,):
        if limit is not None:
            reader.require(number, bound.relation, limit, bound.reason(wanted, around.why))


def field_names(fields: Iterable[Field]) -> list[str]:
    """The keys of some fields."""
    return [wanted.name for wanted in fields]
