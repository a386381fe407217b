"""Compare the claims of a study file, published numbers and trends, with its runs, and write the results as tables."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.files.writing import open_atomic, read_regular_file
from gudgeon.language.plot_units import format_quantity
from gudgeon.language.text_output import escape_for_spreadsheet, format_count
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.judge import RunCell, judge_claim, merge_verdicts
from gudgeon.studies.ensemble.names import collect_display_names, typeset_quantity

if TYPE_CHECKING:
    import pandas

    from gudgeon.studies.ensemble.claims import ResolvedClaims, ResolvedNumber, ResolvedTrend
    from gudgeon.studies.ensemble.finished import Study
    from gudgeon.studies.ensemble.plan import Plan, Plans

CLAIMS_FILE, TABLE_NAMES = "claims.json", ("numbers", "trends")
NOT_COMPUTED = "not computed"
PROBABILITY_COLUMNS = ("probability", "low", "high", "chance")
# verdict of one trend -> text for several trends
VERDICT_PLURALS = {
    "holds": "hold",
    "fails": "fail",
    "undecided": "undecided",
    NOT_COMPUTED: NOT_COMPUTED,
}
NO_ENSEMBLE = ""  # name of the ensemble of runs without named ensembles


class JudgedClaims(NamedTuple):
    """Two tables of judged claims, with a row for each claim and ensemble.

    numbers: claim, figure, says, part, at, place (index along each dimension, JSON), measure, unit, printed, ensemble,
    n (runs), q25, median, q75 (SI), deviation (% of the printed value, or of the median of the number in `beside`),
    beside, note, heading (of its section in the report). trends: claim, figure, says, heading, ensemble, verdict (of
    all ensembles together: "holds", "fails", "undecided", "not computed"), alone (verdict of this ensemble),
    probability (minimum over its checks) and its interval low to high, chance (that one run of each cell satisfies all
    checks), agreed (whether no ensemble rules out the verdict of another), note.
    """

    numbers: pandas.DataFrame
    trends: pandas.DataFrame
    source: str

    def totals(self) -> list[str]:
        """Return summary lines: "13 trends: 8 hold, 2 fail" for each heading, then the deviation from printed numbers.

        A claim with several ensembles counts once. Without printed numbers the last line is left out.
        """
        text_lines = []
        trends_by_claim = self.trends.drop_duplicates("claim") if len(self.trends) else self.trends
        headings = (
            list(trends_by_claim["heading"]) if "heading" in trends_by_claim else [NO_ENSEMBLE] * len(trends_by_claim)
        )
        for heading in dict.fromkeys(headings):
            counts = Counter(trends_by_claim["verdict"][[verdict == heading for verdict in headings]])
            nonzero_counts = (
                (counts[verdict], verdict, plural) for verdict, plural in VERDICT_PLURALS.items() if counts[verdict]
            )
            words = (f"{count} {plural if count > 1 else verdict}" for count, verdict, plural in nonzero_counts)
            heading_text = f" of “{heading}”" if heading else ""
            text_lines.append(f"{format_count(counts.total(), 'trend')}{heading_text}: {', '.join(words)}")
        printed = self.numbers[self.numbers["printed"].notna()] if len(self.numbers) else self.numbers
        if len(printed):
            text_lines.append(_describe_deviations(printed))
        return text_lines


def _describe_deviations(printed_rows: pandas.DataFrame) -> str:
    """Return a sentence with the median of the relative deviations of computed medians from the printed numbers.

    printed_rows: rows of the table of numbers that have a printed value. A printed 0 has no relative deviation. The
    deviation of a claim is the median over its ensembles.
    """
    rows_by_claim = printed_rows.groupby("claim")
    deviations = printed_rows["deviation"].abs().groupby(printed_rows["claim"]).median().dropna()
    n_computed = int(rows_by_claim["median"].count().gt(0).sum())
    numbers_text = format_count(rows_by_claim.ngroups, "printed number")
    if not n_computed:
        return f"{numbers_text}: none could be computed"
    count_text = (
        numbers_text if n_computed == rows_by_claim.ngroups else f"{numbers_text}, {n_computed} of them computed"
    )
    if not len(deviations):
        return f"{count_text}: a printed 0 has no relative deviation"
    median_text = f"{deviations.median():.0f} %" if deviations.median() >= 100.0 else f"{deviations.median():.3g} %"
    sentence = (
        f"half of the computed values deviate by {median_text} or less"
        if len(deviations) > 1
        else f"the computed value deviates by {median_text}"
    )
    return f"{count_text}: {sentence}"


def write_claims(folder: Path, plans: Plans, claims: ResolvedClaims, study: Study) -> None:
    """Judge all claims by the finished runs, and write claims.json and two CSV files into the folder of the study.

    Without claims nothing is written, and files of an earlier edition of the claims are removed. Raises OutputError.
    """
    if not (claims.numbers or claims.trends):
        for name in (CLAIMS_FILE, *(f"claims_{table}.csv" for table in TABLE_NAMES)):
            (folder / name).unlink(missing_ok=True)
        return
    runs = _FinishedRuns(plans, study, collect_display_names(plans).values)
    cells = {str(judged.claim.name): judged.cell for judged in claims.numbers}
    rows = {
        "numbers": [row for judged in claims.numbers for row in _yield_number_rows(judged, runs, cells)],
        "trends": [row for judged in claims.trends for row in _yield_trend_rows(judged, runs)],
    }
    with open_atomic(folder / CLAIMS_FILE) as file:
        file.write(json.dumps({"source": plans.file.claims.source} | rows, indent=1).encode())
    for name, table in zip(TABLE_NAMES, _build_claim_tables(rows), strict=True):
        with open_atomic(folder / f"claims_{name}.csv") as file:
            file.write(table.map(escape_for_spreadsheet).to_csv(index=False).encode())


def read_judged_claims(folder: Path) -> JudgedClaims:
    """Read the judged claims from the folder of a study. Raises GudgeonError if the study has no claims."""
    document = read_claims_json(folder)
    if document is None:
        raise GudgeonError("the study file has no claims")
    numbers, trends = _build_claim_tables(document)
    return JudgedClaims(numbers, trends, str(document.get("source", "")))


def read_claims_json(folder: Path) -> dict[str, Any] | None:
    """Return the contents of claims.json in a folder; None if the file is missing, damaged, or without both tables."""
    try:
        data = read_regular_file(folder / CLAIMS_FILE)
        document = None if data is None else json.loads(data)
    except (OSError, ValueError, RecursionError):
        return None
    return (
        document
        if isinstance(document, dict) and all(isinstance(document.get(name), list) for name in TABLE_NAMES)
        else None
    )


def _build_claim_tables(rows: Mapping[str, Any]) -> list[pandas.DataFrame]:
    """Return the tables of numbers and of trends from their rows, {"numbers": [...], "trends": [...]}.

    None (null in JSON) becomes NaN in columns of numbers.
    """
    import pandas

    tables = [pandas.DataFrame(rows[name]) for name in TABLE_NAMES]
    for name in ("printed", "q25", "median", "q75", "deviation"):
        if name in tables[0]:
            tables[0][name] = tables[0][name].astype(float)  # null is NaN
    for name in PROBABILITY_COLUMNS:
        if name in tables[1]:
            tables[1][name] = tables[1][name].astype(float)
    return tables


class _FinishedRuns:
    """Reader of the measures of a finished study, by cell and ensemble; arrays are cached."""

    def __init__(self, plans: Plans, study: Study, value_texts: Mapping[str, Mapping[str, tuple[str, ...]]]) -> None:
        """Store plans and finished study; value_texts: typeset values of coordinates, {part: {name: texts}}."""
        self.plans, self.study, self.written = plans, study, value_texts
        self.cached_values: dict[tuple[str, str], Array] = {}

    def list_ensembles(self, cells: list[RunCell]) -> list[str]:
        """Return the names of the ensembles in the parts of these cells, without repetitions; [""] for none."""
        names = [
            name for part in dict.fromkeys(cell.part for cell in cells) for name in self._list_ensemble_names(part)
        ]
        return list(dict.fromkeys(names)) or [NO_ENSEMBLE]

    def has_separate_runs(self, cell: RunCell, ensembles: list[str]) -> bool:
        """Return whether each of these ensembles has its own runs of a cell; True for fewer than two ensembles.

        It is False for a cell of a part without these ensembles, whose runs all ensembles share.
        """
        return len(ensembles) < 2 or set(ensembles) <= set(self._list_ensemble_names(cell.part))

    def _list_ensemble_names(self, part: str) -> list[str]:
        """Return the names of the ensembles along the dimension `ensemble` of a part; empty if it has none."""
        plan = self.plans.by_part[part]
        return [
            str(name) for coordinate in plan.coordinates if coordinate.name == "ensemble" for name in coordinate.values
        ]

    def read_values(self, cell: RunCell, measure: str, ensemble: str) -> Array:
        """Return a measure of the runs of a cell in an ensemble, (n,), with NaN of failed runs.

        If the part of the cell does not have this ensemble, all runs of the cell are returned.
        """
        plan, key = self.plans.by_part[cell.part], (cell.part, measure)
        if key not in self.cached_values:
            part_study = self.study.parts[cell.part] if self.plans.named else self.study
            self.cached_values[key] = np.asarray(part_study.dataset[measure].transpose(*plan.dims).values, dtype=float)
        cell_values = self.cached_values[key][cell.index]
        named = self._list_ensemble_names(cell.part)
        if named and ensemble in named:
            return np.asarray(cell_values[named.index(ensemble)])
        return np.asarray(cell_values).ravel()


def _yield_number_rows(
    number: ResolvedNumber, finished_runs: _FinishedRuns, cells: Mapping[str, RunCell]
) -> Iterator[dict[str, Any]]:
    """Yield the table row of a claimed number for each ensemble: quartiles of its runs, deviation of the median in %.

    cells: cells of all numbers by the name of their claim. The deviation is relative to the printed value, or to the
    median of the reference claim (key `beside` of the file). It is None without finite values, or relative to 0.
    """
    claim = number.claim
    for ensemble in finished_runs.list_ensembles([number.cell]):
        values = finished_runs.read_values(number.cell, str(claim.measure), ensemble)
        finite_values = values[np.isfinite(values)]
        quartiles = np.quantile(finite_values, [0.25, 0.5, 0.75]) if len(finite_values) else np.full(3, np.nan)
        reference_value = number.printed
        if claim.reference_claim is not None:
            reference_values = finished_runs.read_values(cells[claim.reference_claim], str(claim.measure), ensemble)
            reference_value = (
                float(np.median(reference_values[np.isfinite(reference_values)]))
                if np.isfinite(reference_values).any()
                else math.nan
            )
        deviation = 100.0 * (quartiles[1] / reference_value - 1.0) if reference_value else math.nan
        plan = finished_runs.plans.by_part[number.cell.part]
        yield {
            "claim": str(claim.name),
            "figure": claim.figure,
            "says": claim.says,
            "part": number.cell.part,
            "at": _describe_cell(plan, number, finished_runs.written[number.cell.part]),
            "place": json.dumps(dict(zip(_list_cell_dimensions(plan), number.cell.index, strict=True))),
            "measure": str(claim.measure),
            "unit": number.unit,
            "printed": _replace_nonfinite(number.printed),
            "ensemble": ensemble,
            "n": len(finite_values),
            "q25": _replace_nonfinite(quartiles[0]),
            "median": _replace_nonfinite(quartiles[1]),
            "q75": _replace_nonfinite(quartiles[2]),
            "deviation": _replace_nonfinite(deviation),
            "beside": str(claim.reference_claim or ""),
            "note": claim.note,
            "heading": claim.heading,
        }


def _describe_cell(plan: Plan, number: ResolvedNumber, value_texts: Mapping[str, tuple[str, ...]]) -> str:
    """Return the coordinates of a number's cell in words: "scene dry, c 0.3 mm", for the table column `at`.

    A value is written as in the claim, else as in the study file (`value_texts`), else formatted with six digits.
    """
    texts, claimed_texts = (
        [],
        {str(name): typeset_quantity(str(text)) for name, text in number.claim.selection.at.items()},
    )
    for name, k in zip(_list_cell_dimensions(plan), number.cell.index, strict=True):
        for coordinate in (coordinate for coordinate in plan.coordinates if coordinate.over == (name,)):
            value = coordinate.values[k]
            formatted_value = value if isinstance(value, str) else format_quantity(float(value), coordinate.unit, 6)
            text_of_file = value_texts.get(coordinate.name, {k: formatted_value})[k]
            texts.append(f"{coordinate.name} {claimed_texts.get(coordinate.name) or text_of_file}")
    return ", ".join(texts)


def _list_cell_dimensions(plan: Plan) -> list[str]:
    """Return the names of the dimensions of a plan that distinguish cells: all but "ensemble" and "start"."""
    return [name for name in plan.dims if name not in ("ensemble", "start")]


def _yield_trend_rows(trend: ResolvedTrend, finished_runs: _FinishedRuns) -> Iterator[dict[str, Any]]:
    """Judge a trend, and yield its table row for each ensemble: common verdict, verdict of the ensemble, probabilities.

    A trend with `not_computed` has one row with the verdict "not computed" and probabilities None.
    """
    claim = trend.claim
    common = {"claim": str(claim.name), "figure": claim.figure, "says": claim.says, "heading": claim.heading}
    if claim.not_computed:
        message = " ".join(filter(None, (claim.not_computed, claim.note)))
        yield common | {
            "ensemble": NO_ENSEMBLE,
            "verdict": NOT_COMPUTED,
            "alone": NOT_COMPUTED,
            **dict.fromkeys(PROBABILITY_COLUMNS),
            "agreed": True,
            "note": message,
        }
        return
    cells = list(dict.fromkeys(cell for check in trend.checks for cell in check.cells))
    measures = list(dict.fromkeys(name for check in trend.checks for name in check.measures))
    certain_cells = [cell for cell in cells if "start" not in finished_runs.plans.by_part[cell.part].dims]
    judged_by_ensemble, ensembles = {}, finished_runs.list_ensembles(cells)
    shared_cells = [cell for cell in cells if not finished_runs.has_separate_runs(cell, ensembles)]
    for ensemble in ensembles:
        verdicts = {
            cell: {
                name: finished_runs.read_values(cell, name, ensemble)
                for name in measures
                if _has_measure(finished_runs, cell, name)
            }
            for cell in cells
        }
        judged_by_ensemble[ensemble] = judge_claim(trend.checks, verdicts, certain_cells, shared_cells)
    overall, agreed = merge_verdicts(list(judged_by_ensemble.values()))
    for ensemble, judged in judged_by_ensemble.items():
        probabilities = {name: _replace_nonfinite(getattr(judged, name)) for name in PROBABILITY_COLUMNS}
        yield common | {
            "ensemble": ensemble,
            "verdict": overall.verdict,
            "alone": judged.verdict,
            **probabilities,
            "agreed": agreed,
            "note": claim.note,
        }


def _has_measure(finished_runs: _FinishedRuns, cell: RunCell, measure: str) -> bool:
    """Return whether the part of a cell has a measure of this name."""
    return any(candidate.name == measure for candidate in finished_runs.plans.by_part[cell.part].run_settings.measures)


def _replace_nonfinite(value: float | None) -> float | None:
    """Return a finite number as a Python float; None for None, NaN and infinity, which JSON lacks."""
    return None if value is None or not math.isfinite(value) else float(value)
