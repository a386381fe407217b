"""Simulate published machines with joint clearance by gudgeon and by independent code, and compare the results.

    python -m benchmarks.clearance [NAME …] [--write]

For each case a table states until when both agree, how well, and what its source prints. `--write` stores the results:
data/NAME.nc, and the table of README.md.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
import xarray as xr

import gudgeon
from benchmarks.clearance.cases import Case, cases

HERE = Path(__file__).resolve().parent
PAGE, BEGIN, END = HERE / "README.md", "<!-- found: python -m benchmarks.clearance --write -->\n", "<!-- end -->\n"
DIGITS = 1e-9  # of the clearance
INTERVALS = 100
FORMAT = "gudgeon-clearance/1"
COLUMNS = "case", "until", "apart by", "first contacts", "peak forces, or rows, printed", "and by these equations"
HEAD = f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}\n"


@dataclass(frozen=True)
class Found:
    """Results of both codes for a case, and the sample up to which they agree."""

    case: Case
    data: xr.Dataset
    peaks: tuple[float, ...]  # N, of the first second by gudgeon, if the paper prints them
    off: str  # deviation from printed rows

    def row(self, name: str) -> str:
        """Return the case's row of the table."""
        d = self.data
        printed = ", ".join("–" if peak is None else f"{peak:g} N" for peak in self.case.peaks) or "–"
        ours = self.off or ", ".join(f"{peak:.4g} N" for peak in self.peaks) or "–"
        if self.case.rows:
            printed = f"[{self.case.rows}]({self.case.rows})"
        onsets = np.sort(d.onset.values[np.isfinite(d.onset.values)])
        onsets = onsets[onsets <= d.attrs["horizon"]]
        first = ", ".join(f"{1e3 * t:.6f}" for t in onsets[:3]) + " ms" if onsets.size else "none"
        until, apart = 1e3 * d.attrs["horizon"], float(d.difference[d.time <= d.attrs["horizon"]].max())
        return f"| [{name}](data/{name}.nc) | {until:g} ms | {apart:.0e} c | {first} | {printed} | {ours} |\n"


def found(case: Case) -> Found:
    """Run a case by both codes."""
    simulation = gudgeon.load(case.file, case.scene, quick=False)
    method = "radau9" if case.is_film else "dop853"
    run = simulation.simulate(case.t_end, output=INTERVALS, parameters=case.parameters, method=method, rtol=1e-13)
    times = np.linspace(0.0, case.t_end, INTERVALS + 1)
    second = case.second
    _, e, force = second.run(second.start(np.array(case.guess)), times)
    own = np.stack([np.stack([run[f"{joint}.ex"], run[f"{joint}.ey"]], -1) for joint in case.joints], 1)
    difference = (abs(own - e).max(axis=2) / case.clearances).max(axis=1)
    agree = np.flatnonzero(difference > DIGITS)
    horizon = float(f"{times[agree[0] - 1 if agree.size else -1]:.12g}")
    most = max(map(len, second.onsets))
    onset = np.full((len(case.joints), most), np.nan)
    for k, began in enumerate(second.onsets):
        onset[k, : len(began)] = began
    data = xr.Dataset(
        {
            "e": (("time", "joint", "axis"), e, {"units": "m", "long_name": "journal's centre from the bearing's"}),
            "force": (("time", "joint", "axis"), force, {"units": "N", "long_name": "force on the journal"}),
            "difference": (
                "time",
                difference,
                {"units": "1", "long_name": "largest difference of e by both codes, by c"},
            ),
            "onset": (("joint", "contact"), onset, {"units": "s", "long_name": "contacts begin"}),
        },
        {"time": ("time", times, {"units": "s"}), "joint": list(case.joints), "axis": ["x", "y"]},
        {
            "format": FORMAT,
            "title": case.title,
            "source": case.source,
            "horizon": horizon,
            "clearance": case.clearance if len(set(case.clearances)) == 1 else case.clearances,
            "mechanism": Path(case.file).name.removesuffix(".yaml"),
            "scene": case.scene,
            "parameters": message(case),
        },
    )
    return Found(case, data, peaks(case, simulation, method), told_beside(case, simulation) if case.rows else "")


def message(case: Case) -> str:
    """Return the parameters that differ from the file, as text."""
    return ", ".join(f"{name} = {value!r}" for name, value in case.parameters.items())


def peaks(case: Case, simulation: Any, method: str) -> tuple[float, ...]:
    """Return the largest forces of the first second, as in the paper; after chaotic contact they are one sample of
    many.
    """
    if not case.peaks:
        return ()
    run = simulation.simulate(1.0, output=2, parameters=case.parameters, method=method, rtol=1e-10)
    return tuple(run.diagnostics.peak(joint).F for joint in case.joints)


def beside(case: Case, simulation: Any) -> dict[str, np.ndarray]:
    """Return the deviation of each series from the printed rows: forces relative to their size, journals to c."""
    with open(HERE / case.rows, encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    printed = {name: np.array([float(line[name]) for line in lines]) for name in lines[0]}
    run = simulation.simulate(output=[0.0, *printed.pop("t")], parameters=case.parameters, rtol=1e-10)
    off = {}
    for name, column in printed.items():
        own, kind = run[name][1:], name.rpartition(".")[2]
        if kind in ("ex", "ey"):
            off[name] = abs(own - 1e-3 * column) / case.clearance
        else:
            off[name] = abs(own - column) / np.where(column, abs(column), 1.0) if kind == "Fn" else abs(own - column)
    return off


def told_beside(case: Case, simulation: Any) -> str:
    """Return the deviations as text: median and, in brackets, maximum by kinds of series."""
    kinds: dict[str, list[np.ndarray]] = {}
    for name, off in beside(case, simulation).items():
        kind = name.rpartition(".")[2]
        formats = {
            "ex": "e {} c",
            "ey": "e {} c",
            "eps": "e {} c",
            "Fn": "Fn {} of itself",
            "omega": f"{name} {{}} rad/s",
        }
        kinds.setdefault(formats.get(kind, f"{name} {{}} rad"), []).append(off)
    parts = (text.format(f"{np.median(off):.0e} ({np.max(off):.0e})") for text, off in kinds.items())
    return f"off by, median (most): {', '.join(parts)}"


def write(rows: dict[str, Found]) -> None:
    """Write the data, and the table of all cases of which data exist."""
    for name, one in rows.items():
        (HERE / "data").mkdir(exist_ok=True)
        packed = {key: {"zlib": True} for key in ("e", "force", "difference")}
        one.data.to_netcdf(HERE / "data" / f"{name}.nc", engine="h5netcdf", encoding=packed)
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    table, tail = rest.split(END)
    old = {line.split("]")[0].removeprefix("| ["): line for line in table.splitlines(keepends=True)[2:]}
    lines = [rows[name].row(name) if name in rows else old[name] for name in cases() if name in rows or name in old]
    PAGE.write_text(head + BEGIN + HEAD + "".join(lines) + END + tail, encoding="utf-8")


def main() -> int:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    every = cases()
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(every))
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if unknown := set(options.names) - set(every):
        parser.error(f"no case is called {', '.join(sorted(unknown))}; there are {', '.join(every)}")
    rows = {}
    print(HEAD, end="")
    for name in options.names or every:
        start = process_time()
        rows[name] = found(every[name])
        print(rows[name].row(name), end="", flush=True)
        print(f"{name}: {process_time() - start:.1f} s", file=sys.stderr)
    if options.write:
        write(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
