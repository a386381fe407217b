"""Integrate pendulums of several links and Andrews' squeezer by MuJoCo: hinge joints, RK4 with a fixed step.

The control is the step (s). A whole call resets the data, steps in C (`mj_step` with a number of steps) and reads the
angles. The loops of Andrews' squeezer are closed by `connect` constraints. MuJoCo's constraints are soft: they act as
springs with damping, here with a time constant of two steps, the shortest that MuJoCo allows. The tree is that of
`exudyn_andrews.JOINTS`, whose last three joints close the loops.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import andrews as a
from benchmarks.peers import chain_equations as chain
from benchmarks.peers.exudyn_andrews import ANGLES, BODIES, GROUND, JOINTS
from benchmarks.peers.timing import CallTimer, Measured

NAME = "mujoco"
STEPS = {
    2: (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5),
    6: (3e-3, 1e-3, 3e-4, 1e-4, 3e-5),
    64: (1e-2, 3e-3, 1e-3, 3e-4),
}
ANDREWS_STEPS = (1e-4, 3e-5, 1e-5, 3e-6, 1e-6)
HEAD = (
    '<mujoco><compiler angle="radian" autolimits="false" balanceinertia="false" boundmass="0"/>'
    '<option timestep="{step!r}" integrator="RK4" gravity="0 0 {gravity!r}" tolerance="1e-15" iterations="100">'
    '<flag contact="disable"/></option>'
)


def link(name: str, position: tuple[float, float], mass: float, inertia: float, middle: tuple[float, float]) -> str:
    """Return the begin of a body that turns about y at `position`; plane coordinates (x, y) are MuJoCo's (x, 0, z)."""
    return (
        f'<body name="{name}" pos="{position[0]!r} 0 {position[1]!r}"><joint name="{name}" axis="0 -1 0"/>'
        f'<inertial pos="{middle[0]!r} 0 {middle[1]!r}" mass="{mass!r}" '
        f'diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>'
    )


@cache
def chain_model(n: int, step: float) -> tuple[Any, Any]:
    """Return model and data of a pendulum of n links."""
    bodies = "".join(
        link(f"L{k}", (chain.L if k else 0.0, 0.0), chain.M, chain.J, (0.5 * chain.L, 0.0)) for k in range(n)
    )
    text = f"{HEAD.format(step=step, gravity=-chain.G)}<worldbody>{bodies}{'</body>' * n}</worldbody></mujoco>"
    return build(text)


def build(text: str) -> tuple[Any, Any]:
    """Return model and data of a text in MJCF."""
    mujoco = import_module(NAME)
    model = mujoco.MjModel.from_xml_string(text)
    return model, mujoco.MjData(model)


def run_chain(n: int, step: float) -> Measured:
    """Integrate a pendulum of n links."""
    count = round(chain.T_END[n] / step)
    model, data = chain_model(n, chain.T_END[n] / count)
    start = chain.starts(n)[:n, 0]
    timer = CallTimer()
    advance(model, data, np.diff(start, prepend=0.0), count, timer)
    angles = np.cumsum(data.qpos)
    return timer.measured(lambda: chain.error(n, angles), 4 * count)


def advance(model: Any, data: Any, start: np.ndarray, count: int, timer: CallTimer) -> None:
    """Take `count` steps from rest at the joint angles `start`. Raises FloatingPointError if MuJoCo diverges."""
    mujoco = import_module(NAME)
    forces = data.qfrc_applied.copy()
    mujoco.mj_resetData(model, data)
    data.qpos[:], data.qfrc_applied[:] = start, forces
    with timer.engine:
        mujoco.mj_step(model, data, count)
    if not np.isfinite(data.qpos).all() or data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
        raise FloatingPointError("MuJoCo: accelerations are not finite")


@cache
def andrews_model(step: float) -> tuple[Any, Any]:
    """Return model and data of Andrews' squeezer."""
    return build(
        f"{HEAD.format(step=step, gravity=0.0)}<worldbody>"
        f'<site name="C" pos="{GROUND["C"][0]!r} 0 {GROUND["C"][1]!r}"/>{branch("")}</worldbody>'
        f'<tendon><spatial stiffness="{a.C0!r}" springlength="{a.L0!r}"><site site="C"/><site site="BDE_D"/></spatial>'
        f"</tendon><equality>{closures(step)}</equality></mujoco>"
    )


def branch(parent: str) -> str:
    """Return the bodies that hang on a body of the tree, or on the ground (""); origins are at the joints."""
    found = ""
    for name, own, other, there in JOINTS[:7]:
        if other != parent:
            continue
        mass, inertia, points = BODIES[name]
        at = GROUND[there] if not parent else relative(parent, there)
        found += link(name, at, mass, inertia, (-points[own][0], -points[own][1]))
        for point in points:
            x, y = relative(name, point)
            found += f'<site name="{name}_{point}" pos="{x!r} 0 {y!r}"/>'
        found += branch(name) + "</body>"
    return found


def relative(body: str, point: str) -> tuple[float, float]:
    """Return a point in the axes of a body, from the joint that holds the body in the tree."""
    origin = BODIES[body][2][next(own for name, own, _, _ in JOINTS if name == body)]
    (x, y) = BODIES[body][2][point]
    return x - origin[0], y - origin[1]


def closures(step: float) -> str:
    """Return the constraints that close the loops: pairs of sites that coincide."""
    return "".join(
        f'<connect site1="{name}_{own}" site2="{other}_{there}" solref="{2.0 * step!r} 1" '
        'solimp="0.9999 0.9999 1 0.5 1"/>'
        for name, own, other, there in JOINTS[7:]
    )


def run_andrews(step: float) -> Measured:
    """Integrate Andrews' squeezer; its seven angles are those of the tree's joints."""
    count = round(a.T_END / step)
    model, data = andrews_model(a.T_END / count)
    at = [int(model.joint(name).qposadr[0]) for name in ANGLES]
    start, torque = np.empty(7), int(model.joint("OF").dofadr[0])
    start[at] = a.START
    timer = CallTimer()
    data.qfrc_applied[torque] = a.TORQUE
    advance(model, data, start, count, timer)
    angles = data.qpos[at]
    return timer.measured(lambda: a.error(angles), 4 * count)
