"""Defines a mechanism as its YAML file describes it: frozen values, names resolved, numbers in SI, no SymPy.

A `Quantity` is a number with an address. It becomes a run-time parameter of the compiled model unless it is a literal
zero, which is structural: its terms vanish. A Scene adds which joints have play, and is the unit of compilation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace

from gudgeon.errors import Location
from gudgeon.language.curves import Curve
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.tree import Expr, Name, Number, replace_names
from gudgeon.language.units import Dimension

GROUND = "ground"


@dataclass(frozen=True)
class Quantity:
    """Represent one physical number: an address and an expression of parameters, in a drive also of `t`."""

    address: str  # "bodies.L2.mass", "ground.O4.y", "parameters.omega"
    value: Expr
    dimension: Dimension
    where: Location
    operands: tuple[Quantity, ...] = ()  # quantities that `value` names by their addresses
    is_always_parameter: bool = False  # a run-time parameter even if it is written as 0
    source_tree: Expr | None = (
        None  # of a named expression: with the names of others, for which `value` has their trees
    )

    @property
    def is_zero(self) -> bool:
        """Return whether the value is a number 0 written in the file, so that its terms vanish from the equations.

        A quantity with `is_always_parameter` and an expression of parameters are never such a zero.
        """
        return not self.is_always_parameter and isinstance(self.value, Number) and self.value.value == 0.0


Vector = tuple[Quantity, Quantity]


def make_dependent_quantity(address: str, source: Quantity, location: Location) -> Quantity:
    """Return a quantity at `address` whose value is that of the quantity `source`, unless a run sets it.

    It has the dimension of `source` and is located at `location` in the file.
    """
    return Quantity(address, Name(source.address), source.dimension, location, (source,))


def make_force_at_zero_penetration(force: Quantity) -> Quantity:
    """Return the value at δ = 0 of a contact force, which is an expression of the penetration, as a quantity.

    Its address is that of the force with "_at_0" appended. It is a run-time parameter even if it is 0.
    """
    value = replace_names(force.value, {"delta": Number(0.0, "0")})
    return Quantity(f"{force.address}_at_0", value, force.dimension, force.where, is_always_parameter=True)


@dataclass(frozen=True)
class PointRef:
    """Represent a named point of a body (`L1.head`) or of the ground (`ground.O1`)."""

    body: str
    point: str
    where: Location


@dataclass(frozen=True)
class Body:
    """Represent a rigid body with its frame.

    The frame of a bar, a body with `length`, has its origin at the tail and its x axis towards the head. Points of
    other bodies are measured from their origin. `com` is the centre of mass; None is the middle of a bar, the origin of
    others.
    """

    name: str
    mass: Quantity | None  # None: not given, which kinematics does not need
    inertia: Quantity | None  # about the centre of mass
    length: Quantity | None
    com: Vector | None
    points: Mapping[str, Vector]  # declared points; tail, head, origin, com are implied
    where: Location
    missing_keys: tuple[str, ...] = ()  # keys that dynamics needs and that are missing


@dataclass(frozen=True)
class Joint:
    """Represent a joint between a point of the first and a point of the second body; `ground` may be either.

    `kind` is a file in generator/kinds/joints, which defines the meaning of `quantities`, `vectors` and
    `options`.
    """

    name: str
    kind: str
    first: PointRef
    second: PointRef
    quantities: Mapping[str, Quantity]
    vectors: Mapping[str, Vector]
    options: Mapping[str, str]
    where: Location


@dataclass(frozen=True)
class Drive:
    """Represent a drive, which prescribes an angle, a coordinate or a distance as the function `value` of t.

    kind "angle": of `body`, relative to `reference` if that is not None; "coordinate": `coordinate` ("x", "y" or
    "theta") of `body`; "distance": between the two `points`, with the body of the first that is not on the ground as
    `body`.
    """

    name: str
    kind: str
    body: str
    reference: str | None
    value: Quantity
    where: Location
    coordinate: str = "theta"
    points: tuple[PointRef, ...] = ()


@dataclass(frozen=True)
class ForceElement:
    """Represent an entry of the section `forces`; `kind` is a file in generator/kinds/forces.

    `targets` are points or bodies: a body is a PointRef to its `com`, the ground one to the point "". Expressions may
    use t, coordinates and velocities where the element's field allows it.
    """

    name: str
    kind: str
    targets: tuple[PointRef, ...]
    quantities: Mapping[str, Quantity]
    vectors: Mapping[str, Vector]
    options: Mapping[str, str]
    where: Location


@dataclass(frozen=True)
class JournalStart:
    """Represent where a journal begins: eccentricity and its rate in ground axes, at addresses "start.play.A.e.x".

    For a slider, `e` is its offset and tilt in its guide, "start.play.A.offset", and `rate` their rates.
    """

    e: Vector
    rate: Vector


@dataclass(frozen=True)
class Start:
    """Represent the start: `guess` selects the branch, `set` is held exactly, `rates` are free velocities.

    Keys are coordinates "L7.theta", "S9.x", "L1.omega"; a guessed point has two, "L7.P.x" and "L7.P.y". `play` contains
    journals by joint.
    """

    guess: Mapping[str, Quantity] = field(default_factory=dict)
    set: Mapping[str, Quantity] = field(default_factory=dict)
    rates: Mapping[str, Quantity] = field(default_factory=dict)
    play: Mapping[str, JournalStart] = field(default_factory=dict)


@dataclass(frozen=True)
class Material:
    """Represent a material with its properties E, nu and density, as far as the file gives them."""

    name: str
    numbers: Mapping[str, Quantity]


@dataclass(frozen=True)
class Choice:
    """Represent a material that a scene or a run may replace; `numbers` are its properties at this address."""

    address: str  # "bearings.pin.journal_material"
    material: str
    numbers: Mapping[str, Quantity]  # "E" at "bearings.pin.journal_material.E"


@dataclass(frozen=True)
class Bearing:
    """Represent a pin in a hole: bearing radius R_i, radial clearance c = R_i − R_j, length L, two materials."""

    name: str
    radius: Quantity
    clearance: Quantity
    length: Quantity
    bearing_material: Material  # its properties E and nu
    journal_material: Material


@dataclass(frozen=True)
class Guide:
    """Represent a block between parallel walls: gap c on each side, half-length, half-height, corner radius."""

    name: str
    gap: Quantity
    half_length: Quantity
    half_height: Quantity
    corner_radius: Quantity | None
    bearing_material: Material  # of the walls; of its numbers E and nu
    journal_material: Material


@dataclass(frozen=True)
class LawUse:
    """Represent a force law with its numbers; `law` is a file in generator/kinds/laws."""

    law: str
    quantities: Mapping[str, Quantity]  # with the law's defaults filled in
    options: Mapping[str, str | bool]  # structural, with the law's defaults filled in


@dataclass(frozen=True)
class Contact:
    """Represent the contact of journal and bearing: dry laws, a film, and how film and dry contact share the load."""

    name: str
    normal: LawUse | None
    friction: LawUse | None
    film: LawUse | None
    transition: Quantity | None
    clip_ratio: bool = False  # clip δ̇/δ̇⁻ to [−1, 1] (physics.md, section 3)
    velocity_floor: Quantity | None = None  # least δ̇⁻ that an onset stores
    mixed: LawUse | None = None

    @property
    def laws(self) -> tuple[LawUse, ...]:
        """Return the laws of the contact that are present, in the order normal, friction, film, mixed."""
        return tuple(use for use in (self.normal, self.friction, self.film, self.mixed) if use is not None)


@dataclass(frozen=True)
class Play:
    """Represent the play of one joint: its bearing or guide, its contact, and the contour of the bearing."""

    bearing: Bearing | Guide
    contact: Contact
    where: Location
    contour: tuple[Quantity, ...] = ()  # depths at equal angles over the bearing's circumference


@dataclass(frozen=True)
class EventSpec:
    """Represent an event: an expression `zero` whose zero crossings a run records, or at which it stops."""

    name: str
    zero: Quantity  # an expression of t, parameters, coordinates and velocities, of any dimension
    direction: str
    action: str
    where: Location


@dataclass(frozen=True)
class SceneSpec:
    """Represent a scene as the file describes it, with `extends` resolved."""

    name: str
    play: Mapping[str, Play]  # joint -> play
    parameters: Mapping[str, Quantity]  # parameter name -> its value in this scene
    simulate: Mapping[str, Quantity]  # t_end, output, step
    where: Location
    events: Mapping[str, EventSpec] = field(default_factory=dict)  # the file's events and the scene's own
    peaks: tuple[str, ...] = ()  # series whose peaks are requested; Text with locations while the file is read
    materials: Mapping[str, str] = field(default_factory=dict)  # address of a choice -> another material


@dataclass(frozen=True)
class Condition:
    """Represent a condition on a value, checked after reading and again for every run-time override."""

    address: str
    relation: str  # ">" ">=" "<" "<="
    bound: float | str  # a number, or the address of a quantity, or of a sum: "a + b"
    message: str  # "a mass is positive"


@dataclass(frozen=True)
class Mechanism:
    """Represent a mechanism with all its sections."""

    name: str
    title: str
    gravity: Vector | None
    parameters: Mapping[str, Quantity]  # in the order of the file
    bodies: Mapping[str, Body]
    ground: Mapping[str, Vector]
    joints: Mapping[str, Joint]
    drives: Mapping[str, Drive]
    start: Start
    scenes: Mapping[str, SceneSpec]  # always contains `ideal`
    outputs: Mapping[str, Quantity]
    conditions: tuple[Condition, ...]
    file: str
    sha256: str  # of the file's bytes
    forces: Mapping[str, ForceElement] = field(default_factory=dict)
    freedoms: Quantity | None = None  # expected degrees of freedom of the closed linkage
    curves: Mapping[str, Curve] = field(default_factory=dict)
    expressions: Mapping[str, Quantity] = field(
        default_factory=dict
    )  # by name; their trees replace the names where they are used
    materials: Mapping[str, Material] = field(default_factory=dict)
    choices: Mapping[str, Choice] = field(default_factory=dict)  # by address
    tables: Mapping[str, str] = field(default_factory=dict)  # path of a table next to the file -> sha256 of its bytes
    laws: Mapping[str, str] = field(default_factory=dict)  # name of each used user-defined law -> key of its definition


def is_massless(mechanism: Mechanism) -> bool:
    """Return whether any body has no mass or no inertia, so that only kinematics is possible."""
    return any(body.missing_keys for body in mechanism.bodies.values())


def iterate_quantities(value: object) -> Iterator[Quantity]:
    """Yield all quantities in a frozen value (dataclass, mapping, tuple or list) and in its parts, recursively.

    Curves and the operands of a quantity are not visited.
    """
    if isinstance(value, Quantity):
        yield value
        return
    inner_values: Iterable[object] = ()
    if isinstance(value, Curve):  # its values are not quantities, and may be millions
        return
    if is_dataclass(value):
        inner_values = (getattr(value, inner_value.name) for inner_value in fields(value))
    elif isinstance(value, Mapping):
        inner_values = value.values()
    elif isinstance(value, (tuple, list)):
        inner_values = value
    for inner_value in inner_values:
        yield from iterate_quantities(inner_value)


@dataclass(frozen=True)
class Scene:
    """Represent a scene: the mechanism with the play, parameter values and run settings of this scene.

    A parameter keeps its address `parameters.<name>` whichever scene gives its value.
    """

    mechanism: Mechanism
    name: str
    play: Mapping[str, Play]  # joint -> play
    parameters: Mapping[str, Quantity]
    simulate: Mapping[str, Quantity]  # t_end, output, step
    events: Mapping[str, EventSpec]
    peaks: tuple[str, ...]
    materials: Mapping[str, str]  # address of each choice -> the material of this scene
    chosen_properties: Mapping[str, Quantity]  # by address: properties that follow the material of this scene


def make_scene(mechanism: Mechanism, name: str) -> Scene:
    """Return the scene `name` of a mechanism, with its values of parameters and its materials in place of the file's.

    Raises UnknownNameError, which lists the scenes that exist.
    """
    if name not in mechanism.scenes:
        raise make_unknown_name_error("scene", name, mechanism.scenes, None)
    spec = mechanism.scenes[name]
    parameters = {
        key: replace(quantity, value=spec.parameters[key].value, where=spec.parameters[key].where)
        if key in spec.parameters
        else quantity
        for key, quantity in mechanism.parameters.items()
    }
    material_names = {
        address: spec.materials.get(address, choice.material) for address, choice in mechanism.choices.items()
    }
    replaced_properties = {
        quantity.address: make_dependent_quantity(
            quantity.address, mechanism.materials[material_names[address]].numbers[property_name], quantity.where
        )
        for address, choice in mechanism.choices.items()
        for property_name, quantity in choice.numbers.items()
    }
    return Scene(
        mechanism,
        name,
        spec.play,
        parameters,
        spec.simulate,
        spec.events,
        spec.peaks,
        material_names,
        replaced_properties,
    )
