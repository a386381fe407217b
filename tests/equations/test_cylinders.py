"""Johnson's and ESDU's contacts of cylinders against the roots of the printed equations, found with forty digits."""

from __future__ import annotations

from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

import gudgeon
from gudgeon.errors import SolverError
from gudgeon.generator.kinds.laws.law import LawInputs, PairSymbols, find_all_laws
from tests.equations.one_law import PAIR, Evaluator
from tests.equations.subjects import NAN, make
from tests.kernels.test_jacobian_contacts import PRESS, journal_at
from tests.oracles.dry import delivered
from tests.programs import needs_compiler
from tests.slow import slow_but

MODULUS = 1.0 / sum((1.0 - nu**2) / E for E, nu in ((PAIR.E_i, PAIR.nu_i), (PAIR.E_j, PAIR.nu_j)))
CONSTANT = {"johnson": -1, "esdu_78035": 1}  # beside the logarithm
HOLDS = {"johnson": 0.5, "esdu_78035": 3.7}  # clearances
DEPTHS = (1e-12, 1e-7, 1e-4, 0.003, 0.05, 0.2, 0.45, 0.5)  # clearances


def printed(law: str, load: mp.mpf) -> mp.mpf:
    """δ (m) of a load (N), as in Pereira, Ramalho and Ambrósio."""
    u = load / (mp.pi * PAIR.L * mp.mpf(MODULUS))
    return u * (mp.log(4 * mp.mpf(PAIR.c) / u) + CONSTANT[law])


def root(law: str, delta: float) -> mp.mpf:
    """The load below the one at which penetration is largest, by bisection and secants: nothing of W in it."""
    most = mp.pi * PAIR.L * mp.mpf(MODULUS) * 4 * mp.mpf(PAIR.c) * mp.exp(CONSTANT[law] - 1)
    return mp.findroot(
        lambda load: printed(law, load) - mp.mpf(delta),
        (most * mp.mpf(10) ** -40, most),
        solver="anderson",
        tol=1e-70,
        maxsteps=500,
    )


@pytest.mark.parametrize("law", sorted(CONSTANT))
def test_force_is_the_printed_equations_root(law: str) -> None:
    """To rounding, at loads of twelve decades up to where a run stops."""
    own = Evaluator(law, {})
    with mp.workdps(40):
        for depth in (*DEPTHS, 1.7, 3.0, 3.7):
            if depth <= HOLDS[law]:
                want = root(law, depth * PAIR.c)
                assert own(depth * PAIR.c, 0.3)[0] == pytest.approx(float(want), rel=1e-13), depth
    assert own(0.0, 0.3)[0] == 0.0


@pytest.mark.parametrize("law", sorted(CONSTANT))
def test_it_rises_all_the_way_and_goes_on_as_a_number_beyond_its_end(law: str) -> None:
    own, end = Evaluator(law, {}), {"johnson": 4.0 * np.exp(-2.0), "esdu_78035": 4.0}[law]
    found = np.array([own(x * PAIR.c, 0.0)[0] for x in np.geomspace(1e-14, end * (1.0 - 1e-9), 300)])
    assert (np.diff(found) > 0.0).all() and (found > 0.0).all()
    assert np.isfinite([own(x * end * PAIR.c, 0.0)[0] for x in (1.0, 1.001, 1.5, 30.0)]).all()


@pytest.mark.parametrize("law", sorted(CONSTANT))
def test_slope_by_the_implicit_function_theorem(law: str) -> None:
    """dF/dδ = 1/(dδ/dF): the law's own steps, differentiated as the Jacobian does, beside the printed equation's."""
    delta = sp.Symbol("delta", real=True)
    numbers = {"restitution": sp.Integer(1)}
    pair = PairSymbols(**{key: sp.Float(value, 40) for key, value in vars(PAIR).items()})
    given = {"delta": delta, "ratio": sp.Integer(0), "deltadot": sp.Integer(0)}
    steps = find_all_laws()[law].build(LawInputs(numbers, {"dissipation": "none"}, pair, given, lambda n, x, m: x))
    known: dict[sp.Symbol, sp.Expr] = {}
    slopes: dict[sp.Symbol, sp.Expr] = {}
    with mp.workdps(30):
        for depth in DEPTHS[2:]:
            at = sp.Float(depth * PAIR.c, 40)
            for name, step in steps.items():
                slope = sp.diff(step, delta) + sum(sp.diff(step, s) * x for s, x in slopes.items())
                symbol = sp.Symbol(name, real=True)
                slopes[symbol] = sp.N(slope.subs({**known, delta: at}), 30)
                known[symbol] = sp.N(step.subs({**known, delta: at}), 30)
            load = root(law, depth * PAIR.c)
            want = 1 / mp.diff(lambda x: printed(law, x), load)
            assert float(slopes[sp.Symbol("F_n", real=True)]) == pytest.approx(float(want), rel=1e-8)
            known.clear()
            slopes.clear()


@needs_compiler
@pytest.mark.parametrize("law", slow_but(["johnson"], sorted(CONSTANT)))
def test_jacobian_of_a_scene(law: str) -> None:
    text = PRESS.replace(b"lankarani_nikravesh", law.encode())
    subject = make(text.replace(b", geometry: external", b""), "press", "dry")
    for depth in (1e-4, 0.02, 0.4):
        e = 0.3e-3 * (1.0 + depth)
        for memory in ((NAN, NAN), (0.02, NAN)):
            subject.compare(0.0, journal_at(subject, (0.6 * e, -0.8 * e), (0.01, 0.03), 2.0), np.array(memory), 1e-9)


BALL = """
format: gudgeon/1
name: ball
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{ball: {{mass: 0.2 kg, inertia: 1e-5 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, ball.com]}}}}
start: {{play: {{A: {{rate: [{speed}, 0]}}}}}}
bearings: {{b: {{radius: 10 mm, clearance: 0.1 mm, length: 5 mm, bearing_material: steel, journal_material: steel}}}}
contacts: {{dry: {{normal: {{law: {law}, restitution: 0.8, dissipation: lankarani_nikravesh}}}}}}
scenes: {{dry: {{play: {{A: {{bearing: b, contact: dry}}}}}}}}
"""


@needs_compiler
@pytest.mark.parametrize("law", sorted(CONSTANT))
def test_one_impact_delivers_what_its_damping_does(law: str, tmp_path: Path) -> None:
    """The identity of restitution holds whatever the elastic force is; nothing pulls, and δ̇⁻ is the speed."""
    path = tmp_path / "ball.yaml"
    path.write_text(BALL.format(law=law, speed=0.5))
    scene = gudgeon.load(path, scene="dry")
    for method in ("dop853", "rodas5p"):
        run = scene.simulate(t_end=4e-4, method=method, rtol=1e-10)
        assert len(run.impacts) == 1
        e = -float(run["A.deltadot"][-1]) / 0.5
        assert e == pytest.approx(delivered(3.0 * (1.0 - 0.8**2) / 4.0), rel=1e-6)
        assert float(np.min(run["A.Fn"])) >= 0.0


@needs_compiler
def test_a_run_stops_where_the_law_ends(tmp_path: Path) -> None:
    path = tmp_path / "ball.yaml"
    path.write_text(BALL.format(law="johnson", speed=400.0))
    for method in ("rk4", "dop853", "rodas5p"):
        with pytest.raises(SolverError, match=r"journal of A .* beyond 0.05 mm, the validity of its contact law"):
            gudgeon.load(path, scene="dry").simulate(t_end=1e-4, method=method)
