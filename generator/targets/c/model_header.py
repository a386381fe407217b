"""Writes model.h: sizes (macros), the struct Parameters and index tables of a scene, which the engine reads."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import Any

import sympy as sp

from gudgeon.contract.kernel_source import ENGINE_ENDS
from gudgeon.generator.equations.model import SIGNS, Model, find_eccentricity_rows
from gudgeon.generator.equations.notes import find_drives_with_jumps, has_drive_with_jumps
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels import outputs
from gudgeon.generator.kernels.event_functions import depends_on_state, make_ranges_kernel
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kinds.joints.joint_type import CORNERS
from gudgeon.generator.kinds.laws.law import BREAKAWAY, MAX_PENETRATION
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.pivots import EARLY, LIGHT_PIVOT, NEARLY_SINGULAR, SINGULAR, VANISHING
from gudgeon.generator.solvers.square_rows import SINGULAR_SQUARE
from gudgeon.generator.symbols.curves import KnotsOf
from gudgeon.generator.symbols.switches import PeriodsOf
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.parameter_fields import list_parameter_fields
from gudgeon.generator.targets.c.printer import break_code

Sizes = dict[str, tuple[int | float, str]]  # macro -> (value, meaning)

_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}  # coordinate of which each rate is the derivative
_PENETRATION_LIMIT = "max_valid_penetration"
_PARAMETER_MEANINGS = {
    "radial_clearance": "Radial clearance of joint i with play, m.",
    _PENETRATION_LIMIT: "The penetration beyond which contact laws are not valid, m: a tenth of the bearing's radius.",
    "min_approach_speed": "The smallest approach speed that is stored at an onset, m/s.",
    "breakaway": "The deflection at which friction with an internal state slides, m; 0: unknown.",
    "restitution_of": "Rigid surfaces: separation speed divided by approach speed.",
    "threshold_of": "Rigid surfaces: the separation speed below which a contact closes, m/s.",
}
_THRESHOLDS: Sizes = {
    limit.name: (limit, meaning)
    for limit, meaning in (
        (SINGULAR, "if it depends on others"),
        (NEARLY_SINGULAR, "if it nearly depends on others"),
        (VANISHING, "if one of a joint's two pivots vanishes: links in one line"),
        (EARLY, "of two equations that are solved before all of their coordinates"),
        (LIGHT_PIVOT, "of the bodies that turn with an angle, if their inertia is too small"),
        (SINGULAR_SQUARE, "of as many equations as unknowns: the root of SINGULAR"),
    )
}
_GAINS = {"two_alpha": "baumgarte_two_alpha", "beta_squared": "baumgarte_beta_squared", "stick": "stick_gain"}


def make_header_values(program: Program, bounds: Kernel | None) -> dict[str, Any]:
    """Return {variable of the template model.h.jinja: value}.

    The values are fields of Parameters, #defines of sizes and thresholds, tables, and Baumgarte's gains in Newton's
    matrix. bounds: the kernel of `make_bounds_kernel`, or None.
    """
    model, scene_sizes = program.model, list_size_macros(program, bounds)
    if series := program.series:
        scene_sizes["TAYLOR"] = (max(len(series.products), 1), "products of the Taylor series of the motion")
    mechanism = model.scene.mechanism
    return {
        "title": printer.sanitize_comment(mechanism.title or mechanism.name),
        "mechanism": mechanism.name,
        "scene": model.scene.name,
        "sha256": mechanism.sha256,
        "parameters": list_parameter_fields(model.parameter_table),
        "sizes": _print_defines(scene_sizes),
        "thresholds": _print_defines(_THRESHOLDS),
        "tables": _print_tables(program, scene_sizes),
        "engine_ends": ENGINE_ENDS,
        "gains": _list_newton_gains(program),
    }


def list_size_macros(program: Program, bounds: Kernel | None) -> Sizes:
    """Return {macro: (value, meaning)} of all sizes in model.h, by which the engine sizes arrays and leaves out code.

    bounds: the kernel of `make_bounds_kernel`, or None.
    """
    return (
        _list_linkage_sizes(program)
        | _list_motion_sizes(program)
        | _list_monitoring_sizes(program, bounds)
        | _list_initial_condition_sizes(program)
    )


def _list_linkage_sizes(program: Program) -> Sizes:
    """Return {macro: (value, meaning)} of coordinates, constraint equations, joints, drives and switching functions."""
    model = program.model
    switches = max(model.symbols.switches.count, program.integrated.system.model.symbols.switches.count)
    return {
        "N_Q": (len(model.q), "coordinates of all bodies"),
        "N_ROWS": (len(model.rows), "constraint equations of the motion"),
        "N_ALL_ROWS": (len(model.all_rows), "constraint equations of the closed linkage"),
        "N_JOINTS": (len(outputs.find_constraining_joints(model)), "joints without play"),
        "N_DRIVES": (len(model.scene.mechanism.drives), "drives"),
        "N_CLEARANCES": (len(model.clearances), "joints with play"),
        "LAW_STATES": (model.law_states, "internal states of the laws of a joint with play, at most"),
        "N_FRICTIONS": (len(model.frictions), "friction elements, which may stick"),
        "N_SWITCHES": (switches, "switching functions of min, max, abs and sign"),
        "N_USER_EVENTS": (len(model.events), "expressions whose zeros are events"),
        "N_SERIES": (len(outputs.list_force_element_series(model)), "results of force elements"),
    }


def _list_motion_sizes(program: Program) -> Sizes:
    """Return {macro: (value, meaning)} of the integrated equations, driven loops, Newton's matrix and its factors.

    Flags have the values 0 and 1.
    """
    integrated, kinematics, tree = program.integrated, program.kinematics, program.tree
    driven_loops, system = integrated.driven_loops, integrated.system
    newton = program.methods.newton if program.methods else None
    return {
        "INTEGRATES": (int(program.integrates), "1: integrated; 0: no degree of freedom, drives determine positions"),
        "TREE": (int(tree is not None), "1: tree coordinates; 0: coordinates of all bodies"),
        "POSITIONS_IN_TREE": (
            int(kinematics is not None and kinematics.rows is not None),
            "the same for kinematic analysis",
        ),
        "N_X": (len(system.q), "coordinates that are integrated"),
        "N_LOOPS": (len(system.rows), "constraint equations of these"),
        "N_DEPENDENT": (len(system.dependent), "dependent coordinates, which drives determine through loops"),
        "N_DEPENDENT_VALUES": (
            len(system.dependent) + 2 * len(driven_loops.directions) if driven_loops else 0,
            "these, and cosines and sines of their angles",
        ),
        "SMOOTH_DRIVEN_LOOPS": (
            int(bool(tree and tree.driven_loop_kernels and not tree.driven_loop_kernels.switch_kernel)),
            "1: drives of driven loops have no switching functions",
        ),
        "TREE_PIVOTS": (
            len(integrated.pivots) - len(driven_loops.rows) if driven_loops else 0,
            "statuses of pivots before those of driven loops",
        ),
        "HAS_ABSOLUTE_FALLBACK": (
            int(tree is not None and tree.has_fallback),
            "1: if a pivot vanishes, absolute coordinates are used",
        ),
        "LARGEST_BLOCK": (_find_largest_block_size(program), "constraint equations that are solved together"),
        "N_VALUES": (newton.values.size if newton else 0, "values of the linearized equations"),
        "N_FACTORS": (newton.factors.size if newton else 0, "values of their factors L and U"),
        "IMPLICIT_STAGES": (int(program.has_complex_stages), "1: there are methods that solve all stages together"),
        "HAS_LANES": (int(program.has_lanes), "runs in vector lanes"),
    }


def _list_monitoring_sizes(program: Program, bounds: Kernel | None) -> Sizes:
    """Return {macro: (value, meaning)} of event functions, terms of time and jumps that the integrator monitors.

    Macros for rigid contacts, mod(), curves, contours and guides exist only if the scene has them. `bounds`: the kernel
    of `make_bounds_kernel`, or None.
    """
    model = program.model
    sizes: Sizes = {
        "DRIVE_IMPULSES": (
            int(bool(find_drives_with_jumps(model))),
            "1: rates of drives may jump, and there are degrees of freedom",
        ),
        "RATE_JUMPS": (int(has_drive_with_jumps(model)), "1: the rate of a drive may jump"),
        "N_MONITORED": (
            len(find_monitored_switches(program)) + len(model.events),
            "monitored switching functions and user events",
        ),
        "KNOWN_BOUNDS": (
            int(bounds is not None),
            "1: bounds of monitored functions over ranges of the state are known",
        ),
        "MONITORS_STATE": (
            int(bounds is not None and depends_on_state(bounds)),
            "1: the bounds depend on the state, not only on time",
        ),
        "N_TERMS": (program.time_terms.count, "terms that depend on time only, whose changes a step may miss"),
        "N_TRANSIENTS": (
            program.time_terms.n_transients,
            "the first of these: transients that a step of any motion may miss",
        ),
    }
    systems = (model, program.integrated.system.model)
    switches = [switch.g for some in systems for switch in some.symbols.switches.switch_by_key.values()]
    if model.rigid:
        sizes["N_RIGID"] = (len(model.rigid), "joints with play and rigid surfaces")
    if model.rigid_with_friction:
        sizes["N_RIGID_WITH_FRICTION"] = (len(model.rigid_with_friction), "of these, joints with friction")
    if unused_switches := find_unused_switches(program):
        sizes["N_UNUSED_SWITCHES"] = (
            len(unused_switches),
            "switching functions that the integrated equations do not contain",
        )
    if any(g.has(PeriodsOf) for g in switches):
        sizes["PERIODS"] = (1, "1: mod() passes from one period to the next within the motion")
    if any(g.has(KnotsOf) for g in switches):
        sizes["KNOTS"] = (1, "1: curves pass from one piece to the next within the motion")
    if any(clearance.contour for clearance in model.clearances):
        sizes["CONTOURS"] = (1, "1: some bearings are not circular")
    if first_corners := find_first_corners(model):
        sizes["WALLS"] = (len(first_corners), "guides in which sliders have play: corners at walls")
        sizes["SLIDER_CORNERS"] = (len(CORNERS), "corners of each slider")
    return sizes


def _list_initial_condition_sizes(program: Program) -> Sizes:
    """Return {macro: (value, meaning)} of the coordinates that the start guesses or sets and of the rates that it sets.

    GUESSED_POINTS is a flag: some guesses are coordinates of points. N_ECCENTRICITIES, the number of specified
    eccentricities of journals, exists only if there are any.
    """
    start_indices, guess = _find_initial_condition_indices(program.model), program.model.scene.mechanism.start.guess
    eccentricity_constraints = find_eccentricity_rows(program.model)
    sizes: Sizes = {
        "N_GUESS": (len(start_indices["guess_coordinate"]), "coordinates that the start gives as guesses"),
        "GUESSED_POINTS": (
            int(any(name.count(".") > 1 for name in guess)),
            "1: some guesses are coordinates of points",
        ),
        "N_SET": (len(start_indices["set_coordinate"]), "coordinates that the start sets"),
        "N_RATES": (len(start_indices["rate_coordinate"]), "velocities that the start sets"),
    }
    return (
        sizes
        | {
            "N_ECCENTRICITIES": (
                len(eccentricity_constraints),
                "constraint equations kept open: eccentricities of journals",
            )
        }
        if eccentricity_constraints
        else sizes
    )


def find_first_corners(model: Model) -> list[int]:
    """Return the index, among joints with play, of the first corner of each slider with play in a guide.

    Each corner counts as a joint with play; the other corners of the slider follow the first one.
    """
    return [k for k, c in enumerate(model.clearances) if c.wall][:: len(CORNERS)]


def make_bounds_kernel(program: Program) -> Kernel | None:
    """Return the kernel that bounds event functions over ranges of the state by interval arithmetic.

    None is returned if no event function is monitored, or if one depends on forces or driven loops.
    """
    model, switch_indices = program.model, find_monitored_switches(program)
    event_functions = (
        program.integrated.event_functions if program.integrates else program.event_functions if model.events else None
    )
    if event_functions is None or not (switch_indices or model.events):
        return None
    return make_ranges_kernel(event_functions, switch_indices, len(model.events))


def find_monitored_switches(program: Program) -> list[int]:
    """Return the indices of the switching functions whose zeros the integrator monitors as events.

    In a kinematic analysis they are all switching functions except those of contact laws.
    """
    if program.integrates:
        return program.integrated.switch_indices
    return sorted(switch.index for switch in program.model.symbols.switches.list_switches(""))


def find_unused_switches(program: Program) -> list[int]:
    """Return the indices of switching functions that the integrated equations do not contain; [] without integration.

    Only the full formulation evaluates them. In a run of the reduced one, the engine sets their values to NaN.
    """
    integrated_switches, all_switches = program.integrated.system.model.symbols.switches, program.model.symbols.switches
    used_indices = {switch.index for switch in integrated_switches.switch_by_key.values()}
    return (
        [k for k in range(max(integrated_switches.count, all_switches.count)) if k not in used_indices]
        if program.integrates
        else []
    )


def get_max_penetration(clearance: Clearance) -> sp.Expr:
    """Return the expression of the penetration (m) up to which the contact laws of a joint are valid.

    It is a tenth of the bearing's radius, or the law's own limit (MAX_PENETRATION) if that is smaller.
    """
    tenth = sp.sympify(clearance.pair.R_i) / 10
    return sp.Min(clearance.constants[MAX_PENETRATION], tenth) if MAX_PENETRATION in clearance.constants else tenth


def _find_largest_block_size(program: Program) -> int:
    """Return the largest number of constraint equations that a kinematic solution solves together; 0 without one.

    Blocks of equations occur in positions of kinematically driven scenes and in driven loops of a tree.
    """
    rows, loop_kernels = (
        program.kinematics and program.kinematics.rows,
        program.tree and program.tree.driven_loop_kernels,
    )
    return max(rows.max_block_size if rows else 0, loop_kernels.square.max_block_size if loop_kernels else 0)


def _print_defines(sizes: Sizes) -> list[str]:
    """Return aligned #define lines with the value and its meaning as a comment."""
    width = max(len(f"{name} {value}") for name, (value, _) in sizes.items())
    return [f"#define {f'{name} {value}':<{width}} /* {meaning} */" for name, (value, meaning) in sizes.items()]


