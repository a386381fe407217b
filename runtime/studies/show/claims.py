"""Show the claims of a study on its page: published numbers and trends, one a row, next to the study's own."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.plot_units import choose_plot_unit
from gudgeon.results.reports.html_page import Section, build_paragraphs, build_table
from gudgeon.studies.show.pictures import CaptionedFigure, PageFigures, format_gallery

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.studies.ensemble.finished import Study
    from gudgeon.studies.show.study_data import StudyData

Row = Mapping[str, Any]  # of a table of claims: a claim and an ensemble
LOG_SCALE_RATIO = 30.0  # times the least, from which on an axis of values is logarithmic
MAX_TICK_LINE_LENGTH, MAX_TICK_LINES = (
    22,
    4,
)  # characters of a line of where a number was taken, and lines, that stand under it
NOTE = "note"
NUMBERS, TRENDS, ALONE = "Published numbers", "Published trends", "Ours alone"  # headings of claims without one


def build_claims_sections(study: Study, parts: Mapping[str, StudyData], page_figures: PageFigures) -> list[Section]:
    """Return the sections of a page on the claims of a study: published numbers with figures, trends, headings of the
    file.

    parts: data of the study's parts. page_figures: receives the figures. Empty for a study without claims.
    """
    try:
        claims = study.claims
    except GudgeonError:  # its file makes no claims
        return []
    claim_names = _ClaimNames(parts)
    numbers, trends = (list(_group_by_claim(table.to_dict("records"))) for table in (claims.numbers, claims.trends))
    source = build_paragraphs([claims.source] * bool(claims.source), "g-quiet")
    number_headings = [_choose_heading(rows[0], NUMBERS if _is_published(rows[0]) else ALONE) for rows in numbers]
    trend_headings = [_choose_heading(rows[0], TRENDS) for rows in trends]
    sections = []
    for k, heading in enumerate(_order_headings(number_headings + trend_headings)):
        number_rows = [rows for rows, name in zip(numbers, number_headings, strict=True) if name == heading]
        published = [rows for rows in number_rows if _is_published(rows[0])]
        figures_html = format_gallery(_iterate_claim_figures(published, claim_names), f"claims{k or ''}", page_figures)
        unpublished_html = _format_unpublished_table(
            [rows for rows in number_rows if not _is_published(rows[0])], claim_names
        )
        trend_html = _format_trend_table(
            [rows for rows, name in zip(trends, trend_headings, strict=True) if name == heading], claim_names
        )
        sections.append(
            (
                heading,
                source * (heading in (NUMBERS, TRENDS))
                + _format_number_table(published, claim_names)
                + figures_html
                + unpublished_html
                + trend_html,
            )
        )
    return sections


def _is_published(row: Row) -> bool:
    """Return whether a number was published: it has a printed value or belongs to a figure."""
    return not _is_missing(row["printed"]) or bool(row["figure"])


def _choose_heading(row: Row, default: str) -> str:
    """Return the heading under which a claim is shown, or the default if it has none."""
    return str(row.get("heading") or default)


def _order_headings(headings: list[str]) -> list[str]:
    """Return the headings without repetitions: published numbers, trends, those of the file in order, unpublished
    numbers.
    """
    other_headings = [name for name in dict.fromkeys(headings) if name not in (NUMBERS, TRENDS, ALONE)]
    return [name for name in (NUMBERS, TRENDS, *other_headings, ALONE) if name in headings]


class _ClaimNames:
    """Names and locations of claims for display."""

    def __init__(self, parts: Mapping[str, StudyData]) -> None:
        """Store the data of the parts, by name; titles are those of the first part."""
        self.parts = parts
        self.get_title = next(iter(parts.values())).get_title

    def describe_cell(self, row: Row) -> str:
        """Return the coordinates of a number's cell in words: "c = 0.3 mm"; the stored text in folders of earlier
        versions.
        """
        if "place" not in row:  # a folder that an earlier version judged
            return str(row["at"])
        return self.parts[str(row["part"])].describe_cell(json.loads(str(row["place"])))

    def find_scene_title(self, row: Row) -> str:
        """Return the title of the scene of a number's part if it has only one, else ""."""
        scene_coordinate = (
            self.parts[str(row["part"])].dataset.coords.get("scene") if str(row["part"]) in self.parts else None
        )
        return (
            self.get_title(scene_coordinate.item())
            if scene_coordinate is not None and not scene_coordinate.ndim
            else ""
        )

    def describe_number(self, row: Row) -> str:
        """Return a description of a number: the text of the claim, or measure, part and coordinates."""
        part = [self.get_title(row["part"])] * bool(row["part"])
        return str(row["says"]) or ", ".join(
            filter(None, (self.get_title(row["measure"]), *part, self.describe_cell(row)))
        )


