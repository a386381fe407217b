"""Runs the stages of the compiler: YAML → Mechanism → Scene → Model → Program → KernelSource, one call each.

If `seconds` is given, each stage stores its duration there; `begun` is called with parts that can be compiled already.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model, make_model
from gudgeon.generator.equations.notes import check_masses
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.mechanism import Mechanism, Scene, make_scene
from gudgeon.generator.reader.read import Overrides, Seconds, read_scene, stage
from gudgeon.generator.redundancy import find_redundancy, refuse_singular_masses
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.emit import Begun, emit
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
from gudgeon.generator.targets.numpy.module import NumPyModel
from gudgeon.generator.targets.numpy.reference import reference_values


def derive(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Model:
    """Derive the equations of one scene of a mechanism file, without redundant constraint equations."""
    return equations(read_scene(data, file, scene, overrides, seconds), seconds)


def equations(scene: Scene, seconds: Seconds | None = None) -> Model:
    """Derive the equations of a scene that was read, without redundant constraint equations."""
    with stage("equations", seconds):
        model = replace(make_model(scene), targets=TARGETS)
    with stage("rank of the rows", seconds):
        model = model.without(find_redundancy(model, describe(model)))
    check_masses(model)
    refuse_singular_masses(model, describe(model))
    return model


def closed_linkage(
    mechanism: Mechanism, scene: str, given: Mapping[str, float | str] | None = None
) -> tuple[NumPyLinkage, list[int]]:
    """Return the closed linkage of a scene in NumPy, and the indices of its rows that the scene with play keeps.

    given: run-time parameters by address, as `simulate` accepts them.
    """
    model = make_model(make_scene(mechanism, scene))
    remaining = {row.name for row in model.rows}
    linkage = NumPyLinkage(model, describe(model), given)
    return linkage, [r for r, row in enumerate(model.all_rows) if row.name in remaining]


def _letters(model: Model) -> Any:
    """Return how the model's equations are written in documents."""
    from gudgeon.generator.targets.latex.to_html import Letters

    return Letters(model)


# Targets of `Model.written` by name, for the full formulation; "letters": how documents write the equations.
TARGETS: Mapping[str, Callable[[Model], Any]] = {
    "numpy": lambda model: NumPyModel(make_program(model, "full")),
    "letters": _letters,
}


def in_c(
    model: Model, formulation: str = "reduced", seconds: Seconds | None = None, begun: Begun | None = None
) -> KernelSource:
    """Return the C code of a model, with the description of its contents and reference values."""
    with stage("functions", seconds):
        program = make_program(model, formulation)
    with stage("C", seconds):
        source = emit(program, begun)
    with stage("reference values", seconds):
        return replace(source, reference=reference_values(program, source))


def generate(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, formulation: str = "reduced"
) -> KernelSource:
    """Return the C code of one scene of a mechanism file."""
    return in_c(derive(data, file, scene, overrides), formulation)
