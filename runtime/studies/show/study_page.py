"""Build the HTML page of a study: varied parameters, failed runs, tables of each measure, and figures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.plot_units import choose_plot_unit, format_label
from gudgeon.language.text_output import format_count
from gudgeon.results.reports.html_page import (
    Section,
    build_article,
    build_page,
    build_paragraphs,
    build_table,
    escape_line,
)
from gudgeon.studies.show.claims import build_claims_sections
from gudgeon.studies.show.pictures import CaptionedFigure, PageFigures, format_gallery
from gudgeon.studies.show.study_data import POOLED_DIMENSIONS, StudyData

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

MAX_ROWS, MAX_SERIES_VALUES, MAX_SERIES_SAMPLES = 500, 30_000_000, 20_000  # of tables, and of series in figures
MAX_SHOWN_VALUES = 8  # values of a coordinate that are listed


@dataclass(frozen=True)
class StudyReport:
    """The report of a finished study: `to_html` returns a self-contained page, notebooks display its sections."""

    study: Study

    def to_html(self) -> str:
        """Return the report as the text of a self-contained HTML page, with its figures as SVG."""
        parts, page_figures = _read_part_data(self.study), PageFigures()
        first = next(iter(parts.values()))
        sections = list(_iterate_sections(self.study, parts, page_figures))
        chapters = _list_chapters(sections, parts) if len(parts) > 1 else ()
        return page_figures.insert_figures(build_page(first.title, _describe_study(parts), sections, chapters))

    def _repr_html_(self) -> str:
        """Return the report as an HTML fragment for a notebook, which calls this method."""
        parts, page_figures = _read_part_data(self.study), PageFigures()
        title = f"<h1>{escape_line(next(iter(parts.values())).title)}</h1>"
        return page_figures.insert_figures(build_article(_iterate_sections(self.study, parts, page_figures), title))


def _read_part_data(study: Study) -> dict[str, StudyData]:
    """Return the data of each part by its name; the key is "" for a study without parts."""
    return {name: StudyData(part) for name, part in (getattr(study, "parts", None) or {"": study}).items()}


def _iterate_sections(study: Study, parts: dict[str, StudyData], page_figures: PageFigures) -> Iterator[Section]:
    """Yield heading and HTML of all sections of a report: summary, claims, then the sections of each part.

    The figures are registered in `page_figures` and drawn later.
    """
    yield "In short", build_paragraphs([*next(iter(parts.values())).names.about, *_read_claim_totals(study)])
    yield from build_claims_sections(study, parts, page_figures)
    for name, data in parts.items():
        before = f"{data.get_title(name)}: " if name else ""
        if name:
            yield _format_part_heading(data, name), build_paragraphs([_describe_counts(data)])
        yield from (
            (before + heading, inside) for heading, inside in iterate_part_sections(data, page_figures, name or "study")
        )


def _format_part_heading(study_data: StudyData, name: str) -> str:
    """Return the heading of a part: "Part" and the title of its name."""
    return f"Part {study_data.get_title(name)}"


def _list_chapters(sections: list[Section], parts: dict[str, StudyData]) -> list[str]:
    """Return the headings of the table of contents: those before the first part, and that of each part."""
    part_headings = [_format_part_heading(data, name) for name, data in parts.items()]
    return [name for name, _ in sections[: [name for name, _ in sections].index(part_headings[0])]] + part_headings


def _read_claim_totals(study: Study) -> list[str]:
    """Return the summary lines of the claims, as `JudgedClaims.totals`; empty for a study without claims."""
    try:
        return study.claims.totals()
    except GudgeonError:  # the study file has no claims
        return []


def iterate_part_sections(
    study_data: StudyData, page_figures: PageFigures, figure_prefix: str = "study"
) -> Iterator[Section]:
    """Yield heading and HTML of each section of a part: varied quantities, failures, notes, measures, figures.

    figure_prefix: prefix of the figures' names. page_figures: receives the figures. Without matplotlib a line on its
    installation replaces the figures and the section of series.
    """
    study = study_data.study
    yield (
        "Varied quantities",
        build_table(("", "over", "values", "unit", ""), _iterate_coordinate_rows(study_data), True),
    )
    failure_rows = ((str(count), kind, message) for kind, count, message in study_data.iterate_failures())
    yield "Failed runs", build_table(("runs", "reason", "first failed run"), failure_rows, True)
    yield "Notes", build_paragraphs(study.notes)
    yield "Measures", _format_measure_table(study_data)
    try:
        import gudgeon.studies.show.study_plots  # noqa: F401 (without matplotlib its error names the package)
    except GudgeonError as error:
        yield "Figures", build_paragraphs([str(error)])
        return
    yield "Figures", format_gallery(_iterate_measure_figures(study_data), f"{figure_prefix}-measure", page_figures)
    yield "Series", format_gallery(_iterate_series_figures(study_data), f"{figure_prefix}-series", page_figures)


def _describe_study(parts: dict[str, StudyData]) -> str:
    """Return one line on a study: numbers of runs and failures, mechanism, version of gudgeon, digest of the file."""
    attributes = next(iter(parts.values())).dataset.attrs
    runs, failed = (sum(getattr(data.study, name) for data in parts.values()) for name in ("runs", "failed"))
    total_counts = f"{format_count(runs, 'run')} in {len(parts)} parts, {failed or 'none'} failed"
    counts = total_counts if len(parts) > 1 else _describe_counts(next(iter(parts.values())))
    versions = f"gudgeon {attributes['gudgeon']} · file {str(attributes['sha256'])[:12]}"
    return f"{counts} · mechanism {attributes['mechanism']} · {versions}"


def _describe_counts(study_data: StudyData) -> str:
    """Return one line on a part: "72 runs (scene 2 × c 3 × start 12), none failed"."""
    study = study_data.study
    sizes = " × ".join(
        f"{study_data.get_title(name)} {size}" for name, size in study_data.dataset["t_last"].sizes.items()
    )
    failed = f", {study.failed} failed" if study.failed else ", none failed"
    return f"{format_count(study.runs, 'run')}{f' ({sizes})' if sizes else ''}{failed}"


def _iterate_coordinate_rows(study_data: StudyData) -> Iterator[tuple[str, ...]]:
    """Yield a table row for each coordinate of the dataset: title, other dimensions, values, unit, meaning.

    Sample times are left out. Values are written as in the study file if possible. Of more than MAX_SHOWN_VALUES
    numbers, the row has the smallest, the largest and their count.
    """
    for name, coordinate in study_data.dataset.coords.items():
        if name in ("time", "sample"):
            continue
        dimensions_text = ", ".join(map(study_data.get_title, coordinate.dims)) if coordinate.dims != (name,) else ""
        unit, meaning = str(coordinate.attrs.get("units", "")), str(coordinate.attrs.get("long_name", ""))
        values = np.ravel(coordinate.values)
        if values.dtype.kind in "OU":
            yield (
                study_data.get_title(name),
                dimensions_text,
                _format_value_list([study_data.get_title(value) for value in values]),
                "",
                meaning,
            )
            continue
        if written := study_data.get_written_values(str(name)):
            yield study_data.get_title(name), dimensions_text, _format_value_list(list(written)), "", meaning
            continue
        factor, unit_text = choose_plot_unit(float(np.abs(values).max(initial=0.0)), unit)
        is_short = len(values) <= MAX_SHOWN_VALUES and not (values.dtype.kind == "i" and len(values) > 2)
        shown_values = values if is_short or not values.size else np.array([values.min(), values.max()])
        value_texts = [f"{float(value) * factor + 0.0:.6g}" for value in shown_values]
        values_text = ", ".join(value_texts) if is_short else f"{' … '.join(value_texts)}, {len(values)} values"
        yield study_data.get_title(name), dimensions_text, values_text, unit_text, meaning


def _format_value_list(value_texts: list[str]) -> str:
    """Return up to MAX_SHOWN_VALUES texts joined by commas; of more the first, the last and their count."""
    return (
        ", ".join(value_texts)
        if len(value_texts) <= MAX_SHOWN_VALUES
        else f"{value_texts[0]} … {value_texts[-1]}, {len(value_texts)} values"
    )


def _format_measure_table(study_data: StudyData) -> str:
    """Return the HTML table of the measures of a part, with a footnote; "" without measures.

    There is a row for each combination of coordinates, and a column for each measure. A cell has the median and
    quartiles of the measure over POOLED_DIMENSIONS (starts, draws, ensembles), or the value of the only run. Rows
    beyond MAX_ROWS are omitted, and the footnote has their number.
    """
    names, rows, omitted = study_data.study.measures, dict[tuple[str, ...], list[str]](), 0
    if not names:
        return ""
    dims, units, has_spread = [], [], False
    for name in names:
        variable = study_data.dataset[name]
        dims = [str(dim) for dim in variable.dims if dim not in POOLED_DIMENSIONS]
        has_spread = any(dim in POOLED_DIMENSIONS for dim in variable.dims)
        factor, unit = choose_plot_unit(
            float(np.nanmax(np.abs(np.nan_to_num(variable.values)), initial=0.0)), study_data.get_unit(name)
        )
        units.append(unit)
        for coordinates, values in study_data.iterate_spreads(name):
            key = tuple(coordinates.values())
            if key not in rows and len(rows) >= MAX_ROWS:
                omitted += name == names[0]
                continue
            rows.setdefault(key, []).append(_format_spread(values * factor, has_spread))
    column_names = [study_data.format_value_labels(dim)[1] for dim in dims]
    column_names += [format_label(study_data.get_title(name), unit) for name, unit in zip(names, units, strict=True)]
    pooled_titles = [study_data.get_title(dim) for dim in study_data.dataset[names[0]].dims if dim in POOLED_DIMENSIONS]
    footnotes = [
        f"median (quartiles) over {', '.join(pooled_titles)}; n: number of runs with a value, if some have none"
    ] * has_spread
    footnotes += [f"{omitted} further rows are in the dataset"] * bool(omitted)
    return build_table(column_names, ([*key, *cells] for key, cells in rows.items())) + build_paragraphs(
        footnotes, "g-quiet"
    )


def _format_spread(values: Any, has_spread: bool) -> str:
    """Return the table cell of some runs: "1.2 (1.1 … 1.4)", median and quartiles of the finite values.

    "n = 3" is added if some values are not finite. has_spread False: the first finite value alone. "–" without finite
    values.
    """
    finite_values = values[np.isfinite(values)]
    if not finite_values.size:
        return "–"
    if not has_spread:
        return f"{finite_values[0]:.5g}"
    q1, middle, q3 = np.quantile(finite_values, (0.25, 0.5, 0.75))
    count_text = f" n = {finite_values.size}" if finite_values.size < values.size else ""
    return f"{middle:.4g} ({q1:.4g} … {q3:.4g}){count_text}"


def _iterate_measure_figures(study_data: StudyData) -> Iterator[CaptionedFigure]:
    """Yield caption and drawing function of each measure over its axis dimension, and of heat maps over its first two.

    Measures without dimensions or finite values are left out. Heat maps are drawn for each scene, over dimensions other
    than POOLED_DIMENSIONS, unless all values are 0 or NaN.
    """
    from gudgeon.studies.show.study_plots import StudyPlot

    plot = StudyPlot(study_data.study)
    for name in study_data.study.measures:
        variable = study_data.dataset[name]
        if not variable.dims or not np.isfinite(variable.values).any():
            continue
        yield (
            f"{study_data.get_title(name)}: {_describe_pooled_runs(study_data, variable)}",
            partial(plot.measure, name, published=True),
        )
        varied = [str(dim) for dim in variable.dims if dim != "scene" and dim not in POOLED_DIMENSIONS]
        if len(varied) < 2:
            continue
        for scene in [str(dim) for dim in study_data.dataset["scene"].values] if "scene" in variable.dims else [""]:
            coordinates = {"scene": scene} if scene else {}
            if not np.nan_to_num(study_data.select_measure(name, coordinates).values).any():  # all values are NaN or 0
                continue
            caption = ", ".join(filter(None, (f"{study_data.get_title(name)}: median", study_data.get_title(scene))))
            yield caption, partial(plot.heat_map, name, *varied[:2], at=coordinates)


def _describe_pooled_runs(study_data: StudyData, measure: Any) -> str:
    """Return in words over which dimensions the figure of a measure has statistics; "of each run" for none."""
    over = study_data.choose_axis_dimension(measure)
    others = [str(dim) for dim in measure.dims if dim not in (over, study_data.choose_line_dimension(measure, over))]
    return (
        f"median, quartiles and extremes over {', '.join(map(study_data.get_title, others))}"
        if others
        else "of each run"
    )


def _iterate_series_figures(study_data: StudyData) -> Iterator[CaptionedFigure]:
    """Yield caption and drawing function of the bands (median, quartiles, extremes) of each stored series over time.

    If runs have different sample times, the bands are over fractions of each run's duration. Series that are empty or
    exceed MAX_SERIES_VALUES or MAX_SERIES_SAMPLES are left out.
    """
    from gudgeon.studies.show.study_plots import StudyPlot

    plot = StudyPlot(study_data.study)
    for name in study_data.stored_series:
        variable = study_data.dataset[name]
        if variable.size > MAX_SERIES_VALUES or variable.shape[-1] > MAX_SERIES_SAMPLES or not variable.size:
            continue
        t, _ = study_data.select_series(name)
        runs = variable.size // variable.shape[-1]
        line_dimension = "scene" if "scene" in variable.dims else None
        over_fractions = t.ndim > 1
        if over_fractions and not (np.nan_to_num(t) > 0.0).any():  # no run began
            continue
        caption = f"{study_data.get_title(name)}: median, quartiles and extremes of {format_count(runs, 'run')}"
        yield (
            caption + ", over fractions of the run" * over_fractions,
            partial(plot.bands, name, line_dimension, share=over_fractions),
        )
