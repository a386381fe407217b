"""Mutants of emitted C and of the engine: does the audit of the run itself report those that change a result?

    python -m tests.audit_mutants [--count 200] [--seed 1] [--jobs 1] [--show] [--seconds S]

A mutant is one change of one line: a sign, an index, a dropped term, a comparison, a statement left out (its value is
stale). It is compiled with the rest of the scene as it is and runs in a process of its own, once as users run it and
once without the audit. The second run is compared with the unchanged scene at a tolerance of EXACT: a mutant changes a
result if one kind of value (RESULTS) differs by more than CHANGED of its largest value, and by more than LOOSER times
what the unchanged scene at the default tolerance differs. So a mutant of the step control that stays within the
tolerance is no fault.

Printed: how many mutants did not compile, changed nothing (reported or not), crashed or did not end without a report,
changed a result (or crash without the audit) and were reported, and changed a result and were not. Exit status 1 where
less than REQUIRED of those that change a result are reported.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import random
import re
import shutil
import subprocess
import tempfile
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from gudgeon.loading import compiler
from gudgeon.loading.engine import ENGINE
from gudgeon.loading.library import open_library
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.reference import check_reference_values
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation

FLAGS = ("-O1", "-std=c11", "-fPIC", "-ffp-contract=off", "-fno-math-errno", "-I.")
RESULTS = ("multipliers", "reactions", "torques", "energy", "power", "clearance")  # and q, v, a and peaks
EXACT = 1e-12  # tolerance of what mutants are compared with
CHANGED = 1e-6  # of the largest value of a kind
LOOSER = 10.0
ROUNDING = 1e-12  # a largest value that is none
REQUIRED = 0.95
SECONDS = 60.0  # of one mutant's runs
SAMPLES = 50
CRASHED = "crashed or endless"
SCENES = (
    ("slider_crank_spring", "ideal", 1.0),
    ("pendulum", "ideal", 3.0),
    ("andrews_squeezer", "ideal", 0.02),
    ("nine_bar_press", "lubricated", 0.05),
    ("slider_crank", "dry", 0.02),
)
ENGINE_FILES = (
    "scalar_simd/dop853.h",
    "scalar_simd/motion.h",
    "scalar_simd/project.h",
    "scalar_simd/error_weights.h",
    "scalar_simd/rodas5p.h",
    "motion/tree.c",
    "methods/step.c",
    "methods/adaptive.c",
    "run/run.c",
    "run/changes.c",
    "run/contacts.c",
    "watch/roots.c",
    "watch/zeros.h",
    "watch/gaps.c",
)
SCENE_FILES = ("dynamics.c", "reduced.c", "constraints.c", "parameters.c", "clearance.c")


def mutant(simulation: Simulation, folder: Path, *edits: tuple[str, str, str], loops: Path | None = None) -> Simulation:
    """The scene with texts replaced, (file of the scene, or engine/file; old; new) each, compiled in `folder`.

    `loops`: the object file of the time loops, where no file of the engine changes. AssertionError where a text is not
    found; subprocess.CalledProcessError where the result does not compile.
    """
    shutil.copytree(ENGINE, folder / "engine", dirs_exist_ok=True)
    for name, text in simulation.source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    for name, old, new in edits:
        text = (folder / name).read_text(encoding="utf-8")
        assert old in text, f"{name} has no {old!r}"
        (folder / name).write_text(text.replace(old, new, 1), encoding="utf-8")
    engine_changes = any(name.startswith("engine/") for name, _, _ in edits)
    cc, own = [*compiler.find_compiler(), *FLAGS], loops if loops and not engine_changes else None
    units = [("engine/engine.c", "engine.o")] * (not own) + [(simulation.source.main, "scene.o")]
    lines = [[*cc, "-c", text, "-o", unit] for text, unit in units]
    lines += [[*cc, "-shared", str(own or "engine.o"), "scene.o", "-lm", "-o", "mutant.so"]]
    for line in lines:
        subprocess.run(line, cwd=folder, check=True, capture_output=True, timeout=300)
    compiled = CompiledModel(simulation.source, open_library(folder / "mutant.so"))
    return Simulation(compiled, simulation.file)


def is_reported(simulation: Simulation, t_end: float, **settings: Any) -> tuple[str, np.ndarray | None]:
    """What the library's check, or the audit of a run, says ("": nothing), and positions at the samples reached."""
    try:
        check_reference_values(simulation.compiled)
        run = simulation.simulate(t_end, output=SAMPLES, **settings)
    except gudgeon.GudgeonError as error:
        return str(error).splitlines()[0], None
    message = [note for note in run.diagnostics.notes if note.startswith("audit:")]
    return "; ".join(message), run.q


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


def results(run: Result) -> dict[str, np.ndarray]:
    """Each kind of value that a run reports, as an array: lengths and angles apart."""
    evaluation, angle = run.evaluation, np.arange(run.q.shape[1]) % 3 == 2
    found = {name: np.asarray(getattr(evaluation, name), dtype=float) for name in RESULTS}
    for name, values in (("q", run.q), ("v", run.v), ("a", evaluation.a)):
        found |= {f"{name} lengths": values[:, ~angle], f"{name} angles": values[:, angle]}
    found["peaks"] = np.array([[peak.F for peak in run.diagnostics.peaks]])
    return found


