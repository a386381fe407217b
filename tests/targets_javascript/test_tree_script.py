"""Lines of reduced.c in JavaScript, at samples of a run: what the absolute formulation has there."""

from __future__ import annotations

import json
import subprocess
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.pipeline import derive
from gudgeon.generator.targets.javascript.module import equations_script
from gudgeon.generator.targets.latex.trace import trace
from gudgeon.loading.find import find_mechanism
from tests.programs import needs_compiler
from tests.targets_latex.test_trace import statements
from tests.web.node import node

pytestmark = [needs_compiler, pytest.mark.skipif(node() is None, reason="Node is not installed")]
LIVE = resources.files("gudgeon.generator.targets.latex").joinpath("live.js")
ASKED = """
const live = require(process.argv[2]);
live.take((() => {%s return gudgeonEquations;})());
console.log(JSON.stringify(%s.map(({memory, a, ...state}) => {
    const series = (name) => [a[name] ?? NaN];
    live.announce({...state, run: {memory: Float64Array.from(memory), t: [0], series}, k: 0});
    return Object.fromEntries(%s.map((name) => [name, live.value(`tmp.${name}`)]));
})));
"""
FUNCTIONS = (
    "reduce_state", "reduce_accelerations", "expand", "closures", "closure_rates", "reduced_dynamics",
    "reduced_project",
)  # fmt: skip
CASES = [("nine_bar_press", "dry", 0.02), ("nine_bar_press", "lubricated", 0.2), ("four_bar", None, 0.5)]


@pytest.mark.parametrize(("mechanism", "scene", "t_end"), CASES)
def test_the_tree_s_lines_at_samples_of_a_run(
    mechanism: str, scene: str | None, t_end: float, tmp_path: Path
) -> None:  # fmt: skip
    """Coordinates there and back, closed loops, accelerations, the power of what has play; every line has a value."""
    simulation, file, program = gudgeon.load(mechanism, scene), find_mechanism(mechanism), node()
    found = trace(derive(file.read_bytes(), str(file), simulation.source.scene))
    run = simulation.simulate(t_end, output=40)
    names = sorted(set(found.values["reduced.c"].values()))
    there = simulation.compiled.evaluate(run.t, run.q, run.v, run.memory, run.p)
    of = [f"{body.name}.{what}" for body in found.model.bodies for what in ("ax", "ay", "alpha")]

    def ask(q: Any) -> list[dict[str, float]]:
        """What a page says of the lines at the samples, bodies being at q."""
        samples = zip(*(x.tolist() for x in (run.t, q, run.v, run.memory, there.a)), strict=True)
        states = [
            {"t": t, "q": at, "v": v, "p": run.p.tolist(), "memory": memory, "a": dict(zip(of, a, strict=True))}
            for t, at, v, memory, a in samples
        ]
        told = json.dumps(states).replace("null", "NaN")
        script = ASKED % (equations_script(found.program), told, json.dumps(names))
        (tmp_path / "ask.js").write_text(script, encoding="utf-8")
        line = [str(program), str(tmp_path / "ask.js"), str(LIVE)]
        done = subprocess.run(line, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        return list(json.loads(done.stdout))

    told = ask(run.q)
    assert all(isinstance(x, float | int) for row in told for x in row.values())
    for function in FUNCTIONS:
        for lines, target, _ in statements(found, "reduced.c", function):
            assert lines[-1] in found.values["reduced.c"] or target == "pivot", (function, target)

    def array(of: str, count: int, rows: list[dict[str, float]] = told) -> Any:
        return np.array([[row[f"tree.{of}[{k}]"] for k in range(count)] for row in rows])

    tree, model = found.program.tree, found.model
    assert tree
    n = len(model.q)
    np.testing.assert_allclose(array("expand.all_q", n), run.q, atol=1e-9)
    np.testing.assert_allclose(array("expand.all_v", n), run.v, atol=1e-9 * np.abs(run.v).max())
    np.testing.assert_allclose(array("closures.out", len(tree.system.rows)), 0.0, atol=1e-9)
    np.testing.assert_allclose(array("closure_rates.out", len(tree.system.rows)), 0.0, atol=1e-9 * np.abs(run.v).max())
    angles = {body.name: body.index + 2 for body in model.bodies}
    places = [angles.get(name, -1) for name in tree.system.unknowns]
    assert max(places) >= 0
    a, wanted = array("reduced_dynamics.a", len(places)), there.a[:, places]
    of_angles = np.array(places) >= 0
    np.testing.assert_allclose(a[:, of_angles], wanted[:, of_angles], rtol=1e-6, atol=1e-8 * np.abs(wanted).max())
    a = array("reduce_accelerations.a", len(places))
    np.testing.assert_allclose(a[:, of_angles], wanted[:, of_angles], rtol=1e-12, atol=1e-12 * np.abs(wanted).max())
    moved = run.q.copy()  # a step of Newton's closes the loops again, to second order
    moved[:, places] += 1e-4 * np.cos(np.arange(len(places)))
    apart = ask(moved)
    moved[:, places] -= array("reduced_project.x", len(places), apart)
    loops = len(tree.system.rows)
    before, after = (np.abs(array("closures.out", loops, rows)) for rows in (apart, ask(moved)))
    assert of_angles.all() and before.max() > 1e-6 and after.max() < 1e-3 * before.max()
    power = array("reduced_dynamics.aside.power", 3)[:, 2]
    np.testing.assert_allclose(power, there.power[:, 2], rtol=1e-6, atol=1e-8 * np.abs(there.power).max())
    if model.clearances and scene == "dry":
        assert (run.state.reshape(len(run.t), -1) > 0).any()
