"""Computes reference values of a scene's functions in NumPy, with which the runtime verifies the compiled library.

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
from gudgeon.generator.kernels.outputs import find_constraining_joints, list_force_element_series
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage, read_parameter
from gudgeon.generator.targets.numpy.module import NumPyModel, _compile_functions, print_called_curves
from gudgeon.generator.targets.numpy.printer import print_function

Array = NDArray[np.float64]
MAX_COORDINATES = 300  # for larger linkages Python takes longer to compile the text than C
N_JOINT_STATES = 2  # all joints with play open; all closed
N_CANDIDATES = 96  # random candidate states for contacts and films
MAX_SELECTED = 6  # of candidates in contact, and of candidates in the clearance or film
MIN_SPEED_EXPONENT, MAX_SPEED_EXPONENT = -4.0, 1.0  # powers of ten by which velocities of candidates are multiplied
RELATIVE_PERTURBATION = 1e-12  # of q, to find ill-conditioned states near singular positions
SENSITIVITY_TOL = 1e-8  # change of a value by the perturbation, relative to the largest value, that excludes a state
N_GAUSS_NEWTON_STEPS = 6  # to close the linkage
DAMPING = 1e-13  # of these steps (Levenberg–Marquardt), relative to the trace of Φ_q Φ_qᵀ: rows may be dependent


def compute_reference_values(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return {"p": parameters, "given": …, "states": [{t, q, v, memory, values}]} for the emitted `source`.

    Numbers are SI. "memory" has the discrete and internal states: the approach speed of each contact (None: open), the
    mode of each friction element, the internal states of laws. "values" has the arrays of an Evaluation by name, flat,
    and phi, nu, gamma and mass. "given" has all parameters of two runs. In one the parameters with even indices are
    specified, in the other those with odd indices; the others have default or derived values
    (`_compute_given_parameters`). They verify how the library derives parameters. {} is returned above MAX_COORDINATES
    coordinates, and if an arithmetic error occurs where C has an infinity.
    """
    if len(program.model.q) > MAX_COORDINATES:
        return {}
    try:
        return _compute_reference(program, source)
    except ArithmeticError:  # where C has an infinity
        return {}


def _compute_reference(program: Program, source: KernelSource) -> dict[str, Any]:
    """Return the reference values of a scene (`compute_reference_values`) at states near a closed linkage.

    States that are ill-conditioned (`_is_well_conditioned`) or cannot be evaluated are left out. Raises ArithmeticError
    where C has an infinity.
    """
    model = program.model
    numpy_model = NumPyModel(program)
    linkage, rng = NumPyLinkage(model, source, closed_linkage=numpy_model), np.random.default_rng(1)
    clearances = [abs(float(linkage.p[joint.clearance])) for joint in source.clearances]
    text = print_function(program.closed_linkage[-1]) + "\n"
    imports = f"import numpy as np\n\n\n{print_called_curves(model.scene.mechanism.curves, text)}"
    outputs = _compile_functions(f"{imports}{text}")["outputs"]
    states, candidates = [], []
    for k in range(N_JOINT_STATES):
        t = float(f"{0.05 + 0.3 * rng.uniform():.9f}")
        q = _sample_position(numpy_model, t, linkage.defaults, min([1e-3, *clearances]), rng)
        v = np.array([float(f"{x:.4g}") for x in rng.normal(0.0, 0.3, len(q))])
        latches = [0.1 if k and not model.rigid else np.nan] * len(model.clearances)
        candidates.append((t, q, v, (latches, [1.0 - 2.0 * k] * len(model.frictions), 0.0)))
    for t, q, v, discrete_states in [
        *candidates,
        *_sample_contact_states(numpy_model, linkage.defaults, candidates[-1], min([1e-3, *clearances]), rng),
    ]:
        values, neighbour = (
            _evaluate_functions(model, numpy_model, outputs, linkage.defaults, (t, x, v), discrete_states)
            for x in (q, q * (1.0 + RELATIVE_PERTURBATION))
        )
        if (
            values
            and neighbour
            and all(_is_well_conditioned(values[name], neighbour[name]) for name in values if name != "phi")
        ):
            approach_speeds, modes, internal_state = discrete_states
            flat_states = [*approach_speeds, *modes, *[internal_state] * len(source.internal_states)]
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
    """Return the parameters of two runs: the user specifies those with even indices, then those with odd indices.

    They test how defaults depend on specified parameters. Values have seven digits; None stands for one that is not
    finite.
    """
    entries, parameters = linkage.source.parameters, []
    for first in range(2):
        with np.errstate(all="ignore"):
            p = numpy_model._compute_parameters(
                {entries[k].address: value for k, value in make_given_parameters(entries, first).items()}
            )
        parameters.append(_round_to_seven_digits(np.array([read_parameter(p, name) for name in linkage.names])))
    return parameters


