"""Assemble every scene for `gudgeon check`: degrees of freedom, guesses, assemblies, and remarks on them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.branches import Assembly, find_assemblies, guess_distance
from gudgeon.assembly.closure import Closure
from gudgeon.assembly.failures import closure_error
from gudgeon.assembly.guess_warnings import guess_difference_text, no_nearer_text, unfollowed
from gudgeon.assembly.journals import check_places, in_walls
from gudgeon.assembly.mobility import Mobility, check_freedoms, find_mobility
from gudgeon.assembly.start import velocities
from gudgeon.commands.common import check_addresses, linkage_at_values
from gudgeon.errors import GudgeonError
from gudgeon.language.tree import Number
from gudgeon.model.seams import curve_seam_notes

if TYPE_CHECKING:
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
    from gudgeon.model.compiled import Array

LARGEST = 50.0  # m: larger lengths are probably numbers without a unit that were meant in mm
QUICK = 45  # number of coordinates up to which assemblies are searched without --branches
# Assemblies whose deviations from the guesses differ by less are ambiguous; rad, or fraction of the size.
ALIKE = math.radians(5.0)


@dataclass(frozen=True)
class Assembled:
    """Result of assembling one scene at its default parameters."""

    linkage: NumPyLinkage
    q: Array
    closed: Mobility
    scene: Mobility
    off: Mapping[str, float]  # guesses that are not followed: rad, or m


@dataclass(frozen=True)
class Findings:
    """Results of assembling all scenes, and the assemblies of the first scene that assembles."""

    scenes: Mapping[str, Assembled]
    failed: Mapping[str, GudgeonError]
    assemblies: tuple[Assembly, ...] = ()

    @property
    def alike(self) -> list[Assembly]:
        """Return the assemblies that follow the guesses of the file as well as the start does."""
        first = next(iter(self.scenes.values()), None)
        if first is None or not self.assemblies:
            return []
        closure = Closure(first.linkage, first.linkage.p, 0.0)
        start = self.assemblies[0].q
        return [a for a in self.assemblies[1:] if guess_distance(closure, a.q, start) < ALIKE]


def assemble_scenes(mechanism: Mechanism, branches: bool, given: Mapping[str, float | str] | None = None) -> Findings:
    """Assemble every scene; find other assemblies too if `branches` is set or the linkage is small (`QUICK`).

    given: values in place of the file's, by address. An address of one scene holds for that scene. An error of a scene
    is stored in `failed`. Raises UnknownNameError for an address that no scene has.
    """
    from gudgeon.generator.pipeline import closed_linkage

    scenes: dict[str, Assembled] = {}
    failed: dict[str, GudgeonError] = {}
    assemblies: tuple[Assembly, ...] = ()
    linkages = {name: closed_linkage(mechanism, name) for name in mechanism.scenes}
    numbers = given or {}
    check_addresses(numbers, mechanism.file, [linkage.source for linkage, _ in linkages.values()])
    for name, (linkage, rows) in linkages.items():
        linkage = linkage_at_values(mechanism, linkage, numbers)
        try:
            scenes[name] = _assembled(linkage, rows)
        except GudgeonError as error:
            failed[name] = error
            continue
        found = scenes[name]
        if (expected := mechanism.freedoms) is not None and isinstance(expected.value, Number):
            check_freedoms(expected.value.value, expected.where, found.closed)
        if not assemblies and (branches or linkage.n <= QUICK):
            assemblies = tuple(find_assemblies(linkage, linkage.p, found.q, found.closed.along))
    return Findings(scenes, failed, assemblies)


def _assembled(linkage: NumPyLinkage, rows: Sequence[int]) -> Assembled:
    """Assemble one linkage and return its position, mobility and guesses that are not followed.

    rows: indices of the scene's own constraint equations; joints with play have none. Raises AssemblyError if positions
    or velocities have no solution.
    """
    p = linkage.p
    check_places(linkage, p)
    closure = Closure(linkage, p, 0.0)
    with np.errstate(all="ignore"):
        q, closed = closure.nearest()
        if not closed:
            raise closure_error(closure, q)
        velocities(closure, q)
        every = find_mobility(linkage, p, q)
        own = every if len(rows) == every.rows else find_mobility(linkage, p, q, rows)
    return Assembled(linkage, q, every, own, unfollowed(linkage, p, q))


def summary(found: Findings) -> str:
    """Return the degrees of freedom as text, grouped by scene: "degrees of freedom 0 (ideal), 4 (dry, lubricated)"."""
    by_count: dict[int, list[str]] = {}
    for name, scene in found.scenes.items():
        by_count.setdefault(scene.scene.freedoms, []).append(name)
    if len(by_count) == 1 and not found.failed:
        return f"degrees of freedom {next(iter(by_count))}"
    counts = [f"{count} ({', '.join(names)})" for count, names in by_count.items()]
    return f"degrees of freedom {', '.join(counts)}" if counts else "none of them assembles"


def without_masses(mechanism: Mechanism, found: Findings) -> list[str]:
    """Return the names of the scenes that have degrees of freedom, if a body of the file has no mass."""
    moved = [name for name in mechanism.scenes if name in found.scenes and found.scenes[name].scene.freedoms]
    return moved if any(body.lacks for body in mechanism.bodies.values()) else []


def verdict(mechanism: Mechanism, found: Findings) -> str:
    """Return "valid", with the scenes that cannot be run although the file is valid."""
    unable = {*found.failed, *without_masses(mechanism, found)}
    names = ", ".join(name for name in mechanism.scenes if name in unable)
    return f"valid, but scene{'s' if len(unable) > 1 else ''} {names} cannot be run" if unable else "valid"


def _masses(mechanism: Mechanism, found: Findings) -> Iterator[tuple[str, str]]:
    """Yield a remark with the missing masses and inertias if a scene with degrees of freedom needs them."""
    lacking = [f"{b.name} has no {' and no '.join(b.lacks)} ({b.where})" for b in mechanism.bodies.values() if b.lacks]
    if moved := without_masses(mechanism, found):
        yield "masses", f"scene {', '.join(moved)} moves by forces and cannot be run: {', '.join(lacking)}"


def remarks(mechanism: Mechanism, found: Findings) -> Iterator[tuple[str, str]]:
    """Yield (subject, remark) pairs for the user: sizes, degrees of freedom, loose bodies, redundancy, guesses,
    assemblies.
    """
    first = next(iter(found.scenes.values()), None)
    if first is None:
        return
    if (large := _too_large(mechanism, first)) is not None:
        yield "size", large
    yield from (("curve", message) for message in curve_seam_notes(first.linkage.source, first.linkage.p))
    deep = (message for scene in found.scenes.values() for message in in_walls(scene.linkage, scene.linkage.p))
    yield from (("start", message) for message in dict.fromkeys(deep))
    closed = first.closed
    if closed.loose:
        yield "loose", f"nothing ties {', '.join(closed.loose)} to the ground: no joint, no drive"
    if closed.freedoms and mechanism.freedoms is None:
        count = f"{closed.freedoms} degree{'' if closed.freedoms == 1 else 's'} of freedom"
        meant = f"if that is meant, freedoms: {closed.freedoms}"
        yield "freedoms", f"{count} with all joints closed: {', '.join(closed.along)}; {meant}"
        yield from _without_shaft(mechanism, closed)
    yield from _masses(mechanism, found)
    if closed.redundant:
        rows = f"{closed.redundant} row{'' if closed.redundant == 1 else 's'}"
        counted = f"by counting there are {closed.gruebler} degrees of freedom, by rank {closed.freedoms}"
        yield "redundant", f"{rows} of Φ say{'s' if closed.redundant == 1 else ''} nothing new: {counted}"
    if closed.aligned:
        rows = "a row of Φ_q depends" if closed.aligned == 1 else f"{closed.aligned} rows of Φ_q depend"
        yield (
            "singular",
            (
                f"links lie in one line at the start: {rows} on the others"
                " there (a dead centre), and accelerations and reactions are not determined; begin beside it"
            ),
        )
    message = {name: off for scene in found.scenes.values() for name, off in scene.off.items()}
    for name, off in message.items():
        yield (
            "guess",
            f"{name} is {guess_difference_text(name, off)} from your guess: {no_nearer_text(first.linkage.source)}",
        )
    if not closed.freedoms or mechanism.freedoms is not None:
        yield from _ambiguous(found)


def _without_shaft(mechanism: Mechanism, closed: Mobility) -> Iterator[tuple[str, str]]:
    """Yield a remark for each driven body that can move away because no joint connects it to the drive's reference."""
    joined = {frozenset((joint.first.body, joint.second.body)) for joint in mechanism.joints.values()}
    for drive in mechanism.drives.values():
        other = drive.reference or "ground"
        moves = any(name.rpartition(".")[0] == drive.body for name in closed.along)
        if drive.kind == "angle" and moves and frozenset((drive.body, other)) not in joined:
            whom = "the ground" if other == "ground" else other
            yield "shaft", f"no joint ties {drive.body} to {whom}, against which drive {drive.name} turns it"


