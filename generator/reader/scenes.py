"""Scenes: which joints have play, and which parameters and run settings go with that."""

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
from gudgeon.generator.reader.contacts import check_guide, parents_first
from gudgeon.generator.reader.fields import Around, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.parameters import dependency_order
from gudgeon.generator.reader.result_names import LATER, ResultNames
from gudgeon.generator.yaml import Map, Text, kind_of
from gudgeon.language.names import unknown_name
from gudgeon.language.parser import at
from gudgeon.language.tree import Expr, Name, Number, names
from gudgeon.language.units import LENGTH

LEAST_SLOTS, MOST_SLOTS = 8, 512  # of a contour


@dataclass(frozen=True)
class Parts:
    """What scenes refer to; `root` is the file, which also names what could not be read."""

    joints: Mapping[str, Joint]
    measures: Mapping[str, Mapping[str, Bearing | Guide]]  # "bearing" and "guide": the file's by name
    contacts: Mapping[str, Contact]
    parameters: Mapping[str, Quantity]
    events: Mapping[str, EventSpec]
    root: Map
    materials: Materials


@dataclass
class _Draft:
    """A scene as texts, `extends` followed."""

    play: Map
    parameters: Map
    simulate: Map
    materials: Map
    events: dict[str, EventSpec]  # read where they are written
    peaks: tuple[Text, ...] = ()


def read_scenes(reader: Reader, parts: Parts) -> dict[str, SceneSpec]:
    """All scenes in the order of the file; `ideal` is the first and always there."""
    section = parts.root.part("scenes")
    nothing = Map.make((), section.where)
    plain = _Draft(nothing, nothing, nothing, nothing, dict(parts.events))
    drafts: dict[str, _Draft] = {IDEAL: plain}
    found: dict[str, SceneSpec] = {IDEAL: SceneSpec(IDEAL, {}, {}, {}, Location(reader.file, 1, 1), plain.events)}
    for name, scene in parents_first(reader, "scene", section, (IDEAL,)):
        with reader.collect():
            if name == IDEAL and any(scene.get(key) for key in ("play", "parameters", "materials", "extends")):
                hint = "expected simulate: and events: only"
                told = "the scene ideal has no play, and the file's parameters and materials"
                raise BadValueError(told, name.where, hint)
        own = read_events(reader, scene.part("events"), f"scenes.{name}.events")
        draft = _draft(drafts[scene["extends"]] if scene.get("extends") else plain, scene, own)
        drafts[str(name)] = draft
        found[str(name)] = _scene(reader, name, draft, parts)
    return {IDEAL: found[IDEAL]} | {str(name): found[name] for name in section if name in found}


def _draft(parent: _Draft, scene: Map, events: Mapping[str, EventSpec]) -> _Draft:
    def merged(above: Map, key: str) -> Map:
        return Map.make({**above, **scene.part(key)}, scene.where)

    return _Draft(
        merged(parent.play, "play"),
        merged(parent.parameters, "parameters"),
        merged(parent.simulate, "simulate"),
        merged(parent.materials, "materials"),
        {**parent.events, **events},
        (*parent.peaks, *_listed(scene.get("peaks", ()))),
    )


def _listed(node: Any) -> tuple[Text, ...]:
    """Names of a list, or of a text with commas between."""
    if not isinstance(node, Text):
        return tuple(node)
    places = accumulate((len(part) + 1 for part in node.split(",")), initial=0)
    parts = zip(node.split(","), places, strict=False)
    found = ((part.strip(), begin + len(part) - len(part.lstrip())) for part, begin in parts)
    return tuple(Text.make(name, at(node.where, offset)) for name, offset in found if not node.is_nothing)


def _scene(reader: Reader, name: Text, draft: _Draft, parts: Parts) -> SceneSpec:
    play = {}
    for joint, use in draft.play.pairs():
        with reader.collect():
            if (made := _play(reader, joint, use, parts, f"scenes.{name}.play.{joint}")) is not None:
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
    simulate = read_fields(reader, draft.simulate, SIMULATE.fields, Around(f"scenes.{name}.simulate")).quantities
    materials = {}
    for address, text in draft.materials.pairs():
        with reader.collect():
            materials[str(address)] = parts.materials.chosen(address, text)
    scene = SceneSpec(str(name), play, parameters, simulate, name.where, draft.events, draft.peaks, materials)
    with reader.collect():
        _check_contours(scene, draft.play)
    return scene


def _play(reader: Reader, joint: Text, use: Map, parts: Parts, owner: str) -> Play | None:
    """The play in one joint; None if what it needs was told to be wrong elsewhere."""
    joints, contact = parts.root.part("joints"), use["contact"]
    errors: list[InputError] = []
    if joint not in joints:
        errors.append(unknown_name("joint", joint, joints, joint.where))
    for what in ("bearing", "guide", "contact"):
        if what in use and use[what] not in (known := parts.root.part(f"{what}s")):
            errors.append(unknown_name(what, use[what], known, use[what].where))
    contour: tuple[Quantity, ...] = ()
    with reader.collect():
        contour = _contour(reader, use, f"{owner}.contour") if "contour" in use else ()
    if errors:
        raise together(errors)
    if joint not in parts.joints:
        return None
    measured = _measured(joint, use, parts)
    if use[measured] not in parts.measures[measured] or contact not in parts.contacts:
        return None
    bearing, law = parts.measures[measured][use[measured]], parts.contacts[contact]
    if isinstance(bearing, Guide):
        check_guide(str(joint), bearing, law, use)
        return Play(bearing, law, joint.where)
    if contour and parts.contacts[contact].film is not None:
        told = f"the contour of {joint} is one with a film: the film's laws are those of a circle"
        raise BadValueError(told, use.key("contour").where, "expected a contact without a film, or no contour")
    normal = parts.contacts[contact].normal
    if contour and normal and laws()[normal.law].rigid:
        told = f"the contour of {joint} is one with {normal.law}: its blows are those of a circle"
        raise BadValueError(told, use.key("contour").where, "expected a contact whose surfaces give, or no contour")
    for depth in contour:
        reader.require(depth, "<", bearing.radius, "a contour's depth is smaller than the radius")
    return Play(bearing, law, joint.where, contour)


