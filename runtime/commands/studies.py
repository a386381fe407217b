"""Read the common arguments of `gudgeon bench` and `gudgeon map`: scenes, parameter values, output file."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from gudgeon.commands.common import (
    check_addresses,
    check_output_file,
    check_output_name,
    parse_settings,
    require_suffix,
    select_scenes,
)
from gudgeon.commands.progress import Report, show_progress_bars, show_status_line
from gudgeon.contract.kernel_source import RuntimeParameter
from gudgeon.errors import BadValueError
from gudgeon.model.parameters import compute_parameter_values, list_addresses, parse_typed_number, read_parameter_value
from gudgeon.simulation.from_file import load
from gudgeon.simulation.simulation import Simulation
from gudgeon.waiting.ctrl_c import INTERRUPTED


class Measured(Protocol):
    """Result of `bench` or `map` for one scene; incomplete after Ctrl-C."""

    @property
    def scene(self) -> str:
        """Return the name of the scene."""

    @property
    def interrupted(self) -> bool:
        """Return whether Ctrl-C ended the measurement."""

    @property
    def done(self) -> tuple[int, int]:
        """Return the number of finished runs and the number of all runs."""


MeasuredScene = TypeVar("MeasuredScene", bound=Measured)


@dataclass(frozen=True)
class MeasurementRequest:
    """Arguments that both commands have, as typed."""

    file: str
    scenes: tuple[str, ...] = ()
    sets: tuple[str, ...] = ()
    t_end: str | None = None
    out: Path = Path("out")
    csv: Path | None = None
    quick: bool = False
    mark: str | None = None
    json: bool = False

    @property
    def parameters(self) -> dict[str, float | str]:
        """Return the values of `--set ADDRESS=VALUE` by address."""
        return parse_settings(self.sets)

    def select_parameters(self, simulation: Simulation) -> dict[str, float | str]:
        """Return the values of `--set` whose addresses the scene has; an ideal scene has no viscosity, for example."""
        known_addresses = set(list_addresses(simulation.source))
        return {name: value for name, value in self.parameters.items() if name in known_addresses}

    def parse_time(self, option: str, text: str | None) -> float | None:
        """Parse the text of an option as a positive time and return it in s; None if it is None.

        Raise BadValueError.
        """
        if text is None:
            return None
        value = read_parameter_value(parse_typed_number(text), RuntimeParameter(option, "s", 0.0, False, (0, 0, 1)))
        if not value > 0:
            raise BadValueError(f"{option} is {value:g} s: expected a positive time")
        return value

    def find_table_path(self, mechanism: str, table_kind: str) -> Path:
        """Return the path of the CSV file: that of --csv, else MECHANISM_KIND.csv in --out, for example pump_map.csv.

        Raises InputError if the path of --csv has another suffix than .csv, or if the file or the picture of the same
        name (.png) cannot be written.
        """
        table = self.csv or self.out / f"{mechanism}_{table_kind}.csv"
        if self.csv is not None:
            require_suffix(self.csv, (".csv",))
        option = "--out" if self.csv is None else "--csv"
        check_output_file(option, table)
        check_output_name(option, table.with_suffix(".png"))
        return table


def measure_scenes(
    simulations: Sequence[Simulation], measure_scene: Callable[[Simulation, Report | None], MeasuredScene], quiet: bool
) -> tuple[list[MeasuredScene], bool]:
    """Call `measure_scene` for each scene with a progress callback; return the results and whether Ctrl-C ended it.

    After Ctrl-C the last result may be incomplete, and further scenes have none. quiet: without a progress bar.
    """
    results: list[MeasuredScene] = []
    with show_progress_bars(quiet) as make_bar:
        try:
            for simulation in simulations:
                results.append(measure_scene(simulation, make_bar(simulation.source.scene)))
                if results[-1].interrupted:
                    return results, True
        except KeyboardInterrupt:
            return results, True
    return results, False


def report_interrupted_scenes(
    simulations: Sequence[Simulation], measured_scenes: Sequence[Measured], interrupted: bool
) -> int:
    """Print the number of finished runs of each scene on stderr if Ctrl-C interrupted the command.

    Returns the exit code: 0, or 130 if interrupted.
    """
    if not interrupted:
        return 0
    if not measured_scenes:
        print("interrupted before any run was finished: nothing is shown or written", file=sys.stderr)
        return INTERRUPTED
    parts = ["{}: {} of {} runs".format(scene.scene, *scene.done) for scene in measured_scenes]
    names = {scene.scene for scene in measured_scenes}
    parts += [f"{s.source.scene}: not started" for s in simulations if s.source.scene not in names]
    print(f"interrupted: the results shown and written are partial ({'; '.join(parts)})", file=sys.stderr)
    return INTERRUPTED


def load_scenes(request: MeasurementRequest) -> list[Simulation]:
    """Load all requested scenes with optimized code, and check the values of --set before anything runs.

    Raises UnknownNameError for an address that no scene has, BadValueError for values.
    """
    with show_status_line(quiet=request.json):
        simulations = [load(request.file, scene, quick=False) for scene in select_scenes(request.file, request.scenes)]
    check_addresses(request.parameters, request.file, [simulation.source for simulation in simulations])
    for simulation in simulations:
        compute_parameter_values(simulation.compiled, request.select_parameters(simulation))
    return simulations
