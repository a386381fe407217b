"""Write a scene as an FMU (FMI 3.0) with its C sources and a binary for this machine (engine/fmi).

Parameters of the FMU are the scene's parameters; outputs are all series that C computes. In co-simulation the engine
integrates between communication points, and every such point ends a step. Contacts and events are located inside the
steps. In model exchange the importer integrates. Its states are the coordinates and velocities that the engine
integrates, and the works. Event indicators are the penetrations of joints with play and the switching points of
expressions. Parameter values that a native run refuses are refused.
https://fmi-standard.org/docs/3.0.2/
"""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.methods import FINE
from gudgeon.errors import BadValueError, BuildError
from gudgeon.exchange.fmu_description import (
    UNITS,
    build_fmu_build_description,
    build_model_description,
    compute_instantiation_token,
    explain_exchange_obstacle,
    find_discontinuous_switches,
    iterate_outputs,
)
from gudgeon.files.writing import write_bytes
from gudgeon.integrators.adaptive import (
    MAX_FILM_SPEED_ERROR,
    RTOL,
    find_integrated_angles,
    select_first_method,
    select_stiff_method,
)
from gudgeon.integrators.kinematic import MAX_CORRECTION
from gudgeon.loading import compiler
from gudgeon.loading.engine import read_engine_files
from gudgeon.model.parameters import GAINS, format_conditions, list_conditions
from gudgeon.model.sizes import MIN_RELATIVE_CLEARANCE, find_size_indices

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.simulation.simulation import Simulation

README = "README.md"
FILE_DATE = (1980, 1, 1, 0, 0, 0)  # date of all files in the archive, so that the bytes are reproducible


def write_fmu(simulation: Simulation, target: str | os.PathLike[str]) -> None:
    """Write the FMU of a scene to a file.

    Raises BuildError if the C does not compile, BadValueError for scenes with contours or user-defined C, OutputError
    if writing fails.
    """
    write_bytes(target, build_fmu(simulation))


def build_fmu(simulation: Simulation) -> bytes:
    """Return the FMU of a scene as the bytes of a zip archive, reproducible for the same scene and compiler.

    It contains descriptions, sources and a binary for this machine; without a compiler only sources. Raises
    BadValueError for a scene with contours of bearings or user-defined C, BuildError if the compiler fails.
    """
    source = simulation.source
    if source.contours or source.cdef:
        message = "an FMU cannot contain a scene with contours of bearings or user-defined C"
        raise BadValueError(message, hint="choose another scene")
    name = re.sub(r"\W", "_", f"{source.mechanism}_{source.scene}", flags=re.ASCII)
    scene_files = {
        path: text for path, text in source.files.items() if path not in (README, "lanes.c")
    }  # not called by an FMU
    sources = {**scene_files, **_read_engine_texts(), "fmu.h": _format_header(simulation)}
    files = {
        "modelDescription.xml": build_model_description(source, name).encode(),
        "sources/buildDescription.xml": build_fmu_build_description(name).encode(),
        **{f"sources/{path}": text.encode() for path, text in sources.items()},
        f"sources/{README}": _format_readme(source, name, scene_files).encode(),
    }
    if compiler.has_compiler():
        files[f"binaries/{_get_platform_name()}/{name}{'.dylib' if sys.platform == 'darwin' else '.so'}"] = (
            _compile_binary(sources)
        )
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, FILE_DATE), data, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def _format_readme(source: KernelSource, name: str, scene_files: Mapping[str, str]) -> str:
    """Return the README of the folder `sources`, with the lines of the scene's README about its files.

    `scene_files` are the scene's files in the FMU, `name` is the model identifier.
    """
    lines = [line for line in source.files.get(README, "").splitlines() if line.startswith("- `")]
    listed_lines = [line for line in lines if line.split("`")[1] in scene_files]
    flags = "-O1 -std=c11 -ffp-contract=off -fPIC -shared -fvisibility=hidden -I."
    return "\n".join(
        [
            f"# Sources of the FMU `{name}`",
            "",
            f"C that gudgeon wrote for the mechanism `{source.mechanism}`, scene `{source.scene}`, and its engine. SI.",
            "",
            *listed_lines,
            "- `fmu.h`: parameters, start and variables of this scene, which the functions of the FMU read",
            "- `engine/fmi/fmi3.c`: these functions; the rest of `engine` has time loops, methods, contacts, events",
            "",
            "To compile in this folder, if the importer does not use `buildDescription.xml`:",
            "",
            "```",
            f"cc {flags} {' '.join(UNITS)} -lm -o {name}.so",
            "```",
            "",
        ]
    )