def _group_by_claim(rows: Iterable[Row]) -> Iterator[list[Row]]:
    """Yield for each claim its rows, one for every ensemble, in the order of first appearance."""
    claims: dict[str, list[Row]] = {}
    for row in rows:
        claims.setdefault(str(row["claim"]), []).append(row)
    yield from claims.values()


def _list_ensembles(claims: list[list[Row]]) -> list[str]:
    """Return the names of all ensembles of the claims, without repetitions."""
    return list(dict.fromkeys(str(row["ensemble"]) for rows in claims for row in rows if row["ensemble"]))


def _format_number_table(claims: list[list[Row]], claim_names: _ClaimNames) -> str:
    """Return the HTML table of published numbers: printed value, median and quartiles of each ensemble, deviation,
    note.

    Without ensembles there is one column for all runs. Below the table stands a footnote.
    """
    ensembles = _list_ensembles(claims) or [""]
    ours = (f"ours, {claim_names.get_title(name)}" if name else "ours" for name in ensembles)
    head = ["", "figure", "what", "printed", *ours, "off by", "note"]
    footnote = ["ours: median (quartiles); off by: of the medians from what is printed"]
    every = (
        _format_number_cells(rows, ensembles, claim_names, *_choose_unit(_select_claims_of_same_measure(claims, rows)))
        for rows in claims
    )
    return _format_table_without_empty_columns(head, every) + build_paragraphs(footnote * bool(claims), "g-quiet")


def _select_claims_of_same_measure(claims: list[list[Row]], claim_rows: list[Row]) -> list[list[Row]]:
    """Return the claims with the same figure and measure as the claim of `claim_rows`; they share a unit."""
    return [rows for rows in claims if all(rows[0][key] == claim_rows[0][key] for key in ("figure", "measure"))]


def _choose_unit(claims: list[list[Row]]) -> tuple[float, str]:
    """Return factor and text of the unit that suits the largest value of these claims."""
    return choose_plot_unit(max(map(_find_largest_magnitude, claims)), str(claims[0][0]["unit"]))


def _format_number_cells(
    rows: list[Row], ensembles: list[str], claim_names: _ClaimNames, factor: float, unit: str
) -> list[str]:
    """Return the cells of a published number: claim, figure, description, printed value, medians, deviation, note.

    rows: one for each ensemble. ensembles: their names, with a column each. factor, unit: of all values.
    """
    first, row_by_ensemble = rows[0], {str(row["ensemble"]): row for row in rows}
    printed = "–" if _is_missing(first["printed"]) else _append_unit(first["printed"] * factor, unit)
    cells = [
        _format_median_cell(row_by_ensemble.get(name) or (rows[0] if len(rows) == 1 and k == 0 else None), factor, unit)
        for k, name in enumerate(ensembles)
    ]
    deviations = sorted(row["deviation"] for row in rows if not _is_missing(row["deviation"]))
    ends = list(dict.fromkeys(f"{value:+.1f}".replace("-", "−") for value in (*deviations[:1], *deviations[-1:])))
    deviation_text = f"{' … '.join(ends)} %" if deviations else ""
    return [
        str(first["claim"]),
        str(first["figure"]),
        claim_names.describe_number(first),
        printed,
        *cells,
        deviation_text,
        str(first["note"]),
    ]


def _format_unpublished_table(claims: list[list[Row]], claim_names: _ClaimNames) -> str:
    """Return the HTML table of unpublished numbers: a row for each cell of runs with all its measures.

    A value that the claim compares with another one (`beside`) has the deviation from it in %.
    """
    measures = list(dict.fromkeys(str(rows[0]["measure"]) for rows in claims))
    cells_by_key: dict[tuple[str, str], dict[str, str]] = {}
    units = {name: _choose_unit([rows for rows in claims if rows[0]["measure"] == name]) for name in measures}
    for rows in claims:
        first = rows[0]
        factor, unit = units[str(first["measure"])]
        deviation = "" if _is_missing(first["deviation"]) else f", {first['deviation']:+.1f} %".replace("-", "−")
        what = str(first["says"]) or claim_names.describe_cell(first), claim_names.get_title(first["part"])
        cells_by_name = cells_by_key.setdefault(what, {})
        cells_by_name[str(first["measure"])] = _format_median_cell(first, factor, unit) + deviation
        cells_by_name[NOTE] = "; ".join(filter(None, (cells_by_name.get(NOTE), str(first.get("note") or ""))))
    footnote = ["median (quartiles), and how far it is off from the row that it stands beside"]
    cells = (
        [*what, *(cells_by_name.get(name, "") for name in (*measures, NOTE))]
        for what, cells_by_name in cells_by_key.items()
    )
    return _format_table_without_empty_columns(
        ["what", "part", *map(claim_names.get_title, measures), NOTE], cells
    ) + build_paragraphs(footnote * bool(claims), "g-quiet")


