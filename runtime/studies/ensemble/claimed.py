"""Judge the claims of a study file by its runs: two tables, in the study's folder as JSON and CSV."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.files.writing import read_regular, written
from gudgeon.language.plot_units import quantity
from gudgeon.language.shown import counted, in_spreadsheet
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.judge import Cell, judged, together
from gudgeon.studies.ensemble.names import as_people_write, names_of

if TYPE_CHECKING:
    import pandas

    from gudgeon.studies.ensemble.claims import Known, KnownNumber, KnownTrend
    from gudgeon.studies.ensemble.finished import Study
    from gudgeon.studies.ensemble.plan import Plan, Plans

FILE, TABLES = "claims.json", ("numbers", "trends")
NOT_COMPUTED = "not computed"
ODDS = ("probability", "low", "high", "chance")
VERDICTS = {"holds": "hold", "fails": "fail", "undecided": "undecided", NOT_COMPUTED: NOT_COMPUTED}  # of several: so
UNNAMED = ""  # the ensemble of runs that are in none


class Claimed(NamedTuple):
    """Two tables of judged claims, with a row for each claim and ensemble.

    numbers: claim, figure, says, part, at, place (of its scene along each dimension, JSON), measure, unit, printed,
    ensemble, n (runs), q25, median, q75 (SI), deviation (% of the printed value, or of the median of the number in
    `beside`), beside, note, heading (under which a page shows it). trends: claim, figure, says, heading, ensemble,
    verdict (of all ensembles together: "holds", "fails", "undecided", "not computed"), alone (verdict of this
    ensemble), probability (the least of its checks) and its interval low to high, chance (that one run of each scene
    shows all checks), agreed (whether no ensemble rules out the verdict of another), note.
    """

    numbers: pandas.DataFrame
    trends: pandas.DataFrame
    source: str

    def totals(self) -> list[str]:
        """Return lines with the number of trends by verdict, for each heading, and with the deviation of printed
        numbers.
        """
        message = []
        each = self.trends.drop_duplicates("claim") if len(self.trends) else self.trends
        headings = list(each["heading"]) if "heading" in each else [UNNAMED] * len(each)
        for heading in dict.fromkeys(headings):
            counts = Counter(each["verdict"][[one == heading for one in headings]])
            found = ((counts[one], one, many) for one, many in VERDICTS.items() if counts[one])
            words = (f"{count} {many if count > 1 else one}" for count, one, many in found)
            of = f" of “{heading}”" if heading else ""
            message.append(f"{counted(counts.total(), 'trend')}{of}: {', '.join(words)}")
        printed = self.numbers[self.numbers["printed"].notna()] if len(self.numbers) else self.numbers
        if len(printed):
            message.append(_deviation_text(printed))
        return message


def _deviation_text(printed: pandas.DataFrame) -> str:
    """Return a sentence on the deviation from printed numbers, of those that were computed; a printed 0 has no relative
    deviation.
    """
    each = printed.groupby("claim")
    off = printed["deviation"].abs().groupby(printed["claim"]).median().dropna()
    computed = int(each["median"].count().gt(0).sum())
    numbers = counted(each.ngroups, "printed number")
    if not computed:
        return f"{numbers}: none could be computed"
    of = numbers if computed == each.ngroups else f"{numbers}, {computed} of them computed"
    if not len(off):
        return f"{of}: of a printed 0 ours is off by no share"
    share = f"{off.median():.0f} %" if off.median() >= 100.0 else f"{off.median():.3g} %"
    sentence = f"ours are off by {share} or less for half of them" if len(off) > 1 else f"ours is off by {share}"
    return f"{of}: {sentence}"


def write_claims(folder: Path, plans: Plans, known: Known, study: Study) -> None:
    """Judge all claims by the finished runs and write the tables; without claims remove them. Raises OutputError."""
    if not (known.numbers or known.trends):
        for name in (FILE, *(f"claims_{table}.csv" for table in TABLES)):
            (folder / name).unlink(missing_ok=True)
        return
    runs = _FinishedRuns(plans, study, names_of(plans).values)
    cells = {str(one.claim.name): one.cell for one in known.numbers}
    rows = {
        "numbers": [row for one in known.numbers for row in _number_rows(one, runs, cells)],
        "trends": [row for one in known.trends for row in _trend_rows(one, runs)],
    }
    with written(folder / FILE) as file:
        file.write(json.dumps({"source": plans.file.claims.source} | rows, indent=1).encode())
    for name, table in zip(TABLES, _tables(rows), strict=True):
        with written(folder / f"claims_{name}.csv") as file:
            file.write(table.map(in_spreadsheet).to_csv(index=False).encode())


def read_claims_of(folder: Path) -> Claimed:
    """Return the tables that write_claims wrote. Raises GudgeonError if there are none."""
    document = claims_json(folder)
    if document is None:
        raise GudgeonError("the file of this study makes no claims")
    numbers, trends = _tables(document)
    return Claimed(numbers, trends, str(document.get("source", "")))


def claims_json(folder: Path) -> dict[str, Any] | None:
    """Return the JSON document of a folder; None if its study makes no claims."""
    try:
        data = read_regular(folder / FILE)
        found = None if data is None else json.loads(data)
    except (OSError, ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) and all(isinstance(found.get(name), list) for name in TABLES) else None


def _tables(rows: Mapping[str, Any]) -> list[pandas.DataFrame]:
    """Return the two tables from rows of JSON."""
    import pandas

    found = [pandas.DataFrame(rows[name]) for name in TABLES]
    for name in ("printed", "q25", "median", "q75", "deviation"):
        if name in found[0]:
            found[0][name] = found[0][name].astype(float)  # null is NaN
    for name in ODDS:
        if name in found[1]:
            found[1][name] = found[1][name].astype(float)
    return found


class _FinishedRuns:
    """Measures of a study's runs by cell and ensemble."""

    def __init__(self, plans: Plans, study: Study, written: Mapping[str, Mapping[str, tuple[str, ...]]]) -> None:
        """Store plans, finished study and values as written in the file."""
        self.plans, self.study, self.written = plans, study, written
        self.held: dict[tuple[str, str], Array] = {}

    def ensembles(self, cells: list[Cell]) -> list[str]:
        """Return the names of the ensembles that any of these cells has, or [UNNAMED]."""
        names = [name for part in dict.fromkeys(cell.part for cell in cells) for name in self._named(part)]
        return list(dict.fromkeys(names)) or [UNNAMED]

    def own(self, cell: Cell, ensembles: list[str]) -> bool:
        """Return whether a cell has separate runs for each of these ensembles."""
        return len(ensembles) < 2 or set(ensembles) <= set(self._named(cell.part))

    def _named(self, part: str) -> list[str]:
        """Return the names of the ensembles of a part."""
        plan = self.plans.each[part]
        return [str(name) for one in plan.coordinates if one.name == "ensemble" for name in one.values]

    def values(self, cell: Cell, measure: str, ensemble: str) -> Array:
        """Return a measure of the runs of a cell in an ensemble, (n,); without this ensemble, of all its runs."""
        plan, key = self.plans.each[cell.part], (cell.part, measure)
        if key not in self.held:
            own = self.study.parts[cell.part] if self.plans.named else self.study
            self.held[key] = np.asarray(own.dataset[measure].transpose(*plan.dims).values, dtype=float)
        found = self.held[key][cell.index]
        named = self._named(cell.part)
        if named and ensemble in named:
            return np.asarray(found[named.index(ensemble)])
        return np.asarray(found).ravel()


