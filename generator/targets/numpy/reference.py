"""Computes reference values of a scene's functions in NumPy, with which the compiled library is compared.

They are stored with the emitted C, and the runtime compares them with the library that it loads
(runtime/model/reference.py). Different printers write NumPy and C from the same statements.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import N_ENERGY, N_REACTION_COLUMNS
from gudgeon.contract.kernel_source import KernelSource, given_parameters
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.outputs import constraining_joints, element_series
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage, _number
from gudgeon.generator.targets.numpy.module import NumPyModel, _defined, with_curves
from gudgeon.generator.targets.numpy.printer import function

Array = NDArray[np.float64]
MAX_COORDINATES = 300  # for larger linkages Python takes longer to compile the text than C
N_STATES = 2  # all joints with play open; all closed
N_TRIED, N_MORE = 96, 6  # candidate states for contacts and films, and how many of each kind are kept at most
SLOWEST, FASTEST = -4.0, 1.0  # range of powers of ten by which velocities of candidate states are multiplied
SENSITIVE = 1e-8  # of the largest value: a change by NEARBY that disqualifies a state (a singular position)
NEARBY = 1e-12
CLOSINGS = 6  # Gauss–Newton steps towards a closed linkage


def reference_values(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return {"p": parameters, "given": …, "states": [{t, q, v, memory, values}]} for the emitted `source`.

    Numbers are SI; "values" has the arrays of an Evaluation by name, flat, and phi, nu, gamma and mass. "given" has the
    parameters where every second slot is given (`given_parameters`), from the first and from the second on. {} for
    large linkages.
    """
    if len(program.model.q) > MAX_COORDINATES:
        return {}
    try:
        return _compute_reference(program, source)
    except ArithmeticError:  # where C has an infinity
        return {}


