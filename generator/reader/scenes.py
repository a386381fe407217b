"""Reads scenes: which joints have play, with which contacts, parameters, materials, events and run settings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any

from gudgeon.errors import BadValueError, CycleError, InputError, Location, combine_errors
from gudgeon.generator.field import WORD
from gudgeon.generator.format.sections import EVENT, IDEAL, SIMULATE
from gudgeon.generator.format.shapes import make_missing_key_error
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.kinds.laws.law import find_all_laws, find_laws_of_role
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
from gudgeon.generator.reader.contacts import check_contact_in_guide, order_by_inheritance
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.parameters import sort_by_dependencies
from gudgeon.generator.reader.result_names import OWNERS_CHECKED_BY_RUN, ResultNames
from gudgeon.generator.yaml import Map, Text, describe_node
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.parser import offset_location
from gudgeon.language.tree import Expr, Name, Number, iterate_names
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
    """Read all scenes in the order of the file; `ideal` is the first and always present.

    Errors are collected, also for `ideal` with play, parameters or materials. Scenes that extend an unknown scene are
    left out.
    """
    section = parts.root.get_mapping("scenes")
    empty_map = Map.make_map((), section.where)
    ideal_scene = _MergedScene(empty_map, empty_map, empty_map, empty_map, dict(parts.events))
    merged_scenes: dict[str, _MergedScene] = {IDEAL: ideal_scene}
    scenes: dict[str, SceneSpec] = {
        IDEAL: SceneSpec(IDEAL, {}, {}, {}, Location(reader.file, 1, 1), ideal_scene.events)
    }
    for name, scene in order_by_inheritance(reader, "scene", section, (IDEAL,)):
        with reader.collect_errors():
            if name == IDEAL and any(scene.get(key) for key in ("play", "parameters", "materials", "extends")):
                hint = "expected simulate: and events: only"
                message = "the scene ideal has the file's parameters and materials, and no play"
                raise BadValueError(message, name.where, hint)
        events = read_events(reader, scene.get_mapping("events"), f"scenes.{name}.events")
        merged_scene = _merge_scene(
            merged_scenes[scene["extends"]] if scene.get("extends") else ideal_scene, scene, events
        )
        merged_scenes[str(name)] = merged_scene
        scenes[str(name)] = _read_scene(reader, name, merged_scene, parts)
    return {IDEAL: scenes[IDEAL]} | {str(name): scenes[name] for name in section if name in scenes}


def _merge_scene(parent: _MergedScene, scene: Map, events: Mapping[str, EventSpec]) -> _MergedScene:
    """Return a scene's entries merged over those of the scene that it extends; names in `peaks` are appended.

    `events` are the scene's own events.
    """

    def merge_section(parent_section: Map, key: str) -> Map:
        """Return one section of the parent, overridden by the scene's own entries at `key`."""
        return Map.make_map({**parent_section, **scene.get_mapping(key)}, scene.where)

    return _MergedScene(
        merge_section(parent.play, "play"),
        merge_section(parent.parameters, "parameters"),
        merge_section(parent.simulate, "simulate"),
        merge_section(parent.materials, "materials"),
        {**parent.events, **events},
        (*parent.peaks, *_split_names(scene.get("peaks", ()))),
    )


def _split_names(node: Any) -> tuple[Text, ...]:
    """Return the names in a list, or in a text with commas between the names, each with its location.

    () for an empty text.
    """
    if not isinstance(node, Text):
        return tuple(node)
    offsets = accumulate((len(part) + 1 for part in node.split(",")), initial=0)
    parts = zip(node.split(","), offsets, strict=False)
    names_and_offsets = ((part.strip(), begin_offset + len(part) - len(part.lstrip())) for part, begin_offset in parts)
    return tuple(
        Text.make_text(name, offset_location(node.where, offset))
        for name, offset in names_and_offsets
        if not node.is_null
    )


def _read_scene(reader: Reader, name: Text, merged_scene: _MergedScene, parts: SceneParts) -> SceneSpec:
    """Return one merged scene: play, parameter values, materials and run settings.

    Errors are collected; entries with errors are left out. An error is collected for a cycle of parameters, and for a
    contour together with a friction law that has an internal state.
    """
    play = {}
    for joint, play_node in merged_scene.play.list_entries():
        with reader.collect_errors():
            if (joint_play := _read_play(reader, joint, play_node, parts, f"scenes.{name}.play.{joint}")) is not None:
                play[str(joint)] = joint_play
    parameters = {}
    for key, text in merged_scene.parameters.list_entries():
        with reader.collect_errors():
            if key not in parts.parameters:
                raise make_unknown_name_error("parameter", key, parts.parameters, key.where)
            address = f"scenes.{name}.parameters.{key}"
            parameters[str(key)] = reader.read_quantity(text, address, reader.parameters[key])
    with reader.collect_errors():
        _check_parameter_cycles(name, parameters, parts)
    simulate = read_fields(
        reader, merged_scene.simulate, SIMULATE.fields, FieldContext(f"scenes.{name}.simulate")
    ).quantities
    materials = {}
    for address, text in merged_scene.materials.list_entries():
        with reader.collect_errors():
            materials[str(address)] = parts.materials.resolve_choice(address, text)
    scene = SceneSpec(
        str(name), play, parameters, simulate, name.where, merged_scene.events, merged_scene.peaks, materials
    )
    with reader.collect_errors():
        _check_contour_friction(scene, merged_scene.play)
    return scene


