"""Check and report the positions of journals in their bearings at the start: in contact, or too deep for the law."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gudgeon.assembly.linkage import Linkage
from gudgeon.contract.boundary import CLEARANCE_Fx, CLEARANCE_Fy
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.errors import AssemblyError, SingularError
from gudgeon.language.plot_units import format_distinct_numbers
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import (
    compute_corner_approach,
    compute_corner_penetration,
    compute_max_clearance,
    find_slider_dimensions,
    get_contour_depths,
    interpolate_depth,
)

MIN_UNIT_RATIO = 10.0  # times the largest allowed value: a longer e probably has the wrong unit
CLEARANCE_TOL = 1e-9  # of the clearance: allowed error of a start in contact
MAX_DEPTH_OVER_RADIUS = 0.1  # of the radius: largest penetration of a journal (`deepest` of model.h)


def check_journal_positions(linkage: Linkage, p: Array) -> None:
    """Check the positions of journals and sliders with play that the file's start sets.

    A journal may lie as deep as MAX_DEPTH_OVER_RADIUS of the bearing's radius in the wall, with rigid surfaces only
    CLEARANCE_TOL of the clearance. Raises AssemblyError for a deeper one, which is beyond the validity of contact laws,
    and for a slider that can turn over.
    """
    for joint in linkage.source.clearances:
        if joint.name.endswith(".front_upper"):
            _check_slider_tilt(linkage, p, joint)
    for joint, e, c in _iterate_joints_with_start_position(linkage, p):
        if joint.is_corner:
            _check_corner_depth(linkage, p, joint, e - c)
            continue
        if joint.name in linkage.source.rigid_joints and e > c * (1.0 + CLEARANCE_TOL):
            length, limit = format_distinct_numbers(1e3 * e, 1e3 * c)
            raise AssemblyError(
                f"start.play.{joint.name}.e has a length of {length} mm: expected {limit} mm at most, the clearance,"
                " because the surfaces of this joint are rigid (newton_restitution)\n"
                f"  write start.play.{joint.name}: {{e: [{limit} mm, 0 mm]}} for a start in contact, or less"
            )
        max_depth = MAX_DEPTH_OVER_RADIUS * float(p[joint.constants["R_i"]])
        if e - c > max_depth:
            length, limit = format_distinct_numbers(1e3 * e, 1e3 * (c + max_depth))
            bare = "; a number without a unit is in m" if e > MIN_UNIT_RATIO * (c + max_depth) else ""
            raise AssemblyError(
                f"start.play.{joint.name}.e has a length of {length} mm: expected {limit} mm at most, the clearance of"
                f" {1e3 * c:.4g} mm and a tenth of the bearing's radius, up to which contact laws are valid\n"
                f"  write start.play.{joint.name}: {{e: [{1e3 * c / 2:.3g} mm, 0 mm]}}, or a fraction of a parameter,"
                f" such as 0.5*c{bare}"
            )


def _check_slider_tilt(linkage: Linkage, p: Array, joint: ClearanceInfo) -> None:
    """Raise AssemblyError for a slider that can turn over in its guide, or is tilted by 90 deg or more at the start.

    Contact is computed for each corner with the wall on its own side only. joint: the front upper corner of the slider.
    """
    source, c = linkage.source, float(p[joint.clearance])
    guide, a, b, radius = find_slider_dimensions(source, p, joint)
    extent = math.hypot(a - radius, b - radius) + radius
    if extent <= b + c:
        raise AssemblyError(
            f"the slider of {guide} can turn over in its guide: its points are {1e3 * extent:.4g} mm at most from its"
            f" centre, and the walls are {1e3 * (b + c):.4g} mm from that of the guide\n"
            f"  corners have contact with the wall on their own side only: give {guide} a larger half_length, or a"
            " smaller gap"
        )
    if source.eccentricity_equations:
        values = linkage.start_values(p)[1][len(source.start_set) :]
        named = dict(zip(source.eccentricity_equations, values, strict=True))
        tilt = math.degrees(named.get(f"{joint.joint}.angle", 0.0))
        if abs(tilt) >= 90.0:
            raise AssemblyError(
                f"start.play.{joint.joint}.tilt is {abs(tilt):.4g} deg: corners have contact with the wall on their own"
                " side only\n  write less than 90 deg, or reverse the slider's axis"
            )


def _check_corner_depth(linkage: Linkage, p: Array, joint: ClearanceInfo, depth: float) -> None:
    """Raise AssemblyError for a slider's corner that is too deep in its wall; `depth` in m, negative outside.

    The limit is MAX_DEPTH_OVER_RADIUS of half the guide's width; for rigid surfaces, CLEARANCE_TOL of the gap.
    """
    rigid, c = joint.name in linkage.source.rigid_joints, float(p[joint.clearance])
    limit = CLEARANCE_TOL * c if rigid else MAX_DEPTH_OVER_RADIUS * float(p[joint.constants["R_i"]])
    if depth > limit:
        why = (
            "the surfaces of this joint are rigid (newton_restitution)"
            if rigid
            else (f"contact laws are valid up to {1e3 * limit:.3g} mm, a tenth of half the guide's width")
        )
        raise AssemblyError(
            f"start.play.{joint.joint} puts the corner {joint.name} {1e3 * depth:.3g} mm into its wall, beyond the gap"
            f" of {1e3 * c:.4g} mm: {why}\n"
            f"  write less offset or tilt: start.play.{joint.joint}: {{offset: {1e3 * c / 2:.3g} mm}}"
        )


def describe_journals_in_walls(linkage: Linkage, p: Array) -> Iterator[str]:
    """Yield a note on each joint whose journal or corner starts inside the wall: its eccentricity exceeds c.

    Joints with rigid surfaces are left out. The depth of a contour does not count.
    """
    for joint, e, c in _iterate_joints_with_start_position(linkage, p):
        if e > c and joint.name not in linkage.source.rigid_joints:
            wall = "its wall" if joint.is_corner else "its bearing's wall"
            consequence = "a run begins in contact" if joint.dry else "there is no film there"
            yield (
                f"{joint.name} begins {1e6 * (e - c):.4g} µm inside {wall}, "
                f"e/c = {format_distinct_numbers(e / c, 1.0, 3)[0]}: {consequence}"
            )


def _iterate_joints_with_start_position(linkage: Linkage, p: Array) -> Iterator[tuple[ClearanceInfo, float, float]]:
    """Yield the joints with play whose positions the file's start sets, each with |e| and the clearance c (m).

    For a corner, e is its approach to the wall; for a contour, c is the largest clearance. Nothing is yielded if the
    file's start sets no such position. If it sets any, bearings that it leaves out are yielded with |e| = 0.
    """
    source = linkage.source
    if not source.eccentricity_equations:
        return
    values = linkage.start_values(p)[1][len(source.start_set) :]
    for joint in source.clearances:
        joint_values = [
            x
            for row, x in zip(source.eccentricity_equations, values, strict=True)
            if row.rpartition(".")[0] == joint.joint
        ]
        if joint.is_corner:
            if joint_values:
                yield (
                    joint,
                    compute_corner_approach(source, p, joint, -joint_values[0], -joint_values[1]),
                    float(p[joint.clearance]),
                )
            continue
        yield joint, float(np.linalg.norm(joint_values)), compute_max_clearance(source, p, joint)


def describe_contacts_with_assumed_approach_speed(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, discrete_states: Array
) -> tuple[str, ...]:
    """Return a note on each dry contact that a run begins with while the surfaces do not approach (δ̇ ≤ 0).

    Its approach speed δ̇⁻ at the onset is then a convention. q, v (n,) at time t (s). Left out are contacts that resume
    from another run, with their δ̇⁻ in discrete_states (n_discrete_states,), and laws that do not depend on δ̇⁻.
    """
    joints = [k for k, joint in enumerate(compiled.source.clearances) if joint.dry and math.isnan(discrete_states[k])]
    notes: list[str] = []
    for index in joints:
        joint = compiled.source.clearances[index]
        if joint.is_corner:
            notes += _describe_corner_with_assumed_approach_speed(compiled, p, t, q, v, discrete_states, index)
            continue
        rows, e = find_eccentricity(compiled, p, t, q, joint)
        depth = math.hypot(*e) - float(p[joint.clearance]) - _find_contour_depth(compiled, p, q, joint, e)
        if depth > 0.0:
            with np.errstate(all="ignore"):  # the run itself reports values that are not finite
                deltadot_by_v = -(e / math.hypot(*e)) @ compiled.closed_phi_q(t, q, p)[rows]  # ∂δ̇/∂v
                deltadot = float(deltadot_by_v @ v + (e / math.hypot(*e)) @ compiled.closed_nu(t, q, p)[rows])
                approach = v + (1.0 - deltadot) / float(deltadot_by_v @ deltadot_by_v) * deltadot_by_v  # δ̇ = 1 m/s
                if deltadot <= 0.0 and _depends_on_approach_speed(compiled, p, t, q, approach, discrete_states, index):
                    notes.append(_format_onset_note(joint.name, depth, deltadot))
    return tuple(notes)


def _describe_corner_with_assumed_approach_speed(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, discrete_states: Array, joint_index: int
) -> Iterator[str]:
    """Yield a note on the corner of a slider if it begins in contact without approaching its wall (δ̇ ≤ 0).

    The approach speed δ̇⁻ at the onset, the start of the contact, is then assumed.
    Nothing is yielded if the force does not depend on the approach speed: it is tested at velocities nearest to v with
    δ̇ = 1 m/s. joint_index: of the joint among those with play. Other arguments as in
    `describe_contacts_with_assumed_approach_speed`.
    """
    joint = compiled.source.clearances[joint_index]
    depth, deltadot = compute_corner_penetration(compiled, p, t, q, v, joint_index)
    if not (depth > 0.0 and deltadot <= 0.0):
        return
    steps = np.eye(len(v))
    deltadot_by_v = np.array(
        [compute_corner_penetration(compiled, p, t, q, v + step, joint_index)[1] - deltadot for step in steps]
    )
    approach = v + (1.0 - deltadot) / float(deltadot_by_v @ deltadot_by_v) * deltadot_by_v  # δ̇ = 1 m/s
    if _depends_on_approach_speed(compiled, p, t, q, approach, discrete_states, joint_index):
        yield _format_onset_note(joint.name, depth, deltadot)


def _find_contour_depth(
    compiled: CompiledModel, p: Array, q: Array, joint: ClearanceInfo, eccentricity: Array
) -> float:
    """Return the depth (m) of a bearing's contour beyond its circle in the direction of the eccentricity (2,).

    It is 0 without a contour.
    """
    if (depths := get_contour_depths(compiled.source, p, joint.name)) is None:
        return 0.0
    theta = q[compiled.source.bodies[joint.first].index + 2] if joint.first >= 0 else 0.0
    return float(interpolate_depth(depths, math.atan2(eccentricity[1], eccentricity[0]) - theta))


def find_eccentricity(
    compiled: CompiledModel, p: Array, t: float, q: Array, joint: ClearanceInfo
) -> tuple[list[int], Array]:
    """Return the indices of a joint's equations in source.start_equations, and its eccentricity.

    The eccentricity (2,) is in m, in ground axes.
    """
    rows = [k for k, row in enumerate(compiled.source.start_equations) if row.owner == joint.name]
    return rows, -compiled.closed_phi(t, q, p)[rows]  # physics.md, section 2: Φ of the joint is −e


def _depends_on_approach_speed(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, discrete_states: Array, joint_index: int
) -> bool:
    """Return whether the force of a joint at this state differs between approach speeds δ̇⁻ of 1 mm/s and infinity.

    v: velocities at which the surfaces approach. joint_index: of the joint among those with play. True is returned if
    the state cannot be evaluated; the run then reports it.
    """
    contact_states = np.array([discrete_states, discrete_states])
    contact_states[:, joint_index] = 1e-3, np.inf
    try:
        columns = compiled.evaluate([t, t], [q, q], [v, v], contact_states, p, field_names=("clearance",)).clearance[
            :, joint_index
        ]
    except SingularError:  # the run itself reports it
        return True
    force = columns[:, [CLEARANCE_Fx, CLEARANCE_Fy]]
    return bool((force[0] != force[1]).any())


def _format_onset_note(joint_name: str, depth: float, penetration_rate: float) -> str:
    """Return the note on a contact at the start whose onset is not known.

    depth: m. penetration_rate: δ̇ ≤ 0, m/s.
    """
    moves = f"separate at {-penetration_rate:.4g} m/s" if penetration_rate < 0.0 else "are at rest"
    return (
        f"{joint_name} begins in contact, {1e6 * depth:.4g} µm deep, while its surfaces {moves}: the onset is not"
        " known; its approach speed δ̇⁻ (deltadot in run.impacts) follows from the energy of motion and elastic force"
        " without loss; only the damping of this contact depends on that choice"
    )