def _print_tables(program: Program, scene_sizes: Sizes) -> list[str]:
    """Return the tables of model.h as C: indices of start values, constraint equations and coordinates, and flags.

    Tables for rigid contacts, guides, eccentricities and monitored functions exist only if the scene needs them.
    """
    model, start_indices, drives = (
        program.model,
        _find_initial_condition_indices(program.model),
        program.model.scene.mechanism.drives,
    )
    row_index = {row.name: r for r, row in enumerate(model.all_rows)}
    coordinate_index = {q: k for k, q in enumerate(model.q)}
    tables: dict[tuple[str, str], Sequence[int]] = {
        ("signed char", "event_direction"): [SIGNS[event.direction] for event in model.events],
        ("unsigned char", "event_stops"): [int(event.action == "stop") for event in model.events],
        ("int", "guess_coordinate"): start_indices["guess_coordinate"],
        ("int", "set_coordinate"): start_indices["set_coordinate"],
        ("int", "rate_coordinate"): start_indices["rate_coordinate"],
        ("int", "drive_row"): [row_index[d] for d in drives],
        ("unsigned char", "row_is_length"): [int(row.unit == "m") for row in model.all_rows],
        ("int", "motion_row"): [row_index[row.name] for row in model.rows],
        ("int", "phi_q_first"): [0, *accumulate(len(row.phi_q) for row in model.all_rows)],
        ("short", "phi_q_column"): [coordinate_index[q] for row in model.all_rows for q in row.phi_q],
        ("unsigned char", "is_angle"): program.integrated.angles,
        ("unsigned char", "film_joint"): [int(c.film is not None) for c in model.clearances],
    }
    if eccentricity_constraints := [k for k, _, _ in find_eccentricity_rows(model)]:
        tables |= {("int", "eccentricity_row"): eccentricity_constraints}
    if model.rigid:
        tables |= {("unsigned char", "rigid_joint"): [int(c.rigid) for c in model.clearances]}
    if first_corners := find_first_corners(model):
        tables |= {("int", "first_corner"): first_corners}
    if unused_switches := find_unused_switches(program):
        tables |= {("short", "unused_switch"): unused_switches}
    if program.integrates:
        tables |= _list_monitoring_tables(program, scene_sizes) | {
            ("int", "friction_of_pivot"): _find_friction_indices_of_pivots(program.integrated.kkt)
        }
    return [_print_table(kind, name, values) for (kind, name), values in tables.items()]


