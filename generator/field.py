"""Declares what one key of a mechanism file may hold: kind of value, dimension, bounds.

The reader, `--set`, the JSON Schema and the tables of docs/format.md all use these declarations. Sections are declared
in generator/format/sections.py, joints, drives, forces and laws in generator/kinds.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

from gudgeon.language.units import DIMENSIONLESS, FORCE, LENGTH, Dimension

# kinds of fields
NUMBER = "number"  # an expression with a dimension
VECTOR = "vector"  # two such expressions
PLACE = "place"  # a number for a coordinate, two for a point
WORD = "word"  # one of the field's `values`
FLAG = "flag"  # true or false
TEXT = "text"
RESULTS = "results"  # names of results: a list, or a text with commas between
POINTS = "points"  # a list of pairs of numbers
DEPTHS = "depths"  # a list of numbers, or the count of zeros
NAME = "name"  # of an entry of the section `names`
BODY = "body"  # a body or the ground
CORNERS = "corners"  # three names of points of the same body
RECORD = "record"  # a mapping with the keys `fields`
MAPPING = "mapping"  # names, each with an `entry`
KINDS = "kinds"  # a mapping with one key that is a kind, and that kind's fields
LAW = "law"  # a mapping with `law:`, a kind, and that kind's fields
SCALARS = frozenset((NUMBER, WORD, FLAG, TEXT, NAME, BODY))

# names that the expression of a number may use in addition to parameters
OF_TIME = "t"
OF_MOTION = "t, coordinates and velocities"
OF_RESULTS = "t and anything that a result has"
OF_PENETRATION = "delta"
OF_CAM_ANGLE = "phi"
CONSTANT_IN_TIME = ("", OF_PENETRATION, OF_CAM_ANGLE)  # expressions that must not use t


RELATIONS: Mapping[str, Callable[[float, float], bool]] = {
    ">": operator.gt,
    ">=": operator.ge,
    "<": operator.lt,
    "<=": operator.le,
}


class Bound(NamedTuple):
    """Represent a condition on a number: its `relation` to a constant, or to another field of the same mapping."""

    relation: str  # ">" ">=" "<" "<="
    limit: float | str
    why: str = ""  # text of the message, "a mass is positive"; {name} is the field's name. "": its meaning

    def format_reason(self, field: Field, owner_name: str) -> str:
        """Return the reason of a violated bound for an error message, such as "a mass is positive".

        It is `why` with {name} replaced by the field's name. Without `why` it is the meaning of the field, followed by
        `owner_name`, the name of the law or mapping, in parentheses.
        """
        return self.why.format(name=field.name) if self.why else f"{field.meaning} ({owner_name})"


POSITIVE = (Bound(">", 0.0, "{name} is positive"),)
NOT_NEGATIVE = (Bound(">=", 0.0, "{name} is not negative"),)


@dataclass(frozen=True)
class Kind:
    """Represent a kind of joint, drive, force or law: the targets that its own key lists, and its other keys."""

    title: str
    fields: tuple[Field, ...]
    targets: str = ""  # "points", "bodies" or "coordinates"; a law has none
    counts: tuple[int, ...] = ()  # allowed numbers of targets
    foreign_names: tuple[str, ...] = ()  # names in other programs, for hints
    like: str = ""  # the kind of which this is another name, with some options fixed


@dataclass(frozen=True)
class Field:
    """Declare one key of a mapping: what it holds, its meaning in at most one sentence, its default and its bounds."""

    name: str
    kind: str  # one of the kinds of fields above
    meaning: str
    dimension: Dimension | None = DIMENSIONLESS  # None: any, or determined by another key
    required: bool = False
    default: float | str | bool | None = None  # default that the reader fills in (SI)
    alternative_key: str = ""  # another key that may stand in place of this one
    otherwise: str = ""  # what applies if the key is missing and has no default
    bounds: tuple[Bound, ...] = ()
    per: str = ""  # of a coefficient in N/m^n: the key of the exponent n, which determines the dimension
    varies: str = ""  # names that its expression may use in addition to parameters
    whole: bool = False  # of a number: 1, 2, 3
    nonzero: bool = False  # of a vector: not both components zero
    values: tuple[str | bool, ...] = ()  # allowed values of a word; a flag has (False, True)
    words: tuple[str, ...] = ()  # words allowed in place of a number
    sources: Mapping[str, str] | None = None  # word -> its source in the literature
    symbol: str = ""  # symbol in the literature, in LaTeX
    section: str = ""  # of a name: the section whose entry it is
    fields: tuple[Field, ...] = ()
    entry: Field | None = None
    keys: Mapping[str, Dimension] | None = None  # of a mapping with keys BODY.key: dimension by key
    addresses: tuple[str, ...] = ()  # patterns of keys that are addresses: bearings.NAME.journal_material
    given: tuple[str, ...] = ()  # names that always exist in a mapping
    kinds: Callable[[], Mapping[str, Kind]] | None = None

    @property
    def accepts_any_dimension(self) -> bool:
        """Return whether the field's dimension is not fixed (`dimension` is None), so that its unit is not checked."""
        return self.dimension is None

    @property
    def default_option(self) -> str | bool:
        """Return the default of a field that is a word, a flag or a body; any other default fails an assertion."""
        assert isinstance(self.default, (str, bool)), self.name
        return self.default

    def find_field(self, name: str, node: Any = ()) -> Field | None:
        """Return the field for the key `name` in a mapping, None if there is no such key.

        `node`, the mapping's contents, shows the kind, if the keys depend on it. A mapping with user-defined names
        returns the field of its entries for every name.
        """
        if self.kind == MAPPING:
            return self.entry
        return next((field for field in self.list_fields(node) if field.name == name), None)

    def list_fields(self, node: Any = ()) -> tuple[Field, ...]:
        """Return the fields of the allowed keys of a mapping.

        A field without `kinds` returns its own `fields`. Otherwise the fields are those of the kinds that `node`
        contains: by its key `law` if the field is a law and has this key, else by all its keys. If `node` contains no
        known kind, the fields of all kinds are returned.
        """
        if self.kinds is None:
            return self.fields
        kinds = self.kinds()
        kind_names = [str(node["law"])] if self.kind == LAW and "law" in node else list(node)
        return tuple(
            field
            for kind in [kind_name for kind_name in kind_names if kind_name in kinds] or kinds
            for field in kinds[kind].fields
        )


