"""Reads scenes: which joints have play, with which contacts, parameters, materials, events and run settings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any

from gudgeon.errors import BadValueError, CycleError, InputError, Location, together
from gudgeon.generator.field import WORD
from gudgeon.generator.format.sections import EVENT, IDEAL, SIMULATE
from gudgeon.generator.format.shapes import missing_key
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.kinds.laws.law import called, laws
from gudgeon.generator.mechanism import (
    GROUND,
    Bearing,
    Contact,
    EventSpec,
    Guide,
    Joint,
    Play,
    Quantity,
    SceneSpec,
)
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.contacts import check_guide, order_by_inheritance
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.parameters import dependency_order
from gudgeon.generator.reader.result_names import LATER, ResultNames
from gudgeon.generator.yaml import Map, Text, kind_of
from gudgeon.language.names import unknown_name
from gudgeon.language.parser import at
from gudgeon.language.tree import Expr, Name, Number, names
from gudgeon.language.units import LENGTH

MIN_DEPTHS, MAX_DEPTHS = 8, 512  # allowed numbers of depths of a contour


@dataclass(frozen=True)
class SceneParts:
    """Contain the parts of the file that scenes refer to.

    `root` is the file's tree, which also contains the names of entries that could not be read.
    """

    joints: Mapping[str, Joint]
    bearings_and_guides: Mapping[str, Mapping[str, Bearing | Guide]]  # "bearing" and "guide": the file's by name
    contacts: Mapping[str, Contact]
    parameters: Mapping[str, Quantity]
    events: Mapping[str, EventSpec]
    root: Map
    materials: Materials


@dataclass
class _MergedScene:
    """Represent a scene as nodes of the file's tree, with `extends` resolved."""

    play: Map
    parameters: Map
    simulate: Map
    materials: Map
    events: dict[str, EventSpec]  # read in the scene that contains them
    peaks: tuple[Text, ...] = ()


def read_scenes(reader: Reader, parts: SceneParts) -> dict[str, SceneSpec]:
    """Read all scenes in the order of the file; `ideal` is the first and always present."""
    section = parts.root.part("scenes")
    nothing = Map.make((), section.where)
    plain = _MergedScene(nothing, nothing, nothing, nothing, dict(parts.events))
    drafts: dict[str, _MergedScene] = {IDEAL: plain}
    found: dict[str, SceneSpec] = {IDEAL: SceneSpec(IDEAL, {}, {}, {}, Location(reader.file, 1, 1), plain.events)}
    for name, scene in order_by_inheritance(reader, "scene", section, (IDEAL,)):
        with reader.collect():
            if name == IDEAL and any(scene.get(key) for key in ("play", "parameters", "materials", "extends")):
                hint = "expected simulate: and events: only"
                message = "the scene ideal has no play, and the file's parameters and materials"
                raise BadValueError(message, name.where, hint)
        own = read_events(reader, scene.part("events"), f"scenes.{name}.events")
        draft = _merge_scene(drafts[scene["extends"]] if scene.get("extends") else plain, scene, own)
        drafts[str(name)] = draft
        found[str(name)] = _read_scene(reader, name, draft, parts)
    return {IDEAL: found[IDEAL]} | {str(name): found[name] for name in section if name in found}


def _merge_scene(parent: _MergedScene, scene: Map, events: Mapping[str, EventSpec]) -> _MergedScene:
    """Merge a scene's entries over those of the scene that it extends."""

    def merged(above: Map, key: str) -> Map:
        """Return one section of the parent overridden by the scene's own entries."""
        return Map.make({**above, **scene.part(key)}, scene.where)

    return _MergedScene(
        merged(parent.play, "play"),
        merged(parent.parameters, "parameters"),
        merged(parent.simulate, "simulate"),
        merged(parent.materials, "materials"),
        {**parent.events, **events},
        (*parent.peaks, *_split_names(scene.get("peaks", ()))),
    )


def _split_names(node: Any) -> tuple[Text, ...]:
    """Return the names in a list, or in a text with commas between the names, each with its location."""
    if not isinstance(node, Text):
        return tuple(node)
    places = accumulate((len(part) + 1 for part in node.split(",")), initial=0)
    parts = zip(node.split(","), places, strict=False)
    found = ((part.strip(), begin + len(part) - len(part.lstrip())) for part, begin in parts)
    return tuple(Text.make(name, at(node.where, offset)) for name, offset in found if not node.is_nothing)


