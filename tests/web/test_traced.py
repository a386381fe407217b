"""A page whose equations are traced: what is selected is lit, with the values that the run on the page gives it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402
from tests.web.chromium import Opened  # noqa: E402

# the lit lines of C: file, text, value; seen one by one, because values are filled in where they are seen
LINES = """async (token) => {
    gudgeonHighlighting.highlight([token]);
    document.getElementById("gudgeon-lines").style.maxHeight = "none";
    for (let k = 0; k < 4; k++) await new Promise((done) => requestAnimationFrame(done));
    return [...document.querySelectorAll("#gudgeon-lines .line")].map((one) =>
        [one.dataset.c, one.firstChild?.textContent ?? "", one.querySelector("output")?.textContent ?? ""]);
}"""
STORES = re.compile(r"^\s*(?:const double )?(?:\w|->|\[\d+\])+ = .*;")
# of each mark that is shown in a plot: where it is across, its dots, the plot's curves
MARKS = """() => [...document.querySelectorAll("g.state-marker[visibility=visible]")].map((mark) => [
    Number(mark.getAttribute("transform").match(/[\\d.]+/)[0]),
    [...mark.querySelectorAll("circle")].map((dot) => Number(dot.getAttribute("cy"))),
    [...mark.parentNode.querySelectorAll("polyline")].map((curve) =>
        curve.getAttribute("points").split(" ").map((point) => point.split(",").map(Number)))])"""
COUNT = "(of) => [...document.querySelectorAll(of)].filter((one) => !one.closest('#gudgeon-lines')).length"
SAMPLE = 300
NOT_RUN = "\u2013"


RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")


def number(text: str) -> float:
    return 0.0 if text == "≈ 0" else float(text.replace("·10", "e").translate(RAISED))


@pytest.fixture(scope="module")
def typed(opened_once: Any, press: Path) -> tuple[Opened, Result]:
    """A page on which all lit lines are seen, with a clearance of its own, and the native run with it."""
    shown = opened_once(press, {"width": 1366, "height": 4000})
    shown.type_into(3, "0.4")
    return shown, gudgeon.load("nine_bar_press", "lubricated").simulate(parameters={"c": "0.4 mm"})


def seek(shown: Opened, k: int) -> None:
    shown.page.evaluate("(k) => gudgeonApp.seek(gudgeonApp.run.t[k])", k)
    shown.wait()


def test_a_row_lights_its_lines_with_the_run_s_values(typed: tuple[Opened, Result]) -> None:
    """Each row of Φ: the file, the row, its entries, γ, and lines of C, of which each has the value at this time."""
    (shown, run), native = typed, gudgeon.load("nine_bar_press", "lubricated")
    page = shown.page
    seek(shown, SAMPLE)
    t, q, v = float(run.t[SAMPLE]), run.q[SAMPLE], run.v[SAMPLE]
    phi, gamma = native.compiled.phi(t, q, run.p), native.compiled.gamma(t, q, v, run.p)
    phi_q = native.compiled.phi_q(t, q, run.p)
    for k, row in enumerate(native.source.equations):
        lines = page.evaluate(LINES, f"row-{k + 1}")
        stored = [(file, text, value) for file, text, value in lines if STORES.match(text)]
        assert len(stored) > 10 and all(value for _, _, value in stored), row
        of = {text.split(" = ")[0].split()[-1]: number(value) for _, text, value in stored if value}
        assert of[f"rhs->lambda[{k}]"] == pytest.approx(run[f"lambda.{row.name}"][SAMPLE], rel=1e-4)
        entries = [of[name] for name in of if name.startswith("phi_q[")]
        assert sorted(entries) == pytest.approx(sorted(phi_q[k][np.flatnonzero(phi_q[k])]), rel=1e-4)
        assert any(x == pytest.approx(gamma[k], rel=1e-4) for name, x in of.items() if name.startswith("gamma_rows["))
        assert any(abs(x - phi[k]) < 1e-15 for name, x in of.items() if name.startswith("phi["))
        for what in (".listing .X", ".equation.X, .X .equation, tr.X", "svg .X"):
            assert page.evaluate(COUNT, what.replace("X", "highlighted")) > 0, (row, what)
    assert shown.complaints == []


def test_a_law_s_lines_are_of_the_joint_that_is_lit(typed: tuple[Opened, Result]) -> None:
    """Of the first where none is; what is not run at the time is told."""
    shown, run = typed
    seek(shown, SAMPLE)
    for token, joint in (("joint-A", "A"), ("joint-B", "B"), ("law-oil", "A")):
        lines = [(text, value) for file, text, value in shown.page.evaluate(LINES, token) if file == "clearance.c"]
        of = {text.split(" = ")[0].strip(): number(value) for text, value in lines if value not in ("", NOT_RUN)}
        assert of["*F_r_out"] == pytest.approx(-run[f"{joint}.Fn"][SAMPLE], rel=1e-4), token
        assert of["*F_t_out"] == pytest.approx(run[f"{joint}.Ft"][SAMPLE], rel=1e-4), token
        assert all(value for text, value in lines if STORES.match(text.replace("*", "")))
        assert [value for text, value in lines if text.strip().startswith("*F_n_out")] == [NOT_RUN]
    message = shown.page.evaluate("document.querySelector('#gudgeon-lines p').textContent")
    assert f"{NOT_RUN}: not run" in message and shown.complaints == []


def test_a_joint_s_state_is_marked_on_each_curve(typed: tuple[Opened, Result]) -> None:
    """The film's two, at moments at which the eccentricity is within the plot; the dots lie on the curves."""
    (shown, run), found = typed, 0
    shown.page.evaluate("[...document.querySelectorAll('g.state-marker')].at(-1).closest('svg').scrollIntoView()")
    shown.wait()
    for k in np.flatnonzero(run["A.e"] / run.parameters["c"] < 0.85)[:: len(run.t) // 6]:
        seek(shown, int(k))
        for x, dots, curves in shown.page.evaluate(MARKS):
            assert len(dots) == len(curves) > 0
            found += 1
            for y, curve in zip(dots, curves, strict=True):
                assert y == pytest.approx(np.interp(x, *np.transpose(curve)), abs=0.3)
    assert found >= 3


def test_lines_of_parameters_have_the_numbers_that_were_typed(typed: tuple[Opened, Result]) -> None:
    shown, _ = typed
    lines = shown.page.evaluate(LINES, "joint-A")
    stored = [(text.split(" = ")[0], value) for _, text, value in lines if text.startswith("    p->") and " = " in text]
    message = {name.strip(): value for name, value in stored}
    assert number(message["p->c_"]) == number(message["p->pin_clearance_"]) == 4e-4
    row = shown.page.locator(".equation[role=button]").first
    row.focus()
    shown.page.keyboard.press("Enter")
    assert row.get_attribute("aria-pressed") == "true"
    shown.page.keyboard.press("Escape")
    assert row.get_attribute("aria-pressed") == "false"
    assert shown.page.evaluate("document.querySelectorAll('.highlighted').length") == 0
    assert shown.complaints == []


PICKED = """() => {
    const terms = [...document.querySelectorAll(".equation[data-pick^=row-] [data-of*='name-']")];
    const term = terms.find((one) => /^entry-\\d+-\\d+ name-\\w+$/.test(one.dataset.of) && terms.filter((other) =>
        other.dataset.of.endsWith(one.dataset.of.split(" ")[1])).length > 1); // a coordinate, in more rows than one
    gudgeonHighlighting.select(term);
    const lit = [...document.querySelectorAll(".highlighted")].map((one) => one.dataset.of);
    return [term.dataset.of.split(" "), lit, document.querySelector("#gudgeon-lines pre").textContent];
}"""


def test_a_term_lights_the_sums_that_it_is_in(opened: Any, press: Path) -> None:
    """The line that sums its row, its entry in each row that has it, and the line of the file that says so."""
    shown = opened(press)
    of, lit, lines = shown.page.evaluate(PICKED)
    name = next(token for token in of if token.startswith("name-")).removeprefix("name-")
    named = [one.split() for one in lit if f"name-{name}" in one.split()]
    entries = {token for of in named for token in of if token.startswith("entry-")}
    assert len(entries) > 1 and re.search(r"\bphi\[\d+\] = ", lines)
    assert all(any(entry in one.split() for one in lit if "name-" not in one) for entry in entries)
    assert "revolute" in lines and "nine_bar_press.yaml" in shown.page.inner_text("#gudgeon-lines p")
