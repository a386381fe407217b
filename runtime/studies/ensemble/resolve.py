"""Resolve a study file to a plan of runs: load its mechanism in each variant, and check all names, units and values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, InputError
from gudgeon.integrators import adaptive
from gudgeon.language.text_output import format_count
from gudgeon.language.units import DIMENSIONLESS, TIME
from gudgeon.results.batch import Array
from gudgeon.results.series import check_series, get_catalogue
from gudgeon.simulation.arguments import select_method
from gudgeon.simulation.from_file import load
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.block import Job, RunSettings, RunTable, resolve_wear_model
from gudgeon.studies.ensemble.exponents import check_lyapunov_measures
from gudgeon.studies.ensemble.libraries import (
    find_study_mechanism,
    get_method_for_scene,
    iterate_variants,
    list_reference_scene_names,
)
from gudgeon.studies.ensemble.measures import (
    check_reference_series,
    describe_measure,
    find_measure_unit,
    list_sampled_series,
    make_unknown_measure_error,
)
from gudgeon.studies.ensemble.parameter_values import (
    check_constant_settings,
    check_expression,
    check_finite_values,
    find_parameter,
    find_parameter_in_scenes,
    parse_dimension_values,
    parse_parameter_value,
    parse_real_value,
)
from gudgeon.studies.ensemble.plan import Coordinate, Deviations, Part, Plan, StudyDimension, check_study_size

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Deviation, Distribution, Draw, Starts, StudyFile
    from gudgeon.generator.yaml import Text


MAX_BLOCK_RUNS = 128
MAX_BLOCK_BYTES = 1 << 26  # approximate limit of the states and series of a block
N_SIZING_RUNS = 64  # runs of a part from which its number of samples is estimated
RANDOM, LATIN, HALTON = "random", "latin_hypercube", "halton"
NORMAL, GEOMETRIC = "normal", "geometric"


def resolve_study(study: StudyFile) -> Plan:
    """Load all scenes of a study (a part of a file) in all variants, and return its plan with checked names and values.

    Missing libraries are compiled. Raises an InputError at its location in the file.
    """
    check_study_size(study)
    structure, coordinates = _resolve_structure(study)
    parts = tuple(_load_variants(study))
    sources = [part.simulation.source for part in parts]
    parameter_dimensions, parameter_coordinates = _resolve_parameters(study, sources)
    deviations, start_coordinates, start_dimensions = _resolve_starts(study.starts, sources)
    coordinates += parameter_coordinates + start_coordinates
    run_settings = _resolve_run_settings(study, parts)
    fixed = {
        str(name): parse_parameter_value(text, find_parameter_in_scenes(sources, name))
        for name, text in study.fixed.items()
    }
    coordinates += [
        Coordinate(name, (), np.array(value), find_parameter_in_scenes(sources, name).unit)
        for name, value in zip(study.fixed, fixed.values(), strict=True)
    ]
    plan = Plan(
        study,
        tuple(structure),
        (*parameter_dimensions, *start_dimensions),
        fixed,
        deviations,
        tuple(coordinates),
        parts,
        run_settings,
        _resolve_units(study, sources),
        tuple(_describe_ineffective_settings(study, sources)),
    )
    return replace(plan, parts=tuple(_choose_block_size(plan, k) for k in range(len(parts))))


def _resolve_structure(study: StudyFile) -> tuple[list[StudyDimension], list[Coordinate]]:
    """Return dimensions and coordinates of the scenes and of the choices of structure of a study.

    A scene that the file writes without brackets (`scenes: dry`) is a scalar coordinate without a dimension.
    """
    named = [("scene", [str(name) for name in study.scenes], "scene of the mechanism")] if not study.one_scene else []
    named += [(choice.name, list(choice.options), "choice of structure") for choice in study.choices]
    coordinates = [Coordinate(name, (name,), np.array(words, object), "", message) for name, words, message in named]
    if study.one_scene:
        coordinates.append(
            Coordinate("scene", (), np.array(str(study.scenes[0]), object), "", "scene of the mechanism")
        )
    return [StudyDimension(name, len(words)) for name, words, _ in named], coordinates


def _load_variants(study: StudyFile) -> Iterator[Part]:
    """Load the library of every variant (combination of scene and options) of a study, and yield a part for each.

    Reference scenes of measures are loaded, too, and checked for the series. Raises an InputError at its location.
    """
    mechanism = find_study_mechanism(study)
    for scene, texts, overrides in iterate_variants(study):
        for reference_scene in list_reference_scene_names(study):
            check_reference_series(study.measures, _load_scene(mechanism, reference_scene, texts, overrides).source)
        yield Part(_load_scene(mechanism, scene, texts, overrides), mechanism, overrides)


def _load_scene(
    mechanism: str, scene: Text, override_texts: Mapping[str, Text], overrides: tuple[tuple[str, str], ...]
) -> Simulation:
    """Load a scene of a mechanism with these overrides, (address, text) pairs, and return its simulation.

    override_texts: the same overrides by address, with locations. An error of an override or of the scene's name is
    raised at its location in the study file, an error of the mechanism's file at its location there.
    """
    try:
        return load(mechanism, str(scene), overrides=dict(overrides), quick=False)
    except InputError as error:
        file = error.where.file if error.where else ""
        address = file.removeprefix("override of ")
        text = override_texts.get(address) or next(
            (override_text for name, override_text in override_texts.items() if repr(name) in error.message), None
        )
        if file and address not in override_texts:  # an error of the mechanism's file
            raise
        raise type(error)(error.message, (text or scene).where, error.hint) from None


def _resolve_parameters(
    study: StudyFile, sources: Sequence[KernelSource]
) -> tuple[list[StudyDimension], list[Coordinate]]:
    """Return dimensions and coordinates of the varied parameters: keys `parameters`, `zip` and `draw` of a study."""
    dimensions, coordinates = [], []
    for axis in study.axes:
        columns = {}
        for name, parameter_values in axis.columns.items():
            parameter = find_parameter_in_scenes(sources, name)
            columns[str(name)] = parse_dimension_values(parameter_values, parameter, may_repeat=axis.grouped)
            coordinates.append(
                Coordinate(str(name), (axis.name,), columns[str(name)], parameter.unit, parameter.address)
            )
        length = len(next(iter(columns.values())))
        if axis.grouped:
            coordinates.append(Coordinate(axis.name, (axis.name,), np.arange(length), "", f"place in zip {axis.name}"))
        dimensions.append(StudyDimension(axis.name, length, columns))
    if study.draw is not None:
        columns = _draw_values(study.draw, sources)
        dimensions.append(StudyDimension("draw", study.draw.count, columns))
        description = f"point of {study.draw.method}, seed {study.draw.seed}"
        coordinates.append(Coordinate("draw", ("draw",), np.arange(study.draw.count), "", description))
        for name in study.draw.distributions:
            parameter = find_parameter_in_scenes(sources, name)
            coordinates.append(Coordinate(str(name), ("draw",), columns[str(name)], parameter.unit, parameter.address))
    return dimensions, coordinates


def _draw_values(draw: Draw, sources: Sequence[KernelSource]) -> dict[str, Any]:
    """Return the random or quasi-random values (SI) of each parameter of `draw`, (count,) by name.

    They depend on method and seed only. Raises BadValueError at its location for invalid ends or standard deviations,
    and for values that are not finite.
    """
    points = sample_unit_cube(draw.method, draw.count, len(draw.names), draw.seed)
    drawn_values = {}
    for name, distribution in draw.distributions.items():
        parameter = find_parameter_in_scenes(sources, name)
        first, second = (parse_real_value(text, parameter) for text in distribution.ends)
        where = distribution.ends[1].where
        if distribution.kind == NORMAL and not second > 0.0:
            raise BadValueError(f"a standard deviation of {second:g}", where, "expected a positive one")
        if distribution.kind != NORMAL and not first < second:
            raise BadValueError(f"from {first:g} to {second:g} {parameter.unit}", where, "expected from < to")
        if distribution.kind not in (NORMAL, "uniform") and not first > 0.0:
            raise BadValueError(
                f"a geometric spread from {first:g}", distribution.ends[0].where, "expected positive ends"
            )
        with np.errstate(over="ignore", invalid="ignore"):
            values = compute_distribution_quantiles(distribution, first, second, points[:, draw.names.index(name)])
            drawn_values[str(name)] = check_finite_values(values, distribution.ends[1])
    return drawn_values


def _resolve_starts(
    starts: Starts | None, sources: Sequence[KernelSource]
) -> tuple[Deviations | None, list[Coordinate], list[StudyDimension]]:
    """Return deviations, coordinates and dimensions of perturbed starts (the key `starts`); None, [], [] without them.

    Without named ensembles, the coordinates have no dimension `ensemble`.
    """
    if starts is None:
        return None, [], []
    names = sorted({str(name): name for ensemble in starts.ensembles.values() for name in ensemble}.values())
    points, ensembles = draw_deviations(starts, list(map(str, names))), list(starts.ensembles.values())
    ensemble_dimension = ("ensemble",) if starts.named else ()
    deviations_ = Deviations({}, {})
    coordinates = [
        Coordinate(
            "start",
            ("start",),
            np.arange(starts.count),
            "",
            f"perturbed start, {starts.distribution}, seed {starts.seed}",
        )
    ]
    if starts.named:
        named = np.array(list(starts.ensembles), object)
        coordinates.append(Coordinate("ensemble", ensemble_dimension, named, "", "ensemble of starts"))
    for k, name in enumerate(names):
        parameter = find_parameter_in_scenes(sources, name)
        for relative, column in ((True, deviations_.relative), (False, deviations_.absolute)):
            sizes = _parse_deviation_sizes(
                ensembles, name, replace(parameter, unit="", dimension=(0, 0, 0)) if relative else parameter, relative
            )
            if sizes is None:
                continue
            column[str(name)] = values = sizes[:, None] * points[:, :, k]
            kind, unit = ("relative", "") if relative else ("absolute", parameter.unit)
            size, values = (sizes, values) if starts.named else (sizes[0], values[0])
            coordinates += [
                Coordinate(
                    f"{name}.{kind}_size",
                    ensemble_dimension,
                    np.array(size),
                    unit,
                    f"{kind} size of the deviation of {name}",
                ),
                Coordinate(
                    f"{name}.{kind}", (*ensemble_dimension, "start"), values, unit, f"{kind} deviation of {name}"
                ),
            ]
    dimensions = [StudyDimension("ensemble", len(ensembles))] if starts.named else []
    return deviations_, coordinates, [*dimensions, StudyDimension("start", starts.count)]


def _parse_deviation_sizes(
    ensembles: Sequence[Mapping[Text, Deviation]], name: Text, parameter: RuntimeParameter, is_relative: bool
) -> Array | None:
    """Return the size of the relative or absolute (SI) deviation of a parameter in each ensemble, (n_ensembles,).

    It is 0 for an ensemble without it. parameter: with the dimension of the size. None if no ensemble has this kind of
    deviation. Raises BadValueError for a size that is not positive.
    """
    sizes, is_found = np.zeros(len(ensembles)), False
    for k, ensemble in enumerate(ensembles):
        if name in ensemble and ensemble[name].relative == is_relative:
            text, is_found = ensemble[name].size, True
            sizes[k] = parse_real_value(text, parameter)
            if not sizes[k] > 0.0:
                raise BadValueError(f"a size of {str(text)!r}", text.where, "expected a positive one")
    return sizes if is_found else None


def _resolve_run_settings(study: StudyFile, parts: Sequence[Part]) -> RunSettings:
    """Return the settings of all runs (end, output, step, windows, measures, method, wear), checked in every scene.

    Raises an InputError at its location for a wrong dimension, unknown name, method or tolerance.
    """
    ends = {"t_end": TIME}
    rtol = None if study.rtol is None else _parse_tolerance(study.rtol)
    for part in parts:
        source = part.simulation.source
        for expression, dimension, extra_dimensions in (
            (study.t_end, TIME, {}),
            (study.output, DIMENSIONLESS, ends),
            (study.step, TIME, ends),
            *((end, TIME, ends) for window in study.windows.values() for end in (window.begin, window.end)),
        ):
            if expression is not None:
                check_expression(source, expression, dimension, extra_dimensions)
        _check_method(study, source, rtol)
        if source.degrees_of_freedom > 0:
            check_lyapunov_measures(study, source)
    check_constant_settings(study)
    windows = {
        name: tuple(None if end is None else end.expr for end in (window.begin, window.end))
        for name, window in study.windows.items()
    }
    t_end, output, step = (
        None if quantity is None else quantity.expr for quantity in (study.t_end, study.output, study.step)
    )
    keep, method = tuple(map(str, study.keep)), str(study.method)
    wear = resolve_wear_model(study.wear, [part.simulation.source for part in parts]) if study.wear else None
    rounds = study.wear.rounds if study.wear else 0
    return RunSettings(t_end, output, step, windows, study.measures, keep, method, rtol, study.stop, wear, rounds)


def _check_method(study: StudyFile, source: KernelSource, rtol: float | None) -> None:
    """Raise an InputError at its location for a method, tolerance or step that a scene does not allow.

    Tolerance and step are ignored in a kinematically driven scene. rtol: the tolerance; None if the study has none.
    """
    method, where = get_method_for_scene(source, str(study.method)), study.method.where
    is_dynamic = bool(source.degrees_of_freedom)
    fixed, rtol = is_dynamic and study.step is not None, rtol if is_dynamic else None
    try:
        selected = select_method(source, method, fixed)
        where = study.rtol.where if study.rtol is not None else where
        adaptive.parse_tolerance(rtol, selected, fixed)
    except InputError as error:
        raise type(error)(f"scene {source.scene}: {error.message}", where, error.hint) from None


def _parse_tolerance(text: Text) -> float:
    """Return the value of the text of `rtol`, a pure number. Raises an InputError at the text for anything else."""
    return parse_real_value(text, RuntimeParameter("rtol", "", 0.0, False, (0, 0, 0)))


def _resolve_units(study: StudyFile, sources: Sequence[KernelSource]) -> dict[str, str]:
    """Return the SI units of measures and stored series by name, from the first scene that has them.

    Raises an InputError at the name for a measure or series that no scene has.
    """
    unit_by_name = {}
    for measure in study.measures:
        units = [unit for source in sources if (unit := find_measure_unit(measure, source)) is not None]
        if not units:
            raise make_unknown_measure_error(measure, sources[-1])
        unit_by_name[measure.name] = units[0]
    for name in study.keep:
        known_units = [get_catalogue(source)[name].unit for source in sources if name in get_catalogue(source)]
        if not known_units:
            try:
                check_series(sources[-1], [str(name)])
            except InputError as error:
                raise type(error)(error.message, name.where, error.hint) from None
        unit_by_name[str(name)] = known_units[0]
    return unit_by_name


def _describe_ineffective_settings(study: StudyFile, sources: Sequence[KernelSource]) -> Iterator[str]:
    """Yield a note for each parameter, measure, series or setting of a study that has no effect in some scenes.

    Varied values that a value for all runs (--set) replaces get a note, too.
    """
    names = [*study.fixed, *(name for axis in study.axes for name in axis.columns)]
    names += [*study.draw.distributions] if study.draw else []
    names += [name for ensemble in study.starts.ensembles.values() for name in ensemble] if study.starts else []
    for axis in study.left_out:
        for name, replaced_values in axis.columns.items():
            count = replaced_values.count or len(replaced_values.texts)
            yield f"{name} is set for all runs, in place of {format_count(count, 'value')} in the study file"
    by_scene = {source.scene: source for source in sources}
    for name in dict.fromkeys(names):
        if scenes_without_it := [
            scene for scene, source in by_scene.items() if find_parameter(source, str(name)) is None
        ]:
            yield f"{name} is not a parameter of scene {', '.join(scenes_without_it)}: its runs do not depend on it"
    if kinematic_scenes := [
        scene for scene, source in by_scene.items() if get_method_for_scene(source, str(study.method)) != study.method
    ]:
        names_of_scenes = ", ".join(kinematic_scenes)
        yield f"scene {names_of_scenes} has no degree of freedom: it follows its drives, and method has no effect"
    for measure in study.measures:
        if scenes_without_it := [
            scene for scene, source in by_scene.items() if find_measure_unit(measure, source) is None
        ]:
            yield (
                f"{measure.name}, {describe_measure(measure)}, is NaN in scene {', '.join(scenes_without_it)}, "
                "which lacks the joint, event or series"
            )
    for name in study.keep:
        if scenes_without_it := [scene for scene, source in by_scene.items() if name not in get_catalogue(source)]:
            yield f"{name} is NaN in scene {', '.join(scenes_without_it)}, which lacks the series"


def _choose_block_size(plan: Plan, part_index: int) -> Part:
    """Return a copy of a part of the plan with runs per block, and the mean and maximum number of samples of a run.

    A block has at most MAX_BLOCK_RUNS runs, and its samples fit into MAX_BLOCK_BYTES. The numbers of samples are
    estimated from at most N_SIZING_RUNS evenly distributed runs.
    """
    runs = np.unique(np.linspace(0, plan.runs_per_part - 1, min(plan.runs_per_part, N_SIZING_RUNS)).astype(int))
    job: Job = plan.make_job(0, part_index, runs, None)
    counts = RunTable(plan.parts[part_index].simulation, job).output
    valid_counts = counts[~np.isnan(counts)] + 1.0
    max_samples, mean_samples = (
        (float(valid_counts.max()), float(valid_counts.mean())) if valid_counts.size else (2.0, 2.0)
    )
    width = 2 + len(
        list_sampled_series(
            plan.run_settings.measures, plan.run_settings.keep, plan.parts[part_index].simulation.source
        )
    )
    block_runs = int(max(1, min(MAX_BLOCK_RUNS, MAX_BLOCK_BYTES // (8 * width * max(max_samples, 2.0)))))
    return replace(plan.parts[part_index], block_runs=block_runs, mean_samples=mean_samples, max_samples=max_samples)


def sample_unit_cube(method: str, count: int, n_dimensions: int, seed: int) -> Array:
    """Return random or quasi-random points of the unit cube, (count, n_dimensions), for a method of `draw` and a seed.

    method: "random" (independent points), "latin_hypercube", "halton" or "sobol", the last three by scipy.stats.qmc.
    Sobol points are the first of a scrambled sequence.
    """
    if method == RANDOM:
        return np.random.default_rng(seed).random((count, n_dimensions))
    from scipy.stats import qmc

    if method == LATIN:
        return np.asarray(qmc.LatinHypercube(n_dimensions, seed=seed).random(count))
    if method == HALTON:
        return np.asarray(qmc.Halton(n_dimensions, seed=seed).random(count))
    return np.asarray(qmc.Sobol(n_dimensions, seed=seed).random_base2(math.ceil(math.log2(count)))[:count])


def compute_distribution_quantiles(
    distribution: Distribution, mean_or_low: float, deviation_or_high: float, fractions: Array
) -> Array:
    """Return the quantiles (SI), (n,), of a normal, log-uniform (`spacing: geometric`) or uniform distribution.

    fractions: cumulative probabilities (n,) in [0, 1] (inverse transform sampling). mean_or_low, deviation_or_high:
    mean and standard deviation of a normal distribution, else the two ends.
    """
    if distribution.kind == NORMAL:
        from scipy.special import ndtri

        return np.asarray(mean_or_low + deviation_or_high * ndtri(fractions))
    if distribution.kind == GEOMETRIC:
        return np.asarray(mean_or_low * (deviation_or_high / mean_or_low) ** fractions)
    return np.asarray(mean_or_low + (deviation_or_high - mean_or_low) * fractions)


def draw_deviations(starts: Starts, names: list[str]) -> Array:
    """Return the random deviations u of each ensemble, start and parameter, (n_ensembles, count, n_names).

    They are uniform in [−1, 1], or standard normal, and depend on the seed only. All cells of the study use the same
    ones (common random numbers), so that runs can be compared start by start.
    """
    generators = [np.random.default_rng([starts.seed, k]) for k in range(len(starts.ensembles))]
    shape = (starts.count, len(names))
    return np.stack(
        [
            rng.standard_normal(shape) if starts.distribution == NORMAL else rng.uniform(-1.0, 1.0, shape)
            for rng in generators
        ]
    )
