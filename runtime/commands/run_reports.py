"""`gudgeon run --report`: each scene run beside itself, its result saved again with what that told, and its page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.commands.progress import status_line
from gudgeon.errors import GudgeonError, MemoryShortage
from gudgeon.files.writing import write_bytes
from gudgeon.simulation.examine import examine

if TYPE_CHECKING:
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation


def report_path(out: Path, mechanism: str, scene: str) -> Path:
    """Where the page of a scene goes: beside its result."""
    return out / f"{mechanism}_{scene}.html"


def write_reports(
    runs: dict[str, Result], simulations: Mapping[str, Simulation], references: Mapping[str, Result], out: Path,
    save: Callable[[Mapping[str, Result]], None], files: dict[str, str], unwritten: list[GudgeonError], quiet: bool,
) -> None:  # fmt: skip
    """Fills `files` and `unwritten`; `runs` are then the examined ones. A run that Ctrl-C ended is told as it is."""
    for scene, run in runs.items():
        try:
            if not run.diagnostics.interrupted:
                with status_line(quiet=quiet):
                    runs[scene] = run = examine(simulations[scene], run, references.get(scene))
                save({scene: run})
            path = report_path(out, run.source.mechanism, scene)
            write_bytes(path, run.report().to_html().encode())
            files[f"report {scene}"] = str(path)
        except GudgeonError as error:
            unwritten.append(error)
        except MemoryError as error:
            unwritten.append(MemoryShortage(error))
