"""Reads the keys of a YAML mapping by their declarations, and finds the key that names the kind of an entry."""

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
from gudgeon.generator.format.shapes import make_missing_key_error, make_unknown_key_error
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import GROUND, PointRef, Quantity, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.point_names import PointNames
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.names import find_nearest_name, format_name_hint
from gudgeon.language.text_output import format_count
from gudgeon.language.tree import Number
from gudgeon.language.units import DIMENSIONLESS

_NO_HINTS: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class Values:
    """Contain the numbers, vectors and options of a mapping by field name, with defaults filled in."""

    quantities: dict[str, Quantity] = field(default_factory=dict)
    vectors: dict[str, Vector] = field(default_factory=dict)
    options: dict[str, str | bool] = field(default_factory=dict)

    def format_options(self) -> dict[str, str]:
        """Return the options as texts, as a file writes them: True becomes "true"."""
        return {name: str(value).lower() if isinstance(value, bool) else value for name, value in self.options.items()}


class _Kind(Protocol):
    """Represent a kind of joint, drive or force: its keys and the names that other programs give it."""

    @property
    def fields(self) -> tuple[Field, ...]: ...

    @property
    def foreign_names(self) -> tuple[str, ...]: ...


def read_kind(
    reader: Reader, node: Map, kinds: Mapping[str, _Kind], address: str, hints: Mapping[str, str] = _NO_HINTS
) -> tuple[Text, frozenset[str | None]]:
    """Return (kind, mistyped keys): the key that states an entry's kind, and the valid keys that unknown keys resemble.

    Errors of unknown keys are collected (`report_unknown_keys`); None stands for an unknown key that resembles no valid
    one. `address` is the entry's address; `hints` maps keys of other sections to a hint. Raises an InputError if there
    is no kind or more than one.
    """
    kind_key = find_kind_key(
        node, kinds, [key for kind_type in kinds.values() for key in list_field_names(kind_type.fields)], address
    )
    return kind_key, report_unknown_keys(
        reader, node, [kind_key, *list_field_names(kinds[kind_key].fields)], address, hints
    )


def find_kind_key(node: Map, kinds: Mapping[str, _Kind], other_keys: Iterable[str], address: str) -> Text:
    """Return the only key of a mapping that is a kind. Raises an InputError if there is none or more than one.

    `kinds` maps kinds to their declarations, `other_keys` are the other allowed keys, `address` is the mapping's
    address. The hint names the kind that another program calls by an unknown key.
    """
    kind_keys = [key for key in node.list_keys() if key in kinds]
    if len(kind_keys) == 1:
        return kind_keys[0]
    if kind_keys:
        raise UnknownKeyError(
            f"{address} is both {kind_keys[0]} and {kind_keys[1]}", kind_keys[1].where, "expected one kind"
        )
    unknown = next((key for key in node.list_keys() if key not in other_keys), None)
    foreign_names = {
        foreign_name: kind for kind, kind_type in kinds.items() for foreign_name in kind_type.foreign_names
    }
    for key in node.list_keys():
        if key.lower() in foreign_names:
            raise make_unknown_key_error(
                key, kinds, address, f"{str(key)!r} is called {foreign_names[key.lower()]} here"
            )
    if unknown is None:
        raise MissingKeyError(f"{address} has no kind", node.where, format_name_hint("", kinds))
    raise make_unknown_key_error(unknown, kinds, address)


def report_unknown_keys(
    reader: Reader, node: Map, known_keys: Sequence[str], address: str, hints: Mapping[str, str] = _NO_HINTS
) -> frozenset[str | None]:
    """Collect an error for each unknown key of an entry, and return the known keys that these probably stand for.

    The set contains None for a key that resembles no known key. `address` is the entry's address; `hints` maps keys of
    other sections to a hint where to write them.
    """
    unknown_keys = [key for key in node.list_keys() if key not in known_keys]
    reader.errors.extend(make_unknown_key_error(key, known_keys, address, hints.get(key, "")) for key in unknown_keys)
    return frozenset(find_nearest_name(key, known_keys) for key in unknown_keys)


