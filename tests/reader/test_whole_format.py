"""The whole format at work: files that use all of it read, derive, compile without a warning and assemble."""

from __future__ import annotations

import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.slow import slow_but

VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"
SCENES = [
    ("every_kind", "ideal"),
    ("slider_crank", "oiled"),
    ("shapes", "ideal"),
    *(("press_as_designed", scene) for scene in ("fast", "ideal", "lubricated")),
]


@cache
def emitted(name: str, scene: str) -> KernelSource:
    return generate_kernel_source((VALID / f"{name}.yaml").read_bytes(), name, scene)


@pytest.mark.parametrize("of", slow_but(SCENES[:3], SCENES), ids="-".join)
def test_emits_without_warnings(of: tuple[str, str], tmp_path: Path) -> None:
    source = emitted(*of)
    for file, text in source.files.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *build_include_flags()]
    lanes = [source.lane_file] if source.lane_file else []
    done = subprocess.run(
        [*find_compiler(), *flags, source.main, *lanes], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[:2000]


@pytest.mark.parametrize("of", slow_but(SCENES[:3:2], SCENES[:4]), ids="-".join)
def test_assembles(of: tuple[str, str]) -> None:
    """Φ = 0 at the start, and Φ_q is its derivative there: a gear's carrier, a driven distance, all of it."""
    name, scene = of
    source = emitted(name, scene)
    linkage = Simulation(CompiledModel(source, compile_kernels(source)), VALID / f"{name}.yaml")
    q, h = linkage.start().q, 1e-6
    assert np.abs(linkage.phi(0.0, q)).max() < 1e-12
    columns = [(linkage.phi(0.0, q + h * step) - linkage.phi(0.0, q - h * step)) / (2 * h) for step in np.eye(len(q))]
    np.testing.assert_allclose(linkage.phi_q(0.0, q), np.transpose(columns), atol=1e-8)
