"""`gudgeon laws NAME --plot`: what a law of force is, as curves: over penetration, slip or eccentricity."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.commands.told import wrote
from gudgeon.errors import BadValueError, MissingKeyError
from gudgeon.files.writing import write_bytes
from gudgeon.language.names import unknown_name
from gudgeon.language.plot_units import label, quantity, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gudgeon.generator.field import Field
    from gudgeon.generator.kinds.laws.law import Law

SUFFIXES = (".svg", ".png", ".pdf")
POINTS = 241
STEEL = {"R_i": 10e-3, "R_j": 9.9e-3, "c": 0.1e-3, "L": 20e-3, "E_i": 207e9, "nu_i": 0.3, "E_j": 207e9, "nu_j": 0.3}
PAIR = "steel, R_i = 10 mm, c = 0.1 mm, L = 20 mm"
# What a number is taken to be that must be given and is not: by its name, else by its dimension (m, kg, s).
USUAL = {"restitution": 0.9, "roughness": 5e-7, "mu_s": 0.15, "v0": 1e-3, "decay": 5e-3}
BY_DIMENSION: Mapping[tuple[float, ...], float] = {
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
DEEPEST, SPEED = 0.05, 0.1  # share of c; m/s, of an approach, and of a slip where the law names none
RATIOS = {1.0: "approach", 0.0: "rest", -1.0: "parting"}
SHOWN = {"restitution"}  # of which the default, 1, would draw the same curve thrice
# What an elastic force is taken to be that the file of a mechanism would give.
FORCE = "1e7 N/m * delta + 1e18 N/m^3 * delta**3"
Function = Callable[..., Mapping[str, Any]]


@dataclass(frozen=True)
class Chosen:
    """A law with all its numbers and options; `told`: those that are not the law's own defaults."""

    law: Law
    name: str
    numbers: Mapping[str, Any]
    options: Mapping[str, str | bool]
    told: str


def plot_law(law: Law, name: str, target: Path, settings: Mapping[str, float | str]) -> None:
    """Writes the picture. Raises BadValueError, MissingKeyError, UnknownNameError for what is set wrongly."""
    from gudgeon.drawing.picture import as_bytes

    write_bytes(target, as_bytes(figure_of(law, name, settings), target.suffix.lower()))
    wrote("plot", target)


def figure_of(law: Law, name: str, settings: Mapping[str, float | str]) -> Figure:
    """The law under one of its names, its numbers told above; errors as `plot_law`."""
    from gudgeon.results.figures import plots  # says where matplotlib is missing

    if law.rigid:
        raise BadValueError(
            f"{name} has no curve: its force is whatever keeps surfaces apart that do not give\n"
            f"  gudgeon laws {name} tells what it does"
        )
    chosen = _chosen(law, name, settings)
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    from gudgeon.generator.kinds.laws.built import alone

    function = alone(law, chosen.numbers, chosen.options, STEEL)
    with rc_context(plots.STYLE), np.errstate(all="ignore"):
        figure = Figure(figsize=(6.4, 4.2), dpi=120, layout="constrained")
        ax = figure.subplots()
        ax.set_prop_cycle(color=plots.COLOURS)
        _DRAWN[law.role](ax, function, chosen)
        ax.legend(fontsize=8)
        figure.suptitle(f"{name}: {chosen.told}" if chosen.told else name, fontsize=10, x=0.012, ha="left")
    return figure


def _chosen(law: Law, name: str, settings: Mapping[str, float | str]) -> Chosen:
    from gudgeon.generator.field import with_dimensions

    fields = {own.name: own for own in with_dimensions(law.fields_as(name), settings)}
    for key in settings:
        if key not in fields:
            raise unknown_name(f"key of {name}", key, tuple(fields), None)
    made: Mapping[str, str | bool] = law.also.get(name, {})
    options = {own.name: made.get(own.name, own.choice) for own in law.options}
    numbers: dict[str, Any] = {}
    told = []
    for own in fields.values():
        if own in law.options:
            if own.name in settings:
                options[own.name] = _option(own, settings[own.name])
                told.append(f"{own.name}: {settings[own.name]}")
        elif own.varies:
            text = str(settings.get(own.name, FORCE))
            numbers[own.name] = _of_variable(own, text)
            told.append(f"{own.name} = {text}")
        elif (value := _number(own, settings)) is not None:
            numbers[own.name] = value
            if value != own.default or own.name in settings:
                told.append(f"{own.name} = {quantity(value, _unit(own))}")
    law.check(numbers)
    return Chosen(law, name, numbers, options, ", ".join(told))


