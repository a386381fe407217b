"""Whether there is memory and disk for all scenes of `gudgeon run`, asked before the first of them begins."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.files.room import check_disk, check_memory
from gudgeon.model.default_step import scene_number
from gudgeon.model.evaluation import evaluated_bytes
from gudgeon.model.room import sample_bytes
from gudgeon.simulation.arguments import DEFAULT_OUTPUT

if TYPE_CHECKING:
    from gudgeon.commands.run import Request
    from gudgeon.model.compiled import Array
    from gudgeon.simulation.simulation import Simulation


def check_needs(request: Request, scenes: Mapping[str, tuple[Simulation, Array]]) -> None:
    """MemoryError where samples and all that follows from them do not fit, OutputError where their files do not.

    scenes: each with its numbers. Files hold every series, and take the places of older ones, one after the other; a
    disk is not asked where no file is written.
    """
    from gudgeon.results.series import catalogue

    given, counts = request.output, dict[str, float]()
    for name, (one, p) in scenes.items():
        counts[name] = 1.0 + (scene_number(one.source, "output", p, DEFAULT_OUTPUT) if given is None else given)
    most = f"{len(scenes)} scenes of {max(counts.values()):.0f} samples"
    each = {name: sample_bytes(one.compiled) + evaluated_bytes(one.compiled) for name, (one, _) in scenes.items()}
    check_memory(sum(counts[name] * each[name] for name in scenes), most)
    if find_spec("h5py"):
        files = [8.0 * counts[name] * (1 + len(catalogue(one.source))) for name, (one, _) in scenes.items()]
        older = sum(_size(request.out, one.source.mechanism, name) for name, (one, _) in scenes.items())
        check_disk(request.out, max(*files, sum(files) - older), f"the results, {most},")


def _size(out: Path, mechanism: str, scene: str) -> int:
    from gudgeon.commands.run import result_path

    path = result_path(out, mechanism, scene)
    return path.stat().st_size if path.is_file() else 0
