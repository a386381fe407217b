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
    combine_errors,
)
from gudgeon.generator.field import CONSTANT_IN_TIME, OF_CAM_ANGLE, OF_PENETRATION
from gudgeon.generator.format.shapes import ANY_NAME, check_tree_structure
from gudgeon.generator.mechanism import Condition, Quantity, Vector
from gudgeon.generator.reader.result_names import CamAngleNames, PenetrationNames, ResultDimension
from gudgeon.generator.reader.unit_or_name import choose_interpretation
from gudgeon.generator.yaml import NO_MERGE, Map, Text
from gudgeon.language.curves import Curve
from gudgeon.language.names import RESERVED, make_unknown_name_error
from gudgeon.language.parser import check_dimension, offset_location, parse
from gudgeon.language.tree import (
    CurveCall,
    Expr,
    Name,
    Number,
    Unary,
    evaluate,
    iterate_curve_calls,
    iterate_names,
    replace_names,
)
from gudgeon.language.unit_remedies import add_unit_hints
from gudgeon.language.units import DIMENSIONLESS, TIME, Dimension

UNREADABLE_EXPRESSION = Name(
    "t"
)  # the value of a named expression that cannot be read: no further error is reported where it is used
MAX_ERRORS = 50  # reading stops there: each error costs a search for the nearest name


@dataclass(frozen=True)
class NamedExpression:
    """Represent an entry of `expressions:`, which other values use by its name."""

    source_tree: Expr  # as in the file, with the names of other expressions
    expanded_tree: Expr  # with the trees of other expressions in place of their names
    dimension: Dimension | None  # None: it fits any
    where: Location


@dataclass(frozen=True)
class _NumberNames(Container[str]):
    """Contain the names of parameters and named expressions that the value at `address` may use, except its own name.

    `constant`: the value must not depend on t or motion, so that named expressions are excluded.
    """

    reader: Reader
    address: str
    constant: bool

    def __contains__(self, name: object) -> bool:
        """Return whether `name` is a parameter or an allowed named expression, and not the one at `address` itself."""
        is_known = name in self.reader.parameters or name in self.reader.expressions and not self.constant
        return is_known and self.address not in (f"parameters.{name}", f"expressions.{name}")


class TooManyErrors(Exception):
    """Signal that the reader stops because the file has MAX_ERRORS errors or cannot be read further."""


