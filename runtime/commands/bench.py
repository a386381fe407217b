"""Run `gudgeon bench`: measure run time against error for each scene, show the table and write it."""

from __future__ import annotations

from gudgeon.commands.progress import Report
from gudgeon.commands.studies import Request, each, exit_code, load_scenes
from gudgeon.contract.methods import OFFERED
from gudgeon.errors import BadValueError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.bench import SceneBench, bench, usual_steps
from gudgeon.studies.methods import choice
from gudgeon.studies.show.bench import show_bench

EVERY = f"leave it out for all that fit; or {','.join(OFFERED)}"


def bench_file(request: Request, methods: tuple[str, ...] = ()) -> int:
    """Run `gudgeon bench`: measure all scenes of a request, print and write the table, and return the exit code.

    methods: names, separated by commas, or () for all. Scenes without degrees of freedom are measured without steps.
    Raises BadValueError for unknown methods before anything is run.
    """
    step, t_end = request.seconds("--mark-step", request.mark), request.seconds("--t-end", request.t_end)
    loaded = load_scenes(request)
    method_names = [name.strip() for text in methods for name in text.split(",") if name.strip()] if methods else None
    if method_names == []:
        raise BadValueError(f"--methods {', '.join(map(repr, methods))}: expected names of methods", hint=EVERY)
    for simulation in loaded:
        if simulation.source.degrees_of_freedom != 0:
            choice(simulation, method_names, request.quick)  # raises for an unknown method before anything is run
    table = request.table(loaded[0].source.mechanism, "bench")

    def one(simulation: Simulation, report: Report | None) -> SceneBench:
        """Measure one scene; its steps include the step of `--mark-step`."""
        parameters, steps = request.of(simulation), None
        if step is not None and simulation.source.degrees_of_freedom != 0:
            steps = {*usual_steps(simulation, parameters, request.quick), step}
        return bench(
            simulation,
            sorted(steps) if steps else None,
            t_end=t_end,
            parameters=parameters,
            quick=request.quick,
            methods=method_names,
            progress=report,
        )

    found, interrupted = each(loaded, one, request.json)
    if found:
        show_bench(loaded[0].source, found, table, step, request.json)
    return exit_code(loaded, found, interrupted)
