"""Make the tables and figures of docs/race.md, the comparison with other solvers, from benchmarks/race.csv.

    python -m benchmarks.race.page          # after a race, or after a change of the page's text

The text between the marks `<!-- race: name -->` … `<!-- end -->` is generated here; a test compares it with the CSV.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from benchmarks.race.record import ENERGY_LEVELS, LEVELS, LEVELS_OF, MEASURES, ONSET_LEVELS, Record, read, time_to

FOLDER = Path(__file__).resolve().parents[1]
CSV, FIGURES, PAGE = FOLDER / "race.csv", FOLDER / "figures", FOLDER.parent / "docs" / "race.md"
UNITS = {
    "ideal": ("µs a sample", 1e6),
    "double": ("µs", 1e6),
    "links": ("µs", 1e6),
    "long": ("s", 1.0),
    "turns": ("s", 1.0),
    "swings": ("s", 1.0),
    "ensemble": ("µs a run", 1e6),
    "sweep": ("ms a run", 1e3),
}
RATIO_LEVELS = (1e-6, 1e-8)  # errors of the summary
DEFAULT = "gudgeon auto"  # the default method, to which the requirements apply


@dataclass(frozen=True)
class Bar:
    """Requirement at the errors `levels`: `least` times the speed of a reference solver, or at most `most` seconds."""

    work: str
    own: str
    levels: tuple[float, ...]
    peer: str = ""
    least: float = math.nan
    most: tuple[float, ...] = ()
    measure: str = ""  # "": the first of the work's


BARS = (
    Bar("lubricated", DEFAULT, LEVELS, "CVODE BDF from C", 15.0),
    Bar("lubricated", DEFAULT, LEVELS, "CVODE BDF from C", 15.0, measure="path"),
    Bar("lubricated", DEFAULT, LEVELS, most=(1.7e-3, 2.0e-3, 3.0e-3)),
    Bar("dry", DEFAULT, LEVELS, "LSODA (SciPy)", 30.0),
    Bar("dry", DEFAULT, LEVELS, most=(1.9e-3, 2.0e-3, 3.1e-3)),
    Bar("ideal", "gudgeon kinematic", LEVELS, most=(2e-6, 2e-6, 2e-6)),
    Bar("andrews", DEFAULT, LEVELS[1:], "jitcode dop853", 3.0),
    Bar("andrews", DEFAULT, LEVELS[1:], "Exudyn gen.-alpha", 500.0),
    Bar("long", DEFAULT, ENERGY_LEVELS, "heyoka", 1.0),
    Bar("sweep", f"{DEFAULT}, 1 thread", (1e-6,), most=(3e-3,)),
)
# other solvers with the method of the default one, which the summary shows in addition to the fastest: problem, solver
SAME_METHOD = (("andrews", "jitcode dop853"),)
OF_SUMMARY = ("slider", "path")  # errors of the summary where a problem has several; others have the first error only
BATCH = ", a batch"
THREADS = 1.8  # the sweep: two threads over one, at least
MAX_GAIN = 2.0  # of two threads; a larger measured gain is due to other work of the machine
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
BATCH_FACT = re.compile(r"(?P<measured>[\d.]+) s \(goal: at most (?P<most>[\d.]+) s\)")


def number(x: float) -> str:
    """Return three digits without an exponent of ten (6,490); a dash if an error was not reached."""
    if not math.isfinite(x):
        return "–"
    rounded = float(f"{x:.3g}")
    return f"{rounded:,.0f}" if abs(rounded) >= 1000.0 else f"{x:#.3g}".rstrip(".")


def power(level: float) -> str:
    """Return an error that is a power of ten, such as 10⁻⁶."""
    return f"10{str(round(math.log10(level))).translate(SUPERSCRIPTS)}"


def set_powers(text: str) -> str:
    """Return a text with numbers such as 3e-12 as 3·10⁻¹²."""
    return re.sub(r"(\d)e(-?)0*(\d+)", lambda x: f"{x[1]}·10{(x[2] + x[3]).translate(SUPERSCRIPTS)}", text)


def grid(head: list[str], rows: list[list[str]], words: int = 1) -> list[str]:
    """Return a Markdown table with columns of equal width; the first `words` columns are aligned left."""
    widths = [max(len(row[k]) for row in [head, *rows]) for k in range(len(head))]
    line = ["---".ljust(w, "-") if k < words else "-" * (w - 1) + ":" for k, w in enumerate(widths)]
    fitted = [
        [cell.ljust(w) if k < words else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, widths, strict=True))]
        for row in [head, line, *rows]
    ]
    return [f"| {' | '.join(row)} |" for row in fitted]


def levels_of(work: str, measure: str) -> tuple[float, ...]:
    """Return the errors of the columns of a problem's table."""
    return ONSET_LEVELS if measure == "onset" else LEVELS_OF.get(work, LEVELS)


