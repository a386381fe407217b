"""Emits a scene's equations as the text of a Python module with NumPy, compiles and evaluates them."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import N_WORK
from gudgeon.errors import ArrayError, BadValueError
from gudgeon.generator.equations.model import Model, find_eccentricity_rows
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.statements import Guard
from gudgeon.generator.ir.values import Test, Threshold
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.play import JointFunctions
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.symbols.curves import make_curve_name
from gudgeon.generator.targets.numpy.printer import (
    WIDTH,
    break_code,
    indent_lines,
    print_assignment,
    print_comment,
    print_docstring,
    print_function,
    print_name,
    print_statements,
)
from gudgeon.language.argument_checks import check_mapping, check_number
from gudgeon.language.curves import RANGE_TOL, Curve
from gudgeon.language.names import make_missing_name_error, make_unknown_name_error
from gudgeon.language.quantities import parse_quantity

Array = NDArray[np.float64]
_ABOUT = (
    "The equations as functions, for reading: results are stored in the last arguments. Numbers are SI (m, kg, "
    "s, N, N*m), "
    "angles rad; t is the time. p has one field per parameter, in the order of prepare(), which fills it; "
    "comments give the "
    "addresses in the file. q are the positions of the bodies' centres of mass and their angles, v are the rates of q:"
)


class _DoubleNamespace(SimpleNamespace):
    """Contain parameters whose division by 0 gives infinity as in C, since `where` may discard the result."""

    def __setattr__(self, name: str, value: object) -> None:
        """Store a float as a NumPy double, and any other value as it is."""
        super().__setattr__(name, np.float64(value) if type(value) is float else value)


class ClosedLinkage:
    """Evaluate Φ, Φ_q, ν, γ and M of the closed linkage (joints with play closed, redundant rows included) in NumPy.

    `source` is the text of the functions; n coordinates, m rows. t in s, q (n,), v (n,) in m, rad and their rates;
    p is the result of `prepare`.
    """

    def __init__(self, model: Model) -> None:
        kernels = [
            closed_linkage.make_mass_kernel(model),
            *closed_linkage.make_constraint_kernels(model),
            closed_linkage.make_start_kernel(model),
            closed_linkage.make_parameter_table_kernel(model),
        ]
        self.model, self.n, self.m = model, len(model.q), len(model.all_rows)
        text = "\n\n\n".join(map(print_function, kernels)) + "\n"
        self.source = (
            f"{_print_module_docstring(model)}\n\n\n{print_called_curves(model.scene.mechanism.curves, text)}{text}"
        )
        self.functions = _compile_functions(self.source)

    def prepare(self, given: Mapping[str, float | str] | None = None) -> SimpleNamespace:
        """Return all parameters of a run by name: given values, defaults, and parameters derived from them.

        given: {address or parameter name: a float in SI, "0.5 mm", or the name of a choice}, as `simulate` accepts
        them. Raises UnknownNameError with the nearest name. Raises BadValueError for an invalid value, or one that two
        keys specify. None: no values are given.
        """
        values = self._convert_given_values(
            check_mapping(given, "given", "{address or parameter name: a float in SI, or '0.5 mm'}")
        )
        p = self._compute_parameters(values)
        chosen = self._find_chosen_properties(values, p)
        return self._compute_parameters(chosen | values) if chosen else p

    def _compute_parameters(self, values: Mapping[str, float]) -> SimpleNamespace:
        """Return all parameters by field name, with `values` {full address: SI}, defaults and derived parameters.

        Calls the emitted function `prepare`. Divisions by zero give infinities, as in C.
        """
        addresses = self.model.parameter_table.entries
        p = _DoubleNamespace(**{name: [0.0] * len(table) for name, table in self.model.parameter_table.tables.items()})
        ordered_values = [values.get(address, 0.0) for address in addresses]
        with np.errstate(all="ignore"):
            self.functions["prepare"](ordered_values, [address in values for address in addresses], p)
        return SimpleNamespace(**{name: float(x) if isinstance(x, np.float64) else x for name, x in vars(p).items()})

    def _find_chosen_properties(self, values: Mapping[str, float], p: SimpleNamespace) -> dict[str, float]:
        """Return {address: value} of the properties that follow from materials chosen by name; {} without a choice.

        values: {address: SI} of a run, in which a choice has the index of its name. p: all parameters without the
        choice. Example: a choice of "steel" for the bearing's material gives its E and nu.
        """
        table, properties = self.model.parameter_table, dict[str, float]()
        for choice in (address for address in values if table.entries[address].choice_words):
            name = table.entries[choice].choice_words[int(values[choice])]
            for address in table.entries:
                if address.startswith(f"{choice}."):
                    entry = table.entries[f"materials.{name}.{address.removeprefix(f'{choice}.')}"]
                    properties[address] = getattr(p, table.find_member_name(entry.symbol))
        return properties

    def _convert_given_values(self, given_values: Mapping[str, float | str]) -> dict[str, float]:
        """Return {full address: value in SI} of the given values; a choice becomes the index of its name.

        A key is a full address or the name of a parameter, a value a number in SI or a text such as "0.5 mm". Raises
        UnknownNameError for an unknown address or choice, BadValueError for an invalid or repeated value.
        """
        entries, values = self.model.parameter_table.entries, dict[str, float]()
        for key, value in given_values.items():
            address = key if key in entries else f"parameters.{key}"
            if address not in entries:
                known_names = (*(a.removeprefix("parameters.") for a in entries), *entries)
                raise make_missing_name_error(
                    f"no parameter of this scene has the address {key!r}", key, tuple(dict.fromkeys(known_names))
                )
            if address in values:
                raise BadValueError(f"{address} is given twice, the second time as {key!r}", hint="give it once")
            if choices := entries[address].choice_words:
                if not isinstance(value, str) or value.strip() not in choices:
                    raise make_unknown_name_error(f"choice of {address}", str(value).strip(), choices, None)
                values[address] = float(choices.index(value.strip()))
                continue
            dimension = entries[address].dimension
            exponents = float(dimension.length), float(dimension.mass), float(dimension.time)
            number = parse_quantity(value, address, exponents) if isinstance(value, str) else value
            values[address] = check_number(number, address)
        return values

    def _call_array_function(self, function_name: str, size: int, *arguments: Any) -> Array:
        """Call a function of `source` with `arguments` and a zero array of `size` values, and return the filled array.

        Warnings of NumPy are suppressed, since infinities are returned as in C.
        """
        values = np.zeros(size)
        with np.errstate(all="ignore"):
            self.functions[function_name](*arguments, values)
        return values

    def mass(self, p: SimpleNamespace) -> Array:
        """Return the diagonal of M, (n,)."""
        return self._call_array_function("mass_matrix", self.n, p)

    def phi(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """Return Φ(q, t), (m,), in m and rad."""
        return self._call_array_function("constraints", self.m, t, _convert_to_list(q), p)

    def phi_q(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """Return the Jacobian ∂Φ/∂q, (m, n)."""
        return self._call_array_function("jacobian", self.m * self.n, t, _convert_to_list(q), p).reshape(self.m, self.n)

    def nu(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """Return ν = −Φ_t, (m,), of Φ_q v = ν."""
        return self._call_array_function("velocity_rhs", self.m, t, _convert_to_list(q), p)

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: SimpleNamespace) -> Array:
        """Return γ, (m,), of Φ_q a = γ."""
        return self._call_array_function("acceleration_rhs", self.m, t, _convert_to_list(q), _convert_to_list(v), p)

    def start_values(self, p: SimpleNamespace) -> tuple[Array, Array, Array]:
        """Return (guesses, set coordinates, set velocities) of the start as three arrays, SI.

        The last two end with the eccentricities of journals and their rates.
        """
        start, n_eccentricities = self.model.scene.mechanism.start, len(find_eccentricity_rows(self.model))
        sizes = (len(start.guess), len(start.set) + n_eccentricities, len(start.rates) + n_eccentricities)
        guess, set_values, rates = (np.zeros(size) for size in sizes)
        with np.errstate(all="ignore"):
            self.functions["start_values"](p, guess, set_values, rates)
        return guess, set_values, rates


class NumPyModel(ClosedLinkage):
    """Evaluate the full formulation of a scene in NumPy, with joints with play, their laws and forces.

    Branches of switching functions are not frozen, and a vanishing pivot is reported, not treated.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program.model)
        contours = [CONTOUR] * any(joint_functions.clearance.contour is not None for joint_functions in program.joints)
        laws = [*contours, *map(print_function, program.laws), *map(print_joint_function, program.joints)]
        parts = [*_print_thresholds(program.dynamics), *laws, print_function(program.dynamics)]
        self.program = program
        text = "\n\n\n".join(parts) + "\n"
        curves = print_called_curves(program.model.scene.mechanism.curves, text, self.source)
        self.source += f"\n\n{curves}{text}"
        self.functions = _compile_functions(self.source)

    def dynamics(
        self,
        t: float,
        q: ArrayLike,
        v: ArrayLike,
        p: SimpleNamespace,
        latches: ArrayLike = (),
        modes: ArrayLike = (),
        states: ArrayLike = 0.0,
    ) -> SimpleNamespace:
        """Solve [M Φ_qᵀ; Φ_q 0][a; λ] = [g; γ − …]: return accelerations a (n,), `lambda_`, forces `clearance`, powers.

        `latches` (joints with play,): the approach speed (m/s) stored at the onset of a closed contact, NaN for an open
        one; (): all contacts are open. The force of a closed rigid contact is NaN, since only the engine computes it.
        `modes` (frictions,): 0 stick, ±1 slip with that sign; required if friction may stick. `states` (joints with
        play, max. number of states of a law): internal states of laws in m, whose rates are `clearance[i].state_rate`.
        `status` is 0, or the number of the pivot that vanished. Raises ArrayError for another number of latches or
        modes.
        """
        model = self.model
        approach_speeds = _check_number_per_name(
            "latches", latches, [c.name for c in model.clearances], [np.nan] * len(model.clearances)
        )
        internal_states = np.broadcast_to(
            np.asarray(states, dtype=float), (len(model.clearances), model.law_states)
        ).tolist()
        discrete = SimpleNamespace(
            contact=[
                SimpleNamespace(closed=bool(x == x), deltadot_minus=float(x), force=np.nan, state=z)
                for x, z in zip(approach_speeds, internal_states, strict=True)
            ],
            mode=_check_number_per_name("modes", modes, [friction.name for friction in model.frictions]),
        )
        m = len(model.rows)
        rhs = SimpleNamespace(
            a=np.zeros(self.n),
            lambda_=np.zeros(m),
            phi=np.zeros(m),
            phi_dot=np.zeros(m),
            power=np.zeros(N_WORK),
            event=np.zeros(len(model.events)),
            clearance=[SimpleNamespace(state_rate=[0.0] * model.law_states) for _ in model.clearances],
            friction=[SimpleNamespace() for _ in model.frictions],
            status=0,
        )
        with np.errstate(all="ignore"):
            rhs.status = self.functions["dynamics"](
                t, _convert_to_list(q), _convert_to_list(v), discrete, p, rhs.a, rhs
            )
        return rhs


