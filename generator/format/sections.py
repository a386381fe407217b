"""Declares the top-level keys of a mechanism file (bodies, joints, scenes and others) and the keys below them.

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
    declare_reference,
    flag,
    mapping,
    number,
    record,
    vector,
    word,
)
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.kinds.laws.law import Law, find_laws_of_role
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
    "dimensions of a revolute joint with play: a pin in a hole",
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
    declare_reference("materials", "bearing_material", "material of the hole"),
    declare_reference("materials", "journal_material", "material of the pin"),
)

GUIDE = record(
    "guide",
    "dimensions of a translational joint with play: a block in a slot with parallel walls",
    number(
        "gap",
        "gap on each side: half the difference of the widths of slot and slider",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "a gap is positive"),),
    ),
    number(
        "half_length",
        "half the length of the slider, along the axis",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "half a length is positive"),),
    ),
    number(
        "half_height",
        "half the height of the slider, across the axis",
        LENGTH,
        required=True,
        bounds=(Bound(">", 0.0, "half a height is positive"),),
    ),
    number(
        "corner_radius",
        "radius of the corners of the slider, within its length and height",
        LENGTH,
        otherwise="0 (sharp corners)",
        bounds=(
            Bound(">", 0.0, "a corner's radius is positive"),
            Bound("<", "half_length", "a corner's radius is less than half the slider's length"),
            Bound("<=", "half_height", "a corner's radius is at most half the slider's height"),
        ),
    ),
    declare_reference("materials", "guide_material", "material of the slot"),
    declare_reference("materials", "slider_material", "material of the slider"),
)


FORMAT = "gudgeon/1"
IDEAL = "ideal"  # the scene without play

COORDINATES: Mapping[str, Dimension] = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS}
RATES: Mapping[str, Dimension] = {"vx": VELOCITY, "vy": VELOCITY, "omega": RATE}


def _list_joint_kinds() -> Mapping[str, Kind]:
    """Return the joint types as kinds of the section `joints`, by name."""
    return {
        kind: Kind(joint_type.title, joint_type.fields, joint_type.joins, (2,), joint_type.foreign_names)
        for kind, joint_type in find_joint_types().items()
    }


def _list_force_kinds() -> Mapping[str, Kind]:
    """Return the force elements as kinds of the section `forces`, by name."""
    return {
        kind: Kind(
            element_type.title,
            element_type.fields,
            element_type.targets,
            element_type.counts,
            element_type.foreign_names,
        )
        for kind, element_type in find_element_types().items()
    }


def _format_law_title(law: Law, name: str) -> str:
    """Return a law's title; for an alias of the law the options that it fixes: "`hertz` with `dissipation: flores`"."""
    implied_options = law.also.get(name, {})
    options = ", ".join(f"{key}: {value}" for key, value in implied_options.items())
    return f"`{law.name}` with `{options}`" if implied_options else law.title


def _make_law_field(role: str, meaning: str) -> Field:
    """Return the field of a contact for the laws of one role; its kinds are found when they are needed."""

    def find_law_kinds() -> Mapping[str, Kind]:
        """Return the laws of the role by each of their names, with the keys that each name allows."""
        return {
            name: Kind(
                _format_law_title(law, name), law.list_fields_of_name(name), like="" if name == law.name else law.name
            )
            for name, law in find_laws_of_role(role).items()
        }

    return Field(role, LAW, meaning, kinds=find_law_kinds)


_ELASTIC_IF_MISSING = "unused in bearings"
MATERIAL = record(
    "material",
    "material of bearings, guides and shapes of bodies",
    number(
        "E",
        "Young's modulus",
        PRESSURE,
        otherwise=_ELASTIC_IF_MISSING,
        bounds=(Bound(">", 0.0, "Young's modulus is positive"),),
    ),
    number(
        "nu",
        "Poisson's ratio",
        DIMENSIONLESS,
        otherwise=_ELASTIC_IF_MISSING,
        bounds=(Bound(">", -1.0, "Poisson's ratio is above -1"), Bound("<", 0.5, "Poisson's ratio is below 0.5")),
    ),
    number(
        "density",
        "density",
        DENSITY,
        otherwise="unused in shapes",
        bounds=(Bound(">", 0.0, "a density is positive"),),
    ),
)

POINT = vector("point", "position", LENGTH)
POINT_OF_GROUND = vector("point", "position, in ground axes", LENGTH)

SHAPE = record(
    "shape",
    "plate of constant thickness, from which the inertia and, by the density, the mass follow;"
    " exactly one of the first four keys is needed",
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
    Field("triangle", CORNERS, "corners of a triangle, from which the centre of mass follows as well"),
    number(
        "density",
        "density, if the body has no `mass`",
        DENSITY,
        bounds=(Bound(">", 0.0, "a density is positive"),),
    ),
    declare_reference("materials", "material", "material whose density is used; instead of `density`", required=False),
    number(
        "thickness",
        "thickness, together with density or material",
        LENGTH,
        bounds=(Bound(">", 0.0, "a thickness is positive"),),
    ),
)