def is_reached(record: Record, work: str, measure: str, level: float) -> bool:
    """Return whether the table of a problem has a column for an error: a solver reaches it."""
    times = (record.time_to(work, name, measure, level) for name in record.entries(work))
    return level in levels_of(work, measure) and any(map(math.isfinite, times))


def bars(record: Record) -> list[str]:
    """Return the table of goals and results, a row for each goal: problem, errors, goal, measured values, result."""
    rows = []
    for bar in (b for b in BARS if record.entries(b.work)):
        measure = bar.measure or MEASURES[bar.work][0]
        own = [record.time_to(bar.work, bar.own, measure, level) for level in bar.levels]
        if bar.peer:
            peer = [record.time_to(bar.work, bar.peer, measure, level) for level in bar.levels]
            found, unit = [b / a for a, b in zip(own, peer, strict=True)], "times"
            goal = f"at least {bar.least:g} times as fast as {bar.peer}".replace("1 times as", "as", bar.least == 1.0)
            fractions = [x / bar.least for x in found]
        else:
            unit, scale = UNITS.get(bar.work, ("ms", 1e3))
            found, fractions = [x * scale for x in own], [m / x for m, x in zip(bar.most, own, strict=True)]
            goal = f"at most {', '.join(f'{m * scale:g}' for m in dict.fromkeys(bar.most))} {unit}"
        errors = f"{measure}: {', '.join(map(power, bar.levels))}"
        rows.append([f"`{bar.work}`", errors, goal, f"{', '.join(map(number, found))} {unit}", rate(fractions)])
    if record.entries("sweep"):
        one, two = (record.time_to("sweep", f"{DEFAULT}, {k}", "worst", 1e-6) for k in ("1 thread", "2 threads"))
        goal, ratio = f"2 threads at least {THREADS} times as fast as one", one / two
        result = "not decided: other work" if ratio > MAX_GAIN else rate([ratio / THREADS])
        rows.append(["`sweep`", f"worst: {power(1e-6)}", goal, f"{number(ratio)} times", result])
    for name, value in record.facts.items():
        if name.startswith("sweep, ") and (fact := BATCH_FACT.fullmatch(value)):
            goal = f"{name.removeprefix('sweep, ')}: at most {fact['most']} s"
            result = rate([float(fact["most"]) / float(fact["measured"])])
            rows.append(["`sweep`", "", goal, f"{fact['measured']} s", result])
    return grid(["problem", "error", "goal", "measured", "result"], rows, words=5)


def rate(fractions: list[float]) -> str:
    """Return whether a goal is met: each measured value divided by the goal is 1 or more. A dash for missing values."""
    if not all(map(math.isfinite, fractions)):
        return "–"
    return "met" if min(fractions) >= 1.0 else "missed"


def find_default(record: Record, work: str) -> str:
    """Return the entry of gudgeon's default method in a problem, else its first entry of gudgeon; "" without one."""
    names = record.entries(work)
    return next((n for n in names if n.startswith(DEFAULT)), next((n for n in names if record.is_own(work, n)), ""))


def find_fastest(record: Record, work: str, measure: str) -> str:
    """Return the other solver with the shortest engine time at the smallest error of RATIO_LEVELS that one reaches.

    Batches are left out. "" is returned if no other solver reaches one of these errors.
    """
    names = [n for n in record.entries(work) if not record.is_own(work, n) and not n.endswith(BATCH)]
    for level in sorted(set(RATIO_LEVELS) & set(levels_of(work, measure))):
        times = {name: record.time_to(work, name, measure, level) for name in names}
        reached = [name for name in names if math.isfinite(times[name])]
        if reached:
            return min(reached, key=times.__getitem__)
    return ""


