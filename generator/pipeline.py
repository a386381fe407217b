"""Runs the stages from YAML to C: Mechanism (data), Model (equations), Program (functions), KernelSource (C).

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
from gudgeon.generator.reader.read import Overrides, Seconds, measure_stage, read_scene
from gudgeon.generator.redundancy import check_mass_matrix, find_redundancy
from gudgeon.generator.targets.c.describe import describe_scene
from gudgeon.generator.targets.c.emit import PartCallback, emit_scene
from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
from gudgeon.generator.targets.numpy.module import NumPyModel
from gudgeon.generator.targets.numpy.reference import compute_reference_values


def derive_scene(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Model:
    """Read one scene of a mechanism file and derive its equations, without redundant constraint equations.

    Raises InputError. overrides: address -> value in place of the file's; seconds: a dict that gets the duration of
    each stage (s), or None.
    """
    return derive_equations(read_scene(data, file, scene, overrides, seconds), seconds)


def derive_equations(scene: Scene, seconds: Seconds | None = None) -> Model:
    """Derive the equations of a scene that was read, without redundant constraint equations.

    Raises BadValueError if masses make the motion undetermined. `seconds` gets the duration of each stage (s), unless
    None.
    """
    with measure_stage("equations", seconds):
        model = replace(make_model(scene), targets=TARGETS)
    with measure_stage("rank of the rows", seconds):
        model = model.remove_redundant_rows(find_redundancy(model, describe_scene(model)))
    check_masses(model)
    check_mass_matrix(model, describe_scene(model))
    return model


def build_closed_linkage(
    mechanism: Mechanism, scene: str, parameters: Mapping[str, float | str] | None = None
) -> tuple[NumPyLinkage, list[int]]:
    """Return the closed linkage of a scene (all joints ideal, without play) in NumPy, for its assembly.

    Also return the indices of its constraint equations that the scene with clearances keeps. parameters: run-time
    parameters by address, as `simulate` accepts them; None for the file's values.
    """
    model = make_model(make_scene(mechanism, scene))
    names_of_remaining_rows = {row.name for row in model.rows}
    linkage = NumPyLinkage(model, describe_scene(model), parameters)
    return linkage, [r for r, row in enumerate(model.all_rows) if row.name in names_of_remaining_rows]


def _make_formula_writer(model: Model) -> Any:
    """Return the FormulaWriter of a model, which prints its equations in the notation of its documents.

    The LaTeX target is imported here, at the first use.
    """
    from gudgeon.generator.targets.latex.to_html import FormulaWriter

    return FormulaWriter(model)


# Targets of `Model.written` by name, for the full formulation; "letters": how documents write the equations.
TARGETS: Mapping[str, Callable[[Model], Any]] = {
    "numpy": lambda model: NumPyModel(make_program(model, "full")),
    "letters": _make_formula_writer,
}


def generate_c(
    model: Model,
    formulation: str = "reduced",
    seconds: Seconds | None = None,
    on_part_ready: PartCallback | None = None,
) -> KernelSource:
    """Return the C code of a model, with the description of its contents and reference values.

    formulation: "reduced" or "full". `on_part_ready` is called with parts of the code that can be compiled already.
    `seconds` gets the duration of each stage (s), unless None.
    """
    with measure_stage("functions", seconds):
        program = make_program(model, formulation)
    with measure_stage("C", seconds):
        source = emit_scene(program, on_part_ready)
    with measure_stage("reference values", seconds):
        return replace(source, reference=compute_reference_values(program, source))


def generate_kernel_source(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, formulation: str = "reduced"
) -> KernelSource:
    """Return the C code of one scene of a mechanism file; as `derive_scene`, then `generate_c`.

    overrides: None for the values of the file.
    """
    return generate_c(derive_scene(data, file, scene, overrides), formulation)
