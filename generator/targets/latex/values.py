"""Writes the numbers of a file as cells of tables: letter, value, unit, and the expression that a number follows."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from types import MappingProxyType

import sympy as sp

from gudgeon.generator.equations.fields import VariableNames
from gudgeon.generator.equations.model import Model
from gudgeon.generator.field import OF_CAM_ANGLE
from gudgeon.generator.mechanism import Quantity, Vector
from gudgeon.generator.symbols.from_expressions import quantity_to_sympy
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.generator.targets.latex.document import Block, Equation, Text, cells, paragraph
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import Notation, of_address
from gudgeon.generator.targets.latex.printers import LONG, as_angle, number_text, share_of_pi
from gudgeon.language.output_units import angle_power
from gudgeon.language.plot_units import pretty
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, names
from gudgeon.language.units import DIMENSIONLESS, RATE, si_unit

LONGEST = 30  # characters of a formula in a cell
SMALL = 1e-3  # below it a number is written with a power of ten
_STRENGTH = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4}


class Values:
    """Write the numbers of a scene as table cells: letter, value, and expression."""

    def __init__(self, model: Model, notation: Notation) -> None:
        self._model, self._slots, self._notation = model, model.slots, notation
        self._long: list[Block] = []  # what numbers follow, where it is longer than a cell is wide

    def cell(self, quantity: Quantity | None) -> Text:
        """Return the cell of a number: "l = 80 mm", "y = −l_5 = −0.3 m", "0", or a formula; empty for no number."""
        if quantity is None:
            return ("",)
        if quantity.address not in self._slots.entries:
            return ("0",) if quantity.is_zero else self._varying(quantity)
        return self.slot(self._slots.entries[quantity.address])

    def _varying(self, quantity: Quantity) -> Text:
        """Return an expression of time and motion, in the file's names; a long one has a letter and stands below."""
        notation, model = self._notation, self._model
        written = as_written(quantity.value, 0, model.scene.mechanism.expressions)
        of_cam = any(name.path == OF_CAM_ANGLE for name in names(quantity.value))
        if of_cam or written != as_written(quantity.value):
            return (written,)
        value = notation.expand(quantity_to_sympy(quantity, VariableNames(model.geometry, model.t)))
        if len((formula := notation.math(value)).text) <= 2 * LONGEST:
            return (formula,)
        left = of_address(quantity.address)
        self._long.append(Equation(left, notation.terms(value)))
        return (left,)

    def slot(self, entry: ParameterEntry) -> Text:
        """Return letter = value."""
        return self._notation.math(entry.symbol), " = ", *self.value(entry)

    def value(self, entry: ParameterEntry) -> Text:
        """Return the default in the unit of the file; for a dependent number its expression and the value in SI."""
        if (measured := _measured(entry.written)) is not None:
            return self._with_unit(*measured)
        return self.followed(entry) + self._with_unit(entry.default, si_unit_of(entry), exact=not entry.follows)

    def in_si(self, entry: ParameterEntry) -> Text:
        """Return the default in SI without its unit, after the text of the file if that differs."""
        written, angle = entry.written, entry.dimension in (DIMENSIONLESS, RATE)
        share = as_angle(entry.default) if angle and share_of_pi(entry.default) else None
        number = share or self._number(entry.default, exact=isinstance(written, Number))
        if written is None or entry.follows:
            return (*self.followed(entry), number)
        if isinstance(written, Number):
            message = unit_of(written) not in ("", si_unit(entry.dimension), si_unit_of(entry))
        else:
            message = share is None
        return (f"{as_written(written)} = ", share or self._number(entry.default)) if message else (number,)

    def followed(self, entry: ParameterEntry) -> Text:
        """Return the expression that a number follows and a sign after it; nothing if it is long and stands below."""
        if not entry.follows:
            return ()
        formula = self._notation.math(entry.value)
        if len(formula.text) <= LONGEST:
            return formula, " = "
        self._long += self._apart(entry)
        return ()

    def _apart(self, entry: ParameterEntry) -> list[Block]:
        """Return a long formula; the argument of a long root gets a letter, since lines cannot break in it."""
        notation, value, blocks = self._notation, entry.value, list[Block]()
        left = notation.math(entry.symbol)
        for root in sorted(value.atoms(sp.Pow), key=sp.default_sort_key):
            if root.exp == sp.Rational(1, 2) and len(notation.math(root).text) > LONG:
                latex, text = (name.partition("_")[1:] for name in (left.latex, left.text))
                marks = "'" * len(blocks)
                named = Name("".join(("D", *latex, marks)), "".join(("D", *text, marks)))
                below = sp.Symbol(named.text)
                blocks.append(Equation(named, notation.terms(root.base)))
                notation, value = notation.called({below: named}), value.xreplace({root: sp.sqrt(below)})
        return [*blocks, Equation(left, notation.terms(value))]

    def _with_unit(self, x: float, unit: str, exact: bool = True) -> Text:
        """Return a number with its unit."""
        number = self._number(x, unit == "rad", exact)
        if unit == "deg":
            return (Name(rf"{number.latex}^{{\circ}}", f"{number.text}°"),)
        return (number, f" {pretty(unit)}") if unit and not any(sign in number.text for sign in "π°") else (number,)

    def _number(self, x: float, angle: bool = False, exact: bool = False) -> Name:
        """Return a number as people write it; results of arithmetic are rounded."""
        if angle and (known := as_angle(x)) is not None:
            return known
        short = x if exact else float(f"{x:.6g}")
        if not 0.0 < abs(short) < SMALL:
            return Name(*(self._notation.math(sp.Float(short, 17)).latex, number_text(short)))
        digits, _, power = f"{Decimal(repr(short)).normalize():e}".partition("e")
        in_front = "" if digits == "1" else rf"{digits} \cdot "
        return Name(rf"{in_front}10^{{{int(power)}}}", f"{digits}e{power}")

    def of_bodies(self, part: str) -> list[tuple[Text, ...]]:
        """Return the numbers of bodies with `sides` or `shape`."""
        found = [(e, e.address.split(".")) for e in self._slots.entries.values() if e.address.startswith("bodies.")]
        return [
            cells(f"{at[1]}.{'.'.join(at[3:])}", self.slot(e))
            for e, at in found
            if at[2] == part and not (e.words or part == "sides" and len(at) > 4)
        ]

    def densities(self) -> list[tuple[Text, ...]]:
        """Return the densities of the materials of shapes."""
        found = [(e, e.address.split(".")) for e in self._slots.entries.values() if not e.words]
        return [cells(at[1], self.slot(e)) for e, at in found if at[0] == "materials" and at[2:] == ["density"]]

    def below(self) -> list[Block]:
        """Return the long expressions since the last call, to be placed below a table."""
        found, self._long = list(dict.fromkeys(self._long)), []
        return [paragraph("In full:"), *found] if found else []

    def vector(self, vector: Vector) -> Text:
        """Return both components; a zero next to a letter has its letter, too."""
        known = [one.address in self._slots.entries for one in vector]
        x, y = (
            (of_address(one.address), " = 0")
            if one.is_zero and any(known) and one.address.endswith(axis) and not one.address.startswith("gravity")
            else self.cell(one)
            for one, axis in zip(vector, (".x", ".y"), strict=True)
        )
        return (*x, ",  ", *y)


