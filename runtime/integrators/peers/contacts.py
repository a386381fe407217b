"""Handle joints with play in runs by SciPy or SUNDIALS: contact states, events on the dense output, peaks.

This module is independent of engine/watch/events.c, since a cross-check must not share the code that it checks. Events
are located on the method's dense output, not by its built-in search. SciPy's and CVODE's searches see only sign changes
between ends of steps, and so miss a contact that begins and ends within one step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import (
    CODE_CONTACT,
    CODE_FREE,
    CODE_IMPACT,
    N_PEAK,
    PEAK_F,
    CLEARANCE_delta,
    CLEARANCE_deltadot,
    CLEARANCE_e,
    CLEARANCE_Fn,
    CLEARANCE_Ft,
    PEAK_e_max,
    PEAK_t,
)
from gudgeon.model.compiled import Array, CompiledModel

NODES = np.linspace(0.0, 1.0, 9)  # fractions of a step at which it is sampled
# tolerance of event times relative to the searched interval; 2 ulp of the time where these are more
EVENT_TIME_TOL = 0.5e-12
MIN_PEAK_FRACTION = 0.9  # fraction of the known peak from which on a step's own peak is refined
LOST_TOL = 1e-3  # of c: a free journal further outside its bearing was lost
ROUNDING_TOL = 1e-7  # of the bearing's radius, in addition


@dataclass(frozen=True)
class AcceptedStep:
    """Hold one accepted step from t0 to t1 (s): the solver's interpolant `evaluate` as a function of time.

    `evaluate_projected` is the same, projected onto the constraints.
    """

    t0: float
    t1: float
    evaluate: Callable[[float], Array]
    evaluate_projected: Callable[[float], Array]

    def compute_sample_times(self) -> Array:
        """Return the times (s) at which the step is sampled for events, both ends included."""
        t = self.t0 + NODES * (self.t1 - self.t0)
        t[-1] = self.t1
        return t


@dataclass(frozen=True)
class ContactQuantities:
    """Hold the quantities of joints with play at N states, (N, n_clearances) each."""

    delta: Array  # m
    deltadot: Array  # m/s
    F: Array  # N
    e: Array  # m


class Contacts:
    """Track the contact states of the joints with play in a run; `discrete_states` (n_clearances,): δ̇⁻, NaN if free."""

    def __init__(
        self, compiled: CompiledModel, p: Array, discrete_states: Array, state: NDArray[np.int8] | None
    ) -> None:
        self.compiled, self.p = compiled, p
        joints = compiled.source.clearances
        self.count = len(joints)
        self.c = p[[joint.clearance for joint in joints]]
        self.R = p[[joint.constants["R_i"] for joint in joints]]
        self.floor = _find_velocity_floor(compiled, p)
        self.discrete_states = np.array(discrete_states[: self.count], dtype=np.float64)
        self.compressing = np.zeros(self.count, dtype=bool) if state is None else np.asarray(state) == CODE_IMPACT
        self.open = [(np.nan, 0.0, np.nan)] * self.count  # onset, largest force and its time of the current contact
        self.impacts: list[tuple[int, float, float, float, float, float]] = []
        self.peaks = np.zeros((self.count, N_PEAK))
        self.peaks[:, PEAK_e_max] = -np.inf
        self.onsets = self.ratio_outside = 0
        self.ratio = (np.inf, -np.inf)

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Return a mask (n_clearances,) of the closed contacts."""
        return ~np.isnan(self.discrete_states)

    @property
    def codes(self) -> NDArray[np.int8]:
        """Return the contact codes (n_clearances,)."""
        touching = np.where(self.compressing, CODE_IMPACT, CODE_CONTACT)
        return np.where(self.closed, touching, CODE_FREE).astype(np.int8)

    def evaluate_quantities(self, t: Array, y: Array) -> ContactQuantities:
        """Return the quantities of joints with play at times t (N,) and states y (N, 2n or more).

        The contacts are those of `discrete_states`.
        """
        n = self.compiled.n
        discrete_states = np.broadcast_to(self.discrete_states, (len(t), self.count))
        columns = self.compiled.evaluate(t, y[:, :n], y[:, n : 2 * n], discrete_states, self.p).clearance
        force = np.hypot(columns[..., CLEARANCE_Fn], columns[..., CLEARANCE_Ft])
        return ContactQuantities(
            columns[..., CLEARANCE_delta], columns[..., CLEARANCE_deltadot], force, columns[..., CLEARANCE_e]
        )

    def close_initial_contacts(self, t: float, y: Array, compute_onset_speeds: Callable[[], Array]) -> None:
        """Close open contacts with δ ≥ 0 at the start y, and let contacts that are closed already begin at t (s).

        `compute_onset_speeds` returns the approach speeds δ̇⁻ (n_discrete_states,) of the former; it is called only if
        there are any.
        """
        now = self.evaluate_quantities(np.array([t]), y[None])
        self.open = [(t, 0.0, t)] * self.count
        began = np.flatnonzero(~self.closed & (now.delta[0] >= 0.0)).tolist()
        onset_speeds = compute_onset_speeds() if began else self.discrete_states
        for k in began:
            self._close_contact(k, t, float(onset_speeds[k]))

    def switch_contacts(self, t: float, y: Array, joint: int) -> None:
        """Switch a joint, given by index, between free and contact at t (s).

        Other joints whose gap has changed sign and moves further are switched too.
        """
        now = self.evaluate_quantities(np.array([t]), y[None])
        sign = np.where(self.closed, 1.0, -1.0)
        over = (sign * now.delta[0] < 0.0) & (sign * now.deltadot[0] < 0.0)
        over[joint] = True
        for k in np.flatnonzero(over):
            if self.closed[k]:
                self._open_contact(int(k), t)
            else:
                self._close_contact(int(k), t, float(now.deltadot[0, k]))

    def _close_contact(self, k: int, t: float, deltadot: float) -> None:
        """Close the contact of joint k at t (s), count the onset, and begin its compression.

        The approach speed is `deltadot` (m/s), at least the velocity floor.
        """
        self.discrete_states[k] = max(deltadot, self.floor)
        self.compressing[k] = True
        self.onsets += 1
        self.open[k] = (t, 0.0, t)

    def _open_contact(self, k: int, t: float) -> None:
        """Open the contact of joint k at t (s), and add it to the list of impacts."""
        onset, F, t_peak = self.open[k]
        self.impacts.append((k, onset, t, float(self.discrete_states[k]), F, t_peak))
        self.discrete_states[k] = np.nan

    def update_peaks(self, t: Array, quantities: ContactQuantities) -> None:
        """Update the largest forces and eccentricities of all joints by `quantities` at accepted states at times t."""
        for k in range(self.count):
            i = int(np.argmax(quantities.F[:, k]))
            self._update_peak(k, float(t[i]), float(quantities.F[i, k]))
            self.peaks[k, PEAK_e_max] = max(self.peaks[k, PEAK_e_max], quantities.e[:, k].max())

    def _update_peak(self, k: int, t: float, F: float) -> None:
        """Update the largest force of joint k, and of its current contact, by F (N) at t (s)."""
        if self.peaks[k, PEAK_F] < F:
            self.peaks[k, [PEAK_F, PEAK_t]] = F, t
        if self.closed[k] and self.open[k][1] < F:
            self.open[k] = (self.open[k][0], F, t)

    def update_contacts(self, t: float, y: Array) -> int | None:
        """Update velocity ratios, phases and peaks at an accepted state y at t (s); return the index of a lost contact.

        A contact is lost if a free joint penetrates by more than LOST_TOL of its clearance. Return None without one.
        """
        now = self.evaluate_quantities(np.array([t]), y[None])
        self.update_peaks(np.array([t]), now)
        closed = self.closed
        for ratio in (now.deltadot[0] / self.discrete_states)[closed]:
            self.ratio = min(self.ratio[0], float(ratio)), max(self.ratio[1], float(ratio))
            self.ratio_outside += abs(ratio) > 1.0
        self.compressing &= closed & (now.deltadot[0] > 0.0)
        lost_joints = np.flatnonzero(~closed & (now.delta[0] > LOST_TOL * self.c + ROUNDING_TOL * self.R))
        return int(lost_joints[0]) if len(lost_joints) else None

    def refine_peaks(self, step: AcceptedStep, t: Array, quantities: ContactQuantities) -> None:
        """Refine the largest forces inside a step by minimization, from the samples `quantities` at times t (N,).

        Each is searched between the neighbours of the joint's largest sample and updates the joint's peak. Joints whose
        samples are below MIN_PEAK_FRACTION of their known peak are skipped.
        """
        from scipy.optimize import minimize_scalar

        for k in range(self.count):
            i = int(np.argmax(quantities.F[:, k]))
            peak = self.open[k][1] if self.closed[k] else self.peaks[k, PEAK_F]
            bounds = (t[max(i - 1, 0)], t[min(i + 1, len(t) - 1)])
            if bounds[0] < bounds[1] and quantities.F[i, k] > MIN_PEAK_FRACTION * peak:
                top = minimize_scalar(
                    lambda x, k=k: -self._evaluate_at(step.evaluate, x).F[0, k],
                    bounds=bounds,
                    method="bounded",
                    options={"xatol": 1e-5 * (bounds[1] - bounds[0])},
                )
                self._update_peak(k, float(top.x), -float(top.fun))

    def _evaluate_at(self, compute_state: Callable[[float], Array], t: float) -> ContactQuantities:
        """Return the quantities of joints with play at time t, for the state given by a function of time."""
        return self.evaluate_quantities(np.array([t]), compute_state(t)[None])

    def find_first_event(self, step: AcceptedStep, t: Array, quantities: ContactQuantities) -> tuple[float, int] | None:
        """Return time (s) and joint index of the first contact that begins or ends inside a step; None without one.

        `quantities`: quantities at the sampled times t of the step.
        """
        sign = np.where(self.closed, 1.0, -1.0)
        zeros = [
            (
                self._find_first_zero(
                    step, k, t, sign[k] * quantities.delta[:, k], sign[k] * quantities.deltadot[:, k]
                ),
                k,
            )
            for k in range(self.count)
        ]
        times = [(zero_time, k) for zero_time, k in zeros if zero_time is not None]
        return min(times) if times else None

    def _find_first_zero(
        self, step: AcceptedStep, k: int, t: Array, event_function: Array, rate: Array
    ) -> float | None:
        """Return the first time (s) in the step at which joint k's event function becomes negative, or None.

        `event_function` and `rate`: samples (N,) of the function and its rate at times t. A minimum between two
        positive samples is located too. A function that begins negative and falls counts at once.
        """
        for i in range(1, len(t)):
            low, high = float(t[i - 1]), float(t[i])
            if event_function[i - 1] < 0.0:  # negative already: an event, unless the function rises
                if event_function[i] < 0.0 and rate[i] < 0.0:
                    return low
                continue
            if event_function[i] >= 0.0:
                if not rate[i - 1] < 0.0 < rate[i]:
                    continue
                high = self._locate_zero(step, k, low, high, is_rate=True) or high  # minimum of the event function
            zero_time = self._locate_zero(step, k, low, high)
            if zero_time is not None:
                return zero_time
        return None

    def _locate_zero(self, step: AcceptedStep, k: int, low: float, high: float, is_rate: bool = False) -> float | None:
        """Return the time (s) in [low, high] at which joint k's event function becomes negative, by Brent's method.

        With `is_rate`, it is the time at which its rate becomes positive. States are projected. Return None without
        one.
        """
        from scipy.optimize import brentq

        def evaluate_event_function(t: float) -> float:
            """Return the projected event function, or its rate, at t."""
            quantities = self._evaluate_at(step.evaluate_projected, t)
            number = quantities.deltadot[0, k] if is_rate else quantities.delta[0, k]
            return float(number if self.closed[k] else -number)

        at_low, at_high = evaluate_event_function(low), evaluate_event_function(high)
        if is_rate and not at_low < 0.0 < at_high or not is_rate and at_high >= 0.0:
            return None
        if not is_rate and at_low < 0.0:  # negative by the projection of the state
            return low
        time_tolerance = max(EVENT_TIME_TOL * (high - low), 2.0 * np.spacing(abs(high)))
        return float(brentq(evaluate_event_function, low, high, xtol=time_tolerance, rtol=1e-15))


def _find_velocity_floor(compiled: CompiledModel, p: Array) -> float:
    """Return the smallest approach speed δ̇⁻ (m/s) that an onset stores: the smallest `velocity_floor` of the scene."""
    parameters = enumerate(compiled.source.parameters)
    floors = (float(p[k]) for k, parameter in parameters if parameter.address.endswith(".velocity_floor"))
    return min(floors, default=0.0)
