"""The numbers of engine/boundary.h are declared once: where any of them is another, the same runs come out."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from tests.programs import needs_compiler
from tests.quick import TCC_OR_CC

ROOT = Path(__file__).resolve().parents[2]

# The files of three scenes: many contacts and events in rk4; contact, friction and an event in a method that chooses
# its step; a kinematic one with more events than a list holds. What two programs print is equal bit for bit.
CHANGES = {
    "bouncing_ball": (
        "name: bouncing_ball",
        "name: ball\nevents: {half: {zero: ball.y + height - 0.5 mm, action: record}}",
    ),
    "slider_crank": (
        "name: slider_crank",
        "name: crank\nevents: {dead: {zero: slider.vx, action: record}}\nforces: {rub: {dry_friction: [ground.O, "
        "slider.origin], direction: [1, 0], static: 3 N, kinetic: 2 N}}",
    ),
    "four_bar": ("name: four_bar", "name: bar\nevents: {often: {zero: sin(400*crank.theta), action: record}}"),
}
RUNS = r"""
import sys
import warnings
from hashlib import sha256
import numpy as np
import gudgeon

def show(name, *arrays):
    print(name, sha256(b"".join(np.ascontiguousarray(x).tobytes() for x in arrays)).hexdigest()[:16])

def show_run(name, run):
    show(name, run.t, run.q, run.v, run.a, run.state, run.memory, run.events, *run.work.T[:3])
    show("series", *(run[each] for each in run.names))
    for part in run.impacts.dtype.names:
        show(part, run.impacts[part])
    print(run.diagnostics.steps, run.diagnostics.peaks, run.diagnostics.audit, run.diagnostics.notes)
    if run.trace:
        show("trace", run.trace.t, run.trace.joints)

warnings.simplefilter("ignore")
ball, crank, bar = sys.argv[1:]
simulation = gudgeon.load(ball, scene="elastic")
options = {"method": "rk4", "step": 2e-5, "output": 5}
run = simulation.simulate(9.5, parameters={"height": 1e-3}, **options)
assert len(run.impacts) > 300 and len(run.events) > 600
show_run("ball", run)
batch = simulation.simulate_many({"height": [1e-3, 1.2e-3]}, 9.5, **options)
show("batch", batch.q, *(batch.impacts[k][part] for k in (0, 1) for part in ("joint", "t_on", "F_peak")))
print(batch.failures)
simulation = gudgeon.load(crank, scene="dry")
show_run("crank", simulation.simulate(0.02, output=9))
batch = simulation.simulate_many({"c": [3e-4, 4e-4]}, 0.02, output=9)
show("batch", batch.q, batch.peaks["F"], batch.peaks["e_max"])
print(batch.failures, simulation.simulate(0.02).diagnostics.peaks)
run = gudgeon.load(bar, scene="ideal").simulate(2.0, output=9)
assert len(run.events) > 300
show_run("bar", run)
"""


def changed(text: str, listed: int) -> str:
    """The header with lists of another length, one column more in each array, other statuses and value references.

    Works, energies and reactions keep their number: the emitted C computes exactly these.
    """
    text = re.sub(r"MAX_LISTED = \d+", f"MAX_LISTED = {listed}", text)
    text = re.sub(r"= -(\d+)\b", lambda match: f"= -{100 + int(match[1])}", text)
    return re.sub(r"\b(?!N_WORK|N_ENERGY|N_REACTION)(N_\w+)\s*\};", r"SPARE_OF_\1, \1 };", text)


def compose(folder: Path, listed: int | None) -> None:
    """The package `gudgeon` as a checkout has it, with that header and what tools/declared.py makes of it."""
    unused = shutil.ignore_patterns("__pycache__", "generated")
    shutil.copytree(ROOT / "src" / "gudgeon", folder / "gudgeon", ignore=unused)
    shutil.copytree(ROOT / "tools", folder / "tools", ignore=unused)
    (folder / "runtime").symlink_to("gudgeon")
    (folder / "engine").symlink_to("gudgeon/engine")
    if listed is not None:
        header = folder / "engine" / "boundary.h"
        header.write_text(changed(header.read_text(encoding="utf-8"), listed), encoding="utf-8")
        checks = folder / "runtime" / "contract" / "audit.py"
        text = checks.read_text(encoding="utf-8")
        checks.write_text(text.replace("CHECKS = {", "CHECKS = {'OF_N_CHECKS': ('nothing',),", 1), encoding="utf-8")
        python(folder, str(folder / "tools" / "declared.py"))


def python(folder: Path, *arguments: str) -> str:
    """What a program prints with the package of that folder."""
    own = {"PYTHONPATH": str(folder), "GUDGEON_CACHE": str(folder / "cache"), "CC": f"{TCC_OR_CC} cc"}
    environment = os.environ | own
    done = subprocess.run([sys.executable, *arguments], env=environment, capture_output=True, text=True, cwd=folder)
    assert not done.returncode, done.stderr
    return done.stdout


@needs_compiler
def test_each_number_of_the_boundary_is_declared_once(tmp_path: Path) -> None:
    files = []
    for name, (old, new) in CHANGES.items():
        text = (ROOT / "mechanisms" / f"{name}.yaml").read_text(encoding="utf-8")
        assert old in text
        files.append(tmp_path / f"{name}_changed.yaml")
        files[-1].write_text(text.replace(old, new, 1), encoding="utf-8")
    printed = []
    for listed in (None, 16, 4096):
        folder = tmp_path / f"lists_of_{listed}"
        folder.mkdir()
        compose(folder, listed)
        printed.append(python(folder, "-c", RUNS, *map(str, files)))
    assert printed[1] == printed[0] and printed[2] == printed[0]