def _format_median_cell(row: Row | None, factor: float, unit: str) -> str:
    """Return median and quartiles of a row, times `factor`, with unit; only the value for one run.

    "" for None (no such ensemble), "–" if no run has the measure.
    """
    if row is None:
        return ""
    if _is_missing(row["median"]):
        return "–"
    middle = _append_unit(row["median"] * factor, unit)
    return middle if row["n"] == 1 else f"{middle} ({row['q25'] * factor:.4g} … {row['q75'] * factor:.4g})"


def _append_unit(value: float, unit: str) -> str:
    """Return a value with four digits and its unit, without a line break between them."""
    return f"{value:.4g}{'' if unit == '°' else chr(160)}{unit}".strip()


def _format_table_without_empty_columns(head: list[str], rows: Iterable[list[str]]) -> str:
    """Return an HTML table without the columns that have a head but no text in any row."""
    every = list(rows)
    kept = [k for k, name in enumerate(head) if not name or any(row[k] for row in every)]
    return build_table([head[k] for k in kept], ([row[k] for k in kept] for row in every), True)


def _format_trend_table(claims: list[list[Row]], claim_names: _ClaimNames) -> str:
    """Return the HTML table of trends with verdict, probability and note, and a footnote that defines them."""
    head = ["", "figure", "what", "verdict", "probability", "one run shows it", "note"]
    footnote = [
        "probability: that the next run shows it, the least of all that the trend says, with the interval in which"
        " it is known (5 % beyond each end), ensemble by ensemble; holds: all of the interval of all runs lies at"
        " 0.8 or above, fails: at 1/3 or below, undecided: neither"
    ]
    return _format_table_without_empty_columns(
        head, (_format_trend_cells(rows, claim_names) for rows in claims)
    ) + build_paragraphs(footnote * bool(claims), "g-quiet")


def _format_trend_cells(rows: list[Row], claim_names: _ClaimNames) -> list[str]:
    """Return the cells of the table row of a trend; `rows` has one row for each ensemble.

    If ensembles contradict each other, the verdict lists that of each.
    """
    first = rows[0]
    each = ", ".join(f"{claim_names.get_title(row['ensemble'])} {row['alone']}" for row in rows)
    verdict = str(first["verdict"]) if first["agreed"] else f"not agreed: {each}"
    odds = (
        _join_distinct(map(_format_probability_cell, rows)),
        _join_distinct(_format_probability(row["chance"]) for row in rows),
    )
    return [str(first["claim"]), str(first["figure"]), str(first["says"]), verdict, *odds, str(first["note"])]


def _format_probability_cell(row: Row) -> str:
    """Return a probability, with its interval in brackets if the interval has a width."""
    message = _format_probability(row["probability"])
    if _is_missing(row["low"]) or row["low"] == row["high"]:
        return message
    return f"{message} ({_format_probability(row['low'])} … {_format_probability(row['high'])})"


def _format_probability(value: Any) -> str:
    """Return a probability with two digits, "–" for None or NaN."""
    return "–" if _is_missing(value) else f"{value:.2g}"


def _join_distinct(values: Iterable[str]) -> str:
    """Return texts joined by commas, or only one of them if all are equal."""
    shown = list(values)
    return shown[0] if len(set(shown)) == 1 else ", ".join(shown)


