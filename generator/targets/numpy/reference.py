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
from gudgeon.contract.kernel_source import KernelSource, make_given_parameters
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.outputs import find_constraining_joints, find_element_series
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage, _get_parameter
from gudgeon.generator.targets.numpy.module import NumPyModel, _compile_functions, print_called_curves
from gudgeon.generator.targets.numpy.printer import print_function

Array = NDArray[np.float64]
MAX_COORDINATES = 300  # for larger linkages Python takes longer to compile the text than C
N_STATES = 2  # all joints with play open; all closed
N_TRIED, N_MORE = 96, 6  # candidate states for contacts and films, and how many of each kind are kept at most
SLOWEST, FASTEST = -4.0, 1.0  # range of powers of ten by which velocities of candidate states are multiplied
SENSITIVE = 1e-8  # of the largest value: a change by NEARBY that disqualifies a state (a singular position)
NEARBY = 1e-12
CLOSINGS = 6  # Gauss–Newton steps towards a closed linkage


def compute_reference_values(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return {"p": parameters, "given": …, "states": [{t, q, v, memory, values}]} for the emitted `source`.

    Numbers are SI; "values" has the arrays of an Evaluation by name, flat, and phi, nu, gamma and mass. "given" has the
    parameters of two runs in which every second one is given, from the first and from the second on. {} for large
    linkages.
    """
    if len(program.model.q) > MAX_COORDINATES:
        return {}
    try:
        return _compute_reference(program, source)
    except ArithmeticError:  # where C has an infinity
        return {}


def _compute_reference(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return the reference values of a scene at states near a closed linkage.

    Raises ArithmeticError where C has an infinity.
    Candidate states whose values change with the last digits of q are left out.
    """
    model = program.model
    numpy_model = NumPyModel(program)
    linkage, rng = NumPyLinkage(model, source, closed_linkage=numpy_model), np.random.default_rng(1)
    clearances = [abs(float(linkage.p[joint.clearance])) for joint in source.clearances]
    text = print_function(program.closed_linkage[-1]) + "\n"
    imports = f"import numpy as np\n\n\n{print_called_curves(model.scene.mechanism.curves, text)}"
    outputs = _compile_functions(f"{imports}{text}")["outputs"]
    states, candidates = [], []
    for k in range(N_STATES):
        t = float(f"{0.05 + 0.3 * rng.uniform():.9f}")
        q = _find_nearly_closed_position(numpy_model, t, linkage.defaults, min([1e-3, *clearances]), rng)
        v = np.array([float(f"{x:.4g}") for x in rng.normal(0.0, 0.3, len(q))])
        latches = [0.1 if k and not model.rigid else np.nan] * len(model.clearances)
        candidates.append((t, q, v, (latches, [1.0 - 2.0 * k] * len(model.frictions), 0.0)))
    for t, q, v, memory in [
        *candidates,
        *_find_contact_states(numpy_model, linkage.defaults, candidates[-1], min([1e-3, *clearances]), rng),
    ]:
        values, neighbour = (
            _evaluate_functions(model, numpy_model, outputs, linkage.defaults, (t, x, v), memory)
            for x in (q, q * (1.0 + NEARBY))
        )
        if values and neighbour and all(_is_steady(values[name], neighbour[name]) for name in values if name != "phi"):
            flat_states = [*memory[0], *memory[1], *[memory[2]] * len(source.states)]
            states.append(
                {
                    "t": t,
                    "q": q.tolist(),
                    "v": v.tolist(),
                    "memory": [None if x != x else x for x in flat_states],
                    "values": {name: _round_to_seven_digits(value) for name, value in values.items()},
                }
            )
    return {
        "p": _round_to_seven_digits(linkage.p),
        "given": _compute_given_parameters(numpy_model, linkage),
        "states": states,
    }


def _compute_given_parameters(numpy_model: NumPyModel, linkage: NumPyLinkage) -> list[list[float | None]]:
    """Return the parameters of two runs in which every second parameter is given, first or second of each pair.

    Values have seven digits; None stands for one that is not finite.
    """
    slots, parameters = linkage.source.slots, []
    for first in range(2):
        with np.errstate(all="ignore"):
            p = numpy_model._compute_parameters(
                {slots[k].address: value for k, value in make_given_parameters(slots, first).items()}
            )
        parameters.append(_round_to_seven_digits(np.array([_get_parameter(p, name) for name in linkage.names])))
    return parameters


def _find_contact_states(
    numpy_model: NumPyModel,
    p: Any,
    start_state: tuple[float, Array, Array, Any],
    displacement_scale: float,
    rng: np.random.Generator,
) -> list[tuple[float, Array, Array, Any]]:
    """Return states (t, q, v, discrete states) in which contacts and films are fast or slow, slip and separate.

    Of N_TRIED random candidates those are selected whose forces differ most (`_list_force_features`); [] without play.
    A candidate with a vanished pivot or an infinity is dropped.
    """
    model, (t, q, _, (latches, modes, _)) = numpy_model.model, start_state
    if not model.clearances:
        return []
    candidates: tuple[list[Any], list[Any]] = [], []  # in contact; free, or in a film
    q = _find_nearly_closed_position(numpy_model, t, p, 0.0, rng)
    for n in range(N_TRIED):
        if n % 2 == 0:
            is_free = n % 4 == 0 or bool(model.rigid)
            distance = displacement_scale * 10.0 ** rng.uniform(-1.5 if is_free else -1.0, -0.3 if is_free else 0.3)
            x = _round_to_digits(q + distance * rng.normal(0.0, 1.0, len(q)), 7)
            velocities = 10.0 ** rng.uniform(SLOWEST, FASTEST) * rng.normal(0.0, 0.3, len(q))
            onset = np.nan if is_free else float(f"{10.0 ** rng.uniform(-3.0, 0.0):.4g}")
        internal_state = float(f"{10.0 ** rng.uniform(-7.0, -4.0):.4g}")
        state = (
            t,
            x,
            _round_to_digits(velocities if n % 2 else -velocities, 4),
            ([onset] * len(latches), modes, internal_state),
        )
        try:
            result = numpy_model.dynamics(*state[:3], p, *state[3])
        except (ArithmeticError, ValueError):
            continue
        if not result.status and np.isfinite(result.a).all():
            candidates[int(is_free)].append((_list_force_features(result), state))
    return [state for states in candidates for state in _select_most_different(states)]


def _select_most_different(candidates: list[tuple[set[tuple[Any, ...]], Any]]) -> list[Any]:
    """Return at most N_MORE states of candidates (features, state) that together have the most features.

    The list `candidates` is emptied on the way. The selection ends when no candidate adds a feature.
    """
    known_features, selected = set[tuple[Any, ...]](), list[Any]()
    while candidates and len(selected) < N_MORE:
        best = max(range(len(candidates)), key=lambda k: len(candidates[k][0] - known_features))
        features, state = candidates.pop(best)
        if not features - known_features:
            break
        known_features |= features
        selected.append(state)
    return selected


def _list_force_features(result: Any) -> set[tuple[Any, ...]]:
    """Return a set of features of the forces in joints with play: contact or film, signs, direction, approach.

    Joints without a force have none.
    """
    features = set[tuple[Any, ...]]()
    for k, joint in enumerate(result.clearance):
        magnitude = math.hypot(joint.Fx, joint.Fy) * math.hypot(joint.ex, joint.ey)
        if magnitude > 0.0:
            along, across = joint.Fx * joint.ex + joint.Fy * joint.ey, joint.Fy * joint.ex - joint.Fx * joint.ey
            tangential_class = round(2.0 * math.log10(abs(across) / magnitude + 1e-6))
            joint_and_contact = k, joint.delta > 0.0
            features |= {
                (*joint_and_contact, across > 0.0, tangential_class),
                (*joint_and_contact, along > 0.0, joint.deltadot > 0.0, None),
            }
    return features


def _round_to_digits(values: Array, n: int) -> Array:
    """Return an array with its values rounded to n significant digits."""
    return np.array([float(f"{x:.{n}g}") for x in values])


def _is_steady(value: Array, neighbour: Array) -> bool:
    """Return whether values are finite and change by at most SENSITIVE of the largest if the state changes slightly."""
    scale = max(float(np.abs(value).max(initial=0.0)), 1e-300)
    return bool(np.isfinite(value).all() and (np.abs(neighbour - value) <= SENSITIVE * scale).all())


def _find_nearly_closed_position(
    numpy_model: NumPyModel, t: float, p: Any, displacement_scale: float, rng: np.random.Generator
) -> Array:
    """Return positions q (n,) near those that satisfy Φ = 0, displaced at random, rounded to seven digits.

    displacement_scale: standard deviation of the displacements, m or rad. A few Gauss–Newton steps from a random
    position close the linkage; they end early at a value that is not finite.
    """
    q = rng.uniform(0.1, 0.6, numpy_model.n)
    for _ in range(CLOSINGS if numpy_model.m else 0):
        phi, phi_q = numpy_model.phi(t, q, p), numpy_model.phi_q(t, q, p)
        if not (np.isfinite(phi).all() and np.isfinite(phi_q).all()):
            break
        q = q - np.linalg.lstsq(phi_q, phi, rcond=1e-6)[0]
    q = np.clip(q, -1e3, 1e3) + displacement_scale * rng.normal(0.0, 1.0, numpy_model.n)
    return np.array([float(f"{x:.7g}") for x in q])


def _evaluate_functions(
    model: Model,
    numpy_model: NumPyModel,
    compute_outputs: Any,
    p: Any,
    state: tuple[float, Array, Array],
    discrete_states: tuple[list[float], list[float], float],
) -> dict[str, Array] | None:
    """Return {name in Evaluation: array} of all functions at a state (t, q, v).

    compute_outputs: the compiled function `outputs`, called with (t, q, v, p, multipliers) and arrays that it fills:
    reactions, torques of drives, series of force elements, energies. p: parameters (SI). discrete_states: approach
    speeds, friction modes, internal states. None is returned where a pivot vanishes or C has an infinity.
    """
    t, q, v = state
    try:
        result = numpy_model.dynamics(t, q, v, p, *discrete_states)
    except (ArithmeticError, ValueError):  # where C has an infinity, or no number
        return None
    if result.status:
        return None
    values = {
        "a": result.a,
        "multipliers": result.lambda_,
        "power": result.power,
        "phi": numpy_model.phi(t, q, p),
        "nu": numpy_model.nu(t, q, p),
        "gamma": numpy_model.gamma(t, q, v, p),
        "mass": numpy_model.mass(p),
        "clearance": np.array([[clearance.Fx, clearance.Fy] for clearance in result.clearance]).ravel(),
    }
    reactions, drives = N_REACTION_COLUMNS * len(find_constraining_joints(model)), len(model.scene.mechanism.drives)
    out = [np.zeros(size) for size in (reactions, drives, len(find_element_series(model)), N_ENERGY)]
    try:
        with np.errstate(all="ignore"):
            compute_outputs(t, q.tolist(), v.tolist(), p, result.lambda_, *out)
    except (ArithmeticError, ValueError):
        return None
    return values | dict(zip(("reactions", "torques", "series", "energy"), out, strict=True))


def _round_to_seven_digits(values: Array) -> list[float | None]:
    """Return a flat list of values with seven digits, as the last ones depend on the machine.

    None for those not finite.
    """
    return [float(f"{x:.7g}") if np.isfinite(x) else None for x in np.asarray(values, dtype=float).ravel()]