def _too_large(mechanism: Mechanism, scene: Assembled) -> str | None:
    """Return a remark on the largest length of the file if it exceeds `LARGEST`, otherwise None."""
    p, source = scene.linkage.p, scene.linkage.source
    lengths = {
        slot.address: abs(float(p[k]))
        for k, slot in enumerate(source.slots)
        if slot.dimension == (1, 0, 0) and not slot.address.startswith(("parameters.", "start."))
    }
    address = max(lengths, key=lengths.__getitem__, default="")
    if not address or lengths[address] <= LARGEST:
        return None
    size = lengths[address]
    return (
        f"{address} is {size:.4g} m: bare numbers are metres; if millimetres are meant, write {size:.4g} mm,"
        f" and so for the others above {LARGEST:g} m"
    )


def _ambiguous(found: Findings) -> Iterator[tuple[str, str]]:
    """Yield a remark if several assemblies follow the guesses of the file equally well."""
    if not (alike := found.alike):
        return
    start = found.assemblies[0]
    telling = next(name for name in start.guess if any(_differs(name, start, other) for other in alike))
    here, there = _value(telling, start.guess[telling]), [_value(telling, a.guess[telling]) for a in alike]
    others = ", ".join(dict.fromkeys(value for value in there if value != here))
    yield (
        "assemblies",
        (
            f"{len(alike) + 1} fit the start's guesses alike: guess {telling} too, {here} as it is taken now or "
            f"{others}; --branches lists all"
        ),
    )


