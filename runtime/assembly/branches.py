"""Find the assemblies of a linkage: its closed configurations (assembly modes), each with a guess that selects it.

Newton's method starts from many random angles; different results are collected until MAX_IDLE_TRIES starts find no new
one. Independent coordinates (those of the degrees of freedom) are held at their values at the start.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from gudgeon.assembly.closure import AssemblyProblem
from gudgeon.assembly.guess_warnings import MIN_DIFFERENCE
from gudgeon.assembly.linkage import Linkage
from gudgeon.model.compiled import Array

MAX_TRIES, MAX_IDLE_TRIES = 600, 60  # largest number of starts, and of successive starts without a new result
CONFIGURATION_TOL = 1e-5  # rad, or relative to the size: closer configurations are the same


@dataclass(frozen=True)
class Assembly:
    """Hold a closed configuration q (n,), and the guess of coordinates (m, rad) that selects it.

    `largest_guess_error`: the guessed angle that is furthest from the file's guess, and its difference (rad).
    """

    q: Array
    guess: dict[str, float]
    largest_guess_error: tuple[str, float]
    is_start: bool = False  # whether the file's own guess leads to it


def find_assemblies(
    linkage: Linkage, p: Array, q: Array, held_coordinates: Sequence[str], t: float = 0.0
) -> list[Assembly]:
    """Find assemblies of a linkage by Newton's method from random starts; return them, that of the start q (n,) first.

    held_coordinates: names of the coordinates of the degrees of freedom. They are held at their values in q; the others
    are solved for from random starts. Coordinates that the file sets have the file's value. t: time of the drives, s.
    Each assembly has a guess that selects it, and the error of the file's guess there.
    """
    index_of = {name: k for k, name in enumerate(linkage.source.coordinates)}
    not_set = [name for name in held_coordinates if name not in linkage.source.start_set]
    problem = AssemblyProblem(linkage, p, t, {name: float(q[index_of[name]]) for name in not_set})
    with np.errstate(all="ignore"):
        configurations = _find_distinct_configurations(problem, q)
        names = [name for name in linkage.source.coordinates if problem.is_angle[index_of[name]]]
        names += [name for name in linkage.source.coordinates if not problem.is_angle[index_of[name]]]
        distinguishing = _select_distinguishing_coordinates(configurations, problem, [index_of[name] for name in names])
        coordinates = linkage.source.coordinates
        assemblies = [
            Assembly(
                x,
                {coordinates[k]: _reduce_coordinate(problem, x, k) for k in distinguishing},
                _find_largest_guess_error(problem, x),
            )
            for x in configurations
        ]
    return [replace(assembly, is_start=k == 0) for k, assembly in enumerate(assemblies)]


def _find_distinct_configurations(problem: AssemblyProblem, start: Array) -> list[Array]:
    """Return the configurations found from random starts, without repetitions; `start` is the first.

    A start differs from `start` by up to π in angles and the mechanism's size in positions; set coordinates keep their
    values. Newton's method must close it, with all bodies in range. The search ends after MAX_TRIES starts, or
    MAX_IDLE_TRIES successive ones without a new result. Angles that differ by full turns are the same.
    """
    rng, configurations, idle = np.random.default_rng(1), [start], 0
    spread = np.where(problem.is_angle, np.pi, problem.size)
    for _ in range(MAX_TRIES):
        x = start + spread * rng.uniform(-1.0, 1.0, len(start))
        x[problem.set_indices] = problem.set_values
        x = problem.close(x)
        new = (
            problem.is_closed(x)
            and problem.has_bodies_in_range(x)
            and not any(_are_same_configuration(problem, x, y) for y in configurations)
        )
        configurations, idle = ([*configurations, x], 0) if new else (configurations, idle + 1)
        if idle >= MAX_IDLE_TRIES:
            break
    return configurations


def _compute_differences(problem: AssemblyProblem, q: Array, other_q: Array) -> Array:
    """Return the magnitudes (n,) of the differences of the coordinates of two configurations (n,).

    Angles are in rad within half a turn, lengths relative to the mechanism's size.
    """
    difference = q - other_q
    return np.abs(np.where(problem.is_angle, (difference + np.pi) % (2.0 * np.pi) - np.pi, difference / problem.size))


def compute_guess_distance(problem: AssemblyProblem, q: Array, other_q: Array) -> float:
    """Return the largest difference of two configurations in guessed coordinates and points; 0 without guesses.

    Angles are in rad, lengths relative to the mechanism's size.
    """
    displacements = [
        problem.compute_point_error(q, point, np.zeros(2)) - problem.compute_point_error(other_q, point, np.zeros(2))
        for point, _ in problem.guessed_points
    ]
    distances = [float(np.linalg.norm(displacement)) / problem.size for displacement in displacements]
    return max([*distances, *_compute_differences(problem, q, other_q)[problem.guessed_indices].tolist()], default=0.0)


def _are_same_configuration(problem: AssemblyProblem, q: Array, other_q: Array) -> bool:
    """Return whether two configurations differ by less than CONFIGURATION_TOL in every coordinate."""
    return bool(_compute_differences(problem, q, other_q).max(initial=0.0) < CONFIGURATION_TOL)


def _select_distinguishing_coordinates(
    configurations: Sequence[Array], problem: AssemblyProblem, preferred_order: Sequence[int]
) -> list[int]:
    """Return the indices of few coordinates by which all configurations can be distinguished.

    They are selected greedily by the number of pairs that differ in them by more than MIN_DIFFERENCE. If no coordinate
    separates the remaining pairs by that much, the one whose smallest difference is largest is added, and the selection
    ends. `preferred_order`: indices of coordinates, the first of which is preferred among equals.
    """
    selected: list[int] = []
    pairs = [_compute_differences(problem, x, y) for x, y in combinations(configurations, 2)]
    remaining = list(range(len(pairs)))
    while remaining:
        best = max(preferred_order, key=lambda k: sum(bool(pairs[i][k] > MIN_DIFFERENCE) for i in remaining))
        separated = [i for i in remaining if pairs[i][best] > MIN_DIFFERENCE]
        if not separated:  # near each other everywhere: the coordinate in which they differ most
            best = max(preferred_order, key=lambda k: min(float(pairs[i][k]) for i in remaining))
            separated = remaining
        selected, remaining = [*selected, best], [i for i in remaining if i not in separated]
    return selected


def _reduce_coordinate(problem: AssemblyProblem, q: Array, index: int) -> float:
    """Return the coordinate q[index] of a configuration; an angle is reduced to [−π, π)."""
    value = float(q[index])
    return float((value + np.pi) % (2.0 * np.pi) - np.pi) if problem.is_angle[index] else value


def _find_largest_guess_error(problem: AssemblyProblem, q: Array) -> tuple[str, float]:
    """Return the name of the guessed angle that is furthest from its guess, and the difference (rad, positive).

    It is ("", 0) without guessed angles. Guessed lengths and points do not count.
    """
    errors = {name: abs(difference) for name, difference in _compute_guess_differences(problem, q).items()}
    name = max(errors, key=lambda key: errors[key], default="")
    return name, errors.get(name, 0.0)


def _compute_guess_differences(problem: AssemblyProblem, q: Array) -> dict[str, float]:
    """Return the differences (rad, within half a turn) of the guessed angles from the file's guesses, by name."""
    angles = [(name, k) for name, k in zip(problem.guess, problem.guessed_indices, strict=True) if problem.is_angle[k]]
    return {name: (float(q[k]) - problem.guess[name] + np.pi) % (2.0 * np.pi) - np.pi for name, k in angles}