def _read_scene(reader: Reader, name: Text, draft: _MergedScene, parts: SceneParts) -> SceneSpec:
    """Read one merged scene: play, parameter values, materials and run settings."""
    play = {}
    for joint, use in draft.play.pairs():
        with reader.collect():
            if (made := _read_play(reader, joint, use, parts, f"scenes.{name}.play.{joint}")) is not None:
                play[str(joint)] = made
    parameters = {}
    for key, text in draft.parameters.pairs():
        with reader.collect():
            if key not in parts.parameters:
                raise unknown_name("parameter", key, parts.parameters, key.where)
            address = f"scenes.{name}.parameters.{key}"
            parameters[str(key)] = reader.quantity(text, address, reader.parameters[key])
    with reader.collect():
        _check_cycles(name, parameters, parts)
    simulate = read_fields(reader, draft.simulate, SIMULATE.fields, FieldContext(f"scenes.{name}.simulate")).quantities
    materials = {}
    for address, text in draft.materials.pairs():
        with reader.collect():
            materials[str(address)] = parts.materials.check_choice(address, text)
    scene = SceneSpec(str(name), play, parameters, simulate, name.where, draft.events, draft.peaks, materials)
    with reader.collect():
        _check_contours(scene, draft.play)
    return scene


def _read_play(reader: Reader, joint: Text, use: Map, parts: SceneParts, owner: str) -> Play | None:
    """Read the play of one joint; None if a part that it needs was reported as wrong elsewhere."""
    joints, contact = parts.root.part("joints"), use["contact"]
    errors: list[InputError] = []
    if joint not in joints:
        errors.append(unknown_name("joint", joint, joints, joint.where))
    for what in ("bearing", "guide", "contact"):
        if what in use and use[what] not in (known := parts.root.part(f"{what}s")):
            errors.append(unknown_name(what, use[what], known, use[what].where))
    contour: tuple[Quantity, ...] = ()
    with reader.collect():
        contour = _read_contour(reader, use, f"{owner}.contour") if "contour" in use else ()
    if errors:
        raise together(errors)
    if joint not in parts.joints:
        return None
    measured = _dimensions_key(joint, use, parts)
    if use[measured] not in parts.bearings_and_guides[measured] or contact not in parts.contacts:
        return None
    bearing, law = parts.bearings_and_guides[measured][use[measured]], parts.contacts[contact]
    if isinstance(bearing, Guide):
        check_guide(str(joint), bearing, law, use)
        return Play(bearing, law, joint.where)
    if contour and parts.contacts[contact].film is not None:
        message = f"the contour of {joint} is one with a film: the film's laws are those of a circle"
        raise BadValueError(message, use.key("contour").where, "expected a contact without a film, or no contour")
    normal = parts.contacts[contact].normal
    if contour and normal and laws()[normal.law].rigid:
        message = f"the contour of {joint} is one with {normal.law}: its blows are those of a circle"
        raise BadValueError(message, use.key("contour").where, "expected a contact whose surfaces give, or no contour")
    for depth in contour:
        reader.require(depth, "<", bearing.radius, "a contour's depth is smaller than the radius")
    return Play(bearing, law, joint.where, contour)


def _dimensions_key(joint: Text, use: Map, parts: SceneParts) -> str:
    """Return the key of the play's dimensions that fits the joint's type: "bearing" or "guide".

    Raises BadValueError if the joint cannot have play or the entry has the other key.
    """
    kind = joint_types()[parts.joints[joint].kind]
    if not kind.play:
        able = [name for name, other in parts.joints.items() if joint_types()[other.kind].play]
        hint = f"expected one of: {', '.join(able)}" if able else "there are no joints here that can"
        raise BadValueError(f"joint {joint} is a {kind.title}: it cannot have play", joint.where, hint)
    for other in {"bearing", "guide"} - {kind.play}:
        if other in use:
            message = f"joint {joint} is a {kind.title}: a {kind.play} says what play it has, no {other}"
            raise BadValueError(message, use.key(other).where, f"expected {kind.play}: one of the file's {kind.play}s")
    if kind.play not in use:
        raise missing_key(kind.play, use.where, f"the play of {joint}")
    return kind.play


