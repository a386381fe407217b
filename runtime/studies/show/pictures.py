"""Figures of a study side by side on its page, as SVG; many of them are drawn on all cores."""

from __future__ import annotations

import io
import re
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterable
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any

from gudgeon.errors import GudgeonError
from gudgeon.integrators.batch import available_threads
from gudgeon.results.web_page import lines, text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_FIGURES = 40
MANY = 12  # figures, from which on it is worth while to begin a process for them
PORTION = 4  # figures that a process takes at a time
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


_wanted: list[tuple[str, Callable[[], Any]]] = []  # of a page, for processes that begin with what this one has


def _side_by_side(wanted: list[tuple[str, Callable[[], Any]]]) -> list[str]:
    """All of them, in processes that are forked from this one, where it is alone in itself; else here."""
    count = min(available_threads(), len(wanted) // PORTION)
    forks = sys.platform == "linux" and threading.active_count() == 1
    if count < 2 or len(wanted) < MANY or not forks:
        return [_drawn(*one) for one in wanted]
    _wanted[:] = wanted
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads of BLAS, which expect it
            pool = get_context("fork").Pool(count, signal.signal, (signal.SIGINT, signal.SIG_IGN))
        with pool:
            return pool.map(_numbered, range(len(wanted)), PORTION)
    finally:
        _wanted.clear()


def _numbered(k: int) -> str:
    return _drawn(*_wanted[k])


def _drawn(name: str, draw: Callable[[], Axes]) -> str:
    """A picture; one that cannot be drawn is told."""
    try:
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
    """Once: `savefig` draws all of it a first time for that. Axes that stand alone need no more than a margin."""
    if len(figure.axes) == 1:
        figure.set_layout_engine("tight")
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine("none")
