"""Pages in a real Chromium without a window: what the tests of pages share."""

from __future__ import annotations

import base64
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.page import build_page
from tests.programs import missing
from tests.web.node import browser

DESK, PHONE = {"width": 1366, "height": 900}, {"width": 390, "height": 844}
READY = "window.gudgeonApp && gudgeonApp.run && !gudgeonApp.activeRun"
BITS = """name => { const bytes = new Uint8Array(Float64Array.from(gudgeonApp.run[name]).buffer);
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")); }"""
C, SECTION = "#g-parameter-3", ".g-section:has(#g-parameter-{})"


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    program = browser()
    if program is None:
        missing("no Chromium is installed: apt-get install chromium")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("playwright is not installed: pip install 'gudgeon[test]'")
    with sync_playwright() as drivers:
        opened = drivers.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield opened
        opened.close()


def written(folder: Path, simulation: Simulation) -> Path:
    file = folder / "page.html"
    file.write_text(build_page(simulation), encoding="utf-8")
    return file


@pytest.fixture(scope="session")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("matplotlib")
    pytest.importorskip("ziglang", reason="the extra web is not installed: no compiler for pages")
    return written(tmp_path_factory.mktemp("press"), gudgeon.load("nine_bar_press", "lubricated"))


class Opened:
    """A page, what it complained of, and what it shows."""

    def __init__(self, page: Any, file: Path) -> None:
        self.page, self.complaints = page, list[str]()
        page.on("console", lambda message: self.heard(message.text if message.type in ("error", "warning") else ""))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda requested: self.heard("" if requested.url.startswith("file:") else requested.url))
        page.goto(file.as_uri())
        self.wait()

    def heard(self, complaint: str) -> None:
        self.complaints += [complaint] if complaint else []

    def wait(self) -> None:
        self.page.wait_for_function(READY)
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def array(self, name: str) -> Any:
        return np.frombuffer(base64.b64decode(self.page.evaluate(BITS, name)))

    def same_bits(self, run: Result) -> bool:
        return all(np.array_equal(self.array(name), np.ravel(getattr(run, name))) for name in ("t", "q", "v"))

    def type_into(self, k: int, text: str) -> None:
        """A number of the file, in its unit."""
        self.page.evaluate("(k) => { document.querySelector(k).open = true; }", SECTION.format(k))
        field = self.page.locator(f"#g-parameter-{k} + input")
        field.fill(text)
        field.press("Enter")
        self.wait()

    def error(self) -> str:
        return str(self.page.evaluate("document.getElementById('g-error').textContent"))

    def shown(self) -> list[str]:
        """Path data of traces and of what moves in the drawing."""
        message = (
            "[...document.querySelectorAll('.g-chart .g-line, #g-drawing path')].map((one) => one.getAttribute('d'))"
        )
        return list(self.page.evaluate(message))


Opening = Callable[..., Opened]


@contextmanager
def _contexts(chromium: Any) -> Iterator[Opening]:
    contexts: list[Any] = []

    def opening(file: Path, viewport: dict[str, int] = DESK, scheme: str = "light") -> Opened:
        contexts.append(chromium.new_context(viewport=viewport, color_scheme=scheme))
        return Opened(contexts[-1].new_page(), file)

    yield opening
    for context in contexts:
        context.close()


@pytest.fixture
def opened(chromium: Any) -> Iterator[Opening]:
    """Opens pages of one test."""
    with _contexts(chromium) as opening:
        yield opening


@pytest.fixture(scope="module")
def opened_once(chromium: Any) -> Iterator[Opening]:
    """Opens pages that the tests of a file share."""
    with _contexts(chromium) as opening:
        yield opening
