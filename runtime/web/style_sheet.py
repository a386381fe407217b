"""Define the style of a simulator page: page.css, and colours of drawings on light and dark backgrounds."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from gudgeon.drawing.page import PIXELS_PER_INCH
from gudgeon.drawing.roles import DRIVEN, EDGES, GREY, INK, LOADED, NAMES, ROLES, TINTS, WOUND, WRONG, resolve_colour

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


def build_style_sheet(shape_styles: Iterable[tuple[str, int]], name_styles: Iterable[tuple[str, int]]) -> str:
    """Return the CSS of a page: page.css, then rules for shapes and names by role and colour index, light and dark.

    `shape_styles` and `name_styles` are pairs (role, colour index). Classes are those of `make_css_class`, for names
    with the suffix "-name".
    """
    light_rules, dark_rules = list[str](), list[str]()
    for role, colour_index in shape_styles:
        selector = f".{make_css_class(role, colour_index)}"
        role_style = ROLES[role]
        dashes = f"stroke-dasharray:{' '.join(f'{x:g}' for x in role_style.dashes)};" if role_style.dashes else ""
        light_edge, light_face = (
            _format_light_colour(name, colour_index) for name in (role_style.edge, role_style.face)
        )
        dark_edge, dark_face = (_format_dark_colour(name, colour_index) for name in (role_style.edge, role_style.face))
        light_rules.append(
            f"{selector}{{stroke:{light_edge};fill:{light_face};"
            f"stroke-width:{role_style.width * PIXELS_PER_INCH / 72.0:.2f};{dashes}}}"
        )
        dark_rules.append(f"{selector}{{stroke:{dark_edge};fill:{dark_face}}}")
    for role, colour_index in name_styles:
        selector = f".{make_css_class(role, colour_index)}-name"
        colour_name, weight = NAMES[role]
        slant = "font-style:italic;" if role == "joint" else ""
        light_rules.append(
            f"{selector}{{fill:{_format_light_colour(colour_name, colour_index)};font-weight:{weight};{slant}}}"
        )
        dark_rules.append(f"{selector}{{fill:{_format_dark_colour(colour_name, colour_index)}}}")
    dark_text = "\n".join(dark_rules)
    light_text = f"{_read_style_sheet()}\n{chr(10).join(light_rules)}"
    return f"{light_text}\n@media screen and (prefers-color-scheme: dark) {{\n{dark_text}\n}}\n"


def make_css_class(role: str, colour_index: int) -> str:
    """Return the CSS class of a role, such as "d-pin"; roles with the colours of a body include the colour index."""
    class_name = role.replace(" ", "-")
    has_body_colour = role in ROLES and {"tint", "edge"} & {ROLES[role].edge, ROLES[role].face}
    return f"d-{class_name}-{colour_index % len(TINTS)}" if has_body_colour or (role == "body") else f"d-{class_name}"


@cache
def _read_style_sheet() -> str:
    """Return the compressed text of page.css; cached."""
    from gudgeon.generator.targets.javascript.compression import compress_style_sheet

    return compress_style_sheet(Path(__file__).with_name("page.css").read_text(encoding="utf-8"))


def _format_light_colour(colour_name: str, colour_index: int) -> str:
    """Return the CSS colour of a role's colour on a light background."""
    colour = resolve_colour(colour_name, colour_index)
    return FRAME.get(colour, colour)


def _format_dark_colour(colour_name: str, colour_index: int) -> str:
    """Return the CSS colour of a role's colour on a dark background."""
    colour = resolve_colour(colour_name, colour_index)
    return DARK_TINTS[TINTS.index(colour)] if colour_name == "tint" else FRAME.get(colour) or DARK.get(colour, colour)
