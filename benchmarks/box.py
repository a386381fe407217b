"""Run the nine-bar press at points of a box of parameters; no point may fail.

    python -m benchmarks.box                      # all corners and 1000 Sobol points, dry and lubricated: an hour
    python -m benchmarks.box --sobol 64           # a sample
    python -m benchmarks.box --point 17           # this one again, with all its numbers

The parameters are clearance, stiffness, viscosity, speed, restitution, and the convention of the contact's geometry.
Each point is run for two periods of the cranks, by method auto at its default tolerance. gudgeon/studies/verdicts.py
defines which runs fail; a run that needs more than a minute per period fails too. The verdict of every point is
appended to a table (--out). Points in the table are not run again, so that an interrupted benchmark can be resumed.
Verdicts of other versions of generator and templates stay in the table and are not counted.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import gudgeon
from gudgeon.loading.kernel_sources import compute_generator_hash
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.box import Range, judge_point, list_corners, sample_sobol_points
from gudgeon.studies.runs import Setting
from gudgeon.studies.verdicts import Cell, Status

MECHANISM, PERIODS, PATIENCE = "nine_bar_press", 2, 60.0  # s a period
CONTACT = {"dry": "dry", "lubricated": "oil"}  # what the joints of a scene have
GEOMETRY = ("external", "internal")
HEAD = (
    "code",
    "scene",
    "geometry",
    "index",
    "status",
    "reason",
    "seconds",
    "energy",
    "penetration_m",
    "motion",
    "path",
    "force",
    "parameters",
)


@dataclass(frozen=True)
class Point:
    """A point of the box; `index` is its position in the list of its scene."""

    scene: str
    index: int
    geometry: str
    parameters: Mapping[str, float]

    @property
    def t_end(self) -> float:
        """Return two periods of the cranks in s."""
        return PERIODS * 2 * math.pi / self.parameters["omega"]

    @property
    def python(self) -> str:
        """Return Python code that runs the point again."""
        contact = f'{{"contacts.dry.normal.geometry": "{self.geometry}"}}'
        return (
            f'gudgeon.load("{MECHANISM}", scene="{self.scene}", overrides={contact}).simulate('
            f"{self.t_end!r}, parameters={dict(self.parameters)!r})"
        )


def ranges(scene: str) -> list[Range]:
    """Return the edges of the box; the geometry is a number: 1 external, 2 internal."""
    edges = [
        Range("c", 0.05e-3, 1e-3),
        Range("materials.aluminium.E", 1e9, 400e9),
        Range("omega", 0.2 * math.pi, 20 * math.pi),
        Range(f"contacts.{CONTACT[scene]}.normal.restitution", 0.1, 0.99),
        Range("geometry", 1.0, 2.0),
    ]
    return [*edges, *([Range("contacts.oil.film.viscosity", 1e-3, 1.0)] if scene == "lubricated" else [])]


def points(scene: str, count: int) -> list[Point]:
    """Return the corners of the box, then Sobol points."""
    edges = ranges(scene)
    found = []
    for index, point in enumerate([*list_corners(edges), *sample_sobol_points(edges, count)]):
        geometry = GEOMETRY[point.pop("geometry") > math.sqrt(2.0)]
        found.append(Point(scene, index, geometry, point))
    return found


def load_scenes(scenes: list[str]) -> dict[tuple[str, str], Simulation]:
    """Load every scene with each convention of the geometry."""
    return {
        (scene, geometry): gudgeon.load(
            MECHANISM,
            scene=scene,
            overrides={"contacts.dry.normal.geometry": geometry},
            quick=False,
        )
        for scene in scenes
        for geometry in GEOMETRY
    }


@cache
def code_digest() -> str:
    """Return the digest of generator and templates to which verdicts belong."""
    return compute_generator_hash()[:12]


def row(point: Point, cell: Cell) -> dict[str, object]:
    """Return the line of the table for a point."""
    e = cell.error
    numbers = (cell.seconds, cell.energy, cell.penetration, e.motion, e.path, e.force)
    message = " ".join(f"{name}={value!r}" for name, value in point.parameters.items())
    first = (code_digest(), point.scene, point.geometry, point.index, cell.status.value, cell.reason)
    return dict(zip(HEAD, (*first, *(f"{x:.3g}" for x in numbers), message), strict=True))


def judge_points(todo: list[Point], threads: int, rtol: float) -> Iterator[tuple[Point, Cell]]:
    """Yield points with their verdicts as they are finished; after Ctrl-C the active runs are finished."""
    simulations = load_scenes(sorted({point.scene for point in todo}))

    def one(point: Point) -> Cell:
        """Run and classify one point."""
        simulation = simulations[point.scene, point.geometry]
        return judge_point(
            simulation, point.parameters, point.t_end, Setting("auto", rtol), cpu_limit=PATIENCE * PERIODS
        )

    with ThreadPoolExecutor(threads) as pool:
        futures = {pool.submit(one, point): point for point in todo}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def print_summary(rows: list[dict[str, str]]) -> None:
    """Print counts by scene, times, and all failed points."""
    for scene in CONTACT:
        own = [r for r in rows if r["scene"] == scene]
        if not own:
            continue
        counts = Counter(r["status"] for r in own)
        times = sorted(float(r["seconds"]) for r in own)
        energy = max((float(r["energy"]) for r in own if r["energy"] != "nan"), default=math.nan)
        print(f"{scene}: {len(own)} points: {', '.join(f'{counts[s.value]} {s.value}' for s in Status)}")
        print(
            f"  seconds a point: median {times[len(times) // 2]:.2g}, largest {times[-1]:.2g};"
            f" largest energy residual {energy:.1e}"
        )
    for r in rows:
        if r["status"] in (Status.DIVERGED.value, Status.INACCURATE.value):
            print(f"FAILED {r['scene']} {r['geometry']} {r['index']}: {r['reason']}\n  {r['parameters']}")


def main() -> None:
    """Run the points that the table does not contain, then print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", choices=list(CONTACT), action="append")
    parser.add_argument("--sobol", type=int, default=1000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rtol", type=float, default=1e-8)
    parser.add_argument("--point", type=int, help="one index, with the Python that runs it again; not stored")
    parser.add_argument("--out", type=Path, default=Path("out/box.csv"))
    options = parser.parse_args()
    todo = [p for scene in options.scene or CONTACT for p in points(scene, options.sobol)]
    if options.point is not None:
        for point, cell in judge_points([p for p in todo if p.index == options.point], 1, options.rtol):
            print(point.python, *(f"  {k} {v}" for k, v in row(point, cell).items()), sep="\n")
        return
    options.out.parent.mkdir(parents=True, exist_ok=True)
    old = list(csv.DictReader(options.out.open(encoding="utf-8"))) if options.out.exists() else []
    rows = [r for r in old if r["code"] == code_digest()]
    have = {(r["scene"], int(r["index"])) for r in rows}
    todo = [point for point in todo if (point.scene, point.index) not in have]
    with options.out.open("a", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, HEAD, lineterminator="\n")
        if not old:
            writer.writeheader()
        for done, (point, cell) in enumerate(judge_points(todo, options.threads, options.rtol) if todo else (), 1):
            found = {key: str(value) for key, value in row(point, cell).items()}
            rows.append(found)
            writer.writerow(found)
            file.flush()
            if cell.failed or done % 100 == 0:
                print(f"{done}/{len(todo)} {point.scene} {point.index}: {cell.status.value} {cell.reason}", flush=True)
    print_summary(rows)


if __name__ == "__main__":
    main()
