"""Blows between surfaces that do not give: rows of a run's impacts without a length, whose F_peak is an impulse."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

FEW, TOLD = 3, 3  # blows that pile up; times at which they do, that are told one by one


def is_blow(impacts: NDArray[Any]) -> NDArray[np.bool_]:
    """Which of the impacts took no time, (k,)."""
    found: NDArray[np.bool_] = impacts["t_off"] == impacts["t_on"]
    return found


def first_force(own: NDArray[Any]) -> float:
    """The largest force of a joint's first contact, N; NaN of a blow, which has none."""
    return math.nan if is_blow(own[:1])[0] else float(own["F_peak"][0])


def piled_up(joints: Sequence[str], impacts: NDArray[Any]) -> Iterator[str]:
    """Where bounces came ever faster until a contact was closed: Zeno's points, in words."""
    for k, name in enumerate(joints):
        own = impacts[impacts["joint"] == k]
        closings = [(n, float(own["t_on"][i])) for i in range(len(own)) if (n := _bounces_before(own, i)) >= FEW]
        for count, t in closings[:TOLD]:
            yield (
                f"{name}: {count} bounces piled up until t = {t:.9g} s, where the contact is closed: they part slower"
                " than the law's threshold there"
            )
        if len(closings) > TOLD:
            yield f"{name}: bounces piled up {len(closings)} times, the last until t = {closings[-1][1]:.9g} s"


def _bounces_before(own: NDArray[Any], i: int) -> int:
    """How many blows of a joint, each slower than the one before, end in its lasting contact i."""
    if bool(is_blow(own[i : i + 1])[0]):
        return 0
    count, slower = 0, 0.0
    for blow in own[:i][::-1]:
        ends_here = count > 0 or blow["t_on"] == own["t_on"][i]
        if not (ends_here and blow["t_off"] == blow["t_on"] and blow["deltadot"] > slower):
            break
        count, slower = count + 1, float(blow["deltadot"])
    return count
