"""Compute the report of a run, `run.report()`: contacts of its joints with play, energies, and accuracy.

The report depends on the stored result only, so that a result from a file has the same report, bit for bit. Values from
additional runs (simulation/examine.py) are included if they were requested, and named as missing if not.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.results.diagnostics import Examination
from gudgeon.results.peaks import find_sample_extreme
from gudgeon.results.reports.comparison import replace_non_finite_numbers
from gudgeon.results.samples import prepend_start

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.kinds.laws.law import Law
    from gudgeon.results.results import Array, Result

MAX_SLOW_SQUEEZE = 0.5  # largest |ε̇| over the surfaces' mean angular velocity that counts as slow squeezing
UNASSIGNED_WORK_TOL = (
    0.02  # fraction of the joints' work that no dissipation accounts for, up to which none is reported
)
_COMMENT = re.compile(r"/\*\n(.*?)\n \*/", re.DOTALL)
_LAW = re.compile(
    r"(?P<title>.*?)\. (?:.*? )??Source: (?P<source>.*?)\. Valid: (?P<valid>.*?)\."
    r"(?: Properties: (?P<properties>.*?)\.)?(?: Options: (?P<options>.*?)\.)?(?: |$)"
)
NOT_REQUESTED = "not requested: gudgeon run --report, or gudgeon.examine(simulation, run, ideal)"


@dataclass(frozen=True)
class RunReport:
    """The report of one run; `print` and notebooks display it, `to_html` is a self-contained page."""

    run: Result

    @cached_property
    def _report_values(self) -> dict[str, Any]:
        """All values of the report by section, in SI, as a dictionary that `to_dict`, the page and the text share."""
        run = prepend_start(self.run)
        joints = {joint.name: _compute_joint_values(run, k, joint) for k, joint in enumerate(run.source.clearances)}
        return {
            "title": run.source.title,
            "mechanism": run.source.mechanism,
            "scene": run.source.scene,
            "t": [float(run.t[0]), float(run.t[-1])],
            "samples": len(self.run.t),
            "method": run.diagnostics.method,
            "joints": joints,
            "guides": {name: _compute_guide_values(run, name) for name in run.source.guides},
            "energy": _compute_energy_balance(run),
            "trust": _collect_accuracy_values(run),
            "laws": read_laws(run.source),
            "warnings": [*run.diagnostics.notes, *_list_validity_warnings(run, joints)],
        }

    def to_dict(self) -> dict[str, Any]:
        """Return plain values in SI for JSON, None where there is no value."""
        json_values: dict[str, Any] = replace_non_finite_numbers(self._report_values)
        return json_values

    def to_html(self) -> str:
        """Return a self-contained HTML page with tables, and each joint's orbit as SVG."""
        from gudgeon.results.reports.run_page import build_report_page

        return build_report_page(self.run, self._report_values)

    def _repr_html_(self) -> str:
        """Return the report as HTML for a notebook."""
        from gudgeon.results.reports.html_page import build_article
        from gudgeon.results.reports.run_page import build_sections

        return build_article(build_sections(self.run, self._report_values))

    def __str__(self) -> str:
        """Return the report as text."""
        from gudgeon.results.reports.run_page import format_report

        return format_report(self._report_values)

    def __repr__(self) -> str:
        """Return mechanism and scene in one line."""
        return f"<RunReport {self.run.source.mechanism}/{self.run.source.scene}>"


