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

APART = 0.2  # rad, or relative to the size: difference from which on assemblies are distinguished by a guess
LISTED = "gudgeon check --branches lists those that there are"
# guesses that runs of batches do not follow; None: warn at once
UNFOLLOWED_GUESSES: ContextVar[list[Mapping[str, float]] | None] = ContextVar(
    "guesses that runs do not follow", default=None
)
FOLLOWED = np.pi / 6  # rad; smaller differences from a guess are not reported


def find_unfollowed_guesses(linkage: Linkage, p: Array, q: Array) -> dict[str, float]:
    """Return {name: difference from the guess} of guessed coordinates that differ at q by more than a limit.

    Differences are in rad or m. Guessed points are included with their distance (m).
    """
    source, differences = linkage.source, dict[str, float]()
    guess = dict(zip(source.start_guess, linkage.start_values(p)[0].tolist(), strict=True))
    size = compute_mechanism_size(linkage, p)
    for name, expected in guess.items():
        if name in source.coordinates:
            difference = float(q[source.coordinates.index(name)]) - expected
            is_angle = name.endswith(".theta")
            difference = (difference + np.pi) % (2.0 * np.pi) - np.pi if is_angle else difference
            if abs(difference) > (FOLLOWED if is_angle else APART * max(size, abs(expected))):
                differences[name] = difference
    for point in source.points:
        if f"{point.name}.x" in guess:
            expected_position = (guess[f"{point.name}.x"], guess[f"{point.name}.y"])
            if (
                difference := float(np.linalg.norm(compute_point_position(source, p, q, point) - expected_position))
            ) > APART * size:
                differences[point.name] = difference
    return differences


def warn_unfollowed_guesses(source: KernelSource, differences: Mapping[str, float]) -> None:
    """Warn about each guess that a start does not follow; within a batch, append them to NOTED instead.

    `differences`: those of `find_unfollowed_guesses`.
    """
    noted = UNFOLLOWED_GUESSES.get()
    if noted is not None:
        noted.append(differences)
        return
    for name, away in differences.items():
        message = (
            f"{name} begins {format_guess_difference(name, away)} from its guess: {describe_missing_assembly(source)}"
        )
        warnings.warn(f"{message}; {LISTED}", stacklevel=find_user_stack_level())


def warn_unfollowed_guesses_in_runs(source: KernelSource, unfollowed_guesses: Sequence[Mapping[str, float]]) -> None:
    """Issue one warning for all runs of a batch: guesses that starts do not follow, number of runs, largest difference.

    unfollowed_guesses: {name: difference} of each run. If a study collects them in NOTED, they are added there instead.
    """
    if (kept := UNFOLLOWED_GUESSES.get()) is not None:  # by who makes many batches
        kept.extend(unfollowed_guesses)
        return
    message = []
    for name in dict.fromkeys(name for off in unfollowed_guesses for name in off):
        deviations = [off[name] for off in unfollowed_guesses if name in off]
        largest = format_guess_difference(name, max(map(abs, deviations)))
        message.append(f"{name} in {len(deviations)} of {len(unfollowed_guesses)} runs by up to {largest}")
    if message:
        text = f"runs begin away from their guess: {', '.join(message)}: {describe_missing_assembly(source)}; {LISTED}"
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
    """Return a text that no nearer assembly was found, and that several guesses may contradict each other."""
    guessed = {name if name in source.coordinates else name.rpartition(".")[0] for name in source.start_guess}
    return f"no assembly nearer{' to all guesses together' if len(guessed) > 1 else ''} was found"
