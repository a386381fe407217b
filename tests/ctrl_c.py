"""Real signals at random moments: how soon Ctrl-C is answered, and whether what is kept is the whole run's.

    python -m tests.ctrl_c [--moments 50] [--seed 0] [--only run batch ...]

SIGINT is sent to this process at random moments of each activity; printed are the longest and the median time from
the signal to the answer, and what was wrong. The moments of a load are those of a cold start: derivation, compiler.
"""

from __future__ import annotations

import argparse
import math
import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

import gudgeon
from gudgeon.assembly.large import solve_damped_least_squares, solve_minimum_norm
from gudgeon.assembly.rank import compute_left_null_maxima, compute_rank
from gudgeon.assembly.start import search_start
from gudgeon.mechanisms.n_four_bar import text as n_four_bar
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from gudgeon.studies.map import compute_verdict_map
from tests.assembly.test_large import squares
from tests.simulation.kept import check_kept

BAR = 0.5  # s
MECHANISMS = Path(gudgeon.__file__).resolve().parents[1] / "mechanisms"


@dataclass(frozen=True)
class Activity:
    """`do` is interrupted; `check` says what is wrong with what it handed back (None: it raised)."""

    name: str
    do: Callable[[], object]
    check: Callable[[object], None]
    within: float = math.nan  # s, of what lasts far longer

    def lasts(self) -> float:
        """s; moments are drawn within."""
        times = [self.within]
        if math.isfinite(self.within):
            return self.within
        for _ in range(2):
            before = time.perf_counter()
            self.do()
            times.append(time.perf_counter() - before)
        return min(times[1:])


def interrupted(activity: Activity, moment: float) -> tuple[float, object]:
    """Seconds from the signal to the answer, NaN where the activity was over before; what was handed back."""
    sent = [math.nan]

    def send() -> None:
        sent[0] = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)

    timer, found = threading.Timer(moment, send), None
    try:
        timer.start()
        found = activity.do()
        answered = time.perf_counter()
        timer.cancel()
        timer.join()
        if answered < sent[0]:
            time.sleep(0.01)  # it came after the end: it is raised here
    except KeyboardInterrupt:
        answered = time.perf_counter()
    timer.join()
    return answered - sent[0], found


def measure(activity: Activity, moments: int, rng: np.random.Generator) -> bool:
    """One line of the table; whether all is well."""
    waits, wrong = [], []
    for moment in rng.uniform(0.0, activity.lasts(), moments).tolist():
        wait, found = interrupted(activity, moment)
        if wait > 0.0:
            waits.append(wait)
        try:
            activity.check(found)
        except AssertionError as error:
            wrong.append(f"{moment:.3f} s: {str(error).strip().splitlines()[0] if str(error) else 'assertion'}")
    late = sum(wait > BAR for wait in waits)
    print(
        f"{activity.name:>12}{len(waits):>6} answered, longest {max(waits, default=0.0):6.3f} s, median"
        f" {np.median(waits) if waits else 0.0:6.3f} s, {late} later than {BAR} s, {len(wrong)} wrong",
        flush=True,
    )
    for message in wrong[:5]:
        print(f"{'':>14}{message}", flush=True)
    return not late and not wrong


def run_of(name: str, simulation: gudgeon.Simulation, t_end: float, **options: object) -> Activity:
    """A run, which is kept as far as it came."""
    whole = simulation.simulate(t_end, **options)  # type: ignore[arg-type]

    def check(found: object) -> None:
        if isinstance(found, Result) and found.diagnostics.interrupted:
            check_kept(found, whole)

    return Activity(name, lambda: simulation.simulate(t_end, **options), check)  # type: ignore[arg-type]


def batch_of(name: str, dry: gudgeon.Simulation, **options: object) -> Activity:
    """Runs in two threads."""
    sets = {"c": np.linspace(0.3e-3, 0.6e-3, 8)}
    whole = dry.simulate_many(sets, 0.2, output=500, threads=2, **options)  # type: ignore[arg-type]

    def check(found: object) -> None:
        if not isinstance(found, Batch):
            return
        for failure in found.failures:
            run = found.partial(failure.run)
            if run is not None:
                check_kept(run, whole[failure.run])

    again = lambda: dry.simulate_many(sets, 0.2, output=500, threads=2, **options)  # type: ignore[arg-type]  # noqa: E731
    return Activity(name, again, check)


