"""Prints SymPy expressions and generated functions as Python with NumPy, for `model.numpy()` and plots of laws.

Branches of switching functions are not frozen, and vanishing pivots are not treated. Lines are at most WIDTH characters
long: code is broken inside brackets.
"""

from __future__ import annotations

import keyword
import textwrap
from collections.abc import Iterable, Sequence
from functools import reduce

import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

from gudgeon.generator.ir.branches import Branch, ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable, convert_to_fraction_of_pi, make_readable, make_readable_statements
from gudgeon.generator.ir.signatures import BRANCHES
from gudgeon.generator.ir.statements import (
    Call,
    DeclareBranches,
    Guard,
    Instruction,
    Jump,
    MaxMagnitude,
    Return,
    SolveDependentRows,
    Statement,
    Status,
    When,
)
from gudgeon.generator.ir.values import Conditional, ParameterOrDefault, Sum, Test, Threshold, Value
from gudgeon.generator.symbols.curves import ContourOf, CurveOf, CurveOn, KnotsOf, make_curve_name
from gudgeon.generator.symbols.from_expressions import CLASSES
from gudgeon.generator.symbols.storage import Key, Result, StorageLocation, find_value_key
from gudgeon.generator.targets import line_breaks
from gudgeon.generator.targets.cached_printer import CachedPrinter

# Lines for vanished pivots, frozen branches and calls that need the joints' forces only.
_OMITTED_LINES = (Status, ReturnIfOnlyJoints, Jump, SolveDependentRows, DeclareBranches)
_BRANCH_PLACES = tuple(StorageLocation(argument.name) for argument in BRANCHES)
_BRANCH_ARGUMENTS = ("branch", "g", "corner")


def print_name(key: Key) -> str:
    """Return the Python expression of a local or storage location.

    A name that is a Python keyword gets an underscore: the field `lambda` becomes `rhs.lambda_[3]`.
    """
    if isinstance(key, StorageLocation):
        members = (f"[{step}]" if isinstance(step, int) else f".{print_name(step)}" for step in key.path)
        return print_name(key.base) + "".join(members)
    return f"{key}_" if keyword.iskeyword(key) else key


