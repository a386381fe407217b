"""Writes the values of a file as cells of tables.

One cell has symbol, expression, value and unit together, for example "y = −l_5 = −0.3 m".
"""

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
from gudgeon.generator.targets.latex.letters import Name
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
SMALL = 1e-3  # below it a number is written with a power of ten
_STRENGTH = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4}


class ValueFormatter:
    """Write the numbers of a scene as table cells: symbol, value and expression.

    Expressions that are too long for a cell are collected for `pop_long_expressions`.
    """

    def __init__(self, model: Model, notation: Notation) -> None:
        self._model, self._slots, self._notation = model, model.parameter_table, notation
        self._long: list[Block] = []  # what numbers follow, where it is longer than a cell is wide

    def format_cell(self, quantity: Quantity | None) -> Text:
        """Return the cell of a number: "l = 80 mm", "y = −l_5 = −0.3 m", "0", or a formula; empty for no number."""
        if quantity is None:
            return ("",)
        if quantity.address not in self._slots.entries:
            return ("0",) if quantity.is_zero else self._format_varying_quantity(quantity)
        return self.format_parameter(self._slots.entries[quantity.address])

    def _format_varying_quantity(self, quantity: Quantity) -> Text:
        """Return an expression of time and motion; a long one is replaced by its symbol and collected for
        `pop_long_expressions`.

        An expression of a cam's angle, or with named expressions, stays as the file writes it.
        """
        notation, model = self._notation, self._model
        file_text = format_expression_as_written(quantity.value, 0, model.scene.mechanism.expressions)
        is_cam_angle = any(name.path == OF_CAM_ANGLE for name in iterate_names(quantity.value))
        if is_cam_angle or file_text != format_expression_as_written(quantity.value):
            return (file_text,)
        value = notation.expand_symbols(
            convert_quantity_to_sympy(quantity, MotionNameResolver(model.geometry, model.t))
        )
        if len((formula := notation.format_expression(value)).text) <= 2 * MAX_CELL_LENGTH:
            return (formula,)
        left = name_parameter(quantity.address)
        self._long.append(Equation(left, notation.format_terms(value)))
        return (left,)

    def format_parameter(self, entry: ParameterEntry) -> Text:
        """Return the cell "symbol = value" of a parameter."""
        return self._notation.format_expression(entry.symbol), " = ", *self.format_default(entry)

    def format_default(self, entry: ParameterEntry) -> Text:
        """Return the default of a parameter in the unit of the file.

        A dependent number has its expression and the value in SI.
        """
        if (measured := _split_unit(entry.expression)) is not None:
            return self._format_with_unit(*measured)
        return self.format_dependency(entry) + self._format_with_unit(
            entry.default, get_si_unit(entry), is_exact=not entry.depends_on_parameters
        )

    def format_in_si(self, entry: ParameterEntry) -> Text:
        """Return the default of a parameter in SI without its unit, after the text of the file if that differs."""
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
            (f"{format_expression_as_written(expression)} = ", angle_text or self._format_number(entry.default))
            if differs
            else (number,)
        )

    def format_dependency(self, entry: ParameterEntry) -> Text:
        """Return the expression of a dependent number and " = "; () for an independent one.

        A long expression is collected for `pop_long_expressions`, and () is returned.
        """
        if not entry.depends_on_parameters:
            return ()
        formula = self._notation.format_expression(entry.value)
        if len(formula.text) <= MAX_CELL_LENGTH:
            return formula, " = "
        self._long += self._split_long_formula(entry)
        return ()

    def _split_long_formula(self, entry: ParameterEntry) -> list[Block]:
        """Return a long formula as blocks.

        The argument of a long root gets a symbol, since lines cannot break in it.
        """
        notation, value, blocks = self._notation, entry.value, list[Block]()
        left_side = notation.format_expression(entry.symbol)
        for root in sorted(value.atoms(sp.Pow), key=sp.default_sort_key):
            if root.exp == sp.Rational(1, 2) and len(notation.format_expression(root).text) > MAX_UNBREAKABLE_LENGTH:
                latex, text = (name.partition("_")[1:] for name in (left_side.latex, left_side.text))
                primes = "'" * len(blocks)
                inner_name = Name("".join(("D", *latex, primes)), "".join(("D", *text, primes)))
                inner_symbol = sp.Symbol(inner_name.text)
                blocks.append(Equation(inner_name, notation.format_terms(root.base)))
                notation, value = (
                    notation.rename_symbols({inner_symbol: inner_name}),
                    value.xreplace({root: sp.sqrt(inner_symbol)}),
                )
        return [*blocks, Equation(left_side, notation.format_terms(value))]

    def _format_with_unit(self, value: float, unit: str, is_exact: bool = True) -> Text:
        """Return a number with its unit; an angle as a fraction of π or in degrees has none.

        is_exact: False for results of arithmetic, which are rounded.
        """
        number = self._format_number(value, unit == "rad", is_exact)
        if unit == "deg":
            return (Name(rf"{number.latex}^{{\circ}}", f"{number.text}°"),)
        return (
            (number, f" {format_unit(unit)}") if unit and not any(sign in number.text for sign in "π°") else (number,)
        )

    def _format_number(self, value: float, is_angle: bool = False, is_exact: bool = False) -> Name:
        """Return a number as people write it: rounded to six digits unless `is_exact`, small ones with a power of ten.

        is_angle: whether it may be written as a fraction of π or in degrees.
        """
        if is_angle and (angle_name := format_angle(value)) is not None:
            return angle_name
        rounded = value if is_exact else float(f"{value:.6g}")
        if not 0.0 < abs(rounded) < SMALL:
            return Name(*(self._notation.format_expression(sp.Float(rounded, 17)).latex, format_number(rounded)))
        digits, _, power = f"{Decimal(repr(rounded)).normalize():e}".partition("e")
        factor = "" if digits == "1" else rf"{digits} \cdot "
        return Name(rf"{factor}10^{{{int(power)}}}", f"{digits}e{power}")

    def list_body_quantities(self, part: str) -> list[tuple[Text, ...]]:
        """Return the table rows of the numbers of bodies in the section `part`, "sides" or "shape"."""
        entries_with_path = [
            (e, e.address.split(".")) for e in self._slots.entries.values() if e.address.startswith("bodies.")
        ]
        return [
            make_row(f"{path[1]}.{'.'.join(path[3:])}", self.format_parameter(e))
            for e, path in entries_with_path
            if path[2] == part and not (e.choice_words or part == "sides" and len(path) > 4)
        ]

    def list_densities(self) -> list[tuple[Text, ...]]:
        """Return the table rows of the densities of materials, with two cells: the material and its density."""
        entries_with_path = [(e, e.address.split(".")) for e in self._slots.entries.values() if not e.choice_words]
        return [
            make_row(path[1], self.format_parameter(e))
            for e, path in entries_with_path
            if path[0] == "materials" and path[2:] == ["density"]
        ]

    def pop_long_expressions(self) -> list[Block]:
        """Return the long expressions since the last call, to be placed below a table, and forget them; [] for none."""
        long_blocks, self._long = list(dict.fromkeys(self._long)), []
        return [make_paragraph("In full:"), *long_blocks] if long_blocks else []

    def format_vector(self, vector: Vector) -> Text:
        """Return the cell of a vector; a zero next to a parameter is written as "symbol = 0"."""
        is_parameter = [component.address in self._slots.entries for component in vector]
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
    """Return (value, unit) of a number in the file with a unit, negative ones included; None for other expressions."""
    if isinstance(expression, Unary) and (operand := _split_unit(expression.operand)) is not None:
        return -operand[0], operand[1]
    if not isinstance(expression, Number) or not get_unit(expression) or expression.text.startswith("pi"):
        return None
    return float(expression.text.removesuffix(get_unit(expression))), get_unit(expression)