def _read_play(reader: Reader, joint: Text, play_node: Map, parts: SceneParts, address: str) -> Play | None:
    """Return the play of one joint; None if a part that it needs was reported as wrong elsewhere.

    `play_node` is the node of the play, `address` its address. Raises an InputError for unknown names, a joint that
    cannot have play, and a contact that does not fit the bearing, guide or contour.
    """
    joints, contact = parts.root.get_mapping("joints"), play_node["contact"]
    errors: list[InputError] = []
    if joint not in joints:
        errors.append(make_unknown_name_error("joint", joint, joints, joint.where))
    for reference_key in ("bearing", "guide", "contact"):
        if reference_key in play_node and play_node[reference_key] not in (
            section := parts.root.get_mapping(f"{reference_key}s")
        ):
            errors.append(
                make_unknown_name_error(
                    reference_key, play_node[reference_key], section, play_node[reference_key].where
                )
            )
    contour: tuple[Quantity, ...] = ()
    with reader.collect_errors():
        contour = _read_contour(reader, play_node, f"{address}.contour") if "contour" in play_node else ()
    if errors:
        raise combine_errors(errors)
    if joint not in parts.joints:
        return None
    dimensions_key = _find_dimensions_key(joint, play_node, parts)
    if play_node[dimensions_key] not in parts.bearings_and_guides[dimensions_key] or contact not in parts.contacts:
        return None
    bearing, law = parts.bearings_and_guides[dimensions_key][play_node[dimensions_key]], parts.contacts[contact]
    if isinstance(bearing, Guide):
        check_contact_in_guide(str(joint), bearing, law, play_node)
        return Play(bearing, law, joint.where)
    if contour and parts.contacts[contact].film is not None:
        message = f"{joint} has a contour and a film: laws of films describe circular bearings"
        raise BadValueError(
            message, play_node.find_key("contour").where, "expected a contact without a film, or no contour"
        )
    normal = parts.contacts[contact].normal
    if contour and normal and find_all_laws()[normal.law].rigid:
        message = f"{joint} has a contour and {normal.law}: its impacts are those of circular bearings"
        raise BadValueError(
            message, play_node.find_key("contour").where, "expected a contact with compliant surfaces, or no contour"
        )
    for depth in contour:
        reader.add_condition(depth, "<", bearing.radius, "a contour's depth is smaller than the radius")
    return Play(bearing, law, joint.where, contour)


def _find_dimensions_key(joint: Text, play_node: Map, parts: SceneParts) -> str:
    """Return the key of the play's dimensions that fits the joint's type: "bearing" or "guide".

    Raises BadValueError if the joint cannot have play or the entry has the other key, MissingKeyError without the key.
    """
    joint_type = find_joint_types()[parts.joints[joint].kind]
    if not joint_type.play:
        joints_with_play = [name for name, other_key in parts.joints.items() if find_joint_types()[other_key.kind].play]
        hint = (
            f"expected one of: {', '.join(joints_with_play)}"
            if joints_with_play
            else "no joint of this file can have play"
        )
        raise BadValueError(f"joint {joint} is a {joint_type.title}: it cannot have play", joint.where, hint)
    for other_key in {"bearing", "guide"} - {joint_type.play}:
        if other_key in play_node:
            message = f"joint {joint} is a {joint_type.title}: its play needs a {joint_type.play}, not a {other_key}"
            raise BadValueError(
                message,
                play_node.find_key(other_key).where,
                f"expected {joint_type.play}: one of the file's {joint_type.play}s",
            )
    if joint_type.play not in play_node:
        raise make_missing_key_error(joint_type.play, play_node.where, f"the play of {joint}")
    return joint_type.play


def _read_contour(reader: Reader, play_node: Map, address: str) -> tuple[Quantity, ...]:
    """Return a contour as run-time parameters: depths (m) at equal angles, or zeros if the file gives their count.

    Raises BadValueError for another number of depths than MIN_DEPTHS to MAX_DEPTHS.
    """
    node, location = play_node["contour"], play_node.find_key("contour").where
    if isinstance(node, Text):
        count = int(node) if node.isdecimal() and node.isascii() and len(node) < 6 else 0
        hint = f"expected a list of depths, or the number of depths: {MIN_DEPTHS} to {MAX_DEPTHS}, such as 128"
    else:
        count, hint = len(node), f"expected {MIN_DEPTHS} to {MAX_DEPTHS} depths at equal angles"
    if not MIN_DEPTHS <= count <= MAX_DEPTHS:
        message = f"{address} is {describe_node(node)}" if isinstance(node, Text) else f"{address} has {count} depths"
        raise BadValueError(message, location, hint)
    if isinstance(node, Text):
        zero = Quantity(address, Number(0.0, "0"), LENGTH, location, is_always_parameter=True)
        return tuple(reader.register_quantity(replace(zero, address=f"{address}.{index}")) for index in range(count))
    depths = (reader.read_quantity(text, f"{address}.{index}", LENGTH) for index, text in enumerate(node))
    return tuple(reader.register_quantity(replace(depth, is_always_parameter=True)) for depth in depths)