def _read_engine_texts() -> dict[str, str]:
    """Return the engine's C files as texts by path."""
    return {path: text for path, text in read_engine_files().items() if not path.endswith(".py")}


def _get_platform_name() -> str:
    """Return the name of FMI's folder for binaries of this machine, such as "x86_64-linux"."""
    machine = {"arm64": "aarch64", "amd64": "x86_64"}.get(os.uname().machine.lower(), os.uname().machine)
    return f"{machine}-{'darwin' if sys.platform == 'darwin' else 'linux'}"


def _compile_binary(sources: Mapping[str, str]) -> bytes:
    """Compile the sources, by path, and return the bytes of the shared library, for any processor of this architecture.

    They are written to a temporary folder; only functions of FMI are exported. Raises BuildError with the compiler's
    message.
    """
    command = compiler.find_compiler()
    with tempfile.TemporaryDirectory(prefix="gudgeon-fmu-") as folder:
        for path, text in sources.items():
            file = Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        command_line = [
            *command,
            *compiler.build_flags(True, command),
            *compiler.build_link_flags(),
            "-fvisibility=hidden",
            "-I.",
            *UNITS,
        ]
        process = subprocess.run(
            [*command_line, "-o", "made", "-lm"],
            cwd=folder,
            env=compiler.build_environment(),
            capture_output=True,
            text=True,
        )
        if process.returncode:
            raise BuildError(
                f"the C compiler failed (exit status {process.returncode}):\n  {process.stderr.strip()[:2000]}"
            )
        return Path(folder, "made").read_bytes()


def _format_header(simulation: Simulation) -> str:
    """Return the text of fmu.h, the tables of this scene that engine/fmi/fmi3.c reads.

    They are constants, default parameters, the start, indices and outputs, and the tables of conditions. The start is
    assembled at the file's values.
    """
    source, compiled = simulation.source, simulation.compiled
    start = simulation.start()
    small_rtol = (source.taylor_file and source.max_taylor_tolerance) or FINE
    methods = {
        rtol: (select_first_method(source, rtol), select_stiff_method(source, rtol))
        for rtol in (small_rtol, 0.5 * small_rtol)
    }
    (first_method_name, stiff_method_name), (first_method_fine, stiff_method_fine) = methods.values()
    gains = [source.parameter_indices[name] for name in GAINS if name in source.parameter_indices]
    sizes, clearance_indices = find_size_indices(source), [joint.clearance for joint in source.clearances]
    angles = (
        [int(x) for x in find_integrated_angles(source)]
        if source.tree_coordinates or source.formulation == "full"
        else []
    )
    output_columns = [(part, column) for _, _, part, column, _ in iterate_outputs(source)]
    defines: dict[str, object] = {
        "FMU_TOKEN": f'"{compute_instantiation_token(source)}"',
        "FMU_PARAMETERS": max(len(source.parameters), 1),
        "FMU_VALUES": max(compiled.n_p, 1),
        "FMU_N_PARAMETERS": len(source.parameters),
        "FMU_OUTPUTS": len(output_columns),
        "FMU_BAUMGARTE_GAINS": len(gains),
        "FMU_SIZES": len(sizes),
        "FMU_CLEARANCES": len(clearance_indices),
        "FMU_RTOL": repr(RTOL),
        "FMU_FINE_RTOL": repr(small_rtol),
        "FMU_HAS_FILM": int(any(joint.film for joint in source.clearances)),
        "FMU_FILM_VELOCITY_TOL": repr(MAX_FILM_SPEED_ERROR),
        "FMU_MAX_CORRECTION": repr(MAX_CORRECTION),
        "FMU_AUTOMATIC": int(not source.is_explicit),
        "FMU_FIRST_METHOD": f'"{first_method_name}"',
        "FMU_STIFF_METHOD": f'"{stiff_method_name}"',
        "FMU_FIRST_METHOD_FINE": f'"{first_method_fine}"',
        "FMU_STIFF_METHOD_FINE": f'"{stiff_method_fine}"',
        "FMU_EXCHANGE": int(not explain_exchange_obstacle(source)),
        "FMU_CONDITIONS": len(list_conditions(source)),
        "FMU_JUMPS": len(find_discontinuous_switches(source)),
        "FMU_MIN_RELATIVE_CLEARANCE": repr(MIN_RELATIVE_CLEARANCE),
    }
    lines = [
        "/* Constants and tables of this scene for the FMU's functions. */",
        "#define FMU_AT_LEAST(n) ((n) > 0 ? (n) : 1)",
    ]
    lines += [f"#define {name} {value}" for name, value in defines.items()]
    lines += [
        _format_c_array("double", "fmu_defaults", [repr(float(parameter.default)) for parameter in source.parameters]),
        _format_c_array("double", "fmu_start", [repr(float(x)) for x in (*start.q, *start.v)]),
        _format_c_array("int", "fmu_baumgarte_gains", gains),
        _format_c_array("int", "fmu_clearances", clearance_indices),
        _format_c_array("int", "fmu_sizes", [f"{{{x}, {y}}}" for x, y in sizes], "[2]"),
        _format_c_array("unsigned char", "fmu_is_angle", angles),
        _format_c_array("int", "fmu_jumps", find_discontinuous_switches(source)),
        _format_c_array("int", "fmu_outputs", [f"{{{part}, {column}}}" for part, column in output_columns], "[2]"),
    ]
    return "\n".join([*lines, *_format_condition_tables(source)]) + "\n"


