"""Define what the generator passes to the runtime: C texts of a scene, and the names of all its quantities.

Nothing else is passed. It is stored as JSON, so that a warm start needs neither SymPy nor Jinja. Values are SI, indices
start at 0.
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
from gudgeon.contract.methods import INTEGRATORS, KINEMATIC, NEED_SLOPES, STAGED
from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.contract.stored import convert_lists_to_tuples, format_json, remove_derived_values, restore_derived_values

HEADER = "model.h"
# line of model.h: the engine depends only on the text before it
ENGINE_ENDS = "/* The engine reads no further: scenes that have all this in common share its code. */"
MAIN = "scene.c"  # file that is compiled next to the engine
ENGINE_PART = 0  # part number of the engine, which is compiled in parallel with the parts of MAIN
CACHED_VALUES = "cached_values"  # attribute with cached results of functions (model/cached_values.py)
# factor of a parameter's default for the reference comparison, and the value in place of a default of 0
REFERENCE_FACTOR = 1.001
REFERENCE_VALUE_OF_ZERO = 0.001


@dataclass(frozen=True)
class RuntimeParameter:
    """Describe a run-time parameter: `given[i]` of the C function `prepare`."""

    address: str  # "bodies.L2.mass", "parameters.omega"
    unit: str  # SI, "kg*m^2"; "" for a pure number
    default: float  # value if it is not overridden
    follows: bool  # whether it is an expression of other parameters, unless overridden itself
    dimension: tuple[float, float, float]  # exponents of m, kg, s: whole, or halves
    words: tuple[str, ...] = ()  # of a choice: the words for the values 0, 1, …
    tree: str = ""  # its expression as JSON, if it may be undefined for some parameters


@dataclass(frozen=True)
class Condition:
    """Describe a condition on a parameter. `bound` is a number, another address, or a sum "a + b" of several."""

    address: str
    relation: str
    bound: float | str
    message: str

    @property
    def addresses(self) -> tuple[str, ...]:
        """Return the addresses whose sum is the bound; () for a number."""
        return tuple(self.bound.split(" + ")) if isinstance(self.bound, str) else ()


@dataclass(frozen=True)
class BodyInfo:
    """Describe a body: `index` of x in q; y and theta follow it."""

    name: str
    index: int


@dataclass(frozen=True)
class PointInfo:
    """Describe a point in its body's centre-of-mass frame: (sign_x p[x], sign_y p[y]); index −1 means zero."""

    name: str  # "L1.head"
    body: int  # index into bodies; −1: ground
    x: int
    y: int
    sign_x: int = 1
    sign_y: int = 1


@dataclass(frozen=True)
class EquationInfo:
    """Describe a constraint equation of Φ (and its multiplier): "A.x" belongs to joint A."""

    name: str
    owner: str  # joint or drive
    kind: str  # "joint" or "drive"
    unit: str  # of the residual: "m" or "rad"


@dataclass(frozen=True)
class JointInfo:
    """Describe a joint without play; the reaction on the second body is given at `point`."""

    name: str
    kind: str
    first: int  # body index, −1: ground
    second: int
    point: str  # of the second body, or of the first where the joint's type says so
    rows: tuple[int, ...]


@dataclass(frozen=True)
class DriveInfo:
    """Describe a drive: its constraint equation (−1: redundant); unit "rad" means torque, "m" force."""

    name: str
    row: int
    unit: str


@dataclass(frozen=True)
class SeriesInfo:
    """Describe a result of a force element, such as "coil.F"."""

    name: str
    unit: str


@dataclass(frozen=True)
class ExpressionInfo:
    """Describe an expression of t or motion, or of a scene's `simulate`, as JSON; or a literal or missing 0."""

    address: str  # "drives.crank.value"
    tree: str
    line: int
    column: int


@dataclass(frozen=True)
class EventInfo:
    """Describe a user event: action "record" or "stop", direction "rising", "falling" or "both"."""

    name: str
    action: str
    direction: str


