"""What holds for every law that is discovered, over random states of each: no law gives energy, none jumps.

The elastic part of a contact hangs on the penetration alone, so that it gives back what it took; what is left of a
law, and all of friction and film, only takes. Branches are looked at from both sides, wherever a law has a corner.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from functools import cache, reduce
from typing import Any

import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.kinds.laws.law import (
    OPTIONAL_VARIABLES,
    VARIABLES,
    Law,
    LawInputs,
    PairSymbols,
    find_bundled_laws,
)
from tests.equations.one_law import PAIR
from tests.equations.subjects import NAN, Subject, make
from tests.programs import needs_compiler
from tests.slow import slow_but

MANY, PAIRS = 50_000, 20_000
Array = np.ndarray
MU, MU_S = 0.12, 0.2
DELTA = sp.Symbol("delta", real=True)
USUAL = {
    "mu": MU,
    "mu_s": MU_S,
    "v0": 1e-3,
    "v1": 5e-3,
    "v_r": 1e-3,
    "v_s": 0.02,
    "decay": 5e-3,
    "viscosity": 0.1,
    "roughness": 1e-6,
    "restitution": 0.7,
    "presliding": 2e-5,
}
NUMBERS: Mapping[str, Mapping[str, Any]] = {
    "kelvin_voigt": {"stiffness": 1e6, "damping": 50.0},
    "lugre": {"stiffness": 2e4, "damping": 3.0},
    "expression": {"force": 1e6 * DELTA + 1e15 * DELTA**3},
}
CORNERS: Mapping[str, tuple[type, Callable[..., Array]]] = {
    "corner_max": (sp.Max, lambda *x: reduce(np.maximum, x)),
    "corner_min": (sp.Min, lambda *x: reduce(np.minimum, x)),
    "corner_abs": (sp.Abs, np.abs),
    "corner_sign": (sp.sign, np.sign),
}


class Vectors:
    """A law as a function of arrays: its steps by name; `corners` are the functions whose zeros part its branches."""

    def __init__(self, law: Law, options: Mapping[str, str | bool], changed: Mapping[str, float]) -> None:
        known: dict[str, Any] = {**USUAL, **NUMBERS.get(law.name, {}), **changed}
        needed = [own for own in law.parameters if own.required or own.default is not None]
        numbers = {own.name: sp.sympify(known.get(own.name, own.default or 0.0)) for own in needed}
        self.symbols = [sp.Symbol(name, real=True) for name in law.variables]
        given = LawInputs(
            numbers,
            options,
            PairSymbols(**{k: sp.Float(v) for k, v in vars(PAIR).items()}),
            dict(zip(law.variables, self.symbols, strict=True)),
            lambda name, value, meaning: value,
        )
        self.law, self.steps = law, {n: sp.sympify(x) for n, x in law.build(given).items()}
        self.named = [*self.symbols, *(sp.Symbol(name, real=True) for name in self.steps)]
        self._steps = {name: self._array(value) for name, value in self.steps.items()}
        self.corners = [self._array(g) for g in dict.fromkeys(itertools.chain(*map(_corners, self.steps.values())))]

    def _array(self, value: sp.Expr) -> Callable[..., Any]:
        for name, (kind, _) in CORNERS.items():
            value = value.replace(kind, sp.Function(name))
        return sp.lambdify(self.named, value, [{name: f for name, (_, f) in CORNERS.items()}, "numpy"])

    def at(self, *state: Array) -> list[Array]:
        """Values of variables and steps; of steps that are not known yet 0."""
        values: list[Any] = [*state, *[0.0] * len(self.steps)]
        for k, function in enumerate(self._steps.values(), len(state)):
            values[k] = np.broadcast_to(function(*values), state[0].shape)
        return values

    def __call__(self, *state: Array) -> dict[str, Array]:
        with np.errstate(under="ignore"):
            return dict(zip(self._steps, self.at(*state)[len(state) :], strict=True))


def _corners(value: sp.Expr) -> Iterator[sp.Expr]:
    for part in sp.preorder_traversal(value):
        if isinstance(part, (sp.Max, sp.Min)):
            yield from (a - b for a, b in itertools.combinations(part.args, 2))
        elif isinstance(part, (sp.Abs, sp.sign)):
            yield part.args[0]


def choices() -> list[tuple[str, str]]:
    """Every law that gives a force with its defaults, then with each other choice of one key."""
    found = []
    for law in (law for law in find_bundled_laws().values() if not law.rigid):
        found.append((law.name, ""))
        found += [(law.name, f"{own.name}={x}") for own in law.options for x in own.values if x != own.default_option]
    return found


@cache
def vectors(name: str, choice: str, *changed: tuple[str, float]) -> Vectors:
    law = find_bundled_laws()[name]
    options = {own.name: own.default_option for own in law.options}
    if choice:
        key, _, word = choice.partition("=")
        options[key] = next(x for own in law.options if own.name == key for x in own.values if str(x) == word)
    return Vectors(law, options, dict(changed))


def random(law: Law, count: int, seed: int = 1) -> list[Array]:
    """States in the order of its variables, over decades and of both signs."""
    rng = np.random.default_rng(seed)

    def sized(low: float, high: float) -> Array:
        return np.exp(rng.uniform(np.log(low), np.log(high), count))

    signs = rng.choice([-1.0, 1.0], (3, count))
    drawn = {
        "delta": lambda: sized(1e-9, 1e-4),
        "ratio": lambda: rng.uniform(-9.0, 9.0, count),
        "deltadot": lambda: signs[0] * sized(1e-6, 10.0),
        "F_n": lambda: sized(1e-3, 1e5),
        "v_t": lambda: signs[0] * sized(1e-7, 10.0),
        "epsilon": lambda: 0.9999 * rng.uniform(0.0, 1.0, count) ** 0.3,
        "w_n": lambda: signs[1] * sized(1e-6, 1e4),
        "w_t": lambda: signs[2] * sized(1e-6, 1e4),
        "z": lambda: rng.uniform(-1.0, 1.0, count),
    }
    return [drawn[name]() for name in law.variables]


WRONG = {("pinkus_sternlicht", "as_printed=True")}  # told to be: it does work, and jumps where w_n changes its sign


def passive(own: Vectors, count: int, seed: int = 1) -> Array:
    """What a law takes (≥ 0) by state, over the size of what it takes and gives."""
    law, state = own.law, random(own.law, count, seed)
    if law.role == "normal":  # the rest is elastic
        moving = own(*state)["F_n"]
        rates = {"ratio", *OPTIONAL_VARIABLES["normal"]}
        still = own(*(0.0 * x if name in rates else x for name, x in zip(law.variables, state, strict=True)))["F_n"]
        rate = state[law.variables.index("deltadot" if law.name == "kelvin_voigt" else "ratio")]
        assert (still >= 0.0).all() and np.isfinite(moving).all()
        return np.asarray((moving - still) * np.sign(rate) / still)
    if law.role == "friction":
        F_n, v_t = state[:2]
        if law.states:
            return stored(own, state)
        used = -own(*state)["F_t"] * np.sign(v_t) / F_n
        assert (used <= MU_S * (1.0 + 1e-12)).all()
        return np.asarray(used)
    if law.role == "film":
        _, w_n, w_t = state
        got = own(*state)
        size = np.hypot(got["F_r"], got["F_t"]) * np.hypot(w_n, w_t)
        turning = np.random.default_rng(seed + 1).normal(size=count) * 100.0
        shear = np.asarray(got["T0"]) * turning**2 / PAIR.c
        return np.asarray((shear - got["F_r"] * w_n - got["F_t"] * w_t) / (shear + size))
    share = own(*state)["share"]
    return np.asarray(np.minimum(share, 1.0 - share))


def stored(own: Vectors, state: list[Array]) -> Array:
    """Of bristles: slip's power less what ½ σ0 z² grows by, at a load of 1 N; |z| up to where they slide."""
    _, v_t, z = state
    most, stiff = (MU_S / 2e4, 2e4) if own.law.name == "lugre" else (2e-5, MU / 2e-5)
    z = z * most
    got = own(np.ones_like(z), v_t, z)
    edge = own(np.ones_like(z), v_t, np.sign(z) * most)
    assert (np.sign(z) * edge["z_rate"] <= 1e-14 * np.abs(v_t)).all()  # they never bend further
    return np.asarray((-got["F_t"] * v_t - stiff * z * got["z_rate"]) / np.abs(v_t))


