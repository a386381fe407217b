"""The assemblies of a linkage: closed configurations that no motion joins, each with the guess that picks it.

Newton's steps from many random angles end on one of them or nowhere; those that differ are kept, until nothing new has
come for a while. What can move is held as the start has it, else there would be as many as one likes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.followed import APART
from gudgeon.assembly.linkage import Linkage
from gudgeon.model.compiled import Array

MOST_TRIES, IDLE = 600, 60  # starts in all; so many in a row that find nothing new are enough
SAME = 1e-5  # rad, or share of the size: configurations nearer than that are one


@dataclass(frozen=True)
class Assembly:
    """A closed configuration q (n,); `guess` are coordinates that pick it among the others, m and rad.

    `off`: the guessed angle that is furthest from the file's guess, and how far (rad).
    """

    q: Array
    guess: dict[str, float]
    off: tuple[str, float]
    is_start: bool = False  # the one that the file's own guess leads to


def find_assemblies(linkage: Linkage, p: Array, q: Array, along: Sequence[str], t: float = 0.0) -> list[Assembly]:
    """All that were found, the start's q (n,) first. `along`: coordinates that can move, held as they are there."""
    place = {name: k for k, name in enumerate(linkage.source.coordinates)}
    free = [name for name in along if name not in linkage.source.start_set]
    closure = Closure(linkage, p, t, {name: float(q[place[name]]) for name in free})
    with np.errstate(all="ignore"):
        found = _distinct(closure, q)
        names = [name for name in linkage.source.coordinates if closure.is_angle[place[name]]]
        names += [name for name in linkage.source.coordinates if not closure.is_angle[place[name]]]
        telling = _telling(found, closure, [place[name] for name in names])
        coordinates = linkage.source.coordinates
        assemblies = [
            Assembly(x, {coordinates[k]: _plain(closure, x, k) for k in telling}, _furthest(closure, x)) for x in found
        ]
    return [replace(assembly, is_start=k == 0) for k, assembly in enumerate(assemblies)]


def _distinct(closure: Closure, start: Array) -> list[Array]:
    """Configurations with nothing between them; angles are the same if they differ by turns."""
    rng, found, idle = np.random.default_rng(1), [start], 0
    spread = np.where(closure.is_angle, np.pi, closure.size)
    for _ in range(MOST_TRIES):
        x = start + spread * rng.uniform(-1.0, 1.0, len(start))
        x[closure.set_index] = closure.set
        x = closure.newton(closure.place_angles(x))
        new = closure.is_closed(x) and closure.is_near(x) and not any(_same(closure, x, y) for y in found)
        found, idle = ([*found, x], 0) if new else (found, idle + 1)
        if idle >= IDLE:
            break
    return found


def _between(closure: Closure, x: Array, y: Array) -> Array:
    """How far apart, (n,): rad within half a turn, and shares of the size."""
    away = x - y
    return np.abs(np.where(closure.is_angle, (away + np.pi) % (2.0 * np.pi) - np.pi, away / closure.size))


def guesses_apart(closure: Closure, x: Array, y: Array) -> float:
    """By how much two configurations differ in what is guessed, at most: rad, or shares of the size."""
    points = [
        closure.off_point(x, point, np.zeros(2)) - closure.off_point(y, point, np.zeros(2))
        for point, _ in closure.points
    ]
    far = [float(np.linalg.norm(away)) / closure.size for away in points]
    return max([*far, *_between(closure, x, y)[closure.guessed].tolist()], default=0.0)


def _same(closure: Closure, x: Array, y: Array) -> bool:
    return bool(_between(closure, x, y).max(initial=0.0) < SAME)


def _telling(found: Sequence[Array], closure: Closure, order: Sequence[int]) -> list[int]:
    """As few coordinates as tell all configurations apart, taken greedily: which tells most pairs that are left."""
    chosen: list[int] = []
    pairs = [_between(closure, x, y) for x, y in combinations(found, 2)]
    left = list(range(len(pairs)))
    while left:
        best = max(order, key=lambda k: sum(bool(pairs[i][k] > APART) for i in left))
        told = [i for i in left if pairs[i][best] > APART]
        if not told:  # near each other everywhere: the coordinate in which they differ most
            best = max(order, key=lambda k: min(float(pairs[i][k]) for i in left))
            told = left
        chosen, left = [*chosen, best], [i for i in left if i not in told]
    return chosen


def _plain(closure: Closure, x: Array, k: int) -> float:
    """A coordinate, an angle within half a turn."""
    value = float(x[k])
    return float((value + np.pi) % (2.0 * np.pi) - np.pi) if closure.is_angle[k] else value


def _furthest(closure: Closure, x: Array) -> tuple[str, float]:
    away = {name: abs(value) for name, value in _off(closure, x).items()}
    name = max(away, key=lambda key: away[key], default="")
    return name, away.get(name, 0.0)


def _off(closure: Closure, x: Array) -> dict[str, float]:
    angles = [(name, k) for name, k in zip(closure.guess, closure.guessed, strict=True) if closure.is_angle[k]]
    return {name: (float(x[k]) - closure.guess[name] + np.pi) % (2.0 * np.pi) - np.pi for name, k in angles}
