"""Writes model.h: what the engine must know of a scene, as sizes, fields of Parameters and small tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import accumulate
from typing import Any

import sympy as sp

from gudgeon.contract.kernel_source import ENGINE_ENDS
from gudgeon.generator.equations.model import SIGNS, Model, eccentricity_rows
from gudgeon.generator.equations.notes import drives_with_jumps, has_jumps
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.field import Field
from gudgeon.generator.format.sections import FILE
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels import outputs
from gudgeon.generator.kernels.event_functions import depends_on_state, ranges_kernel
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kinds.joints.joint_type import CORNERS
from gudgeon.generator.kinds.laws.law import BREAKAWAY, DEEPEST
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.pivots import EARLY, LIGHT_PIVOT, NEARLY_SINGULAR, SINGULAR, VANISHING
from gudgeon.generator.solvers.square_rows import SHARE
from gudgeon.generator.symbols.curves import KnotsOf
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.switches import PeriodsOf
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.printer import broken, comment_text
from gudgeon.language.units import DIMENSIONLESS, POWER, PRESSURE, VISCOSITY, Dimension

_NAMED = {PRESSURE: "Pa", VISCOSITY: "Pa*s", POWER: "W"}


def parameter_fields(slots: ParameterTable) -> list[tuple[str, str]]:
    """Return name and comment of each field of Parameters, in the order of the struct."""
    known: dict[sp.Symbol, Dimension | None] = {}
    fields = []
    inner = {symbol for table in slots.tables.values() for symbol in table[1:]}
    sizes = {table[0]: f"{name}[{len(table)}]" for name, table in slots.tables.items()}
    for entry in slots.entries.values():
        known[entry.symbol] = entry.dimension
        if entry.symbol in inner:
            continue
        turn = entry.address.endswith(".theta") and entry.dimension == DIMENSIONLESS
        unit = "rad" if turn else _unit_of_law(entry.address) or unit_text(entry.dimension)
        name = sizes.get(entry.symbol, slots.field(entry.symbol))
        address = entry.address.rpartition(".")[0] if entry.symbol in sizes else entry.address
        fields.append((name, comment_text(f"{address}, {unit}")))
    for symbol, value in slots.derived.items():
        known[symbol] = _dimension(value, known)
        own = known[symbol]
        message = (slots.symbols.info[symbol].meaning, unit_text(own) if own else "")
        fields.append((slots.field(symbol), comment_text(", ".join(filter(None, message)))))
    return fields


def _unit_of_law(address: str) -> str:
    """Return the meaning of a law's coefficient in N/m^n, whose unit depends on an exponent; "" for others."""
    field: Field | None = FILE if address.startswith("contacts.") else None
    for part in address.split("."):
        field = field and field.below(part)
    return field.meaning if field and field.any_dimension else ""


def unit_text(dimension: Dimension) -> str:
    """Return a dimension as a unit: N*m, Pa, N*s/m^1.5, kg*m^2; 1 for a plain number and rad."""
    if unit := _NAMED.get(dimension):
        return unit
    powers = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time}
    if dimension.mass == 1 and dimension.time in (-1, -2):
        powers = {"N": Fraction(1), "m": dimension.length - 1, "s": dimension.time + 2}
    above, below = _product(powers), _product({unit: -n for unit, n in powers.items()})
    many = f"({below})" if "*" in below else below
    return f"{above or 1}/{many}" if below else above or "1"


def _product(powers: Mapping[str, Fraction]) -> str:
    """Return the product of units with positive powers: N*s, m^1.5."""
    exact = {unit: f"{float(n):g}" if n.denominator in (1, 2, 4) else f"({n})" for unit, n in powers.items() if n > 0}
    return "*".join(unit if n == "1" else f"{unit}^{n}" for unit, n in exact.items())


