"""Runs as moving pictures: what each picture of a page holds against the series, and that its script runs."""

from __future__ import annotations

import json
import re
import resource
import shutil
import subprocess
import tempfile
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.colors import to_rgb  # noqa: E402
from PIL import Image  # noqa: E402

import gudgeon  # noqa: E402
from gudgeon.drawing.insets import compute_eccentricity  # noqa: E402
from gudgeon.drawing.labels import find_overlaps  # noqa: E402
from gudgeon.drawing.page import _iterate_name_offsets  # noqa: E402
from gudgeon.drawing.roles import INK, TINTS  # noqa: E402
from gudgeon.drawing.shapes import Sketch  # noqa: E402
from gudgeon.errors import BadValueError, GudgeonError, OutputError, UnknownNameError  # noqa: E402
from gudgeon.results.figures.animation import (
    CONTACT_NOTE,
    check_animation_options,
    draw_sketches,
    find_contacts_between,
)  # noqa: E402
from gudgeon.results.figures.configurations import compute_configuration  # noqa: E402
from gudgeon.results.figures.mechanism_plots import find_contacts_at_configuration  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402


@pytest.fixture(scope="module")
def crank() -> Result:
    return gudgeon.load("slider_crank", "dry").simulate(0.02, output=40)


@pytest.fixture(scope="module")
def html(crank: Result) -> str:
    shown = crank.animate(seconds=0.8, rate=10.0, points=["rod.head"], velocities=True)
    assert shown is not None
    return shown.html


def frames(html: str) -> tuple[dict[str, Any], list[dict[str, Any]], list[list[Any]]]:
    """The page's data, with of each picture its paths by identifier and where names are, as the script decodes them."""
    data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', html)[1])  # type: ignore[index]
    for track in (data["frames"], data["places"]):
        for k in range(1, len(track)):
            track[k] = [before if x == 0 else x for before, x in zip(track[k - 1], track[k], strict=True)]
    names = re.findall(r'<path id="([^"]+)"/>', html)
    return data, [dict(zip(names, frame, strict=True)) for frame in data["frames"]], data["places"]


def disc(path: str) -> tuple[float, float, float]:
    """Centre and radius of a circle's path."""
    x, y, r = re.match(r"M([-\d.]+) ([-\d.]+)a([\d.]+)", path).groups()  # type: ignore[union-attr]
    return float(x) + float(r), float(y), float(r)


def test_each_picture_has_its_pins_where_the_run_has_them(crank: Result, html: str) -> None:
    """The crank's pin on its circle, within the rounding to a tenth of a pixel: scale and origin are the start's."""
    data, pictures, _ = frames(html)
    assert len(pictures) == 8 and data["seconds"] == 0.8
    assert data["times"] == pytest.approx(np.linspace(0.0, 0.02, 8), abs=1e-9)
    pivot = disc(pin(pictures[0], "O"))
    scale = (disc(pin(pictures[0], "crankpin"))[0] - pivot[0]) / 0.05
    for t, picture in zip(data["times"], pictures, strict=True):
        x, y, _ = disc(pin(picture, "crankpin"))
        angle = 20.0 * np.pi * t
        expected = scale * 0.05 * np.cos(angle), scale * 0.05 * np.sin(angle)
        assert (x - pivot[0], pivot[1] - y) == pytest.approx(expected, abs=0.4)
    assert scale > 1000.0


def pin(picture: dict[str, Any], joint: str) -> str:
    """The last circle of a joint: what is painted on top is its pin."""
    found = [shape[0] for name, shape in picture.items() if re.fullmatch(rf"joint-{joint}(-\d+)?", name) and shape]
    return [path for path in found if "a" in path][-1]


def test_a_page_needs_nothing_from_elsewhere(html: str) -> None:
    class Tags(HTMLParser):
        open: list[str] = []

        def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
            assert not {"src", "href"} & {name for name, _ in attributes}
            self.open += [tag] if tag not in ("meta", "input", "br", "path") else []

        def handle_endtag(self, tag: str) -> None:
            assert self.open.pop() == tag

        def handle_startendtag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
            pass

    parser = Tags()
    parser.feed(html)
    assert parser.open == [] and "http" not in html and "@import" not in html and "url(" not in html
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', html).groups())  # type: ignore[union-attr]
    assert 300 < width < 1000 and 100 < height < 1000 and not re.search("@[A-Z]+@", html)
    ids = re.findall(r'id="([^"]+)"', html)
    assert len(set(ids)) == len(ids) and {"path-rod.head", "body-slider", "inset-wristpin"} <= set(ids)


def test_a_title_is_text(crank: Result) -> None:
    title = "</script><b>@DATA@ & $x$"
    hostile = replace(crank, source=replace(crank.source, title=title), stored={})
    shown = hostile.animate(seconds=0.2, rate=10)
    assert shown is not None and "<b>" not in shown.html
    assert shown.html.count("&lt;/script&gt;&lt;b&gt;@DATA@ &amp; $x$: dry") == 3


