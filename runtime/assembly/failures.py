"""What is said where a linkage does not close, or its velocities do not fit."""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.rank import tied
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array
from gudgeon.model.written import reason


def stuck(closure: Closure, matrix: Array, left: Array) -> AssemblyError:
    """Velocities that do not fit: the rows whose combination vanishes, drives and rates among them."""
    source = closure.linkage.source
    rows = [row.name for row in source.start_rows] + list(source.start_rates)
    moving = {row.name for row in source.start_rows if row.kind == "drive"} | set(source.start_rates)
    stuck = [name for name, share in zip(rows, tied(matrix), strict=True) if share > 1e-6]
    movers = [name for name in stuck if name in moving]
    rates = [name for name in stuck if name in source.start_rates]
    play = {joint.name for joint in source.clearances}
    closed = dict.fromkeys(row.owner for row in source.start_rows if row.name in stuck and row.owner in play)
    if rates and closed:
        return AssemblyError(
            f"start.rates {', '.join(rates)} cannot be met: a start closes the joints with play"
            f" ({', '.join(closed)}), and then the linkage moves as its drives say\n"
            "  leave the rate out, or begin from a State of your own: simulate(start=...)"
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
    rows = ", ".join(f"{closure.names[k]} ({closure.residual(q)[k]:.3g})" for k in worst)
    owners = ", ".join(dict.fromkeys(closure.owners[k] for k in worst if closure.owners[k] != "start"))
    sets = "what start.set holds, " if len(closure.set_index) else ""
    return AssemblyError(
        f"the start cannot be assembled: rows {rows} stay open (joints {owners or 'none'};"
        f" residual {np.abs(closure.residual(q)).max():.3g})\n"
        "  either the constraints contradict each other or the guess is far from every branch: check"
        f" {sets}lengths and ground points, or give start.guess angles nearer to the wanted branch"
    )
