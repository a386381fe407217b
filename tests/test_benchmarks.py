"""The peers of the race are judged before they judge: their C against the oracles, the table's interpolation."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import json
import math
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.oracles import press_dense

if "benchmarks" not in sys.modules:  # the root stays off sys.path, so the folder is made a package by name
    spec = importlib.machinery.ModuleSpec("benchmarks", None, is_package=True)
    spec.submodule_search_locations = [str(Path(__file__).resolve().parents[1] / "benchmarks")]
    sys.modules["benchmarks"] = importlib.util.module_from_spec(spec)

from benchmarks import callgrind, rhs  # noqa: E402
from benchmarks.peers import ideal, press  # noqa: E402
from benchmarks.peers.reference import ONSETS  # noqa: E402
from benchmarks.race_record import time_to  # noqa: E402

needs_compiler = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")


def test_time_to_an_error_is_interpolated_between_neighbours_only() -> None:
    points = [(1e-3, 1.0), (1e-5, 4.0), (1e-7, 16.0)]
    assert time_to(points, 1e-4) == pytest.approx(2.0)
    assert time_to(points, 1e-5) == pytest.approx(4.0)
    assert time_to(points, 1e-2) == pytest.approx(1.0)
    assert math.isnan(time_to(points, 1e-8))
    assert time_to([(math.inf, 1.0), (1e-5, 4.0)], 1e-4) == pytest.approx(4.0)


@needs_compiler
@pytest.mark.parametrize("name", ["dry", "lubricated"])
def test_right_hand_side_and_gaps_are_those_of_the_oracle(name: str) -> None:
    work = press.work(name)
    kernel, rng = press.Kernel(work), np.random.default_rng(5)
    y = kernel.y0.copy()
    y[[3, 4, 6, 7]] += work.press.clearance * np.array([0.612, -0.816, -0.5, 0.3])  # A beyond its gap, B within
    y[24:] += 0.01 * rng.standard_normal(24)
    dy, _, contacts = press_dense.rhs(work.press, 0.1, y)
    assert np.array_equal(kernel.rhs(0.1, y), dy)
    delta, rate = kernel.gaps(y)[[0, 1]], kernel.gaps(y)[[2, 3]]
    assert delta == pytest.approx([c.delta for c in contacts], abs=1e-16)
    assert rate == pytest.approx([c.deltadot for c in contacts], abs=1e-13)


@needs_compiler
def test_differenced_jacobian_predicts_a_change_of_the_right_hand_side() -> None:
    work = press.work("lubricated")
    kernel, rng = press.Kernel(work), np.random.default_rng(7)
    y = kernel.y0.copy()
    y[[3, 4, 6, 7]] += work.press.clearance * np.array([0.24, 0.32, 0.3, -0.2])
    d = 1e-8 * rng.standard_normal(48)  # short against what bends the film; differences of both sorts leave 1e-5
    change = (kernel.rhs(0.0, y + d) - kernel.rhs(0.0, y - d)) / 2.0
    assert np.allclose(kernel.jacobian(0.0, y) @ d, change, rtol=0.0, atol=1e-4 * abs(change).max())


@needs_compiler
def test_located_onsets_of_the_dry_press_meet_the_reference() -> None:
    # DOP853 in double precision against the committed long double of order 12: two integrators, one right-hand side.
    # What the first contacts leave grows up to the last onset, so the tolerance is far above rtol times t.
    work, exact = press.work("dry"), json.loads(ONSETS.read_text())["onsets"]
    found = press.with_events(press.Kernel(work), work, kinks=True, method="DOP853", rtol=1e-12, atol=1e-14)
    for joint, times in zip("AB", found.onsets, strict=True):
        assert times == pytest.approx([t for name, t, _ in exact if name == joint], abs=2e-8)


@needs_compiler
def test_ideal_press_by_hand_is_its_closed_form() -> None:
    assert ideal.dense(0.0)[0] < 1e-12


def test_paths_of_a_concentric_start_are_points() -> None:
    work = press.work("dry")
    assert abs(press.paths(work, press_dense.start(work.press)[None, :24])).max() < 1e-15


@needs_compiler
def test_timed_states_are_finite_consistent_and_those_of_the_peer() -> None:
    """Reduced, full and hand-written right-hand sides agree where they are timed."""
    works = rhs.works()
    assert [work.closed for work in works] == [(), ("A",), (), ()]
    for work in works:
        found = rhs.result(work)
        assert np.isfinite(found.accelerations).all() and abs(found.accelerations).max() > 1.0
        assert found.phi < 1e-14 and found.phi_dot < 1e-12
        assert found.from_full < 1e-9
        assert found.from_peer < 1e-9 or (work.peer is None and math.isnan(found.from_peer))
    free, contact = works[0].operations, works[1].operations
    law = sum(works[1].simulation.source.operations[f"{law}_A_force"] for law in ("normal", "friction"))
    assert contact == (free[0] + law, free[1] + law)


@needs_compiler
@pytest.mark.skipif(not callgrind.available(), reason="no valgrind")
def test_callgrind_counts_a_call_and_nothing_else() -> None:
    """A loop of known additions: what is counted is in proportion to it, whatever the counts are."""
    code = "double f(long n, const double *x, int m) { double s = 0; for (long i = 0; i < n; i++)" + (
        " for (int k = 0; k < m; k++) s += x[k % 2]; return s; }"
    )
    flags = ("-O1", "-ffp-contract=off")

    def counted(times: int, counts: tuple[int, int]) -> float:
        text = f"f(count, x, {times})"
        arrays = {"x": np.array([0.1, math.nan])}
        declaration = "double f(long n, const double *x, int m);"
        return callgrind.instructions(callgrind.Call({"f.c": code}, "f.c", declaration, text, arrays, flags), counts)

    hundred = counted(100, (10, 20))
    assert hundred == counted(100, (10, 110))  # start and end of the process are gone
    assert 2.0 * hundred > counted(200, (10, 20)) > 1.9 * hundred  # less the loop around it
    assert hundred >= 100
