"""What a scene's equations mean for its user, in sentences."""

from __future__ import annotations

from gudgeon.generator.equations.constraints import rate_jumps
from gudgeon.generator.equations.model import Model


def scene_notes(model: Model) -> tuple[str, ...]:
    """What this scene does not have, and so does not pay for."""
    notes = []
    if model.redundancy.dropped:
        notes.append(
            f"redundant rows left out: {', '.join(model.redundancy.dropped)}; reactions not determined by"
            f" rigid bodies: {', '.join(model.redundancy.indeterminate)}"
        )
    if lacking := [body.name for body in model.scene.mechanism.bodies.values() if body.lacks]:
        notes.append(
            f"no mass or no inertia of {', '.join(lacking)}: no forces, torques and energies that follow from it"
        )
    if model.degrees_of_freedom < 0:
        notes.append(
            f"{-model.degrees_of_freedom} more rows than coordinates: nothing can move, and unless lengths and points"
            " fit exactly it cannot be assembled"
        )
    if not model.clearances:
        notes.append("no joint has play: no contact code, no film")
        if model.degrees_of_freedom == 0:
            notes.append("no degree of freedom: positions by Newton, nothing is integrated")
    elif not any(c.film for c in model.clearances):
        notes.append("no film: dry contact only")
    options = {c.joint.name: c.normal.options for c in model.clearances if c.wall and c.normal}
    for joint in (name for name, own in options.items() if own.get("geometry") == "internal"):
        notes.append(f"geometry: internal says nothing in {joint}: its wall is flat, K is by the corner's radius")
    if states := [f"{c.name}.{state.name}" for c in model.clearances for state in c.states]:
        notes.append(f"inner states of laws, {', '.join(states)}: integrated with the motion, which peers do not do")
    if model.rigid:
        notes.append(f"impacts by Newton's restitution in {', '.join(model.rigid)}: no slopes, so no rodas5p, no peers")
    if all(component == 0 for component in model.gravity):
        notes.append("no gravity: no weight terms")
    jumps = jumping_drives(model)
    if jumps:
        notes.append(
            f"the rate of {', '.join(jumps)} may jump: the linkage follows by an impulse; smooth_step has no jump"
        )
    return tuple(notes)


def has_jumps(model: Model) -> bool:
    """Whether any drive's rate may jump, whatever is free to move."""
    return any(map(rate_jumps, model.scene.mechanism.drives.values()))


def jumping_drives(model: Model) -> tuple[str, ...]:
    """Drives whose rate may jump before something that is free to move."""
    drives = model.scene.mechanism.drives.values() if model.degrees_of_freedom else ()
    return tuple(drive.name for drive in drives if rate_jumps(drive))
