"""Print the results of a study, for people and as JSON: numbers of runs, failures, and the spread of each measure."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from gudgeon.files.free_space import size_text
from gudgeon.language.shown import counted, path_text, print_json, visible
from gudgeon.studies.ensemble.claimed import FILE, claims_json
from gudgeon.studies.ensemble.estimate import Estimate
from gudgeon.studies.ensemble.finished import Study
from gudgeon.studies.ensemble.folder import DATASET
from gudgeon.studies.ensemble.plan import Plan, Plans
from gudgeon.studies.show.study_data import StudyData
from gudgeon.studies.show.tables import console, new_table, seconds

MOST_KINDS = 8
MOST_TRENDS = 16  # trends that are printed one by one
QUANTILES = {"min": 0.0, "median": 0.5, "max": 1.0}


def runs_text(plan: Plan, runs: int) -> str:
    """Return the number of runs and the dimensions: "10 runs (scene 2 × c 5)", "1 run"."""
    shape = " × ".join(f"{name} {length}" for name, length in zip(plan.dims, plan.shape, strict=True))
    return counted(runs, "run") + f" ({visible(shape)})" * bool(shape)


def show_estimates(plans: Plans, found: Mapping[str, Estimate], json: bool) -> None:
    """Print the plans with the estimates from trial runs."""
    if json:
        each = {name: _estimate_json(plan, found[name]) for name, plan in plans.each.items()}
        print_json({"parts": each} if plans.named else each[""])
        return
    for name, plan in plans.each.items():
        if name:
            print(f"part {visible(name)}:")
        _show_estimate(plan, found[name])
    if plans.named:
        size, spent = sum(one.bytes for one in found.values()), sum(one.seconds for one in found.values())
        print(f"all parts: {counted(plans.runs, 'run')}, about {size_text(size)} on disk, {_time_text(spent)}")


def _estimate_json(plan: Plan, found: Estimate) -> dict[str, Any]:
    """Return an estimate as JSON."""
    return {
        "dimensions": dict(zip(plan.dims, plan.shape, strict=True)),
        "runs": found.runs,
        "blocks": found.blocks,
        "bytes": found.bytes,
        "seconds": found.seconds,
        "tried": found.tried,
        "tried_failed": found.failed,
        "notes": list(plan.notes),
    }


def _show_estimate(plan: Plan, found: Estimate) -> None:
    """Print an estimate."""
    print(f"{runs_text(plan, found.runs)} in {counted(found.blocks, 'block')}")
    print(
        f"about {size_text(found.bytes)} on disk, {_time_text(found.seconds)} by {counted(found.tried, 'run')} on trial"
    )
    if found.failed:
        print(f"{found.failed} of {counted(found.tried, 'run')} on trial failed: {visible(found.reasons[0])}")
    for note in plan.notes:
        print(f"note: {visible(note)}")


def show_studies(plans: Plans, found: Study, json: bool) -> None:
    """Print the measures of all parts over the runs that did not fail."""
    parts = found.parts or {"": found}
    if json:
        each = {name: _study_json(plan, parts[name]) for name, plan in plans.each.items()}
        whole = {"folder": str(found.folder), "runs": found.runs, "failed": found.failed, "parts": each}
        claims = claims_json(found.folder)
        print_json((whole if plans.named else each[""]) | ({} if claims is None else {"claims": claims}))
        return
    for name, plan in plans.each.items():
        if name:
            print(f"part {visible(name)}:")
        _show_study(plan, parts[name])
    if claims_json(found.folder) is not None:
        _show_claims(found)


def _study_json(plan: Plan, found: Study) -> dict[str, Any]:
    """Return the results of one study as JSON."""
    measures = {name: {"unit": unit, **row} for name, unit, row in _measure_spreads(plan, found)}
    return {
        "folder": str(found.folder),
        "dataset": str(found.folder / DATASET),
        "runs": found.runs,
        "failed": found.failed,
        "failures": found.failures,
        "first_failures": {kind: message for kind, _, message in StudyData(found).failures()},
        "measures": measures,
        "notes": list(found.notes),
    }


def _show_study(plan: Plan, found: Study) -> None:
    """Print the results of one study."""
    spread = {name: (unit, row) for name, unit, row in _measure_spreads(plan, found)}
    print(runs_text(plan, found.runs))
    if spread:
        table = new_table(["measure", *QUANTILES, "unit", "NaN"], ["measure", "unit"])
        for name, (unit, row) in spread.items():
            numbers = (f"{row[key]:.6g}" if np.isfinite(row[key]) else "–" for key in QUANTILES)
            table.add_row(visible(name), *numbers, unit, str(row["nan"]))
        console().print(table)
    if found.failed:
        print(f"{found.failed} of {counted(found.runs, 'run')} failed:")
        for kind, count, message in itertools.islice(StudyData(found).failures(), MOST_KINDS):
            print(f"  {count} × {visible(kind)}" + f"\n    the first: {visible(message)}" * bool(message))
        if (more := len(found.failures) - MOST_KINDS) > 0:
            print(f"  and {more} other reasons")
    for note in found.notes:
        print(f"note: {visible(note)}")
    print(f"wrote {path_text(Path(found.folder) / DATASET)}")


def _show_claims(found: Study) -> None:
    """Print the verdicts of trends, or only their totals if there are many, and the deviation from printed numbers."""
    claims = found.claims
    trends = claims.trends
    if len(trends):
        message = {
            name: own["verdict"].iloc[0] if own["agreed"].all() else "not the same in all ensembles"
            for name, own in trends.groupby("claim", sort=False)
        }
        if len(message) <= MOST_TRENDS:
            says = trends.drop_duplicates("claim").set_index("claim")["says"]
            print("\n".join(f"{name} {verdict}: {visible(str(says[name]))}" for name, verdict in message.items()))
    print("\n".join(map(visible, claims.totals())))
    print(f"wrote {path_text(Path(found.folder) / FILE)}")


def _measure_spreads(plan: Plan, found: Study) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Yield name, unit, and minimum, median, maximum and number of NaN of each measure."""
    for name in (one.name for one in plan.expected.measures):
        values = found.dataset[name].values
        own = values[np.isfinite(values)]
        row = {key: float(np.quantile(own, q)) if own.size else float("nan") for key, q in QUANTILES.items()}
        yield name, plan.units[name], row | {"nan": int(values.size - own.size)}


def _time_text(value: float) -> str:
    """Return a duration in a suitable unit."""
    for factor, unit in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if value >= 2 * factor:
            return f"{value / factor:.3g} {unit}"
    return seconds(value)
