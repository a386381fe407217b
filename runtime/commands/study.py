"""`gudgeon study`: a file of many runs, made, resumed and told."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from gudgeon.commands.common import check_folder, settings
from gudgeon.commands.progress import progress_bar, status_line
from gudgeon.language.shown import path_text
from gudgeon.studies.ensemble.estimate import estimate
from gudgeon.studies.ensemble.folder import StudyFolder
from gudgeon.studies.ensemble.plan import Plan
from gudgeon.studies.ensemble.study import plan_of, run_plan
from gudgeon.studies.ensemble.workers import workers
from gudgeon.studies.show.study import show_estimate, show_study

INTERRUPTED, FAILED = 130, 1


@dataclass(frozen=True)
class Request:
    """What the command is asked for, as typed."""

    file: str
    out: Path | None = None
    threads: int | None = None
    restart: bool = False
    sets: tuple[str, ...] = ()
    runs: bool = False
    json: bool = False
    workers: int | None = None
    cluster: str | None = None

    @property
    def folder(self) -> Path:
        """Where blocks and the dataset go."""
        return self.out or Path(f"{Path(self.file).stem}.study")


def study_file(request: Request) -> int:
    """Run what is missing, print what was found; 1 where every run failed."""
    given = settings(request.sets)
    if not request.runs:
        check_folder("--out", request.folder)
    with status_line(quiet=request.json):
        plan = plan_of(request.file, given)
    if request.runs:
        show_estimate(plan, estimate(plan, request.threads), request.json)
        return 0
    try:
        with workers(request.workers, request.cluster) as pool, progress_bar(request.json) as bar:
            report = bar(request.folder.stem)
            found = run_plan(plan, request.folder, request.threads, pool, report, request.restart)
    except KeyboardInterrupt:
        _interrupted(plan, request.folder)
        return INTERRUPTED
    show_study(plan, found, request.json)
    return FAILED if found.failed == found.runs else 0


def _interrupted(plan: Plan, folder: Path) -> None:
    opened = StudyFolder(folder, plan)
    there = sum(opened.has(block.number) for block in plan.blocks)
    told = f"{there} of {len(plan.blocks)} blocks of runs are in {path_text(folder)}"
    print(f"interrupted: {told}; the same command goes on from there", file=sys.stderr)