def _read_contour(reader: Reader, use: Map, address: str) -> tuple[Quantity, ...]:
    """Read a contour: its depths (m) at equal angles, or that many zeros if the file gives a whole number."""
    given, where = use["contour"], use.key("contour").where
    if isinstance(given, Text):
        count = int(given) if given.isdecimal() and given.isascii() and len(given) < 6 else 0
        hint = f"expected a list of depths, or how many there are: {MIN_DEPTHS} to {MAX_DEPTHS}, 128 say"
    else:
        count, hint = len(given), f"expected {MIN_DEPTHS} to {MAX_DEPTHS} depths at equal angles"
    if not MIN_DEPTHS <= count <= MAX_DEPTHS:
        message = f"{address} is {kind_of(given)}" if isinstance(given, Text) else f"{address} has {count} depths"
        raise BadValueError(message, where, hint)
    if isinstance(given, Text):
        zero = Quantity(address, Number(0.0, "0"), LENGTH, where, kept=True)
        return tuple(reader.keep(replace(zero, address=f"{address}.{k}")) for k in range(count))
    read = (reader.quantity(text, f"{address}.{k}", LENGTH) for k, text in enumerate(given))
    return tuple(reader.keep(replace(depth, kept=True)) for depth in read)


def check_peaks(reader: Reader, scenes: Mapping[str, SceneSpec], known: ResultNames, outputs: Iterable[str]) -> None:
    """Collect an error for each name in `peaks:` that no result of the scene has, as far as the file tells.

    Results that only the equations determine are checked by the run.
    """
    for scene in scenes.values():
        for text in scene.peaks:
            is_later = text.partition(".")[0] in LATER or text in _inner_states(scene)
            if isinstance(text, Text) and text not in outputs and not is_later:
                with reader.collect():
                    known.check_series(text, outputs)
                    known(Name(str(text)), text.where)
                    known.check_play(text, scene.name, scene.play)


def _check_contours(scene: SceneSpec, uses: Map) -> None:
    """Raise BadValueError if a scene combines a contour with a friction law that has an inner state.

    Derivatives by the angle in the bearing and by inner states are not derived together.
    """
    with_contour = [joint for joint, play in scene.play.items() if play.contour]
    if with_contour and (states := sorted(_inner_states(scene))):
        message = f"scene {scene.name} has a contour beside a law with an inner state ({states[0]})"
        where = uses[with_contour[0]].key("contour").where
        raise BadValueError(message, where, "expected friction without an inner state, or no contour")


def _inner_states(scene: SceneSpec) -> set[str]:
    """Return the names of the inner states of a scene's friction laws, such as A.z."""
    used = {joint: play.contact.friction for joint, play in scene.play.items()}
    known = called("friction")
    return {f"{joint}.{state.name}" for joint, use in used.items() if use for state in known[use.law].states}


def _check_cycles(name: Text, own: Mapping[str, Quantity], parts: SceneParts) -> None:
    """Raise CycleError if a scene's parameter values close a cycle that the file's own values do not have."""
    if not own:
        return
    used = {**parts.parameters, **own}
    trees: dict[str, Expr] = {key: quantity.value for key, quantity in used.items()}
    places = {key: own[key].where if key in own else Location("~", 0, 0) for key in used}
    try:
        dependency_order({key: q.value for key, q in parts.parameters.items()}, places)
    except CycleError:
        return  # reported already
    try:
        dependency_order(trees, {key: quantity.where for key, quantity in used.items()})
    except CycleError as error:
        where = min(quantity.where for quantity in own.values())
        raise CycleError(f"in scene {name}, {error.message}", where, error.hint) from None


def read_events(reader: Reader, section: Map, owner: str) -> dict[str, EventSpec]:
    """Read the events of a section by name; `owner` is the section's address."""
    events = {}
    for name, node in section.pairs():
        with reader.collect():
            events[str(name)] = _read_event(reader, name, node, f"{owner}.{name}")
    return events


def _read_event(reader: Reader, name: Text, node: Map, owner: str) -> EventSpec:
    """Read one event: its expression, direction and action. An expression that never changes is an error."""
    errors_before = len(reader.errors)
    own = read_fields(reader, node, EVENT.fields, FieldContext(owner))
    zero = own.quantities["zero"]
    choice = {field.name: field.choice for field in EVENT.fields if field.kind == WORD} | own.options
    if len(reader.errors) == errors_before and not _varies_in_time(zero.value):
        hint = "expected an expression of t, or of coordinates and velocities: S9.y, L1.omega - 20 rad/s"
        raise BadValueError(f"{owner}.zero never changes: it crosses zero at no time", node["zero"].where, hint)
    return EventSpec(str(name), zero, str(choice["direction"]), str(choice["action"]), name.where)


def _varies_in_time(expr: Expr) -> bool:
    """Return whether an expression depends on time or motion; coordinates of the ground's points do not count."""
    paths = [name.path for name in names(expr)]
    return any(path == "t" or "." in path and path.partition(".")[0] != GROUND for path in paths)