@dataclass(frozen=True)
class PartInfo:
    """Describe a joint, drive or force element of the file for drawing; its values are parameters by address.

    `ends` are points, "L1.head", in the file's order. For elements between bodies they are centres of mass, "L1.com";
    "ground." is the ground.
    """

    section: str  # "joints", "drives" or "forces"
    name: str
    kind: str  # "revolute", "angle", "spring_damper", …
    ends: tuple[str, ...]
    options: Mapping[str, str]  # words: {"carrier": "L3", "internal": "true"}, of a drive {"coordinate": "y"}


# names of KernelSource fields in the stored JSON text, where they differ
STORED_NAMES = {
    "equations": "rows",
    "start_equations": "start_rows",
    "parameters": "slots",
    "integrated_pivots": "motion_pivots",
    "driven_loop_coordinates": "chain",
    "driven_loop_equations": "chain_rows",
    "reduction_log": "story",
    "file_expressions": "written",
    "named_expressions": "expressions",
    "internal_states": "states",
    "compilation_units": "units",
    "simulate_expressions": "simulate_written",
    "eccentricity_equations": "start_apart",
    "tree_coordinates": "tree",
    "taylor_file": "taylor",
    "max_taylor_tolerance": "taylor_below",
    "has_stage_matrices": "stages",
    "lane_file": "lanes",
    "rigid_joints": "rigid",
    "massless_bodies": "massless",
}


