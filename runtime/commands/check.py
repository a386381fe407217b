"""`gudgeon check`: read a mechanism file and say whether it is valid; with -v, what each scene becomes."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gudgeon.errors import InputError, InputErrors
from gudgeon.kernel_source import KernelSource
from gudgeon.loading import find_mechanism, kernel_source, read_bytes

if TYPE_CHECKING:
    from gudgeon.generator.mechanism import Mechanism


def check_file(name: str, verbose: bool, as_json: bool) -> int:
    """Read, tell, and return the exit code."""
    from gudgeon.generator.read_yaml import read_mechanism

    file = find_mechanism(name)
    try:
        data = read_bytes(file)
        mechanism = read_mechanism(data, str(file))
    except InputError as error:
        if not as_json:
            raise
        print(json.dumps({"valid": False, "errors": _errors(error)}, ensure_ascii=False, indent=1))
        return error.exit_code
    scenes = {scene: kernel_source(data, file, scene)[0] for scene in mechanism.scenes} if verbose else {}
    if as_json:
        print(json.dumps(_document(mechanism, scenes), ensure_ascii=False, indent=1))
        return 0
    print(f"valid: {_counts(mechanism)}")
    if scenes:
        _print(mechanism, scenes)
    return 0


def _errors(error: InputError) -> list[dict[str, Any]]:
    errors = error.errors if isinstance(error, InputErrors) else (error,)
    return [
        {
            "kind": type(e).__name__,
            "file": e.where.file if e.where else None,
            "line": e.where.line if e.where else None,
            "column": e.where.column if e.where else None,
            "message": e.message,
            "hint": e.hint,
        }
        for e in errors
    ]


def _counts(mechanism: Mechanism) -> str:
    numbers = [(len(mechanism.bodies), "body", "bodies"), (len(mechanism.joints), "joint", "joints"),
               (len(mechanism.drives), "drive", "drives")]  # fmt: skip
    words = [f"{count} {one if count == 1 else more}" for count, one, more in numbers]
    return f"{', '.join(words)}; scenes {', '.join(mechanism.scenes)}"


def non_zeros(source: KernelSource) -> int:
    """Entries of the scene's Φ_q that are not identically zero: those that its C assigns.

    The C function fills Φ_q of the closed linkage, row by row; rows of joints with play are not counted.
    """
    entries = {int(k) for text in source.files.values() for k in re.findall(r"\bphi_q\[(\d+)\] = ", text)}
    kept = {row.name for row in source.rows}
    return sum(source.start_rows[k // len(source.coordinates)].name in kept for k in entries)


def _facts(source: KernelSource) -> dict[str, int]:
    facts = {
        "unknowns": len(source.coordinates),
        "rows": len(source.rows),
        "degrees of freedom": source.degrees_of_freedom,
        "non-zeros of Φ_q": non_zeros(source),
        "joints with play": len(source.clearances),
        "numbers that can be set": len(source.slots),
    }
    return facts | {_label(name): count for name, count in source.operations.items()}


def _events(source: KernelSource) -> list[str]:
    """What is watched: "top (falling, recorded)"."""
    does = {"record": "recorded", "stop": "ends the run"}
    return [f"{event.name} ({event.direction}, {does[event.action]})" for event in source.events]


def _label(kernel: str) -> str:
    return kernel if " " in kernel else f"operations in {kernel}"


def _document(mechanism: Mechanism, scenes: Mapping[str, KernelSource]) -> dict[str, Any]:
    return {
        "valid": True,
        "name": mechanism.name,
        "title": mechanism.title,
        "bodies": list(mechanism.bodies),
        "joints": list(mechanism.joints),
        "drives": list(mechanism.drives),
        "scenes": {name: _of_scene(scenes[name]) if name in scenes else {} for name in mechanism.scenes},
    }


def _of_scene(source: KernelSource) -> dict[str, Any]:
    return {**_facts(source), "events": _events(source), "notes": list(source.notes)}


def _print(mechanism: Mechanism, scenes: Mapping[str, KernelSource]) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    facts = {scene: _facts(source) for scene, source in scenes.items()}
    console = Console(width=None if sys.stdout.isatty() else 200, highlight=False)
    table = Table(title=mechanism.title or mechanism.name, title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    table.add_column("", no_wrap=True)
    for scene in scenes:
        table.add_column(scene, justify="right", no_wrap=True)
    for name in dict.fromkeys(name for found in facts.values() for name in found):
        if name.startswith("operations") and not any(found.get(name) for found in facts.values()):
            continue  # a kernel of zeros in every scene
        table.add_row(name, *(f"{found[name]:,}" if name in found else "–" for found in facts.values()))
    console.print(table)
    for scene, source in scenes.items():
        if source.events:
            console.print(f"{scene}: events {', '.join(_events(source))}", markup=False)
        for note in source.notes:
            console.print(f"{scene}: {note}", markup=False)
