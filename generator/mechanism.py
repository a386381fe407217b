"""A mechanism as its YAML file describes it: names resolved, numbers in SI, no SymPy.

All of these are frozen values. A `Quantity` is a number with an address: it becomes a run-time
slot of the compiled model unless it is a literal zero, which is structural (its terms vanish).

All numbers in a part of a mechanism.

A scene: the mechanism plus which joints have play, with which laws. The unit that is compiled.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace

from gudgeon.errors import Location
from gudgeon.language.curves import Curve
from gudgeon.language.names import unknown_name
from gudgeon.language.tree import Expr, Name, Number, replaced
from gudgeon.language.units import Dimension

GROUND = "ground"


@dataclass(frozen=True)
class Quantity:
    """One physical number: `value` is an expression of parameters (of `t` too, in a drive)."""

    address: str  # "bodies.L2.mass", "ground.O4.y", "parameters.omega"
    value: Expr
    dimension: Dimension
    where: Location
    of: tuple[Quantity, ...] = ()  # numbers that `value` names by their addresses: it follows them
    kept: bool = False  # a number of the run even where it is written as 0
    written: Expr | None = None  # of an expression by name: with the names of others, whose trees `value` has

    @property
    def is_zero(self) -> bool:
        """True for a literal zero only, unless it is kept: a parameter is never assumed zero."""
        return not self.kept and isinstance(self.value, Number) and self.value.value == 0.0


Vector = tuple[Quantity, Quantity]


def following(address: str, of: Quantity, where: Location) -> Quantity:
    """The number at an address that is another one, unless it is given itself."""
    return Quantity(address, Name(of.address), of.dimension, where, (of,))


def at_onset(force: Quantity) -> Quantity:
    """What an expression of the penetration is at δ = 0, as a number of its own."""
    value = replaced(force.value, {"delta": Number(0.0, "0")})
    return Quantity(f"{force.address}_at_0", value, force.dimension, force.where, kept=True)


@dataclass(frozen=True)
class PointRef:
    """A named point of a body (`L1.head`) or of the ground (`ground.O1`)."""

    body: str
    point: str
    where: Location


@dataclass(frozen=True)
class Body:
    """A rigid body. Its frame: a bar (a body with `length`) has its origin at the tail and its x axis
    towards the head; any other body has its origin where its points are measured from.

    `points` are in that frame and hold `origin` always, `tail` and `head` for a bar.
    `com` is the centre of mass in that frame; None stands for the default: mid-length of a bar,
    the origin of any other body.
    """

    name: str
    mass: Quantity | None  # None: there is none, which kinematics does not ask for
    inertia: Quantity | None  # about the centre of mass
    length: Quantity | None
    com: Vector | None
    points: Mapping[str, Vector]  # what the user named; tail, head, origin, com are implied
    where: Location
    lacks: tuple[str, ...] = ()  # keys that dynamics would ask for


@dataclass(frozen=True)
class Joint:
    """A joint between a point of the first and a point of the second body; `ground` may be either.

    `kind` names a file in generator/kinds/joints, which owns the meaning of `quantities` (numbers with
    addresses), `vectors` (pairs of them) and `options` (structural words).
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
    """Prescribes `value` of t: of an angle, of a coordinate, or of the distance of two points.

    kind "angle": of `body`, relative to `reference` if that is not None; "coordinate": `coordinate`
    ("x", "y" or "theta") of `body`; "distance": between the two `points` (`body` is then that of the first
    point that is not on the ground).
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
    """An entry of the section `forces`; `kind` names a file in generator/kinds/forces.

    `targets` are the points or bodies that its own key lists (a body is a PointRef to its `com`, the
    ground one to the point ""). Expressions (`quantities`, `vectors`) may use t and named coordinates and
    velocities where the element's field says so.
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
    """Where a journal begins: eccentricity and its rate in ground axes, "start.play.A.e.x"; all four are kept.
    Of a slider they are its offset and tilt in its guide, "start.play.A.offset", and their rates."""

    e: Vector
    rate: Vector


@dataclass(frozen=True)
class Start:
    """`guess` picks the branch, `set` is held exactly, `rates` are velocities that drives leave free.

    Keys are coordinates "L7.theta", "S9.x", "L1.omega"; values have addresses "start.guess.L7.theta".
    A guessed point is two: "L7.P.x", "L7.P.y". `play` is by joint, for scenes that give it play.
    """

    guess: Mapping[str, Quantity] = field(default_factory=dict)
    set: Mapping[str, Quantity] = field(default_factory=dict)
    rates: Mapping[str, Quantity] = field(default_factory=dict)
    play: Mapping[str, JournalStart] = field(default_factory=dict)


@dataclass(frozen=True)
class Material:
    """What the file says of it: E, nu, density."""

    name: str
    numbers: Mapping[str, Quantity]


@dataclass(frozen=True)
class Choice:
    """A material that a scene or a run may replace by another; `numbers` are those at its address, by their names."""

    address: str  # "bearings.pin.journal_material"
    material: str
    numbers: Mapping[str, Quantity]  # "E" at "bearings.pin.journal_material.E"


@dataclass(frozen=True)
class Bearing:
    """A pin in a hole: bearing radius R_i, radial clearance c = R_i − R_j, length L, two materials."""

    name: str
    radius: Quantity
    clearance: Quantity
    length: Quantity
    bearing_material: Material  # of its numbers E and nu
    journal_material: Material


@dataclass(frozen=True)
class Guide:
    """A block between parallel walls: gap c on each side, half-length, half-height, radius of its corners if any."""

    name: str
    gap: Quantity
    half_length: Quantity
    half_height: Quantity
    corner_radius: Quantity | None
    bearing_material: Material  # of the walls; of its numbers E and nu
    journal_material: Material