def _compute_joint_values(run: Result, k: int, joint: ClearanceInfo) -> dict[str, Any]:
    """Return the values of a joint with play (clearance k) by the keys of the report, in SI.

    Peak and eccentricity are over all steps, fractions of time from onsets and separations. Without additional runs
    restitution and work are None, and the rms force is that of the samples. Values of a missing film or dry contact are
    NaN.
    """
    peak, clearance = run.diagnostics.peak(joint.name), float(run.p[joint.clearance])
    impacts = run.impacts[run.impacts["joint"] == k]
    examined, max_penetration = _find_joint_statistics(run, joint.name), peak.e_max - clearance
    mean_clearance = float(run.p[joint.constants.get("mean_clearance", joint.clearance)])  # rough surfaces: their means
    if any(contour.joint == joint.name for contour in run.source.contours) and len(run.t):
        max_penetration = float(
            run[f"{joint.name}.delta"].max()
        )  # at the samples, since the depth depends on the angle
    values = {
        "c": clearance,
        "corner": joint.is_corner,
        "time": _compute_time_fractions(run, k, joint, impacts),
        "contacts": len(impacts),
        "still_closed": int(np.isnan(impacts["t_off"]).sum()),
        "approach": _compute_quantiles(impacts["deltadot"][impacts["deltadot"] > 0.0]),
        "restitution": None,
        "stiffness": _find_stiffness(run, joint),
        "asked": _find_specified_restitution(run, joint),
        "free_impact": _compute_free_restitution(run, joint),
        "peak": {"F": peak.F, "t": peak.t},
        "rms": _compute_rms_force(run, joint.name),
        "rms_of": "samples",
        "largest_e": peak.e_max,
        "penetration": max(max_penetration, 0.0) if joint.dry else math.nan,
        "penetration_share": max(max_penetration, 0.0) / clearance if joint.dry else math.nan,
        "film_least": max(mean_clearance - peak.e_max, 0.0) if joint.film else math.nan,
        "work": None,
    }
    if examined is not None:
        names = ("min", "q1", "median", "q3", "max")
        values["restitution"] = {name: getattr(examined, f"restitution_{name}") for name in names}
        values |= {"rms": examined.F_rms, "rms_of": "all of the time"}
        damping = examined.used - examined.returned
        values["work"] = {
            "taken": examined.used,
            "returned": examined.returned,
            "damping": damping,
            "friction": examined.friction,
            "film": examined.film,
        }
    return values | {"ideal": _find_ideal_force(run, joint.name)}


def _compute_guide_values(run: Result, name: str) -> dict[str, Any]:
    """Return the force (peak, rms) and the peak moment on the slider of a guide with play, at the samples.

    "ideal" is the force in the ideal scene; None if it is not known.
    """
    force, moment = (find_sample_extreme("", "", run.t, run[f"{name}.{component}"]) for component in "FM")
    values = {
        "peak": {"F": force.peak, "t": force.t},
        "rms": _compute_rms_force(run, name),
        "M": {"peak": moment.peak, "t": moment.t},
    }
    return values | {"ideal": _find_ideal_force(run, name)}


def _find_ideal_force(run: Result, joint: str) -> dict[str, float] | None:
    """Return {"F": peak, "t": its time, "rms": rms} of the force at a joint of the ideal scene; None if not known."""
    for ideal in (run.diagnostics.examined or Examination()).ideal:
        if ideal.joint == joint:
            return {"F": ideal.peak, "t": ideal.t_peak, "rms": ideal.rms}
    return None


def _find_stiffness(run: Result, joint: ClearanceInfo) -> dict[str, Any] | None:
    """Return the stiffness {"K": value, "unit": unit} of a joint's contact law; None for a law without one.

    The unit is N/m^n with the exponent n of the law; N/m for n = 1.
    """
    for name in ("K", "spring"):
        if name in joint.constants:
            exponent = float(run.parameters.get(f"contacts.{_find_contact_name(run, joint)}.normal.exponent", 1.0))
            unit = "N/m" if name == "spring" or exponent == 1.0 else f"N/m^{exponent:g}"
            return {"K": float(run.p[joint.constants[name]]), "unit": unit}
    return None


def _find_contact_name(run: Result, joint: ClearanceInfo) -> str:
    """Return the name, in section `contacts` of the file, of the contact law of a joint; "" if it is not known.

    Derived parameters are named CONTACT_BEARING_CONSTANT, which contains it. Otherwise it is the only contact of the
    scene, if the scene has only one joint with play.
    """
    source = run.source
    contact_names = [
        address.split(".")[1] for parameter in source.parameters if ".normal." in (address := parameter.address)
    ]
    bearing_name = source.parameters[joint.clearance].address.split(".")[1]
    for name, p_index in joint.constants.items():
        if (derived_index := p_index - len(source.parameters)) >= 0:
            derived_names = {
                contact: re.sub("_+", "_", f"{contact}_{bearing_name}_{name}") for contact in contact_names
            }
            matching_contacts = [
                contact for contact in contact_names if source.derived[derived_index] == derived_names[contact]
            ]
            if matching_contacts:
                return matching_contacts[0]
    return (
        contact_names[0]
        if len({*contact_names}) == 1 and len({joint.joint for joint in source.clearances}) == 1
        else ""
    )


