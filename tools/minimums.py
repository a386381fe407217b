"""Print the lowest versions that pyproject.toml allows, as constraints for pip: `name==version` in each line.

    python tools/minimums.py [EXTRA ...]

`make packages` installs these versions and runs every command (tests/packages.py), which verifies the ranges.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOWEST = re.compile(r"([A-Za-z0-9._-]+)(?:\[[^]]*\])?>=([0-9.]+)")
OWN_EXTRAS = re.compile(r"gudgeon\[([^]]+)\]")


def find_lowest_versions(extras: Sequence[str]) -> dict[str, str]:
    """Return the lowest version of each dependency of gudgeon and of some extras, {name: version}.

    Raises ValueError for a dependency without a lowest version.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

    def resolve(of: Sequence[str]) -> Iterator[str]:
        """Yield the dependencies, with those of gudgeon's own extras resolved."""
        for text in of:
            if own := OWN_EXTRAS.fullmatch(text):
                for extra in own[1].split(","):
                    yield from resolve(project["optional-dependencies"][extra])
            else:
                yield text

    lowest_versions = {}
    for text in (*resolve(project["dependencies"]), *resolve([f"gudgeon[{extra}]" for extra in extras])):
        if not (declared := LOWEST.fullmatch(text)):
            raise ValueError(f"{text}: expected NAME>=VERSION in pyproject.toml")
        lowest_versions[declared[1]] = declared[2]
    return lowest_versions


if __name__ == "__main__":
    for name, version in find_lowest_versions(sys.argv[1:] or ["all"]).items():
        print(f"{name}=={version}")
