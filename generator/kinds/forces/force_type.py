"""Defines the interface of a force element: its keys, its forces and its potential energy.

Each other file of this folder is one kind and exports `ELEMENT`.

As with joints and laws, nothing here imports SymPy at the top. `build(target_frames, element_fields)` gets one
PointFrame for each target and the element's numbers, and returns a `Loads`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from gudgeon.generator.field import Field
from gudgeon.generator.kinds import iterate_declarations
from gudgeon.language.units import Dimension


@dataclass(frozen=True)
class Load:
    """Represent the force (N, ground axes) and moment (N·m, about the point) on the body of one target."""

    target: int
    x: Any
    y: Any
    moment: Any


@dataclass(frozen=True)
class Slip:
    """Represent a slip velocity that friction may hold at zero: v (m/s), speed of the surface, limits in N.

    `stribeck_velocity` (m/s): slip in which friction falls from static to kinetic (Stribeck, Gaussian); 0: at once.
    """

    v: Any
    speed: Any
    static: Any
    kinetic: Any
    stribeck_velocity: Any = 0

    def evaluate_kinetic_force(self, v: Any) -> Any:
        """Return the magnitude (N) of the friction force at a slip v (m/s) of either sign, as an expression.

        It falls from static to kinetic friction with the slip: F_k = F_c + (F_s − F_c) exp(−(v/v_s)²), with the fields
        `kinetic`, `static` and `stribeck_velocity`. If `stribeck_velocity` is 0, it is F_c at every slip.
        """
        import sympy as sp

        if self.stribeck_velocity == 0:
            return self.kinetic
        return self.kinetic + (self.static - self.kinetic) * sp.exp(-((v / self.stribeck_velocity) ** 2))


@dataclass(frozen=True)
class Loads:
    """Contain the effect of an element: its loads, its potential energy, and the power of its other forces.

    `series` are results by name ("F", "length") with their units.
    """

    loads: tuple[Load, ...]
    potential: Any
    power: Any
    series: Mapping[str, tuple[Any, str]]
    slip: Slip | None = None


@dataclass(frozen=True)
class ElementType:
    """Declare a kind of force element: the YAML key `kind: target` or `kind: [target, target]`."""

    kind: str
    title: str
    targets: str  # "points" or "bodies"; the ground is one of either
    counts: tuple[int, ...]  # allowed numbers of targets
    fields: tuple[Field, ...]  # its keys in addition to `kind`
    results: tuple[tuple[str, Dimension], ...]  # names of `Loads.series`, for outputs
    build: Callable[..., Loads]
    doc: str | None  # text for documents: a line, then its sketch and its equation
    foreign_names: tuple[str, ...] = ()  # names in other programs, for hints


@cache
def find_element_types() -> Mapping[str, ElementType]:
    """Return all kinds of force elements by name."""
    return {e.kind: e for e in iterate_declarations("gudgeon.generator.kinds.forces", "ELEMENT", ElementType)}
