"""Define the catalogue of time series: every name that a result has, its unit, its meaning and how it is computed.

    S9.x .y .theta   .vx .vy .omega   .ax .ay .alpha       of a body's centre of mass
    L1.head.x .y     .vx .vy          .ax .ay              of a point
    A.Fx .Fy .F .M                                         of an ideal joint: on the second body, ground axes
    A.Fx .Fy .F .Fn .Ft .e .ex .ey .delta .eps .deltadot .vt .state .deltadot_minus      with play
    way.front_upper.Fn …   way.Fx .Fy .F .M                the same at a slider's corner; sums over a guide's corners
    crank1.torque   lambda.A.x   energy.kinetic .potential .residual   work.drives .forces .clearances
    Phi.max   Phi_dot.max                                  how far the constraints are violated
    lift                                                   an output of the mechanism file

If a body has no mass, series that depend on masses are left out: reactions, torques, multipliers, energies and works.
The names depend on the scene alone; a series is computed on first access (`Series.compute`).
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
from gudgeon.contract.kernel_source import JointInfo, KernelSource
from gudgeon.errors import GudgeonError, UnknownNameError
from gudgeon.language import tree as expression_tree
from gudgeon.language.argument_checks import shorten_value
from gudgeon.language.names import find_near_names
from gudgeon.language.output_units import derive_unit
from gudgeon.model.evaluation import MotionSeries
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
    "Fn": (2, "N", "normal force: component along −n of the force on the journal, positive in compression"),
    "Ft": (3, "N", "tangential force, along e turned by +90°"),
    "ex": (4, "m", "eccentricity of the journal in its bearing, x in ground axes"),
    "ey": (5, "m", "eccentricity of the journal in its bearing, y in ground axes"),
    "e": (6, "m", "eccentricity"),
    "deltadot": (7, "m/s", "rate of the penetration"),
    "vt": (8, "m/s", "slip of the journal's surface on the bearing's"),
    "delta": (9, "m", "penetration: e less the radial clearance where the journal is"),
}
# what these mean at a slider's corner, n the outward normal of its wall
WALL_SERIES_MEANINGS = {
    "Fx": "force on the corner, x in ground axes",
    "Fy": "force on the corner, y in ground axes",
    "F": "force on the corner, magnitude",
    "Fn": "normal force, against n",
    "Ft": "force along n turned by +90°",
    "ex": "e n, x in ground axes",
    "ey": "e n, y in ground axes",
    "vt": "slip on its wall",
    "eps": "e by the gap",
    "e": "displacement towards its wall from the middle of the guide",
    "delta": "penetration: e less the gap",
}


@dataclass(frozen=True)
class Series:
    """A named quantity of a result: its unit, meaning, and a function that returns its values (N,) in SI."""

    unit: str
    meaning: str
    compute: Callable[[Result], Array]
    evaluation_fields: frozenset[str] = frozenset()  # fields of an Evaluation that it needs
    stored: tuple[str, int] | None = None  # (array of a Result, column) if the series is a column of it
    evaluated: tuple[str, tuple[int, ...]] | None = None  # (field of an Evaluation, column) if it is a column of it
    is_by_sample: bool = False  # computed sample by sample, so that samples of several runs may follow each other
    motion: MotionSeries | None = None  # body, axis and order of the derivative of a coordinate or a point


_catalogues: dict[int, tuple[Any, Mapping[str, Series]]] = {}  # by the id of a source; a callback would lose a Ctrl-C


def get_catalogue(source: KernelSource) -> Mapping[str, Series]:
    """Return all series of a scene by name, read-only, in the order of lists and files; cached for each source."""
    if (entry := _catalogues.get(id(source))) is None or entry[0]() is not source:
        for stale_key in [key for key, (reference, _) in list(_catalogues.items()) if reference() is None]:
            _catalogues.pop(stale_key, None)
        entry = _catalogues[id(source)] = weakref.ref(source), MappingProxyType(_build_catalogue(source))
    return entry[1]


def _build_catalogue(source: KernelSource) -> dict[str, Series]:
    """Return all series of a scene by name: motion of bodies and points, then forces and energies, then outputs.

    If a body has no mass, only motion, results of force elements and constraint drift remain. Outputs are left out if
    a name in their expression is missing.
    """
    series_by_name: dict[str, Series] = {}
    for series_of in (
        _iterate_body_series,
        _iterate_point_series,
        *(_MASSLESS_SERIES_ITERATORS if source.massless_bodies else _SERIES_ITERATORS),
    ):
        series_by_name.update(series_of(source))
    for name, expression_json in source.outputs.items():
        if not find_missing_names(source, expression_json, series_by_name):
            series_by_name[name] = _make_output_series(source, name, expression_json, series_by_name)
    return series_by_name


MASSLESS_HINT = "give every body mass: and inertia:, or a shape: with a density"


def explain_missing_masses(source: KernelSource) -> str:
    """Return why quantities that depend on masses are unknown ("S9 has no mass or no inertia"); "" if all are known."""
    if not source.massless_bodies:
        return ""
    names = source.massless_bodies
    return f"{', '.join(names)} {'has' if len(names) == 1 else 'have'} no mass or no inertia"


def find_missing_names(source: KernelSource, expression_json: Any, available_names: Container[str]) -> list[str]:
    """Return the names in an output's expression that this scene does not have, such as A.Fn where A has no play.
    `available_names` contains the names of series; parameters and t are always available.
    """
    parameter_names = {parameter.address.removeprefix("parameters.") for parameter in source.parameters} | {"t"}
    used_names = [name.path for name in expression_tree.iterate_names(expression_tree.from_json(expression_json))]
    return [path for path in dict.fromkeys(used_names) if path not in available_names and path not in parameter_names]


def find_rate_names(name: str) -> tuple[str, str]:
    """Return velocity and acceleration of a position by name: "S9.y" → ("S9.vy", "S9.ay"); ("", "") for others."""
    prefix, _, quantity = name.rpartition(".")
    for position, velocity, acceleration in MOTION:
        if prefix and quantity == position:
            return f"{prefix}.{velocity}", f"{prefix}.{acceleration}"
    return "", ""


def _iterate_body_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of positions, velocities and accelerations of each body's centre of mass."""
    for body in source.bodies:
        for axis in range(3):
            for order, array in enumerate(("q", "v", "a")):
                meaning = f"{body.name}, {MOTION_WORDS[order]}{_AXES[axis]} of the centre of mass"
                series = _make_stored_series(MOTION_UNITS[axis][order], meaning, array, body.index + axis)
                yield f"{body.name}.{MOTION[axis][order]}", series


