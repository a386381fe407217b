"""Reads the values of a mapping by the declarations of its fields, and finds the key that states an entry's kind."""

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
from gudgeon.generator.reader.point_names import PointNames
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import known_hint, nearest
from gudgeon.language.shown import counted
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS

_NOWHERE: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class Values:
    """Contain the numbers, vectors and choices of a mapping, with defaults filled in."""

    quantities: dict[str, Quantity] = field(default_factory=dict)
    vectors: dict[str, Vector] = field(default_factory=dict)
    options: dict[str, str | bool] = field(default_factory=dict)

    def words(self) -> dict[str, str]:
        """Return the choices as texts, as a file writes them."""
        return {name: str(value).lower() if isinstance(value, bool) else value for name, value in self.options.items()}


class _Kind(Protocol):
    """Represent a kind of joint, drive or force: its keys and the names that other programs give it."""

    @property
    def fields(self) -> tuple[Field, ...]: ...

    @property
    def also(self) -> tuple[str, ...]: ...


def read_kind(
    reader: Reader, node: Map, kinds: Mapping[str, _Kind], owner: str, elsewhere: Mapping[str, str] = _NOWHERE
) -> tuple[Text, frozenset[str | None]]:
    """Return the key that states an entry's kind, and the keys that its unknown keys probably mean (`check_keys`)."""
    kind = find_kind(node, kinds, [key for of in kinds.values() for key in field_names(of.fields)], owner)
    return kind, check_keys(reader, node, [kind, *field_names(kinds[kind].fields)], owner, elsewhere)


def find_kind(node: Map, known: Mapping[str, _Kind], also: Iterable[str], owner: str) -> Text:
    """Return the only key of a mapping that is a kind. Raises an InputError if there is none or more than one.

    `also` are the other keys that are allowed; `owner` is the mapping's address.
    """
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
    """Collect an error for each unknown key of an entry, and return the keys that they probably stand for.

    `elsewhere` maps keys of other sections to a hint where to write them.
    """
    strange = [key for key in node.names() if key not in known]
    reader.errors.extend(unknown_key(key, known, owner, elsewhere.get(key, "")) for key in strange)
    return frozenset(nearest(key, known) for key in strange)


def read_targets(
    reader: Reader, node: Map, kind: Text, targets: str, counts: Sequence[int], point_names: PointNames
) -> tuple[PointRef, ...]:
    """Return the points (`targets` "points") or bodies that an entry lists.

    `counts` are the allowed numbers of them. All are checked before an error is raised.
    """
    found = node[kind]
    items = list(found) if isinstance(found, Items) else [found]
    if len(items) not in counts or isinstance(found, Items) and len(items) == 1:
        one, many = ("point", "points") if targets == "points" else ("body", "bodies")
        what = counted(len(items), one, many) if isinstance(found, Items) else kind_of(found)
        place = found.where if isinstance(found, Items) else kind.where
        hint = _targets_hint(targets, counts)
        joint = joint_types().get(kind)
        if len(items) > 2 and joint and joint.is_pivot and all(isinstance(item, Text) for item in items):
            hint += f"; {_pairs_hint(kind, items)}"
        raise BadValueError(f"{kind} has {what}", place, hint)
    refs: list[PointRef] = []
    errors: list[InputError] = []
    for item in items:
        place = getattr(item, "where", kind.where)
        try:
            refs.append(point_names.point(item, place) if targets == "points" else point_names.body(item, place))
        except InputError as error:
            errors.append(error)
    if errors:
        reader.errors.extend(errors[:-1])
        raise errors[-1]
    return tuple(refs)


def _targets_hint(targets: str, counts: Sequence[int]) -> str:
    """Return the hint that says how many points or bodies are expected."""
    one, two = ("L1.head", "[L1.head, L2.tail]") if targets == "points" else ("L1", "[L1, L2]")
    examples = {1: f"one {'point' if targets == 'points' else 'body'}: {one}", 2: f"two {targets}: {two}"}
    return f"expected {' or '.join(examples[count] for count in counts)}"


def _pairs_hint(kind: Text, points: Sequence[object]) -> str:
    """Return the hint for several bodies on one pin: the joints, of two points each, that replace the list."""
    first, *others = (str(point)[:60] for point in points[:4])
    lines = ", ".join(f"{name}: {{{kind}: [{first}, {other}]}}" for name, other in zip("ABC", others, strict=False))
    return f"{len(points)} bodies on one pin are {len(points) - 1} joints: {lines}"


def refuse_same_body(kind: str, refs: Sequence[PointRef]) -> None:
    """Raise JoinError unless the references are two different bodies, or one body that is not the ground."""
    last = refs[-1]
    if len(refs) == 1 and last.body == GROUND:
        raise JoinError(f"{kind} acts on the ground", last.where, "expected a body: the ground does not move")
    if len(refs) == 2 and refs[0].body == last.body:
        what = "the ground to the ground" if last.body == GROUND else f"body {last.body} to itself"
        raise JoinError(f"{kind} joins {what}", last.where, "expected two different bodies")


