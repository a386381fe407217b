"""Own the catalogue of series: every name that a result has, its unit, its meaning and how it is computed.

    S9.x .y .theta   .vx .vy .omega   .ax .ay .alpha       of a body's centre of mass
    L1.head.x .y     .vx .vy          .ax .ay              of a point
    A.Fx .Fy .F .M                                         of an ideal joint: on the second body, ground axes
    A.Fx .Fy .F .Fn .Ft .e .ex .ey .delta .eps .deltadot .vt .state .deltadot_minus      with play
    way.front_upper.Fn …   way.Fx .Fy .F .M                the same of a slider's corner; of its guide their sum
    crank1.torque   lambda.A.x   energy.kinetic .potential .residual   work.drives .forces .clearances
    Phi.max   Phi_dot.max                                  how far the constraints are violated
    lift                                                   an output of the mechanism file

If a body has no mass, series that depend on masses are left out: reactions, torques, multipliers, energies and works.
The names depend on the scene alone; a series is computed on first access (`Series.compute`).

Also the spectrum of a series at even times, and the low-pass filter of an accelerometer.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import JointInfo, KernelSource, PointInfo
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language import tree as expression_tree
from gudgeon.language.argument_checks import message, refuse, text, whole
from gudgeon.language.names import near
from gudgeon.language.output_units import unit_of
from gudgeon.results.state import Array

if TYPE_CHECKING:
    from gudgeon.results.results import Result

# (position, velocity, acceleration) and their units, in the order of q = (x, y, θ) of a body
MOTION = (("x", "vx", "ax"), ("y", "vy", "ay"), ("theta", "omega", "alpha"))
MOTION_UNITS = (("m", "m/s", "m/s^2"), ("m", "m/s", "m/s^2"), ("rad", "rad/s", "rad/s^2"))
MOTION_WORDS = ("", "velocity, ", "acceleration, ")

REACTION = (("Fx", "N", "force, x"), ("Fy", "N", "force, y"), ("M", "N*m", "moment"))  # columns of Evaluation.reactions
# columns of Evaluation.clearance: name -> (column, unit, meaning)
CLEARANCE = {
    "Fx": (0, "N", "force on the journal, x in ground axes"),
    "Fy": (1, "N", "force on the journal, y in ground axes"),
    "Fn": (2, "N", "normal force: its magnitude in dry contact, its component along e in a film"),
    "Ft": (3, "N", "tangential force, along e turned by +90°"),
    "ex": (4, "m", "eccentricity of the journal in its bearing, x in ground axes"),
    "ey": (5, "m", "eccentricity of the journal in its bearing, y in ground axes"),
    "e": (6, "m", "eccentricity"),
    "deltadot": (7, "m/s", "rate of the penetration"),
    "vt": (8, "m/s", "slip of the journal's surface on the bearing's"),
    "delta": (9, "m", "penetration: e less the radial clearance where the journal is"),
}
# what these mean at a slider's corner, n the outward normal of its wall
AT_WALL = {
    "Fx": "force on the corner, x in ground axes",
    "Fy": "force on the corner, y in ground axes",
    "F": "force on the corner, magnitude",
    "Fn": "normal force, against n",
    "Ft": "force along n turned by +90°",
    "ex": "e n, x in ground axes",
    "ey": "e n, y in ground axes",
    "vt": "slip on its wall",
    "eps": "e by the gap",
    "e": "how far it is nearer to its wall than in the middle of the guide",
    "delta": "penetration: e less the gap",
}
EVEN = 1e-6  # of an interval: samples that far from even are not
WINDOWS = ("boxcar", "hann", "hamming", "blackman", "blackmanharris", "flattop")
MOST_ORDER = 16


@dataclass(frozen=True)
class Series:
    """A named quantity of a result: its unit, meaning, and the function `compute` that returns its (N,) values in
    SI.
    """

    unit: str
    meaning: str
    compute: Callable[[Result], Array]
    parts: frozenset[str] = frozenset()  # of an Evaluation, all that it needs
    stored: tuple[str, int] | None = None  # the array of a run, and its column, that it is
    evaluated: tuple[str, tuple[int, ...]] | None = None  # the part of an Evaluation, and its column


_catalogues: dict[int, tuple[Any, Mapping[str, Series]]] = {}  # by the id of a source; a callback would lose a Ctrl-C


def catalogue(source: KernelSource) -> Mapping[str, Series]:
    """Return all series of a scene by name, in the order of lists and files; cached for each source."""
    if (kept := _catalogues.get(id(source))) is None or kept[0]() is not source:
        for gone in [key for key, (lives, _) in list(_catalogues.items()) if lives() is None]:
            _catalogues.pop(gone, None)
        kept = _catalogues[id(source)] = weakref.ref(source), MappingProxyType(_build_catalogue(source))
    return kept[1]


def _build_catalogue(source: KernelSource) -> dict[str, Series]:
    """Return all series of a scene by name: those of bodies, points and, with masses, of forces; then outputs."""
    found: dict[str, Series] = {}
    for part in (_body_series, _point_series, *(_MOTION_ALONE if source.massless else _PARTS)):
        found.update(part(source))
    for name, tree in source.outputs.items():
        if not missing_names(source, tree, found):
            found[name] = _output_series(source, name, tree, found)
    return found


MASSLESS_HINT = "give every body mass: and inertia:, or a shape: with a density"


def without_masses(source: KernelSource) -> str:
    """Return the reason why quantities that depend on masses are unknown; "" if all bodies have masses."""
    if not source.massless:
        return ""
    return f"{', '.join(source.massless)} {'has' if len(source.massless) == 1 else 'have'} no mass or no inertia"


def missing_names(source: KernelSource, tree: Any, known: Container[str]) -> list[str]:
    """Return the names in an output's expression that this scene does not have, such as A.Fn where A has no play."""
    parameters = {slot.address.removeprefix("parameters.") for slot in source.slots} | {"t"}
    used = [name.path for name in expression_tree.names(expression_tree.from_json(tree))]
    return [path for path in dict.fromkeys(used) if path not in known and path not in parameters]