def _number_rows(known: KnownNumber, runs: _FinishedRuns, cells: Mapping[str, Cell]) -> Iterator[dict[str, Any]]:
    """Yield the row of a published number for each ensemble."""
    claim = known.claim
    for ensemble in runs.ensembles([known.cell]):
        values = runs.values(known.cell, str(claim.measure), ensemble)
        own = values[np.isfinite(values)]
        quartiles = np.quantile(own, [0.25, 0.5, 0.75]) if len(own) else np.full(3, np.nan)
        base = known.printed
        if claim.beside is not None:
            others = runs.values(cells[claim.beside], str(claim.measure), ensemble)
            base = float(np.median(others[np.isfinite(others)])) if np.isfinite(others).any() else math.nan
        off = 100.0 * (quartiles[1] / base - 1.0) if base else math.nan
        plan = runs.plans.each[known.cell.part]
        yield {
            "claim": str(claim.name),
            "figure": claim.figure,
            "says": claim.says,
            "part": known.cell.part,
            "at": _describe_cell(plan, known, runs.written[known.cell.part]),
            "place": json.dumps(dict(zip(_cell_dimensions(plan), known.cell.index, strict=True))),
            "measure": str(claim.measure),
            "unit": known.unit,
            "printed": _finite_or_none(known.printed),
            "ensemble": ensemble,
            "n": len(own),
            "q25": _finite_or_none(quartiles[0]),
            "median": _finite_or_none(quartiles[1]),
            "q75": _finite_or_none(quartiles[2]),
            "deviation": _finite_or_none(off),
            "beside": str(claim.beside or ""),
            "note": claim.note,
            "heading": claim.heading,
        }