@dataclass(frozen=True)
class FieldContext:
    """Contain the context in which the fields of a mapping are read."""

    owner: str  # address of the mapping
    why: str = ""  # the law, for messages of conditions that have no text
    place: Location | None = None  # location of defaults; None: the mapping's
    mistyped: frozenset[str | None] = frozenset()  # keys that unknown ones probably stand for: not reported as missing
    point_names: PointNames | None = None  # to check names of bodies


def read_fields(reader: Reader, node: Map, fields: Sequence[Field], context: FieldContext) -> Values:
    """Read the numbers, vectors, words, flags and bodies among the fields of a mapping, and record their conditions."""
    values = Values()
    for declared in fields:
        with reader.collect():
            if declared.name in node:
                _read_field(reader, node, declared, context, values)
            elif declared.required and declared.name not in context.mistyped:
                raise missing_key(declared.name, node.where, context.owner)
            elif declared.default is not None:
                _fill_in_default(
                    reader, declared, f"{context.owner}.{declared.name}", context.place or node.where, values
                )
    _record_bounds(reader, fields, context, values)
    return values


def _fill_in_default(reader: Reader, declared: Field, address: str, place: Location, values: Values) -> None:
    """Store the default of a field in `values`."""
    if declared.kind == NUMBER:
        number = Number(float(declared.default or 0.0), repr(declared.default))
        dimension = declared.dimension or DIMENSIONLESS
        values.quantities[declared.name] = reader.keep(Quantity(address, number, dimension, place))
    else:
        values.options[declared.name] = declared.choice


def _read_field(reader: Reader, node: Map, declared: Field, context: FieldContext, values: Values) -> None:
    """Read one field that the mapping contains into `values`."""
    address, text = f"{context.owner}.{declared.name}", node[declared.name]
    if declared.kind in (NUMBER, BODY) and not isinstance(text, Text):
        where = node.key(declared.name).where
        raise BadValueError(f"{address} is {kind_of(text)}", where, "expected a number or a text")
    if declared.kind == VECTOR:
        values.vectors[declared.name] = read_vector(reader, text, node.key(declared.name), declared, address)
    elif declared.kind == NUMBER:
        values.quantities[declared.name] = reader.quantity(text, address, declared.dimension, declared.varies)
        if declared.whole:
            reader.wholes[address] = declared.meaning
    elif declared.kind in (WORD, FLAG):
        values.options[declared.name] = _read_word(text, node.key(declared.name), declared, address)
    elif declared.kind == BODY and context.point_names is not None:
        values.options[declared.name] = context.point_names.check_body(text, text.where)


def read_vector(reader: Reader, pair: object, key: Text, declared: Field, address: str) -> Vector:
    """Read two numbers `address`.x and `address`.y as their field declares them; `key` is the key before them."""
    if not isinstance(pair, Items) or len(pair) != 2 or not all(isinstance(item, Text) for item in pair):
        raise BadValueError(f"{address} is {kind_of(pair)}", key.where, "expected a list of two: [x, y]")
    x, y = (
        reader.quantity(text, f"{address}.{axis}", declared.dimension, declared.varies)
        for text, axis in zip(pair, "xy", strict=True)
    )
    if declared.nonzero:
        reader.vectors_not_zero.append((x, y))
    return x, y


def _read_word(text: object, key: Text, declared: Field, address: str) -> str | bool:
    """Return one of the allowed words of a field, or True or False of a flag. Raises BadValueError."""
    words = {str(value).lower() if isinstance(value, bool) else value: value for value in declared.values}
    if not isinstance(text, Text) or text not in words:
        place = text.where if isinstance(text, Text) and not text.is_nothing else key.where
        hint = "expected true or false" if declared.kind == FLAG else known_hint(str(text), words)
        raise BadValueError(f"{address} is {kind_of(text)}", place, hint)
    return words[text]


def _record_bounds(reader: Reader, fields: Sequence[Field], context: FieldContext, values: Values) -> None:
    """Record the bounds of numbers and vectors as conditions; bounds of a limit come before those that use it."""
    seen: set[str] = set()
    waiting: list[tuple[Field, Bound]] = []
    for declared in fields:
        seen.add(declared.name)
        waiting = [*((declared, bound) for bound in declared.bounds), *waiting]
        for bounded, bound in waiting:
            if not isinstance(bound.limit, str) or bound.limit in seen:
                _record_bound(reader, bounded, bound, context, values)
        waiting = [(f, bound) for f, bound in waiting if isinstance(bound.limit, str) and bound.limit not in seen]


def _record_bound(reader: Reader, declared: Field, bound: Bound, context: FieldContext, values: Values) -> None:
    """Record one bound of a number, or of both components of a vector."""
    own = values.quantities.get(declared.name)
    limit = values.quantities.get(bound.limit) if isinstance(bound.limit, str) else bound.limit
    for number in values.vectors.get(declared.name, ()) if own is None else (own,):
        if limit is not None:
            reader.require(number, bound.relation, limit, bound.reason(declared, context.why))


def field_names(fields: Iterable[Field]) -> list[str]:
    """Return the keys of some fields."""
    return [declared.name for declared in fields]
