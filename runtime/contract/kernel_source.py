"""What the generator hands to the runtime: C text and the names of everything in it.

Nothing else crosses. Stored as JSON: a warm start needs neither SymPy nor Jinja. Numbers are SI, indices from 0.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, asdict, dataclass, field, fields
from functools import cached_property
from hashlib import sha256
from typing import Any

from gudgeon.contract.clearance_info import ClearanceInfo, ContourInfo
from gudgeon.contract.ledger import Story
from gudgeon.contract.methods import INTEGRATORS, KINEMATIC, NEED_SLOPES, STAGED
from gudgeon.contract.stored import as_text, complete, shorten, tuples

HEADER = "model.h"
ENGINE_ENDS = "/* The engine reads no further: scenes that have all this in common share its code. */"
MAIN = "scene.c"  # what is compiled of a scene's files, beside the engine
ENGINE_PART = 0  # what is compiled side by side: the engine, and MAIN in parts
GIVEN = 1.001  # times a parameter's default
GIVEN_ZERO = 0.001  # where that is zero


@dataclass(frozen=True)
class Slot:
    """A run-time number: `given[i]` of the C function `prepare`."""

    address: str  # "bodies.L2.mass", "parameters.omega"
    unit: str  # SI, "kg*m^2"; "" for a pure number
    default: float  # its value when nothing is overridden
    follows: bool  # an expression of other parameters: it follows them unless overridden itself
    dimension: tuple[float, float, float]  # exponents of m, kg, s: whole, or halves
    words: tuple[str, ...] = ()  # of a choice: what its number, 0, 1, …, stands for
    tree: str = ""  # as it is written, JSON, where that may be undefined for some parameters


@dataclass(frozen=True)
class Condition:
    """What a slot must satisfy; `bound` is a number, another slot's address, or several: "a + b" is their sum."""

    address: str
    relation: str
    bound: float | str
    message: str

    @property
    def addresses(self) -> tuple[str, ...]:
        """The slots whose sum is the bound; none of a number."""
        return tuple(self.bound.split(" + ")) if isinstance(self.bound, str) else ()


@dataclass(frozen=True)
class BodyInfo:
    """`index` of x in q; y and theta follow it."""

    name: str
    index: int


@dataclass(frozen=True)
class PointInfo:
    """A point in its body's centre-of-mass frame: (sign_x p[x], sign_y p[y]); an index −1 is a zero."""

    name: str  # "L1.head"
    body: int  # index into bodies; −1: ground
    x: int
    y: int
    sign_x: int = 1
    sign_y: int = 1


@dataclass(frozen=True)
class RowInfo:
    """A row of Φ (and its multiplier): "A.x" belongs to joint A."""

    name: str
    owner: str  # joint or drive
    kind: str  # "joint" or "drive"
    unit: str  # of the row: "m" or "rad"


@dataclass(frozen=True)
class JointInfo:
    """A joint that is kept as a constraint; the reaction on the second body is given at `point`."""

    name: str
    kind: str
    first: int  # body index, −1: ground
    second: int
    point: str  # of the second body, or of the first where the joint's type says so
    rows: tuple[int, ...]


@dataclass(frozen=True)
class DriveInfo:
    """Its row (−1: redundant, left out); the row's unit tells a torque ("rad") from a force ("m")."""

    name: str
    row: int
    unit: str


@dataclass(frozen=True)
class SeriesInfo:
    """A result of a force element, such as "coil.F"."""

    name: str
    unit: str


@dataclass(frozen=True)
class WrittenInfo:
    """An expression of t or motion, or of a scene's `simulate`, as JSON; or a 0 that is written or left out."""

    address: str  # "drives.crank.value"
    tree: str
    line: int
    column: int


@dataclass(frozen=True)
class EventInfo:
    """An event of the user: action "record" or "stop", direction "rising", "falling" or "both"."""

    name: str
    action: str
    direction: str


@dataclass(frozen=True)
class PartInfo:
    """A joint, drive or force element as the file has it, for who draws it; its numbers are slots by their addresses.

    `ends` are points, "L1.head", in the file's order. Of what joins bodies or moves one they are centres of mass,
    "L1.com", and "ground." is the ground.
    """

    section: str  # "joints", "drives" or "forces"
    name: str
    kind: str  # "revolute", "angle", "spring_damper", …
    ends: tuple[str, ...]
    options: Mapping[str, str]  # words: {"carrier": "L3", "internal": "true"}, of a drive {"coordinate": "y"}


