"""What has no mass or no inertia is fine as long as nothing but rows determines the motion."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import InputErrors, MissingKeyError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.mechanism.mechanism import Mechanism


def refuse_massless(model: Model) -> None:
    """Raise a MissingKeyError for each body without mass or inertia, where the motion depends on them."""
    if asks := _asks(model):
        errors = list(lacking(model.scene.mechanism, f"scene {model.scene.name} {asks}"))
        if len(errors) == 1:
            raise errors[0]
        if errors:
            raise InputErrors(errors)


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
    """An error for each body that lacks mass or inertia, at its place; `asks` says who needs them."""
    for body in mechanism.bodies.values():
        if body.lacks:
            hint = (
                f"expected {' and '.join(f'{key}:' for key in body.lacks)} of {body.name}, or a shape: with a density;"
                " only where drives determine every motion, without play, none is needed"
            )
            yield MissingKeyError(
                f"body {body.name} has no {' and no '.join(body.lacks)}, and {asks}", body.where, hint
            )
