"""What a study's page shows of claims: numbers and trends that others published, a row each, beside the study's own."""

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
NUMBERS, TRENDS, ALONE = "Published numbers", "Published trends", "Ours alone"  # headings of what says none


def claims_sections(study: Study, parts: Mapping[str, StudyData], pictures: Pictures) -> list[Section]:
    """Published numbers with figures in their order, trends, and what the file puts under headings of its own.

    None of a study that claims nothing.
    """
    try:
        found = study.claims
    except GudgeonError:  # its file makes no claims
        return []
    told = _Told(parts)
    numbers, trends = (list(_each(table.to_dict("records"))) for table in (found.numbers, found.trends))
    source = lines([found.source] * bool(found.source), "g-quiet")
    own = [_heading(rows[0], NUMBERS if _published(rows[0]) else ALONE) for rows in numbers]
    judged = [_heading(rows[0], TRENDS) for rows in trends]
    shown = []
    for k, heading in enumerate(_in_order(own + judged)):
        under = [rows for rows, name in zip(numbers, own, strict=True) if name == heading]
        theirs = [rows for rows in under if _published(rows[0])]
        drawn = gallery(_figures(theirs, told), f"claims{k or ''}", pictures)
        alone = _alone([rows for rows in under if not _published(rows[0])], told)
        said = _trends([rows for rows, name in zip(trends, judged, strict=True) if name == heading], told)
        shown.append((heading, source * (heading in (NUMBERS, TRENDS)) + _numbers(theirs, told) + drawn + alone + said))
    return shown


def _published(row: Row) -> bool:
    """Whether somebody printed the number, or drew it: then it is in a figure."""
    return not _none(row["printed"]) or bool(row["figure"])


def _heading(row: Row, otherwise: str) -> str:
    return str(row.get("heading") or otherwise)


def _in_order(headings: list[str]) -> list[str]:
    """Each once: what is published, headings of the file, and what is under none at the end."""
    own = [name for name in dict.fromkeys(headings) if name not in (NUMBERS, TRENDS, ALONE)]
    return [name for name in (NUMBERS, TRENDS, *own, ALONE) if name in headings]


class _Told:
    """Names and places of claims, for people."""

    def __init__(self, parts: Mapping[str, StudyData]) -> None:
        self.parts = parts
        self.shown = next(iter(parts.values())).shown

    def at(self, row: Row) -> str:
        """Where a number's scene lies."""
        if "place" not in row:  # a folder that an earlier version judged
            return str(row["at"])
        return self.parts[str(row["part"])].where(json.loads(str(row["place"])))

    def scene(self, row: Row) -> str:
        """The scene of a number's part where it has but one, else nothing."""
        found = self.parts[str(row["part"])].dataset.coords.get("scene") if str(row["part"]) in self.parts else None
        return self.shown(found.item()) if found is not None and not found.ndim else ""

    def what(self, row: Row) -> str:
        """A number in words: its own, or measure, part and place."""
        part = [self.shown(row["part"])] * bool(row["part"])
        return str(row["says"]) or ", ".join(filter(None, (self.shown(row["measure"]), *part, self.at(row))))


def _each(rows: Iterable[Row]) -> Iterator[list[Row]]:
    """The rows of each claim: one for every ensemble."""
    claims: dict[str, list[Row]] = {}
    for row in rows:
        claims.setdefault(str(row["claim"]), []).append(row)
    yield from claims.values()


def _ensembles(claims: list[list[Row]]) -> list[str]:
    return list(dict.fromkeys(str(row["ensemble"]) for rows in claims for row in rows if row["ensemble"]))


def _numbers(claims: list[list[Row]], told: _Told) -> str:
    """A row a claim: median and quartiles of each ensemble, or of all runs where there is none."""
    names = _ensembles(claims) or [""]
    ours = (f"ours, {told.shown(name)}" if name else "ours" for name in names)
    head = ["", "figure", "what", "printed", *ours, "off by", "note"]
    below = ["ours: median (quartiles); off by: of the medians from what is printed"]
    every = (_number(rows, names, told, *_unit(_alike(claims, rows))) for rows in claims)
    return _filled(head, every) + lines(below * bool(claims), "g-quiet")