@dataclass(frozen=True)
class KernelSource:
    """A compiled-to-be scene. `files` are C texts by name; `main` is the one to compile."""

    mechanism: str
    scene: str
    title: str
    sha256: str  # of the YAML bytes
    files: Mapping[str, str]
    main: str
    coordinates: tuple[str, ...]  # "L1.x", "L1.y", "L1.theta", …
    bodies: tuple[BodyInfo, ...]
    points: tuple[PointInfo, ...]
    rows: tuple[RowInfo, ...]
    joints: tuple[JointInfo, ...]
    drives: tuple[DriveInfo, ...]
    clearances: tuple[ClearanceInfo, ...]
    series: tuple[SeriesInfo, ...]
    start_rows: tuple[RowInfo, ...]  # of the start's Φ: joints with play are closed there
    start_guess: tuple[str, ...]  # coordinates in the order of the C function `start_values`
    start_set: tuple[str, ...]
    start_rates: tuple[str, ...]  # "L1.omega"
    frictions: tuple[str, ...]  # force elements that may stick
    pivots: tuple[str, ...]  # rows in their order of elimination: a status k > 0 names pivots[k − 1]
    start_pivots: tuple[str, ...]  # the same for the kinematic method's projection
    rate_jumps: tuple[str, ...]  # drives whose rate may jump: the linkage follows by an impulse
    indeterminate: tuple[str, ...]  # joints and drives whose multipliers redundancy leaves open
    slots: tuple[Slot, ...]
    derived: tuple[str, ...]  # names of the prepared numbers that follow the slots in p
    conditions: tuple[Condition, ...]
    outputs: Mapping[str, Any]  # name -> expression tree as nested lists
    simulate: Mapping[str, float]  # the scene's own t_end, step, output, if given
    operations: Mapping[str, int]  # kernel -> operation count
    notes: tuple[str, ...]  # what was skipped and why (check -v)
    gravity: bool
    formulation: str = "full"  # what is integrated: "reduced" or "full"
    motion_pivots: tuple[str, ...] = ()  # as pivots, of what is integrated
    tree: tuple[str, ...] = ()  # coordinates of the reduced formulation: "L7" (an angle), "guide.slide", "L3.x"
    closures: tuple[str, ...] = ()  # its rows
    chain: tuple[str, ...] = ()  # coordinates that drives determine through loops: they are evaluated, not integrated
    chain_rows: tuple[str, ...] = ()  # the rows of these loops
    events: tuple[EventInfo, ...] = ()
    story: Story = Story()  # how the equations became what is integrated (check -v)
    written: tuple[WrittenInfo, ...] = ()
    expressions: tuple[WrittenInfo, ...] = ()  # that the file has by name, and uses by it here too
    lines: tuple[tuple[str, int], ...] = ()  # of the file, where joints and drives are
    states: tuple[str, ...] = ()  # inner states of laws, "A.z", as many a joint with play; "": none
    units: tuple[int, ...] = ()  # in which `main` is compiled, side by side, as PART in C counts them; none: whole
    taylor: str = ""  # the file with the series of the motion, of a library with Taylor's method; "": it has none
    stages: bool = False  # whether it has the matrices of methods whose stages are found together
    lanes: str = ""  # the file to compile for runs side by side; "": there is none
    cdef: str = ""  # what `main` declares where it is compiled alone; "": with the engine, by the engine's calls
    overrides: tuple[tuple[str, str | float | bool], ...] = ()  # of the file: (address, value), sorted (load)
    simulate_written: tuple[WrittenInfo, ...] = ()  # of `simulate`, what follows parameters: its value is the default
    tables: tuple[tuple[str, str], ...] = ()  # files beside the YAML that curves were read from, and their sha256
    laws: tuple[tuple[str, str], ...] = ()  # of the user's own, and what they said (kinds/laws/registered.py)

    @property
    def beside(self) -> tuple[tuple[str, str], ...]:
        """What the file's text does not hold itself, tables and laws of the user's own, and their SHA-256."""
        return (*self.tables, *self.laws)

    @property
    def whole_sha256(self) -> str:
        """SHA-256 of all that the file says: its own, and with tables or laws of the user's one over theirs too."""
        parts = [self.sha256, *(f"{name} {digest}" for name, digest in self.beside)]
        return sha256("\n".join(parts).encode()).hexdigest() if len(parts) > 1 else self.sha256

    reference: Mapping[str, Any] = field(default_factory=dict)  # values by the NumPy target (model/reference.py)
    peaks: tuple[str, ...] = ()  # series whose peaks over all steps the scene asks for
    rigid: tuple[str, ...] = ()  # joints with play whose surfaces do not give: Newton's restitution
    start_apart: tuple[str, ...] = ()  # rows of joints with play that the start holds apart, by e and its rate
    parts: tuple[PartInfo, ...] = ()  # all joints, drives and force elements: what is drawn
    contours: tuple[ContourInfo, ...] = ()  # of joints with play whose bearings are no circles
    massless: tuple[str, ...] = ()  # bodies without mass or inertia: nothing is known that follows from masses

    @cached_property
    def place(self) -> dict[str, int]:
        """Where each slot stands, by its address; not to be written."""
        return {slot.address: k for k, slot in enumerate(self.slots)}

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less constraint rows."""
        return len(self.coordinates) - len(self.rows)

    @cached_property
    def guides(self) -> tuple[str, ...]:
        """Translational joints with play, whose sliders touch at corners."""
        return tuple(dict.fromkeys(joint.joint for joint in self.clearances if joint.at_wall))

    @property
    def n_memory(self) -> int:
        """What a sample remembers: an impact velocity a joint with play, a mode a friction, then inner states."""
        return len(self.clearances) + len(self.frictions) + len(self.states)

    @property
    def explicit(self) -> bool:
        """Whether only the explicit methods in C run it: what a law does has no slopes."""
        return bool(self.rigid)

    @property
    def no_slopes(self) -> str:
        """Why there is no Jacobian; "" where there is one."""
        if self.methods == (KINEMATIC,):
            return "without a degree of freedom nothing is integrated"
        return f"the contact in {self.rigid[0]} comes and goes, a constraint (newton_restitution)" if self.rigid else ""

    @property
    def methods(self) -> tuple[str, ...]:
        """What runs this scene: the integrators, or where nothing is left to be integrated the other one."""
        fitting = tuple(x for x in (*INTEGRATORS, *STAGED * self.stages) if not (self.explicit and x in NEED_SLOPES))
        return fitting if self.degrees_of_freedom or self.clearances or self.frictions else (KINEMATIC,)

    def to_json(self) -> str:
        """Readable JSON; the same source gives the same bytes."""
        return self._json

    @cached_property
    def _json(self) -> str:
        return as_text(shorten(asdict(self), _defaults()))

    @staticmethod
    def from_json(text: str) -> KernelSource:
        """The source that `to_json` wrote."""
        data = complete(json.loads(text), _defaults())
        kinds = {
            "bodies": BodyInfo,
            "points": PointInfo,
            "rows": RowInfo,
            "joints": JointInfo,
            "drives": DriveInfo,
            "clearances": ClearanceInfo,
            "start_rows": RowInfo,
            "slots": Slot,
            "conditions": Condition,
            "series": SeriesInfo,
            "events": EventInfo,
            "written": WrittenInfo,
            "expressions": WrittenInfo,
            "simulate_written": WrittenInfo,
            "parts": PartInfo,
            "contours": ContourInfo,
        }
        data |= {key: tuple(kind(**tuples(item)) for item in data.get(key, ())) for key, kind in kinds.items()}
        for key, value in data.items():
            if isinstance(value, list) and key not in kinds:
                data[key] = tuple(tuple(item) if isinstance(item, list) else item for item in value)
        return KernelSource(**data | {"story": Story.from_data(data.get("story", {}))})


def _defaults() -> dict[str, Any]:
    """What is not said where it is as usual: nothing, mostly."""
    usual = {field.name: field.default for field in fields(KernelSource) if field.default is not MISSING}
    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in usual.items()}
    lists = (
        "rows",
        "joints",
        "drives",
        "clearances",
        "series",
        "start_rows",
        "start_guess",
        "start_set",
        "start_rates",
        "frictions",
        "pivots",
        "start_pivots",
        "rate_jumps",
        "indeterminate",
        "derived",
        "conditions",
        "notes",
    )
    mappings = ("files", "outputs", "simulate", "reference")
    nothing: dict[str, Any] = {name: [] for name in lists} | {name: {} for name in mappings}
    return {"main": MAIN, **nothing, **plain, "story": {}}


def given_parameters(slots: Sequence[Slot], first: int) -> dict[int, float]:
    """Return a value for every second slot from `first` on, by its number. Choices of a name keep their defaults.

    With these a library is compared with values of the NumPy target (model/reference.py).
    """
    own = [(k, slot) for k, slot in enumerate(slots) if k % 2 == first and not slot.words]
    return {k: GIVEN * slot.default or GIVEN_ZERO for k, slot in own if math.isfinite(slot.default)}
