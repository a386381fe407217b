"""Declares the sections of a mechanism file and their keys, each once.

Joints, drives, forces and laws are declared in their own folders of generator/kinds; `kinds` of a field returns them.
"""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.generator.field import (
    CORNERS,
    DEPTHS,
    KINDS,
    LAW,
    OF_MOTION,
    OF_RESULTS,
    PLACE,
    POINTS,
    RESULTS,
    TEXT,
    WORD,
    Bound,
    Field,
    Kind,
    flag,
    mapping,
    name_in,
    number,
    record,
    vector,
    word,
)
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import element_types
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.kinds.laws.law import Law, called
from gudgeon.language.curves import ENDS, EXTRAPOLATE, INTERPOLATIONS, NATURAL, SPLINE, STOP
from gudgeon.language.units import (
    ACCELERATION,
    DENSITY,
    DIMENSIONLESS,
    INERTIA,
    LENGTH,
    MASS,
    PRESSURE,
    RATE,
    TIME,
    VELOCITY,
    Dimension,
)

BEARING = record(
    "bearing",
    "a pin in a hole",
    number(
        "radius",
        "radius of the hole",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "a bearing's radius is positive"),),
    ),
    number(
        "clearance",
        "radial clearance: radius of the hole − radius of the pin",
        LENGTH,
        required=True,
        bounds=(
            Bound(">", 0.0, "a clearance is positive"),
            Bound("<", "radius", "a clearance is smaller than the bearing's radius"),
        ),
    ),
    number(
        "length",
        "length of the pin in the hole",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "a bearing's length is positive"),),
    ),
    name_in("materials", "bearing_material", "of the hole"),
    name_in("materials", "journal_material", "of the pin"),
)

GUIDE = record(
    "guide",
    "a block in a slot with parallel walls: what a translational joint with play is",
    number(
        "gap",
        "half of what the slot is wider than the slider",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "a gap is positive"),),
    ),
    number(
        "half_length",
        "half the slider's length, along the axis",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "half a length is positive"),),
    ),
    number(
        "half_height",
        "half the slider's height, across the axis",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "half a height is positive"),),
    ),
    number(
        "corner_radius",
        "radius of the slider's corners, within its length and height",
        LENGTH,
        otherwise="sharp ones",
        bounds=(
            Bound(">", 0.0, "a corner's radius is positive"),
            Bound("<", "half_length", "a corner's radius is less than half the slider's length"),
            Bound("<=", "half_height", "a corner's radius is at most half the slider's height"),
        ),
    ),
    name_in("materials", "guide_material", "of the slot"),
    name_in("materials", "slider_material", "of the slider"),
)


FORMAT = "gudgeon/1"
IDEAL = "ideal"  # the scene without play

COORDINATES: Mapping[str, Dimension] = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS}
RATES: Mapping[str, Dimension] = {"vx": VELOCITY, "vy": VELOCITY, "omega": RATE}


def _joints() -> Mapping[str, Kind]:
    """Return the joint types as kinds of the section `joints`."""
    return {kind: Kind(of.title, of.fields, of.joins, (2,), of.also) for kind, of in joint_types().items()}


def _forces() -> Mapping[str, Kind]:
    """Return the force elements as kinds of the section `forces`."""
    return {kind: Kind(of.title, of.fields, of.targets, of.counts, of.also) for kind, of in element_types().items()}


def _title(law: Law, name: str) -> str:
    """Return a law's title, or for another name of the law the options that this name implies."""
    choices = law.also.get(name, {})
    options = ", ".join(f"{key}: {value}" for key, value in choices.items())
    return f"{law.name} with {options}" if choices else law.title


def _law(role: str, meaning: str) -> Field:
    """Return the field of a contact for the laws of one role."""

    def kinds() -> Mapping[str, Kind]:
        """Return the laws of the role by each of their names."""
        return {
            name: Kind(_title(law, name), law.fields_as(name), like="" if name == law.name else law.name)
            for name, law in called(role).items()
        }

    return Field(role, LAW, meaning, kinds=kinds)


