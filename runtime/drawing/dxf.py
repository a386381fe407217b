"""Write sketches as a DXF file for CAD: lines and circles in millimetres, with a layer for each body, joint, drive and
force.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from gudgeon.drawing.roles import EDGES, NAMES, ROLES, resolve_colour
from gudgeon.drawing.shapes import Disc, Line, Sketch
from gudgeon.errors import GudgeonError
from gudgeon.language.text_output import format_one_line
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
MM_PER_M = 1e3
MILLIMETRES = 4  # $INSUNITS
FORBIDDEN = str.maketrans(dict.fromkeys('<>/\\":;?*|=`,', "_"))  # in names of layers
MAX_LAYER_NAME = 200  # characters; the format allows 255
SKETCH_GAP = 0.1  # between two sketches, as a fraction of the widest one


def encode_dxf(sketches: Sequence[Sketch], titles: Sequence[str]) -> bytes:
    """Return sketches as the bytes of one DXF file (ASCII, R2010, millimetres), always the same for the same sketches.

    The first sketch has the ground's axes; the others are to its right, with `titles` above. An empty title is left
    out. Raises ValueError for a coordinate that is not finite.
    """
    with _suppress_dates():
        document = ezdxf.new(VERSION, units=MILLIMETRES)
        document.header["$MEASUREMENT"] = 1
        modelspace, layers = document.modelspace(), _Layers(document)
        distance = (1.0 + SKETCH_GAP) * max(float(sketch.high[0] - sketch.low[0]) for sketch in sketches)
        for k, (sketch, title) in enumerate(zip(sketches, titles, strict=True)):
            offset = np.array([k * distance, 0.0])
            _draw_sketch(modelspace, layers, sketch, offset)
            if title:
                position = offset + [sketch.low[0], sketch.high[1] + 2.0 * sketch.unit]
                _draw_text(modelspace, title, position, sketch.unit, {"layer": layers("titles", 0)})
        classes = document.classes
        classes.add_required_classes(document.dxfversion)
        classes.classes = dict(sorted(classes.classes.items()))  # ezdxf iterates over sets, in an order by hash
        out = io.StringIO()
        document.write(out)
    return out.getvalue().encode(document.output_encoding)


@contextmanager
def _suppress_dates() -> Iterator[None]:
    """Make ezdxf write no times and random identifiers within this context; the previous setting is restored."""
    previous_setting = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = previous_setting


class _Layers:
    """Names of layers by part: valid, and different also without regard to case."""

    def __init__(self, document: Drawing) -> None:
        """Start with the layers of a document."""
        self._table, self._names = document.layers, dict[str, str]()

    def __call__(self, part: str, colour_index: int) -> str:
        """Return the name of the layer of a part, created with the colour of index `colour_index` on first use.

        Forbidden characters are replaced, and a number is added to a name that another part uses.
        """
        if part not in self._names:
            valid_name = format_one_line(part).translate(FORBIDDEN)[:MAX_LAYER_NAME].strip() or "drawing"
            name, count = valid_name, 1
            while name in self._table:
                count += 1
                name = f"{valid_name} {count}"
            colour = EDGES[colour_index % len(EDGES)] if part.startswith("body ") else "#222222"
            self._table.add(name, true_color=_convert_colour(colour))
            self._names[part] = name
        return self._names[part]


def _convert_colour(code: str) -> int:
    """Return the DXF colour of a code "#rrggbb"."""
    return rgb2int((int(code[1:3], 16), int(code[3:5], 16), int(code[5:7], 16)))


def _draw_sketch(modelspace: Modelspace, layers: _Layers, sketch: Sketch, offset: Array) -> None:
    """Draw the outlines of a sketch in the order of painting, without fill, and its names.

    `offset` (2,) in m is added to all positions.
    """
    for shape in sorted(sketch.shapes, key=lambda shape: ROLES[shape.role].order):
        attributes: dict[str, str | int] = {"layer": layers(shape.part, shape.colour_index)}
        edge = resolve_colour(ROLES[shape.role].edge, shape.colour_index)
        if edge.startswith("#"):
            attributes |= {"true_color": _convert_colour(edge)}
        if isinstance(shape, Disc):
            centre, (radius, _) = _convert_to_millimetres(shape.centre + offset, np.array([shape.radius, 0.0]))
            modelspace.add_circle(centre, radius, dxfattribs=attributes)
        else:
            _draw_line(modelspace, shape, offset, attributes)
    for label in sketch.labels:
        angle = np.radians(label.direction)
        position = label.position + offset + (label.clearance + sketch.unit) * np.array([np.cos(angle), np.sin(angle)])
        colour = NAMES[label.role][0]
        attributes = {"layer": layers(label.part, 0)}
        if colour.startswith("#"):
            attributes |= {"true_color": _convert_colour(colour)}
        _draw_text(modelspace, label.text, position, sketch.unit, attributes)


def _draw_line(modelspace: Modelspace, shape: Line, offset: Array, attributes: dict[str, str | int]) -> None:
    """Draw a polyline in millimetres, moved by `offset` (m)."""
    modelspace.add_lwpolyline(
        _convert_to_millimetres(*(shape.points + offset)), close=shape.closed, dxfattribs=attributes
    )


def _draw_text(
    modelspace: Modelspace, text: str, position: Array, height: float, attributes: dict[str, str | int]
) -> None:
    """Draw a text in one line with the middle of its left edge at a position (m); `height` is in m."""
    ((x, y),) = _convert_to_millimetres(position)
    entity = modelspace.add_text(format_one_line(text), height=MM_PER_M * height, dxfattribs=attributes)
    entity.set_placement((x, y), align=TextEntityAlignment.MIDDLE_LEFT)


def _convert_to_millimetres(*points: Array) -> list[tuple[float, float]]:
    """Return positions (2,) in m as pairs in millimetres.

    Raises ValueError unless all are finite.
    """
    if not np.isfinite(points).all():
        raise ValueError("a coordinate is not finite")
    return [(MM_PER_M * float(x), MM_PER_M * float(y)) for x, y in points]
