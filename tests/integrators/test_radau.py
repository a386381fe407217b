"""Radau IIA of orders 5 and 9: its tables, its orders, what it costs in films, and where no step is found."""

from __future__ import annotations

import re
from functools import cache

import mpmath as mp
import numpy as np
import pytest

from gudgeon.errors import SolverError
from gudgeon.loading.engine import ENGINE
from tests.integrators.test_methods import LUBRICATED, observed_order, scene_of
from tests.programs import needs_compiler

pytestmark = [needs_compiler, pytest.mark.plain]
TABLES = {"radau5": 3, "radau9": 5}


@cache
def printed(name: str) -> dict[str, np.ndarray]:
    """A table of engine/scalar_simd/radau.h, member by member."""
    text = (ENGINE / "scalar_simd/radau.h").read_text(encoding="utf-8")
    body = re.search(rf"RadauTable {name.upper()} = \{{(.*?)\}};", text, re.DOTALL)
    assert body
    found = re.findall(r"\.(\w+) = (\{.*?\}(?=,\s*\.|$)|[\d.]+)", body[1].strip(), re.DOTALL)
    return {member: np.array(eval(value.replace("{", "[").replace("}", "]"))) for member, value in found}  # noqa: S307


@cache
def butcher(stages: int) -> tuple[mp.matrix, mp.matrix, mp.matrix]:
    """Nodes, A and b of Radau IIA in 40 digits, by its definition: collocation at the zeros of a derivative.

    E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.5.
    """
    with mp.workdps(40):
        p = [mp.mpf(1)]
        for root in [0] * (stages - 1) + [1] * stages:
            p = [a - root * b for a, b in zip([*p, 0], [0, *p], strict=True)]
        for _ in range(stages - 1):
            p = [c * (len(p) - 1 - k) for k, c in enumerate(p[:-1])]
        nodes = sorted(mp.re(c) for c in mp.polyroots(p, maxsteps=500, extraprec=400))
        powers = mp.matrix([[c**k for c in nodes] for k in range(stages)])
        a = [mp.lu_solve(powers, mp.matrix([c ** (k + 1) / (k + 1) for k in range(stages)])) for c in nodes]
        table = mp.matrix([[row[j] for j in range(stages)] for row in a])
        return mp.matrix(nodes), table, mp.matrix([table[stages - 1, j] for j in range(stages)])