def _describe_cell(plan: Plan, known: KnownNumber, written: Mapping[str, tuple[str, ...]]) -> str:
    """Return the cell of a number in words, as the claim or the file writes it: "scene dry, c 0.3 mm"."""
    texts, own = [], {str(name): as_people_write(str(text)) for name, text in known.claim.selection.at.items()}
    for name, k in zip(_cell_dimensions(plan), known.cell.index, strict=True):
        for one in (one for one in plan.coordinates if one.over == (name,)):
            value = one.values[k]
            specified = value if isinstance(value, str) else quantity(float(value), one.unit, 6)
            texts.append(f"{one.name} {own.get(one.name) or written.get(one.name, {k: specified})[k]}")
    return ", ".join(texts)


def _cell_dimensions(plan: Plan) -> list[str]:
    """Return the dimensions of a plan along which cells lie: all but ensemble and start."""
    return [name for name in plan.dims if name not in ("ensemble", "start")]


def _trend_rows(known: KnownTrend, runs: _FinishedRuns) -> Iterator[dict[str, Any]]:
    """Yield the row of a trend for each ensemble."""
    claim = known.claim
    common = {"claim": str(claim.name), "figure": claim.figure, "says": claim.says, "heading": claim.heading}
    if claim.not_computed:
        message = " ".join(filter(None, (claim.not_computed, claim.note)))
        yield common | {
            "ensemble": UNNAMED,
            "verdict": NOT_COMPUTED,
            "alone": NOT_COMPUTED,
            **dict.fromkeys(ODDS),
            "agreed": True,
            "note": message,
        }
        return
    cells = list(dict.fromkeys(cell for check in known.checks for cell in check.cells))
    measures = list(dict.fromkeys(name for check in known.checks for name in check.measures))
    certain = [cell for cell in cells if "start" not in runs.plans.each[cell.part].dims]
    each, ensembles = {}, runs.ensembles(cells)
    again = [cell for cell in cells if not runs.own(cell, ensembles)]
    for ensemble in ensembles:
        own = {
            cell: {name: runs.values(cell, name, ensemble) for name in measures if _has_measure(runs, cell, name)}
            for cell in cells
        }
        each[ensemble] = judged(known.checks, own, certain, again)
    whole, agreed = together(list(each.values()))
    for ensemble, one in each.items():
        odds = {name: _finite_or_none(getattr(one, name)) for name in ODDS}
        yield common | {
            "ensemble": ensemble,
            "verdict": whole.verdict,
            "alone": one.verdict,
            **odds,
            "agreed": agreed,
            "note": claim.note,
        }


def _has_measure(runs: _FinishedRuns, cell: Cell, measure: str) -> bool:
    """Return whether the part of a cell has a measure."""
    return any(one.name == measure for one in runs.plans.each[cell.part].expected.measures)


def _finite_or_none(value: float | None) -> float | None:
    """Return a finite number as a float, anything else as None, for JSON."""
    return None if value is None or not math.isfinite(value) else float(value)