def _print_module_docstring(model: Model) -> str:
    """Return the beginning of the emitted module: its docstring with the order of q and v, and the import of NumPy."""
    mechanism = model.scene.mechanism
    title = f"{mechanism.title or mechanism.name}: scene {model.scene.name} of the mechanism {mechanism.name}."
    docstring_lines = [*textwrap.wrap(title, WIDTH - 7), "", *textwrap.wrap(_ABOUT, WIDTH - 7), ""]
    info = model.symbols.info
    docstring_lines += [
        f"    q[{3 * k}:{3 * k + 3}], v[{3 * k}:{3 * k + 3}]: {', '.join(info[q].meaning for q in body.q)}"
        for k, body in enumerate(model.bodies)
    ]
    return "\n".join([*print_docstring(docstring_lines), "", "import numpy as np"])


def _print_thresholds(kernel: Kernel) -> list[str]:
    """Return the definitions of the thresholds of pivots that a kernel's guards name, as one text in a list.

    [] is returned if there are none.
    """
    tests = (line.test for section in kernel.sections for line in section.statements if isinstance(line, Guard))
    bounds = (x for test in tests if isinstance(test, Test) and not test.is_relative_to_value for x in test.bound)
    limits = {x.name: float(x) for x in bounds if isinstance(x, Threshold)}
    comment = print_comment("A constraint equation is dependent if less than this fraction of its pivot is left.")
    definitions = [f"{name} = {value!r}" for name, value in sorted(limits.items())]
    return ["\n".join([*comment, *definitions])] if limits else []


