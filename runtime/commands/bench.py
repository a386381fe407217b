"""Run `gudgeon bench`: measure run time against error for each scene, show the table and write it."""

from __future__ import annotations

from gudgeon.commands.progress import Report
from gudgeon.commands.studies import MeasurementRequest, load_scenes, measure_scenes, report_interrupted_scenes
from gudgeon.contract.methods import OFFERED
from gudgeon.errors import BadValueError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.bench import SceneBench, list_bench_steps, measure_scene
from gudgeon.studies.methods import select_methods
from gudgeon.studies.show.bench import report_bench

METHODS_HINT = f"without it all methods are measured; or {','.join(OFFERED)}"


def benchmark_file(request: MeasurementRequest, methods: tuple[str, ...] = ()) -> int:
    """Run `gudgeon bench`: measure all scenes of a request, print and write the table, and return the exit code.

    methods: texts of names separated by commas, or () for all. For scenes without degrees of freedom, steps and methods
    do not apply. Raises BadValueError for unknown methods before anything is run.
    """
    step, t_end = request.parse_time("--mark-step", request.mark), request.parse_time("--t-end", request.t_end)
    simulations = load_scenes(request)
    method_names = [name.strip() for text in methods for name in text.split(",") if name.strip()] if methods else None
    if method_names == []:
        raise BadValueError(f"--methods {', '.join(map(repr, methods))}: expected names of methods", hint=METHODS_HINT)
    for simulation in simulations:
        if simulation.source.degrees_of_freedom != 0:
            select_methods(
                simulation, method_names, request.quick
            )  # raises for an unknown method before anything is run
    table = request.find_table_path(simulations[0].source.mechanism, "bench")

    def measure_one_scene(simulation: Simulation, progress: Report | None) -> SceneBench:
        """Measure run time against error of one scene and return its SceneBench.

        With `--mark-step`, that step is added to the default steps, except without degrees of freedom. `progress` is
        called with fraction and text. None: no progress is reported.
        """
        parameters, steps = request.select_parameters(simulation), None
        if step is not None and simulation.source.degrees_of_freedom != 0:
            steps = {*list_bench_steps(simulation, parameters, request.quick), step}
        return measure_scene(
            simulation,
            sorted(steps) if steps else None,
            t_end=t_end,
            parameters=parameters,
            quick=request.quick,
            methods=method_names,
            progress=progress,
        )

    measured_scenes, interrupted = measure_scenes(simulations, measure_one_scene, request.json)
    if measured_scenes:
        report_bench(simulations[0].source, measured_scenes, table, step, request.json)
    return report_interrupted_scenes(simulations, measured_scenes, interrupted)
