"""Define the colours and line styles of each kind of shape in drawings, the same in figures and HTML pages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

# fill and edge colours of bodies, used cyclically; hues of Okabe and Ito
TINTS = ("#cfe3f1", "#fbe3bd", "#cdebe0", "#f3dbe8", "#fad6c1", "#dceff9", "#e6e6e6", "#f6f2c0")
EDGES = ("#1f5f8b", "#946000", "#007050", "#8d4a70", "#9c4300", "#2f7ba8", "#555555", "#7d7500")
INK, GREY, DRIVEN, LOADED, WOUND, WRONG = "#222222", "#888888", "#b3261e", "#00695c", "#4a4a4a", "#d50000"


@dataclass(frozen=True)
class Role:
    """Style of a shape: colours ("": none; "tint", "edge": the body's), line width in points, order of painting,
    dashes.
    """

    edge: str
    face: str
    width: float
    order: float
    dashes: tuple[float, ...] = ()


ROLES: Mapping[str, Role] = {
    "hatch": Role(GREY, "", 0.6, 1.0),
    "rail": Role(INK, "", 1.3, 1.1),
    "stand": Role(INK, "white", 0.9, 1.2),
    "rim": Role("edge", "", 0.9, 0.7),
    "ring": Role("edge", "", 0.9, 0.75, (6.0, 2.0, 1.0, 2.0)),
    "wheel": Role("edge", "tint", 0.9, 0.8, (6.0, 2.0, 1.0, 2.0)),
    "spoke": Role("edge", "", 0.8, 0.9),
    "rod": Role(INK, "", 1.6, 1.9),
    "guide": Role("edge", "tint", 0.9, 1.92),
    "channel": Role("edge", "white", 0.7, 1.94),
    "body": Role("edge", "tint", 0.9, 2.0),
    "loose": Role(WRONG, "#ffd5d0", 1.1, 2.0, (4.0, 2.0)),
    "axis": Role(GREY, "", 0.6, 2.2, (6.0, 2.0, 1.0, 2.0)),
    "slot": Role(INK, "white", 0.8, 2.3),
    "block": Role(INK, "#e8e8e8", 0.8, 2.4),
    "rough": Role(LOADED, "", 0.9, 2.5),
    "spring": Role(WOUND, "", 1.1, 2.6),
    "piston": Role(DRIVEN, "", 1.6, 2.6),
    "barrel": Role(DRIVEN, "#f9dedc", 1.0, 2.7),
    "roller": Role(INK, "white", 0.9, 2.8),
    "worn": Role(INK, "#ffffff", 0.9, 3.0),
    "pin": Role(INK, "white", 0.9, 3.1),
    "weld": Role(INK, INK, 0.5, 3.2),
    "mark": Role(INK, INK, 0.5, 3.2),
    "no force": Role(LOADED, "", 0.9, 3.3, (2.0, 2.0)),
    "drive": Role(DRIVEN, "", 1.4, 3.5),
    "drive head": Role(DRIVEN, DRIVEN, 0.3, 3.5),
    "force": Role(LOADED, "", 1.4, 3.6),
    "force head": Role(LOADED, LOADED, 0.3, 3.6),
    "gravity": Role(GREY, "", 1.2, 1.0),
    "gravity head": Role(GREY, GREY, 0.3, 1.0),
    "velocity": Role("#0072B2", "", 1.1, 3.8),
    "velocity head": Role("#0072B2", "#0072B2", 0.3, 3.8),
    "reaction": Role("#D55E00", "", 1.1, 3.9),
    "reaction head": Role("#D55E00", "#D55E00", 0.3, 3.9),
    "path": Role("#D55E00", "", 1.4, 4.2),
    "path end": Role("#D55E00", "white", 1.1, 4.3),
    "gap": Role(WRONG, "", 1.8, 4.5),
    "free": Role(WRONG, "", 1.3, 4.5),
    "free head": Role(WRONG, WRONG, 0.3, 4.5),
    "clearance": Role(GREY, "", 0.7, 4.6, (3.0, 2.0)),
    "bearing": Role(INK, "#ececec", 1.0, 4.4),
    "hole": Role(INK, "white", 1.0, 4.5),
    "journal": Role(INK, "#cfe3f1", 1.0, 4.55),
    "touched": Role(WRONG, "#ffd5d0", 1.4, 4.4),
    "touching": Role(WRONG, "#ffd5d0", 1.4, 4.55),
    "scale": Role(INK, "", 1.0, 1.0),
}

# colour and weight of names
NAMES: Mapping[str, tuple[str, str]] = {
    "body": ("edge", "bold"),
    "joint": (INK, "normal"),
    "drive": (DRIVEN, "normal"),
    "force": (LOADED, "normal"),
    "point": (WOUND, "normal"),
    "gap": (WRONG, "bold"),
    "free": (WRONG, "bold"),
    "gravity": (GREY, "normal"),
    "inset": (INK, "normal"),
    "scale": (INK, "normal"),
    "path": ("#9c4300", "normal"),
}


def resolve_colour(colour_name: str, colour_index: int) -> str:
    """Return the CSS colour of a colour's name; "tint" and "edge" are body colours, "" is "none"."""
    palette = {"tint": TINTS, "edge": EDGES}.get(colour_name)
    return palette[colour_index % len(palette)] if palette else colour_name or "none"
