"""Warn about guesses of the start that the assembly does not follow."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from contextvars import ContextVar

import numpy as np

from gudgeon.assembly.linkage import Linkage, mechanism_size, place_of
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.compiled import Array

APART = 0.2  # rad, or relative to the size: difference from which on assemblies are distinguished by a guess
LISTED = "gudgeon check --branches lists those that there are"
# guesses that runs of batches do not follow; None: warn at once
NOTED: ContextVar[list[Mapping[str, float]] | None] = ContextVar("guesses that runs do not follow", default=None)
FOLLOWED = np.pi / 6  # rad; smaller differences from a guess are not reported


def unfollowed(linkage: Linkage, p: Array, q: Array) -> dict[str, float]:
    """Return the guessed coordinates that are far from their guess at q, and points by their distance: rad, or m."""
    source, off = linkage.source, dict[str, float]()
    guess = dict(zip(source.start_guess, linkage.start_values(p)[0].tolist(), strict=True))
    size = mechanism_size(linkage, p)
    for name, expected in guess.items():
        if name in source.coordinates:
            away = float(q[source.coordinates.index(name)]) - expected
            is_angle = name.endswith(".theta")
            away = (away + np.pi) % (2.0 * np.pi) - np.pi if is_angle else away
            if abs(away) > (FOLLOWED if is_angle else APART * max(size, abs(expected))):
                off[name] = away
    for point in source.points:
        if f"{point.name}.x" in guess:
            wanted_at = (guess[f"{point.name}.x"], guess[f"{point.name}.y"])
            if (away := float(np.linalg.norm(place_of(source, p, q, point) - wanted_at))) > APART * size:
                off[point.name] = away
    return off


def warn_unfollowed(linkage: Linkage, p: Array, q: Array) -> None:
    """Warn about each guess that the start q does not follow; within a batch, note them in NOTED."""
    off, noted = unfollowed(linkage, p, q), NOTED.get()
    if noted is not None:
        noted.append(off)
        return
    for name, away in off.items():
        message = f"{name} begins {guess_difference_text(name, away)} from its guess: {no_nearer_text(linkage.source)}"
        warnings.warn(f"{message}; {LISTED}", stacklevel=outside())


def warn_unfollowed_in_runs(source: KernelSource, noted: Sequence[Mapping[str, float]]) -> None:
    """Issue one warning for all runs of a batch: which guesses, in how many runs, by how much at most."""
    if (kept := NOTED.get()) is not None:  # by who makes many batches
        kept.extend(noted)
        return
    message = []
    for name in dict.fromkeys(name for off in noted for name in off):
        by = [off[name] for off in noted if name in off]
        message.append(
            f"{name} in {len(by)} of {len(noted)} runs by up to {guess_difference_text(name, max(map(abs, by)))}"
        )
    if message:
        text = f"runs begin away from their guess: {', '.join(message)}: {no_nearer_text(source)}; {LISTED}"
        warnings.warn(text, stacklevel=outside())


def outside() -> int:
    """Return the stack level of the user's own line, as `warnings.warn` counts it."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "gudgeon":
        level, frame = level + 1, frame.f_back
    return level


def guess_difference_text(name: str, off: float) -> str:
    """Return the difference from a guess as text, in degrees or mm."""
    return f"{np.degrees(abs(off)):.3g}°" if name.endswith(".theta") else f"{1e3 * abs(off):.3g} mm"


def no_nearer_text(source: KernelSource) -> str:
    """Return a text that no nearer assembly was found; several guesses may contradict each other."""
    guessed = {name if name in source.coordinates else name.rpartition(".")[0] for name in source.start_guess}
    return f"no assembly nearer{' to all guesses together' if len(guessed) > 1 else ''} was found"
