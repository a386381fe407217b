"""Renders parts of a document as HTML: MathML, tokens for cross-highlighting, elements for values, listings.

`Letters` writes a model's equations in a notebook or a terminal.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Collection, Iterator
from itertools import pairwise
from xml.etree.ElementTree import Element, tostring

import sympy as sp

from gudgeon.errors import GudgeonError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.latex.document import Listing, Text
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import make_notation

_FUNCTIONS = ("sin", "cos", "tan")


def attributes(of: Collection[str], pick: str = "", focus: bool = False) -> str:
    """Return the attribute `data-of` and others of an element, with a leading space; "" without tokens."""
    if not of:
        return ""
    picks = f' data-pick="{html.escape(pick)}"' if pick else ""
    return f' data-of="{html.escape(" ".join(of))}"{picks}' + ' tabindex="0"' * focus


def output(value: str) -> str:
    """Return the element in which a running page shows a value."""
    return f'<output data-value="{html.escape(value)}"></output>' if value else ""


def line(text: Text) -> str:
    """Return words and formulas as HTML."""
    return "".join(formula(part) if isinstance(part, Name) else html.escape(part) for part in text)


def formula(name: Name) -> str:
    """Return a formula as MathML with its tokens and value; a line may break as in LaTeX."""
    message = "".join(map(mathml, _pieces(name.latex))) + output(name.value)
    return f"<span{attributes(name.of)}>{message}</span>" if name.of else message


def _pieces(latex: str) -> Iterator[str]:
    """Return a formula split at each \\allowbreak outside of braces."""
    held = ""
    for part in latex.split(r"\allowbreak "):
        held += part
        if held.count("{") == held.count("}") and held.count(r"\left") == held.count(r"\right"):
            yield held
            held = ""
    if held:
        yield held


def mathml(latex: str) -> str:
    """Return a formula as MathML. Raises GudgeonError if the extra `docs` is not installed."""
    try:
        from latex2mathml.converter import convert_to_element
    except ImportError as error:
        raise GudgeonError("HTML needs latex2mathml: pip install 'gudgeon[docs]'") from error
    text = latex.replace(r"^{\circ}", "°").replace(r"\surd ", r"\text{√}")  # which no font has to raise, nor to stretch
    whole = convert_to_element(text)
    whole.attrib.clear()  # what a page takes for granted
    for row in list(whole.iter()):
        _space_functions(row)
        _read_signs(row)
        _without_rows(row)
    shown = tostring(whole, encoding="unicode").replace(" />", "/>").replace(r"\_", "_")
    shown = shown.replace(' fence="true"', "")  # which changes nothing that is seen
    return shown.replace('"0.167em"', '".17em"')  # of a thin space there are hundreds on a page


def _read_signs(part: Element) -> None:
    """Return MathML with numeric character references replaced by characters."""
    part.text = html.unescape(part.text) if part.text else part.text


def _without_rows(part: Element) -> None:
    """Return MathML without superfluous rows and styles; an empty row before a sign makes it binary."""
    for k, inner in enumerate(part):
        while inner.tag in ("mrow", "mstyle") and len(inner) == 1 and not (inner.text or "").strip():
            inner[0].attrib = inner.attrib | inner[0].attrib
            inner = inner[0]
            part[k] = inner


def _space_functions(row: Element) -> None:
    """Return MathML with a space between a function's name and its argument, which browsers omit."""
    for k, (word, of) in reversed(list(enumerate(pairwise(row)))):
        base_of_power = row.tag == "msup" and k == 0
        if word.tag == "mi" and word.text in _FUNCTIONS and of.tag.startswith(("mr", "ms")) and not base_of_power:
            row.insert(k + 1, Element("mspace", {"width": "0.167em"}))


def listing(block: Listing) -> str:
    """Return a file with line numbers, folded."""
    lines = (
        f'<span class="line"{attributes(sorted(block.of.get(k, ())), focus=True)}>{html.escape(text) or " "}</span>'
        for k, text in enumerate(block.lines, 1)
    )
    title = html.escape(block.title)
    return f'<details open><summary>{title}</summary><pre class="listing">{"".join(lines)}</pre></details>'


class Letters:
    """Write expressions of one model as formulas."""

    def __init__(self, model: Model) -> None:
        self.model, self.notation = model, make_notation(model)

    def latex(self, matrix: sp.Matrix) -> str:
        """Return a matrix as LaTeX."""
        rows = r" \\ ".join(map(" & ".join, self._rows(matrix, lambda name: name.latex)))
        return rf"\left[\begin{{array}}{{{'c' * matrix.cols}}}{rows}\end{{array}}\right]"

    def text(self, matrix: sp.Matrix) -> str:
        """Return a matrix as plain text, a line for each row."""
        return "\n".join(f"[{', '.join(row)}]" for row in self._rows(matrix, lambda name: name.text))

    def equation(self) -> Name:
        """Return Φ(q, t) = 0, row by row."""
        return Name(rf"\Phi(q, t) = {self.latex(self.model.Phi)} = 0", f"Φ(q, t) =\n{self.text(self.model.Phi)}")

    def html(self) -> str:
        """Return a matrix as MathML; LaTeX between dollar signs without the extra `docs`."""
        try:
            return mathml(self.equation().latex)
        except GudgeonError:
            return f"$${self.equation().latex}$$"

    def _rows(self, matrix: sp.Matrix, write: Callable[[Name], str]) -> list[list[str]]:
        """Return the entries of a matrix, each written by `write`."""
        return [[write(self.notation.math(matrix[r, c])) for c in range(matrix.cols)] for r in range(matrix.rows)]