def _sample_contact_states(
    numpy_model: NumPyModel,
    p: Any,
    start_state: tuple[float, Array, Array, Any],
    displacement_scale: float,
    rng: np.random.Generator,
) -> list[tuple[float, Array, Array, Any]]:
    """Return random states (t, q, v, discrete states) with various contacts and films: approach, slip, separation.

    N_CANDIDATES candidates near the closed linkage are evaluated; those with a vanished pivot or an infinity are
    dropped. `_select_diverse_states` selects among those in contact and among the others. [] is returned without play.
    start_state: gives time, number of contacts and friction modes. displacement_scale: m or rad.
    """
    model, (t, q, _, (latches, modes, _)) = numpy_model.model, start_state
    if not model.clearances:
        return []
    candidates: tuple[list[Any], list[Any]] = [], []  # in contact; free, or in a film
    q = _sample_position(numpy_model, t, p, 0.0, rng)
    for n in range(N_CANDIDATES):
        if n % 2 == 0:
            is_free = n % 4 == 0 or bool(model.rigid)
            distance = displacement_scale * 10.0 ** rng.uniform(-1.5 if is_free else -1.0, -0.3 if is_free else 0.3)
            x = _round_to_digits(q + distance * rng.normal(0.0, 1.0, len(q)), 7)
            velocities = 10.0 ** rng.uniform(MIN_SPEED_EXPONENT, MAX_SPEED_EXPONENT) * rng.normal(0.0, 0.3, len(q))
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
    return [state for states in candidates for state in _select_diverse_states(states)]


def _select_diverse_states(candidates: list[tuple[set[tuple[Any, ...]], Any]]) -> list[Any]:
    """Return at most MAX_SELECTED states of candidates (set of features, state) by a greedy set cover of the features.

    Each step selects the candidate with the most features that no selected state has, until none adds one. Selected
    candidates are removed from the list `candidates`.
    """
    known_features, selected = set[tuple[Any, ...]](), list[Any]()
    while candidates and len(selected) < MAX_SELECTED:
        best = max(range(len(candidates)), key=lambda k: len(candidates[k][0] - known_features))
        features, state = candidates.pop(best)
        if not features - known_features:
            break
        known_features |= features
        selected.append(state)
    return selected


def _list_force_features(result: Any) -> set[tuple[Any, ...]]:
    """Return a set of discrete features of the forces in joints with play, by which states are compared.

    They are, for each joint with a force: contact or film, the signs of both components and of the penetration rate,
    and the order of magnitude of the tangential fraction.
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


def _is_well_conditioned(value: Array, neighbour: Array) -> bool:
    """Return whether values are finite and insensitive to rounding of the state.

    value, neighbour: the values at q and at q (1 + RELATIVE_PERTURBATION). They may differ by SENSITIVITY_TOL of the
    largest magnitude in `value`.
    """
    scale = max(float(np.abs(value).max(initial=0.0)), 1e-300)
    return bool(np.isfinite(value).all() and (np.abs(neighbour - value) <= SENSITIVITY_TOL * scale).all())


def _sample_position(
    numpy_model: NumPyModel, t: float, p: Any, displacement_scale: float, rng: np.random.Generator
) -> Array:
    """Return random positions q (n,) that nearly satisfy Φ = 0, rounded to seven digits.

    N_GAUSS_NEWTON_STEPS steps from a random position close the linkage; they end early at a value that is not finite.
    Normally distributed displacements follow. displacement_scale: their standard deviation, m or rad.
    """
    q = rng.uniform(0.1, 0.6, numpy_model.n)
    for _ in range(N_GAUSS_NEWTON_STEPS if numpy_model.m else 0):
        phi, phi_q = numpy_model.phi(t, q, p), numpy_model.phi_q(t, q, p)
        if not (np.isfinite(phi).all() and np.isfinite(phi_q).all()):
            break
        gram = phi_q @ phi_q.T
        q = q - phi_q.T @ np.linalg.solve(gram + DAMPING * np.trace(gram) * np.eye(len(phi)), phi)
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
    out = [np.zeros(size) for size in (reactions, drives, len(list_force_element_series(model)), N_ENERGY)]
    try:
        with np.errstate(all="ignore"):
            compute_outputs(t, q.tolist(), v.tolist(), p, result.lambda_, *out)
    except (ArithmeticError, ValueError):
        return None
    return values | dict(zip(("reactions", "torques", "series", "energy"), out, strict=True))


def _round_to_seven_digits(values: Array) -> list[float | None]:
    """Return a flat list of values with seven significant digits, since the last digits depend on the machine.

    None stands for a value that is not finite.
    """
    return [float(f"{x:.7g}") if np.isfinite(x) else None for x in np.asarray(values, dtype=float).ravel()]
