"""What is said where a linkage does not close, or its velocities do not fit."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from gudgeon.assembly.closure import CLOSED, Closure
from gudgeon.assembly.open_loops import wrong_lengths
from gudgeon.assembly.rank import tied
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array
from gudgeon.model.far_masses import far_masses
from gudgeon.model.written import reason

FAR = 100.0  # times the next longest: so far apart are lengths in mm and those left in m
FEW = 60  # coordinates up to which it is looked for which length is wrong


def stuck(closure: Closure, matrix: Array, left: Array) -> AssemblyError:
    """Velocities that do not fit: the rows whose combination vanishes, drives and rates among them."""
    source = closure.linkage.source
    if told := far_masses(source, closure.linkage.mass(closure.p)):
        return AssemblyError(told)
    rows = [row.name for row in source.start_rows] + list(source.start_rates)
    moving = {row.name for row in source.start_rows if row.kind == "drive"} | set(source.start_rates)
    stuck = [name for name, share in zip(rows, tied(matrix), strict=True) if share > 1e-6]
    movers = [name for name in stuck if name in moving]
    rates = [name for name in stuck if name in source.start_rates]
    play = {joint.joint: joint.at_wall for joint in source.clearances}
    closed = dict.fromkeys(row.owner for row in source.start_rows if row.name in stuck and row.owner in play)
    if rates and closed:
        first = next(iter(closed))
        key = "offset_rate" if play[first] else "rate"
        return AssemblyError(
            f"start.rates {', '.join(rates)} cannot be met: a start closes the joints with play"
            f" ({', '.join(closed)}), and then the linkage moves as its drives say\n"
            f"  leave the rate out, say how journals move (start: {{play: {{{first}: {{{key}: ..}}}}}}),"
            " or begin from a State of your own: simulate(start=...)"
        )
    if len(movers) > 1:
        owners = dict(zip(rows, [row.owner for row in source.start_rows], strict=False))
        joints = dict.fromkeys(owners[name] for name in stuck if name not in moving)
        among = f" (joints {', '.join(joints)} tie them)" if joints else ""
        return AssemblyError(
            f"the start's velocities contradict each other: {', '.join(movers)} ask for different motions{among}\n"
            "  leave out a rate, or make drives and rates agree at the start"
        )
    if movers:
        return AssemblyError(
            f"the start is a dead centre: {', '.join(movers)} cannot move the linkage from here (rows"
            f" {', '.join(name for name in stuck if name not in moving)} stand against it)\n"
            "  start from another angle, or drive another body"
        )
    worst = rows[int(left.argmax())]
    return AssemblyError(f"no velocities fit the start: row {worst} is left with {left.max():.3g}")


def not_closed(closure: Closure, q: Array) -> AssemblyError:
    """Which rows stay open, by how much, and what to try."""
    scaled = np.abs(closure.residual(q) / closure.row_scale)
    if not np.isfinite(scaled).all():
        why = reason(closure.linkage.source, closure.p, closure.t, q, np.zeros_like(q))
        told = f"{why}\n  expected a number at the start" if why else "the constraints are not finite at the guess"
        return AssemblyError(f"the start cannot be assembled: {told}")
    worst = np.argsort(-scaled)[:6]
    worst = worst[scaled[worst] > 1e-3 * scaled.max()]
    rows = ", ".join(_open_row(closure, q, k) for k in worst)
    if more := int((scaled >= max(CLOSED, 1e-6 * scaled.max())).sum()) - len(worst):
        rows += f" and {more} more, less far,"
    owners = ", ".join(dict.fromkeys(closure.owners[k] for k in worst if closure.owners[k] != "start"))
    sets = "what start.set holds, " if len(closure.set_index) else ""
    lengths = _in_metres(closure) or _lengths(closure, q)
    return AssemblyError(
        f"the start cannot be assembled: rows {rows} stay open (joints {owners or 'none'}){lengths}\n"
        "  either the constraints contradict each other or the guess is far from every branch: check"
        f" {sets}lengths and ground points, or give start.guess angles nearer to the wanted branch"
    )


def _open_row(closure: Closure, q: Array, k: int) -> str:
    """ "C.x (8.2 mm, line 14)": by how much it stays open."""
    left, line = float(closure.residual(q)[k]), dict(closure.linkage.source.lines).get(closure.owners[k])
    amount = lengths_text(left) if closure.units[k] == "m" else f"{np.degrees(left):.3g} deg"
    return f"{closure.names[k]} ({amount}{f', line {line}' if line else ''})"


def _lengths(closure: Closure, q: Array) -> str:
    """Which links are too short or too long, and by how much; "" where no single one would do, or they are many."""
    if closure.linkage.n > FEW:
        return ""
    found = wrong_lengths(closure, closure.least(q, closure.p))[:3]
    told = [
        f"{one.told} ({lengths_text(one.length)}) {'longer' if one.missing > 0.0 else 'shorter'} by"
        f" {lengths_text(abs(one.missing))}" for one in found
    ]  # fmt: skip
    return f"\n  one change would close it: {', or '.join(told)}" if told else ""


def _in_metres(closure: Closure) -> str:
    """Which few lengths of the file are metres where all the others are far less; "" where none are."""
    source = closure.linkage.source
    sizes = {
        slot.address: abs(float(closure.p[k]))
        for k, slot in enumerate(source.slots)
        if slot.dimension == (1, 0, 0) and slot.address.startswith(("bodies.", "ground.", "joints."))
    }
    order = sorted((name for name, size in sizes.items() if size > 0.0), key=lambda name: -sizes[name])
    for k, (name, after) in enumerate(pairwise(order), 1):
        if sizes[name] > FAR * sizes[after] and sizes[name] >= 1.0 and 2 * k <= len(order):
            told = ", ".join(f"{long} is {lengths_text(sizes[long])}" for long in order[:k][:3])
            meant = f"was {sizes[order[0]]:.4g} mm meant" if k == 1 else "were they meant in mm"
            return f"\n  {told}, {sizes[name] / sizes[after]:,.0f} times the next longest: {meant}? bare numbers are m"
    return ""


def lengths_text(length: float) -> str:
    """A length with four digits, in mm or m."""
    return f"{1e3 * length:.4g} mm" if abs(length) < 1.0 else f"{length:.4g} m"
