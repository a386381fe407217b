"""Compute the Fourier spectrum of a series at equal time intervals, and filter it with a Butterworth low-pass.

The low-pass filter models the amplifier of an accelerometer.
"""

from __future__ import annotations

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_integer, check_text, raise_bad_value
from gudgeon.results.state import Array

SAMPLE_INTERVAL_TOL = 1e-6  # relative deviation from the mean interval up to which samples count as evenly spaced
WINDOWS = ("boxcar", "hann", "hamming", "blackman", "blackmanharris", "flattop")
MAX_FILTER_ORDER = 16


def compute_sampling_rate(t: Array) -> float:
    """Return the sampling rate (Hz) of times (N,).

    Raises BadValueError for fewer than nine times, or intervals that differ by more than SAMPLE_INTERVAL_TOL.
    """
    intervals = np.diff(t)
    if len(intervals) < 8 or not np.all(np.abs(intervals - intervals.mean()) <= SAMPLE_INTERVAL_TOL * intervals.mean()):
        message = "a spectrum or a filter needs at least nine samples at equal intervals"
        hint = "simulate(…, output=N) has equal intervals; an event that ends a run adds one"
        raise BadValueError(message, hint=hint)
    return float(1.0 / intervals.mean())


def compute_spectrum(t: Array, values: Array, window: str = "hann") -> tuple[Array, Array]:
    """Return frequencies (Hz) and amplitudes (M,) of the one-sided Fourier spectrum of a series less its mean.

    `window` is a name from WINDOWS; the window is divided by its mean, so that a sine of amplitude A on a spectral
    line has the amplitude A. Raises BadValueError for another window, uneven times or values that are not finite.
    """
    from scipy.signal import get_window

    if check_text(window, "window") not in WINDOWS:
        raise_bad_value("window", window, f"one of {', '.join(WINDOWS)}")
    sampling_rate, window_values = compute_sampling_rate(t), get_window(window, len(t))
    check_finite_series(values)
    amplitudes = np.abs(np.fft.rfft((values - values.mean()) * window_values)) / window_values.sum()
    amplitudes[1 : (len(t) + 1) // 2] *= 2.0  # adds the amplitudes at −f, except at 0 and at the Nyquist frequency
    return np.fft.rfftfreq(len(t), 1.0 / sampling_rate), amplitudes


def apply_low_pass(t: Array, values: Array, cutoff: float, order: int = 2, causal: bool = True) -> Array:
    """Return a series (N,) after a Butterworth low-pass filter with −3 dB at `cutoff` (Hz).

    `causal`: one pass forwards, with phase lag, in steady state at the first value. Otherwise forwards and backwards
    with zero phase, with −3 dB of both passes together at `cutoff`. Raises BadValueError for a cutoff above half the
    sampling rate, and for values that are not finite.
    """
    from scipy.signal import butter, sosfilt, sosfilt_zi, sosfiltfilt

    sampling_rate, order = compute_sampling_rate(t), check_integer(order, "order", 1, MAX_FILTER_ORDER)
    check_finite_series(values)
    if not 0.0 < cutoff < 0.499 * sampling_rate:
        message = f"cutoff: {cutoff:g} Hz with {sampling_rate:g} samples a second: expected less than half of that"
        raise BadValueError(message, hint="simulate with a larger output")
    warped_frequency = np.tan(np.pi * cutoff / sampling_rate)  # prewarping of the bilinear transform
    if not causal:
        warped_frequency *= (2.0**0.5 - 1.0) ** (-1.0 / (2.0 * order))
    design_frequency = float(np.arctan(warped_frequency)) / np.pi * sampling_rate
    sections = butter(order, design_frequency, fs=sampling_rate, output="sos")
    if causal:
        return np.asarray(sosfilt(sections, values, zi=sosfilt_zi(sections) * values[0])[0])
    filtered_both_ways: Array = sosfiltfilt(sections, values)
    return filtered_both_ways


def check_finite_series(values: Array) -> None:
    """Raise BadValueError unless all values are finite."""
    if not np.isfinite(values).all():
        raise BadValueError("the series has values that are not finite: a spectrum or a filter needs finite values")
