"""Warn if the assembled start is far from values that the file gives in `start: guess`."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from contextvars import ContextVar

import numpy as np

from gudgeon.assembly.linkage import Linkage, compute_mechanism_size, compute_point_position
from gudgeon.contract.kernel_source import KernelSource
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
    guess = dict(zip(source.start_guess, linkage.start_values(p)[0].tolist(), strict=True))
    size = compute_mechanism_size(linkage, p)
    for name, expected in guess.items():
        if name in source.coordinates:
            difference = float(q[source.coordinates.index(name)]) - expected
            is_angle = name.endswith(".theta")
            difference = (difference + np.pi) % (2.0 * np.pi) - np.pi if is_angle else difference
            if abs(difference) > (MAX_ANGLE_DEVIATION if is_angle else MIN_DIFFERENCE * max(size, abs(expected))):
                differences[name] = difference
    for point in source.points:
        if f"{point.name}.x" in guess:
            expected_position = (guess[f"{point.name}.x"], guess[f"{point.name}.y"])
            if (
                difference := float(np.linalg.norm(compute_point_position(source, p, q, point) - expected_position))
            ) > MIN_DIFFERENCE * size:
                differences[point.name] = difference
    return differences


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


def find_user_stack_level() -> int:
    """Return the stack level of the first caller outside gudgeon, as `warnings.warn` counts it."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "gudgeon":
        level, frame = level + 1, frame.f_back
    return level


def format_guess_difference(name: str, difference: float) -> str:
    """Return the magnitude of a difference from a guess as text, in degrees for angles, else in mm."""
    return f"{np.degrees(abs(difference)):.3g}°" if name.endswith(".theta") else f"{1e3 * abs(difference):.3g} mm"


def describe_missing_assembly(source: KernelSource) -> str:
    """Return the text that no nearer assembly was found; with several guesses, none nearer to all of them together."""
    guessed = {name if name in source.coordinates else name.rpartition(".")[0] for name in source.start_guess}
    return f"no assembly nearer{' to all guesses together' if len(guessed) > 1 else ''} was found"