def _find_specified_restitution(run: Result, joint: ClearanceInfo) -> float | None:
    """Return the coefficient of restitution that the file specifies for a joint's contact; None if there is none."""
    restitution = run.parameters.get(f"contacts.{_find_contact_name(run, joint)}.normal.restitution")
    return None if restitution is None else float(restitution)


def _compute_free_restitution(run: Result, joint: ClearanceInfo) -> float | None:
    """Return the coefficient of restitution of a free impact (no other forces) with the hysteresis damping of a joint.

    Returns None for a law without such damping.
    """
    from gudgeon.generator.kinds.laws.dissipation import compute_delivered_restitution

    return (
        compute_delivered_restitution(float(run.p[joint.constants["hysteresis"]]))
        if "hysteresis" in joint.constants
        else None
    )


def _find_joint_statistics(run: Result, joint: str) -> Any:
    """Return the contact statistics of a joint from the second pass through the run.

    Returns None if they were not requested.
    """
    examined = run.diagnostics.examined or Examination()
    return next((statistics for statistics in examined.joints if statistics.joint == joint), None)


def _compute_time_fractions(run: Result, k: int, joint: ClearanceInfo, impacts: Array) -> dict[str, float]:
    """Return the fractions of the time by mode: free, impacting (from an onset to the first maximum of δ), contact,
    film.

    The time in contact follows from onsets and separations. Its impacting part is from the examination (repeated run)
    of a joint with dry contact, else from the contact codes at the samples. A joint with a film has "film" instead of
    "free". All are NaN for a run without duration.
    """
    begin, end = float(run.t[0]), float(run.t[-1])
    if not end > begin:
        return dict.fromkeys(("free", "impacting", "contact", "film"), math.nan)
    end_times = np.where(np.isnan(impacts["t_off"]), end, impacts["t_off"])
    contact_times = np.clip(end_times, begin, end) - np.clip(impacts["t_on"], begin, end)
    contact_fraction = float(contact_times.sum()) / (end - begin)
    examined = _find_joint_statistics(run, joint.name)
    if examined is not None and joint.dry:
        impacting_fraction = min(examined.impacting, contact_fraction)
    else:
        contact_codes = run.state[:, k]
        impacting_fraction = (
            contact_fraction * float((contact_codes == 1).sum()) / max(int((contact_codes > 0).sum()), 1)
        )
    free_fraction = 1.0 - contact_fraction
    return {
        "free": 0.0 if joint.film else free_fraction,
        "impacting": impacting_fraction,
        "contact": contact_fraction - impacting_fraction,
        "film": free_fraction if joint.film else 0.0,
    }


def _compute_quantiles(values: Array) -> dict[str, float] | None:
    """Return minimum, median and maximum of the values by name; None without values."""
    if not len(values):
        return None
    low, middle, high = (float(x) for x in np.quantile(values, (0.0, 0.5, 1.0)))
    return {"min": low, "median": middle, "max": high}


def _compute_rms_force(run: Result, joint: str) -> float:
    """Return the rms force (N) of a joint or guide over the run, by the trapezoidal rule over the samples.

    For a run without duration it is the force at the first sample.
    """
    force, duration = run[f"{joint}.F"], float(run.t[-1] - run.t[0])
    return math.sqrt(float(np.trapezoid(force**2, run.t)) / duration) if duration > 0.0 else float(force[0])


