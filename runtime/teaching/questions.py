"""The questions of a sheet: freedoms, Φ, Φ_q at a position, γ, a joint's play; of the motion: motion_questions.py."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

import numpy as np
import sympy as sp

from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.targets.latex.document import Block, cells, paragraph, table
from gudgeon.generator.targets.latex.kinematics import gamma_of
from gudgeon.generator.targets.latex.letters import Name, letter
from gudgeon.teaching.abbreviations import abbreviations, letters_of
from gudgeon.teaching.motion_questions import acceleration, force, indexed, position
from gudgeon.teaching.sheet import LONGEST, Question, Subject

PHI, PHI_Q, NU = Name(r"\Phi", "Φ"), Name(r"\Phi_{q}", "Φ_q"), Name(r"\nu", "ν")
GAMMA = Name(r"\gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}",
             "γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt")  # fmt: skip
WIDEST = 60  # characters of a formula in a cell
STATE = (("x", "m"), ("y", "m"), ("theta", "rad"))


def make_questions(subject: Subject) -> list[Question]:
    """Those that a scene has an answer to."""
    found = [_freedoms(subject)]
    if subject.rows:
        found += [_rows(subject), _jacobian(subject), _gamma(subject)]
        if subject.model.degrees_of_freedom == 0:
            found.append(acceleration(subject))
        found += force(subject)
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
    elif model.rows:
        told = f" is {len(model.rows)}, as many as there are rows: none follows from the others, and f is what is free."
        solved.append(paragraph("The rank of ", PHI_Q, told))
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
        for block in (paragraph(f"{row.name}, {row.unit}:"), subject.equation(indexed("Phi", k), row.phi))
    ]
    return Question("Write Φ", (asked,), tuple(_new_letters(subject, "phi") + solved))


def _new_letters(subject: Subject, of: str) -> list[Block]:
    """What these of the rows that are asked for show by a letter that earlier solutions have not explained."""
    wanted = {
        "phi": [row.phi for _, row in subject.rows],
        "phi_q": [entry for _, row in subject.rows for entry in row.phi_q.values()],
        "gamma": [row.gamma for _, row in subject.rows],
    }
    known = set[sp.Symbol]()
    for before in takewhile(lambda what: what != of, wanted):
        known |= set(letters_of(subject, wanted[before]))
    return abbreviations(subject, [s for s in letters_of(subject, wanted[of]) if s not in known])


def _jacobian(subject: Subject) -> Question:
    model, drawn = subject.model, subject.drawn
    compiled = subject.simulation.compiled
    values = compiled.phi_q(drawn.t, drawn.q, drawn.p)
    off = drawn.uncertainty(lambda q, v: compiled.phi_q(drawn.t, q, drawn.p))
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
            shown = subject.number(x, off=off[k - 1, place[q]])
            rows.append(cells(left, formula, shown, _entry_unit(row.unit, place[q] % 3)))
    asked = [
        paragraph(f"At {drawn.t:g} s the bodies are at"),
        *position(subject, rates=False),
        paragraph("What entries of ", PHI_Q, f" do the rows of {_named(subject)} have there? Check one by moving its "
                  "coordinate by a little."),
    ]  # fmt: skip
    solved = [*_new_letters(subject, "phi_q"), *table(cells("entry", "", "value", "unit"), rows), *below]
    return Question("The Jacobian at a position", tuple(asked), tuple(solved), numbers)


def _entry_unit(row: str, axis: int) -> str:
    return {("m", 2): "m/rad", ("rad", 0): "rad/m", ("rad", 1): "rad/m"}.get((row, axis), "1")


def _gamma(subject: Subject) -> Question:
    drawn = subject.drawn
    compiled = subject.simulation.compiled
    values = compiled.gamma(drawn.t, drawn.q, drawn.v, drawn.p)
    off = drawn.uncertainty(lambda q, v: compiled.gamma(drawn.t, q, v, drawn.p))
    scale = float(np.abs(values).max())
    numbers, solved = dict[str, float](), _new_letters(subject, "gamma")
    for k, row in subject.rows:
        numbers[row.name] = float(values[k - 1])
        gamma = gamma_of(row, subject.model, subject.notation)
        if gamma != 0 and sp.count_ops(gamma) <= LONGEST:
            formula = subject.equation(indexed("gamma", k), gamma)
            # cases never break
            if all(len(term.text) <= WIDEST or "cases" not in term.latex for term in formula.terms):
                solved.append(formula)
        unit = "m/s²" if row.unit == "m" else "rad/s²"
        solved.append(subject.value(indexed("gamma", k), numbers[row.name], unit, scale, off[k - 1]))
    asked = [
        paragraph(f"At the same {drawn.t:g} s the rates are"),
        *position(subject, rates=True),
        paragraph("Find ", GAMMA, f" in the rows of {_named(subject)}: its formula, and its value."),
    ]
    return Question("γ", tuple(asked), tuple(solved), numbers)


def _play(subject: Subject) -> Iterator[Question]:
    """Where the journal of a joint with play is in its bearing."""
    drawn = subject.drawn
    journals = [c.name for c in subject.model.clearances if c.wall is None]
    if not journals:
        return
    joint = subject.rng.permutation(np.array(journals, object))[0]
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
