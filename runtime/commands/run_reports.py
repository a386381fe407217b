"""What `gudgeon run` does with a scene besides: `--verify` checks its contacts, `--report` writes its page.

For a page each scene is run again, and its result is saved again with what that run showed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
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


def verify(runs: dict[str, Result], failures: dict[str, GudgeonError], quiet: bool) -> None:
    """Check the contacts of every run (Result.check); a run whose contacts are wrong goes to `failures` too."""
    for scene, run in runs.items():
        if not run.source.clearances:
            continue
        try:
            with status_line(quiet=quiet):
                found = run.check()
            notes = (*run.diagnostics.notes, *found.notes, f"{len(found.faults) or 'no'} faults of contacts at"
                     f" {found.samples} samples")  # fmt: skip
            runs[scene] = replace(run, diagnostics=replace(run.diagnostics, notes=notes))
            found.raise_faults()
        except GudgeonError as error:
            failures.setdefault(scene, error)


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
