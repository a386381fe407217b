"""Show the claims of a study on its page: published numbers and trends, one a row, next to the study's own."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.language.plot_units import drawn
from gudgeon.results.reports.html_page import Section, lines, table
from gudgeon.studies.show.pictures import Draw, Pictures, gallery

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gudgeon.studies.ensemble.finished import Study
    from gudgeon.studies.show.study_data import StudyData

Row = Mapping[str, Any]  # of a table of claims: a claim and an ensemble
LARGE = 30.0  # times the least, from which on an axis of values is logarithmic
SHORT, MOST_LINES = 22, 4  # characters of a line of where a number was taken, and lines, that stand under it
NOTE = "note"
NUMBERS, TRENDS, ALONE = "Published numbers", "Published trends", "Ours alone"  # headings of claims without one


def claims_sections(study: Study, parts: Mapping[str, StudyData], pictures: Pictures) -> list[Section]:
    """Return the sections of published numbers with figures, of trends, and of the headings of the file.

    Empty for a study without claims.
    """
    try:
        found = study.claims
    except GudgeonError:  # its file makes no claims
        return []
    names_of = _ClaimNames(parts)
    numbers, trends = (list(_group_by_claim(table.to_dict("records"))) for table in (found.numbers, found.trends))
    source = lines([found.source] * bool(found.source), "g-quiet")
    own = [_heading(rows[0], NUMBERS if _is_published(rows[0]) else ALONE) for rows in numbers]
    judged = [_heading(rows[0], TRENDS) for rows in trends]
    shown = []
    for k, heading in enumerate(_order_headings(own + judged)):
        under = [rows for rows, name in zip(numbers, own, strict=True) if name == heading]
        theirs = [rows for rows in under if _is_published(rows[0])]
        drawn = gallery(_claim_figures(theirs, names_of), f"claims{k or ''}", pictures)
        alone = _unpublished_table([rows for rows in under if not _is_published(rows[0])], names_of)
        specified = _trend_table([rows for rows, name in zip(trends, judged, strict=True) if name == heading], names_of)
        shown.append(
            (
                heading,
                source * (heading in (NUMBERS, TRENDS)) + _number_table(theirs, names_of) + drawn + alone + specified,
            )
        )
    return shown


def _is_published(row: Row) -> bool:
    """Return whether a number was published: it has a printed value or belongs to a figure."""
    return not _is_missing(row["printed"]) or bool(row["figure"])


def _heading(row: Row, otherwise: str) -> str:
    """Return the heading of a claim, or a default."""
    return str(row.get("heading") or otherwise)


def _order_headings(headings: list[str]) -> list[str]:
    """Return the headings without repetitions: published ones, those of the file, and the default ones."""
    own = [name for name in dict.fromkeys(headings) if name not in (NUMBERS, TRENDS, ALONE)]
    return [name for name in (NUMBERS, TRENDS, *own, ALONE) if name in headings]


class _ClaimNames:
    """Names and locations of claims for display."""

    def __init__(self, parts: Mapping[str, StudyData]) -> None:
        """Store the data of the parts."""
        self.parts = parts
        self.shown = next(iter(parts.values())).shown

    def at(self, row: Row) -> str:
        """Return the coordinates of a number's cell."""
        if "place" not in row:  # a folder that an earlier version judged
            return str(row["at"])
        return self.parts[str(row["part"])].where(json.loads(str(row["place"])))

    def scene(self, row: Row) -> str:
        """Return the scene of a number's part if it has only one, else ""."""
        found = self.parts[str(row["part"])].dataset.coords.get("scene") if str(row["part"]) in self.parts else None
        return self.shown(found.item()) if found is not None and not found.ndim else ""

    def what(self, row: Row) -> str:
        """Return a number in words: its own text, or measure, part and coordinates."""
        part = [self.shown(row["part"])] * bool(row["part"])
        return str(row["says"]) or ", ".join(filter(None, (self.shown(row["measure"]), *part, self.at(row))))


def _group_by_claim(rows: Iterable[Row]) -> Iterator[list[Row]]:
    """Yield the rows of each claim, one for every ensemble."""
    claims: dict[str, list[Row]] = {}
    for row in rows:
        claims.setdefault(str(row["claim"]), []).append(row)
    yield from claims.values()


def _ensemble_names(claims: list[list[Row]]) -> list[str]:
    """Return the names of all ensembles of the claims."""
    return list(dict.fromkeys(str(row["ensemble"]) for rows in claims for row in rows if row["ensemble"]))


def _number_table(claims: list[list[Row]], names_of: _ClaimNames) -> str:
    """Return the table of published numbers: median and quartiles of each ensemble, or of all runs."""
    names = _ensemble_names(claims) or [""]
    ours = (f"ours, {names_of.shown(name)}" if name else "ours" for name in names)
    head = ["", "figure", "what", "printed", *ours, "off by", "note"]
    footnote = ["ours: median (quartiles); off by: of the medians from what is printed"]
    every = (_number_cells(rows, names, names_of, *_unit(_same_measure(claims, rows))) for rows in claims)
    return _table_without_empty(head, every) + lines(footnote * bool(claims), "g-quiet")


