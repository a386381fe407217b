"""What notebooks show of a scene and of a run: the mechanism drawn, and a table."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.shown import one_line

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource

MOST = 12  # names that a table lists of a kind
Rows = list[tuple[str, ...]]
_MARKS = re.compile(r"([\\{}$&#%_^~])")


class Shown:
    """A scene, which has a `start`, or a run, which has series."""

    source: KernelSource

    def _repr_html_(self) -> str:
        """A drawing, where it can be drawn, above a table."""
        title = one_line(self.source.title or self.source.mechanism)
        cells = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows_of(self))
        return f"<p>{escape(title)}, scene {escape(self.source.scene)}</p>{_drawing(self)}<table>{cells}</table>"

    def _repr_latex_(self) -> str:
        """The same table."""
        lines = r" \\ ".join(" & ".join(_roman(cell) for cell in row) for row in rows_of(self))
        return rf"$\displaystyle\begin{{array}}{{{'l' * len(rows_of(self)[0])}}} {lines} \end{{array}}$"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """What a notebook asks for first."""
        return {"text/plain": repr(self), "text/html": self._repr_html_(), "text/latex": self._repr_latex_()}


def rows_of(shown: Any) -> Rows:
    """Of a run what a reader wants to see of its samples; of a scene what it is made of."""
    return [*_of_run(shown)] if hasattr(shown, "names") else [*_of_scene(shown.source)]


def _of_scene(source: KernelSource) -> Iterator[tuple[str, ...]]:
    yield "bodies", _listed([body.name for body in source.bodies])
    yield "joints", _listed([joint.name for joint in source.joints])
    yield "joints with play", _listed([joint.name for joint in source.clearances])
    yield "drives", _listed([drive.name for drive in source.drives])
    yield "coordinates, rows of Φ", f"{len(source.coordinates)}, {len(source.rows)}"
    yield "formulation", source.formulation


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - MOST} more" if len(names) > MOST else ""
    return f"{len(names)}: {', '.join(names[:MOST])}{more}" if names else "none"


def _of_run(run: Any) -> Iterator[tuple[str, ...]]:
    from gudgeon.results.series import default_watch, drive_series

    source = run.source
    joints = [f"{joint.name}.F" for joint in source.clearances or source.joints]
    names = dict.fromkeys([*default_watch(run), *source.outputs, *drive_series(source), *joints])
    yield f"of {len(run.t)} samples", "least", "largest", "unit"
    for name in list(names)[:MOST]:
        if name in run.names and np.isfinite(run[name]).any():
            yield name, f"{np.nanmin(run[name]):.5g}", f"{np.nanmax(run[name]):.5g}", run.unit(name) or "1"
    if len(run.impacts):
        yield "impacts", "", str(len(run.impacts)), "1"


def _drawing(shown: Any) -> str:
    """At the start, as an image of its own; nothing where that is not to be had."""
    try:
        from gudgeon.results.figures.mechanism_plots import start_picture

        picture = start_picture(shown)
    except (GudgeonError, ValueError, ArithmeticError):
        return ""
    data = base64.b64encode(picture).decode("ascii")
    return f'<img alt="the mechanism at its start" src="data:image/png;base64,{data}"/>'


def _roman(text: str) -> str:
    """Words in a formula: letters are no variables, blanks stay."""
    marked = _MARKS.sub(lambda found: r"\backslash " if found[1] == "\\" else f"\\{found[1]}", text)
    return rf"\mathrm{{{marked}}}".replace(" ", r"\ ").replace("Φ", r"\Phi{}")