_ELASTIC = "no bearing is of it"
MATERIAL = record(
    "material",
    "what bearings and shapes of bodies may be of",
    number(
        "E",
        "Young's modulus",
        PRESSURE,
        otherwise=_ELASTIC,
        bounds=(Bound(">", 0.0, "Young's modulus is positive"),),
    ),
    number(
        "nu",
        "Poisson's ratio",
        DIMENSIONLESS,
        otherwise=_ELASTIC,
        bounds=(Bound(">", -1.0, "Poisson's ratio is above -1"), Bound("<", 0.5, "Poisson's ratio is below 0.5")),
    ),
    number(
        "density",
        "density",
        DENSITY,
        otherwise="no shape is of it",
        bounds=(Bound(">", 0.0, "a density is positive"),),
    ),
)

POINT = vector("point", "where it is", LENGTH)
POINT_OF_GROUND = vector("point", "where it is, in ground axes", LENGTH)

SHAPE = record(
    "shape",
    "a plate of one thickness, from which inertia follows, and mass by density: one of the first four",
    number(
        "bar",
        "width of a rectangle that is as long as the bar; about the centre of mass",
        LENGTH,
        bounds=(Bound(">", 0.0, "a width is positive"),),
    ),
    vector(
        "rectangle",
        "length and width of a rectangle, about the centre of mass",
        LENGTH,
        bounds=(Bound(">", 0.0, "a side is positive"),),
    ),
    number(
        "disc",
        "radius of a disc, about the centre of mass",
        LENGTH,
        bounds=(Bound(">", 0.0, "a radius is positive"),),
    ),
    Field("triangle", CORNERS, "corners of a triangle, from which the centre of mass follows too"),
    number(
        "density",
        "density, where the body has no mass of its own",
        DENSITY,
        bounds=(Bound(">", 0.0, "a density is positive"),),
    ),
    name_in("materials", "material", "whose density it has, in place of that key", required=False),
    number("thickness", "goes with density or material", LENGTH, bounds=(Bound(">", 0.0, "a thickness is positive"),)),
)

_SIDE = (Bound(">", 0.0, "a side is positive"),)
SIDES = record(
    "sides",
    "three points P, Q and R of a body by their distances: P is the origin, Q on the x axis",
    number("PQ", "distance of P and Q", LENGTH, required=True, bounds=_SIDE),
    number("QR", "distance of Q and R", LENGTH, required=True, bounds=_SIDE),
    number("PR", "distance of P and R", LENGTH, required=True, bounds=_SIDE),
    word("side", "where R is, looking from P to Q", ("left", "right"), "left"),
)

_WITHOUT = "from `shape`; else no freedom may be left and nothing may have play"
BODY = record(
    "body",
    "a rigid body with its own frame; with a length a bar: its origin is the tail, its x points to the head",
    number("mass", "mass", MASS, otherwise=_WITHOUT, bounds=(Bound(">", 0.0, "a mass is positive"),)),
    number(
        "inertia",
        "moment of inertia about the centre of mass; `auto`: of a slender bar, mass length²/12; 0: a point",
        INERTIA,
        otherwise=_WITHOUT,
        words=("auto",),
        bounds=(Bound(">=", 0.0, "a moment of inertia is not negative"),),
    ),
    number(
        "length",
        "length of a bar, from tail to head",
        LENGTH,
        otherwise="it is no bar",
        bounds=(Bound(">", 0.0, "a length is positive"),),
    ),
    vector(
        "com",
        "centre of mass, in the body's frame: of a bar from its tail, x to its head",
        LENGTH,
        otherwise="mid-length of a bar, else the origin",
    ),
    mapping("points", "points by name, in the body's frame: of a bar from its tail, x to its head", POINT),
    SIDES,
    SHAPE,
)