@dataclass(frozen=True)
class KernelSource:
    """Describe a scene to be compiled. `files` are C texts by name; `main` is the one to compile."""

    mechanism: str
    scene: str
    title: str
    sha256: str  # of the YAML bytes
    files: Mapping[str, str]
    main: str
    coordinates: tuple[str, ...]  # "L1.x", "L1.y", "L1.theta", …
    bodies: tuple[BodyInfo, ...]
    points: tuple[PointInfo, ...]
    equations: tuple[EquationInfo, ...]  # constraint equations of the motion
    joints: tuple[JointInfo, ...]
    drives: tuple[DriveInfo, ...]
    clearances: tuple[ClearanceInfo, ...]
    series: tuple[SeriesInfo, ...]
    start_equations: tuple[EquationInfo, ...]  # of the start's Φ, in which joints with play are closed
    start_guess: tuple[str, ...]  # coordinates in the order of the C function `start_values`
    start_set: tuple[str, ...]
    start_rates: tuple[str, ...]  # "L1.omega"
    frictions: tuple[str, ...]  # force elements that may stick
    pivots: tuple[str, ...]  # constraint equations in their order of elimination: a status k > 0 names pivots[k − 1]
    start_pivots: tuple[str, ...]  # the same for the kinematic method's projection
    rate_jumps: tuple[str, ...]  # drives whose rate may jump, which causes impulses
    indeterminate: tuple[str, ...]  # joints and drives whose multipliers are undetermined because of redundancy
    parameters: tuple[RuntimeParameter, ...]  # run-time parameters, in the order of p
    derived: tuple[str, ...]  # names of the derived values that follow the parameters in p
    conditions: tuple[Condition, ...]
    outputs: Mapping[str, Any]  # name -> expression tree as nested lists
    simulate: Mapping[str, float]  # t_end, step and output of the scene, if the file gives them
    operations: Mapping[str, int]  # function → operation count
    notes: tuple[str, ...]  # notes on effects that were left out, with reasons (check -v)
    gravity: bool
    formulation: str = "full"  # formulation that is integrated: "reduced" or "full"
    integrated_pivots: tuple[str, ...] = ()  # as pivots, of the formulation that is integrated
    tree_coordinates: tuple[
        str, ...
    ] = ()  # coordinates of the reduced formulation: "L7" (an angle), "guide.slide", "L3.x"
    closures: tuple[str, ...] = ()  # constraint equations of the reduced formulation
    # coordinates that drives determine through loops: evaluated, not integrated
    driven_loop_coordinates: tuple[str, ...] = ()
    driven_loop_equations: tuple[str, ...] = ()  # constraint equations of these loops
    events: tuple[EventInfo, ...] = ()
    reduction_log: ReductionLog = ReductionLog()  # record of the reduction (check -v)
    file_expressions: tuple[ExpressionInfo, ...] = ()  # of drives, forces and joints
    named_expressions: tuple[ExpressionInfo, ...] = ()  # those of the file that are used by name here
    lines: tuple[tuple[str, int], ...] = ()  # lines of the file at which joints and drives are
    internal_states: tuple[str, ...] = ()  # internal states of laws, "A.z", equally many per joint with play; "": none
    # parts in which `main` is compiled in parallel, as PART in C counts them; (): as a whole
    compilation_units: tuple[int, ...] = ()
    taylor_file: str = ""  # file with the Taylor series of the motion; "": the library has none
    # tolerance below which `auto` integrates by the Taylor series, of this library or of the variant; 0: never
    max_taylor_tolerance: float = 0.0
    has_stage_matrices: bool = False  # whether the library has the matrices of methods with coupled stages
    lane_file: str = ""  # file to compile for lanes; "": there is none
    cdef: str = ""  # declarations of `main` where it is compiled without the engine; "": those of the engine
    overrides: tuple[tuple[str, str | float | bool], ...] = ()  # of the file: (address, value), sorted (load)
    # expressions of `simulate` that depend on parameters; their values are the defaults
    simulate_expressions: tuple[ExpressionInfo, ...] = ()
    tables: tuple[tuple[str, str], ...] = ()  # table files of curves in the mechanism's folder, and their SHA-256
    laws: tuple[tuple[str, str], ...] = ()  # user-defined laws and their keys (kinds/laws/registered.py)

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for pickling, without cached values (model/cached_values.py)."""
        return {name: value for name, value in vars(self).items() if name != CACHED_VALUES}

    @property
    def external_files(self) -> tuple[tuple[str, str], ...]:
        """Return tables and user-defined laws, which the file's text does not contain, with their SHA-256."""
        return (*self.tables, *self.laws)

    @property
    def whole_sha256(self) -> str:
        """Return the SHA-256 of the file, including its tables and user-defined laws if there are any."""
        parts = [self.sha256, *(f"{name} {digest}" for name, digest in self.external_files)]
        return sha256("\n".join(parts).encode()).hexdigest() if len(parts) > 1 else self.sha256

    reference: Mapping[str, Any] = field(default_factory=dict)  # values by the NumPy target (model/reference.py)
    peaks: tuple[str, ...] = ()  # series whose peaks over all steps the scene requests
    rigid_joints: tuple[str, ...] = ()  # joints with play and rigid surfaces: Newton's restitution
    eccentricity_equations: tuple[
        str, ...
    ] = ()  # equations of joints with play that the start holds open, by e and its rate
    parts: tuple[PartInfo, ...] = ()  # all joints, drives and force elements, for drawing
    contours: tuple[ContourInfo, ...] = ()  # joints with play whose bearings have contours
    massless_bodies: tuple[str, ...] = ()  # bodies without mass or inertia: quantities that need masses are unknown

    @cached_property
    def parameter_indices(self) -> dict[str, int]:
        """Return the index of each parameter by address. Do not write to it."""
        return {parameter.address: k for k, parameter in enumerate(self.parameters)}

    @property
    def degrees_of_freedom(self) -> int:
        """Return the number of coordinates less that of constraint equations."""
        return len(self.coordinates) - len(self.equations)

    @cached_property
    def guides(self) -> tuple[str, ...]:
        """Return the translational joints with play, whose sliders touch at corners."""
        return tuple(dict.fromkeys(joint.joint for joint in self.clearances if joint.is_corner))

    @property
    def n_discrete_states(self) -> int:
        """Return the number of discrete states: δ̇⁻ per joint with play, mode per friction, then internal states."""
        return len(self.clearances) + len(self.frictions) + len(self.internal_states)

    @property
    def is_explicit(self) -> bool:
        """Return whether only explicit methods fit: a contact law has no derivatives."""
        return bool(self.rigid_joints)

    @property
    def reason_without_jacobian(self) -> str:
        """Return why there is no Jacobian; "" if there is one.

        There is none without degrees of freedom, or if a contact of rigid surfaces opens and closes.
        """
        if self.methods == (KINEMATIC,):
            return "without a degree of freedom nothing is integrated"
        contact = f"the contact in {self.rigid_joints[0]}" if self.rigid_joints else ""
        return contact and f"{contact} is a constraint that opens and closes (newton_restitution)"

    @cached_property
    def methods(self) -> tuple[str, ...]:
        """Return the names of the methods that fit this scene: integrators, or the kinematic method alone.

        The kinematic method fits scenes without degrees of freedom, play and friction. Methods with coupled stages are
        included if the library has their matrices; those that use the Jacobian only if contact laws have derivatives.
        """
        integrators = tuple(
            x for x in (*INTEGRATORS, *STAGED * self.has_stage_matrices) if not (self.is_explicit and x in NEED_SLOPES)
        )
        return integrators if self.degrees_of_freedom or self.clearances or self.frictions else (KINEMATIC,)

    def to_json(self) -> str:
        """Return readable JSON; the same source gives the same bytes."""
        return self._json

    @cached_property
    def _json(self) -> str:
        """Return the JSON text, computed once."""
        data = {STORED_NAMES.get(name, name): value for name, value in asdict(self).items()}
        return format_json(remove_derived_values(data, _find_json_defaults()))

    @staticmethod
    def from_json(text: str) -> KernelSource:
        """Return the kernel source that `to_json` wrote; values that were left out are restored.

        Lists become tuples; bodies, joints, series and other entries become their dataclasses.
        """
        data = restore_derived_values(json.loads(text), _find_json_defaults())
        field_names = {stored_name: name for name, stored_name in STORED_NAMES.items()}
        fields = {field_names.get(name, name): value for name, value in data.items()}
        classes = {
            "bodies": BodyInfo,
            "points": PointInfo,
            "equations": EquationInfo,
            "joints": JointInfo,
            "drives": DriveInfo,
            "clearances": ClearanceInfo,
            "start_equations": EquationInfo,
            "parameters": RuntimeParameter,
            "conditions": Condition,
            "series": SeriesInfo,
            "events": EventInfo,
            "file_expressions": ExpressionInfo,
            "named_expressions": ExpressionInfo,
            "simulate_expressions": ExpressionInfo,
            "parts": PartInfo,
            "contours": ContourInfo,
        }
        fields |= {
            key: tuple(kind(**convert_lists_to_tuples(item)) for item in fields.get(key, ()))
            for key, kind in classes.items()
        }
        for key, value in fields.items():
            if isinstance(value, list) and key not in classes:
                fields[key] = tuple(tuple(item) if isinstance(item, list) else item for item in value)
        log = ReductionLog.from_data(fields.get("reduction_log", {}))
        return KernelSource(**fields | {"reduction_log": log})


