"""What a class does with a page: sliders to their ends, forces of a moment, what rounding leaves, a drift in Python."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.errors import AssemblyError  # noqa: E402
from gudgeon.language.units import UNITS, make_dimension  # noqa: E402
from gudgeon.model.parameters import compute_parameter_values  # noqa: E402
from gudgeon.web import drift  # noqa: E402
from gudgeon.web.parameter_panel import build_parameter_sections, list_units  # noqa: E402
from tests.web.chromium import written  # noqa: E402


def test_sliders_reach_nothing_that_is_refused() -> None:
    """A clearance follows the parameter c: zero is the end of its condition, and no end of the slider."""
    press = gudgeon.load("nine_bar_press", "lubricated")
    ends = [
        (one["k"], one[end])
        for group in build_parameter_sections(press, press.p)
        for one in group["numbers"]
        for end in ("low", "high")
        if end in one
    ]
    assert len(ends) > 100
    for k, end in ends:
        compute_parameter_values(press.compiled, {press.source.parameters[k].address: end})
    c = next(
        one for group in build_parameter_sections(press, press.p) for one in group["numbers"] if one["name"] == "c"
    )
    assert 0.0 < c["low"] < 1e-2 * c["high"]


def test_units_that_a_field_takes_are_those_of_its_dimension() -> None:
    source = gudgeon.load("nine_bar_press", "lubricated").source
    used = list_units(source)
    assert used["m"]["mm"] == 1e-3 and used["s"]["ms"] == 1e-3 and used["1/s"]["rpm"] == pytest.approx(np.pi / 30)
    for slot in source.parameters:
        for name in used[slot.unit] if not slot.words else ():
            assert UNITS[name][1] == make_dimension(*slot.dimension)


def test_python_for_a_drift_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """As the page of a driven mechanism shows it, and that of a scene whose full formulation it does not carry."""
    four_bar, pendulum = gudgeon.load("four_bar"), gudgeon.load("pendulum")
    assert drift.explain_missing_drift(pendulum, pendulum.simulate(), 10, 10) is None
    opens = []
    for scene in (four_bar, pendulum):
        message = drift.explain_missing_drift(scene, scene.simulate(), 70_000, 62_000)
        assert message is not None and ("70 kB" in message["note"]) == (scene is pendulum)
        exec(message["code"], {})
        opens.append([float(line.split()[-1]) for line in capsys.readouterr().out.splitlines()])
    (free, held, pushed), (of_pendulum, _, projected) = opens
    assert 1e-5 < free < 1e-3 and held < 0.1 * free and pushed > 10 * held  # over five turns
    assert 0.0 < projected < 1e-10 and 1e-16 < of_pendulum < 1e-4


@pytest.fixture(scope="module")
def page_of_four_bar(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("ziglang")
    return written(tmp_path_factory.mktemp("four_bar"), gudgeon.load("four_bar"))


def test_forces_of_a_moment_and_what_rounding_leaves(opened: Any, page_of_four_bar: Path) -> None:
    """The longest arrow is the largest force of its sample; below 1e-9 of the largest of its kind nothing is told."""
    four_bar = gudgeon.load("four_bar")
    shown, run = opened(page_of_four_bar), four_bar.simulate()
    page, joints = shown.page, [joint.name for joint in four_bar.source.joints]
    page.check("#g-show-forces")
    for k in (137, 500):
        page.evaluate("(k) => gudgeonApp.seek(gudgeonApp.run.t[k])", k)
        shown.wait()
        longest = page.inner_text("#g-force-scale").split(": ")[1].split()
        size = max(float(np.hypot(run[f"{name}.Fx"][k], run[f"{name}.Fy"][k])) for name in joints)
        scale = {"mN": 1e-3, "N;": 1.0, "N": 1.0, "kN;": 1e3, "mN;": 1e-3}[longest[1]]
        assert float(longest[0]) * scale == pytest.approx(size, rel=6e-3)
    force = max(float(np.abs(run[f"{name}.F"]).max()) for name in joints)
    none = "(x) => [gudgeonApp.isRoundingError(x, 'N'), gudgeonApp.isRoundingError(-x, 'N')]"
    assert page.evaluate(none, 0.9e-9 * force) == [True, True] and page.evaluate(none, 1.1e-9 * force) == [False, False]
    assert page.evaluate("['1.25e-17', '-3e-9', '0.5'].map((x) => gudgeonValues.formatValue(Number(x)))") == [
        "1.25·10⁻¹⁷",
        "−3·10⁻⁹",
        "0.5",
    ]
    assert "drifts" in page.inner_text("#g-parameters") and shown.complaints == []


BOX = "[...document.querySelectorAll('.g-section')].find((one) => one.textContent.startsWith('Baumgarte'))"
ONE_SAMPLE = """() => {
    const {run} = gudgeonApp, n = run.sim.n, one = new run.constructor(run.sim, run.t.slice(0, 1));
    const rows = Object.entries({q: n, v: n, a: n, work: 3}).map(([name, width]) => [name, run[name].slice(0, width)]);
    Object.assign(one, Object.fromEntries(rows), {memory: run.memory.slice(0, 1), counts: {steps: 1}});
    gudgeonApp.showRun(one);
    gudgeonApp.seek(1);
}"""


def test_a_driven_page_keeps_its_rows_where_it_is_asked_to(opened: Any, page_of_four_bar: Path) -> None:
    """Gains are shown where they act; Φ drifts without them. A guess that only Python follows; a run of one sample."""
    four_bar = gudgeon.load("four_bar")
    shown = opened(page_of_four_bar)
    page, place = shown.page, {slot.address: k for k, slot in enumerate(four_bar.source.parameters)}
    worst = "Math.max(...gudgeonApp.run.series('Phi.max').slice(-250))"
    assert page.evaluate(f"{BOX}.hidden") and page.evaluate(worst) < 1e-14 and shown.same_bits(four_bar.simulate())
    page.select_option("#g-run-method", "rk4")
    shown.wait()
    specified = page.inner_text("#g-counts"), page.inner_text("#g-parameters")  # the gains of the file, 50 1/s
    assert (
        "steps of 16.67 ms" in specified[0] and "2αh = 1.7 is too much" in specified[1] and "Some 6 1/s" in specified[1]
    )
    first = [page.evaluate(worst)]
    for gain in ("6", "0"):
        for name in ("alpha", "beta"):
            shown.type_into(place[f"baumgarte.{name}"], gain)
        first.append(page.evaluate(worst))
        assert f"{'is small enough' if gain == '6' else 'holds nothing'}" in page.inner_text("#g-parameters")
    pushed, held, free = first
    assert pushed > 2 * free > 6 * held > 1e-8  # the drift is seen in one turn, and where a gain hurts
    page.fill("#g-run-step", "20 ms")
    page.fill("#g-run-t_end", "20")
    page.keyboard.press("Enter")
    shown.wait()
    assert not page.evaluate(f"{BOX}.hidden")
    drifts = []
    for gain in ("5", "0"):
        for name in ("alpha", "beta"):
            shown.type_into(place[f"baumgarte.{name}"], gain)
        drifts.append(page.evaluate(worst))
    assert drifts[1] > 30 * drifts[0] > 1e-9 and shown.error() == ""
    page.select_option("#g-run-method", "kinematic")
    shown.wait()
    assert page.evaluate(f"{BOX}.hidden") and page.evaluate(worst) < 1e-14
    page.click(".g-reset")
    shown.type_into(place["start.guess.coupler.theta"], "120")
    assert shown.error() == "" and "near its guess Python may find another" in page.inner_text("#g-counts")
    with pytest.warns(UserWarning, match="from its guess"):
        native = four_bar.simulate(parameters={"start.guess.coupler.theta": "120 deg"})
    assert np.abs(shown.array("q")[:9] - native.q[0]).max() < 1e-9
    shown.type_into(place["bodies.coupler.length"], "1000")
    message, call = shown.error().split(" Python searches on and runs from what it finds: ")
    assert "Cause: bodies.coupler.length = 1000 mm" in message
    with pytest.raises(AssemblyError, match="cannot be assembled"):
        eval(call.partition(". What is shown")[0], {"gudgeon": gudgeon})
    page.click(".g-reset")
    shown.wait()
    page.evaluate(ONE_SAMPLE)
    shown.wait()
    assert page.inner_text("#g-counts").startswith("the run ends where it begins: 1 step, ")
    assert page.is_disabled("#g-time") and shown.complaints == []
