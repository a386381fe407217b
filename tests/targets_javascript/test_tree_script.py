"""Lines of reduced.c in JavaScript, at samples of a run: what the absolute formulation has there."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.javascript.module import print_equations_script
from gudgeon.generator.targets.latex.trace import HighlightIndex, make_highlight_index
from gudgeon.loading.kernel_sources import find_mechanism
from gudgeon.model.evaluation import Evaluation
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.slow import slow_but
from tests.targets_latex.test_trace import statements
from tests.web.node import needs_node, node

pytestmark = [needs_compiler, needs_node]
LIVE = resources.files("gudgeon.generator.targets.latex").joinpath("current_values.js")
ASKED = """
const live = require(process.argv[2]);
live.setEquations((() => {%s return gudgeonEquations;})());
console.log(JSON.stringify(%s.map(({memory, a, ...state}) => {
    const series = (name) => [a[name] ?? NaN];
    live.setState({...state, run: {memory: Float64Array.from(memory), t: [0], series}, k: 0});
    return Object.fromEntries(%s.map((name) => [name, live.getValue(`tmp.${name}`)]));
})));
"""
FUNCTIONS = (
    "reduce_state",
    "reduce_accelerations",
    "expand",
    "closures",
    "closure_rates",
    "reduced_dynamics",
    "reduced_project",
)
CHAINS = "evaluate_loop_directions", "compute_loop_step", "compute_loop_rates", "compute_third_loop_rates"
METHODS = Path(__file__).parents[1] / "mechanisms/methods"
CASES = [("nine_bar_press", "dry", 0.02), ("four_bar", None, 0.5), ("nine_bar_press", "lubricated", 0.2)]


@dataclass(frozen=True)
class Asked:
    """A run, and what a page says of the lines of reduced.c at its samples."""

    found: HighlightIndex
    run: Result
    folder: Path

    @cached_property
    def there(self) -> Evaluation:
        run = self.run
        assert run.compiled
        return run.compiled.evaluate(run.t, run.q, run.v, run.memory, run.p)

    def at(self, q: Any) -> list[dict[str, float]]:
        """Each line's value by its name, bodies being at q."""
        run, names = self.run, sorted(set(self.found.values["reduced.c"].values()))
        of = [f"{body.name}.{what}" for body in self.found.model.bodies for what in ("ax", "ay", "alpha")]
        samples = zip(*(x.tolist() for x in (run.t, q, run.v, run.memory, self.there.a)), strict=True)
        states = [
            {"t": t, "q": at, "v": v, "p": run.p.tolist(), "memory": memory, "a": dict(zip(of, a, strict=True))}
            for t, at, v, memory, a in samples
        ]
        message = json.dumps(states).replace("null", "NaN")
        script = ASKED % (print_equations_script(self.found.program), message, json.dumps(names))
        (self.folder / "ask.js").write_text(script, encoding="utf-8")
        line = [str(node()), str(self.folder / "ask.js"), str(LIVE)]
        done = subprocess.run(line, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        return list(json.loads(done.stdout))


def requested(mechanism: str, scene: str | None, t_end: float, folder: Path) -> Asked:
    simulation, file = gudgeon.load(mechanism, scene), find_mechanism(mechanism)
    found = make_highlight_index(derive_scene(file.read_bytes(), str(file), simulation.source.scene))
    return Asked(found, simulation.simulate(t_end, output=40), folder)


def array(of: str, places: Iterable[int], rows: list[dict[str, float]]) -> Any:
    """Entries of an array of a function, sample by sample."""
    return np.array([[row[f"tree.{of}[{k}]"] for k in places] for row in rows])


def check_every_line(requested: Asked, functions: Iterable[str], message: list[dict[str, float]]) -> None:
    assert all(isinstance(x, float | int) for row in message for x in row.values())
    for function in functions:
        for lines, target, _ in statements(requested.found, "reduced.c", function):
            assert lines[-1] in requested.found.values["reduced.c"] or target in ("pivot", "max_magnitude"), (
                function,
                target,
            )


@pytest.mark.parametrize("case", slow_but(CASES[:2], CASES))
def test_the_tree_s_lines_at_samples_of_a_run(case: tuple[str, str | None, float], tmp_path: Path) -> None:
    """Coordinates there and back, closed loops, accelerations, the power of what has play; every line has a value."""
    page = requested(*case, tmp_path)
    found, run, there, message = page.found, page.run, page.there, page.at(page.run.q)
    check_every_line(page, FUNCTIONS, message)
    tree, model = found.program.tree, found.model
    assert tree
    n, loops = len(model.q), range(len(tree.system.rows))
    np.testing.assert_allclose(array("expand.all_q", range(n), message), run.q, atol=1e-9)
    np.testing.assert_allclose(array("expand.all_v", range(n), message), run.v, atol=1e-9 * np.abs(run.v).max())
    np.testing.assert_allclose(array("closures.out", loops, message), 0.0, atol=1e-9)
    np.testing.assert_allclose(array("closure_rates.out", loops, message), 0.0, atol=1e-9 * np.abs(run.v).max())
    angles = {body.name: body.index + 2 for body in model.bodies}
    places = [angles.get(name, -1) for name in tree.system.unknowns]
    assert max(places) >= 0
    a, expected = array("reduced_dynamics.a", range(len(places)), message), there.a[:, places]
    of_angles = np.array(places) >= 0
    np.testing.assert_allclose(a[:, of_angles], expected[:, of_angles], rtol=1e-6, atol=1e-8 * np.abs(expected).max())
    a = array("reduce_accelerations.a", range(len(places)), message)
    np.testing.assert_allclose(a[:, of_angles], expected[:, of_angles], rtol=1e-12, atol=1e-12 * np.abs(expected).max())
    moved = run.q.copy()  # a step of Newton's closes the loops again, to second order
    moved[:, places] += 1e-4 * np.cos(np.arange(len(places)))
    apart = page.at(moved)
    moved[:, places] -= array("reduced_project.x", range(len(places)), apart)
    before, after = (np.abs(array("closures.out", loops, rows)) for rows in (apart, page.at(moved)))
    assert of_angles.all() and before.max() > 1e-6 and after.max() < 1e-3 * before.max()
    power = array("reduced_dynamics.rhs.power", [2], message)[:, 0]
    np.testing.assert_allclose(power, there.power[:, 2], rtol=1e-6, atol=1e-8 * np.abs(there.power).max())
    if "dry" in case:
        assert (run.state.reshape(len(run.t), -1) > 0).any()


@pytest.mark.parametrize("mechanism", ["driven_four_bar", "trammel"])
def test_lines_of_driven_chains_at_samples_of_a_run(mechanism: str, tmp_path: Path) -> None:
    """Chains that turn, and one that slides: rates of all three orders, what is free beside them, Chebyshev's step.

    Rates and accelerations are those of the absolute formulation, third rates are differences of the second. The step
    is of order 3: what it leaves of a loop that is opened by 1e-3 is of the order of 1e-9.
    """
    page = requested(str(METHODS / f"{mechanism}.yaml"), None, 0.5, tmp_path)
    tree, run, there, message = page.found.program.tree, page.run, page.there, page.at(page.run.q)
    assert tree and tree.driven_loop_kernels
    check_every_line(page, [one for one in (*FUNCTIONS, *CHAINS) if one != "reduce_accelerations"], message)
    n, names = len(tree.system.unknowns), tree.driven_loop_kernels.loops.names
    of = {
        name: k
        for body in page.found.model.bodies
        for k, name in enumerate((f"{body.name}.x", f"{body.name}.y", body.name), body.index)
    }
    chain, free = [of[name] for name in names], [of[x] for x in tree.system.unknowns if x in of]
    rates, second = range(n, n + len(chain)), range(n + len(chain), n + 2 * len(chain))
    size = np.abs(run.v).max()
    np.testing.assert_allclose(array("expand.all_q", range(run.q.shape[1]), message), run.q, atol=1e-12)
    np.testing.assert_allclose(array("expand.all_v", range(run.q.shape[1]), message), run.v, atol=1e-11 * size)
    np.testing.assert_allclose(array("compute_loop_rates.v", rates, message), run.v[:, chain], atol=1e-11 * size)
    bends = array("compute_loop_rates.v", second, message)
    np.testing.assert_allclose(bends, there.a[:, chain], atol=1e-9 * np.abs(there.a).max())
    at = [k for k, name in enumerate(tree.system.unknowns) if name in of]
    np.testing.assert_allclose(
        array("reduced_dynamics.a", at, message), there.a[:, free], atol=1e-9 * np.abs(there.a).max()
    )
    third = array("compute_third_loop_rates.out", range(len(chain)), message)
    np.testing.assert_allclose(third[2:-2], slopes(run.t, bends), atol=1e-2 * np.abs(third).max())
    np.testing.assert_allclose(array("compute_loop_step.step", range(len(chain)), message), 0.0, atol=1e-12)
    moved = run.q.copy()
    moved[:, chain] += 1e-3 * np.cos(np.arange(len(chain)))
    moved[:, chain] -= array("compute_loop_step.step", range(len(chain)), page.at(moved))
    np.testing.assert_allclose(moved[:, chain], run.q[:, chain], atol=2e-8)
    assert np.abs(third).max() > 1.0


def slopes(t: Any, x: Any) -> Any:
    """Differences of order 4 at evenly spaced times, without the two at both ends."""
    return (x[:-4] - 8.0 * x[1:-3] + 8.0 * x[3:-1] - x[4:]) / (12.0 * (t[1] - t[0]))
