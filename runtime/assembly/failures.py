"""Diagnose why a linkage does not close or has no consistent velocities, and which links are too short or long.

One body at a time is scaled about its centre of mass until the equations close with the least change. Where they cannot
close, a configuration has a least residual with Φ_qᵀ Φ = 0. No motion reduces it, but a change of length s does, by
Φᵀ Φ_s. So s follows from Newton's steps on the norm of the residual.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from gudgeon.assembly.closure import CLOSURE_TOL, AssemblyProblem
from gudgeon.assembly.linkage import find_point_in_body
from gudgeon.assembly.rank import compute_left_null_maxima
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array, describe_mass_ratio
from gudgeon.model.file_expressions import explain_undefined_value_after

MIN_UNIT_RATIO = 100.0  # times the next longest length: a sign of lengths in mm next to lengths in m
MAX_SEARCHED_COORDINATES = 60  # coordinates up to which wrong lengths are searched
MAX_STEPS = 30  # largest number of Newton's steps
RELATIVE_STEP = 1e-6  # relative change of a body's length for the derivative
CLOSED_LENGTH_TOL = 1e-7  # residual relative to the size at which a length counts as found
ENDS = {"tail", "head"}
MAX_CHANGE, MIN_CHANGE = 4.0, -0.95  # limits of the relative change: a length beyond them is not the cause


def make_velocity_error(problem: AssemblyProblem, matrix: Array, residuals: Array) -> AssemblyError:
    """Return the error for a start whose velocities do not satisfy the equations.

    matrix: equations of drives, joints and rates for the velocities. residuals: magnitude of each. The message names
    the cause: mass ratios, rates of closed joints, contradicting rates, a dead centre, or else the equation with the
    largest residual.
    """
    source = problem.linkage.source
    if mass_message := describe_mass_ratio(source, problem.linkage.mass(problem.p)):
        return AssemblyError(mass_message)
    rows = [row.name for row in source.start_equations] + list(source.start_rates)
    prescribed = {row.name for row in source.start_equations if row.kind == "drive"} | set(source.start_rates)
    dependent = [name for name, maximum in zip(rows, compute_left_null_maxima(matrix), strict=True) if maximum > 1e-6]
    dependent_motions = [name for name in dependent if name in prescribed]
    rates = [name for name in dependent if name in source.start_rates]
    play = {joint.joint: joint.is_corner for joint in source.clearances}
    closed_joints = dict.fromkeys(
        row.owner for row in source.start_equations if row.name in dependent and row.owner in play
    )
    if rates and closed_joints:
        first = next(iter(closed_joints))
        key = "offset_rate" if play[first] else "rate"
        return AssemblyError(
            f"start.rates {', '.join(rates)} cannot be met: a start closes the joints with play"
            f" ({', '.join(closed_joints)}), and then the drives determine its velocities\n"
            f"  leave out the rate, give the rate of a journal (start: {{play: {{{first}: {{{key}: ..}}}}}}),"
            " or start from a State: simulate(start=...)"
        )
    if len(dependent_motions) > 1:
        owners = dict(zip(rows, [row.owner for row in source.start_equations], strict=False))
        joints = dict.fromkeys(owners[name] for name in dependent if name not in prescribed)
        among = f" (connected by joints {', '.join(joints)})" if joints else ""
        return AssemblyError(
            f"the start's velocities contradict each other: {', '.join(dependent_motions)} prescribe different"
            f" motions{among}\n"
            "  leave out a rate, or make drives and rates agree at the start"
        )
    if dependent_motions:
        return AssemblyError(
            f"the start is a dead centre: {', '.join(dependent_motions)} cannot move the linkage from here (constraint"
            f" equations {', '.join(name for name in dependent if name not in prescribed)} prevent it)\n"
            "  start from another angle, or drive another body"
        )
    worst = rows[int(residuals.argmax())]
    return AssemblyError(
        f"no velocities satisfy all equations at the start: {worst} has a residual of {residuals.max():.3g}"
    )


def make_closure_error(problem: AssemblyProblem, q: Array) -> AssemblyError:
    """Return the error for a linkage that does not close: open equations with their residuals, and remedies.

    q: the best configuration that was found. At most six equations are named, the largest residuals first. The message
    may name lengths with a wrong unit, or a link whose change would close the linkage. If a residual is not finite, the
    message explains the undefined expression instead.
    """
    scaled_residuals = np.abs(problem.compute_residual(q) / problem.row_scale)
    if not np.isfinite(scaled_residuals).all():
        why = explain_undefined_value_after(problem.linkage.source, problem.p, problem.t, q, np.zeros_like(q))
        message = f"{why}\n  expected a number at the start" if why else "the constraints are not finite at the guess"
        return AssemblyError(f"the start cannot be assembled: {message}")
    worst = np.argsort(-scaled_residuals)[:6]
    worst = worst[scaled_residuals[worst] > 1e-3 * scaled_residuals.max()]
    rows = ", ".join(_format_open_equation(problem, q, k) for k in worst)
    if more := int((scaled_residuals >= max(CLOSURE_TOL, 1e-6 * scaled_residuals.max())).sum()) - len(worst):
        rows += f" and {more} more with smaller residuals,"
    owners = ", ".join(dict.fromkeys(problem.owners[k] for k in worst if problem.owners[k] != "start"))
    sets = "start.set, " if len(problem.set_indices) else ""
    lengths = _describe_unit_mistake(problem) or _describe_wrong_lengths(problem, q)
    return AssemblyError(
        f"the start cannot be assembled: constraint equations {rows} are violated (joints"
        f" {owners or 'none'}){lengths}\n"
        "  either the constraints contradict each other or the guess is far from every assembly: check"
        f" {sets}lengths and ground points, or give start.guess angles nearer to the intended assembly"
    )


def _format_open_equation(problem: AssemblyProblem, q: Array, index: int) -> str:
    """Return the name of a violated equation, its residual and the line of its joint: "C.x (8.2 mm, line 14)"."""
    residual, line = (
        float(problem.compute_residual(q)[index]),
        dict(problem.linkage.source.lines).get(problem.owners[index]),
    )
    amount = format_length(residual) if problem.units[index] == "m" else f"{np.degrees(residual):.3g} deg"
    return f"{problem.names[index]} ({amount}{f', line {line}' if line else ''})"


def _describe_wrong_lengths(problem: AssemblyProblem, q: Array) -> str:
    """Return a text on up to three links, of which a change of one would close the linkage; "" if there is none.

    "" also if the linkage has more than MAX_SEARCHED_COORDINATES coordinates: no change is searched then.
    """
    if problem.linkage.n > MAX_SEARCHED_COORDINATES:
        return ""
    wrong_lengths = find_wrong_lengths(problem, problem.find_least_squares_configuration(q, problem.p))[:3]
    message = [
        f"{change.message} ({format_length(change.length)}) {'longer' if change.missing > 0.0 else 'shorter'} by"
        f" {format_length(abs(change.missing))}"
        for change in wrong_lengths
    ]
    return f"\n  one change would close it: {', or '.join(message)}" if message else ""


def _describe_unit_mistake(problem: AssemblyProblem) -> str:
    """Return a text on lengths that are probably in mm without a unit; "" if there are none.

    They are at least 1 m and more than MIN_UNIT_RATIO times the next longest, and at most half of all lengths.
    """
    source = problem.linkage.source
    sizes = {
        parameter.address: abs(float(problem.p[k]))
        for k, parameter in enumerate(source.parameters)
        if parameter.dimension == (1, 0, 0) and parameter.address.startswith(("bodies.", "ground.", "joints."))
    }
    order = sorted((name for name, size in sizes.items() if size > 0.0), key=lambda name: -sizes[name])
    for k, (name, after) in enumerate(pairwise(order), 1):
        if sizes[name] > MIN_UNIT_RATIO * sizes[after] and sizes[name] >= 1.0 and 2 * k <= len(order):
            message = ", ".join(f"{long} is {format_length(sizes[long])}" for long in order[:k][:3])
            question = f"is it {sizes[order[0]]:.4g} mm" if k == 1 else "are they in mm"
            return (
                f"\n  {message}, {sizes[name] / sizes[after]:,.0f} times the next longest: {question}? numbers without"
                " a unit are in m"
            )
    return ""


def format_length(length: float) -> str:
    """Return a length (m) with four digits as text, in mm below 1 m, else in m."""
    return f"{1e3 * length:.4g} mm" if abs(length) < 1.0 else f"{length:.4g} m"


@dataclass(frozen=True)
class WrongLength:
    """Describe a body that would close the linkage if it alone were longer by `missing` (m); negative: shorter."""

    body: str
    points: tuple[str, str]  # its connected points with the largest distance
    length: float  # m, distance of these points
    missing: float

    @property
    def message(self) -> str:
        """Return the name of the body, with the names of its points unless these are its ends."""
        return self.body if {*self.points} == ENDS else f"{self.body}, {'–'.join(self.points)}"


def find_wrong_lengths(problem: AssemblyProblem, q: Array) -> list[WrongLength]:
    """Return the bodies of which a change of length would close the equations, the least change first.

    q: the configuration with the least residuals.
    """
    with np.errstate(all="ignore"):
        return sorted(_search_wrong_lengths(problem, q), key=lambda wrong: abs(wrong.missing))


def _search_wrong_lengths(problem: AssemblyProblem, q: Array) -> Iterator[WrongLength]:
    """Yield the bodies of which a change of length would close the equations, in the order of the file.

    The points of joints and drives on a body are scaled together by the relative change of
    `_find_closing_length_change`. The reported length is the distance of the two points that are furthest apart. Bodies
    without two such positions are skipped. q: first configuration of the search.
    """
    source = problem.linkage.source
    connected = {end for part in source.parts if part.section != "forces" for end in part.ends}
    for index, body in enumerate(source.bodies):
        positions = [
            (p, find_point_in_body(problem.p, p)) for p in source.points if p.body == index and p.name in connected
        ]
        distances = {(p1, p2): float(np.hypot(*(r1 - r2))) for (p1, r1), (p2, r2) in combinations(positions, 2)}
        furthest_points = max(distances, key=distances.__getitem__, default=None)
        if furthest_points is not None and distances[furthest_points] > 0.0:
            first_name, second_name = (point.name.partition(".")[2] for point in furthest_points)
            parameter_indices = sorted({k for point, _ in positions for k in (point.x, point.y) if k >= 0})
            relative_change = _find_closing_length_change(problem, q, parameter_indices)
            if relative_change is not None:
                yield WrongLength(
                    body.name,
                    (first_name, second_name),
                    distances[furthest_points],
                    relative_change * distances[furthest_points],
                )


def _find_closing_length_change(problem: AssemblyProblem, q: Array, length_indices: list[int]) -> float | None:
    """Return the smallest relative change of some lengths that closes the equations; None if none does.

    length_indices: the lengths' indices in p; they are scaled together. q: first configuration. Newton's method on the
    norm of the least-squares residual is followed by bisection between open and closed. Changes outside MIN_CHANGE to
    MAX_CHANGE are not considered; None also for a residual that is not finite or hardly depends on the lengths.
    """
    p, open_change, closing_change, change = problem.p, 0.0, None, 0.0

    def scale_lengths(relative_change: float) -> Array:
        """Return the parameter values with the lengths scaled by 1 + relative_change."""
        changed = np.array(p)
        changed[length_indices] *= 1.0 + relative_change
        return changed

    for _ in range(MAX_STEPS):
        least_squares_q = problem.find_least_squares_configuration(q, scale_lengths(change))
        residual = problem.compute_residual(least_squares_q, scale_lengths(change)) / problem.row_scale
        size = float(np.linalg.norm(residual))
        if not np.isfinite(size):
            return None
        if size < CLOSED_LENGTH_TOL:  # a smaller change may also close the equations
            if change == open_change or abs(change - open_change) < RELATIVE_STEP:
                return change
            closing_change, change = change, 0.5 * (open_change + change)
            continue
        residual_above, residual_below = (
            problem.compute_residual(least_squares_q, scale_lengths(change + e)) / problem.row_scale
            for e in (RELATIVE_STEP, -RELATIVE_STEP)
        )
        slope = float(residual @ (residual_above - residual_below)) / (2.0 * RELATIVE_STEP)
        if abs(slope) < 1e-9 * size:
            return closing_change
        q, open_change, change = least_squares_q, change, change - size**2 / slope
        if closing_change is not None and not min(open_change, closing_change) < change < max(
            open_change, closing_change
        ):
            change = 0.5 * (open_change + closing_change)
        if abs(change) > MAX_CHANGE or change <= MIN_CHANGE:
            return closing_change
    return closing_change
