"""Build the sections of a report on the claims of a study: tables of published numbers and trends, and figures."""

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

Row = Mapping[str, Any]  # row of a table of claims, for one claim and one ensemble
LOG_SCALE_RATIO = 30.0  # ratio of the largest to the smallest magnitude above which the axis is logarithmic
MAX_TICK_LINE_LENGTH, MAX_TICK_LINES = 22, 4  # maximum length (characters) and number of coordinates of a tick label
NOTE = "note"
NUMBERS, TRENDS = "Published numbers", "Published trends"  # headings of claims without a heading
UNPUBLISHED = "Computed only"  # heading of numbers that were not published


def build_claims_sections(study: Study, parts: Mapping[str, StudyData], page_figures: PageFigures) -> list[Section]:
    """Return the sections (heading, HTML) of a report on the claims of a study: numbers with figures, and trends.

    There is a section for each heading of `_order_headings`. parts: data of the study's parts by name. page_figures:
    the figures are registered there. Empty for a study without claims.
    """
    try:
        claims = study.claims
    except GudgeonError:  # the study file has no claims
        return []
    claim_names = _ClaimNames(parts)
    numbers, trends = (list(_group_by_claim(table.to_dict("records"))) for table in (claims.numbers, claims.trends))
    source = build_paragraphs([claims.source] * bool(claims.source), "g-quiet")
    number_headings = [_choose_heading(rows[0], NUMBERS if _is_published(rows[0]) else UNPUBLISHED) for rows in numbers]
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
    """Return whether a number was published: it has a printed value, or names a figure of the publication."""
    return not _is_missing(row["printed"]) or bool(row["figure"])


def _choose_heading(row: Row, default: str) -> str:
    """Return the heading of the claim in the study file, or `default` if it has none."""
    return str(row.get("heading") or default)


def _order_headings(headings: list[str]) -> list[str]:
    """Return the headings without repetitions: NUMBERS, TRENDS, those of the study file in order, UNPUBLISHED."""
    other_headings = [name for name in dict.fromkeys(headings) if name not in (NUMBERS, TRENDS, UNPUBLISHED)]
    return [name for name in (NUMBERS, TRENDS, *other_headings, UNPUBLISHED) if name in headings]


class _ClaimNames:
    """Texts that describe claims for display: titles, scenes and coordinates of their cells of runs."""

    def __init__(self, parts: Mapping[str, StudyData]) -> None:
        """Store the data of the parts by name ("" for a file without parts); titles are those of the first part."""
        self.parts = parts
        self.get_title = next(iter(parts.values())).get_title

    def describe_cell(self, row: Row) -> str:
        """Return the coordinates of a number's cell of runs in words, with titles: "c = 0.3 mm, ω = 2π rad/s".

        In a folder of an earlier version it is the stored text.
        """
        if "place" not in row:  # a folder of an earlier version
            return str(row["at"])
        return self.parts[str(row["part"])].describe_cell(json.loads(str(row["place"])))

    def find_scene_title(self, row: Row) -> str:
        """Return the title of the scene of a number's part; "" if the part is unknown or has several scenes."""
        scene_coordinate = (
            self.parts[str(row["part"])].dataset.coords.get("scene") if str(row["part"]) in self.parts else None
        )
        return (
            self.get_title(scene_coordinate.item())
            if scene_coordinate is not None and not scene_coordinate.ndim
            else ""
        )

    def describe_number(self, row: Row) -> str:
        """Return a description of a number: its statement `says`, else its measure, part and coordinates."""
        part = [self.get_title(row["part"])] * bool(row["part"])
        return str(row["says"]) or ", ".join(
            filter(None, (self.get_title(row["measure"]), *part, self.describe_cell(row)))
        )


def _group_by_claim(rows: Iterable[Row]) -> Iterator[list[Row]]:
    """Yield for each claim the list of its rows, one for every ensemble; claims in the order of their first rows."""
    claims: dict[str, list[Row]] = {}
    for row in rows:
        claims.setdefault(str(row["claim"]), []).append(row)
    yield from claims.values()


def _list_ensembles(claims: list[list[Row]]) -> list[str]:
    """Return the names of all ensembles of the claims, without repetitions; empty if no claim has a named one."""
    return list(dict.fromkeys(str(row["ensemble"]) for rows in claims for row in rows if row["ensemble"]))


