"""Make the questions of an exercise sheet: constraints Φ and derivatives, a joint's play, accelerations, forces.

Abbreviations in formulas are explained in the order of their use.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import takewhile

import numpy as np
import sympy as sp

from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.symbols.switches import Select
from gudgeon.generator.targets.latex.document import Block, Equation, make_paragraph, make_row, make_tables
from gudgeon.generator.targets.latex.kinematics import format_gamma
from gudgeon.generator.targets.latex.letters import Formula, make_symbol_name
from gudgeon.model.compiled import Array
from gudgeon.teaching.draw_parameters import ROUNDING_TOL
from gudgeon.teaching.sheet import MAX_OPERATIONS, Question, Subject

PHI, PHI_Q, NU = Formula(r"\Phi", "Φ"), Formula(r"\Phi_{q}", "Φ_q"), Formula(r"\nu", "ν")
GAMMA = Formula(
    r"\gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}", "γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt"
)
MAX_CELL_WIDTH = 60  # largest number of characters of a formula in a cell
STATE = (("x", "m"), ("y", "m"), ("theta", "rad"))
ACCELERATIONS = Formula(r"\Phi_{q} \ddot{q} = \gamma", "Φ_q·q̈ = γ")
KKT = Formula(r"M \ddot{q} + \Phi_{q}^{\mathsf{T}} \lambda = g", "M·q̈ + Φ_qᵀ·λ = g")
BALANCE = Formula(r"\Phi_{q}^{\mathsf{T}} \lambda = g - M \ddot{q}", "Φ_qᵀ·λ = g - M·q̈")
FORCE = Formula(r"-\Phi_{q}^{\mathsf{T}} \lambda", "-Φ_qᵀ·λ")
MAX_SHOWN_ROWS = 40  # largest number of equations that a solution shows


def make_questions(subject: Subject) -> list[Question]:
    """Return the questions of an exercise sheet that apply to the scene, in order.

    Without chosen constraint equations, only those on degrees of freedom and play remain.
    """
    questions = [_make_mobility_question(subject)]
    if subject.selected_rows:
        questions += [_make_constraint_question(subject), _make_jacobian_question(subject)]
        questions.append(_make_gamma_question(subject))
        if subject.model.degrees_of_freedom == 0:
            questions.append(_make_acceleration_question(subject))
        questions += _make_reaction_question(subject)
    return [*questions, *_make_play_question(subject)]


def _make_mobility_question(subject: Subject) -> Question:
    """Build the question for the degrees of freedom by Grübler's count, and by the rank of Φ_q.

    The solution explains redundant constraints if there are any.
    """
    model = subject.model
    mechanism, play = model.scene.mechanism, model.scene.play
    rows, count, n = [], 0, 3 * len(mechanism.bodies)
    for name, kind in [*((j.name, j.kind) for j in mechanism.joints.values()), *((d, "") for d in mechanism.drives)]:
        n_equations = 0 if name in play else len(find_joint_types()[kind].row_names) if kind else 1
        title = find_joint_types()[kind].title if kind else "drive"
        rows.append(make_row(name, f"{title}, has play" if name in play else title, str(n_equations)))
        count += n_equations
    total = Formula(f"f = {n} - {count} = {n - count}", f"f = {n} - {count} = {n - count}")
    solved: list[Block] = [
        make_paragraph(f"Each body has 3 coordinates, together {n}. Joints and drives have these rows:"),
        *make_tables(make_row("joint or drive", "type", "rows"), rows),
        make_paragraph(total, "."),
    ]
    if dropped := model.redundancy.dropped:
        text = f"{', '.join(dropped)} depend on the others: the rank is {len(model.rows)}, f = {n - len(model.rows)}"
        solved.append(make_paragraph(f"Grübler's count does not hold here: {text}."))
    elif model.rows:
        text = f" is {len(model.rows)}, the number of rows: none depends on the others, and the count is right."
        solved.append(make_paragraph("The rank of ", PHI_Q, text))
    requested = make_paragraph(
        "How many coordinates do the bodies have, how many rows does each joint and drive add to ",
        PHI,
        ", and how many degrees of freedom f remain by Grübler's count? Does the rank of ",
        PHI_Q,
        " agree?",
    )
    answers = {"coordinates": float(n), "rows": float(count), "freedoms": float(n - len(model.rows))}
    return Question("Count the degrees of freedom", (requested,), tuple(solved), answers)


def _format_owners(subject: Subject) -> str:
    """Return the names of the chosen joints and drives as text: "A, B and motor"."""
    return ", ".join(subject.owners[:-1]) + (" and " if len(subject.owners) > 1 else "") + subject.owners[-1]


def _make_constraint_question(subject: Subject) -> Question:
    """Build the question for the constraint equations of the chosen joints and drives."""
    requested = make_paragraph(
        "Write the rows of ",
        PHI,
        f" of {_format_owners(subject)}, in the coordinates of the centres of mass, with the "
        "symbols given above. Differences of a joint's points go from its first body to its second.",
    )
    solved: list[Block] = [
        block
        for k, row in subject.selected_rows
        for block in (
            make_paragraph(f"{row.name}, {row.unit}:"),
            subject.make_equation(make_indexed_symbol("Phi", k), row.phi),
        )
    ]
    return Question("Write Φ", (requested,), tuple(_define_new_abbreviations(subject, "phi") + solved))


def _define_new_abbreviations(subject: Subject, quantity: str) -> list[Block]:
    """Return the definitions of abbreviations in "phi", "phi_q" or "gamma" that no earlier solution has."""
    expressions_of = {
        "phi": [row.phi for _, row in subject.selected_rows],
        "phi_q": [entry for _, row in subject.selected_rows for entry in row.phi_q.values()],
        "gamma": [row.gamma for _, row in subject.selected_rows],
    }
    defined_symbols = set[sp.Symbol]()
    for before in takewhile(lambda name: name != quantity, expressions_of):
        defined_symbols |= set(list_abbreviations(subject, expressions_of[before]))
    return define_abbreviations(
        subject, [s for s in list_abbreviations(subject, expressions_of[quantity]) if s not in defined_symbols]
    )


def _make_jacobian_question(subject: Subject) -> Question:
    """Build the question for the entries of Φ_q in the selected constraint equations at the sheet's position.

    Formulas over MAX_CELL_WIDTH characters are below the table; those over MAX_OPERATIONS are left out.
    """
    model, exercise = subject.model, subject.exercise
    compiled = subject.simulation.compiled
    values = compiled.phi_q(exercise.t, exercise.q, exercise.p)
    errors = exercise.estimate_rounding_uncertainty(lambda q, v: compiled.phi_q(exercise.t, q, exercise.p))
    column_of = {q: k for k, q in enumerate(model.q)}
    answers, rows, below = dict[str, float](), [], list[Block]()
    for k, row in subject.selected_rows:
        for q in sorted(row.phi_q, key=column_of.__getitem__):
            x = float(values[k - 1, column_of[q]])
            answers[f"{row.name} {subject.simulation.source.coordinates[column_of[q]]}"] = x
            coordinate = subject.notation.format_expression(q)
            left = Formula(rf"\partial \Phi_{{{k}}} / \partial {coordinate.latex}", f"∂Φ_{k}/∂{coordinate.text}")
            entry = subject.notation.expand_symbols(row.phi_q[q])
            formula: str | Formula = (
                subject.notation.format_expression(entry) if sp.count_ops(entry) <= MAX_OPERATIONS else ""
            )
            if isinstance(formula, Formula) and len(formula.text) > MAX_CELL_WIDTH:
                below.append(subject.make_equation(left, entry))
                formula = "below"
            shown = subject.format_number(x, uncertainty=errors[k - 1, column_of[q]])
            rows.append(make_row(left, formula, shown, _find_entry_unit(row.unit, column_of[q] % 3)))
    requested = [
        make_paragraph(f"At {exercise.t:g} s the bodies are at"),
        *tabulate_positions(subject, shows_rates=False),
        make_paragraph(
            "What entries of ",
            PHI_Q,
            f" do the rows of {_format_owners(subject)} have there? Check one entry by a finite difference.",
        ),
    ]
    solved = [
        *_define_new_abbreviations(subject, "phi_q"),
        *make_tables(make_row("entry", "", "value", "unit"), rows),
        *below,
    ]
    return Question("The Jacobian at a position", tuple(requested), tuple(solved), answers)


def _find_entry_unit(row_unit: str, axis: int) -> str:
    """Return the unit of an entry of Φ_q; row_unit: unit of the constraint equation; axis: 0 x, 1 y, 2 angle."""
    return {("m", 2): "m/rad", ("rad", 0): "rad/m", ("rad", 1): "rad/m"}.get((row_unit, axis), "1")


def _make_gamma_question(subject: Subject) -> Question:
    """Build the question for γ in the selected equations; the solution has no formulas over MAX_OPERATIONS."""
    exercise = subject.exercise
    compiled = subject.simulation.compiled
    values = compiled.gamma(exercise.t, exercise.q, exercise.v, exercise.p)
    errors = exercise.estimate_rounding_uncertainty(lambda q, v: compiled.gamma(exercise.t, q, v, exercise.p))
    scale = float(np.abs(values).max())
    answers, solved = dict[str, float](), _define_new_abbreviations(subject, "gamma")
    for k, row in subject.selected_rows:
        answers[row.name] = float(values[k - 1])
        gamma = format_gamma(row, subject.model, subject.notation)
        if gamma != 0 and sp.count_ops(gamma) <= MAX_OPERATIONS:
            formula = subject.make_equation(make_indexed_symbol("gamma", k), gamma)
            # terms with cases cannot be broken into lines
            if all(len(term.text) <= MAX_CELL_WIDTH or "cases" not in term.latex for term in formula.terms):
                solved.append(formula)
        unit = "m/s²" if row.unit == "m" else "rad/s²"
        solved.append(
            subject.make_value_equation(make_indexed_symbol("gamma", k), answers[row.name], unit, scale, errors[k - 1])
        )
    requested = [
        make_paragraph(f"At the same time, {exercise.t:g} s, the rates are"),
        *tabulate_positions(subject, shows_rates=True),
        make_paragraph("Find ", GAMMA, f" in the rows of {_format_owners(subject)}: its formula, and its value."),
    ]
    return Question("γ", tuple(requested), tuple(solved), answers)


def _make_play_question(subject: Subject) -> Iterator[Question]:
    """Yield the question for the eccentricity of one randomly chosen revolute joint with play; nothing without one."""
    exercise = subject.exercise
    journals = [c.name for c in subject.model.clearances if c.wall is None]
    if not journals:
        return
    joint = subject.rng.permutation(np.array(journals, object))[0]
    ex, ey = (float(f"{exercise.run[f'{joint}.e{axis}'][-1]:.4g}") for axis in "xy")
    clearance = float(exercise.run.constants[f"{joint}.c"])
    e = float(np.hypot(ex, ey))
    requested = make_paragraph(
        f"The centre of the journal of {joint} is displaced from that of its bearing by (",
        subject.format_number(ex),
        ", ",
        subject.format_number(ey),
        ") m, and the clearance is ",
        subject.format_number(clearance),
        " m. How large are the eccentricity e, its ratio e/c and the penetration δ = e - c? Do the surfaces touch?",
    )
    touch = "they touch" if e > clearance else "they do not touch"
    solved = (
        subject.make_value_equation(make_symbol_name("e", joint), e, "m"),
        subject.make_value_equation(make_symbol_name("epsilon", joint), e / clearance),
        subject.make_value_equation(make_symbol_name("delta", joint), e - clearance, "m"),
        make_paragraph(f"As δ is {'positive' if e > clearance else 'negative'}, {touch}."),
    )
    answers = {"e": e, "ratio": e / clearance, "delta": e - clearance}
    yield Question("A joint with play", (requested,), solved, answers)


def list_abbreviations(subject: Subject, expressions: Iterable[sp.Expr]) -> list[sp.Symbol]:
    """Return the abbreviations that occur in expressions, each after those that its definition contains."""
    notation, definitions, abbreviations = subject.notation, subject.model.symbols.definitions, list[sp.Symbol]()

    def add_abbreviations(expression: sp.Expr) -> None:
        """Add the abbreviations of one expression, those of their definitions first."""
        for symbol in sorted(
            notation.expand_symbols(expression).free_symbols, key=lambda s: notation.format_expression(s).text
        ):
            if symbol in notation.shown_symbols and symbol in definitions and symbol not in abbreviations:
                add_abbreviations(definitions[symbol])
                abbreviations.append(symbol)

    for expression in expressions:
        add_abbreviations(expression)
    order = {symbol: k for k, symbol in enumerate(subject.model.symbols.definitions)}
    return sorted(abbreviations, key=order.__getitem__)


def define_abbreviations(subject: Subject, symbols: list[sp.Symbol]) -> list[Block]:
    """Return the definitions of abbreviations as blocks after the word "With"; [] if there are none."""
    blocks = [block for symbol in symbols for block in _define_symbol(subject, symbol)]
    return [make_paragraph("With"), *blocks] if blocks else []


def _define_symbol(subject: Subject, symbol: sp.Symbol) -> list[Block]:
    """Return the definition of one abbreviation as blocks; that of a drive with smooth steps by their progress s."""
    value = subject.notation.expand_symbols(subject.model.symbols.definitions[symbol])
    for driven in subject.model.constraints.drive_functions.values():
        if symbol in driven:
            step_blocks = _define_by_steps(subject, symbol, driven)
            return step_blocks or [subject.make_equation(symbol, value)]
    return [subject.make_equation(symbol, value)]


def _define_by_steps(subject: Subject, symbol: sp.Symbol, driven: tuple[sp.Symbol, ...]) -> list[Block]:
    """Return the definition of a driven quantity by the progress s of its steps from 0 to 1; [] for other drives.

    It shows s for min(max(…, 0), 1), and the rates while s is between 0 and 1. `driven`: symbols of the drive's value
    and its time derivatives, of which `symbol` is one.
    """
    notation, t = subject.notation, subject.model.t
    value = notation.expand_symbols(subject.model.symbols.definitions[driven[0]])
    progress_of = {
        clamp: progress for clamp in value.atoms(sp.Max) if (progress := _find_clamped_progress(clamp)) is not None
    }
    used = {name.text for name in notation.names.values()}
    base = next(letter for letter in ("s", "u", "w", "z") if not {letter, f"{letter}_1"} & used)
    steps = {
        clamp: sp.Symbol(base if len(progress_of) == 1 else f"{base}_{k}") for k, clamp in enumerate(progress_of, 1)
    }
    driven_value = value.xreplace(steps)
    if not steps or driven_value.has(sp.Max, sp.Min, Select):
        return []
    rates = {steps[clamp]: sp.diff(progress, t) for clamp, progress in progress_of.items()}
    for _ in range(driven.index(symbol)):
        driven_value = sp.Add(*(_differentiate_in_time(term, rates, t) for term in sp.Add.make_args(driven_value)))
    names = {s: Formula(s.name if "_" not in s.name else f"{base}_{{{s.name[2:]}}}", s.name) for s in rates}
    step_notation = notation.rename_symbols(names)
    step_equations = [
        Equation(step_notation.format_expression(steps[clamp]), step_notation.format_terms(progress))
        for clamp, progress in progress_of.items()
    ]
    outside_text = " and is constant before and after" if driven.index(symbol) else ", with 0 before and 1 after"
    terms = step_notation.format_terms(
        sp.Add(*(_expand_progress(term, list(rates)) for term in sp.Add.make_args(driven_value)))
    )
    return [
        *step_equations,
        make_paragraph(f"which increases from 0 to 1{outside_text}:"),
        Equation(step_notation.format_expression(symbol), terms),
    ]


def _find_clamped_progress(expression: sp.Max) -> sp.Expr | None:
    """Return u if the expression is min(max(u, 0), 1), otherwise None."""
    inner = [x for x in expression.args if isinstance(x, sp.Min)]
    if len(expression.args) != 2 or sp.Integer(0) not in expression.args or len(inner) != 1:
        return None
    others = [x for x in inner[0].args if x != 1]
    return others[0] if len(inner[0].args) == 2 and len(others) == 1 else None


def _differentiate_in_time(term: sp.Expr, rates: dict[sp.Symbol, sp.Expr], t: sp.Symbol) -> sp.Expr:
    """Return the time derivative of a product whose symbols have these `rates`, constant factors first."""
    factor, dependent_part = term.as_independent(*rates, as_Add=False)
    terms = (factor * rate * sp.expand(sp.diff(dependent_part, s)) for s, rate in rates.items())
    return sp.Add(sp.diff(factor, t) * dependent_part, *terms)


def _expand_progress(term: sp.Expr, steps: list[sp.Symbol]) -> sp.Expr:
    """Return a product as a factor times the expanded polynomial in the progress symbols `steps`."""
    factor, dependent_part = term.as_independent(*steps, as_Add=False)
    return sp.Mul(factor, sp.expand(dependent_part), evaluate=False) if dependent_part != 1 else term


def make_indexed_symbol(quantity: str, index: int) -> Formula:
    """Return the symbol of a quantity with an index, in LaTeX and as text; `quantity`: key of its letter."""
    name = make_symbol_name(quantity)
    return Formula(f"{name.latex}_{{{index}}}", f"{name.text}_{index}")


def tabulate_positions(subject: Subject, shows_rates: bool, of_other_bodies: bool = False) -> list[Block]:
    """Return a table of positions (shows_rates: rates) of the bodies in the selected equations, or of the others."""
    model, exercise = subject.model, subject.exercise
    selected_coordinates = {s for _, row in subject.selected_rows for s in row.phi_q}
    header = ("body", "x, m", "y, m", "angle, rad", "angle, degrees")
    if shows_rates:
        header = ("body", "x, m/s", "y, m/s", "angle, rad/s", "")
    values, rows = exercise.v if shows_rates else exercise.q, []
    for body in model.bodies:
        if bool(selected_coordinates & set(body.q)) != of_other_bodies:
            body_values = values[body.index : body.index + 3]
            angle = "" if shows_rates else subject.format_number(float(np.degrees(body_values[2])), 5)
            rows.append(make_row(body.name, *(subject.format_number(float(x), 9) for x in body_values), angle))
    return make_tables(make_row(*header), rows)


def _make_acceleration_question(subject: Subject) -> Question:
    """Build the question for the largest acceleration at the time of the exercise: of an angle without a drive.

    If these angles are at rest, of any coordinate without a drive, or of any. The solution shows Φ_q a = γ by rows.
    """
    model, exercise, compiled = subject.model, subject.exercise, subject.simulation.compiled
    a, driven = exercise.run.a[-1], {q for row in model.rows if len(row.phi_q) == 1 for q in row.phi_q}
    candidates = [k for k in range(2, len(a), 3) if model.q[k] not in driven]
    if not candidates or np.abs(a[candidates]).max() <= ROUNDING_TOL * np.abs(a).max():
        candidates = [k for k in range(len(a)) if model.q[k] not in driven] or [*range(len(a))]
    k = max(candidates, key=lambda k: abs(a[k]))
    name = model.bodies[k // 3].name
    quantity = "angular acceleration of" if k % 3 == 2 else f"acceleration in {'xy'[k % 3]} of the centre of"
    others = tabulate_positions(subject, shows_rates=False, of_other_bodies=True)
    requested = [
        *([make_paragraph("The other bodies are at"), *others, make_paragraph("with the rates")] if others else []),
        *tabulate_positions(subject, shows_rates=True, of_other_bodies=True),
        make_paragraph(
            "Drives determine the whole motion. Write all rows of ",
            ACCELERATIONS,
            f" at {exercise.t:g} s, by hand or by computer, and solve them: how large is the {quantity} {name}?",
        ),
    ]
    phi_q = compiled.phi_q(exercise.t, exercise.q, exercise.p)
    gamma = compiled.gamma(exercise.t, exercise.q, exercise.v, exercise.p)
    symbol_names = [make_symbol_name(base, body.name, dots=2) for body in model.bodies for base in ("x", "y", "theta")]
    shown_rows = range(len(gamma)) if len(gamma) <= MAX_SHOWN_ROWS else [r for r in range(len(gamma)) if phi_q[r, k]]
    scale = float(np.abs(gamma).max())
    errors = exercise.estimate_rounding_uncertainty(lambda q, v: compiled.gamma(exercise.t, q, v, exercise.p))
    solved = [
        make_paragraph("Row by row ", ACCELERATIONS, _format_omission(len(gamma)), " is, in m/s² and rad/s²,"),
        *(
            _make_linear_equation(
                subject, subject.format_number(gamma[r], scale=scale, uncertainty=errors[r]), phi_q[r], symbol_names
            )
            for r in shown_rows
        ),
        make_paragraph("The accelerations, of centres of mass and of angles, are"),
        *_tabulate_by_body(subject, a, "x, m/s²", "y, m/s²", "angle, rad/s²"),
        subject.make_value_equation(symbol_names[k], float(a[k]), "rad/s²" if k % 3 == 2 else "m/s²"),
    ]
    return Question("Accelerations", tuple(requested), tuple(solved), {compiled.source.coordinates[k]: float(a[k])})


def _format_omission(n_rows: int) -> str:
    """Return a remark that only some of the `n_rows` equations are shown; "" if all are."""
    return "" if n_rows <= MAX_SHOWN_ROWS else f", of whose {n_rows} rows those with the requested unknowns are shown,"


def _make_linear_equation(subject: Subject, left: Formula, factors: Array, symbols_of_terms: list[Formula]) -> Equation:
    """Return the equation left = sum of factors times `symbols_of_terms`, without factors of rounding size."""
    symbols = [sp.Symbol(name.text) for name in symbols_of_terms]
    notation = replace(
        subject.notation,
        names=dict(zip(symbols, symbols_of_terms, strict=True)),
        order={symbol: k for k, symbol in enumerate(symbols)},
    )
    scale = float(np.abs(factors).max())
    shown = [(float(f"{x:.4g}"), s) for x, s in zip(factors, symbols, strict=True) if abs(x) > ROUNDING_TOL * scale]
    return Equation(
        left, notation.format_terms(sp.Add(*(s * (sp.nsimplify(x) if abs(x) == 1.0 else x) for x, s in shown)))
    )


def _make_reaction_question(subject: Subject) -> Iterator[Question]:
    """Yield the question for the reaction of a randomly chosen joint without play.

    Nothing is yielded without masses, or if redundancy leaves all reactions undetermined.
    """
    source, exercise, mechanism = subject.simulation.source, subject.exercise, subject.model.scene.mechanism
    open_ = {*source.indeterminate, *(joint.joint for joint in source.clearances)}
    joint_names = [row.owner for row in subject.model.rows if row.kind == "joint" and row.owner not in open_]
    joint_names = [name for name in dict.fromkeys(joint_names) if f"{name}.Fx" in exercise.run]
    if source.massless_bodies or not joint_names:
        return
    name = str(subject.rng.permutation(np.array(joint_names, object))[0])
    second = mechanism.joints[name].second
    F = [float(exercise.run[f"{name}.{component}"][-1]) for component in ("Fx", "Fy", "F")]
    blocks: list[Block] = []
    if subject.model.degrees_of_freedom:
        blocks += [make_paragraph(f"The accelerations at {exercise.t:g} s, of centres of mass and of angles, are")]
        blocks += _tabulate_by_body(subject, exercise.run.a[-1], "x, m/s²", "y, m/s²", "angle, rad/s²")
    else:
        blocks.append(make_paragraph("Use the accelerations of all bodies from the previous question."))
    if source.clearances or source.frictions:
        blocks.append(make_paragraph("Gravity, forces, friction and joints with play have the resultants g"))
        blocks += _tabulate_by_body(subject, _compute_applied_forces(subject), "x, N", "y, N", "angle, N m")
    blocks.append(make_paragraph("By ", KKT, f": what force does {name} exert on {second.body}, in ground axes?"))
    lambdas = [(k, row) for k, row in enumerate(subject.model.rows, 1) if row.owner == name]
    solved: list[Block] = [
        *_make_balance_blocks(subject, [k - 1 for k, _ in lambdas]),
        *(
            subject.make_value_equation(
                make_indexed_symbol("lambda", k),
                _get_multiplier(subject, row.name),
                "N" if row.unit == "m" else "N m",
                F[2],
            )
            for k, row in lambdas
        ),
        make_paragraph(f"The force on {second.body} is that of these multipliers, ", FORCE, ":"),
    ]
    solved += [
        subject.make_value_equation(make_symbol_name("F", axis, name), x, "N", F[2])
        for axis, x in zip("xy", F, strict=False)
    ]
    solved.append(subject.make_value_equation(make_symbol_name("F", name), F[2], "N", F[2]))
    yield Question("The force in a joint", tuple(blocks), tuple(solved), dict(zip(("Fx", "Fy", "F"), F, strict=True)))


def _make_balance_blocks(subject: Subject, requested: list[int]) -> list[Block]:
    """Return Φ_qᵀ λ = g − M q̈ as blocks; of more than MAX_SHOWN_ROWS rows those with `requested` multipliers."""
    model, exercise, compiled = subject.model, subject.exercise, subject.simulation.compiled
    phi_q = compiled.phi_q(exercise.t, exercise.q, exercise.p)
    left = _compute_applied_forces(subject) - np.asarray(compiled.mass(exercise.p)) * exercise.run.a[-1]
    symbol_names = [make_indexed_symbol("lambda", k) for k in range(1, len(model.rows) + 1)]
    n, scale = len(model.q), float(np.abs(left).max())
    shown_rows = [k for k in range(n) if phi_q[:, k].any() and (n <= MAX_SHOWN_ROWS or phi_q[requested, k].any())]
    blocks: list[Block] = [
        make_paragraph("Coordinate by coordinate ", BALANCE, _format_omission(n), " is, in N and N m,")
    ]
    for k in shown_rows:
        q, number = subject.notation.format_expression(model.q[k]), subject.format_number(float(left[k]), scale=scale)
        side = Formula(rf"(g - M \ddot{{q}})_{{{q.latex}}} = {number.latex}", f"(g - M·q̈)_{q.text} = {number.text}")
        blocks.append(_make_linear_equation(subject, side, phi_q[:, k], symbol_names))
    return [*blocks, make_paragraph("and the multipliers are")]


def _get_multiplier(subject: Subject, row: str) -> float:
    """Return the multiplier of a constraint equation at the end of the run, in N or N·m."""
    return float(subject.exercise.run[f"lambda.{row}"][-1])


def _compute_applied_forces(subject: Subject) -> Array:
    """Return the generalized applied forces g = M q̈ + Φ_qᵀ λ (n,) at the last sample of the run, in N and N·m."""
    p, run, compiled = subject.exercise.p, subject.exercise.run, subject.simulation.compiled
    multipliers = np.array([_get_multiplier(subject, row.name) for row in subject.model.rows])
    constraint_forces = compiled.phi_q(run.t[-1], run.q[-1], p).T @ multipliers if len(multipliers) else 0.0
    return np.asarray(compiled.mass(p) * run.a[-1] + constraint_forces)


def _tabulate_by_body(subject: Subject, values: Array, *header: str) -> list[Block]:
    """Return a table with three values (x, y, angle) for each body; header: titles of these columns."""
    body_values = values.reshape(-1, 3)
    scales = [*2 * [float(np.abs(body_values[:, :2]).max())], float(np.abs(body_values[:, 2]).max())]
    rows = [
        make_row(body.name, *(subject.format_number(float(values[body.index + k]), 5, scales[k]) for k in range(3)))
        for body in subject.model.bodies
    ]
    return make_tables(make_row("body", *header), rows)