def _alike(claims: list[list[Row]], one: list[Row]) -> list[list[Row]]:
    """Numbers of the same measure in the same figure: they stand in one unit."""
    return [rows for rows in claims if all(rows[0][key] == one[0][key] for key in ("figure", "measure"))]


def _unit(claims: list[list[Row]]) -> tuple[float, str]:
    """Factor and text of the unit in which the largest of these reads well."""
    return drawn(max(map(_size, claims)), str(claims[0][0]["unit"]))


def _number(rows: list[Row], names: list[str], words: _Told, factor: float, unit: str) -> list[str]:
    first, own = rows[0], {str(row["ensemble"]): row for row in rows}
    printed = "–" if _none(first["printed"]) else _with(first["printed"] * factor, unit)
    cells = [
        _median(own.get(name) or (rows[0] if len(rows) == 1 and k == 0 else None), factor, unit)
        for k, name in enumerate(names)
    ]
    off = sorted(row["deviation"] for row in rows if not _none(row["deviation"]))
    ends = list(dict.fromkeys(f"{value:+.1f}".replace("-", "−") for value in (*off[:1], *off[-1:])))
    told = f"{' … '.join(ends)} %" if off else ""
    return [str(first["claim"]), str(first["figure"]), words.what(first), printed, *cells, told, str(first["note"])]


def _alone(claims: list[list[Row]], words: _Told) -> str:
    """What nobody has printed: a row for all measures of the same, off by so much from what they stand beside."""
    measures = list(dict.fromkeys(str(rows[0]["measure"]) for rows in claims))
    each: dict[tuple[str, str], dict[str, str]] = {}
    units = {name: _unit([rows for rows in claims if rows[0]["measure"] == name]) for name in measures}
    for rows in claims:
        first = rows[0]
        factor, unit = units[str(first["measure"])]
        off = "" if _none(first["deviation"]) else f", {first['deviation']:+.1f} %".replace("-", "−")
        what = str(first["says"]) or words.at(first), words.shown(first["part"])
        own = each.setdefault(what, {})
        own[str(first["measure"])] = _median(first, factor, unit) + off
        own[NOTE] = "; ".join(filter(None, (own.get(NOTE), str(first.get("note") or ""))))
    told = ["median (quartiles), and how far it is off from the row that it stands beside"]
    cells = ([*what, *(own.get(name, "") for name in (*measures, NOTE))] for what, own in each.items())
    return _filled(["what", "part", *map(words.shown, measures), NOTE], cells) + lines(told * bool(claims), "g-quiet")


def _median(row: Row | None, factor: float, unit: str) -> str:
    if row is None:
        return ""
    if _none(row["median"]):
        return "–"
    middle = _with(row["median"] * factor, unit)
    return middle if row["n"] == 1 else f"{middle} ({row['q25'] * factor:.4g} … {row['q75'] * factor:.4g})"


def _with(value: float, unit: str) -> str:
    """With its unit on the same line, a degree at its number."""
    return f"{value:.4g}{'' if unit == '°' else chr(160)}{unit}".strip()


def _filled(head: list[str], rows: Iterable[list[str]]) -> str:
    """A table without the columns in which nothing stands."""
    every = list(rows)
    kept = [k for k, name in enumerate(head) if not name or any(row[k] for row in every)]
    return table([head[k] for k in kept], ([row[k] for k in kept] for row in every), True)


def _trends(claims: list[list[Row]], words: _Told) -> str:
    """A row a claim: the verdict of all ensembles together, or what each says where they contradict each other."""
    head = ["", "figure", "what", "verdict", "probability", "one run shows it", "note"]
    told = [
        "probability: that the next run shows it, the least of all that the trend says, with the interval in which"
        " it is known (5 % beyond each end), ensemble by ensemble; holds: all of the interval of all runs lies at"
        " 0.8 or above, fails: at 1/3 or below, undecided: neither"
    ]
    return _filled(head, (_trend(rows, words) for rows in claims)) + lines(told * bool(claims), "g-quiet")


