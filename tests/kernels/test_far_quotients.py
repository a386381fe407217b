"""Quotients of which the denominator's square is no number of C, it being one: drives and forces against mpmath."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.ir.differentiation import compute_partial_derivative
from gudgeon.generator.symbols.unevaluated import UnevaluatedQuotient
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.latex.printers import TexPrinter, TextPrinter
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.slow import slow_but

pytestmark = needs_compiler
AT = 0.25
x, a = sp.symbols("x a", real=True)
FORMS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "powers": ("(T + 60)**90/(T + 61)**90", lambda x: (x + 60) ** 90 / (x + 61) ** 90),
    "hyperbolic": ("cosh(400)/cosh(400 + T)", lambda x: mp.cosh(400) / mp.cosh(400 + x)),
    "ratio": ("sinh(400 + 2*T)/sinh(401 + T)", lambda x: mp.sinh(400 + 2 * x) / mp.sinh(401 + x)),
    "exponential": ("exp(400)/(exp(400 + T) + 1)", lambda x: mp.exp(400) / (mp.exp(400 + x) + 1)),
    "number": ("1e200*T/(1e200 + 1e200*T)", lambda x: x / (1 + x)),
    "square": ("1e160*sin(T)/(1e160 + 1e160*T**2)", lambda x: mp.sin(x) / (1 + x * x)),
    "small": ("1e-170/(1e-170 + 1e-170*T)", lambda x: 1 / (1 + x)),
    "root": ("1e110/sqrt(1e220 + 1e220*T)", lambda x: 1 / mp.sqrt(1 + x)),
    "terms": (
        "T + 1e200/(1e200 + 1e200*T) - exp(-400)/(exp(-400 - T) + exp(-400))",
        lambda x: x + 1 / (1 + x) - 1 / (mp.exp(-x) + 1),
    ),
    "within": ("sin(1e200/(1e200 + 1e200*T))", lambda x: mp.sin(1 / (1 + x))),
    "logarithmic": ("asinh(T*exp(400 + T))", lambda x: mp.asinh(x * mp.exp(400 + x))),
    "angle": ("atan(cosh(400 + T)/cosh(400))", lambda x: mp.atan(mp.cosh(400 + x) / mp.cosh(400))),
}


def expected(name: str, order: int) -> float:
    with mp.workdps(60):
        return float(mp.diff(FORMS[name][1], mp.mpf(AT), order, h=mp.mpf(10) ** -15))


def block(beside: str, forms: Iterable[str]) -> str:
    """A cart driven along each form; a bar hangs on the one of `beside`."""
    lines = ["ground: {o: [0, 0]}", "gravity: [0, -9.81]", "bodies:"]
    lines += [f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}" for name in forms]
    lines += ["  bar: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}"] * bool(beside)
    lines += ["joints:", *(f"  on_{n}: {{translational: [ground.o, {n}.origin], axis: [1, 0]}}" for n in forms)]
    lines += [f"  pin: {{revolute: [{beside}.origin, bar.tail]}}"] * bool(beside) + ["drives:"]
    for name in forms:
        value = re.sub(r"\bT\b", "(t/(1 s))", FORMS[name][0])
        lines.append(f'  by_{name}: {{coordinate: {name}.x, value: "1 m*({value})"}}')
    return "\n".join(lines)


CASES = [
    (beside, formulation, forms)
    for beside in ("", "hyperbolic")
    for formulation in ("reduced", "full")
    for forms in (("hyperbolic", "root", "angle"), tuple(FORMS))
]
FEW = CASES[0], CASES[6]  # each way with few forms; forces have all of them


@pytest.mark.parametrize("case", slow_but(FEW, CASES), ids=lambda case: f"{case[0]}-{case[1]}-{len(case[2])}")
def test_drives_have_their_rates(case: tuple[str, str, tuple[str, ...]], tmp_path: Path) -> None:
    """They were those of the numerators alone: .3395 m/s for .005543 m/s."""
    beside, formulation, forms = case
    simulation = loader(tmp_path)(block(beside, forms))
    run = (simulation.full if formulation == "full" else simulation).simulate(AT, output=1)
    for name in forms:
        for order, quantity in enumerate(("x", "vx", "ax")):
            found = float(run[f"{name}.{quantity}"][-1])
            assert found == pytest.approx(expected(name, order), rel=1e-11, abs=1e-13), (name, quantity)


def test_forces_have_their_slopes(tmp_path: Path) -> None:
    lines = ["ground: {o: [0, 0]}", "bodies:", *(f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}" for name in FORMS)]
    lines += ["joints:", *(f"  on_{n}: {{translational: [ground.o, {n}.origin], axis: [1, 0]}}" for n in FORMS)]
    lines += ["forces:"]
    for name, (form, _) in FORMS.items():
        value = re.sub(r"\bT\b", f"({name}.x/(1 m))", form)
        lines.append(f'  of_{name}: {{force: {name}.origin, value: ["1 N*({value})", 0]}}')
    full = loader(tmp_path)("\n".join(lines)).full
    n = full.compiled.n
    y = np.zeros(2 * n)
    y[:n:3] = AT
    slopes, _ = full.compiled.jacobian(0.0, y, full.p)
    for k, name in enumerate(FORMS):
        assert float(slopes[n + 3 * k, 3 * k]) == pytest.approx(expected(name, 1), rel=1e-11), name


def test_ordinary_quotients_are_differentiated_as_they_were() -> None:
    for value in (1 / (a + x**2), sp.sin(x) / (1 + x) ** 2, 1 / sp.sqrt(1 + x**2), sp.atan(a * x)):
        assert compute_partial_derivative(value, x) == sp.diff(value, x)


def test_how_a_share_is_written() -> None:
    value = UnevaluatedQuotient(sp.sin(x) / (1 + x)) ** 2
    assert printer.print_expression(value) == "((sin(x)/(x + 1.0)) * (sin(x)/(x + 1.0)))"
    assert TextPrinter({}, {}).doprint(value).startswith("(sin(")
    assert TexPrinter({}, {}).doprint(value).endswith(r"\right)^{2}")