def chosen_numbers(law: Law) -> dict[str, float | str]:
    """Its numbers under its own name where nothing is set: defaults, else what is usual; SI, an expression as text."""
    return {**_chosen(law, law.name, {}).numbers, **dict.fromkeys((own.name for own in law.expressions), FORCE)}


def _of_variable(own: Field, text: str) -> Any:
    """An expression of the variable that the key names, as SymPy. Raises what it would raise in a file."""
    import sympy as sp

    from gudgeon.errors import Location
    from gudgeon.generator.symbols.from_expressions import to_sympy
    from gudgeon.language.parser import check_dimension, parse
    from gudgeon.language.tree import names
    from gudgeon.language.units import LENGTH

    where = Location(f"value of {own.name}", 1, 1)
    tree = parse(text.strip(), where)
    for name in names(tree):
        if name.path != own.varies:
            raise unknown_name("name", name.path, (own.varies,), where)
    check_dimension(tree, own.dimension, lambda _: LENGTH, where)
    return to_sympy(tree, lambda path: sp.Symbol(path, real=True))


def _unit(own: Field) -> str:
    from gudgeon.language.units import si_unit

    unit = "" if own.dimension is None else si_unit(own.dimension)
    return "" if unit == "-" else unit


def _number(own: Field, settings: Mapping[str, float | str]) -> float | None:
    """As set, the law's default, or what is usual."""
    from gudgeon.language.quantities import number_of_text

    exponents = None
    if own.dimension is not None:
        exponents = float(own.dimension.length), float(own.dimension.mass), float(own.dimension.time)
    if own.name in settings:
        given = settings[own.name]
        return number_of_text(given, own.name, exponents or (0, 0, 0)) if isinstance(given, str) else float(given)
    if own.name not in SHOWN and (own.default is not None or not own.required):
        return None if own.default is None else float(own.default)
    usual = USUAL.get(own.name, BY_DIMENSION.get(exponents) if exponents else None)
    if usual is None:
        raise MissingKeyError(f"{own.name} is missing: {own.meaning}\n  for example --set {own.name}=1")
    return usual


def _option(own: Field, given: float | str) -> str | bool:
    words: dict[str, str | bool] = {
        str(value).lower() if isinstance(value, bool) else value: value for value in own.values
    }
    if str(given) not in words:
        raise unknown_name(f"choice of {own.name}", str(given), tuple(words), None)
    return words[str(given)]


def _line(ax: Axes, x: Any, lines: Iterator[tuple[Any, str]], across: tuple[str, str], up: tuple[str, str]) -> None:
    """Curves in units that read well; no number is a gap, and nothing but gaps a BadValueError."""
    found = [(np.where(np.isfinite(y), y, np.nan), told) for y, told in lines]
    for y, told in found:
        if np.isnan(y).all():
            raise BadValueError(f"nothing to draw: with these numbers {told} is no finite number anywhere")
    wide, x_unit = scale(float(np.abs(x).max()), across[1])
    high, y_unit = scale(float(np.nanmax([np.nanmax(np.abs(y)) for y, _ in found])), up[1])
    for y, told in found:
        ax.plot(wide * x, high * y, label=told)
    ax.set(xlabel=label(across[0], x_unit), ylabel=label(up[0], y_unit))


def _normal(ax: Axes, law: Function, chosen: Chosen) -> None:
    """The force while the surfaces approach, rest and part."""
    from gudgeon.generator.kinds.laws.built import reads_besides

    delta = np.linspace(0.0, DEEPEST * STEEL["c"], POINTS)
    further = [SPEED] * reads_besides(chosen.law)
    curves = {ratio: law(delta, ratio, *(ratio * x for x in further))["F_n"] for ratio in RATIOS}
    same = np.array_equal(curves[1.0], curves[-1.0])
    lines = (
        [(curves[1.0], "approach and parting alike")]
        if same
        else [(curve, f"{RATIOS[ratio]}, δ̇/δ̇⁻ = {ratio:g}".replace("-", "−")) for ratio, curve in curves.items()]
    )
    _line(ax, delta, iter(lines), ("δ", "m"), ("F_n", "N"))
    by_speed = bool(further) and not np.array_equal(law(delta, 1.0, 0.0)["F_n"], curves[1.0])
    ax.set_title(PAIR + f", δ̇⁻ = {SPEED:g} m/s" * by_speed)