def _format_condition_tables(source: KernelSource) -> list[str]:
    """Return the C tables of a scene's parameters, of their conditions, of the parameters in bounds, and of joints with
    play.

    A condition relates a parameter to a constant plus a sum of other parameters (conditions.c).
    """
    parameter_rows = [
        f"{{{_format_c_string(parameter.address)}, {_format_c_string(parameter.unit)}, {int(parameter.follows)},"
        f" {int(bool(parameter.words))}}}"
        for parameter in source.parameters
    ]
    condition_rows: list[str] = []
    bound_indices: list[int] = []
    for condition in list_conditions(source):
        constant = 0.0 if isinstance(condition.bound, str) else float(condition.bound)
        message_literal = _format_c_string(
            f"{condition.message}; expected {format_conditions(source, condition.address)}"
        )
        index = source.parameter_indices[condition.address]
        condition_rows.append(
            f"{{{index}, {len(bound_indices)}, {len(condition.addresses)},"
            f' "{condition.relation}", {constant!r}, {message_literal}}}'
        )
        bound_indices += [source.parameter_indices[address] for address in condition.addresses]
    return [
        _format_c_array(
            "struct { const char *address, *unit; int depends_on_parameters, chosen; }",
            "fmu_parameters",
            parameter_rows or ['{"", "", 0, 0}'],
        ),
        _format_c_array(
            "struct { int parameter, first, count; const char *relation; double bound; const char *message; }",
            "fmu_conditions",
            condition_rows or ['{0, 0, 0, "<", 0.0, ""}'],
        ),
        _format_c_array("int", "fmu_bounds", bound_indices),
        _format_c_array("char *const", "fmu_joints", [_format_c_string(joint.name) for joint in source.clearances]),
    ]


def _format_c_string(text: str) -> str:
    """Return a text as a string literal of C."""
    return json.dumps(text, ensure_ascii=False)


def _format_c_array(c_type: str, name: str, values: Sequence[object], dimensions: str = "") -> str:
    """Return the definition of a static array of C with eight elements a line.

    `dimensions` are further dimensions, such as "[2]". An empty array gets one element that is not read.
    """
    elements = [str(value) for value in values] or ["{0, 0}" if dimensions else "0"]
    rows = [", ".join(elements[k : k + 8]) for k in range(0, len(elements), 8)]
    body_text = ",\n    ".join(rows)
    return f"static const {c_type} {name}[]{dimensions} = {{\n    {body_text}}};"
