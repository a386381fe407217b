"""python -m tests.random_machines --count N --seed S: random machines; exit status 1 where one fails."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

from tests import quick
from tests.random_machines.draw import FAMILIES
from tests.random_machines.trial import Tally, try_seeds


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.random_machines")
    parser.add_argument("--count", type=int, default=200, help="machines")
    parser.add_argument("--seed", type=int, default=0, help="of the first design")
    parser.add_argument("--machines", type=int, default=8, help="sets of numbers of each design")
    parser.add_argument("--family", choices=sorted(FAMILIES))
    parser.add_argument("--out", type=Path, help="a folder for the files that fail")
    requested = parser.parse_args()
    designs, begun, message = -(-requested.count // requested.machines), time.time(), [0]

    def report(tally: Tally) -> None:
        for failure in tally.failures[message[0] :]:
            print(failure, flush=True)
            if requested.out:
                requested.out.mkdir(parents=True, exist_ok=True)
                name = f"seed_{failure.seed}_{failure.family}_{failure.what.partition(':')[0].replace(' ', '_')}.yaml"
                remark = "".join(f"# {line}\n" for line in str(failure).splitlines())
                (requested.out / name).write_text(remark + failure.text, encoding="utf-8")
        message[0] = len(tally.failures)

    quick.install()
    with tempfile.TemporaryDirectory() as folder, quick.compiled(False, True):
        os.environ["GUDGEON_CACHE"] = f"{folder}/cache"
        seeds = range(requested.seed, requested.seed + designs)
        tally = try_seeds(seeds, Path(folder), requested.machines, requested.family, report)
    print(f"{tally}; {len(tally.failures)} failures; {time.time() - begun:.0f} s")
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
