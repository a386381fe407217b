"""Mechanisms closed at their start, to be drawn, and what a sketch has by name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.assembly.closure import AssemblyProblem  # noqa: E402
from gudgeon.drawing.configuration import Configuration  # noqa: E402
from gudgeon.drawing.labels import NameLabels  # noqa: E402
from gudgeon.drawing.picture import build_figure  # noqa: E402
from gudgeon.drawing.shapes import Sketch  # noqa: E402
from gudgeon.generator.pipeline import build_closed_linkage  # noqa: E402
from gudgeon.generator.reader.read import read_mechanism  # noqa: E402
from gudgeon.model.compiled import Array  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Drawn:
    mechanism: Any
    linkage: Any
    problem: AssemblyProblem
    configuration: Configuration


@cache
def drawn(file: Path | str) -> Drawn:
    """The last scene of a file (where it has play, one with it) at its start; of a text its own."""
    text = file.encode() if isinstance(file, str) else file.read_bytes()
    mechanism = read_mechanism(text, "drawn.yaml", None)
    linkage, _ = build_closed_linkage(mechanism, list(mechanism.scenes)[-1])
    problem = AssemblyProblem(linkage, linkage.p, 0.0)
    with np.errstate(all="ignore"):
        q, _ = problem.find_nearest_configuration()
    return Drawn(mechanism, linkage, problem, Configuration(linkage.source, linkage.p, q))


def boxes(picture: Any) -> Iterator[tuple[str, tuple[float, ...]]]:
    for ax in picture.axes:
        for artist in ax.get_children():
            if isinstance(artist, NameLabels):
                yield from artist.boxes.items()


def named(sketch: Sketch) -> dict[str, Array]:
    """Boxes of names (left, low, right, high) in metres."""
    picture = build_figure([sketch], [""], "x")
    picture.draw_without_rendering()
    back = picture.axes[0].transData.inverted().transform
    return {part: np.ravel(back(np.reshape(box, (2, 2)))) for part, box in boxes(picture)}
