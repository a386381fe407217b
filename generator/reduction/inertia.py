"""Mass matrix and velocity terms in tree coordinates, with all constants as derived parameters.

With r_b = Σ_T value_T A(θ_T) w_bT (generator/reduction/geometry.py) all products of positions are
    P_TU = Σ_b m_b (A_T w_bT) · (A_U w_bU) = α cos(θ_U − θ_T) − β sin(θ_U − θ_T),   α = Σ m w_T · w_U,
    Q_TU = Σ_b m_b (ẑ × A_T w_bT) · (A_U w_bU) = α sin(θ_U − θ_T) + β cos(θ_U − θ_T),   β = Σ m w_T × w_U:
the mass matrix, and the centrifugal and Coriolis terms, are these times coordinates and rates.
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reduction.frames import ONE, ZERO, Frame, Pair
from gudgeon.generator.reduction.geometry import Term, TreeGeometry


class Inertia:
    """Derives M, the velocity terms and the weights of one tree geometry; coordinates are identified by name."""

    def __init__(self, geometry: TreeGeometry, gravity: Pair) -> None:
        """Collect the constants of all bodies and derive the mass matrix."""
        self.geometry, self.motions, self.gravity = geometry, geometry.motions, gravity
        self.symbols, self.slots = geometry.symbols, geometry.slots
        self._alpha: dict[tuple[Term, Term], tuple[sp.Expr, sp.Expr]] = {}
        self._moment: dict[Term, Pair] = {}  # Σ m w
        self._between: dict[tuple[str, str], Pair] = {}  # cos and sin of θ_U − θ_T
        self._products: dict[tuple[Term, Term], Pair] = {}
        self._collect()
        self.mass = self._mass()

    def _collect(self) -> None:
        """Sum α, β and Σ m w over the bodies, without terms that do not move."""
        for body in self.geometry.bodies.values():
            moving = [(T, w) for T, w in self.geometry.com(body.name).terms.items() if T != (GROUND, "")]
            for i, (T, w) in enumerate(moving):
                m_x, m_y = self._moment.get(T, (ZERO, ZERO))
                self._moment[T] = m_x + body.mass * w[0], m_y + body.mass * w[1]
                for U, u in moving[i:]:
                    sign = 1 if (T, U) in self._alpha or (U, T) not in self._alpha else -1
                    key = (T, U) if sign == 1 else (U, T)
                    alpha, beta = self._alpha.get(key, (ZERO, ZERO))
                    dot, cross = w[0] * u[0] + w[1] * u[1], w[0] * u[1] - w[1] * u[0]
                    self._alpha[key] = alpha + body.mass * dot, beta + sign * body.mass * cross

    def _angles_between(self, one: Frame, two: Frame) -> Pair:
        """Return cos and sin of θ_two − θ_one."""
        if one.name == two.name:
            return ONE, ZERO
        if not one.turns:
            return two.cos, two.sin
        if not two.turns:
            return one.cos, -one.sin
        if (one.name, two.name) not in self._between:
            define, name = self.symbols.define, f"{two.name}_less_{one.name}"
            cos = define(f"cos_{name}", one.cos * two.cos + one.sin * two.sin)
            sin = define(f"sin_{name}", one.cos * two.sin - one.sin * two.cos)
            self._rules(cos, sin, one, two)
            self._between[one.name, two.name] = cos, sin
        return self._between[one.name, two.name]

    def _rules(self, cos: sp.Symbol, sin: sp.Symbol, one: Frame, two: Frame) -> None:
        """Set the derivatives of a cosine and sine of ψ = θ_two − θ_one: d cos = −sin dψ, d sin = cos dψ.

        P and Q have the same rules.
        """
        turns = {k: two.turns.get(k, ZERO) - one.turns.get(k, ZERO) for k in {**one.turns, **two.turns}}
        self.symbols.rules[cos] = self.motions.rules({k: -c * sin for k, c in turns.items()})
        self.symbols.rules[sin] = self.motions.rules({k: c * cos for k, c in turns.items()})

    def products(self, T: Term, U: Term) -> Pair:
        """Return P_TU and Q_TU of two terms."""
        if (T, U) not in self._alpha:
            if (U, T) not in self._alpha:
                return ZERO, ZERO
            P, Q = self.products(U, T)
            return P, -Q
        if (T, U) not in self._products:
            one, two = self.geometry.frames[T[0]], self.geometry.frames[U[0]]
            name = "_".join(part.replace(".", "_") for part in (*T, *U) if part)
            derive = self.slots.derive
            alpha, beta = (sp.expand(x) for x in self._alpha[T, U])
            alpha, beta = (
                derive(f"inertia_{name}", alpha, "sum of m w.w"),
                derive(f"twist_{name}", beta, "sum of m wxw"),
            )
            cos, sin = self._angles_between(one, two)
            P, Q = alpha * cos - beta * sin, alpha * sin + beta * cos
            if cos != 1:
                P, Q = (self._named(f"{letter}_{name}", value) for letter, value in (("dot", P), ("cross", Q)))
                if P.is_Symbol and Q.is_Symbol:
                    self._rules(P, Q, one, two)
            self._products[T, U] = P, Q
        return self._products[T, U]

    def _named(self, expected: str, value: sp.Expr) -> sp.Expr:
        """Return a number as it is, else a new symbol for the value."""
        return value if value.is_Number else self.symbols.define(expected, value)

    def _columns(self, T: Term) -> dict[str, Pair]:
        """Return ∂r_T/∂z = (rot ẑ + along) A w as pairs (rot, along) by coordinate."""
        frame, along, value = self.geometry.frames[T[0]], self.geometry.along(T[1]), self.geometry.value(T[1])
        names = dict.fromkeys((*frame.turns, *along))
        return {k: (frame.turns.get(k, ZERO) * value, along.get(k, ZERO)) for k in names}

    def _pairs(self) -> Iterable[tuple[Term, Term]]:
        """Yield ordered pairs of terms that some body has together."""
        for T, U in self._alpha:
            yield T, U
            if T != U:
                yield U, T

    def _mass(self) -> dict[tuple[str, str], sp.Expr]:
        """Return both triangles of M by names of coordinates, prescribed ones included."""
        total: dict[tuple[str, str], sp.Expr] = {}
        for T, U in self._pairs():
            P, Q = self.products(T, U)
            for k, (rot, along) in self._columns(T).items():
                for j, (turn, c) in self._columns(U).items():
                    entry = rot * turn * P + rot * c * Q - along * turn * Q + along * c * P
                    total[k, j] = total.get((k, j), ZERO) + entry
        for body in self.geometry.bodies.values():
            turns = self.geometry.frame_of[body.name].turns
            for k, c in turns.items():
                for j, d in turns.items():
                    total[k, j] = total.get((k, j), ZERO) + body.inertia * c * d
        out = {}
        for (k, j), value in total.items():
            if (hoisted := self.hoist(f"mass_{k}_{j}", value)) != 0:
                out[k, j] = hoisted
        return out

    def hoist(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return a sum with the constant factor of each product as a derived parameter."""
        groups: dict[sp.Expr, sp.Expr] = {}
        for term in sp.Add.make_args(sp.expand(value)):
            variable = [s for s in term.free_symbols if not self.slots.is_constant(s)]
            constant, rest = term.as_independent(*variable, as_Add=False) if variable else (term, ONE)
            groups[rest] = groups.get(rest, ZERO) + constant
        return sp.Add(*(rest * self._constant(name, c) for rest, c in groups.items()))

    def _constant(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return a constant as a derived parameter; a symbol or its negative is one already."""
        return value if (-value).is_Symbol else self.slots.derive_signed(name, value, "constant of M")

    def velocity_terms(self) -> dict[str, sp.Expr]:
        """Return h_k = Σ_b m_b ∂r_b/∂z_k · r̈_b at z̈ = 0, by coordinate."""
        h: dict[str, sp.Expr] = {}
        for T, U in self._pairs():
            P, Q = self.products(T, U)
            frame, value, rate = self.geometry.frames[U[0]], self.geometry.value(U[1]), self.geometry.rate(U[1])
            toward, across = -(frame.omega**2) * value, 2 * frame.omega * rate
            for k, (rot, along) in self._columns(T).items():
                term = rot * toward * Q + rot * across * P + along * toward * P - along * across * Q
                h[k] = h.get(k, ZERO) + term
        return {k: self.hoist(f"spin_{k}", value) for k, value in h.items()}

    def weights(self) -> dict[str, sp.Expr]:
        """Return the generalized weights Σ_b m_b g · ∂r_b/∂z_k by coordinate."""
        g_x, g_y = self.gravity
        total: dict[str, sp.Expr] = {}
        for T, (m_x, m_y) in self._moment.items():
            frame, name = self.geometry.frames[T[0]], "_".join(T).replace(".", "_")
            alpha = self.slots.derive(f"weight_{name}_along", sp.expand(m_x * g_x + m_y * g_y), "weight")
            beta = self.slots.derive(f"weight_{name}_across", sp.expand(m_x * g_y - m_y * g_x), "weight")
            P, Q = alpha * frame.cos + beta * frame.sin, beta * frame.cos - alpha * frame.sin
            for k, (rot, along) in self._columns(T).items():
                total[k] = total.get(k, ZERO) + rot * Q + along * P
        return {k: self.hoist(f"weight_{k}", value) for k, value in total.items() if value != 0}
