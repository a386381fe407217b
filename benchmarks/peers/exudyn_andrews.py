"""Integrate Andrews' squeezer by Exudyn: seven bodies, ten revolute joints, a spring, a torque; generalized-α.

The control is the step (s). The time is that of `SolveDynamic` alone, without output.
Angles β … ε are differences of the bodies' rotations, as in the test set.
"""

from __future__ import annotations

import math
from functools import cache
from importlib import import_module
from typing import Any

from benchmarks.peers import andrews as a
from benchmarks.peers.timing import CallTimer, Measured

# mass, inertia about the centre of mass, points in the body's frame (origin at the centre of mass)
BODIES: dict[str, tuple[float, float, dict[str, tuple[float, float]]]] = {
    "OF": (a.M1, a.I1, {"O": (-a.RA, 0.0), "F": (a.RR - a.RA, 0.0)}),
    "FE": (a.M2, a.I2, {"E": (a.DA - a.D, 0.0), "F": (a.DA, 0.0)}),
    "BDE": (a.M3, a.I3, {"B": (-a.SB, a.SA), "E": (-a.SB, a.SA - a.SS), "D": (a.SD - a.SB, a.SA - a.SC)}),
    "EG": (a.M4, a.I4, {"G": (0.0, a.E - a.EA), "E": (0.0, -a.EA)}),
    "AG": (a.M5, a.I5, {"A": (-a.TA, a.TB), "G": (a.ZT - a.TA, a.TB)}),
    "HE": (a.M6, a.I6, {"H": (a.FA - a.ZF, 0.0), "E": (a.FA, 0.0)}),
    "AH": (a.M7, a.I7, {"A": (a.UB, a.UA), "H": (a.UB, a.UA - a.U)}),
}
GROUND = {"O": (0.0, 0.0), "A": (a.XA, a.YA), "B": (a.XB, a.YB), "C": (a.XC, a.YC)}
# joints in an order that determines all positions: (body, its point, other body or ground, point there)
JOINTS = (
    ("OF", "O", "", "O"),
    ("FE", "F", "OF", "F"),
    ("BDE", "B", "", "B"),
    ("AG", "A", "", "A"),
    ("AH", "A", "", "A"),
    ("EG", "G", "AG", "G"),
    ("HE", "H", "AH", "H"),
    ("BDE", "E", "FE", "E"),
    ("EG", "E", "FE", "E"),
    ("HE", "E", "FE", "E"),
)
ANGLES = (
    "OF",
    "FE",
    "BDE",
    "EG",
    "AG",
    "HE",
    "AH",
)  # bodies in the order of the test set's angles, those of JOINTS[:7]


def placements() -> dict[str, tuple[float, float, float]]:
    """Return x, y, θ of every body at the start, along JOINTS."""
    be, th, ga, ph, de, om, ep = a.START
    angle = {"OF": be, "FE": be + th, "BDE": ga, "EG": ph + de, "AG": de, "HE": om + ep, "AH": ep}
    placed: dict[str, tuple[float, float, float]] = {}

    def point(body: str, name: str) -> tuple[float, float]:
        """Return the position of a point."""
        if not body:
            return GROUND[name]
        x, y, t = placed[body]
        px, py = BODIES[body][2][name]
        return x + px * math.cos(t) - py * math.sin(t), y + px * math.sin(t) + py * math.cos(t)

    for body, own, other, there in JOINTS[:7]:
        placed[body] = (0.0, 0.0, angle[body])
        (x, y), (px, py) = point(other, there), point(body, own)
        placed[body] = (x - px, y - py, angle[body])
    return placed


@cache
def build() -> tuple[Any, Any, dict[str, Any]]:
    """Return container, system and node number of each body. Raises ImportError without exudyn."""
    exu, item = import_module("exudyn"), import_module("exudyn.itemInterface")
    container = exu.SystemContainer()
    system = container.AddSystem()
    ground = system.AddObject(item.ObjectGround())
    node, body = {}, {"": ground}
    for name, (x, y, angle) in placements().items():
        mass, inertia, _ = BODIES[name]
        node[name] = system.AddNode(
            item.NodeRigidBody2D(referenceCoordinates=[x, y, angle], initialVelocities=[0.0, 0.0, 0.0])
        )
        body[name] = system.AddObject(
            item.ObjectRigidBody2D(physicsMass=mass, physicsInertia=inertia, nodeNumber=node[name])
        )

    def marker(name: str, point: str) -> Any:
        """Return a marker at a point of a body."""
        x, y = BODIES[name][2][point] if name else GROUND[point]
        return system.AddMarker(item.MarkerBodyPosition(bodyNumber=body[name], localPosition=[x, y, 0.0]))

    for name, own, other, there in JOINTS:
        system.AddObject(item.ObjectJointRevolute2D(markerNumbers=[marker(other, there), marker(name, own)]))
    system.AddObject(
        item.ObjectConnectorSpringDamper(
            markerNumbers=[marker("", "C"), marker("BDE", "D")], stiffness=a.C0, referenceLength=a.L0
        )
    )
    crank = system.AddMarker(item.MarkerBodyRigid(bodyNumber=body["OF"], localPosition=[0.0, 0.0, 0.0]))
    system.AddLoad(item.LoadTorqueVector(markerNumber=crank, loadVector=[0.0, 0.0, a.TORQUE]))
    system.Assemble()
    return container, system, node


def run(step: float) -> Measured:
    """Integrate with a step in s; the integration is SolveDynamic, the whole call also sets its options."""
    exu = import_module("exudyn")
    _, system, node = build()
    timer = CallTimer()
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime = round(a.T_END / step), a.T_END
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-10, 1e-12
    integration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.linearSolverType = exu.LinearSolverType.EigenSparse
    with timer.engine:
        system.SolveDynamic(settings)
    angle = {k: float(system.GetNodeOutput(n, exu.OutputVariableType.Coordinates)[2]) for k, n in node.items()}
    timer.stop()
    start = {k: p[2] for k, p in placements().items()}
    now = {k: start[k] + angle[k] for k in angle}
    y = [
        now["OF"],
        now["FE"] - now["OF"],
        now["BDE"],
        now["EG"] - now["AG"],
        now["AG"],
        now["HE"] - now["AH"],
        now["AH"],
    ]
    return timer.measured(lambda: a.error(y))