def _dimension(value: sp.Expr, known: dict[sp.Symbol, Dimension | None]) -> Dimension | None:
    """Return the dimension of a derived parameter; None if it depends on an exponent that is a parameter."""
    if value.is_Symbol:
        return known.get(value)
    if value.is_Add:
        return next((d for term in value.args if (d := _dimension(term, known))), DIMENSIONLESS)
    if value.is_Mul:
        product: Dimension | None = DIMENSIONLESS
        for factor in value.args:
            own = _dimension(factor, known)
            product = product * own if product and own else None
        return product
    if value.is_Pow:
        base, exponent = _dimension(value.base, known), value.exp
        if base is None or base == DIMENSIONLESS:
            return base
        return base ** Fraction(int(exponent.p), int(exponent.q)) if exponent.is_Rational else None
    if isinstance(value, (sp.Max, sp.Min, sp.Abs)):
        return _dimension(value.args[0], known)
    return DIMENSIONLESS


Sizes = dict[str, tuple[int | float, str]]

_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}  # coordinate of which each rate is the derivative
_OF_JOINTS = {
    "radial_clearance": "Radial clearance of joint i with play, m.",
    "deepest": "The penetration beyond which contact laws mean nothing, m: a tenth of the bearing's radius.",
    "min_approach_speed": "The least velocity that counts as that of an impact, m/s.",
    "breakaway": "The deflection at which friction with an inner state slides, m; 0: not known.",
    "restitution_of": "Where surfaces do not give, speed of parting by speed of approach.",
    "threshold_of": "Where surfaces do not give, the speed of parting below which a contact closes, m/s.",
}
_THRESHOLDS: Sizes = {
    limit.name: (limit, meaning)
    for limit, meaning in (
        (SINGULAR, "where it depends on others"),
        (NEARLY_SINGULAR, "where it nearly does"),
        (VANISHING, "where one of a joint's two rows vanishes: links in one line"),
        (EARLY, "of two rows that are solved before all of their coordinates"),
        (LIGHT_PIVOT, "of what turns with an angle, where its inertia is too small for it"),
        (SHARE, "of as many rows as unknowns: the root of SINGULAR"),
    )
}
_GAINS = {"two_alpha": "baumgarte_two_alpha", "beta_squared": "baumgarte_beta_squared", "stick": "stick_gain"}


def header_values(program: Program, bounds: Kernel | None) -> dict[str, Any]:
    """Return the substitutions of the template of model.h; `bounds` is the kernel of `known_bounds`."""
    model, of_scene = program.model, sizes(program, bounds)
    if series := program.series:
        of_scene["TAYLOR"] = (max(len(series.products), 1), "products of the Taylor series of the motion")
    mechanism = model.scene.mechanism
    return {
        "title": printer.comment_text(mechanism.title or mechanism.name),
        "mechanism": mechanism.name,
        "scene": model.scene.name,
        "sha256": mechanism.sha256,
        "parameters": parameter_fields(model.slots),
        "sizes": _defines(of_scene),
        "thresholds": _defines(_THRESHOLDS),
        "tables": _tables(program, of_scene),
        "engine_ends": ENGINE_ENDS,
        "gains": _gains(program),
    }


def sizes(program: Program, bounds: Kernel | None) -> Sizes:
    """Return sizes by name with their meaning; code for what has size 0 is left out of the library."""
    return _linkage_sizes(program) | _motion_sizes(program) | _monitoring_sizes(program, bounds) | _start_sizes(program)


def _linkage_sizes(program: Program) -> Sizes:
    """Return the numbers of coordinates, constraint equations, joints, switching functions and others."""
    model = program.model
    switches = max(model.symbols.switches.count, program.integrated.system.model.symbols.switches.count)
    return {
        "N_Q": (len(model.q), "coordinates of all bodies"),
        "N_ROWS": (len(model.rows), "constraint rows of the motion"),
        "N_ALL_ROWS": (len(model.all_rows), "rows of the closed linkage"),
        "N_JOINTS": (len(outputs.constraining_joints(model)), "joints without play"),
        "N_DRIVES": (len(model.scene.mechanism.drives), "drives"),
        "N_CLEARANCES": (len(model.clearances), "joints with play"),
        "LAW_STATES": (model.law_states, "inner states of the laws of a joint with play, at most"),
        "N_FRICTIONS": (len(model.frictions), "slips that friction may hold"),
        "N_SWITCHES": (switches, "corners of min, max, abs and sign"),
        "N_USER_EVENTS": (len(model.events), "expressions whose zeros are watched"),
        "N_SERIES": (len(outputs.element_series(model)), "results of force elements"),
    }


