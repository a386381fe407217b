"""Formats the values of a mechanism file as table cells: symbol, expression, value and unit ("y = −l_5 = −0.3 m")."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from types import MappingProxyType

import sympy as sp

from gudgeon.generator.equations.fields import MotionNameResolver
from gudgeon.generator.equations.model import Model
from gudgeon.generator.field import OF_CAM_ANGLE
from gudgeon.generator.mechanism import Quantity, Vector
from gudgeon.generator.symbols.from_expressions import convert_quantity_to_sympy
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.generator.targets.latex.document import Block, Equation, Text, make_paragraph, make_row
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.notation import Notation, name_parameter
from gudgeon.generator.targets.latex.printers import (
    MAX_UNBREAKABLE_LENGTH,
    find_fraction_of_pi,
    format_angle,
    format_number,
)
from gudgeon.language.output_units import find_angle_power
from gudgeon.language.plot_units import format_unit
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, iterate_names
from gudgeon.language.units import DIMENSIONLESS, RATE, find_si_unit

MAX_CELL_LENGTH = 30  # characters of a formula in a cell
MIN_PLAIN_NUMBER = 1e-3  # a number with a smaller magnitude is written with a power of ten
_PRECEDENCE = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4}


class ValueFormatter:
    """Format the quantities of a scene as table cells: symbol, value and expression.

    Expressions that are too long for a cell are collected for `pop_long_expressions`.
    """

    def __init__(self, model: Model, notation: Notation) -> None:
        self._model, self._table, self._notation = model, model.parameter_table, notation
        self._long_expressions: list[Block] = []

    def format_cell(self, quantity: Quantity | None) -> Text:
        """Return the cell of a quantity: "l = 80 mm", "y = −l_5 = −0.3 m", "0", or a formula of time and motion.

        The cell of None is empty.
        """
        if quantity is None:
            return ("",)
        if quantity.address not in self._table.entries:
            return ("0",) if quantity.is_zero else self._format_varying_quantity(quantity)
        return self.format_parameter(self._table.entries[quantity.address])

    def _format_varying_quantity(self, quantity: Quantity) -> Text:
        """Return the cell of an expression of time and motion, as a formula.

        A formula of more than 2 · MAX_CELL_LENGTH characters is replaced by its symbol and collected for
        `pop_long_expressions`. An expression of a cam's angle, or with named expressions, is in the syntax of the file.
        """
        notation, model = self._notation, self._model
        file_text = format_file_expression(quantity.value, 0, model.scene.mechanism.expressions)
        is_cam_angle = any(name.path == OF_CAM_ANGLE for name in iterate_names(quantity.value))
        if is_cam_angle or file_text != format_file_expression(quantity.value):
            return (file_text,)
        value = notation.expand_symbols(
            convert_quantity_to_sympy(quantity, MotionNameResolver(model.geometry, model.t))
        )
        if len((formula := notation.format_expression(value)).text) <= 2 * MAX_CELL_LENGTH:
            return (formula,)
        left = name_parameter(quantity.address)
        self._long_expressions.append(Equation(left, notation.format_terms(value)))
        return (left,)

    def format_parameter(self, entry: ParameterEntry) -> Text:
        """Return the cell "symbol = value" of a parameter."""
        return self._notation.format_expression(entry.symbol), " = ", *self.format_default(entry)

    def format_default(self, entry: ParameterEntry) -> Text:
        """Return the default of a parameter: a number with a unit as in the file, any other expression in SI.

        A parameter that depends on others has its expression and " = " before the value (`format_dependency`).
        """
        if (measured := _split_unit(entry.expression)) is not None:
            return self._format_with_unit(*measured)
        return self.format_dependency(entry) + self._format_with_unit(
            entry.default, get_si_unit(entry), is_exact=not entry.depends_on_parameters
        )

    def format_in_si(self, entry: ParameterEntry) -> Text:
        """Return the default of a parameter in SI without its unit, such as "60 rpm = 6.28319".

        The expression of the file precedes the value if it has another unit or is not a number. Fractions of π are
        written as such for angles and their rates.
        """
        expression, may_be_angle = entry.expression, entry.dimension in (DIMENSIONLESS, RATE)
        angle_text = format_angle(entry.default) if may_be_angle and find_fraction_of_pi(entry.default) else None
        number = angle_text or self._format_number(entry.default, is_exact=isinstance(expression, Number))
        if expression is None or entry.depends_on_parameters:
            return (*self.format_dependency(entry), number)
        if isinstance(expression, Number):
            differs = get_unit(expression) not in ("", find_si_unit(entry.dimension), get_si_unit(entry))
        else:
            differs = angle_text is None
        return (
            (f"{format_file_expression(expression)} = ", angle_text or self._format_number(entry.default))
            if differs
            else (number,)
        )

    def format_dependency(self, entry: ParameterEntry) -> Text:
        """Return the formula of a parameter that depends on others, then " = "; () for an independent one.

        A formula of more than MAX_CELL_LENGTH characters is collected for `pop_long_expressions`, and () is returned.
        """
        if not entry.depends_on_parameters:
            return ()
        formula = self._notation.format_expression(entry.value)
        if len(formula.text) <= MAX_CELL_LENGTH:
            return formula, " = "
        self._long_expressions += self._split_long_formula(entry)
        return ()

    def _split_long_formula(self, entry: ParameterEntry) -> list[Block]:
        """Return the equation of a parameter with a long formula, after equations for the arguments of long roots.

        A line cannot break in a root: the argument of one above MAX_UNBREAKABLE_LENGTH characters gets a symbol D.
        """
        notation, value, blocks = self._notation, entry.value, list[Block]()
        left_side = notation.format_expression(entry.symbol)
        for root in sorted(value.atoms(sp.Pow), key=sp.default_sort_key):
            if root.exp == sp.Rational(1, 2) and len(notation.format_expression(root).text) > MAX_UNBREAKABLE_LENGTH:
                latex, text = (name.partition("_")[1:] for name in (left_side.latex, left_side.text))
                primes = "'" * len(blocks)
                inner_name = Formula("".join(("D", *latex, primes)), "".join(("D", *text, primes)))
                inner_symbol = sp.Symbol(inner_name.text)
                blocks.append(Equation(inner_name, notation.format_terms(root.base)))
                notation, value = (
                    notation.rename_symbols({inner_symbol: inner_name}),
                    value.xreplace({root: sp.sqrt(inner_symbol)}),
                )
        return [*blocks, Equation(left_side, notation.format_terms(value))]

    def _format_with_unit(self, value: float, unit: str, is_exact: bool = True) -> Text:
        """Return a number with its unit; an angle that is written as a fraction of π or in degrees has none.

        is_exact: False for results of arithmetic, which are rounded to six digits.
        """
        number = self._format_number(value, unit == "rad", is_exact)
        if unit == "deg":
            return (Formula(rf"{number.latex}^{{\circ}}", f"{number.text}°"),)
        return (
            (number, f" {format_unit(unit)}") if unit and not any(sign in number.text for sign in "π°") else (number,)
        )

    def _format_number(self, value: float, is_angle: bool = False, is_exact: bool = False) -> Formula:
        """Return a number as a formula, rounded to six significant digits unless `is_exact`.

        A magnitude below MIN_PLAIN_NUMBER is written with a power of ten. is_angle: whether the number may be written
        as a fraction of π or in degrees (`format_angle`).
        """
        if is_angle and (angle_name := format_angle(value)) is not None:
            return angle_name
        rounded = value if is_exact else float(f"{value:.6g}")
        if not 0.0 < abs(rounded) < MIN_PLAIN_NUMBER:
            return Formula(*(self._notation.format_expression(sp.Float(rounded, 17)).latex, format_number(rounded)))
        digits, _, power = f"{Decimal(repr(rounded)).normalize():e}".partition("e")
        factor = "" if digits == "1" else rf"{digits} \cdot "
        return Formula(rf"{factor}10^{{{int(power)}}}", f"{digits}e{power}")

    def list_body_quantities(self, section: str) -> list[tuple[Text, ...]]:
        """Return the table rows (address, value) of the parameters of bodies in a section of bodies, "sides" or
        "shape".

        Choices of materials, and coordinates of sides, are left out.
        """
        entries_with_path = [
            (e, e.address.split(".")) for e in self._table.entries.values() if e.address.startswith("bodies.")
        ]
        return [
            make_row(f"{path[1]}.{'.'.join(path[3:])}", self.format_parameter(e))
            for e, path in entries_with_path
            if path[2] == section and not (e.choice_words or section == "sides" and len(path) > 4)
        ]

    def list_densities(self) -> list[tuple[Text, ...]]:
        """Return the table rows of the densities of materials, with two cells: the material and its density."""
        entries_with_path = [(e, e.address.split(".")) for e in self._table.entries.values() if not e.choice_words]
        return [
            make_row(path[1], self.format_parameter(e))
            for e, path in entries_with_path
            if path[0] == "materials" and path[2:] == ["density"]
        ]

    def pop_long_expressions(self) -> list[Block]:
        """Return the collected long expressions, after the words "In full:", and clear the collection; [] for none."""
        long_blocks, self._long_expressions = list(dict.fromkeys(self._long_expressions)), []
        return [make_paragraph("In full:"), *long_blocks] if long_blocks else []

    def format_vector(self, vector: Vector) -> Text:
        """Return the cell of a vector, such as "x = 10 mm,  y = 0".

        A component that is 0 has its symbol if the other one is a parameter, except for gravity.
        """
        is_parameter = [component.address in self._table.entries for component in vector]
        x, y = (
            (name_parameter(component.address), " = 0")
            if component.is_zero
            and any(is_parameter)
            and component.address.endswith(axis)
            and not component.address.startswith("gravity")
            else self.format_cell(component)
            for component, axis in zip(vector, (".x", ".y"), strict=True)
        )
        return (*x, ",  ", *y)


def _split_unit(expression: Expr | None) -> tuple[float, str] | None:
    """Return (value, unit) of a number with a unit in the file, such as (−80.0, "mm"); None for other expressions.

    Multiples of pi, such as "2pi rad", are not numbers with a unit here.
    """
    if isinstance(expression, Unary) and (operand := _split_unit(expression.operand)) is not None:
        return -operand[0], operand[1]
    if not isinstance(expression, Number) or not get_unit(expression) or expression.text.startswith("pi"):
        return None
    return float(expression.text.removesuffix(get_unit(expression))), get_unit(expression)


def get_unit(number: Number) -> str:
    """Return the unit of a number of the file, such as "rpm" of "60 rpm"; "" if it has none."""
    text = number.text.strip().removeprefix("pi") if number.has_unit else ""
    return text[max((k for k in range(len(text) + 1) if _is_float(text[:k])), default=0) :].strip()


def _is_float(text: str) -> bool:
    """Return whether Python's float() accepts a text.

    It is called to find the longest prefix of a value with a unit that is a number.
    """
    try:
        float(text)
    except ValueError:
        return False
    return True


def get_si_unit(entry: ParameterEntry) -> str:
    """Return the SI unit of a parameter; "rad" or "rad/s" if the units in its expression make it an angle or rate."""
    if entry.expression is not None and find_angle_power(entry.expression) == 1:
        return {DIMENSIONLESS: "rad", RATE: "rad/s"}.get(entry.dimension, find_si_unit(entry.dimension))
    return find_si_unit(entry.dimension)


def format_file_expression(
    expression: Expr, outer_precedence: int = 0, expressions: Mapping[str, Quantity] = MappingProxyType({})
) -> str:
    """Return an expression in the syntax of the file, with its numbers, units and names, and the necessary brackets.

    outer_precedence: the precedence of the operator around it (_PRECEDENCE). expressions: named expressions, which are
    printed by their names.
    """
    if (name := next((name for name, of in expressions.items() if of.value is expression), "")) and not isinstance(
        expression, Number
    ):
        return name
    match expression:
        case Number(value=value, text=text):
            return text or repr(value)
        case Unary(operand=operand):
            text, precedence = f"-{format_file_expression(operand, 3, expressions)}", 3
        case Binary(operator=operator, left=left, right=right):
            precedence = _PRECEDENCE[operator]
            operand_precedences = (precedence + 1, precedence) if operator == "**" else (precedence, precedence + 1)
            operand_texts = [
                format_file_expression(operand, operand_precedence, expressions)
                for operand, operand_precedence in zip((left, right), operand_precedences, strict=True)
            ]
            for k, operand in enumerate((left, right)):  # t / (1 s): brackets around a number with its unit
                if (operator, k) in (("/", 1), ("**", 0)) and isinstance(operand, Number) and get_unit(operand):
                    operand_texts[k] = f"({operand_texts[k]})"
            text = f" {operator} ".join(operand_texts)
        case Call(function=function, arguments=arguments):
            operand_texts = [format_file_expression(a, 0, expressions) for a in arguments]
            call_arguments = (
                [" < ".join(operand_texts[:2]), *operand_texts[2:]] if function == "where" else operand_texts
            )
            return f"{function}({', '.join(call_arguments)})"
        case _:
            return expression.path
    return f"({text})" if precedence < outer_precedence else text
