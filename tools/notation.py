"""Write docs/notation.md: symbol, YAML key, Python name and C name of each quantity, from the declarations.

Symbols of a joint with play are those of the LaTeX target, units and series those of a result, keys and symbols of the
laws' parameters those of their declarations. The paper is X. Chen, S. Gao, T. Wang, Nonlinear Dynamics (2022),
doi 10.1007/s11071-022-07478-4; the tables have its symbols in a column. Writing fails if one symbol has two meanings in
a table, or in a law.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path

import sympy as sp

from gudgeon.generator.equations import contact_steps as steps
from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.format.sections import BEARING, BODY, CONTACT, GUIDE, MATERIAL
from gudgeon.generator.kinds.laws.law import RESULTS, find_bundled_laws
from gudgeon.generator.marked_text import get_markdown
from gudgeon.generator.targets.latex.letters import make_symbol_name
from gudgeon.generator.targets.latex.notation import get_field_symbol
from gudgeon.generator.targets.latex.play import BEARING_DIMENSIONS
from gudgeon.generator.targets.latex.play_letters import GUIDE as GUIDE_LETTERS
from gudgeon.generator.targets.latex.play_letters import LAW_SPECIFIC_NAMES, LAW_SYMBOL_NAMES, NAMES, get_latex_symbol
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit
from gudgeon.results.series import CLEARANCE

PAGE = Path(__file__).resolve().parents[1] / "docs" / "notation.md"
LEAD = """# Notation

This page lists each symbol of [physics](physics.md) with its sign convention, its unit and its names in the paper,
YAML, Python and C. "The paper" is Chen, Gao and Wang (2022).