_AXES = ("x", "y", "angle")


def _make_stored_series(unit: str, meaning: str, array: str, column: int) -> Series:
    """Return the series that is a column of an array of a Result: q, v, a, state, memory or work.

    Accelerations "a" may have to be evaluated. A column of q, v or a also gets `motion`, its body, axis and order.
    """
    evaluation_fields = frozenset({"a"} if array == "a" else ())
    compute, is_motion = partial(_get_stored_column, array=array, column=column), array in ("q", "v", "a")
    motion = MotionSeries("qva".index(array), column % 3, column - column % 3) if is_motion else None
    return Series(unit, meaning, compute, evaluation_fields, (array, column), motion=motion)


def _make_evaluated_series(unit: str, meaning: str, field: str, *index: int) -> Series:
    """Return the series that is a column of a field of the Evaluation: `field`[:, *index].

    For example field "reactions", index (joint, component).
    """
    compute = partial(_get_evaluated_column, field=field, index=index)
    return Series(unit, meaning, compute, frozenset({field}), None, (field, index))


def _get_stored_column(run: Result, array: str, column: int) -> Array:
    """Return a column (N,) of a stored array of the run."""
    values: Array = getattr(run, array)
    return values[:, column]


def _iterate_point_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of positions and, except on the ground, velocities and accelerations of each named point."""
    for point in source.points:
        for order in range(3 if point.body >= 0 else 1):  # a point of the ground rests
            for axis in range(2):
                meaning = f"point {point.name}, {MOTION_WORDS[order]}{_AXES[axis]} in ground axes"
                body = source.bodies[point.body].index if point.body >= 0 else -1
                motion = MotionSeries(order, axis, body, point.x, point.y, point.sign_x, point.sign_y)
                compute, evaluation_fields = (
                    partial(_compute_point_motion, motion=motion),
                    frozenset({"a"} if order == 2 else ()),
                )
                name, unit = f"{point.name}.{MOTION[axis][order]}", MOTION_UNITS[axis][order]
                yield name, Series(unit, meaning, compute, evaluation_fields, is_by_sample=True, motion=motion)


def _compute_point_motion(run: Result, motion: MotionSeries) -> Array:
    """Return a coordinate of a point, or its first or second time derivative, (N,), SI; evaluated in C.

    Empty for a run without samples. Raises GudgeonError for a result that was read from a file.
    """
    if not len(run.t):
        return np.zeros(0)
    if run.compiled is None:
        raise GudgeonError("this result was read from a file that lacks the series; run the scene again")
    states = [getattr(run, array) for array in "qva"[: motion.order + 1]] if motion.body >= 0 else []
    columns = [array[:, motion.body : motion.body + 3] for array in states]
    return run.compiled.evaluate_motion_series(motion, run.sample_counts, columns, run.p)


def _iterate_joint_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of the reactions Fx, Fy, M and F at joints without play, on the second body in ground axes.

    The meaning names the point where they act: the second body's own point, or else the pin.
    """
    for k, joint in enumerate(source.joints):
        is_own_point = joint.point.startswith(f"{source.bodies[joint.second].name if joint.second >= 0 else 'ground'}.")
        location = f"{_get_body_name(source, joint.second)} at {'its point' if is_own_point else 'the pin'}"
        location_text = f"joint {joint.name}, on {location}, ground axes"
        yield from _iterate_reaction_series(joint.name, k, "reaction", location_text)


