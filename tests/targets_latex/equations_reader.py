"""Reads the text of `gudgeon equations` as a student would: line by line, with nothing but what is written there."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gudgeon.language.units import UNITS

# a letter with dots, hats and subscripts: x_L1, θ̇_L1, ξ_L1.com, δ̇⁻
NAME = re.compile(r"(?<![\w.])[^\W\d_][\w\u0302\u0307\u0308]*(?:\.\w+)*[⁰⁻']*")
_EQUATION = re.compile(rf"  ({NAME.pattern}|∂\S+/∂\S+) = (.*)")
FUNCTIONS: dict[str, Callable[..., float]] = {
    "cos": math.cos,
    "sin": math.sin,
    "tan": math.tan,
    "sqrt": math.sqrt,
    "atan2": math.atan2,
    "exp": math.exp,
    "atan": math.atan,
    "tanh": math.tanh,
    "log": math.log,
    "abs": abs,
    "max": max,
    "min": min,
    "sgn": lambda x: (x > 0) - (x < 0),
    "H": lambda x: float(x > 0),
    "mod": lambda a, b: a % b,
    "where": lambda holds, then, otherwise: then if holds else otherwise,
}


def sections(text: str) -> dict[str, list[str]]:
    """The lines of each section by its title; lines that go on are joined."""
    found: dict[str, list[str]] = {}
    lines = text.splitlines()
    current: list[str] = []
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        if line and set(below) in ({"="}, {"-"}) and len(below) == width(line):
            current = found[line] = []
        elif line.startswith(" " * 8) and current and _EQUATION.match(current[-1]):
            current[-1] += " " + line.strip()
        elif set(line) not in ({"="}, {"-"}):
            current.append(line)
    return found


def width(line: str) -> int:
    """Columns of a line on a terminal."""
    return len(re.sub("[\u0302\u0307\u0308]", "", line))


def equations(lines: list[str]) -> list[tuple[str, str]]:
    """The equations of a section: left side, right side."""
    return [(m[1], m[2]) for m in map(_EQUATION.fullmatch, lines) if m and m[1] != "Φ"]


def value(expression: str, known: dict[str, float]) -> float:
    """The number of an expression; KeyError for a name that was not introduced before."""
    text = expression.replace("·", "*").replace("^", "**").replace("√", "sqrt")
    text = re.sub(r"(\d)(?=π)", r"\1*", re.sub(r"([\d.]+)°", r"(\1*π/180)", text))
    text = re.sub(r"\|([^|]*)\|", r"abs(\1)", text)
    text = NAME.sub(lambda m: m[0] if m[0] in FUNCTIONS else f"known[{m[0]!r}]", text)
    names: dict[str, Any] = {**FUNCTIONS, "known": {"π": math.pi, **known}}
    return float(eval(text, {"__builtins__": {}}, names))  # the text is our own


def dots_apart(name: str) -> str:
    """Dotted letters as the document has them: the letter, then the dot."""
    return name.replace("ẋ", "x\u0307").replace("ẏ", "y\u0307").replace("ė", "e\u0307").replace("δ̇", "δ\u0307")


def state(bodies: Sequence[str], q: np.ndarray, v: np.ndarray) -> dict[str, float]:
    """Coordinates and rates by the names that physics.md gives them."""
    known = {}
    for k, body in enumerate(bodies):
        for i, (name, rate) in enumerate((("x", "ẋ"), ("y", "ẏ"), ("θ", "θ\u0307"))):
            known[f"{name}_{body}"] = float(q[3 * k + i])
            known[f"{dots_apart(rate)}_{body}"] = float(v[3 * k + i])
    return known


def evaluate(lines: list[str], known: dict[str, float]) -> dict[str, float]:
    """`known` with what the section's equations give, one after the other."""
    known = dict(known)
    for left, right in equations(lines):
        known[left] = value(right, known)
    return known


def rows(lines: list[str]) -> list[list[str]]:
    """The rows of a section's tables, cell by cell."""
    return [re.split(r"\s{3,}", line.strip()) for line in lines if line.startswith("  ")]


def numbers(lines: list[str]) -> dict[str, float]:
    """What tables say in the form "l_L1 = 80 mm" or "y_O4 = -l_5 = -0.3 m", in SI."""
    cells = [part for row in rows(lines) for cell in row for part in cell.split(",  ")]
    parts = [cell.split(" = ") for cell in cells if " = " in cell]
    found = ((part[0], quantity(part[-1])) for part in parts if NAME.fullmatch(part[0]))
    return {name: number for name, number in found if number is not None}


def quantity(text: str) -> float | None:
    """A number, behind it a unit or none, in SI; None for any other text."""
    found = re.fullmatch(r"(-?(?:\d[\d.e+-]*°?|\d*π(?:/\d)?))(?: ([^\d\W].*))?", text)
    if found is None:
        return None
    unit = (found[2] or "").replace("·", "*").replace("²", "^2").replace("³", "^3")
    return value(found[1], {}) * (UNITS[unit][0] if unit else 1.0)