def _measured(written: Expr | None) -> tuple[float, str] | None:
    """Return a number of the file and its unit; None for other expressions."""
    if isinstance(written, Unary) and (inner := _measured(written.operand)) is not None:
        return -inner[0], inner[1]
    if not isinstance(written, Number) or not unit_of(written) or written.text.startswith("pi"):
        return None
    return float(written.text.removesuffix(unit_of(written))), unit_of(written)


def unit_of(number: Number) -> str:
    """Return the unit of a number of the file, "rpm"; "" if it has none."""
    text = number.text.strip().removeprefix("pi") if number.has_unit else ""
    return text[max((k for k in range(len(text) + 1) if _is_number(text[:k])), default=0) :].strip()


def _is_number(text: str) -> bool:
    """Return whether a text is a number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def si_unit_of(entry: ParameterEntry) -> str:
    """Return the SI unit of a number; rad and rad/s for angles and their rates, if the file declares them."""
    if entry.written is not None and angle_power(entry.written) == 1:
        return {DIMENSIONLESS: "rad", RATE: "rad/s"}.get(entry.dimension, si_unit(entry.dimension))
    return si_unit(entry.dimension)


def as_written(tree: Expr, around: int = 0, called: Mapping[str, Quantity] = MappingProxyType({})) -> str:
    """Return an expression as in the file, with its numbers, units and names."""
    if (name := next((name for name, of in called.items() if of.value is tree), "")) and not isinstance(tree, Number):
        return name
    match tree:
        case Number(value=value, text=text):
            return text or repr(value)
        case Unary(operand=operand):
            text, own = f"-{as_written(operand, 3, called)}", 3
        case Binary(operator=operator, left=left, right=right):
            own = _STRENGTH[operator]
            sides = (own + 1, own) if operator == "**" else (own, own + 1)
            written = [as_written(side, around, called) for side, around in zip((left, right), sides, strict=True)]
            for k, side in enumerate((left, right)):  # t / (1 s): a number and its unit are one
                if (operator, k) in (("/", 1), ("**", 0)) and isinstance(side, Number) and unit_of(side):
                    written[k] = f"({written[k]})"
            text = f" {operator} ".join(written)
        case Call(function=function, arguments=arguments):
            written = [as_written(a, 0, called) for a in arguments]
            compared = [" < ".join(written[:2]), *written[2:]] if function == "where" else written
            return f"{function}({', '.join(compared)})"
        case _:
            return tree.path
    return f"({text})" if own < around else text
