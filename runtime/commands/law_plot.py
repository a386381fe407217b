"""Run `gudgeon laws NAME --plot`: plot a force law over penetration, slip velocity or eccentricity ratio."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.commands.outcome import report_written_file
from gudgeon.errors import BadValueError, MissingKeyError
from gudgeon.files.writing import write_bytes
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.plot_units import choose_prefix, format_label, format_quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gudgeon.generator.field import Field
    from gudgeon.generator.kinds.laws.law import Law

SUFFIXES = (".svg", ".png", ".pdf")
N_POINTS = 241  # samples of a curve
STEEL_JOINT = {
    "R_i": 10e-3,
    "R_j": 9.9e-3,
    "c": 0.1e-3,
    "L": 20e-3,
    "E_i": 207e9,
    "nu_i": 0.3,
    "E_j": 207e9,
    "nu_j": 0.3,
}
STEEL_JOINT_TEXT = "steel, R_i = 10 mm, c = 0.1 mm, L = 20 mm"
# Values of required keys that are not set: by name, otherwise by dimension (exponents of m, kg, s).
DEFAULTS_BY_NAME = {"restitution": 0.9, "roughness": 5e-7, "mu_s": 0.15, "v0": 1e-3, "decay": 5e-3}
DEFAULTS_BY_DIMENSION: Mapping[tuple[float, ...], float] = {
    (0, 0, 0): 0.1,
    (1, 0, 0): 2e-5,
    (1, 0, -1): 1e-2,
    (-1, 0, 0): 2e4,
    (-1, 0, 1): 3.0,
    (0, 1, -2): 1e8,
    (0, 1, -1): 2e3,
    (-1, 1, -1): 0.05,
    (-1, 1, -2): 1e9,
}
MAX_PENETRATION, APPROACH_SPEED = (
    0.05,
    0.1,
)  # largest δ/c; approach speed in m/s, also slip velocity if the law has none
RATE_RATIOS = {1.0: "approach", 0.0: "rest", -1.0: "separation"}  # by δ̇/δ̇⁻
NEVER_DEFAULT = {"restitution"}  # keys whose default is not used: restitution 1 gives three equal curves
# Elastic force of laws that read it from the mechanism file.
ELASTIC_FORCE = "1e7 N/m * delta + 1e18 N/m^3 * delta**3"
Function = Callable[..., Mapping[str, Any]]


@dataclass(frozen=True)
class _SelectedLaw:
    """A law with all its parameter values and options; `description` lists those that are not the law's defaults."""

    law: Law
    name: str
    parameter_values: Mapping[str, Any]
    options: Mapping[str, str | bool]
    description: str


def plot_law(law: Law, name: str, target: Path, settings: Mapping[str, float | str]) -> None:
    """Draw a law with the values of --set, and write the picture in the format of the target's suffix.

    Raises BadValueError, MissingKeyError, UnknownNameError for wrong settings.
    """
    from gudgeon.drawing.picture import encode_figure

    write_bytes(target, encode_figure(make_law_figure(law, name, settings), target.suffix.lower()))
    report_written_file("plot", target)


def make_law_figure(law: Law, name: str, settings: Mapping[str, float | str]) -> Figure:
    """Return a figure of the law under one of its names, with its parameter values in the title.

    Raises BadValueError for a rigid law, which has no curve, and otherwise as `plot_law`.
    """
    from gudgeon.results.figures import plots  # says where matplotlib is missing

    if law.rigid:
        raise BadValueError(
            f"{name} has no curve: it is the constraint force between rigid surfaces\n"
            f"  gudgeon laws {name} describes it"
        )
    selected_law = _select_law_values(law, name, settings)
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    from gudgeon.generator.kinds.laws.built import make_law_function

    function = make_law_function(law, selected_law.parameter_values, selected_law.options, STEEL_JOINT)
    with rc_context(plots.STYLE), np.errstate(all="ignore"):
        figure = Figure(figsize=(6.4, 4.2), dpi=120, layout="constrained")
        ax = figure.subplots()
        ax.set_prop_cycle(color=plots.COLOURS)
        _DRAWN[law.role](ax, function, selected_law)
        ax.legend(fontsize=8)
        figure.suptitle(
            f"{name}: {selected_law.description}" if selected_law.description else name, fontsize=10, x=0.012, ha="left"
        )
    return figure


