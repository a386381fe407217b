"""A digest of what gudgeon computes: every shipped scene, formulation and method, runs and batches, bit for bit.

    python -m tests.digest [NAME ...] [--save FILE.npz] [--against FILE.npz]

One line a case: SHA-256 of the times, states, work, impacts, events and the trace of a run of 4,000 of the scene's
steps, and of three such runs as a batch. Two programs whose lines are the same compute the same bits; `--against`
reports what differs in a case: numbers of steps, impacts and events, and of each array from which time on and by which
share of its scale. The bits are those of one compiler on one machine.
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
COUNTS = ("steps", "rejected", "right_hand_sides")  # kept to explain differences, in no digest
Array = NDArray[Any]
Arrays = dict[str, Array]


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
    counts = {name: np.array(getattr(run.diagnostics, name)) for name in COUNTS}
    return found | counts | ({"trace.t": run.trace.t, "trace": run.trace.joints} if run.trace else {})


def _batch(simulation: gudgeon.Simulation, method: str) -> Arrays:
    """The first of the scene's numbers that is not zero, and two values beside it."""
    slot = next(slot for slot in simulation.compiled.source.parameters if slot.default)
    runs = simulation.simulate_many(
        {slot.address: slot.default * np.array([1.0, 1.001, 1.002])}, **_options(simulation, method)
    )
    counts = {name: np.asarray(runs.diagnostics[name]) for name in COUNTS if name in runs.diagnostics}
    return counts | {name: getattr(runs, name) for name in ("t", "q", "v", "work")}


def digest(arrays: Arrays) -> str:
    """Of names, types, shapes and bytes."""
    message = sha256()
    for name, values in sorted(arrays.items()):
        if name not in COUNTS:
            message.update(
                f"{name} {values.dtype.str} {values.shape}".encode() + np.ascontiguousarray(values).tobytes()
            )
    return message.hexdigest()[:16]


def differences(new: Arrays, old: Arrays) -> list[str]:
    """Return what differs between two outcomes of a case: refusals; else counts of steps, then each array that does."""
    cases = (("is", new), ("was", old))
    found = [f"{verb} refused: {of['error'].tobytes().decode()}" for verb, of in cases if "error" in of]
    if found:
        return found
    for name in [*COUNTS, *sorted((new.keys() | old.keys()) - {*COUNTS})]:
        a, b = new.get(name), old.get(name)
        if a is None or b is None:  # files of earlier versions have no counts
            found += [] if name in COUNTS else [f"{name} is {'missing' if a is None else 'new'}"]
        elif (a.dtype, a.shape[1:]) != (b.dtype, b.shape[1:]):
            found.append(f"{name}: {a.dtype} {a.shape} instead of {b.dtype} {b.shape}")
        elif a.tobytes() != b.tobytes():
            found.append(f"{name}: {a} instead of {b}" if name in COUNTS else f"{name}: {_of_rows(name, a, b, new)}")
    return found


def _of_rows(name: str, a: Array, b: Array, new: Arrays) -> str:
    """The first difference of each field, and the largest one where both have as many rows."""
    words = [f"{len(a)} instead of {len(b)}"] if len(a) != len(b) else []
    n = min(len(a), len(b))
    for field in a.dtype.names or ("",):
        x, y = (np.asarray(rows[field] if field else rows)[:n] for rows in (a, b))
        other = np.argwhere((x != y) & ~((x != x) & (y != y)))
        if len(other):
            axis = int(x.ndim == 3 and "impacts" not in new)  # of time: a batch has runs before it
            first = tuple(other[other[:, axis].argmin()])
            amount = _amount(x, y, first) if len(a) == len(b) else "other"
            words.append(f"{field} {amount} from {_time(name, a, first[axis], new):.9g} s on".strip())
    return ", ".join(words) or "signs of zeros or bits of NaN"


def _amount(x: Array, y: Array, first: tuple[int, ...]) -> str:
    """The largest difference as a share of the scale; the first pair where that means nothing."""
    if x.dtype.kind != "f" or (np.isnan(x) != np.isnan(y)).any():
        return f"{x[first]} instead of {y[first]}"
    return f"by {np.nanmax(np.abs(x - y)) / np.nanmax(np.abs(y), initial=1e-300):.1e} of scale"


def _time(name: str, rows: Array, row: int, arrays: Arrays) -> float:
    """Of a row: its own, or that of the sample."""
    for field in ("t", "t_on"):
        if field in (rows.dtype.names or ()):
            return float(rows[row][field])
    return float(arrays["trace.t" if name == "trace" else name if rows.ndim == 1 else "t"][row])


def main() -> None:
    """Print the table; exit code 1 where a case differs from the file's."""
    parser = argparse.ArgumentParser(prog="python -m tests.digest", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--save", type=Path)
    parser.add_argument("--against", type=Path)
    requested = parser.parse_args()
    before = dict(np.load(requested.against)) if requested.against else {}
    kept: Arrays = {}
    differ, count = 0, 0
    for where, arrays in cases(requested.names):
        old = {key.split("|")[1]: value for key, value in before.items() if key.startswith(f"{where}|")}
        message, lines = digest(arrays), list[str]()
        if requested.against and digest(old) != message:
            lines = differences(arrays, old) if old else ["not in the file"]
            differ += 1
        print(f"{message}  {where}", *lines, sep="\n    ", flush=True)
        kept |= {f"{where}|{name}": values for name, values in arrays.items()}
        count += 1
    if requested.save:
        np.savez_compressed(requested.save, **kept)  # type: ignore[arg-type]
    print(f"{count} cases" + (f", {differ} differ" if requested.against else ""))
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
