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
from gudgeon.studies.ensemble.plan import Plans
from gudgeon.studies.ensemble.study import plans_of, run_plans
from gudgeon.studies.show.study import show_estimates, show_studies

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
        plans = plans_of(request.file, given)
    if request.runs:
        estimates = {name: estimate(plan, request.threads) for name, plan in plans.each.items()}
        show_estimates(plans, estimates, request.json)
        return 0
    try:
        with progress_bar(request.json) as bar:
            found = run_plans(plans, request.folder, request.threads, None, bar(request.folder.stem), request.restart)
    except KeyboardInterrupt:
        _interrupted(plans, request.folder)
        return INTERRUPTED
    show_studies(plans, found, request.json)
    return FAILED if found.failed == found.runs else 0


def _interrupted(plans: Plans, folder: Path) -> None:
    every = [(StudyFolder(folder / name, plan), plan.blocks) for name, plan in plans.each.items()]
    there = sum(opened.has(block.number) for opened, blocks in every for block in blocks)
    told = f"{there} of {sum(len(blocks) for _, blocks in every)} blocks of runs are in {path_text(folder)}"
    print(f"interrupted: {told}; the same command goes on from there", file=sys.stderr)
