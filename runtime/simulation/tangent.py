"""Integrate the variational equation along a run, through its contacts: state-transition and saltation matrices.

δẏ = J δy is solved with the exact Jacobian by Gauss collocation of order 6 on panels, which end at contacts. They are
halved until the propagator (state-transition matrix) P converges and maps the rates of the motion: f(b) = P f(a).

At a contact, the right-hand side changes from f⁻ to f⁺ on a surface g(y) = 0; g is the penetration. Differences are
multiplied by the saltation matrix S = I + (f⁺ − f⁻) ∇gᵀ/(∇gᵀ f⁻) (M. di Bernardo, C. Budd, A. Champneys, P. Kowalczyk,
Piecewise-smooth Dynamical Systems, Springer 2008, section 2.5). The difference of the stored approach speed δ̇⁻ is one
more coordinate. It begins at the onset with δ(δ̇⁻) = ∇ġ·δy + g̈⁻ δt, δt = −∇g·δy/ġ, and ends with the contact.

The motion is a flow in the integrated coordinates, with Baumgarte's gains zero.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.boundary import N_WORK
from gudgeon.integrators.adaptive import find_integrated_angles
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import compute_corner_penetration, get_contour_depths, interpolate_depth
from gudgeon.model.parameters import compute_values_without_baumgarte
from gudgeon.results.samples import prepend_start
from gudgeon.simulation.neighbours import INITIAL_DISTANCE, DifferenceNorm, flatten_state

if TYPE_CHECKING:
    from gudgeon.results.results import Result, State
    from gudgeon.simulation.simulation import Simulation


RELATIVE_STEP = 1e-5  # relative change of δ̇⁻ for the slope of forces, which depend on 1/δ̇⁻
ROOT = np.sqrt(15.0)
# nodes of Gauss's method of order 6: E. Hairer, G. Wanner, Solving ODEs II, table IV.5.2
NODES = np.array([0.5 - ROOT / 10, 0.5, 0.5 + ROOT / 10])
BUTCHER = np.array(
    [
        [5 / 36, 2 / 9 - ROOT / 15, 5 / 36 - ROOT / 30],
        [5 / 36 + ROOT / 24, 2 / 9, 5 / 36 - ROOT / 24],
        [5 / 36 + ROOT / 30, 2 / 9 + ROOT / 15, 5 / 36],
    ]
)
WEIGHTS = np.array([5 / 18, 4 / 9, 5 / 18])
N_PANELS, MAX_DEPTH = 2, 16  # initial panels between two contacts, and largest number of halvings
PROPAGATOR_TOL = 1e-8  # largest change of a panel's propagator by halving it
MAX_RATE_ERROR = 1e-4  # of the rates ẏ: allowed difference of P ẏ(begin of the panel) from ẏ(its end)
INSIDE = 1e-6  # of the time between two contacts: distance from its ends at which rates are evaluated
CLEARANCE_OFFSET = 1e-9  # of the clearance: distance from the surface at which f⁻ and f⁺ are evaluated
DIFFERENCE_STEP = 1e-4  # of the clearance: difference for derivatives of gaps
# ln of the growth over one interval: if it is larger, the interval is repeated with half its length
MAX_LOG_GROWTH = 30.0


class Flow:
    """Evaluate rates, Jacobian and gaps of the integrated state y (2m,), that is m coordinates and their rates."""

    def __init__(self, compiled: CompiledModel, run: Result) -> None:
        source = compiled.source
        self.compiled, self.p = compiled, compute_values_without_baumgarte(compiled, run.given, run.is_given)
        self.is_reduced = source.formulation == "reduced"
        self.m = len(source.tree_coordinates) if self.is_reduced else compiled.n
        self.n_dep = len(source.driven_loop_coordinates) if self.is_reduced else 0
        self.is_angle, self.n_joints = find_integrated_angles(source), len(source.clearances)
        rows = [row.owner for row in source.start_equations]
        self.rows = [[k for k, owner in enumerate(rows) if owner == joint.name] for joint in source.clearances]
        self.radial_clearances = [float(self.p[joint.clearance]) for joint in source.clearances]
        self.depths = [get_contour_depths(source, self.p, joint.name) for joint in source.clearances]
        # index into q of the x coordinate of each bearing; −1: ground
        self.bearing = [source.bodies[joint.first].index if joint.first >= 0 else -1 for joint in source.clearances]
        self._allocate_buffers()

    def _allocate_buffers(self) -> None:
        """Allocate the arrays that C reads and fills in tens of thousands of calls, and store C pointers to them."""
        compiled, m, size, p = self.compiled, self.m, self.m + self.n_dep, self.make_pointers(self.p)
        self._full = np.zeros(compiled.n), np.zeros(compiled.n)
        self._reduced = np.zeros(max(size, 1)), np.zeros(max(size, 1))
        self._reduce = [*self.make_pointers(*self._full), *p, *self.make_pointers(*self._reduced, is_written=True)]
        self._state = np.zeros(max(size, 1)), np.zeros(max(size, 1)), np.zeros(max(compiled.n_discrete_states, 1))
        self._a = np.zeros(max(m, 1))
        others = np.zeros(len(compiled.source.closures) + 1), np.zeros(N_WORK)
        self._rhs = [*self.make_pointers(*self._state), *p, *self.make_pointers(self._a, *others, is_written=True)]
        of_node = np.zeros(2 * m + N_WORK + self.n_dep), self._state[2]
        self._J, self._f_t = np.empty((2 * m + N_WORK,) * 2), np.empty(2 * m + N_WORK)
        self._jacobian = [*self.make_pointers(*of_node), *p, *self.make_pointers(self._J, self._f_t, is_written=True)]
        self._node, self._others = of_node[0], others  # referenced here, since pointers do not keep arrays alive

    def reduce_state(self, t: float, qv: Array) -> tuple[Array, Array]:
        """Convert (q, q̇) of all bodies, (2n,), to the integrated state y (2m,) and the dependent coordinates.

        The second result (2, n_dep) contains the dependent coordinates and their rates. In the full formulation
        y is a copy, and n_dep is 0.
        """
        if not self.is_reduced:
            return qv.copy(), np.zeros((2, 0))
        n, m, size = self.compiled.n, self.m, self.m + self.n_dep
        (full_q, full_v), (q, v) = self._full, self._reduced
        full_q[:], full_v[:], q[:], v[:] = qv[:n], qv[n:], 0.0, 0.0
        self.compiled.lib.gudgeon_reduce(t, *self._reduce)
        return np.concatenate([q[:m], v[:m]]), np.stack([q[m:size], v[m:size]])

    def expand_state(self, t: float, y: Array, q_dep: Array) -> Array:
        """Convert state y (2m,) and dependent coordinates and rates (2, n_dep) to (q, q̇) of all bodies, (2n,)."""
        if not self.is_reduced:
            return y.copy()
        q, v = np.zeros(self.compiled.n), np.zeros(self.compiled.n)
        given = self.make_pointers(np.append(y[: self.m], q_dep[0]), np.append(y[self.m :], q_dep[1]), self.p)
        self.compiled.lib.gudgeon_expand(t, *given, *self.make_pointers(q, v, is_written=True))
        return np.concatenate([q, v])

    def expand_difference(self, t: float, y: Array, q_dep: Array, d: Array, h: float) -> Array:
        """Return the difference (2n,) of (q, q̇) of all bodies for a difference d (2m,) of y.

        It is the central difference between y + h d and y − h d, divided by 2h.
        """
        return (self.expand_state(t, y + h * d, q_dep) - self.expand_state(t, y - h * d, q_dep)) / (2.0 * h)

    def compute_rates(self, t: float, y: Array, q_dep: Array, discrete_states: Array) -> Array:
        """Return ẏ (2m,) of the integrated state with dependent coordinates and `discrete_states`.

        Raises SingularError where the equations cannot be solved. The C buffers are overwritten.
        """
        if not self.is_reduced:
            return self.compiled.rhs(t, y, self.p, discrete_states)[: 2 * self.m]
        m, size, (q, v, memory_buffer) = self.m, self.m + self.n_dep, self._state
        q[:m], q[m:size], v[:m], v[m:size] = y[:m], q_dep[0], y[m:], q_dep[1]
        memory_buffer[: len(discrete_states)] = discrete_states
        status = self.compiled.lib.gudgeon_reduced_rhs(t, *self._rhs)
        if status:
            self.compiled.check_pivot(status, t, self.compiled.source.integrated_pivots or None)
        return np.concatenate([y[m:], self._a[:m]])

    def compute_jacobian(self, t: float, y: Array, q_dep: Array, discrete_states: Array) -> Array:
        """Return the Jacobian of the rates of (y, δ̇⁻, t), (2m + n_clearances + 1) square; the rows of δ̇⁻ and t are 0.

        Columns of y and t come from C. Columns of the approach speeds δ̇⁻ of closed contacts are central differences.
        """
        m, node, J = self.m, self._node, self._J
        A = np.zeros((2 * m + self.n_joints + 1,) * 2)
        node[: 2 * m], node[2 * m + N_WORK :], self._state[2][: len(discrete_states)] = y, q_dep[0], discrete_states
        status = self.compiled.lib.gudgeon_jacobian(t, *self._jacobian)
        self.compiled.check_linearization(status, t)
        A[: 2 * m, : 2 * m], A[: 2 * m, -1] = J[: 2 * m, : 2 * m], self._f_t[: 2 * m]
        for k in (k for k in range(self.n_joints) if np.isfinite(discrete_states[k])):
            ends = []
            for factor in (1.0 - RELATIVE_STEP, 1.0 + RELATIVE_STEP):
                changed = discrete_states.copy()
                changed[k] *= factor
                ends.append(self.compute_rates(t, y, q_dep, changed))
            A[: 2 * m, 2 * m + k] = (ends[1] - ends[0]) / (2.0 * RELATIVE_STEP * discrete_states[k])
        return A

    def compute_dependent_coordinates(self, t: float, q_dep: Array) -> Array:
        """Return the dependent coordinates and rates (2, n_dep) at t (s), which drives determine.

        `q_dep`: those at a nearby time, where the iteration begins; returned itself if n_dep is 0.
        """
        if not self.n_dep:
            return q_dep
        q, rates = q_dep[0].copy(), np.zeros(3 * self.n_dep)
        self.compiled.lib.gudgeon_driven_loops(
            t,
            *self.make_pointers(q, is_written=True),
            *self.make_pointers(self.p),
            *self.make_pointers(rates, is_written=True),
        )
        return np.stack([q, rates[: self.n_dep]])

    def compute_penetration(self, joint: int, t: float, y: Array, q_dep: Array) -> tuple[float, float]:
        """Return the penetration δ (m) and its rate δ̇ (m/s) of a joint with play at the integrated state.

        `joint`: index of the joint, which may be a corner at a wall or have a bearing with a contour.
        """
        full, n, rows = self.expand_state(t, y, q_dep), self.compiled.n, self.rows[joint]
        if self.compiled.source.clearances[joint].is_corner:
            return compute_corner_penetration(self.compiled, self.p, t, full[:n], full[n:], joint)
        e = self.compiled.closed_phi(t, full[:n], self.p)[rows]
        rate = self.compiled.closed_phi_q(t, full[:n], self.p)[rows] @ full[n:]
        rate -= self.compiled.closed_nu(t, full[:n], self.p)[rows]
        length = float(np.hypot(*e))
        penetration, approach = length - self.radial_clearances[joint], float(e @ rate) / length
        depths = self.depths[joint]
        if depths is None:
            return penetration, approach
        index = self.bearing[joint]
        theta, omega = (full[index + 2], full[n + index + 2]) if index >= 0 else (0.0, 0.0)
        angle = np.arctan2(-e[1], -e[0]) - theta
        turning = float(e[0] * rate[1] - e[1] * rate[0]) / length**2 - omega
        depth, slope = (float(interpolate_depth(depths, angle, order)) for order in (0, 1))
        return penetration - depth, approach - slope * turning

    def make_pointers(self, *arrays: Array, is_written: bool = False) -> list[Any]:
        """Return C pointers to arrays, for C to write into if `is_written`; those to empty arrays have length 1."""
        return [self.compiled.pointer(array if array.size else np.zeros(1), is_written=is_written) for array in arrays]


@dataclass(eq=False)
class Panel:
    """Hold the panel from s to s + width (0 to 1) of the time from a to b (s), with its propagator P."""

    a: float
    b: float
    s: float
    width: float
    depth: int = 0
    P: Array | None = None
    rate_error: float = 0.0  # relative error of the rates ẏ that P maps from the begin to the end
    halving_change: float = 0.0  # of the propagator by the last halving
    halves: tuple[Panel, ...] = ()

    @property
    def nodes(self) -> list[tuple[float, float]]:
        """Return the times t (s) of the three nodes of the panel, each with dt/ds times the width (s).

        The map t(s) = a + (b − a)(3 s² − 2 s³) has zero slope at both ends, where contacts begin or end.
        """
        s = self.s + self.width * NODES
        times, rates = self.a + (self.b - self.a) * s * s * (3.0 - 2.0 * s), 6.0 * (self.b - self.a) * s * (1.0 - s)
        return list(zip(times.tolist(), (self.width * rates).tolist(), strict=True))

    @property
    def ends(self) -> list[float]:
        """Return the times (s) of both ends of the panel, mapped as `nodes`, slightly inside the contacts' times."""
        s, length = np.array([self.s, self.s + self.width]), self.b - self.a
        return np.clip(
            self.a + length * s * s * (3.0 - 2.0 * s), self.a + INSIDE * length, self.b - INSIDE * length
        ).tolist()

    def split(self) -> tuple[Panel, Panel]:
        """Return two new panels, the halves of this one, without propagators."""
        h, times = 0.5 * self.width, (self.a, self.b)
        return Panel(*times, self.s, h, self.depth + 1), Panel(*times, self.s + h, h, self.depth + 1)

    def compose_propagator(self) -> tuple[Array, float]:
        """Return the propagator of the panel, composed of its halves if it has any, and the sum of `halving_change`."""
        if not self.halves:
            assert self.P is not None
            return self.P, self.halving_change
        (P, first), (Q, second) = (half.compose_propagator() for half in self.halves)
        return Q @ P, first + second