def get_unit(number: Number) -> str:
    """Return the unit of a number of the file, such as "rpm"; "" if it has none."""
    text = number.text.strip().removeprefix("pi") if number.has_unit else ""
    return text[max((k for k in range(len(text) + 1) if _is_number(text[:k])), default=0) :].strip()


def _is_number(text: str) -> bool:
    """Return whether a text is a number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def get_si_unit(entry: ParameterEntry) -> str:
    """Return the SI unit of a parameter; rad and rad/s for angles and their rates if the file writes them as such."""
    if entry.expression is not None and find_angle_power(entry.expression) == 1:
        return {DIMENSIONLESS: "rad", RATE: "rad/s"}.get(entry.dimension, find_si_unit(entry.dimension))
    return find_si_unit(entry.dimension)


def format_expression_as_written(
    expression: Expr, outer_strength: int = 0, expressions: Mapping[str, Quantity] = MappingProxyType({})
) -> str:
    """Return an expression as in the file, with its numbers, units and names, and brackets where they are needed.

    outer_strength: how strongly the operator around it binds. expressions: named expressions, which appear by their
    names.
    """
    if (name := next((name for name, of in expressions.items() if of.value is expression), "")) and not isinstance(
        expression, Number
    ):
        return name
    match expression:
        case Number(value=value, text=text):
            return text or repr(value)
        case Unary(operand=operand):
            text, strength = f"-{format_expression_as_written(operand, 3, expressions)}", 3
        case Binary(operator=operator, left=left, right=right):
            strength = _STRENGTH[operator]
            operand_strengths = (strength + 1, strength) if operator == "**" else (strength, strength + 1)
            operand_texts = [
                format_expression_as_written(side, outer_strength, expressions)
                for side, outer_strength in zip((left, right), operand_strengths, strict=True)
            ]
            for k, side in enumerate((left, right)):  # t / (1 s): a number and its unit are one
                if (operator, k) in (("/", 1), ("**", 0)) and isinstance(side, Number) and get_unit(side):
                    operand_texts[k] = f"({operand_texts[k]})"
            text = f" {operator} ".join(operand_texts)
        case Call(function=function, arguments=arguments):
            operand_texts = [format_expression_as_written(a, 0, expressions) for a in arguments]
            call_arguments = (
                [" < ".join(operand_texts[:2]), *operand_texts[2:]] if function == "where" else operand_texts
            )
            return f"{function}({', '.join(call_arguments)})"
        case _:
            return expression.path
    return f"({text})" if strength < outer_strength else text
