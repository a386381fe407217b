"""Build the HTML page of a study: variations, failures, every measure by its coordinates, and figures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.plot_units import drawn, label
from gudgeon.language.shown import counted
from gudgeon.results.reports.html_page import Section, article, lines, page, table, text
from gudgeon.studies.show.claims import claims_sections
from gudgeon.studies.show.pictures import Draw, Pictures, gallery
from gudgeon.studies.show.study_data import MANY, StudyData

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

MOST_ROWS, MOST_NUMBERS, MOST_SAMPLES = 500, 30_000_000, 20_000
SHOWN_VALUES = 8  # of what varied, in full


@dataclass(frozen=True)
class StudyReport:
    """The report of a finished study: `to_html` is a self-contained page, notebooks display the same."""

    study: Study

    def to_html(self) -> str:
        """Return the self-contained HTML file."""
        parts, pictures = _parts(self.study), Pictures()
        first = next(iter(parts.values()))
        every = list(_all_sections(self.study, parts, pictures))
        chapters = _chapters(every, parts) if len(parts) > 1 else ()
        return pictures.filled(page(first.title, _about(parts), every, chapters))

    def _repr_html_(self) -> str:
        """Return the report as HTML for a notebook."""
        parts, pictures = _parts(self.study), Pictures()
        title = f"<h1>{text(next(iter(parts.values())).title)}</h1>"
        return pictures.filled(article(_all_sections(self.study, parts, pictures), title))


def _parts(study: Study) -> dict[str, StudyData]:
    """Return the data of the study, or of its parts, by name."""
    return {name: StudyData(own) for name, own in (getattr(study, "parts", None) or {"": study}).items()}


def _all_sections(study: Study, parts: dict[str, StudyData], pictures: Pictures) -> Iterator[Section]:
    """Yield all sections: the summary, the claims on the whole, then those of each part."""
    yield "In short", lines([*next(iter(parts.values())).names.about, *_claim_totals(study)])
    yield from claims_sections(study, parts, pictures)
    for name, data in parts.items():
        before = f"{data.shown(name)}: " if name else ""
        if name:
            yield _part_heading(data, name), lines([_counts(data)])
        yield from ((before + heading, inside) for heading, inside in sections(data, pictures, name or "study"))


def _part_heading(data: StudyData, name: str) -> str:
    """Return the heading of a part."""
    return f"Part {data.shown(name)}"


def _chapters(every: list[Section], parts: dict[str, StudyData]) -> list[str]:
    """Return the headings that the page links to: those of the whole, and the first of each part."""
    of_parts = [_part_heading(data, name) for name, data in parts.items()]
    return [name for name, _ in every[: [name for name, _ in every].index(of_parts[0])]] + of_parts


def _claim_totals(study: Study) -> list[str]:
    """Return the summary of the claims as lines; empty without claims."""
    try:
        return study.claims.totals()
    except GudgeonError:  # its file makes no claims
        return []


def sections(data: StudyData, pictures: Pictures, name: str = "study") -> Iterator[Section]:
    """Yield heading and HTML of each section of a part; `name` is the prefix of its figures."""
    study = data.study
    yield "What varied", table(("", "over", "values", "unit", ""), _coordinate_rows(data), True)
    failed = ((str(count), kind, message) for kind, count, message in data.failures())
    yield "Failed runs", table(("runs", "failed of", "the first of them"), failed, True)
    yield "Notes", lines(study.notes)
    yield "Measures", _measure_table(data)
    try:
        import gudgeon.studies.show.study_plots  # noqa: F401 (without matplotlib it says what to install)
    except GudgeonError as error:
        yield "Figures", lines([str(error)])
        return
    yield "Figures", gallery(_measure_figures(data), f"{name}-measure", pictures)
    yield "Series", gallery(_series_figures(data), f"{name}-series", pictures)


def _about(parts: dict[str, StudyData]) -> str:
    """Return runs, failures, mechanism and versions in one line."""
    attributes = next(iter(parts.values())).dataset.attrs
    runs, failed = (sum(getattr(data.study, name) for data in parts.values()) for name in ("runs", "failed"))
    whole = f"{counted(runs, 'run')} in {len(parts)} parts, {failed or 'none'} failed"
    about = whole if len(parts) > 1 else _counts(next(iter(parts.values())))
    versions = f"gudgeon {attributes['gudgeon']} · file {str(attributes['sha256'])[:12]}"
    return f"{about} · mechanism {attributes['mechanism']} · {versions}"


def _counts(data: StudyData) -> str:
    """Return runs, dimensions and failures in one line."""
    study = data.study
    sizes = " × ".join(f"{data.shown(name)} {size}" for name, size in data.dataset["t_last"].sizes.items())
    failed = f", {study.failed} failed" if study.failed else ", none failed"
    return f"{counted(study.runs, 'run')}{f' ({sizes})' if sizes else ''}{failed}"


def _coordinate_rows(data: StudyData) -> Iterator[tuple[str, ...]]:
    """Yield a row for each varied coordinate: name, dimension, values, unit, meaning."""
    for name, one in data.dataset.coords.items():
        if name in ("time", "sample"):
            continue
        over = ", ".join(map(data.shown, one.dims)) if one.dims != (name,) else ""
        unit, message = str(one.attrs.get("units", "")), str(one.attrs.get("long_name", ""))
        values = np.ravel(one.values)
        if values.dtype.kind in "OU":
            yield data.shown(name), over, _list_values([data.shown(value) for value in values]), "", message
            continue
        if written := data.written(str(name)):
            yield data.shown(name), over, _list_values(list(written)), "", message
            continue
        factor, shown = drawn(float(np.abs(values).max(initial=0.0)), unit)
        few = len(values) <= SHOWN_VALUES and not (values.dtype.kind == "i" and len(values) > 2)
        ends = values if few or not values.size else np.array([values.min(), values.max()])
        words = [f"{float(value) * factor + 0.0:.6g}" for value in ends]
        listed = ", ".join(words) if few else f"{' … '.join(words)}, {len(values)} of them"
        yield data.shown(name), over, listed, shown, message


def _list_values(words: list[str]) -> str:
    """Return all of a few texts, or the first and the last of many."""
    return ", ".join(words) if len(words) <= SHOWN_VALUES else f"{words[0]} … {words[-1]}, {len(words)} of them"


def _measure_table(data: StudyData) -> str:
    """Return the table of measures: a row for each coordinate, with median and quartiles over starts and draws."""
    names, rows, left = data.study.measures, dict[tuple[str, ...], list[str]](), 0
    if not names:
        return ""
    dims, units, spread = [], [], False
    for name in names:
        shape = data.dataset[name]
        dims = [str(one) for one in shape.dims if one not in MANY]
        spread = any(one in MANY for one in shape.dims)
        factor, unit = drawn(float(np.nanmax(np.abs(np.nan_to_num(shape.values)), initial=0.0)), data.unit(name))
        units.append(unit)
        for at, values in data.spreads(name):
            key = tuple(at.values())
            if key not in rows and len(rows) >= MOST_ROWS:
                left += name == names[0]
                continue
            rows.setdefault(key, []).append(_spread_cell(values * factor, spread))
    head = [data.labels(data.dataset[names[0]], one)[1] for one in dims]
    head += [label(data.shown(name), unit) for name, unit in zip(names, units, strict=True)]
    over = [data.shown(one) for one in data.dataset[names[0]].dims if one in MANY]
    message = [f"median (quartiles) over {', '.join(over)}; n: the number of these runs, where some have none"] * spread
    message += [f"{left} more rows are in the dataset"] * bool(left)
    return table(head, ([*key, *cells] for key, cells in rows.items())) + lines(message, "g-quiet")


def _spread_cell(values: Any, spread: bool) -> str:
    """Return median and quartiles as a cell, with the number of runs if some have no value."""
    own = values[np.isfinite(values)]
    if not own.size:
        return "–"
    if not spread:
        return f"{own[0]:.5g}"
    q1, middle, q3 = np.quantile(own, (0.25, 0.5, 0.75))
    less = f" n = {own.size}" if own.size < values.size else ""
    return f"{middle:.4g} ({q1:.4g} … {q3:.4g}){less}"


def _measure_figures(data: StudyData) -> Iterator[Draw]:
    """Yield caption and drawing function of each measure over the first dimension, and maps over the first two."""
    from gudgeon.studies.show.study_plots import StudyPlot

    plot = StudyPlot(data.study)
    for name in data.study.measures:
        found = data.dataset[name]
        if not found.dims or not np.isfinite(found.values).any():
            continue
        yield f"{data.shown(name)}: {_describe_pooled_runs(data, found)}", partial(plot.measure, name, published=True)
        varied = [str(one) for one in found.dims if one != "scene" and one not in MANY]
        if len(varied) < 2:
            continue
        for scene in [str(one) for one in data.dataset["scene"].values] if "scene" in found.dims else [""]:
            at = {"scene": scene} if scene else {}
            if not np.nan_to_num(data.measure(name, at).values).any():  # nothing, or what is 0 everywhere
                continue
            message = ", ".join(filter(None, (f"{data.shown(name)}: median", data.shown(scene))))
            yield message, partial(plot.heat_map, name, *varied[:2], at=at)


def _describe_pooled_runs(data: StudyData, found: Any) -> str:
    """Return the runs over which the statistics of a measure's figure are computed, in words."""
    over = data.first(found)
    others = [str(one) for one in found.dims if one not in (over, data.lines(found, over))]
    return f"median, quartiles and extremes over {', '.join(map(data.shown, others))}" if others else "of each run"


def _series_figures(data: StudyData) -> Iterator[Draw]:
    """Yield caption and drawing function of bands of each stored series over time, or over fractions of each run."""
    from gudgeon.studies.show.study_plots import StudyPlot

    plot = StudyPlot(data.study)
    for name in data.kept:
        found = data.dataset[name]
        if found.size > MOST_NUMBERS or found.shape[-1] > MOST_SAMPLES or not found.size:
            continue
        t, _ = data.series(name)
        runs = found.size // found.shape[-1]
        by = "scene" if "scene" in found.dims else None
        shares = t.ndim > 1
        if shares and not (np.nan_to_num(t) > 0.0).any():  # no run began
            continue
        message = (
            f"{data.shown(name)}: median, quartiles and extremes of {counted(runs, 'run')}{', over shares' * shares}"
        )
        yield message, partial(plot.bands, name, by, share=shares)
