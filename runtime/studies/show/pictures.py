"""Insert the figures of a study into its HTML page as SVG; many figures are drawn by forked processes in parallel."""

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

MAX_FIGURES = 40  # of one gallery
MIN_FIGURES_FOR_PROCESSES = 12  # with fewer figures, no process is started
MIN_FIGURES_PER_PROCESS = 4
_NON_SVG = re.compile(r"^.*?(?=<svg)|<metadata>.*?</metadata>|<!--.*?-->", re.DOTALL)
_IDS = re.compile(r'(\bid="|xlink:href="#|url\(#)')
_PLACEHOLDER = re.compile(r"<!--picture (\d+)-->")
CaptionedFigure = tuple[str, Callable[[], "Axes"]]  # caption, and function that draws the figure


class PageFigures:
    """The figures of an HTML page: placeholders are written first and replaced when all figures are registered."""

    def __init__(self) -> None:
        """Create an empty list of figures."""
        self.figures: list[tuple[str, Callable[[], Axes]]] = []

    def add_placeholder(self, name: str, draw_axes: Callable[[], Axes]) -> str:
        """Register a figure, which `insert_figures` draws later, and return its placeholder, an HTML comment.

        name: unique prefix of the SVG identifiers.
        """
        self.figures.append((name, draw_axes))
        return f"<!--picture {len(self.figures) - 1}-->"

    def insert_figures(self, page: str) -> str:
        """Draw all registered figures and return the page (HTML) with their SVG in place of the placeholders."""
        svg_texts = _draw_in_processes(self.figures)
        return _PLACEHOLDER.sub(lambda place: svg_texts[int(place[1])], page)


def format_gallery(figures: Iterable[CaptionedFigure], name_prefix: str, page_figures: PageFigures) -> str:
    """Return an HTML grid of at most MAX_FIGURES figures with captions, and a line with the number of omitted ones.

    name_prefix: prefix of the figures' names. page_figures: the figures are registered there and drawn later. ""
    without figures.
    """
    figure_elements, n_omitted = [], 0
    for k, (caption, draw_axes) in enumerate(figures):
        if k >= MAX_FIGURES:
            n_omitted += 1
            continue
        placeholder = page_figures.add_placeholder(f"{name_prefix}-{k}", draw_axes)
        figure_elements.append(f"<figure>{placeholder}<figcaption>{escape_line(caption)}</figcaption></figure>")
    omission_html = build_paragraphs([f"{n_omitted} more figures: study.plot draws them"] * bool(n_omitted), "g-quiet")
    return f"<div class='g-figures'>{''.join(figure_elements)}</div>{omission_html}" if figure_elements else ""


def _draw_in_processes(figures: list[tuple[str, Callable[[], Any]]]) -> list[str]:
    """Draw all figures, (name, drawing function) each, and return their SVG in order.

    MIN_FIGURES_FOR_PROCESSES or more figures are distributed over forked processes, on Linux and only if this process
    has no other threads.
    """
    may_fork = sys.platform == "linux" and threading.active_count() == 1 and len(figures) >= MIN_FIGURES_FOR_PROCESSES
    count = min(count_available_threads(), len(figures) // MIN_FIGURES_PER_PROCESS) if may_fork else 1
    drawing_processes = [_DrawingProcess(figures[k::count]) for k in range(1, count)]
    svg_texts = [""] * len(figures)
    try:
        svg_texts[::count] = [_draw_figure(*arguments) for arguments in figures[::count]]
        for k, drawing_process in enumerate(drawing_processes, 1):
            svg_texts[k::count] = drawing_process.receive_figures()
    finally:
        for drawing_process in drawing_processes:
            drawing_process.process.kill()
            drawing_process.process.join()
    return svg_texts


class _DrawingProcess:
    """A forked process that draws some of the figures of a page and sends them through a pipe."""

    def __init__(self, figures: list[tuple[str, Callable[[], Any]]]) -> None:
        """Fork a process that draws figures; each is a pair of name and drawing function."""
        self.figures, context = figures, get_context("fork")
        self.end, begin = context.Pipe(duplex=False)
        self.process = context.Process(target=_send_drawn_figures, args=(begin, figures), daemon=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of forks with threads: those of BLAS allow forks
            self.process.start()
        begin.close()

    def receive_figures(self) -> list[str]:
        """Wait for the figures of the process and return them as SVG; draw them here if the process died."""
        try:
            figures: list[str] = self.end.recv()
        except (EOFError, OSError):
            return [_draw_figure(*arguments) for arguments in self.figures]
        return figures


def _send_drawn_figures(connection: Connection, figures: list[tuple[str, Callable[[], Any]]]) -> None:
    """Draw figures in the child process and send their SVG as one list; after an error nothing is sent.

    The child ignores Ctrl-C. The parent draws the figures again after an error, and reports it.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process handles Ctrl-C
    with suppress(Exception):  # errors are reported when the figure is drawn again
        connection.send([_draw_figure(*arguments) for arguments in figures])


def _draw_figure(name: str, draw_axes: Callable[[], Axes]) -> str:
    """Draw a figure and return it as SVG; if that raises an error of values, an HTML line "not drawn: …" instead."""
    from gudgeon.results.figures.run_plots import suppress_figure_display

    try:
        with suppress_figure_display():
            return _convert_to_svg(draw_axes(), name)
    except (GudgeonError, ValueError, ArithmeticError) as error:
        return build_paragraphs([f"not drawn: {error}"], "g-quiet")


def _convert_to_svg(ax: Axes, name: str) -> str:
    """Return the <svg> element of the figure of an axes: reproducible, without a date, with texts as text.

    Identifiers have the prefix `name`, so that several figures fit into one page.
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
    return _IDS.sub(lambda match: f"{match[1]}{name}-", svg)


def _apply_layout(figure: Figure) -> None:
    """Apply the layout of a figure once and remove its layout engine, which would make `savefig` draw it twice.

    A figure with a single axes gets the tight layout without a rectangle, since matplotlib would measure all texts
    again for one.
    """
    if len(figure.axes) == 1:
        figure.set_layout_engine("tight", rect=None)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine("none")
