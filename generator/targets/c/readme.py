"""Writes README.md of a scene's folder: the order in which to read the files, and what each contains."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sized

from gudgeon.generator.kernels.program import Program

NAME = "README.md"
# In the order of reading.
_EQUATION_FILES = {
    "model.h": "sizes, `Parameters` (every parameter, with its unit and its address in the YAML), and small tables",
    "parameters.c": "`prepare`: defaults of all parameters, and derived parameters",
    "constraints.c": "Φ, Φ_q, ν, γ and M of the closed linkage; values of the start; joint forces and other outputs",
    "clearance.c": "joints with play: each law once, as a function of its parameters, then the force of each joint",
    "dynamics.c": "accelerations and multipliers in all coordinates, [M Φ_qᵀ; Φ_q 0][a; λ] = [g; γ − …], "
    "written out for this linkage",
    "reduced.c": "the same motion in tree coordinates: conversion in both directions, and the accelerations "
    "that are integrated",
}
_METHOD_FILES = {
    "newton.c": "derivatives of the equations of motion, the solution with Newton's matrix (for stiff methods), and a "
    "projection step onto the constraints",
    "newton_complex.c": "the same matrix at complex steps (for `radau5` and `radau9`)",
    "positions.c": "no degree of freedom: a step of Newton's method for the positions at a time, then velocities and "
    "accelerations",
    "curves.c": "the file's curves: knots and coefficients of their pieces",
    "taylor.c": "the motion's Taylor series, at order 0 and at every higher order (for `taylor`)",
    "watched.c": "bounds of monitored functions over ranges of time and state, so that a step misses no event",
    "lanes.c": "the same functions for several runs in vector lanes, with the same bits",
    "scene.c": "all files together, with the functions that the engine adds: this file is compiled",
    "kernel.json": "names of everything for the Python runtime: coordinates, addresses, results",
}
# Other purposes in scenes without degrees of freedom, which are not integrated.
_KINEMATIC_PURPOSES = {
    "reduced.c": "the same motion in tree coordinates: conversion in both directions; forces, and powers that "
    "are integrated to works",
}
READABLE = (*_EQUATION_FILES, "positions.c")  # stored as files in generated/; the others are in its archive
_ENGINE = (
    "Time loops, methods, contacts, events and batches are the same for all scenes: plain C in the folder `engine`. "
    "`engine/README.md` describes the order of reading. The engine uses the sizes in `model.h`."
)
_COMPILED = (
    "`ROOT=..` fits a folder that `gudgeon emit` wrote. Otherwise `ROOT` is gudgeon's folder, which contains `engine`:"
)


def print_readme(program: Program, files: Mapping[str, str], other_files: Collection[str] = ("kernel.json",)) -> str:
    """Return the Markdown text of README.md: the order in which to read a scene's files, and what each contains.

    files: text of each file by its name. other_files: names of other files in the folder. A file that
    `list_file_purposes` does not have is described by its first comment.
    """
    mechanism, scene = program.model.scene.mechanism, program.model.scene
    names = [*files, *other_files]
    equations = [name for name in _EQUATION_FILES if name in names]
    numerics = [name for name in _METHOD_FILES if name in names]
    numerics = [*(name for name in names if name not in (*equations, *numerics)), *numerics]
    purpose_by_file = list_file_purposes(program)
    return "\n".join(
        [
            f"# {_escape_markdown(mechanism.title or mechanism.name)}: scene {scene.name}",
            "",
            f"C that gudgeon wrote for the mechanism `{mechanism.name}`. {_describe_sizes(program)}",
            "",
            *_describe_reading_order(program, names),
            "",
            "## The equations, in the order of reading",
            "",
            *(f"- `{name}`: {purpose_by_file[name]}" for name in equations),
            "",
            "## The solution of the equations",
            "",
            *(
                f"- `{name}`: {purpose_by_file.get(name) or _extract_first_sentence(files.get(name, ''))}"
                for name in numerics
            ),
            "",
            *_describe_calls(program, names),
        ]
    )


def list_file_purposes(program: Program) -> dict[str, str]:
    """Return {file: purpose} of all files that a scene may have, in the order in which they are to be read."""
    return _EQUATION_FILES | _METHOD_FILES | ({} if program.integrates else _KINEMATIC_PURPOSES)


def _describe_sizes(program: Program) -> str:
    """Return two sentences about the sizes of the scene and of the integrated system.

    The first has the numbers of bodies, coordinates, constraint equations and joints with play. The second has those of
    the integrated coordinates and equations, or "nothing" if drives determine the motion.
    """
    model, system = program.model, program.integrated.system
    joints_with_play = {clearance.joint.name for clearance in model.clearances}
    integrated = f"{_format_count(system.q, 'coordinate')}, {_format_count(system.rows, 'constraint equation')}"
    return (
        f"{_format_count(model.bodies, 'body', 'bodies')} with {_format_count(model.q, 'coordinate')}, "
        f"{_format_count(model.rows, 'constraint equation')}, {_format_count(joints_with_play, 'joint')} with play. "
        f"Integrated: {integrated if program.integrates else 'nothing, because drives determine the motion'}."
    )


def _format_count(items: Sized, singular: str, plural: str = "") -> str:
    """Return the number of items with its noun, such as "1 body" or "2 bodies".

    plural: "" for the singular with "s".
    """
    return f"{len(items)} {singular if len(items) == 1 else plural or singular + 's'}"


def _describe_reading_order(program: Program, file_names: Collection[str]) -> list[str]:
    """Return the two lines of README.md that say which files to read first and what q, v and p are.

    file_names: the files of the scene, of which positions.c or else reduced.c is mentioned if present.
    """
    integrated_file = next((name for name in ("positions.c", "reduced.c") if name in file_names), "")
    continuation = f", and `{integrated_file}`, which a run evaluates" if integrated_file else ""
    return [
        f"Read `model.h` first, for the names, then `dynamics.c`, the equations of a textbook{continuation}.",
        "Units are SI; `q` and `v` are positions and velocities, `p` is the `Parameters` of a run.",
    ]


def _describe_calls(program: Program, file_names: Collection[str]) -> list[str]:
    """Return the lines of README.md that say how the scene is compiled, and which C functions start and run it.

    The functions differ for scenes that are integrated and kinematically driven ones.
    """
    run_functions = (
        "`gudgeon_run_start`, `gudgeon_adaptive_setup`, then `gudgeon_adaptive_run`"
        if program.integrates
        else ("`gudgeon_kinematic_begin`, then `gudgeon_kinematic`")
    )
    lanes_note = ["`lanes.c` is a separate library, compiled in the same way without the engine."] * (
        "lanes.c" in file_names
    )
    return [
        "## Calls from outside",
        "",
        _ENGINE,
        "",
        _COMPILED,
        "",
        "```",
        "cc -O1 -march=native -std=c11 -ffp-contract=off -fPIC -shared "
        "-I. -I$ROOT scene.c $ROOT/engine/engine.c -lm -o scene.so",
        "```",
        "",
        *lanes_note,
        "`engine/scene/calls.h` declares the functions for calls from outside: `gudgeon_prepare` fills the parameters, "
        f"`gudgeon_start` closes the linkage, `gudgeon_rhs` is the right-hand side; a run is {run_functions}. "
        "From Python, `gudgeon.load(…).simulate(…)` calls all of them.",
        "",
    ]


def _escape_markdown(text: str) -> str:
    """Return a text as one line with the special characters of Markdown escaped."""
    return re.sub(r"[\\`*_<>\[\]#|]", r"\\\g<0>", " ".join(text.split()))


def _extract_first_sentence(text: str) -> str:
    """Return the first sentence of the first block comment of a C file; "further functions" if there is none."""
    _, _, comment = text.partition("/*")
    lines = [line.strip().removeprefix("*").strip() for line in comment.partition("*/")[0].splitlines()]
    return " ".join(filter(None, lines)).partition(". ")[0] or "further functions"
