"""Questions of the motion: accelerations from all rows, and from them the force in a joint."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import sympy as sp

from gudgeon.generator.targets.latex.document import Block, Equation, cells, paragraph, table
from gudgeon.generator.targets.latex.letters import Name, letter
from gudgeon.model.compiled import Array
from gudgeon.teaching.draw_numbers import NOISE
from gudgeon.teaching.sheet import Question, Subject

ACCELERATIONS = Name(r"\Phi_{q} \ddot{q} = \gamma", "Φ_q·q̈ = γ")
KKT = Name(r"M \ddot{q} + \Phi_{q}^{\mathsf{T}} \lambda = g", "M·q̈ + Φ_qᵀ·λ = g")
BALANCE = Name(r"\Phi_{q}^{\mathsf{T}} \lambda = g - M \ddot{q}", "Φ_qᵀ·λ = g - M·q̈")
FORCE = Name(r"-\Phi_{q}^{\mathsf{T}} \lambda", "-Φ_qᵀ·λ")
MOST = 40  # rows that a solution writes out


def indexed(of: str, k: int) -> Name:
    name = letter(of)
    return Name(f"{name.latex}_{{{k}}}", f"{name.text}_{k}")


def position(subject: Subject, rates: bool, others: bool = False) -> list[Block]:
    """The coordinates of the bodies that are asked for at the moment, or of the others, or their rates."""
    model, drawn = subject.model, subject.drawn
    wanted = {s for _, row in subject.rows for s in row.phi_q}
    header = ("body", "x, m", "y, m", "angle, rad", "angle, degrees")
    if rates:
        header = ("body", "x, m/s", "y, m/s", "angle, rad/s", "")
    values, rows = drawn.v if rates else drawn.q, []
    for body in model.bodies:
        if bool(wanted & set(body.q)) != others:
            own = values[body.index : body.index + 3]
            angle = "" if rates else subject.number(float(np.degrees(own[2])), 5)
            rows.append(cells(body.name, *(subject.number(float(x), 9) for x in own), angle))
    return table(cells(*header), rows)


def acceleration(subject: Subject) -> Question:
    """Of the body that turns the most; of what turns evenly, or as a drive says, the place that is sped up most."""
    model, drawn, compiled = subject.model, subject.drawn, subject.simulation.compiled
    a, driven = drawn.run.a[-1], {q for row in model.rows if len(row.phi_q) == 1 for q in row.phi_q}
    turning = [k for k in range(2, len(a), 3) if model.q[k] not in driven]
    if not turning or np.abs(a[turning]).max() <= NOISE * np.abs(a).max():
        turning = [k for k in range(len(a)) if model.q[k] not in driven] or [*range(len(a))]
    k = max(turning, key=lambda k: abs(a[k]))
    name = model.bodies[k // 3].name
    what = "angular acceleration of" if k % 3 == 2 else f"acceleration in {'xy'[k % 3]} of the centre of"
    others = position(subject, rates=False, others=True)
    asked = [
        *([paragraph("The other bodies are at"), *others, paragraph("with the rates")] if others else []),
        *position(subject, rates=True, others=True),
        paragraph(
            "Drives determine the whole motion. Write all rows of ", ACCELERATIONS, f" at {drawn.t:g} s, by hand or by "
            f"computer, and solve them: how large is the {what} {name}?",
        ),
    ]  # fmt: skip
    phi_q, gamma = compiled.phi_q(drawn.t, drawn.q, drawn.p), compiled.gamma(drawn.t, drawn.q, drawn.v, drawn.p)
    signs = [letter(base, body.name, dots=2) for body in model.bodies for base in ("x", "y", "theta")]
    shown = range(len(gamma)) if len(gamma) <= MOST else [r for r in range(len(gamma)) if phi_q[r, k]]
    scale, off = float(np.abs(gamma).max()), drawn.uncertainty(lambda q, v: compiled.gamma(drawn.t, q, v, drawn.p))
    solved = [
        paragraph("Row by row ", ACCELERATIONS, _told(len(gamma)), " is, in m/s² and rad/s²,"),
        *(_row(subject, subject.number(gamma[r], scale=scale, off=off[r]), phi_q[r], signs) for r in shown),
        paragraph("The accelerations, of centres of mass and of angles, are"),
        *_by_body(subject, a, "x, m/s²", "y, m/s²", "angle, rad/s²"),
        subject.value(signs[k], float(a[k]), "rad/s²" if k % 3 == 2 else "m/s²"),
    ]
    coordinate = subject.simulation.source.coordinates[k]
    return Question("Accelerations", tuple(asked), tuple(solved), {coordinate: float(a[k])})


def _told(rows: int) -> str:
    return "" if rows <= MOST else f", of whose {rows} rows those with what is asked stand here,"


def _row(subject: Subject, left: Name, factors: Array, of: list[Name]) -> Equation:
    """left = a sum of factors times letters."""
    symbols = [sp.Symbol(name.text) for name in of]
    notation = replace(
        subject.notation,
        names=dict(zip(symbols, of, strict=True)),
        order={symbol: k for k, symbol in enumerate(symbols)},
    )
    scale = float(np.abs(factors).max())
    shown = [(float(f"{x:.4g}"), s) for x, s in zip(factors, symbols, strict=True) if abs(x) > NOISE * scale]
    return Equation(left, notation.terms(sp.Add(*(s * (sp.nsimplify(x) if abs(x) == 1.0 else x) for x, s in shown))))


def force(subject: Subject) -> Iterator[Question]:
    """The reaction of a joint; none without masses, or where redundancy leaves it open."""
    source, drawn, mechanism = subject.simulation.source, subject.drawn, subject.model.scene.mechanism
    open_ = {*source.indeterminate, *(joint.joint for joint in source.clearances)}
    known = [row.owner for row in subject.model.rows if row.kind == "joint" and row.owner not in open_]
    known = [name for name in dict.fromkeys(known) if f"{name}.Fx" in drawn.run]
    if source.massless or not known:
        return
    name = str(subject.rng.permutation(np.array(known, object))[0])
    second = mechanism.joints[name].second
    F = [float(drawn.run[f"{name}.{what}"][-1]) for what in ("Fx", "Fy", "F")]
    told: list[Block] = []
    if subject.model.degrees_of_freedom:
        told.append(paragraph(f"The accelerations at {drawn.t:g} s, of centres of mass and of angles, are"))
        told += _by_body(subject, drawn.run.a[-1], "x, m/s²", "y, m/s²", "angle, rad/s²")
    else:
        told.append(paragraph("Take the accelerations of all bodies from the question before."))
    if source.clearances or source.frictions:
        told.append(paragraph("Gravity, forces, friction and joints with play add up to the components of g"))
        told += _by_body(subject, _applied(subject), "x, N", "y, N", "angle, N m")
    told.append(paragraph("By ", KKT, f": what force does {name} put on {second.body}, in ground axes?"))
    lambdas = [(k, row) for k, row in enumerate(subject.model.rows, 1) if row.owner == name]
    solved: list[Block] = [
        *_balance(subject, [k - 1 for k, _ in lambdas]),
        *(
            subject.value(
                indexed("lambda", k), _multiplier(subject, row.name), "N" if row.unit == "m" else "N m", F[2]
            )
            for k, row in lambdas
        ),
        paragraph(f"The force on {second.body} is what these multipliers put on it, ", FORCE, ":"),
    ]
    solved += [subject.value(letter("F", axis, name), x, "N", F[2]) for axis, x in zip("xy", F, strict=False)]
    solved.append(subject.value(letter("F", name), F[2], "N", F[2]))
    yield Question("The force in a joint", tuple(told), tuple(solved), dict(zip(("Fx", "Fy", "F"), F, strict=True)))


def _balance(subject: Subject, asked: list[int]) -> list[Block]:
    """The equations from which the multipliers came, a coordinate each."""
    model, drawn, compiled = subject.model, subject.drawn, subject.simulation.compiled
    phi_q = compiled.phi_q(drawn.t, drawn.q, drawn.p)
    left = _applied(subject) - np.asarray(compiled.mass(drawn.p)) * drawn.run.a[-1]
    signs = [indexed("lambda", k) for k in range(1, len(model.rows) + 1)]
    n, scale = len(model.q), float(np.abs(left).max())
    shown = [k for k in range(n) if phi_q[:, k].any() and (n <= MOST or phi_q[asked, k].any())]
    blocks: list[Block] = [paragraph("Coordinate by coordinate ", BALANCE, _told(n), " is, in N and N m,")]
    for k in shown:
        q, number = subject.notation.math(model.q[k]), subject.number(float(left[k]), scale=scale)
        what = Name(rf"(g - M \ddot{{q}})_{{{q.latex}}} = {number.latex}", f"(g - M·q̈)_{q.text} = {number.text}")
        blocks.append(_row(subject, what, phi_q[:, k], signs))
    return [*blocks, paragraph("and solved for the multipliers")]


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