def _print_table(c_type: str, name: str, values: Iterable[int]) -> str:
    """Return one table as a static array in C; an empty table gets one unused 0."""
    return "\n".join(break_code(f"static const {c_type} {name}[] = {{{', '.join(map(str, values)) or 0}}};"))


def _list_monitoring_tables(program: Program, scene_sizes: Sizes) -> dict[tuple[str, str], Sequence[int]]:
    """Return {(C type, table): values} of the tables by which the integrator monitors event functions.

    `monitored_event` lists the monitored functions, `monitored_index` their positions in it (−1: none), and
    `is_continuous_switch` has a flag for each switching function. Indices count gaps of joints with play, then
    switching functions, frictions and user events.
    """
    count = {name: value for name, (value, _) in scene_sizes.items()}
    first = int(count["N_CLEARANCES"] + count["N_SWITCHES"] + count["N_FRICTIONS"])
    event_functions = [int(count["N_CLEARANCES"]) + k for k in program.integrated.switch_indices]
    event_functions += range(first, first + int(count["N_USER_EVENTS"]))
    position = {k: i for i, k in enumerate(event_functions)}
    return {
        ("short", "monitored_event"): event_functions,
        ("short", "monitored_index"): [position.get(k, -1) for k in range(first + int(count["N_USER_EVENTS"]))],
        ("unsigned char", "is_continuous_switch"): _flag_continuous_switches(program.model, int(count["N_SWITCHES"])),
    }


