"""Place the figures of a study on its page as SVG; large numbers of figures are drawn on all cores."""

from __future__ import annotations

import io
import re
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterable
from contextlib import suppress
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any

from gudgeon.errors import GudgeonError
from gudgeon.integrators.threads import count_available_threads
from gudgeon.results.reports.html_page import build_paragraphs, escape_line

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MAX_FIGURES = 40
MIN_FIGURES_FOR_PROCESSES = 12  # figures, from which on it is worth while to begin a process for them
MIN_FIGURES_PER_PROCESS = 4  # figures, for which no core is taken
_NON_SVG = re.compile(r"^.*?(?=<svg)|<metadata>.*?</metadata>|<!--.*?-->", re.DOTALL)
_IDS = re.compile(r'(\bid="|xlink:href="#|url\(#)')
_PLACEHOLDER = re.compile(r"<!--picture (\d+)-->")
CaptionedFigure = tuple[str, Callable[[], "Axes"]]  # what it shows, and how it is drawn


class PageFigures:
    """Figures of a page by number: placeholders are written first and replaced when all figures are known."""

    def __init__(self) -> None:
        """Create an empty list of figures."""
        self.figures: list[tuple[str, Callable[[], Axes]]] = []

    def add_placeholder(self, name: str, draw_axes: Callable[[], Axes]) -> str:
        """Register a figure and return its placeholder, an HTML comment; `draw_axes` is called later. `name` must be
        unique.
        """
        self.figures.append((name, draw_axes))
        return f"<!--picture {len(self.figures) - 1}-->"

    def insert_figures(self, page: str) -> str:
        """Draw all registered figures and return the page with their SVG in place of the placeholders."""
        drawn = _draw_in_processes(self.figures)
        return _PLACEHOLDER.sub(lambda place: drawn[int(place[1])], page)


def format_gallery(figures: Iterable[CaptionedFigure], name_prefix: str, page_figures: PageFigures) -> str:
    """Return an HTML grid of figures with captions; of more than MAX_FIGURES only the first ones and a line on the
    others.

    name_prefix: prefix of the figures' names. page_figures: receives the figures, which are drawn later. "" without
    figures.
    """
    parts, omitted = [], 0
    for k, (caption, draw_axes) in enumerate(figures):
        if k >= MAX_FIGURES:
            omitted += 1
            continue
        placeholder = page_figures.add_placeholder(f"{name_prefix}-{k}", draw_axes)
        parts.append(f"<figure>{placeholder}<figcaption>{escape_line(caption)}</figcaption></figure>")
    more = build_paragraphs([f"{omitted} more figures: study.plot draws them"] * bool(omitted), "g-quiet")
    return f"<div class='g-figures'>{''.join(parts)}</div>{more}" if parts else ""


def _draw_in_processes(figures: list[tuple[str, Callable[[], Any]]]) -> list[str]:
    """Return the SVG of all figures in order.

    Many figures are distributed over forked processes, on Linux and only if this process has no other threads.
    """
    forks = sys.platform == "linux" and threading.active_count() == 1 and len(figures) >= MIN_FIGURES_FOR_PROCESSES
    count = min(count_available_threads(), len(figures) // MIN_FIGURES_PER_PROCESS) if forks else 1
    others = [_DrawingProcess(figures[k::count]) for k in range(1, count)]
    drawn = [""] * len(figures)
    try:
        drawn[::count] = [_draw_figure(*arguments) for arguments in figures[::count]]
        for k, other in enumerate(others, 1):
            drawn[k::count] = other.receive_figures()
    finally:
        for other in others:
            other.process.kill()
            other.process.join()
    return drawn


class _DrawingProcess:
    """A process that draws some of the figures; if it dies, they are drawn here."""

    def __init__(self, figures: list[tuple[str, Callable[[], Any]]]) -> None:
        """Start a forked process that draws figures, given as pairs of name and drawing function."""
        self.figures, context = figures, get_context("fork")
        self.end, begin = context.Pipe(duplex=False)
        self.process = context.Process(target=_send_drawn_figures, args=(begin, figures), daemon=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads of BLAS, which expect it
            self.process.start()
        begin.close()

    def receive_figures(self) -> list[str]:
        """Wait for the process and return its figures as SVG; if the process died, draw them here."""
        try:
            figures: list[str] = self.end.recv()
        except (EOFError, OSError):
            return [_draw_figure(*arguments) for arguments in self.figures]
        return figures


def _send_drawn_figures(connection: Connection, figures: list[tuple[str, Callable[[], Any]]]) -> None:
    """Draw figures in the child process and send their SVG as one list; after an error nothing is sent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the calling process's own
    with suppress(Exception):  # errors are reported when the figure is drawn again
        connection.send([_draw_figure(*arguments) for arguments in figures])


def _draw_figure(name: str, draw_axes: Callable[[], Axes]) -> str:
    """Return a figure as SVG, or an HTML line with the reason if it cannot be drawn."""
    from gudgeon.results.figures.run_plots import suppress_figure_display

    try:
        with suppress_figure_display():
            return _convert_to_svg(draw_axes(), name)
    except (GudgeonError, ValueError, ArithmeticError) as error:
        return build_paragraphs([f"not drawn: {error}"], "g-quiet")


def _convert_to_svg(ax: Axes, name: str) -> str:
    """Return the SVG element of the figure of an axes, with text as text, identifiers prefixed by `name`, and no
    date.
    """
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    target = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": name, "svg.fonttype": "none"}):
        figure: Any = ax.figure
        canvas = FigureCanvasSVG(figure)
        _apply_layout(figure)
        canvas.print_svg(target, metadata={"Date": None, "Creator": None})
    svg = _NON_SVG.sub("", target.getvalue().decode())
    return _IDS.sub(lambda own: f"{own[1]}{name}-", svg)


def _apply_layout(figure: Figure) -> None:
    """Apply the layout of a figure once and remove its layout engine, with which `savefig` would draw it twice.

    A single axes needs only a margin. With a rectangle, even that of the figure, matplotlib would measure all texts
    again.
    """
    if len(figure.axes) == 1:
        figure.set_layout_engine("tight", rect=None)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine("none")