def _find_json_defaults() -> dict[str, Any]:
    """Return the values of KernelSource fields that the JSON text leaves out, by their names in the text.

    They are the defaults of fields in JSON form (tuples as lists), empty lists and mappings for some fields without
    defaults, MAIN for `main`, and an empty mapping for the reduction log (`story`).
    """
    defaults = {
        STORED_NAMES.get(field.name, field.name): field.default
        for field in fields(KernelSource)
        if field.default is not MISSING
    }
    json_defaults = {name: list(value) if isinstance(value, tuple) else value for name, value in defaults.items()}
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
    empty_values: dict[str, Any] = {name: [] for name in lists} | {name: {} for name in mappings}
    return {"main": MAIN, **empty_values, **json_defaults, "story": {}}


def make_given_parameters(parameters: Sequence[RuntimeParameter], parity: int) -> dict[int, float]:
    """Return a test value for every second parameter from index `parity` (0 or 1) on, by index, without choices.

    It is REFERENCE_FACTOR times the default, REFERENCE_VALUE_OF_ZERO for a default of 0. With these values, a library
    is compared with the NumPy target (model/reference.py).
    """
    varied_parameters = [
        (k, parameter) for k, parameter in enumerate(parameters) if k % 2 == parity and not parameter.words
    ]
    return {
        k: REFERENCE_FACTOR * parameter.default or REFERENCE_VALUE_OF_ZERO
        for k, parameter in varied_parameters
        if math.isfinite(parameter.default)
    }
