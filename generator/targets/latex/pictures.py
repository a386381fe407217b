"""Draws a document's pictures as small static SVG and as characters: patterns of matrices, the tree of bodies."""

from __future__ import annotations

import html
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.latex.document import Block, Picture, entry_token, row_token

SMALL, TINY, LARGE = 10, 6, 20  # side of an entry in a picture of a matrix, of an assembled one; at most
ROOM = 420  # pixels up to which a small matrix grows
MOST_ROWS, MOST_COLUMNS = 150, 150  # beyond which nobody sees anything in it
WIDEST_GRID = 92  # columns of characters
FULL, EMPTY = "■", "·"


@dataclass(frozen=True)
class Dot:
    """Represent a nonzero entry of a matrix, indices from 0, with its token."""

    row: int
    column: int
    of: str = ""
    message: str = ""


def svg(width: float, height: float, label: str, parts: Sequence[str]) -> str:
    """Return a picture that scales with its column; colours are those of the page."""
    size = f'width="{width:g}" height="{height:g}" viewBox="0 0 {width:g} {height:g}"'
    return f'<svg {size} role="img" aria-label="{html.escape(label)}">{"".join(parts)}</svg>'


def pattern(model: Model) -> list[Block]:
    """Return the picture of the nonzero entries of Φ_q."""
    dots = _entries(model)
    if not _fits(len(model.rows), len(model.q)):
        return []
    cell = cell_side(len(model.q), SMALL)
    parts = [*_columns(model, 24, cell), *_row_names(model, 24, cell), *_dots(dots, 30, 24, "entry", cell)]
    size = 30 + cell * len(model.q) + 4, 24 + cell * len(model.rows) + 4
    caption = "Rows and columns of the Jacobian with its entries that are not zero"
    return [Picture(caption, svg(*size, caption, parts), _grid(len(model.rows), len(model.q), dots))]


def assembled(model: Model) -> list[Block]:
    """Return the picture of [M Φ_qᵀ; Φ_q 0] with its blocks distinguished."""
    n, m = len(model.q), len(model.rows)
    if not _fits(n + m, n + m):
        return []
    entries = _entries(model)
    masses = [Dot(k, k, f"body-{body.name}") for body in model.bodies for k in range(body.index, body.index + 3)]
    below = [Dot(n + dot.row, dot.column, dot.of) for dot in entries]
    above = [Dot(dot.column, n + dot.row, dot.of) for dot in entries]
    cell = cell_side(n + m, TINY)
    total = cell * (n + m)
    lines = [
        f'<path class="rule" d="M0 {cell * n}H{total}M{cell * n} 0V{total}"/>' if m else "",
        f'<rect class="frame" x=".5" y=".5" width="{total - 1}" height="{total - 1}"/>',
    ]
    parts = [*_dots(masses, 0, 0, "mass", cell), *_dots([*above, *below], 0, 0, "entry", cell), *lines]
    caption = "The assembled matrix: M on its diagonal, the Jacobian below and its transpose on the right"
    return [Picture(caption, svg(total, total, caption, parts))]


def _fits(rows: int, columns: int) -> bool:
    """Return whether a matrix is small enough for a picture."""
    return rows <= MOST_ROWS and columns <= MOST_COLUMNS


