"""Scenes: which joints have play, and which parameters and run settings go with that."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from gudgeon.errors import BadValueError, CycleError, InputError, Location
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism.mechanism import GROUND, Bearing, Contact, EventSpec, Joint, Play, Quantity, SceneSpec
from gudgeon.generator.reader.collector import Reader, ResultDimension
from gudgeon.generator.reader.extends import parents_first
from gudgeon.generator.reader.parameters import dependency_order
from gudgeon.generator.yaml.shapes import EventShape, FileShape, PlayShape, SceneShape
from gudgeon.generator.yaml.tree import Text, kind_of
from gudgeon.language.names import check_label
from gudgeon.language.suggestions import known_hint, unknown_name
from gudgeon.language.tree import Expr, names
from gudgeon.language.units import DIMENSIONLESS, TIME, Dimension

# the first of each is the default
DIRECTIONS = ("both", "rising", "falling")
ACTIONS = ("record", "stop")

IDEAL = "ideal"
SIMULATE: Mapping[str, Dimension] = {"t_end": TIME, "output": DIMENSIONLESS, "step": TIME}


@dataclass(frozen=True)
class Parts:
    """What scenes refer to; `named` are all that the file names, also those that could not be read."""

    joints: Mapping[str, Joint]
    bearings: Mapping[str, Bearing]
    contacts: Mapping[str, Contact]
    parameters: Mapping[str, Quantity]
    events: Mapping[str, EventSpec]
    shape: FileShape
    motion: ResultDimension  # of the names that an event's expression may use


@dataclass
class _Draft:
    """A scene as texts, `extends` followed."""

    play: dict[Text, PlayShape] = field(default_factory=dict)
    parameters: dict[Text, Text] = field(default_factory=dict)
    simulate: dict[str, Text] = field(default_factory=dict)
    events: dict[str, EventSpec] = field(default_factory=dict)  # read where they are written


def read_scenes(reader: Reader, parts: Parts) -> dict[str, SceneSpec]:
    """All scenes in the order of the file; `ideal` is the first and always there."""
    section = parts.shape.scenes
    plain = _Draft(events=dict(parts.events))
    drafts: dict[str, _Draft] = {IDEAL: plain}
    found: dict[str, SceneSpec] = {IDEAL: SceneSpec(IDEAL, {}, {}, {}, Location(reader.file, 1, 1), plain.events)}
    for name, scene in parents_first(reader, "scene", section, (IDEAL,)):
        with reader.collect():
            check_label(name, "scene", name.where)
            if name == IDEAL and (scene.play or scene.parameters or scene.extends):
                hint = "expected simulate: and events: only"
                raise BadValueError("the scene ideal has no play, and the file's parameters", name.where, hint)
        own = read_events(reader, scene.events, f"scenes.{name}.events", parts.motion)
        draft = _draft(drafts[scene.extends] if scene.extends else plain, scene, own)
        drafts[str(name)] = draft
        found[str(name)] = _scene(reader, name, draft, parts)
    return {IDEAL: found[IDEAL]} | {str(name): found[name] for name in section if name in found}


def _draft(parent: _Draft, scene: SceneShape, events: Mapping[str, EventSpec]) -> _Draft:
    own = {key: getattr(scene.simulate, key) for key in SIMULATE} if scene.simulate else {}
    return _Draft(
        {**parent.play, **scene.play},
        {**parent.parameters, **scene.parameters},
        {**parent.simulate, **{key: text for key, text in own.items() if text is not None}},
        {**parent.events, **events},
    )


def _scene(reader: Reader, name: Text, draft: _Draft, parts: Parts) -> SceneSpec:
    play = {}
    for joint, use in draft.play.items():
        with reader.collect():
            if (made := _play(joint, use, parts)) is not None:
                play[str(joint)] = made
    parameters = {}
    for key, text in draft.parameters.items():
        with reader.collect():
            if key not in parts.parameters:
                raise unknown_name("parameter", key, parts.parameters, key.where)
            address = f"scenes.{name}.parameters.{key}"
            parameters[str(key)] = reader.quantity(text, address, reader.parameters[key])
    with reader.collect():
        _check_cycles(name, parameters, parts)
    simulate = {}
    for option, dimension in SIMULATE.items():
        if option in draft.simulate:
            simulate[option] = reader.quantity(draft.simulate[option], f"scenes.{name}.simulate.{option}", dimension)
            if option == "output":
                reader.require(simulate[option], ">=", 1.0, "a run has at least one interval of output")
            else:
                reader.require(simulate[option], ">", 0.0, "a time span is positive")
    return SceneSpec(str(name), play, parameters, simulate, name.where, draft.events)


def _play(joint: Text, use: PlayShape, parts: Parts) -> Play | None:
    """The play in one joint; None if what it needs was told to be wrong elsewhere."""
    if joint not in parts.shape.joints:
        raise unknown_name("joint", joint, parts.shape.joints, joint.where)
    errors: list[InputError] = []
    for what, text, known in (
        ("bearing", use.bearing, parts.shape.bearings),
        ("contact", use.contact, parts.shape.contacts),
    ):
        if text not in known:
            errors.append(unknown_name(what, text, known, text.where))
    if errors:
        raise errors[0]
    if joint not in parts.joints or use.bearing not in parts.bearings or use.contact not in parts.contacts:
        return None
    kind = joint_types()[parts.joints[joint].kind]
    if not kind.may_have_play:
        able = [name for name, other in parts.joints.items() if joint_types()[other.kind].may_have_play]
        hint = f"expected one of: {', '.join(able)}" if able else "there are no joints here that can"
        raise BadValueError(f"joint {joint} is a {kind.title}: it cannot have play", joint.where, hint)
    return Play(parts.bearings[use.bearing], parts.contacts[use.contact], joint.where)


def _check_cycles(name: Text, own: Mapping[str, Quantity], parts: Parts) -> None:
    """A scene's values may close a cycle that the file's own do not."""
    if not own:
        return
    used = {**parts.parameters, **own}
    trees: dict[str, Expr] = {key: quantity.value for key, quantity in used.items()}
    places = {key: own[key].where if key in own else Location("~", 0, 0) for key in used}
    try:
        dependency_order({key: q.value for key, q in parts.parameters.items()}, places)
    except CycleError:
        return  # told already
    try:
        dependency_order(trees, {key: quantity.where for key, quantity in used.items()})
    except CycleError as error:
        where = min(quantity.where for quantity in own.values())
        raise CycleError(f"in scene {name}, {error.message}", where, error.hint) from None


def read_events(
    reader: Reader, section: Mapping[Text, EventShape], owner: str, motion: ResultDimension
) -> dict[str, EventSpec]:
    """The events of a section; `motion` gives the dimensions of the coordinates and velocities that they may use."""
    events = {}
    for name, shape in section.items():
        with reader.collect():
            check_label(name, "event", name.where)
        with reader.collect():
            events[str(name)] = _event(reader, name, shape, f"{owner}.{name}", motion)
    return events


def _event(reader: Reader, name: Text, shape: EventShape, owner: str, motion: ResultDimension) -> EventSpec:
    told = len(reader.errors)
    zero = reader.quantity(shape.zero, f"{owner}.zero", None, time=True, result=motion)
    if len(reader.errors) == told and not _varies(zero.value):
        hint = "expected an expression of t, or of coordinates and velocities: S9.y, L1.omega - 20 rad/s"
        raise BadValueError(f"{owner}.zero never changes: it crosses zero at no time", shape.zero.where, hint)
    with reader.collect():
        direction = _word(shape.direction, "direction", DIRECTIONS)
        return EventSpec(str(name), zero, direction, _word(shape.action, "action", ACTIONS), name.where)
    return EventSpec(str(name), zero, DIRECTIONS[0], ACTIONS[0], name.where)


def _varies(expr: Expr) -> bool:
    """Whether a name in it stands for time or motion; points of the ground rest."""
    paths = [name.path for name in names(expr)]
    return any(path == "t" or "." in path and path.partition(".")[0] != GROUND for path in paths)


def _word(text: Text | None, key: str, words: tuple[str, ...]) -> str:
    """One of some words; the first, where nothing is written."""
    if text is None:
        return words[0]
    if text not in words:
        raise BadValueError(f"{key} is {kind_of(text)}", text.where, known_hint(text, words))
    return str(text)
