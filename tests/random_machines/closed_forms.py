"""What is known of a run without any simulation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gudgeon.results.results import Result
from tests.random_machines.design import Design


def check(design: Design, run: Result, wrong: type[AssertionError]) -> None:
    """Raise `wrong` where the run contradicts a closed form of its design, or its own constraints."""
    values = design.numbers.plain()

    def number(*path: Any) -> float:
        found: Any = design.file
        for key in path:
            found = found[key]
        return values[found]

    phi = float(run.diagnostics.phi_max)
    if phi > 1e-6 * design.size:
        raise wrong(f"max |Φ| is {phi:.3g} m")
    if "change point" in design.tags:
        off = np.max(abs(run["rocker.theta"] - run["crank.theta"]))
        if off > 1e-9:
            raise wrong(f"the rocker is {off:.3g} rad off the crank")
    if "hill" in design.tags and not len(run.events):
        raise wrong("the particle leaves the hill without an event")
    if "stick" in design.tags and "shake" not in design.file["forces"]:
        speed, rub = number("start", "rates", "block.vx"), number("forces", "rub", "kinetic")
        stops = speed * number("bodies", "block", "mass") / rub
        found = [round(float(t), 9) for t in run.events["t"]]
        if stops < design.t_end and found != [round(stops, 9)] * 2:
            raise wrong(f"the block stops once at {stops:.9g} s, events are {found[:5]} ({len(found)})")
    if "pulse" in design.tags:
        value = design.file["forces"]["pulse"]["value"][0]
        top, width, at = (
            values[name]
            for name in (value.split("/")[0], value.split("/")[1].split("*")[0], value.split("- ")[1].split(")")[0])
        )
        gained = 0.5 * top * (math.erf((design.t_end - at) / width) + math.erf(at / width))
        expected = number("start", "rates", "block.vx") + gained / number("bodies", "block", "mass")
        if abs(run["block.vx"][-1] - expected) > 1e-6:
            raise wrong(f"block.vx ends at {run['block.vx'][-1]!r}, by its impulse at {expected!r}")
