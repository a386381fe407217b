"""The report of a run, `run.report()`: what its joints with play did, where energy went, how far it may be believed.

Everything is of what a result holds, so that one that was read from a file has the same report, bit for bit. What other
runs tell (simulation/examine.py) is there if it was asked for, and named as missing if not.
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
from gudgeon.results.peaks import of_samples
from gudgeon.results.reports.comparison import finite
from gudgeon.results.samples import with_start

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.kinds.laws.law import Law
    from gudgeon.results.results import Array, Result

SQUEEZE = 0.5  # of the mean rate of both surfaces: faster squeezing is not slow beside turning
OFF = 0.02  # of the joints' work: a quadrature that misses more of it is told
_COMMENT = re.compile(r"/\*\n(.*?)\n \*/", re.DOTALL)
_LAW = re.compile(
    r"(?P<title>.*?)\. Source: (?P<source>.*?)\. Valid: (?P<valid>.*?)\.(?: Options: (?P<options>.*?)\.)?(?: |$)"
)
NOT_ASKED = "not asked for: gudgeon run --report, or gudgeon.examine(simulation, run, ideal)"


@dataclass(frozen=True)
class RunReport:
    """The report of one run; `print` shows it, a notebook too, `to_html` is a page of its own."""

    run: Result

    @cached_property
    def _found(self) -> dict[str, Any]:
        run = with_start(self.run)
        joints = {joint.name: _joint(run, k, joint) for k, joint in enumerate(run.source.clearances)}
        return {
            "title": run.source.title,
            "mechanism": run.source.mechanism,
            "scene": run.source.scene,
            "t": [float(run.t[0]), float(run.t[-1])],
            "samples": len(self.run.t),
            "method": run.diagnostics.method,
            "joints": joints,
            "guides": {name: _guide(run, name) for name in run.source.guides},
            "energy": _energy(run),
            "trust": _trust(run),
            "laws": laws_of(run.source),
            "warnings": [*run.diagnostics.notes, *_warnings(run, joints)],
        }

    def to_dict(self) -> dict[str, Any]:
        """Plain values in SI, None where there is nothing: JSON takes them."""
        plain: dict[str, Any] = finite(self._found)
        return plain

    def to_html(self) -> str:
        """One page that needs nothing from elsewhere: tables, and each joint's orbit as SVG."""
        from gudgeon.results.reports.run_page import page_of

        return page_of(self.run, self._found)

    def _repr_html_(self) -> str:
        from gudgeon.results.reports.html_page import article
        from gudgeon.results.reports.run_page import sections

        return article(sections(self.run, self._found))

    def __str__(self) -> str:
        from gudgeon.results.reports.run_page import as_text

        return as_text(self._found)

    def __repr__(self) -> str:
        return f"<RunReport {self.run.source.mechanism}/{self.run.source.scene}>"


