"""Record how the equations of motion were reduced before integration; `gudgeon check -v` shows the record.

The record begins with all coordinates and constraint equations, joints without play. Each step removes some and may
add others; what remains is integrated. A step of elimination removes as many coordinates as equations, so that the
degrees of freedom stay. Only play and redundant equations change the difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

# Kinds of steps in their order, and the meaning of their `owners`:
PLAY = "play"  # joints with play
REDUNDANT = "redundant"  # owners of redundant equations
PRESCRIBED = "prescribed"  # drives that make angles functions of time
CONSTANT = "constant"  # joints that keep angles constant
DEPENDENT = "following"  # bodies whose angles determine the removed ones
HUB = "hub"  # joints of points where more than two bodies meet
HINGES = "hinges"  # joints of the tree whose points coincide
SLIDES = "slides"  # joints of the tree that carry a body along an axis
KNOWN = "known"  # slides and drives that determine a slide
CHAIN = "chain"  # joints whose loops determine driven coordinates


@dataclass(frozen=True)
class ReductionStep:
    """Describe a reduction step: coordinates ("L1.x", "guide.slide") and equations ("A.x") that are removed and
    added.
    """

    kind: str
    owners: tuple[str, ...]
    gone: tuple[str, ...] = ()  # removed coordinates
    come: tuple[str, ...] = ()  # added coordinates
    rows_gone: tuple[str, ...] = ()  # removed constraint equations
    rows_come: tuple[str, ...] = ()  # added constraint equations


@dataclass(frozen=True)
class Solve:
    """Describe the linear system of a right-hand side, [M Φ_qᵀ; Φ_q 0], factored in a fixed order."""

    coordinates: int
    rows: int  # constraint equations, and one for each friction element that may stick
    entries: int  # nonzeros of the matrix, both halves
    factor: int  # nonzeros of L below its diagonal
    products: int  # multiplications of the elimination

    @property
    def size(self) -> int:
        """Return the number of rows of the matrix."""
        return self.coordinates + self.rows


@dataclass(frozen=True)
class Group:
    """Describe equations that are solved together for as many coordinates (kinematic linkages)."""

    rows: tuple[str, ...]
    coordinates: tuple[str, ...]


@dataclass(frozen=True)
class TreeBody:
    """Describe a body of the spanning tree and its parent; `joint` is empty if the body has its own x and y."""

    body: str
    parent: str
    joint: str


@dataclass(frozen=True)
class ReductionLog:
    """Record the reduction. `costs`: estimated operations of each tree; the first is breadth-first, the cheapest is
    used.
    """

    coordinates: tuple[str, ...] = ()  # at the beginning
    rows: tuple[str, ...] = ()
    jacobian: int = 0  # nonzeros of the absolute Φ_q, without joints with play
    steps: tuple[ReductionStep, ...] = ()
    tree: tuple[TreeBody, ...] = ()
    costs: tuple[int, ...] = ()
    before: Solve | None = None  # linear system in absolute coordinates
    after: Solve | None = None  # linear system of the reduced equations
    groups: tuple[Group, ...] = ()  # in the order in which they are solved; kinematic linkages only

    def iterate_steps(self) -> Iterator[tuple[ReductionStep, int, int]]:
        """Yield each reduction step with the numbers of coordinates and constraint equations that remain after it."""
        n, m = len(self.coordinates), len(self.rows)
        for step in self.steps:
            n += len(step.come) - len(step.gone)
            m += len(step.rows_come) - len(step.rows_gone)
            yield step, n, m

    @staticmethod
    def from_data(data: Mapping[str, Any]) -> ReductionLog:
        """Build the log from the dictionaries and lists of its JSON form.

        Steps, bodies of the tree, groups and linear systems become their dataclasses, other lists become tuples.
        """
        classes_of_lists = {"steps": ReductionStep, "tree": TreeBody, "groups": Group}
        classes_of_systems = {"before": Solve, "after": Solve}
        fields: dict[str, Any] = {}
        for name, value in data.items():
            if name in classes_of_lists:
                fields[name] = tuple(_build_record(classes_of_lists[name], item) for item in value)
            elif name in classes_of_systems:
                fields[name] = value and Solve(**value)
            else:
                fields[name] = tuple(value) if isinstance(value, list) else value
        return ReductionLog(**fields)


def _build_record(kind: Any, item: Mapping[str, Any]) -> Any:
    """Return an object of the dataclass `kind` from a mapping of JSON data, with lists as tuples."""
    return kind(**{f.name: tuple(v) if isinstance(v := item[f.name], list) else v for f in fields(kind)})
