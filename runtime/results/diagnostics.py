"""Define `Diagnostics`: size and cost of a run, peaks, measures of its accuracy, and its provenance."""

from __future__ import annotations

import json
import math
import os
import platform
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from functools import cache, lru_cache
from time import time
from typing import TYPE_CHECKING, Any

from gudgeon.contract.audit import Finding
from gudgeon.errors import UnknownNameError
from gudgeon.language.argument_checks import shorten_value
from gudgeon.results.wear import SlidingLoads

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

PROVENANCE = ("version", "platform", "compiler", "date", "mechanism")


@dataclass(frozen=True)
class Peak:
    """The largest force at one joint with play over all accepted steps, not only over the samples."""

    joint: str
    F: float  # N
    t: float  # s, of F
    e_max: float  # m, the largest eccentricity
    first_contact: float  # s, NaN: the surfaces never touched
    first_peak: float  # N, the peak force of the first contact; NaN: none


@dataclass(frozen=True)
class Extremes:
    """The largest and the smallest value of a series over all steps of a run; NaN if it never was a number."""

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
        return abs(self._largest_magnitude[0])

    @property
    def t_abs(self) -> float:
        """Time of the largest magnitude, s."""
        return self._largest_magnitude[1]

    @property
    def _largest_magnitude(self) -> tuple[float, float]:
        """Value and time (s) of the largest magnitude."""
        return (self.min, self.t_min) if -self.min > self.max else (self.max, self.t_max)


@dataclass(frozen=True)
class JointContactStatistics:
    """Statistics of a joint's contacts from a second pass through the run (simulation/examine.py).

    NaN: the joint has no such contacts.
    """

    joint: str
    impacting: float  # fraction of the time that lies between an onset and the first maximum of the penetration
    F_rms: float  # N, over all of the time
    used: float  # J, absorbed by normal contact forces during approach; NaN for rigid surfaces
    returned: float  # J, returned by normal contact forces during separation; the rest was damped
    friction: float  # J, dissipated by tangential contact forces
    film: float  # J, dissipated by the film
    separations: int
    restitution_min: float  # separation speed over approach speed, of contacts that ended
    restitution_q1: float
    restitution_median: float
    restitution_q3: float
    restitution_max: float


@dataclass(frozen=True)
class IdealForce:
    """Peak and rms of the reaction at a joint of the ideal scene, at the samples of the run."""

    joint: str
    peak: float  # N
    t_peak: float  # s
    rms: float  # N


@dataclass(frozen=True)
class Difference:
    """The largest difference of a series between a run and one with smaller steps.

    It is taken over the samples up to `until`, the predictability horizon if that is known.
    """

    name: str
    unit: str
    largest: float
    t: float  # s
    until: float  # s


@dataclass(frozen=True)
class Examination:
    """Results of additional runs for a report; empty where they failed, with the reason in `notes`."""

    joints: tuple[JointContactStatistics, ...] = ()
    ideal: tuple[IdealForce, ...] = ()
    differences: tuple[Difference, ...] = ()
    compared_with: str = ""  # "steps half as long"
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Diagnostics:
    """Counts, maxima, accuracy and cost of one run; NaN where the method has no such quantity, such as the step of a
    kinematic scene.
    """

    method: str
    step: float  # s, of a fixed step; NaN: the method chose it
    steps: int
    right_hand_sides: int
    onsets: int
    phi_max: float  # max |Φ| over all accepted steps, m or rad
    phi_dot_max: float  # max |Φ̇|, m/s or rad/s
    energy_residual: float  # max |T + V − T0 − V0 − (W − W0)| over the stored samples, J
    energy_turned_over: float  # J, energy throughput, the scale of the residual
    ratio_min: float  # smallest δ̇/δ̇⁻ in contacts
    ratio_max: float
    ratio_outside: int  # steps with the ratio outside [−1, 1]
    peaks: tuple[Peak, ...]  # in the order of the clearances
    seconds: float  # wall time of the integration
    seconds_per_simulated_second: float
    interrupted: bool = False
    notes: tuple[str, ...] = ()
    rtol: float = float("nan")  # relative tolerance of a method with step-size control
    rejected: int = 0  # rejected steps
    stiff_steps: int = 0  # steps of the stiff method, which `steps` includes
    jacobians: int = 0
    last_step: float = float("nan")  # s, last step of a fixed-step run if it is shorter; NaN: it is not
    t_end: float = float("nan")  # s, requested end of a run that ended before; NaN: it reached its end
    horizon: float = float("nan")  # s, predictability horizon; inf: beyond the end, NaN: not requested
    extremes: tuple[Extremes, ...] = ()  # over all steps, of the series in `peaks`
    examined: Examination | None = None  # results of additional runs, for a report; None: not requested
    audit: tuple[Finding, ...] = ()  # largest value of each check, as a multiple of its limit; empty: switched off
    sliding_loads: tuple[SlidingLoads, ...] = ()  # over all steps, of joints whose wear was requested; not saved

    def peak(self, joint: str) -> Peak:
        """Return the largest force at a joint with play over all steps, with time, eccentricity and first contact.

        Raises UnknownNameError for any other name.
        """
        for peak in self.peaks:
            if isinstance(joint, str) and peak.joint == joint:
                return peak
        joint_names = ", ".join(peak.joint for peak in self.peaks) or "none"
        raise UnknownNameError(
            f"no peak of {shorten_value(joint)}: expected a joint with play", hint=f"there are: {joint_names}"
        )

    def to_json(self) -> str:
        """Return the diagnostics as JSON without NaN or infinity, which RFC 8259 lacks: they are the words "nan",
        "inf", "-inf".

        A float has as many digits as an exact reading needs. `extremes`, `examined` and `audit` are left out if they
        are empty; `sliding_loads` is always left out.
        """
        data = asdict(replace(self, sliding_loads=()))
        del data["sliding_loads"]
        for name in ("extremes", "examined", "audit"):
            if not data[name]:
                del data[name]
        return json.dumps(_convert_to_json_values(data), ensure_ascii=False, allow_nan=False)

    @staticmethod
    def from_json(text: str) -> Diagnostics:
        """Return the diagnostics from the text that `to_json` wrote, bit for bit.

        Fields that older files lack get their defaults; the former field "grazes" is ignored.
        """
        data = json.loads(text)
        data.pop("grazes", None)  # in older files, whose rk4 evaluated contacts at the ends of steps only
        data["peaks"] = tuple(Peak(**_convert_to_floats(peak, Peak)) for peak in data["peaks"])
        data["extremes"] = tuple(
            Extremes(**_convert_to_floats(fields, Extremes)) for fields in data.get("extremes", ())
        )
        data["audit"] = tuple(Finding(**_convert_to_floats(fields, Finding)) for fields in data.get("audit", ()))
        data["notes"] = tuple(data["notes"])
        data["examined"] = _read_examination_json(data["examined"]) if data.get("examined") else None
        return Diagnostics(**_convert_to_floats(data, Diagnostics))

    def __str__(self) -> str:
        """Return the diagnostics as aligned lines, one for each quantity, peak, series and note."""
        lists = ("peaks", "notes", "extremes", "examined", "audit", "sliding_loads")
        lines = [
            f"{name:>30}  {value}"
            for name, value in asdict(replace(self, sliding_loads=())).items()
            if name not in lists
        ]
        lines += [f"{'peak at ' + p.joint:>30}  {p.F:.6g} N at {p.t:.6g} s, e ≤ {p.e_max:.6g} m" for p in self.peaks]
        lines += [
            f"{'peaks of ' + x.name + ' against ' * bool(x.against) + x.against:>30}  {x.min:.6g} {x.unit} at"
            f" {x.t_min:.6g} s, {x.max:.6g} {x.unit} at {x.t_max:.6g} s"
            for x in self.extremes
        ]
        lines += [f"{'audit of ' + x.check:>30}  {x.worst:.3g} limits at {x.t:.6g} s {x.place}" for x in self.audit]
        return "\n".join([*lines, *(f"{'note':>30}  {note}" for note in self.notes)])


