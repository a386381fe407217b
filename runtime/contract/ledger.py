"""How a scene's equations became what is integrated, in figures: the generator writes it, `gudgeon check -v` tells it.

A ledger: it begins with all coordinates and all rows of the closed linkage; each step takes some and may bring
others; what is left behind the last one is integrated. A step of elimination takes as many coordinates as rows, so
that the freedom stays; only play (freedom comes) and redundant rows (they never took any) change the difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

# The steps in their order, by kind; what `owners` are:
PLAY = "play"  # joints with play
REDUNDANT = "redundant"  # owners of rows that say nothing new
PRESCRIBED = "prescribed"  # drives that make angles functions of time
CONSTANT = "constant"  # joints that keep angles as they are
FOLLOWING = "following"  # bodies whose angles say those that go
HUB = "hub"  # joints of points where more than two bodies meet
HINGES = "hinges"  # joints of the tree whose points coincide
SLIDES = "slides"  # joints of the tree that carry a body along an axis
KNOWN = "known"  # slides and drives that say a slide
CHAIN = "chain"  # joints whose loops determine what drives move


@dataclass(frozen=True)
class Step:
    """Coordinates ("L1.x", "guide.slide") and rows ("A.x") that go and come; `owners` by kind, see above."""

    kind: str
    owners: tuple[str, ...]
    gone: tuple[str, ...] = ()
    come: tuple[str, ...] = ()
    rows_gone: tuple[str, ...] = ()
    rows_come: tuple[str, ...] = ()


@dataclass(frozen=True)
class Solve:
    """The linear system of a right-hand side, [M Φ_qᵀ; Φ_q 0], factored in an order that is chosen beforehand."""

    coordinates: int
    rows: int  # with one for each friction that may stick
    entries: int  # of the matrix that are not identically zero, both halves
    factor: int  # of L below its diagonal
    products: int  # of the elimination

    @property
    def size(self) -> int:
        """Rows of the matrix."""
        return self.coordinates + self.rows


@dataclass(frozen=True)
class Group:
    """Rows that are solved together, for as many coordinates (a linkage without freedom)."""

    rows: tuple[str, ...]
    coordinates: tuple[str, ...]


@dataclass(frozen=True)
class Placed:
    """A body of the tree with the one that places it; `joint` is empty where the body keeps its x and y."""

    body: str
    parent: str
    joint: str


@dataclass(frozen=True)
class Story:
    """`costs` are estimated operations of each tree that was looked at: the first breadth first, the least taken."""

    coordinates: tuple[str, ...] = ()  # at the beginning
    rows: tuple[str, ...] = ()
    jacobian: int = 0  # entries of the absolute Φ_q, joints with play open, that are not identically zero
    steps: tuple[Step, ...] = ()
    tree: tuple[Placed, ...] = ()
    costs: tuple[int, ...] = ()
    before: Solve | None = None  # in absolute coordinates
    after: Solve | None = None  # of what is integrated or followed
    groups: tuple[Group, ...] = ()  # in the order in which they are solved; without freedom only

    def ledger(self) -> Iterator[tuple[Step, int, int]]:
        """Each step with how many coordinates and rows it leaves."""
        n, m = len(self.coordinates), len(self.rows)
        for step in self.steps:
            n += len(step.come) - len(step.gone)
            m += len(step.rows_come) - len(step.rows_gone)
            yield step, n, m

    @staticmethod
    def from_data(data: Mapping[str, Any]) -> Story:
        """The story that `dataclasses.asdict` and JSON made lists of."""
        kinds = {"steps": Step, "tree": Placed, "groups": Group}
        solves = {"before": Solve, "after": Solve}
        found: dict[str, Any] = {}
        for name, value in data.items():
            if name in kinds:
                found[name] = tuple(_build(kinds[name], item) for item in value)
            elif name in solves:
                found[name] = value and Solve(**value)
            else:
                found[name] = tuple(value) if isinstance(value, list) else value
        return Story(**found)


def _build(kind: Any, item: Mapping[str, Any]) -> Any:
    """JSON knows lists only."""
    return kind(**{f.name: tuple(v) if isinstance(v := item[f.name], list) else v for f in fields(kind)})
