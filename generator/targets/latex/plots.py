"""Plots force laws over their range as SVG, evaluated by the functions of the NumPy target."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels.play import JointFunctions
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.targets.c.play import get_function_name
from gudgeon.generator.targets.latex.document import Block, Picture
from gudgeon.generator.targets.latex.pictures import print_svg
from gudgeon.generator.targets.latex.trace import Functions
from gudgeon.generator.targets.numpy.module import print_called_curves
from gudgeon.generator.targets.numpy.printer import print_function
from gudgeon.language.plot_units import choose_prefix, format_label
from gudgeon.language.units import VELOCITY

N_SAMPLES = 61  # of a curve; twice as many for friction
MAX_PENETRATION_RATIO = 0.05  # fraction of the clearance up to which contact forces are plotted
APPROACH_SPEED = 0.1  # m/s: |δ̇| for a law that reads δ̇ itself; max. slip for a friction law without a velocity
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 420, 204, 62, 408, 16, 172  # pixels: size of the SVG, limits of the axes


@dataclass(frozen=True)
class Curve:
    """Represent y over the plot's x, with a label."""

    y: Any
    label: str


@dataclass(frozen=True)
class Plot:
    """Represent a plot; axes are (symbol, SI unit).

    `state_local`: the local of the joint's C function that is on the x axis: (part, local), such as ("dry", "v_t").
    """

    x: Any
    curves: tuple[Curve, ...]
    x_axis: tuple[str, str]
    y_axis: tuple[str, str]
    state_local: tuple[str, str]
    caption: str


def plot_law_of_joints(functions: Functions, joint_labels: Sequence[str], role: str, law: Law) -> list[Block]:
    """Return the plot of a law of the first of `joint_labels`, with a mark for the current state of each joint.

    role: "normal", "friction" or "film". [] is returned for "mixed", rigid contacts and laws with internal states, and
    if the law cannot be evaluated to finite values for arrays.
    """
    joint_indices = {joint.clearance.label: k for k, joint in enumerate(functions.program.joints)}
    joint = functions.program.joints[joint_indices[joint_labels[0]]]
    call = joint.laws.get(role)
    if call is None or law.states or law.rigid:
        return []
    parameters = _evaluate_parameters(functions)
    try:
        with np.errstate(all="ignore"):
            plot = _PLOT_BY_ROLE[role](functions, joint, call, parameters)
    except (ArithmeticError, ValueError, TypeError, AttributeError):  # a user-defined law that does not accept arrays
        return []
    if not all(np.isfinite(curve.y).all() for curve in plot.curves):
        return []
    part, local = plot.state_local
    mark_values = {name: f"{get_function_name(part, name)}.{local}" for name in joint_labels}
    return [Picture(plot.caption, print_plot_svg(plot, mark_values))]


def _evaluate_parameters(functions: Functions) -> Mapping[str, float]:
    """Return {field of Parameters: default value, SI} of all parameters, derived ones included; tables are left out."""
    tables = functions.model.parameter_table.tables
    p = SimpleNamespace(**{name: [0.0] * len(table) for name, table in tables.items()})
    count = len(functions.model.parameter_table.entries)
    _compile_kernel(functions, functions.program.prepare)([0.0] * count, [False] * count, p)
    return {name: float(value) for name, value in vars(p).items() if name not in tables}


def _compile_kernel(functions: Functions, kernel: Kernel) -> Any:
    """Return a kernel as a Python function, printed by the NumPy target with the curves that it calls, and compiled."""
    names: dict[str, Any] = {"np": np}
    text = print_function(kernel)
    exec(compile(print_called_curves(functions.model.scene.mechanism.curves, text) + text, "<law>", "exec"), names)
    return names[kernel.name]


def _call_law_kernel(
    functions: Functions, call: SharedFunctionCall, parameters: Mapping[str, float], *arguments: Any
) -> Any:
    """Return the results of a law, one array or a tuple of arrays, for its variables `arguments` (SI).

    parameters: {field: value} of all parameters, from which those of the law's call are selected.
    """
    return _compile_kernel(functions, call.kernel)(*arguments, *(parameters[place.member] for place in call.parameters))


def _evaluate_symbol(functions: Functions, parameters: Mapping[str, float], symbol: Any) -> float:
    """Return the value (SI) of a symbol that is a parameter, or of a SymPy number."""
    return (
        parameters[functions.model.parameter_table.find_member_name(symbol)]
        if symbol in functions.model.symbols.info
        else float(symbol)
    )


