"""Print the texts of an archive of generated/ (generated C), so that `git diff` compares them (CONTRIBUTING.md)."""

from __future__ import annotations

import json
import lzma
import sys
from pathlib import Path


def main(file: Path) -> None:
    """Print all texts of an archive, each after a line with its path."""
    archive = json.loads(lzma.decompress(file.read_bytes()))
    descriptions = {f"{scene}/kernel.json": stored["rest"] for scene, stored in archive["scenes"].items()}
    for path, text in sorted({**archive["texts"], **descriptions}.items()):
        print(f"==> {path} <==\n{text}")


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")  # type: ignore[union-attr]
    main(Path(sys.argv[1]))