class NumPyPrinter(CachedPrinter, PythonCodePrinter):
    """Print expressions as Python for scalars and arrays alike; conditional expressions of C become np.where."""

    def __init__(self, readable_lines: Readable) -> None:
        super().__init__({"fully_qualified_modules": False})
        self.readable = readable_lines

    def get_name(self, key: Key) -> str:
        """Return the name of a local or place in this function."""
        return print_name(self.readable.names.get(key, key))

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        """Print a symbol by its name in the function."""
        return self.get_name(find_value_key(expr))

    def _print_Float(self, expr: sp.Float) -> str:
        """Print a float, a fraction of π as such."""
        fraction = convert_to_fraction_of_pi(expr)
        return fraction.format("np.pi") if fraction else repr(float(expr))

    def parenthesize(self, item: sp.Expr, level: float, strict: bool = False) -> str:
        """Print an operand, in brackets if its precedence is lower than `level`, or equal unless `strict`.

        A number that is printed as a fraction of π, such as 2*np.pi/3, always gets brackets.
        """
        if item.is_Float and (fraction := convert_to_fraction_of_pi(item)) and not fraction.is_pi:
            return f"({self._print(item)})"
        return super().parenthesize(item, level, strict)

    def _print_Mul(self, expr: sp.Mul) -> str:
        """Print a product; a rational multiple of π is printed as a fraction of np.pi if that has the same bits."""
        if text := self.print_symbol_product(expr):
            return text
        fraction = convert_to_fraction_of_pi(expr)
        return fraction.format("np.pi") if fraction else str(super()._print_Mul(expr))

    def _print_Rational(self, expr: sp.Rational) -> str:
        """Print a rational number as a quotient."""
        return f"{int(expr.p)}/{int(expr.q)}"

    def _print_NumberSymbol(self, expr: sp.NumberSymbol) -> str:
        """Print a constant such as e."""
        return repr(float(expr))

    _print_Exp1 = _print_NumberSymbol

    def _print_Pi(self, expr: sp.Expr) -> str:
        """Print π."""
        return "np.pi"

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        """Print a power: exponents ±1/2 by np.sqrt, −1 as a quotient, other integers by **, all others by np.power.

        np.power returns NaN for a negative base.
        """
        base, exponent = expr.as_base_exp()
        if exponent in (sp.Rational(1, 2), sp.Rational(-1, 2)):
            return f"{'' if exponent > 0 else '1/'}np.sqrt({self._print(base)})"
        if exponent == -1:
            return f"1/{self.parenthesize(base, 60)}"
        if not exponent.is_integer:
            return f"np.power({self._print(base)}, {self._print(exponent)})"
        return f"{self.parenthesize(base, 70)}**{self.parenthesize(exponent, 70)}"

    def _print_table_function(self, expr: sp.Expr) -> str:
        """Print a function of the table of functions by its NumPy name; np.maximum and np.minimum as nested calls."""
        name, arguments = f"np.{CLASSES[type(expr)].in_numpy}", list(map(self._print, expr.args))
        if isinstance(expr, (sp.Max, sp.Min)):
            return reduce(lambda first, other: f"{name}({first}, {other})", arguments)
        return f"{name}({', '.join(arguments)})"

    def _print_ComparedMagnitude(self, expr: sp.Expr) -> str:
        """Print an absolute value."""
        return f"np.abs({self._print(expr.args[0])})"

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print a step function, 1 at 0."""
        return f"np.where({self._print(expr.args[0])} >= 0, 1.0, 0.0)"

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function: its sign, since branches are not frozen."""
        return f"np.sign({self._print(expr.args[1])})"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """Print an absolute value that is never 0."""
        return f"(np.abs({self._print(expr.args[0])}) + 1e-150)"

    def _print_Select(self, expr: sp.Expr) -> str:
        """Print Select(branch, a, b) as np.where: b for branch < 0, else a (also for NaN).

        If `readable.branches` contains the expression, the name of its local is printed.
        """
        if expr in self.readable.branches:
            return self.get_name(self.readable.branches[expr])
        branch, a, b = map(self._print, expr.args)
        return f"np.where({branch} < 0, {b}, {a})"

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """Print the depth of a contour or its derivative (symbols/curves.py)."""
        return f"contour(p.{expr.table}, {expr.order}, {self._print(expr.args[3])})"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print the value of a curve or its derivative."""
        return f"curve({make_curve_name(expr.name)}, {expr.order}, {self._print(expr.args[2])})"

    def _print_CurveOn(self, expr: CurveOn) -> str:
        """Print the value of a curve; the piece is not frozen."""
        return self._print_CurveOf(CurveOf(*expr.args[:3]))

    def _print_KnotsOf(self, expr: KnotsOf) -> str:
        """Print the event function of a curve's knots."""
        return f"knots({make_curve_name(expr.name)}, {self._print(expr.args[1])})"

    def _print_ModOf(self, expr: sp.Expr) -> str:
        """Print a remainder; the period is not frozen."""
        return f"np.mod({self._print(expr.args[0])}, {self._print(expr.args[1])})"

    _print_ModOn = _print_ModOf

    def _print_PeriodsOf(self, expr: sp.Expr) -> str:
        """Print the event function of a remainder's periods."""
        a, b = map(self._print, expr.args)
        return f"np.sin(np.pi*({a})/({b}))"

    def _print_Unevaluated(self, expr: sp.Expr) -> str:
        """Print an unevaluated operand in brackets."""
        return f"({self._print(expr.args[0])})"

    _print_UnevaluatedQuotient = _print_Unevaluated

    def _print_Slope(self, expr: sp.Expr) -> str:
        """Print a derivative, or a difference quotient where it is not finite."""
        derivative, value_after, value_before, distance = map(self._print, expr.args)
        quotient = f"({value_after} - ({value_before}))/({distance})"
        return f"np.where(np.isfinite({derivative}), {derivative}, {quotient})"

    def _print_NextAbove(self, expr: sp.Expr) -> str:
        """Print a value slightly above its argument."""
        x = self._print(expr.args[0])
        return f"({x} + 1e-9*(1 + np.abs({x})))"

    def _print_NextBelow(self, expr: sp.Expr) -> str:
        """Print a value slightly below its argument."""
        x = self._print(expr.args[0])
        return f"({x} - 1e-9*(1 + np.abs({x})))"