class Reader:
    """Collect the errors of one file instead of stopping at the first.

    A number that cannot be read becomes NaN; no further error is reported for it.
    """

    def __init__(self, file: str) -> None:
        """Begin without errors and values; `file` is the name of the file for messages."""
        self.file = file
        self.errors: list[InputError] = []
        self.quantities: dict[str, Quantity] = {}  # by address
        self.conditions: list[Condition] = []
        self.nonzero_vectors: list[Vector] = []
        self.meaning_of_integers: dict[str, str] = {}  # address -> meaning of a number that must be whole
        self.curves: dict[str, Curve] = {}
        self.expressions: dict[str, NamedExpression] = {}
        self.named_expressions_used: dict[
            str, tuple[str, ...]
        ] = {}  # address -> named expressions that its value contains
        self.tables: dict[str, str] = {}  # path of each table of a curve -> sha256 of its bytes
        self.laws: dict[str, str] = {}  # name of each user-defined law -> key of its definition
        self.parameters: dict[str, Dimension | None] = {}  # None: defined without a unit
        self.candidate_dimensions: dict[
            str, set[Dimension]
        ] = {}  # parameters without a unit -> dimensions of the values in which they stand alone
        self.removed_names: frozenset[str] = frozenset()  # names of entries whose shape is wrong
        self.invalid_names: set[str] = set()  # names of parameters, curves and expressions that are not allowed
        self.parsed_texts: list[Text] = []  # all parsed expressions
        self.result_scopes: dict[
            str, ResultDimension
        ] = {  # dimension of a name that is not a parameter, by `Field.varies`
            OF_PENETRATION: PenetrationNames(self.parameters),
            OF_CAM_ANGLE: CamAngleNames(self.parameters),
        }

    def remove_invalid_entries(self, root: Map) -> Map:
        """Return the file's tree without the entries whose keys or node types are wrong.

        Their errors are collected, and the names of the removed entries are stored in `removed_names`. A key that is
        given twice adds ANY_NAME to them, since it may have been meant as a missing key. Raises TooManyErrors if
        nothing is left to read.
        """
        with self.collect_errors():
            checked = check_tree_structure(root)
            has_duplicates = any(error.message != NO_MERGE for error in self.errors)
            unknown_names = (
                (ANY_NAME,) if has_duplicates else ()
            )  # the duplicate may have been meant as a key that is missing
            self.removed_names = checked.removed_names.union(unknown_names)
            self.errors += checked.errors
            return checked.root
        raise TooManyErrors  # nothing is left to read

    @contextmanager
    def collect_errors(self) -> Iterator[None]:
        """Return a context manager that collects an InputError raised inside and continues after the block.

        InputErrors are collected one by one. Raises TooManyErrors at the end if MAX_ERRORS errors were collected.
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

        Left out are duplicates, unknown names of entries that `remove_invalid_entries` removed, and errors in
        expressions that use an invalid name: they follow from another error.
        """
        unique_errors = {_make_error_key(error): error for error in reversed(self.errors)}.values()
        texts_with_invalid_names = self._find_texts_with_invalid_names()
        errors = [
            error
            for error in unique_errors
            if not (
                self._is_unknown_name_of_removed_entry(error)
                or any(_is_located_in(error, text) for text in texts_with_invalid_names)
            )
        ]
        if errors:
            raise combine_errors(errors)

    def _is_unknown_name_of_removed_entry(self, error: InputError) -> bool:
        """Return whether an error reports an unknown name of an entry that `remove_invalid_entries` removed.

        If a whole section was removed (ANY_NAME), this holds for every unknown name.
        """
        name = re.match(r"unknown [^']*'([A-Za-z0-9_]+)", error.message)
        return isinstance(error, UnknownNameError) and bool(
            self.removed_names.intersection((ANY_NAME, name and name[1]))
        )

    def _find_texts_with_invalid_names(self) -> list[Text]:
        """Return the parsed expressions that use an invalid name: one whose definition was refused with an error.

        Such a name is undefined in the expression, so that the errors of the expression follow from that one. Names
        that are valid in every expression (t, pi) do not count. [] if there is no invalid name.
        """
        names = [re.escape(name) for name in self.invalid_names if name not in RESERVED]
        pattern = re.compile(rf"(?<![\w.])(?:{'|'.join(names)})(?!\w| *\()")
        return [text for text in self.parsed_texts if pattern.search(text)] if names else []

    def read_quantity(self, text: Text, address: str, expected: Dimension | None, name_scope: str = "") -> Quantity:
        """Read the number or expression at an address, check its dimension, and register and return it as a quantity.

        `expected` is its dimension, None if any. `name_scope` is the set of names that it may use in addition to
        parameters, such as OF_TIME (generator/field.py). Named expressions are replaced by their trees. An error is
        collected, and the value is NaN then.
        """
        tree: Expr = make_unreadable_number(text)
        dimension = expected

        def read_spelling(spelling_text: str) -> tuple[Expr, Dimension | None]:
            """Return the expression tree and dimension of one spelling of the value. Raises InputError.

            A name that is also a unit is interpreted by `choose_interpretation`. `add_unit_hints` calls this function
            with other spellings.
            """
            spelling = (
                text if spelling_text is text else Text.make_text(spelling_text, text.where, text.plain, text.one_line)
            )
            parsed = self.parse_expression(spelling, address, constant=not name_scope)
            dimensions = self.find_name_dimensions(parsed, text.where, name_scope)
            if dimensions:
                parsed = choose_interpretation(spelling, parsed, expected, dimensions.get, self.curves)
            return parsed, check_dimension(parsed, expected, dimensions.get, text.where)

        with (
            self.collect_errors(),
            add_unit_hints(text, text.where, read_spelling, expected, _NumberNames(self, "", False)),
        ):
            tree, dimension = read_spelling(text)
        if not isinstance(tree, Number):
            self._record_candidate_dimension(tree, expected)
            if used_expressions := self.find_named_expressions(tree):
                self.named_expressions_used[address] = used_expressions
                tree = replace_names(tree, {name: self.expressions[name].expanded_tree for name in used_expressions})
        self.quantities[address] = Quantity(
            address, tree, DIMENSIONLESS if dimension is None else dimension, text.where
        )
        return self.quantities[address]

    def find_number_dimension(self, name: str) -> Dimension | None:
        """Return the dimension of a parameter or named expression.

        None if the name is unknown, or if it was defined without a unit (`c: 0.1`) and thus fits any dimension.
        """
        return self.expressions[name].dimension if name in self.expressions else self.parameters.get(name)

    def register_quantity(self, quantity: Quantity) -> Quantity:
        """Register a quantity under its address, replacing one that is there, and return it."""
        self.quantities[quantity.address] = quantity
        return quantity

    def parse_expression(self, text: Text, address: str, constant: bool = False) -> Expr:
        """Parse a scalar of the file and return its expression tree; its text is recorded in `parsed_texts`.

        `constant`: the value must not contain named expressions. Raises BadValueError for an empty value,
        ExpressionError for a text on several lines, and InputError for other errors.
        """
        self.parsed_texts.append(text)
        if text.is_null:
            raise BadValueError(f"{address} has no value", text.where, "expected a number or an expression")
        if not text.one_line:
            raise ExpressionError(f"{address} is on several lines", text.where, "expected an expression on one line")
        return parse(text, text.where, _NumberNames(self, address, constant), self.curves)

    def find_name_dimensions(self, expr: Expr, location: Location, name_scope: str = "") -> dict[str, Dimension | None]:
        """Return the dimension of every name in `expr` by name, None for a name that fits any dimension.

        `name_scope` says which names are allowed in addition to parameters. Calls of curves are checked too. Raises an
        ExpressionError or UnknownNameError at a name that is not allowed there, InputErrors for several.
        """
        for call in iterate_curve_calls(expr):
            check_curve_call(call, offset_location(location, call.offset), name_scope != "")
        dimensions: dict[str, Dimension | None] = {}
        errors: dict[str, InputError] = {}
        for name in iterate_names(expr):
            if name.path not in dimensions and name.path not in errors:
                try:
                    dimensions[name.path] = self._find_dimension(
                        name, offset_location(location, name.offset), name_scope
                    )
                except InputError as error:
                    errors[name.path] = error
        if errors:
            raise combine_errors(errors.values())
        return dimensions

    def _find_dimension(self, name: Name, location: Location, name_scope: str) -> Dimension | None:
        """Return the dimension of one name in an expression; None if it fits any dimension.

        A parameter that is defined without a unit (`c: 0.1`) fits any dimension. The order of search is t, parameters,
        named expressions, then results such as L1.x if `name_scope` allows them. A named expression is checked for
        names that this value must not contain. Raises an InputError at `location` if the name is unknown or
        `name_scope` does not allow it.
        """
        allows_time, result_dimension = name_scope not in CONSTANT_IN_TIME, self.result_scopes.get(name_scope)
        if name.path == "t":
            return _find_dimension_of_time(location, allows_time, result_dimension is not None)
        if name.path in self.parameters:
            return self.parameters[name.path]
        if name.path in self.expressions:
            self._check_dependencies_of_expression(name.path, location, allows_time, result_dimension)
            return self.expressions[name.path].dimension
        if result_dimension is not None:
            return result_dimension(name, location)
        if "." in name.path:
            hint = "expected parameters" + (" and t" if allows_time else "") + ", whose names have no dot"
            raise ExpressionError(f"{name.path!r} is not allowed here", location, hint)
        if name.path.lower() in ("time", "t"):
            raise ExpressionError(f"{name.path!r} is not a name here", location, "the time is written t")
        raise make_unknown_name_error(
            "name", name.path, (*self.parameters, *(self.expressions if name_scope else ())), location
        )

    def _check_dependencies_of_expression(
        self, name: str, location: Location, allows_time: bool, result_dimension: ResultDimension | None
    ) -> None:
        """Raise ExpressionError if a named expression depends on t or motion and the value at `location` must not.

        `allows_time`: the value may depend on t. `result_dimension`: returns the dimension of a result, and raises for
        a result that is not allowed; None if no results are allowed.
        """
        if not allows_time and result_dimension is None:
            hint = (
                "expected parameters: a named expression may depend on t and motion; it is allowed in drives, forces,"
                " events and outputs only"
            )
            raise ExpressionError(f"{name!r} is a named expression, and this number must be constant", location, hint)
        for dependency in self._iterate_dependencies(name):
            if dependency in self.parameters or dependency == "t" and allows_time:
                continue
            if dependency == "t" or result_dimension is None:
                hint = f"expected {'t and parameters' if allows_time else 'parameters'}"
                raise ExpressionError(f"{name!r} depends on {dependency}, which is not allowed here", location, hint)
            result_dimension(Name(dependency), location)

    def _iterate_dependencies(self, name: str) -> Iterator[str]:
        """Yield the names in a named expression that are not named expressions.

        The expressions that it contains, directly or through others, are searched too.
        """
        for expression_name in self.find_named_expressions(Name(name)):
            yield from (
                dependency.path
                for dependency in iterate_names(self.expressions[expression_name].source_tree)
                if dependency.path not in self.expressions
            )

    def find_named_expressions(self, expr: Expr) -> tuple[str, ...]:
        """Return the names of the named expressions that `expr` contains, directly or through others.

        Each name occurs once.
        """
        expression_names, trees = dict[str, None](), [expr]
        while trees:
            new = [
                inner.path
                for inner in iterate_names(trees.pop())
                if inner.path in self.expressions and inner.path not in expression_names
            ]
            expression_names |= dict.fromkeys(new)
            trees += [self.expressions[name].source_tree for name in new]
        return tuple(expression_names)

    def _record_candidate_dimension(self, expr: Expr, expected: Dimension | None) -> None:
        """Record `expected` as a possible dimension of a parameter without a unit that is the whole value.

        Signs before the parameter are ignored. Nothing is recorded for other values, or if any dimension fits.
        """
        while isinstance(expr, Unary):
            expr = expr.operand
        if isinstance(expr, Name) and expected is not None and self.parameters.get(expr.path, TIME) is None:
            self.candidate_dimensions.setdefault(expr.path, set()).add(expected)

    def add_condition(self, quantity: Quantity, relation: str, bound: float | Quantity, message: str) -> None:
        """Record the condition `quantity relation bound`, which is checked after reading and at each run-time override.

        `relation` is ">", ">=", "<" or "<="; `bound` is a number in SI units or another quantity; `message` states the
        condition in the error.
        """
        limit = bound.address if isinstance(bound, Quantity) else bound
        self.conditions.append(Condition(quantity.address, relation, limit, message))

    def add_sum_condition(self, quantity: Quantity, addresses_of_sum: str, message: str) -> None:
        """Record the condition that a quantity is less than a sum of other quantities.

        `addresses_of_sum` contains their addresses joined by " + ". The condition is checked after reading and at each
        run-time override; `message` states it in the error.
        """
        self.conditions.append(Condition(quantity.address, "<", addresses_of_sum, message))


