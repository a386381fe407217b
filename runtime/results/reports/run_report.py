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

from gudgeon.results.diagnostics import Examined
from gudgeon.results.peaks import sample_extreme
from gudgeon.results.reports.comparison import replace_non_finite
from gudgeon.results.samples import with_start

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.kinds.laws.law import Law
    from gudgeon.results.results import Array, Result

SQUEEZE = 0.5  # largest |ε̇| over the surfaces' mean rate that counts as slow squeezing
OFF = 0.02  # fraction of the joints' work; a quadrature that misses more is reported
_COMMENT = re.compile(r"/\*\n(.*?)\n \*/", re.DOTALL)
_LAW = re.compile(
    r"(?P<title>.*?)\. (?:.*? )??Source: (?P<source>.*?)\. Valid: (?P<valid>.*?)\."
    r"(?: Options: (?P<options>.*?)\.)?(?: |$)"
)
NOT_ASKED = "not asked for: gudgeon run --report, or gudgeon.examine(simulation, run, ideal)"


@dataclass(frozen=True)
class RunReport:
    """The report of one run; `print` and notebooks display it, `to_html` is a self-contained page."""

    run: Result

    @cached_property
    def _found(self) -> dict[str, Any]:
        """All values of the report, in SI."""
        run = with_start(self.run)
        joints = {joint.name: _joint_values(run, k, joint) for k, joint in enumerate(run.source.clearances)}
        return {
            "title": run.source.title,
            "mechanism": run.source.mechanism,
            "scene": run.source.scene,
            "t": [float(run.t[0]), float(run.t[-1])],
            "samples": len(self.run.t),
            "method": run.diagnostics.method,
            "joints": joints,
            "guides": {name: _guide_values(run, name) for name in run.source.guides},
            "energy": _energy_balance(run),
            "trust": _accuracy_values(run),
            "laws": laws_of(run.source),
            "warnings": [*run.diagnostics.notes, *_validity_warnings(run, joints)],
        }

    def to_dict(self) -> dict[str, Any]:
        """Return plain values in SI for JSON, None where there is no value."""
        plain: dict[str, Any] = replace_non_finite(self._found)
        return plain

    def to_html(self) -> str:
        """Return a self-contained HTML page with tables, and each joint's orbit as SVG."""
        from gudgeon.results.reports.run_page import page_of

        return page_of(self.run, self._found)

    def _repr_html_(self) -> str:
        """Return the report as HTML for a notebook."""
        from gudgeon.results.reports.html_page import article
        from gudgeon.results.reports.run_page import sections

        return article(sections(self.run, self._found))

    def __str__(self) -> str:
        """Return the report as text."""
        from gudgeon.results.reports.run_page import as_text

        return as_text(self._found)

    def __repr__(self) -> str:
        """Return mechanism and scene in one line."""
        return f"<RunReport {self.run.source.mechanism}/{self.run.source.scene}>"


def _joint_values(run: Result, k: int, joint: ClearanceInfo) -> dict[str, Any]:
    """Return the values of a joint with play.

    Times, forces and positions are over all steps, fractions of time from onsets and separations.
    """
    peak, c = run.diagnostics.peak(joint.name), float(run.p[joint.clearance])
    impacts = run.impacts[run.impacts["joint"] == k]
    examined, deepest = _joint_statistics(run, joint.name), peak.e_max - c
    between = float(run.p[joint.constants.get("mean_clearance", joint.clearance)])  # rough surfaces: their means
    if any(one.joint == joint.name for one in run.source.contours) and len(run.t):
        deepest = float(run[f"{joint.name}.delta"].max())  # at the samples, since the depth depends on the angle
    found = {
        "c": c,
        "corner": joint.at_wall,
        "time": _time_fractions(run, k, joint, impacts),
        "contacts": len(impacts),
        "still_closed": int(np.isnan(impacts["t_off"]).sum()),
        "approach": _quantiles(impacts["deltadot"][impacts["deltadot"] > 0.0]),
        "restitution": None,
        "stiffness": _stiffness(run, joint),
        "asked": _specified_restitution(run, joint),
        "free_impact": _free_impact(run, joint),
        "peak": {"F": peak.F, "t": peak.t},
        "rms": _rms_force(run, joint.name),
        "rms_of": "samples",
        "largest_e": peak.e_max,
        "penetration": max(deepest, 0.0) if joint.dry else math.nan,
        "penetration_share": max(deepest, 0.0) / c if joint.dry else math.nan,
        "film_least": max(between - peak.e_max, 0.0) if joint.film else math.nan,
        "work": None,
    }
    if examined is not None:
        names = ("min", "q1", "median", "q3", "max")
        found["restitution"] = {name: getattr(examined, f"restitution_{name}") for name in names}
        found |= {"rms": examined.F_rms, "rms_of": "all of the time"}
        damping = examined.used - examined.returned
        found["work"] = {
            "taken": examined.used,
            "returned": examined.returned,
            "damping": damping,
            "friction": examined.friction,
            "film": examined.film,
        }
    return found | {"ideal": _ideal_force(run, joint.name)}