@pytest.mark.parametrize("count", slow_but([MANY], [MANY, 1_000_000]))
@pytest.mark.parametrize(("name", "choice"), choices(), ids=lambda x: str(x) or "usual")
def test_it_gives_no_energy(name: str, choice: str, count: int) -> None:
    """And shares of mixed lubrication, by which two that take are added, lie between 0 and 1."""
    changed = [("damping", 4.0 * MU / 10.0)] if name == "lugre" else []  # its bound, for slips up to 10 m/s
    used = passive(vectors(name, choice, *changed), count)
    assert np.isfinite(used).all()
    if (name, choice) in WRONG:
        assert used.min() < -0.1
    else:
        assert used.min() >= -1e-12


def test_bristles_give_energy_beyond_the_bound_of_their_damping() -> None:
    assert passive(vectors("lugre", "", ("damping", 40.0 * MU / 10.0)), 100_000).min() < -1e-6


@pytest.mark.parametrize(("name", "choice"), choices(), ids=lambda x: str(x) or "usual")
def test_it_does_not_jump_at_a_branch(name: str, choice: str) -> None:
    """States on both sides of a corner are led to it by bisection; there the results are the same."""
    own = vectors(name, choice)
    jumps = [jump(own, g, seed) for seed, g in enumerate(own.corners, 3)]
    found = [x for x in jumps if x is not None]
    assert found or not own.corners  # a corner that no pair of states encloses is not looked at
    if (name, choice) in WRONG:
        assert max(found) > 0.1
    else:
        assert max(found, default=0.0) < 1e-9


