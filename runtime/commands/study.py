"""Run `gudgeon study`: run, resume and report a study, a YAML file that describes many runs of one mechanism."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gudgeon.commands.common import check_output_file, check_output_folder, parse_settings, require_suffix
from gudgeon.commands.outcome import report_as_json, report_written_file
from gudgeon.commands.progress import show_progress_bars, show_status_line
from gudgeon.errors import BadValueError, shorten_path
from gudgeon.files.writing import write_bytes
from gudgeon.language.text_output import format_path
from gudgeon.studies.ensemble.estimate import estimate_study
from gudgeon.studies.ensemble.folder import StudyFolder
from gudgeon.studies.ensemble.plan import Plans
from gudgeon.studies.ensemble.study import load_study, resolve_plans, run_plans
from gudgeon.studies.ensemble.workers import open_workers
from gudgeon.studies.show.study import report_estimates, report_studies

INTERRUPTED, FAILED = 130, 1
REPORT = "report"  # instead of a file: write a page


@dataclass(frozen=True)
class StudyRequest:
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

    json: print the written file as JSON. `out` None: next to the folder.
    """
    page = out or Path(folder).absolute().with_suffix(".html")
    require_suffix(page, (".html", ".htm"))
    check_output_file("--out", page)
    with show_status_line(quiet=json):
        html = load_study(folder).report().to_html()
    with report_as_json(json):
        write_bytes(page, html.encode())
        report_written_file("report", page)
    return 0


def run_study_file(request: StudyRequest) -> int:
    """Run the unfinished runs of a study, print the results, and return the exit code: 1 if every run failed.

    It is 130 after Ctrl-C. For the file "report" the page of the finished study is written; with `--runs` only
    estimates are printed. Raises BadValueError for options that exclude each other.
    """
    if request.finished is not None:
        if request.file != REPORT:
            hint = f"gudgeon study {REPORT} FOLDER writes a page of it"
            raise BadValueError(f"study: expected one file, got {shorten_path(request.finished)} too", hint=hint)
        return report_study(request.finished, request.out, request.json)
    if request.file == REPORT and not Path(REPORT).exists():
        raise BadValueError(f"study {REPORT}: the folder is missing", hint=f"gudgeon study {REPORT} NAME.study")
    overrides = parse_settings(tuple(request.sets or ()))
    if request.folder.suffix.lower() == ".html":
        hint = f"name a folder; gudgeon study {REPORT} FOLDER --out {shorten_path(request.folder)} writes the page"
        raise BadValueError(
            f"--out: {shorten_path(request.folder)} is the name of a page: expected a folder", hint=hint
        )
    if not request.runs:
        check_output_folder("--out", request.folder)
    with show_status_line(quiet=request.json):
        plans = resolve_plans(request.file, overrides, request.starts, request.seed)
    if request.runs:
        estimates = {name: estimate_study(plan, request.threads) for name, plan in plans.by_part.items()}
        report_estimates(plans, estimates, request.json)
        return 0
    try:
        with open_workers(request.workers, request.cluster) as pool, show_progress_bars(request.json) as make_bar:
            report = make_bar(request.folder.stem)
            finished_study = run_plans(plans, request.folder, request.threads, pool, report, request.restart)
    except KeyboardInterrupt:
        _report_interruption(plans, request.folder)
        return INTERRUPTED
    report_studies(plans, finished_study, request.json)
    return FAILED if finished_study.failed == finished_study.runs else 0


def _report_interruption(plans: Plans, folder: Path) -> None:
    """Print to stderr how many blocks of runs are stored in the folder; called after Ctrl-C."""
    n_blocks = sum(len(plan.blocks) for plan in plans.by_part.values())
    n_stored = min(
        n_blocks, sum(StudyFolder(folder / name, plan).count_block_files() for name, plan in plans.by_part.items())
    )
    text = f"{n_stored} of {n_blocks} blocks of runs are in {format_path(folder)}"
    print(f"interrupted: {text}; the same command resumes the study", file=sys.stderr)
