"""A model as C: the texts, and the names of everything in them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import resources
from typing import Any

import jinja2

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.ledger import tell
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.c import functions, ranges_printer, readme
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c.curves import NAME as CURVES
from gudgeon.generator.targets.c.curves import curves_code
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.layout import within
from gudgeon.generator.targets.c.model_header import header_values, known_bounds
from gudgeon.generator.targets.c.newton import newton_code, tangent_code
from gudgeon.generator.targets.c.play import clearances_code
from gudgeon.generator.targets.c.reduced import reduced_code

MAIN = "scene.c"


def emit(program: Program, begun: Callable[[str], None] | None = None) -> KernelSource:
    """The whole scene as C text with its description; `begun` is told model.h as soon as it is known."""
    model, tree, integrated = program.model, program.tree, program.integrated
    prepare = closed_linkage.prepare_kernel(model)
    bounds = known_bounds(program)
    header = within(render("model.h.jinja", **header_values(program, bounds)))
    if begun:
        begun(header)
    lanes = lanes_code.lanes_code(program, render) if program.has_lanes else {}
    files = {name: within(text) for name, text in (_files(program, prepare, header, bounds) | lanes).items()}
    files[readme.NAME] = readme.readme(program, files)
    course = program.course
    return describe(
        model, files=files, main=MAIN,
        pivots=program.kkt.pivots, start_pivots=course.pivots if course else (), motion_pivots=integrated.pivots,
        operations=_operations(program, prepare),
        tree=tree.system.unknowns if tree else (), chain=integrated.chain,
        closures=tuple(row.name for row in tree.system.rows) if tree else (), formulation=program.formulation,
        story=tell(
            model, program.kkt, course.solved if course else integrated.kkt, integrated.system,
            course.groups if course else (),
        ),
        lanes=lanes_code.MAIN if lanes else "",
    )  # fmt: skip


def _files(program: Program, prepare: Kernel, header: str, bounds: Kernel | None) -> dict[str, str]:
    """The texts, in the order in which they are read; MAIN includes the others and what the engine adds."""
    files = {
        "parameters.c": _kernels(prepare),
        "constraints.c": _kernels(*program.closed),
        "clearance.c": clearances_code(program, render),
        "dynamics.c": _kernels(*program.right_hand_side),
        "reduced.c": reduced_code(program.model, program.tree, render, _kernels) if program.tree else "",
        "newton.c": _linearized(program),
        "positions.c": _kernels(*program.course.kernels) if program.course else "",
        "watched.c": _bounds(program, bounds),
    }
    files = {name: text for name, text in files.items() if text}
    if tables := curves_code(program.model.scene.mechanism.curves, files.values()):
        files = {CURVES: tables, **files}
    includes = ("model.h", "engine/scene/kernels.h", "engine/scene/trigonometry.h", *files, "engine/scene/scene.c")
    main = "".join(f'#include "{name}"\n' for name in includes)
    return {MAIN: main, "model.h": header, **files}


def _linearized(program: Program) -> str:
    """The linearized equations (Newton's matrix), and the step back onto the rows."""
    methods = program.methods
    if methods is None:
        return ""
    slopes = tangent_code(program.pins, methods, render)
    return slopes + newton_code(methods.newton, render) + functions.kernel(methods.closing)


def _bounds(program: Program, watched: Kernel | None) -> str:
    """Bounds over ranges of time and state: of terms of time, corners of drives, what is watched."""
    jumps = program.integrated.jumps if program.integrates else None
    kernels = [program.terms, watched, jumps.ranges if jumps else None]
    values = functions.kernel(jumps.values) + "\n" if jumps else ""
    return values + "\n".join(ranges_printer.kernel(kernel) for kernel in kernels if kernel)


def render(name: str, /, **values: Any) -> str:
    """A template with its substitutions; an undefined one is an error."""
    return _environment().get_template(name).render(**values) + "\n"


@cache
def _environment() -> jinja2.Environment:
    """One for all scenes: reading the templates takes half of the time that a small scene takes."""

    def load(name: str) -> str:
        return resources.files("gudgeon.templates").joinpath("c", name).read_text(encoding="utf-8")

    return jinja2.Environment(
        loader=jinja2.FunctionLoader(load), undefined=jinja2.StrictUndefined, autoescape=False, trim_blocks=True
    )


def _kernels(*kernels: Kernel) -> str:
    return "\n".join(map(functions.kernel, kernels))


def _all(program: Program, *prepare: Kernel) -> list[Kernel]:
    tree, extra = program.tree, program.methods or program.course
    kernels = [*program.right_hand_side, *program.closed, *(tree.every if tree else ()), *prepare]
    return [*kernels, *(extra.kernels if extra else ()), *program.laws]


def _operations(program: Program, prepare: Kernel) -> dict[str, int]:
    """Of each function, as `check -v` tells them; of laws those of each joint."""
    calls = [(pin.clearance.name, *call) for pin in program.pins for call in pin.laws.items()]
    laws = {f"{role}_{joint}_force": call.kernel for joint, role, call in calls}
    own = {kernel.name: kernel for kernel in _all(program, prepare) if kernel not in program.laws}
    return {name: kernel.operations for name, kernel in (own | laws).items()}
