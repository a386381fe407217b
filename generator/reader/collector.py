"""Collects the errors, values, conditions and names that all parts of the reader of mechanism files share."""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from gudgeon.errors import (
    BadValueError,
    ExpressionError,
    InputError,
    InputErrors,
    Location,
    UnknownNameError,
    together,
)
from gudgeon.generator.field import CONSTANT_IN_TIME, OF_CAM_ANGLE, OF_PENETRATION
from gudgeon.generator.format.shapes import ANY_NAME, check_shape
from gudgeon.generator.mechanism import Condition, Quantity, Vector
from gudgeon.generator.reader.result_names import CamAngleNames, PenetrationNames, ResultDimension
from gudgeon.generator.reader.unit_or_name import choose_reading
from gudgeon.generator.yaml import NO_MERGE, Map, Text
from gudgeon.language.curves import Curve
from gudgeon.language.names import RESERVED, unknown_name
from gudgeon.language.parser import at, check_dimension, parse
from gudgeon.language.tree import CurveCall, Expr, Name, Number, Unary, curve_calls, evaluate, names, replaced
from gudgeon.language.unit_remedies import unit_remedies
from gudgeon.language.units import DIMENSIONLESS, TIME, Dimension

BROKEN = Name("t")  # the value of a named expression that cannot be read: no further error is reported where it is used
MAX_ERRORS = 50  # reading stops there: each error costs a search for the nearest name


@dataclass(frozen=True)
class NamedExpression:
    """Represent an entry of `expressions:`, which others use by its name."""

    written: Expr  # as in the file, with the names of other expressions
    value: Expr  # with the trees of other expressions in place of their names
    dimension: Dimension | None  # None: it fits any
    where: Location


@dataclass(frozen=True)
class _NumberNames(Container[str]):
    """Contain the names that stand for a number in the value at `address`: parameters and expressions, except its own.

    `constant`: the value must not depend on t or motion, so that named expressions are excluded.
    """

    reader: Reader
    address: str
    constant: bool

    def __contains__(self, name: object) -> bool:
        """Return whether `name` stands for a number in the value at `address`."""
        known = name in self.reader.parameters or name in self.reader.expressions and not self.constant
        return known and self.address not in (f"parameters.{name}", f"expressions.{name}")


class TooManyErrors(Exception):
    """Signal that the reader stops because the file has MAX_ERRORS errors or cannot be read further."""


