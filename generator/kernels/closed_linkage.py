"""Functions of the linkage without play in its joints: constraints, mass matrix, initial values, parameter table.

A kernel is a function as statements (ir/kernels.py), which the targets print as C, NumPy and JavaScript.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model, list_start_values
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, Section
from gudgeon.generator.ir.signatures import PARAMETERS, STATE, Number, make_input_argument, make_output_argument
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.ir.values import ParameterOrDefault
from gudgeon.generator.symbols.storage import StorageLocation


def make_parameter_table_kernel(model: Model) -> Kernel:
    """Return the kernel `prepare`, which fills the parameter table `p` of a run before the run starts.

    A parameter has the value `given[i]` if `is_given[i]`, else the default of the file. The derived parameters are
    computed after that. Call it after all parameters have been derived.
    """
    parameters: list[Statement] = []
    info = model.symbols.info
    for index, entry in enumerate(model.parameter_table.entries.values()):
        comment = f"{entry.address}, from 0: {', '.join(entry.choice_words)}" if entry.choice_words else entry.address
        parameters.append(Statement(entry.symbol.name, ParameterOrDefault(index, entry.value), comment))
        parameters.append(Statement(model.parameter_table.find_storage_location(entry.symbol), entry.symbol))
    derived: list[Statement] = []
    for symbol, value in model.parameter_table.derived.items():
        derived.append(Statement(symbol.name, value, info[symbol].meaning))
        derived.append(Statement(model.parameter_table.find_storage_location(symbol), symbol))
    return Kernel(
        "prepare",
        ("Fill all parameters of a run: given values or defaults, then derived parameters.",),
        (
            make_input_argument("given"),
            make_input_argument("is_given", Number.BYTE),
            make_output_argument(PARAMETERS.name, PARAMETERS.type),
        ),
        (Section("slots", tuple(parameters)), Section("derived", tuple(derived))),
    )


def make_mass_kernel(model: Model) -> Kernel:
    """Return the kernel that writes the diagonal of the mass matrix M in absolute coordinates to `m` (n)."""
    builder = KernelBuilder(
        model.symbols, "mass_matrix", ["The diagonal of the mass matrix M (n) in absolute coordinates."]
    )
    builder.begin_section("M")
    for k, mass in enumerate(model.masses):
        builder.append_store(StorageLocation("m")[k], mass)
    return builder.build_kernel((PARAMETERS, make_output_argument("m")))


def make_constraint_kernels(model: Model) -> list[Kernel]:
    """Return the kernels of the constraint equations without play: Φ, Φ_q (dense, row by row), ν and γ."""

    def make_kernel(
        name: str,
        doc: str,
        array: str,
        reads_velocity: bool,
        get_value: Callable[[Row], sp.Expr],
        unit_suffix: str = "",
    ) -> Kernel:
        """Return the kernel `name` that writes one value of each constraint equation to the array `array`.

        `doc`: its comment; `reads_velocity`: the value depends on velocities; `get_value` returns it; `unit_suffix`:
        suffix of the unit, such as "/s".
        """
        builder = KernelBuilder(model.symbols, name, [doc])
        builder.begin_section("rows")
        for row_index, row in enumerate(model.all_rows):
            builder.append_store(
                StorageLocation(array)[row_index],
                get_value(row),
                f"{row.name}, {row.unit}{unit_suffix}{_describe_exclusion(model, row)}",
            )
        arguments = (*STATE, PARAMETERS, make_output_argument(array))
        return builder.build_kernel(arguments if reads_velocity else (*STATE[:2], *arguments[3:]))

    note = " Rows marked 'open' or 'redundant' do not constrain the motion."
    note *= any(_describe_exclusion(model, row) for row in model.all_rows)
    return [
        make_kernel(
            "constraints", f"Phi(q, t) of the closed linkage; m and rad.{note}", "phi", False, lambda row: row.phi
        ),
        _make_jacobian_kernel(model),
        make_kernel(
            "velocity_rhs",
            "Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).",
            "nu",
            False,
            lambda row: row.nu,
            "/s",
        ),
        make_kernel(
            "acceleration_rhs",
            "Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).",
            "gamma_rows",
            True,
            lambda row: row.gamma,
            "/s^2",
        ),
    ]


def _describe_exclusion(model: Model, row: Row) -> str:
    """Return the end of an equation's comment if the equation does not constrain the motion, else "".

    Examples: "; open, B has play" and "; redundant, left out".
    """
    if row.owner in model.scene.play:
        return f"; open, {row.owner} has play"
    return "; redundant, left out" if row.name in model.redundancy.dropped else ""


def _make_jacobian_kernel(model: Model) -> Kernel:
    """Return the kernel of the dense Jacobian Φ_q, row by row, of all equations, also of joints with play.

    It writes only the non-zero entries and leaves the others as they are.
    """
    builder = KernelBuilder(
        model.symbols,
        "jacobian",
        ["The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written."],
    )
    builder.begin_section("non-zeros")
    column_of = {q: k for k, q in enumerate(model.q)}
    for row_index, row in enumerate(model.all_rows):
        for q, value in row.phi_q.items():
            builder.append_store(
                StorageLocation("phi_q")[row_index * len(model.q) + column_of[q]], value, f"d {row.name} / d {q.name}"
            )
    return builder.build_kernel((*STATE[:2], PARAMETERS, make_output_argument("phi_q")))


def make_start_kernel(model: Model) -> Kernel:
    """Return the kernel that writes the values of the file's `start` to the arrays `guess`, `set` and `rates`.

    `guess`: initial guesses of coordinates for the search of a position; `set`: prescribed coordinates, then the
    prescribed eccentricities of journals and sliders; `rates`: prescribed velocities, then the rates of these
    eccentricities. For sliders the negative values are stored.
    """
    builder = KernelBuilder(
        model.symbols,
        "start_values",
        ["Values of the file's start: guesses, set values, then rates; those of journals follow."],
    )
    builder.begin_section("start")
    for key, group in list_start_values(model).items():
        for k, (quantity, sign) in enumerate(group):
            builder.append_store(
                StorageLocation(key)[k], sign * model.parameter_table.get_or_add_parameter(quantity), quantity.address
            )
    arguments = (PARAMETERS, *(make_output_argument(key) for key in ("guess", "set", "rates")))
    return builder.build_kernel(arguments)