def _trend(rows: list[Row], words: _Told) -> list[str]:
    first = rows[0]
    each = ", ".join(f"{words.shown(row['ensemble'])} {row['alone']}" for row in rows)
    verdict = str(first["verdict"]) if first["agreed"] else f"not agreed: {each}"
    odds = _odds(map(_known, rows)), _odds(_share(row["chance"]) for row in rows)
    return [str(first["claim"]), str(first["figure"]), str(first["says"]), verdict, *odds, str(first["note"])]


def _known(row: Row) -> str:
    """A probability with its interval, where there is one."""
    told = _share(row["probability"])
    if _none(row["low"]) or row["low"] == row["high"]:
        return told
    return f"{told} ({_share(row['low'])} … {_share(row['high'])})"


def _share(value: Any) -> str:
    return "–" if _none(value) else f"{value:.2g}"


def _odds(values: Iterable[str]) -> str:
    shown = list(values)
    return shown[0] if len(set(shown)) == 1 else ", ".join(shown)


def _figures(claims: list[list[Row]], words: _Told) -> Iterator[Draw]:
    """A picture for each figure of the source and measure, in the source's order."""
    groups: dict[tuple[str, str], list[list[Row]]] = {}
    for rows in claims:
        if rows[0]["figure"]:
            groups.setdefault((str(rows[0]["figure"]), str(rows[0]["measure"])), []).append(rows)
    for (figure, measure), own in groups.items():
        printed = "ours alone" if all(_none(rows[0]["printed"]) for rows in own) else "printed and ours"
        yield f"{figure}: {words.shown(measure)}, {printed}", partial(_drawn, own, words)


def _drawn(claims: list[list[Row]], words: _Told) -> Axes:
    """Medians with quartiles of each ensemble, what is printed as a black mark."""
    import matplotlib

    from gudgeon.results.figures.plots import COLOURS, STYLE
    from gudgeon.results.figures.run_plots import new_axes

    factor, unit = _unit(claims)
    measure = words.shown(claims[0][0]["measure"])
    names = _ensembles(claims) or [""]
    with matplotlib.rc_context(STYLE):
        ax = new_axes(5.6, 3.2)
        for j, name in enumerate([*names, *[""] * (names != [""])]):  # and what is in no ensemble
            own = [
                (k, row)
                for k, rows in enumerate(claims)
                for row in rows
                if row["ensemble"] == name and not _none(row["median"])
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
                label=words.shown(name) if name else "ours" if names == [""] else "ours, one run",
            )
        printed = [rows[0]["printed"] * factor for rows in claims if not _none(rows[0]["printed"])]
        places = [k for k, rows in enumerate(claims) if not _none(rows[0]["printed"])]
        ax.plot(places, printed, "k_", ms=16, mew=1.6, label="printed" if printed else None)
        scenes = len({str(rows[0]["part"]) for rows in claims}) > 1
        ax.set_xticks(range(len(claims)), [_tick(rows[0], words, scenes) for rows in claims], fontsize=7)
        ax.set_xlim(-0.6, len(claims) - 0.4)
        ax.grid(False, axis="x")
        ours = (row["median"] * factor for rows in claims for row in rows if not _none(row["median"]))
        shown = [abs(value) for value in (*printed, *ours) if value]
        if shown and min(shown) > 0.0 and max(shown) > LARGE * min(shown):
            ax.set_yscale("log")
        else:
            ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
        ax.set_ylabel(f"{measure} [{unit}]" if unit else measure)
        ax.legend(fontsize=7, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(names) + 2)
    return ax


def _tick(row: Row, words: _Told, scenes: bool) -> str:
    """Which claim it is, at which values, a line each; and in which scene, where there are several."""
    at = words.at(row).split(", ")
    told = at if max(map(len, at)) <= SHORT and len(at) <= MOST_LINES else []
    return "\n".join(filter(None, (str(row["claim"]), words.scene(row) if scenes else "", *told)))


def _size(rows: list[Row]) -> float:
    values = (rows[0]["printed"], *(row["median"] for row in rows))
    return max((abs(value) for value in values if not _none(value)), default=0.0)


def _none(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))