def _compute_energy_balance(run: Result) -> dict[str, float] | None:
    """Return the works up to the end and the terms of the energy balance, in J; None for a scene without masses.

    Keys: works of drives, forces and clearances; "change" of kinetic and potential energy; "residual", the largest of
    the run; "turned_over", the energy throughput. "not_told_apart" is the work of joints with play less the energies
    that contact, friction and film dissipate; it is present only if all joints have contact statistics.
    """
    if run.source.massless_bodies:
        return None
    diagnostics, names = run.diagnostics, ("drives", "forces", "clearances")
    terms = {name: float(run.work[-1, k] - run.work[0, k]) for k, name in enumerate(names)}
    total_energy = run["energy.kinetic"] + run["energy.potential"]
    terms |= {
        "change": float(total_energy[-1] - total_energy[0]),
        "residual": diagnostics.energy_residual,
        "turned_over": diagnostics.energy_turned_over,
    }
    statistics = [_find_joint_statistics(run, joint.name) for joint in run.source.clearances]
    if statistics and all(statistics):
        dissipated = [
            energy
            for joint_statistics in statistics
            for energy in (
                joint_statistics.used - joint_statistics.returned,
                joint_statistics.friction,
                joint_statistics.film,
            )
            if math.isfinite(energy)
        ]
        terms["not_told_apart"] = -terms["clearances"] - math.fsum(dissipated)
    return terms


def _collect_accuracy_values(run: Result) -> dict[str, Any]:
    """Return the values of a run's accuracy by the keys of the report: drift, horizon, steps, differences, notes."""
    diagnostics, examined = run.diagnostics, run.diagnostics.examined or Examination()
    horizon: Any = "to the end" if diagnostics.horizon == math.inf else diagnostics.horizon
    return {
        "phi_max": diagnostics.phi_max,
        "phi_dot_max": diagnostics.phi_dot_max,
        "horizon": horizon,
        "steps": diagnostics.steps,
        "rtol": diagnostics.rtol,
        "step": diagnostics.step,
        "compared_with": examined.compared_with,
        "interrupted": diagnostics.interrupted,
        "differences": [asdict(difference) for difference in examined.differences],
        "notes": list(examined.notes),
        "asked": diagnostics.examined is not None,
    }


def read_laws(source: KernelSource) -> list[dict[str, str]]:
    """Return {"title", "source", "valid", "properties", "options"} of each law of contact, friction and film, once.

    The texts are parsed from the comments of the scene's generated C; properties and options may be "".
    """
    laws: dict[tuple[str, str], dict[str, str]] = {}
    for comment in _COMMENT.findall(source.files.get("clearance.c", "")):
        if law_match := _LAW.match(" ".join(line.strip(" *") for line in comment.splitlines())):
            fields = law_match.groupdict("")
            fields["options"] = re.sub(
                r": (True|False)\b", lambda match: match[0].lower(), fields["options"]
            )  # as in YAML
            laws.setdefault((fields["title"], fields["options"]), fields)
    return list(laws.values())


def _list_validity_warnings(run: Result, joints: dict[str, dict[str, Any]]) -> list[str]:
    """Return a warning for each limit of validity that the run exceeds.

    Checked are: |δ̇/δ̇⁻| > 1 in contact, the limits of film laws, and work in no dissipated energy (more than
    UNASSIGNED_WORK_TOL of the joints' work). Other warnings are among the notes of the run.
    """
    diagnostics, warnings = run.diagnostics, []
    if diagnostics.ratio_outside:
        warnings.append(
            f"in {diagnostics.ratio_outside} steps in contact δ̇/δ̇⁻ was outside ±1,"
            f" {diagnostics.ratio_min:.3g} … {diagnostics.ratio_max:.3g}: damping laws are valid"
            " for free impacts without driving forces"
        )
    warnings += find_exceeded_limits(run)
    energy = _compute_energy_balance(run) or {}
    is_balance_complete = not run.source.rigid_joints  # the energy loss of rigid impacts is in no other term
    if is_balance_complete and abs(energy.get("not_told_apart", 0.0)) > UNASSIGNED_WORK_TOL * max(
        abs(energy.get("clearances", 0.0)), 1e-300
    ):
        warnings.append(
            f"{energy['not_told_apart']:.3g} J of the joints' work was dissipated neither by contact, friction nor"
            " the film's force: film shear, or contacts that the second pass did not resolve"
        )
    return warnings


def find_exceeded_limits(run: Result) -> list[str]:
    """Return a sentence for each limit of validity that a film of the run exceeds; an empty list without films."""
    return [note for joint in run.source.clearances if joint.film for note in _iterate_exceeded_limits(run, joint)]