def test_the_script_runs_to_the_last_picture(html: str, tmp_path: Path) -> None:
    """In node, on a page of stubs: it decodes all, shows the first, goes where the slider is put."""
    if shutil.which("node") is None:
        pytest.skip("needs node")
    data, pictures, places = frames(html)
    script = re.findall(r"<script>(.*?)</script>", html, re.S)[0]
    stub = """
const made = {};
const element = () => ({ at: {}, style: {}, setAttribute(k, v) { this.at[k] = v }, click() { this.onclick() } });
const several = n => Array.from({ length: n }, element);
const pages = { "svg path": several(PATHS), "#names text": several(TEXTS) };
const document = { getElementById: n => made[n] ??= n === "data" ? { textContent: DATA } : element(),
                   querySelectorAll: n => pages[n] };
const matchMedia = () => ({ matches: true }), requestAnimationFrame = () => 0;
"""
    raw = re.search(r'id="data">(.*?)</script>', html)[1]  # type: ignore[index]
    stub = stub.replace("PATHS", str(len(pictures[0]))).replace("TEXTS", str(len(places[0])))
    ask = """
made.time.value = 7; made.time.oninput();
const [drawn, named] = [pages["svg path"].map(p => p.at.d), pages["#names text"].map(p => p.at.x)];
console.log(JSON.stringify([drawn, made["time-text"].textContent, named]));
"""
    (tmp_path / "x.js").write_text(stub.replace("DATA", json.dumps(raw)) + script + ask)
    done = subprocess.run(["node", tmp_path / "x.js"], capture_output=True, text=True, check=True)
    drawn, message, xs = json.loads(done.stdout)
    assert drawn == [shape[0] if shape else "" for shape in pictures[7].values()]
    assert message == "t = 0.020000 s" and xs == [place[0] for place in places[7]]


def test_a_journals_number_moves_with_it(crank: Result, html: str) -> None:
    _, _, places = frames(html)
    message = [[place[2] for place in picture if len(place) > 2] for picture in places]
    assert all(len(texts) == 1 and texts[0].startswith("wristpin ×") for texts in message)
    last = crank["wristpin.eps"][-1]
    assert "e/c = 0.00" in message[0][0] and f"e/c = {last:.2f}" in message[-1][0]


def test_a_blow_between_two_pictures_is_seen(run: Result) -> None:
    """Of the made-up run: A is in contact from 0.11 to 0.12 s, and from 0.46 s on."""
    run.state[:] = 0
    assert find_contacts_between(run, 0.10, 0.109) == frozenset()
    assert find_contacts_between(run, 0.10, 0.111) == find_contacts_between(run, 0.119, 0.2) == frozenset({"A"})
    assert find_contacts_between(run, 0.13, 0.4) == frozenset() and find_contacts_between(run, 0.9, 1.0) == frozenset(
        {"A"}
    )


def test_red_is_what_is_at_that_time(crank: Result) -> None:
    """A red journal where e ≥ c at the picture's time; a red bearing where a contact came and went since the last."""
    expected = check_animation_options(crank, 1.0, len(crank.t), [], False, False)
    every = [*draw_sketches(crank, replace(expected, times=crank.t))]
    now = np.array(["touching" in roles(sketch) for sketch in every])
    since = np.array(["touched" in roles(sketch) for sketch in every])
    assert (now == (crank["wristpin.eps"] >= 1.0)).all() and now.any() and not now.all()
    on, off, t = crank.impacts["t_on"], np.nan_to_num(crank.impacts["t_off"], nan=np.inf), crank.t
    met = np.array([((on <= end) & (off >= begin)).any() for begin, end in zip(t, t[1:], strict=False)])
    assert (since[1:] == (met & ~now[1:])).all() and since.any()
    assert all(CONTACT_NOTE in sketch.notes for sketch in every)


def roles(sketch: Sketch) -> set[str]:
    return {shape.role for shape in sketch.of("inset wristpin")}


def test_between_samples_red_is_what_is_drawn(crank: Result) -> None:
    for t in (crank.t[1:] + crank.t[:-1]) / 2:
        configuration = compute_configuration(crank, float(t))
        ends = crank.source.clearances[0]
        overlaps = float(np.hypot(*compute_eccentricity(configuration, "wristpin"))) >= crank.p[ends.clearance]
        assert find_contacts_at_configuration(crank, configuration) == (
            frozenset({"wristpin"}) if overlaps else frozenset()
        )


