"""What is made of a series at even times: its spectrum, and what an accelerometer's filter leaves of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.wanted import refuse, text, whole

if TYPE_CHECKING:
    from gudgeon.results.state import Array

EVEN = 1e-6  # of an interval: samples that far from even are not
WINDOWS = ("boxcar", "hann", "hamming", "blackman", "blackmanharris", "flattop")
MOST_ORDER = 16


def rate_of(t: Array) -> float:
    """Samples a second, Hz. BadValueError where they are not even."""
    steps = np.diff(t)
    if len(steps) < 8 or not np.all(np.abs(steps - steps.mean()) <= EVEN * steps.mean()):
        told = "a spectrum or a filter takes nine samples at even times or more"
        raise BadValueError(told, hint="simulate(…, output=N) has equal intervals; an event that ends a run adds one")
    return float(1.0 / steps.mean())


def spectrum(t: Array, values: Array, window: str = "hann") -> tuple[Array, Array]:
    """Frequencies (Hz) and amplitudes (M,), the unit of the values: a sine of amplitude A on a line of it has A.

    One-sided, of the values less their mean, under a window of scipy.signal.windows, divided by its mean.
    """
    from scipy.signal import get_window

    if text(window, "window") not in WINDOWS:
        refuse("window", window, f"one of {', '.join(WINDOWS)}")
    rate, weights = rate_of(t), get_window(window, len(t))
    finite(values)
    found = np.abs(np.fft.rfft((values - values.mean()) * weights)) / weights.sum()
    found[1 : (len(t) + 1) // 2] *= 2.0  # what is at −f, but for that at half the rate
    return np.fft.rfftfreq(len(t), 1.0 / rate), found


def low_pass(t: Array, values: Array, cutoff: float, order: int = 2, causal: bool = True) -> Array:
    """What a low-pass of Butterworth leaves, (N,): −3 dB at `cutoff` (Hz).

    `causal`: once forwards, as an amplifier does, late by its phase; begun at rest at the first value. Else forwards
    and back, with no phase, the cutoff placed so that both together have −3 dB there. BadValueError for a cutoff
    beyond half the rate of the samples.
    """
    from scipy.signal import butter, sosfilt, sosfilt_zi, sosfiltfilt

    rate, order = rate_of(t), whole(order, "order", 1, MOST_ORDER)
    finite(values)
    if not 0.0 < cutoff < 0.499 * rate:
        told = f"cutoff: {cutoff:g} Hz with {rate:g} samples a second: expected one below half of that"
        raise BadValueError(told, hint="simulate with a larger output")
    warped = np.tan(np.pi * cutoff / rate)  # of the bilinear transform
    if not causal:
        warped *= (2.0**0.5 - 1.0) ** (-1.0 / (2.0 * order))
    design = float(np.arctan(warped)) / np.pi * rate
    sections = butter(order, design, fs=rate, output="sos")
    if causal:
        found: Array = sosfilt(sections, values, zi=sosfilt_zi(sections) * values[0])[0]
        return found
    back: Array = sosfiltfilt(sections, values)
    return back


def finite(values: Array) -> None:
    """BadValueError unless all are numbers."""
    if not np.isfinite(values).all():
        raise BadValueError("a series with values that are no numbers has no spectrum")