_SIDE_BOUNDS = (Bound(">", 0.0, "a side is positive"),)
SIDES = record(
    "sides",
    "three points P, Q and R of a body by their distances: P is the origin, Q on the x axis",
    number("PQ", "distance of P and Q", LENGTH, required=True, bounds=_SIDE_BOUNDS),
    number("QR", "distance of Q and R", LENGTH, required=True, bounds=_SIDE_BOUNDS),
    number("PR", "distance of P and R", LENGTH, required=True, bounds=_SIDE_BOUNDS),
    word("side", "side of R, seen from P towards Q", ("left", "right"), "left"),
)

_MASS_IF_MISSING = "from `shape`; otherwise allowed only if drives determine the motion and no joint has play"
BODY = record(
    "body",
    "a rigid body with its own frame; a body with a length is a bar: origin at the tail, x axis to the head",
    number("mass", "mass", MASS, otherwise=_MASS_IF_MISSING, bounds=(Bound(">", 0.0, "a mass is positive"),)),
    number(
        "inertia",
        "moment of inertia about the centre of mass; `auto`: slender bar, mass length²/12; 0: point mass",
        INERTIA,
        otherwise=_MASS_IF_MISSING,
        words=("auto",),
        bounds=(Bound(">=", 0.0, "a moment of inertia is not negative"),),
    ),
    number(
        "length",
        "length of a bar, from tail to head",
        LENGTH,
        otherwise="not a bar",
        bounds=(Bound(">", 0.0, "a length is positive"),),
    ),
    vector(
        "com",
        "centre of mass, in the frame of the body; for a bar: from the tail, x to the head",
        LENGTH,
        otherwise="mid-length of a bar, else the origin",
    ),
    mapping("points", "points by name, in the frame of the body; for a bar: from the tail, x to the head", POINT),
    SIDES,
    SHAPE,
)

CONTACT = record(
    "contact",
    "laws of the forces between journal and bearing: a normal law, a film, or both",
    declare_reference("contacts", "extends", "contact whose keys apply where this contact has none", required=False),
    _make_law_field("normal", "law of the normal force"),
    _make_law_field("friction", "law of dry friction"),
    _make_law_field("film", "law of the oil film"),
    _make_law_field(
        "mixed", "law of mixed lubrication: weights of the film force and the dry force; instead of `transition`"
    ),
    number(
        "transition",
        "length of the transition from film to dry contact, if a contact has both",
        LENGTH,
        bounds=(Bound(">", 0.0, "the width of a transition is positive"),),
    ),
    flag("clip_ratio", "whether δ̇/δ̇⁻ is limited to −1 to 1 in the law"),
    number(
        "velocity_floor",
        "smallest δ̇⁻ that is stored at the onset of a contact",
        VELOCITY,
        otherwise="1e-6 m/s",
        bounds=(Bound(">", 0.0, "the least impact velocity is positive"),),
    ),
)

EVENT = record(
    "event",
    "zero crossing of an expression, which a run locates",
    number("zero", "event function: the event is its zero", None, required=True, varies=OF_MOTION),
    word("direction", "direction of the zero crossings that count", ("both", "rising", "falling"), "both"),
    word("action", "whether an event is only recorded or also ends the run", ("record", "stop"), "record"),
)

CURVE = record(
    "curve",
    "a cubic spline or monotone cubic through points, which expressions call as NAME(argument)",
    Field("points", POINTS, "points with rising x, instead of a table", otherwise="the points of the table"),
    Field(
        "table",
        TEXT,
        "CSV file with two columns, in the folder of the mechanism or below, instead of points",
        otherwise="the points",
    ),
    Field("x", TEXT, "unit of x: mm, deg, s", otherwise="SI, of any dimension"),
    Field("y", TEXT, "unit of y", otherwise="SI, of any dimension"),
    word("ends", "end conditions; periodic: the curve repeats, and the last y equals the first", ENDS, NATURAL),
    word(
        "interpolation",
        "spline: continuous second derivative; monotone: no overshoot, so a dwell remains constant",
        INTERPOLATIONS,
        SPLINE,
    ),
    word(
        "extrapolate",
        "values outside the points: `none`, an error; `hold`, the last value; `line`, the tangent",
        EXTRAPOLATE,
        STOP,
    ),
)

SIMULATE = record(
    "simulate",
    "default settings of runs of this scene",
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
        otherwise="an estimate of the largest stable step",
        bounds=(Bound(">", 0.0, "a time span is positive"),),
    ),
)

