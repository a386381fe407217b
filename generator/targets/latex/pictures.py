"""Draws the pictures of a document as static SVG and as characters: sparsity patterns, the spanning tree of bodies."""

from __future__ import annotations

import html
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.latex.document import Block, Picture, make_entry_token, make_row_token

MIN_CELL_SIDE, MIN_ASSEMBLED_CELL_SIDE = 10, 6  # pixels of an entry of the Jacobian, of the assembled matrix
MAX_CELL_SIDE = 20  # pixels of an entry
MAX_GROWN_WIDTH = 420  # pixels up to which the entries of a small matrix are enlarged
MAX_ROWS, MAX_COLUMNS = 150, 150  # a larger picture is not legible
MAX_GRID_COLUMNS = 92  # of a pattern in characters
NONZERO_CHARACTER, ZERO_CHARACTER = "■", "·"


@dataclass(frozen=True)
class NonzeroEntry:
    """Represent a nonzero entry of a matrix, indices from 0, with its highlighting token."""

    row: int
    column: int
    token: str = ""
    message: str = ""


def print_svg(width: float, height: float, label: str, parts: Sequence[str]) -> str:
    """Return an SVG element of a width and height in pixels, with a label for screen readers.

    parts: its child elements; their CSS classes get the colours of the page.
    """
    size = f'width="{width:g}" height="{height:g}" viewBox="0 0 {width:g} {height:g}"'
    return f'<svg {size} role="img" aria-label="{html.escape(label)}">{"".join(parts)}</svg>'


def draw_jacobian_pattern(model: Model) -> list[Block]:
    """Return the picture of the sparsity pattern of Φ_q in SVG and in characters; [] if it would be too large."""
    entries = _list_nonzero_entries(model)
    if not _fits_in_picture(len(model.rows), len(model.q)):
        return []
    cell_side = compute_cell_side(len(model.q), MIN_CELL_SIDE)
    parts = [
        *_print_body_names(model, 24, cell_side),
        *_print_row_numbers(model, 24, cell_side),
        *_print_squares(entries, 30, 24, "entry", cell_side),
    ]
    size = 30 + cell_side * len(model.q) + 4, 24 + cell_side * len(model.rows) + 4
    caption = "Rows and columns of the Jacobian with its nonzero entries"
    return [
        Picture(
            caption, print_svg(*size, caption, parts), _print_character_grid(len(model.rows), len(model.q), entries)
        )
    ]


def draw_assembled_matrix(model: Model) -> list[Block]:
    """Return the SVG picture of the sparsity pattern of [M Φ_qᵀ; Φ_q 0], with different colours of M and Φ_q.

    [] is returned if it would be too large (`_fits_in_picture`). It has no form in characters.
    """
    n, m = len(model.q), len(model.rows)
    if not _fits_in_picture(n + m, n + m):
        return []
    entries = _list_nonzero_entries(model)
    masses = [
        NonzeroEntry(k, k, f"body-{body.name}") for body in model.bodies for k in range(body.index, body.index + 3)
    ]
    jacobian = [NonzeroEntry(n + entry.row, entry.column, entry.token) for entry in entries]
    transposed = [NonzeroEntry(entry.column, n + entry.row, entry.token) for entry in entries]
    cell_side = compute_cell_side(n + m, MIN_ASSEMBLED_CELL_SIDE)
    total = cell_side * (n + m)
    lines = [
        f'<path class="rule" d="M0 {cell_side * n}H{total}M{cell_side * n} 0V{total}"/>' if m else "",
        f'<rect class="frame" x=".5" y=".5" width="{total - 1}" height="{total - 1}"/>',
    ]
    parts = [
        *_print_squares(masses, 0, 0, "mass", cell_side),
        *_print_squares([*transposed, *jacobian], 0, 0, "entry", cell_side),
        *lines,
    ]
    caption = "The assembled matrix: M on its diagonal, the Jacobian below and its transpose on the right"
    return [Picture(caption, print_svg(total, total, caption, parts))]


