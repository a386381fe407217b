"""One right-hand side: its time beside its operation count, and beside the hand-written dense C of benchmarks/peers.

    python -m benchmarks.rhs                # from the repository's root, with gudgeon installed

Both are timed in one process at the same states: the start, and the first contact's peak force. The peer
solves the dense 44 × 44 system of the press with play; it is what a careful user writes by hand.
"""

from __future__ import annotations

import math
import os
import platform
from dataclasses import replace
from pathlib import Path

import gudgeon
from gudgeon.measure.rhs import RhsTime, time_rhs
from tests.oracles import press_dense
from tests.oracles.press_dense import Press

SCENES = {"ideal": None, "dry": Press(), "lubricated": replace(Press(), film=True)}
LONGEST = 0.05  # s, in which a contact is looked for
ROUNDS = 12  # in which ours and the peer take turns: the least tells the code from whatever else the machine does


def machine() -> str:
    """The processor as it names itself, and how many cores there are; no names of hosts."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        lines = cpuinfo.read_text(encoding="utf-8", errors="replace").splitlines()
        model = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), model)
    return f"{model}, {os.cpu_count()} cores"


def measure(scene: str, peer: Press | None) -> list[tuple[RhsTime, float]]:
    """Each state with the peer's time (s) there; NaN without one."""
    simulation = gudgeon.load("nine_bar_press", scene=scene)
    best: list[tuple[RhsTime, float]] = []
    for _ in range(ROUNDS):
        found = []
        for rhs in time_rhs(simulation, LONGEST):
            y = (*rhs.q, *rhs.v)
            found.append((rhs, math.nan if peer is None else press_dense.seconds_per_rhs(peer, t=rhs.t, y=y)))
        best = [
            (replace(new, seconds=min(new.seconds, old.seconds)), min(new_peer, old_peer))
            for (new, new_peer), (old, old_peer) in zip(found, best or found, strict=True)
        ]
    return best


def line(scene: str, rhs: RhsTime, dense: float) -> str:
    """A row of the table; the ratio is the peer's time over ours."""
    each = rhs.seconds / rhs.operations
    text = f"{scene:<12}{rhs.state:<16}{rhs.seconds * 1e6:10.3f}{rhs.operations:12,}{each * 1e9:11.2f}"
    return text if math.isnan(dense) else f"{text}{dense * 1e6:14.3f}{dense / rhs.seconds:8.1f}"


def main() -> None:
    """Print the table."""
    print(f"{machine()}; least of several batches, one thread\n")
    columns = f"{'time [µs]':>10}{'operations':>12}{'ns an op.':>11}{'dense C [µs]':>14}{'ratio':>8}"
    print(f"{'scene':<12}{'state':<16}{columns}")
    for scene, peer in SCENES.items():
        for rhs, dense in measure(scene, peer):
            print(line(scene, rhs, dense))


if __name__ == "__main__":
    main()
