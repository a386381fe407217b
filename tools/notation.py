"""Write docs/notation.md: symbol, YAML key, Python name and C name of each quantity, from the declarations.

Symbols of a joint with play are those of the LaTeX target, units and series those of a result, keys and symbols of the
laws' parameters those of their declarations. The paper is X. Chen, S. Gao, T. Wang, Nonlinear Dynamics (2022),
doi 10.1007/s11071-022-07478-4; the tables have its symbols in a column.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import sympy as sp

from gudgeon.generator.equations import contact_steps as steps
from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.format.sections import BEARING, BODY, CONTACT, GUIDE, MATERIAL
from gudgeon.generator.kinds.laws.law import CONSTRAINT_VARIABLES, RESULTS, find_bundled_laws
from gudgeon.generator.targets.latex.letters import make_symbol_name
from gudgeon.generator.targets.latex.notation import get_field_letter
from gudgeon.generator.targets.latex.play import PAIR
from gudgeon.generator.targets.latex.play_letters import GUIDE as GUIDE_LETTERS
from gudgeon.generator.targets.latex.play_letters import LAW_SPECIFIC_NAMES, LAW_SYMBOL_NAMES, NAMES, get_latex_symbol
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit
from gudgeon.results.series import CLEARANCE

PAGE = Path(__file__).resolve().parents[1] / "docs" / "notation.md"
LEAD = """# Notation

This page lists the symbol, the sign convention and the unit of each quantity, and its names in the paper, YAML, Python
and C. Use it to find the variable of the generated C that belongs to a symbol of an equation. "The paper" is Chen, Gao
and Wang (2022).

- Values in Python and C are in SI units, angles in radians. The unit 1 marks a pure number.
- `JOINT`, `BODY` and `NAME` stand for names of the mechanism file; `ROW` is the name of a constraint equation.
- The sign – marks a quantity without a name in that place.
- Each symbol stands for one quantity. In the tables of the laws, $K$, $S$ and $v_0$ are quantities of each law.
- [Physics](physics.md) gives the equations. `make tables` writes this page from the declarations.

