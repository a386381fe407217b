"""Where a run left what the law of a film is good for: L/D, eccentricity, squeezing beside turning."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.kinds.laws.law import Law
    from gudgeon.results.results import Result

SQUEEZE = 0.5  # of the mean rate of both surfaces: faster squeezing is not slow beside turning


def beyond(run: Result) -> list[str]:
    """A sentence for each limit that a film of the run is beyond; none where no joint has a film."""
    return [note for joint in run.source.clearances if joint.film for note in _beyond(run, joint)]


def _beyond(run: Result, joint: ClearanceInfo) -> Iterator[str]:
    """Where a film's law says that it is good for less than it was asked; of a law that is not known nothing."""
    law = _film_law(run.source, joint)
    if law is None:
        return
    low, high = law.limits.l_over_d
    ratio = _l_over_d(run, joint)
    if not low <= ratio <= high:
        good = f"below {high:g}" if low == 0.0 else f"above {low:g}" if high == math.inf else f"{low:g} to {high:g}"
        yield f"{joint.name}: L/D is {ratio:.3g}: {law.name} is good for L/D {good}"
    between = joint.constants.get("mean_clearance", joint.clearance)  # of rough surfaces: their means
    c = float(run.p[joint.constants.get("film_clearance", between)])
    epsilon, most = run[f"{joint.name}.e"] / c, run.diagnostics.peak(joint.name).e_max / c
    deep = float((epsilon > law.limits.epsilon).mean())
    if most > law.limits.epsilon:
        where = f"at {100 * deep:.3g} % of the samples" if deep > 0.0 else "between samples"
        yield f"{joint.name}: {where} ε is over {law.limits.epsilon:g}, beyond {law.name}; it reaches {most:.4g}"
    share = _squeezed(run, joint) if law.limits.slow_squeeze else 0.0
    if share > 0.0:
        yield (
            f"{joint.name}: at {100 * share:.3g} % of the samples on the film |ε̇| is over half the surfaces' mean"
            f" rate: {law.name} holds for |ω| ≫ |ε̇|"
        )


def _film_law(source: KernelSource, joint: ClearanceInfo) -> Law | None:
    """The law that the C of a joint's film calls."""
    from gudgeon.generator.kinds.laws.law import called

    # without the "_": runs that were saved before names of a file ended in one
    body = re.search(rf" film_{re.escape(joint.name)}_?\(.*?\n}}", source.files.get("clearance.c", ""), re.DOTALL)
    call = body and re.search(r"^\s+(\w+)\(epsilon, w_n, w_t", body[0], re.MULTILINE)
    fitting = [law for law in called("film").values() if call and f"{call[1]}_".startswith(f"{law.name}_")]
    return max(fitting, key=lambda law: len(law.name), default=None)


def _l_over_d(run: Result, joint: ClearanceInfo) -> float:
    """Length over diameter of the journal."""
    bearing = run.source.slots[joint.constants["R_i"]].address.rpartition(".")[0]
    length = run.p[run.source.place[f"{bearing}.length"]]
    return float(length / (2.0 * run.p[joint.constants["R_j"]]))


def _squeezed(run: Result, joint: ClearanceInfo) -> float:
    """Share of the samples on the film at which its squeezing is not slow beside its turning."""
    sides = [run.source.bodies[body].name for body in (joint.first, joint.second) if body >= 0]
    turning = 0.5 * np.abs(sum(run[f"{name}.omega"] for name in sides))
    c = float(run.p[joint.clearance])
    on_film = run[f"{joint.name}.e"] < c
    fast = np.abs(run[f"{joint.name}.deltadot"]) / c > SQUEEZE * turning
    return float((fast & on_film).sum()) / max(int(on_film.sum()), 1)
