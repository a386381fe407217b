"""The table of contents: YAML → Mechanism → Scene → Model → Program → KernelSource, a call each."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model, make_model
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.mechanism.scene import make_scene
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.redundancy import find_redundancy
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.emit import emit


def derive(data: bytes, file: str, scene: str, overrides: Mapping[str, str | float | bool] | None = None) -> Model:
    """The equations of one scene of a mechanism file, without the rows that say nothing new."""
    mechanism = read_mechanism(data, file, overrides)
    model = make_model(make_scene(mechanism, scene))
    return model.without(find_redundancy(model, describe(model)))


def in_c(model: Model, formulation: str = "reduced") -> KernelSource:
    """The C of a model, with the names of everything in it."""
    return emit(make_program(model, formulation))


def generate(
    data: bytes, file: str, scene: str, overrides: Mapping[str, str | float | bool] | None = None,
    formulation: str = "reduced",
) -> KernelSource:  # fmt: skip
    """The C of one scene of a mechanism file."""
    return in_c(derive(data, file, scene, overrides), formulation)
