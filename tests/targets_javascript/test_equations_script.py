"""Φ, Φ_q, ν and γ in JavaScript beside the compiled C: to the bit where the operations are the same."""

from __future__ import annotations

import json
import subprocess
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.javascript.module import print_equations_script
from gudgeon.generator.targets.latex.trace import make_highlight_index
from gudgeon.loading.kernel_sources import find_mechanism
from gudgeon.model.evaluation import CLEARANCE_COLUMNS
from tests.equations.models import random_state
from tests.slow import slow_but
from tests.web.node import needs_node, node

LIVE = resources.files("gudgeon.generator.targets.latex").joinpath("current_values.js")
ASKED = """
const live = require(process.argv[2]), equations = (() => {%s return gudgeonEquations;})();
live.setEquations(equations);
const answer = %s.map((state) => {
    live.setState(state);
    const {rowIndices: rows, functions} = equations, all = {};
    for (const [of, name] of [["phi", "constraints"], ["nu", "velocity_rhs"], ["gamma_rows", "acceleration_rhs"]]) {
        const given = {t: state.t, q: state.q, v: state.v,
            p: Object.fromEntries(Object.entries(equations.parameterIndices).map(([name, k]) => [name, state.p[k]]))};
        all[of] = functions[name](...equations.argumentNames[name].map((one) => given[one]))[of];
    }
    const by = (kind) => rows.map((_, k) => live.getValue(`${kind}.${k + 1}`));
    return {all, phi: by("phi"), nu: by("nu"), gamma: by("gamma"),
        phi_q: rows.map((_, k) => state.q.map((_, i) => live.getValue(`phi_q.${k + 1}.${i + 1}`) ?? 0)),
        rhs: equations.rowNames.map((name) => live.getValue(`tmp.rhs.rhs_${name.replaceAll(".", "_")}_`)),
        numbers: state.p.map((_, k) => live.getValue(`tmp.p.${k + 1}`)),
        gap: %s.map((name) => live.getValue(`tmp.law.${name}`))};
});
console.log(JSON.stringify(answer));
"""
PRESS = "nine_bar_press"
KEPT = [(PRESS, "lubricated"), ("slider_crank", "dry"), ("belt_block", "ideal")]


@needs_node
@pytest.mark.parametrize("case", slow_but(KEPT, [*KEPT, (PRESS, "ideal")]), ids="/".join)
def test_values_are_those_of_the_compiled_scene(case: tuple[str, str], tmp_path: Path) -> None:
    """By the names that a page asks for; p is that of a run."""
    program, (mechanism, scene) = node(), case
    assert program
    file = find_mechanism(mechanism)
    found = make_highlight_index(derive_scene(file.read_bytes(), str(file), scene))
    compiled = gudgeon.load(mechanism, scene).compiled
    source = compiled.source
    p = compiled.prepare(np.zeros(len(source.parameters)), np.zeros(len(source.parameters), dtype=bool))
    place = {slot.address: k for k, slot in enumerate(source.parameters)}
    alpha, beta = (float(p[place[f"baumgarte.{name}"]]) for name in ("alpha", "beta"))
    states = [random_state(found.model, seed) for seed in range(4)]
    given = [{"t": t, "q": q.tolist(), "v": v.tolist(), "p": p.tolist()} for t, q, v in states]
    gaps = [f"clearance_{joint.name}_.{of}" for joint in found.model.clearances for of in ("delta", "deltadot")]
    script = ASKED % (print_equations_script(found.program), json.dumps(given), json.dumps(gaps))
    (tmp_path / "ask.js").write_text(script, encoding="utf-8")
    done = subprocess.run([program, str(tmp_path / "ask.js"), str(LIVE)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    answers: list[dict[str, Any]] = json.loads(done.stdout)
    for (t, q, v), got in zip(states, answers, strict=True):
        scale = max(1.0, float(np.abs(q).max()))
        eps = 4.0 * np.finfo(float).eps
        assert np.allclose(got["all"]["phi"], compiled.closed_phi(t, q, p), rtol=eps, atol=eps * scale)
        assert np.allclose(got["phi"], compiled.phi(t, q, p), rtol=eps, atol=eps * scale)
        assert np.array_equal(got["nu"], compiled.nu(t, q, p))
        gamma = compiled.gamma(t, q, v, p)
        assert np.allclose(got["gamma"], gamma, rtol=eps, atol=eps * max(1.0, float(np.abs(gamma).max(initial=0.0))))
        want = compiled.phi_q(t, q, p)
        rate, phi = want @ v - compiled.nu(t, q, p), compiled.phi(t, q, p)
        rhs = gamma - 2.0 * alpha * rate - beta**2 * phi
        assert np.allclose(got["rhs"], rhs, rtol=1e-11, atol=1e-11 * scale * beta**2)
        assert got["numbers"] == p.tolist()
        filled = np.array([[x or 0.0 for x in row] for row in got["phi_q"]]).reshape(want.shape)
        assert np.allclose(filled, want, rtol=eps, atol=eps * scale)
        assert np.array_equal(filled[np.abs(want) == 1.0], want[np.abs(want) == 1.0])
        if gaps:
            free = np.full((1, compiled.n_discrete_states), np.nan)
            columns = compiled.evaluate([t], q[None], v[None], free, p).clearance[0]
            of = {name: columns[:, k] for k, name in enumerate(CLEARANCE_COLUMNS)}
            c = [p[joint.clearance] for joint in source.clearances]
            assert np.allclose(got["gap"][::2], of["e"] - c, rtol=eps, atol=eps * scale)
            assert np.allclose(got["gap"][1::2], of["deltadot"], rtol=10 * eps, atol=10 * eps * float(np.abs(v).max()))
