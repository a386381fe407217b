"""What a claim is about: places along the dimensions of a part, and how many of them are looked at."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gudgeon.errors import BadValueError
from gudgeon.studies.ensemble.judge import Cell, Check
from gudgeon.studies.ensemble.plan import Plan

if TYPE_CHECKING:
    from gudgeon.generator.yaml import Text

MOST_COMPARED = 100_000  # cells of runs, or pairs of them, that one claim compares: each is judged alone
FEWER = f"expected {MOST_COMPARED} at most: select some with at:, or vary less"


def few(checks: Iterable[Check], name: Text) -> tuple[Check, ...]:
    """All checks of a claim, or BadValueError at its name where there are too many."""
    found = tuple(itertools.islice(checks, MOST_COMPARED + 1))
    if len(found) > MOST_COMPARED:
        raise BadValueError(f"{name} compares more than {MOST_COMPARED} pairs of runs", name.where, FEWER)
    return found


@dataclass(frozen=True, eq=False)
class Selected:
    """Which places along each dimension of a part a selection leaves, starts left out."""

    part: str
    plan: Plan
    places: Mapping[str, tuple[int, ...]]
    where: Text

    def cells(self, fixed: Mapping[str, int]) -> Iterator[tuple[tuple[Any, ...], Cell]]:
        """All of them, with the values of their dimensions that are not fixed. BadValueError for too many."""
        if (count := math.prod(len(own) for own in self.places.values())) > MOST_COMPARED:
            raise BadValueError(f"the claim is about {count} values of coordinates", self.where.where, FEWER)
        for index in itertools.product(*([fixed[name]] if name in fixed else own for name, own in self.places.items())):
            free = [(name, k) for name, k in zip(self.places, index, strict=True) if self._is_free(name, fixed)]
            yield tuple((name, self._value(name, k)) for name, k in free), Cell(self.part, index)

    def _is_free(self, name: str, fixed: Mapping[str, int]) -> bool:
        return name not in fixed and len(self.places[name]) > 1

    def _value(self, name: str, k: int) -> Any:
        found = next((one for one in self.plan.coordinates if one.name == name and one.over == (name,)), None)
        return k if found is None else found.values[k].item() if hasattr(found.values[k], "item") else found.values[k]
