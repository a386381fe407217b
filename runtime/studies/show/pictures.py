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
from gudgeon.integrators.threads import available_threads
from gudgeon.results.reports.html_page import build_paragraphs, escape_line

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_FIGURES = 40
MANY = 12  # figures, from which on it is worth while to begin a process for them
FEW = 4  # figures, for which no core is taken
_AROUND = re.compile(r"^.*?(?=<svg)|<metadata>.*?</metadata>|<!--.*?-->", re.DOTALL)
_IDS = re.compile(r'(\bid="|xlink:href="#|url\(#)')
_PLACE = re.compile(r"<!--picture (\d+)-->")
Draw = tuple[str, Callable[[], "Axes"]]  # what it shows, and how it is drawn


class Pictures:
    """Figures of a page by number: placeholders are written first and replaced when all figures are known."""

    def __init__(self) -> None:
        """Create an empty list of figures."""
        self.expected: list[tuple[str, Callable[[], Axes]]] = []

    def add_placeholder(self, name: str, draw: Callable[[], Axes]) -> str:
        """Register a figure and return its placeholder, an HTML comment; `draw` is called later. `name` must be
        unique.
        """
        self.expected.append((name, draw))
        return f"<!--picture {len(self.expected) - 1}-->"

    def insert_figures(self, page: str) -> str:
        """Draw all registered figures and return the page with their SVG in place of the placeholders."""
        drawn = _draw_in_processes(self.expected)
        return _PLACE.sub(lambda place: drawn[int(place[1])], page)


def format_gallery(figures: Iterable[Draw], kind: str, pictures: Pictures) -> str:
    """Return an HTML grid of figures with captions; of more than MOST_FIGURES only the first ones and a line on the
    others.

    kind: prefix of the figures' names. "" without figures.
    """
    parts, omitted = [], 0
    for k, (caption, draw) in enumerate(figures):
        if k >= MOST_FIGURES:
            omitted += 1
            continue
        placeholder = pictures.add_placeholder(f"{kind}-{k}", draw)
        parts.append(f"<figure>{placeholder}<figcaption>{escape_line(caption)}</figcaption></figure>")
    more = build_paragraphs([f"{omitted} more figures: study.plot draws them"] * bool(omitted), "g-quiet")
    return f"<div class='g-figures'>{''.join(parts)}</div>{more}" if parts else ""


def _draw_in_processes(figures: list[tuple[str, Callable[[], Any]]]) -> list[str]:
    """Return the SVG of all figures in order.

    Many figures are distributed over forked processes, on Linux and only if this process has no other threads.
    """
    forks = sys.platform == "linux" and threading.active_count() == 1 and len(figures) >= MANY
    count = min(available_threads(), len(figures) // FEW) if forks else 1
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

    def __init__(self, expected: list[tuple[str, Callable[[], Any]]]) -> None:
        """Start a forked process that draws the figures of `expected`, pairs of name and drawing function."""
        self.expected, context = expected, get_context("fork")
        self.end, begin = context.Pipe(duplex=False)
        self.process = context.Process(target=_draw_all, args=(begin, expected), daemon=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads of BLAS, which expect it
            self.process.start()
        begin.close()

    def receive_figures(self) -> list[str]:
        """Wait for the process and return its figures as SVG; if the process died, draw them here."""
        try:
            figures: list[str] = self.end.recv()
        except (EOFError, OSError):
            return [_draw_figure(*arguments) for arguments in self.expected]
        return figures


def _draw_all(end: Connection, figures: list[tuple[str, Callable[[], Any]]]) -> None:
    """Draw figures in the child process and send their SVG as one list; after an error nothing is sent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the calling process's own
    with suppress(Exception):  # errors are reported when the figure is drawn again
        end.send([_draw_figure(*arguments) for arguments in figures])


def _draw_figure(name: str, draw: Callable[[], Axes]) -> str:
    """Return a figure as SVG, or an HTML line with the reason if it cannot be drawn."""
    from gudgeon.results.figures.run_plots import suppress_figure_display

    try:
        with suppress_figure_display():
            return _convert_to_svg(draw(), name)
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
        _compute_layout(figure)
        canvas.print_svg(target, metadata={"Date": None, "Creator": None})
    svg = _AROUND.sub("", target.getvalue().decode())
    return _IDS.sub(lambda own: f"{own[1]}{name}-", svg)


def _compute_layout(figure: Figure) -> None:
    """Compute the layout of a figure once, since `savefig` would draw everything twice for it.

    A single axes needs only a margin. With a rectangle, even that of the figure, matplotlib would measure all texts
    again.
    """
    if len(figure.axes) == 1:
        figure.set_layout_engine("tight", rect=None)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine("none")