def _format_number_table(claims: list[list[Row]], claim_names: _ClaimNames) -> str:
    """Return the HTML table of published numbers with a footnote: printed value, medians and quartiles, deviation.

    claims: a list of rows for each claim. There is a column for each ensemble, or one for all runs without ensembles.
    """
    ensembles = _list_ensembles(claims) or [""]
    computed = (f"computed, {claim_names.get_title(name)}" if name else "computed" for name in ensembles)
    head = ["", "figure", "number", "printed", *computed, "deviation", "note"]
    footnote = ["computed: median (quartiles); deviation: of the medians, relative to the printed value"]
    rows_of_cells = (
        _format_number_cells(rows, ensembles, claim_names, *_choose_unit(_select_claims_of_same_measure(claims, rows)))
        for rows in claims
    )
    return _format_table_without_empty_columns(head, rows_of_cells) + build_paragraphs(
        footnote * bool(claims), "g-quiet"
    )


def _select_claims_of_same_measure(claims: list[list[Row]], claim_rows: list[Row]) -> list[list[Row]]:
    """Return the claims with the same figure and measure as the claim of `claim_rows`, which share its display unit."""
    return [rows for rows in claims if all(rows[0][key] == claim_rows[0][key] for key in ("figure", "measure"))]


def _choose_unit(claims: list[list[Row]]) -> tuple[float, str]:
    """Return the factor from SI and the text of the display unit for the largest value of these claims."""
    return choose_plot_unit(max(map(_find_largest_magnitude, claims)), str(claims[0][0]["unit"]))