def _motion_sizes(program: Program) -> Sizes:
    """Return the sizes of the integrated equations and of their matrices."""
    integrated, chain, course, tree = program.integrated, program.integrated.chain, program.course, program.tree
    system, newton = integrated.system, program.methods.newton if program.methods else None
    return {
        "INTEGRATES": (int(program.integrates), "1; 0: no freedom is left, positions follow from the drives"),
        "TREE": (int(tree is not None), "1: in coordinates of a tree of bodies; 0: in those of all bodies"),
        "POSITIONS_IN_TREE": (int(course is not None and course.rows is not None), "the same, where they follow"),
        "N_X": (len(system.q), "coordinates that are integrated"),
        "N_LOOPS": (len(system.rows), "constraint rows of these"),
        "N_CHAIN": (len(system.known), "coordinates that drives determine through loops"),
        "N_LED": (len(system.known) + 2 * len(chain.directions) if chain else 0, "these, cosines and sines of angles"),
        "SMOOTH_CHAINS": (int(bool(tree and tree.chains and not tree.chains.corners)), "their drives have no corners"),
        "TREE_PIVOTS": (len(integrated.pivots) - len(chain.rows) if chain else 0, "statuses of chains follow these"),
        "RESCUED": (int(tree is not None and tree.rescued), "pivots may vanish: all bodies' equations help"),
        "LARGEST_BLOCK": (_largest_block(program), "rows that are solved together"),
        "N_VALUES": (newton.values.size if newton else 0, "of the linearized equations"),
        "N_FACTORS": (newton.factors.size if newton else 0, "of their factors L and U"),
        "IMPLICIT_STAGES": (int(program.staged), "1: there are methods that find their stages together"),
        "HAS_LANES": (int(program.has_lanes), "runs go side by side"),
    }


def _monitoring_sizes(program: Program, bounds: Kernel | None) -> Sizes:
    """Return the sizes of what is monitored within a step: event functions, terms of time, jumps."""
    model = program.model
    sizes: Sizes = {
        "DRIVE_IMPULSES": (
            int(bool(drives_with_jumps(model))),
            "drives' rates may jump, and something is free to move",
        ),
        "RATE_JUMPS": (int(has_jumps(model)), "the rate of some drive may jump"),
        "N_WATCHED": (len(watched_corners(program)) + len(model.events), "corners of expressions, and events"),
        "KNOWN_BOUNDS": (int(bounds is not None), "bounds of what is watched are known over ranges of the state"),
        "WATCHES_STATE": (int(bounds is not None and depends_on_state(bounds)), "they hang on more than time"),
        "N_TERMS": (program.terms.count, "terms of time alone, which may hide within a step"),
        "N_PULSES": (program.terms.pulses, "of these, the first: those that may in a step of any motion"),
    }
    systems = (model, program.integrated.system.model)
    switches = [switch.g for some in systems for switch in some.symbols.switches.found.values()]
    if model.rigid:
        sizes["N_RIGID"] = (len(model.rigid), "joints with play whose surfaces do not give")
    if model.rigid_with_friction:
        sizes["N_RUBBED"] = (len(model.rigid_with_friction), "of them, with friction")
    if idle := idle_switches(program):
        sizes["N_IDLE"] = (len(idle), "of N_SWITCHES that what is integrated does not have")
    if any(g.has(PeriodsOf) for g in switches):
        sizes["PERIODS"] = (1, "mod begins anew within the motion")
    if any(g.has(KnotsOf) for g in switches):
        sizes["KNOTS"] = (1, "curves change from piece to piece within the motion")
    if any(clearance.contour for clearance in model.clearances):
        sizes["CONTOURS"] = (1, "bearings are no circles")
    if corners := first_corners(model):
        sizes["WALLS"] = (len(corners), "guides in which sliders have play: corners at walls")
        sizes["SLIDER_CORNERS"] = (len(CORNERS), "of each slider")
    return sizes