def _iterate_guide_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of the resultant of the corner forces of each guide with play: Fx, Fy, M and F.

    They act on the second body at its point, in ground axes. The names are those of the reaction of a guide without
    play, such as "way.Fx".
    """
    second_body = {joint.joint: _get_body_name(source, joint.second) for joint in source.clearances}
    for k, name in enumerate(source.guides, len(source.joints)):
        yield from _iterate_reaction_series(
            name, k, "contact", f"all corners of {name}, on {second_body[name]} at its point, ground axes"
        )


def _iterate_reaction_series(name: str, row_index: int, force_kind: str, location: str) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) Fx, Fy, M and F of a joint or guide, from a row of Evaluation.reactions. `force_kind` and
    `location` are words of the meanings of the series.
    """
    for column, (component, unit, quantity) in enumerate(REACTION):
        series = _make_evaluated_series(unit, f"{force_kind} {quantity}: {location}", "reactions", row_index, column)
        yield f"{name}.{component}", series
    compute_magnitude, evaluation_fields = partial(_compute_magnitude, name=name), frozenset({"reactions"})
    meaning = f"{force_kind} force, magnitude: {location}"
    yield f"{name}.F", Series("N", meaning, compute_magnitude, evaluation_fields, is_by_sample=True)


def _get_body_name(source: KernelSource, body: int) -> str:
    """Return the name of a body; "the ground" for −1."""
    return source.bodies[body].name if body >= 0 else "the ground"


def _get_evaluated_column(run: Result, field: str, index: tuple[int, ...]) -> Array:
    """Return a column (N,) of a field of the run's Evaluation."""
    values: Array = getattr(run.evaluation, field)[(slice(None), *index)]
    return values


def _compute_magnitude(run: Result, name: str) -> Array:
    """Return the magnitude (N,) of the series name.Fx, name.Fy."""
    return np.hypot(run[f"{name}.Fx"], run[f"{name}.Fy"])


def _iterate_clearance_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of each joint with play or slider's corner: the columns of CLEARANCE, then F, eps, state
    and deltadot_minus.
    """
    for k, joint in enumerate(source.clearances):
        suffix, evaluation_fields = (
            f": {'corner' if joint.is_corner else 'joint'} {joint.name} with play",
            frozenset({"clearance"}),
        )
        meanings = (
            WALL_SERIES_MEANINGS
            if joint.is_corner
            else {"F": "force on the journal, magnitude", "eps": "eccentricity ratio e/c"}
        )
        for name, (column, unit, meaning) in CLEARANCE.items():
            series = _make_evaluated_series(unit, meanings.get(name, meaning) + suffix, "clearance", k, column)
            yield f"{joint.name}.{name}", series
        compute_magnitude = partial(_compute_magnitude, name=joint.name)
        yield (
            f"{joint.name}.F",
            Series("N", meanings["F"] + suffix, compute_magnitude, evaluation_fields, is_by_sample=True),
        )
        compute_ratio = partial(_compute_eccentricity_ratio, joint=joint)
        yield f"{joint.name}.eps", Series("", meanings["eps"] + suffix, compute_ratio, evaluation_fields)
        states = "0 free, 1 impact (until the penetration first stops growing), 2 contact"
        yield f"{joint.name}.state", _make_stored_series("", f"{states}{suffix}", "state", k)
        approach_speed = _make_stored_series("m/s", f"rate of penetration at the last onset{suffix}", "memory", k)
        yield f"{joint.name}.deltadot_minus", approach_speed


def _iterate_state_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of state variables of friction laws, such as bristle deflections.

    State variables without a name have no series.
    """
    first_index = len(source.clearances) + len(source.frictions)
    for k, name in enumerate(source.internal_states):
        if name:
            meaning = "internal state of the joint's friction law"
            yield name, _make_stored_series("m", meaning, "memory", first_index + k)