def _guide_values(run: Result, name: str) -> dict[str, Any]:
    """Return force and moment on the slider of a guide with play, at the samples."""
    force, moment = (sample_extreme("", "", run.t, run[f"{name}.{last}"]) for last in "FM")
    found = {
        "peak": {"F": force.peak, "t": force.t},
        "rms": _rms_force(run, name),
        "M": {"peak": moment.peak, "t": moment.t},
    }
    return found | {"ideal": _ideal_force(run, name)}


def _ideal_force(run: Result, joint: str) -> dict[str, float] | None:
    """Return peak and rms of the force at a joint of the ideal scene; None if they were not requested."""
    for ideal in (run.diagnostics.examined or Examined()).ideal:
        if ideal.joint == joint:
            return {"F": ideal.peak, "t": ideal.t_peak, "rms": ideal.rms}
    return None


def _stiffness(run: Result, joint: ClearanceInfo) -> dict[str, Any] | None:
    """Return the stiffness K of the contact law with its unit, which depends on the law; None without one."""
    for name in ("K", "spring"):
        if name in joint.constants:
            n = float(run.parameters.get(f"contacts.{_contact_name(run, joint)}.normal.exponent", 1.0))
            unit = "N/m" if name == "spring" or n == 1.0 else f"N/m^{n:g}"
            return {"K": float(run.p[joint.constants[name]]), "unit": unit}
    return None


def _contact_name(run: Result, joint: ClearanceInfo) -> str:
    """Return the name of the contact whose normal law a joint has; "" if it is not known.

    Derived parameters of a law contain the name of its contact.
    """
    source = run.source
    named = [address.split(".")[1] for slot in source.slots if ".normal." in (address := slot.address)]
    bearing = source.slots[joint.clearance].address.split(".")[1]
    for name, place in joint.constants.items():
        if (k := place - len(source.slots)) >= 0:
            own = {contact: re.sub("_+", "_", f"{contact}_{bearing}_{name}") for contact in named}
            fits = [contact for contact in named if source.derived[k] == own[contact]]
            if fits:
                return fits[0]
    return named[0] if len({*named}) == 1 and len({joint.joint for joint in source.clearances}) == 1 else ""


def _specified_restitution(run: Result, joint: ClearanceInfo) -> float | None:
    """Return the specified coefficient of restitution of a joint's contact, if there is one."""
    found = run.parameters.get(f"contacts.{_contact_name(run, joint)}.normal.restitution")
    return None if found is None else float(found)


def _free_impact(run: Result, joint: ClearanceInfo) -> float | None:
    """Return the restitution that the hysteresis damping delivers in an impact without other forces; None without such
    damping.
    """
    from gudgeon.generator.kinds.laws.dissipation import delivered

    return delivered(float(run.p[joint.constants["hysteresis"]])) if "hysteresis" in joint.constants else None


def _joint_statistics(run: Result, joint: str) -> Any:
    """Return the contact statistics of a joint from the second pass; None if they were not requested."""
    found = run.diagnostics.examined or Examined()
    return next((one for one in found.joints if one.joint == joint), None)