def _plot_normal_force(
    functions: Functions, joint: JointFunctions, call: SharedFunctionCall, parameters: Mapping[str, float]
) -> Plot:
    """Return the plot of a normal force (N) over the penetration (m), with a curve for each ratio δ̇/δ̇⁻ of 1, 0, −1.

    The penetration goes up to MAX_PENETRATION_RATIO of the clearance. A law that reads the rate itself gets the
    ratio times APPROACH_SPEED.
    """
    delta = np.linspace(0.0, MAX_PENETRATION_RATIO, N_SAMPLES) * _evaluate_symbol(
        functions, parameters, joint.clearance.pair.c
    )
    curves = []
    for ratio in (1.0, 0.0, -1.0):
        rate_argument = [ratio * APPROACH_SPEED] if joint.normal_law_extra_variables else []
        y = np.broadcast_to(_call_law_kernel(functions, call, parameters, delta, ratio, *rate_argument), delta.shape)
        rate_label = f", δ̇ = {ratio * APPROACH_SPEED:g} m/s" if joint.normal_law_extra_variables else ""
        curves.append(Curve(y, f"δ̇/δ̇⁻ = {ratio:g}{rate_label}"))
    caption = "The normal force over the penetration, while the surfaces approach, rest and separate"
    return Plot(delta, tuple(curves), ("δ", "m"), ("F_n", "N"), ("clearance", "delta"), caption)


def _plot_friction(
    functions: Functions, joint: JointFunctions, call: SharedFunctionCall, parameters: Mapping[str, float]
) -> Plot:
    """Return the plot of a friction force over the slip velocity, for a normal force of 1 N.

    The slip reaches three times the largest velocity among the law's parameters, or three times APPROACH_SPEED.
    """
    law = joint.clearance.friction
    law_parameters = law.parameters if law else {}
    velocity_names = {field.name for field in law.law.parameters if field.dimension == VELOCITY} if law else set()
    velocities = [
        _evaluate_symbol(functions, parameters, symbol)
        for name, symbol in law_parameters.items()
        if name in velocity_names
    ]
    v_t = np.linspace(-1.0, 1.0, 2 * N_SAMPLES) * 3.0 * (max(velocities, default=0.0) or APPROACH_SPEED)
    y = np.broadcast_to(_call_law_kernel(functions, call, parameters, 1.0, v_t), v_t.shape)
    caption = "Friction over the slip, for a normal force of 1 N"
    return Plot(v_t, (Curve(y, ""),), ("v_t", "m/s"), ("F_t/F_n", ""), ("dry", "v_t"), caption)


def _plot_film(
    functions: Functions, joint: JointFunctions, call: SharedFunctionCall, parameters: Mapping[str, float]
) -> Plot:
    """Return the plot of the film forces F_r and F_t (N) over the eccentricity ratio from 0 to 0.9.

    Both surfaces rotate at 1 rad/s and the journal rests, so that w_n = 0 and w_t = −ε/2 (in clearances per second).
    """
    epsilon = np.linspace(0.0, 0.9, N_SAMPLES)
    radial, tangential, *_ = _call_law_kernel(functions, call, parameters, epsilon, 0.0 * epsilon, -0.5 * epsilon)
    curves = (
        Curve(np.broadcast_to(radial, epsilon.shape), "F_r"),
        Curve(np.broadcast_to(tangential, epsilon.shape), "F_t"),
    )
    caption = "The film's forces over the eccentricity ratio, for both surfaces at 1 rad/s and no squeeze"
    return Plot(epsilon, curves, ("ε", ""), ("F", "N"), ("film", "epsilon"), caption)


_PLOT_BY_ROLE = {"normal": _plot_normal_force, "friction": _plot_friction, "film": _plot_film}


