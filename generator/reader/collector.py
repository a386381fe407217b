"""What all parts of the reader share: the errors found so far, the numbers, what they must satisfy."""

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
from gudgeon.generator.reader.result_names import CamAngle, Penetration, ResultDimension
from gudgeon.generator.reader.unit_or_name import settle_reading
from gudgeon.generator.yaml import NO_MERGE, Map, Text
from gudgeon.language.curves import Curve
from gudgeon.language.names import RESERVED, unknown_name
from gudgeon.language.parser import at, check_dimension, parse
from gudgeon.language.tree import CurveCall, Expr, Name, Number, Unary, curve_calls, evaluate, names, replaced
from gudgeon.language.unit_remedies import unit_remedies
from gudgeon.language.units import DIMENSIONLESS, TIME, Dimension

BROKEN = Name("t")  # stands for an expression by name that cannot be read: its users are not told of it again
MOST_ERRORS = 50  # nobody reads more, and each costs a search for the nearest name


@dataclass(frozen=True)
class Named:
    """An expression of the file that others use by its name."""

    written: Expr
    value: Expr  # without the names of others: their trees
    dimension: Dimension | None  # None: it fits any
    where: Location


@dataclass(frozen=True)
class _Numbers(Container[str]):
    """Names that stand for a number in the value at `address`: parameters and expressions, but the value's own name."""

    reader: Reader
    address: str
    constant: bool

    def __contains__(self, name: object) -> bool:
        known = name in self.reader.parameters or name in self.reader.expressions and not self.constant
        return known and self.address not in (f"parameters.{name}", f"expressions.{name}")


class EnoughErrors(Exception):
    """Ends the reading of a file with very many mistakes."""


class Reader:
    """Collects errors instead of stopping at the first: what is broken becomes NaN and is asked no more."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.errors: list[InputError] = []
        self.quantities: dict[str, Quantity] = {}  # by address
        self.conditions: list[Condition] = []
        self.vectors_not_zero: list[Vector] = []
        self.wholes: dict[str, str] = {}  # address -> what is counted
        self.curves: dict[str, Curve] = {}
        self.expressions: dict[str, Named] = {}
        self.made_of: dict[str, tuple[str, ...]] = {}  # address -> expressions by name that are parts of it
        self.tables: dict[str, str] = {}  # files that curves were read from -> sha256
        self.laws: dict[str, str] = {}  # laws of the user's own -> their keys
        self.parameters: dict[str, Dimension | None] = {}  # None: defined without a unit
        self.uses: dict[str, set[Dimension]] = {}  # of those: what they were used as
        self.left_out: frozenset[str] = frozenset()  # names of entries whose shape is wrong
        self.refused: set[str] = set()  # names of parameters, curves and expressions that cannot be
        self.texts: list[Text] = []  # expressions
        self.scopes: dict[str, ResultDimension] = {  # of names that are no parameters, by what a field `varies` with
            OF_PENETRATION: Penetration(self.parameters),
            OF_CAM_ANGLE: CamAngle(self.parameters),
        }

    def check_shape(self, root: Map) -> Map:
        """The file without the entries whose shape is wrong: these are told, and not missed."""
        with self.collect():
            checked = check_shape(root)
            is_twice = any(error.message != NO_MERGE for error in self.errors)
            twice = (ANY_NAME,) if is_twice else ()  # it may stand for a key that is missing now
            self.left_out = checked.left_out.union(twice)
            self.errors += checked.errors
            return checked.root
        raise EnoughErrors  # nothing is left to read

    @contextmanager
    def collect(self) -> Iterator[None]:
        """Keep the error that is raised inside, and go on."""
        try:
            yield
        except InputErrors as several:
            self.errors.extend(several.errors)
        except InputError as error:
            self.errors.append(error)
        if len(self.errors) >= MOST_ERRORS:
            raise EnoughErrors

    def raise_errors(self) -> None:
        """Raise what was collected: one error as itself, several as InputErrors."""
        several = {_told(e): e for e in reversed(self.errors)}.values()
        misnamed = self._with_refused_names()
        errors = [e for e in several if not (self._follows(e) or any(_stands_in(e, text) for text in misnamed))]
        if errors:
            raise together(errors)

    def _follows(self, error: InputError) -> bool:
        """Whether an error is that of a name whose entry was left out."""
        name = re.match(r"unknown [^']*'([A-Za-z0-9_]+)", error.message)
        return isinstance(error, UnknownNameError) and bool(self.left_out.intersection((ANY_NAME, name and name[1])))

    def _with_refused_names(self) -> list[Text]:
        """Expressions with a name that was refused where it is defined: what is told of them follows from that.

        What an expression may hold all the same (t, pi) says nothing of the rest.
        """
        names = [re.escape(name) for name in self.refused if name not in RESERVED]
        held = re.compile(rf"(?<![\w.])(?:{'|'.join(names)})(?!\w| *\()")
        return [text for text in self.texts if held.search(text)] if names else []

    def quantity(self, text: Text, address: str, expected: Dimension | None, varies: str = "") -> Quantity:
        """Return the number at `address`; `varies` says what it may use besides parameters (generator/field.py).

        An error is collected, and the number is then NaN.
        """
        tree: Expr = broken(text)
        found = expected

        def read(value: str) -> tuple[Expr, Dimension | None]:
            written = text if value is text else Text.make(value, text.where, text.plain, text.one_line)
            parsed = self.parse(written, address, constant=not varies)
            known = self.check_names(parsed, text.where, varies)
            if known:
                parsed = settle_reading(written, parsed, expected, known.get, self.curves)
            return parsed, check_dimension(parsed, expected, known.get, text.where)

        with self.collect(), unit_remedies(text, text.where, read, expected, _Numbers(self, "", False)):
            tree, found = read(text)
        if not isinstance(tree, Number):
            self._note_use(tree, expected)
            if parts := self.expressions_in(tree):
                self.made_of[address] = parts
                tree = replaced(tree, {name: self.expressions[name].value for name in parts})
        self.quantities[address] = Quantity(address, tree, DIMENSIONLESS if found is None else found, text.where)
        return self.quantities[address]

    def dimension_of_number(self, name: str) -> Dimension | None:
        """Return the dimension of a parameter or an expression, None where it has or is known to have none."""
        return self.expressions[name].dimension if name in self.expressions else self.parameters.get(name)

    def keep(self, quantity: Quantity) -> Quantity:
        """Register a quantity under its address."""
        self.quantities[quantity.address] = quantity
        return quantity

    def parse(self, text: Text, address: str, constant: bool = False) -> Expr:
        """The tree of a scalar. Raises what expressions.parse raises, and on nothing or several lines.

        `constant`: expressions by name cannot stand in it.
        """
        self.texts.append(text)
        if text.is_nothing:
            raise BadValueError(f"{address} has no value", text.where, "expected a number or an expression")
        if not text.one_line:
            raise ExpressionError(
                f"{address} stands on several lines", text.where, "expected an expression on one line"
            )
        return parse(text, text.where, _Numbers(self, address, constant), self.curves)

    def check_names(self, expr: Expr, where: Location, varies: str = "") -> dict[str, Dimension | None]:
        """Return the dimension of every name in `expr`.

        Raises an ExpressionError or UnknownNameError at a name that cannot stand there, InputErrors of several.
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
        time, result = varies not in CONSTANT_IN_TIME, self.scopes.get(varies)
        if name.path == "t":
            return _of_time(place, time, result is not None)
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
        """Raise ExpressionError where an expression by name reads what may not be read here."""
        if not time and result is None:
            hint = (
                "expected parameters: an expression by name may hold t and motion, and can stand in drives, forces,"
                " events and outputs only"
            )
            raise ExpressionError(f"{name!r} is an expression, and this number is constant", place, hint)
        for read in self._read_by(name):
            if read in self.parameters or read == "t" and time:
                continue
            if read == "t" or result is None:
                hint = f"expected {'t and parameters' if time else 'parameters'}"
                raise ExpressionError(f"{name!r} reads {read}, which cannot stand here", place, hint)
            result(Name(read), place)

    def _read_by(self, name: str) -> Iterator[str]:
        """What an expression by name is made of, with what its own names are made of."""
        for one in self.expressions_in(Name(name)):
            yield from (read.path for read in names(self.expressions[one].written) if read.path not in self.expressions)

    def expressions_in(self, expr: Expr) -> tuple[str, ...]:
        """Expressions by name that stand in another one, and those that stand in these."""
        found, waiting = dict[str, None](), [expr]
        while waiting:
            new = [x.path for x in names(waiting.pop()) if x.path in self.expressions and x.path not in found]
            found |= dict.fromkeys(new)
            waiting += [self.expressions[name].written for name in new]
        return tuple(found)

    def _note_use(self, expr: Expr, expected: Dimension | None) -> None:
        """A parameter without a unit takes the dimension of the place where it stands alone."""
        while isinstance(expr, Unary):
            expr = expr.operand
        if isinstance(expr, Name) and expected is not None and self.parameters.get(expr.path, TIME) is None:
            self.uses.setdefault(expr.path, set()).add(expected)

    def require(self, quantity: Quantity, relation: str, bound: float | Quantity, message: str) -> None:
        """Note a condition, for now and for every override at run time."""
        limit = bound.address if isinstance(bound, Quantity) else bound
        self.conditions.append(Condition(quantity.address, relation, limit, message))

    def require_less(self, quantity: Quantity, sum_of: str, message: str) -> None:
        """A condition whose bound is a sum: addresses with " + " between."""
        self.conditions.append(Condition(quantity.address, "<", sum_of, message))


