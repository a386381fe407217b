"""Run `gudgeon check`: report whether a mechanism file is valid; with -v, also how its equations are reduced.

With -v each scene is derived again, without the cache. The output has a table of counts and then, for each scene, the
reduction log: each elimination step with its reason, the solved equations, operations before and after, methods, notes,
and the time of each stage of the derivation. No line is longer than WIDTH columns.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from gudgeon.commands import assembly_report
from gudgeon.commands.common import parse_settings
from gudgeon.commands.progress import show_status_line
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import KINEMATIC
from gudgeon.contract.reduction_description import describe_reduced_system, describe_reduction_steps
from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.errors import AssemblyError, InputError, InputErrors, MissingKeyError
from gudgeon.integrators.adaptive import select_first_method
from gudgeon.language.text_output import print_json
from gudgeon.loading.kernel_sources import derive_kernel_source, find_mechanism, read_bytes
from gudgeon.model.contours import find_contour_parameters

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

    from gudgeon.generator.mechanism import Mechanism

WIDTH = 100  # columns of what is printed
MAX_INDENT = 14  # maximum indentation of continuation lines, in columns
MARGIN, GAP = 4, 3  # columns left of a table, and between its columns
REFERENCE_SOLVERS = ("scipy:*", "sundials:*")  # methods of reference solvers


def check_mechanism(
    name: str, verbose: bool, as_json: bool, branches: bool = False, settings: Sequence[str] = ()
) -> int:
    """Run `gudgeon check`: check a mechanism file, print the result, and return the exit code.

    name: shipped name or path. verbose: with reduction logs. branches: with all assemblies. settings: texts
    ADDRESS=VALUE, in place of the file's values. Raises InputError for an invalid file, AssemblyError if a scene does
    not assemble; with `as_json` both are in the printed document.
    """
    from gudgeon.generator.reader.read import read_mechanism

    overrides, file = parse_settings(settings), find_mechanism(name)
    try:
        data = read_bytes(file)
        mechanism = read_mechanism(data, str(file))
    except InputError as error:
        if not as_json:
            raise
        print_json({"valid": False, "errors": _build_error_documents(error)})
        return error.exit_code
    seconds: dict[str, dict[str, float]] = {scene: {} for scene in mechanism.scenes}
    with show_status_line(quiet=as_json):
        findings = assembly_report.assemble_scenes(mechanism, branches, overrides)
        scenes = {
            scene: derive_kernel_source(data, file, scene, seconds=seconds[scene])
            for scene in mechanism.scenes
            if verbose
        }
    if as_json:
        print_json(_build_check_document(mechanism, scenes, seconds, findings))
        return _find_exit_code(mechanism, findings)
    print(
        _wrap_labelled_text(
            assembly_report.format_verdict(mechanism, findings),
            f"{_format_counts(mechanism)}; {assembly_report.format_degrees_of_freedom(findings)}",
        )
    )
    for subject, remark in assembly_report.yield_remarks(mechanism, findings):
        print(_wrap_labelled_text(f"  {subject}", remark))
    for line in assembly_report.yield_assembly_lines(findings) if branches else ():
        print(line)
    if scenes:
        _print_scenes(mechanism, scenes, seconds)
    for scene, problem in findings.errors.items():
        prefix = "" if len(findings.errors) == len(mechanism.scenes) else f"scene {scene}: "
        raise AssemblyError(f"{prefix}{problem}")
    return _find_exit_code(mechanism, findings)


def _find_exit_code(mechanism: Mechanism, findings: assembly_report.Findings) -> int:
    """Return the exit code: that of the first scene that does not assemble, else that of a missing mass, else 0."""
    mass_code = MissingKeyError.exit_code if assembly_report.list_scenes_without_masses(mechanism, findings) else 0
    return next((error.exit_code for error in findings.errors.values()), mass_code)


def _build_error_documents(error: InputError) -> list[dict[str, Any]]:
    """Return the errors of a file as dictionaries for `--json`: kind, file, line, column, message and hint of each.

    An InputErrors gives one for each of its errors. Without a location, file, line and column are None.
    """
    errors = error.errors if isinstance(error, InputErrors) else (error,)
    return [
        {
            "kind": type(e).__name__,
            "file": e.where.file if e.where else None,
            "line": e.where.line if e.where else None,
            "column": e.where.column if e.where else None,
            "message": e.message,
            "hint": e.hint,
        }
        for e in errors
    ]


def _format_counts(mechanism: Mechanism) -> str:
    """Return the numbers of bodies, joints and drives: "2 bodies, 3 joints, 1 drive; scenes ideal, worn"."""
    numbers = [
        (len(mechanism.bodies), "body", "bodies"),
        (len(mechanism.joints), "joint", "joints"),
        (len(mechanism.drives), "drive", "drives"),
    ]
    count_texts = [f"{count} {singular if count == 1 else plural}" for count, singular, plural in numbers]
    return f"{', '.join(count_texts)}; scenes {', '.join(mechanism.scenes)}"


def _build_scene_counts(source: KernelSource) -> dict[str, int]:
    """Return the counts of a scene for the table, by label.

    They are unknowns, constraint equations, degrees of freedom, non-zeros of Φ_q, joints with play, parameters, depths
    of contours if there are any, and the operations of each C function.
    """
    counts = {
        "unknowns": len(source.coordinates),
        "rows": len(source.equations),
        "degrees of freedom": source.degrees_of_freedom,
        "non-zeros of Φ_q": source.reduction_log.jacobian,
        "joints with play": len({joint.joint for joint in source.clearances}),
        "numbers that can be set": len(source.parameters),
        **({"of them depths of contours": len(find_contour_parameters(source))} if source.contours else {}),
    }
    return counts | {_format_kernel_label(name): count for name, count in source.operations.items()}


def find_eliminated_drive_equations(source: KernelSource) -> tuple[str, ...]:
    """Return the names of constraint equations of drives that the tree solves: their coordinates are functions of time.

    In the full formulation there are none.
    """
    if source.formulation == "full":
        return ()
    rows = (source.equations[drive.row].name for drive in source.drives if drive.row >= 0)
    return tuple(row for row in rows if row not in source.closures)


def _can_run_in_reference_solvers(source: KernelSource) -> bool:
    """Return whether the integrators of SciPy and SUNDIALS can run the scene (integrators/peers).

    They cannot run scenes without degrees of freedom, or with set-valued friction, jumps of a drive's rate or
    explicit contact laws.
    """
    return KINEMATIC not in source.methods and not (source.frictions or source.rate_jumps or source.is_explicit)


def _describe_reduction(source: KernelSource) -> dict[str, Any]:
    """Return for `--json` the formulation, tree, closures, solved drives, operation counts and available methods.

    Reference solvers are among the methods if they can run the scene. The first method of `auto` is named too.
    """
    operations = {"full": source.operations["dynamics"]}
    if "reduced_dynamics" in source.operations:
        operations["reduced"] = source.operations["reduced_dynamics"]
    return {
        "formulation": source.formulation,
        "tree": list(source.tree_coordinates),
        "closures": list(source.closures),
        "driven": list(find_eliminated_drive_equations(source)),
        "operations of the accelerations": operations,
        "methods": [*source.methods, *(REFERENCE_SOLVERS if _can_run_in_reference_solvers(source) else ())],
        "auto begins with": select_first_method(source),
    }


def _yield_derivation_lines(source: KernelSource, seconds: Mapping[str, float]) -> Iterator[tuple[str, str]]:
    """Yield the (label, text) lines below the reduction log: methods, events, notes, time of each stage.

    `seconds`: wall time by stage of the derivation.
    """
    yield (
        "methods",
        f"{', '.join(_describe_reduction(source)['methods'])}; auto begins with {select_first_method(source)}",
    )
    if source.events:
        yield "events", ", ".join(_format_events(source))
    for note in source.notes:
        yield "", note
    stages = ", ".join(f"{name} {took:.2f}" for name, took in seconds.items())
    yield "seconds", f"{stages}; together {sum(seconds.values()):.2f}"


def _format_events(source: KernelSource) -> list[str]:
    """Return a text for each event: "top (falling, recorded)"; "ends the run" for one with `action: stop`."""
    does = {"record": "recorded", "stop": "ends the run"}
    return [f"{event.name} ({event.direction}, {does[event.action]})" for event in source.events]


def _format_kernel_label(kernel: str) -> str:
    """Return the row label of a kernel: "operations in dynamics"; a name that contains a space unchanged."""
    return kernel if " " in kernel else f"operations in {kernel}"


def _build_check_document(
    mechanism: Mechanism,
    scenes: Mapping[str, KernelSource],
    seconds: Mapping[str, Mapping[str, float]],
    findings: assembly_report.Findings,
) -> dict[str, Any]:
    """Return the whole result of the check as a dictionary for `--json`.

    It has the names of the mechanism's parts, the verdict, the assembled scenes, the assemblies, and for each derived
    scene its equations with the wall time of each stage from `seconds`; {} for a scene that was not derived.
    """
    return {
        "valid": True,
        "name": mechanism.name,
        "title": mechanism.title,
        "bodies": list(mechanism.bodies),
        "joints": list(mechanism.joints),
        "drives": list(mechanism.drives),
        "verdict": assembly_report.format_verdict(mechanism, findings),
        "assembled": assembly_report.build_scene_documents(findings),
        "assemblies": assembly_report.build_assembly_documents(findings),
        "scenes": {
            name: _build_scene_document(scenes[name]) | {"seconds": seconds[name]} if name in scenes else {}
            for name in mechanism.scenes
        },
    }


def _build_scene_document(source: KernelSource) -> dict[str, Any]:
    """Return the counts, reduction, events, notes and reduction log of one scene for `--json`."""
    document = {
        "events": _format_events(source),
        "notes": list(source.notes),
        "story": build_log_document(source.reduction_log),
    }
    return {**_build_scene_counts(source), **_describe_reduction(source), **document}


def _print_scenes(
    mechanism: Mechanism, scenes: Mapping[str, KernelSource], seconds: Mapping[str, Mapping[str, float]]
) -> None:
    """Print the tables of counts and the reduction logs of all scenes; seconds: time of each stage by scene.

    Scenes that fit share a table. Kernels without operations in every scene are left out.
    """
    from gudgeon.language.text_output import format_one_line, make_plain_console

    counts_by_scene = {scene: _build_scene_counts(source) for scene, source in scenes.items()}
    names = [
        name
        for name in dict.fromkeys(name for counts in counts_by_scene.values() for name in counts)
        if not name.startswith("operations") or any(counts.get(name) for counts in counts_by_scene.values())
    ]  # without kernels that are zero in every scene
    console, title = make_plain_console(WIDTH), format_one_line(mechanism.title or mechanism.name)
    for scene_names in _group_columns(scenes, max(map(len, names))):
        console.print(_make_count_table(title, names, {scene: counts_by_scene[scene] for scene in scene_names}))
    for part in yield_reduction_logs(scenes, lambda source: _yield_derivation_lines(source, seconds[source.scene])):
        console.print(part)


def _wrap_labelled_text(label: str, text: str) -> str:
    """Return "label: text" in lines of at most WIDTH columns; continuation lines are indented."""
    indent = " " * min(len(label) + 2, MAX_INDENT)
    lines = textwrap.wrap(f"{label}: {text}", WIDTH, subsequent_indent=indent, break_on_hyphens=False)
    return "\n".join(lines)


def _group_columns(scenes: Mapping[str, KernelSource], label_width: int) -> Iterator[list[str]]:
    """Yield groups of scene names whose columns fit next to each other in one table of WIDTH characters.

    A scene whose column is too wide has a group of its own. label_width: width of the first column.
    """
    scene_names: list[str] = []
    for scene in scenes:
        widths = [max(len(name), len("999,999")) + GAP for name in [*scene_names, scene]]
        if scene_names and MARGIN + label_width + sum(widths) > WIDTH:
            yield scene_names
            scene_names = []
        scene_names.append(scene)
    yield scene_names


def _make_count_table(title: str, names: Sequence[str], counts_by_scene: Mapping[str, Mapping[str, int]]) -> Table:
    """Return a table of rich with one column for each scene and one row for each count; "–" where a scene lacks it."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    table.add_column("", no_wrap=True)
    for scene in counts_by_scene:
        table.add_column(scene, justify="right", no_wrap=True)
    for name in names:
        table.add_row(name, *(f"{counts[name]:,}" if name in counts else "–" for counts in counts_by_scene.values()))
    return table


