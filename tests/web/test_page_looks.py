"""The page that runs, in a real Chromium without a window: names, keys, colours, a phone and a printer."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.drawing.labels import find_overlaps  # noqa: E402
from tests.web.chromium import DESK, PHONE, Opened  # noqa: E402


@pytest.fixture(scope="module")
def seen_before(opened_once: Any, press: Path) -> Opened:
    shown: Opened = opened_once(press)
    return shown


@pytest.fixture
def seen(seen_before: Opened) -> Iterator[Opened]:
    """The press's page, for tests that change no number of it: what they look at it with is put back."""
    yield seen_before
    page = seen_before.page
    page.set_viewport_size(DESK)
    page.emulate_media(media="screen", color_scheme="light")
    page.evaluate("gudgeonApp.setPlaying(false); gudgeonApp.seek(0); scrollTo(0, 0)")
    seen_before.wait()
    assert seen_before.complaints == []


def test_the_state_is_announced_at_each_sample(seen: Opened) -> None:
    heard = seen.page.evaluate("""new Promise((done) => {
        document.addEventListener("gudgeon:state", ({detail: {sim, run, k, t, q, v, p}}) =>
            done([sim === gudgeonApp.sim, run === gudgeonApp.run, k, t, q.length, v.length, p === run.p,
                window.gudgeonState.k]), {once: true});
        gudgeonApp.seek(0.5);
    })""")
    assert heard == [True, True, 500, 0.5, 24, 24, True, 500]
    assert seen.page.evaluate("document.querySelector('#g-drawing [data-of~=joint-A]') !== null")
    assert seen.page.evaluate("document.querySelector('#g-drawing [data-of~=body-L1]') !== null")


NAMES = """() => [...Array(200).keys()].map((i) => {
    gudgeonApp.seek(gudgeonApp.run.t[0] + i / 199 * gudgeonApp.duration);
    gudgeonApp.showSample();
    return gudgeonApp.drawing.visibleLabels.map(({element, anchor, plannedOffset}) => {
        const {x, y, width, height} = element.getBBox(), {e, f} = element.transform.baseVal[0].matrix;
        return [e - width / 2, f - height / 2, e + width / 2, f + height / 2, ...anchor, ...plannedOffset];
    });
})"""


def test_names_follow_and_lie_on_no_other(seen: Opened) -> None:
    """A turn of the press: each keeps its place beside what it names until another one is there."""
    message = np.array(seen.page.evaluate(NAMES))
    rounded = 0.2 * np.array([1.0, 1.0, -1.0, -1.0])  # places are written to a tenth
    middles = (message[..., :2] + message[..., 2:4]) / 2
    fixed = 0
    for names, middle in zip(message, middles, strict=True):
        assert find_overlaps(names[:, :4] + rounded, names[:, :4] + rounded).sum() == len(names)
        off = names[:, 4:6] + names[:, 6:] - middle
        planned = names[:, :4] + np.hstack([off, off]) + rounded
        fixed += int(find_overlaps(planned, planned).sum() > len(names))
    beside = middles - message[..., 4:6]
    moves = (np.abs(np.diff(beside, axis=0)).max(axis=-1) > 0.3).sum()
    assert fixed > 0 and 0 < moves < 0.02 * beside[..., 0].size  # without following some would lie on others


def test_sizes(seen: Opened, press: Path) -> None:
    seen.page.set_viewport_size(PHONE)
    assert seen.page.evaluate("document.documentElement.scrollWidth") <= 390
    assert press.stat().st_size < 400_000


LABELS = """() => [...document.querySelectorAll("#gudgeon-app :is(button, input, select, summary)")].filter((one) => {
    const named = one.getAttribute("aria-label") || one.labels?.[0]?.textContent.trim() || one.textContent.trim();
    return !named || one.tabIndex < 0;
}).map((one) => one.outerHTML)"""