def jump(own: Vectors, g: Callable[..., Any], seed: int) -> float | None:
    """The largest difference of a result across g = 0, over its size there; None: no pair of states encloses it."""
    low, high = random(own.law, PAIRS, seed), random(own.law, PAIRS, seed + 100)
    if own.law.role != "mixed":  # one and the same penetration, load or eccentricity at both ends
        high[0] = low[0]
    if own.law.states:
        low[2], high[2] = (2e-5 * x[2] for x in (low, high))
    sides = [np.broadcast_to(g(*own.at(*ends)), (PAIRS,)) for ends in (low, high)]
    apart = sides[0] * sides[1] < 0.0
    if not apart.any():
        return None
    low, high, below = [x[apart] for x in low], [x[apart] for x in high], sides[0][apart] < 0.0
    sizes = [np.maximum(*(np.abs(own(*ends)[name]) for ends in (low, high))) for name in own.law.results]
    sizes[0] = np.maximum(sizes[0], low[0]) if own.law.role == "friction" else sizes[0]  # the load's
    for _ in range(80):
        middle = [0.5 * (a + b) for a, b in zip(low, high, strict=True)]
        with_low = (np.broadcast_to(g(*own.at(*middle)), below.shape) < 0.0) == below
        low = [np.where(with_low, m, a) for m, a in zip(middle, low, strict=True)]
        high = [np.where(with_low, b, m) for m, b in zip(middle, high, strict=True)]
    got = [own(*ends) for ends in (low, high)]
    return max(
        float((np.abs(got[0][name] - got[1][name]) / np.maximum(size, 1e-300)).max())
        for name, size in zip(own.law.results, sizes, strict=True)
    )


@pytest.mark.parametrize("name", sorted(n for n, law in find_bundled_laws().items() if law.role == "film"))
def test_a_film_is_isotropic_at_the_centre_and_none_at_rest(name: str) -> None:
    """At ε = 0 any direction may be the normal: force and velocity are parallel, and alike whichever way they point."""
    own, rng = vectors(name, ""), np.random.default_rng(4)
    turn, size = rng.uniform(0.0, 2.0 * np.pi, 1000), np.exp(rng.uniform(-5.0, 5.0, 1000))
    at = own(np.zeros(1000), size * np.cos(turn), size * np.sin(turn))
    along = -(at["F_r"] * np.cos(turn) + at["F_t"] * np.sin(turn)) / size
    across = (at["F_t"] * np.cos(turn) - at["F_r"] * np.sin(turn)) / size
    assert along == pytest.approx(along[0], rel=1e-12) and np.abs(across).max() < 1e-12 * along[0]
    still = own(np.linspace(0.0, 0.9999, 50), np.zeros(50), np.zeros(50))
    assert max(np.abs(still[force]).max() for force in ("F_r", "F_t")) < 1e-140  # what keeps 0/0 away


@pytest.mark.parametrize("name", sorted(n for n, law in find_bundled_laws().items() if law.role == "film"))
def test_a_film_is_in_proportion_to_its_viscosity(name: str) -> None:
    """So that without viscosity what is left of a joint's force is what its surfaces bear (simulation/wear.py)."""
    state = random(find_bundled_laws()[name], 1000)
    thin, thick, none = (vectors(name, "shear=True", ("viscosity", mu))(*state) for mu in (0.01, 0.03, 0.0))
    for result in find_bundled_laws()[name].results:
        np.testing.assert_allclose(thick[result], 3.0 * thin[result], rtol=1e-12)
        assert np.abs(thin[result]).max() > 0.0 and not np.any(none[result])


