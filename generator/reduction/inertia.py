"""Mass matrix and velocity-dependent inertia forces in tree coordinates (relative coordinates of the joints).

With r_b = Σ_T value_T A(θ_T) w_bT (generator/reduction/geometry.py), the inertia coupling of two terms T and U is
    P_TU = Σ_b m_b (A_T w_bT) · (A_U w_bU) = α cos(θ_U − θ_T) − β sin(θ_U − θ_T),   α = Σ m w_T · w_U,
    Q_TU = Σ_b m_b (ẑ × A_T w_bT) · (A_U w_bU) = α sin(θ_U − θ_T) + β cos(θ_U − θ_T),   β = Σ m w_T × w_U.
The mass matrix, and the centrifugal and Coriolis terms, are these times coordinates and rates.
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from gudgeon.generator.mechanism import GROUND
from gudgeon.generator.reduction.frames import ONE, ZERO, Frame, Pair
from gudgeon.generator.reduction.geometry import Term, TreeGeometry


class Inertia:
    """Derivation of M, the velocity terms and the weights of one tree geometry; coordinates are identified by name."""

    def __init__(self, geometry: TreeGeometry, gravity: Pair) -> None:
        """Collect the constants of all bodies and derive the mass matrix `mass`.

        `gravity`: its components in ground axes.
        """
        self.geometry, self.motions, self.gravity = geometry, geometry.motions, gravity
        self.symbols, self.parameter_table = geometry.symbols, geometry.parameter_table
        self._alpha_and_beta: dict[tuple[Term, Term], tuple[sp.Expr, sp.Expr]] = {}
        self._mass_moments: dict[Term, Pair] = {}  # Σ m w
        self._angle_differences: dict[tuple[str, str], Pair] = {}  # cos and sin of θ_second − θ_first
        self._products: dict[tuple[Term, Term], Pair] = {}
        self._sum_body_constants()
        self.mass = self._derive_mass()

    def _sum_body_constants(self) -> None:
        """Sum α = Σ m w·u, β = Σ m w × u and Σ m w over the bodies, by pair of terms and by term.

        A position is a sum of terms, vectors w by (frame, slide); terms of the ground do not count. Each pair is stored
        in one order only.
        """
        for body in self.geometry.bodies.values():
            moving_terms = [
                (first, w)
                for first, w in self.geometry.centre_of_mass(body.name).terms.items()
                if first != (GROUND, "")
            ]
            for i, (first, w) in enumerate(moving_terms):
                m_x, m_y = self._mass_moments.get(first, (ZERO, ZERO))
                self._mass_moments[first] = m_x + body.mass * w[0], m_y + body.mass * w[1]
                for second, u in moving_terms[i:]:
                    sign = (
                        1
                        if (first, second) in self._alpha_and_beta or (second, first) not in self._alpha_and_beta
                        else -1
                    )
                    key = (first, second) if sign == 1 else (second, first)
                    alpha, beta = self._alpha_and_beta.get(key, (ZERO, ZERO))
                    dot, cross = w[0] * u[0] + w[1] * u[1], w[0] * u[1] - w[1] * u[0]
                    self._alpha_and_beta[key] = alpha + body.mass * dot, beta + sign * body.mass * cross

    def _find_angle_difference(self, first: Frame, second: Frame) -> Pair:
        """Return (cos, sin) of θ_second − θ_first, the angle between two frames.

        They are (1, 0) for the same frame. If only one frame turns, they follow from its own cosine and sine. If both
        turn, they are symbols with derivative rules, defined at the first call.
        """
        if first.name == second.name:
            return ONE, ZERO
        if not first.angle_coefficients:
            return second.cos, second.sin
        if not second.angle_coefficients:
            return first.cos, -first.sin
        if (first.name, second.name) not in self._angle_differences:
            define, name = self.symbols.add_definition, f"{second.name}_less_{first.name}"
            cos = define(f"cos_{name}", first.cos * second.cos + first.sin * second.sin)
            sin = define(f"sin_{name}", first.cos * second.sin - first.sin * second.cos)
            self._set_derivative_rules(cos, sin, first, second)
            self._angle_differences[first.name, second.name] = cos, sin
        return self._angle_differences[first.name, second.name]

    def _set_derivative_rules(self, cos: sp.Symbol, sin: sp.Symbol, first: Frame, second: Frame) -> None:
        """Set the derivatives of symbols for cos ψ and sin ψ, ψ the angle from the `first` to the `second` frame.

        d cos = −sin dψ and d sin = cos dψ. P and Q of `find_inertia_coupling` have the same rules.
        """
        angle_coefficients = {
            k: second.angle_coefficients.get(k, ZERO) - first.angle_coefficients.get(k, ZERO)
            for k in {**first.angle_coefficients, **second.angle_coefficients}
        }
        self.symbols.derivative_rules[cos] = self.motions.find_derivative_rules(
            {k: -c * sin for k, c in angle_coefficients.items()}
        )
        self.symbols.derivative_rules[sin] = self.motions.find_derivative_rules(
            {k: c * cos for k, c in angle_coefficients.items()}
        )

    def find_inertia_coupling(self, first: Term, second: Term) -> Pair:
        """Return P = α cos ψ − β sin ψ and Q = α sin ψ + β cos ψ of two terms of positions, from a cache.

        α = Σ m w·u and β = Σ m w × u are sums over the bodies, w and u the vectors of the first and second term. ψ is
        the angle from the first frame to the second. The result is (0, 0) for terms that share no body. P is symmetric
        and Q antisymmetric in the terms. α and β become derived parameters. If ψ varies, P and Q become symbols with
        derivative rules.
        """
        if (first, second) not in self._alpha_and_beta:
            if (second, first) not in self._alpha_and_beta:
                return ZERO, ZERO
            P, Q = self.find_inertia_coupling(second, first)
            return P, -Q
        if (first, second) not in self._products:
            first_frame, second_frame = self.geometry.frames[first[0]], self.geometry.frames[second[0]]
            name = "_".join(part.replace(".", "_") for part in (*first, *second) if part)
            derive = self.parameter_table.derive_parameter
            alpha, beta = (sp.expand(constant) for constant in self._alpha_and_beta[first, second])
            alpha, beta = (
                derive(f"inertia_{name}", alpha, "sum of m w.w"),
                derive(f"twist_{name}", beta, "sum of m wxw"),
            )
            cos, sin = self._find_angle_difference(first_frame, second_frame)
            P, Q = alpha * cos - beta * sin, alpha * sin + beta * cos
            if cos != 1:
                P, Q = (
                    self._define_if_variable(f"{letter}_{name}", value) for letter, value in (("dot", P), ("cross", Q))
                )
                if P.is_Symbol and Q.is_Symbol:
                    self._set_derivative_rules(P, Q, first_frame, second_frame)
            self._products[first, second] = P, Q
        return self._products[first, second]

    def _define_if_variable(self, base_name: str, value: sp.Expr) -> sp.Expr:
        """Return a number unchanged, else a new symbol for the value; `base_name`: base of its name."""
        return value if value.is_Number else self.symbols.add_definition(base_name, value)

    def _find_jacobian_columns(self, term: Term) -> dict[str, Pair]:
        """Return ∂r/∂z of a term r of a position by coordinate z, as pairs (angular, linear).

        ∂r/∂z = angular ẑ × A w + linear A w, with the vector A w of the term in ground axes. `angular` is in m if the
        term has a slide; ẑ × turns a vector by +90°.
        """
        frame, along, value = (
            self.geometry.frames[term[0]],
            self.geometry.find_slide_coefficients(term[1]),
            self.geometry.get_slide_value(term[1]),
        )
        names = dict.fromkeys((*frame.angle_coefficients, *along))
        return {k: (frame.angle_coefficients.get(k, ZERO) * value, along.get(k, ZERO)) for k in names}

    def _iterate_term_pairs(self) -> Iterable[tuple[Term, Term]]:
        """Yield the ordered pairs of terms (parts of a position) that occur together in the position of some body.

        Both orders are yielded; a pair of a term with itself is yielded once.
        """
        for first, second in self._alpha_and_beta:
            yield first, second
            if first != second:
                yield second, first

    def _derive_mass(self) -> dict[tuple[str, str], sp.Expr]:
        """Return both triangles of M by names of coordinates, prescribed ones included, without zeros.

        An entry is a sum over ordered pairs of terms with their products P and Q (`find_inertia_coupling`), and over
        the bodies' moments of inertia about their centres of mass.
        """
        sums: dict[tuple[str, str], sp.Expr] = {}
        for first, second in self._iterate_term_pairs():
            P, Q = self.find_inertia_coupling(first, second)
            for k, (angular_first, linear_first) in self._find_jacobian_columns(first).items():
                for j, (angular_second, linear_second) in self._find_jacobian_columns(second).items():
                    entry = (
                        angular_first * angular_second * P
                        + angular_first * linear_second * Q
                        - linear_first * angular_second * Q
                        + linear_first * linear_second * P
                    )
                    sums[k, j] = sums.get((k, j), ZERO) + entry
        for body in self.geometry.bodies.values():
            angle_coefficients = self.geometry.frame_of[body.name].angle_coefficients
            for k, c in angle_coefficients.items():
                for j, d in angle_coefficients.items():
                    sums[k, j] = sums.get((k, j), ZERO) + body.inertia * c * d
        result = {}
        for (k, j), value in sums.items():
            if (hoisted := self.hoist_constants(f"mass_{k}_{j}", value)) != 0:
                result[k, j] = hoisted
        return result

    def hoist_constants(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return a sum in which the constant factor of each product is a derived parameter, named after `name`.

        Products with the same variable part are combined first. Constants contain numbers and parameters only.
        """
        groups: dict[sp.Expr, sp.Expr] = {}
        for term in sp.Add.make_args(sp.expand(value)):
            variable = [symbol for symbol in term.free_symbols if not self.parameter_table.is_constant(symbol)]
            constant_factor, variable_part = term.as_independent(*variable, as_Add=False) if variable else (term, ONE)
            groups[variable_part] = groups.get(variable_part, ZERO) + constant_factor
        return sp.Add(
            *(variable_part * self._derive_constant(name, constant) for variable_part, constant in groups.items())
        )

    def _derive_constant(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return a constant as ± a derived parameter, an existing one if its value is ± the constant.

        Minus a symbol is returned unchanged.
        """
        return (
            value if (-value).is_Symbol else self.parameter_table.derive_signed_parameter(name, value, "constant of M")
        )

    def derive_velocity_terms(self) -> dict[str, sp.Expr]:
        """Return the velocity terms (centrifugal and Coriolis) h_k = Σ_b m_b ∂r_b/∂z_k · r̈_b at z̈ = 0, by z_k.

        z_k are all coordinates, prescribed ones included. The equations of motion are M z̈ + h = applied forces.
        """
        h: dict[str, sp.Expr] = {}
        for first, second in self._iterate_term_pairs():
            P, Q = self.find_inertia_coupling(first, second)
            frame, value, rate = (
                self.geometry.frames[second[0]],
                self.geometry.get_slide_value(second[1]),
                self.geometry.get_slide_rate(second[1]),
            )
            radial, tangential = -(frame.omega**2) * value, 2 * frame.omega * rate
            for k, (angular, linear) in self._find_jacobian_columns(first).items():
                term = angular * radial * Q + angular * tangential * P + linear * radial * P - linear * tangential * Q
                h[k] = h.get(k, ZERO) + term
        return {k: self.hoist_constants(f"spin_{k}", value) for k, value in h.items()}

    def derive_weights(self) -> dict[str, sp.Expr]:
        """Return the generalized weights Σ_b m_b g · ∂r_b/∂z_k by coordinate z_k, without zeros; g is gravity."""
        g_x, g_y = self.gravity
        sums: dict[str, sp.Expr] = {}
        for term, (m_x, m_y) in self._mass_moments.items():
            frame, name = self.geometry.frames[term[0]], "_".join(term).replace(".", "_")
            alpha = self.parameter_table.derive_parameter(
                f"weight_{name}_along", sp.expand(m_x * g_x + m_y * g_y), "weight"
            )
            beta = self.parameter_table.derive_parameter(
                f"weight_{name}_across", sp.expand(m_x * g_y - m_y * g_x), "weight"
            )
            P, Q = alpha * frame.cos + beta * frame.sin, beta * frame.cos - alpha * frame.sin
            for k, (angular, linear) in self._find_jacobian_columns(term).items():
                sums[k] = sums.get(k, ZERO) + angular * Q + linear * P
        return {k: self.hoist_constants(f"weight_{k}", value) for k, value in sums.items() if value != 0}