def _start_sizes(program: Program) -> Sizes:
    """Return the sizes of the start."""
    start, guess = _start_indices(program.model), program.model.scene.mechanism.start.guess
    apart = eccentricity_rows(program.model)
    sizes: Sizes = {
        "N_GUESS": (len(start["guess_place"]), "coordinates that the start guesses"),
        "GUESSED_POINTS": (int(any(name.count(".") > 1 for name in guess)), "some of them are those of points"),
        "N_SET": (len(start["set_place"]), "those that it sets"),
        "N_RATES": (len(start["rate_place"]), "velocities that it sets"),
    }
    return sizes | {"N_APART": (len(apart), "rows that it holds apart: eccentricities of journals")} if apart else sizes


def first_corners(model: Model) -> list[int]:
    """Return the index of the first corner of each guide with play among joints with play; three others follow it."""
    return [k for k, c in enumerate(model.clearances) if c.wall][:: len(CORNERS)]


def known_bounds(program: Program) -> Kernel | None:
    """Return the kernel that bounds event functions, None if they depend on forces or driven loops."""
    model, corners = program.model, watched_corners(program)
    watched = program.integrated.watched if program.integrates else program.watched if model.events else None
    if watched is None or not (corners or model.events):
        return None
    return ranges_kernel(watched, corners, len(model.events))


def watched_corners(program: Program) -> list[int]:
    """Return the indices of the scene's own switching functions."""
    if program.integrates:
        return program.integrated.corners
    return sorted(switch.index for switch in program.model.symbols.switches.of(""))


def idle_switches(program: Program) -> list[int]:
    """Return the indices of switching functions that only the full formulation evaluates."""
    own, every = program.integrated.system.model.symbols.switches, program.model.symbols.switches
    used = {switch.index for switch in own.found.values()}
    return [k for k in range(max(own.count, every.count)) if k not in used] if program.integrates else []


def deepest(clearance: Clearance) -> sp.Expr:
    """Return the penetration up to which contact laws are valid: a tenth of the bearing's radius or a law's own."""
    tenth = sp.sympify(clearance.pair.R_i) / 10
    return sp.Min(clearance.constants[DEEPEST], tenth) if DEEPEST in clearance.constants else tenth


def _largest_block(program: Program) -> int:
    """Return the largest number of constraint equations that are solved together."""
    rows, chains = program.course and program.course.rows, program.tree and program.tree.chains
    return max(rows.largest if rows else 0, chains.square.largest if chains else 0)


def _defines(values: Sizes) -> list[str]:
    """Return #define lines with comments."""
    width = max(len(f"{name} {value}") for name, (value, _) in values.items())
    return [f"#define {f'{name} {value}':<{width}} /* {meaning} */" for name, (value, meaning) in values.items()]


def _tables(program: Program, of_scene: Sizes) -> list[str]:
    """Return the tables of model.h as C: indices of start values, constraint equations and coordinates."""
    model, start, drives = program.model, _start_indices(program.model), program.model.scene.mechanism.drives
    place = {row.name: r for r, row in enumerate(model.all_rows)}
    column = {q: k for k, q in enumerate(model.q)}
    tables: dict[tuple[str, str], Sequence[int]] = {
        ("signed char", "event_direction"): [SIGNS[event.direction] for event in model.events],
        ("unsigned char", "event_stops"): [int(event.action == "stop") for event in model.events],
        ("int", "guess_place"): start["guess_place"],
        ("int", "set_place"): start["set_place"],
        ("int", "rate_place"): start["rate_place"],
        ("int", "drive_row"): [place[d] for d in drives],
        ("unsigned char", "row_is_length"): [int(row.unit == "m") for row in model.all_rows],
        ("int", "kept_row"): [place[row.name] for row in model.rows],
        ("int", "phi_q_first"): [0, *accumulate(len(row.phi_q) for row in model.all_rows)],
        ("short", "phi_q_place"): [column[q] for row in model.all_rows for q in row.phi_q],
        ("unsigned char", "is_angle"): program.integrated.angles,
        ("unsigned char", "film_joint"): [int(c.film is not None) for c in model.clearances],
    }
    if apart := [k for k, _, _ in eccentricity_rows(model)]:
        tables |= {("int", "apart_row"): apart}
    if model.rigid:
        tables |= {("unsigned char", "rigid_joint"): [int(c.rigid) for c in model.clearances]}
    if corners := first_corners(model):
        tables |= {("int", "first_corner"): corners}
    if idle := idle_switches(program):
        tables |= {("short", "idle"): idle}
    if program.integrates:
        tables |= _monitoring_tables(program, of_scene) | {
            ("int", "friction_of_pivot"): _friction_pivots(program.integrated.kkt)
        }
    return [_table(kind, name, values) for (kind, name), values in tables.items()]


