"""The peers of the race are judged before they judge: their C against the oracles, the table's interpolation."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import tests.benches  # noqa: F401
from benchmarks import callgrind, growth, laws, rhs
from benchmarks.peers import chain_equations, cvode, dry_chain, ideal, long_runs, press  # noqa: E402
from benchmarks.peers import four_bar_closed_form as four_bars
from benchmarks.peers.reference import ONSETS  # noqa: E402
from benchmarks.race import entries
from benchmarks.race import page as race_page
from benchmarks.race import record as race_record
from benchmarks.race.record import time_to  # noqa: E402
from gudgeon.generator.kinds.laws.law import find_bundled_laws
from tests.oracles import press_dense
from tests.oracles.journal import Journal
from tests.programs import needs_compiler


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
        return callgrind.instructions(callgrind.Call({"f.c": code}, ("f.c",), declaration, text, arrays, flags), counts)

    hundred = counted(100, (10, 20))
    assert hundred == counted(100, (10, 110))  # start and end of the process are gone
    assert 2.0 * hundred > counted(200, (10, 20)) > 1.9 * hundred  # less the loop around it
    assert hundred >= 100


def record() -> race_record.Record:
    """Of one work: ours twice as fast and as exact at each control, a peer that never comes to 1e-8."""
    errors = ((1e-3, 1e-5, 1e-9), (1e-3, 1e-5, math.nan))
    rows = [
        race_record.Row(
            "andrews",
            name,
            own,
            10.0**-k,
            (1.0 + own) ** -1 * 4.0**k * 1e-3,
            -1,
            {"angle": error[k]},
            4.0**k * 2e-3,
            0.5,
        )
        for name, own, error in zip(("gudgeon auto", "jitcode dop853"), (True, False), errors, strict=True)
        for k in range(3)
    ]
    return race_record.Record({"run 1, machine": "one: of two", "andrews, note": "5 µs"}, tuple(rows))


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    race_record.write(tmp_path / "race.csv", record())
    back = race_record.read(tmp_path / "race.csv")
    assert back.facts == record().facts
    assert repr(back.rows) == repr(record().rows)  # NaN is no equal of itself


def test_tables_tell_times_ratios_and_what_is_not_reached() -> None:
    lines = race_page.table(record(), "andrews", "angle")
    (cells,) = ([cell.strip() for cell in line.split("|")] for line in lines if "jitcode" in line)
    # 1e-4 is half-way, log-log, from 1e-3 (1 ms) to 1e-5 (4 ms); a whole call takes twice as long
    assert cells[1:-1] == ["jitcode dop853", "2.00", "–", "–", "4.00", "–", "–"]
    (cells,) = ([cell.strip() for cell in line.split("|")] for line in lines if "auto" in line)
    assert cells[1:-1] == ["gudgeon auto", "1.00", "2.83", "5.66", "4.00", "11.3", "22.6"]
    (bar,) = ([cell.strip() for cell in line.split("|")] for line in race_page.bars(record()) if "jitcode" in line)
    assert bar[1:-1] == [
        "`andrews`",
        "angle: 10⁻⁶, 10⁻⁸",
        "at least 3 times as fast as jitcode dop853",
        "–, – times",
        "–",
    ]
    (ratio,) = ([cell.strip() for cell in line.split("|")] for line in race_page.ratios(record()) if "`" in line)
    assert ratio[1:-1] == ["`andrews`", "angle", "jitcode dop853", *["–"] * 4]
    assert "| `andrews` | gudgeon auto; jitcode dop853 |     0.500 |" in race_page.setups(record())
    assert [race_page.number(x) for x in (6494.0, 999.96, 0.41263, math.nan)] == ["6,490", "1,000", "0.413", "–"]
    assert race_page.set_powers("3e-12 of 5e-08") == "3·10⁻¹² of 5·10⁻⁸"


def test_a_newer_run_replaces_its_problems_and_keeps_the_rest() -> None:
    old, (row, *_) = record(), record().rows
    links = replace(row, work="links", run=1)
    old = race_record.Record({**old.facts, "links, note": "old"}, (*old.rows, links))
    newer = race_record.Record(
        {"run 2, machine": "another", "links, not installed": "heyoka"}, (replace(links, run=2),)
    )
    both = old.merged(newer)
    assert both.runs() == [1, 2] and both.runs("links") == [2] and len(both.rows) == len(old.rows)
    assert both.facts == {k: v for k, v in {**old.facts, **newer.facts}.items() if k != "links, note"}
    assert race_page.facts(both, "links") == ["- not installed: heyoka", "- measurement 2"]
    again = both.merged(race_record.Record({"run 3, machine": "third"}, (replace(row, run=3),)))
    assert [name for name in again.facts if name.startswith("run")] == ["run 2, machine", "run 3, machine"]


def test_every_problem_has_entries_of_gudgeon_and_of_others() -> None:
    everybody = entries.entries()
    assert len({(entry.work, entry.name) for entry in everybody}) == len(everybody)
    for work in race_record.MEASURES:
        assert {bool(entry.method) for entry in everybody if entry.work == work} == {True, False}


def test_two_forms_of_a_chain_agree_and_conserve_energy() -> None:
    rng = np.random.default_rng(2)
    theta, omega = rng.standard_normal((2, 20))
    dense = np.array(chain_equations.accelerations(theta, omega, np.sin, np.cos))
    found = np.array(chain_equations.recursive_accelerations(theta, omega, np.sin, np.cos))
    assert abs(found - dense).max() < 1e-12 * abs(dense).max()
    h = 1e-6
    ends = [chain_equations.energy(np.concatenate([theta + s * h * omega, omega + s * h * found])) for s in (-1, 1)]
    assert abs(ends[1] - ends[0]) / (2.0 * h) < 1e-5 * abs(ends[0])  # the power; its terms are as large as the energy


def test_closed_form_of_four_bars_closes_and_has_the_rates_of_its_angles() -> None:
    lengths = four_bars.draw_lengths(3)
    found = four_bars.solve(lengths)
    t = four_bars.times()
    crank = np.pi / 2 + four_bars.SPEED * t
    for k, (a, b, c) in enumerate(zip(*lengths, strict=True)):
        ends = [a * np.exp(1j * crank) + b * np.exp(1j * found[0, k]), four_bars.PIVOT + c * np.exp(1j * found[3, k])]
        assert abs(ends[0] - ends[1]).max() < 1e-15
        for angle in (0, 3):
            for order in (0, 1):
                slope = CubicSpline(t, found[angle + order, k])(t, 1)
                assert slope[5:-5] == pytest.approx(found[angle + order + 1, k, 5:-5], rel=1e-4, abs=1e-3)


def test_energy_of_the_free_squeezer_is_conserved_by_its_equations() -> None:
    y, h = long_runs.start("turns"), 1e-9
    rate = np.array(long_runs.equations("turns", np, chain_equations.keep_expression, list(y)), dtype=float)
    before, after = long_runs.squeezer_energy(y - h * rate), long_runs.squeezer_energy(y + h * rate)
    assert abs(after - before) < 1e-12 * before  # the power times 2 h


def test_a_contact_of_the_chain_of_dry_joints_is_that_of_the_oracle() -> None:
    """One link in contact: the vector code against the oracle of a journal, and the law of action and reaction."""
    chain, y = dry_chain.Chain(), dry_chain.start()
    y[1] -= dry_chain.CLEARANCE + 2e-6  # the first journal lies in its bearing, the second in the other direction
    y[3 * dry_chain.LINKS + 1] -= 0.02
    chain.stored[:2] = 0.05
    rate = chain(0.0, y)[3 * dry_chain.LINKS :].reshape(dry_chain.LINKS, 3)
    e, speed, first, second, half = chain.joints(y)
    law = Journal(clearance=dry_chain.CLEARANCE, stored=0.05)
    wrenches = [law(e[:, k], speed[:, k], first[k], second[k]) for k in (0, 1)]
    force = wrenches[0].force - wrenches[1].force
    assert rate[0, :2] == pytest.approx(force / dry_chain.MASS - [0.0, dry_chain.GRAVITY], rel=1e-9)
    arm = half[:, 0]
    moment = -arm[0] * wrenches[0].force[1] + arm[1] * wrenches[0].force[0] + wrenches[0].moment_second
    moment += -arm[0] * wrenches[1].force[1] + arm[1] * wrenches[1].force[0] + wrenches[1].moment_first
    assert rate[0, 2] == pytest.approx(moment / dry_chain.INERTIA, rel=1e-9)


def test_the_page_is_what_the_committed_record_makes_of_it() -> None:
    page = race_page.PAGE.read_text(encoding="utf-8")
    assert race_page.filled(page, race_record.read(race_page.CSV)) == page
    assert set(re.findall(r"<!-- race: (\w+) -->", page)) == {
        "machine",
        "ratios",
        "faster",
        "bars",
        "setups",
        "evaluations",
        *race_record.MEASURES,
    }
    with pytest.raises(ValueError, match="nobody"):
        race_page.filled("<!-- race: nobody -->\n<!-- end -->", record())


def test_the_guide_to_methods_shows_the_times_of_the_race() -> None:
    """docs/choosing_a_method.md repeats the columns `engine` of gudgeon's methods, lubricated press, error `path`."""
    lines = race_page.table(race_record.read(race_page.CSV), "lubricated", "path")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines if "gudgeon " in line]
    guide = (race_page.PAGE.parent / "choosing_a_method.md").read_text(encoding="utf-8")
    assert len(rows) == 6
    for name, *cells in rows:
        assert f"| `{name.removeprefix('gudgeon ')}` | {' | '.join(cells[:3])} |\n" in guide


