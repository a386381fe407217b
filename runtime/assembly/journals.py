"""What is said of journals where a run begins: in contact whose onset is not known, deeper than laws of contact go."""

from __future__ import annotations

import math

import numpy as np

from gudgeon.assembly.linkage import Linkage
from gudgeon.errors import AssemblyError, SingularError
from gudgeon.model.compiled import Array, CompiledModel

DEEPEST = 0.1  # of the radius, that a journal may lie in its bearing (`deepest` of model.h)


def check_places(linkage: Linkage, p: Array) -> None:
    """AssemblyError for a journal that the file's start lays deeper into its bearing than any law of contact holds."""
    source = linkage.source
    if not source.start_apart:
        return
    values = linkage.start_values(p)[1][len(source.start_set) :]
    for joint in source.clearances:
        own = [x for row, x in zip(source.start_apart, values, strict=True) if row.rpartition(".")[0] == joint.name]
        e, c = float(np.linalg.norm(own)), float(p[joint.clearance])
        deepest = DEEPEST * float(p[joint.constants["R_i"]])
        if e - c > deepest:
            raise AssemblyError(
                f"start.play.{joint.name}.e is {1e3 * e:.4g} mm long, and the clearance of {joint.name} is"
                f" {1e3 * c:.4g} mm: it lies {1e3 * deepest:.4g} mm, a tenth of its radius, in metal at most\n"
                f"  a bare number is in m: write e: [{1e3 * c / 2:.3g} mm, 0 mm], or a share of a parameter, 0.5*c"
            )


def parting(compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, memory: Array) -> tuple[str, ...]:
    """A remark on each dry contact that a run begins with while δ̇ ≤ 0: its δ̇⁻ is a matter of convention.

    q, v (n,) at time t (s); memory (n_memory,): contacts that go on from another run know their onset.
    """
    joints = [k for k, joint in enumerate(compiled.source.clearances) if joint.dry and math.isnan(memory[k])]
    phi = compiled.closed_phi(t, q, p) if joints else np.zeros(0)
    told = []
    for number in joints:
        joint = compiled.source.clearances[number]
        rows = [k for k, row in enumerate(compiled.source.start_rows) if row.owner == joint.name]
        e = -phi[rows]  # physics.md, section 3: Φ of the joint is −e
        depth = math.hypot(*e) - float(p[joint.clearance])
        if depth > 0.0:
            with np.errstate(all="ignore"):  # a state of anybody's: the run itself tells what is not finite
                by_v = -(e / math.hypot(*e)) @ compiled.closed_phi_q(t, q, p)[rows]  # ∂δ̇/∂v
                deltadot = float(by_v @ v + (e / math.hypot(*e)) @ compiled.closed_nu(t, q, p)[rows])
                approach = v + (1.0 - deltadot) / float(by_v @ by_v) * by_v  # δ̇ = 1 m/s
                if deltadot <= 0.0 and _reads_onset(compiled, p, t, q, approach, memory, number):
                    told.append(_told(joint.name, depth, deltadot))
    return tuple(told)


def _reads_onset(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, memory: Array, number: int
) -> bool:  # fmt: skip
    """Whether the force in a joint depends on δ̇⁻ at all: it does not without loss, nor where a law reads δ̇ alone."""
    latched = np.array([memory, memory])
    latched[:, number] = 1e-3, np.inf
    try:
        force = compiled.evaluate([t, t], [q, q], [v, v], latched, p, parts=("clearance",)).clearance[:, number]
    except SingularError:  # the run itself tells
        return True
    return bool((force[0] != force[1]).any())


def _told(joint: str, depth: float, deltadot: float) -> str:
    moves = f"part at {-deltadot:.4g} m/s" if deltadot < 0.0 else "are at rest"
    return (
        f"{joint} begins in contact, {1e6 * depth:.4g} µm deep, while its surfaces {moves}: the onset is not known, and"
        " its rate δ̇⁻ is taken as that of one without loss, by the energy of motion and elastic force (run.impacts has"
        " it, as deltadot); damping of this contact, and of no other, hangs on that choice"
    )
