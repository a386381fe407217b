"""Run `gudgeon map`: classify runs (stable, inaccurate, diverged …) over a grid or a box of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gudgeon.commands.progress import Report
from gudgeon.commands.studies import MeasurementRequest, load_scenes, measure_scenes, report_interrupted_scenes
from gudgeon.contract.kernel_source import RuntimeParameter
from gudgeon.contract.methods import OFFERED
from gudgeon.errors import BadValueError
from gudgeon.integrators.adaptive import parse_tolerance
from gudgeon.language.names import make_missing_name_error
from gudgeon.model.parameters import list_addresses, parse_typed_number, read_parameter_value
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import GROUPS, SETTINGS, make_axis, parse_axis
from gudgeon.studies.box import Range
from gudgeon.studies.map import (
    DEFAULT_RTOL,
    VerdictBox,
    VerdictMap,
    compute_verdict_box,
    compute_verdict_map,
    list_map_steps,
)
from gudgeon.studies.runs import FIXED_STEP_METHODS, Setting, find_default_step
from gudgeon.studies.show.box import report_box
from gudgeon.studies.show.map import PRESSURE_UNITS, report_map


@dataclass(frozen=True)
class MapOptions:
    """Options that only `gudgeon map` has."""

    method: str = "auto"
    at: str | None = None  # step or tolerance, if no axis is one
    axes: tuple[str, ...] = ()
    box: int | None = None
    ranges: tuple[str, ...] = ()

    @property
    def has_fixed_step(self) -> bool:
        """Return whether the method has a fixed step."""
        return self.method in FIXED_STEP_METHODS


def map_file(request: MeasurementRequest, map_options: MapOptions) -> int:
    """Run `gudgeon map`: classify the runs of all scenes, print the result, write table and picture; return the exit
    code.

    Scenes without degrees of freedom are left out with a message. Raises BadValueError, UnknownNameError for options.
    """
    step, t_end = request.parse_time("--mark-step", request.mark), request.parse_time("--t-end", request.t_end)
    _check_options(map_options, step)
    setting, simulations = _parse_fixed_setting(map_options), load_scenes(request)
    _check_axis_names(map_options, simulations)
    dynamic_simulations = [simulation for simulation in simulations if simulation.source.degrees_of_freedom != 0]
    if not request.json:
        for simulation in simulations:
            if simulation not in dynamic_simulations:
                print(f"{simulation.source.scene}: no degrees of freedom: nothing is integrated")
    if not dynamic_simulations:
        return 0
    table_path = request.find_table_path(dynamic_simulations[0].source.mechanism, "map")
    if map_options.box is not None:
        return _map_box(request, map_options, dynamic_simulations, t_end, setting, table_path)
    steps = sorted({*list_map_steps(dynamic_simulations, request.quick), *([] if step is None else [step])})

    def classify_scene(simulation: Simulation, progress: Report | None) -> VerdictMap:
        """Return the map of one scene: the verdicts over the axes of the command, with the scene's values of `--set`.

        With a fixed-step method and less than two axes, none of them a step, the first axis has the default steps.
        `progress` is called with fraction and text; None: no progress is reported.
        """
        parameters = request.select_parameters(simulation)
        axes = [parse_axis(simulation, text, parameters) for text in map_options.axes]
        if map_options.has_fixed_step and not any(a.is_method_setting for a in axes) and len(axes) < 2:
            axes = [make_axis(simulation, "step", steps), *axes]
        return compute_verdict_map(
            simulation,
            axes,
            method=map_options.method,
            value=setting,
            t_long=t_end,
            parameters=parameters,
            quick=request.quick,
            progress=progress,
        )

    measured_scenes, interrupted = measure_scenes(dynamic_simulations, classify_scene, request.json)
    if measured_scenes:
        report_map(dynamic_simulations[0].source, request.file, measured_scenes, table_path, step, request.json)
    return report_interrupted_scenes(dynamic_simulations, measured_scenes, interrupted)


def _map_box(
    request: MeasurementRequest,
    map_options: MapOptions,
    dynamic_simulations: Sequence[Simulation],
    t_end: float | None,
    setting: float | None,
    table_path: Path,
) -> int:
    """Classify runs at the corners and Sobol points of a box for each scene, show and write them; return the exit code.

    setting: step (s) or tolerance of all runs, or None for the default; table_path: of the CSV file.
    """

    def classify_box(simulation: Simulation, progress: Report | None) -> VerdictBox:
        """Return the verdicts of one scene at the corners and Sobol points of the box.

        All runs have one setting; without `--at` it is the default step of a fixed-step method, or DEFAULT_RTOL.
        `progress` is called with fraction and text; None: no progress is reported.
        """
        parameters = request.select_parameters(simulation)
        axes = {a.name: a for a in (parse_axis(simulation, text, parameters) for text in map_options.ranges)}
        ranges = [Range(a.name, a.values[0], a.values[-1], PRESSURE_UNITS.get(a.unit, a.unit)) for a in axes.values()]
        default_setting = find_default_step(simulation, parameters) if map_options.has_fixed_step else DEFAULT_RTOL
        return compute_verdict_box(
            simulation,
            ranges,
            map_options.box or 0,
            setting=Setting(map_options.method, setting or default_setting),
            t_long=t_end,
            parameters=parameters,
            addresses=axes,
            quick=request.quick,
            progress=progress,
        )

    measured_scenes, interrupted = measure_scenes(dynamic_simulations, classify_box, request.json)
    if measured_scenes:
        report_box(dynamic_simulations[0].source, request.file, measured_scenes, table_path, request.json)
    return report_interrupted_scenes(dynamic_simulations, measured_scenes, interrupted)


def _check_options(map_options: MapOptions, step: float | None) -> None:
    """Raise BadValueError for an unknown method, and for options of map that exclude or need each other.

    step: the value of --mark-step in s; None if it is not given.
    """
    if map_options.method not in OFFERED:
        raise BadValueError(f"--method {map_options.method!r}: expected {', '.join(OFFERED)}")
    setting_names = [name for name in map(_get_axis_name, map_options.axes) if name in SETTINGS]
    _check_varied_once("--axis", map_options.axes)
    _check_varied_once("--range", map_options.ranges)
    if map_options.box is None and map_options.ranges:
        hint = "add --box COUNT (0: only its corners), or vary the parameter along an --axis"
        raise BadValueError(f"--range {map_options.ranges[0]}: --range needs --box", hint=hint)
    if map_options.box is not None:
        if map_options.axes:
            raise BadValueError("--box with --axis: give the edges of a box with --range NAME=LOW..HIGH")
        if not map_options.ranges:
            raise BadValueError("--box: give its edges with --range NAME=LOW..HIGH")
        for text in map_options.ranges:
            if ".." not in text.partition("=")[2] or ":" in text:
                raise BadValueError(f"--range {text}: expected NAME=LOW..HIGH")
            if _get_axis_name(text) in SETTINGS:
                message = f"--range {text}: all runs of a box have the same {_get_axis_name(text)}"
                raise BadValueError(message, hint="--at gives it")
    elif map_options.at is not None and (setting_names or len(map_options.axes) < 2):
        setting_name = "step" if map_options.has_fixed_step else "rtol"
        raise BadValueError(
            f"--at {map_options.at}: {setting_name} is an axis of the map", hint="give two other axes, or --box"
        )
    has_step_rows = (
        map_options.box is None
        and map_options.has_fixed_step
        and ("step" in setting_names or len(map_options.axes) < 2)
    )
    if step is not None and not has_step_rows:
        raise BadValueError("--mark-step: no row is a step", hint="with --method rk4 the rows of the map are steps")


def _check_varied_once(option: str, texts: Sequence[str]) -> None:
    """Raise BadValueError for a parameter that is varied twice by an option; the section `parameters.` may be
    omitted.
    """
    varied: dict[str, str] = {}
    for text in texts:
        name = _get_axis_name(text).removeprefix("parameters.")
        if name in varied:
            message = f"{option} {text}: this parameter is varied already, by {option} {varied[name]}"
            raise BadValueError(message, hint=f"give each {option} another parameter")
        varied[name] = text


def _check_axis_names(map_options: MapOptions, simulations: Sequence[Simulation]) -> None:
    """Raise UnknownNameError, with the nearest names, for the name of an axis or range that no scene has.

    Names are addresses of parameters, the settings step and rtol, "clearance", and groups of parameters. Texts without
    "=" are not checked.
    """
    addresses = [name for simulation in simulations for name in list_addresses(simulation.source)]
    known_names = tuple(dict.fromkeys([*SETTINGS, "clearance", *GROUPS, *addresses]))
    for option, texts in (("--axis", map_options.axes), ("--range", map_options.ranges)):
        for text in texts:
            if "=" in text and _get_axis_name(text) not in known_names:
                raise make_missing_name_error(
                    f"{option} {text}: no scene has a parameter {_get_axis_name(text)!r}",
                    _get_axis_name(text),
                    known_names,
                )


def _get_axis_name(text: str) -> str:
    """Return the name of an axis or range, "c" of "c=1mm..2mm"."""
    return text.partition("=")[0].strip()


def _parse_fixed_setting(map_options: MapOptions) -> float | None:
    """Return the step (s) or tolerance of `--at`, or None without it. Raise BadValueError if it is out of range."""
    if map_options.at is None:
        return None
    unit, power = ("s", 1) if map_options.has_fixed_step else ("", 0)
    value = read_parameter_value(
        parse_typed_number(map_options.at), RuntimeParameter("--at", unit, 0.0, False, (0, 0, power))
    )
    if map_options.has_fixed_step and not value > 0:
        raise BadValueError(f"--at {map_options.at}: expected a positive step")
    return value if map_options.has_fixed_step else parse_tolerance(value, map_options.method, False)