def _flag_continuous_switches(model: Model, n_switches: int) -> list[int]:
    """Return `n_switches` flags: 1 for a switching function at which a force is continuous, 0 if it may jump.

    Those of contact laws are continuous, except films with the option `as_printed`. All others have 0.
    """
    joints_as_printed = {c.name for c in model.clearances if c.film is not None and c.film.options.get("as_printed")}
    owners = {switch.index: switch.owner for switch in model.symbols.switches.switch_by_key.values()}
    return [int(bool(owners.get(k)) and owners[k] not in joints_as_printed) for k in range(n_switches)]


def _find_friction_indices_of_pivots(kkt: KKT) -> list[int]:
    """Return the index of the friction element of each friction pivot of a KKT matrix, in the order of elimination.

    Pivots of friction elements follow those of the constraint equations.
    """
    names = [friction.name for friction in kkt.frictions]
    return [names.index(pivot) for pivot in kkt.pivots[len(kkt.rows) : len(kkt.rows) + len(names)]]


def _find_initial_condition_indices(model: Model) -> dict[str, list[int]]:
    """Return {table: indices}: in q those of guessed and set coordinates, in v those of set velocities.

    A guess that is the coordinate of a point, not of a body, has the index 0.
    """
    coordinate_index = {model.symbols.info[q].meaning: k for k, q in enumerate(model.q)}
    start = model.scene.mechanism.start
    rates = (name.partition(".") for name in start.rates)
    return {
        "guess_coordinate": [coordinate_index.get(name, 0) for name in start.guess],
        "set_coordinate": [coordinate_index[name] for name in start.set],
        "rate_coordinate": [coordinate_index[f"{body}.{_POSITION[rate]}"] for body, _, rate in rates],
    }