def _of_time(place: Location, may_stand: bool, of_penetration: bool) -> Dimension:
    """Return the dimension of t. Raises ExpressionError where it cannot stand."""
    if may_stand:
        return TIME
    hint = "time can stand in drives and outputs only"
    if of_penetration:
        message = "'t' is time, and this force follows the penetration alone"
        raise ExpressionError(message, place, f"expected delta and parameters; {hint}")
    raise ExpressionError("'t' is time, and this number is constant", place, f"expected parameters; {hint}")


def _stands_in(error: InputError, text: Text) -> bool:
    """Whether an error's place lies in an expression."""
    if (at_error := error.where) is None or (at_error.file, at_error.line) != (text.where.file, text.where.line):
        return False
    return 0 <= at_error.column - text.where.column <= len(text)


def _told(error: InputError) -> tuple[str, str, str]:
    """What makes two errors the same: what a contact or scene inherits is wrong once, where it is written."""
    message = re.sub(r"\b(contacts\.|scenes\.|in scene )\w+", "", error.message)
    return str(error.where), type(error).__name__, message


def check_curve(call: CurveCall, place: Location, varies: bool) -> None:
    """Raise where a curve may not stand, or is called outside its range by a number that is written there."""
    (argument,), curve = call.arguments, call.curve
    if not varies:
        hint = "expected parameters; a curve can stand in drives, forces, events and outputs only"
        raise ExpressionError(f"{call.function!r} is a curve, and this number is constant", place, hint)
    if not any(True for _ in names(argument)) and not curve.within(x := float(evaluate(argument, lambda _: 0.0))):
        told = f"curve {call.function} is called {curve.outside(x)}"
        raise BadValueError(told, place, "expected an argument in it")


def broken(text: str) -> Number:
    """Stands for a number that could not be read."""
    return Number(math.nan, str(text))
