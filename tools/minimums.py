"""The lowest versions that pyproject.toml allows, as constraints for pip: `name==version`, a line for each dependency.

    python tools/minimums.py [EXTRA ...]

`make packages` installs them and runs every command (tests/packages.py): the ranges in pyproject.toml are what that
proves.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOWEST = re.compile(r"([A-Za-z0-9._-]+)(?:\[[^]]*\])?>=([0-9.]+)")
OWN = re.compile(r"gudgeon\[([^]]+)\]")


def lowest(extras: Sequence[str]) -> dict[str, str]:
    """The lowest version of each dependency by its name, of extras too. Raises ValueError where none is declared."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

    def needed(of: Sequence[str]) -> Iterator[str]:
        for text in of:
            if own := OWN.fullmatch(text):
                for extra in own[1].split(","):
                    yield from needed(project["optional-dependencies"][extra])
            else:
                yield text

    found = {}
    for text in (*needed(project["dependencies"]), *needed([f"gudgeon[{extra}]" for extra in extras])):
        if not (declared := LOWEST.fullmatch(text)):
            raise ValueError(f"{text}: expected NAME>=VERSION in pyproject.toml")
        found[declared[1]] = declared[2]
    return found


if __name__ == "__main__":
    for name, version in lowest(sys.argv[1:] or ["all"]).items():
        print(f"{name}=={version}")