def ratios(record: Record) -> list[str]:
    """Return the summary: times of the fastest other solver of each problem divided by those of the default method.

    Solvers of SAME_METHOD have a row too. A cell is empty if the table of the problem lacks its error, and a dash if
    a solver does not reach the error.
    """
    rows = []
    for work, measures in MEASURES.items():
        own, same = find_default(record, work), [peer for w, peer in SAME_METHOD if w == work]
        same = [peer for peer in same if peer in record.entries(work)]
        for measure in [m for m in measures if m in OF_SUMMARY] or measures[:1]:
            fastest = find_fastest(record, work, measure)
            for peer in dict.fromkeys([*same, *([fastest] if fastest or not same else ())]) if own else ():
                cells = []
                for call in (False, True):
                    for level in RATIO_LEVELS:
                        times = [record.time_to(work, n, measure, level, call) if n else math.nan for n in (peer, own)]
                        cells.append(number(times[0] / times[1]) if is_reached(record, work, measure, level) else "")
                rows.append([f"`{work}`", measure, peer or "none", *cells])
    return grid(["problem", "error", "solver", *_name_columns(map(power, RATIO_LEVELS))], rows, words=3)


def faster(record: Record) -> list[str]:
    """Return the table of the solvers that are faster than the default method at one of the errors of a problem.

    A row has the times divided by those of the default method, one for each error; a batch is compared with a batch.
    """
    rows = []
    for work, measures in MEASURES.items():
        for name in (n for n in record.entries(work) if not record.is_own(work, n)):
            default = find_default(record, work)
            batch = default + BATCH
            own = batch if name.endswith(BATCH) and batch in record.entries(work) else default
            for measure in measures:
                levels = [level for level in levels_of(work, measure) if is_reached(record, work, measure, level)]
                found = []
                for call in (False, True):
                    times = [[record.time_to(work, n, measure, level, call) for level in levels] for n in (name, own)]
                    found.append([other / mine for other, mine in zip(*times, strict=True)])
                if any(ratio < 1.0 for ratios_of_kind in found for ratio in ratios_of_kind):
                    errors = f"{measure}: {', '.join(map(power, levels))}"
                    rows.append([f"`{work}`", errors, name, *(", ".join(map(number, x)) for x in found)])
    return grid(["problem", "error", "solver", "engine", "call"], rows, words=5)


def _name_columns(errors: Iterable[str]) -> list[str]:
    """Return the heads of the columns of engine times at some errors, then of call times."""
    errors = list(errors)
    return [f"{kind} {error}" for kind in ("engine", "call") for error in errors]


def table(record: Record, work: str, measure: str) -> list[str]:
    """Return the table of a problem: engine times of all entries to each error, then their call times.

    Columns of errors that no entry reaches are left out. If the default method has no tolerance, so that its time is
    the same for each error, the table has one column of engine times and one of call times. An entry with different
    times then has a row for each error that it reaches.
    """
    levels = [level for level in levels_of(work, measure) if is_reached(record, work, measure, level)]
    unit, scale = UNITS.get(work, ("ms", 1e3))
    rows, own = [], record.of(work, find_default(record, work))
    if own and all(math.isnan(row.control) for row in own):
        for name in record.entries(work):
            pairs = {
                power(level): [number(record.time_to(work, name, measure, level, x) * scale) for x in (False, True)]
                for level in levels
            }
            if len(set(map(tuple, pairs.values()))) == 1:
                rows.append([name, *pairs[power(levels[0])]])
            else:
                rows += [[f"{name}, error {error}", *pair] for error, pair in pairs.items() if "–" not in pair]
        return grid([f"{measure}, {unit}", "engine", "call"], rows)
    for name in record.entries(work):
        times = [record.time_to(work, name, measure, level, call) for call in (False, True) for level in levels]
        rows.append([name, *(number(t * scale) for t in times)])
    errors = [f"{power(level)}{' s' if measure == 'onset' else ''}" for level in levels]
    return grid([f"{measure}, {unit}", *_name_columns(errors)], rows)


def evaluations(record: Record, work: str = "lubricated", measure: str = "path") -> list[str]:
    """Return the table of right-hand sides that each entry of a problem needs to reach an error."""
    rows = []
    for name in record.entries(work):
        points = [(row.errors[measure], float(row.right_hand_sides)) for row in record.of(work, name)]
        counts = [time_to(points, level) for level in levels_of(work, measure)]
        if min(n for _, n in points) >= 0.0:
            rows.append([name, *map(number, counts)])
    return grid([measure, *map(power, levels_of(work, measure))], rows)


def setups(record: Record) -> list[str]:
    """Return the table of set-up times: a row for each problem and each model, with the entries that share it."""
    rows = []
    for work in (w for w in MEASURES if record.entries(w)):
        names_by_time: dict[str, list[str]] = {}
        for name in record.entries(work):
            names_by_time.setdefault(number(record.setup(work, name)), []).append(name)
        rows += [[f"`{work}`", "; ".join(names), time] for time, names in names_by_time.items()]
    note = ["", "A dash means that the set-up took more than 120 s."]
    return grid(["problem", "solvers", "set-up, s"], rows, words=2) + note * any(time == "–" for *_, time in rows)