def test_keys_reach_everything(seen: Opened) -> None:
    """Each thing has a name; Tab goes through all in sight, and where it is can be seen."""
    page = seen.page
    assert page.evaluate(LABELS) == []
    page.evaluate("document.getElementById('g-play').focus()")
    page.keyboard.press("Space")
    assert page.inner_text("#g-play") == "Pause"
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    at = page.evaluate("document.activeElement.id")
    page.keyboard.press("End")
    seen.wait()
    assert (at, page.evaluate("gudgeonApp.t")) == ("g-time", 1.0)
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        message = page.evaluate("""() => { const one = document.activeElement, look = getComputedStyle(one);
            return [one.id || one.textContent.slice(0, 20), look.outlineStyle, look.outlineWidth,
                one.closest("#gudgeon-app") !== null]; }""")
        if not message[3]:
            break
        assert message[1] == "solid" and message[2] == "2px", message
        reached.add(message[0])
    assert {"g-speed", "g-show-names", "g-show-forces", "g-run-method", "g-parameter-3", "g-add-trace"} <= reached


# of each text its colour's contrast with what lies behind it (WCAG 2.2, 1.4.3), the worst first
CONTRAST = """() => {
    const canvas = new OffscreenCanvas(1, 1).getContext("2d", {willReadFrequently: true});
    const rgb = (colour) => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
        return [...canvas.getImageData(0, 0, 1, 1).data]; };
    const light = ([r, g, b]) => { const [x, y, z] = [r, g, b].map((c) => c / 255).map((c) =>
        c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4); return 0.2126 * x + 0.7152 * y + 0.0722 * z; };
    const behind = (one) => { for (; one; one = one.parentElement) {
        const colour = rgb(getComputedStyle(one).backgroundColor); if (colour[3] > 0) return colour; }
        return rgb("white"); };
    const app = document.getElementById("gudgeon-app"), found = [];
    app.querySelectorAll("details").forEach((one) => { one.open = true; });
    for (const one of app.querySelectorAll("*")) {
        const text = [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
        if (!(text || one.matches("input[type=text], select")) || !one.getClientRects().length) continue;
        const look = getComputedStyle(one), of_svg = one instanceof SVGElement;
        const [a, b] = [light(rgb(of_svg ? look.fill : look.color)), light(behind(one))];
        found.push([(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), one.outerHTML.slice(0, 90)]);
    }
    return found.sort((x, y) => x[0] - y[0]);
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stands_out(seen: Opened, scheme: str) -> None:
    seen.page.emulate_media(color_scheme=scheme)
    seen.wait()
    found = seen.page.evaluate(CONTRAST)
    assert len(found) > 150
    assert [one for one in found if one[0] < 4.5] == []


def test_what_is_wide_is_read_whole_on_a_phone_and_in_print(seen: Opened) -> None:
    """No table or drawing scrolls sideways at 390 pixels, nor any by a pixel up and down; in print nothing is cut, nor
    shaded as if it were."""
    page = seen.page
    page.set_viewport_size(PHONE)
    style = page.add_style_tag(content="* { content-visibility: visible !important; }")
    cut = """(of) => [...document.querySelectorAll(of)].filter((one) => one.scrollWidth > one.clientWidth + 1).length"""
    assert page.evaluate(cut, "body > table, .sketch, .sketch pre") == 0
    high = cut.replace("Width + 1", "Height").replace("Width", "Height")
    assert page.evaluate(high, "body > :is(table, figure, .equation)") == 0
    page.emulate_media(media="print")
    shaded = """() => [...document.querySelectorAll("body > :is(table, pre, figure, .equation)")].filter((one) =>
        getComputedStyle(one).backgroundImage !== "none" || getComputedStyle(one).overflowX !== "visible").length"""
    assert page.evaluate(shaded) == 0
    style.evaluate("(one) => one.remove()")


def test_the_panel_s_foot_is_seen_and_traces_stand_below_the_drawing(seen: Opened) -> None:
    page = seen.page
    page.set_viewport_size({"width": 1280, "height": 900})
    box = {of: page.locator(of).bounding_box() for of in (".g-reset", "#g-parameters", ".g-stage", ".g-traces")}
    assert box[".g-reset"]["y"] + box[".g-reset"]["height"] <= 900
    gap = box[".g-traces"]["y"] - box[".g-stage"]["y"] - box[".g-stage"]["height"]
    assert 0 <= gap < 40 < box["#g-parameters"]["height"]


def test_print_has_no_controls(seen: Opened) -> None:
    page = seen.page
    page.emulate_media(media="print", color_scheme="dark")
    message = """[...document.querySelectorAll("#gudgeon-app :is(button, input, select, details)")]
        .filter((one) => one.getClientRects().length).map((one) => one.outerHTML)"""
    assert page.evaluate(message) == []
    assert page.evaluate("document.querySelector('.g-chart .g-print').getClientRects().length") > 0
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