CONTACTS = """
  c0: {normal: {law: hertz, restitution: 0.7, dissipation: zhiying_qishao}, friction: {law: coulomb, mu: 0.1, v0: 0.01}}
  c1:
    normal: {law: kelvin_voigt, stiffness: 1e7, damping: 200}
    friction: {law: threlfall, mu: 0.1, v_r: 0.2}
    film: {law: pinkus_sternlicht, viscosity: 0.01, shear: true}
    transition: 20 um
  c2:
    normal: {law: lankarani_nikravesh, restitution: 0.7, geometry: internal}
    friction: {law: bengisu_akay, mu: 0.1, mu_s: 0.2, v0: 0.05, decay: 0.1}
    film: {law: ocvirk, viscosity: 0.01, cavitation: full, shear: true}
    mixed: {law: christensen, roughness: 4 um}
  c3:
    normal: {law: liu, restitution: 0.7}
    friction: {law: stribeck, mu: 0.1, mu_s: 0.2, v_s: 0.2, v0: 0.05}
    film: {law: finite_length, viscosity: 0.01, shear: true}
    mixed: {law: greenwood_tripp, roughness: 6 um}
  c4:
    normal: {law: johnson, restitution: 0.7}
    friction: {law: brown_mcphee, mu: 0.1, mu_s: 0.2, v0: 0.1}
    film: {law: ocvirk, viscosity: 0.01}
    mixed: {law: christensen, roughness: 4 um}
  c5:
    normal: {law: esdu_78035, restitution: 0.7, pulls: true}
  c6:
    normal: {law: esdu_78035, restitution: 0.7}
    friction: {law: modified_coulomb, mu: 0.1, v0: 0.01, v1: 0.4}
  c7:
    normal: {law: expression, force: 1e6 N/m * delta + 1e15 N/m^3 * delta**3, restitution: 0.7}
"""
COUNT, CLEARANCE = 8, 0.2e-3
DISCS = f"""
format: gudgeon/1
name: discs
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{{", ".join(f"d{k}: {{mass: 0.2 kg, inertia: 1e-4 kg*m^2}}" for k in range(COUNT))}}}
ground: {{O: [0, 0]}}
joints: {{{", ".join(f"J{k}: {{revolute: [ground.O, d{k}.com]}}" for k in range(COUNT))}}}
bearings: {{b: {{radius: 15 mm, clearance: 0.2 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}}}
contacts: {CONTACTS}
scenes: {{all: {{play: {{{", ".join(f"J{k}: {{bearing: b, contact: c{k}}}" for k in range(COUNT))}}}}}}}
"""


def test_no_law_without_states_is_left_out_of_the_slopes() -> None:
    named = {word.strip(" ,{}") for word in CONTACTS.replace("law: ", "\n@").split("\n") if word.startswith("@")}
    named = {word[1:].split(",")[0].strip(" }") for word in named}
    assert named == {law.name for law in find_bundled_laws().values() if not (law.states or law.rigid)}


@pytest.fixture(scope="module")
def discs() -> Subject:
    return make(DISCS.encode(), "discs", "all")


def moving(rng: np.random.Generator) -> tuple[Array, Array]:
    """Which way each disc lies, and what it does."""
    turn = rng.uniform(0.0, 2.0 * np.pi, COUNT)
    v = np.column_stack([*rng.uniform(-0.1, 0.1, (2, COUNT)), rng.uniform(-20.0, 20.0, COUNT)]).ravel()
    return turn, v


def state(e: float, turn: Array, v: Array) -> Array:
    return np.concatenate([np.column_stack([e * np.cos(turn), e * np.sin(turn), np.zeros(COUNT)]).ravel(), v])


@needs_compiler
def test_slopes_of_every_law_are_those_of_the_complex_step(discs: Subject) -> None:
    """One scene with all laws: on the film, in the transition, deep in the contact; before and after an onset."""
    rng = np.random.default_rng(9)
    for depth in (-0.3, 0.02, 0.08, 0.13, 0.3):  # clearances
        for stored_rate in (NAN, 0.05):
            discs.compare(0.0, state(CLEARANCE * (1.0 + depth), *moving(rng)), np.full(COUNT, stored_rate), 1e-9)


@needs_compiler
def test_no_joint_jumps_where_film_and_contact_meet(discs: Subject) -> None:
    """Across the onset, both ends of each transition and of each share, and the film's cap, all laws at once."""
    rng, ends = np.random.default_rng(10), [CLEARANCE, CLEARANCE + 20e-6, CLEARANCE + 24e-6]
    ends += [0.9999 * (CLEARANCE + x) for x in (0.0, 12e-6, 24e-6)]
    for e in ends:
        for stored_rate in (NAN, 0.05) if e > CLEARANCE else (NAN,):
            turn, v = moving(rng)
            memory = np.full(COUNT, stored_rate)
            sides = [discs.library.rhs(0.0, state(e * (1.0 + s), turn, v), discs.p, memory) for s in (-1e-12, 1e-12)]
            a = [side[3 * COUNT : 6 * COUNT].reshape(COUNT, 3) for side in sides]
            assert (np.abs(a[1] - a[0]).max(axis=1) <= 1e-5 * np.abs(a[0]).max(axis=1) + 1e-6).all(), e


def test_variables_are_drawn_for_every_role() -> None:
    known = {"delta", "ratio", "deltadot", "F_n", "v_t", "epsilon", "w_n", "w_t"}
    assert {x for some in (*VARIABLES.values(), *OPTIONAL_VARIABLES.values()) for x in some} <= known