def _select_law_values(law: Law, name: str, settings: Mapping[str, float | str]) -> _SelectedLaw:
    """Return the law with the values of `settings`; other keys get the law's defaults, or those of this module.

    `name` is the law's name or an alternative name, which may fix options. Raises as `plot_law`.
    """
    from gudgeon.generator.field import resolve_dimensions

    fields = {field.name: field for field in resolve_dimensions(law.list_fields_of_name(name), settings)}
    for key in settings:
        if key not in fields:
            raise make_unknown_name_error(f"key of {name}", key, tuple(fields), None)
    fixed_options: Mapping[str, str | bool] = law.also.get(name, {})
    options = {field.name: fixed_options.get(field.name, field.default_option) for field in law.options}
    parameter_values: dict[str, Any] = {}
    description = []
    for field in fields.values():
        if field in law.options:
            if field.name in settings:
                options[field.name] = _parse_option(field, settings[field.name])
                description.append(f"{field.name}: {settings[field.name]}")
        elif field.varies:
            text = str(settings.get(field.name, ELASTIC_FORCE))
            parameter_values[field.name] = _parse_law_expression(field, text)
            description.append(f"{field.name} = {text}")
        elif (value := _find_parameter_value(field, settings)) is not None:
            parameter_values[field.name] = value
            if value != field.default or field.name in settings:
                description.append(f"{field.name} = {format_quantity(value, _get_unit(field))}")
    law.check_bounds(parameter_values)
    return _SelectedLaw(law, name, parameter_values, options, ", ".join(description))


def list_default_parameters(law: Law) -> dict[str, float | str]:
    """Return the parameter values of a law without settings, by key: defaults of the law or of this module, in SI.

    Keys of expressions have the text ELASTIC_FORCE.
    """
    return {
        **_select_law_values(law, law.name, {}).parameter_values,
        **dict.fromkeys((expression.name for expression in law.expressions), ELASTIC_FORCE),
    }


def _parse_law_expression(field: Field, text: str) -> Any:
    """Parse an expression of the one variable that the key allows, and return it in SymPy.

    Raises UnknownNameError for other names, UnitError for another dimension, and ExpressionError.
    """
    import sympy as sp

    from gudgeon.errors import Location
    from gudgeon.generator.symbols.from_expressions import convert_to_sympy
    from gudgeon.language.parser import check_dimension, parse
    from gudgeon.language.tree import iterate_names
    from gudgeon.language.units import LENGTH

    where = Location(f"value of {field.name}", 1, 1)
    tree = parse(text.strip(), where)
    for name in iterate_names(tree):
        if name.path != field.varies:
            raise make_unknown_name_error("name", name.path, (field.varies,), where)
    check_dimension(tree, field.dimension, lambda _: LENGTH, where)
    return convert_to_sympy(tree, lambda path: sp.Symbol(path, real=True))


def _get_unit(field: Field) -> str:
    """Return the SI unit of a key as text, "" if it has none."""
    from gudgeon.language.units import find_si_unit

    unit = "" if field.dimension is None else find_si_unit(field.dimension)
    return "" if unit == "-" else unit


def _find_parameter_value(field: Field, settings: Mapping[str, float | str]) -> float | None:
    """Return the value of a key in SI: the setting, else the law's default, else that of DEFAULTS_BY_NAME or
    DEFAULTS_BY_DIMENSION.

    None for an optional key without default and setting. Raises MissingKeyError for a required key without a value.
    """
    from gudgeon.language.quantities import parse_quantity

    exponents = None
    if field.dimension is not None:
        exponents = float(field.dimension.length), float(field.dimension.mass), float(field.dimension.time)
    if field.name in settings:
        given = settings[field.name]
        return parse_quantity(given, field.name, exponents or (0, 0, 0)) if isinstance(given, str) else float(given)
    if field.name not in NEVER_DEFAULT and (field.default is not None or not field.required):
        return None if field.default is None else float(field.default)
    fallback = DEFAULTS_BY_NAME.get(field.name, DEFAULTS_BY_DIMENSION.get(exponents) if exponents else None)
    if fallback is None:
        raise MissingKeyError(f"{field.name} is missing: {field.meaning}\n  for example --set {field.name}=1")
    return fallback