def _friction(ax: Axes, law: Function, chosen: Chosen) -> None:
    """F_t/F_n over the slip; with inner states over a slip that goes to and fro, and again."""
    speeds = [chosen.numbers[own.name] for own in chosen.law.parameters if _unit(own) == "m/s"]
    fastest = 3.0 * max(speeds, default=SPEED / 3.0)
    if not chosen.law.states:
        v_t = np.linspace(-fastest, fastest, 2 * POINTS)
        _line(ax, v_t, iter([(law(1.0, v_t)["F_t"], "F_t/F_n")]), ("v_t", "m/s"), ("F_t/F_n", ""))
        ax.set_title("the force on the journal by the slip of its surface on the bearing's")
        return
    for way in (2e-5, 2e-4):
        v_t, force = _to_and_fro(law, chosen.law, fastest, way)
        told = f"to and fro, {quantity(2 * way, 'm', 2)} apart"
        _line(ax, v_t, iter([(force, told)]), ("v_t", "m/s"), ("F_t/F_n", ""))
    ax.set_title("slip as a cosine, third time, F_n = 1 N: what is bent follows")


def _to_and_fro(law: Function, of: Law, fastest: float, way: float) -> tuple[Any, Any]:
    """v_t and F_t where the surfaces slip by ±way, at `fastest` in the middle; the states begin with none."""
    from scipy.integrate import solve_ivp

    omega = fastest / way

    def rates(t: float, z: Any) -> list[float]:
        found = law(1.0, fastest * np.cos(omega * t), *z)
        return [float(found[f"{state.name}_rate"]) for state in of.states]

    times = np.linspace(4.0 * np.pi, 6.0 * np.pi, 2 * POINTS) / omega
    none = [0.0] * len(of.states)
    try:
        found = solve_ivp(rates, (0.0, times[-1]), none, "Radau", t_eval=times, rtol=1e-6, atol=1e-12)
    except ValueError:  # rates, or their slopes, overflow
        found = None
    if found is None or found.y.shape[1] < len(times):
        names = ", ".join(state.name for state in of.states)
        raise BadValueError(f"nothing to draw: with these numbers {names} cannot be followed; its rate overflows")
    v_t = fastest * np.cos(omega * times)
    return v_t, law(1.0, v_t, *found.y)["F_t"]


def _film(ax: Axes, law: Function, chosen: Chosen) -> None:
    """Of a journal that turns, closes the gap, opens it; w = 1 1/s."""
    epsilon = np.linspace(0.01, 0.95, POINTS)
    turning, closing, opening = (law(epsilon, *w) for w in ((0.0, -0.5 * epsilon), (1.0, 0.0), (-1.0, 0.0)))
    lines = [
        (-turning["F_r"], "−F_r, turns"),
        (turning["F_t"], "F_t, turns"),
        (-closing["F_r"], "−F_r, gap closes"),
        (opening["F_r"], "F_r, gap opens"),
    ]
    if not any((y > 0.0).any() for y, _ in lines):
        raise BadValueError("nothing to draw: with these numbers all forces are 0")
    _line(ax, epsilon, iter(lines), ("ε", ""), ("F", "N"))
    ax.set_yscale("log")
    ax.set_title(f"{PAIR}; ω_s = 1 rad/s, or ε̇ = ±1 1/s")


def _mixed(ax: Axes, law: Function, chosen: Chosen) -> None:
    """The share of the dry contact over how deep the tips of the roughness lie in each other."""
    deepest = 7.0 * sum(x for name, x in chosen.numbers.items() if name.startswith("roughness"))
    delta = np.linspace(0.0, deepest, POINTS)
    shares = iter([(law(delta)["share"], "of the dry contact; the film has the rest")])
    _line(ax, delta, shares, ("δ, how deep the tips lie in each other", "m"), ("share b", ""))
    ax.set_title("share of the dry contact in force and moments")


_DRAWN = {"normal": _normal, "friction": _friction, "film": _film, "mixed": _mixed}
