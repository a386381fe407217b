"""List the checks of a run's audit, in the order of engine/boundary.h, with the values that each check compares."""

from __future__ import annotations

from dataclasses import dataclass

from gudgeon.contract.boundary import AUDIT_CHECK_NAMES, AUDIT_FULL, AUDIT_OFF, AUDIT_ON

LEVELS = {False: AUDIT_OFF, True: AUDIT_ON, "full": AUDIT_FULL}  # levels in C by the argument `audit`


@dataclass(frozen=True)
class Check:
    """Describe a check. `compares` completes "the check of …"; `place` is what its index counts, "" for nothing."""

    name: str
    compares: str
    place: str = ""


_STEP_CHECKS = {  # in C, at steps
    "defect": ("the dense output against the equations of motion between the ends of a step",),
    "gap": ("penetrations of joints, which closed contacts alone have", "joint"),
    "free": ("joint forces, which are zero without a contact and never pull rigid surfaces", "joint"),
    "position": ("all constraint equations Φ = 0 of all bodies", "row"),
    "velocity": ("all velocity constraints Φ_q v = ν of all bodies", "row"),
    "acceleration": ("accelerations against the equations of motion of all bodies", "coordinate"),
    "branch": ("branches of switching functions against their signs", "switch"),
    "event": ("recorded events against the signs of their expressions", "event"),
    "force": ("forces of films against the accelerations of the dense output", "joint"),
    "rate": ("rates of the dense output against velocities and accelerations, whatever the step's length",),
    "step": ("the errors of steps by the integral of the defect of the dense output",),
    "mode": ("slips and forces of friction elements against their modes", "friction"),
}
CHECKS = tuple(Check(name, *_STEP_CHECKS[name]) for name in AUDIT_CHECK_NAMES)
SAMPLE_CHECKS = (  # in Python, at samples and at the end (runtime/simulation/audit.py)
    Check("start", "the first sample against the start that was found"),
    Check("energy", "the energy of the motion against the works of drives, forces and joints with play"),
    Check("power", "reported accelerations, torques and forces against the change of energy"),
    Check(
        "body", "reported accelerations and forces of joints against the equations of motion of single bodies", "body"
    ),
    Check("torque", "reported drive torques against the power of the drives"),
    Check("sample", "sampled forces of open joints, which are zero", "joint"),
    Check("peak", "the peak of a joint's force against the largest force of its contacts", "joint"),
    Check("rows", "all constraint equations Φ = 0 of all bodies at samples"),
    Check("rates", "all velocity constraints Φ_q v = ν of all bodies at samples"),
    Check("finite", "reported accelerations, reactions, torques and forces, which are finite"),
)


@dataclass(frozen=True)
class Finding:
    """Hold the largest value of a check in a run."""

    check: str
    worst: float  # relative to its limit
    t: float  # s
    place: str  # name of the joint, constraint row, coordinate or event; "": the whole linkage
