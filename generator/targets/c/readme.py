"""README.md of a scene's folder: which file to read first, and what each holds."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sized

from gudgeon.generator.kernels.program import Program

NAME = "README.md"
# In the order in which they are to be read.
_EQUATIONS = {
    "model.h": "sizes, `Parameters` (every number, with its unit and its address in the YAML), and the structs that "
               "functions pass to each other",
    "parameters.c": "`prepare`: defaults of all numbers, and what follows from them",
    "constraints.c": "Φ, Φ_q, ν, γ and M of the closed linkage; where the start is; joint forces and other outputs",
    "clearance.c": "joints with play: each law once, as a function of its numbers, then each joint's force",
    "dynamics.c": "accelerations and multipliers in all coordinates, [M Φ_qᵀ; Φ_q 0][a; λ] = [g; γ − …], as they are "
                  "taught; written out for this linkage",
    "reduced.c": "the same motion in few coordinates: there and back, and the accelerations that are integrated",
    "motion.c": "what is integrated, by one name for all methods",
}  # fmt: skip
_NUMERICS = {
    "newton.c": "derivatives of the equations of motion, and Newton's matrix solved, for `rodas5p`",
    "projection.c": "a step of Newton's method onto the constraints",
    "singular.c": "rows of constraints that depend on each other where a pivot vanishes",
    "start.c": "the linkage closed at the start: positions and velocities",
    "system.c": "the functions that are called from outside, in all coordinates",
    "trigonometry.c": "cosines and sines, four angles at a time",
    "kinematic.c": "no freedom is left: positions at given times, by Newton's method",
    "kinematic_events.c": "events of a motion that is prescribed",
    "run.c": "a run: its state, how it begins, what it reports",
    "step.c": "what the steps of all methods share",
    "rk4.c": "the classical method of Runge and Kutta with fixed steps",
    "dop853.c": "Dormand and Prince's explicit method of order 8",
    "rodas5p.c": "a Rosenbrock method of order 5, for stiff motion",
    "adaptive.c": "how `dop853` and `rodas5p` choose their steps",
    "events.c": "where contacts begin and end, corners are crossed, a watched expression is zero",
    "changes.c": "what happens there",
    "roots.c": "a zero along a step",
    "peaks.c": "the largest forces of joints with play",
    "jumps.c": "jumps of drives, which a step of `rk4` must not pass over",
    "ranges.c": "arithmetic with ranges: what a value can be over a whole step",
    "time_terms.c": "terms of time alone that may hide within a step",
    "pulses.c": "pulses that a step has not seen",
    "watched.c": "corners and events that are looked for along a step",
    "asked.c": "a long computation asks now and then whether it is still wanted",
    "batch.h": "a batch of runs",
    "many.c": "many runs in one call",
    "lanes.h": "vectors of two, four or eight runs",
    "lanes.c": "the same functions for runs side by side in such vectors; to the same bits",
    "scene.c": "all files together: this one is compiled",
    "kernel.json": "names of everything for the Python runtime: coordinates, addresses, results",
}


def readme(program: Program, files: Mapping[str, str], others: Collection[str] = ("kernel.json",)) -> str:
    """Markdown over a scene's files; of one that is new here its own first comment."""
    mechanism, scene = program.model.scene.mechanism, program.model.scene
    names = [*files, *others]
    equations = [name for name in _EQUATIONS if name in names]
    rest = [name for name in _NUMERICS if name in names]
    rest = [*(name for name in names if name not in (*equations, *rest)), *rest]
    told = _EQUATIONS | _NUMERICS
    return "\n".join([
        f"# {_plain(mechanism.title or mechanism.name)}: scene {scene.name}", "",
        f"C that gudgeon wrote for the mechanism `{mechanism.name}`. {_sizes(program)}", "",
        *_first(equations), "", "## The equations, in the order in which they are to be read", "",
        *(f"- `{name}`: {told[name]}" for name in equations), "", "## How they are solved", "",
        *(f"- `{name}`: {told.get(name) or _comment(files.get(name, ''))}" for name in rest), "",
        *_calls(program, names),
    ])  # fmt: skip


def _sizes(program: Program) -> str:
    model, system = program.model, program.integrated.system
    left = f"{_count(system.q, 'coordinate')}, {_count(system.rows, 'row')}"
    return (
        f"{_count(model.bodies, 'body', 'bodies')} with {_count(model.q, 'coordinate')}, "
        f"{_count(model.rows, 'row')} of constraints, {_count(model.clearances, 'joint')} with play. "
        f"What is integrated: {left if program.integrates else 'nothing, for drives say all'}."
    )


def _count(some: Sized, one: str, many: str = "") -> str:
    return f"{len(some)} {one if len(some) == 1 else many or one + 's'}"


def _first(equations: list[str]) -> list[str]:
    main = "reduced.c" if "reduced.c" in equations else "dynamics.c"
    return [
        f"Read `model.h` first, for the names, then `dynamics.c`, which is the textbook's{_shorter(main)}.",
        "Units are SI; `q` and `v` are positions and velocities, `p` is the `Parameters` of a run.",
    ]


def _shorter(main: str) -> str:
    return ", and `reduced.c`, which is what runs" if main == "reduced.c" else ""


def _calls(program: Program, names: Collection[str]) -> list[str]:
    """How it is compiled and called."""
    runs = "`gudgeon_run_start`, then `gudgeon_rk4_run` or `gudgeon_adaptive_run`" if program.integrates else (
        "`gudgeon_course_begin`, then `gudgeon_kinematic`"
    )  # fmt: skip
    lanes = ["`lanes.c` is compiled beside it for each width of vectors."] * ("lanes.c" in names)
    return [
        "## How it is called", "",
        "`scene.c` includes the others: `cc -O1 -std=c11 -ffp-contract=off -fPIC -shared scene.c -lm -o scene.so`.",
        *lanes,
        "`gudgeon_prepare` fills the parameters, `gudgeon_start` closes the linkage, `gudgeon_rhs` is the right-hand "
        f"side; a run is {runs}. From Python all of it is `gudgeon.load(…).simulate(…)`.", "",
    ]  # fmt: skip


def _plain(text: str) -> str:
    """One line that cannot be more than text."""
    return re.sub(r"[\\`*_<>\[\]#|]", r"\\\g<0>", " ".join(text.split()))


def _comment(text: str) -> str:
    """The first sentence of a file's first comment."""
    found = re.search(r"/\*(.*?)(\*/|[.:;]\s)", text, re.S)
    return " ".join(found[1].replace("\n *", " ").split()) if found else "more of it"
