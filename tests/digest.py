"""A digest of what gudgeon computes: every shipped scene, formulation and method, runs and batches, bit for bit.

    python -m tests.digest [NAME ...] [--save FILE.npz] [--against FILE.npz]

One line a case: SHA-256 of the times, states, work, impacts, events and the trace of a run of 4,000 of the scene's
steps, and of three such runs as a batch. Two programs whose lines are the same compute the same bits; `--against`
tells of each case that differs by how much of its scale. The bits are those of one compiler on one machine.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import gudgeon
from gudgeon.errors import GudgeonError
from gudgeon.generator.reader.read import read_mechanism

MECHANISMS = Path(gudgeon.__file__).resolve().parents[1] / "mechanisms"
FORMULATIONS = ("reduced", "full")
STEPS, STEP, SAMPLES = 4_000, 1e-4, 101
Arrays = dict[str, NDArray[Any]]


def cases(names: list[str]) -> Iterator[tuple[str, Arrays]]:
    """Name of each case and its arrays."""
    for file in sorted(MECHANISMS.glob("*.yaml")):
        if names and file.stem not in names:
            continue
        for scene in read_mechanism(file.read_bytes(), file.name).scenes:
            for formulation in FORMULATIONS:
                simulation = gudgeon.load(file, scene, formulation=formulation, quick=False)
                for method in ("auto", *simulation.compiled.source.methods):
                    where = f"{file.stem}/{scene} {formulation} {method}"
                    yield where, _found(lambda s=simulation, m=method: _run(s, m))
                    yield f"{where} batch", _found(lambda s=simulation, m=method: _batch(s, m))


def _found(work: Any) -> Arrays:
    try:
        found: Arrays = work()
    except GudgeonError as error:  # a refusal is an outcome too
        return {"error": np.frombuffer(str(error).encode(), dtype=np.uint8)}
    return found


def _options(simulation: gudgeon.Simulation, method: str) -> dict[str, Any]:
    step = simulation.compiled.source.simulate.get("step", STEP)
    fixed = {"step": step} if method == "rk4" else {}
    return {"t_end": STEPS * step, "output": SAMPLES, "method": method, **fixed}


def _run(simulation: gudgeon.Simulation, method: str) -> Arrays:
    run = simulation.simulate(**_options(simulation, method))
    found = {name: getattr(run, name) for name in ("t", "q", "v", "state", "memory", "work", "impacts", "events")}
    return found | ({"trace.t": run.trace.t, "trace": run.trace.joints} if run.trace else {})


def _batch(simulation: gudgeon.Simulation, method: str) -> Arrays:
    """The first of the scene's numbers that is not zero, and two values beside it."""
    slot = next(slot for slot in simulation.compiled.source.slots if slot.default)
    runs = simulation.simulate_many({slot.address: slot.default * np.array([1.0, 1.001, 1.002])},
                                    **_options(simulation, method))  # fmt: skip
    return {name: getattr(runs, name) for name in ("t", "q", "v", "work")}


def digest(arrays: Arrays) -> str:
    """Of names, types, shapes and bytes."""
    told = sha256()
    for name, values in sorted(arrays.items()):
        told.update(f"{name} {values.dtype.str} {values.shape}".encode() + np.ascontiguousarray(values).tobytes())
    return told.hexdigest()[:16]


def largest(new: Arrays, old: Arrays) -> float:
    """The largest difference as a share of the array's scale; infinite where the arrays are of another form."""
    most = 0.0
    for name in new.keys() | old.keys():
        a, b = new.get(name), old.get(name)
        if a is None or b is None or a.shape != b.shape or a.dtype != b.dtype:
            return np.inf
        for field in a.dtype.names or ("",):
            x, y = (np.asarray(c[field] if field else c) for c in (a, b))
            if x.dtype.kind == "f" and (np.isnan(x) == np.isnan(y)).all():
                scale = np.nanmax(np.abs(y), initial=1e-300)
                most = max(most, float(np.nanmax(np.abs(x - y), initial=0.0)) / scale)
            elif x.tobytes() != y.tobytes():
                return np.inf
    return most


def main() -> None:
    """Print the table; exit code 1 where a case differs from the file's."""
    parser = argparse.ArgumentParser(prog="python -m tests.digest", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--save", type=Path)
    parser.add_argument("--against", type=Path)
    asked = parser.parse_args()
    before = dict(np.load(asked.against)) if asked.against else {}
    kept: Arrays = {}
    differ, count = 0, 0
    for where, arrays in cases(asked.names):
        told = digest(arrays)
        if asked.against:
            old = {key.split("|")[1]: value for key, value in before.items() if key.startswith(f"{where}|")}
            same = old and digest(old) == told
            told += "" if same else f"  differs: {largest(arrays, old):.1e} of scale"
            differ += not same
        kept |= {f"{where}|{name}": values for name, values in arrays.items()}
        count += 1
        print(f"{told}  {where}", flush=True)
    if asked.save:
        np.savez_compressed(asked.save, **kept)  # type: ignore[arg-type]
    print(f"{count} cases" + (f", {differ} differ" if asked.against else ""))
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
