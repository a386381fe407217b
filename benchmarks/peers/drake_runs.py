"""Integrate pendulums of several links by Drake: a continuous MultibodyPlant and its error-controlled runge_kutta5.

The control is the accuracy of the integrator. A whole call sets the state in the context, initializes the simulator,
advances it and reads the angles. Joints turn about -y, and plane coordinates (x, y) are Drake's (x, 0, z).

Drake cannot close a loop in a continuous plant: its constraints exist in plants with discrete steps only, with contact
solvers of order 1. Andrews' squeezer therefore has no entry.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import chain_equations as chain
from benchmarks.peers.timing import CallTimer, Measured

NAME = "pydrake"
SCHEME = "runge_kutta5"
MAX_STEP = 0.1  # s


@cache
def simulator_of(n: int, accuracy: float) -> tuple[Any, Any, Any]:
    """Return simulator, plant and its context for a pendulum of n links."""
    drake = import_module("pydrake.all")
    plant = drake.MultibodyPlant(0.0)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -chain.G])
    frame = plant.world_frame()
    inertia = drake.SpatialInertia.MakeFromCentralInertia(
        chain.M, [0.5 * chain.L, 0.0, 0.0], drake.RotationalInertia(*[chain.J] * 3)
    )
    for k in range(n):
        body = plant.AddRigidBody(f"L{k}", inertia)
        plant.AddJoint(drake.RevoluteJoint(f"J{k}", frame, body.body_frame(), [0.0, -1.0, 0.0], 0.0))
        frame = plant.AddFrame(
            drake.FixedOffsetFrame(f"E{k}", body.body_frame(), drake.RigidTransform([chain.L, 0.0, 0.0]))
        )
    plant.Finalize()
    simulator = drake.Simulator(plant)
    integrator = drake.ResetIntegratorFromFlags(simulator, SCHEME, MAX_STEP)
    integrator.set_target_accuracy(accuracy)
    integrator.set_fixed_step_mode(False)
    return simulator, plant, simulator.get_mutable_context()


def run_chain(n: int, accuracy: float) -> Measured:
    """Integrate a pendulum of n links."""
    simulator, plant, context = simulator_of(n, accuracy)
    state = np.concatenate([np.diff(chain.starts(n)[:n, 0], prepend=0.0), np.zeros(n)])
    timer = CallTimer()
    context.SetTime(0.0)
    plant.SetPositionsAndVelocities(context, state)
    simulator.Initialize()
    with timer.engine:
        simulator.AdvanceTo(chain.T_END[n])
    angles = np.cumsum(plant.GetPositions(context))
    return timer.measured(lambda: chain.error(n, angles))
