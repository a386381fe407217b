"""Reports of a run and of a study in Chromium: nothing is asked for, nothing sticks out of a phone, dark is dark."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import gudgeon
from tests.programs import needs_compiler
from tests.slow import slow_but
from tests.web.chromium import DESK, PHONE

pytestmark = needs_compiler


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    pytest.importorskip("matplotlib")
    folder = tmp_path_factory.mktemp("reports")
    simulation = gudgeon.load("bouncing_ball", "damped")
    run = gudgeon.examine(simulation, simulation.simulate(1.0))
    study = gudgeon.study(
        {
            "mechanism": "bouncing_ball",
            "scenes": ["elastic", "damped"],
            "t_end": 0.6,
            "output": 30,
            "parameters": {"height": [0.5, 1.0], "contacts.damped.normal.stiffness": [1e8, 2e8]},
            "keep": ["ball.y"],
            "measures": {"hits": {"impacts": "fall"}, "force": {"peak_force": "fall"}},
        }
    )
    (folder / "run.html").write_text(run.report().to_html(), encoding="utf-8")
    (folder / "study.html").write_text(study.report().to_html(), encoding="utf-8")
    return [folder / "run.html", folder / "study.html"]


DEVICES = [(DESK, "light"), (PHONE, "light"), (DESK, "dark"), (PHONE, "dark")]


@pytest.mark.parametrize("device", slow_but([(DESK, "light"), (PHONE, "dark")], DEVICES))
def test_pages_fit_and_ask_for_nothing(chromium: Any, pages: list[Path], device: tuple[dict[str, int], str]) -> None:
    size, scheme = device
    context = chromium.new_context(viewport=size, color_scheme=scheme)
    for file in pages:
        page, requested, messages = context.new_page(), list[str](), list[str]()
        page.on("request", lambda request, requested=requested: requested.append(request.url))
        page.on("console", lambda line, messages=messages: messages.append(line.text))
        page.goto(file.as_uri())
        assert [url for url in requested if not url.startswith("data:")] == [file.as_uri()] and not messages
        assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
        paper = page.evaluate("getComputedStyle(document.querySelector('.g-report')).backgroundColor")
        assert (paper == "rgb(255, 255, 255)") == (scheme == "light")
        page.emulate_media(media="print", color_scheme=scheme)
        paper = page.evaluate("getComputedStyle(document.querySelector('.g-report')).backgroundColor")
        assert paper == "rgb(255, 255, 255)"
    context.close()