def _iterate_exceeded_limits(run: Result, joint: ClearanceInfo) -> Iterator[str]:
    """Yield a warning for each limit that the film of a joint exceeds: L/D, eccentricity ratio, squeeze rate.

    Yields nothing if the film's law is not known.
    """
    law = _find_film_law(run.source, joint)
    if law is None:
        return
    low, high = law.limits.l_over_d
    length_ratio = _compute_length_ratio(run, joint)
    if not low <= length_ratio <= high:
        valid_range = (
            f"below {high:g}" if low == 0.0 else f"above {low:g}" if high == math.inf else f"{low:g} to {high:g}"
        )
        yield f"{joint.name}: L/D is {length_ratio:.3g}: {law.name} is valid for L/D {valid_range}"
    mean_clearance = joint.constants.get("mean_clearance", joint.clearance)  # of rough surfaces: their means
    film_clearance = float(run.p[joint.constants.get("film_clearance", mean_clearance)])
    eccentricity_ratios, max_ratio = (
        run[f"{joint.name}.e"] / film_clearance,
        run.diagnostics.peak(joint.name).e_max / film_clearance,
    )
    outside_fraction = float((eccentricity_ratios > law.limits.epsilon).mean())
    if max_ratio > law.limits.epsilon:
        location = f"at {100 * outside_fraction:.3g} % of the samples" if outside_fraction > 0.0 else "between samples"
        yield (
            f"{joint.name}: {location} ε is over {law.limits.epsilon:g}, beyond {law.name}; it reaches {max_ratio:.4g}"
        )
    fast_fraction = _compute_fast_squeeze_fraction(run, joint) if law.limits.slow_squeeze else 0.0
    if fast_fraction > 0.0:
        yield (
            f"{joint.name}: at {100 * fast_fraction:.3g} % of the samples on the film |ε̇| is over half the"
            f" surfaces' mean angular velocity: {law.name} is valid for |ω| ≫ |ε̇|"
        )


def _find_film_law(source: KernelSource, joint: ClearanceInfo) -> Law | None:
    """Return the law that the generated C of a joint's film calls; None if it is not known.

    The name is parsed from the function call in the C source. If several law names are prefixes of it, the longest is
    used.
    """
    from gudgeon.generator.kinds.laws.law import find_laws_of_role

    # without the "_": runs that were saved before names of a file ended in one
    function_text = re.search(
        rf" film_{re.escape(joint.name)}_?\(.*?\n}}", source.files.get("clearance.c", ""), re.DOTALL
    )
    call_match = function_text and re.search(r"^\s+(\w+)\(epsilon, w_n, w_t", function_text[0], re.MULTILINE)
    matching_laws = [
        law
        for law in find_laws_of_role("film").values()
        if call_match and f"{call_match[1]}_".startswith(f"{law.name}_")
    ]
    return max(matching_laws, key=lambda law: len(law.name), default=None)


def _compute_length_ratio(run: Result, joint: ClearanceInfo) -> float:
    """Return length over diameter of the journal of a joint with a film."""
    bearing_address = run.source.parameters[joint.constants["R_i"]].address.rpartition(".")[0]
    length = run.p[run.source.parameter_indices[f"{bearing_address}.length"]]
    return float(length / (2.0 * run.p[joint.constants["R_j"]]))


def _compute_fast_squeeze_fraction(run: Result, joint: ClearanceInfo) -> float:
    """Return the fraction of the samples on the film at which squeezing is fast.

    There |ε̇| is over MAX_SLOW_SQUEEZE times the mean rate of rotation of the surfaces. The fraction
    is 0 without samples on the film.
    """
    body_names = [run.source.bodies[body].name for body in (joint.first, joint.second) if body >= 0]
    mean_rate = 0.5 * np.abs(sum(run[f"{name}.omega"] for name in body_names))
    clearance = float(run.p[joint.clearance])
    is_on_film = run[f"{joint.name}.e"] < clearance
    is_fast = np.abs(run[f"{joint.name}.deltadot"]) / clearance > MAX_SLOW_SQUEEZE * mean_rate
    return float((is_fast & is_on_film).sum()) / max(int(is_on_film.sum()), 1)
