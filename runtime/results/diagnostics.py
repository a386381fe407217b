"""What a run says about itself: its size, its cost, how far it may be trusted, and where it comes from."""

from __future__ import annotations

import json
import math
import os
import platform
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from gudgeon.contract.audit import Finding
from gudgeon.errors import UnknownNameError
from gudgeon.language.wanted import told
from gudgeon.results.wear import Rubbed

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

PROVENANCE = ("version", "platform", "compiler", "date", "mechanism")


@dataclass(frozen=True)
class Peak:
    """The largest force at one joint with play, over all accepted steps (not only the stored samples)."""

    joint: str
    F: float  # N
    t: float  # s, of F
    e_max: float  # m, the largest eccentricity
    first_contact: float  # s, NaN: the surfaces never touched
    first_peak: float  # N, the peak force of the first contact; NaN: none


@dataclass(frozen=True)
class Extremes:
    """The largest and the smallest value of a series over all steps of a run; NaN where it never was a number."""

    name: str
    unit: str
    max: float
    t_max: float  # s
    min: float
    t_min: float  # s
    against: str = ""  # the scene whose series was subtracted; "": none

    @property
    def abs(self) -> float:
        """The largest magnitude."""
        return abs(self._furthest[0])

    @property
    def t_abs(self) -> float:
        """Its time, s."""
        return self._furthest[1]

    @property
    def _furthest(self) -> tuple[float, float]:
        return (self.min, self.t_min) if -self.min > self.max else (self.max, self.t_max)


@dataclass(frozen=True)
class JointExamined:
    """What a second pass through a joint's contacts found (simulation/examine.py); NaN: there was nothing of it."""

    joint: str
    impacting: float  # share of the time from an onset until the penetration first stops growing
    F_rms: float  # N, over all of the time
    taken: float  # J, by normal contact forces while the surfaces approached; NaN of surfaces that do not give
    returned: float  # J, by these while they parted; what is missing was damped
    friction: float  # J, taken by tangential contact forces
    film: float  # J, taken by the film
    separations: int
    restitution_min: float  # rate of parting over rate of approach, of contacts that ended
    restitution_q1: float
    restitution_median: float
    restitution_q3: float
    restitution_max: float


@dataclass(frozen=True)
class IdealForce:
    """The reaction at a joint of the ideal scene, at the samples of the run."""

    joint: str
    peak: float  # N
    t_peak: float  # s
    rms: float  # N


@dataclass(frozen=True)
class Difference:
    """How far a run is from one with smaller steps, over the samples up to `until`, the horizon if it is known."""

    name: str
    unit: str
    largest: float
    t: float  # s
    until: float  # s


