"""The exact start on the branch nearest the guess: positions by Newton, then velocities.

A scene with play starts from its closed linkage (e = 0, ideal velocities). Angles weigh most: a step
moves guessed angles least, then the other angles, and positions follow. The ordinary case is one call of C
(engine/scene/start.c); what it cannot close, or not near the guess, is looked for here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.assembly.large import LARGE, dependent_step, nearest_step, smallest_step
from gudgeon.assembly.rank import tied
from gudgeon.model.written import reason

MAX_STEPS = 60
FAR = 1.0  # rad: where a guessed angle turns further, a nearer configuration is sought
TRIES, MANY = 24, 60  # from as many other angles; fewer with more coordinates than these
_LENGTH = (1, 0, 0)  # exponents of m, kg, s
AWAY = 1e3  # of how far drives and the start ask for: a body so far from the origin is lost
CLOSED = 1e-10  # a residual above this share of the mechanism's size is no assembly,
ROUNDING = 1e-14  # with this share of how far from the origin it is

# Weights of a coordinate in the norm of a Newton step: a guess is held most firmly.
GUESSED, FREE_ANGLE, FREE_POSITION = 1.0, 1e-2, 1e-4


@dataclass(frozen=True)
class Start:
    """q, q̇ (n,) at time t, with the residual max |Φ| that is left."""

    q: Array
    v: Array
    residual: float


def assemble(compiled: CompiledModel, p: Array, t: float = 0.0) -> Start:
    """The start of a scene. Raises AssemblyError with rows, joints and residual."""
    closed = compiled.close(t, p, mechanism_size(compiled, p)) if compiled.n < LARGE else None
    if closed is not None and np.isfinite(closed[1]).all():
        return Start(*closed)
    return search(compiled, p, t)


def search(compiled: CompiledModel, p: Array, t: float = 0.0) -> Start:
    """The start by all means there are. Raises AssemblyError with rows, joints and residual."""
    problem = _Assembly(compiled, p, t)
    with np.errstate(all="ignore"):  # Newton may come where a direction is not defined; it looks for that itself
        q = problem.positions()
    return Start(q, problem.velocities(q), float(np.abs(problem.residual(q)).max(initial=0.0)))


class _Assembly:
    """Rows of the closed linkage, then those of `set`; each coordinate with its weight."""

    def __init__(self, compiled: CompiledModel, p: Array, t: float) -> None:
        source = compiled.source
        self.compiled, self.p, self.t = compiled, p, t
        self.place = {name: k for k, name in enumerate(source.coordinates)}
        self.guess, self.set, self.rates = compiled.start_values(p)
        self.set_index = [self.place[name] for name in source.start_set]
        self.names = [row.name for row in source.start_rows] + [f"set {name}" for name in source.start_set]
        self.owners = [row.owner for row in source.start_rows] + ["start"] * len(self.set_index)
        self.is_angle = np.array([name.endswith(".theta") for name in source.coordinates])
        self.size = mechanism_size(compiled, p)
        units = [row.unit for row in source.start_rows] + ["rad" if self.is_angle[k] else "m" for k in self.set_index]
        self.row_scale = np.array([self.size if unit == "m" else 1.0 for unit in units])
        self.weight = np.where(self.is_angle, FREE_ANGLE, FREE_POSITION / self.size)
        guessed = [self.place[name] for name in source.start_guess]
        self.reach = self.size
        self.weight[guessed] = np.where(self.is_angle[guessed], GUESSED, GUESSED / self.size)

    def residual(self, q: Array) -> Array:
        return np.concatenate([self.compiled.closed_phi(self.t, q, self.p), q[self.set_index] - self.set])

    def jacobian(self, q: Array) -> Array:
        extra = np.zeros((len(self.set_index), len(q)))
        extra[np.arange(len(self.set_index)), self.set_index] = 1.0
        return np.concatenate([self.compiled.closed_phi_q(self.t, q, self.p), extra])

    def _norm(self, q: Array) -> float:
        return float(np.linalg.norm(self.residual(q) / self.row_scale))

    def _step(self, q: Array, columns: Array | slice = slice(None)) -> Array:
        """Smallest weighted step that closes the linearised rows, in some columns only."""
        weight = self.weight[columns]
        matrix = self.jacobian(q)[:, columns] / self.row_scale[:, None] / weight
        target, step = -self.residual(q) / self.row_scale, np.zeros_like(q)
        if np.isfinite(matrix).all() and np.isfinite(target).all():  # a driven distance has no direction at zero
            few = len(self.place) >= LARGE and len(matrix) > matrix.shape[1]
            step[columns] = (nearest_step if few else smallest)(matrix, target) / weight
        return step

    def positions(self) -> Array:
        """The closed configuration nearest the guess; where Newton leads far away or nowhere, others are sought."""
        guess = np.zeros(len(self.place))
        guess[[self.place[name] for name in self.compiled.source.start_guess]] = self.guess
        guess[self.set_index] = self.set
        guess = self._place_angles(guess)
        self.reach = self._farthest_place(guess)
        first = self._newton(guess)
        if self._is_closed(first) and self._turned(first, guess) < FAR and self._is_near(first):
            return first
        found = [first]
        for spread in (1.0, np.pi) if self.compiled.source.start_guess else (np.pi,):
            found += [self._newton(other) for other in self._others(guess, spread)]
            near = [q for q in found if self._is_near(q)]
            closed = [self._unwound(q, guess) for q in near if self._is_closed(q)]
            if closed:
                break
        else:
            raise self._failure(min(near, key=self._norm, default=guess))
        return min(closed, key=lambda q: float(np.linalg.norm((q - guess) * self.weight)))

    def _farthest_place(self, guess: Array) -> float:
        """How far from the origin (m) drives, the start's set and its guess ask bodies to be: the size, at least."""
        asked = np.abs(self.residual(guess))[: len(self.compiled.source.start_rows)]
        lengths = [row.unit == "m" for row in self.compiled.source.start_rows]
        return float(max(self.size, asked[lengths].max(initial=0.0), np.abs(guess[~self.is_angle]).max(initial=0.0)))

    def _is_closed(self, q: Array) -> bool:
        return self._norm(q) < CLOSED + ROUNDING * self.reach / self.size

    def _is_near(self, q: Array) -> bool:
        """Not run off to where parallel lines meet, and every row seems to close."""
        return bool(np.abs(q[~self.is_angle]).max(initial=0.0) < AWAY * self.reach)

    def _turned(self, q: Array, guess: Array) -> float:
        """The largest turn (rad) of a guessed angle."""
        held = self.is_angle & (self.weight == GUESSED)
        return float(np.abs(q - guess)[held].max(initial=0.0))

    def _others(self, guess: Array, of_guessed: float) -> Iterator[Array]:
        """Coordinates around the guess, the same in every run; driven and set ones fall back into place.

        of_guessed: rad, how far guessed angles are turned, for a guess may lie where every way ends in a fold (the
        residual is least there and not zero).
        """
        rng, guessed = np.random.default_rng(0), [self.place[name] for name in self.compiled.source.start_guess]
        spread = np.where(self.is_angle, np.pi, self.size)
        spread[guessed] *= of_guessed / np.pi
        for _ in range(TRIES if len(guess) <= MANY else TRIES // 4):
            q = guess + spread * rng.uniform(-1.0, 1.0, len(guess))
            q[self.set_index] = self.set
            yield self._place_angles(q)

    def _unwound(self, q: Array, guess: Array) -> Array:
        """Angles within half a turn of the guess, where no row counts turns."""
        for k in np.flatnonzero(self.is_angle & (np.abs(q - guess) > np.pi)):
            other = q.copy()
            other[k] -= 2.0 * np.pi * np.round((q[k] - guess[k]) / (2.0 * np.pi))
            q = other if self._is_closed(other) else q
        return q

    def _newton(self, q: Array) -> Array:
        """Newton with line search, positions put in first; as far as it gets."""
        q = q + self._step(q, ~self.is_angle)
        norm = self._norm(q)
        for _ in range(MAX_STEPS):
            step, share = self._step(q), 1.0
            while share > 1e-4 and not self._norm(q + share * step) < (1.0 - 1e-4 * share) * norm:
                share *= 0.5
            if share <= 1e-4:
                break
            q, norm = q + share * step, self._norm(q + share * step)
        return q

    def _place_angles(self, q: Array) -> Array:
        """Rows in angles alone (drives, sliders) give their angles at once."""
        rows = np.abs(self.jacobian(q)[:, ~self.is_angle]).max(axis=1, initial=0.0) == 0.0
        matrix = self.jacobian(q)[rows][:, self.is_angle] / self.weight[self.is_angle]
        q = q.copy()
        if rows.any():
            solution = smallest(matrix, -self.residual(q)[rows])
            q[self.is_angle] += solution / self.weight[self.is_angle]
        return q

    def _ahead(self) -> float:
        """s, when the drives' rates are looked at: a rate that jumps at the start is what follows (model.h.jinja)."""
        more = max(32 * np.finfo(float).eps * abs(self.t), 1e-100)
        return self.t + more if self.compiled.source.rate_jumps else self.t

    def velocities(self, q: Array) -> Array:
        """q̇ with Φ_q q̇ = ν and the start's rates; what nothing determines is least in the metric of M."""
        names = {"x": "vx", "y": "vy", "theta": "omega"}
        wanted = [f"{body}.{names[c]}" for body, c in (name.split(".") for name in self.place)]
        index = [wanted.index(name) for name in self.compiled.source.start_rates]
        extra = np.zeros((len(index), len(q)))
        extra[np.arange(len(index)), index] = 1.0
        matrix = np.concatenate([self.compiled.closed_phi_q(self.t, q, self.p), extra])
        target = np.concatenate([self.compiled.closed_nu(self._ahead(), q, self.p), self.rates])
        if not (np.isfinite(target).all() and np.isfinite(matrix).all()):
            source = self.compiled.source
            rows = [row.name for row, x in zip(source.start_rows, target, strict=False) if not np.isfinite(x)]
            raise AssemblyError(
                f"the start has no velocities: the rate of {', '.join(rows) or 'the constraints'} is not finite at"
                f" t = {self.t:g} s\n  a root or a power has no slope where it begins: begin with smooth_step or later"
            )
        root = np.sqrt(self.compiled.mass(self.p))
        v = np.zeros_like(q)
        for _ in range(2):  # once more for the rounding of the first solution
            v += smallest(matrix / root, target - matrix @ v) / root
        left = np.abs(matrix @ v - target)
        if left.max(initial=0.0) > 1e-8 * float(np.abs(target).max(initial=0.0)):
            raise self._stuck(matrix / root, left)
        return v

    def _stuck(self, matrix: Array, left: Array) -> AssemblyError:
        """Velocities that do not fit: the rows whose combination vanishes, drives and rates among them."""
        source = self.compiled.source
        rows = [row.name for row in source.start_rows] + list(source.start_rates)
        moving = {row.name for row in source.start_rows if row.kind == "drive"} | set(source.start_rates)
        stuck = [name for name, share in zip(rows, tied(matrix), strict=True) if share > 1e-6]
        movers = [name for name in stuck if name in moving]
        rates = [name for name in stuck if name in source.start_rates]
        play = {joint.name for joint in source.clearances}
        closed = dict.fromkeys(row.owner for row in source.start_rows if row.name in stuck and row.owner in play)
        if rates and closed:
            return AssemblyError(
                f"start.rates {', '.join(rates)} cannot be met: a start closes the joints with play"
                f" ({', '.join(closed)}), and then the linkage moves as its drives say\n"
                "  leave the rate out, or begin from a State of your own: simulate(start=...)"
            )
        if len(movers) > 1:
            owners = dict(zip(rows, [row.owner for row in source.start_rows], strict=False))
            joints = dict.fromkeys(owners[name] for name in stuck if name not in moving)
            among = f" (joints {', '.join(joints)} tie them)" if joints else ""
            return AssemblyError(
                f"the start's velocities contradict each other: {', '.join(movers)} ask for different motions{among}\n"
                "  leave out a rate, or make drives and rates agree at the start"
            )
        if movers:
            return AssemblyError(
                f"the start is a dead centre: {', '.join(movers)} cannot move the linkage from here (rows"
                f" {', '.join(name for name in stuck if name not in moving)} stand against it)\n"
                "  start from another angle, or drive another body"
            )
        worst = rows[int(left.argmax())]
        return AssemblyError(f"no velocities fit the start: row {worst} is left with {left.max():.3g}")

    def _failure(self, q: Array) -> AssemblyError:
        """Which rows stay open, by how much, and what to try."""
        scaled = np.abs(self.residual(q) / self.row_scale)
        if not np.isfinite(scaled).all():
            why = reason(self.compiled.source, self.p, self.t, q, np.zeros_like(q))
            told = f"{why}\n  expected a number at the start" if why else "the constraints are not finite at the guess"
            return AssemblyError(f"the start cannot be assembled: {told}")
        worst = np.argsort(-scaled)[:6]
        worst = worst[scaled[worst] > 1e-3 * scaled.max()]
        rows = ", ".join(f"{self.names[k]} ({self.residual(q)[k]:.3g})" for k in worst)
        owners = ", ".join(dict.fromkeys(self.owners[k] for k in worst if self.owners[k] != "start"))
        sets = "what start.set holds, " if len(self.set_index) else ""
        return AssemblyError(
            f"the start cannot be assembled: rows {rows} stay open (joints {owners or 'none'};"
            f" residual {np.abs(self.residual(q)).max():.3g})\n"
            "  either the constraints contradict each other or the guess is far from every branch: check"
            f" {sets}lengths and ground points, or give start.guess angles nearer to the wanted branch"
        )


def mechanism_size(compiled: CompiledModel, p: Array) -> float:
    """The largest coordinate of a point in its body, of a ground point, or length of a joint, m."""
    return float(mechanism_sizes(compiled, p))


def mechanism_sizes(compiled: CompiledModel, p: Array) -> Array:
    """The same for parameters of any number of runs: (...,) from (..., n_slots + n_derived)."""
    source = compiled.source
    index = [k for point in source.points for k in (point.x, point.y) if k >= 0]
    lengths = [slot.dimension == _LENGTH and slot.address.startswith("joints.") for slot in source.slots]
    index += [k for k, is_length in enumerate(lengths) if is_length]
    if not index:
        return np.ones(p.shape[:-1])
    size = np.abs(p[..., index]).max(axis=-1, initial=0.0)
    return np.where(size > 0.0, size, 1.0)


def smallest(matrix: Array, target: Array) -> Array:
    """The shortest x with matrix x = target, or the nearest to it that there is; 0 where they are not finite."""
    if not (np.isfinite(matrix).all() and np.isfinite(target).all()):
        return np.zeros(matrix.shape[1])
    if matrix.shape[1] >= LARGE:
        x = smallest_step(matrix, target)
        return x if x is not None else dependent_step(matrix, target)
    return np.asarray(np.linalg.lstsq(matrix, target, rcond=1e-12)[0], dtype=np.float64)
