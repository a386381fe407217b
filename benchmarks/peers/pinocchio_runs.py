"""Integrate pendulums of several links and Andrews' squeezer by Pinocchio's dynamics and SciPy's DOP853.

Pinocchio computes accelerations in C++ and has no integrator of its own, so DOP853 calls it from Python: `aba` for
trees; for Andrews' squeezer `constraintDynamics`, in which three point constraints close the loops, with Baumgarte
terms. Joints turn about -y, and plane coordinates (x, y) are Pinocchio's (x, 0, z). The tree is that of
`exudyn_andrews.JOINTS`, whose last three joints close the loops.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import andrews as a
from benchmarks.peers import chain_equations as chain
from benchmarks.peers.exudyn_andrews import ANGLES, BODIES, GROUND, JOINTS
from benchmarks.peers.timing import CallTimer, Measured

NAME = "pinocchio"
ATOL = 1e-2  # of rtol
DEPTH_FIRST = ("OF", "FE", "BDE", "AG", "EG", "AH", "HE")  # the order in which Pinocchio needs the bodies
STABLE = 1e3  # 1/s, gain of Baumgarte's terms
PROXIMAL = 1e-10, 1e-10, 10  # accuracy, regularization and iterations of the constraint solver


def at(point: tuple[float, float]) -> Any:
    """Return a placement without rotation at a point of the plane."""
    return import_module(NAME).SE3(np.eye(3), np.array([point[0], 0.0, point[1]]))


def add_link(
    model: Any,
    parent: int,
    name: str,
    place: tuple[float, float],
    mass: float,
    inertia: float,
    middle: tuple[float, float],
) -> int:
    """Add a body on a revolute joint at `place` of its parent; return the index of the joint."""
    pin = import_module(NAME)
    joint = int(model.addJoint(parent, pin.JointModelRevoluteUnaligned(np.array([0.0, -1.0, 0.0])), at(place), name))
    model.appendBodyToJoint(joint, pin.Inertia(mass, at(middle).translation, inertia * np.eye(3)), pin.SE3.Identity())
    return joint


@cache
def chain_model(n: int) -> tuple[Any, Any]:
    """Return model and data of a pendulum of n links."""
    model, joint = import_module(NAME).Model(), 0
    model.gravity.linear = np.array([0.0, 0.0, -chain.G])
    for k in range(n):
        joint = add_link(model, joint, f"L{k}", (chain.L * bool(k), 0.0), chain.M, chain.J, (0.5 * chain.L, 0.0))
    return model, model.createData()


Accelerations = Callable[[np.ndarray, np.ndarray], np.ndarray]


def integrate(find: Accelerations, start: np.ndarray, t_end: float, rtol: float, timer: CallTimer) -> tuple[Any, int]:
    """Integrate from rest by DOP853; return the joint angles at the end and the number of right-hand sides."""
    from scipy.integrate import solve_ivp

    n = len(start)

    def rate(_: float, y: np.ndarray) -> np.ndarray:
        """Return y'."""
        return np.concatenate([y[n:], find(y[:n], y[n:])])

    y0 = np.concatenate([start, np.zeros(n)])
    with timer.engine:
        s = solve_ivp(rate, (0.0, t_end), y0, "DOP853", t_eval=[t_end], rtol=rtol, atol=ATOL * rtol)
    return s.y[:n, -1], int(s.nfev)


def run_chain(n: int, rtol: float) -> Measured:
    """Integrate a pendulum of n links."""
    aba = import_module(NAME).aba
    model, data = chain_model(n)
    start, nothing = np.diff(chain.starts(n)[:n, 0], prepend=0.0), np.zeros(n)
    timer = CallTimer()
    angles, calls = integrate(lambda q, v: aba(model, data, q, v, nothing), start, chain.T_END[n], rtol, timer)
    absolute = np.cumsum(angles)
    return timer.measured(lambda: chain.error(n, absolute), calls)


@cache
def andrews_model() -> tuple[Any, ...]:
    """Return model, data, constraints and their data, joints' indices, points C and D of the spring."""
    pin = import_module(NAME)
    model, joint = pin.Model(), {"": 0}
    model.gravity.linear = np.zeros(3)
    for name, own, other, there in sorted(JOINTS[:7], key=lambda entry: DEPTH_FIRST.index(entry[0])):
        mass, inertia, points = BODIES[name]
        place = relative(other, there) if other else GROUND[there]
        joint[name] = add_link(model, joint[other], name, place, mass, inertia, (-points[own][0], -points[own][1]))
    closed, closed_data = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for name, own, other, there in JOINTS[7:]:
        ends = joint[name], at(relative(name, own)), joint[other], at(relative(other, there))
        constraint = pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, *ends, pin.ReferenceFrame.LOCAL)
        baumgarte = constraint.m_baumgarte_parameters
        baumgarte.Kp, baumgarte.Kd = STABLE**2, 2.0 * STABLE
        constraint.setBaumgarteCorrectorParameters(baumgarte)
        closed.append(constraint)
        closed_data.append(constraint.createData())
    data = model.createData()
    pin.initConstraintDynamics(model, data, closed, closed_data)
    return model, data, closed, closed_data, joint


def relative(body: str, point: str) -> tuple[float, float]:
    """Return a point in the axes of a body, from the joint that holds the body in the tree."""
    origin = BODIES[body][2][next(own for name, own, _, _ in JOINTS if name == body)]
    (x, y) = BODIES[body][2][point]
    return x - origin[0], y - origin[1]


def run_andrews(rtol: float) -> Measured:
    """Integrate Andrews' squeezer; its seven angles are those of the tree's joints."""
    pin = import_module(NAME)
    model, data, closed, closed_data, joint = andrews_model()
    order = [model.joints[joint[name]].idx_q for name in ANGLES]
    start, torque = np.empty(7), np.zeros(7)
    start[order] = a.START
    settings = pin.ProximalSettings(*PROXIMAL)
    spring = order[ANGLES.index("BDE")]
    arm_x, arm_y = relative("BDE", "D")

    def find(q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the accelerations; the spring turns BDE about B, which is fixed."""
        c, s = np.cos(q[spring]), np.sin(q[spring])
        x, y = c * arm_x - s * arm_y, s * arm_x + c * arm_y
        dx, dy = GROUND["B"][0] + x - GROUND["C"][0], GROUND["B"][1] + y - GROUND["C"][1]
        length = np.hypot(dx, dy)
        pull = -a.C0 * (length - a.L0) / length
        torque[order[0]], torque[spring] = a.TORQUE, pull * (x * dy - y * dx)
        return pin.constraintDynamics(model, data, q, v, torque, closed, closed_data, settings)

    timer = CallTimer()
    angles, calls = integrate(find, start, a.T_END, rtol, timer)
    angles = angles[order]
    return timer.measured(lambda: a.error(angles), calls)