def _format_number_cells(
    rows: list[Row], ensembles: list[str], claim_names: _ClaimNames, factor: float, unit: str
) -> list[str]:
    """Return the texts of a table row of a published number: claim, figure, description, printed, medians, deviation,
    note.

    rows: one for each ensemble. ensembles: names of the columns; a claim without ensembles has its median in the first.
    factor, unit: display unit, factor from SI. The deviation is the range over the ensembles, in %.
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
    """Return the HTML table of unpublished numbers with a footnote: a row for each statement or cell of runs.

    It has a column for each measure. A number that is compared with another number (key `beside`) has the deviation
    from it in %.
    """
    measures = list(dict.fromkeys(str(rows[0]["measure"]) for rows in claims))
    cells_by_key: dict[tuple[str, str], dict[str, str]] = {}
    units = {name: _choose_unit([rows for rows in claims if rows[0]["measure"] == name]) for name in measures}
    for rows in claims:
        first = rows[0]
        factor, unit = units[str(first["measure"])]
        deviation = "" if _is_missing(first["deviation"]) else f", {first['deviation']:+.1f} %".replace("-", "−")
        key = str(first["says"]) or claim_names.describe_cell(first), claim_names.get_title(first["part"])
        cells_by_name = cells_by_key.setdefault(key, {})
        cells_by_name[str(first["measure"])] = _format_median_cell(first, factor, unit) + deviation
        cells_by_name[NOTE] = "; ".join(filter(None, (cells_by_name.get(NOTE), str(first.get("note") or ""))))
    footnote = ["median (quartiles), and its deviation from the number with which it is compared"]
    cells = (
        [*key, *(cells_by_name.get(name, "") for name in (*measures, NOTE))]
        for key, cells_by_name in cells_by_key.items()
    )
    return _format_table_without_empty_columns(
        ["number", "part", *map(claim_names.get_title, measures), NOTE], cells
    ) + build_paragraphs(footnote * bool(claims), "g-quiet")


def _format_median_cell(row: Row | None, factor: float, unit: str) -> str:
    """Return the table cell of a row: "1.2 mm (1.1 … 1.4)", median and quartiles; the value alone for one run.

    factor: from SI to `unit`. "" for None (the claim lacks the ensemble), "–" if no run has the measure.
    """
    if row is None:
        return ""
    if _is_missing(row["median"]):
        return "–"
    middle = _append_unit(row["median"] * factor, unit)
    return middle if row["n"] == 1 else f"{middle} ({row['q25'] * factor:.4g} … {row['q75'] * factor:.4g})"


def _append_unit(value: float, unit: str) -> str:
    """Return a value with four digits and its unit, joined by a no-break space, or by nothing for degrees."""
    return f"{value:.4g}{'' if unit == '°' else chr(160)}{unit}".strip()


def _format_table_without_empty_columns(head: list[str], rows: Iterable[list[str]]) -> str:
    """Return an HTML table without the columns that have no text in any row; a column without a head stays."""
    row_list = list(rows)
    filled_columns = [k for k, name in enumerate(head) if not name or any(row[k] for row in row_list)]
    return build_table([head[k] for k in filled_columns], ([row[k] for k in filled_columns] for row in row_list), True)


def _format_trend_table(claims: list[list[Row]], claim_names: _ClaimNames) -> str:
    """Return the HTML table of trends with verdict, probability and note, and a footnote that defines the columns.

    claims: a list of rows for each claim.
    """
    head = ["", "figure", "trend", "verdict", "probability", "one run shows it", "note"]
    footnote = [
        "probability: that a further run satisfies the trend, the smallest of all its conditions, with the confidence"
        " interval (5 % beyond each end), for each ensemble; verdict: holds if the interval of all runs lies at 0.8 or"
        " above, fails if it lies at 1/3 or below, else undecided"
    ]
    return _format_table_without_empty_columns(
        head, (_format_trend_cells(rows, claim_names) for rows in claims)
    ) + build_paragraphs(footnote * bool(claims), "g-quiet")


def _format_trend_cells(rows: list[Row], claim_names: _ClaimNames) -> list[str]:
    """Return the texts of the table row of a trend: claim, figure, statement, verdict, probabilities, note.

    rows: one for each ensemble. If the ensembles disagree, the verdict is "ensembles disagree" with the verdict of
    each.
    """
    first = rows[0]
    verdicts_text = ", ".join(f"{claim_names.get_title(row['ensemble'])} {row['alone']}" for row in rows)
    verdict = str(first["verdict"]) if first["agreed"] else f"ensembles disagree: {verdicts_text}"
    probability_cells = (
        _join_distinct(map(_format_probability_cell, rows)),
        _join_distinct(_format_probability(row["chance"]) for row in rows),
    )
    return [
        str(first["claim"]),
        str(first["figure"]),
        str(first["says"]),
        verdict,
        *probability_cells,
        str(first["note"]),
    ]


def _format_probability_cell(row: Row) -> str:
    """Return a probability with its interval, "0.9 (0.8 … 1)", or alone if the interval has no width or is missing."""
    message = _format_probability(row["probability"])
    if _is_missing(row["low"]) or row["low"] == row["high"]:
        return message
    return f"{message} ({_format_probability(row['low'])} … {_format_probability(row['high'])})"


def _format_probability(probability: Any) -> str:
    """Return a probability as text with two digits; "–" for None or NaN."""
    return "–" if _is_missing(probability) else f"{probability:.2g}"


def _join_distinct(values: Iterable[str]) -> str:
    """Return texts joined by commas, or a single one if all are equal; "" without texts."""
    shown = list(values)
    return shown[0] if len(set(shown)) == 1 else ", ".join(shown)


def _iterate_claim_figures(claims: list[list[Row]], claim_names: _ClaimNames) -> Iterator[CaptionedFigure]:
    """Yield caption and drawing function for each pair of figure and measure of the publication, in the order of
    claims.

    Claims without a figure are left out.
    """
    groups: dict[tuple[str, str], list[list[Row]]] = {}
    for rows in claims:
        if rows[0]["figure"]:
            groups.setdefault((str(rows[0]["figure"]), str(rows[0]["measure"])), []).append(rows)
    for (figure, measure), claim_rows in groups.items():
        has_printed = not all(_is_missing(rows[0]["printed"]) for rows in claim_rows)
        contents = "printed and computed" if has_printed else "computed"
        yield f"{figure}: {claim_names.get_title(measure)}, {contents}", partial(_draw_claims, claim_rows, claim_names)


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
        for j, name in enumerate([*names, *[""] * (names != [""])]):  # then the numbers without an ensemble
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
                label=claim_names.get_title(name) if name else "computed" if names == [""] else "computed, one run",
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
    """Return the tick label of a claim on the horizontal axis, one line each: its name, its scene, its coordinates.

    The scene is left out unless `with_scene`, or if its part has several scenes. All coordinates are left out if one is
    longer than MAX_TICK_LINE_LENGTH characters or there are more than MAX_TICK_LINES.
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
    """Return the largest magnitude (SI) of the printed value and the medians of a claim; 0 if it has none."""
    values = (rows[0]["printed"], *(row["median"] for row in rows))
    return max((abs(value) for value in values if not _is_missing(value)), default=0.0)


def _is_missing(value: Any) -> bool:
    """Return whether a value is None or NaN."""
    return value is None or (isinstance(value, float) and math.isnan(value))
