"""Spectra, filters, phases and sections of runs: a sine's line, Butterworth's formula, a pendulum's lowest place."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.errors import BadValueError, UnknownNameError  # noqa: E402
from gudgeon.loading.kernel_sources import find_mechanism  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402
from gudgeon.results.signals import WINDOWS, apply_low_pass, compute_spectrum  # noqa: E402
from tests.programs import needs_compiler  # noqa: E402

RATE, N = 1000.0, 2000
T = np.arange(N) / RATE


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("n", [N, N - 1])
def test_a_sine_is_a_line_of_its_amplitude(window: str, n: int) -> None:
    """On a line of the spectrum, whatever the window, and above a mean that is left out."""
    line = 80 * RATE / n
    f, found = compute_spectrum(T[:n], 3.0 + 0.7 * np.sin(2 * np.pi * line * T[:n] + 0.4), window)
    assert f[found.argmax()] == pytest.approx(line, rel=1e-12)
    assert found.max() == pytest.approx(0.7, rel=1e-6) and found[-300:].max() < 1e-3


def test_the_power_of_a_spectrum_is_the_signals() -> None:
    """Parseval, of white noise without a window: the line at half the rate is not doubled."""
    values = np.random.default_rng(3).normal(size=N)
    _, found = compute_spectrum(T, values, "boxcar")
    power = found[0] ** 2 + (found[1:-1] ** 2).sum() / 2 + found[-1] ** 2
    assert power == pytest.approx(values.var(), rel=1e-12)


@pytest.mark.parametrize("causal", [True, False])
@pytest.mark.parametrize("order", [1, 2, 4])
def test_a_low_pass_is_butterworths(order: int, causal: bool) -> None:
    """1/√2 at the cutoff; far below 1, and an octave above what the formula says, by the bilinear transform's scale."""
    cutoff, middle = 40.0, slice(N // 2, 3 * N // 4)

    def gain(f: float) -> float:
        out = apply_low_pass(T, np.sin(2 * np.pi * f * T), cutoff, order, causal)
        basis = np.column_stack([np.sin(2 * np.pi * f * T), np.cos(2 * np.pi * f * T)])[middle]
        return float(np.hypot(*np.linalg.lstsq(basis, out[middle], rcond=None)[0]))

    assert gain(cutoff) == pytest.approx(np.sqrt(0.5), rel=2e-3)
    ratio = np.tan(np.pi * 80 / RATE) / np.tan(np.pi * cutoff / RATE)
    times = 1 if causal else 2
    scale = 1.0 if causal else np.sqrt(2) - 1
    assert gain(80.0) == pytest.approx((1 + scale * ratio ** (2 * order)) ** (-times / 2), rel=5e-3)
    assert gain(2.0) == pytest.approx(1.0, abs=3e-3)


def test_zero_phase_is_not_late_and_a_constant_stays() -> None:
    pulse = np.exp(-(((T - 1.0) / 0.02) ** 2))
    assert T[apply_low_pass(T, pulse, 30.0, causal=False).argmax()] == pytest.approx(1.0, abs=1e-3)
    assert T[apply_low_pass(T, pulse, 30.0).argmax()] > 1.004
    np.testing.assert_allclose(apply_low_pass(T, np.full(N, 7.0), 30.0), 7.0, rtol=1e-9)


@pytest.mark.parametrize("cutoff", [0.0, -1.0, 500.0, np.nan, np.inf])
def test_what_cannot_be_filtered_is_refused(cutoff: float) -> None:
    with pytest.raises(BadValueError, match="cutoff"):
        apply_low_pass(T, T, cutoff)
    with pytest.raises(BadValueError, match="equal intervals"):
        compute_spectrum(T**2, T)
    with pytest.raises(BadValueError, match="not finite"):
        compute_spectrum(T, np.where(T == 0.5, np.nan, T))
    with pytest.raises(BadValueError, match="one of boxcar"):
        compute_spectrum(T, T, "kaiser")


def test_a_run_is_drawn_in_its_units(run: Result) -> None:
    """Whatever is drawn is what the functions give, in millimetres; a file's names, horizons and all as ever."""
    assert run.t.size > 9
    ax: Any = run.plot.phase("S9.y")
    x, y = ax.lines[0].get_data()
    np.testing.assert_allclose(x, run["S9.y"] * 1e3)
    np.testing.assert_allclose(y, run["S9.vy"] * (1 if ax.get_ylabel().endswith("[m/s]") else 1e3))
    f, found = compute_spectrum(run.t, run["S9.y"])
    drawn: Any = run.plot.spectrum("S9.y")
    np.testing.assert_array_equal(drawn.lines[0].get_xdata(), f)
    np.testing.assert_allclose(drawn.lines[0].get_ydata(), found * 1e3)
    assert drawn.get_xlabel() == "f [Hz]" and "hann" in drawn.get_title()
    rate = 1.0 / (run.t[1] - run.t[0])
    left: Any = run.plot.low_pass("S9.y", rate / 10, order=4)
    np.testing.assert_allclose(left.lines[1].get_ydata(), apply_low_pass(run.t, run["S9.y"], rate / 10, 4) * 1e3)
    with pytest.raises(UnknownNameError):
        run.plot.phase("S9.z")
    with pytest.raises(BadValueError, match="no series of its rate"):
        run.plot.phase("A.F")
    short = replace(run, t=run.t[:5], q=run.q[:5], stored={})
    with pytest.raises(BadValueError, match="nine samples"):
        short.plot.spectrum("S9.y")


@needs_compiler
def test_a_pendulums_section_is_two_points(tmp_path: Path) -> None:
    """It passes its lowest place at √(2 g l), to the right and to the left in turn."""
    text = find_mechanism("pendulum").read_text(encoding="utf-8")
    (tmp_path / "p.yaml").write_text(text.replace("outputs:", "events: {low: {zero: bob.x}}\noutputs:"), "utf-8")
    run = gudgeon.load(tmp_path / "p.yaml").simulate(t_end=10.0, output=20)
    ax: Any = run.plot.section("low", "bob.y", "bob.vx")
    y, rate = ax.lines[0].get_data()
    np.testing.assert_allclose(y, -1.0, rtol=1e-9)
    np.testing.assert_allclose(np.abs(rate), np.sqrt(2 * 9.81), rtol=1e-6)
    assert len(rate) == 8 and set(np.sign(rate)) == {1.0, -1.0}
    with pytest.raises(BadValueError, match="did not happen"):
        gudgeon.load(tmp_path / "p.yaml").simulate(t_end=0.01).plot.section("low", "bob.y")
