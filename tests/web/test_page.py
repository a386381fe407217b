"""The page that runs, in a real Chromium without a window: what hands do, what is run and what is told."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from tests.pump import Gudgeon  # noqa: E402
from tests.scenes import loader  # noqa: E402
from tests.web.chromium import PHONE, C, written  # noqa: E402


def test_what_a_hand_moves_is_simulated_and_shown(opened: Any, press: Path) -> None:
    """The clearance typed, then slid; states are the native run's to the last bit."""
    native = gudgeon.load("nine_bar_press", "lubricated")
    shown = opened(press)
    assert shown.same_bits(native.simulate())
    before = shown.shown()
    shown.type_into(3, "400 µm")
    assert shown.array("p")[3] == 4e-4
    shown.type_into(3, "0,4")
    assert shown.same_bits(native.simulate(parameters={"c": "0.4 mm"}))
    after = shown.shown()
    assert sum(x != y for x, y in zip(before[-4:], after[-4:], strict=True)) >= 3  # traces
    shown.page.evaluate("gudgeonApp.seek(0.3)")
    shown.wait()
    drawn = shown.shown()
    move = "(slider) => { slider.value = 540; slider.dispatchEvent(new Event('input')); }"
    shown.page.locator("#g-parameter-2").evaluate(move)
    shown.wait()
    l5 = shown.page.evaluate("gudgeonApp.sim.p[2]")
    assert l5 != 0.3
    assert shown.same_bits(native.simulate(parameters={"c": "0.4 mm", "l5": l5}))
    assert sum(x != y for x, y in zip(drawn, shown.shown(), strict=True)) > 8
    assert shown.error() == "" and shown.complaints == []


def test_what_cannot_be_run_is_told(opened: Any, press: Path) -> None:
    shown = opened(press)
    before = shown.array("q")
    field = shown.page.locator(f"{C} + input")
    for text, message in (("-1", "expected > 0"), ("one", "one is no number"), ("90 deg/s", "a unit may follow")):
        shown.type_into(3, text)
        assert message in shown.error() and field.get_attribute("aria-invalid") == "true"
        assert np.array_equal(shown.array("q"), before)
    shown.type_into(3, "0.3")
    assert shown.error() == "" and field.get_attribute("aria-invalid") is None
    shown.type_into(21, "20")  # L2 does not reach
    address = shown.page.evaluate("gudgeonApp.description.slots[21].address")
    message = rf"closes beyond {address} = ([\d.]+) mm: the largest gap, ([\d.]+) mm, is in a row of \w+\. Python"
    gap = re.search(message, shown.error())
    assert gap and 20.0 < float(gap[1]) < 200.0 and 1.0 < float(gap[2]) < 300.0
    shown.type_into(3, "0.31")  # which moves no start: the blame stays where it is
    assert f"Cause: {address} = 20 mm." in shown.error()
    assert field.get_attribute("aria-invalid") is None
    shown.page.locator(".g-reset").click()
    shown.wait()
    assert shown.error() == "" and np.array_equal(shown.array("q"), before)
    assert shown.complaints == []


FRAMES = """() => new Promise((done) => {
    const slider = document.querySelector("#g-parameter-3"), apart = [];
    let [last, k] = [0, 0];
    gudgeonApp.setPlaying(true);
    const step = (now) => {
        if (last) apart.push(now - last);
        last = now;
        slider.value = 500 + 300 * Math.sin(k / 30);
        slider.dispatchEvent(new Event("input"));
        if (++k < 40) requestAnimationFrame(step);
        else done(apart.sort((a, b) => a - b));
    };
    requestAnimationFrame(step);
})"""