def _check_number_per_name(
    argument_name: str, values: ArrayLike, names: list[str], default_numbers: list[float] | None = None
) -> list[float]:
    """Return `values` as a list with one number for each name.

    default_numbers: the result for an empty `values`; None: no defaults. Raises ArrayError for another number of
    values, with argument_name and the names in the message.
    """
    numbers = np.asarray(values, dtype=float)
    if numbers.shape == (0,) and default_numbers is not None:
        return default_numbers
    if numbers.shape != (len(names),):
        message = f"{argument_name} of shape {numbers.shape}: expected ({len(names)},)"
        raise ArrayError(
            message,
            hint=f"expected one number for each of {', '.join(names)}"
            if names
            else "expected no numbers: this scene has none",
        )
    return _convert_to_list(numbers)


def _convert_to_list(values: ArrayLike) -> list[float]:
    """Return an array as a list of Python floats, whose arithmetic is faster than that of NumPy scalars."""
    return np.asarray(values, dtype=float).tolist()


def _compile_functions(source: str) -> dict[str, Any]:
    """Execute emitted Python source, and return {name: object} of what it defines."""
    names: dict[str, Any] = {}
    exec(compile(source, "<equations>", "exec"), names)
    return names


_CURVE = f'''def curve(table, order, x):
    """Return a cubic spline or its derivative; outside its range NaN, unless it is periodic."""
    knots, c, is_periodic = table
    first, last = knots[0], knots[-1]
    margin = {RANGE_TOL} * (last - first)
    inside = is_periodic | ((x >= first - margin) & (x <= last + margin))
    x = x - (last - first) * np.floor((x - first) / (last - first)) if is_periodic else x
    k = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(c) - 1)
    h, (c0, c1, c2, c3) = x - knots[k], np.moveaxis(c[k], -1, 0)
    value = (c0 + h * (c1 + h * (c2 + h * c3)), c1 + h * (2.0 * c2 + h * (3.0 * c3)),
             2.0 * c2 + h * (6.0 * c3), 6.0 * c3)[order]
    return np.where(inside, value, np.nan)[()]


def knots(table, x):
    """Return 1 in pieces with an even number, -1 in the others, 0 at knots."""
    knots, _, is_periodic = table
    length = knots[-1] - knots[0]
    x = x - length * np.floor((x - knots[0]) / length) if is_periodic else x
    k = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
    return np.where(k % 2, -1.0, 1.0) * np.where(x == knots[k], 0.0, 1.0)'''