def convert_extremes_to_json(extremes: tuple[Extremes, ...]) -> str:
    """Return the extremes of one run as JSON, in the form of `Diagnostics.to_json`."""
    return json.dumps(
        _convert_to_json_values([asdict(series_extremes) for series_extremes in extremes]),
        ensure_ascii=False,
        allow_nan=False,
    )


def convert_extremes_from_json(text: str) -> tuple[Extremes, ...]:
    """Return the extremes from the text that `convert_extremes_to_json` wrote, bit for bit."""
    return tuple(Extremes(**_convert_to_floats(fields, Extremes)) for fields in json.loads(text))


def _read_examination_json(data: dict[str, Any]) -> Examination:
    """Return the Examination from its part of the parsed JSON of `Diagnostics.to_json`; words become floats."""
    classes = {"joints": JointContactStatistics, "ideal": IdealForce, "differences": Difference}
    records = {
        name: tuple(cls(**_convert_to_floats(fields, cls)) for fields in data[name]) for name, cls in classes.items()
    }
    return Examination(**data | records | {"notes": tuple(data["notes"])})


def _convert_to_json_values(value: Any) -> Any:
    """Return a value with NaN and infinities replaced by "nan", "inf", "-inf", at any depth of lists and dicts.

    Tuples become lists, NumPy scalars Python numbers; other values are returned as they are.
    """
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    if isinstance(value, dict):
        return {key: _convert_to_json_values(element) for key, element in value.items()}
    if isinstance(value, (list, tuple)):
        return [_convert_to_json_values(element) for element in value]
    return value.item() if hasattr(value, "item") else value  # a NumPy scalar


def _convert_to_floats(data: dict[str, Any], cls: type) -> dict[str, Any]:
    """Return the fields of a dataclass with the words of `_convert_to_json_values` converted back to floats.

    Only fields that `cls` declares as float are converted.
    """
    float_fields = {name for name, annotation in cls.__annotations__.items() if annotation == "float"}
    return {key: float(value) if key in float_fields else value for key, value in data.items()}


def collect_provenance(compiled: CompiledModel, seconds: float) -> dict[str, str]:
    """Return version, platform, compiler, date and mechanism text of a run, by the keys of PROVENANCE.

    `seconds` is the date of the run from `get_run_date`, in s since 1970. Nothing is computed from the provenance.
    """
    from gudgeon import __version__

    platform_text = _format_platform()
    return dict(
        zip(
            PROVENANCE,
            (__version__, platform_text, compiled.compiler, _format_seconds(int(seconds)), compiled.text),
            strict=True,
        )
    )


@cache
def _format_platform() -> str:
    """Return operating system, release, processor and Python version: "Linux 6.1 x86_64, Python 3.12.3"; cached."""
    system = platform.uname()
    return f"{system.system} {system.release} {system.machine}, Python {platform.python_version()}"


def get_run_date() -> float:
    """Return the current time, or that of SOURCE_DATE_EPOCH in the environment, in s since 1970.

    With SOURCE_DATE_EPOCH, files of the same run are equal byte for byte.
    """
    epoch_text = os.environ.get("SOURCE_DATE_EPOCH", "")
    return float(epoch_text) if epoch_text.isdecimal() else time()


@lru_cache(maxsize=1)
def _format_seconds(seconds: int) -> str:
    """Return the date and time in UTC, ISO 8601, of a time in seconds since 1970."""
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="seconds")