class Reader:
    """Collect the errors of one file instead of stopping at the first.

    A number that cannot be read becomes NaN; no further error is reported for it.
    """

    def __init__(self, file: str) -> None:
        self.file = file
        self.errors: list[InputError] = []
        self.quantities: dict[str, Quantity] = {}  # by address
        self.conditions: list[Condition] = []
        self.vectors_not_zero: list[Vector] = []
        self.wholes: dict[str, str] = {}  # address -> meaning of a number that must be whole
        self.curves: dict[str, Curve] = {}
        self.expressions: dict[str, NamedExpression] = {}
        self.made_of: dict[str, tuple[str, ...]] = {}  # address -> named expressions that its value contains
        self.tables: dict[str, str] = {}  # path of each table of a curve -> sha256 of its bytes
        self.laws: dict[str, str] = {}  # name of each user-defined law -> key of its definition
        self.parameters: dict[str, Dimension | None] = {}  # None: defined without a unit
        self.uses: dict[
            str, set[Dimension]
        ] = {}  # parameters without a unit -> dimensions of the values in which they stand alone
        self.left_out: frozenset[str] = frozenset()  # names of entries whose shape is wrong
        self.refused: set[str] = set()  # names of parameters, curves and expressions that are not allowed
        self.texts: list[Text] = []  # all parsed expressions
        self.scopes: dict[str, ResultDimension] = {  # dimension of a name that is not a parameter, by `Field.varies`
            OF_PENETRATION: PenetrationNames(self.parameters),
            OF_CAM_ANGLE: CamAngleNames(self.parameters),
        }

    def check_shape(self, root: Map) -> Map:
        """Return the file's tree without the entries whose keys or node types are wrong.

        Their errors are collected, and their names go to `left_out`. Raises TooManyErrors if nothing is left to read.
        """
        with self.collect():
            checked = check_shape(root)
            is_twice = any(error.message != NO_MERGE for error in self.errors)
            twice = (ANY_NAME,) if is_twice else ()  # the duplicate may have been meant as a key that is missing
            self.left_out = checked.left_out.union(twice)
            self.errors += checked.errors
            return checked.root
        raise TooManyErrors  # nothing is left to read

    @contextmanager
    def collect(self) -> Iterator[None]:
        """Return a context manager that collects an InputError raised inside and continues after the block.

        Raises TooManyErrors if MAX_ERRORS errors were collected.
        """
        try:
            yield
        except InputErrors as several:
            self.errors.extend(several.errors)
        except InputError as error:
            self.errors.append(error)
        if len(self.errors) >= MAX_ERRORS:
            raise TooManyErrors

    def raise_errors(self) -> None:
        """Raise the collected errors: one error as itself, several as InputErrors; return if there are none.

        Duplicates and errors that follow from another error are left out.
        """
        several = {_error_key(e): e for e in reversed(self.errors)}.values()
        misnamed = self._with_refused_names()
        errors = [
            e for e in several if not (self._is_consequence(e) or any(_is_located_in(e, text) for text in misnamed))
        ]
        if errors:
            raise together(errors)

    def _is_consequence(self, error: InputError) -> bool:
        """Return whether an error reports an unknown name that belongs to an entry left out by `check_shape`."""
        name = re.match(r"unknown [^']*'([A-Za-z0-9_]+)", error.message)
        return isinstance(error, UnknownNameError) and bool(self.left_out.intersection((ANY_NAME, name and name[1])))

    def _with_refused_names(self) -> list[Text]:
        """Return the expressions that use a name whose definition was refused; their errors follow from that refusal.

        Names that are valid in every expression (t, pi) do not count.
        """
        names = [re.escape(name) for name in self.refused if name not in RESERVED]
        held = re.compile(rf"(?<![\w.])(?:{'|'.join(names)})(?!\w| *\()")
        return [text for text in self.texts if held.search(text)] if names else []

    def quantity(self, text: Text, address: str, expected: Dimension | None, varies: str = "") -> Quantity:
        """Read the number at `address` and return it; an error is collected, and the number is then NaN.

        `expected` is its dimension, None if any. `varies` says which names it may use besides parameters
        (generator/field.py).
        """
        tree: Expr = unreadable_number(text)
        found = expected

        def read(value: str) -> tuple[Expr, Dimension | None]:
            written = text if value is text else Text.make(value, text.where, text.plain, text.one_line)
            parsed = self.parse(written, address, constant=not varies)
            known = self.dimensions_of_names(parsed, text.where, varies)
            if known:
                parsed = choose_reading(written, parsed, expected, known.get, self.curves)
            return parsed, check_dimension(parsed, expected, known.get, text.where)

        with self.collect(), unit_remedies(text, text.where, read, expected, _NumberNames(self, "", False)):
            tree, found = read(text)
        if not isinstance(tree, Number):
            self._record_dimension(tree, expected)
            if parts := self.expressions_in_tree(tree):
                self.made_of[address] = parts
                tree = replaced(tree, {name: self.expressions[name].value for name in parts})
        self.quantities[address] = Quantity(address, tree, DIMENSIONLESS if found is None else found, text.where)
        return self.quantities[address]

    def dimension_of_number(self, name: str) -> Dimension | None:
        """Return the dimension of a parameter or named expression; None if it is unknown or defined without a unit."""
        return self.expressions[name].dimension if name in self.expressions else self.parameters.get(name)

    def keep(self, quantity: Quantity) -> Quantity:
        """Register a quantity under its address and return it."""
        self.quantities[quantity.address] = quantity
        return quantity

    def parse(self, text: Text, address: str, constant: bool = False) -> Expr:
        """Parse a scalar of the file and return its expression tree. Raises InputError, also for an empty or long text.

        `constant`: the value must not contain named expressions.
        """
        self.texts.append(text)
        if text.is_nothing:
            raise BadValueError(f"{address} has no value", text.where, "expected a number or an expression")
        if not text.one_line:
            raise ExpressionError(
                f"{address} stands on several lines", text.where, "expected an expression on one line"
            )
        return parse(text, text.where, _NumberNames(self, address, constant), self.curves)

    def dimensions_of_names(self, expr: Expr, where: Location, varies: str = "") -> dict[str, Dimension | None]:
        """Return the dimension of every name in `expr`.

        Raises an ExpressionError or UnknownNameError at a name that is not allowed there, InputErrors for several.
        """
        for call in curve_calls(expr):
            check_curve(call, at(where, call.offset), varies != "")
        found: dict[str, Dimension | None] = {}
        wrong: dict[str, InputError] = {}
        for name in names(expr):
            if name.path not in found and name.path not in wrong:
                try:
                    found[name.path] = self._dimension_of(name, at(where, name.offset), varies)
                except InputError as error:
                    wrong[name.path] = error
        if wrong:
            raise together(wrong.values())
        return found

    def _dimension_of(self, name: Name, place: Location, varies: str) -> Dimension | None:
        """Return the dimension of one name at `place`. Raises an InputError if `varies` does not allow it."""
        time, result = varies not in CONSTANT_IN_TIME, self.scopes.get(varies)
        if name.path == "t":
            return _dimension_of_time(place, time, result is not None)
        if name.path in self.parameters:
            return self.parameters[name.path]
        if name.path in self.expressions:
            self._check_expression(name.path, place, time, result)
            return self.expressions[name.path].dimension
        if result is not None:
            return result(name, place)
        if "." in name.path:
            hint = "expected parameters" + (" and t" if time else "") + ", which have no parts"
            raise ExpressionError(f"{name.path!r} cannot stand here", place, hint)
        if name.path.lower() in ("time", "t"):
            raise ExpressionError(f"{name.path!r} is no name here", place, "time is written t")
        raise unknown_name("name", name.path, (*self.parameters, *(self.expressions if varies else ())), place)

    def _check_expression(self, name: str, place: Location, time: bool, result: ResultDimension | None) -> None:
        """Raise ExpressionError if a named expression depends on time or motion and the value at `place` must not."""
        if not time and result is None:
            hint = (
                "expected parameters: an expression by name may hold t and motion, and can stand in drives, forces,"
                " events and outputs only"
            )
            raise ExpressionError(f"{name!r} is an expression, and this number is constant", place, hint)
        for read in self._dependencies_of(name):
            if read in self.parameters or read == "t" and time:
                continue
            if read == "t" or result is None:
                hint = f"expected {'t and parameters' if time else 'parameters'}"
                raise ExpressionError(f"{name!r} reads {read}, which cannot stand here", place, hint)
            result(Name(read), place)

    def _dependencies_of(self, name: str) -> Iterator[str]:
        """Yield the names that a named expression depends on, with other named expressions expanded."""
        for one in self.expressions_in_tree(Name(name)):
            yield from (read.path for read in names(self.expressions[one].written) if read.path not in self.expressions)

    def expressions_in_tree(self, expr: Expr) -> tuple[str, ...]:
        """Return the named expressions that `expr` contains, directly or through other named expressions."""
        found, waiting = dict[str, None](), [expr]
        while waiting:
            new = [x.path for x in names(waiting.pop()) if x.path in self.expressions and x.path not in found]
            found |= dict.fromkeys(new)
            waiting += [self.expressions[name].written for name in new]
        return tuple(found)

    def _record_dimension(self, expr: Expr, expected: Dimension | None) -> None:
        """Record `expected` as a dimension of a parameter without a unit, if the value is that parameter alone."""
        while isinstance(expr, Unary):
            expr = expr.operand
        if isinstance(expr, Name) and expected is not None and self.parameters.get(expr.path, TIME) is None:
            self.uses.setdefault(expr.path, set()).add(expected)

    def require(self, quantity: Quantity, relation: str, bound: float | Quantity, message: str) -> None:
        """Record the condition `quantity relation bound`, which is checked after reading and at each run-time override.

        `bound` is a number in SI units or another quantity; `message` states the condition in the error.
        """
        limit = bound.address if isinstance(bound, Quantity) else bound
        self.conditions.append(Condition(quantity.address, relation, limit, message))

    def require_less(self, quantity: Quantity, sum_of: str, message: str) -> None:
        """Record the condition that a quantity is less than a sum; `sum_of` contains the addresses joined by " + "."""
        self.conditions.append(Condition(quantity.address, "<", sum_of, message))


