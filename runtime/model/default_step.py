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
from gudgeon.model.parameters import prepare
from gudgeon.model.sizes import metric

T_END = 1.0  # s, end of a scene's run by default
SMOOTH = 2e-4  # of the run's length: largest step
FILM = 1.0  # largest step times the rate of a film
CONTACT = 1.0 / 50.0  # of the duration of a contact: largest step
IMPACT_SPEED = 0.1  # m/s, assumed for the duration of a contact


def scene_number(source: KernelSource, name: str, p: Array, otherwise: float) -> float:
    """Return the scene's t_end, output or step for the parameter values p; `otherwise` if it gives none.

    Raises BadValueError, with the line, for an expression that has no valid value.
    """
    written = next((one for one in source.simulate_written if one.address.rpartition(".")[2] == name), None)
    if written is None:
        return float(source.simulate.get(name, otherwise))
    values = {slot.address: float(number) for slot, number in zip(source.slots, p, strict=False)}
    found = float(evaluate(from_json(json.loads(written.tree)), lambda path: values[f"parameters.{path}"]))
    whole = name == "output"
    if not (math.isfinite(found) and (found >= 1.0 and found == round(found) if whole else found > 0.0)):
        expected = "a whole number, 1 or more" if whole else "a positive time (s)"
        where = f"{written.address} (line {written.line}, column {written.column})"
        raise BadValueError(f"{where} is {found:g} with this run's numbers: expected {expected}")
    return found


def scene_end(source: KernelSource, p: Array) -> float:
    """Return the end (s) of a scene's run with parameter values p: as the file says, or T_END."""
    return scene_number(source, "t_end", p, T_END)


def plain_end(compiled: CompiledModel, parameters: Mapping[str, float | str] | None) -> float:
    """Return the end (s) of a scene's run with these parameters, given as in `simulate`."""
    return scene_end(compiled.source, prepare(compiled, parameters)[0])


def scene_step(compiled: CompiledModel, p: Array, duration: float) -> float:
    """Return the step (s) of a scene's run with rk4: the file's, or the default."""
    own = scene_number(compiled.source, "step", p, 0.0)
    return own or default_step(compiled, p, duration if duration > 0.0 else T_END)


def default_step(compiled: CompiledModel, p: Array, t_end: float) -> float:
    """Return the largest step (s) that all three time scales allow."""
    bounds = [SMOOTH * t_end, 1e-3]
    mass = metric(compiled.source, p, compiled.mass(p))
    for joint in compiled.source.clearances:
        bodies = [compiled.source.bodies[b].index for b in (joint.first, joint.second) if b >= 0]
        inverse = sum(1.0 / mass[k] + 0.25 * _longest_arm(compiled, p, k) ** 2 / mass[k + 2] for k in bodies)
        numbers = {name: float(p[k]) for name, k in joint.constants.items()}
        if joint.film and "S" in numbers:
            bounds.append(FILM / (math.pi * numbers["S"] / numbers["c"] * inverse))
        if joint.dry and "K" in numbers:
            # Hertz: δ_max = (5 m v²/(4K))^(2/5), contact time 2.943 δ_max/v
            deepest = (1.25 * IMPACT_SPEED**2 / (inverse * numbers["K"])) ** 0.4
            bounds.append(CONTACT * 2.943 * deepest / IMPACT_SPEED)
        if joint.dry and "spring" in numbers:
            bounds.append(CONTACT * math.pi / math.sqrt(inverse * numbers["spring"]))
        if joint.dry and "damper" in numbers:
            bounds.append(FILM / (inverse * numbers["damper"]))
    return min(bounds)


def _longest_arm(compiled: CompiledModel, p: Array, index: int) -> float:
    """Return the longest distance (m) of a body's points from its centre of mass."""
    body = next(k for k, info in enumerate(compiled.source.bodies) if info.index == index)
    points = [point for point in compiled.source.points if point.body == body]
    lengths = [math.hypot(*(float(p[k]) if k >= 0 else 0.0 for k in (point.x, point.y))) for point in points]
    return max(lengths, default=0.0)
