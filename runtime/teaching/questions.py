"""The questions of a sheet: freedoms, Φ, Φ_q at a position, γ, accelerations, the force in a joint, a joint's play."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy as sp

from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.targets.latex.document import Block, cells, paragraph, table
from gudgeon.generator.targets.latex.letters import Name, letter
from gudgeon.model.compiled import Array
from gudgeon.teaching.sheet import LONGEST, Question, Subject

PHI, PHI_Q, NU = Name(r"\Phi", "Φ"), Name(r"\Phi_{q}", "Φ_q"), Name(r"\nu", "ν")
GAMMA = Name(r"\gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}",
             "γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt")  # fmt: skip
ACCELERATIONS = Name(r"\Phi_{q} \ddot{q} = \gamma", "Φ_q·q̈ = γ")
KKT = Name(r"M \ddot{q} + \Phi_{q}^{\mathsf{T}} \lambda = g", "M·q̈ + Φ_qᵀ·λ = g")
WIDEST = 60  # characters of a formula in a cell
STATE = (("x", "m"), ("y", "m"), ("theta", "rad"))


def make_questions(subject: Subject) -> list[Question]:
    """Those that a scene has an answer to."""
    found = [_freedoms(subject)]
    if subject.rows:
        found += [_rows(subject), _jacobian(subject), _gamma(subject)]
        if subject.model.degrees_of_freedom == 0:
            found.append(_acceleration(subject))
        found += _force(subject)
    return [*found, *_play(subject)]


def _freedoms(subject: Subject) -> Question:
    """Grübler's count, and what the rank adds to it."""
    model = subject.model
    mechanism, play = model.scene.mechanism, model.scene.play
    rows, count, n = [], 0, 3 * len(mechanism.bodies)
    for name, kind in [*((j.name, j.kind) for j in mechanism.joints.values()), *((d, "") for d in mechanism.drives)]:
        own = 0 if name in play else len(joint_types()[kind].row_names) if kind else 1
        what = joint_types()[kind].title if kind else "drive"
        rows.append(cells(name, f"{what}, has play" if name in play else what, str(own)))
        count += own
    total = Name(f"f = {n} - {count} = {n - count}", f"f = {n} - {count} = {n - count}")
    solved: list[Block] = [
        paragraph(f"Each body has 3 coordinates, which makes {n}; what joins and drives them:"),
        *table(cells("joint or drive", "type", "rows"), rows),
        paragraph(total, "."),
    ]
    if dropped := model.redundancy.dropped:
        told = f"{', '.join(dropped)} follow from the others: the rank is {len(model.rows)}, and {n - len(model.rows)}"
        solved.append(paragraph(f"Counting is not enough here: {told} are free."))
    asked = paragraph(
        "How many coordinates do the bodies have, how many rows does each joint and drive add to ", PHI,
        ", and how many degrees of freedom f are left by Grübler's count? Does the rank of ", PHI_Q, " agree?",
    )  # fmt: skip
    numbers = {"coordinates": float(n), "rows": float(count), "freedoms": float(n - len(model.rows))}
    return Question("Count the freedoms", (asked,), tuple(solved), numbers)


def _named(subject: Subject) -> str:
    return ", ".join(subject.owners[:-1]) + (" and " if len(subject.owners) > 1 else "") + subject.owners[-1]


def _rows(subject: Subject) -> Question:
    asked = paragraph(
        "Write the rows of ", PHI, f" of {_named(subject)}, in the coordinates of the centres of mass, with the "
        "letters given above. A joint's points are written from its first body to its second.",
    )  # fmt: skip
    solved: list[Block] = [
        block
        for k, row in subject.rows
        for block in (paragraph(f"{row.name}, {row.unit}:"), subject.equation(_indexed("Phi", k), row.phi))
    ]
    return Question("Write Φ", (asked,), tuple(_abbreviations(subject) + solved))


def _abbreviations(subject: Subject) -> list[Block]:
    """What the rows that are asked for show by a letter of its own."""
    model, notation = subject.model, subject.notation
    left = [notation.expand(e) for _, row in subject.rows for e in (row.phi, row.gamma, *row.phi_q.values())]
    seen = dict[sp.Symbol, sp.Expr]()
    while left:
        for symbol in sorted(left.pop().free_symbols, key=str):
            if symbol in notation.kept and symbol in model.symbols.definitions and symbol not in seen:
                seen[symbol] = model.symbols.definitions[symbol]
                left.append(notation.expand(seen[symbol]))
    if not seen:
        return []
    return [paragraph("With"), *(subject.equation(symbol, value) for symbol, value in seen.items())]