Example: the slip velocity $v_t$ of joint A is the series `run["A.vt"]` in Python, and the member `v_t` of
`rhs->clearance[i]` in C. It is positive if the journal's surface moves along t relative to the bearing's.
"""
NONE = "–"
SYSTEM = (  # symbol, quantity, paper, YAML, Python, C, unit
    ("t", "time", "t", "`t`", "`run.t`", "`t`", "s"),
    ("q", "coordinates of all bodies", "q", "`BODY.x`, `.y`, `.theta`", "`run.q`", "`q`", "m, rad"),
    ("\\dot q", "velocities: rates of q", "\\dot q", "`BODY.vx`, `.vy`, `.omega`", "`run.v`", "`v`", "m/s, rad/s"),
    ("\\ddot q", "accelerations: second rates of q", "\\ddot q", "", "`run.a`", "`a`", "m/s², rad/s²"),
    ("M", "mass matrix, diagonal", "M", "", "`equations.mass(p)`", "`mass_matrix`", "kg, kg·m²"),
    ("\\Phi", "constraint equations, Φ = 0", "\\Phi", "", "`equations.phi(t, q, p)`", "`constraints`", "m, rad"),
    ("\\Phi_q", "Jacobian of the constraints", "\\Phi_q", "", "`equations.phi_q(t, q, p)`", "`jacobian`", "1, m"),
    (
        "\\nu",
        "right-hand side of the velocity equation, ν = −∂Φ/∂t",
        "\\upsilon",
        "",
        "`equations.nu(t, q, p)`",
        "`velocity_rhs`",
        "m/s, rad/s",
    ),
    (
        "\\gamma",
        "right-hand side of the acceleration equation",
        "\\gamma",
        "",
        "`equations.gamma(t, q, v, p)`",
        "`acceleration_rhs`",
        "m/s², rad/s²",
    ),
    ("\\lambda", "Lagrange multipliers", "\\lambda", "", '`run["lambda.ROW"]`', "`rhs->lambda`", "N, N·m"),
    ("G", "Delassus operator: −∂δ̈/∂F_n of closed rigid contacts", "", "", "", "`contacts->D`", "1/kg"),
    ("\\alpha", "Baumgarte's gain of the rates of Φ", "\\alpha", "", "`baumgarte.alpha`", "`p->alpha_`", "1/s"),
    ("\\beta", "Baumgarte's gain of Φ", "\\beta", "", "`baumgarte.beta`", "`p->beta_`", "1/s"),
)
PLAY = {  # series: symbol of the equations, the paper's symbol
    "Fx": (steps.F_x, ""),
    "Fy": (steps.F_y, ""),
    "Fn": (sp.Symbol("F_n", real=True), "F_n"),
    "Ft": (steps.F_along_t, "F_t"),
    "ex": (steps.e_x, "e_x"),
    "ey": (steps.e_y, "e_y"),
    "e": (steps.e, "e"),
    "deltadot": (steps.deltadot, "\\dot\\delta"),
    "vt": (steps.v_t, "v_t"),
    "delta": (steps.delta, "\\delta"),
}  # series of CLEARANCE
MEANING = {  # what a formula says more clearly than the words of CLEARANCE
    "e": "eccentricity: distance of the centres of journal and bearing",
    "deltadot": "rate of the penetration, positive in approach",
    "delta": "penetration, δ = e − c; in a non-circular bearing, c is the clearance at the angle of the journal",
    "Fn": "normal force, positive in compression: component along −n of the force on the journal; −F_r in a film alone",
    "Ft": "tangential force: component along t of the force on the journal",
    "vt": "slip of the journal's surface on the bearing's, along t",
}
OF_JOINT = {"ex": "`start.play.JOINT.e`", "ey": "`start.play.JOINT.e`"}  # YAML keys of initial values
C_MEMBER = {"Fn": "-F_n", "Ft": "F_t", "vt": "v_t"}
STEPS = (  # symbol of the equations, quantity, Python, C variable, unit
    (
        steps.stored,
        "approach speed: rate of δ at the onset",
        "`JOINT.deltadot_minus`",
        "contact->deltadot_minus",
        "m/s",
    ),
    (steps.epsilon, "eccentricity ratio e/c", "`JOINT.eps`", "epsilon", "1"),
    (steps.omega_i, "angular velocity of the bearing", "`BODY.omega`", "omega_i", "rad/s"),
    (steps.omega_j, "angular velocity of the journal", "`BODY.omega`", "omega_j", "rad/s"),
    (steps.a_i, "lever arm of F_t about the centre of the bearing", "", "a_i", "m"),
    (steps.a_j, "lever arm of F_t about the centre of the journal", "", "a_j", "m"),
    (steps.w_n, "effective squeeze velocity of a film along n, divided by c", "", "w_n", "1/s"),
    (steps.w_t, "effective squeeze velocity of a film along t, divided by c", "", "w_t", "1/s"),
    (sp.Symbol("F_r", real=True), "force of a film along n", "", "F_r", "N"),
    (steps.share, "fraction of the load that the dry contact carries", "", "share", "1"),
    (
        sp.Symbol(CONSTRAINT_VARIABLES[0], real=True),
        "multiplier of a closed contact of rigid surfaces: its normal force",
        "",
        "contact->force",
        "N",
    ),
    (steps.steep, "length of the gradient of δ in a bearing with a contour", "", "steep", "1"),
    (steps.contour_depth, "depth of a contour beyond the circle, at the angle of the journal", "", "worn", "m"),
    (steps.beta_i, "angle of e in the body of the bearing, with a contour", "", "beta_i", "rad"),
)
SECTIONS = (
    ("Bearings", "bearings.NAME", BEARING),
    ("Guides", "guides.NAME", GUIDE),
    ("Materials", "materials.NAME", MATERIAL),
    ("Bodies", "bodies.BODY", BODY),
    ("Contacts", "contacts.NAME", CONTACT),
)
IN_LAWS = {field: sign for field, sign, _ in PAIR}  # symbols of a bearing in the laws
IN_GUIDE = {field: sign for field, sign, _ in GUIDE_LETTERS}
IN_CONTACT = {"transition": "e_0", "velocity_floor": "v_{\\min}"}  # as physics.md
OF_MATERIAL = {"E": "E_i$, $E_j", "nu": "\\nu_i$, $\\nu_j"}  # of the surface of the bearing or the journal
IN_PAPER = {
    "bearings.NAME.clearance": "r",
    "bearings.NAME.radius": "R_i",
    "bearings.NAME.length": "L",
    "materials.NAME.E": "E",
    "materials.NAME.nu": "\\nu",
    "bodies.BODY.mass": "m",
    "bodies.BODY.inertia": "J",
    "bodies.BODY.length": "L",
}
DERIVED = (  # name in the functions of the laws, quantity, laws, unit
    ("K", "contact stiffness", "laws of the normal force with a stiffness", "N/m^n"),
    ("hysteresis", "hysteresis damping factor, by `dissipation`", "laws with `dissipation`", "1"),
    ("F_e", "elastic force", "`expression`", "N"),
    ("friction_slope", "1/(v_1 − v_0)", "`modified_coulomb`", "s/m"),
    ("z", "deflection of the bristles", "`dahl`, `lugre`", "m"),
    ("film_clearance", "clearance of the film, c + c_a", "all films", "m"),
    ("S", "film factor: the equation of each law defines it", "all films", "N·s"),
    ("root", "√(1 − ε²)", "all films", "1"),
    ("q", "√(w_n² + s_ε² w_t²)", "`finite_length`", "1/s"),
    ("x", "ε w_n/w_ε", "`finite_length`", "1"),
    ("W", "√(w_n² + w_t²)", "`pinkus_sternlicht`, `ocvirk`", "1/s"),
    ("factor", "correction of the squeeze motion", "`pinkus_sternlicht`", "1"),
    ("shear", "shear torque of the centred journal divided by ω_j − ω_i", "films with `shear`", "N·m·s"),
    ("T0", "shear torque M_τ divided by ω_j − ω_i", "films with `shear`", "N·m·s"),
    ("mean_clearance", "clearance between the mean surfaces", "laws of mixed lubrication", "m"),
)


def make_notation_page() -> str:
    """Return the page: equations of motion, a joint with play, parameters of the file, parameters of the laws."""
    head = ("symbol", "quantity", "in the paper", "YAML", "Python", "C", "unit")
    lines = [LEAD, "## Equations of motion", ""]
    lines += [
        "In Python, `run` is a result, `equations` is `simulation.model.numpy()`, and `p` is `equations.prepare()`.",
        "",
    ]
    lines += _format_table(head, ((f"${row[0]}$", row[1], f"${row[2]}$" * bool(row[2]), *row[3:]) for row in SYSTEM))
    lines += [
        "",
        "## A joint with play",
        "",
        "The unit vector n points from the centre of the bearing to the centre of the journal; t is n turned by +90°.",
        'The forces act on the journal. In Python, `run["JOINT.delta"]` returns a series. In C, the structure',
        "`rhs->clearance[i]` contains the quantities of the first table; those of the second are local variables.",
        "",
    ]
    lines += _format_table(head, _iterate_play_rows())
    lines += ["", *_format_table(("symbol", "quantity", "Python", "C", "unit"), _iterate_step_rows())]
    lines += [
        "",
        "## Parameters of the file",
        "",
        "In Python, `parameters={KEY: value}` of a run sets a parameter by its YAML key. In C, `model.h` declares each",
        "parameter as a member of `struct Parameters`, with its key in a comment.",
    ]
    parameter_head = ("symbol", "quantity", "in the paper", "YAML and Python", "C", "unit")
    for title, path, record in SECTIONS:
        lines += ["", f"### {title}", "", *_format_table(parameter_head, _iterate_record_rows(path, record))]
    lines += ["", "## Parameters of the laws", ""]
    lines += ["[Laws](laws.md) gives the equations.", ""]
    lines += _format_table(("symbol", "quantity", "laws", "YAML and Python", "C", "unit"), _iterate_law_rows())
    lines += [
        "",
        "## Derived quantities of the laws",
        "",
        "A derived quantity has no key in YAML. The column C gives the name of the argument or local variable in the",
        "function of the law. Quantities that are constant in a run are also members of `struct Parameters`, such as",
        "`p->dry_pin_K_` for the contact `dry` and the bearing `pin`.",
        "",
    ]
    lines += _format_table(("symbol", "quantity", "laws", "C", "unit"), _iterate_derived_rows())
    return "\n".join([*lines, ""])


def _format_table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    """Return the lines of a Markdown table; an empty cell gets the sign of a quantity without a name."""
    head = tuple(head)
    lines = [f"| {' | '.join(cell or NONE for cell in row)} |" for row in (head, ["---"] * len(head), *rows)]
    return [re.sub(r"_\{(\w)\}|_\{\\text\{(\w)\}\}", lambda found: f"_{found[1] or found[2]}", line) for line in lines]


def _iterate_play_rows() -> Iterator[tuple[str, ...]]:
    for name, (_, unit, meaning) in CLEARANCE.items():
        symbol, paper = PLAY[name]
        shown = NAMES[symbol].latex if symbol in NAMES else "F_t"
        yield (
            f"${shown}$",
            MEANING.get(name, meaning),
            f"${paper}$" * bool(paper),
            OF_JOINT.get(name, ""),
            f"`JOINT.{name}`",
            f"`{C_MEMBER.get(name, name)}`".replace("`-", "−`"),
            unit,
        )


def _iterate_step_rows() -> Iterator[tuple[str, ...]]:
    for symbol, meaning, python, variable, unit in STEPS:
        yield f"${NAMES[symbol].latex}$", meaning, python, f"`{variable}`", unit


def _iterate_record_rows(path: str, record: Field) -> Iterator[tuple[str, ...]]:
    symbols = {
        id(BEARING): IN_LAWS,
        id(GUIDE): IN_GUIDE,
        id(CONTACT): IN_CONTACT,
        id(MATERIAL): OF_MATERIAL,
    }.get(id(record), {})
    for field in record.fields:
        if field.kind == NUMBER:
            key = f"{path}.{field.name}"
            shown = symbols.get(field.name) or make_symbol_name(get_field_letter(field.name)).latex
            paper = IN_PAPER.get(key, "")
            yield (
                f"${shown}$",
                field.meaning,
                f"${paper}$" * bool(paper),
                f"`{key}`",
                _format_c_member(key),
                _format_unit(field),
            )


def _iterate_law_rows() -> Iterator[tuple[str, ...]]:
    """Yield one row for each parameter, by symbol, key and meaning, with the laws that have it."""
    merged: dict[tuple[str, ...], list[str]] = {}
    for role in RESULTS:
        for law in find_bundled_laws().values():
            for field in law.parameters if law.role == role else ():
                row = (
                    get_latex_symbol(field),
                    field.meaning,
                    f"contacts.NAME.{role}.{field.name}",
                    _format_unit(field),
                )
                merged.setdefault(row, []).append(f"`{law.name}`")
    for (symbol, meaning, key, unit), laws in merged.items():
        yield f"${symbol}$", meaning, ", ".join(laws), f"`{key}`", _format_c_member(key), unit


def _iterate_derived_rows() -> Iterator[tuple[str, ...]]:
    specific = {name: letter for (_, name), letter in LAW_SPECIFIC_NAMES.items()}
    for name, meaning, laws, unit in DERIVED:
        letter = {**LAW_SYMBOL_NAMES, **specific}.get(name) or make_symbol_name(name)
        yield f"${letter.latex}$", meaning, laws, f"`{name}`", unit


def _format_c_member(key: str) -> str:
    """Return the member of struct Parameters for a key: the key without its section, with underscores."""
    return f"`p->{'_'.join(key.split('.')[1:])}_`".replace("NAME_velocity_floor", "velocity_floor")


def _format_unit(field: Field) -> str:
    """Return the SI unit of a field as text; 1 for a pure number, N/m^n for a stiffness by its exponent."""
    if field.dimension is None:
        return "N/m^n" if field.per else NONE
    return format_unit(find_si_unit(field.dimension)) or "1"


if __name__ == "__main__":
    PAGE.write_text(make_notation_page(), encoding="utf-8")