def print_called_curves(curves: Mapping[str, Curve], text: str, existing_text: str = "") -> str:
    """Return the Python tables of the curves that a Python text calls, after the functions that evaluate them.

    Parts that `existing_text` already contains are left out. "" is returned if the text calls no curve.
    """
    called_curves = [curve for curve in curves.values() if f"({make_curve_name(curve.name)}," in text]
    parts = [_CURVE, *map(_print_curve_table, called_curves)] if called_curves else []
    return "".join(f"{part}\n\n\n" for part in parts if part not in existing_text)


def _print_curve_table(curve: Curve) -> str:
    """Return the Python assignment of a curve's table: (knots, coefficients of each piece, whether it is periodic).

    A long curve (`Curve.is_long`) is written as hexadecimal bytes.
    """
    if curve.is_long:
        x, c = (np.asarray(table, "<f8").tobytes().hex() for table in (curve.x, curve.coefficients))
        return "\n".join(
            [
                *print_comment(f"{curve.name}: {curve.describe()}"),
                f"{make_curve_name(curve.name)} = (",
                f'    np.frombuffer(bytes.fromhex("{x}"), "<f8"),',
                f'    np.frombuffer(bytes.fromhex("{c}"), "<f8").reshape(-1, 4),',
                f"    {curve.is_periodic},",
                ")",
            ]
        )
    knots = [", ".join(map(repr, curve.x[k : k + 3])) for k in range(0, len(curve.x), 3)]
    pieces = [f"        [{', '.join(map(repr, piece))}]," for piece in curve.coefficients]
    return "\n".join(
        [
            *print_comment(f"{curve.name}: {curve.describe()}"),
            f"{make_curve_name(curve.name)} = (",
            "    np.array([",
            *(f"        {line}," for line in knots),
            "    ]),",
            "    np.array([",
            *pieces,
            "    ]),",
            f"    {curve.is_periodic},",
            ")",
        ]
    )


_DRY = ("F_n", "F_along_t_dry", "M_i_dry", "M_j_dry")
CONTOUR = '''\
def contour(depth, order, angle):
    """Return the depth of a contour (polynomials of degree five) or its derivative."""
    count = len(depth)
    x = count*(angle/(2*np.pi) - np.floor(angle/(2*np.pi)))
    k = min(int(x), count - 1)
    a, b, c, d = (depth[(k + shift) % count] for shift in (-1, 0, 1, 2))
    s, slope, bend, rest = x - k, 0.5*(c - a), (a - b) + (c - b), 3*(c - b) + (a - d)
    if order == 0:
        return b + s*(slope + s*(0.5*bend + s*rest*(1.5 + s*(s - 2.5))))
    if order == 1:
        return count/(2*np.pi)*(slope + s*(bend + s*rest*(4.5 + s*(5*s - 10))))
    return (count/(2*np.pi))**2*(bend + s*rest*(9 + s*(20*s - 30)))'''
_FILM = ("F_r", "F_along_t_film", "M_i_film", "M_j_film")


