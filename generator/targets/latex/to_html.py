"""Renders parts of a document as HTML: MathML, tokens for cross-highlighting, elements for values, listings.

`FormulaWriter` writes a model's equations in a notebook or a terminal.
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
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.notation import make_notation

_TRIGONOMETRIC_FUNCTIONS = ("sin", "cos", "tan")


def print_attributes(tokens: Collection[str], selection_token: str = "", is_focusable: bool = False) -> str:
    """Return the attributes of an HTML element for cross-highlighting, with a leading space; "" without tokens.

    tokens: the highlighting tokens, for `data-of`. selection_token: the token that selecting the element highlights,
    for `data-pick`; "" for all. is_focusable: whether the keyboard can reach the element.
    """
    if not tokens:
        return ""
    pick_attribute = f' data-pick="{html.escape(selection_token)}"' if selection_token else ""
    return f' data-of="{html.escape(" ".join(tokens))}"{pick_attribute}' + ' tabindex="0"' * is_focusable


def print_value_element(value_name: str) -> str:
    """Return the HTML element in which a running page shows the value of this name; "" for an empty name."""
    return f'<output data-value="{html.escape(value_name)}"></output>' if value_name else ""


def print_instruction(text: Text) -> str:
    """Return words and formulas as HTML."""
    return "".join(print_formula(part) if isinstance(part, Formula) else html.escape(part) for part in text)


def print_formula(name: Formula) -> str:
    """Return a formula as MathML, then the element of its value; within a span with its tokens if it has any."""
    mathml_text = "".join(map(convert_to_mathml, _split_formula(name.latex))) + print_value_element(name.value)
    return f"<span{print_attributes(name.tokens)}>{mathml_text}</span>" if name.tokens else mathml_text


def _split_formula(latex: str) -> Iterator[str]:
    """Yield the parts of a formula, split at each \\allowbreak outside of braces and of pairs \\left … \\right."""
    piece = ""
    for part in latex.split(r"\allowbreak "):
        piece += part
        if piece.count("{") == piece.count("}") and piece.count(r"\left") == piece.count(r"\right"):
            yield piece
            piece = ""
    if piece:
        yield piece


def convert_to_mathml(latex: str) -> str:
    """Return a formula in LaTeX as MathML (latex2mathml) without superfluous elements and attributes.

    Raises GudgeonError if the extra `docs` is not installed.
    """
    try:
        from latex2mathml.converter import convert_to_element
    except ImportError as error:
        raise GudgeonError("HTML needs latex2mathml: pip install 'gudgeon[docs]'") from error
    latex_text = latex.replace(r"^{\circ}", "°").replace(
        r"\surd ", r"\text{√}"
    )  # signs that need no superscript and no stretching
    root = convert_to_element(latex_text)
    root.attrib.clear()  # the namespace and the display mode are defaults in HTML
    for row in list(root.iter()):
        _insert_function_spaces(row)
        _unescape_text(row)
        _unwrap_rows(row)
    xml_text = tostring(root, encoding="unicode").replace(" />", "/>").replace(r"\_", "_")
    xml_text = xml_text.replace(' fence="true"', "")  # has no visible effect
    return xml_text.replace('"0.167em"', '".17em"')  # shorter, since a page has hundreds of thin spaces


def _unescape_text(element: Element) -> None:
    """Replace numeric character references in the text of an element by characters, in place."""
    element.text = html.unescape(element.text) if element.text else element.text


def _unwrap_rows(element: Element) -> None:
    """Replace each child of an element that is an mrow or mstyle around one element by that element, in place.

    The inner element gets the attributes. An empty mrow before an operator stays, since it makes the operator binary.
    """
    for k, child in enumerate(element):
        while child.tag in ("mrow", "mstyle") and len(child) == 1 and not (child.text or "").strip():
            child[0].attrib = child.attrib | child[0].attrib
            child = child[0]
            element[k] = child


def _insert_function_spaces(element: Element) -> None:
    """Insert a thin space between sin, cos or tan and its argument, in place, since browsers omit it."""
    for k, (name, argument) in reversed(list(enumerate(pairwise(element)))):
        base_of_power = element.tag == "msup" and k == 0
        if (
            name.tag == "mi"
            and name.text in _TRIGONOMETRIC_FUNCTIONS
            and argument.tag.startswith(("mr", "ms"))
            and not base_of_power
        ):
            element.insert(k + 1, Element("mspace", {"width": "0.167em"}))


def print_listing(block: Listing) -> str:
    """Return the listing of a file as HTML: a foldable element (details) with a span for each line and its tokens."""
    lines = (
        f'<span class="line"{print_attributes(sorted(block.tokens_by_line.get(k, ())), is_focusable=True)}>'
        f"{html.escape(text) or ' '}</span>"
        for k, text in enumerate(block.lines, 1)
    )
    title = html.escape(block.title)
    return f'<details open><summary>{title}</summary><pre class="listing">{"".join(lines)}</pre></details>'


class FormulaWriter:
    """Write the constraint equations and matrices of one model as formulas, for a notebook or a terminal."""

    def __init__(self, model: Model) -> None:
        self.model, self.notation = model, make_notation(model)

    def latex(self, matrix: sp.Matrix) -> str:
        """Return a matrix as LaTeX."""
        rows = r" \\ ".join(map(" & ".join, self._format_entries(matrix, lambda name: name.latex)))
        return rf"\left[\begin{{array}}{{{'c' * matrix.cols}}}{rows}\end{{array}}\right]"

    def text(self, matrix: sp.Matrix) -> str:
        """Return a matrix as plain text, a line for each row."""
        return "\n".join(f"[{', '.join(row)}]" for row in self._format_entries(matrix, lambda name: name.text))

    def equation(self) -> Formula:
        """Return the constraint equations Φ(q, t) = 0, one below the other."""
        return Formula(rf"\Phi(q, t) = {self.latex(self.model.Phi)} = 0", f"Φ(q, t) =\n{self.text(self.model.Phi)}")

    def html(self) -> str:
        """Return Φ(q, t) = 0 as MathML; as LaTeX between dollar signs without the extra `docs`."""
        try:
            return convert_to_mathml(self.equation().latex)
        except GudgeonError:
            return f"$${self.equation().latex}$$"

    def _format_entries(self, matrix: sp.Matrix, format_name: Callable[[Formula], str]) -> list[list[str]]:
        """Return the rows of a matrix as lists of texts; `format_name` returns the text of a formula."""
        return [
            [format_name(self.notation.format_expression(matrix[r, c])) for c in range(matrix.cols)]
            for r in range(matrix.rows)
        ]