def rates(name: str) -> tuple[str, str]:
    """Return the names of velocity and acceleration of a position: "S9.y" → ("S9.vy", "S9.ay"); "" for other names."""
    owner, _, last = name.rpartition(".")
    for position, velocity, acceleration in MOTION:
        if owner and last == position:
            return f"{owner}.{velocity}", f"{owner}.{acceleration}"
    return "", ""


def _body_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of positions, velocities and accelerations of each body's centre of mass."""
    for body in source.bodies:
        for axis in range(3):
            for order, array in enumerate(("q", "v", "a")):
                meaning = f"{body.name}, {MOTION_WORDS[order]}{_AXES[axis]} of the centre of mass"
                series = _stored_series(MOTION_UNITS[axis][order], meaning, array, body.index + axis)
                yield f"{body.name}.{MOTION[axis][order]}", series


_AXES = ("x", "y", "angle")


def _stored_series(unit: str, meaning: str, array: str, column: int) -> Series:
    """Return a series that is a column of q, v, a, state, memory or work.

    Accelerations may have to be evaluated.
    """
    parts = frozenset({"a"} if array == "a" else ())
    return Series(unit, meaning, partial(_stored_column, array=array, column=column), parts, (array, column))


def _evaluated_series(unit: str, meaning: str, part: str, *index: int) -> Series:
    """Return a series that is a column of a part of the Evaluation."""
    return Series(
        unit, meaning, partial(_evaluated_column, part=part, index=index), frozenset({part}), None, (part, index)
    )


def _stored_column(run: Result, array: str, column: int) -> Array:
    """Return a column (N,) of a stored array of the run."""
    values: Array = getattr(run, array)
    return values[:, column]