def differences(run: dict[str, np.ndarray], right: dict[str, np.ndarray]) -> dict[str, float]:
    """Largest difference of each kind of value, of its largest value; where that is rounding, of 1."""
    off = {}
    for name, expected in right.items():
        found = run[name]
        if found.shape != expected.shape:
            return {name: math.inf}
        known = np.isfinite(expected)
        scale = np.abs(expected[known]).max(initial=0.0)
        worst = np.nan_to_num(np.abs(found - expected)[known], nan=math.inf).max(initial=0.0)
        off[name] = float(worst / (scale if scale > ROUNDING else 1.0))
    return off


class Scene:
    """A scene of SCENES with what mutants are compared with, and the object file of its time loops."""

    def __init__(self, name: str, scene: str, t_end: float, folder: Path) -> None:
        self.name, self.t_end, self.folder = f"{name}/{scene}", t_end, folder
        self.simulation = gudgeon.load(name, scene, quick=False)
        self.right = results(self.simulation.simulate(t_end, output=SAMPLES, rtol=EXACT))
        run = self.simulation.simulate(t_end, output=SAMPLES)
        self.limit = {name: max(CHANGED, LOOSER * off) for name, off in differences(results(run), self.right).items()}
        folder.mkdir()
        mutant(self.simulation, folder)

    def outcome(self, file: str, edit: tuple[str, str], say: Callable[[tuple[str, str]], None]) -> None:
        """Say what becomes of a mutant, and in how far it differs or how it is reported.

        A report is said at once: what is reported before a result exists may crash, or never end, without the audit.
        """
        with tempfile.TemporaryDirectory() as folder:
            try:
                other = mutant(self.simulation, Path(folder), (file, *edit), loops=self.folder / "engine.o")
            except (AssertionError, subprocess.SubprocessError):
                return say(("does not compile", ""))
            message = is_reported(other, self.t_end)[0]
            if message:
                say(("reported", message))
            try:
                off = differences(results(other.simulate(self.t_end, output=SAMPLES, audit=False)), self.right)
            except gudgeon.GudgeonError:
                off = {"no result": math.inf}
        say(self._judged(off, message))

    def _judged(self, off: dict[str, float], message: str) -> tuple[str, str]:
        """The outcome of a mutant whose results differ so much, and which the audit reports so."""
        worst = max(off, key=lambda name: off[name] / self.limit.get(name, CHANGED))
        changes = not off[worst] <= self.limit.get(worst, CHANGED)
        if not changes:
            return ("changes nothing, reported" if message else "changes nothing"), message
        return ("reported", message) if message else ("not reported", f"{worst} {off[worst]:.3g}")


def _draws(scenes: list[Scene], seed: int) -> Iterator[tuple[Scene, str, tuple[str, str]]]:
    """Scenes, files and changes, without end."""
    rng = random.Random(seed)
    while True:
        scene, of_scene = rng.choice(scenes), rng.random() < 0.6
        texts = scene.simulation.source.files
        file = rng.choice([x for x in SCENE_FILES if x in texts] if of_scene else [f"engine/{x}" for x in ENGINE_FILES])
        edit = mutations(texts[file] if of_scene else (ENGINE.parent / file).read_text(encoding="utf-8"), rng)
        if edit:
            yield scene, file, edit


def _begin(scene: Scene, file: str, edit: tuple[str, str]) -> tuple[Any, Any]:
    """A process that finds the outcome, and the connection that it comes by."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=lambda: scene.outcome(file, edit, theirs.send))
    process.start()
    theirs.close()
    return process, ours


def _outcome(process: Any, connection: Any) -> tuple[str, str]:
    """What a process says last; it is ended after SECONDS."""
    found, end = (CRASHED, ""), time.monotonic() + SECONDS
    try:
        while connection.poll(max(end - time.monotonic(), 0.0)):
            found = connection.recv()
    except EOFError:
        pass
    finally:
        process.kill()
        process.join()
    return found


def run(count: int, seed: int, jobs: int, show: bool, seconds: float = math.inf) -> Counter[str]:
    """Outcomes of so many mutants, or of those that so many seconds allow."""
    outcomes, under_way = Counter[str](), deque[Any]()
    with tempfile.TemporaryDirectory() as folder:
        scenes = [Scene(*given, Path(folder) / given[0]) for given in SCENES]
        draws, begun_at = _draws(scenes, seed), time.monotonic()
        ended = ("reported", "not reported", CRASHED)
        while time.monotonic() - begun_at < seconds and sum(outcomes[x] for x in ended) < count:
            while len(under_way) < jobs:
                draw = next(draws)
                under_way.append((draw, _begin(*draw)))
            (scene, file, edit), begun = under_way.popleft()
            outcome, message = _outcome(*begun)
            outcomes[outcome] += 1
            if show or outcome == "not reported":
                change = f"{edit[0].strip()}  ->  {edit[1].strip()}"
                print(f"{outcome}: {scene.name} {file}: {change}  {message}", flush=True)
        for _, begun in under_way:
            begun[0].kill()
    return outcomes


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--seconds", type=float, default=math.inf)
    requested = parser.parse_args()
    outcomes = run(requested.count, requested.seed, requested.jobs, requested.show, requested.seconds)
    print(", ".join(f"{outcome}: {number}" for outcome, number in sorted(outcomes.items())))
    reported, missed = outcomes["reported"], outcomes["not reported"]
    print(f"reported of those that change a result: {reported / max(reported + missed, 1):.3f}")
    return int(reported < REQUIRED * (reported + missed))


if __name__ == "__main__":
    raise SystemExit(main())