def _time_fractions(run: Result, k: int, joint: ClearanceInfo, impacts: Array) -> dict[str, float]:
    """Return the fractions of the time: free, impacting (from an onset until the first maximum of δ), in contact, on a
    film.

    The time in contact follows from onsets and separations. Its impacting part is from the second pass, else from
    samples.
    """
    begin, end = float(run.t[0]), float(run.t[-1])
    if not end > begin:
        return dict.fromkeys(("free", "impacting", "contact", "film"), math.nan)
    off = np.where(np.isnan(impacts["t_off"]), end, impacts["t_off"])
    touching = np.clip(off, begin, end) - np.clip(impacts["t_on"], begin, end)
    closed = float(touching.sum()) / (end - begin)
    examined = _joint_statistics(run, joint.name)
    if examined is not None and joint.dry:
        impacting = min(examined.impacting, closed)
    else:
        states = run.state[:, k]
        impacting = closed * float((states == 1).sum()) / max(int((states > 0).sum()), 1)
    open_fraction = 1.0 - closed
    return {
        "free": 0.0 if joint.film else open_fraction,
        "impacting": impacting,
        "contact": closed - impacting,
        "film": open_fraction if joint.film else 0.0,
    }


def _quantiles(values: Array) -> dict[str, float] | None:
    """Return minimum, median and maximum of the values; None for none."""
    if not len(values):
        return None
    low, middle, high = (float(x) for x in np.quantile(values, (0.0, 0.5, 1.0)))
    return {"min": low, "median": middle, "max": high}


def _rms_force(run: Result, joint: str) -> float:
    """Return the rms force of a joint over the samples, by the trapezoidal rule."""
    force, span = run[f"{joint}.F"], float(run.t[-1] - run.t[0])
    return math.sqrt(float(np.trapezoid(force**2, run.t)) / span) if span > 0.0 else float(force[0])


def _energy_balance(run: Result) -> dict[str, float] | None:
    """Return the works up to the end and the terms of the energy balance, J; None for a scene without masses."""
    if run.source.massless:
        return None
    d, names = run.diagnostics, ("drives", "forces", "clearances")
    found = {name: float(run.work[-1, k] - run.work[0, k]) for k, name in enumerate(names)}
    total = run["energy.kinetic"] + run["energy.potential"]
    found |= {"change": float(total[-1] - total[0]), "residual": d.energy_residual, "turned_over": d.energy_turned_over}
    joints = [_joint_statistics(run, joint.name) for joint in run.source.clearances]
    if joints and all(joints):
        parts = [x for one in joints for x in (one.used - one.returned, one.friction, one.film) if math.isfinite(x)]
        found["not_told_apart"] = -found["clearances"] - math.fsum(parts)
    return found


def _accuracy_values(run: Result) -> dict[str, Any]:
    """Return the values of the accuracy of a run."""
    d, examined = run.diagnostics, run.diagnostics.examined or Examined()
    horizon: Any = "to the end" if d.horizon == math.inf else d.horizon
    return {
        "phi_max": d.phi_max,
        "phi_dot_max": d.phi_dot_max,
        "horizon": horizon,
        "steps": d.steps,
        "rtol": d.rtol,
        "step": d.step,
        "compared_with": examined.compared_with,
        "interrupted": d.interrupted,
        "differences": [asdict(one) for one in examined.differences],
        "notes": list(examined.notes),
        "asked": d.examined is not None,
    }


def laws_of(source: KernelSource) -> list[dict[str, str]]:
    """Return title, source, validity and options of each law of contact, friction and film, from the comments of
    its C.
    """
    found: dict[tuple[str, str], dict[str, str]] = {}
    for comment in _COMMENT.findall(source.files.get("clearance.c", "")):
        if law := _LAW.match(" ".join(line.strip(" *") for line in comment.splitlines())):
            fields = law.groupdict("")
            fields["options"] = re.sub(
                r": (True|False)\b", lambda flag: flag[0].lower(), fields["options"]
            )  # as in YAML
            found.setdefault((fields["title"], fields["options"]), fields)
    return list(found.values())


