"""How far FMPy is from gudgeon's own run, a table for docs/exchange.md: `python -m tests.exchange.accuracy`.

Errors are the largest of a series at fifty times, over the largest value of the series, against the native run at a
tolerance of 1e-12.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import fmpy
import numpy as np

import gudgeon

TOLERANCES = (1e-6, 1e-8, 1e-10, 1e-11)
SCENES = (
    ("andrews_squeezer", "ideal", 0.03, "OF.theta"),
    ("nine_bar_press", "lubricated", 0.05, "A.ex"),
    ("nine_bar_press", "dry", 0.02, "A.ex"),
    ("slider_crank", "dry", 0.02, "slider.x"),
)


def error(fmu: str, kind: str, rtol: float, series: str, reference: gudgeon.Result) -> float:
    """Of one run by FMPy; by CVODE where it integrates."""
    t_end = reference.t[-1]
    found = fmpy.simulate_fmu(
        fmu,
        stop_time=t_end,
        step_size=t_end / 50 if kind == "CoSimulation" else None,
        output_interval=t_end / 50,
        relative_tolerance=rtol,
        output=[series],
        fmi_type=kind,
        solver="CVode",
        record_events=False,
    )
    assert np.allclose(found["time"], reference.t, rtol=0.0, atol=1e-12)
    return float(abs(found[series] - reference[series]).max() / abs(reference[series]).max())


def main() -> None:
    kinds = ("CoSimulation", "ModelExchange")
    print("| scene | time, s | contacts | series | |", *(f"1e{round(np.log10(rtol))} |" for rtol in TOLERANCES))
    print("|" + "---|" * (5 + len(TOLERANCES)))
    with tempfile.TemporaryDirectory() as folder:
        for name, which, t_end, series in SCENES:
            simulation, fmu = gudgeon.load(name, scene=which), str(Path(folder, f"{name}_{which}.fmu"))
            gudgeon.write_fmu(simulation, fmu)
            reference = simulation.simulate(output=np.linspace(0.0, t_end, 51), rtol=1e-12)
            for kind in kinds:
                first = (f"{name}, {which}", f"{t_end:g}", str(reference.diagnostics.onsets), series)
                message = (f"{error(fmu, kind, rtol, series, reference):.0e}" for rtol in TOLERANCES)
                message_of = " | ".join(first) if kind == kinds[0] else "| | |"
                print("|", message_of, "|", " | ".join((kind, *message)), "|")


if __name__ == "__main__":
    main()
