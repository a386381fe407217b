"""Find the assemblies of a linkage: closed configurations that no motion connects, each with a guess that selects
it.

Newton's method starts from many random angles; different results are collected until no new one was found for a while.
Coordinates that can move are held at their values at the start.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.guess_warnings import APART
from gudgeon.assembly.linkage import Linkage
from gudgeon.model.compiled import Array

MOST_TRIES, IDLE = 600, 60  # largest number of starts, and of successive starts without a new result
SAME = 1e-5  # rad, or relative to the size: closer configurations are the same


@dataclass(frozen=True)
class Assembly:
    """Hold a closed configuration q (n,), and the guess of coordinates (m, rad) that selects it.

    `off`: the guessed angle that is furthest from the file's guess, and its difference (rad).
    """

    q: Array
    guess: dict[str, float]
    off: tuple[str, float]
    is_start: bool = False  # whether the file's own guess leads to it


def find_assemblies(linkage: Linkage, p: Array, q: Array, along: Sequence[str], t: float = 0.0) -> list[Assembly]:
    """Return all assemblies that were found, that of the start q (n,) first.

    `along`: coordinates that can move; they are held at their values in q.
    """
    place = {name: k for k, name in enumerate(linkage.source.coordinates)}
    free = [name for name in along if name not in linkage.source.start_set]
    closure = Closure(linkage, p, t, {name: float(q[place[name]]) for name in free})
    with np.errstate(all="ignore"):
        found = _find_distinct(closure, q)
        names = [name for name in linkage.source.coordinates if closure.is_angle[place[name]]]
        names += [name for name in linkage.source.coordinates if not closure.is_angle[place[name]]]
        telling = _distinguishing_coordinates(found, closure, [place[name] for name in names])
        coordinates = linkage.source.coordinates
        assemblies = [
            Assembly(
                x, {coordinates[k]: _reduced_coordinate(closure, x, k) for k in telling}, _furthest_guess(closure, x)
            )
            for x in found
        ]
    return [replace(assembly, is_start=k == 0) for k, assembly in enumerate(assemblies)]


def _find_distinct(closure: Closure, start: Array) -> list[Array]:
    """Return configurations that differ; angles that differ by full turns are the same."""
    rng, found, idle = np.random.default_rng(1), [start], 0
    spread = np.where(closure.is_angle, np.pi, closure.size)
    for _ in range(MOST_TRIES):
        x = start + spread * rng.uniform(-1.0, 1.0, len(start))
        x[closure.set_index] = closure.set
        x = closure.newton(closure.place_angles(x))
        new = closure.is_closed(x) and closure.is_near(x) and not any(_is_same(closure, x, y) for y in found)
        found, idle = ([*found, x], 0) if new else (found, idle + 1)
        if idle >= IDLE:
            break
    return found


def _differences(closure: Closure, x: Array, y: Array) -> Array:
    """Return the differences (n,) of two configurations: rad within half a turn, or relative to the size."""
    away = x - y
    return np.abs(np.where(closure.is_angle, (away + np.pi) % (2.0 * np.pi) - np.pi, away / closure.size))


def guess_distance(closure: Closure, x: Array, y: Array) -> float:
    """Return the largest difference of two configurations in guessed coordinates: rad, or relative to the size."""
    points = [
        closure.off_point(x, point, np.zeros(2)) - closure.off_point(y, point, np.zeros(2))
        for point, _ in closure.points
    ]
    far = [float(np.linalg.norm(away)) / closure.size for away in points]
    return max([*far, *_differences(closure, x, y)[closure.guessed].tolist()], default=0.0)


def _is_same(closure: Closure, x: Array, y: Array) -> bool:
    """Return whether two configurations are the same within SAME."""
    return bool(_differences(closure, x, y).max(initial=0.0) < SAME)


def _distinguishing_coordinates(found: Sequence[Array], closure: Closure, order: Sequence[int]) -> list[int]:
    """Return few coordinates that distinguish all configurations, chosen greedily by the number of new pairs."""
    selected: list[int] = []
    pairs = [_differences(closure, x, y) for x, y in combinations(found, 2)]
    left = list(range(len(pairs)))
    while left:
        best = max(order, key=lambda k: sum(bool(pairs[i][k] > APART) for i in left))
        message = [i for i in left if pairs[i][best] > APART]
        if not message:  # near each other everywhere: the coordinate in which they differ most
            best = max(order, key=lambda k: min(float(pairs[i][k]) for i in left))
            message = left
        selected, left = [*selected, best], [i for i in left if i not in message]
    return selected


def _reduced_coordinate(closure: Closure, x: Array, k: int) -> float:
    """Return a coordinate; an angle is reduced to half a turn."""
    value = float(x[k])
    return float((value + np.pi) % (2.0 * np.pi) - np.pi) if closure.is_angle[k] else value


def _furthest_guess(closure: Closure, x: Array) -> tuple[str, float]:
    """Return the guessed angle that is furthest from its guess, and its difference (rad)."""
    away = {name: abs(value) for name, value in _guess_differences(closure, x).items()}
    name = max(away, key=lambda key: away[key], default="")
    return name, away.get(name, 0.0)


def _guess_differences(closure: Closure, x: Array) -> dict[str, float]:
    """Return the differences (rad) of the guessed angles from the file's guess, by name."""
    angles = [(name, k) for name, k in zip(closure.guess, closure.guessed, strict=True) if closure.is_angle[k]]
    return {name: (float(x[k]) - closure.guess[name] + np.pi) % (2.0 * np.pi) - np.pi for name, k in angles}