def print_plot_svg(plot: Plot, mark_values: Mapping[str, str]) -> str:
    """Return the plot as SVG: axes with limits, labelled curves, marks for the current state of each joint.

    The y axis includes 0. mark_values: {label of a joint: name of the value at which the page puts its mark}.
    """
    y_min, y_max = (float(f([f(curve.y) for curve in plot.curves])) for f in (np.min, np.max))
    y_min, y_max = min(y_min, 0.0), max(y_max, 0.0) if y_max > y_min or y_max > 0.0 else y_min + 1.0
    x_min, x_max = float(plot.x[0]), float(plot.x[-1])

    def scale_x(x: Any) -> Any:
        """Return the horizontal position (pixels) of x, a number or array."""
        return LEFT + (RIGHT - LEFT) * (x - x_min) / (x_max - x_min or 1.0)

    def scale_y(y: Any) -> Any:
        """Return the vertical position (pixels) of y, a number or array."""
        return BOTTOM - (BOTTOM - TOP) * (y - y_min) / (y_max - y_min or 1.0)

    parts = [
        f'<path class="rule" d="M{LEFT} {TOP}V{BOTTOM}M{LEFT} {scale_y(0.0):.1f}H{RIGHT}"/>',
        *_print_axis_labels(plot, y_min, y_max, x_min, x_max),
    ]
    for k, curve in enumerate(plot.curves):
        points = zip(scale_x(plot.x).tolist(), scale_y(np.asarray(curve.y, dtype=float)).tolist(), strict=True)
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        parts.append(f'<polyline class="curve dash{k}" points="{path}"/>')
        if curve.label:
            y = TOP + 12 + 15 * k
            parts.append(f'<path class="curve dash{k}" d="M{LEFT + 12} {y - 4}h26"/>')
            parts.append(f'<text x="{LEFT + 44}" y="{y}">{_print_label(curve.label)}</text>')
    parts += [_print_state_marker(name, value, x_min, x_max, len(plot.curves)) for name, value in mark_values.items()]
    return print_svg(WIDTH, HEIGHT, f"{plot.y_axis[0]} over {plot.x_axis[0]}", parts)


def _print_axis_labels(plot: Plot, y_min: float, y_max: float, x_min: float, x_max: float) -> list[str]:
    """Return the SVG texts of the axes: limits, and labels with prefixes of units that suit the ranges.

    Limits are in SI units.
    """
    x_scale, x_unit = choose_prefix(max(abs(x_min), abs(x_max)), plot.x_axis[1])
    y_scale, y_unit = choose_prefix(max(abs(y_min), abs(y_max)), plot.y_axis[1])
    x_name, y_name = (
        _print_label(format_label(plot.x_axis[0], x_unit)),
        _print_label(format_label(plot.y_axis[0], y_unit)),
    )
    return [
        f'<text class="end" x="{LEFT - 5}" y="{TOP + 8}">{_format_number(y_max * y_scale)}</text>',
        f'<text class="end" x="{LEFT - 5}" y="{BOTTOM}">{_format_number(y_min * y_scale)}</text>',
        f'<text x="{LEFT}" y="{BOTTOM + 16}">{_format_number(x_min * x_scale)}</text>',
        f'<text class="end" x="{RIGHT}" y="{BOTTOM + 16}">{_format_number(x_max * x_scale)}</text>',
        f'<text class="middle" x="{(LEFT + RIGHT) / 2:g}" y="{BOTTOM + 28}">{x_name}</text>',
        f'<text class="middle" transform="translate(14 {(TOP + BOTTOM) / 2:g}) rotate(-90)">{y_name}</text>',
    ]


def _format_number(value: float) -> str:
    """Return a number for an axis: three digits with a typographic minus."""
    return f"{value:.3g}".replace("-", "−")


def _print_label(text: str) -> str:
    """Return a label as SVG text, escaped; the character after each "_" becomes a subscript."""
    first, *others = html.escape(text).split("_")
    subscripts = (f'<tspan class="small" dy="3">{x[:1]}</tspan><tspan dy="-3">&#8203;{x[1:]}</tspan>' for x in others)
    return "".join((first, *subscripts))


def _print_state_marker(name: str, value_name: str, x_min: float, x_max: float, n_curves: int) -> str:
    """Return the SVG group that marks a joint's state: a vertical line, a dot per curve and the label `name`.

    It is hidden until current_values.js moves it. x_min, x_max: limits of the x axis.
    """
    dots = '<circle r="3"/>' * n_curves
    return (
        f'<g class="state-marker" data-value="tmp.law.{value_name}" data-range="{x_min!r} {x_max!r} {LEFT} {RIGHT}"'
        f' visibility="hidden"><path d="M0 {TOP}V{BOTTOM}"/>{dots}'
        f'<text class="middle" y="{TOP - 2}">{html.escape(name)}</text></g>'
    )