def test_files(crank: Result, tmp_path: Path) -> None:
    assert crank.animate(tmp_path / "x.gif", seconds=0.3, rate=10) is None
    with Image.open(tmp_path / "x.gif") as film:  # few colours, those of a drawing among them: they stay what they are
        assert film.n_frames == 3 and film.info["duration"] == 150
        colours = {colour for _, colour in film.convert("RGB").getcolors(1 << 20)}
    expected = (np.array(to_rgb(colour)) * 255.0 for colour in ("#ffffff", INK, TINTS[0]))
    assert all(min(np.abs(np.subtract(one, other)).max() for other in colours) < 8.0 for one in expected)
    data = (tmp_path / "x.gif").read_bytes()
    assert data.startswith(b"GIF89a") and data.count(b"\x21\xf9\x04") == 3  # a control block for each picture
    shown = crank.animate(str(tmp_path / "x.HTML"), seconds=0.3, rate=10)
    assert shown is not None and (tmp_path / "x.HTML").read_text() == shown.html
    assert "<iframe" in shown._repr_html_() and "<script" not in shown._repr_html_()


@pytest.mark.parametrize("name", ["jansen_leg", "whitworth"])
def test_names_follow_and_lie_on_no_other(name: str) -> None:
    """A turn of the crank: each name keeps its place beside what it names until another name is there."""
    run = gudgeon.load(name).simulate()
    drawn = list(draw_sketches(run, check_animation_options(run, 1.6, 25.0, [], False, False)))
    scale = 700.0 / float(drawn[0].high[0] - drawn[0].low[0])
    halves = {label.part: np.array([3.5 * len(label.text), 6.0]) for label in drawn[0].labels}
    followed = list(_iterate_name_offsets(drawn, dict.fromkeys(halves, (0.0, 0.0)), halves, scale))[1:]
    fixed = still = moves = 0
    for sketch, before, now in zip(drawn[2:], followed, followed[1:], strict=False):
        middles = {label.part: scale * label.position + now[label.part] for label in sketch.labels}
        boxes = np.array([[*(at - halves[part]), *(at + halves[part])] for part, at in middles.items()])
        assert find_overlaps(boxes, boxes).sum() == len(boxes)
        moves += sum(before[part] != now[part] for part in now)
        still += sum(before[part] == now[part] for part in now)
        first = [scale * label.position + followed[0][label.part] for label in sketch.labels]
        boxes = np.array([[*(at - half), *(at + half)] for at, half in zip(first, halves.values(), strict=True)])
        fixed += int(find_overlaps(boxes, boxes).sum() > len(boxes))
    assert fixed > 0 and 0 < moves < 0.1 * still  # without following some would lie on others


def test_each_picture_is_told(crank: Result, tmp_path: Path) -> None:
    heard: list[tuple[float, str]] = []
    crank.animate(tmp_path / "x.gif", seconds=0.4, rate=10.0, progress=lambda *message: heard.append(message))
    assert heard == [(k / 4, f"picture {k + 1} of 4") for k in range(4)]
    with pytest.raises(BadValueError, match="progress"):
        crank.animate(progress=3)  # type: ignore[arg-type]


def test_what_cannot_be_is_told(crank: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    requested: Any = crank.animate
    for arguments, kind, message in (
        ({"path": tmp_path / "x.mp4"}, GudgeonError, "ffmpeg"),
        ({"path": tmp_path / "x.avi"}, BadValueError, ".gif, .mp4 or .html"),
        ({"path": tmp_path}, BadValueError, "expected a name"),
        ({"path": ""}, BadValueError, "is '': expected a name"),
        ({"path": "x.gif/"}, BadValueError, "x.gif/': expected a name"),
        ({"seconds": 0.0}, BadValueError, "above 0"),
        ({"seconds": 1e6}, BadValueError, "at most"),
        ({"points": ["rod.hed"]}, UnknownNameError, "nearest: rod.head"),
        ({"forces": "yes"}, BadValueError, "forces is"),
    ):
        with pytest.raises(kind, match=message):
            requested(**arguments)
    assert list(tmp_path.iterdir()) == []


def test_no_room_for_a_picture(crank: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A limit on the size of files, which takes effect as a full disk does; then no temporary folder."""
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    try:  # Python ignores SIGXFSZ: the write fails
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, old[1]))
        with pytest.raises(OutputError, match=r"x\.gif"):
            crank.animate(tmp_path / "x.gif", seconds=0.2, rate=10)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "none"))
    with pytest.raises(OutputError, match=r"x\.gif"):
        crank.animate(tmp_path / "x.gif", seconds=0.2, rate=10)
    assert list(tmp_path.iterdir()) == []


def test_a_page_follows_a_dark_desk(html: str) -> None:
    """The paper is dark and ink is turned light; in print it stays as it is."""
    dark = html.split("@media screen and (prefers-color-scheme: dark) {")[1].split("</style>")[0]
    assert "color-scheme: dark" in dark and re.search(r"svg \{ filter: invert", dark)