def _parse_option(field: Field, given: float | str) -> str | bool:
    """Return the value of an option from the text or number `given`. Raises UnknownNameError for other values."""
    words: dict[str, str | bool] = {
        str(value).lower() if isinstance(value, bool) else value: value for value in field.values
    }
    if str(given) not in words:
        raise make_unknown_name_error(f"choice of {field.name}", str(given), tuple(words), None)
    return words[str(given)]


def _draw_curves(
    ax: Axes, x: Any, lines: Iterator[tuple[Any, str]], x_axis: tuple[str, str], y_axis: tuple[str, str]
) -> None:
    """Draw the curves (values, label) over x with scaled units; values that are not finite are gaps.

    x_axis, y_axis: symbol and unit. Raises BadValueError if a curve has no finite value.
    """
    curves = [(np.where(np.isfinite(y), y, np.nan), description) for y, description in lines]
    for y, description in curves:
        if np.isnan(y).all():
            raise BadValueError(f"nothing to draw: with these values {description} is not finite at any point")
    wide, x_unit = choose_prefix(float(np.abs(x).max()), x_axis[1])
    high, y_unit = choose_prefix(float(np.nanmax([np.nanmax(np.abs(y)) for y, _ in curves])), y_axis[1])
    for y, description in curves:
        ax.plot(wide * x, high * y, label=description)
    ax.set(xlabel=format_label(x_axis[0], x_unit), ylabel=format_label(y_axis[0], y_unit))


def _draw_normal_force(ax: Axes, law: Function, selected_law: _SelectedLaw) -> None:
    """Draw the normal force over penetration δ for δ̇/δ̇⁻ = 1 (approach), 0 (rest) and −1 (separation).

    There is one curve if approach and separation agree. The approach speed is APPROACH_SPEED, the largest penetration
    MAX_PENETRATION clearances of STEEL_JOINT.
    """
    from gudgeon.generator.kinds.laws.built import count_optional_variables

    delta = np.linspace(0.0, MAX_PENETRATION * STEEL_JOINT["c"], N_POINTS)
    speeds = [APPROACH_SPEED] * count_optional_variables(selected_law.law)
    curves = {ratio: law(delta, ratio, *(ratio * x for x in speeds))["F_n"] for ratio in RATE_RATIOS}
    are_equal = np.array_equal(curves[1.0], curves[-1.0])
    lines = (
        [(curves[1.0], "approach and separation")]
        if are_equal
        else [(curve, f"{RATE_RATIOS[ratio]}, δ̇/δ̇⁻ = {ratio:g}".replace("-", "−")) for ratio, curve in curves.items()]
    )
    _draw_curves(ax, delta, iter(lines), ("δ", "m"), ("F_n", "N"))
    by_speed = bool(speeds) and not np.array_equal(law(delta, 1.0, 0.0)["F_n"], curves[1.0])
    ax.set_title(STEEL_JOINT_TEXT + f", δ̇⁻ = {APPROACH_SPEED:g} m/s" * by_speed)


def _draw_friction_force(ax: Axes, law: Function, selected_law: _SelectedLaw) -> None:
    """Draw F_t/F_n of a friction law over the slip velocity v_t.

    The largest velocity is three times the law's largest parameter in m/s, else APPROACH_SPEED. Laws with internal
    states are drawn as hysteresis loops of two slip amplitudes, at F_n = 1 N.
    """
    speeds = [
        selected_law.parameter_values[parameter.name]
        for parameter in selected_law.law.parameters
        if _get_unit(parameter) == "m/s"
    ]
    max_slip_velocity = 3.0 * max(speeds, default=APPROACH_SPEED / 3.0)
    if not selected_law.law.states:
        v_t = np.linspace(-max_slip_velocity, max_slip_velocity, 2 * N_POINTS)
        _draw_curves(ax, v_t, iter([(law(1.0, v_t)["F_t"], "F_t/F_n")]), ("v_t", "m/s"), ("F_t/F_n", ""))
        ax.set_title("force on the journal over the slip velocity of its surface on the bearing's")
        return
    for amplitude in (2e-5, 2e-4):
        v_t, force = _simulate_slip_oscillation(law, selected_law.law, max_slip_velocity, amplitude)
        text = f"oscillation over {format_quantity(2 * amplitude, 'm', 2)}"
        _draw_curves(ax, v_t, iter([(force, text)]), ("v_t", "m/s"), ("F_t/F_n", ""))
    ax.set_title("sinusoidal slip, third period, F_n = 1 N: internal states included")


