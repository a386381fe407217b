"""Run `gudgeon study`: run, resume and report a file of many runs."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gudgeon.commands.common import check_file, check_folder, require_suffix, settings
from gudgeon.commands.outcome import report_as_json, wrote
from gudgeon.commands.progress import progress_bar, status_line
from gudgeon.errors import BadValueError, shortened
from gudgeon.files.writing import write_bytes
from gudgeon.language.shown import path_text
from gudgeon.studies.ensemble.estimate import estimate
from gudgeon.studies.ensemble.folder import StudyFolder
from gudgeon.studies.ensemble.plan import Plans
from gudgeon.studies.ensemble.study import load_study, plans_of, run_plans
from gudgeon.studies.ensemble.workers import workers
from gudgeon.studies.show.study import show_estimates, show_studies

INTERRUPTED, FAILED = 130, 1
REPORT = "report"  # typed in place of a file


@dataclass(frozen=True)
class Request:
    """Arguments of the command, as typed."""

    file: str
    out: Path | None = None
    threads: int | None = None
    restart: bool = False
    sets: Sequence[str] | None = None
    runs: bool = False
    json: bool = False
    finished: str | None = None  # folder of the study to report
    workers: int | None = None
    cluster: str | None = None
    starts: int | None = None
    seed: int | None = None

    @property
    def folder(self) -> Path:
        """Return the folder of the blocks and the dataset."""
        return self.out or Path(f"{Path(self.file).stem}.study")


def report_study(folder: str, out: Path | None, json: bool) -> int:
    """Write the HTML page of a finished study to `out`, or next to its folder, and return the exit code.

    json: print the written file as JSON.
    """
    page = out or Path(folder).absolute().with_suffix(".html")
    require_suffix(page, (".html", ".htm"))
    check_file("--out", page)
    with status_line(quiet=json):
        found = load_study(folder).report().to_html()
    with report_as_json(json):
        write_bytes(page, found.encode())
        wrote("report", page)
    return 0


def study_file(request: Request) -> int:
    """Run what is missing of a study, print the results, and return the exit code: 1 if every run failed."""
    if request.finished is not None:
        if request.file != REPORT:
            hint = f"gudgeon study {REPORT} FOLDER writes a page of it"
            raise BadValueError(f"study takes one file, and found {shortened(request.finished)} too", hint=hint)
        return report_study(request.finished, request.out, request.json)
    if request.file == REPORT and not Path(REPORT).exists():
        raise BadValueError(f"study {REPORT}: of which study?", hint=f"gudgeon study {REPORT} NAME.study")
    given = settings(tuple(request.sets or ()))
    if request.folder.suffix.lower() == ".html":
        hint = f"name a folder; gudgeon study {REPORT} FOLDER --out {shortened(request.folder)} writes the page"
        raise BadValueError(f"--out: {shortened(request.folder)} is a page's name, and a study is a folder", hint=hint)
    if not request.runs:
        check_folder("--out", request.folder)
    with status_line(quiet=request.json):
        plans = plans_of(request.file, given, request.starts, request.seed)
    if request.runs:
        estimates = {name: estimate(plan, request.threads) for name, plan in plans.each.items()}
        show_estimates(plans, estimates, request.json)
        return 0
    try:
        with workers(request.workers, request.cluster) as pool, progress_bar(request.json) as bar:
            report = bar(request.folder.stem)
            found = run_plans(plans, request.folder, request.threads, pool, report, request.restart)
    except KeyboardInterrupt:
        _report_interruption(plans, request.folder)
        return INTERRUPTED
    show_studies(plans, found, request.json)
    return FAILED if found.failed == found.runs else 0


def _report_interruption(plans: Plans, folder: Path) -> None:
    """Print to stderr, after Ctrl-C, how many blocks of runs are stored in the folder."""
    every = sum(len(plan.blocks) for plan in plans.each.values())
    there = min(every, sum(StudyFolder(folder / name, plan).there() for name, plan in plans.each.items()))
    text = f"{there} of {every} blocks of runs are in {path_text(folder)}"
    print(f"interrupted: {text}; the same command goes on from there", file=sys.stderr)
