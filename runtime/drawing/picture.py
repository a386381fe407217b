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

from gudgeon.drawing.labels import Names, gid
from gudgeon.drawing.roles import ROLES, Role, colour_of
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.language.shown import figure_title

import matplotlib  # isort: skip  (labels.py says where it is missing)
from matplotlib.axes import Axes  # isort: skip
from matplotlib.figure import Figure  # isort: skip
from matplotlib.patches import Circle, Patch, Polygon  # isort: skip

LARGEST, SMALLEST = 8.0, 3.2  # inches, of the longer and the shorter side
LEAST_UNIT, MOST = 0.042, 24.0  # inches: of half a bar's width at least, for which the longer side may grow so far
APART = 0.3  # inches between pictures side by side
PER_INCH = 12.0  # characters of a caption
FEW = 28  # names that fit in the larger type
STYLE = {"font.size": 9, "text.usetex": False, "svg.hashsalt": "gudgeon", "path.sketch": None}
_LACKS = re.compile(r"Glyph (\d+) .*missing from font")


def draw_on(ax: Axes, sketch: Sketch, faint: bool = False) -> None:
    """Draw a sketch on axes and set their limits; `faint` in grey, as a background."""
    seen = Counter[str]()
    for shape in sorted(sketch.shapes, key=lambda shape: ROLES[shape.role].order):
        role = ROLES[shape.role]
        pale = faint and not shape.role.startswith("path")
        patch = _make_patch(shape, role, pale)
        patch.set_zorder(role.order - (2.0 if pale else 0.0))
        seen[shape.part] += 1
        message = gid("", shape.part)
        patch.set_gid(message if seen[shape.part] == 1 else f"{message}-{seen[shape.part]}")
        ax.add_artist(patch)  # limits are set below: add_patch would look for them shape by shape
    if sketch.labels:
        names = Names(sketch, 8.0 if len(sketch.labels) <= FEW else 7.0)
        ax.add_artist(names)
        names.set_clip_on(False)
    ax.set(xlim=(sketch.low[0], sketch.high[0]), ylim=(sketch.low[1], sketch.high[1]), aspect="equal")
    ax.set_axis_off()


def _make_patch(shape: Shape, role: Role, pale: bool) -> Patch:
    """Return the matplotlib patch of a shape; `pale` in grey."""
    edge, face = colour_of(role.edge, shape.tint), colour_of(role.face, shape.tint)
    look: dict[str, Any] = {"ec": edge, "fc": face, "lw": role.width, "joinstyle": "round", "capstyle": "round"}
    if role.dashes:
        look |= {"ls": (0.0, role.dashes)}
    if pale:
        look |= {"ec": "#bbbbbb" if edge != "none" else edge, "fc": "#f4f4f4" if face != "none" else face}
    if isinstance(shape, Disc):
        return Circle((float(shape.centre[0]), float(shape.centre[1])), shape.radius, **look)
    if not shape.closed:
        look["fc"] = "none"
    return Polygon(shape.points, closed=shape.closed, **look)


def size_of(sketch: Sketch, largest: float = LARGEST) -> tuple[float, float]:
    """Return width and height in inches that suit a sketch."""
    width, height = (float(x) for x in sketch.high - sketch.low)
    scale = max(largest, min(MOST, LEAST_UNIT * max(width, height) / sketch.unit)) / max(width, height)
    return max(SMALLEST, width * scale), max(0.75 * SMALLEST, height * scale)


def figure_of(sketches: Sequence[Sketch], titles: Sequence[str], caption: str) -> Figure:
    """Return a figure of one sketch, or of several side by side with titles."""
    columns = min(len(sketches), 3 if len(sketches) != 4 else 2)
    rows = -(-len(sketches) // columns)
    sizes = [size_of(sketch, LARGEST if columns == 1 else 5.0) for sketch in sketches]
    width, height = max(w for w, _ in sizes), max(h for _, h in sizes)
    lines = len(textwrap.wrap(caption, int(PER_INCH * columns * width)))
    head, foot = 0.25 + 0.17 * lines, 0.17 * max(len(sketch.notes) for sketch in sketches) + 0.05
    with matplotlib.rc_context(STYLE):
        pitch = width + APART * (columns > 1)
        picture = Figure(figsize=(columns * pitch, rows * (height + head * (rows * columns > 1) + foot) + head))
        across, down = picture.get_size_inches()
        for k, (sketch, title) in enumerate(zip(sketches, titles, strict=True)):
            row, column = divmod(k, columns)
            top = down - head - row * (height + foot + head) - head * (rows * columns > 1)
            ax = picture.add_axes((column * pitch / across, (top - height) / down, width / across, height / down))
            draw_on(ax, sketch)
            if title:
                ax.set_title(title, fontsize=9)
            note = "\n".join(sketch.notes)
            place = ((column * pitch + 0.12) / across, (top - height - 0.02) / down)
            picture.text(*place, note, fontsize=7.5, va="top", color="#444444", parse_math=False)
        width = int(PER_INCH * across)
        picture.suptitle(
            figure_title(caption, width), x=0.1 / across, y=1.0 - 0.1 / down, ha="left", va="top", fontsize=10.5
        )
    return picture


@contextmanager
def report_missing_glyphs() -> Iterator[None]:
    """Report characters that the font lacks once for a picture, instead of once for each layout."""
    with warnings.catch_warnings(record=True) as message:
        warnings.simplefilter("always")
        yield
    lacking = dict.fromkeys(found[1] for w in message if (found := _LACKS.match(str(w.message))))
    for w in message:
        if not _LACKS.match(str(w.message)):
            warnings.warn_explicit(w.message, w.category, w.filename, w.lineno)
    if lacking:
        signs = "".join(chr(int(sign)) for sign in lacking)
        hint = "matplotlib.rcParams['font.family'] names another"
        warnings.warn(f"the font has no sign for {signs}: {hint}", stacklevel=4)


def as_bytes(picture: Figure, suffix: str, dpi: int = 120) -> bytes:
    """Return an SVG, PNG or PDF without date or version, always the same bytes for the same picture."""
    out = io.BytesIO()
    kind = suffix.removeprefix(".")
    metadata = {
        "svg": {"Date": None, "Creator": None},
        "png": {"Software": None},
        "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    }[kind]
    with matplotlib.rc_context(STYLE), report_missing_glyphs():
        picture.savefig(out, format=kind, metadata=metadata, dpi=dpi)
    return out.getvalue()