def _point_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of positions, velocities and accelerations of each named point."""
    for point in source.points:
        for order in range(3 if point.body >= 0 else 1):  # a point of the ground rests
            for axis in range(2):
                meaning = f"point {point.name}, {MOTION_WORDS[order]}{_AXES[axis]} in ground axes"
                compute = partial(point_motion, point=point, axis=axis, order=order)
                parts = frozenset({"a"} if order == 2 else ())
                yield f"{point.name}.{MOTION[axis][order]}", Series(MOTION_UNITS[axis][order], meaning, compute, parts)


def point_motion(run: Result, point: PointInfo, axis: int, order: int) -> Array:
    """Return a coordinate of a point, or its first or second time derivative (order 0, 1, 2), (N,).

    r_P = r + A(θ) s with s = (x, y) in the body's frame; axis 0 is x, 1 is y in ground axes.
    """
    x = point.sign_x * float(run.p[point.x]) if point.x >= 0 else 0.0
    y = point.sign_y * float(run.p[point.y]) if point.y >= 0 else 0.0
    if point.body < 0:
        return np.full(run.t.shape, (x, y)[axis])
    i = run.source.bodies[point.body].index
    sin, cos = np.sin(run.q[:, i + 2]), np.cos(run.q[:, i + 2])
    arm = (cos * x - sin * y, sin * x + cos * y)
    turned = (-arm[1], arm[0])[axis]  # d arm / dθ
    if order == 0:
        return run.q[:, i + axis] + arm[axis]
    if order == 1:
        return run.v[:, i + axis] + run.v[:, i + 2] * turned
    return run.a[:, i + axis] + run.a[:, i + 2] * turned - run.v[:, i + 2] ** 2 * arm[axis]


def _joint_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of the reactions at joints without play."""
    for k, joint in enumerate(source.joints):
        own = joint.point.startswith(f"{source.bodies[joint.second].name if joint.second >= 0 else 'ground'}.")
        on = f"{_body_name(source, joint.second)} at {'its point' if own else 'the pin'}"
        yield from _reaction_series(joint.name, k, "reaction", f"joint {joint.name}, on {on}, ground axes")


def _guide_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the summed corner forces of each guide with play, named like the reaction of an ideal joint."""
    second = {joint.joint: _body_name(source, joint.second) for joint in source.clearances}
    for k, name in enumerate(source.guides, len(source.joints)):
        yield from _reaction_series(
            name, k, "contact", f"all corners of {name}, on {second[name]} at its point, ground axes"
        )


def _reaction_series(name: str, row: int, kind: str, on: str) -> Iterator[tuple[str, Series]]:
    """Yield the series Fx, Fy, M and F of one joint or guide, from row `row` of Evaluation.reactions."""
    for column, (last, unit, what) in enumerate(REACTION):
        yield f"{name}.{last}", _evaluated_series(unit, f"{kind} {what}: {on}", "reactions", row, column)
    magnitude = partial(_magnitude, name=name)
    yield f"{name}.F", Series("N", f"{kind} force, magnitude: {on}", magnitude, frozenset({"reactions"}))


def _body_name(source: KernelSource, body: int) -> str:
    """Return the name of a body; "the ground" for −1."""
    return source.bodies[body].name if body >= 0 else "the ground"


def _evaluated_column(run: Result, part: str, index: tuple[int, ...]) -> Array:
    """Return a column (N,) of a part of the run's Evaluation."""
    values: Array = getattr(run.evaluation, part)[(slice(None), *index)]
    return values


def _magnitude(run: Result, name: str) -> Array:
    """Return the magnitude (N,) of the series name.Fx, name.Fy."""
    return np.hypot(run[f"{name}.Fx"], run[f"{name}.Fy"])


