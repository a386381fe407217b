"""Mutants of emitted C and of the engine: does the audit of the run itself report those that change a result?

    python -m tests.audit_mutants [--count 200] [--seed 1] [--show]

A mutant is one change of one line: a sign, an index, a dropped term, a comparison, a statement left out (its value is
stale). It is compiled with the rest of the scene as it is, runs in a process of its own, and its samples are compared
with those of the unchanged scene. Printed: how many did not compile, changed nothing (by less than CHANGED), crashed or
did not end, were reported, and were not. Exit status 1 where less than REQUIRED of those that change a result are
reported.
"""

from __future__ import annotations

import argparse
import multiprocessing
import random
import re
import shutil
import subprocess
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from gudgeon.loading import compiler
from gudgeon.loading.engine import ENGINE
from gudgeon.loading.library import opened
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.reference import check_reference
from gudgeon.simulation.simulation import Simulation

FLAGS = ("-O1", "-std=c11", "-fPIC", "-ffp-contract=off", "-fno-math-errno", "-shared", "-I.")
CHANGED = 1e-6  # of the largest value of a kind of coordinate
REQUIRED = 0.95
SECONDS = 60.0  # of one mutant's run
SCENES = (
    ("slider_crank_spring", "ideal", 1.0), ("pendulum", "ideal", 3.0), ("andrews_squeezer", "ideal", 0.02),
    ("nine_bar_press", "lubricated", 0.05), ("slider_crank", "dry", 0.02),
)  # fmt: skip
ENGINE_FILES = ("both/dop853.h", "both/motion.h", "both/project.h", "both/weigh.h", "both/rodas5p.h", "motion/tree.c",
                "methods/step.c", "methods/adaptive.c", "run/run.c", "run/changes.c", "run/latches.c",
                "watch/roots.c", "watch/gaps.c")  # fmt: skip
SCENE_FILES = ("dynamics.c", "reduced.c", "constraints.c", "parameters.c", "clearance.c")


def mutant(simulation: Simulation, folder: Path, *edits: tuple[str, str, str]) -> Simulation:
    """The scene with texts replaced, (file of the scene, or engine/file; old; new) each, compiled in `folder`.

    AssertionError where a text is not found; subprocess.CalledProcessError where the result does not compile.
    """
    shutil.copytree(ENGINE, folder / "engine", dirs_exist_ok=True)
    for name, text in simulation.source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    for name, old, new in edits:
        text = (folder / name).read_text(encoding="utf-8")
        assert old in text, f"{name} has no {old!r}"
        (folder / name).write_text(text.replace(old, new, 1), encoding="utf-8")
    line = [*compiler.find_compiler(), *FLAGS, "engine/engine.c", simulation.source.main, "-lm", "-o", "mutant.so"]
    subprocess.run(line, cwd=folder, check=True, capture_output=True, timeout=300)
    compiled = CompiledModel(simulation.source, opened(folder / "mutant.so"))
    return Simulation(compiled, simulation.file)


def is_reported(simulation: Simulation, t_end: float, **settings: Any) -> tuple[str, np.ndarray | None]:
    """What the library's check, or the audit of a run, says ("": nothing), and positions at the samples reached."""
    try:
        check_reference(simulation.compiled)
        run = simulation.simulate(t_end, output=50, **settings)
    except gudgeon.GudgeonError as error:
        return str(error).splitlines()[0], None
    told = [note for note in run.diagnostics.notes if note.startswith("audit:")]
    return "; ".join(told), run.q


def mutations(text: str, rng: random.Random) -> tuple[str, str] | None:
    """One change of one line of C: old and new text, the old one being unique; None: the draw found none."""
    code = [line for line in text.splitlines() if not line.lstrip().startswith(("*", "/", "#"))]
    lines = [line for line in code if text.count(line) == 1]
    line = rng.choice([x for x in lines if re.search(r"[-+*=\[<>]", x)] or [""])
    kinds = [(r" - ", " + "), (r" \+ ", " - "), (r" \* ", " + "), (r" < ", " > "), (r" > ", " < ")]
    choices = [(m, new) for old, new in kinds for m in re.finditer(old, line)]
    choices += [(m, f"[{int(m[1]) + 1}]") for m in re.finditer(r"\[(\d)\]", line)]
    choices += [(m, "") for m in re.finditer(r" [-+] [\w.\[\]>]+(?=[ ;)])", line)]
    if re.match(r"\s+[\w.\[\]>-]+ [-+*]?= .*;$", line):
        choices.append((re.match(r"\s*(.*)$", line), "/* left out */;"))  # type: ignore[arg-type]
    if not line or not choices:
        return None
    m, new = rng.choice(choices)
    start, end = m.span(1) if m.re.pattern == r"\s*(.*)$" else m.span()
    return line, line[:start] + new + line[end:]


def _try(job: tuple[str, str, float, str, tuple[str, str]], answer: Any) -> None:
    name, scene, t_end, file, edit = job
    simulation = gudgeon.load(name, scene, quick=False)
    _, right = is_reported(simulation, t_end)
    with tempfile.TemporaryDirectory() as folder:
        try:
            other = mutant(simulation, Path(folder), (file, *edit))
        except (AssertionError, subprocess.SubprocessError):
            answer.put(("does not compile", ""))
            return
        told, q = is_reported(other, t_end)
    if told:
        answer.put(("reported", told))
        return
    assert right is not None and q is not None
    same = q.shape == right.shape
    off = max(float(np.abs(q[:, k::3] - right[:, k::3]).max() / np.abs(right[:, k::3]).max()) for k in range(3)) \
        if same and np.abs(right).max() > 0 else float("inf")  # fmt: skip
    answer.put(("changes nothing", "") if off < CHANGED else ("not reported", f"{off:.3g}"))


def run(count: int, seed: int, show: bool) -> Counter[str]:
    """Outcomes of so many mutants."""
    rng, outcomes = random.Random(seed), Counter[str]()
    while sum(outcomes[x] for x in ("reported", "not reported", "crashed or endless")) < count:
        name, scene, t_end = rng.choice(SCENES)
        of_scene = rng.random() < 0.6
        texts = gudgeon.load(name, scene, quick=False).source.files
        file = rng.choice([x for x in SCENE_FILES if x in texts] if of_scene else [f"engine/{x}" for x in ENGINE_FILES])
        text = texts[file] if of_scene else (ENGINE.parent / file).read_text(encoding="utf-8")
        edit = mutations(text, rng)
        if edit is None:
            continue
        answer = multiprocessing.get_context("spawn").Queue()
        job = (name, scene, t_end, file, edit)
        process = multiprocessing.get_context("spawn").Process(target=_try, args=(job, answer))
        process.start()
        process.join(SECONDS)
        if process.is_alive():
            process.kill()
        outcome, told = answer.get() if not answer.empty() else ("crashed or endless", "")
        outcomes[outcome] += 1
        if show or outcome == "not reported":
            print(f"{outcome}: {name}/{scene} {file}: {edit[0].strip()}  ->  {edit[1].strip()}  {told}", flush=True)
    return outcomes


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--show", action="store_true")
    asked = parser.parse_args()
    outcomes = run(asked.count, asked.seed, asked.show)
    print(", ".join(f"{outcome}: {number}" for outcome, number in sorted(outcomes.items())))
    reported, missed = outcomes["reported"], outcomes["not reported"]
    print(f"reported of those that change a result: {reported / max(reported + missed, 1):.3f}")
    return int(reported < REQUIRED * (reported + missed))


if __name__ == "__main__":
    raise SystemExit(main())
