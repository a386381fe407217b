"""Write a sketch as a TikZ picture for LaTeX, with names where matplotlib places them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from gudgeon.drawing.labels import LED, Names
from gudgeon.drawing.picture import draw_on, size_of
from gudgeon.drawing.roles import NAMES, ROLES, colour_of
from gudgeon.drawing.shapes import Disc, Shape, Sketch
from gudgeon.language.shown import one_line
from gudgeon.model.compiled import Array

from matplotlib.figure import Figure  # isort: skip  (labels.py says where it is missing)

WIDEST, HIGHEST = 6.3, 5.0  # inches on the page


def tikz_of(sketch: Sketch, escaped: Callable[[str], str]) -> str:
    """Return a tikzpicture; `escaped` converts a name to LaTeX without commands."""
    width, height = size_of(sketch, WIDEST)
    shrunk = min(1.0, WIDEST / width, HIGHEST / height)
    width, height = width * shrunk, height * shrunk
    picture = Figure(figsize=(width, height), dpi=72)
    draw_on(picture.add_axes((0.0, 0.0, 1.0, 1.0)), sketch)
    picture.draw_without_rendering()
    to_points = picture.axes[0].transData.transform  # pixels at 72 to the inch are TeX's bp
    colours = _Colours()
    lines = [
        _draw_path(shape, to_points, colours) for shape in sorted(sketch.shapes, key=lambda s: ROLES[s.role].order)
    ]
    names = next((artist for artist in picture.axes[0].get_children() if isinstance(artist, Names)), None)
    lines += list(_draw_names(names, sketch, to_points, colours, escaped)) if names is not None else []
    box = rf"\useasboundingbox (0,0) rectangle ({72.0 * width:.1f},{72.0 * height:.1f});"
    begin = r"\begin{tikzpicture}[x=1bp, y=1bp, line join=round, line cap=round]"
    return "\n".join((*colours.defined(), begin, box, *lines, r"\end{tikzpicture}"))


class _Colours:
    """Names of colours in the order of their first use."""

    def __init__(self) -> None:
        """Create an empty list of colours."""
        self._draw_names: dict[str, str] = {}

    def __call__(self, colour: str) -> str:
        """Return the TikZ name of a colour."""
        if not colour.startswith("#"):
            return colour
        return self._draw_names.setdefault(colour[1:].upper(), f"gudgeon{len(self._draw_names)}")

    def defined(self) -> list[str]:
        """Return the definitions of all used colours."""
        return [rf"\definecolor{{{name}}}{{HTML}}{{{code}}}" for code, name in self._draw_names.items()]


def _draw_path(shape: Shape, to_points: Callable[[Array], Array], colours: _Colours) -> str:
    """Return the path of a line or circle in the style of its role."""
    role = ROLES[shape.role]
    edge, face = colour_of(role.edge, shape.tint), colour_of(role.face, shape.tint)
    filled = face != "none" and (isinstance(shape, Disc) or shape.closed)
    look = [f"line width={role.width:g}bp", "draw=" + colours(edge), *([f"fill={colours(face)}"] if filled else [])]
    if role.dashes:
        on_off = zip(role.dashes, ("on", "off") * len(role.dashes), strict=False)
        look.append("dash pattern=" + " ".join(f"{word} {length * role.width:.2f}bp" for length, word in on_off))
    if isinstance(shape, Disc):
        centre, rim = to_points(shape.centre), to_points(shape.centre + [shape.radius, 0.0])
        message = f"{_coordinates(centre)} circle[radius={rim[0] - centre[0]:.2f}]"
    else:
        message = " -- ".join([*map(_coordinates, to_points(shape.points)), *(["cycle"] if shape.closed else [])])
    return rf"\path[{', '.join(look)}] {message};"


def _coordinates(point: Sequence[float] | Array) -> str:
    """Return a point as TikZ coordinates."""
    return f"({point[0]:.2f},{point[1]:.2f})"


def _draw_names(
    names: Names, sketch: Sketch, to_points: Callable[[Array], Array], colours: _Colours, escaped: Callable[[str], str]
) -> Iterator[str]:
    """Yield the nodes of names that were placed, with a thin leader line for distant ones."""
    for label, text in zip(sketch.labels, names.texts, strict=True):
        if label.part not in names.beside or not text.get_visible():
            continue
        place = to_points(label.place)
        middle = place + names.beside[label.part]
        word, weight = NAMES[label.role]
        colour = colours(colour_of(word, names.order.get(label.part, 0)) if word == "edge" else word)
        if float(abs(middle - place).max()) > 2.0 * LED:
            yield rf"\path[line width=.4bp, draw=gray] {_coordinates(place)} -- {_coordinates(middle)};"
        font = r"\bfseries" if weight == "bold" else r"\itshape" if label.role == "joint" else ""
        look = rf"inner sep=1bp, text={colour}, font=\sffamily\scriptsize{font}"
        yield rf"\node[{look}] at {_coordinates(middle)} {{{escaped(one_line(label.text))}}};"