CONTACT = record(
    "contact",
    "what happens between journal and bearing: a normal law, a film, or both",
    name_in("contacts", "extends", "contact whose keys it has where it has none of its own", required=False),
    _law("normal", "law of the normal force"),
    _law("friction", "law of dry friction"),
    _law("film", "law of the oil film"),
    _law("mixed", "law of mixed lubrication: how film and dry contact share the load; in place of transition"),
    number(
        "transition",
        "length over which the film hands over to the dry contact; where there are both",
        LENGTH,
        bounds=(Bound(">", 0.0, "the width of a transition is positive"),),
    ),
    flag("clip_ratio", "whether the law sees δ̇/δ̇⁻ within −1 and 1 only"),
    number(
        "velocity_floor",
        "least δ̇⁻ that an onset of contact stores",
        VELOCITY,
        otherwise="1e-6 m/s",
        bounds=(Bound(">", 0.0, "the least impact velocity is positive"),),
    ),
)

EVENT = record(
    "event",
    "a run is watched for an expression that crosses zero",
    number("zero", "the expression", None, required=True, varies=OF_MOTION),
    word("direction", "which crossings count", ("both", "rising", "falling"), "both"),
    word("action", "whether the run goes on", ("record", "stop"), "record"),
)

CURVE = record(
    "curve",
    "a cubic spline or monotone cubic through points, which expressions call as NAME(argument)",
    Field("points", POINTS, "points, x rising; this or a table", otherwise="the table's"),
    Field("table", TEXT, "CSV file with two columns, in the mechanism's folder or below", otherwise="the points"),
    Field("x", TEXT, "unit of x: mm, deg, s", otherwise="SI, of any dimension"),
    Field("y", TEXT, "unit of y", otherwise="SI, of any dimension"),
    word("ends", "what holds at both ends; periodic repeats, the last y is the first", ENDS, NATURAL),
    word(
        "interpolation",
        "spline: a continuous second derivative; monotone: no overshoot, dwells stay dwells",
        INTERPOLATIONS,
        SPLINE,
    ),
    word("extrapolate", "what holds outside the points: an error, the last value, or the tangent", EXTRAPOLATE, STOP),
)

SIMULATE = record(
    "simulate",
    "how this scene is run unless the run is told otherwise",
    number(
        "t_end",
        "time at which the run ends",
        TIME,
        otherwise="1 s",
        bounds=(Bound(">", 0.0, "a time span is positive"),),
    ),
    number(
        "output",
        "number of equal intervals of output",
        DIMENSIONLESS,
        otherwise="1000",
        whole=True,
        bounds=(Bound(">=", 1.0, "a run has at least one interval of output"),),
    ),
    number(
        "step",
        "length of the steps of rk4",
        TIME,
        otherwise="as long as is stable, by an estimate",
        bounds=(Bound(">", 0.0, "a time span is positive"),),
    ),
)

PLAY = record(
    "play",
    "the play in a joint",
    name_in("bearings", "bearing", "its measures, of a revolute joint", False, either="guide", otherwise="a guide"),
    name_in("guides", "guide", "its measures, of a translational joint", False, otherwise="a bearing"),
    name_in("contacts", "contact", "its laws"),
    Field(
        "contour",
        DEPTHS,
        "how much deeper than its circle the bearing is, at equal angles from its body's x axis on;"
        " a number: so many, all 0, which a run sets",
        LENGTH,
        otherwise="a circle",
    ),
)

