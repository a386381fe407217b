"""Plots force laws over their range, evaluated by the functions of the NumPy target."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.targets.c.play import function_name
from gudgeon.generator.targets.latex.document import Block, Picture
from gudgeon.generator.targets.latex.pictures import svg
from gudgeon.generator.targets.latex.trace import Functions
from gudgeon.generator.targets.numpy.module import with_curves
from gudgeon.generator.targets.numpy.printer import function
from gudgeon.language.plot_units import label, scale
from gudgeon.language.units import VELOCITY

POINTS = 61
DEEPEST = 0.05  # share of the clearance up to which contact forces are drawn
FAST = 0.1  # m/s, approach at which a law that reads δ̇ itself is drawn
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 420, 204, 62, 408, 16, 172


@dataclass(frozen=True)
class Curve:
    """Represent y over the plot's x, with a label."""

    y: Any
    message: str


@dataclass(frozen=True)
class Plot:
    """Represent a plot; axes are (letter, SI unit), `now` is the local on the x axis by function: "dry", "v_t"."""

    x: Any
    curves: tuple[Curve, ...]
    x_axis: tuple[str, str]
    y_axis: tuple[str, str]
    now: tuple[str, str]
    caption: str


def law_plot(found: Functions, joints: Sequence[str], role: str, law: Law) -> list[Block]:
    """Return the plot of a role's law in joints that share it; nothing for laws with inner states."""
    pins = {pin.clearance.label: k for k, pin in enumerate(found.program.pins)}
    pin = found.program.pins[pins[joints[0]]]
    call = pin.laws.get(role)
    if call is None or law.states or law.rigid:
        return []
    p = _numbers(found)
    try:
        with np.errstate(all="ignore"):
            plot = _DRAWN[role](found, pin, call, p)
    except (ArithmeticError, ValueError, TypeError, AttributeError):  # a law of the user's own that arrays do not fit
        return []
    if not all(np.isfinite(curve.y).all() for curve in plot.curves):
        return []
    part, local = plot.now
    marks = {name: f"{function_name(part, name)}.{local}" for name in joints}
    return [Picture(plot.caption, drawn(plot, marks))]


def _numbers(found: Functions) -> Mapping[str, float]:
    """Return every parameter by its field, at its default."""
    tables = found.model.slots.tables
    p = SimpleNamespace(**{name: [0.0] * len(table) for name, table in tables.items()})
    count = len(found.model.slots.entries)
    _callable(found, found.program.prepare)([0.0] * count, [False] * count, p)
    return {name: float(value) for name, value in vars(p).items() if name not in tables}


def _callable(found: Functions, kernel: Kernel) -> Any:
    """Return a kernel as a Python function."""
    names: dict[str, Any] = {"np": np}
    text = function(kernel)
    exec(compile(with_curves(found.model.scene.mechanism.curves, text) + text, "<law>", "exec"), names)
    return names[kernel.name]


def _called(found: Functions, call: SharedFunctionCall, p: Mapping[str, float], *given: Any) -> Any:
    """Return the result of a law at default parameters."""
    return _callable(found, call.kernel)(*given, *(p[number.member] for number in call.numbers))


def _value(found: Functions, p: Mapping[str, float], number: Any) -> float:
    """Return the value of a symbol that is a parameter, or of a number."""
    return p[found.model.slots.field(number)] if number in found.model.symbols.info else float(number)


def _normal(found: Functions, pin: Pin, call: SharedFunctionCall, p: Mapping[str, float]) -> Plot:
    """Return the plot of a normal force over penetration, for several ratios δ̇/δ̇⁻."""
    delta = np.linspace(0.0, DEEPEST, POINTS) * _value(found, p, pin.clearance.pair.c)
    curves = []
    for ratio in (1.0, 0.0, -1.0):
        further = [ratio * FAST] if pin.further else []
        y = np.broadcast_to(_called(found, call, p, delta, ratio, *further), delta.shape)
        curves.append(Curve(y, f"δ̇/δ̇⁻ = {ratio:g}" + (f", δ̇ = {ratio * FAST:g} m/s" if pin.further else "")))
    caption = "The normal force over the penetration, while the surfaces approach, rest and part"
    return Plot(delta, tuple(curves), ("δ", "m"), ("F_n", "N"), ("clearance", "delta"), caption)


def _friction(found: Functions, pin: Pin, call: SharedFunctionCall, p: Mapping[str, float]) -> Plot:
    """Return the plot of a friction force over slip."""
    law = pin.clearance.friction
    numbers = law.numbers if law else {}
    of_speed = {own.name for own in law.law.parameters if own.dimension == VELOCITY} if law else set()
    speeds = [_value(found, p, symbol) for name, symbol in numbers.items() if name in of_speed]
    v_t = np.linspace(-1.0, 1.0, 2 * POINTS) * 3.0 * (max(speeds, default=0.0) or FAST)
    y = np.broadcast_to(_called(found, call, p, 1.0, v_t), v_t.shape)
    caption = "Friction over the slip, for a normal force of 1 N"
    return Plot(v_t, (Curve(y, ""),), ("v_t", "m/s"), ("F_t/F_n", ""), ("dry", "v_t"), caption)


