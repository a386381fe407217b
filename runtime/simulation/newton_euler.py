"""Newton's and Euler's equations of single bodies at samples, with the reported reactions.

For each body on which only joints and gravity act, m a - m g - sum F and J alpha - sum (M + r x F) are computed
from the description of the scene. Nothing of the derived equations is used but what the run reports: accelerations,
reactions, contact forces and masses.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation

KINDS = frozenset({"revolute", "translational", "point_on_line", "distance", "rigid"})  # one reaction at one point
LEAST = 1e-300  # N, N m


@dataclass(frozen=True)
class Table:
    """Which forces act on which bodies, of a scene: made once."""

    signs: Array  # (n_bodies, n_joints + n_clearances) 1 where a force on the second body acts, -1 where its reaction
    moved: NDArray[np.intp]  # bodies on which all forces are known
    turned: NDArray[np.intp]  # those on which all moments are, too
    turning: Array  # (n_turned, n_joints) rows of `signs`
    body: NDArray[np.intp]  # (n_joints,) on which the reaction has its point; -1: the ground
    at: NDArray[np.intp]  # (2, n_joints) indices into p of the point's coordinates in its body
    at_sign: Array  # (2, n_joints) by which these are multiplied
    gravity: tuple[tuple[int, int], ...]  # its given components: axis, index into p


def table_of(source: KernelSource) -> Table:
    """Return the table of a scene; it is kept with the source."""
    kept = source.__dict__
    if "newton_euler" not in kept:
        kept["newton_euler"] = _made(source)
    found: Table = kept["newton_euler"]
    return found


def _made(source: KernelSource) -> Table:
    places, bodies = {point.name: point for point in source.points}, [body.name for body in source.bodies]
    parts = {part.name: part for part in source.parts if part.section == "joints"}
    moved, turned = np.ones(len(bodies), dtype=bool), np.ones(len(bodies), dtype=bool)
    lost = {name.partition(".")[0] for part in source.parts for name in (*part.ends, *part.options.values())
            if part.section == "forces" or part.name in source.indeterminate or part.name in source.rigid
            or (part.section == "drives" and part.kind != "angle")
            or (part.section == "joints" and part.kind not in KINDS)}  # fmt: skip
    driven = {name.partition(".")[0] for part in source.parts for name in part.ends if part.section == "drives"}
    moved[[name in lost for name in bodies]] = False
    first, contacts = np.zeros((len(bodies), len(source.joints))), np.zeros((len(bodies), len(source.clearances)))
    joints = [(joint.first, joint.second) for joint in source.joints]
    plays = [(joint.first, joint.second) for joint in source.clearances]
    for rows, pairs in ((first, joints), (contacts, plays)):
        for k, (before, after) in enumerate(pairs):
            for body, sign in ((before, -1.0), (after, 1.0)):
                if body >= 0:
                    rows[body, k] = sign
    points = [places[parts[joint.name].ends[0] if joint.kind == "point_on_line" else joint.point]
              for joint in source.joints]  # fmt: skip
    turned &= moved & ~contacts.any(axis=1) & ~np.array([name in driven for name in bodies], dtype=bool)
    at = np.array([[max(point.x, 0) for point in points], [max(point.y, 0) for point in points]], dtype=np.intp)
    signs = [[point.sign_x * (point.x >= 0) for point in points], [point.sign_y * (point.y >= 0) for point in points]]
    given = ((0, source.place.get("gravity.x")), (1, source.place.get("gravity.y")))
    return Table(
        np.hstack([first, contacts]), np.flatnonzero(moved), np.flatnonzero(turned), first[turned],
        np.array([point.body for point in points], dtype=np.intp), at, np.array(signs, dtype=float),
        tuple((axis, k) for axis, k in given if k is not None),
    )  # fmt: skip


def newton_euler(compiled: CompiledModel, p: Array, q: Array, evaluation: Evaluation, at: NDArray[np.intp]) -> Array:
    """Return what is left of the equations of bodies at samples `at`, (len(at),), as a share of the largest term."""
    table, n = table_of(compiled.source), len(at)
    if not len(table.moved) or not n:
        return np.zeros(n)
    m = compiled.mass(p)
    inertia = (evaluation.a[at] * m).reshape(n, -1, 3)
    reactions = evaluation.reactions[at, : len(table.body)]
    forces = np.concatenate([reactions[:, :, :2], evaluation.clearance[at, :, :2]], axis=1)
    left = inertia[:, :, :2] - table.signs @ forces
    for axis, k in table.gravity:
        left[:, :, axis] -= m[::3] * p[k]
    largest = max(np.abs(inertia[:, :, :2]).max(), np.abs(forces).max(initial=0.0), LEAST)
    worst = np.abs(left[:, table.moved]).max(axis=(1, 2)) / largest
    if len(table.turned):
        moments, longest = _moments(table, p, q[at].reshape(n, -1, 3), reactions)
        off = np.abs(inertia[:, table.turned, 2] - moments.sum(axis=2)).max(axis=1)
        worst = np.maximum(worst, off / max(np.abs(moments).max(initial=0.0), largest * longest, LEAST))
    return np.asarray(worst)


def _moments(table: Table, p: Array, q: Array, reactions: Array) -> tuple[Array, float]:
    """Return moments of reactions about centres of mass, (n, n_turned, n_joints), N m, and the longest arm, m.

    q is (n, n_bodies, 3).
    """
    x, y = p[table.at] * table.at_sign
    own = q[:, table.body] * (table.body >= 0)[:, np.newaxis]
    c, s = np.cos(own[:, :, 2]), np.sin(own[:, :, 2])
    arm_x = (own[:, :, 0] + c * x - s * y)[:, np.newaxis] - q[:, table.turned, 0, np.newaxis]
    arm_y = (own[:, :, 1] + s * x + c * y)[:, np.newaxis] - q[:, table.turned, 1, np.newaxis]
    F_x, F_y, M = reactions[:, np.newaxis, :, 0], reactions[:, np.newaxis, :, 1], reactions[:, np.newaxis, :, 2]
    longest = float((np.hypot(arm_x, arm_y) * np.abs(table.turning)).max(initial=0.0))
    return np.asarray(table.turning * (M + arm_x * F_y - arm_y * F_x)), longest