_OF_MATERIAL = (
    "bearings.NAME.bearing_material",
    "bearings.NAME.journal_material",
    "guides.NAME.guide_material",
    "guides.NAME.slider_material",
    "bodies.NAME.shape.material",
)
SCENE = record(
    "scene",
    "which joints have play, and what goes with that",
    name_in("scenes", "extends", "scene whose entries it has besides its own", required=False),
    mapping("play", "joints with play", PLAY),
    mapping("parameters", "parameters that have another value here", number("value", "the value here", None)),
    mapping("events", "events of this scene, besides the file's", EVENT),
    Field("peaks", RESULTS, "series whose largest and smallest values over all steps a run tells", otherwise="none"),
    mapping(
        "materials",
        "materials that are others here: bearings.NAME.journal_material, bodies.NAME.shape.material",
        name_in("materials", "value", "the material here"),
        addresses=_OF_MATERIAL,
    ),
    SIMULATE,
)

PLAY_START = record(
    "apart",
    "where a joint begins in its play, in scenes that give it some: a journal in ground axes, a slider in its guide",
    vector("e", "eccentricity: from the bearing's centre to the journal's", LENGTH, otherwise="none"),
    vector("rate", "the rate of the eccentricity", VELOCITY, otherwise="none"),
    number("offset", "of a slider: how far its point is off the axis, to the axis' left", LENGTH, otherwise="none"),
    number("tilt", "of a slider: angle by which it is turned in its guide", DIMENSIONLESS, otherwise="none"),
    number("offset_rate", "the rate of the offset", VELOCITY, otherwise="none"),
    number("tilt_rate", "the rate of the tilt", RATE, otherwise="none"),
)
START = record(
    "start",
    "how the motion begins: coordinates and velocities of centres of mass, in ground axes",
    mapping(
        "guess",
        "coordinates, and points of bodies, that pick the branch",
        Field("value", PLACE, "about where", None),
        keys=COORDINATES,
    ),
    mapping("set", "coordinates that are held exactly", number("value", "where", None), keys=COORDINATES),
    mapping("rates", "velocities that drives leave free", number("value", "how fast", None), keys=RATES),
    mapping("play", "joints with play that begin out of the middle, or move there", PLAY_START),
)

EXPRESSION = number("value", "what the name stands for", None, varies=OF_MOTION)
OUTPUT = number("value", "what it is at each time", None, varies=OF_RESULTS)

FILE = record(
    "file",
    "a mechanism",
    Field("format", WORD, "the version of this format", values=(FORMAT,), required=True),
    name_in("", "name", "the mechanism's name"),
    Field("title", TEXT, "one line for people", otherwise="the name"),
    vector("gravity", "acceleration, in ground axes", ACCELERATION, otherwise="none"),
    mapping("parameters", "numbers by name, for every expression", number("value", "the number", None)),
    mapping("curves", "curves by name", CURVE),
    mapping("expressions", "expressions by name, which drives, forces, events and outputs may use", EXPRESSION),
    mapping("materials", "materials by name", MATERIAL),
    mapping("bodies", "bodies by name: one at least", BODY, required=True),
    mapping("ground", "points of the ground by name, in ground axes", POINT_OF_GROUND),
    number(
        "freedoms",
        "degrees of freedom that are meant, with all joints closed and all drives: checked",
        DIMENSIONLESS,
        otherwise="they are told where there are any",
        whole=True,
        bounds=(Bound(">=", 0.0, "a count is not negative"),),
    ),
    mapping("joints", "joints by name", Field("joint", KINDS, "one kind and its keys", kinds=_joints)),
    mapping("drives", "drives by name", Field("drive", KINDS, "one kind and its keys", kinds=lambda: DRIVES)),
    mapping("forces", "force elements by name", Field("force", KINDS, "one kind and its keys", kinds=_forces)),
    START,
    mapping("bearings", "bearings by name", BEARING),
    mapping("guides", "guides by name", GUIDE),
    mapping("contacts", "contacts by name", CONTACT),
    mapping("events", "events of every scene by name", EVENT),
    mapping("scenes", "scenes by name; ideal, without play, is always there", SCENE, given=(IDEAL,)),
    mapping("outputs", "further results by name", OUTPUT),
)
SECTIONS: Mapping[str, Field] = {field.name: field for field in FILE.fields}