@dataclass(frozen=True)
class LawUse:
    """A force law with its numbers; `law` names a file in generator/kinds/laws."""

    law: str
    quantities: Mapping[str, Quantity]  # with the law's defaults filled in
    options: Mapping[str, str | bool]  # structural, with the law's defaults filled in


@dataclass(frozen=True)
class Contact:
    """What happens between journal and bearing: dry laws, a film, and between both a transition or a law of sharing."""

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
        """The laws that it has."""
        return tuple(use for use in (self.normal, self.friction, self.film, self.mixed) if use is not None)


@dataclass(frozen=True)
class Play:
    bearing: Bearing | Guide
    contact: Contact
    where: Location
    contour: tuple[Quantity, ...] = ()  # depths at equal angles over the bearing's circumference


@dataclass(frozen=True)
class EventSpec:
    """The run is watched for `zero` crossing zero: "rising", "falling" or "both"; action "record" or "stop"."""

    name: str
    zero: Quantity  # an expression of t, parameters, coordinates and velocities, of any dimension
    direction: str
    action: str
    where: Location


@dataclass(frozen=True)
class SceneSpec:
    """A scene as the file writes it, `extends` already followed."""

    name: str
    play: Mapping[str, Play]  # joint -> play
    parameters: Mapping[str, Quantity]  # parameter name -> its value in this scene
    simulate: Mapping[str, Quantity]  # t_end, output, step
    where: Location
    events: Mapping[str, EventSpec] = field(default_factory=dict)  # the file's, with the scene's own put in
    peaks: tuple[str, ...] = ()  # series whose peaks are wanted, with their places (yaml.tree.Text) while it is read
    materials: Mapping[str, str] = field(default_factory=dict)  # address of a choice -> another material


@dataclass(frozen=True)
class Condition:
    """What a value must satisfy, at reading and again for every run-time override."""

    address: str
    relation: str  # ">" ">=" "<" "<="
    bound: float | str  # a number, or the address of another quantity, or those of several: "a + b" is their sum
    message: str  # "a mass is positive"


@dataclass(frozen=True)
class Mechanism:
    name: str
    title: str
    gravity: Vector | None
    parameters: Mapping[str, Quantity]  # in the order of the file
    bodies: Mapping[str, Body]
    ground: Mapping[str, Vector]
    joints: Mapping[str, Joint]
    drives: Mapping[str, Drive]
    start: Start
    scenes: Mapping[str, SceneSpec]  # holds `ideal` always
    outputs: Mapping[str, Quantity]
    conditions: tuple[Condition, ...]
    file: str
    sha256: str  # of the file's bytes
    forces: Mapping[str, ForceElement] = field(default_factory=dict)
    freedoms: Quantity | None = None  # what the file says of the closed linkage
    curves: Mapping[str, Curve] = field(default_factory=dict)
    expressions: Mapping[str, Quantity] = field(default_factory=dict)  # by name; their trees stand where they are used
    materials: Mapping[str, Material] = field(default_factory=dict)
    choices: Mapping[str, Choice] = field(default_factory=dict)  # by address
    tables: Mapping[str, str] = field(default_factory=dict)  # files beside this one -> sha256 of what was read
    laws: Mapping[str, str] = field(default_factory=dict)  # the user's own that it uses -> what they say, as a key


def is_massless(mechanism: Mechanism) -> bool:
    """Whether a body has no mass or no inertia: there is kinematics then, and no force that follows from motion."""
    return any(body.lacks for body in mechanism.bodies.values())


def quantities(part: object) -> Iterator[Quantity]:
    """Those of a frozen value, of what it holds and of what that holds."""
    if isinstance(part, Quantity):
        yield part
        return
    inner: Iterable[object] = ()
    if isinstance(part, Curve):  # its numbers are no quantities, and may be millions
        return
    if is_dataclass(part):
        inner = (getattr(part, one.name) for one in fields(part))
    elif isinstance(part, Mapping):
        inner = part.values()
    elif isinstance(part, (tuple, list)):
        inner = part
    for one in inner:
        yield from quantities(one)


@dataclass(frozen=True)
class Scene:
    """`parameters` are the mechanism's, in the order of the file, with the scene's own values put in.

    A parameter keeps its address `parameters.<name>` whichever scene gives its value: it is the same
    run-time slot in all of them.
    """

    mechanism: Mechanism
    name: str
    play: Mapping[str, Play]  # joint -> play
    parameters: Mapping[str, Quantity]
    simulate: Mapping[str, Quantity]  # t_end, output, step
    events: Mapping[str, EventSpec]
    peaks: tuple[str, ...]
    materials: Mapping[str, str]  # address of each choice -> what is chosen here
    instead: Mapping[str, Quantity]  # by address: numbers that follow another material than the file's


def make_scene(mechanism: Mechanism, name: str) -> Scene:
    """The scene `name` of a mechanism. Raises UnknownNameError, which names the scenes that exist."""
    if name not in mechanism.scenes:
        raise unknown_name("scene", name, mechanism.scenes, None)
    spec = mechanism.scenes[name]
    parameters = {
        key: replace(own, value=spec.parameters[key].value, where=spec.parameters[key].where)
        if key in spec.parameters
        else own
        for key, own in mechanism.parameters.items()
    }
    chosen = {address: spec.materials.get(address, choice.material) for address, choice in mechanism.choices.items()}
    instead = {
        own.address: following(own.address, mechanism.materials[chosen[address]].numbers[what], own.where)
        for address, choice in mechanism.choices.items()
        for what, own in choice.numbers.items()
    }
    return Scene(mechanism, name, spec.play, parameters, spec.simulate, spec.events, spec.peaks, chosen, instead)