def check_peaks(
    reader: Reader, scenes: Mapping[str, SceneSpec], result_names: ResultNames, outputs: Iterable[str]
) -> None:
    """Collect an error for each name in `peaks:` that no result of the scene has, as far as the file determines it.

    `result_names` are the names of results, `outputs` those of outputs. Results that only the equations determine, such
    as multipliers, are checked by the run.
    """
    for scene in scenes.values():
        for name in scene.peaks:
            is_checked_by_run = name.partition(".")[0] in OWNERS_CHECKED_BY_RUN or name in _find_internal_states(scene)
            if isinstance(name, Text) and name not in outputs and not is_checked_by_run:
                with reader.collect_errors():
                    result_names.reject_name_without_dot(name, outputs)
                    result_names(Name(str(name)), name.where)
                    result_names.check_result_availability(name, scene.name, scene.play)


def _check_contour_friction(scene: SceneSpec, play_section: Map) -> None:
    """Raise BadValueError if a scene combines a contour with a friction law that has an internal state.

    Derivatives by the angle in the bearing and by internal states are not derived together. `play_section` is the
    scene's `play`.
    """
    with_contour = [joint for joint, play in scene.play.items() if play.contour]
    if with_contour and (states := sorted(_find_internal_states(scene))):
        message = f"scene {scene.name} has a contour and a law with an internal state ({states[0]})"
        location = play_section[with_contour[0]].find_key("contour").where
        raise BadValueError(message, location, "expected friction without an internal state, or no contour")


def _find_internal_states(scene: SceneSpec) -> set[str]:
    """Return the names of the internal states of a scene's friction laws, such as A.z."""
    friction_laws = {joint: play.contact.friction for joint, play in scene.play.items()}
    laws_of_friction = find_laws_of_role("friction")
    return {
        f"{joint}.{state.name}"
        for joint, friction in friction_laws.items()
        if friction
        for state in laws_of_friction[friction.law].states
    }


def _check_parameter_cycles(name: Text, scene_parameters: Mapping[str, Quantity], parts: SceneParts) -> None:
    """Raise CycleError if a scene's parameter values close a cycle that the file's own values do not have.

    A cycle of the file's own values was reported when they were read.
    """
    if not scene_parameters:
        return
    parameters = {**parts.parameters, **scene_parameters}
    trees: dict[str, Expr] = {key: quantity.value for key, quantity in parameters.items()}
    locations = {
        key: scene_parameters[key].where if key in scene_parameters else Location("~", 0, 0) for key in parameters
    }
    try:
        sort_by_dependencies({key: q.value for key, q in parts.parameters.items()}, locations)
    except CycleError:
        return  # reported already
    try:
        sort_by_dependencies(trees, {key: quantity.where for key, quantity in parameters.items()})
    except CycleError as error:
        location = min(quantity.where for quantity in scene_parameters.values())
        raise CycleError(f"in scene {name}, {error.message}", location, error.hint) from None


def read_events(reader: Reader, section: Map, address: str) -> dict[str, EventSpec]:
    """Return the events of a section by name, of the file or of a scene; `address` is the section's address.

    Errors are collected in the reader, and events with errors are left out.
    """
    events = {}
    for name, node in section.list_entries():
        with reader.collect_errors():
            events[str(name)] = _read_event(reader, name, node, f"{address}.{name}")
    return events


def _read_event(reader: Reader, name: Text, node: Map, address: str) -> EventSpec:
    """Return one event: its expression, direction and action.

    Errors of its keys are collected. Raises BadValueError for an expression that never changes.
    """
    errors_before = len(reader.errors)
    values = read_fields(reader, node, EVENT.fields, FieldContext(address))
    zero = values.quantities["zero"]
    options = {field.name: field.default_option for field in EVENT.fields if field.kind == WORD} | values.options
    if len(reader.errors) == errors_before and not _is_time_dependent(zero.value):
        hint = "expected an expression of t, or of coordinates and velocities: S9.y, L1.omega - 20 rad/s"
        raise BadValueError(f"{address}.zero never changes, so that it has no zero crossing", node["zero"].where, hint)
    return EventSpec(str(name), zero, str(options["direction"]), str(options["action"]), name.where)


def _is_time_dependent(expr: Expr) -> bool:
    """Return whether an expression depends on time or motion; coordinates of the ground's points do not count."""
    paths = [name.path for name in iterate_names(expr)]
    return any(path == "t" or "." in path and path.partition(".")[0] != GROUND for path in paths)
