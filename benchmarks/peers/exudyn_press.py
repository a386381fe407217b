"""Integrate the press without clearance by Exudyn: eight bodies, ten joints, two driven cranks; generalized-α.

A step is the time between two samples, so that `SolveDynamic` computes only the requested samples. The cranks' speeds
are prescribed, in C++: a function of time called back in Python would be a handicap. Nothing is written during
the run; a sensor stores the slider in memory. Error as in `ideal`, but of y and v alone: with spectral radius 1, which
is second order and undamped, accelerations oscillate, and that is the method's, not the model's.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import ideal, press
from benchmarks.peers.timing import CallTimer, Measured
from tests.oracles import ideal_press, press_dense

# pairs of (body, end): −1 tail, +1 head; by number of the body, "" the ground's point
JOINTS = (
    ((0, 1), (1, -1)),
    ((3, 1), (2, -1)),
    ((1, 1), (5, -1)),
    ((2, 1), (5, -1)),
    ((5, 1), (4, 1)),
    ((5, 1), (6, -1)),
    ((6, 1), (7, 0)),
)


@cache
def build() -> tuple[Any, int]:
    """Return the system and the node of the slider; sensor 0 stores its coordinates, 1 its velocities.

    Raises ImportError without exudyn.
    """
    exu, item = import_module("exudyn"), import_module("exudyn.itemInterface")
    data = press.work("dry").press
    geometry, struct = data.geometry, press_dense._struct(data)
    y = press_dense.start(data)
    system = exu.SystemContainer().AddSystem()
    ground = system.AddObject(item.ObjectGround())
    nodes, bodies = [], []
    for k in range(8):
        place, rate = y[3 * k : 3 * k + 3], y[24 + 3 * k : 27 + 3 * k]
        nodes.append(system.AddNode(item.NodeRigidBody2D(referenceCoordinates=place, initialVelocities=rate)))
        bodies.append(
            system.AddObject(
                item.ObjectRigidBody2D(
                    physicsMass=struct.mass[k], physicsInertia=struct.inertia[k], nodeNumber=nodes[k]
                )
            )
        )

    def marker(body: int, local: list[float]) -> Any:
        """Return a marker at a point of a body."""
        return system.AddMarker(item.MarkerBodyPosition(bodyNumber=body, localPosition=[*local, 0.0]))

    def end(k: int, side: int) -> Any:
        """Return a marker at an end of a bar."""
        return marker(bodies[k], [0.5 * side * struct.length[k] if k != 7 else 0.0, 0.0])

    pins = [(end(*a), end(*b)) for a, b in JOINTS]
    pins += [
        (marker(ground, [0.0, 0.0]), end(0, -1)),
        (marker(ground, [0.0, -geometry.l5]), end(3, -1)),
        (marker(ground, [geometry.hx, geometry.hy]), end(4, -1)),
    ]
    for pair in pins:
        system.AddObject(item.ObjectJointRevolute2D(markerNumbers=list(pair)))
    _hold(system, item, nodes, geometry)
    keep = {"writeToFile": False, "storeInternal": True, "nodeNumber": nodes[7]}
    for kind in ("Coordinates", "Coordinates_t"):
        system.AddSensor(item.SensorNode(outputVariableType=getattr(exu.OutputVariableType, kind), **keep))
    system.Assemble()
    return system, nodes[7]


def _hold(system: Any, item: Any, nodes: list[int], geometry: ideal_press.PressData) -> None:
    """Prescribe the speeds of the cranks, and hold x and angle of the slider."""
    fixed = system.AddNode(item.NodePointGround())
    zero = system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=fixed, coordinate=0))
    for node, coordinate, speed in (
        (nodes[0], 2, geometry.omega1),
        (nodes[3], 2, geometry.omega4),
        (nodes[7], 0, None),
        (nodes[7], 2, None),
    ):
        own = system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
        rate = {} if speed is None else {"velocityLevel": True, "offset": speed}
        system.AddObject(item.ObjectConnectorCoordinate(markerNumbers=[zero, own], **rate))


def run(step: float) -> Measured:
    """Integrate with a step in s; times are those of a sample. Raises FloatingPointError."""
    exu = import_module("exudyn")
    system, _ = build()
    timer = CallTimer()
    count = round(ideal.T_END / step)
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime = count, ideal.T_END
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.newton.useModifiedNewton = True
    integration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = ideal.T_END / (ideal.SAMPLES - 1)
    with timer.engine:
        system.SolveDynamic(settings)
    start = press_dense.start(press.work("dry").press)
    y = np.asarray(system.GetSensorStoredData(0))[:, 2] + start[22]
    v = np.asarray(system.GetSensorStoredData(1))[:, 2]
    timer.stop()
    if len(y) != ideal.SAMPLES:
        raise FloatingPointError(f"Exudyn stored {len(y)} samples")
    return timer.measured(lambda: ideal.error(np.stack([y, v], axis=1))).per(ideal.SAMPLES)