def _iterate_claim_figures(claims: list[list[Row]], claim_names: _ClaimNames) -> Iterator[CaptionedFigure]:
    """Yield caption and drawing function for each figure and measure of the publication, in the order of the claims.

    Claims without a figure have none.
    """
    groups: dict[tuple[str, str], list[list[Row]]] = {}
    for rows in claims:
        if rows[0]["figure"]:
            groups.setdefault((str(rows[0]["figure"]), str(rows[0]["measure"])), []).append(rows)
    for (figure, measure), claim_rows in groups.items():
        printed = "ours alone" if all(_is_missing(rows[0]["printed"]) for rows in claim_rows) else "printed and ours"
        yield f"{figure}: {claim_names.get_title(measure)}, {printed}", partial(_draw_claims, claim_rows, claim_names)


def _draw_claims(claims: list[list[Row]], claim_names: _ClaimNames) -> Axes:
    """Draw the medians with quartiles of each ensemble for several claims, with printed values as black marks, on new
    axes.

    The axis of values is logarithmic if magnitudes differ by more than LOG_SCALE_RATIO. Returns the axes.
    """
    import matplotlib

    from gudgeon.results.figures.plots import COLOURS, STYLE
    from gudgeon.results.figures.run_plots import create_axes

    factor, unit = _choose_unit(claims)
    measure = claim_names.get_title(claims[0][0]["measure"])
    names = _list_ensembles(claims) or [""]
    with matplotlib.rc_context(STYLE):
        ax = create_axes(5.6, 3.2)
        for j, name in enumerate([*names, *[""] * (names != [""])]):  # and what is in no ensemble
            rows_of_ensemble = [
                (k, row)
                for k, rows in enumerate(claims)
                for row in rows
                if row["ensemble"] == name and not _is_missing(row["median"])
            ]
            if not rows_of_ensemble:
                continue
            positions = [k + 0.16 * (j - 0.5 * (len(names) - 1)) * bool(name) for k, _ in rows_of_ensemble]
            middle, low, high = (
                np.array([row[part] for _, row in rows_of_ensemble]) * factor for part in ("median", "q25", "q75")
            )
            error_bars = middle - low, high - middle
            ax.errorbar(
                positions,
                middle,
                error_bars,
                fmt="o",
                color=COLOURS[j % len(COLOURS)],
                ms=3.5,
                capsize=2.0,
                lw=1.0,
                label=claim_names.get_title(name) if name else "ours" if names == [""] else "ours, one run",
            )
        printed = [rows[0]["printed"] * factor for rows in claims if not _is_missing(rows[0]["printed"])]
        printed_positions = [k for k, rows in enumerate(claims) if not _is_missing(rows[0]["printed"])]
        ax.plot(printed_positions, printed, "k_", ms=16, mew=1.6, label="printed" if printed else None)
        has_several_parts = len({str(rows[0]["part"]) for rows in claims}) > 1
        ax.set_xticks(
            range(len(claims)),
            [_format_tick_label(rows[0], claim_names, has_several_parts) for rows in claims],
            fontsize=7,
        )
        ax.set_xlim(-0.6, len(claims) - 0.4)
        ax.grid(False, axis="x")
        medians = (row["median"] * factor for rows in claims for row in rows if not _is_missing(row["median"]))
        magnitudes = [abs(value) for value in (*printed, *medians) if value]
        if magnitudes and min(magnitudes) > 0.0 and max(magnitudes) > LOG_SCALE_RATIO * min(magnitudes):
            ax.set_yscale("log")
        else:
            ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
        ax.set_ylabel(f"{measure} [{unit}]" if unit else measure)
        ax.legend(fontsize=7, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(names) + 2)
    return ax


def _format_tick_label(row: Row, claim_names: _ClaimNames, with_scene: bool) -> str:
    """Return the label of a claim at the axis, on several lines: name, with `with_scene` the scene, and short
    coordinates.
    """
    coordinate_texts = claim_names.describe_cell(row).split(", ")
    coordinates = (
        coordinate_texts
        if max(map(len, coordinate_texts)) <= MAX_TICK_LINE_LENGTH and len(coordinate_texts) <= MAX_TICK_LINES
        else []
    )
    return "\n".join(
        filter(None, (str(row["claim"]), claim_names.find_scene_title(row) if with_scene else "", *coordinates))
    )


def _find_largest_magnitude(rows: list[Row]) -> float:
    """Return the largest magnitude of the printed value and the medians of a claim; 0 if it has none."""
    values = (rows[0]["printed"], *(row["median"] for row in rows))
    return max((abs(value) for value in values if not _is_missing(value)), default=0.0)


def _is_missing(value: Any) -> bool:
    """Return whether a value is None or NaN."""
    return value is None or (isinstance(value, float) and math.isnan(value))