def list_joint_parameters(model: Model) -> list[tuple[str, str, list[str]]]:
    """Return (meaning, name of the C function, [C expression for each joint]) of the parameters of joints with play.

    Each C function returns one parameter, such as the radial clearance, of joint i. Breakaway is included only if laws
    have internal states, restitution and threshold only if contacts are rigid.
    """
    values = {
        "radial_clearance": [c.pair.c for c in model.clearances],
        _PENETRATION_LIMIT: [get_max_penetration(c) for c in model.clearances],
        "min_approach_speed": [c.velocity_floor for c in model.clearances],
    }
    if model.law_states:
        values["breakaway"] = [c.constants.get(BREAKAWAY, 0) for c in model.clearances]
    if model.rigid:
        values |= {
            f"{name}_of": [c.normal.parameters[name] if c.rigid and c.normal else 0 for c in model.clearances]
            for name in ("restitution", "threshold")
        }
    meanings = dict(_PARAMETER_MEANINGS)
    if any(MAX_PENETRATION in c.constants for c in model.clearances):
        meanings[_PENETRATION_LIMIT] = meanings[_PENETRATION_LIMIT].replace("radius.", "radius, or the limit of a law.")
    if any(c.wall for c in model.clearances):
        meanings[_PENETRATION_LIMIT] = meanings[_PENETRATION_LIMIT].replace(
            "radius", "radius, of half a guide's width", 1
        )
    return [
        (
            meanings[name],
            name,
            [printer.print_expression(model.symbols.read_from_storage_locations(sp.sympify(x))) for x in joint_values],
        )
        for name, joint_values in values.items()
    ]


def _list_newton_gains(program: Program) -> list[tuple[str, str]]:
    """Return (name, C expression) of the stabilization gains in Newton's matrix, "0.0" for gains that do not occur.

    [] without implicit methods.
    """
    if program.methods is None:
        return []
    gains = program.methods.gains
    return [(name, f"p->{gains[key]}" if key in gains else "0.0") for key, name in _GAINS.items()]
