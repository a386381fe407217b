"""The whole format at work: files that use all of it read, derive, compile without a warning and assemble."""

from __future__ import annotations

import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.pipeline import generate
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import include_flags
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation

VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"
SCENES = [("every_kind", "ideal"), ("press_as_designed", "fast"), ("slider_crank", "oiled"), ("shapes", "ideal"),
          *(pytest.param("press_as_designed", scene, marks=pytest.mark.slow) for scene in ("ideal", "lubricated"))]


@cache
def emitted(name: str, scene: str) -> KernelSource:
    return generate((VALID / f"{name}.yaml").read_bytes(), name, scene)


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_emits_without_warnings(name: str, scene: str, tmp_path: Path) -> None:
    source = emitted(name, scene)
    for file, text in source.files.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *include_flags()]
    lanes = [source.lanes] if source.lanes else []
    done = subprocess.run(
        [*find_compiler(), *flags, source.main, *lanes], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[:2000]


@pytest.mark.parametrize(
    ("name", "scene"), [("every_kind", "ideal"), ("press_as_designed", "fast"), ("shapes", "ideal")]
)
def test_assembles(name: str, scene: str) -> None:
    """Φ = 0 at the start, and Φ_q is its derivative there: a gear's carrier, a driven distance, all of it."""
    source = emitted(name, scene)
    linkage = Simulation(CompiledModel(source, compile_kernels(source)), VALID / f"{name}.yaml")
    q, h = linkage.start().q, 1e-6
    assert np.abs(linkage.phi(0.0, q)).max() < 1e-12
    columns = [(linkage.phi(0.0, q + h * step) - linkage.phi(0.0, q - h * step)) / (2 * h) for step in np.eye(len(q))]
    np.testing.assert_allclose(linkage.phi_q(0.0, q), np.transpose(columns), atol=1e-8)