class LinePrinter:
    """Print the lines of one function as Python without indent.

    Raises ValueError for a kind of line without a counterpart.
    """

    def __init__(self, readable_lines: Readable) -> None:
        self.printer = NumPyPrinter(readable_lines)

    def print_lines(self, lines: Iterable[Instruction]) -> list[str]:
        """Return lines of a kernel as lines of Python without indent, wrapped; _OMITTED_LINES are left out."""
        return [
            text for item in lines if not isinstance(item, _OMITTED_LINES) for text in self._print_instruction(item)
        ]

    def print_expression(self, value: Value) -> str:
        """Return a value of a kernel as a Python expression, by its class; other values are SymPy expressions."""
        match value:
            case StorageLocation():
                return self.printer.get_name(value)
            case Conditional():
                then, otherwise = self.print_expression(value.then), self.print_expression(value.otherwise)
                return f"np.where({self.print_test(value.test)}, {then}, {otherwise})"
            case Sum():
                return " + ".join(map(print_name, value.places))
            case ParameterOrDefault():
                return f"given[{value.k}] if is_given[{value.k}] else {self.print_expression(value.default)}"
            case _:
                return str(self.printer.doprint(value))

    def print_test(self, test: Test) -> str:
        """Return a comparison as a Python condition; a test without a relation is its value.

        A test that is relative to the value itself (`is_relative_to_value`) checks that the value, or its magnitude if
        that is compared, is positive and finite.
        """
        value = self.print_expression(test.value)
        left_side = f"np.abs({value})" if test.compares_magnitude else value
        if test.is_relative_to_value:
            return f"0 < {left_side} < np.inf"
        bound = " * ".join(map(self._print_bound_factor, test.bound))
        return f"{left_side} {test.relation} {bound}" if test.relation else left_side

    def _print_bound_factor(self, value: sp.Basic | float) -> str:
        """Return a factor of the bound of a comparison (`test.bound`, a product) as Python, without parentheses.

        It is a number, an expression, or a threshold, which is printed by its name.
        """
        if isinstance(value, Threshold):
            return value.name
        return repr(value) if isinstance(value, float) else self.print_expression(value)

    def _print_instruction(self, line: Instruction) -> list[str]:
        """Return one line of a kernel as lines of Python, wrapped.

        A branch becomes np.where. A guard returns the number of its pivot if the test fails; the end of the function
        returns 0. Raises ValueError for a class of lines without a counterpart.
        """
        match line:
            case Statement():
                target, value = self.printer.get_name(line.target), self.print_expression(line.value)
                return print_assignment(target, value, line.comment, isinstance(line.value, Conditional))
            case Branch():
                branch, then, otherwise = map(
                    self.print_expression, (line.active_branch, line.value_above, line.value_below)
                )
                value = f"np.where({branch} < 0, {otherwise}, {then})"
                return print_assignment(self.printer.get_name(line.target), value, line.comment, is_call=True)
            case When():
                return [
                    *break_code(f"if {self.print_test(line.test)}:"),
                    *indent_lines(self._print_instruction(line.statement)),
                ]
            case Call():
                arguments = [self.print_expression(x) for x in (*line.inputs, *line.results) if x not in _BRANCH_PLACES]
                return break_code(f"{line.function}({', '.join(arguments)})")
            case Guard(test=Test() as test):
                condition = f"{self.print_test(line.condition)} and " if line.condition else ""
                return [*break_code(f"if {condition}not ({self.print_test(test)}):"), f"    return {line.number}"]
            case MaxMagnitude():
                inner = ", ".join(f"np.abs({self.print_expression(x)})" for x in line.values)
                value = f"max({inner}, 0.0)" if line.values else "0.0"
                return print_assignment(f"{line.target}[0]", value, is_call=True)
            case Return():
                return ["return 0"]
        raise ValueError(f"a line of a function has no counterpart in Python: {line}")


