"""Define the style of a page: page.css, and colours of drawings on light and dark backgrounds."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from gudgeon.drawing.page import PIXELS
from gudgeon.drawing.roles import DRIVEN, EDGES, GREY, INK, LOADED, NAMES, ROLES, TINTS, WOUND, WRONG, colour_of

# colours of paper and ink, which depend on the colour scheme
FRAME = {INK: "var(--ink)", GREY: "var(--quiet)", "white": "var(--paper)", "#ffffff": "var(--paper)"}
DARK = {
    DRIVEN: "#ff8a80",
    LOADED: "#4fd1b5",
    WOUND: "#c8c8d0",
    WRONG: "#ff6b6b",
    "#0072B2": "#6cb8f0",
    "#D55E00": "#ff9d4d",
    "#9c4300": "#ffb27a",
    "#f9dedc": "#57211d",
    "#e8e8e8": "#3a3c44",
    "#ececec": "#33353c",
    "#ffd5d0": "#5c1f1f",
    "#cfe3f1": "#24455c",
} | dict(zip(EDGES, TINTS, strict=True))
DARK_TINTS = ("#1d3a4d", "#4a3510", "#153f32", "#45263a", "#4d2a14", "#234152", "#3a3a3e", "#403d12")


def style(looks: Iterable[tuple[str, int]], names: Iterable[tuple[str, int]]) -> str:
    """Return the CSS of the panel, of shapes by role and tint (class `look`), and of names (class `look-name`)."""
    light, dark = list[str](), list[str]()
    for role, tint in looks:
        here = f".{look(role, tint)}"
        one = ROLES[role]
        dashes = f"stroke-dasharray:{' '.join(f'{x:g}' for x in one.dashes)};" if one.dashes else ""
        light.append(
            f"{here}{{stroke:{_light(one.edge, tint)};fill:{_light(one.face, tint)};"
            f"stroke-width:{one.width * PIXELS / 72.0:.2f};{dashes}}}"
        )
        dark.append(f"{here}{{stroke:{_dark(one.edge, tint)};fill:{_dark(one.face, tint)}}}")
    for role, tint in names:
        here = f".{look(role, tint)}-name"
        word, weight = NAMES[role]
        slant = "font-style:italic;" if role == "joint" else ""
        light.append(f"{here}{{fill:{_light(word, tint)};font-weight:{weight};{slant}}}")
        dark.append(f"{here}{{fill:{_dark(word, tint)}}}")
    rules = "\n".join(dark)
    return f"{_sheet()}\n{chr(10).join(light)}\n@media screen and (prefers-color-scheme: dark) {{\n{rules}\n}}\n"


def look(role: str, tint: int) -> str:
    """Return the CSS class of a role; roles with the colours of a body include the tint."""
    word = role.replace(" ", "-")
    coloured = role in ROLES and {"tint", "edge"} & {ROLES[role].edge, ROLES[role].face}
    return f"d-{word}-{tint % len(TINTS)}" if coloured or (role == "body") else f"d-{word}"


@cache
def _sheet() -> str:
    """Return page.css without indentation."""
    return re.sub(r"(?m)^ +", "", Path(__file__).with_name("page.css").read_text(encoding="utf-8"))


def _light(word: str, tint: int) -> str:
    """Return a colour on a light background."""
    colour = colour_of(word, tint)
    return FRAME.get(colour, colour)


def _dark(word: str, tint: int) -> str:
    """Return a colour on a dark background."""
    colour = colour_of(word, tint)
    return DARK_TINTS[TINTS.index(colour)] if word == "tint" else FRAME.get(colour) or DARK.get(colour, colour)