def yield_reduction_logs(
    scenes: Mapping[str, KernelSource], yield_further_lines: Callable[[KernelSource], Iterable[tuple[str, str]]]
) -> Iterator[Text | Table]:
    """Yield heading and reduction log of each scene, its outcome, and the (label, text) lines of `yield_further_lines`,
    for rich.

    If an earlier scene has the same log, only the lines that differ are shown.
    """
    from rich.text import Text

    printed_logs: list[tuple[str, list[tuple[int, int, str]], list[tuple[str, str]]]] = []
    for scene, source in scenes.items():
        steps, lines = (
            list(describe_reduction_steps(source)),
            [*describe_reduced_system(source), *yield_further_lines(source)],
        )
        earlier_log = next((other for other in printed_logs if other[1] == steps), None)
        if earlier_log:
            lines = [line for line in lines if line not in earlier_log[2]]
            yield Text(f"scene {scene}: as {earlier_log[0]}{', but' if lines else ''}", style="bold")
        else:
            printed_logs.append((scene, steps, lines))
            yield Text(f"scene {scene}", style="bold")
        yield _make_log_table([] if earlier_log else steps, lines)


def _make_log_table(steps: Sequence[tuple[int, int, str]], lines: Iterable[tuple[str, str]]) -> Table:
    """Return a table without rules: remaining coordinates, remaining constraint equations, and the step's text.

    `steps`: (coordinates, equations, text) of each reduction step; without steps the table has no header. `lines`:
    (label, text) below the steps, with the label in the first column. The last row is empty.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, show_header=bool(steps))
    for name in ("coordinates", "rows"):
        table.add_column(name, justify="right", no_wrap=True, min_width=len(name))
    table.add_column()
    for n, m, text in steps:
        table.add_row(f"{n:,}", f"{m:,}", Text(text))
    for name, text in lines:
        table.add_row(name, "", Text(text))
    table.add_row()
    return table


def build_log_document(log: ReductionLog) -> dict[str, Any]:
    """Return the reduction log for `--json`, each step with the numbers of coordinates and constraint equations
    left.
    """
    remaining_counts = [{"coordinates left": n, "rows left": m} for _, n, m in log.iterate_steps()]
    data = asdict(log)
    data["steps"] = [step | counts for step, counts in zip(data["steps"], remaining_counts, strict=True)]
    return data