| you have | go to |
| --- | --- |
| a symbol of an equation | the table of its subject below |
| a name in C | [the index](#index-of-names-in-c) |
| a name `p->…` in C | the comment of that name in `model.h` |
| a name in C that differs from its term | [the table of these names](#names-in-c-that-differ-from-the-term) |
| an intermediate or general symbol | [other symbols](#other-symbols-of-the-equations) |
| a symbol that is not here | the page that uses it, such as [algorithms](algorithms.md) |

Example of a row: the slip velocity $v_t$ of joint A is the series `run["A.vt"]` in Python, and the member `v_t` of
`rhs->clearance[i]` in C. The slip velocity is positive if the journal's surface moves along $\\mathbf t$
relative to the bearing's. Every other row is read in the same way.

- `JOINT`, `BODY` and `NAME` stand for names of the mechanism file; `ROW` is the name of a constraint equation.
- The sign – in a column marks a quantity that has no name there.
- Values in Python and C are in SI units, angles in radians. The unit 1 marks a pure number. Bold letters are vectors.
- A symbol stands for one quantity, except $K$, $S$, $v_0$, $c$, $c_e$ and $c_f$, which each force law or joint type
  defines.
"""
MADE_BY = (
    "`make tables` writes this page from the declarations in the code. A test compares the page with the symbols of\n"
    "[physics](physics.md)."
)
NONE = "–"
UNIT_OF_COEFFICIENT = "N/m$^n$"
SYSTEM = (  # symbol, quantity, paper, YAML, Python, C, unit
    ("t", "time", "t", "`t`", "`run.t`", "`t`", "s"),
    ("q", "coordinates of all bodies", "q", "`BODY.x`, `.y`, `.theta`", "`run.q`", "`q`", "m, rad"),
    ("\\dot q", "velocities: rates of $q$", "\\dot q", "`BODY.vx`, `.vy`, `.omega`", "`run.v`", "`v`", "m/s, rad/s"),
    ("\\ddot q", "accelerations: second rates of $q$", "\\ddot q", "", "`run.a`", "`a`", "m/s², rad/s²"),
    ("M", "mass matrix, diagonal", "M", "", "`equations.mass(p)`", "`mass_matrix`", "kg, kg·m²"),
    ("\\Phi", "constraint equations, $\\Phi = 0$", "\\Phi", "", "`equations.phi(t, q, p)`", "`constraints`", "m, rad"),
    ("\\Phi_q", "Jacobian of the constraints", "\\Phi_q", "", "`equations.phi_q(t, q, p)`", "`jacobian`", "1, m"),
    (
        "\\nu",
        "right-hand side of the velocity constraints, $\\nu = -\\Phi_t$",
        "\\upsilon",
        "",
        "`equations.nu(t, q, p)`",
        "`velocity_rhs`",
        "m/s, rad/s",
    ),
    (
        "\\gamma",
        "right-hand side of the acceleration constraints",
        "\\gamma",
        "",
        "`equations.gamma(t, q, v, p)`",
        "`acceleration_rhs`",
        "m/s², rad/s²",
    ),
    ("\\lambda", "Lagrange multipliers", "\\lambda", "", '`run["lambda.ROW"]`', "`rhs->lambda`", "N, N·m"),
    ("\\alpha", "Baumgarte's gain of the rates of $\\Phi$", "\\alpha", "", "`baumgarte.alpha`", "`p->alpha_`", "1/s"),
    ("\\beta", "Baumgarte's gain of $\\Phi$", "\\beta", "", "`baumgarte.beta`", "`p->beta_`", "1/s"),
)
PLAY = {  # series: symbol of the equations, the paper's symbol
    "ex": (steps.e_x, "e_x"),
    "ey": (steps.e_y, "e_y"),
    "e": (steps.e, "e"),
    "delta": (steps.delta, "\\delta"),
    "deltadot": (steps.deltadot, "\\dot\\delta"),
    "vt": (steps.v_t, "v_t"),
    "Fx": (steps.F_x, ""),
    "Fy": (steps.F_y, ""),
    "Fn": (sp.Symbol("F_n", real=True), "F_n"),
    "Ft": (steps.F_along_t, "F_t"),
}  # series of CLEARANCE
MEANING = {  # what a formula says more clearly than the words of CLEARANCE
    "e": "eccentricity: distance of the centres of journal and bearing",
    "deltadot": "rate of the penetration, positive in approach",
    "delta": "penetration, $\\delta = e - c$; in a non-circular bearing, $c$ is that at the angle of the journal",
    "Fn": "normal force, positive in compression: component along $-\\mathbf n$ of the force on the journal",
    "Ft": "tangential force: component along $\\mathbf t$ of the force on the journal",
    "vt": "slip of the journal's surface on the bearing's, along $\\mathbf t$",
}
OF_JOINT = {"ex": "`start.play.JOINT.e`", "ey": "`start.play.JOINT.e`"}  # YAML keys of initial values
C_MEMBER = {"Fn": "-F_n", "Ft": "F_t", "vt": "v_t"}
LOCAL_VARIABLES = (  # symbol, quantity, Python, C variables, unit
    ("\\mathbf e", "eccentricity vector: from the centre of the bearing to that of the journal", "", "e_x, e_y", "m"),
    ("\\mathbf n", "unit normal: along $\\mathbf e$, in a guide from the middle outwards", "", "n_x, n_y", "1"),
    ("\\mathbf t", "unit tangent: $\\mathbf n$ turned by +90°", "", "", "1"),
    ("R_j", "radius of the journal, $R_i - c$", "", "p->R_j_NAME_", "m"),
    ("M_i", "moment on the bearing about its centre; in a guide, on the guide about its point", "", "M_i", "N·m"),
    ("M_j", "moment on the journal about its centre; in a guide, on the slider about the corner", "", "M_j", "N·m"),
)
STEPS = (  # symbol of the equations, quantity, Python, C variable, unit
    (
        steps.stored_approach_speed,
        "approach speed: rate of $\\delta$ at the onset",
        "`JOINT.deltadot_minus`",
        "contact->deltadot_minus",
        "m/s",
    ),
    (
        steps.epsilon,
        "eccentricity ratio $e/c_{\\text{film}}$; $e/c$ without `extra_clearance` and `mixed`",
        "`JOINT.eps`",
        "epsilon",
        "1",
    ),
    (steps.omega_i, "angular velocity of the bearing", "`BODY.omega`", "omega_i", "rad/s"),
    (steps.omega_j, "angular velocity of the journal", "`BODY.omega`", "omega_j", "rad/s"),
    (steps.a_i, "lever arm of $F_t$ about the centre of the bearing", "", "a_i", "m"),
    (steps.a_j, "lever arm of $F_t$ about the centre of the journal", "", "a_j", "m"),
    (
        steps.w_n,
        "effective squeeze velocity of a film along $\\mathbf n$, divided by $c_{\\text{film}}$: "
        "$w_n = \\dot\\varepsilon$",
        "",
        "w_n",
        "1/s",
    ),
    (
        steps.w_t,
        "effective squeeze velocity of a film along $\\mathbf t$, divided by $c_{\\text{film}}$",
        "",
        "w_t",
        "1/s",
    ),
    (sp.Symbol("F_r", real=True), "force of a film along $\\mathbf n$", "", "F_r", "N"),
    (steps.gradient_length, "length of the gradient of $\\delta$ in a bearing with a contour", "", "steep", "1"),
    (steps.contour_depth, "depth of a contour beyond the circle, at the angle of the journal", "", "worn", "m"),
    (steps.beta_i, "angle of $\\mathbf e$ in the body of the bearing, with a contour", "", "beta_i", "rad"),
)
IMPACTS = (  # symbol, quantity, Python, C, unit
    ("\\dot{\\delta}^{+}", "rate of $\\delta$ after the impact", "", "", "m/s"),
    (
        "P_n",
        "impulse along $-\\mathbf n$ on the second body",
        '`run.impacts["F_peak"]` of an impact',
        "`impulse[k]`",
        "N·s",
    ),
    ("P_t", "impulse of friction along $\\mathbf t$ on the second body", "", "`friction->P[k]`", "N·s"),
    (
        "v_t^{0}",
        "slip after the impact without friction, with the specified restitution",
        "",
        "`friction->after[k]`",
        "m/s",
    ),
    (
        "\\tilde v_t",
        "slip after the impact without friction, with the restitution 0",
        "",
        "`friction->plastic[k]`",
        "m/s",
    ),
    ("v_t^{+}", "slip after the impact", "", "", "m/s"),
    (
        "G_{kl}",
        "Delassus operator: $-\\partial\\ddot\\delta_k/\\partial F_{n,l}$, of contact $k$ by the force in contact $l$",
        "",
        "`contacts->D[k][l]`",
        "1/kg",
    ),
    ("G_t", "change of the slip per unit of $P_t$", "", "`S[k][k]`", "1/kg"),
)
MIXED = (
    (
        NAMES[steps.share].latex,
        "weight of the dry force in $\\mathbf F = b\\,\\mathbf F_{\\text{dry}} + (1 - b)\\,\\mathbf F_{\\text{film}}$",
        "",
        "`share`",
        "1",
    ),
    ("h", "film thickness between the mean surfaces", "", "", "m"),
    ("\\Lambda", "film thickness ratio $h/\\sigma_r$", "", "", "1"),
    ("\\Lambda_0", "film thickness ratio at $\\delta = 0$", "", "", "1"),
    ("\\eta", "height of an asperity divided by $\\sigma_r$", "", "", "1"),
    (
        "F_{5/2}",
        "$\\int_\\Lambda^\\infty (\\eta - \\Lambda)^{5/2} f_{\\text{N}}(\\eta)\\,d\\eta$, "
        "with the standard normal density $f_{\\text{N}}$",
        "",
        "",
        "1",
    ),
)
WEAR = (
    ("V_w", "worn volume of one surface", "`worn.bearing.volume`, `worn.journal.volume`", "", "m³"),
    ("k_w", "wear coefficient", "argument `k` of `gudgeon.wear`", "", "1"),
    ("H", "hardness", "argument `hardness` of `gudgeon.wear`", "", "Pa"),
)
ENERGY = (
    ("T", "kinetic energy", '`run["energy.kinetic"]`', "`energy[0]`", "J"),
    ("V", "potential energy of gravity and springs", '`run["energy.potential"]`', "`energy[1]`", "J"),
    ("\\Delta E", "energy residual", '`run["energy.residual"]`', "", "J"),
    ("W_{\\text{drives}}", "work of drives since the start", '`run["work.drives"]`', "`y[2 * N_X]`", "J"),
    ("W_{\\text{forces}}", "work of force elements", '`run["work.forces"]`', "`y[2 * N_X + 1]`", "J"),
    ("W_{\\text{joints}}", "work of joints with play", '`run["work.clearances"]`', "`y[2 * N_X + 2]`", "J"),
)
QUANTITIES = (  # heading, text above the table, rows of symbol, quantity, Python, C, unit
    (
        "Impacts and closed contacts of rigid surfaces",
        "The names in C in this table are variables of `engine/run/impacts.c` and `engine/run/frictional_impact.c`.",
        IMPACTS,
    ),
    (
        "Mixed lubrication",
        "The combined roughness $\\sigma_r$ is in the table of the [parameters of the laws](#parameters-of-the-laws).",
        MIXED,
    ),
    ("Wear", "In the column Python, `worn` is the object that the function `gudgeon.wear` returns.", WEAR),
    (
        "Energy",
        "In the column C, `energy` is an argument of the function `outputs`, and `y` is the state that the integrator\n"
        "advances.",
        ENERGY,
    ),
)
SECTIONS = (
    ("Bearings", "bearings.NAME", BEARING),
    ("Guides", "guides.NAME", GUIDE),
    ("Materials", "materials.NAME", MATERIAL),
    ("Bodies", "bodies.BODY", BODY),
    ("Contacts", "contacts.NAME", CONTACT),
)
IN_LAWS = {field: sign for field, sign, _ in BEARING_DIMENSIONS}  # symbols of a bearing in the laws
IN_GUIDE = {field: sign for field, sign, _ in GUIDE_LETTERS}
IN_SECTION = {  # what the words of a declaration do not say: the term of physics.md
    "bearings.NAME.length": "length of the bearing: length of the pin in the hole",
    "contacts.NAME.velocity_floor": "smallest $\\dot\\delta^{-}$ that is stored at the onset of a contact",
    "bodies.BODY.inertia": "moment of inertia about the centre of mass",
    "guides.NAME.gap": "clearance: gap on each side, half the difference of the widths of slot and slider",
}
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
    ("K", "contact stiffness", "laws of the normal force with a stiffness", UNIT_OF_COEFFICIENT),
    ("hysteresis", "hysteresis damping factor, by `dissipation`", "laws with `dissipation`", "1"),
    ("F_e", "elastic force: the value of the key `force`", "`expression`", "N"),
    ("friction_slope", "$1/(v_1 - v_0)$", "`modified_coulomb`", "s/m"),
    ("z", "deflection of the bristles", "`dahl`, `lugre`", "m"),
    (
        "film_clearance",
        "clearance of the film, $c + c_a$; with `mixed`, $c_{\\text{mean}} + c_a$",
        "all films",
        "m",
    ),
    ("S", "film factor: the equation of each law defines it", "all films", "N·s"),
    ("root", "$\\sqrt{1 - \\varepsilon^2}$", "all films", "1"),
    ("q", "$\\sqrt{w_n^2 + s_\\varepsilon^2 w_t^2}$", "`finite_length`", "1/s"),
    ("x", "$\\varepsilon w_n/w_\\varepsilon$", "`finite_length`", "1"),
    ("W", "$\\sqrt{w_n^2 + w_t^2}$", "`pinkus_sternlicht`, `ocvirk`", "1/s"),
    ("factor", "correction of the squeeze motion", "`pinkus_sternlicht`", "1"),
    ("shear", "shear torque of the centred journal divided by $\\omega_j - \\omega_i$", "films with `shear`", "N·m·s"),
    ("T0", "shear torque $M_\\tau$ divided by $\\omega_j - \\omega_i$", "films with `shear`", "N·m·s"),
    (
        "mean_clearance",
        "clearance between the mean surfaces, $c + \\Lambda_0\\sigma_r$",
        "laws of mixed lubrication",
        "m",
    ),
)

C_NAMES = (  # name in C, symbol, quantity, not to be confused with
    ("`steep`", "\\Gamma", "length of the gradient of $\\delta$", ""),
    ("`worn`", "d", "depth of a contour, also without wear", "`worn` in Python, the result of `gudgeon.wear`"),
    ("`F_n`, local variable without a contour", "F_n", "normal force", "`rhs->clearance[i].F_n`, which is $-F_n$"),
    ("`F_n`, local variable with a contour", "F_\\delta", "result of the normal law", "the normal force $F_n$"),
    ("`F_N`, local variable with a contour", "F_n", "normal force", ""),
    (
        "`ex`, `ey`",
        "e_x$, $e_y",
        "eccentricity in the results, members of `rhs->clearance[i]`; of a corner of a slider, along the normal of its "
        "wall",
        "`e_x`, `e_y`, arguments of the functions of a joint",
    ),
    (
        "`e_x`, `e_y`",
        "\\mathbf e",
        "eccentricity vector, arguments of the functions of a joint; of a corner of a slider, its position relative to "
        "the point of the guide",
        "`ex`, `ey` of a corner",
    ),
    ("`share`", "b", "weight of the dry force", ""),
    ("`T0`", "D_s", "shear torque divided by $\\omega_j - \\omega_i$", "a torque: the unit of `T0` is N·m·s"),
    ("`factor`", "f", "correction of the squeeze motion", ""),
    ("`root`", "s_\\varepsilon", "$\\sqrt{1 - \\varepsilon^2}$", ""),
    ("`q` of `finite_length`", "w_\\varepsilon", "$\\sqrt{w_n^2 + s_\\varepsilon^2 w_t^2}$", "the coordinates $q$"),
    ("`x` of `finite_length`", "\\xi", "$\\varepsilon w_n/w_\\varepsilon$", "a position $x$"),
    ("`D[k][l]`", "G_{kl}", "Delassus operator", "the damping $D$"),
    ("`S[k][k]`", "G_t", "change of the slip per unit of $P_t$", "the film factor $S$"),
)
OTHER_SYMBOLS = (  # symbols of physics.md in no other table: symbols, quantity, unit, section
    ("x_k$, $y_k$, $\\theta_k", "coordinates of body $k$: centre of mass, angle", "m, m, rad", "1"),
    ("g", "applied forces and moments", "N, N·m", "1"),
    ("s", "independent coordinates of the tree", "rad, m", "1"),
    ("r_1$, $r_2", "pitch radii of a gear pair", "m", "1"),
    ("\\alpha_w", "working pressure angle of a gear pair", "rad", "1"),
    ("\\theta_d", "value that a drive prescribes", "rad or m", "1"),
    ("i$, $j", "subscripts of the first and the second body of a joint", "", "2"),
    ("\\mathbf r_i$, $\\mathbf r_j", "positions of the centres of bearing and journal", "m", "2"),
    ("\\mathbf r", "position of a corner of a slider relative to the point of the guide", "m", "2"),
    ("\\mathbf F$, $\\mathbf F_j$, $\\mathbf F_i", "force on the second body; on journal and on bearing", "N", "2"),
    ("d'", "derivative of the depth of a contour by $\\beta_i$", "m", "2"),
    ("\\mathbf u", "unit vector $\\mathbf e/e$ in a bearing with a contour", "1", "2"),
    ("F_\\delta", "result of the normal law in a bearing with a contour, $F_n/\\Gamma$", "N", "2"),
    ("\\delta_{\\text{tol}}", "penetration that counts as rounding", "m", "3"),
    ("v_c", "separation speed up to which an impact leaves no separation, at least $v_{\\text{th}}$", "m/s", "3"),
    ("h_b$, $t_b", "smallest height and smallest rise time of a bounce that a run resolves", "m, s", "3"),
    ("m_c", "effective mass of a contact", "kg", "3"),
    ("E^{*}", "contact modulus", "Pa", "3"),
    ("R^{*}", "effective radius of a contact", "m", "3"),
    ("e_r", "delivered coefficient of restitution", "1", "3"),
    ("\\omega_0", "natural frequency of a contact", "1/s", "3"),
    ("\\zeta", "damping ratio of a contact", "1", "3"),
    ("c_d", "coefficient of friction at the present slip", "1", "3"),
    ("g_v", "coefficient of friction in steady sliding of the LuGre law", "1", "3"),
    ("F_s", "set-valued friction: static limit, the key `static`", "N", "3"),
    ("F_c", "set-valued friction: kinetic force at high slip, the key `kinetic`", "N", "3"),
    ("F_k", "set-valued friction: kinetic force", "N", "3"),
    ("P_\\Phi", "impulses of the constraint equations", "N·s, N·m·s", "3"),
    ("\\chi_k", "scaled approach speed of impact $k$", "kg^(1/2)·m/s", "3"),
    ("\\kappa_{12}", "coupling of two contacts", "1", "3"),
    ("\\psi", "direction of $\\mathbf e$ in ground axes", "rad", "4"),
    ("\\varphi$, $\\varphi_1", "angle from the widest gap; its value at the start of the half film", "rad", "4"),
    ("\\omega_s", "effective angular velocity of the film", "rad/s", "4"),
    ("\\mathbf w", "effective squeeze velocity", "m/s", "4"),
    ("L/(2R_j)", "length of the bearing divided by the diameter of the journal", "1", "4"),
    ("p", "film pressure above that at the ends", "Pa", "4"),
    ("V_f", "potential of the film force", "W", "4"),
    ("a_0 \\dots a_3", "coefficients of $V_f$", "1", "4"),
    ("M_\\tau", "shear torque of a film", "N·m", "4"),
)


def make_notation_page() -> str:
    """Return the page: equations of motion, a joint with play, parameters of the file, parameters of the laws.

    Raises ValueError if a symbol has two meanings in one table or in one law.
    """
    head = ("symbol", "quantity", "in the paper", "YAML", "Python", "C", "unit")
    lines = [LEAD, "## Equations of motion", ""]
    lines += [
        "In the column Python, `run` is the result of `simulate`, `equations` is `simulation.model.numpy()` of the",
        "loaded mechanism `simulation`, and `p` is `equations.prepare()`.",
        "",
    ]
    lines += _format_table(head, ((f"${row[0]}$", row[1], f"${row[2]}$" * bool(row[2]), *row[3:]) for row in SYSTEM))
    lines += [
        "",
        "## A joint with play",
        "",
        "The unit vector $\\mathbf n$ points from the centre of the bearing to the centre of the journal.",
        "The unit vector $\\mathbf t$ is $\\mathbf n$ turned by +90°. The forces $F_n$ and $F_t$ in the table act on",
        "the journal.",
        "",
        "In a guide, `JOINT` is a corner, such as `guide.front_upper`. The corner of the slider then replaces the",
        "journal, and the wall of the guide replaces the bearing. The series `ex` and `ey` of a corner are the",
        "components of $e\\,\\mathbf n$.",
        "",
        'In Python, `run["JOINT.delta"]` returns a series. In C, the structure `rhs->clearance[i]` contains the',
        "quantities of the first table below. Quantities of the second table are local variables in C.",
        "",
        "Two variables have the opposite sign of their quantity: `rhs->clearance[i].F_n` in C and the attribute `F_n`",
        "of `equations.dynamics` are $-F_n$. The local variable `F_n` of the functions of a joint is $F_n$ without a",
        "contour, and $F_\\delta$ with a contour.",
        "",
    ]
    lines += _format_table(head, _iterate_play_rows())
    lines += [
        "",
        "- In a film alone, $F_n = -F_r$.",
        "- In a closed contact of rigid surfaces, $F_n$ is the multiplier of $\\delta = 0$ and the member",
        "  `contact->force` of the contact state in `engine/scene/types.h`.",
        "",
        "Further quantities of a joint with play:",
    ]
    head_of_quantities = ("symbol", "quantity", "Python", "C", "unit")
    lines += ["", *_format_table(head_of_quantities, _iterate_step_rows())]
    for title, text, rows in QUANTITIES:
        lines += [
            "",
            f"## {title}",
            "",
            text,
            "",
            *_format_table(head_of_quantities, ((f"${row[0]}$", *row[1:]) for row in rows)),
        ]
    lines += [
        "",
        "## Parameters of the file",
        "",
        "In Python, `parameters={KEY: value}` of a run sets a parameter by its YAML key. In C, `model.h` declares each",
        "parameter as a member of `struct Parameters`, with its key in a comment. [Format](format.md) gives the rules",
        "of each key, such as special values.",
    ]
    parameter_head = ("symbol", "quantity", "in the paper", "YAML and Python", "C", "unit")
    for title, path, record in SECTIONS:
        lines += ["", f"### {title}", "", *_format_table(parameter_head, _iterate_record_rows(path, record))]
    lines += ["", "## Parameters of the laws", ""]
    lines += ["The table lists the parameters of all force laws. [Laws](laws.md) gives the equations of the laws.", ""]
    lines += _format_table(("symbol", "quantity", "laws", "YAML and Python", "C", "unit"), _iterate_law_rows())
    lines += [
        "",
        "## Derived quantities of the laws",
        "",
        "A derived quantity of a force law has no key in YAML. The column C gives the name of an argument or local",
        "variable in the function of the law. The name is valid in that function only: for example, `q` and `x` of",
        "`finite_length` are not coordinates.",
        "",
        "Derived quantities that are constant in a run are also members of `struct Parameters`, such as",
        "`p->dry_pin_K_` for the contact `dry` and the bearing `pin`.",
        "",
    ]
    lines += _format_table(("symbol", "quantity", "laws", "C", "unit"), _iterate_derived_rows())
    lines += [
        "",
        "## Names in C that differ from the term",
        "",
        "The table lists short names of local variables and members in C. Some of these names are also the name of",
        "another quantity, which the last column gives.",
        "",
    ]
    c_rows = ((name, f"${symbol}$", *rest) for name, symbol, *rest in C_NAMES)
    lines += _format_table(("name in C", "symbol", "quantity", "is not"), c_rows)
    lines += [
        "",
        "## Other symbols of the equations",
        "",
        "Most of the symbols in this table stand for intermediate or general quantities.",
        "The last column is the section of [Physics](physics.md#symbols-and-sign-conventions) that uses the symbol.",
        "",
    ]
    other_rows = ((f"${symbols}$", *rest) for symbols, *rest in OTHER_SYMBOLS)
    lines += _format_table(("symbol", "quantity", "unit", "section of physics"), other_rows)
    lines += ["", "## Index of names in C", "", *_format_table(("name in C", "symbol", "section"), _index_names(lines))]
    page = "\n".join([*lines, "", MADE_BY, ""])
    if ambiguous := find_ambiguous_symbols(page):
        raise ValueError("docs/notation.md: symbols with two meanings: " + "; ".join(ambiguous))
    return page


def find_missing_symbols(page: str, physics: str) -> list[str]:
    """Return the symbols declared in the tables of docs/physics.md that are on the page of the notation nowhere."""
    declared = physics.partition("## Symbols and sign conventions")[2].partition("\n## ")[0]
    cells = "\n".join(line.split(" | ")[0] for line in declared.splitlines() if line.startswith("| $"))
    listed = {_strip_symbol(symbol) for symbol in re.findall(r"\$([^$]+)\$", page)}
    symbols = (symbol for cell in re.findall(r"\$([^$]+)\$", cells) for symbol in _split_coordinates(cell))
    return [symbol for symbol in symbols if _strip_symbol(symbol) not in listed]


def _split_coordinates(symbol: str) -> list[str]:
    """Return the symbols of a definition such as q_k = (x_k, y_k, θ_k): those in the parentheses."""
    return symbol.partition("(")[2].rstrip(")").split(", ") if " = (" in symbol else [symbol]


def _strip_symbol(symbol: str) -> str:
    """Return a symbol without spaces, braces and fonts, so that two spellings of it are equal."""
    return re.sub(r"\\(mathrm|text)\b|[{} ]", "", symbol)


def find_ambiguous_symbols(page: str) -> list[str]:
    """Return a message for each symbol that has two meanings in one context of the page.

    A context is one law, one section of parameters with all tables of quantities before it, or these tables alone.
    """
    above, _, parameters = page.partition("\n## Parameters of the file\n")
    common = list(_iterate_meanings(above))
    contexts: dict[str, list[tuple[str, str]]] = defaultdict(list, {"quantities": common})
    of_file, _, of_laws = parameters.partition("\n## Parameters of the laws\n")
    for section in of_file.split("\n### ")[1:]:
        contexts[section.partition("\n")[0]] = [*common, *_iterate_meanings(section)]
    of_laws, _, derived = of_laws.partition("\n## ")
    contexts["derived quantities"] = [*common, *_iterate_meanings(derived)]
    for line in of_laws.splitlines():
        for law in re.findall(r"`(\w+)`", line.split(" | ")[2]) if line.startswith("| $") else ():
            contexts[law] += _iterate_meanings(line)
    messages = []
    for context, pairs in contexts.items():
        meanings = defaultdict(set)
        for symbol, meaning in pairs:
            meanings[symbol].add(meaning)
        messages += [f"{symbol} in {context}" for symbol, found in meanings.items() if len(found) > 1]
    return messages


def _iterate_meanings(text: str) -> Iterator[tuple[str, str]]:
    """Yield symbol and meaning of each row of the tables in a text; a row may have several symbols."""
    for line in text.splitlines():
        if line.startswith("| $"):
            symbols, meaning = line.removeprefix("| ").split(" | ")[:2]
            yield from ((symbol, meaning) for symbol in symbols.split(", "))


def _format_table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    """Return the lines of a Markdown table; an empty cell gets the sign of a quantity without a name."""
    head = tuple(head)
    lines = [f"| {' | '.join(cell or NONE for cell in row)} |" for row in (head, ["---"] * len(head), *rows)]
    lines = [line.replace(r"_{\mathrm{max}}", r"_{\max}") for line in lines]
    lines = [re.sub(r"_\{\\mathrm\{(\w+)\}\}", r"_{\\text{\1}}", line) for line in lines]
    return [
        re.sub(r"_\{(\w)\}|_\{\\text\{([a-z])\}\}", lambda found: f"_{found[1] or found[2]}", line) for line in lines
    ]


def _index_names(lines: Iterable[str]) -> list[tuple[str, str, str]]:
    """Return name in C, symbol and section of each variable in the tables of the page, by name.

    Members of `struct Parameters` are left out: their key is in a comment of `model.h`. A name with several meanings
    has a row for each of them.
    """
    section_of_names, section, column = "Names in C that differ from the term", "", -1
    in_list = {("`contact->force`", "$F_n$", "A joint with play")}  # in a list of the page, not in a table
    found = {(name, f"${symbol}$", section_of_names) for name, symbol, *_ in C_NAMES if name[:4] in ("`F_n", "`F_N")}
    for line in "\n".join(lines).splitlines():
        cells = line.removeprefix("| ").removesuffix(" |").split(" | ")
        if line.startswith("## "):
            section = line.removeprefix("## ")
        elif line.startswith("| symbol "):
            column = cells.index("C") if "C" in cells else -1
        elif line.startswith("| $") and column >= 0:
            names = re.findall(r"`([^`]+)`", cells[column])
            signs = {name: "−" * (f"−`{name}`" in cells[column]) for name in names}
            shown = {"F_n": "rhs->clearance[i].F_n"}
            found |= {(f"`{shown.get(x, x)}`", signs[x] + cells[0], section) for x in names if not x.startswith("p->")}
    return sorted(found | in_list, key=lambda row: (row[0].strip("`").lower(), row))


def _iterate_play_rows() -> Iterator[tuple[str, ...]]:
    for name, (symbol, paper) in PLAY.items():
        _, unit, meaning = CLEARANCE[name]
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
    for symbol, meaning, python, variables, unit in LOCAL_VARIABLES:
        yield f"${symbol}$", meaning, python, ", ".join(f"`{name}`" for name in variables.split(", ") if name), unit
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
            shown = symbols.get(field.name) or make_symbol_name(get_field_symbol(field.name)).latex
            paper = IN_PAPER.get(key, "")
            meaning = IN_SECTION.get(key) or get_markdown(field.meaning)
            yield (
                f"${shown}$",
                meaning,
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
                    get_latex_symbol(field).replace(r"\mathrm{el}", r"\text{el}"),
                    get_markdown(field.meaning),
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
    """Return the SI unit of a field as text; 1 for a pure number, N/m$^n$ for a stiffness by its exponent."""
    if field.dimension is None:
        return UNIT_OF_COEFFICIENT if field.per else NONE
    return format_unit(find_si_unit(field.dimension)) or "1"


if __name__ == "__main__":
    PAGE.write_text(make_notation_page(), encoding="utf-8")