def resolve_dimensions(fields: Iterable[Field], node: Mapping[str, Any]) -> list[Field]:
    """Return fields in which those with `per` have the dimension N/m^n; n is the number in `node` or its default.

    The dimension is any (None) if n is not a plain number or has exponents finer than halves. Other fields are
    unchanged. `per` is the name of the field that holds n.
    """
    result = list(fields)
    defaults = {field.name: str(field.default) for field in result}
    for index, field in enumerate(result):
        exponent = str(node.get(field.per, defaults[field.per])) if field.per else ""
        if re.fullmatch(r"\d{1,3}(\.\d{1,9}|/[1-9])?", exponent):
            dimension = FORCE / LENGTH ** Fraction(exponent)
            result[index] = replace(field, dimension=dimension if dimension.has_halves_at_most else None)
    return result


def number(name: str, meaning: str, dimension: Dimension | None, **more: Any) -> Field:
    """Declare a number with a dimension; None: any dimension."""
    return Field(name, NUMBER, meaning, dimension, **more)


def vector(name: str, meaning: str, dimension: Dimension | None, **more: Any) -> Field:
    """Declare a vector of two numbers, [x, y]."""
    return Field(name, VECTOR, meaning, dimension, **more)


def word(
    name: str, meaning: str, words: Iterable[str], default: str, sources: Mapping[str, str] | None = None
) -> Field:
    """Declare an optional field whose value is one of some words.

    `words`: the allowed ones; `default`: the word if the key is missing. `sources` maps a word to its source in the
    literature; None: no word has one.
    """
    return Field(name, WORD, meaning, values=tuple(words), default=default, sources=sources)


def flag(name: str, meaning: str) -> Field:
    """Declare an optional field that is true or false, false by default."""
    return Field(name, FLAG, meaning, values=(False, True), default=False)


def body_or_ground(name: str, meaning: str) -> Field:
    """Declare an optional field that holds the name of a body or "ground"; "ground" is the default."""
    return Field(name, BODY, meaning, default="ground")


def declare_reference(
    section: str,
    name: str,
    meaning: str,
    required: bool = True,
    alternative_key: str = "",
    otherwise: str = "",
) -> Field:
    """Declare a field that refers by name to an entry of another section (foreign key), such as to one of `bearings`.

    `section`: the section with the entries; `name`, `meaning`: the key of the field, and what it holds.
    `alternative_key`: another key that may be given instead, "" for none. `otherwise`: what applies if the key is
    missing.
    """
    return Field(
        name,
        NAME,
        meaning,
        section=section,
        required=required,
        alternative_key=alternative_key,
        otherwise=otherwise,
    )


def record(name: str, meaning: str, *fields: Field, required: bool = False) -> Field:
    """Declare a field that holds a mapping with the keys `fields` and no others; it is optional by default."""
    return Field(name, RECORD, meaning, fields=fields, required=required)


def mapping(name: str, meaning: str, entry: Field, **more: Any) -> Field:
    """Declare a field that holds a mapping from names that the user chooses to values; `entry` declares each value."""
    return Field(name, MAPPING, meaning, entry=entry, **more)
