"""A program of a user's that says the types of all that it calls: `mypy --strict` finds nothing in it, and it runs."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import gudgeon
from gudgeon import Batch, InputError, Result, Simulation, SolverError, Study


def largest(run: Result, name: str) -> float:
    """Of a series."""
    return float(np.abs(run[name]).max())


def one_run(crank: Simulation) -> tuple[Result, dict[str, float]]:
    """A run, what it is judged by, and the run that goes on from it."""
    start = crank.start({"c": "0.2 mm"})
    run = crank.simulate("20 ms", output=100, parameters={"c": 0.2e-3}, peaks=["slider.ax"])
    later = crank.simulate(output=np.linspace(0.02, 0.03, 5), start=run.final)
    judged = gudgeon.examine(crank, run, gudgeon.load("slider_crank", scene="ideal"))
    worn = gudgeon.wear(crank, run, "wristpin", k="1e-4", hardness="2 GPa")
    message = {"force": run.diagnostics.peaks[0].F, "q": float(start.q[0]), "t": float(later.t[-1])}
    message |= {"onsets": float(len(run.impacts)), "residual": judged.diagnostics.energy_residual}
    message |= {"volume": worn.bearing.volume, "peak": run.peak("slider.ax").max}
    return judged, message


def many_runs(crank: Simulation) -> tuple[Batch, float]:
    """Runs side by side, and those that failed."""
    batch = crank.simulate_many({"c": np.linspace(1e-4, 3e-4, 3)}, 0.01, output=[0.005, 0.01], threads=2)
    for failure in batch.failures:
        print(failure.run, failure.error.exit_code)
    return batch, float(batch["slider.x"][0, -1]) + float(batch[1].t[-1])


def many_studied(folder: Path) -> float:
    """A study on the disk."""
    measures = {"top": {"max": "swing"}}
    requested = {"mechanism": "pendulum", "t_end": "1 s", "parameters": {"g": [5, 9]}, "measures": measures}
    study: Study = gudgeon.study(requested, folder / "x.study", threads=1)
    again = gudgeon.load_study(folder / "x.study")
    return float(study.dataset["top"].max()) + again.runs


def main(folder: Path) -> int:
    """All of it; 0 where nothing is missing."""
    crank: Simulation = gudgeon.load("slider_crank", scene="dry")
    run, message = one_run(crank)
    batch, place = many_runs(crank)
    run.save(folder / "x.nc")
    run.to_csv(folder / "x.csv")
    message["x"] = largest(Result.load(folder / "x.nc"), "slider.x") + place
    message["study"] = many_studied(folder)
    message["exponent"] = gudgeon.load("pendulum").lyapunov(1.0).exponent
    try:
        crank.simulate(-1.0)
    except SolverError as failed:
        print(failed.time, failed.partial)
    except InputError as wrong:
        print(wrong.message, wrong.where, wrong.hint)
    print(*message, len(batch))
    return 0 if all(np.isfinite(value) for value in message.values()) else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