def _differs(name: str, one: Assembly, other: Assembly) -> bool:
    """Return whether two assemblies have different printed values of the guess `name`."""
    return _value(name, one.guess[name]) != _value(name, other.guess[name])


def _value(name: str, x: float) -> str:
    """Return a guess as text with its unit, as a mechanism file may contain it: x in rad or m."""
    return f"{math.degrees(x):.4g} deg" if name.endswith(".theta") else f"{1e3 * x:.4g} mm"


def branches(found: Findings) -> Iterator[str]:
    """Yield a line for each assembly, with the guess that selects it."""
    if not found.assemblies:
        return
    count = len(found.assemblies)
    yield f"{count} assembl{'y' if count == 1 else 'ies'} found at the start; what picks each, as start: {{guess: …}}"
    for number, one in enumerate(found.assemblies, 1):
        here = "  as the file has it" if one.is_start else ""
        yield f"  {number}  {guess_text(one)}{here}"
    if any(one.guess for one in found.assemblies):
        yield "     each in place of the guess that the file has: beside it, both would be followed"


def guess_text(one: Assembly) -> str:
    """Return the guess that selects an assembly, as text for a mechanism file."""
    guess = ", ".join(f"{name}: {_value(name, x)}" for name, x in one.guess.items())
    return f"{{{guess}}}" if guess else "none needed"


def data(found: Findings) -> dict[str, Any]:
    """Return the results of all scenes for `--json`, by scene; angles in rad, lengths in m."""
    return {name: _scene_data(scene) for name, scene in found.scenes.items()} | {
        name: {"assembles": False, "message": str(error)} for name, error in found.failed.items()
    }


def _scene_data(scene: Assembled) -> dict[str, Any]:
    """Return the results of one assembled scene as a dictionary for `--json`."""
    return {
        "assembles": True,
        "degrees of freedom": scene.scene.freedoms,
        "with all joints closed": scene.closed.freedoms,
        "by counting": scene.closed.gruebler,
        "redundant rows": scene.closed.redundant,
        "along": list(scene.closed.along),
        "loose": list(scene.closed.loose),
        "guesses not followed": dict(scene.off),
    }


def branches_data(found: Findings) -> list[dict[str, Any]]:
    """Return all assemblies with their guesses for `--json`."""
    return [{"guess": one.guess, "start": one.is_start} for one in found.assemblies]
