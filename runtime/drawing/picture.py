"""Draw a sketch with matplotlib: patches on axes with equal scales."""

from __future__ import annotations

import io
import re
import textwrap
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from gudgeon.drawing.labels import NameLabels, make_identifier
from gudgeon.drawing.roles import ROLES, Role, resolve_colour
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.language.text_output import format_figure_title

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.axes import Axes  # isort: skip
from matplotlib.figure import Figure  # isort: skip
from matplotlib.patches import Circle, Patch, Polygon  # isort: skip

MAX_SIDE_IN, MIN_SIDE_IN = 8.0, 3.2  # inches, of the longer and the shorter side
MIN_UNIT_IN, MAX_GROWN_SIDE_IN = 0.042, 24.0  # inches: smallest half width of a bar, and longest side to achieve it
PICTURE_GAP_IN = 0.3  # inches between pictures side by side
CHARACTERS_PER_INCH = 12.0  # characters of a caption
MAX_LARGE_NAMES = 28  # names that fit in the larger type
STYLE = {"font.size": 9, "text.usetex": False, "svg.hashsalt": "gudgeon", "path.sketch": None}
_MISSING_GLYPH = re.compile(r"Glyph (\d+) .*missing from font")


def draw_sketch(ax: Axes, sketch: Sketch, is_background: bool = False) -> None:
    """Draw the shapes and names of a sketch on matplotlib axes, set their limits and hide the frame.

    With `is_background`, all shapes but paths are grey and lie under the others. Each patch gets an identifier of its
    part.
    """
    shape_counts = Counter[str]()
    for shape in sorted(sketch.shapes, key=lambda shape: ROLES[shape.role].order):
        role = ROLES[shape.role]
        is_grey = is_background and not shape.role.startswith("path")
        patch = _make_patch(shape, role, is_grey)
        patch.set_zorder(role.order - (2.0 if is_grey else 0.0))
        shape_counts[shape.part] += 1
        identifier = make_identifier("", shape.part)
        patch.set_gid(identifier if shape_counts[shape.part] == 1 else f"{identifier}-{shape_counts[shape.part]}")
        ax.add_artist(patch)  # limits are set below: add_patch would update them for each shape
    if sketch.labels:
        names = NameLabels(sketch, 8.0 if len(sketch.labels) <= MAX_LARGE_NAMES else 7.0)
        ax.add_artist(names)
        names.set_clip_on(False)
    ax.set(xlim=(sketch.low[0], sketch.high[0]), ylim=(sketch.low[1], sketch.high[1]), aspect="equal")
    ax.set_axis_off()


def _make_patch(shape: Shape, role: Role, is_grey: bool) -> Patch:
    """Return the matplotlib patch of a shape in the style `role`: a circle for a disc, a polygon for a line.

    With `is_grey`, edge and face are grey. An open line is not filled.
    """
    edge, face = resolve_colour(role.edge, shape.colour_index), resolve_colour(role.face, shape.colour_index)
    style: dict[str, Any] = {"ec": edge, "fc": face, "lw": role.width, "joinstyle": "round", "capstyle": "round"}
    if role.dashes:
        style |= {"ls": (0.0, role.dashes)}
    if is_grey:
        style |= {"ec": "#bbbbbb" if edge != "none" else edge, "fc": "#f4f4f4" if face != "none" else face}
    if isinstance(shape, Disc):
        return Circle((float(shape.centre[0]), float(shape.centre[1])), shape.radius, **style)
    if not shape.closed:
        style["fc"] = "none"
    return Polygon(shape.points, closed=shape.closed, **style)


def compute_figure_size(sketch: Sketch, max_length: float = MAX_SIDE_IN) -> tuple[float, float]:
    """Return width and height in inches that suit a sketch.

    The longer side is `max_length`, but grows up to MAX_GROWN_SIDE_IN so that half a bar's width is at least
    MIN_UNIT_IN. The width is at least MIN_SIDE_IN, the height 0.75 MIN_SIDE_IN.
    """
    width, height = (float(x) for x in sketch.high - sketch.low)
    scale = max(max_length, min(MAX_GROWN_SIDE_IN, MIN_UNIT_IN * max(width, height) / sketch.unit)) / max(width, height)
    return max(MIN_SIDE_IN, width * scale), max(0.75 * MIN_SIDE_IN, height * scale)