def _film(found: Functions, pin: Pin, call: SharedFunctionCall, p: Mapping[str, float]) -> Plot:
    """Return the plot of film forces over the eccentricity ratio."""
    epsilon = np.linspace(0.0, 0.9, POINTS)
    radial, along, *_ = _called(found, call, p, epsilon, 0.0 * epsilon, -0.5 * epsilon)
    curves = (Curve(np.broadcast_to(radial, epsilon.shape), "F_r"), Curve(np.broadcast_to(along, epsilon.shape), "F_t"))
    caption = "The film's forces over the eccentricity ratio, for surfaces that turn at 1 rad/s together and no squeeze"
    return Plot(epsilon, curves, ("ε", ""), ("F", "N"), ("film", "epsilon"), caption)


_DRAWN = {"normal": _normal, "friction": _friction, "film": _film}


def drawn(plot: Plot, marks: Mapping[str, str]) -> str:
    """Return the plot as SVG: axes with limits, labelled curves, marks for the present state of each joint."""
    low, high = (float(f([f(curve.y) for curve in plot.curves])) for f in (np.min, np.max))
    low, high = min(low, 0.0), max(high, 0.0) if high > low or high > 0.0 else low + 1.0
    first, last = float(plot.x[0]), float(plot.x[-1])

    def at_x(x: Any) -> Any:
        """Return the horizontal position of x."""
        return LEFT + (RIGHT - LEFT) * (x - first) / (last - first or 1.0)

    def at_y(y: Any) -> Any:
        """Return the vertical position of y."""
        return BOTTOM - (BOTTOM - TOP) * (y - low) / (high - low or 1.0)

    parts = [
        f'<path class="rule" d="M{LEFT} {TOP}V{BOTTOM}M{LEFT} {at_y(0.0):.1f}H{RIGHT}"/>',
        *_ends(plot, low, high, first, last, float(at_y(0.0))),
    ]
    for k, curve in enumerate(plot.curves):
        points = zip(at_x(plot.x).tolist(), at_y(np.asarray(curve.y, dtype=float)).tolist(), strict=True)
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        parts.append(f'<polyline class="curve dash{k}" points="{path}"/>')
        if curve.message:
            y = TOP + 12 + 15 * k
            parts.append(f'<path class="curve dash{k}" d="M{LEFT + 12} {y - 4}h26"/>')
            parts.append(f'<text x="{LEFT + 44}" y="{y}">{_set(curve.message)}</text>')
    parts += [_mark(name, value, first, last, len(plot.curves)) for name, value in marks.items()]
    return svg(WIDTH, HEIGHT, f"{plot.y_axis[0]} over {plot.x_axis[0]}", parts)


def _ends(plot: Plot, low: float, high: float, first: float, last: float, zero: float) -> list[str]:
    """Return the labels and limits of the axes, in suitable units."""
    across, x_unit = scale(max(abs(first), abs(last)), plot.x_axis[1])
    up, y_unit = scale(max(abs(low), abs(high)), plot.y_axis[1])
    x_name, y_name = _set(label(plot.x_axis[0], x_unit)), _set(label(plot.y_axis[0], y_unit))
    return [
        f'<text class="end" x="{LEFT - 5}" y="{TOP + 8}">{_plain(high * up)}</text>',
        f'<text class="end" x="{LEFT - 5}" y="{BOTTOM}">{_plain(low * up)}</text>',
        f'<text x="{LEFT}" y="{BOTTOM + 16}">{_plain(first * across)}</text>',
        f'<text class="end" x="{RIGHT}" y="{BOTTOM + 16}">{_plain(last * across)}</text>',
        f'<text class="middle" x="{(LEFT + RIGHT) / 2:g}" y="{BOTTOM + 28}">{x_name}</text>',
        f'<text class="middle" transform="translate(14 {(TOP + BOTTOM) / 2:g}) rotate(-90)">{y_name}</text>',
    ]


def _plain(value: float) -> str:
    """Return a number for an axis."""
    return f"{value:.3g}".replace("-", "−")


def _set(text: str) -> str:
    """Return a label in SVG, a letter after _ lowered."""
    first, *others = html.escape(text).split("_")
    lowered = (f'<tspan class="small" dy="3">{x[:1]}</tspan><tspan dy="-3">&#8203;{x[1:]}</tspan>' for x in others)
    return "".join((first, *lowered))


def _mark(name: str, value: str, first: float, last: float, curves: int) -> str:
    """Return a line at the joint's present state and a dot on each curve, moved and shown by live.js."""
    dots = '<circle r="3"/>' * curves
    return (
        f'<g class="now" data-value="tmp.law.{value}" data-range="{first!r} {last!r} {LEFT} {RIGHT}"'
        f' visibility="hidden"><path d="M0 {TOP}V{BOTTOM}"/>{dots}'
        f'<text class="middle" y="{TOP - 2}">{html.escape(name)}</text></g>'
    )