def _compute_eccentricity_ratio(run: Result, joint: ClearanceInfo) -> Array:
    """Return the eccentricity ratio e/c, (N,), of a joint with play."""
    return run[f"{joint.name}.e"] / run.p[joint.clearance]


def _iterate_drive_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of the torque of each rotational drive, and of the force of each other drive."""
    for k, drive in enumerate(source.drives):
        is_rotational = drive.unit == "rad"
        name, unit = ("torque", "N*m") if is_rotational else ("force", "N")
        yield f"{drive.name}.{name}", _make_evaluated_series(unit, f"{name} of drive {drive.name}", "torques", k)


def list_drive_series(source: KernelSource) -> list[str]:
    """Return the names of the series of the drives' torques and forces, such as ["crank1.torque"]."""
    return [name for name, _ in _iterate_drive_series(source)]


def _iterate_friction_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of each set-valued friction element: force F, slip v and mode."""
    first_index = len(source.clearances)
    for k, name in enumerate(source.frictions):
        yield f"{name}.F", _make_evaluated_series("N", "friction on the second body", "friction", k, 0)
        yield f"{name}.v", _make_evaluated_series("m/s", "slip", "friction", k, 1)
        modes = "0 stick, 2 held at rest by other constraints, else the sign of the slip"
        yield f"{name}.mode", _make_stored_series("", modes, "memory", first_index + k)


def _iterate_element_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of each result that a force element declares, such as the length of a spring."""
    for k, series in enumerate(source.series):
        yield series.name, _make_evaluated_series(series.unit, "result of a force element", "series", k)


def _iterate_multiplier_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of the Lagrange multiplier of each constraint equation: "lambda.NAME"."""
    for k, row in enumerate(source.equations):
        unit = "N" if row.unit == "m" else "N*m"
        yield (
            f"lambda.{row.name}",
            _make_evaluated_series(unit, f"multiplier of the constraint {row.name}", "multipliers", k),
        )


def _iterate_energy_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of kinetic and potential energy, the residual of the energy balance, and the works."""
    for k, name in enumerate(("kinetic", "potential")):
        yield f"energy.{name}", _make_evaluated_series("J", f"{name} energy", "energy", k)
    meaning_of_residual = "kinetic + potential energy less their start less all work"
    yield "energy.residual", Series("J", meaning_of_residual, _compute_energy_residual, frozenset({"energy"}))
    for k, name in enumerate(("drives", "forces", "clearances")):
        meaning = f"work done so far by the {'joints with play' if name == 'clearances' else name}"
        yield f"work.{name}", _make_stored_series("J", meaning, "work", k)


DRIFT = ("Phi.max", "Phi_dot.max")


def _iterate_drift_series(source: KernelSource) -> Iterator[tuple[str, Series]]:
    """Yield (name, series) of the constraint drift: the largest |Φ| and |Φ̇| over all equations, m and rad alike."""
    units = ("|Φ|: m for lengths, rad for angles", "|Φ̇|: m/s for lengths, rad/s for angles")
    for k, name in enumerate(DRIFT):
        yield name, _make_evaluated_series("", f"drift, the largest {units[k]}", "drift", k)


# series in addition to motion, with masses and without
_SERIES_ITERATORS = (
    _iterate_joint_series,
    _iterate_clearance_series,
    _iterate_guide_series,
    _iterate_state_series,
    _iterate_drive_series,
    _iterate_element_series,
    _iterate_friction_series,
    _iterate_multiplier_series,
    _iterate_energy_series,
    _iterate_drift_series,
)
_MASSLESS_SERIES_ITERATORS = (_iterate_element_series, _iterate_drift_series)


def _compute_energy_residual(run: Result) -> Array:
    """Return the energy residual (N,), J: the change of kinetic plus potential energy since the start, less all work.

    The start is `start_row` if that is not among the samples.
    """
    energy, initial = (x["energy.kinetic"] + x["energy.potential"] for x in (run, run.start_row or run))
    return energy - initial[0] - (run["work.drives"] + run["work.forces"] + run["work.clearances"])


