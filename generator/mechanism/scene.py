"""A scene: the mechanism plus which joints have play, with which laws. The unit that is compiled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from gudgeon.generator.mechanism.mechanism import EventSpec, Mechanism, Play, Quantity, following
from gudgeon.language.suggestions import unknown_name


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