def _indexed(of: str, k: int) -> Name:
    name = letter(of)
    return Name(f"{name.latex}_{{{k}}}", f"{name.text}_{k}")


def _position(subject: Subject, rates: bool) -> list[Block]:
    """The coordinates of the bodies that are asked for at the moment, or their rates."""
    model, drawn = subject.model, subject.drawn
    wanted = {s for _, row in subject.rows for s in row.phi_q}
    header = ("body", "x, m", "y, m", "angle, rad", "angle, degrees")
    if rates:
        header = ("body", "x, m/s", "y, m/s", "angle, rad/s", "")
    values, rows = drawn.v if rates else drawn.q, []
    for body in model.bodies:
        if wanted & set(body.q):
            own = values[body.index : body.index + 3]
            angle = "" if rates else subject.number(float(np.degrees(own[2])), 5)
            rows.append(cells(body.name, *(subject.number(float(x), 9) for x in own), angle))
    return table(cells(*header), rows)


def _jacobian(subject: Subject) -> Question:
    model, drawn = subject.model, subject.drawn
    values = subject.simulation.compiled.phi_q(drawn.t, drawn.q, drawn.p)
    place = {q: k for k, q in enumerate(model.q)}
    numbers, rows, below = dict[str, float](), [], list[Block]()
    for k, row in subject.rows:
        for q in sorted(row.phi_q, key=place.__getitem__):
            x = float(values[k - 1, place[q]])
            numbers[f"{row.name} {subject.simulation.source.coordinates[place[q]]}"] = x
            by = subject.notation.math(q)
            left = Name(rf"\partial \Phi_{{{k}}} / \partial {by.latex}", f"∂Φ_{k}/∂{by.text}")
            entry = subject.notation.expand(row.phi_q[q])
            formula: str | Name = subject.notation.math(entry) if sp.count_ops(entry) <= LONGEST else ""
            if isinstance(formula, Name) and len(formula.text) > WIDEST:
                below.append(subject.equation(left, entry))
                formula = "below"
            rows.append(cells(left, formula, subject.number(x), _entry_unit(row.unit, place[q] % 3)))
    asked = [
        paragraph(f"At {drawn.t:g} s the bodies are at"),
        *_position(subject, rates=False),
        paragraph("What entries of ", PHI_Q, f" do the rows of {_named(subject)} have there? Check one by moving its "
                  "coordinate by a little."),
    ]  # fmt: skip
    solved = [*table(cells("entry", "", "value", "unit"), rows), *below]
    return Question("The Jacobian at a position", tuple(asked), tuple(solved), numbers)


def _entry_unit(row: str, axis: int) -> str:
    return {("m", 2): "m/rad", ("rad", 0): "rad/m", ("rad", 1): "rad/m"}.get((row, axis), "1")


def _gamma(subject: Subject) -> Question:
    drawn = subject.drawn
    values = subject.simulation.compiled.gamma(drawn.t, drawn.q, drawn.v, drawn.p)
    scale = float(np.abs(values).max())
    numbers, solved = dict[str, float](), list[Block]()
    for k, row in subject.rows:
        numbers[row.name] = float(values[k - 1])
        gamma = subject.notation.expand(row.gamma)
        if gamma != 0 and sp.count_ops(gamma) <= LONGEST:
            formula = subject.equation(_indexed("gamma", k), gamma)
            # cases never break
            if all(len(term.text) <= WIDEST or "cases" not in term.latex for term in formula.terms):
                solved.append(formula)
        unit = "m/s²" if row.unit == "m" else "rad/s²"
        solved.append(subject.value(_indexed("gamma", k), numbers[row.name], unit, scale))
    asked = [
        paragraph(f"At the same {drawn.t:g} s the rates are"),
        *_position(subject, rates=True),
        paragraph("Find ", GAMMA, f" in the rows of {_named(subject)}: its formula, and its value."),
    ]
    return Question("γ", tuple(asked), tuple(solved), numbers)


def _acceleration(subject: Subject) -> Question:
    """Of the body that turns the most."""
    model, drawn = subject.model, subject.drawn
    alphas = {body.name: float(drawn.run[f"{body.name}.alpha"][-1]) for body in model.bodies}
    name = max(alphas, key=lambda body: abs(alphas[body]))
    angle = letter("theta", name, dots=2)
    asked = paragraph(
        "Drives determine the whole motion. Write all rows of ", ACCELERATIONS, f" at {drawn.t:g} s, by hand or by "
        f"computer, and solve them: how large is the angular acceleration of {name}?",
    )  # fmt: skip
    return Question("Accelerations", (asked,), (subject.value(angle, alphas[name], "rad/s²"),), {name: alphas[name]})