def _same_measure(claims: list[list[Row]], rows_of_claim: list[Row]) -> list[list[Row]]:
    """Return the claims with the same measure in the same figure as `one`; they share a unit."""
    return [rows for rows in claims if all(rows[0][key] == rows_of_claim[0][key] for key in ("figure", "measure"))]


def _unit(claims: list[list[Row]]) -> tuple[float, str]:
    """Return factor and text of the unit that suits the largest of these numbers."""
    return drawn(max(map(_largest_magnitude, claims)), str(claims[0][0]["unit"]))


def _number_cells(rows: list[Row], names: list[str], names_of: _ClaimNames, factor: float, unit: str) -> list[str]:
    """Return the cells of a published number."""
    first, own = rows[0], {str(row["ensemble"]): row for row in rows}
    printed = "–" if _is_missing(first["printed"]) else _with_unit(first["printed"] * factor, unit)
    cells = [
        _median_cell(own.get(name) or (rows[0] if len(rows) == 1 and k == 0 else None), factor, unit)
        for k, name in enumerate(names)
    ]
    off = sorted(row["deviation"] for row in rows if not _is_missing(row["deviation"]))
    ends = list(dict.fromkeys(f"{value:+.1f}".replace("-", "−") for value in (*off[:1], *off[-1:])))
    message = f"{' … '.join(ends)} %" if off else ""
    return [
        str(first["claim"]),
        str(first["figure"]),
        names_of.what(first),
        printed,
        *cells,
        message,
        str(first["note"]),
    ]


def _unpublished_table(claims: list[list[Row]], names_of: _ClaimNames) -> str:
    """Return the table of unpublished numbers: a row for each cell with all its measures, and deviations from
    `beside`.
    """
    measures = list(dict.fromkeys(str(rows[0]["measure"]) for rows in claims))
    each: dict[tuple[str, str], dict[str, str]] = {}
    units = {name: _unit([rows for rows in claims if rows[0]["measure"] == name]) for name in measures}
    for rows in claims:
        first = rows[0]
        factor, unit = units[str(first["measure"])]
        off = "" if _is_missing(first["deviation"]) else f", {first['deviation']:+.1f} %".replace("-", "−")
        what = str(first["says"]) or names_of.at(first), names_of.shown(first["part"])
        own = each.setdefault(what, {})
        own[str(first["measure"])] = _median_cell(first, factor, unit) + off
        own[NOTE] = "; ".join(filter(None, (own.get(NOTE), str(first.get("note") or ""))))
    footnote = ["median (quartiles), and how far it is off from the row that it stands beside"]
    cells = ([*what, *(own.get(name, "") for name in (*measures, NOTE))] for what, own in each.items())
    return _table_without_empty(["what", "part", *map(names_of.shown, measures), NOTE], cells) + lines(
        footnote * bool(claims), "g-quiet"
    )


def _median_cell(row: Row | None, factor: float, unit: str) -> str:
    """Return median and quartiles as a cell."""
    if row is None:
        return ""
    if _is_missing(row["median"]):
        return "–"
    middle = _with_unit(row["median"] * factor, unit)
    return middle if row["n"] == 1 else f"{middle} ({row['q25'] * factor:.4g} … {row['q75'] * factor:.4g})"


def _with_unit(value: float, unit: str) -> str:
    """Return a value and its unit without a line break between them."""
    return f"{value:.4g}{'' if unit == '°' else chr(160)}{unit}".strip()


def _table_without_empty(head: list[str], rows: Iterable[list[str]]) -> str:
    """Return an HTML table without its empty columns."""
    every = list(rows)
    kept = [k for k, name in enumerate(head) if not name or any(row[k] for row in every)]
    return table([head[k] for k in kept], ([row[k] for k in kept] for row in every), True)


def _trend_table(claims: list[list[Row]], names_of: _ClaimNames) -> str:
    """Return the table of trends: the verdict of all ensembles, or that of each if they contradict each other."""
    head = ["", "figure", "what", "verdict", "probability", "one run shows it", "note"]
    footnote = [
        "probability: that the next run shows it, the least of all that the trend says, with the interval in which"
        " it is known (5 % beyond each end), ensemble by ensemble; holds: all of the interval of all runs lies at"
        " 0.8 or above, fails: at 1/3 or below, undecided: neither"
    ]
    return _table_without_empty(head, (_trend_cells(rows, names_of) for rows in claims)) + lines(
        footnote * bool(claims), "g-quiet"
    )


def _trend_cells(rows: list[Row], names_of: _ClaimNames) -> list[str]:
    """Return the cells of a trend."""
    first = rows[0]
    each = ", ".join(f"{names_of.shown(row['ensemble'])} {row['alone']}" for row in rows)
    verdict = str(first["verdict"]) if first["agreed"] else f"not agreed: {each}"
    odds = (
        _join_distinct(map(_probability_cell, rows)),
        _join_distinct(_format_probability(row["chance"]) for row in rows),
    )
    return [str(first["claim"]), str(first["figure"]), str(first["says"]), verdict, *odds, str(first["note"])]


