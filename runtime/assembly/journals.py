"""What is said of a joint with play whose run begins in contact, without the onset that its damping is a share of."""

from __future__ import annotations

import math

import numpy as np

from gudgeon.model.compiled import Array, CompiledModel


def parting(compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, memory: Array) -> tuple[str, ...]:
    """A remark on each dry contact that a run begins with while δ̇ ≤ 0: its δ̇⁻ is a matter of convention.

    q, v (n,) at time t (s); memory (n_memory,): contacts that go on from another run know their onset.
    """
    joints = [joint for k, joint in enumerate(compiled.source.clearances) if joint.dry and math.isnan(memory[k])]
    phi = compiled.closed_phi(t, q, p) if joints else np.zeros(0)
    told = []
    for joint in joints:
        rows = [k for k, row in enumerate(compiled.source.start_rows) if row.owner == joint.name]
        e = -phi[rows]  # physics.md, section 3: Φ of the joint is −e
        depth = float(np.linalg.norm(e)) - float(p[joint.clearance])
        if depth > 0.0:
            rate = compiled.closed_phi_q(t, q, p)[rows] @ v - compiled.closed_nu(t, q, p)[rows]
            deltadot = -float(rate @ e) / float(np.linalg.norm(e))
            if deltadot <= 0.0:
                told.append(_told(joint.name, depth, deltadot))
    return tuple(told)


def _told(joint: str, depth: float, deltadot: float) -> str:
    moves = f"part at {-deltadot:.4g} m/s" if deltadot < 0.0 else "are at rest"
    taken = f"{-deltadot:.4g} m/s" if deltadot < 0.0 else "0"
    return (
        f"{joint} begins in contact, {depth:.4g} m deep, while its surfaces {moves}: the onset is not known, and its"
        f" rate δ̇⁻ is taken as {taken}, or the contact's velocity_floor if that is more; damping of this contact, and"
        " of no other, hangs on that choice"
    )