def print_statements(statements: Sequence[Statement]) -> list[str]:
    """Return statements as lines of Python without indent, for a function that is not a kernel, such as a joint's."""
    readable_statements = make_readable_statements(statements)
    return LinePrinter(readable_statements).print_lines(
        line for section in readable_statements.sections for line in section.statements
    )


def print_function(kernel: Kernel) -> str:
    """Return a kernel as the text of a Python function with its docstring.

    Scalars that C stores through pointers become return values; arrays are filled in place. The arguments for branches
    are left out.
    """
    targets = [line.target for section in kernel.sections for line in section.statements if isinstance(line, Statement)]
    returned = [a.name for a in kernel.arguments if Result(a.name) in targets]
    argument_names = [print_name(a.name) for a in kernel.arguments if a.name not in (*_BRANCH_ARGUMENTS, *returned)]
    text = [*break_code(f"def {kernel.name}({', '.join(argument_names)}):"), *indent_lines(print_docstring(kernel.doc))]
    readable_kernel = make_readable(kernel)
    for section in readable_kernel.sections:
        body = LinePrinter(readable_kernel).print_lines(section.statements)
        is_titled = not any(isinstance(line, SolveDependentRows) for line in section.statements)
        text += indent_lines([*print_comment(section.title if is_titled else ""), *body]) if body else []
    return "\n".join([*text, *([f"    return {', '.join(returned)}"] if returned else [])])


WIDTH = 100
_WIDTH = WIDTH - 12  # of a line without its indent, which is at most that of a function with two nested conditions


def break_code(text: str) -> list[str]:
    """Return a line of Python as lines of at most _WIDTH characters, as far as it can be broken inside brackets."""
    return line_breaks.break_code(text, _WIDTH, min_depth=1)


def print_assignment(target: str, value: str, comment: str = "", is_call: bool = False) -> list[str]:
    """Return `target = value` as lines of Python; a value longer than a line is put in brackets unless `is_call`.

    The comment follows on the same line if it fits, else precedes. is_call: whether the value has its own brackets.
    """
    line = f"{target} = {value}"
    lines = break_code(line if is_call or len(line) <= _WIDTH else f"{target} = ({value})")
    comment_text = f"# {remove_line_breaks(comment)}" if comment else ""
    if len(lines) == 1 and len(line) + 2 + len(comment_text) <= _WIDTH:
        return [f"{line}  {comment_text}".rstrip()]
    return [*print_comment(comment), *lines]


def print_comment(text: str) -> list[str]:
    """Return a text as comment lines; [] for an empty text."""
    return [f"# {line}" for line in textwrap.wrap(remove_line_breaks(text), _WIDTH - 2)]


def print_docstring(doc: Sequence[str]) -> list[str]:
    """Return the lines of a docstring from paragraphs; long ones are wrapped and continued with an indent."""
    printable = (remove_line_breaks(line, keep_spaces=True).replace("\\", "/").replace('"', "'") for line in doc)
    first, *others = [part for line in printable for part in _wrap_docstring_line(line)]
    return [f'"""{first}"""'] if not others else [f'"""{first}', *others, '"""']


def _wrap_docstring_line(line: str) -> list[str]:
    """Return a line of a docstring wrapped at WIDTH − 7; continuation lines have two more spaces of indent.

    [""] is returned for an empty line.
    """
    indent = line[: len(line) - len(line.lstrip())]
    return textwrap.wrap(line, WIDTH - 7, subsequent_indent=f"{indent}  ", break_on_hyphens=False) or [""]


def remove_line_breaks(text: str, keep_spaces: bool = False) -> str:
    """Return a user's text as one line: characters that are not printable, such as line breaks, become spaces.

    Several spaces become one, unless `keep_spaces`.
    """
    printable = "".join(c if c.isprintable() else " " for c in text)
    return printable.rstrip() if keep_spaces else " ".join(printable.split())


def indent_lines(text: Iterable[str]) -> list[str]:
    """Return lines indented by four columns."""
    return [f"    {line}" if line else "" for line in text]
