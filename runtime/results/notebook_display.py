"""Define what notebooks display for a scene and for a run: a drawing of the mechanism and a table."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.text_output import format_one_line

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource

MAX_NAMES = 12  # largest number of names of one kind in a table
Rows = list[tuple[str, ...]]
_MARKS = re.compile(r"([\\{}$&#%_^~])")


class NotebookDisplay:
    """Base class of a scene, which has a `start`, and of a run, which has series, for display in notebooks."""

    source: KernelSource

    def _repr_html_(self) -> str:
        """Return title, drawing of the start and table as HTML; a notebook displays it.

        The drawing is left out if the mechanism cannot be drawn.
        """
        title = format_one_line(self.source.title or self.source.mechanism)
        cells = "".join(
            f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in build_table_rows(self)
        )
        heading = f"<p>{escape(title)}, scene {escape(self.source.scene)}</p>"
        return f"{heading}{_build_start_image(self)}<table>{cells}</table>"

    def _repr_latex_(self) -> str:
        """Return the table of `build_table_rows` as a LaTeX array."""
        lines = r" \\ ".join(" & ".join(_format_latex_text(cell) for cell in row) for row in build_table_rows(self))
        return rf"$\displaystyle\begin{{array}}{{{'l' * len(build_table_rows(self)[0])}}} {lines} \end{{array}}$"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Return text, HTML and LaTeX by MIME type; a notebook calls this method first."""
        return {"text/plain": repr(self), "text/html": self._repr_html_(), "text/latex": self._repr_latex_()}


def build_table_rows(scene_or_run: Any) -> Rows:
    """Return the rows of the table that a notebook displays, each a tuple of cells.

    For a run they are the ranges of its main series, for a scene its components.
    """
    return (
        [*_iterate_run_rows(scene_or_run)]
        if hasattr(scene_or_run, "names")
        else [*_iterate_scene_rows(scene_or_run.source)]
    )


def _iterate_scene_rows(source: KernelSource) -> Iterator[tuple[str, ...]]:
    """Yield a row for each kind of component of a scene, such as ("bodies", "2: crank, rod").

    The last rows are the numbers of coordinates and constraint equations, and the formulation.
    """
    yield "bodies", _format_name_list([body.name for body in source.bodies])
    yield "joints", _format_name_list([joint.name for joint in source.joints])
    yield "joints with play", _format_name_list([joint.name for joint in source.clearances])
    yield "drives", _format_name_list([drive.name for drive in source.drives])
    yield "coordinates, rows of Φ", f"{len(source.coordinates)}, {len(source.equations)}"
    yield "formulation", source.formulation


def _format_name_list(names: list[str]) -> str:
    """Return the number of names and the first MAX_NAMES of them: "14: A, B … and 2 more"."""
    suffix = f" and {len(names) - MAX_NAMES} more" if len(names) > MAX_NAMES else ""
    return f"{len(names)}: {', '.join(names[:MAX_NAMES])}{suffix}" if names else "none"


def _iterate_run_rows(run: Any) -> Iterator[tuple[str, ...]]:
    """Yield a heading and a row for each main series of a run: name, smallest and largest sample, unit.

    At most MAX_NAMES series are shown; series without a finite sample are left out. The last row is the number of
    impacts, if there are any.
    """
    from gudgeon.results.series import choose_default_series, list_drive_series

    source = run.source
    joints = [f"{joint.name}.F" for joint in source.clearances or source.joints]
    names = dict.fromkeys([*choose_default_series(run), *source.outputs, *list_drive_series(source), *joints])
    yield f"of {len(run.t)} samples", "smallest", "largest", "unit"
    for name in list(names)[:MAX_NAMES]:
        if name in run.names and np.isfinite(run[name]).any():
            yield name, f"{np.nanmin(run[name]):.5g}", f"{np.nanmax(run[name]):.5g}", run.unit(name) or "1"
    if len(run.impacts):
        yield "impacts", "", str(len(run.impacts)), "1"


def _build_start_image(scene_or_run: Any) -> str:
    """Return an HTML image element (PNG) of the mechanism at its start; "" if it cannot be assembled or drawn."""
    try:
        from gudgeon.results.figures.mechanism_plots import draw_start_picture

        png_bytes = draw_start_picture(scene_or_run)
    except (GudgeonError, ValueError, ArithmeticError):
        return ""
    data = base64.b64encode(png_bytes).decode("ascii")
    return f'<img alt="the mechanism at its start" src="data:image/png;base64,{data}"/>'


def _format_latex_text(text: str) -> str:
    """Return a text as an upright word of a LaTeX formula, with blanks kept and special characters escaped."""
    escaped_text = _MARKS.sub(lambda match: r"\backslash " if match[1] == "\\" else f"\\{match[1]}", text)
    return rf"\mathrm{{{escaped_text}}}".replace(" ", r"\ ").replace("Φ", r"\Phi{}")
