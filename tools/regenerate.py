"""Derive every scene of every shipped mechanism anew and write generated/ (run by `make generated`)."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from gudgeon.generator.pipeline import generate
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.loading.shipped import write_generated


def regenerate(mechanisms: Path, generated: Path) -> None:
    """Write `generated/<mechanism>/<scene>/` for each file; folders that nothing stands behind are removed."""
    wanted = set()
    for file in sorted(mechanisms.glob("*.yaml")):
        data = file.read_bytes()
        for scene in read_mechanism(data, file.name, None).scenes:
            folder = generated / file.stem / scene
            write_generated(generate(data, file.name, scene, None), folder)
            wanted.add(folder)
            print(f"generated/{file.stem}/{scene}")
    for folder in generated.glob("*/*/"):
        if folder not in wanted and folder.parent.name != "__pycache__":
            shutil.rmtree(folder)


if __name__ == "__main__":
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("generated", type=Path, nargs="?", default=root / "generated", help="another folder for it")
    regenerate(root / "mechanisms", parser.parse_args().generated)