PLAY = record(
    "play",
    "play in a joint",
    declare_reference(
        "bearings",
        "bearing",
        "bearing with the dimensions of a revolute joint",
        False,
        alternative_key="guide",
        otherwise="a guide",
    ),
    declare_reference(
        "guides", "guide", "guide with the dimensions of a translational joint", False, otherwise="a bearing"
    ),
    declare_reference("contacts", "contact", "contact whose laws apply"),
    Field(
        "contour",
        DEPTHS,
        "wear depths of the bearing at equal angles, beginning at its body's x axis;"
        " a single number: the number of depths, which are 0 until a run sets them",
        LENGTH,
        otherwise="a circle",
    ),
)

_MATERIAL_ADDRESSES = (
    "bearings.NAME.bearing_material",
    "bearings.NAME.journal_material",
    "guides.NAME.guide_material",
    "guides.NAME.slider_material",
    "bodies.NAME.shape.material",
)
SCENE = record(
    "scene",
    "joints with play, and the parameters, materials, events, peaks and run settings of this scene",
    declare_reference("scenes", "extends", "scene whose entries this scene inherits", required=False),
    mapping("play", "joints with play", PLAY),
    mapping(
        "parameters", "values that replace those of the file in this scene", number("value", "the value here", None)
    ),
    mapping("events", "events of this scene, in addition to the file's", EVENT),
    Field("peaks", RESULTS, "results whose largest and smallest values over all steps are reported", otherwise="none"),
    mapping(
        "materials",
        "materials that replace those of the file in this scene",
        declare_reference("materials", "value", "the material here"),
        addresses=_MATERIAL_ADDRESSES,
    ),
    SIMULATE,
)

PLAY_START = record(
    "value",
    "initial position in a joint with play: for a journal in ground axes, for a slider in its guide",
    vector("e", "eccentricity vector from the bearing's centre to the journal's", LENGTH, otherwise="none"),
    vector("rate", "rate of the eccentricity", VELOCITY, otherwise="none"),
    number(
        "offset",
        "of a slider: distance of its point from the axis, positive to the left of the axis",
        LENGTH,
        otherwise="none",
    ),
    number("tilt", "of a slider: angle of its rotation in the guide", DIMENSIONLESS, otherwise="none"),
    number("offset_rate", "rate of the offset", VELOCITY, otherwise="none"),
    number("tilt_rate", "rate of the tilt", RATE, otherwise="none"),
)
START = record(
    "start",
    "initial coordinates and velocities of centres of mass, in ground axes",
    mapping(
        "guess",
        "approximate coordinates and points of bodies, which select the assembly branch",
        Field("value", PLACE, "about where", None),
        keys=COORDINATES,
    ),
    mapping("set", "coordinates with exact initial values", number("value", "where", None), keys=COORDINATES),
    mapping("rates", "initial velocities that drives do not determine", number("value", "how fast", None), keys=RATES),
    mapping("play", "initial eccentricities and rates of joints with play", PLAY_START),
)

EXPRESSION = number("value", "expression that the name stands for", None, varies=OF_MOTION)
OUTPUT = number("value", "value at each time, an expression", None, varies=OF_RESULTS)

MECHANISM_FILE = record(
    "file",
    "a mechanism",
    Field("format", WORD, "version of this format", values=(FORMAT,), required=True),
    declare_reference("", "name", "name of the mechanism"),
    Field("title", TEXT, "title of the mechanism, one line", otherwise="the name"),
    vector("gravity", "acceleration of gravity, in ground axes", ACCELERATION, otherwise="none"),
    mapping("parameters", "parameters by name, which every expression may use", number("value", "the number", None)),
    mapping("curves", "curves by name", CURVE),
    mapping("expressions", "expressions by name, which drives, forces, events and outputs may use", EXPRESSION),
    mapping("materials", "materials by name", MATERIAL),
    mapping("bodies", "bodies by name, at least one", BODY, required=True),
    mapping("ground", "points of the ground by name, in ground axes", POINT_OF_GROUND),
    number(
        "freedoms",
        "expected degrees of freedom with all joints closed and all drives; an error if the computed number differs",
        DIMENSIONLESS,
        otherwise="the computed number is reported",
        whole=True,
        bounds=(Bound(">=", 0.0, "a count is not negative"),),
    ),
    mapping(
        "joints", "joints by name", Field("joint", KINDS, "one type of joint and its keys", kinds=_list_joint_kinds)
    ),
    mapping("drives", "drives by name", Field("drive", KINDS, "one type of drive and its keys", kinds=lambda: DRIVES)),
    mapping(
        "forces",
        "force elements by name",
        Field("force", KINDS, "one type of force element and its keys", kinds=_list_force_kinds),
    ),
    START,
    mapping("bearings", "bearings by name", BEARING),
    mapping("guides", "guides by name", GUIDE),
    mapping("contacts", "contacts by name", CONTACT),
    mapping("events", "events of every scene by name", EVENT),
    mapping("scenes", "scenes by name; the scene `ideal`, without play, always exists", SCENE, given=(IDEAL,)),
    mapping("outputs", "additional results by name", OUTPUT),
)
SECTIONS: Mapping[str, Field] = {field.name: field for field in MECHANISM_FILE.fields}