def _table(kind: str, name: str, values: Iterable[int]) -> str:
    """Return one table as C; an empty one contains one unused number."""
    return "\n".join(broken(f"static const {kind} {name}[] = {{{', '.join(map(str, values)) or 0}}};"))


def _monitoring_tables(program: Program, of_scene: Sizes) -> dict[tuple[str, str], Sequence[int]]:
    """Return the tables of monitored event functions in C's order, and of switches whose branches meet."""
    count = {name: value for name, (value, _) in of_scene.items()}
    first = int(count["N_CLEARANCES"] + count["N_SWITCHES"] + count["N_FRICTIONS"])
    event_functions = [int(count["N_CLEARANCES"]) + k for k in program.integrated.corners]
    event_functions += range(first, first + int(count["N_USER_EVENTS"]))
    place = {k: i for i, k in enumerate(event_functions)}
    return {
        ("short", "watched"): event_functions,
        ("short", "watched_as"): [place.get(k, -1) for k in range(first + int(count["N_USER_EVENTS"]))],
        ("unsigned char", "meets"): _continuous_switches(program.model, int(count["N_SWITCHES"])),
    }


def _continuous_switches(model: Model, count: int) -> list[int]:
    """Return 1 for switching functions of contact laws, whose branches meet; others, and laws as printed, may jump."""
    printed = {c.name for c in model.clearances if c.film is not None and c.film.options.get("as_printed")}
    owners = {switch.index: switch.owner for switch in model.symbols.switches.found.values()}
    return [int(bool(owners.get(k)) and owners[k] not in printed) for k in range(count)]


def _friction_pivots(kkt: KKT) -> list[int]:
    """Return the index of the friction element of each pivot after those of constraint equations."""
    names = [friction.name for friction in kkt.frictions]
    return [names.index(pivot) for pivot in kkt.pivots[len(kkt.rows) : len(kkt.rows) + len(names)]]


def _start_indices(model: Model) -> dict[str, list[int]]:
    """Return the indices in q of guessed and set coordinates, and of set velocities."""
    place = {model.symbols.info[q].meaning: k for k, q in enumerate(model.q)}
    start = model.scene.mechanism.start
    rates = (name.partition(".") for name in start.rates)
    return {
        "guess_place": [place.get(name, 0) for name in start.guess],
        "set_place": [place[name] for name in start.set],
        "rate_place": [place[f"{body}.{_POSITION[rate]}"] for body, _, rate in rates],
    }


def joint_parameters(model: Model) -> list[tuple[str, str, list[str]]]:
    """Return parameters of joints with play: their meaning, the function that returns them, a value for each joint."""
    values = {
        "radial_clearance": [c.pair.c for c in model.clearances],
        "deepest": [deepest(c) for c in model.clearances],
        "min_approach_speed": [c.velocity_floor for c in model.clearances],
    }
    if model.law_states:
        values["breakaway"] = [c.constants.get(BREAKAWAY, 0) for c in model.clearances]
    if model.rigid:
        values |= {
            f"{name}_of": [c.normal.numbers[name] if c.rigid and c.normal else 0 for c in model.clearances]
            for name in ("restitution", "threshold")
        }
    message = dict(_OF_JOINTS)
    if any(DEEPEST in c.constants for c in model.clearances):
        message["deepest"] = message["deepest"].replace("radius.", "radius, or a law's own.")
    if any(c.wall for c in model.clearances):
        message["deepest"] = message["deepest"].replace("radius", "radius, of half a guide's width", 1)
    return [
        (message[name], name, [printer.expression(model.symbols.in_place(sp.sympify(x))) for x in some])
        for name, some in values.items()
    ]


def _gains(program: Program) -> list[tuple[str, str]]:
    """Return the gains of Newton's matrix as C; the reduced formulation has no Baumgarte terms."""
    if program.methods is None:
        return []
    gains = program.methods.gains
    return [(name, f"p->{gains[key]}" if key in gains else "0.0") for key, name in _GAINS.items()]