def print_joint_function(joint_with_play: JointFunctions) -> str:
    """Return the Python function `clearance_<joint>`, which fills `out` with the force in one joint with play.

    A contact acts where the bodies overlap, δ > 0; rigid contacts act if they are closed.
    """
    joint, clearance = joint_with_play.clearance.label, joint_with_play.clearance
    description = f"Force of joint {clearance.name} on the journal, from the eccentricity e and its rate."
    if clearance.wall:
        description = f"Force on corner {clearance.name}, from its position relative to the guide's point and its rate."
    body = [*print_docstring([description])]
    body += print_statements(joint_with_play.gap)
    if clearance.normal is None:
        body += [*_print_film(joint_with_play), "F = F_r, F_along_t_film, M_i_film, M_j_film", "v_t = 0.0"]
    elif clearance.film is None:
        condition = "contact.closed" if clearance.rigid else "delta > 0"
        body += [
            "F, v_t = (0.0, 0.0, 0.0, 0.0), 0.0",
            f"if {condition}:",
            *indent_lines(_print_dry_contact(joint_with_play)),
        ]
    else:
        body += [
            *_print_film(joint_with_play),
            "F, v_t = (F_r, F_along_t_film, M_i_film, M_j_film), 0.0",
            "if delta > 0:",
        ]
        body += indent_lines(
            [
                *_print_dry_contact(joint_with_play),
                *print_statements(joint_with_play.blend),
                "if share < 1:",
                f"    film = {', '.join(_FILM)}",
                "    F = tuple(b + share*(a - b) for a, b in zip(F, film))",
            ]
        )
    position, moment_first = ("e*n_x, e*n_y", "F[2] + along*F[0]") if clearance.wall else ("e_x, e_y", "F[2]")
    body += [
        "out.Fx, out.Fy = F[0]*n_x - F[1]*n_y, F[0]*n_y + F[1]*n_x",
        "out.F_n, out.F_t, out.v_t = F[0], F[1], v_t",
        f"out.ex, out.ey, out.e, out.deltadot, out.delta = {position}, e, deltadot, delta",
        f"out.moment_first, out.moment_second, out.power = {moment_first}, F[3], 0.0",
    ]
    surface_arguments = ", n_x, n_y" if clearance.wall else ", theta_i" if clearance.contour else ""
    signature = f"def clearance_{joint}_(e_x, e_y, de_x, de_y, omega_i, omega_j{surface_arguments}, contact, p, out):"
    return "\n".join([*break_code(signature), *indent_lines(body)])


def _print_dry_contact(joint: JointFunctions) -> list[str]:
    """Return the Python lines that compute normal force, friction and moments of a dry contact, and assign them to `F`.

    The ratio δ̇/δ̇⁻ has the stored approach speed if the contact is closed, and is 1 otherwise. The friction is 0
    without a friction law. The rates of internal states are stored in `out`. The caller prints the condition δ > 0.
    """
    ratio_name, states = "unclipped" if joint.clearance.clip_ratio else "ratio", range(len(joint.clearance.states))
    state_values, state_rates = [f"contact.state[{k}]" for k in states], [f"out.state_rate[{k}]" for k in states]
    normal_force = "F_N" if joint.contour_normal_force else "F_n"
    friction_call = (
        _print_law_call(joint.laws["friction"], normal_force, "v_t", *state_values)
        if "friction" in joint.laws
        else "0.0"
    )
    return [
        f"{ratio_name} = deltadot / contact.deltadot_minus if contact.closed else 1.0",
        *print_statements(joint.before_dry),
        *print_assignment(
            "F_n",
            _print_law_call(joint.laws["normal"], "delta", "ratio", *map(print_name, joint.normal_law_argument_places)),
            is_call=True,
        ),
        *print_statements(joint.contour_normal_force),
        *print_assignment(", ".join(["F_along_t_dry", *state_rates]), friction_call, is_call=True),
        *print_statements(joint.after_dry),
        f"F = -{normal_force}, {', '.join(_DRY[1:])}",
    ]


def _print_film(joint: JointFunctions) -> list[str]:
    """Return the Python lines that compute the lubrication forces F_r and F_along_t_film and the moments of a joint.

    The joint must have a film.
    """
    film_call = print_assignment(
        "F_r, F_along_t_film, T0", _print_law_call(joint.laws["film"], "epsilon", "w_n", "w_t"), is_call=True
    )
    return [*print_statements(joint.before_film), *film_call, *print_statements(joint.after_film)]


def _print_law_call(call: SharedFunctionCall, *arguments: str) -> str:
    """Return the call of a law in Python: its arguments, then the parameters of this joint."""
    return f"{call.kernel.name}({', '.join([*arguments, *map(print_name, call.parameters)])})"