def _simulate_slip_oscillation(
    law: Function, law_description: Law, max_slip_velocity: float, amplitude: float
) -> tuple[Any, Any]:
    """Return v_t (m/s) and F_t (N) of a friction law for a slip that oscillates like a cosine, in its third period.

    max_slip_velocity: in m/s. amplitude: in m. The internal states start at 0. Raises BadValueError if they
    diverge.
    """
    from scipy.integrate import solve_ivp

    omega = max_slip_velocity / amplitude

    def compute_state_rates(t: float, z: Any) -> list[float]:
        """Return the rates of the internal states z at the time t."""
        solution = law(1.0, max_slip_velocity * np.cos(omega * t), *z)
        return [float(solution[f"{state.name}_rate"]) for state in law_description.states]

    times = np.linspace(4.0 * np.pi, 6.0 * np.pi, 2 * N_POINTS) / omega
    none = [0.0] * len(law_description.states)
    try:
        solution = solve_ivp(compute_state_rates, (0.0, times[-1]), none, "Radau", t_eval=times, rtol=1e-6, atol=1e-12)
    except ValueError:  # rates, or their slopes, overflow
        solution = None
    if solution is None or solution.y.shape[1] < len(times):
        names = ", ".join(state.name for state in law_description.states)
        raise BadValueError(f"nothing to draw: with these values {names} cannot be integrated; its rate overflows")
    v_t = max_slip_velocity * np.cos(omega * times)
    return v_t, law(1.0, v_t, *solution.y)["F_t"]


def _draw_film_forces(ax: Axes, law: Function, selected_law: _SelectedLaw) -> None:
    """Draw film force components over the eccentricity ratio ε, on a logarithmic axis.

    There are four curves: −F_r and F_t of a journal that rotates (ω_s = 1 rad/s), −F_r of one that approaches
    (ε̇ = 1 1/s), and F_r of one that recedes (ε̇ = −1 1/s). Raises BadValueError if no curve has a positive value.
    """
    epsilon = np.linspace(0.01, 0.95, N_POINTS)
    turning, closing, opening = (law(epsilon, *w) for w in ((0.0, -0.5 * epsilon), (1.0, 0.0), (-1.0, 0.0)))
    lines = [
        (-turning["F_r"], "−F_r, rotation"),
        (turning["F_t"], "F_t, rotation"),
        (-closing["F_r"], "−F_r, gap closes"),
        (opening["F_r"], "F_r, gap opens"),
    ]
    if not any((y > 0.0).any() for y, _ in lines):
        raise BadValueError("nothing to draw: with these values all forces are 0")
    _draw_curves(ax, epsilon, iter(lines), ("ε", ""), ("F", "N"))
    ax.set_yscale("log")
    ax.set_title(f"{STEEL_JOINT_TEXT}; ω_s = 1 rad/s, or ε̇ = ±1 1/s")


def _draw_contact_fraction(ax: Axes, law: Function, selected_law: _SelectedLaw) -> None:
    """Draw the fraction b of the dry contact in mixed lubrication over the penetration δ of the asperities.

    δ goes up to seven times the sum of the law's roughnesses.
    """
    max_penetration = 7.0 * sum(x for name, x in selected_law.parameter_values.items() if name.startswith("roughness"))
    delta = np.linspace(0.0, max_penetration, N_POINTS)
    fractions = iter([(law(delta)["share"], "dry contact; the rest is the film's")])
    _draw_curves(ax, delta, fractions, ("δ, penetration of the asperities", "m"), ("fraction b", ""))
    ax.set_title("fraction of the dry contact in force and moments")


_DRAWN = {
    "normal": _draw_normal_force,
    "friction": _draw_friction_force,
    "film": _draw_film_forces,
    "mixed": _draw_contact_fraction,
}
