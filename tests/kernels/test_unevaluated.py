"""Powers of products that SymPy must not evaluate: forces, derivatives and bounds against mpmath."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from gudgeon.errors import BadValueError, InputErrors, Location, NonFiniteError
from gudgeon.generator.symbols.from_expressions import convert_to_sympy
from gudgeon.generator.targets.c import printer, ranges_printer
from gudgeon.generator.targets.latex.printers import TexPrinter, TextPrinter
from gudgeon.language.parser import parse
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
X = 80.0
FORMS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "coefficient": ("p3*(0.01*x)**161", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** 161),
    "large": ("p3*(100*c*c*x)**200", lambda x: mp.mpf(1e16) * (100 * mp.mpf(0.01) ** 2 * x) ** 200),
    "nested": ("p3*((0.01*x)**7)**23", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** 161),
    "quotient": ("p3*(x/100)**161", lambda x: mp.mpf(1e16) * (x / 100) ** 161),
    "sum": ("p3*(0.004*x + 0.006*x**1.0)**161", lambda x: mp.mpf(1e16) * ((mp.mpf(0.004) + mp.mpf(0.006)) * x) ** 161),
    "scaled_sum": ("p3*(x/100 + 3.0/50)**161", lambda x: mp.mpf(1e16) * (x / 100 + mp.mpf("0.06")) ** 161),
    "parameter": ("p3*(c*x)**161", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** 161),
    "parameter_nested": ("p3*(((c*x)**4)**5)**8", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** 160),
    "downward": ("1e-16*(0.01*x)**-161", lambda x: mp.mpf(1e-16) * (mp.mpf(0.01) * x) ** -161),
    "upside_down": ("1e-16*(100/x)**161", lambda x: mp.mpf(1e-16) * (100 / x) ** 161),
    "broken": ("p3*(0.01*x)**160.5", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** mp.mpf(160.5)),
    "by_logarithm": ("p3*exp(161*log(0.01*x))", lambda x: mp.mpf(1e16) * (mp.mpf(0.01) * x) ** 161),
    "product": ("1e-200*x**60*1e-200*x**60*1e171", lambda x: mp.mpf(10) ** -229 * x**120),
    "size": ("1e160*hypot(1e-160*x, 0)", lambda x: x),
    "exponentials": ("exp(5000 - 1000*x)*exp(1000*x - 4999)", lambda x: mp.e + 0 * x),
}


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    """A mass of 1 kg on the x axis for each form."""
    lines = ["parameters: {p3: 1e16, c: 0.01}", "ground: {o: [0, 0]}", "bodies:"]
    lines += [f"  {name}: {{mass: 1 kg, inertia: 1 kg*m^2}}" for name in FORMS]
    lines += ["joints:", *(f"  on_{n}: {{translational: [ground.o, {n}.origin], axis: [1, 0]}}" for n in FORMS)]
    lines += ["start:", "  set:", *(f"    {name}.x: {X}" for name in FORMS), "forces:"]
    for name, (form, _) in FORMS.items():
        value = re.sub(r"\bx\b", f"({name}.x/(1 m))", form)
        lines.append(f'  of_{name}: {{force: {name}.origin, value: ["1 N*({value})", 0]}}')
    return loader(tmp_path_factory.mktemp("wholes"))("\n".join(lines))


@pytest.mark.parametrize("x", [X, 97.0])
def test_slopes_are_those_of_thirty_digits(scene: Simulation, x: float) -> None:
    full = scene.full
    n = full.compiled.n
    y = np.zeros(2 * n)
    y[:n:3] = x
    slopes, _ = full.compiled.jacobian(0.0, y, full.p)
    for k, (name, (_, form)) in enumerate(FORMS.items()):
        with mp.workdps(40):
            expected = mp.diff(form, mp.mpf(x), h=mp.mpf(10) ** -18)
        assert float(slopes[n + 3 * k, 3 * k]) == pytest.approx(float(expected), rel=1e-11, abs=1e-12), name


@pytest.mark.parametrize("method", ["dop853", "rodas5p", "rk4", "auto"])
def test_forces_have_all_their_digits(scene: Simulation, method: str) -> None:
    """That of `coefficient` was 1.2 % off, for 0.01^161 has no digits left; that of `large` ∞ · 0."""
    run = scene.simulate(1e-9, output=1, method=method, step=1e-9 if method == "rk4" else None)
    for name, (_, form) in FORMS.items():
        with mp.workdps(40):
            assert run[f"of_{name}.Fx"][0] == pytest.approx(float(form(mp.mpf(X))), rel=1e-12), name


def test_several_runs_at_once_have_them_too(scene: Simulation) -> None:
    runs = scene.simulate_many([{"c": 0.01}] * 8, 1e-9, output=1, method="rk4", step=1e-9)
    assert not runs.failures
    assert runs[7]["of_parameter.Fx"][0] == pytest.approx(2.497398840252816, rel=1e-12)


def read(text: str) -> sp.Expr:
    return convert_to_sympy(parse(text, Location("f", 1, 1)), lambda name: sp.Symbol(name, real=True))


@pytest.mark.parametrize(
    ("form", "c", "ranges", "tex", "text"),
    [
        (
            "(0.01*x)**161",
            "pow((0.01*x), 161.0)",
            "interval_pow((interval_mul(make_interval(0.01), x)), make_interval(161.0))",
            r"\left(0.01 \, x\right)^{161}",
            "(0.01·x)^161",
        ),
        (
            "(0.01*x)**3",
            "1.0000000000000002e-06*(x * x * x)",
            "interval_mul(make_interval(1.0000000000000002e-06), interval_pow(x, make_interval(3.0)))",
            None,
            None,
        ),
    ],
)
def test_how_a_whole_is_written(form: str, c: str, ranges: str, tex: str | None, text: str | None) -> None:
    value = read(form)
    assert printer.print_expression(value) == c
    assert ranges_printer.RangesPrinter()._print_range(value) == ranges
    assert tex is None or TexPrinter({}, {}).doprint(value) == tex
    assert text is None or TextPrinter({}, {}).doprint(value) == text


@pytest.mark.parametrize("number", [sp.Float("1e-400"), sp.Float("-1e-322"), sp.Float("1e400"), sp.Integer(10) ** 350])
def test_a_coefficient_that_binary64_has_not_stands_on_both_sides(number: sp.Expr) -> None:
    x = sp.Symbol("x", real=True)
    text = printer.print_expression(number * sp.exp(x))
    at = -np.sign(float(sp.log(abs(number)))) * 700.0
    found = eval(text, {"exp": np.exp, "x": at})  # two products and a call: Python reads them as C does
    assert found == pytest.approx(float(number * sp.exp(sp.Integer(int(at)))), rel=1e-12, abs=0.0)
    assert "INFINITY" not in ranges_printer.RangesPrinter()._print_range(number * x)


@pytest.mark.parametrize("value", ["1e-200*1e-200*a.x/(1 m)", "0.01**161*a.x/(1 m)", "p**2*a.x/(1 m)", "exp(p*1e-150)"])
def test_what_vanishes_as_it_is_written_is_refused(tmp_path: Path, value: str) -> None:
    block = f"""
    parameters: {{p: 1e-160}}
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    forces: {{f: {{force: a.origin, value: ["1 N*({value})", 0]}}}}
    """
    with pytest.raises((BadValueError, InputErrors), match="which loses digits by underflow"):
        loader(tmp_path)(block)


def test_a_sample_that_is_no_number_is_told(tmp_path: Path) -> None:
    """Every stage of the steps had one; those between, which samples need, had none, and the run went on in silence."""
    block = """
    parameters: {c: 0.91445, w: 1e-8}
    bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {o: [0, 0]}
    joints: {g: {translational: [ground.o, a.origin], axis: [1, 0]}}
    start: {set: {a.x: 0}, rates: {a.vx: 1}}
    forces: {f: {force: a.origin, value: ["1e-3 N*sqrt((a.x/(1 m) - c)**2 - w)", 0]}}
    """
    scene = loader(tmp_path)(block)
    with pytest.raises(NonFiniteError, match=r"no longer finite at t = 0.9 s|not finite at t = 0.9 s") as message:
        scene.simulate(1.0, output=40, method="dop853")
    assert message.value.partial.t[-1] == pytest.approx(0.875) and np.isfinite(message.value.partial.q).all()
    many = scene.simulate_many([{}, {"c": 2.0}], 1.0, output=40, method="dop853")
    assert [str(failure) for failure in many.failures] == [f"run 0: {message.value}"]