def _clearance_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of each joint with play: forces, eccentricity, penetration, contact state."""
    for k, joint in enumerate(source.clearances):
        at, parts = f": {'corner' if joint.at_wall else 'joint'} {joint.name} with play", frozenset({"clearance"})
        message = (
            AT_WALL if joint.at_wall else {"F": "force on the journal, magnitude", "eps": "eccentricity ratio e/c"}
        )
        for name, (column, unit, meaning) in CLEARANCE.items():
            yield (
                f"{joint.name}.{name}",
                _evaluated_series(unit, message.get(name, meaning) + at, "clearance", k, column),
            )
        yield f"{joint.name}.F", Series("N", message["F"] + at, partial(_magnitude, name=joint.name), parts)
        yield f"{joint.name}.eps", Series("", message["eps"] + at, partial(_eccentricity_ratio, joint=joint), parts)
        states = "0 free, 1 impact (until the penetration first stops growing), 2 contact"
        yield f"{joint.name}.state", _stored_series("", f"{states}{at}", "state", k)
        latched = _stored_series("m/s", f"rate of penetration at the last onset{at}", "memory", k)
        yield f"{joint.name}.deltadot_minus", latched


def _state_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of the state variables of friction laws, such as bristle deflections."""
    first = len(source.clearances) + len(source.frictions)
    for k, name in enumerate(source.states):
        if name:
            yield name, _stored_series("m", "inner state of the joint's law of friction", "memory", first + k)


def _eccentricity_ratio(run: Result, joint: ClearanceInfo) -> Array:
    """Return the eccentricity ratio e/c, (N,), of a joint with play."""
    return run[f"{joint.name}.e"] / run.p[joint.clearance]


def _drive_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of the torque or force of each drive."""
    for k, drive in enumerate(source.drives):
        turns = drive.unit == "rad"
        name, unit = ("torque", "N*m") if turns else ("force", "N")
        yield f"{drive.name}.{name}", _evaluated_series(unit, f"{name} of drive {drive.name}", "torques", k)


def drive_series(source: KernelSource) -> list[str]:
    """Return the names of the series of the drives' torques and forces."""
    return [name for name, _ in _drive_series(source)]


def _friction_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of each friction element: force, slip and mode."""
    first = len(source.clearances)
    for k, name in enumerate(source.frictions):
        yield f"{name}.F", _evaluated_series("N", "friction on the second body", "friction", k, 0)
        yield f"{name}.v", _evaluated_series("m/s", "slip", "friction", k, 1)
        modes = "0 stick, 2 at rest by other rows, else the sign of the slip"
        yield f"{name}.mode", _stored_series("", modes, "memory", first + k)


def _element_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of results of force elements."""
    for k, series in enumerate(source.series):
        yield series.name, _evaluated_series(series.unit, "result of a force element", "series", k)


def _multiplier_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of the Lagrange multiplier of each constraint equation."""
    for k, row in enumerate(source.rows):
        unit = "N" if row.unit == "m" else "N*m"
        yield (
            f"lambda.{row.name}",
            _evaluated_series(unit, f"multiplier of the constraint {row.name}", "multipliers", k),
        )


def _energy_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the series of energies, works and the energy residual."""
    for k, name in enumerate(("kinetic", "potential")):
        yield f"energy.{name}", _evaluated_series("J", f"{name} energy", "energy", k)
    message = "kinetic + potential energy less their start less all work"
    yield "energy.residual", Series("J", message, _energy_residual, frozenset({"energy"}))
    for k, name in enumerate(("drives", "forces", "clearances")):
        meaning = f"work done so far by the {'joints with play' if name == 'clearances' else name}"
        yield f"work.{name}", _stored_series("J", meaning, "work", k)


DRIFT = ("Phi.max", "Phi_dot.max")