def build_figure(sketches: Sequence[Sketch], titles: Sequence[str], caption: str) -> Figure:
    """Return a figure of one sketch, or of several in two or three columns with titles, under a caption.

    The notes of each sketch are below it. All pictures have the same size in inches.
    """
    n_columns = min(len(sketches), 3 if len(sketches) != 4 else 2)
    n_rows = -(-len(sketches) // n_columns)
    picture_sizes = [compute_figure_size(sketch, MAX_SIDE_IN if n_columns == 1 else 5.0) for sketch in sketches]
    width, height = max(w for w, _ in picture_sizes), max(h for _, h in picture_sizes)
    n_lines = len(textwrap.wrap(caption, int(CHARACTERS_PER_INCH * n_columns * width)))
    title_height, notes_height = 0.25 + 0.17 * n_lines, 0.17 * max(len(sketch.notes) for sketch in sketches) + 0.05
    with matplotlib.rc_context(STYLE):
        column_width = width + PICTURE_GAP_IN * (n_columns > 1)
        figure = Figure(
            figsize=(
                n_columns * column_width,
                n_rows * (height + title_height * (n_rows * n_columns > 1) + notes_height) + title_height,
            )
        )
        figure_width, figure_height = figure.get_size_inches()
        for k, (sketch, title) in enumerate(zip(sketches, titles, strict=True)):
            row, column = divmod(k, n_columns)
            picture_top = (
                figure_height
                - title_height
                - row * (height + notes_height + title_height)
                - title_height * (n_rows * n_columns > 1)
            )
            ax = figure.add_axes(
                (
                    column * column_width / figure_width,
                    (picture_top - height) / figure_height,
                    width / figure_width,
                    height / figure_height,
                )
            )
            draw_sketch(ax, sketch)
            if title:
                ax.set_title(title, fontsize=9)
            note = "\n".join(sketch.notes)
            position = ((column * column_width + 0.12) / figure_width, (picture_top - height - 0.02) / figure_height)
            figure.text(*position, note, fontsize=7.5, va="top", color="#444444", parse_math=False)
        width = int(CHARACTERS_PER_INCH * figure_width)
        figure.suptitle(
            format_figure_title(caption, width),
            x=0.1 / figure_width,
            y=1.0 - 0.1 / figure_height,
            ha="left",
            va="top",
            fontsize=10.5,
        )
    return figure


@contextmanager
def report_missing_glyphs() -> Iterator[None]:
    """Return a context in which matplotlib's warnings about missing glyphs are combined into one.

    That warning and all others are issued at the end of the context, not if an error ends it.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    missing_codes = dict.fromkeys(match[1] for w in caught if (match := _MISSING_GLYPH.match(str(w.message))))
    for w in caught:
        if not _MISSING_GLYPH.match(str(w.message)):
            warnings.warn_explicit(w.message, w.category, w.filename, w.lineno)
    if missing_codes:
        characters = "".join(chr(int(code)) for code in missing_codes)
        hint = "set another font in matplotlib.rcParams['font.family']"
        warnings.warn(f"the font has no glyph for {characters}: {hint}", stacklevel=4)


def encode_figure(picture: Figure, suffix: str, dpi: int = 120) -> bytes:
    """Return a figure as the bytes of an SVG, PNG or PDF file, always the same for the same figure.

    `suffix` is ".svg", ".png" or ".pdf"; any other raises KeyError. Date and version are left out. Glyphs that the font
    lacks are reported in one warning.
    """
    out = io.BytesIO()
    file_format = suffix.removeprefix(".")
    metadata = {
        "svg": {"Date": None, "Creator": None},
        "png": {"Software": None},
        "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    }[file_format]
    with matplotlib.rc_context(STYLE), report_missing_glyphs():
        picture.savefig(out, format=file_format, metadata=metadata, dpi=dpi)
    return out.getvalue()