def _joint(run: Result, k: int, joint: ClearanceInfo) -> dict[str, Any]:
    """Of a joint with play; times, forces and places over all steps, shares of time from onsets and separations."""
    peak, c = run.diagnostics.peak(joint.name), float(run.p[joint.clearance])
    own = run.impacts[run.impacts["joint"] == k]
    examined, deepest = _examined(run, joint.name), peak.e_max - c
    between = float(run.p[joint.constants.get("mean_clearance", joint.clearance)])  # rough surfaces: their means
    if any(one.joint == joint.name for one in run.source.contours) and len(run.t):
        deepest = float(run[f"{joint.name}.delta"].max())  # at the samples: how deep it is hangs on where
    found = {
        "c": c,
        "corner": joint.at_wall,
        "time": _shares(run, k, joint, own),
        "contacts": len(own),
        "still_closed": int(np.isnan(own["t_off"]).sum()),
        "approach": _spread(own["deltadot"][own["deltadot"] > 0.0]),
        "restitution": None,
        "stiffness": _stiffness(run, joint),
        "asked": _asked(run, joint),
        "free_impact": _free_impact(run, joint),
        "peak": {"F": peak.F, "t": peak.t},
        "rms": _rms(run, joint.name),
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
        damping = examined.taken - examined.returned
        found["work"] = {
            "taken": examined.taken,
            "returned": examined.returned,
            "damping": damping,
            "friction": examined.friction,
            "film": examined.film,
        }
    return found | {"ideal": _ideal(run, joint.name)}


def _guide(run: Result, name: str) -> dict[str, Any]:
    """Force and moment on the slider of a guide with play, of samples."""
    force, moment = (of_samples("", "", run.t, run[f"{name}.{last}"]) for last in "FM")
    found = {"peak": {"F": force.peak, "t": force.t}, "rms": _rms(run, name), "M": {"peak": moment.peak, "t": moment.t}}
    return found | {"ideal": _ideal(run, name)}


def _ideal(run: Result, joint: str) -> dict[str, float] | None:
    for ideal in (run.diagnostics.examined or Examined()).ideal:
        if ideal.joint == joint:
            return {"F": ideal.peak, "t": ideal.t_peak, "rms": ideal.rms}
    return None


def _stiffness(run: Result, joint: ClearanceInfo) -> dict[str, Any] | None:
    """K of the elastic force as its law has it, with its unit; of a line contact and a spring by length."""
    for name in ("K", "spring"):
        if name in joint.constants:
            n = float(run.parameters.get(f"contacts.{_contact(run, joint)}.normal.exponent", 1.0))
            unit = "N/m" if name == "spring" or n == 1.0 else f"N/m^{n:g}"
            return {"K": float(run.p[joint.constants[name]]), "unit": unit}
    return None


def _contact(run: Result, joint: ClearanceInfo) -> str:
    """The contact whose normal law it has; "" where that is not known: what follows from its numbers bears its name."""
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


def _asked(run: Result, joint: ClearanceInfo) -> float | None:
    found = run.parameters.get(f"contacts.{_contact(run, joint)}.normal.restitution")
    return None if found is None else float(found)


def _free_impact(run: Result, joint: ClearanceInfo) -> float | None:
    """The restitution that its hysteresis damping delivers where nothing but the contact acts."""
    from gudgeon.generator.kinds.laws.dissipation import delivered

    return delivered(float(run.p[joint.constants["hysteresis"]])) if "hysteresis" in joint.constants else None


def _examined(run: Result, joint: str) -> Any:
    found = run.diagnostics.examined or Examined()
    return next((one for one in found.joints if one.joint == joint), None)


def _shares(run: Result, k: int, joint: ClearanceInfo, own: Array) -> dict[str, float]:
    """Of the time: free, impacting (from an onset until the penetration first stops growing), in contact, on a film.

    How long surfaces touch follows from onsets and separations; of it what is impact from a second pass, else samples.
    """
    begin, end = float(run.t[0]), float(run.t[-1])
    if not end > begin:
        return dict.fromkeys(("free", "impacting", "contact", "film"), math.nan)
    off = np.where(np.isnan(own["t_off"]), end, own["t_off"])
    touching = np.clip(off, begin, end) - np.clip(own["t_on"], begin, end)
    closed = float(touching.sum()) / (end - begin)
    examined = _examined(run, joint.name)
    if examined is not None and joint.dry:
        impacting = min(examined.impacting, closed)
    else:
        states = run.state[:, k]
        impacting = closed * float((states == 1).sum()) / max(int((states > 0).sum()), 1)
    apart = 1.0 - closed
    return {
        "free": 0.0 if joint.film else apart,
        "impacting": impacting,
        "contact": closed - impacting,
        "film": apart if joint.film else 0.0,
    }


def _spread(values: Array) -> dict[str, float] | None:
    if not len(values):
        return None
    low, middle, high = (float(x) for x in np.quantile(values, (0.0, 0.5, 1.0)))
    return {"min": low, "median": middle, "max": high}


def _rms(run: Result, joint: str) -> float:
    """Of the samples, by trapezoids."""
    force, span = run[f"{joint}.F"], float(run.t[-1] - run.t[0])
    return math.sqrt(float(np.trapezoid(force**2, run.t)) / span) if span > 0.0 else float(force[0])


def _energy(run: Result) -> dict[str, float] | None:
    """Works to the end and the balance, J; None of a scene that lacks masses."""
    if run.source.massless:
        return None
    d, names = run.diagnostics, ("drives", "forces", "clearances")
    found = {name: float(run.work[-1, k] - run.work[0, k]) for k, name in enumerate(names)}
    total = run["energy.kinetic"] + run["energy.potential"]
    found |= {"change": float(total[-1] - total[0]), "residual": d.energy_residual, "turned_over": d.energy_turned_over}
    joints = [_examined(run, joint.name) for joint in run.source.clearances]
    if joints and all(joints):
        parts = [x for one in joints for x in (one.taken - one.returned, one.friction, one.film) if math.isfinite(x)]
        found["not_told_apart"] = -found["clearances"] - math.fsum(parts)
    return found


def _trust(run: Result) -> dict[str, Any]:
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
    """Title, source, validity and options of each law of contact, friction and film, as its C says them."""
    found: dict[tuple[str, str], dict[str, str]] = {}
    for comment in _COMMENT.findall(source.files.get("clearance.c", "")):
        if law := _LAW.match(" ".join(line.strip(" *") for line in comment.splitlines())):
            told = law.groupdict("")
            told["options"] = re.sub(r": (True|False)\b", lambda flag: flag[0].lower(), told["options"])  # as in YAML
            found.setdefault((told["title"], told["options"]), told)
    return list(found.values())


def _warnings(run: Result, joints: dict[str, dict[str, Any]]) -> list[str]:
    """Where a run went beyond what its laws are good for; what it told itself is among its notes."""
    d, found = run.diagnostics, []
    if d.ratio_outside:
        found.append(
            f"in {d.ratio_outside} steps in contact δ̇/δ̇⁻ was outside ±1, {d.ratio_min:.3g} … {d.ratio_max:.3g}: damping"
            " laws are made for impacts that nothing drives on"
        )
    found += beyond(run)
    energy = _energy(run) or {}
    known = not run.source.rigid  # what blows take is told nowhere else
    if known and abs(energy.get("not_told_apart", 0.0)) > OFF * max(abs(energy.get("clearances", 0.0)), 1e-300):
        found.append(
            f"{energy['not_told_apart']:.3g} J of the joints' work is of neither contact, friction nor the film's"
            " force: its shear, or contacts that the second pass did not resolve"
        )
    return found


def beyond(run: Result) -> list[str]:
    """A sentence for each limit that a film of the run is beyond; none where no joint has a film."""
    return [note for joint in run.source.clearances if joint.film for note in _beyond(run, joint)]


def _beyond(run: Result, joint: ClearanceInfo) -> Iterator[str]:
    """Where a film's law says that it is good for less than it was asked; of a law that is not known nothing."""
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
    share = _squeezed(run, joint) if law.limits.slow_squeeze else 0.0
    if share > 0.0:
        yield (
            f"{joint.name}: at {100 * share:.3g} % of the samples on the film |ε̇| is over half the surfaces' mean"
            f" rate: {law.name} holds for |ω| ≫ |ε̇|"
        )


def _film_law(source: KernelSource, joint: ClearanceInfo) -> Law | None:
    """The law that the C of a joint's film calls."""
    from gudgeon.generator.kinds.laws.law import called

    # without the "_": runs that were saved before names of a file ended in one
    body = re.search(rf" film_{re.escape(joint.name)}_?\(.*?\n}}", source.files.get("clearance.c", ""), re.DOTALL)
    call = body and re.search(r"^\s+(\w+)\(epsilon, w_n, w_t", body[0], re.MULTILINE)
    fitting = [law for law in called("film").values() if call and f"{call[1]}_".startswith(f"{law.name}_")]
    return max(fitting, key=lambda law: len(law.name), default=None)


def _l_over_d(run: Result, joint: ClearanceInfo) -> float:
    """Length over diameter of the journal."""
    bearing = run.source.slots[joint.constants["R_i"]].address.rpartition(".")[0]
    length = run.p[run.source.place[f"{bearing}.length"]]
    return float(length / (2.0 * run.p[joint.constants["R_j"]]))


def _squeezed(run: Result, joint: ClearanceInfo) -> float:
    """Share of the samples on the film at which its squeezing is not slow beside its turning."""
    sides = [run.source.bodies[body].name for body in (joint.first, joint.second) if body >= 0]
    turning = 0.5 * np.abs(sum(run[f"{name}.omega"] for name in sides))
    c = float(run.p[joint.clearance])
    on_film = run[f"{joint.name}.e"] < c
    fast = np.abs(run[f"{joint.name}.deltadot"]) / c > SQUEEZE * turning
    return float((fast & on_film).sum()) / max(int(on_film.sum()), 1)
