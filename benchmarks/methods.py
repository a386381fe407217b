"""Compare `auto` with every method of gudgeon on the shipped scenes: processor time at each tolerance.

    python -m benchmarks.methods [--scenes PATTERN ...] [--tolerances 1e-4 ... 1e-12] [--budget 0.05] [--taylor]

The scenes are those of shipped mechanisms that integrate a motion. The time of a run is the processor time of its
thread, the least of several runs in turns, and contains the call of `simulate`. The length of a run is that of the
scene, halved or doubled until a run of `auto` at 1e-8 takes between a tenth of `--budget` seconds and all of them.
Each row is one scene at one tolerance, with the time of each method relative to `auto`. A method that fails has no
value. `--taylor` derives and compiles the Taylor series of scenes with smooth motion, which takes seconds per scene.

`chain_N` are N links that swing from rest (benchmarks/peers/chains.py). `joints_N` are N independent pendulums on dry
pins with clearance.
"""

from __future__ import annotations

import argparse
import math
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatch
from pathlib import Path
from time import thread_time

import gudgeon
from benchmarks.peers import chains
from gudgeon.contract.methods import STAGED
from gudgeon.errors import GudgeonError
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.loading.shipped import find_shipped_file, list_shipped_mechanisms
from gudgeon.simulation.simulation import Simulation

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
METHODS = ("dop853", "dopri5", "rodas5p", *STAGED, "taylor")
SLOW = 20.0  # times the processor time of auto: such a method is not repeated
REPETITIONS = 5
MAX_LENGTH = 1e3  # s: longest run
CHAINS, JOINTS = (1, 2, 6, 12), (1, 8, 16)


def write_journals(count: int) -> str:
    """Return a mechanism of `count` pendulums, each on a pin with clearance, that swing from the horizontal."""
    names = [f"L{k}" for k in range(count)]
    return "\n".join(
        [
            f"format: gudgeon/1\nname: joints_{count}\ngravity: [0, -9.81 m/s^2]",
            "materials:\n  steel: {E: 206 GPa, nu: 0.3}",
            f"ground: {{{', '.join(f'O{k}: [{k} m, 0]' for k in range(count))}}}",
            "bodies:",
            *(f"  L{k}: {{length: 0.3 m, mass: {1 + 0.1 * k} kg, inertia: 0.01 kg*m^2}}" for k in range(count)),
            "joints:",
            *(f"  J{k}: {{revolute: [ground.O{k}, L{k}.tail]}}" for k in range(count)),
            f"start: {{set: {{{', '.join(f'{name}.theta: {-0.1 * k} rad' for k, name in enumerate(names))}}},",
            f"  rates: {{{', '.join(f'{name}.omega: 0' for name in names)}}}}}",
            "bearings:",
            "  pin: {radius: 15 mm, clearance: 0.3 mm, length: 40 mm,",
            "    bearing_material: steel, journal_material: steel}",
            "contacts:",
            "  dry:",
            "    normal: {law: lankarani_nikravesh, restitution: 0.9}",
            "    friction: {law: modified_coulomb, mu: 0.15, v0: 1e-4 m/s, v1: 1e-3 m/s}",
            f"scenes:\n  dry: {{play: {{{', '.join(f'J{k}: {{bearing: pin, contact: dry}}' for k in range(count))}}}}}",
            "",
        ]
    )


def list_scenes(patterns: Iterable[str]) -> Iterator[tuple[str, Simulation]]:
    """Yield the names and simulations of all scenes that integrate a motion and match one of the patterns."""
    patterns = tuple(patterns)
    for mechanism in list_shipped_mechanisms():
        file = find_shipped_file(mechanism)
        for scene in read_mechanism(file.read_bytes(), file.name).scenes:
            name = f"{mechanism}/{scene}"
            if any(fnmatch(name, pattern) for pattern in patterns):
                simulation = gudgeon.load(mechanism, scene=scene, quick=False)
                if simulation.source.methods[0] != "kinematic":
                    yield name, simulation
    with tempfile.TemporaryDirectory() as folder:
        texts = {f"chain_{n}/ideal": chains.written(n, tuple(chains.starts(n)[:n, 0].tolist())) for n in CHAINS}
        texts |= {f"joints_{n}/dry": write_journals(n) for n in JOINTS}
        for name, text in texts.items():
            if any(fnmatch(name, pattern) for pattern in patterns):
                file = Path(folder, f"{name.split('/')[0]}.yaml")
                file.write_text(text, encoding="utf-8")
                yield name, gudgeon.load(file, scene=name.split("/")[1], quick=False)