def _force(subject: Subject) -> Iterator[Question]:
    """The reaction of a joint; none without masses, or where redundancy leaves it open."""
    source, drawn, mechanism = subject.simulation.source, subject.drawn, subject.model.scene.mechanism
    open_ = {*source.indeterminate, *(joint.name for joint in source.clearances)}
    known = [row.owner for row in subject.model.rows if row.kind == "joint" and row.owner not in open_]
    known = [name for name in dict.fromkeys(known) if f"{name}.Fx" in drawn.run]
    if source.massless or not known:
        return
    name = str(subject.rng.permutation(np.array(known, object))[0])
    second = mechanism.joints[name].second
    F = [float(drawn.run[f"{name}.{what}"][-1]) for what in ("Fx", "Fy", "F")]
    told: list[Block] = [
        paragraph(f"The accelerations at {drawn.t:g} s, of centres of mass and of angles, are"),
        *_by_body(subject, drawn.run.a[-1], "x, m/s²", "y, m/s²", "angle, rad/s²"),
    ]
    if source.clearances or source.frictions:
        told.append(paragraph("Gravity, forces, friction and joints with play add up to the components of g"))
        told += _by_body(subject, _applied(subject), "x, N", "y, N", "angle, N m")
    told.append(paragraph("By ", KKT, f": what force does {name} put on {second.body}, in ground axes?"))
    lambdas = [(k, row) for k, row in enumerate(subject.model.rows, 1) if row.owner == name]
    solved: list[Block] = [
        subject.value(_indexed("lambda", k), _multiplier(subject, row.name), "N" if row.unit == "m" else "N m", F[2])
        for k, row in lambdas
    ]
    solved += [subject.value(letter("F", axis, name), x, "N", F[2]) for axis, x in zip("xy", F, strict=False)]
    solved.append(subject.value(letter("F", name), F[2], "N", F[2]))
    yield Question("The force in a joint", tuple(told), tuple(solved), dict(zip(("Fx", "Fy", "F"), F, strict=True)))


def _multiplier(subject: Subject, row: str) -> float:
    return float(subject.drawn.run[f"lambda.{row}"][-1])


def _applied(subject: Subject) -> Array:
    """g as the run has it: M q̈ + Φ_qᵀ λ, (n,), N and N·m."""
    drawn, compiled = subject.drawn, subject.simulation.compiled
    last, rows = drawn.run, [row.name for row in subject.model.rows]
    multipliers = np.array([_multiplier(subject, row) for row in rows])
    held = compiled.phi_q(last.t[-1], last.q[-1], drawn.p).T @ multipliers if rows else 0.0
    return np.asarray(compiled.mass(drawn.p) * last.a[-1] + held)


def _by_body(subject: Subject, values: Array, *header: str) -> list[Block]:
    """Three numbers a body."""
    apart = values.reshape(-1, 3)
    scales = [*2 * [float(np.abs(apart[:, :2]).max())], float(np.abs(apart[:, 2]).max())]
    rows = [
        cells(body.name, *(subject.number(float(values[body.index + k]), 5, scales[k]) for k in range(3)))
        for body in subject.model.bodies
    ]
    return table(cells("body", *header), rows)


def _play(subject: Subject) -> Iterator[Question]:
    """Where the journal of a joint with play is in its bearing."""
    drawn = subject.drawn
    if not subject.model.clearances:
        return
    joint = subject.rng.permutation(np.array([c.name for c in subject.model.clearances], object))[0]
    ex, ey = (float(f"{drawn.run[f'{joint}.e{axis}'][-1]:.4g}") for axis in "xy")
    clearance = float(drawn.run.constants[f"{joint}.c"])
    e = float(np.hypot(ex, ey))
    asked = paragraph(
        f"The journal of {joint} is off the middle of its bearing by (", subject.number(ex), ", ", subject.number(ey),
        ") m, and the clearance is ", subject.number(clearance), " m. How large are the eccentricity e, its ratio "
        "e/c and the penetration δ = e - c? Do the surfaces touch?",
    )  # fmt: skip
    touch = "they touch" if e > clearance else "they do not touch"
    solved = (
        subject.value(letter("e", joint), e, "m"),
        subject.value(letter("epsilon", joint), e / clearance),
        subject.value(letter("delta", joint), e - clearance, "m"),
        paragraph(f"As δ is {'positive' if e > clearance else 'negative'}, {touch}."),
    )
    numbers = {"e": e, "ratio": e / clearance, "delta": e - clearance}
    yield Question("A joint with play", (asked,), solved, numbers)
