"""Read the defaults of a scene's runs (`simulate:`), and estimate a default step for rk4.

The scene's t_end, output and step may depend on parameters (`t_end: 2*pi/omega`) of the run. The default step is
bounded by three time scales: the motion, the damping of a film near ε = 0 (rate about πS/(c m), RK4 is stable below
2.78 of it), and a dry contact's half period. `bench` and `map` measure the error of a step.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.language.tree import evaluate, from_json
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.model.sizes import compute_norm_weights

T_END = 1.0  # s, end of a scene's run by default
MAX_STEP_FRACTION = 2e-4  # of the run's length: largest step
MAX_STEP_TIMES_FILM_RATE = 1.0  # largest step times the rate of a film
MAX_CONTACT_FRACTION = 1.0 / 50.0  # of the duration of a contact: largest step
ASSUMED_IMPACT_SPEED = 0.1  # m/s, assumed for the duration of a contact


def evaluate_scene_option(source: KernelSource, name: str, p: Array, default: float) -> float:
    """Return the scene's t_end, output or step for the parameter values p; `default` if it gives none.

    An expression of parameters is evaluated; a number is returned as the file has it. Raises BadValueError, with the
    line, for an expression that has no valid value.
    """
    expression = next((info for info in source.simulate_expressions if info.address.rpartition(".")[2] == name), None)
    if expression is None:
        return float(source.simulate.get(name, default))
    values = {parameter.address: float(number) for parameter, number in zip(source.parameters, p, strict=False)}
    value = float(evaluate(from_json(json.loads(expression.tree)), lambda path: values[f"parameters.{path}"]))
    is_count = name == "output"
    if not (math.isfinite(value) and (value >= 1.0 and value == round(value) if is_count else value > 0.0)):
        expected = "a whole number, 1 or more" if is_count else "a positive time (s)"
        location = f"{expression.address} (line {expression.line}, column {expression.column})"
        raise BadValueError(f"{location} is {value:g} with this run's numbers: expected {expected}")
    return value


def evaluate_scene_end_time(source: KernelSource, p: Array) -> float:
    """Return the end (s) of a scene's run with parameter values p: that of the file, or T_END. Raises BadValueError."""
    return evaluate_scene_option(source, "t_end", p, T_END)


def evaluate_file_end_time(compiled: CompiledModel, parameters: Mapping[str, float | str] | None) -> float:
    """Return the end (s) that the file gives a scene's run with these parameters, or T_END.

    parameters: as in `simulate`; None: the values of the file. Raises an InputError for wrong ones.
    """
    return evaluate_scene_end_time(compiled.source, compute_parameter_values(compiled, parameters)[0])


def evaluate_scene_step(compiled: CompiledModel, p: Array, duration: float) -> float:
    """Return the step (s) of a scene's run with rk4: the file's, or the default. Raises BadValueError.

    `duration` of the run (s): T_END is used in place of values <= 0.
    """
    step = evaluate_scene_option(compiled.source, "step", p, 0.0)
    return step or estimate_default_step(compiled, p, duration if duration > 0.0 else T_END)


def estimate_default_step(compiled: CompiledModel, p: Array, t_end: float) -> float:
    """Return the largest step (s) for rk4 that all three time scales allow: of the motion, of films and of dry
    contacts.

    The bounds are 1e-3 s, MAX_STEP_FRACTION of t_end (s), MAX_STEP_TIMES_FILM_RATE over the damping rates of films and
    dampers, and MAX_CONTACT_FRACTION of the contact times. Contact times are those of Hertz's law at
    ASSUMED_IMPACT_SPEED, or of a linear spring. Rates and times use the effective mass of both bodies of a joint.
    """
    bounds = [MAX_STEP_FRACTION * t_end, 1e-3]
    mass = compute_norm_weights(compiled.source, p, compiled.mass(p))
    for joint in compiled.source.clearances:
        bodies = [compiled.source.bodies[b].index for b in (joint.first, joint.second) if b >= 0]
        inverse_mass = sum(1.0 / mass[k] + 0.25 * _find_longest_arm(compiled, p, k) ** 2 / mass[k + 2] for k in bodies)
        constants = {name: float(p[k]) for name, k in joint.constants.items()}
        if joint.film and "S" in constants:
            bounds.append(MAX_STEP_TIMES_FILM_RATE / (math.pi * constants["S"] / constants["c"] * inverse_mass))
        if joint.dry and "K" in constants:
            # Hertz: δ_max = (5 m v²/(4K))^(2/5), contact time 2.943 δ_max/v
            max_penetration = (1.25 * ASSUMED_IMPACT_SPEED**2 / (inverse_mass * constants["K"])) ** 0.4
            bounds.append(MAX_CONTACT_FRACTION * 2.943 * max_penetration / ASSUMED_IMPACT_SPEED)
        if joint.dry and "spring" in constants:
            bounds.append(MAX_CONTACT_FRACTION * math.pi / math.sqrt(inverse_mass * constants["spring"]))
        if joint.dry and "damper" in constants:
            bounds.append(MAX_STEP_TIMES_FILM_RATE / (inverse_mass * constants["damper"]))
    return min(bounds)


def _find_longest_arm(compiled: CompiledModel, p: Array, x_index: int) -> float:
    """Return the longest distance (m) of a body's points from its centre of mass; x_index: index of its x in q."""
    body = next(k for k, info in enumerate(compiled.source.bodies) if info.index == x_index)
    points = [point for point in compiled.source.points if point.body == body]
    lengths = [math.hypot(*(float(p[k]) if k >= 0 else 0.0 for k in (point.x, point.y))) for point in points]
    return max(lengths, default=0.0)