def machine_facts(record: Record) -> list[str]:
    """Return the facts of the machines of all runs; runs with the same value of a fact have one line together."""
    runs_of: dict[tuple[str, str], list[str]] = {}
    for name, value in record.facts.items():
        if name.startswith("run "):
            run, _, fact = name.removeprefix("run ").partition(", ")
            runs_of.setdefault((fact, value), []).append(run)
    if len(record.runs()) <= 1:
        return [f"- {fact}: {value}" for fact, value in runs_of]
    return [
        f"- {'measurement' if len(runs) == 1 else 'measurements'} {', '.join(runs)}, {fact}: {value}"
        for (fact, value), runs in runs_of.items()
    ]


def facts(record: Record, work: str = "") -> list[str]:
    """Return the facts of a problem, or of the machines of all runs."""
    if not work:
        return machine_facts(record)
    prefix = f"{work}, "
    found = [
        f"- {name.removeprefix(prefix)}: {set_powers(x)}" for name, x in record.facts.items() if name.startswith(prefix)
    ]
    runs = record.runs(work)
    return [*found, f"- measurement {', '.join(map(str, runs))}"] if len(record.runs()) > 1 and runs else found


def blocks(record: Record) -> dict[str, str]:
    """Return the texts between the marks by name."""
    found = {
        "machine": facts(record),
        "ratios": ratios(record),
        "faster": faster(record),
        "bars": bars(record),
        "setups": setups(record),
    }
    found["evaluations"] = evaluations(record)
    for work, measures in MEASURES.items():
        lines = facts(record, work)
        if not record.entries(work):
            lines += ["This problem was not measured: `make race` measures all problems."]
        for measure in measures if record.entries(work) else ():
            lines += ["", *table(record, work, measure)]
        if record.entries(work):
            lines += ["", f"![{work}: time against error](../benchmarks/figures/race_{work}.png)"]
        found[work] = lines
    return {name: "\n".join(lines).strip() for name, lines in found.items()}


def filled(page: str, record: Record) -> str:
    """Return the page with the texts between its marks replaced. Raises ValueError for unknown marks."""
    texts = blocks(record)

    def put(found: re.Match[str]) -> str:
        """Return the text of a mark."""
        if found[1] not in texts:
            raise ValueError(f"unknown mark {found[1]!r}; expected one of {', '.join(texts)}")
        return f"<!-- race: {found[1]} -->\n{texts[found[1]]}\n<!-- end -->"

    return re.sub(r"<!-- race: (\w+) -->\n.*?<!-- end -->", put, page, flags=re.S)


def draw(folder: Path, record: Record) -> None:
    """Draw time against error, log-log, one figure for each problem.

    Lines of gudgeon are thick; its default method is dashed on top of the chosen one.
    """
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter

    for work, measures in MEASURES.items():
        if not record.entries(work):
            continue
        unit, scale = UNITS.get(work, ("ms", 1e3))
        figure, axis = plt.subplots(figsize=(8.0, 4.6), layout="constrained")
        for name in record.entries(work):
            points = [(e, scale * t) for e, t in record.points(work, name, measures[0]) if 0.0 < e < math.inf]
            style = {"linewidth": 2.4 if record.is_own(work, name) else 1.0, "label": name}
            if name == DEFAULT:
                style |= {"linestyle": "--", "color": "black", "linewidth": 1.6, "zorder": 5}
            if points:
                axis.loglog(*zip(*points, strict=True), marker="o", markersize=3, **style)
        axis.set(title=work, xlabel=f"error ({measures[0]})", ylabel=f"time [{unit}]")
        low, high = axis.get_xlim()
        axis.set_xlim(10.0 ** math.ceil(math.log10(high) - 0.2), 10.0 ** math.floor(math.log10(low) + 0.2))
        for side in (axis.xaxis, axis.yaxis):
            side.set_minor_formatter(NullFormatter())
        axis.grid(True, which="major", alpha=0.3)
        figure.legend(fontsize=7, loc="outside right upper")
        figure.savefig(folder / f"race_{work}.png", dpi=100, metadata={"Software": None})
        plt.close(figure)


def main() -> None:
    """Write the page and the figures from the CSV."""
    record = read(CSV)
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), record), encoding="utf-8")
    draw(FIGURES, record)


if __name__ == "__main__":
    main()