def _probability_cell(row: Row) -> str:
    """Return a probability with its interval, if there is one."""
    message = _format_probability(row["probability"])
    if _is_missing(row["low"]) or row["low"] == row["high"]:
        return message
    return f"{message} ({_format_probability(row['low'])} … {_format_probability(row['high'])})"


def _format_probability(value: Any) -> str:
    """Return a probability with two digits, "–" if it is not known."""
    return "–" if _is_missing(value) else f"{value:.2g}"


def _join_distinct(values: Iterable[str]) -> str:
    """Return texts joined by commas, or one if all are equal."""
    shown = list(values)
    return shown[0] if len(set(shown)) == 1 else ", ".join(shown)


def _claim_figures(claims: list[list[Row]], names_of: _ClaimNames) -> Iterator[Draw]:
    """Yield caption and drawing function for each figure and measure of the source, in its order."""
    groups: dict[tuple[str, str], list[list[Row]]] = {}
    for rows in claims:
        if rows[0]["figure"]:
            groups.setdefault((str(rows[0]["figure"]), str(rows[0]["measure"])), []).append(rows)
    for (figure, measure), own in groups.items():
        printed = "ours alone" if all(_is_missing(rows[0]["printed"]) for rows in own) else "printed and ours"
        yield f"{figure}: {names_of.shown(measure)}, {printed}", partial(_draw_claims, own, names_of)


def _draw_claims(claims: list[list[Row]], names_of: _ClaimNames) -> Axes:
    """Draw the medians with quartiles of each ensemble, and printed values as black marks."""
    import matplotlib

    from gudgeon.results.figures.plots import COLOURS, STYLE
    from gudgeon.results.figures.run_plots import new_axes

    factor, unit = _unit(claims)
    measure = names_of.shown(claims[0][0]["measure"])
    names = _ensemble_names(claims) or [""]
    with matplotlib.rc_context(STYLE):
        ax = new_axes(5.6, 3.2)
        for j, name in enumerate([*names, *[""] * (names != [""])]):  # and what is in no ensemble
            own = [
                (k, row)
                for k, rows in enumerate(claims)
                for row in rows
                if row["ensemble"] == name and not _is_missing(row["median"])
            ]
            if not own:
                continue
            at = [k + 0.16 * (j - 0.5 * (len(names) - 1)) * bool(name) for k, _ in own]
            middle, low, high = (np.array([row[part] for _, row in own]) * factor for part in ("median", "q25", "q75"))
            reach = middle - low, high - middle
            ax.errorbar(
                at,
                middle,
                reach,
                fmt="o",
                color=COLOURS[j % len(COLOURS)],
                ms=3.5,
                capsize=2.0,
                lw=1.0,
                label=names_of.shown(name) if name else "ours" if names == [""] else "ours, one run",
            )
        printed = [rows[0]["printed"] * factor for rows in claims if not _is_missing(rows[0]["printed"])]
        places = [k for k, rows in enumerate(claims) if not _is_missing(rows[0]["printed"])]
        ax.plot(places, printed, "k_", ms=16, mew=1.6, label="printed" if printed else None)
        scenes = len({str(rows[0]["part"]) for rows in claims}) > 1
        ax.set_xticks(range(len(claims)), [_tick_label(rows[0], names_of, scenes) for rows in claims], fontsize=7)
        ax.set_xlim(-0.6, len(claims) - 0.4)
        ax.grid(False, axis="x")
        ours = (row["median"] * factor for rows in claims for row in rows if not _is_missing(row["median"]))
        shown = [abs(value) for value in (*printed, *ours) if value]
        if shown and min(shown) > 0.0 and max(shown) > LARGE * min(shown):
            ax.set_yscale("log")
        else:
            ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
        ax.set_ylabel(f"{measure} [{unit}]" if unit else measure)
        ax.legend(fontsize=7, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(names) + 2)
    return ax


def _tick_label(row: Row, names_of: _ClaimNames, scenes: bool) -> str:
    """Return the label of a claim at the axis: name, scene if there are several, and coordinates, on several lines."""
    at = names_of.at(row).split(", ")
    message = at if max(map(len, at)) <= SHORT and len(at) <= MOST_LINES else []
    return "\n".join(filter(None, (str(row["claim"]), names_of.scene(row) if scenes else "", *message)))


def _largest_magnitude(rows: list[Row]) -> float:
    """Return the largest magnitude of printed and computed values of a claim."""
    values = (rows[0]["printed"], *(row["median"] for row in rows))
    return max((abs(value) for value in values if not _is_missing(value)), default=0.0)


def _is_missing(value: Any) -> bool:
    """Return whether a value is None or NaN."""
    return value is None or (isinstance(value, float) and math.isnan(value))