def test_the_page_of_growth_is_what_its_record_makes_of_it() -> None:
    page = growth.PAGE.read_text(encoding="utf-8")
    assert growth.filled(page) == page
    assert set(re.findall(r"<!-- scaling: (\w+) -->", page)) == {"machine", *growth.SIZES}


def test_exponents_of_growth_are_fitted_over_the_bodies() -> None:
    rows = [
        growth.Size("chain", n, n, 0.1 * n, 0.2 * n, 0.3 * n, 2.0 * n**2, 10 * n, 0.5, n**1.5, 7) for n in (2, 8, 32)
    ]
    assert [row.load for row in rows] == pytest.approx([1.2, 4.8, 19.2])
    cells = [cell.strip() for cell in growth.table(rows)[-1].split("|")]
    assert cells[1:-1] == ["exponent", "1.00", "1.00", "1.00", "1.00", "2.00", "1.00", "0.00", "1.50", "0.00"]
    assert "bodies" not in growth.table(rows)[0]  # each N is the number of bodies
    assert "bodies" in growth.table([replace(row, bodies=row.n + 1) for row in rows])[0]


@needs_compiler
def test_the_peers_of_the_sweep_are_the_runs_of_the_sweep() -> None:
    c, omega = np.array([3e-4, 6e-4]), np.array([math.pi, 5.0 * math.pi])
    first, second = cvode.sweep_works(c, omega)
    assert second == press.work("lubricated")
    geometry = first.press.geometry
    assert (first.press.clearance, geometry.omega1, geometry.omega4) == (3e-4, math.pi, -math.pi)


def test_every_law_has_states_to_be_timed_at() -> None:
    for law in filter(laws.has_function, find_bundled_laws().values()):
        assert set(law.variables) - {state.name for state in law.states} <= set(laws.DRAWN)


@needs_compiler
def test_a_law_is_timed_by_itself(tmp_path: Path) -> None:
    """The program compiles, sums what is a number, and the law takes longer than nothing."""
    own, nothing = laws.timed(find_bundled_laws()["ocvirk"], tmp_path)
    assert 0.0 < nothing < own


def test_the_widest_vectors_of_a_processor_are_told() -> None:
    """By whole flags of Linux; "" where none is known."""
    message = {
        "sse2 avx": "AVX",
        "sse2 avx avx2 fma": "AVX2",
        "avx2 avx512f avx512bw": "AVX-512",
        "asimd": "Neon",
        "avx512_fp16 sse2x": "",
    }
    assert {flags: rhs.widest(flags.split()) for flags in message} == message