@dataclass(frozen=True)
class Examined:
    """What other runs beside this one tell of it; empty: it could not be had, and `notes` say why."""

    joints: tuple[JointExamined, ...] = ()
    ideal: tuple[IdealForce, ...] = ()
    differences: tuple[Difference, ...] = ()
    compared_with: str = ""  # "steps half as long"
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Diagnostics:
    """Of one run; NaN stands for what the method does not have (the step of a kinematic scene)."""

    method: str
    step: float  # s, of a fixed step; NaN: the method chose it
    steps: int
    right_hand_sides: int
    onsets: int
    phi_max: float  # max |Φ| over all accepted steps, m or rad
    phi_dot_max: float  # max |Φ̇|, m/s or rad/s
    energy_residual: float  # max |T + V − T0 − V0 − (W − W0)| over the stored samples, J
    energy_turned_over: float  # J, what the residual is to be compared with
    ratio_min: float  # of δ̇/δ̇⁻ while latched
    ratio_max: float
    ratio_outside: int  # steps with the ratio outside [−1, 1]
    peaks: tuple[Peak, ...]  # in the order of the clearances
    seconds: float  # wall time of the integration
    seconds_per_simulated_second: float
    interrupted: bool = False
    notes: tuple[str, ...] = ()
    rtol: float = float("nan")  # of a method that chose its step
    rejected: int = 0  # steps tried and not taken
    stiff_steps: int = 0  # of the steps, those of the stiff method
    jacobians: int = 0
    last_step: float = float("nan")  # s, of a fixed step, where the last one up to t_end is shorter; NaN: it is not
    t_end: float = float("nan")  # s, up to which a run was to go that ended before; NaN: it went there
    horizon: float = float("nan")  # s, to which the trace can be trusted; inf: to the end, NaN: not asked
    extremes: tuple[Extremes, ...] = ()  # over all steps, of the series that `peaks` asked for
    examined: Examined | None = None  # by other runs, for a report; None: nobody asked
    audit: tuple[Finding, ...] = ()  # largest value of each check, as a multiple of its limit; empty: switched off
    rubbed: tuple[Rubbed, ...] = ()  # by all steps, of joints whose wear was asked for; no file has it

    def peak(self, joint: str) -> Peak:
        """The peak at a joint with play; UnknownNameError for any other."""
        for peak in self.peaks:
            if isinstance(joint, str) and peak.joint == joint:
                return peak
        known = ", ".join(peak.joint for peak in self.peaks) or "none"
        raise UnknownNameError(f"no peak of {told(joint)}: expected a joint with play", hint=f"there are: {known}")

    def to_json(self) -> str:
        """JSON without NaN or infinity (RFC 8259 has neither): they are the words "nan", "inf", "-inf".

        A float is written with as many digits as reading it back exactly needs.
        """
        data = asdict(replace(self, rubbed=()))
        for name in ("extremes", "examined", "audit", "rubbed"):
            if not data[name]:
                del data[name]
        return json.dumps(_words(data), ensure_ascii=False, allow_nan=False)

    @staticmethod
    def from_json(text: str) -> Diagnostics:
        """The diagnostics that `to_json` wrote, bit for bit."""
        data = json.loads(text)
        data.pop("grazes", None)  # of files from when rk4 looked at the ends of its steps alone
        data["peaks"] = tuple(Peak(**_numbers(peak, Peak)) for peak in data["peaks"])
        data["extremes"] = tuple(Extremes(**_numbers(one, Extremes)) for one in data.get("extremes", ()))
        data["audit"] = tuple(Finding(**_numbers(one, Finding)) for one in data.get("audit", ()))
        data["notes"] = tuple(data["notes"])
        data["examined"] = _examined(data["examined"]) if data.get("examined") else None
        return Diagnostics(**_numbers(data, Diagnostics))

    def __str__(self) -> str:
        lists = ("peaks", "notes", "extremes", "examined", "audit", "rubbed")
        rows = [f"{name:>30}  {value}" for name, value in asdict(replace(self, rubbed=())).items() if name not in lists]
        rows += [f"{'peak at ' + p.joint:>30}  {p.F:.6g} N at {p.t:.6g} s, e ≤ {p.e_max:.6g} m" for p in self.peaks]
        rows += [
            f"{'peaks of ' + x.name + ' against ' * bool(x.against) + x.against:>30}  {x.min:.6g} {x.unit} at"
            f" {x.t_min:.6g} s, {x.max:.6g} {x.unit} at {x.t_max:.6g} s"
            for x in self.extremes
        ]
        rows += [f"{'audit of ' + x.check:>30}  {x.worst:.3g} limits at {x.t:.6g} s {x.place}" for x in self.audit]
        return "\n".join([*rows, *(f"{'note':>30}  {note}" for note in self.notes)])


def extremes_to_json(extremes: tuple[Extremes, ...]) -> str:
    """Those of one run alone, as `Diagnostics.to_json` has them."""
    return json.dumps(_words([asdict(one) for one in extremes]), ensure_ascii=False, allow_nan=False)


def extremes_from_json(text: str) -> tuple[Extremes, ...]:
    """What `extremes_to_json` wrote, bit for bit."""
    return tuple(Extremes(**_numbers(one, Extremes)) for one in json.loads(text))


def _examined(data: dict[str, Any]) -> Examined:
    kinds = {"joints": JointExamined, "ideal": IdealForce, "differences": Difference}
    lists = {name: tuple(kind(**_numbers(one, kind)) for one in data[name]) for name, kind in kinds.items()}
    return Examined(**data | lists | {"notes": tuple(data["notes"])})


def _words(value: Any) -> Any:
    """Numbers that JSON lacks as words, at any depth."""
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    if isinstance(value, dict):
        return {key: _words(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_words(item) for item in value]
    return value.item() if hasattr(value, "item") else value  # a NumPy scalar


def _numbers(data: dict[str, Any], kind: type) -> dict[str, Any]:
    """The words of `_words` back to floats, where the field of `kind` is one."""
    floats = {name for name, annotation in kind.__annotations__.items() if annotation == "float"}
    return {key: float(value) if key in floats else value for key, value in data.items()}


def provenance_of(compiled: CompiledModel) -> dict[str, str]:
    """Return where a run that ends now comes from, by PROVENANCE; nothing is computed from it, no comparison reads it.

    `SOURCE_DATE_EPOCH` (s since 1970) in the environment replaces the date, so that runs repeat byte for byte.
    """
    from gudgeon import __version__

    system = platform.uname()
    where = f"{system.system} {system.release} {system.machine}, Python {platform.python_version()}"
    return dict(zip(PROVENANCE, (__version__, where, compiled.compiler, _date(), compiled.text), strict=True))


def _date() -> str:
    given = os.environ.get("SOURCE_DATE_EPOCH", "")
    now = datetime.fromtimestamp(int(given), UTC) if given.isdecimal() else datetime.now(UTC)
    return now.isoformat(timespec="seconds")
