"""Wear between the runs of a study: rounds of wear_loop.py before the runs that are measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError, InputError, UnknownNameError
from gudgeon.results.batch import Array
from gudgeon.simulation.simulation import Simulation
from gudgeon.simulation.wear import rate_of
from gudgeon.simulation.wear_loop import Loop, Wearing, share
from gudgeon.studies.ensemble.numbers import real

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import WearRounds
    from gudgeon.integrators.trajectory import Progress


def wearing_of(wear: WearRounds, sources: Sequence[KernelSource]) -> Wearing:
    """An InputError at its place for numbers, and for a joint that has a contour in no scene."""
    able = {one.joint for source in sources for one in source.contours}
    for joint in wear.joints:
        if joint not in able:
            hint = f"joints with one: {', '.join(sorted(able))}" if able else "contour: 128 in the play of a scene"
            raise UnknownNameError(f"wear.joints: no scene has a contour at {joint}", joint.where, hint)
    try:
        rate = rate_of(wear.k, wear.hardness, "wear.k", "wear.hardness")
    except InputError as error:
        raise type(error)(error.message, wear.k.where, error.hint) from None
    scale = 1.0 if wear.scale is None else real(wear.scale, Slot("wear.scale", "", 1.0, False, (0, 0, 0)))
    if wear.scale is not None and not scale > 0.0:
        raise BadValueError(f"wear.scale is {scale:g}", wear.scale.where, "expected a positive number of runs")
    return Wearing(tuple(map(str, wear.joints)), rate, wear.law, scale)


def worn(
    simulation: Simulation, wearing: Wearing | None, rounds: int, parameters: Any, ends: Array, common: dict[str, Any],
    progress: Progress | None,
) -> tuple[dict[str, Array], Progress | None]:  # fmt: skip
    """The contours that the rounds of wear leave of the runs, by joint; none where the scene has none that wears.

    And what is left of the progress for the runs themselves: each round has as much of it.
    """
    able = {one.joint for one in simulation.source.contours}
    if wearing is None or not able.intersection(wearing.joints):
        return {}, progress
    loop = Loop(simulation, replace(wearing, joints=tuple(joint for joint in wearing.joints if joint in able)), {})
    for k in range(rounds):
        loop.round(parameters, ends, progress=share(progress, k, rounds + 1), **common)
    return loop.given, share(progress, rounds, rounds + 1)
