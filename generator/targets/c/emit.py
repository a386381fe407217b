"""A model as C, in absolute and in tree coordinates: the texts, and the names of everything in them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache, partial
from importlib import resources
from typing import Any

import jinja2
import sympy as sp

from gudgeon.contract.kernel_source import ENGINE_PART, HEADER, MAIN, KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.kernels.driven_chains import ChainKernels
from gudgeon.generator.kernels.ledger import tell
from gudgeon.generator.kernels.program import Program, TreeFunctions
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.symbols.storage import PARAMETERS, Place
from gudgeon.generator.targets.c import functions, ranges_printer, readme, taylor
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c.curves import NAME as CURVES
from gudgeon.generator.targets.c.curves import curves_code
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.model_header import header_values, known_bounds, of_joints
from gudgeon.generator.targets.c.newton import newton_code, tangent_code
from gudgeon.generator.targets.c.play import clearances_code
from gudgeon.generator.targets.c.printer import within
from gudgeon.generator.targets.c.reduced_summary import reduced_summary

CLEARANCES = "clearance.c"
NOT_AT_START = ("acceleration_rhs", "outputs")  # of the closed linkage's functions
ABSOLUTE, REDUCED, METHODS = 1, 2, 3  # the parts of MAIN, as PART in C counts them
Begun = Callable[[int, Mapping[str, str]], None]
Texts = dict[str, Callable[[], str]]  # by file, printed when they are asked for


def emit(program: Program, begun: Begun | None = None) -> KernelSource:
    """The whole scene as C text with its description; with a series there is Taylor's method.

    `begun` is told the engine, then each part of MAIN, with the files so far, as soon as these are all that it reads.
    """
    model, series = program.model, program.series
    bounds = known_bounds(program)
    files = {HEADER: within(render("model.h.jinja", **header_values(program, bounds)))}
    if begun:
        begun(ENGINE_PART, files)
    parts, shared = _parts(program, bounds), _shared(program)
    if series:
        parts[REDUCED][taylor.FILE] = lambda: taylor.taylor_code(series)
    files |= {MAIN: _main(parts, shared), **_printed(shared)}
    for number, texts in parts.items():
        files |= _printed(texts)
        if begun and not model.scene.mechanism.curves:
            begun(number, files)
    if tables := curves_code(model.scene.mechanism.curves, files.values()):
        files |= {MAIN: _main(parts, [CURVES, *shared]), CURVES: tables}
    if program.has_lanes:
        files |= {name: within(text) for name, text in lanes_code.lanes_code(program, render).items()}
    files[readme.NAME] = readme.readme(program, files)
    told = described(program, files, () if CURVES in files else tuple(parts))
    return replace(told, taylor=taylor.FILE) if series else told


def described(program: Program, files: Mapping[str, str], units: tuple[int, ...] = ()) -> KernelSource:
    """All that is told of a scene beside its texts."""
    model, tree, integrated, course = program.model, program.tree, program.integrated, program.course
    return describe(
        model,
        files=files,
        main=MAIN,
        units=units,
        pivots=program.kkt.pivots,
        start_pivots=course.pivots if course else (),
        motion_pivots=integrated.pivots,
        operations=_operations(program),
        tree=tree.system.unknowns if tree else (),
        chain=integrated.chain,
        closures=tuple(row.name for row in tree.system.rows) if tree else (),
        formulation=program.formulation,
        story=tell(
            model,
            program.kkt,
            course.solved if course else integrated.kkt,
            integrated.system,
            course.groups if course else (),
        ),
        lanes=lanes_code.MAIN if program.has_lanes else "",
        stages=program.staged,
    )


def file_names(program: Program) -> list[str]:
    """What `emit` writes, but for tables of curves and README.md, without writing it."""
    parts = _parts(program, known_bounds(program))
    printed = [name for texts in parts.values() for name in texts]
    return [HEADER, MAIN, *_shared(program), *printed, *([lanes_code.MAIN] if program.has_lanes else [])]


def _shared(program: Program) -> Texts:
    """What every part but that of the methods reads."""
    return {CLEARANCES: lambda: clearances_code(program, render)} if program.pins else {}


def _parts(program: Program, bounds: Kernel | None) -> dict[int, Texts]:
    """What is in each part of MAIN, in the order in which it is read."""
    tree, course = program.tree, program.course
    parts: dict[int, Texts] = {
        ABSOLUTE: {
            "parameters.c": lambda: _parameters(program),
            "constraints.c": lambda: _closed(program),
            "dynamics.c": lambda: _kernels(*program.right_hand_side),
        }
    }
    if tree:
        parts[REDUCED] = {"reduced.c": lambda: reduced_code(program.model, tree, render, _kernels)}
    if course:
        parts[METHODS] = {"positions.c": lambda: _kernels(*course.kernels)}
    elif program.methods:
        parts[METHODS] = {"newton.c": lambda: _linearized(program)}
    if program.methods and program.staged:
        parts[METHODS]["newton_complex.c"] = partial(_kernels, *program.methods.at_complex)
    if _bounded(program, bounds):
        parts[METHODS]["watched.c"] = lambda: _watched(program, bounds)
    return parts


def _printed(texts: Texts) -> dict[str, str]:
    return {name: within(text()) for name, text in texts.items()}


def _main(parts: Mapping[int, Iterable[str]], shared: Iterable[str]) -> str:
    """It includes all others, whole or a part of them, and what the engine adds."""
    first = (HEADER, "engine/scene/kernels.h", "engine/scene/trigonometry.h")
    lines = ["/* All files together, or with -DPART=1, 2, 3 those of a part: these are compiled side by side. */"]
    lines += [*map(_include, first), *_only(f"PART != {METHODS}", shared)]
    for number, names in parts.items():
        lines += _only(f"!PART || PART == {number}", names)
    return "\n".join([*lines, _include("engine/scene/scene.c"), ""])


def _only(condition: str, names: Iterable[str]) -> list[str]:
    lines = [_include(name) for name in names]
    return [f"#if {condition}", *lines, "#endif"] if lines else []


def _include(name: str) -> str:
    return f'#include "{name}"'


def _parameters(program: Program) -> str:
    """All numbers, then those of joints with play by their place."""
    told = render("of_joints.c.jinja", of_joints=of_joints(program.model)) if program.pins else ""
    return _kernels(program.prepare) + told


def _closed(program: Program) -> str:
    """Functions of the closed linkage; where runs are integrated, which starts are the same."""
    at_start = (kernel for kernel in program.closed if kernel.name not in NOT_AT_START)
    return _kernels(*program.closed) + (same_start(at_start) if program.integrates else "")


def _linearized(program: Program) -> str:
    """The linearized equations (Newton's matrix), and the step back onto the rows."""
    methods = program.methods
    if methods is None:
        return ""
    slopes = tangent_code(program.pins, methods, render, program.model.law_states)
    return slopes + newton_code(methods.newton, render) + functions.kernel(methods.closing)


def _bounded(program: Program, watched: Kernel | None) -> bool:
    """Whether any bounds are known."""
    return bool(program.terms.kernel or watched)


def _watched(program: Program, watched: Kernel | None) -> str:
    """Bounds over ranges of time and state: of terms of time, of what is watched."""
    return "\n".join(ranges_printer.kernel(kernel) for kernel in (program.terms.kernel, watched) if kernel)


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


def _all(program: Program) -> list[Kernel]:
    tree, extra = program.tree, program.methods or program.course
    kernels = [*program.right_hand_side, *program.closed, *(tree.every if tree else ()), program.prepare]
    return [*kernels, *(extra.kernels if extra else ()), *program.laws]


def _operations(program: Program) -> dict[str, int]:
    """Of each function, as `check -v` tells them; of laws those of each joint."""
    calls = [(pin.clearance.name, *call) for pin in program.pins for call in pin.laws.items()]
    laws = {f"{role}_{joint}_force": call.kernel for joint, role, call in calls}
    own = {kernel.name: kernel for kernel in _all(program) if kernel not in program.laws}
    return {name: kernel.operations for name, kernel in (own | laws).items()}


def same_start(called: Iterable[Kernel]) -> str:
    """The function that tells it, of the kernels that a start calls (engine/scene/start.c).

    Where they read tables, or hand over all numbers, no two are.
    """
    lines = [line for kernel in called for section in kernel.sections for line in section.statements]
    read = [name for line in lines for name in _numbers(line)]
    names = [*dict.fromkeys(read)]
    tests = "\n        && ".join(f"same_number(p->{name}, other->{name})" for name in names)
    known = all(name.isidentifier() for name in names)
    body = f"    return {tests};\n" if known and tests else f"    (void)p, (void)other;\n    return {int(known)};\n"
    return (
        "\n/* Whether a start with these numbers is that with the others: what closing the linkage reads. */\n"
        f"int same_start(const Parameters *p, const Parameters *other)\n{{\n{body}}}\n"
    )


def _numbers(line: Line) -> list[str]:
    """What a line reads of Parameters; "" is all of it."""
    if isinstance(line, Statement) and isinstance(line.value, Place) and line.value.is_parameter:
        return [line.value.member]
    return [""] if PARAMETERS in line.reads else []


Render = Callable[..., str]


def reduced_code(model: Model, tree: TreeFunctions, render: Render, print_kernels: Render) -> str:
    """The kernels in tree coordinates, the way there and back, and those of driven chains."""
    parts = [functions.comment(reduced_summary(tree.system))]
    parts += [print_kernels(*tree.around), print_kernels(*tree.kernels)]
    if tree.rescued:
        parts.append(render("multipliers.c.jinja", multipliers=_multipliers(model, tree.system)))
    if chains := tree.chains:
        kernels = print_kernels(*chains.kernels)
        parts.append(render("driven_loops.c.jinja", kernels=kernels, shares=_shares(chains), turned=_turned(chains)))
    return "\n".join(parts)


def _shares(chains: ChainKernels) -> list[str]:
    """What a step of each coordinate is multiplied by to be a number: an angle is one, a slide goes by the size."""
    size = f"1.0 / (p->{chains.size} + DBL_MIN)" if chains.size.is_Symbol else "1.0"  # without one all points are one
    return ["1.0" if "." not in name else size for name in chains.chain.names]


def _turned(chains: ChainKernels) -> list[tuple[int, str]]:
    """Where each direction is in q that a step of the chains' coordinates turns, and how far it turns."""

    def factor(c: sp.Expr) -> str:
        if c == 1:
            return ""
        return f"{float(c)!r} * " if c.is_Number else f"-p->{-c} * " if (-c).is_Symbol else f"p->{c} * "

    first = chains.first + len(chains.chain.names)
    return [
        (first + 2 * k, " + ".join(f"{factor(c)}step[{j}]" for j, c in d.turns.items()))
        for k, d in enumerate(chains.chain.directions)
        if d.turns
    ]


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]
