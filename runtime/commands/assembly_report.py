"""Assemble every scene for `gudgeon check`: degrees of freedom, guesses, assemblies, and remarks on them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.branches import Assembly, compute_guess_distance, find_assemblies
from gudgeon.assembly.closure import AssemblyProblem
from gudgeon.assembly.failures import make_closure_error
from gudgeon.assembly.guess_warnings import describe_missing_assembly, find_guess_deviations, format_guess_difference
from gudgeon.assembly.journals import check_journal_positions, describe_journals_in_walls
from gudgeon.assembly.mobility import Mobility, check_degrees_of_freedom, find_mobility
from gudgeon.assembly.start import compute_start_velocities
from gudgeon.commands.common import apply_settings, check_addresses
from gudgeon.errors import GudgeonError
from gudgeon.language.tree import Number
from gudgeon.model.period_jumps import iterate_period_jump_warnings

if TYPE_CHECKING:
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage
    from gudgeon.model.compiled import Array

MAX_LENGTH = 50.0  # m, above which a length is probably a number of mm without its unit
MAX_SEARCHED_COORDINATES = 45  # number of coordinates up to which assemblies are searched without --branches
# Assemblies whose deviations from the guesses differ by less are ambiguous; rad, or fraction of the size.
MAX_GUESS_DIFFERENCE = math.radians(5.0)


@dataclass(frozen=True)
class AssembledScene:
    """Result of assembling one scene: position, mobility without play and with the scene's constraints, deviations
    from guesses.
    """

    linkage: NumPyLinkage
    q: Array
    closed_mobility: Mobility
    scene_mobility: Mobility
    guess_deviations: Mapping[str, float]  # name of a guess that is not followed -> deviation, rad or m


@dataclass(frozen=True)
class Findings:
    """Results of assembling all scenes, and the assemblies of the first scene that assembles."""

    scenes: Mapping[str, AssembledScene]
    errors: Mapping[str, GudgeonError]
    assemblies: tuple[Assembly, ...] = ()

    @property
    def equivalent_assemblies(self) -> list[Assembly]:
        """Return the other assemblies whose guesses differ from the start's by less than MAX_GUESS_DIFFERENCE.

        [] if no assemblies were searched.
        """
        first = next(iter(self.scenes.values()), None)
        if first is None or not self.assemblies:
            return []
        problem = AssemblyProblem(first.linkage, first.linkage.p, 0.0)
        start = self.assemblies[0].q
        return [a for a in self.assemblies[1:] if compute_guess_distance(problem, a.q, start) < MAX_GUESS_DIFFERENCE]


def assemble_scenes(
    mechanism: Mechanism, branches: bool, settings: Mapping[str, float | str] | None = None
) -> Findings:
    """Assemble every scene of a mechanism; find its assemblies if `branches`, or if the linkage is small.

    Small: up to MAX_SEARCHED_COORDINATES coordinates. Assemblies are those of the first scene that can be assembled.
    settings: values by address that replace the file's; each applies to the scenes that have the address. An error of a
    scene is stored in `errors` of the returned Findings. Raises UnknownNameError for an address that no scene has, and
    InputError if the file's `freedoms` are wrong.
    """
    from gudgeon.generator.pipeline import build_closed_linkage

    scenes: dict[str, AssembledScene] = {}
    errors: dict[str, GudgeonError] = {}
    assemblies: tuple[Assembly, ...] = ()
    linkages = {name: build_closed_linkage(mechanism, name) for name in mechanism.scenes}
    settings = settings or {}
    check_addresses(settings, mechanism.file, [linkage.source for linkage, _ in linkages.values()])
    for name, (linkage, rows) in linkages.items():
        linkage = apply_settings(mechanism, linkage, settings)
        try:
            scenes[name] = _assemble_scene(linkage, rows)
        except GudgeonError as error:
            errors[name] = error
            continue
        assembled_scene = scenes[name]
        if (expected := mechanism.freedoms) is not None and isinstance(expected.value, Number):
            check_degrees_of_freedom(expected.value.value, expected.where, assembled_scene.closed_mobility)
        if not assemblies and (branches or linkage.n <= MAX_SEARCHED_COORDINATES):
            assemblies = tuple(
                find_assemblies(
                    linkage, linkage.p, assembled_scene.q, assembled_scene.closed_mobility.independent_coordinates
                )
            )
    return Findings(scenes, errors, assemblies)


def _assemble_scene(linkage: NumPyLinkage, equation_indices: Sequence[int]) -> AssembledScene:
    """Assemble one linkage and return its position, mobility and the guesses that are not followed.

    equation_indices: those of the scene; joints with play have no equations. Raises AssemblyError if the linkage
    without play has no position or no velocities, or if a journal is too deep in its bearing's wall.
    """
    p = linkage.p
    check_journal_positions(linkage, p)
    problem = AssemblyProblem(linkage, p, 0.0)
    with np.errstate(all="ignore"):
        q, closed = problem.find_nearest_configuration()
        if not closed:
            raise make_closure_error(problem, q)
        compute_start_velocities(problem, q)
        closed_mobility = find_mobility(linkage, p, q)
        mobility = (
            closed_mobility
            if len(equation_indices) == closed_mobility.rows
            else find_mobility(linkage, p, q, equation_indices)
        )
    return AssembledScene(linkage, q, closed_mobility, mobility, find_guess_deviations(linkage, p, q))


def format_degrees_of_freedom(findings: Findings) -> str:
    """Return the degrees of freedom as text, grouped by scene: "degrees of freedom 0 (ideal), 4 (dry, lubricated)".

    If all scenes agree, names are left out; if none assembles, the text says so.
    """
    by_count: dict[int, list[str]] = {}
    for name, scene in findings.scenes.items():
        by_count.setdefault(scene.scene_mobility.freedoms, []).append(name)
    if len(by_count) == 1 and not findings.errors:
        return f"degrees of freedom {next(iter(by_count))}"
    counts = [f"{count} ({', '.join(names)})" for count, names in by_count.items()]
    return f"degrees of freedom {', '.join(counts)}" if counts else "no scene assembles"


def list_scenes_without_masses(mechanism: Mechanism, findings: Findings) -> list[str]:
    """Return the names of the scenes that have degrees of freedom, if a body of the file lacks mass or inertia; else
    [].
    """
    dynamic_scenes = [
        name for name in mechanism.scenes if name in findings.scenes and findings.scenes[name].scene_mobility.freedoms
    ]
    return dynamic_scenes if any(body.missing_keys for body in mechanism.bodies.values()) else []


def format_verdict(mechanism: Mechanism, findings: Findings) -> str:
    """Return "valid", followed by the scenes that cannot be run although the file is valid.

    They do not assemble, or need missing masses.
    """
    failed_scenes = {*findings.errors, *list_scenes_without_masses(mechanism, findings)}
    names = ", ".join(name for name in mechanism.scenes if name in failed_scenes)
    return (
        f"valid, but scene{'s' if len(failed_scenes) > 1 else ''} {names} cannot be run" if failed_scenes else "valid"
    )


def _yield_mass_remark(mechanism: Mechanism, findings: Findings) -> Iterator[tuple[str, str]]:
    """Yield a remark (subject, text) if scenes with degrees of freedom need masses or inertias that the file lacks.

    The text lists the scenes, which cannot be run, and the missing keys of each body with their locations.
    """
    missing_texts = [
        f"{b.name} has no {' and no '.join(b.missing_keys)} ({b.where})"
        for b in mechanism.bodies.values()
        if b.missing_keys
    ]
    if dynamic_scenes := list_scenes_without_masses(mechanism, findings):
        yield (
            "masses",
            f"scene {', '.join(dynamic_scenes)} has degrees of freedom and cannot be run: {', '.join(missing_texts)}",
        )


def yield_remarks(mechanism: Mechanism, findings: Findings) -> Iterator[tuple[str, str]]:
    """Yield (subject, remark) pairs on the assembled scenes, for the user of `gudgeon check`.

    Subjects are sizes, curves, start, loose bodies, degrees of freedom, masses, redundancy, singularity, guesses and
    assemblies. Nothing is yielded if no scene assembles.
    """
    first = next(iter(findings.scenes.values()), None)
    if first is None:
        return
    if (size_remark := _format_size_remark(mechanism, first)) is not None:
        yield "size", size_remark
    yield from (("curve", message) for message in iterate_period_jump_warnings(first.linkage.source, first.linkage.p))
    journal_messages = (
        message
        for scene in findings.scenes.values()
        for message in describe_journals_in_walls(scene.linkage, scene.linkage.p)
    )
    yield from (("start", message) for message in dict.fromkeys(journal_messages))
    closed = first.closed_mobility
    if closed.unconnected_bodies:
        yield "loose", f"no joint or drive connects {', '.join(closed.unconnected_bodies)} to the ground"
    if closed.freedoms and mechanism.freedoms is None:
        count = f"{closed.freedoms} degree{'' if closed.freedoms == 1 else 's'} of freedom"
        remedy = f"if that is intended, write freedoms: {closed.freedoms}"
        yield "freedoms", f"{count} with all joints closed: {', '.join(closed.independent_coordinates)}; {remedy}"
        yield from _yield_unattached_body_remarks(mechanism, closed)
    yield from _yield_mass_remark(mechanism, findings)
    if closed.redundant:
        rows = "1 row of Φ is" if closed.redundant == 1 else f"{closed.redundant} rows of Φ are"
        counted = f"{closed.gruebler} degrees of freedom by counting, {closed.freedoms} by rank"
        yield "redundant", f"{rows} redundant: {counted}"
    if closed.n_dependent_at_start:
        rows = (
            "a row of Φ_q depends"
            if closed.n_dependent_at_start == 1
            else f"{closed.n_dependent_at_start} rows of Φ_q depend"
        )
        yield (
            "singular",
            (
                f"links are collinear at the start (a dead centre): {rows} on the others,"
                " and accelerations and reactions are not determined; start at another position"
            ),
        )
    deviations = {name: x for scene in findings.scenes.values() for name, x in scene.guess_deviations.items()}
    for name, deviation in deviations.items():
        yield (
            "guess",
            f"{name} differs by {format_guess_difference(name, deviation)} from the guess: "
            f"{describe_missing_assembly(first.linkage.source)}",
        )
    if not closed.freedoms or mechanism.freedoms is not None:
        yield from _yield_ambiguity_remark(findings)


def _yield_unattached_body_remarks(mechanism: Mechanism, mobility: Mobility) -> Iterator[tuple[str, str]]:
    """Yield ("shaft", remark) for each body with an angle drive that no joint connects to the drive's reference.

    Only bodies with an independent coordinate get a remark: without a joint their position is free.
    """
    joined = {frozenset((joint.first.body, joint.second.body)) for joint in mechanism.joints.values()}
    for drive in mechanism.drives.values():
        other = drive.reference or "ground"
        moves = any(name.rpartition(".")[0] == drive.body for name in mobility.independent_coordinates)
        if drive.kind == "angle" and moves and frozenset((drive.body, other)) not in joined:
            reference = "the ground" if other == "ground" else other
            yield "shaft", f"no joint connects {drive.body} to {reference}, the reference of drive {drive.name}"


def _format_size_remark(mechanism: Mechanism, scene: AssembledScene) -> str | None:
    """Return a remark that suggests millimetres if the largest length of the file exceeds MAX_LENGTH; else None.

    `parameters` and `start` are not considered.
    """
    p, source = scene.linkage.p, scene.linkage.source
    lengths = {
        parameter.address: abs(float(p[k]))
        for k, parameter in enumerate(source.parameters)
        if parameter.dimension == (1, 0, 0) and not parameter.address.startswith(("parameters.", "start."))
    }
    address = max(lengths, key=lengths.__getitem__, default="")
    if not address or lengths[address] <= MAX_LENGTH:
        return None
    size = lengths[address]
    return (
        f"{address} is {size:.4g} m: numbers without a unit are metres; if millimetres are meant, write {size:.4g} mm,"
        f" also for the other lengths above {MAX_LENGTH:g} m"
    )


def _yield_ambiguity_remark(findings: Findings) -> Iterator[tuple[str, str]]:
    """Yield a remark if several assemblies follow the guesses of the file equally well.

    It is a pair (subject, text). The text names a coordinate whose guess separates them, with its value in the present
    start and in the others.
    """
    if not (equivalent_assemblies := findings.equivalent_assemblies):
        return
    start = findings.assemblies[0]
    guess_name = next(
        name for name in start.guess if any(_has_different_guess(name, start, other) for other in equivalent_assemblies)
    )
    start_text, other_texts = (
        _format_guess_value(guess_name, start.guess[guess_name]),
        [_format_guess_value(guess_name, a.guess[guess_name]) for a in equivalent_assemblies],
    )
    values_text = ", ".join(dict.fromkeys(value for value in other_texts if value != start_text))
    yield (
        "assemblies",
        (
            f"{len(equivalent_assemblies) + 1} assemblies follow the guesses of the start equally well:"
            f" also guess {guess_name}, {start_text} as in the present start or {values_text}; --branches lists all"
        ),
    )


def _has_different_guess(name: str, assembly: Assembly, other: Assembly) -> bool:
    """Return whether two assemblies have different printed values of the guess `name`."""
    return _format_guess_value(name, assembly.guess[name]) != _format_guess_value(name, other.guess[name])


def _format_guess_value(name: str, x: float) -> str:
    """Return a guess as text with its unit, in degrees or mm, as a mechanism file may contain it; x in rad or m."""
    return f"{math.degrees(x):.4g} deg" if name.endswith(".theta") else f"{1e3 * x:.4g} mm"


def yield_assembly_lines(findings: Findings) -> Iterator[str]:
    """Yield a heading and a line for each assembly, with the guess that selects it; nothing if none was searched.

    The assembly at the file's start is marked. A last line advises to replace the file's guess, if there are guesses.
    """
    if not findings.assemblies:
        return
    count = len(findings.assemblies)
    noun = "assembly" if count == 1 else "assemblies"
    yield f"{count} {noun} found at the start; each is selected by its start: {{guess: …}}"
    for number, assembly in enumerate(findings.assemblies, 1):
        mark = "  as in the file" if assembly.is_start else ""
        yield f"  {number}  {format_guess(assembly)}{mark}"
    if any(assembly.guess for assembly in findings.assemblies):
        yield "     replace the guess of the file: with two guesses, both are followed"


def format_guess(assembly: Assembly) -> str:
    """Return the guess that selects an assembly, as text for a mechanism file: "{rod.theta: 30 deg}" or "none
    needed".
    """
    guess = ", ".join(f"{name}: {_format_guess_value(name, x)}" for name, x in assembly.guess.items())
    return f"{{{guess}}}" if guess else "none needed"


def build_scene_documents(findings: Findings) -> dict[str, Any]:
    """Return the results of all scenes for `--json`, by scene; angles in rad, lengths in m."""
    return {name: _build_assembled_scene_document(scene) for name, scene in findings.scenes.items()} | {
        name: {"assembles": False, "message": str(error)} for name, error in findings.errors.items()
    }


def _build_assembled_scene_document(scene: AssembledScene) -> dict[str, Any]:
    """Return the results of one assembled scene as a dictionary for `--json`.

    It has the degrees of freedom with and without play, Grübler's count, the number of redundant equations, independent
    coordinates, unconnected bodies, and guesses that are not followed.
    """
    return {
        "assembles": True,
        "degrees of freedom": scene.scene_mobility.freedoms,
        "with all joints closed": scene.closed_mobility.freedoms,
        "by counting": scene.closed_mobility.gruebler,
        "redundant rows": scene.closed_mobility.redundant,
        "along": list(scene.closed_mobility.independent_coordinates),
        "loose": list(scene.closed_mobility.unconnected_bodies),
        "guesses not followed": dict(scene.guess_deviations),
    }


def build_assembly_documents(findings: Findings) -> list[dict[str, Any]]:
    """Return all assemblies with their guesses for `--json`."""
    return [{"guess": assembly.guess, "start": assembly.is_start} for assembly in findings.assemblies]