def test_frames_while_a_slider_moves(opened: Any, press: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Told, not asserted: it depends on who else computes here."""
    shown = opened(press)
    first = shown.array("q")
    apart = shown.page.evaluate(FRAMES)
    with capsys.disabled():
        print(
            f"\n    press: {1e3 / np.mean(apart):.0f} frames a second while a slider moves and time goes on"
            f" (median {apart[len(apart) // 2]:.1f} ms, worst {apart[-1]:.0f} ms)"
        )
    assert not np.array_equal(shown.array("q"), first)  # it has gone on to new runs all the while
    assert shown.complaints == []


LONG = f"""
title: {"Koppelgetriebe" * 8}
parameters: {{omega: 1 rad/s}}
bodies: {{crank: {{length: 50 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, crank.tail]}}}}
drives: {{motor: {{angle: crank, value: 0.5 rad + omega*t}}}}
scenes: {{s: {{simulate: {{t_end: 1 s, output: 50}}}}}}
"""


def test_scenes_lead_to_each_other(opened: Any, tmp_path: Path, call: Gudgeon) -> None:
    """A folder of pages: another scene begins with the numbers of this one, and computes what the compiled one does."""
    native = loader(tmp_path)(LONG, "s")
    assert call("equations", "attacked_0.yaml", "-o", "pages/").exit_code == 0
    page = opened(tmp_path / "pages" / "attacked_0_ideal.html")
    page.page.evaluate("gudgeonApp.panel.set('parameters.omega', 40)")
    page.wait()
    page.page.evaluate("gudgeonApp.seek(0.05)")
    page.page.select_option("#g-scene", "s")
    page.page.wait_for_url("**/attacked_0_s.html#*")
    page.wait()
    assert page.page.evaluate("[gudgeonApp.description.scene, gudgeonApp.t]") == ["s", 0.05]
    assert page.same_bits(native.simulate(parameters={"omega": 40.0}))
    page.page.goto(
        f"{page.page.url.partition('#')[0]}#parameters.omega=nan&bodies.crank.inertia=&t=x&bodies.crank.mass=-1"
        "&bodies.rad.mass=1&bodies.rad.mass=1&t=-5"
    )
    page.page.reload()
    page.page.wait_for_function("document.getElementById('g-error').textContent")
    assert page.page.evaluate("gudgeonApp.panel.givenValues") == {"bodies.crank.mass": -1}
    assert "bodies.crank.mass is -1 kg: a mass is positive; expected > 0 kg" in page.error()
    assert page.page.inner_text("#g-note") == (
        "Not taken from the link: parameters.omega = nan (expected a number), bodies.crank.inertia = nothing"
        " (expected a number), t = x (expected a number), bodies.rad.mass = 1 (this scene has no such number),"
        f" t = -5 (the run has 0 to {page.page.evaluate('gudgeonApp.endTime')} s)."
    )
    assert page.same_bits(native.simulate())  # the file's numbers are what is shown
    page.page.goto(f"{page.page.url.partition('#')[0]}#bodies.crank.mass=300 g&t=50 ms")
    page.page.reload()
    page.page.wait_for_function("window.gudgeonApp?.run?.p && Object.keys(gudgeonApp.panel.givenValues).length")
    page.wait()
    assert page.page.evaluate("[gudgeonApp.panel.givenValues, gudgeonApp.t]") == [{"bodies.crank.mass": 0.3}, 0.05]
    assert page.page.inner_text("#g-note") == "" and page.complaints == []


def test_a_run_without_an_end_is_seen_and_stopped(opened: Any, tmp_path: Path) -> None:
    """A turn of a nanosecond: how far it is, a way to stop, a limit; the first picture does not wait for its end."""
    pytest.importorskip("ziglang")
    simulation = loader(tmp_path)(LONG, "s")
    shown = opened(written(tmp_path, simulation), PHONE)
    page, progress = shown.page, shown.page.locator("#g-progress")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390  # its title is one word
    assert page.evaluate("(([one]) => one.scrollWidth <= one.clientWidth)(document.getElementsByTagName('h1'))")
    page.evaluate("""() => { gudgeonApp.run = undefined;
        for (const one of document.querySelectorAll("#g-drawing path")) one.removeAttribute("d");
        gudgeonApp.panel.set("parameters.omega", 1e9); }""")
    progress.wait_for(state="visible")
    assert re.fullmatch(r"running: \S+ % after \d+ s; given up after 120 s", progress.locator("span").inner_text())
    assert page.evaluate("gudgeonApp.run === undefined && [...document.querySelectorAll('#g-drawing [d]')].length > 0")
    progress.locator("button").click()
    shown.wait()
    assert shown.error().startswith("stopped by hand at ") and "the run up to there" in shown.error()
    assert progress.is_hidden() and page.evaluate("gudgeonApp.run.q[2]") == 0.5
    page.evaluate("gudgeonApp.limit_s = 0.6; gudgeonApp.startRun()")
    page.wait_for_function("document.getElementById('g-error').textContent.startsWith('given up after 0.6 s at ')")
    assert page.evaluate("gudgeonApp.activeRun") is None
    page.locator(".g-reset").click()
    shown.wait()
    assert shown.error() == "" and shown.same_bits(simulation.simulate())
    assert shown.complaints == []


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("ziglang")
    return written(tmp_path_factory.mktemp("pendulum"), gudgeon.load("pendulum"))


def test_a_start_that_is_its_guess_is_closed_in_the_page(opened: Any, pendulum: Path) -> None:
    """A slider of a mechanism whose guess closes dependent equations: no start is followed from that of the file."""
    shown = opened(pendulum)
    assert "followed" not in shown.page.inner_text("#g-counts")
    shown.page.evaluate("gudgeonApp.panel.set('parameters.length', 1.1)")
    shown.wait()
    native = gudgeon.load("pendulum").simulate(parameters={"length": 1.1}, method="dop853")  # as pages
    assert shown.error() == ""
    for name in ("q", "v"):
        assert np.abs(shown.array(name) - np.ravel(getattr(native, name))).max() < 1e-9
    assert "followed" not in shown.page.inner_text("#g-counts")
    assert shown.complaints == []


def test_numbers_beyond_all_prefixes_have_none(opened: Any, press: Path) -> None:
    """A prefix and a power of ten are two powers of ten."""
    page = opened(press).page
    page.evaluate("""() => { const {run} = gudgeonApp, unit = run.unit.bind(run), name = gudgeonApp.values[0].name;
        run.unit = (one) => one === name ? "N*m" : unit(one);
        run.seriesCache.set(name, run.t.map((t, k) => [-1.555e299, 1.2e7, 1e-25][k] ?? 0));
        gudgeonApp.scales["N*m"] = 0; }""")
    for k, message in enumerate(("−1.555·10²⁹⁹ N·m", "12 MN·m", "1·10⁻²⁵ N·m")):
        page.evaluate("(k) => { gudgeonApp.seek(gudgeonApp.run.t[k]); gudgeonApp.showSample(); }", k)
        assert page.locator("#g-values tr").first.locator("td").all_inner_texts() == message.split(" ")


def test_constraints_drift_where_nothing_holds_them(opened: Any, pendulum: Path) -> None:
    """The pendulum in all its coordinates by rk4: with gains less than without, not at all when reduced."""
    shown, native = opened(pendulum), gudgeon.load("pendulum")
    page, place = shown.page, {slot.address: k for k, slot in enumerate(native.source.parameters)}
    worst = "Math.max(...gudgeonApp.run.series('Phi.max').slice(-250))"
    page.select_option("#g-run-method", "rk4")
    shown.wait()
    assert shown.error() == "" and shown.same_bits(native.simulate(method="rk4"))  # its step is estimated
    assert "estimated" in page.inner_text("#g-counts")
    page.fill("#g-run-t_end", "5000 ms")
    page.keyboard.press("Enter")
    shown.wait()
    assert shown.same_bits(native.simulate(5, method="rk4"))
    page.fill("#g-run-step", "0.01")
    page.keyboard.press("Enter")
    shown.wait()
    assert page.evaluate(worst) < 1e-14
    page.select_option("#g-run-formulation", "-full")
    page.wait_for_function(
        "gudgeonApp.description.rows.length && gudgeonApp.run.sim === gudgeonApp.sim && !gudgeonApp.activeRun"
    )
    drifts = []
    for gain in ("5", "0"):
        for name in ("alpha", "beta"):
            shown.type_into(place[f"baumgarte.{name}"], gain)
        drifts.append(page.evaluate(worst))
    held, free = drifts
    assert free > 10 * held > 1e-13
    gains = {"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0}
    assert shown.same_bits(native.full.simulate(5, method="rk4", step=0.01, parameters=gains))
    assert shown.complaints == []


def test_without_the_compiler_it_carries_one_run(opened: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ziglang", None)
    four_bar = gudgeon.load("four_bar")
    shown, run = opened(written(tmp_path, four_bar)), four_bar.simulate()
    assert "one run" in shown.page.inner_text("#g-note") and "gudgeon[web]" in shown.page.inner_text("#g-note")
    assert shown.page.evaluate("gudgeonState.sim") is None
    assert shown.page.evaluate("document.querySelectorAll('#g-parameters *').length") == 0
    assert len(shown.array("t")) == 400
    q = shown.array("q").reshape(400, -1)
    assert np.abs(q[-1] - run.q[-1]).max() < 1e-6 and np.abs(q[0] - run.q[0]).max() < 1e-6
    lines = shown.shown()[-4:]
    assert min(map(len, lines)) > 1000
    shown.page.evaluate("gudgeonApp.setPlaying(true)")
    shown.page.wait_for_function("gudgeonApp.k > 3")
    assert shown.complaints == []


def test_who_writes_the_page_of_a_run_that_fails_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ziglang", None)
    text = """
format: gudgeon/1
name: fails
bodies: {crank: {length: 50 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, crank.tail]}}
drives: {motor: {angle: crank, value: acos(t/(1 s))}}
scenes: {s: {simulate: {t_end: 2 s, output: 20}}}
"""
    (tmp_path / "fails.yaml").write_text(text, encoding="utf-8")
    with pytest.warns(UserWarning, match=r"up to its failure: drives\.motor\.value .* at t = 1 s"):
        written(tmp_path, gudgeon.load(tmp_path / "fails.yaml", "s"))
