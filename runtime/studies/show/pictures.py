"""Figures of a study side by side on its page, as SVG."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gudgeon.errors import GudgeonError
from gudgeon.results.web_page import lines, text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_FIGURES = 40
_AROUND = re.compile(r"^.*?(?=<svg)|<metadata>.*?</metadata>|<!--.*?-->", re.DOTALL)
_IDS = re.compile(r'(\bid="|xlink:href="#|url\(#)')
Draw = tuple[str, Callable[[], "Axes"]]  # what it shows, and how it is drawn


def gallery(drawn: Iterable[Draw], kind: str) -> str:
    """Pictures side by side; one that cannot be drawn is told."""
    parts, left = [], 0
    for k, (caption, draw) in enumerate(drawn):
        if k >= MOST_FIGURES:
            left += 1
            continue
        try:
            inside = _svg(draw(), f"{kind}-{k}")
        except (GudgeonError, ValueError, ArithmeticError) as error:
            inside = lines([f"not drawn: {error}"], "g-quiet")
        parts.append(f"<figure>{inside}<figcaption>{text(caption)}</figcaption></figure>")
    more = lines([f"{left} more figures: study.plot draws them"] * bool(left), "g-quiet")
    return f"<div class='g-figures'>{''.join(parts)}</div>{more}" if parts else ""


def _svg(ax: Axes, name: str) -> str:
    """The figure's SVG by itself: words are text, names are its own, no date."""
    import matplotlib

    target = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": name, "svg.fonttype": "none"}):
        figure: Any = ax.figure
        figure.savefig(target, format="svg", metadata={"Date": None, "Creator": None})
    found = _AROUND.sub("", target.getvalue().decode())
    return _IDS.sub(lambda own: f"{own[1]}{name}-", found)