def read_targets(
    reader: Reader, node: Map, kind: Text, target_kind: str, counts: Sequence[int], point_names: PointNames
) -> tuple[PointRef, ...]:
    """Return the points (`target_kind` "points") or bodies that an entry lists, in the order of the file.

    `kind` is the key of the list; `counts` are the allowed numbers of targets. All names are checked: the last error is
    raised, the others are collected. Raises BadValueError for another number of targets.
    """
    value = node[kind]
    items = list(value) if isinstance(value, Items) else [value]
    if len(items) not in counts or isinstance(value, Items) and len(items) == 1:
        singular, plural = ("point", "points") if target_kind == "points" else ("body", "bodies")
        phrase = format_count(len(items), singular, plural) if isinstance(value, Items) else describe_node(value)
        location = value.where if isinstance(value, Items) else kind.where
        hint = _format_targets_hint(target_kind, counts)
        joint = find_joint_types().get(kind)
        if len(items) > 2 and joint and joint.is_pivot and all(isinstance(item, Text) for item in items):
            hint += f"; {_format_joints_hint(kind, items)}"
        raise BadValueError(f"{kind} has {phrase}", location, hint)
    references: list[PointRef] = []
    errors: list[InputError] = []
    for item in items:
        location = getattr(item, "where", kind.where)
        try:
            references.append(
                point_names.resolve_point(item, location)
                if target_kind == "points"
                else point_names.resolve_body(item, location)
            )
        except InputError as error:
            errors.append(error)
    if errors:
        reader.errors.extend(errors[:-1])
        raise errors[-1]
    return tuple(references)


def _format_targets_hint(target_kind: str, counts: Sequence[int]) -> str:
    """Return the hint that says how many points or bodies are expected, with an example for each allowed number."""
    single_example, pair_example = ("L1.head", "[L1.head, L2.tail]") if target_kind == "points" else ("L1", "[L1, L2]")
    examples = {
        1: f"one {'point' if target_kind == 'points' else 'body'}: {single_example}",
        2: f"two {target_kind}: {pair_example}",
    }
    return f"expected {' or '.join(examples[count] for count in counts)}"


def _format_joints_hint(kind: Text, points: Sequence[object]) -> str:
    """Return the hint for more than two points at one pin: the joints of two points each that replace the list.

    At most three joints are written out; texts of points are cut at 60 characters.
    """
    first_point, *other_points = (str(point)[:60] for point in points[:4])
    lines = ", ".join(
        f"{name}: {{{kind}: [{first_point}, {other_point}]}}"
        for name, other_point in zip("ABC", other_points, strict=False)
    )
    return f"write {len(points)} bodies on one pin as {len(points) - 1} joints: {lines}"


def check_different_bodies(kind: str, references: Sequence[PointRef]) -> None:
    """Raise JoinError unless the references are two different bodies, or one body that is not the ground."""
    last = references[-1]
    if len(references) == 1 and last.body == GROUND:
        raise JoinError(f"{kind} acts on the ground", last.where, "expected a body: the ground does not move")
    if len(references) == 2 and references[0].body == last.body:
        phrase = "the ground to the ground" if last.body == GROUND else f"body {last.body} to itself"
        raise JoinError(f"{kind} joins {phrase}", last.where, "expected two different bodies")


@dataclass(frozen=True)
class FieldContext:
    """Contain the context in which the fields of a mapping are read."""

    address: str  # address of the mapping
    reason: str = ""  # the law, for messages of conditions that have no text
    default_location: Location | None = None  # location of defaults; None: the mapping's
    mistyped_keys: frozenset[str | None] = (
        frozenset()
    )  # keys that unknown ones probably stand for: not reported as missing
    point_names: PointNames | None = None  # to check names of bodies


def read_fields(reader: Reader, node: Map, fields: Sequence[Field], context: FieldContext) -> Values:
    """Return the numbers, vectors, words, flags and bodies among the fields of a mapping, and record their conditions.

    Defaults are filled in. Errors are collected, also for a required key that is missing, unless an unknown key
    probably stands for it (`context.mistyped_keys`).
    """
    values = Values()
    for declaration in fields:
        with reader.collect_errors():
            if declaration.name in node:
                _read_field(reader, node, declaration, context, values)
            elif declaration.required and declaration.name not in context.mistyped_keys:
                raise make_missing_key_error(declaration.name, node.where, context.address)
            elif declaration.default is not None:
                _fill_in_default(
                    reader,
                    declaration,
                    f"{context.address}.{declaration.name}",
                    context.default_location or node.where,
                    values,
                )
    _record_bounds(reader, fields, context, values)
    return values


def _fill_in_default(reader: Reader, declaration: Field, address: str, location: Location, values: Values) -> None:
    """Store the default of a field in `values`.

    A number becomes a registered quantity at `address`; a word, flag or body becomes an option.
    """
    if declaration.kind == NUMBER:
        number = Number(float(declaration.default or 0.0), repr(declaration.default))
        dimension = declaration.dimension or DIMENSIONLESS
        values.quantities[declaration.name] = reader.register_quantity(Quantity(address, number, dimension, location))
    else:
        values.options[declaration.name] = declaration.default_option