def _drift_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield the constraint drift, the largest |Φ| and |Φ̇|; lengths and angles count as numbers."""
    what = ("|Φ|: m of rows of lengths, rad of rows of angles", "|Φ̇|: m/s of rows of lengths, rad/s of rows of angles")
    for k, name in enumerate(DRIFT):
        yield name, _evaluated_series("", f"drift, the largest {what[k]}", "drift", k)


# series in addition to motion, with masses and without
_PARTS = (
    _joint_series,
    _clearance_series,
    _guide_series,
    _state_series,
    _drive_series,
    _element_series,
    _friction_series,
    _multiplier_series,
    _energy_series,
    _drift_series,
)
_MOTION_ALONE = (_element_series, _drift_series)


def _energy_residual(run: Result) -> Array:
    """Return the energy residual (N,), J: kinetic plus potential energy, less their start, less all work."""
    energy, first = (one["energy.kinetic"] + one["energy.potential"] for one in (run, run.start_row or run))
    return energy - first[0] - (run["work.drives"] + run["work.forces"] + run["work.clearances"])


def _output_series(source: KernelSource, name: str, tree: Any, known: Mapping[str, Series]) -> Series:
    """Return the series of an output of the mechanism file, with the unit of its expression."""
    expression = expression_tree.from_json(tree)
    expected = {used.path for used in expression_tree.names(expression)}
    units = {"t": "s"} | {path: known[path].unit for path in expected if path in known}
    units |= {slot.address.removeprefix("parameters."): slot.unit for slot in source.slots}
    units |= {slot.address: slot.unit for slot in source.slots}

    def compute(run: Result) -> Array:
        """Return the values (N,) of the expression at the samples of a run."""
        values = expression_tree.evaluate(expression, run.value_of)
        return np.array(np.broadcast_to(values, run.t.shape), dtype=float)

    parts = frozenset(part for path in expected if path in known for part in known[path].parts)
    return Series(unit_of(expression, units.get), f"output {name}", compute, parts)


def unknown_series(
    source: KernelSource, known: Mapping[str, Series], name: Any, parameters: Iterable[str]
) -> UnknownNameError:
    """Return the error for a name that is not in `known`, with the nearest names and the reason."""
    if not isinstance(name, str):
        return UnknownNameError(f"nothing is named {message(name)}", hint="a name is a text: run.names lists all")
    if name in parameters:
        alike = ", ".join(path for path in known if path.rpartition(".")[2] == name)
        hint = f'its value is run.parameters["{name}"]' + (f"; series: {alike}" if alike else "")
        return UnknownNameError(f"{name!r} is a parameter, no series", hint=hint)
    if name in source.outputs:
        lacking = ", ".join(missing_names(source, source.outputs[name], known))
        hint = "a joint's play, contact and reaction have results only in the scenes that have them"
        hint = MASSLESS_HINT if source.massless else hint
        return UnknownNameError(f"output {name!r} needs {lacking}, which scene {source.scene!r} lacks", hint=hint)
    if (why := without_masses(source)) and name in catalogue(replace(source, massless=())):
        return UnknownNameError(f"{name!r} is not known: {why}", hint=MASSLESS_HINT)
    found = near(name, known)
    hint = f"nearest: {', '.join(found)}" if found else "run.names lists all names"
    return UnknownNameError(f"the scene {source.scene!r} has nothing named {name!r}", hint=hint)


def check_series(source: KernelSource, names: Iterable[Any]) -> tuple[str, ...]:
    """Return names of series without repetitions. Raises UnknownNameError for a name that the scene lacks."""
    known, expected = catalogue(source), list(names)
    for name in expected:
        if not isinstance(name, str) or name not in known:
            raise unknown_series(source, known, name, parameter_names(source))
    return tuple(dict.fromkeys(expected))


def parameter_names(source: KernelSource) -> set[str]:
    """Return the addresses of a scene's run-time parameters, and the short names of its `parameters`."""
    addresses = {slot.address for slot in source.slots}
    return addresses | {address.removeprefix("parameters.") for address in addresses}


