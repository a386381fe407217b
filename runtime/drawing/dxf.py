"""Write sketches as a DXF file for CAD: lines and circles in millimetres, with a layer for each body, joint, drive and
force.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from gudgeon.drawing.roles import EDGES, NAMES, ROLES, colour_of
from gudgeon.drawing.shapes import Disc, Line, Sketch
from gudgeon.errors import GudgeonError
from gudgeon.language.shown import one_line
from gudgeon.model.compiled import Array

try:
    import ezdxf
    from ezdxf.colors import rgb2int
    from ezdxf.document import Drawing
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.layouts import Modelspace
except ImportError as error:
    raise GudgeonError("DXF needs ezdxf: pip install 'gudgeon[plot,dxf]'") from error

VERSION = "R2010"  # texts are UTF-8, lines have any colour
SCALE = 1e3  # mm in a metre: what most CAD takes a bare number for
MILLIMETRES = 4  # $INSUNITS
FORBIDDEN = str.maketrans(dict.fromkeys('<>/\\":;?*|=`,', "_"))  # in names of layers
LONGEST = 200  # letters of a layer's name; the format has room for 255
APART = 0.1  # of the widest sketch, between two


def as_dxf(sketches: Sequence[Sketch], titles: Sequence[str]) -> bytes:
    """Return a DXF file (ASCII, R2010, $INSUNITS millimetres), always the same bytes for the same sketches.

    The first sketch has the ground's axes; others are to its right with their titles. Raises GudgeonError without
    ezdxf, ValueError for a coordinate that is not finite.
    """
    with _no_dates():
        document = ezdxf.new(VERSION, units=MILLIMETRES)
        document.header["$MEASUREMENT"] = 1
        space, layers = document.modelspace(), _Layers(document)
        pitch = (1.0 + APART) * max(float(sketch.high[0] - sketch.low[0]) for sketch in sketches)
        for k, (sketch, title) in enumerate(zip(sketches, titles, strict=True)):
            moved = np.array([k * pitch, 0.0])
            _draw(space, layers, sketch, moved)
            if title:
                at = moved + [sketch.low[0], sketch.high[1] + 2.0 * sketch.unit]
                _draw_text(space, title, at, sketch.unit, {"layer": layers("titles", 0)})
        known = document.classes
        known.add_required_classes(document.dxfversion)
        known.classes = dict(sorted(known.classes.items()))  # ezdxf takes them from sets, in an order by hash
        out = io.StringIO()
        document.write(out)
    return out.getvalue().encode(document.output_encoding)


@contextmanager
def _no_dates() -> Iterator[None]:
    """Make ezdxf write no times and random identifiers within this context."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


class _Layers:
    """Names of layers by part: valid, and different also without regard to case."""

    def __init__(self, document: Drawing) -> None:
        """Start with the layers of a document."""
        self._table, self._names = document.layers, dict[str, str]()

    def __call__(self, part: str, tint: int) -> str:
        """Return the layer of a part, created on first use."""
        if part not in self._names:
            expected = one_line(part).translate(FORBIDDEN)[:LONGEST].strip() or "drawing"
            name, count = expected, 1
            while name in self._table:
                count += 1
                name = f"{expected} {count}"
            colour = EDGES[tint % len(EDGES)] if part.startswith("body ") else "#222222"
            self._table.add(name, true_color=_as_dxf_colour(colour))
            self._names[part] = name
        return self._names[part]


def _as_dxf_colour(code: str) -> int:
    """Return the DXF colour of a code "#rrggbb"."""
    return rgb2int((int(code[1:3], 16), int(code[3:5], 16), int(code[5:7], 16)))


def _draw(space: Modelspace, layers: _Layers, sketch: Sketch, moved: Array) -> None:
    """Draw the outlines of a sketch in the order of painting, without fill, and its names."""
    for shape in sorted(sketch.shapes, key=lambda shape: ROLES[shape.role].order):
        look: dict[str, str | int] = {"layer": layers(shape.part, shape.tint)}
        edge = colour_of(ROLES[shape.role].edge, shape.tint)
        if edge.startswith("#"):
            look |= {"true_color": _as_dxf_colour(edge)}
        if isinstance(shape, Disc):
            centre, (radius, _) = _in_millimetres(shape.centre + moved, np.array([shape.radius, 0.0]))
            space.add_circle(centre, radius, dxfattribs=look)
        else:
            _draw_line(space, shape, moved, look)
    for label in sketch.labels:
        way = np.radians(label.way)
        at = label.place + moved + (label.clear + sketch.unit) * np.array([np.cos(way), np.sin(way)])
        colour = NAMES[label.role][0]
        look = {"layer": layers(label.part, 0)}
        if colour.startswith("#"):
            look |= {"true_color": _as_dxf_colour(colour)}
        _draw_text(space, label.text, at, sketch.unit, look)


def _draw_line(space: Modelspace, shape: Line, moved: Array, look: dict[str, str | int]) -> None:
    """Draw a polyline."""
    space.add_lwpolyline(_in_millimetres(*(shape.points + moved)), close=shape.closed, dxfattribs=look)


def _draw_text(space: Modelspace, text: str, at: Array, height: float, look: dict[str, str | int]) -> None:
    """Draw a text with its left middle at a position."""
    ((x, y),) = _in_millimetres(at)
    made = space.add_text(one_line(text), height=SCALE * height, dxfattribs=look)
    made.set_placement((x, y), align=TextEntityAlignment.MIDDLE_LEFT)


def _in_millimetres(*points: Array) -> list[tuple[float, float]]:
    """Return positions in millimetres. Raises ValueError unless they are finite."""
    if not np.isfinite(points).all():
        raise ValueError("a coordinate is not finite")
    return [(SCALE * float(x), SCALE * float(y)) for x, y in points]