def _read_field(reader: Reader, node: Map, declaration: Field, context: FieldContext, values: Values) -> None:
    """Read the value of one field whose key is present, check it by the field's kind, and store it in `values`.

    Numbers are stored in `quantities`, vectors in `vectors`, words, flags and bodies in `options`. Fields of other
    kinds (names, records) are skipped: other readers read them. The caller handles missing keys. Raises BadValueError
    for a node of the wrong type.
    """
    address, node_of_field = f"{context.address}.{declaration.name}", node[declaration.name]
    if declaration.kind in (NUMBER, BODY) and not isinstance(node_of_field, Text):
        location = node.find_key(declaration.name).where
        raise BadValueError(f"{address} is {describe_node(node_of_field)}", location, "expected a number or a text")
    if declaration.kind == VECTOR:
        values.vectors[declaration.name] = read_vector(
            reader, node_of_field, node.find_key(declaration.name), declaration, address
        )
    elif declaration.kind == NUMBER:
        values.quantities[declaration.name] = reader.read_quantity(
            node_of_field, address, declaration.dimension, declaration.varies
        )
        if declaration.whole:
            reader.meaning_of_integers[address] = declaration.meaning
    elif declaration.kind in (WORD, FLAG):
        values.options[declaration.name] = _read_word(
            node_of_field, node.find_key(declaration.name), declaration, address
        )
    elif declaration.kind == BODY and context.point_names is not None:
        values.options[declaration.name] = context.point_names.check_body(node_of_field, node_of_field.where)


def read_vector(reader: Reader, node: object, key: Text, declaration: Field, address: str) -> Vector:
    """Return the two quantities `address`.x and `address`.y of a list [x, y], read as their field declares.

    `key` is the key before the list, for the location of errors. A vector that must not be zero is recorded for
    `check_values`. Raises BadValueError unless `node` is a list of two scalars.
    """
    if not isinstance(node, Items) or len(node) != 2 or not all(isinstance(item, Text) for item in node):
        raise BadValueError(f"{address} is {describe_node(node)}", key.where, "expected a list of two: [x, y]")
    x, y = (
        reader.read_quantity(text, f"{address}.{axis}", declaration.dimension, declaration.varies)
        for text, axis in zip(node, "xy", strict=True)
    )
    if declaration.nonzero:
        reader.nonzero_vectors.append((x, y))
    return x, y


def _read_word(node: object, key: Text, declaration: Field, address: str) -> str | bool:
    """Return one of the allowed words of a field; for a flag, True or False. Raises BadValueError.

    `key` is the key before the node, which locates the error if the node is empty or not a scalar.
    """
    allowed_values = {str(value).lower() if isinstance(value, bool) else value: value for value in declaration.values}
    if not isinstance(node, Text) or node not in allowed_values:
        location = node.where if isinstance(node, Text) and not node.is_null else key.where
        hint = "expected true or false" if declaration.kind == FLAG else format_name_hint(str(node), allowed_values)
        raise BadValueError(f"{address} is {describe_node(node)}", location, hint)
    return allowed_values[node]


def _record_bounds(reader: Reader, fields: Sequence[Field], context: FieldContext, values: Values) -> None:
    """Record the bounds of numbers and vectors as conditions, which `check_values` evaluates later.

    A bound by another field is recorded after that field's own bounds, so that an error of the limit is reported
    first.
    """
    visited: set[str] = set()
    postponed: list[tuple[Field, Bound]] = []
    for declaration in fields:
        visited.add(declaration.name)
        postponed = [*((declaration, bound) for bound in declaration.bounds), *postponed]
        for bounded_declaration, bound in postponed:
            if not isinstance(bound.limit, str) or bound.limit in visited:
                _record_bound(reader, bounded_declaration, bound, context, values)
        postponed = [
            (bounded_declaration, bound)
            for bounded_declaration, bound in postponed
            if isinstance(bound.limit, str) and bound.limit not in visited
        ]


def _record_bound(reader: Reader, declaration: Field, bound: Bound, context: FieldContext, values: Values) -> None:
    """Record one bound of a number, or of both components of a vector, as a condition of the reader.

    Nothing is recorded if the number or the field that limits it was not read.
    """
    quantity = values.quantities.get(declaration.name)
    limit = values.quantities.get(bound.limit) if isinstance(bound.limit, str) else bound.limit
    for bounded_quantity in values.vectors.get(declaration.name, ()) if quantity is None else (quantity,):
        if limit is not None:
            reader.add_condition(
                bounded_quantity, bound.relation, limit, bound.format_reason(declaration, context.reason)
            )


def list_field_names(fields: Iterable[Field]) -> list[str]:
    """Return the keys of some fields."""
    return [declared.name for declared in fields]