def _find_dimension_of_time(location: Location, is_allowed: bool, is_contact_force: bool) -> Dimension:
    """Return the dimension of t, the time. Raises ExpressionError if the value must not depend on time.

    `is_allowed`: the value may depend on t. `is_contact_force`: the value is the force of a contact, for which the
    message differs.
    """
    if is_allowed:
        return TIME
    hint = "time is allowed in drives, forces, events and outputs only"
    if is_contact_force:
        message = "'t' is time, and this force depends on the penetration only"
        raise ExpressionError(message, location, f"expected delta and parameters; {hint}")
    raise ExpressionError("'t' is time, and this number must be constant", location, f"expected parameters; {hint}")


def _is_located_in(error: InputError, text: Text) -> bool:
    """Return whether the location of an error lies within an expression of the file.

    False for an error without a location.
    """
    if (location := error.where) is None or (location.file, location.line) != (text.where.file, text.where.line):
        return False
    return 0 <= location.column - text.where.column <= len(text)


def _make_error_key(error: InputError) -> tuple[str, str, str]:
    """Return the key by which duplicate errors are recognised: location, type, and message without contact and scene.

    An error in an entry that contacts or scenes inherit is thus reported once, where it is written.
    """
    message = re.sub(r"\b(contacts\.|scenes\.|in scene )\w+", "", error.message)
    return str(error.where), type(error).__name__, message


def check_curve_call(call: CurveCall, location: Location, may_vary: bool) -> None:
    """Raise an InputError if a call of a curve is not allowed, or if its constant argument is outside its range.

    `may_vary`: the value may depend on t or motion; without it no curve is allowed. The error is located at `location`.
    """
    (argument,), curve = call.arguments, call.curve
    if not may_vary:
        hint = "expected parameters; a curve is allowed in drives, forces, events and outputs only"
        raise ExpressionError(f"{call.function!r} is a curve, and this number must be constant", location, hint)
    if not any(True for _ in iterate_names(argument)) and not curve.is_within(
        x := float(evaluate(argument, lambda _: 0.0))
    ):
        message = f"curve {call.function} is called {curve.describe_out_of_range(x)}"
        raise BadValueError(message, location, "expected an argument within the range")


def make_unreadable_number(text: str) -> Number:
    """Return a number node with the value NaN, which represents a number that could not be read."""
    return Number(math.nan, str(text))