def _compute_reference(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return the reference values of a scene. Raises ArithmeticError where C has an infinity."""
    model = program.model
    numpy = NumPyModel(program)
    linkage, rng = NumPyLinkage(model, source, closed=numpy), np.random.default_rng(1)
    plays = [abs(float(linkage.p[joint.clearance])) for joint in source.clearances]
    text = function(program.closed[-1]) + "\n"
    head = f"import numpy as np\n\n\n{with_curves(model.scene.mechanism.curves, text)}"
    outputs = _defined(f"{head}{text}")["outputs"]
    states, tried = [], []
    for k in range(N_STATES):
        t = float(f"{0.05 + 0.3 * rng.uniform():.9f}")
        q = _near_closed(numpy, t, linkage.defaults, min([1e-3, *plays]), rng)
        v = np.array([float(f"{x:.4g}") for x in rng.normal(0.0, 0.3, len(q))])
        latches = [0.1 if k and not model.rigid else np.nan] * len(model.clearances)
        tried.append((t, q, v, (latches, [1.0 - 2.0 * k] * len(model.frictions), 0.0)))
    for t, q, v, memory in [*tried, *_contact_states(numpy, linkage.defaults, tried[-1], min([1e-3, *plays]), rng)]:
        found, near = (
            _values(model, numpy, outputs, linkage.defaults, (t, x, v), memory) for x in (q, q * (1.0 + NEARBY))
        )
        if found and near and all(_is_steady(found[name], near[name]) for name in found if name != "phi"):
            flat = [*memory[0], *memory[1], *[memory[2]] * len(source.states)]
            states.append(
                {
                    "t": t,
                    "q": q.tolist(),
                    "v": v.tolist(),
                    "memory": [None if x != x else x for x in flat],
                    "values": {name: _as_seven_digits(value) for name, value in found.items()},
                }
            )
    return {"p": _as_seven_digits(linkage.p), "given": _parameters_of_given(numpy, linkage), "states": states}


def _parameters_of_given(numpy: NumPyModel, linkage: NumPyLinkage) -> list[list[float | None]]:
    """Return parameters of two runs in which every second parameter is given, from the first and from the second on."""
    slots, found = linkage.source.slots, []
    for first in range(2):
        with np.errstate(all="ignore"):
            p = numpy._prepared({slots[k].address: value for k, value in given_parameters(slots, first).items()})
        found.append(_as_seven_digits(np.array([_number(p, name) for name in linkage.names])))
    return found


def _contact_states(
    numpy: NumPyModel, p: Any, at: tuple[float, Array, Array, Any], play: float, rng: np.random.Generator
) -> list[tuple[float, Array, Array, Any]]:
    """Return states in which contacts and films are fast and slow, slip either way, approach and separate.

    Of N_TRIED candidates those are kept whose forces differ most (`_features`).
    """
    model, (t, q, _, (latches, modes, _)) = numpy.model, at
    if not model.clearances:
        return []
    tried: tuple[list[Any], list[Any]] = [], []  # in contact; free, or in a film
    q = _near_closed(numpy, t, p, 0.0, rng)
    for n in range(N_TRIED):
        if n % 2 == 0:
            free = n % 4 == 0 or bool(model.rigid)
            far = play * 10.0 ** rng.uniform(-1.5 if free else -1.0, -0.3 if free else 0.3)
            x = _round_to_digits(q + far * rng.normal(0.0, 1.0, len(q)), 7)
            fast = 10.0 ** rng.uniform(SLOWEST, FASTEST) * rng.normal(0.0, 0.3, len(q))
            onset = np.nan if free else float(f"{10.0 ** rng.uniform(-3.0, 0.0):.4g}")
        bent = float(f"{10.0 ** rng.uniform(-7.0, -4.0):.4g}")
        state = t, x, _round_to_digits(fast if n % 2 else -fast, 4), ([onset] * len(latches), modes, bent)
        try:
            found = numpy.dynamics(*state[:3], p, *state[3])
        except (ArithmeticError, ValueError):
            continue
        if not found.status and np.isfinite(found.a).all():
            tried[int(free)].append((_features(found), state))
    return [state for states in tried for state in _most_different(states)]


def _most_different(candidates: list[tuple[set[tuple[Any, ...]], Any]]) -> list[Any]:
    """Return at most N_MORE states of candidates (features, state) that together have the most features."""
    seen, kept = set[tuple[Any, ...]](), list[Any]()
    while candidates and len(kept) < N_MORE:
        best = max(range(len(candidates)), key=lambda k: len(candidates[k][0] - seen))
        features, state = candidates.pop(best)
        if not features - seen:
            break
        seen |= features
        kept.append(state)
    return kept


def _features(found: Any) -> set[tuple[Any, ...]]:
    """Return features of the force in each joint with play: contact or film, signs, direction, approach."""
    features = set[tuple[Any, ...]]()
    for k, joint in enumerate(found.clearance):
        size = math.hypot(joint.Fx, joint.Fy) * math.hypot(joint.ex, joint.ey)
        if size > 0.0:
            along, across = joint.Fx * joint.ex + joint.Fy * joint.ey, joint.Fy * joint.ex - joint.Fx * joint.ey
            share = round(2.0 * math.log10(abs(across) / size + 1e-6))
            kind = k, joint.delta > 0.0
            features |= {(*kind, across > 0.0, share), (*kind, along > 0.0, joint.deltadot > 0.0, None)}
    return features


def _round_to_digits(values: Array, n: int) -> Array:
    """Return values rounded to n significant digits."""
    return np.array([float(f"{x:.{n}g}") for x in values])


def _is_steady(value: Array, near: Array) -> bool:
    """Return whether values are finite and nearly independent of the last digits of the state."""
    scale = max(float(np.abs(value).max(initial=0.0)), 1e-300)
    return bool(np.isfinite(value).all() and (np.abs(near - value) <= SENSITIVE * scale).all())


def _near_closed(numpy: NumPyModel, t: float, p: Any, play: float, rng: np.random.Generator) -> Array:
    """Return positions (n,) near a closed linkage, with seven digits; journals are near contact."""
    q = rng.uniform(0.1, 0.6, numpy.n)
    for _ in range(CLOSINGS if numpy.m else 0):
        phi, phi_q = numpy.phi(t, q, p), numpy.phi_q(t, q, p)
        if not (np.isfinite(phi).all() and np.isfinite(phi_q).all()):
            break
        q = q - np.linalg.lstsq(phi_q, phi, rcond=1e-6)[0]
    q = np.clip(q, -1e3, 1e3) + play * rng.normal(0.0, 1.0, numpy.n)
    return np.array([float(f"{x:.7g}") for x in q])


def _values(
    model: Model,
    numpy: NumPyModel,
    outputs: Any,
    p: Any,
    at: tuple[float, Array, Array],
    memory: tuple[list[float], list[float], float],
) -> dict[str, Array] | None:
    """Return all functions at a state by their names in Evaluation; None where a pivot vanishes."""
    t, q, v = at
    try:
        found = numpy.dynamics(t, q, v, p, *memory)
    except (ArithmeticError, ValueError):  # where C has an infinity, or no number
        return None
    if found.status:
        return None
    values = {
        "a": found.a,
        "multipliers": found.lambda_,
        "power": found.power,
        "phi": numpy.phi(t, q, p),
        "nu": numpy.nu(t, q, p),
        "gamma": numpy.gamma(t, q, v, p),
        "mass": numpy.mass(p),
        "clearance": np.array([[one.Fx, one.Fy] for one in found.clearance]).ravel(),
    }
    reactions, drives = N_REACTION_COLUMNS * len(constraining_joints(model)), len(model.scene.mechanism.drives)
    out = [np.zeros(size) for size in (reactions, drives, len(element_series(model)), N_ENERGY)]
    try:
        with np.errstate(all="ignore"):
            outputs(t, q.tolist(), v.tolist(), p, found.lambda_, *out)
    except (ArithmeticError, ValueError):
        return None
    return values | dict(zip(("reactions", "torques", "series", "energy"), out, strict=True))


def _as_seven_digits(values: Array) -> list[float | None]:
    """Return values with seven digits, as the last ones depend on the machine; None for those not finite."""
    return [float(f"{x:.7g}") if np.isfinite(x) else None for x in np.asarray(values, dtype=float).ravel()]