@dataclass(eq=False)
class Tangent:
    """Integrate a tangent vector z along a run: differences of y, of the approach speeds δ̇⁻ and of t (always 0)."""

    simulation: Simulation
    norm: DifferenceNorm
    settings: dict[str, Any]
    state: State
    transverse: bool
    flow: Flow
    n_coincidences: int = 0  # always 0: tangent vectors do not vanish
    growth_error: float = 0.0  # sum of the errors of ln of the growth
    z: Array = field(init=False)  # (2m + n_clearances + 1,)

    def __post_init__(self) -> None:
        """Set the first tangent vector `z` from a randomly drawn neighbour of the start, and its norm `distance`."""
        t, y = self.state.t, flatten_state(self.state)
        reduced_state, _ = self.flow.reduce_state(t, y)
        other, _ = self.flow.reduce_state(t, self.norm.draw_neighbour(t, y))
        self.z = np.append((other - reduced_state) / INITIAL_DISTANCE, np.zeros(self.flow.n_joints + 1))
        self.distance = self._compute_tangent_norm(self.state, self.z)

    def advance_to(self, t: float, is_shortest_interval: bool) -> tuple[Result, float] | None:
        """Advance the run to t (s); return it and ln of the growth of the tangent vector.

        Return None, with nothing changed, if the growth is too large, unless `is_shortest_interval`. Otherwise
        the vector is scaled back to the norm 1. KeyboardInterrupt is passed on.
        """
        run = self._simulate_to_times([t])
        changes = self._list_contact_changes(run)
        times = {t_on for t_on, *_ in changes}
        states = self._compute_states(sorted(times)) if times else {}
        z, error = self.z, 0.0
        for panel in self._compute_panels(sorted({self.state.t, t, *times})):
            P, change = panel.compose_propagator()
            z, error = P @ z, error + change
            for t_change, joint, is_onset, deltadot in changes:
                if t_change == panel.b and panel.s + panel.width == 1.0:
                    z = self._apply_saltation_matrix(z, t_change, joint, is_onset, deltadot, states[t_change])
        z = self._project_tangent(run, z)
        distance = self._compute_tangent_norm(run.final, z)
        log_growth = math.log(distance / self.distance)
        if abs(log_growth) > MAX_LOG_GROWTH and not is_shortest_interval:
            return None
        self.state, self.z, self.distance, self.growth_error = run.final, z / distance, 1.0, self.growth_error + error
        return run, log_growth

    def _simulate_to_times(self, times: list[float] | Array) -> Result:
        """Return the run from the current state with samples at these times (s).

        Raises KeyboardInterrupt after Ctrl-C.
        """
        run = self.simulation.simulate(output=times, start=self.state, stop=False, peaks=(), **self.settings)
        if run.diagnostics.interrupted:
            raise KeyboardInterrupt
        return run

    def _list_contact_changes(self, run: Result) -> list[tuple[float, int, bool, float]]:
        """Return the onsets and ends of contacts after the current state and before the end of the run, by time.

        Items are (time in s, index of the joint, whether it is an onset, approach speed δ̇⁻ in m/s).
        """
        begin, end = self.state.t, float(run.t[-1])
        changes = []
        for impact in run.impacts:
            joint, deltadot = int(impact["joint"]), float(impact["deltadot"])
            changes += [
                (float(impact[name]), joint, name == "t_on", deltadot)
                for name in ("t_on", "t_off")
                if begin < impact[name] < end
            ]
        return sorted(changes)

    def _compute_states(self, times: list[float]) -> dict[float, tuple[Array, Array]]:
        """Return (q, q̇), (2n,), and discrete states by time, from a run through these increasing times (s)."""
        run = prepend_start(self._simulate_to_times([t for t in times if t > self.state.t]))
        rows = np.searchsorted(run.t, times)
        return {
            t: (np.concatenate([run.q[k], run.v[k]]), run.memory[k].copy()) for t, k in zip(times, rows, strict=True)
        }

    def _compute_panels(self, times: list[float]) -> list[Panel]:
        """Return N_PANELS panels between each two successive times, with propagators that have converged.

        A panel is halved until this changes its propagator by at most PROPAGATOR_TOL and both halves map ẏ within
        MAX_RATE_ERROR, or until MAX_DEPTH. The halves are nested in `panel.halves`; the list holds the first
        panels only.
        """
        panels = [
            Panel(a, b, k / N_PANELS, 1.0 / N_PANELS)
            for a, b in zip(times, times[1:], strict=False)
            for k in range(N_PANELS)
        ]
        self._set_propagators(panels)
        unconverged = panels
        while unconverged:
            for panel in unconverged:
                panel.halves = panel.split()
            halves = [half for panel in unconverged for half in panel.halves]
            self._set_propagators(halves)
            next_unconverged: list[Panel] = []
            for panel in unconverged:
                first, second = panel.halves
                assert first.P is not None and second.P is not None and panel.P is not None
                change = self._compute_propagator_difference(second.P @ first.P, panel.P)
                rate_error = max(first.rate_error, second.rate_error)
                if (change > PROPAGATOR_TOL or rate_error > MAX_RATE_ERROR) and first.depth < MAX_DEPTH:
                    next_unconverged += panel.halves
                else:
                    first.halving_change = max(change, rate_error if rate_error > MAX_RATE_ERROR else 0.0)
            unconverged = next_unconverged
        return panels

    def _set_propagators(self, panels: list[Panel]) -> None:
        """Set `P` and `rate_error` of each panel by Gauss collocation of order 6, with states from a run."""
        nodes = [panel.nodes for panel in panels]
        states = self._compute_states(
            sorted({t for panel in nodes for t, _ in panel} | {t for x in panels for t in x.ends})
        )
        A = np.array([[rate * self._compute_jacobian(t, *states[t]) for t, rate in panel] for panel in nodes])
        count, _, size, _ = A.shape
        matrix = np.eye(3 * size) - (BUTCHER[None, :, None, :, None] * A[:, :, :, None, :]).reshape(
            count, 3 * size, 3 * size
        )
        K = np.linalg.solve(matrix, A.reshape(count, 3 * size, size)).reshape(count, 3, size, size)
        for panel, P in zip(panels, np.eye(size) + np.einsum("i,pijk->pjk", WEIGHTS, K), strict=True):
            panel.P, panel.rate_error = (
                P,
                self._compute_rate_error(P, *(self._compute_rates(t, *states[t]) for t in panel.ends)),
            )

    def _compute_rates(self, t: float, qv: Array, discrete_states: Array) -> Array:
        """Return ẏ (2m,) at the state (q, q̇), (2n,), of all bodies with `discrete_states`."""
        y, q_dep = self.flow.reduce_state(t, qv)
        return self.flow.compute_rates(t, y, q_dep, discrete_states)

    def _compute_rate_error(self, P: Array, rates_at_begin: Array, rates_at_end: Array) -> float:
        """Return the norm of P ẏ(begin) − ẏ(end) of a panel, relative to the larger of the rates (2m,) at its ends."""
        w, size = self._compute_variable_scales(), len(rates_at_begin)
        mapped_rates = P @ np.concatenate([rates_at_begin, np.zeros(self.flow.n_joints), [1.0]])
        largest = max(float(np.linalg.norm(rates / w[:size])) for rates in (rates_at_begin, rates_at_end))
        return float(np.linalg.norm((mapped_rates[:size] - rates_at_end) / w[:size])) / max(
            largest, 1e-9 / self.norm.crossing_time
        )

    def _compute_jacobian(self, t: float, qv: Array, discrete_states: Array) -> Array:
        """Return the Jacobian at the state (q, q̇), (2n,), of all bodies; see Flow.compute_jacobian."""
        y, q_dep = self.flow.reduce_state(t, qv)
        return self.flow.compute_jacobian(t, y, q_dep, discrete_states)

    def _compute_variable_scales(self) -> Array:
        """Return the scales (2m + n_clearances,) of y and δ̇⁻, by which differences are divided for norms."""
        largest, crossing = float(self.norm.scales[: self.norm.n].max()), self.norm.crossing_time
        q = largest * np.where(self.flow.is_angle, 1.0 / self.norm.size, 1.0)
        return np.concatenate([q, q / crossing, np.full(self.flow.n_joints, largest / crossing)])

    def _compute_propagator_difference(self, P: Array, Q: Array) -> float:
        """Return |P − Q|/|P| (Frobenius, scaled variables) of two propagators without their last row and column."""
        w = self._compute_variable_scales()
        P, Q = P[:-1, :-1] * w / w[:, None], Q[:-1, :-1] * w / w[:, None]
        return float(np.linalg.norm(P - Q) / np.linalg.norm(P))

    def _apply_saltation_matrix(
        self, z: Array, t: float, joint: int, is_onset: bool, approach_speed: float, state_at_t: tuple[Array, Array]
    ) -> Array:
        """Return the tangent vector z multiplied by the saltation matrix of a contact that begins or ends at t (s).

        `joint`: its index; `is_onset`: whether the contact begins; `approach_speed`: δ̇⁻ (m/s); `state_at_t`: (q, q̇)
        and discrete states at t. At an onset, the component of δ̇⁻ is set (formulas: head of this file), except if the
        law's smallest approach speed holds; at an end, it becomes 0.
        """
        flow, size = self.flow, 2 * self.flow.m
        (y, q_dep), d = flow.reduce_state(t, state_at_t[0]), z[:size]
        closed_states, open_states = state_at_t[1].copy(), state_at_t[1].copy()
        closed_states[joint], open_states[joint] = approach_speed, np.nan
        penetration, rate = flow.compute_penetration(joint, t, y, q_dep)
        h = DIFFERENCE_STEP / self.norm.compute_norm(self._map_tangent_to_bodies(t, y, q_dep, d))
        ends = [np.array(flow.compute_penetration(joint, t, y + s * h * d, q_dep)) for s in (1.0, -1.0)]
        penetration_slope, rate_slope = (ends[0] - ends[1]) / (2.0 * h)
        time_shift = -penetration_slope / rate
        offset = (CLEARANCE_OFFSET * flow.radial_clearances[joint] + 2.0 * abs(penetration)) / abs(rate)  # s
        drift = flow.compute_rates(t, y, q_dep, open_states)
        drift[flow.m :] = 0.0
        both_states = (open_states, closed_states) if is_onset else (closed_states, open_states)  # before, after
        f = [
            flow.compute_rates(
                t + s * offset,
                y + s * offset * drift,
                flow.compute_dependent_coordinates(t + s * offset, q_dep),
                discrete_states,
            )
            for s, discrete_states in zip((-1.0, 1.0), both_states, strict=True)
        ]
        z_after = z.copy()
        z_after[:size] -= (f[1] - f[0]) * time_shift
        z_after[size + joint] = 0.0
        if is_onset and approach_speed < rate * (1.0 + 1e-6):  # else the floor of δ̇⁻, which does not move
            acceleration = self._compute_penetration_acceleration(joint, t, y, q_dep, f[0])
            z_after[size + joint] = rate_slope + acceleration * time_shift
        return z_after

    def _compute_penetration_acceleration(self, joint: int, t: float, y: Array, q_dep: Array, f: Array) -> float:
        """Return the second derivative δ̈ (m/s²) of a joint's penetration along the rates f (2m,), by central
        differences in time.
        """
        flow, n = self.flow, len(y) // 2
        difference = self._map_tangent_to_bodies(t, y, q_dep, f)
        difference[self.norm.n :] = 0.0
        h = DIFFERENCE_STEP / max(self.norm.compute_norm(difference), 1.0 / self.norm.crossing_time)
        rates = [
            flow.compute_penetration(
                joint,
                t + s,
                y + s * f + 0.5 * s * s * np.append(f[n:], np.zeros(n)),
                flow.compute_dependent_coordinates(t + s, q_dep),
            )[1]
            for s in (h, -h)
        ]
        return (rates[0] - rates[1]) / (2.0 * h)

    def _project_tangent(self, run: Result, z: Array) -> Array:
        """Return z projected onto the tangent space of the constraints at the end of the run.

        It is the central difference of the nonlinear projection of the states y ± h z, with h z of the size
        INITIAL_DISTANCE. If `transverse`, the component along the motion is removed first. Entries of approach speeds
        are unchanged.
        """
        t, full, size = float(run.t[-1]), flatten_state(run.final), 2 * self.flow.m
        y, q_dep = self.flow.reduce_state(t, full)
        d = z[:size]
        if self.transverse:
            f = self.flow.compute_rates(t, y, q_dep, run.memory[-1])
            d = d - f * self.norm.project_on_flow(
                self._map_tangent_to_bodies(t, y, q_dep, d), self._map_tangent_to_bodies(t, y, q_dep, f)
            )
        h = INITIAL_DISTANCE / self.norm.compute_norm(self._map_tangent_to_bodies(t, y, q_dep, d))
        ends = [
            self.flow.reduce_state(t, self.norm.project_state(t, self.flow.expand_state(t, y + s * h * d, q_dep)))[0]
            for s in (1.0, -1.0)
        ]
        return np.append((ends[0] - ends[1]) / (2.0 * h), z[size:])

    def _map_tangent_to_bodies(self, t: float, y: Array, q_dep: Array, d: Array) -> Array:
        """Map a tangent vector d (2m,) of the integrated state to that (2n,) of (q, q̇) of all bodies; 0 for d = 0.

        It is a central difference quotient whose step changes the integrated state by at most 1e-6.
        """
        largest = float(np.abs(d).max(initial=0.0))
        if largest == 0.0:
            return np.zeros(2 * self.norm.n)
        return self.flow.expand_difference(t, y, q_dep, d, 1e-6 / largest)

    def _compute_tangent_norm(self, state: State, z: Array) -> float:
        """Return the norm of the tangent vector z at a state: that of (q, q̇) of all bodies, without δ̇⁻ and t."""
        y, q_dep = self.flow.reduce_state(state.t, flatten_state(state))
        return self.norm.compute_norm(self._map_tangent_to_bodies(state.t, y, q_dep, z[: 2 * self.flow.m]))