@pytest.mark.parametrize("name", TABLES)
def test_tables_are_those_of_the_method(name: str) -> None:
    """A⁻¹ = T diag(γ, blocks) T⁻¹, the embedded formula's order, the collocation polynomial."""
    s, table = TABLES[name], printed(name)
    with mp.workdps(40):
        nodes, a, b = butcher(s)
        inverse = np.array((a**-1).tolist(), float)
        powers = mp.matrix([[nodes[j] ** k for j in range(s)] for k in range(s)])
        gamma = 1 / mp.mpf(float(table["gamma"]))
        expected = mp.matrix([mp.mpf(1) / (k + 1) - (gamma if k == 0 else 0) for k in range(s)])
        embedded = mp.lu_solve(powers, expected) - b  # ŷ - y = γ h f(y0) + h Σ (b̂ - b) f(Y), of order s
        error = np.array((embedded.T * a**-1).tolist(), float)[0]
    assert table["node"] == pytest.approx(np.array(nodes.tolist(), float).ravel(), abs=1e-16)
    middle = np.zeros((s, s))
    middle[0, 0] = table["gamma"]
    for k, (re_, im) in enumerate(table["pair"]):
        rows = slice(2 * k + 1, 2 * k + 3)
        middle[rows, rows] = [[re_, -im], [im, re_]]
    assert table["to_stages"] @ table["from_stages"] == pytest.approx(np.eye(s), abs=1e-13)
    assert table["to_stages"] @ middle @ table["from_stages"] == pytest.approx(inverse, abs=2e-13 * abs(inverse).max())
    assert table["error"] == pytest.approx(error, rel=1e-13)
    for k in range(s):  # a polynomial through the beginning is met at every share of the step
        z = table["node"] ** (k + 1)
        d, x = table["dense"] @ z, np.linspace(0.0, 1.0, 7)
        basis = [x ** ((j + 2) // 2) * (1.0 - x) ** ((j + 1) // 2) for j in range(s)]
        assert d @ np.array(basis) == pytest.approx(x ** (k + 1), abs=2e-13)


@pytest.mark.parametrize(
    ("name", "scene", "inside", "order", "steps"),
    [
        ("radau5", "swing", False, 5.0, (12, 1200, 14)),
        ("radau5", "swing", True, 5.0, (12, 1200, 14)),
        ("radau9", "car_axis", False, 9.0, (20, 160, 14)),
        pytest.param("radau9", "car_axis", True, 6.0, (40, 800, 14), marks=pytest.mark.slow),
    ],
)
def test_observed_orders(name: str, scene: str, inside: bool, order: float, steps: tuple[int, int, int]) -> None:
    """At the ends of steps the method's; between them velocities err by h⁵, with five stages by h⁶.

    No film is in the scenes: what the methods need is derived when they are asked for.
    """
    assert observed_order(scene, name, 1.0, steps, inside) == pytest.approx(order, abs=0.35)


def test_a_film_costs_a_fraction_of_rodas5p() -> None:
    """The press's journals at 1e-8 of the clearance, beside rodas5p at 1e-12."""
    press = scene_of("nine_bar_press", "lubricated")
    exact = press.simulate(0.4, output=100, method="rodas5p", rtol=1e-12, parameters=LUBRICATED)
    runs = {
        m: press.simulate(0.4, output=100, method=m, rtol=1e-8, parameters=LUBRICATED)
        for m in ("rodas5p", "radau5", "radau9", "auto")
    }
    errors = {
        m: max(abs(run[n] - exact[n]).max() for n in ("A.ex", "A.ey", "B.ex", "B.ey")) / LUBRICATED["c"]
        for m, run in runs.items()
    }
    requested = {m: run.diagnostics.right_hand_sides for m, run in runs.items()}
    assert max(errors.values()) < 3e-7
    assert errors["radau9"] < 2.0 * errors["rodas5p"] and 2 * requested["radau9"] < requested["rodas5p"]
    assert errors["radau5"] < errors["rodas5p"] and 1.5 * requested["radau5"] < requested["rodas5p"]
    assert runs["auto"].diagnostics.method == "radau9" and errors["auto"] < 2.0 * errors["rodas5p"]
    loose = press.simulate(0.4, output=100, rtol=1e-4, parameters=LUBRICATED)
    assert loose.diagnostics.method == "radau5"


def test_contacts_are_located_as_by_the_others() -> None:
    """The dry press has no film: what the methods need is derived for it when it is asked for."""
    press = scene_of("nine_bar_press", "dry")
    runs = [press.simulate(0.02, output=50, method=m, rtol=1e-9) for m in ("dop853", "radau5", "radau9")]
    assert all(len(run.impacts) == len(runs[0].impacts) > 3 for run in runs)
    for run in runs[1:]:
        first = abs(run.impacts["t_on"][:3] - runs[0].impacts["t_on"][:3])
        assert first.max() < 1e-8
        assert run.diagnostics.energy_residual < 1e-7


def test_both_formulations_agree() -> None:
    press = scene_of("nine_bar_press", "lubricated")
    runs = [x.simulate(0.05, output=20, method="radau9", rtol=1e-9, parameters=LUBRICATED) for x in (press, press.full)]
    assert abs(runs[0].q - runs[1].q).max() < 1e-10


def test_a_step_whose_stages_are_not_found_is_told() -> None:
    """With a fixed step nothing can be shortened."""
    with pytest.raises(SolverError, match="stages of radau9's step were not found"):
        scene_of("swing").simulate(1.0, output=2, method="radau9", step=0.5)