def _fits_in_picture(n_rows: int, n_columns: int) -> bool:
    """Return whether a matrix has at most MAX_ROWS rows and MAX_COLUMNS columns, so that its picture is legible."""
    return n_rows <= MAX_ROWS and n_columns <= MAX_COLUMNS


def compute_cell_side(n_columns: int, min_side: int) -> int:
    """Return the side of an entry in pixels: MAX_GROWN_WIDTH per column, from `min_side` to MAX_CELL_SIDE."""
    return min(MAX_CELL_SIDE, max(min_side, MAX_GROWN_WIDTH // max(1, n_columns)))


def _list_nonzero_entries(model: Model) -> list[NonzeroEntry]:
    """Return a NonzeroEntry for each nonzero entry of Φ_q, row by row."""
    column_of = {q: k for k, q in enumerate(model.q)}
    return [
        NonzeroEntry(r, column_of[q], make_entry_token(r + 1, column_of[q] + 1))
        for r, row in enumerate(model.rows)
        for q in row.phi_q
    ]


def _print_squares(entries: Sequence[NonzeroEntry], left: int, top: int, css_class: str, cell_side: int) -> list[str]:
    """Return an SVG group with one square for each nonzero entry of a matrix.

    left, top: the position of the matrix in pixels. css_class: "entry" or "mass". cell_side: side of an entry in
    pixels; the group passes the side of the squares to the style sheet as --cell. `data-of` of a square is the
    highlighting token of its entry.
    """
    squares = (
        f'<rect x="{left + cell_side * entry.column}" y="{top + cell_side * entry.row}" '
        f'data-of="{html.escape(entry.token)}"/>'
        for entry in entries
    )
    return [f'<g class="{css_class} cells" style="--cell: {cell_side - 1}px">', *squares, "</g>"]


def _print_body_names(model: Model, top: int, cell_side: int) -> list[str]:
    """Return the SVG of the names of the bodies above their three columns, each with a rule on its left.

    top: the vertical position of the matrix, cell_side: the side of an entry, both in pixels. Long names are shortened.
    """
    parts, max_characters = [], 3 * cell_side // 7  # letters that fit above three columns
    bottom = top + cell_side * len(model.rows)
    for body in model.bodies:
        x = 30 + cell_side * body.index
        name = html.escape(body.name if len(body.name) <= max_characters else f"{body.name[: max_characters - 1]}…")
        parts.append(f'<path class="rule" d="M{x - 0.5} {top - 6}V{bottom}"/>')
        parts.append(f'<text x="{x + 1}" y="{top - 9}" data-of="body-{html.escape(body.name)}">{name}</text>')
    return parts


def _print_row_numbers(model: Model, top: int, cell_side: int) -> list[str]:
    """Return SVG texts: the numbers of the constraint equations, from 1, on the left of a matrix.

    top: the vertical position of the matrix, cell_side: the side of an entry, both in pixels.
    """
    return [
        f'<text class="end" x="25" y="{top + cell_side * r + cell_side // 2 + 3}" '
        f'data-of="{make_row_token(r + 1)}">{r + 1}</text>'
        for r in range(len(model.rows))
    ]


def _print_character_grid(n_rows: int, n_columns: int, entries: Sequence[NonzeroEntry]) -> tuple[str, ...]:
    """Return the pattern of a matrix as lines of characters: NONZERO_CHARACTER or ZERO_CHARACTER for each entry.

    Each line begins with the number of its row, from 1. () is returned for more than MAX_GRID_COLUMNS columns.
    """
    if n_columns > MAX_GRID_COLUMNS:
        return ()
    grid = [[ZERO_CHARACTER] * n_columns for _ in range(n_rows)]
    for entry in entries:
        grid[entry.row][entry.column] = NONZERO_CHARACTER
    return tuple(f"{r:>3}  {''.join(line)}" for r, line in enumerate(grid, 1))


def draw_tree(reduction_log: ReductionLog, joints: Collection[str]) -> list[Block]:
    """Return the picture of the tree of bodies with its joints; [] if there is no tree, or if it is too large.

    joints: the names of the file's joints, which are highlighted.
    """
    children: dict[str, list[tuple[str, str]]] = {}
    for link in reduction_log.tree:
        children.setdefault(link.parent, []).append((link.body, link.joint))
    if not reduction_log.tree or len(reduction_log.tree) > MAX_ROWS:
        return []
    positions: dict[str, tuple[float, int]] = {}
    lines: list[str] = []
    _arrange_subtree(children, "ground", "", 0, [0], positions, lines)
    caption = "The tree: the parent of each body, and the joint that positions it"
    return [Picture(caption, _print_tree_svg(reduction_log, joints, positions, caption), tuple(lines))]


def _arrange_subtree(
    children: Mapping[str, Sequence[tuple[str, str]]],
    body: str,
    joint: str,
    depth: int,
    next_row: list[int],
    positions: dict[str, tuple[float, int]],
    lines: list[str],
) -> float:
    """Store (row, depth) of a body and of its descendants in the tree in `positions`, and return the body's row.

    A body is in the middle of its children; a leaf gets `next_row[0]`, which is then incremented. A line of text for
    each body is added to `lines`. children: (body, joint) of the children of each body. joint: that to the parent.
    """
    lines.append(f"{'   ' * depth}{body}{f'  by {joint}' if joint else ''}")
    child_rows = [
        _arrange_subtree(children, name, child_joint, depth + 1, next_row, positions, lines)
        for name, child_joint in children.get(body, ())
    ]
    if child_rows:
        row = (child_rows[0] + child_rows[-1]) / 2
    else:
        row = float(next_row[0])
        next_row[0] += 1
    positions[body] = (row, depth)
    return row


STEP_X, STEP_Y = 120, 34  # pixels between two depths and two rows of a tree


def _print_tree_svg(
    reduction_log: ReductionLog, joints: Collection[str], positions: Mapping[str, tuple[float, int]], caption: str
) -> str:
    """Return the tree of bodies as SVG: a box for each body, a curve with the joint's name to its parent.

    joints: names of the file's joints, which get a highlighting token. positions: (row, depth) of each body. caption:
    label of the picture.
    """
    centres = {body: (50 + STEP_X * depth, 20 + STEP_Y * row) for body, (row, depth) in positions.items()}
    parts = []
    for link in reduction_log.tree:
        (x0, y0), (x1, y1) = centres[link.parent], centres[link.body]
        line_class = "rule" if link.joint else "rule dashed"
        parts.append(f'<path class="{line_class}" d="M{x0} {y0:g}C{x0 + 60} {y0:g} {x1 - 60} {y1:g} {x1} {y1:g}"/>')
        if link.joint:
            name = html.escape(link.joint)
            at_y = (y0 + 3 * y1) / 4 - 4
            token = f' data-of="joint-{name}"' if link.joint in joints else ""
            short_name = name if len(link.joint) <= 9 else f"{html.escape(link.joint[:8])}…"
            parts.append(f'<text class="middle small" x="{x1 - 60}" y="{at_y:g}"{token}>{short_name}</text>')
    for body, (x, y) in centres.items():
        token = "" if body == "ground" else f' data-of="body-{html.escape(body)}"'
        parts.append(
            f'<g{token}><rect class="box" x="{x - 34}" y="{y - 12:g}" width="68" height="24" rx="4"/>'
            f'<text class="middle" x="{x}" y="{y + 4:g}">{html.escape(body)}</text></g>'
        )
    width, height = max(x for x, _ in centres.values()) + 40, max(y for _, y in centres.values()) + 20
    return print_svg(width, height, caption, parts)
