"""Figures of a study side by side on its page, as SVG; many of them are drawn on all cores."""

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
from gudgeon.results.reports.html_page import lines, text

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
    """What a page shows, by number: its places are written first, and filled when all of them are known."""

    def __init__(self) -> None:
        self.wanted: list[tuple[str, Callable[[], Axes]]] = []

    def place(self, name: str, draw: Callable[[], Axes]) -> str:
        """A comment, such as no text of a file can be, where the picture will stand. `name` is that of no other."""
        self.wanted.append((name, draw))
        return f"<!--picture {len(self.wanted) - 1}-->"

    def filled(self, page: str) -> str:
        """The page with its pictures."""
        drawn = _side_by_side(self.wanted)
        return _PLACE.sub(lambda place: drawn[int(place[1])], page)


def gallery(drawn: Iterable[Draw], kind: str, pictures: Pictures) -> str:
    """Pictures side by side, with what they show; of very many the first."""
    parts, left = [], 0
    for k, (caption, draw) in enumerate(drawn):
        if k >= MOST_FIGURES:
            left += 1
            continue
        inside = pictures.place(f"{kind}-{k}", draw)
        parts.append(f"<figure>{inside}<figcaption>{text(caption)}</figcaption></figure>")
    more = lines([f"{left} more figures: study.plot draws them"] * bool(left), "g-quiet")
    return f"<div class='g-figures'>{''.join(parts)}</div>{more}" if parts else ""


def _side_by_side(wanted: list[tuple[str, Callable[[], Any]]]) -> list[str]:
    """All of them: each core draws its share, in processes forked from this one where it is alone in itself."""
    forks = sys.platform == "linux" and threading.active_count() == 1 and len(wanted) >= MANY
    count = min(available_threads(), len(wanted) // FEW) if forks else 1
    others = [_Other(wanted[k::count]) for k in range(1, count)]
    drawn = [""] * len(wanted)
    try:
        drawn[::count] = [_drawn(*one) for one in wanted[::count]]
        for k, other in enumerate(others, 1):
            drawn[k::count] = other.drawn()
    finally:
        for other in others:
            other.process.kill()
            other.process.join()
    return drawn


class _Other:
    """A process that draws some of them; where it dies, they are drawn here."""

    def __init__(self, wanted: list[tuple[str, Callable[[], Any]]]) -> None:
        self.wanted, context = wanted, get_context("fork")
        self.end, begin = context.Pipe(duplex=False)
        self.process = context.Process(target=_draw_all, args=(begin, wanted), daemon=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads of BLAS, which expect it
            self.process.start()
        begin.close()

    def drawn(self) -> list[str]:
        """Waits for it."""
        try:
            found: list[str] = self.end.recv()
        except (EOFError, OSError):
            return [_drawn(*one) for one in self.wanted]
        return found


def _draw_all(end: Connection, wanted: list[tuple[str, Callable[[], Any]]]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the calling process's own
    with suppress(Exception):  # what is no picture is told where it is drawn again
        end.send([_drawn(*one) for one in wanted])


def _drawn(name: str, draw: Callable[[], Axes]) -> str:
    """A picture; one that cannot be drawn is told."""
    from gudgeon.results.figures.run_plots import of_a_page

    try:
        with of_a_page():
            return _svg(draw(), name)
    except (GudgeonError, ValueError, ArithmeticError) as error:
        return lines([f"not drawn: {error}"], "g-quiet")


def _svg(ax: Axes, name: str) -> str:
    """The figure's SVG by itself: words are text, names are its own, no date."""
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    target = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": name, "svg.fonttype": "none"}):
        figure: Any = ax.figure
        canvas = FigureCanvasSVG(figure)
        _laid_out(figure)
        canvas.print_svg(target, metadata={"Date": None, "Creator": None})
    found = _AROUND.sub("", target.getvalue().decode())
    return _IDS.sub(lambda own: f"{own[1]}{name}-", found)


def _laid_out(figure: Figure) -> None:
    """Once: `savefig` draws all of it a first time for that. Axes that stand alone need no more than a margin.

    A rectangle, even that of the whole figure, has matplotlib measure all texts a second time, to the same end.
    """
    if len(figure.axes) == 1:
        figure.set_layout_engine("tight", rect=None)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine("none")
