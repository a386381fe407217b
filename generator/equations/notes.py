"""Notes for the user about a scene's equations: effects that are left out, and errors for missing masses."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import MissingKeyError, combine_errors
from gudgeon.generator.equations.constraints import has_jumping_rate
from gudgeon.generator.equations.model import Model
from gudgeon.generator.mechanism import Body, Mechanism


def write_scene_notes(model: Model) -> tuple[str, ...]:
    """Return sentences for the user about a scene: what its equations leave out, and consequences of its choices.

    Topics are redundant equations, missing masses, more equations than coordinates, missing play or film, internal
    states, impacts, missing gravity and drives with jumps. Each sentence is there only if it applies.
    """
    notes = []
    if model.redundancy.dropped:
        notes.append(
            f"redundant constraint equations left out: {', '.join(model.redundancy.dropped)}; reactions not "
            "determined by"
            f" rigid bodies: {', '.join(model.redundancy.indeterminate)}"
        )
    if massless := [body.name for body in model.scene.mechanism.bodies.values() if body.missing_keys]:
        notes.append(
            f"no mass or no inertia of {', '.join(massless)}: forces, torques and energies that depend on it "
            "are left out"
        )
    if model.degrees_of_freedom < 0:
        notes.append(
            f"{-model.degrees_of_freedom} more constraint equations than coordinates: no body can move, and "
            "unless lengths and points"
            " fit exactly the mechanism cannot be assembled"
        )
    if not model.clearances:
        notes.append("no joint has play: no contact code, no film")
        if model.degrees_of_freedom == 0:
            notes.append("no degree of freedom: positions by Newton's method, without integration")
    elif not any(c.film for c in model.clearances):
        notes.append("no film: dry contact only")
    options = {c.joint.name: c.normal.options for c in model.clearances if c.wall and c.normal}
    for joint in (name for name, law_options in options.items() if law_options.get("geometry") == "internal"):
        notes.append(f"geometry: internal has no effect in {joint}: the wall is flat, K depends on the corner's radius")
    if states := [f"{c.name}.{state.name}" for c in model.clearances for state in c.states]:
        notes.append(
            f"internal states of laws, {', '.join(states)}: integrated with the motion, without reference solvers"
        )
    if model.rigid:
        notes.append(
            f"impacts by Newton's restitution in {', '.join(model.rigid)}: no derivatives, so no rodas5p and no "
            "reference solvers"
        )
    if all(component == 0 for component in model.gravity):
        notes.append("no gravity: no weight terms")
    jumps = find_drives_with_jumps(model)
    if jumps:
        notes.append(
            f"the rate of {', '.join(jumps)} may jump: a jump causes an impulse in the linkage; smooth_step has no jump"
        )
    return tuple(notes)


def has_drive_with_jumps(model: Model) -> bool:
    """Return whether the rate of any drive may jump, also in a scene without degrees of freedom."""
    return any(map(has_jumping_rate, model.scene.mechanism.drives.values()))


def find_drives_with_jumps(model: Model) -> tuple[str, ...]:
    """Return the names of the drives whose rate may jump; empty if the scene has no degree of freedom."""
    drives = model.scene.mechanism.drives.values() if model.degrees_of_freedom else ()
    return tuple(drive.name for drive in drives if has_jumping_rate(drive))


def check_masses(model: Model) -> None:
    """Raise MissingKeyError for all bodies without mass or inertia if the motion of the scene depends on masses.

    It does with play, degrees of freedom or friction that may stick.
    """
    reason = _explain_need_for_masses(model)
    if reason and (errors := list(find_missing_masses(model.scene.mechanism, f"scene {model.scene.name} {reason}"))):
        raise combine_errors(errors)


def _explain_need_for_masses(model: Model) -> str:
    """Return why a scene needs masses, the end of a message: play, degrees of freedom or friction that may stick.

    Return "" if it needs none, so that kinematics alone determines the motion.
    """
    if model.clearances:
        return f"has play in {', '.join(clearance.name for clearance in model.clearances)}"
    if (free := model.degrees_of_freedom) > 0:
        return f"has {free} degree{'' if free == 1 else 's'} of freedom"
    if model.frictions:
        return f"has friction that may stick, {', '.join(friction.name for friction in model.frictions)}"
    return ""


def find_missing_masses(mechanism: Mechanism, reason: str) -> Iterator[MissingKeyError]:
    """Yield one MissingKeyError for each combination of missing keys (mass, inertia), with all its bodies.

    `reason`: the end of the message, why masses are needed.
    """
    bodies_by_missing_keys: dict[tuple[str, ...], list[Body]] = {}
    for body in mechanism.bodies.values():
        if body.missing_keys:
            bodies_by_missing_keys.setdefault(tuple(body.missing_keys), []).append(body)
    for missing_keys, bodies in bodies_by_missing_keys.items():
        owner = bodies[0].name if len(bodies) == 1 else "each"
        hint = (
            f"expected {' and '.join(f'{key}:' for key in missing_keys)} of {owner}, or a shape: with a density;"
            " neither is needed if drives determine every motion and no joint has play"
        )
        names = ", ".join([bodies[0].name, *(f"{body.name} (line {body.where.line})" for body in bodies[1:])])
        subject = f"body {names} has" if len(bodies) == 1 else f"bodies {names} have"
        yield MissingKeyError(f"{subject} no {' and no '.join(missing_keys)}, and {reason}", bodies[0].where, hint)
