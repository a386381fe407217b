"""Print the results of a study as text or JSON: numbers of runs, failures, quantiles of each measure, claims."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from gudgeon.files.free_space import format_size
from gudgeon.language.text_output import escape_invisible, format_count, format_path, print_json
from gudgeon.studies.ensemble.claim_tables import CLAIMS_FILE, read_claims_json
from gudgeon.studies.ensemble.estimate import Estimate
from gudgeon.studies.ensemble.finished import Study
from gudgeon.studies.ensemble.folder import DATASET
from gudgeon.studies.ensemble.plan import Plan, Plans
from gudgeon.studies.show.study_data import StudyData
from gudgeon.studies.show.tables import format_seconds, make_console, make_rich_table

MAX_FAILURE_KINDS = 8  # reasons of failures that are printed
MAX_TRENDS = 16  # with more trends, only their totals are printed
QUANTILES = {"min": 0.0, "median": 0.5, "max": 1.0}


def describe_runs(plan: Plan, runs: int) -> str:
    """Return a number of runs and the dimensions of the plan: "10 runs (scene 2 × c 5)"; without dimensions "1 run"."""
    shape = " × ".join(f"{name} {length}" for name, length in zip(plan.dims, plan.shape, strict=True))
    return format_count(runs, "run") + f" ({escape_invisible(shape)})" * bool(shape)


def report_estimates(plans: Plans, estimates: Mapping[str, Estimate], as_json: bool) -> None:
    """Print for each part the number of runs and the estimated disk space and time; with `as_json` a JSON document.

    estimates: by the name of the part, "" for a file without parts. For a file with parts, a line has the totals.
    """
    if as_json:
        json_by_part = {name: _estimate_to_json(plan, estimates[name]) for name, plan in plans.by_part.items()}
        print_json({"parts": json_by_part} if plans.named else json_by_part[""])
        return
    for name, plan in plans.by_part.items():
        if name:
            print(f"part {escape_invisible(name)}:")
        _print_estimate(plan, estimates[name])
    if plans.named:
        size, total_seconds = (
            sum(estimate.bytes for estimate in estimates.values()),
            sum(estimate.seconds for estimate in estimates.values()),
        )
        print(
            f"all parts: {format_count(plans.runs, 'run')}, about {format_size(size)} on disk, "
            f"{_format_duration(total_seconds)}"
        )


def _estimate_to_json(plan: Plan, estimate: Estimate) -> dict[str, Any]:
    """Return the estimate of a part as a mapping for JSON: dimensions, runs, blocks, bytes, seconds, trials, notes."""
    return {
        "dimensions": dict(zip(plan.dims, plan.shape, strict=True)),
        "runs": estimate.runs,
        "blocks": estimate.blocks,
        "bytes": estimate.bytes,
        "seconds": estimate.seconds,
        "tried": estimate.tried,
        "tried_failed": estimate.failed,
        "notes": list(plan.notes),
    }


def _print_estimate(plan: Plan, estimate: Estimate) -> None:
    """Print runs, disk space, time and notes of one part, and the first reason if trial runs failed."""
    print(f"{describe_runs(plan, estimate.runs)} in {format_count(estimate.blocks, 'block')}")
    trials = format_count(estimate.tried, "trial run")
    print(f"about {format_size(estimate.bytes)} on disk, {_format_duration(estimate.seconds)}, estimated from {trials}")
    if estimate.failed:
        print(f"{estimate.failed} of {trials} failed: {escape_invisible(estimate.reasons[0])}")
    for note in plan.notes:
        print(f"note: {escape_invisible(note)}")


def report_studies(plans: Plans, study: Study, as_json: bool) -> None:
    """Print measures, failures and notes of each part of a finished study, then the verdicts on its claims if any.

    With `as_json` it prints one JSON document instead.
    """
    parts = study.parts or {"": study}
    if as_json:
        json_by_part = {name: _convert_study_to_json(plan, parts[name]) for name, plan in plans.by_part.items()}
        study_json = {"folder": str(study.folder), "runs": study.runs, "failed": study.failed, "parts": json_by_part}
        claims = read_claims_json(study.folder)
        print_json((study_json if plans.named else json_by_part[""]) | ({} if claims is None else {"claims": claims}))
        return
    for name, plan in plans.by_part.items():
        if name:
            print(f"part {escape_invisible(name)}:")
        _print_study(plan, parts[name])
    if read_claims_json(study.folder) is not None:
        _print_claims(study)


def _convert_study_to_json(plan: Plan, study: Study) -> dict[str, Any]:
    """Return the results of one part as a mapping for JSON: folder, runs, failures, quantiles of measures, notes."""
    measures = {name: {"unit": unit, **row} for name, unit, row in _iterate_measure_spreads(plan, study)}
    return {
        "folder": str(study.folder),
        "dataset": str(study.folder / DATASET),
        "runs": study.runs,
        "failed": study.failed,
        "failures": study.failures,
        "first_failures": {kind: message for kind, _, message in StudyData(study).iterate_failures()},
        "measures": measures,
        "notes": list(study.notes),
    }


def _print_study(plan: Plan, study: Study) -> None:
    """Print the results of one part: number of runs, quantiles of the measures, frequent failures, notes, its file.

    At most MAX_FAILURE_KINDS reasons of failures are printed, each with the full message of its first run.
    """
    spreads = {name: (unit, row) for name, unit, row in _iterate_measure_spreads(plan, study)}
    print(describe_runs(plan, study.runs))
    if spreads:
        table = make_rich_table(["measure", *QUANTILES, "unit", "NaN"], ["measure", "unit"])
        for name, (unit, row) in spreads.items():
            quantile_cells = (f"{row[key]:.6g}" if np.isfinite(row[key]) else "–" for key in QUANTILES)
            table.add_row(escape_invisible(name), *quantile_cells, unit, str(row["nan"]))
        make_console().print(table)
    if study.failed:
        print(f"{study.failed} of {format_count(study.runs, 'run')} failed:")
        for kind, count, message in itertools.islice(StudyData(study).iterate_failures(), MAX_FAILURE_KINDS):
            print(
                f"  {count} × {escape_invisible(kind)}"
                + f"\n    the first: {escape_invisible(message)}" * bool(message)
            )
        if (n_omitted := len(study.failures) - MAX_FAILURE_KINDS) > 0:
            print(f"  and {n_omitted} other reasons")
    for note in study.notes:
        print(f"note: {escape_invisible(note)}")
    print(f"wrote {format_path(Path(study.folder) / DATASET)}")


def _print_claims(study: Study) -> None:
    """Print the judged claims of a study: a line "T1 holds: statement" for each trend, then totals and the file.

    With more than MAX_TRENDS trends only the totals are printed: trends by verdict, and the median deviation from the
    printed numbers. A trend on which ensembles disagree has "ensembles disagree" in place of its verdict. The study
    must have claims.
    """
    claims = study.claims
    trends = claims.trends
    if len(trends):
        verdicts = {
            name: claim_rows["verdict"].iloc[0] if claim_rows["agreed"].all() else "ensembles disagree"
            for name, claim_rows in trends.groupby("claim", sort=False)
        }
        if len(verdicts) <= MAX_TRENDS:
            statements = trends.drop_duplicates("claim").set_index("claim")["says"]
            lines = (
                f"{name} {verdict}: {escape_invisible(str(statements[name]))}" for name, verdict in verdicts.items()
            )
            print("\n".join(lines))
    print("\n".join(map(escape_invisible, claims.totals())))
    print(f"wrote {format_path(Path(study.folder) / CLAIMS_FILE)}")


def _iterate_measure_spreads(plan: Plan, study: Study) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Yield name, SI unit and statistics of each measure over all finite values: a dict of min, median, max and nan.

    `nan` is the number of runs without a finite value. Without any finite value the quantiles are NaN.
    """
    for name in (measure.name for measure in plan.run_settings.measures):
        values = study.dataset[name].values
        finite_values = values[np.isfinite(values)]
        row = {
            key: float(np.quantile(finite_values, q)) if finite_values.size else float("nan")
            for key, q in QUANTILES.items()
        }
        yield name, plan.units[name], row | {"nan": int(values.size - finite_values.size)}


def _format_duration(seconds: float) -> str:
    """Return a duration (s) as text, in days, h or min from twice that unit on, else as `format_seconds`: "3.5 h"."""
    for factor, unit in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * factor:
            return f"{seconds / factor:.3g} {unit}"
    return format_seconds(seconds)