def large(folder: Path) -> list[Activity]:
    """Forty four-bars side by side, which come to a singular position; the start's algebra of two hundred."""
    file, matrix = folder / "n_four_bar_40.yaml", squares(1.5, 200)
    file.write_text(n_four_bar(40), encoding="utf-8")
    target, every = np.ones(len(matrix)), np.arange(matrix.shape[1])
    found = []

    def algebra() -> None:
        solve_minimum_norm(matrix, target)
        solve_damped_least_squares(matrix[:, every % 3 != 2], target)
        solve_minimum_norm(np.vstack([matrix, matrix[:1]]), np.ones(len(matrix) + 1))
        compute_left_null_maxima(matrix), compute_rank(matrix), compute_rank(np.vstack([matrix, matrix[:1]]))

    def check(run: object) -> None:
        assert run is None or isinstance(run, Result) and np.isfinite(run.q).all()
        assert run is None or run.diagnostics.phi_max < 1e-6

    for formulation in ("full", "reduced"):
        bars = gudgeon.load(file, formulation=formulation)
        found.append(Activity(f"N=40 {formulation}", partial(bars.simulate, 40.0, output=200, rtol=1e-12), check))
    found.append(Activity("N=40 start", partial(search_start, bars.compiled, bars.p), lambda _: None))
    return [*found, Activity("N=200", algebra, lambda _: None, 2.0)]


def activities(folder: Path) -> list[Activity]:
    """All but the large ones."""
    dry, oil, ideal = (gudgeon.load("nine_bar_press", scene) for scene in ("dry", "lubricated", "ideal"))
    bars = gudgeon.load("n_four_bar", formulation="full")
    number, long = iter(range(10**6)), dry.simulate(1.0, output=50_000)

    def compile_cold() -> None:
        os.environ["GUDGEON_CACHE"] = str(folder / f"cache{next(number)}")
        text = (MECHANISMS / "four_bar.yaml").read_text(encoding="utf-8")
        file = folder / "cold.yaml"
        file.write_text(f"{text}# {next(number)}\n", encoding="utf-8")
        gudgeon.load(file, quick=False)

    def check_cache(_: object) -> None:
        text = (MECHANISMS / "four_bar.yaml").read_text(encoding="utf-8")
        assert text and gudgeon.load(folder / "cold.yaml").simulate(0.1, output=3).t[-1] == 0.1

    def start_again() -> None:
        end = time.perf_counter() + 0.5
        while time.perf_counter() < end:
            search_start(bars.compiled, bars.p)

    def check_saved(_: object) -> None:
        assert Result.load(folder / "run.nc").t[-1] == long.t[-1]

    long.save(folder / "run.nc")
    return [
        run_of("run auto", dry, 1.0, output=2000),
        run_of("run oil", oil, 0.05, output=300, method="rodas5p"),
        run_of("run rk4", dry, 0.5, output=500, method="rk4", step=1e-6),
        run_of("run ideal", ideal, 20.0, output=100_000),
        run_of("run dense", bars, 20.0, output=200, rtol=1e-13),
        run_of("run scipy", oil, 2e-3, output=50, method="scipy:DOP853"),
        batch_of("batch auto", dry),
        batch_of("batch lanes", dry, method="rk4", step=2e-6),
        Activity("horizon", lambda: dry.simulate(0.3, output=300, horizon=True), lambda _: None),
        Activity("map", lambda: compute_verdict_map(oil, t_long=0.05, quick=True), lambda _: None),
        Activity("start", start_again, lambda _: None),
        Activity("save", lambda: long.save(folder / "run.nc"), check_saved),
        Activity("compile", compile_cold, check_cache),
    ]


def main() -> int:
    """Command line; 1 where something was late or wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--moments", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="+", default=[])
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background process ignores it
    rng, well = np.random.default_rng(options.seed), True
    with tempfile.TemporaryDirectory() as folder:
        for make in (activities, large):
            if options.condition and all(name.startswith("N") != (make is large) for name in options.condition):
                continue  # it takes a minute to derive
            for activity in make(Path(folder)):
                if not options.condition or any(activity.name.startswith(name) for name in options.condition):
                    well &= measure(activity, options.moments, rng)
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