def measure(simulation: Simulation, t_end: float, method: str, rtol: float) -> float:
    """Return the processor time of one run (s); infinity if it fails. Peaks that the file requests are not searched."""
    before = thread_time()
    try:
        simulation.simulate(t_end, method=method, rtol=rtol, output=1, audit=False, peaks=())
    except GudgeonError:
        return math.inf
    return thread_time() - before


def measure_in_turns(variants: Mapping[str, Simulation], t_end: float, rtol: float) -> dict[str, float]:
    """Return the processor time of a run by each method (s), the least of several in turns; infinity if it fails.

    `variants`: simulations by method, with "auto". A method that takes SLOW times as long as `auto` is not repeated.
    """
    for method, simulation in variants.items():
        simulation.of_method(method, rtol=rtol)  # compiled before it is measured
    times = {method: math.inf for method in variants}
    for _ in range(REPETITIONS):
        for method, simulation in variants.items():
            if not SLOW * times["auto"] < times[method] < math.inf or method == "auto":
                times[method] = min(times[method], measure(simulation, t_end, method, rtol))
    return times


def find_length(simulation: Simulation, budget: float) -> float:
    """Return the length of the scene's run (s), halved or doubled until a run of auto at 1e-8 fits the budget.

    The run takes between a tenth of `budget` and `budget` seconds, if it does not end before.
    """
    t_end = float(simulation.source.simulate.get("t_end") or 1.0)
    simulation.of_method("auto", rtol=1e-8)
    while measure(simulation, t_end, "auto", 1e-8) > budget and t_end > 1e-6:
        t_end /= 2.0
    while measure(simulation, t_end, "auto", 1e-8) < 0.1 * budget and t_end < MAX_LENGTH:
        t_end *= 2.0
    return t_end


def main() -> None:
    """Print the table, and how often and by how much `auto` is slower than the best method."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", nargs="+", default=["*"])
    parser.add_argument("--tolerances", nargs="+", type=float, default=list(TOLERANCES))
    parser.add_argument("--budget", type=float, default=0.05)
    parser.add_argument("--taylor", action="store_true")
    arguments = parser.parse_args()
    methods = METHODS if arguments.taylor else METHODS[:-1]
    print(f"{'scene':34} {'rtol':>6} {'auto, ms':>9} {'runs':>16} " + " ".join(f"{name:>8}" for name in methods))
    ratios = []
    for name, simulation in list_scenes(arguments.scenes):
        t_end = find_length(simulation, arguments.budget)
        variants = {"auto": simulation}
        for method in methods:
            try:
                if method not in STAGED or simulation.source.has_stage_matrices:
                    variants[method] = simulation.of_method(method)
            except GudgeonError:
                pass
        for rtol in arguments.tolerances:
            times = measure_in_turns(variants, t_end, rtol)
            auto = times["auto"]
            cells = [f"{times[m] / auto:8.2f}" if times.get(m, math.inf) < math.inf else f"{'-':>8}" for m in methods]
            used = simulation.simulate(t_end, rtol=rtol, output=1, audit=False).diagnostics.method
            ratios.append(max(auto / time for time in times.values()))
            print(f"{name:34} {rtol:6.0e} {1e3 * auto:9.3f} {used:>16} " + " ".join(cells), flush=True)
    slower = sum(ratio > 1.1 for ratio in ratios)
    print(
        f"auto is more than 10 % slower than the best in {slower} of {len(ratios)} rows: up to {max(ratios):.2f} times"
    )


if __name__ == "__main__":
    main()