def _validity_warnings(run: Result, joints: dict[str, dict[str, Any]]) -> list[str]:
    """Return sentences for runs beyond the validity of their laws; other warnings are among the notes of the run."""
    d, found = run.diagnostics, []
    if d.ratio_outside:
        found.append(
            f"in {d.ratio_outside} steps in contact δ̇/δ̇⁻ was outside ±1, {d.ratio_min:.3g} … {d.ratio_max:.3g}: damping"
            " laws are made for impacts that nothing drives on"
        )
    found += beyond(run)
    energy = _energy_balance(run) or {}
    known = not run.source.rigid  # the energy loss of rigid impacts is in no other term
    if known and abs(energy.get("not_told_apart", 0.0)) > OFF * max(abs(energy.get("clearances", 0.0)), 1e-300):
        found.append(
            f"{energy['not_told_apart']:.3g} J of the joints' work is of neither contact, friction nor the film's"
            " force: its shear, or contacts that the second pass did not resolve"
        )
    return found


def beyond(run: Result) -> list[str]:
    """Return a sentence for each limit of validity that a film of the run exceeds; empty without films."""
    return [note for joint in run.source.clearances if joint.film for note in _exceeded_limits(run, joint)]


def _exceeded_limits(run: Result, joint: ClearanceInfo) -> Iterator[str]:
    """Yield a sentence for each limit that the film of a joint exceeds; nothing for an unknown law."""
    law = _film_law(run.source, joint)
    if law is None:
        return
    low, high = law.limits.l_over_d
    ratio = _l_over_d(run, joint)
    if not low <= ratio <= high:
        good = f"below {high:g}" if low == 0.0 else f"above {low:g}" if high == math.inf else f"{low:g} to {high:g}"
        yield f"{joint.name}: L/D is {ratio:.3g}: {law.name} is good for L/D {good}"
    between = joint.constants.get("mean_clearance", joint.clearance)  # of rough surfaces: their means
    c = float(run.p[joint.constants.get("film_clearance", between)])
    epsilon, most = run[f"{joint.name}.e"] / c, run.diagnostics.peak(joint.name).e_max / c
    deep = float((epsilon > law.limits.epsilon).mean())
    if most > law.limits.epsilon:
        where = f"at {100 * deep:.3g} % of the samples" if deep > 0.0 else "between samples"
        yield f"{joint.name}: {where} ε is over {law.limits.epsilon:g}, beyond {law.name}; it reaches {most:.4g}"
    fraction = _fast_squeeze_fraction(run, joint) if law.limits.slow_squeeze else 0.0
    if fraction > 0.0:
        yield (
            f"{joint.name}: at {100 * fraction:.3g} % of the samples on the film |ε̇| is over half the surfaces' mean"
            f" rate: {law.name} holds for |ω| ≫ |ε̇|"
        )


def _film_law(source: KernelSource, joint: ClearanceInfo) -> Law | None:
    """Return the law that the C of a joint's film calls; None if it is not known."""
    from gudgeon.generator.kinds.laws.law import called

    # without the "_": runs that were saved before names of a file ended in one
    body = re.search(rf" film_{re.escape(joint.name)}_?\(.*?\n}}", source.files.get("clearance.c", ""), re.DOTALL)
    call = body and re.search(r"^\s+(\w+)\(epsilon, w_n, w_t", body[0], re.MULTILINE)
    fitting = [law for law in called("film").values() if call and f"{call[1]}_".startswith(f"{law.name}_")]
    return max(fitting, key=lambda law: len(law.name), default=None)


def _l_over_d(run: Result, joint: ClearanceInfo) -> float:
    """Return length over diameter of the journal."""
    bearing = run.source.slots[joint.constants["R_i"]].address.rpartition(".")[0]
    length = run.p[run.source.place[f"{bearing}.length"]]
    return float(length / (2.0 * run.p[joint.constants["R_j"]]))


def _fast_squeeze_fraction(run: Result, joint: ClearanceInfo) -> float:
    """Return the fraction of the samples on the film at which |ε̇| is not small next to the mean rotation of the
    surfaces.
    """
    sides = [run.source.bodies[body].name for body in (joint.first, joint.second) if body >= 0]
    turning = 0.5 * np.abs(sum(run[f"{name}.omega"] for name in sides))
    c = float(run.p[joint.clearance])
    on_film = run[f"{joint.name}.e"] < c
    fast = np.abs(run[f"{joint.name}.deltadot"]) / c > SQUEEZE * turning
    return float((fast & on_film).sum()) / max(int(on_film.sum()), 1)