def _measured(joint: Text, use: Map, parts: Parts) -> str:
    """The key of the joint's measures: what has play in such a joint, "bearing" or "guide"."""
    kind = joint_types()[parts.joints[joint].kind]
    if not kind.play:
        able = [name for name, other in parts.joints.items() if joint_types()[other.kind].play]
        hint = f"expected one of: {', '.join(able)}" if able else "there are no joints here that can"
        raise BadValueError(f"joint {joint} is a {kind.title}: it cannot have play", joint.where, hint)
    for other in {"bearing", "guide"} - {kind.play}:
        if other in use:
            told = f"joint {joint} is a {kind.title}: a {kind.play} says what play it has, no {other}"
            raise BadValueError(told, use.key(other).where, f"expected {kind.play}: one of the file's {kind.play}s")
    if kind.play not in use:
        raise missing_key(kind.play, use.where, f"the play of {joint}")
    return kind.play


def _contour(reader: Reader, use: Map, address: str) -> tuple[Quantity, ...]:
    """Depths at equal angles; of a whole number so many that are 0."""
    given, where = use["contour"], use.key("contour").where
    if isinstance(given, Text):
        count = int(given) if given.isdecimal() and given.isascii() and len(given) < 6 else 0
        hint = f"expected a list of depths, or how many there are: {LEAST_SLOTS} to {MOST_SLOTS}, 128 say"
    else:
        count, hint = len(given), f"expected {LEAST_SLOTS} to {MOST_SLOTS} depths at equal angles"
    if not LEAST_SLOTS <= count <= MOST_SLOTS:
        told = f"{address} is {kind_of(given)}" if isinstance(given, Text) else f"{address} has {count} depths"
        raise BadValueError(told, where, hint)
    if isinstance(given, Text):
        zero = Quantity(address, Number(0.0, "0"), LENGTH, where, kept=True)
        return tuple(reader.keep(replace(zero, address=f"{address}.{k}")) for k in range(count))
    read = (reader.quantity(text, f"{address}.{k}", LENGTH) for k, text in enumerate(given))
    return tuple(reader.keep(replace(depth, kept=True)) for depth in read)


def check_peaks(reader: Reader, scenes: Mapping[str, SceneSpec], known: ResultNames, outputs: Iterable[str]) -> None:
    """Every name in `peaks:` is one of a result of its scene, as far as the file says; the rest is told at the run."""
    for scene in scenes.values():
        for text in scene.peaks:
            is_later = text.partition(".")[0] in LATER or text in _inner_states(scene)
            if isinstance(text, Text) and text not in outputs and not is_later:
                with reader.collect():
                    known.check_series(text, outputs)
                    known(Name(str(text)), text.where)
                    known.check_play(text, scene.name, scene.play)


def _check_contours(scene: SceneSpec, uses: Map) -> None:
    """Slopes by the angle in a bearing and by inner states of laws are not derived together."""
    with_contour = [joint for joint, play in scene.play.items() if play.contour]
    if with_contour and (states := sorted(_inner_states(scene))):
        told = f"scene {scene.name} has a contour beside a law with an inner state ({states[0]})"
        where = uses[with_contour[0]].key("contour").where
        raise BadValueError(told, where, "expected friction without an inner state, or no contour")


def _inner_states(scene: SceneSpec) -> set[str]:
    """Results that laws of friction of a scene bring with them: A.z."""
    used = {joint: play.contact.friction for joint, play in scene.play.items()}
    known = called("friction")
    return {f"{joint}.{state.name}" for joint, use in used.items() if use for state in known[use.law].states}


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


def read_events(reader: Reader, section: Map, owner: str) -> dict[str, EventSpec]:
    """The events of a section."""
    events = {}
    for name, node in section.pairs():
        with reader.collect():
            events[str(name)] = _event(reader, name, node, f"{owner}.{name}")
    return events


def _event(reader: Reader, name: Text, node: Map, owner: str) -> EventSpec:
    told = len(reader.errors)
    own = read_fields(reader, node, EVENT.fields, Around(owner))
    zero = own.quantities["zero"]
    choice = {field.name: field.choice for field in EVENT.fields if field.kind == WORD} | own.options
    if len(reader.errors) == told and not _varies(zero.value):
        hint = "expected an expression of t, or of coordinates and velocities: S9.y, L1.omega - 20 rad/s"
        raise BadValueError(f"{owner}.zero never changes: it crosses zero at no time", node["zero"].where, hint)
    return EventSpec(str(name), zero, str(choice["direction"]), str(choice["action"]), name.where)


def _varies(expr: Expr) -> bool:
    """Whether a name in it stands for time or motion; points of the ground rest."""
    paths = [name.path for name in names(expr)]
    return any(path == "t" or "." in path and path.partition(".")[0] != GROUND for path in paths)