def _make_output_series(
    source: KernelSource, name: str, expression_json: Any, series_by_name: Mapping[str, Series]
) -> Series:
    """Return the series of an output of the mechanism file, with the unit that follows from its expression.

    `series_by_name` has the series that the expression may name.
    """
    expression = expression_tree.from_json(expression_json)
    used_names = {name_node.path for name_node in expression_tree.iterate_names(expression)}
    units = {"t": "s"} | {path: series_by_name[path].unit for path in used_names if path in series_by_name}
    units |= {parameter.address.removeprefix("parameters."): parameter.unit for parameter in source.parameters}
    units |= {parameter.address: parameter.unit for parameter in source.parameters}

    def compute(run: Result) -> Array:
        """Return the values (N,) of the expression at the samples of a run."""
        values = expression_tree.evaluate(expression, run.value_of)
        return np.array(np.broadcast_to(values, run.t.shape), dtype=float)

    evaluation_fields = frozenset(
        part for path in used_names if path in series_by_name for part in series_by_name[path].evaluation_fields
    )
    return Series(derive_unit(expression, units.get), f"output {name}", compute, evaluation_fields)


def make_unknown_series_error(
    source: KernelSource, available_series: Mapping[str, Series], name: Any, parameter_names: Iterable[str]
) -> UnknownNameError:
    """Return, without raising it, the error for a name that is not in `available_series`.

    The message gives the reason: no text, a parameter, an output with missing names, or a body without mass. Otherwise
    it suggests similar names.
    """
    if not isinstance(name, str):
        message = f"no series {shorten_value(name)}: the name must be a text"
        return UnknownNameError(message, hint="run.names lists all names")
    if name in parameter_names:
        similar_series = ", ".join(path for path in available_series if path.rpartition(".")[2] == name)
        hint = f'its value is run.parameters["{name}"]' + (f"; series: {similar_series}" if similar_series else "")
        return UnknownNameError(f"{name!r} is a parameter, not a series", hint=hint)
    if name in source.outputs:
        missing = ", ".join(find_missing_names(source, source.outputs[name], available_series))
        hint = "a joint's play, contact and reaction have results only in the scenes that have them"
        hint = MASSLESS_HINT if source.massless_bodies else hint
        return UnknownNameError(f"output {name!r} needs {missing}, which scene {source.scene!r} lacks", hint=hint)
    if (reason := explain_missing_masses(source)) and name in get_catalogue(replace(source, massless_bodies=())):
        return UnknownNameError(f"{name!r} is not known: {reason}", hint=MASSLESS_HINT)
    nearest_names = find_near_names(name, available_series)
    hint = f"nearest: {', '.join(nearest_names)}" if nearest_names else "run.names lists all names"
    return UnknownNameError(f"the scene {source.scene!r} has nothing named {name!r}", hint=hint)


def check_series(source: KernelSource, names: Iterable[Any]) -> tuple[str, ...]:
    """Return names of series as a tuple, each once. Raises UnknownNameError for a name that the scene lacks."""
    available, name_list = get_catalogue(source), list(names)
    for name in name_list:
        if not isinstance(name, str) or name not in available:
            raise make_unknown_series_error(source, available, name, list_parameter_names(source))
    return tuple(dict.fromkeys(name_list))


def list_parameter_names(source: KernelSource) -> set[str]:
    """Return the addresses of a scene's run-time parameters, and the short names of its `parameters`."""
    addresses = {parameter.address for parameter in source.parameters}
    return addresses | {address.removeprefix("parameters.") for address in addresses}


def choose_default_series(reference: Result) -> tuple[str, ...]:
    """Return the names of the series to show by default.

    Each slider on the ground has its x or y, whichever has the larger range in the run `reference`. Without such
    sliders they are the outputs, or else the angle of the last body.
    """
    slider_series, source = [], reference.source
    guided_bodies = [joint.second for joint in source.clearances if joint.is_corner and joint.first < 0]
    for k in [joint.second for joint in find_ideal_translational_joints(source) if joint.first < 0] + guided_bodies:
        body = source.bodies[k].name
        slider_series.append(max((f"{body}.x", f"{body}.y"), key=lambda name: float(np.ptp(reference[name]))))
    last_body = reference.source.bodies[-1].name
    return tuple(dict.fromkeys(slider_series)) or tuple(reference.source.outputs) or (f"{last_body}.theta",)


def find_ideal_translational_joints(source: KernelSource) -> list[JointInfo]:
    """Return the translational joints without play.

    The kind is a literal here, since a run from the cache does not import the joints' declarations of the generator.
    """
    return [joint for joint in source.joints if joint.kind == "translational"]
