"""What has no mass or no inertia is fine as long as nothing but rows determines the motion."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import MissingKeyError, together
from gudgeon.generator.equations.model import Model
from gudgeon.generator.mechanism.mechanism import Body, Mechanism


def refuse_massless(model: Model) -> None:
    """Raise a MissingKeyError for bodies without mass or inertia, where the motion depends on them."""
    asks = _asks(model)
    if asks and (errors := list(lacking(model.scene.mechanism, f"scene {model.scene.name} {asks}"))):
        raise together(errors)


def _asks(model: Model) -> str:
    """Why a scene needs masses; "" where it does not."""
    if model.clearances:
        return f"has play in {', '.join(clearance.name for clearance in model.clearances)}"
    if (free := model.degrees_of_freedom) > 0:
        return f"has {free} degree{'' if free == 1 else 's'} of freedom"
    if model.frictions:
        return f"has friction that may stick, {', '.join(friction.name for friction in model.frictions)}"
    return ""


def lacking(mechanism: Mechanism, asks: str) -> Iterator[MissingKeyError]:
    """An error for the bodies that lack mass, inertia or both, at the first one; `asks` says who needs them."""
    alike: dict[tuple[str, ...], list[Body]] = {}
    for body in mechanism.bodies.values():
        if body.lacks:
            alike.setdefault(tuple(body.lacks), []).append(body)
    for lacks, bodies in alike.items():
        whose = bodies[0].name if len(bodies) == 1 else "each"
        hint = (
            f"expected {' and '.join(f'{key}:' for key in lacks)} of {whose}, or a shape: with a density;"
            " only where drives determine every motion, without play, none is needed"
        )
        names = ", ".join([bodies[0].name, *(f"{body.name} (line {body.where.line})" for body in bodies[1:])])
        who = f"body {names} has" if len(bodies) == 1 else f"bodies {names} have"
        yield MissingKeyError(f"{who} no {' and no '.join(lacks)}, and {asks}", bodies[0].where, hint)
