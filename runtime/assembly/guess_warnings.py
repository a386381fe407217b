"""Warn if the assembled start is far from values that the file gives in `start: guess`."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from contextvars import ContextVar

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import Linkage, compute_mechanism_size, compute_point_position
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.deprecations import find_user_stack_level
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array

MIN_DIFFERENCE = 0.2  # rad, or relative to the size: smallest difference of assemblies that a guess distinguishes
LISTED = "gudgeon check --branches lists the assemblies"
# deviations from guesses in the runs of a study's batches; None: warn at once
COLLECTED_GUESS_DEVIATIONS: ContextVar[list[Mapping[str, float]] | None] = ContextVar(
    "deviations from guesses", default=None
)
MAX_ANGLE_DEVIATION = np.pi / 6  # rad; smaller deviations from a guessed angle are not reported


def find_guess_deviations(linkage: Linkage, p: Array, q: Array) -> dict[str, float]:
    """Return {name: deviation} of the guessed coordinates and points from which the assembled position q deviates.

    Deviations of coordinates are q minus the guess (rad or m; angles within a half turn), those of points are distances
    (m). Only deviations above MAX_ANGLE_DEVIATION (30°) for angles, and above MIN_DIFFERENCE (0.2) of the mechanism's
    size (of a coordinate's guess, if larger) for lengths, are returned.
    """
    source, differences = linkage.source, dict[str, float]()
    values, size = linkage.start_values(p)[0], compute_mechanism_size(linkage, p)
    guessed, coordinates, angle_limits, is_length = _list_guessed_coordinates(source)
    expected = values.take(guessed)
    difference = q.take(coordinates) - expected
    if (
        b"\0" in (np.abs(difference) <= angle_limits + MIN_DIFFERENCE * size * is_length).tobytes()
    ):  # quicker than all()
        turned = np.where(is_length, difference, (difference + np.pi) % (2.0 * np.pi) - np.pi)
        limits = angle_limits + MIN_DIFFERENCE * np.maximum(size, np.abs(expected)) * is_length
        for k in np.flatnonzero(np.abs(turned) > limits).tolist():
            differences[source.coordinates[coordinates[k]]] = float(turned[k])
    if len(guessed) == len(values):
        return differences
    guess = dict(zip(source.start_guess, values.tolist(), strict=True))
    for point in source.points:
        if f"{point.name}.x" in guess:
            expected_position = (guess[f"{point.name}.x"], guess[f"{point.name}.y"])
            distance = float(np.linalg.norm(compute_point_position(source, p, q, point) - expected_position))
            if distance > MIN_DIFFERENCE * size:
                differences[point.name] = distance
    return differences


@cache_by_values
def _list_guessed_coordinates(source: KernelSource) -> tuple[NDArray[np.intp], NDArray[np.intp], Array, Array]:
    """Return arrays on the guesses of coordinates: their indices in source.start_guess and in q; the largest deviation
    of angles, 0 for lengths; and 1 for lengths, 0 for angles.
    """
    names = [name for name in source.start_guess if name in source.coordinates]
    of_guesses, of_q = (
        np.array([everything.index(name) for name in names], np.intp)
        for everything in (source.start_guess, source.coordinates)
    )
    is_length = np.array([float(not name.endswith(".theta")) for name in names])
    return of_guesses, of_q, MAX_ANGLE_DEVIATION * (1.0 - is_length), is_length


def warn_guess_deviations(source: KernelSource, differences: Mapping[str, float]) -> None:
    """Warn about each guess from which the start deviates.

    In a study, append the deviations to the list of COLLECTED_GUESS_DEVIATIONS instead. `differences`: the result of
    `find_guess_deviations`.
    """
    collected = COLLECTED_GUESS_DEVIATIONS.get()
    if collected is not None:
        collected.append(differences)
        return
    for name, away in differences.items():
        message = (
            f"{name} begins {format_guess_difference(name, away)} from its guess: {describe_missing_assembly(source)}"
        )
        warnings.warn(f"{message}; {LISTED}", stacklevel=find_user_stack_level())


def warn_guess_deviations_in_runs(source: KernelSource, guess_deviations: Sequence[Mapping[str, float]]) -> None:
    """Issue one warning for all runs of a batch: guesses from which starts deviate, number of runs, largest deviation.

    guess_deviations: {name: deviation} of each run, as of `find_guess_deviations`; without any there is no warning. In
    a study they are appended to the list in COLLECTED_GUESS_DEVIATIONS instead.
    """
    if (collected := COLLECTED_GUESS_DEVIATIONS.get()) is not None:  # a study with many batches
        collected.extend(guess_deviations)
        return
    message = []
    for name in dict.fromkeys(name for run_deviations in guess_deviations for name in run_deviations):
        deviations = [run_deviations[name] for run_deviations in guess_deviations if name in run_deviations]
        largest = format_guess_difference(name, max(map(abs, deviations)))
        message.append(f"{name} in {len(deviations)} of {len(guess_deviations)} runs by up to {largest}")
    if message:
        text = f"starts deviate from their guess: {', '.join(message)}: {describe_missing_assembly(source)}; {LISTED}"
        warnings.warn(text, stacklevel=find_user_stack_level())


def format_guess_difference(name: str, difference: float) -> str:
    """Return the magnitude of a difference from a guess as text, in degrees for angles, else in mm."""
    return f"{np.degrees(abs(difference)):.3g}°" if name.endswith(".theta") else f"{1e3 * abs(difference):.3g} mm"


def describe_missing_assembly(source: KernelSource) -> str:
    """Return the text that no nearer assembly was found; with several guesses, none nearer to all of them together."""
    guessed = {name if name in source.coordinates else name.rpartition(".")[0] for name in source.start_guess}
    return f"no assembly nearer{' to all guesses together' if len(guessed) > 1 else ''} was found"