def cell_side(columns: int, least: int) -> int:
    """Return the side of an entry in pixels; fewer entries are larger."""
    return min(LARGE, max(least, ROOM // max(1, columns)))


def _entries(model: Model) -> list[Dot]:
    """Return the nonzero entries of Φ_q."""
    place = {q: k for k, q in enumerate(model.q)}
    return [Dot(r, place[q], entry_token(r + 1, place[q] + 1)) for r, row in enumerate(model.rows) for q in row.phi_q]


def _dots(dots: Sequence[Dot], x: int, y: int, kind: str, cell: int) -> list[str]:
    """Return a group of squares, whose size the page reads from it."""
    squares = (
        f'<rect x="{x + cell * dot.column}" y="{y + cell * dot.row}" data-of="{html.escape(dot.of)}"/>' for dot in dots
    )
    return [f'<g class="{kind} cells" style="--cell: {cell - 1}px">', *squares, "</g>"]


def _columns(model: Model, top: int, cell: int) -> list[str]:
    """Return the names of the bodies above their three columns, each with a rule on its left."""
    parts, most = [], 3 * cell // 7  # letters that fit above three columns
    bottom = top + cell * len(model.rows)
    for body in model.bodies:
        x = 30 + cell * body.index
        name = html.escape(body.name if len(body.name) <= most else f"{body.name[: most - 1]}…")
        parts.append(f'<path class="rule" d="M{x - 0.5} {top - 6}V{bottom}"/>')
        parts.append(f'<text x="{x + 1}" y="{top - 9}" data-of="body-{html.escape(body.name)}">{name}</text>')
    return parts


def _row_names(model: Model, top: int, cell: int) -> list[str]:
    """Return the numbers of the rows."""
    return [
        f'<text class="end" x="25" y="{top + cell * r + cell // 2 + 3}" data-of="{row_token(r + 1)}">{r + 1}</text>'
        for r in range(len(model.rows))
    ]


def _grid(rows: int, columns: int, dots: Sequence[Dot]) -> tuple[str, ...]:
    """Return the pattern in characters; nothing if it is too wide."""
    if columns > WIDEST_GRID:
        return ()
    grid = [[EMPTY] * columns for _ in range(rows)]
    for dot in dots:
        grid[dot.row][dot.column] = FULL
    return tuple(f"{r:>3}  {''.join(line)}" for r, line in enumerate(grid, 1))


def tree(story: ReductionLog, joints: Collection[str]) -> list[Block]:
    """Return the picture of the tree of bodies, with the joints along it; `joints` are those of the file."""
    carried: dict[str, list[tuple[str, str]]] = {}
    for placed in story.tree:
        carried.setdefault(placed.parent, []).append((placed.body, placed.joint))
    if not story.tree or len(story.tree) > MOST_ROWS:
        return []
    places: dict[str, tuple[float, int]] = {}
    lines: list[str] = []
    _place(carried, "ground", "", 0, [0], places, lines)
    caption = "The tree: who places whom, and by which joint"
    return [Picture(caption, _tree_svg(story, joints, places, caption), tuple(lines))]


def _place(
    carried: Mapping[str, Sequence[tuple[str, str]]],
    body: str,
    joint: str,
    depth: int,
    next_row: list[int],
    places: dict[str, tuple[float, int]],
    lines: list[str],
) -> float:
    """Return row and depth of each body, from left to right by depth; a body is in the middle of its children."""
    lines.append(f"{'   ' * depth}{body}{f'  by {joint}' if joint else ''}")
    own = [_place(carried, name, by, depth + 1, next_row, places, lines) for name, by in carried.get(body, ())]
    if own:
        row = (own[0] + own[-1]) / 2
    else:
        row = float(next_row[0])
        next_row[0] += 1
    places[body] = (row, depth)
    return row


STEP_X, STEP_Y = 120, 34


def _tree_svg(
    story: ReductionLog, joints: Collection[str], places: Mapping[str, tuple[float, int]], caption: str
) -> str:
    """Return the tree as SVG."""
    at = {body: (50 + STEP_X * depth, 20 + STEP_Y * row) for body, (row, depth) in places.items()}
    parts = []
    for placed in story.tree:
        (x0, y0), (x1, y1) = at[placed.parent], at[placed.body]
        kind = "rule" if placed.joint else "rule loose"
        parts.append(f'<path class="{kind}" d="M{x0} {y0:g}C{x0 + 60} {y0:g} {x1 - 60} {y1:g} {x1} {y1:g}"/>')
        if placed.joint:
            name = html.escape(placed.joint)
            at_y = (y0 + 3 * y1) / 4 - 4
            of = f' data-of="joint-{name}"' if placed.joint in joints else ""
            shown = name if len(placed.joint) <= 9 else f"{html.escape(placed.joint[:8])}…"
            parts.append(f'<text class="middle small" x="{x1 - 60}" y="{at_y:g}"{of}>{shown}</text>')
    for body, (x, y) in at.items():
        of = "" if body == "ground" else f' data-of="body-{html.escape(body)}"'
        parts.append(
            f'<g{of}><rect class="box" x="{x - 34}" y="{y - 12:g}" width="68" height="24" rx="4"/>'
            f'<text class="middle" x="{x}" y="{y + 4:g}">{html.escape(body)}</text></g>'
        )
    width, height = max(x for x, _ in at.values()) + 40, max(y for _, y in at.values()) + 20
    return svg(width, height, caption, parts)