def default_watch(reference: Result) -> tuple[str, ...]:
    """Return the series to show by default: the coordinate of each slider on the ground that moves further; else
    outputs.
    """
    found, source = [], reference.source
    guided = [joint.second for joint in source.clearances if joint.at_wall and joint.first < 0]
    for k in [joint.second for joint in rigid_guides(source) if joint.first < 0] + guided:
        body = source.bodies[k].name
        found.append(max((f"{body}.x", f"{body}.y"), key=lambda name: float(np.ptp(reference[name]))))
    last = reference.source.bodies[-1].name
    return tuple(dict.fromkeys(found)) or tuple(reference.source.outputs) or (f"{last}.theta",)


def rigid_guides(source: KernelSource) -> list[JointInfo]:
    """Return the joints without play of the kind whose play is that of a guide.

    The kind is named here, since a warm run does not import the generator, which has the joints' declarations.
    """
    return [joint for joint in source.joints if joint.kind == "translational"]


def rate_of(t: Array) -> float:
    """Return the sampling rate, Hz. Raises BadValueError for samples at uneven times or fewer than nine."""
    steps = np.diff(t)
    if len(steps) < 8 or not np.all(np.abs(steps - steps.mean()) <= EVEN * steps.mean()):
        message = "a spectrum or a filter takes nine samples at even times or more"
        raise BadValueError(
            message, hint="simulate(…, output=N) has equal intervals; an event that ends a run adds one"
        )
    return float(1.0 / steps.mean())


def spectrum(t: Array, values: Array, window: str = "hann") -> tuple[Array, Array]:
    """Return frequencies (Hz) and amplitudes (M,) of a series; a sine of amplitude A on a line has the amplitude A.

    The spectrum is one-sided, of the values less their mean, under a window of scipy.signal.windows divided by its
    mean.
    """
    from scipy.signal import get_window

    if text(window, "window") not in WINDOWS:
        refuse("window", window, f"one of {', '.join(WINDOWS)}")
    rate, weights = rate_of(t), get_window(window, len(t))
    check_finite(values)
    found = np.abs(np.fft.rfft((values - values.mean()) * weights)) / weights.sum()
    found[1 : (len(t) + 1) // 2] *= 2.0  # what is at −f, but for that at half the rate
    return np.fft.rfftfreq(len(t), 1.0 / rate), found


def low_pass(t: Array, values: Array, cutoff: float, order: int = 2, causal: bool = True) -> Array:
    """Return a series (N,) after a Butterworth low-pass with −3 dB at `cutoff` (Hz).

    `causal`: one pass forwards, as in an amplifier, with its phase lag, from rest at the first value. Otherwise
    forwards and backwards without phase, with a cutoff such that both passes together have −3 dB there. Raises
    BadValueError for a cutoff above half the sampling rate.
    """
    from scipy.signal import butter, sosfilt, sosfilt_zi, sosfiltfilt

    rate, order = rate_of(t), whole(order, "order", 1, MOST_ORDER)
    check_finite(values)
    if not 0.0 < cutoff < 0.499 * rate:
        message = f"cutoff: {cutoff:g} Hz with {rate:g} samples a second: expected one below half of that"
        raise BadValueError(message, hint="simulate with a larger output")
    warped = np.tan(np.pi * cutoff / rate)  # of the bilinear transform
    if not causal:
        warped *= (2.0**0.5 - 1.0) ** (-1.0 / (2.0 * order))
    design = float(np.arctan(warped)) / np.pi * rate
    sections = butter(order, design, fs=rate, output="sos")
    if causal:
        found: Array = sosfilt(sections, values, zi=sosfilt_zi(sections) * values[0])[0]
        return found
    back: Array = sosfiltfilt(sections, values)
    return back


def check_finite(values: Array) -> None:
    """Raise BadValueError unless all values are finite."""
    if not np.isfinite(values).all():
        raise BadValueError("a series with values that are no numbers has no spectrum")