def _dimension_of_time(place: Location, may_stand: bool, of_penetration: bool) -> Dimension:
    """Return the dimension of t. Raises ExpressionError if the value must not depend on time.

    `of_penetration`: the value is the force of a contact, for which the message differs.
    """
    if may_stand:
        return TIME
    hint = "time can stand in drives and outputs only"
    if of_penetration:
        message = "'t' is time, and this force follows the penetration alone"
        raise ExpressionError(message, place, f"expected delta and parameters; {hint}")
    raise ExpressionError("'t' is time, and this number is constant", place, f"expected parameters; {hint}")


def _is_located_in(error: InputError, text: Text) -> bool:
    """Return whether the location of an error lies within an expression of the file."""
    if (at_error := error.where) is None or (at_error.file, at_error.line) != (text.where.file, text.where.line):
        return False
    return 0 <= at_error.column - text.where.column <= len(text)


def _error_key(error: InputError) -> tuple[str, str, str]:
    """Return the key by which duplicate errors are recognised: location, type, and message without contact and scene.

    An entry that contacts or scenes inherit is thus reported once, where it is written.
    """
    message = re.sub(r"\b(contacts\.|scenes\.|in scene )\w+", "", error.message)
    return str(error.where), type(error).__name__, message


def check_curve(call: CurveCall, place: Location, varies: bool) -> None:
    """Raise an InputError if a curve is not allowed at `place`, or if its constant argument is outside its range."""
    (argument,), curve = call.arguments, call.curve
    if not varies:
        hint = "expected parameters; a curve can stand in drives, forces, events and outputs only"
        raise ExpressionError(f"{call.function!r} is a curve, and this number is constant", place, hint)
    if not any(True for _ in names(argument)) and not curve.within(x := float(evaluate(argument, lambda _: 0.0))):
        message = f"curve {call.function} is called {curve.outside(x)}"
        raise BadValueError(message, place, "expected an argument in it")


def unreadable_number(text: str) -> Number:
    """Return NaN, which represents a number that could not be read."""
    return Number(math.nan, str(text))
