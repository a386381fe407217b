"""Write a sketch as a TikZ picture for LaTeX, with names where matplotlib places them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from gudgeon.drawing.labels import MIN_LEADER_DISTANCE, NameLabels
from gudgeon.drawing.picture import compute_figure_size, draw_sketch
from gudgeon.drawing.roles import NAMES, ROLES, resolve_colour
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.language.text_output import format_one_line
from gudgeon.model.compiled import Array

from matplotlib.figure import Figure  # isort: skip  (labels.py says where it is missing)

MAX_WIDTH_IN, MAX_HEIGHT_IN = 6.3, 5.0  # inches on the page


def format_tikz(sketch: Sketch, escape_latex: Callable[[str], str]) -> str:
    """Return a sketch as the text of a tikzpicture with definitions of its colours; nothing is written.

    It is at most MAX_WIDTH_IN by MAX_HEIGHT_IN inches. `escape_latex` converts a name to LaTeX without commands.
    matplotlib places the names.
    """
    width, height = compute_figure_size(sketch, MAX_WIDTH_IN)
    shrink_factor = min(1.0, MAX_WIDTH_IN / width, MAX_HEIGHT_IN / height)
    width, height = width * shrink_factor, height * shrink_factor
    figure = Figure(figsize=(width, height), dpi=72)
    draw_sketch(figure.add_axes((0.0, 0.0, 1.0, 1.0)), sketch)
    figure.draw_without_rendering()
    to_points = figure.axes[0].transData.transform  # pixels at 72 to the inch are TeX's bp
    colours = _Colours()
    lines = [
        _format_path(shape, to_points, colours) for shape in sorted(sketch.shapes, key=lambda s: ROLES[s.role].order)
    ]
    names = next((artist for artist in figure.axes[0].get_children() if isinstance(artist, NameLabels)), None)
    lines += list(_iterate_name_nodes(names, sketch, to_points, colours, escape_latex)) if names is not None else []
    bounding_box = rf"\useasboundingbox (0,0) rectangle ({72.0 * width:.1f},{72.0 * height:.1f});"
    begin = r"\begin{tikzpicture}[x=1bp, y=1bp, line join=round, line cap=round]"
    return "\n".join((*colours.format_definitions(), begin, bounding_box, *lines, r"\end{tikzpicture}"))


class _Colours:
    """Names of colours in the order of their first use."""

    def __init__(self) -> None:
        """Create an empty list of colours."""
        self._tikz_names: dict[str, str] = {}

    def __call__(self, colour: str) -> str:
        """Return the TikZ name of a colour."""
        if not colour.startswith("#"):
            return colour
        return self._tikz_names.setdefault(colour[1:].upper(), f"gudgeon{len(self._tikz_names)}")

    def format_definitions(self) -> list[str]:
        """Return the definitions of all used colours."""
        return [rf"\definecolor{{{name}}}{{HTML}}{{{code}}}" for code, name in self._tikz_names.items()]


def _format_path(shape: Shape, to_points: Callable[[Array], Array], colours: _Colours) -> str:
    """Return the TikZ command of a line or circle in the style of its role: width, edge, fill and dashes.

    `to_points` converts metres to points; `colours` collects the colours that need a definition. An open line is not
    filled.
    """
    role = ROLES[shape.role]
    edge, face = resolve_colour(role.edge, shape.colour_index), resolve_colour(role.face, shape.colour_index)
    is_filled = face != "none" and (isinstance(shape, Disc) or shape.closed)
    options = [
        f"line width={role.width:g}bp",
        "draw=" + colours(edge),
        *([f"fill={colours(face)}"] if is_filled else []),
    ]
    if role.dashes:
        dash_lengths = zip(role.dashes, ("on", "off") * len(role.dashes), strict=False)
        options.append(
            "dash pattern=" + " ".join(f"{state} {length * role.width:.2f}bp" for length, state in dash_lengths)
        )
    if isinstance(shape, Disc):
        centre, rim = to_points(shape.centre), to_points(shape.centre + [shape.radius, 0.0])
        path_text = f"{_format_coordinates(centre)} circle[radius={rim[0] - centre[0]:.2f}]"
    else:
        path_text = " -- ".join(
            [*map(_format_coordinates, to_points(shape.points)), *(["cycle"] if shape.closed else [])]
        )
    return rf"\path[{', '.join(options)}] {path_text};"


def _format_coordinates(point: Sequence[float] | Array) -> str:
    """Return a point as TikZ coordinates."""
    return f"({point[0]:.2f},{point[1]:.2f})"


def _iterate_name_nodes(
    names: NameLabels,
    sketch: Sketch,
    to_points: Callable[[Array], Array],
    colours: _Colours,
    escape_latex: Callable[[str], str],
) -> Iterator[str]:
    """Yield the TikZ nodes of names that were placed, with a thin leader line for names far from their parts.

    Names that matplotlib omitted are omitted here.
    """
    for label, text in zip(sketch.labels, names.texts, strict=True):
        if label.part not in names.label_offsets or not text.get_visible():
            continue
        position = to_points(label.position)
        text_centre = position + names.label_offsets[label.part]
        colour_name, weight = NAMES[label.role]
        colour = colours(
            resolve_colour(colour_name, names.body_tints.get(label.part, 0)) if colour_name == "edge" else colour_name
        )
        if float(abs(text_centre - position).max()) > 2.0 * MIN_LEADER_DISTANCE:
            ends = f"{_format_coordinates(position)} -- {_format_coordinates(text_centre)}"
            yield rf"\path[line width=.4bp, draw=gray] {ends};"
        font = r"\bfseries" if weight == "bold" else r"\itshape" if label.role == "joint" else ""
        options = rf"inner sep=1bp, text={colour}, font=\sffamily\scriptsize{font}"
        label_text = escape_latex(format_one_line(label.text))
        yield rf"\node[{options}] at {_format_coordinates(text_centre)} {{{label_text}}};"
