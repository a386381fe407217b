"""Returns of a motion to a section: states at an event of the file, or once a period, gathered run by run.

A point has lengths over the mechanism's size, cosine and sine of angles, velocities over their largest rms and, of
joints with play, e/c: what happens within a clearance is far too small for the size to show.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.linkage import angles
from gudgeon.errors import BadValueError, InputError
from gudgeon.model.compiled import Array
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.results.lyapunov import Section
from gudgeon.simulation.arguments import end_of, seconds

if TYPE_CHECKING:
    from gudgeon.results.results import Result
    from gudgeon.results.samples import AtEvents

ON_TIME = 1e-6  # of a period


@dataclass(eq=False)
class Returns:
    """Of `event`, or of `period` (s, 0: none), counted from `begin` (s)."""

    event: str
    period: float
    begin: float
    size: float
    speed: float  # m/s, and 1/s of angles times the size
    extent: float
    t: list[float] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)

    @staticmethod
    def of(run: Result, section: str | float | None) -> Returns:
        """Of a run that shows the whole motion. Raises InputError for a section that is none."""
        event, period = _wanted(run, section)
        size = float(mechanism_sizes(run.source, run.p))
        per = np.where(angles(run.source), 1.0, size)
        speed = float(np.sqrt(np.mean(np.square(run.v / per), axis=0)).max(initial=0.0)) * size
        found = Returns(event, period, float(run.t[0]), size, speed or size, 0.0)
        whole = found._of(run)
        found.extent = float(np.sqrt(np.mean(np.sum(np.square(whole - whole.mean(axis=0)), axis=1))))
        return found

    def note(self, run: Result) -> None:
        """The returns of a part of the run."""
        if self.event:
            at = run.at_events(self.event)
            self.t += at.t.tolist()
            self.points += list(self._of(at)) if len(at) else []
        elif self.period:
            turns = (float(run.t[-1]) - self.begin) / self.period
            if round(turns) > 0 and abs(turns - round(turns)) < ON_TIME:
                self.t.append(float(run.t[-1]))
                self.points.append(self._of(run)[-1])

    def section(self) -> Section | None:
        """What was gathered; None where no section was asked for."""
        if not (self.event or self.period):
            return None
        points = np.array(self.points) if self.points else np.zeros((0, 1))
        return Section(self.event or f"every {self.period:.6g} s", np.array(self.t), points, self.extent)

    def _of(self, run: Result | AtEvents) -> Array:
        """(k, d) points of all samples, or of all events."""
        source = run.source if not hasattr(run, "all") else run.all.source
        p = run.p if not hasattr(run, "all") else run.all.p
        angle = angles(source)
        per = np.where(angle, 1.0, self.size)
        parts = [run.q[:, ~angle] / self.size, np.cos(run.q[:, angle]), np.sin(run.q[:, angle]),
                 run.v / per * (self.size / self.speed)]  # fmt: skip
        parts += [(run[f"{joint.name}.{axis}"] / p[joint.clearance])[:, None]
                  for joint in source.clearances for axis in ("ex", "ey")]  # fmt: skip
        return np.concatenate(parts, axis=1)


def _wanted(run: Result, section: str | float | None) -> tuple[str, float]:
    """The event, or the period (s); "" and 0.0 for none."""
    if section is None:
        return "", 0.0
    events = [event.name for event in run.source.events]
    if isinstance(section, str) and section in events:
        return section, 0.0
    try:
        found = end_of(run.source, section, run.p)
        period = seconds("section", 0.0 if found is None else found)
    except InputError as error:
        if isinstance(section, str) and section.isidentifier():
            run.events_of(section)  # UnknownNameError names the nearest
        raise error
    if not (math.isfinite(period) and 0.0 < period < run.t[-1] - run.t[0]):
        told = f"section is {period:g} s: expected an event of the file, or a period within the run"
        raise BadValueError(told, hint=f"its events: {', '.join(events) or 'none'}; a period as '2*pi/omega'")
    return "", period
