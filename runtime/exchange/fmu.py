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
from gudgeon.exchange.fmu_description import UNITS, build, description, exchange_obstacle, jumps, outputs, token
from gudgeon.files.writing import write_bytes
from gudgeon.integrators.adaptive import FELT_BY_FILMS, RTOL, first_method, integrated_angles, stiff_method
from gudgeon.integrators.kinematic import REACH
from gudgeon.loading import compiler
from gudgeon.loading.engine import engine_files
from gudgeon.model.parameters import GAINS, conditions, expected
from gudgeon.model.sizes import LEAST_CLEARANCE, size_places

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.simulation.simulation import Simulation

README = "README.md"
FILE_DATE = (1980, 1, 1, 0, 0, 0)  # date of all files in the archive, so that the bytes are reproducible


def write_fmu(simulation: Simulation, target: str | os.PathLike[str]) -> None:
    """Write the FMU of a scene. Raises BuildError if the C does not compile, BadValueError for scenes with contours."""
    write_bytes(target, fmu_bytes(simulation))


def fmu_bytes(simulation: Simulation) -> bytes:
    """Return the FMU as the bytes of a zip archive. Without a compiler it contains the sources only.

    Raises as `write_fmu`.
    """
    source = simulation.source
    if source.contours or source.cdef:
        raise BadValueError("a scene whose bearings have contours does not go into an FMU: they are no numbers of it")
    name = re.sub(r"\W", "_", f"{source.mechanism}_{source.scene}", flags=re.ASCII)
    own = {path: text for path, text in source.files.items() if path not in (README, "lanes.c")}  # not called by an FMU
    texts = {**own, **_engine_texts(), "fmu.h": _header_text(simulation)}
    files = {
        "modelDescription.xml": description(source, name).encode(),
        "sources/buildDescription.xml": build(name).encode(),
        **{f"sources/{path}": text.encode() for path, text in texts.items()},
        f"sources/{README}": _readme_text(source, name, own).encode(),
    }
    if compiler.is_there():
        files[f"binaries/{_platform_name()}/{name}{'.dylib' if sys.platform == 'darwin' else '.so'}"] = _compile_binary(
            texts
        )
    room = io.BytesIO()
    with zipfile.ZipFile(room, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, FILE_DATE), data, zipfile.ZIP_DEFLATED)
    return room.getvalue()


def _readme_text(source: KernelSource, name: str, own: Mapping[str, str]) -> str:
    """Return the README of the folder `sources`; own: the scene's files in it."""
    lines = [line for line in source.files.get(README, "").splitlines() if line.startswith("- `")]
    message = [line for line in lines if line.split("`")[1] in own]
    flags = "-O1 -std=c11 -ffp-contract=off -fPIC -shared -fvisibility=hidden -I."
    return "\n".join(
        [
            f"# Sources of the FMU `{name}`",
            "",
            f"C that gudgeon wrote for the mechanism `{source.mechanism}`, scene `{source.scene}`, and its engine. SI.",
            "",
            *message,
            "- `fmu.h`: numbers, start and variables of this scene, as the FMU's functions read them",
            "- `engine/fmi/fmi3.c`: these functions; the rest of `engine` are time loops, methods, contacts, events",
            "",
            "In this folder, where the importer does not do it by `buildDescription.xml`:",
            "",
            "```",
            f"cc {flags} {' '.join(UNITS)} -lm -o {name}.so",
            "```",
            "",
        ]
    )


def _engine_texts() -> dict[str, str]:
    """Return the engine's C files as texts by path."""
    return {path: text for path, text in engine_files().items() if not path.endswith(".py")}


def _platform_name() -> str:
    """Return the name of FMI's folder for binaries of this machine, such as "x86_64-linux"."""
    machine = {"arm64": "aarch64", "amd64": "x86_64"}.get(os.uname().machine.lower(), os.uname().machine)
    return f"{machine}-{'darwin' if sys.platform == 'darwin' else 'linux'}"


def _compile_binary(texts: Mapping[str, str]) -> bytes:
    """Compile the sources and return the shared library, for any processor of this architecture. Raises BuildError."""
    command = compiler.find_compiler()
    with tempfile.TemporaryDirectory(prefix="gudgeon-fmu-") as folder:
        for path, text in texts.items():
            file = Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        line = [*command, *compiler.flags(True, command), *compiler.link_flags(), "-fvisibility=hidden", "-I.", *UNITS]
        done = subprocess.run(
            [*line, "-o", "made", "-lm"], cwd=folder, env=compiler.plain(), capture_output=True, text=True
        )
        if done.returncode:
            raise BuildError(f"the C compiler failed (exit status {done.returncode}):\n  {done.stderr.strip()[:2000]}")
        return Path(folder, "made").read_bytes()


def _header_text(simulation: Simulation) -> str:
    """Return the text of fmu.h, the tables of this scene that engine/fmi/fmi3.c reads."""
    source, compiled = simulation.source, simulation.compiled
    start = simulation.start()
    methods = {rtol: (first_method(source, rtol), stiff_method(source, rtol)) for rtol in (2.0 * FINE, 0.5 * FINE)}
    (begins, stiff), (begins_fine, stiff_fine) = methods.values()
    gains = [source.place[name] for name in GAINS if name in source.place]
    sizes, plays = size_places(source), [joint.clearance for joint in source.clearances]
    angles = [int(x) for x in integrated_angles(source)] if source.tree or source.formulation == "full" else []
    places = [(part, column) for _, _, part, column, _ in outputs(source)]
    defines: dict[str, object] = {
        "FMU_TOKEN": f'"{token(source)}"',
        "FMU_SLOTS": max(len(source.slots), 1),
        "FMU_NUMBERS": max(compiled.n_p, 1),
        "FMU_SLOTS_USED": len(source.slots),
        "FMU_OUTPUTS": len(places),
        "FMU_GAINS": len(gains),
        "FMU_SIZES": len(sizes),
        "FMU_PLAYS": len(plays),
        "FMU_RTOL": repr(RTOL),
        "FMU_FINE": repr(FINE),
        "FMU_FILM": int(any(joint.film for joint in source.clearances)),
        "FMU_FELT": repr(FELT_BY_FILMS),
        "FMU_BEYOND": int(bool(compiled.beyond)),
        "FMU_REACH": repr(REACH),
        "FMU_AUTOMATIC": int(not source.explicit),
        "FMU_BEGINS": f'"{begins}"',
        "FMU_STIFF": f'"{stiff}"',
        "FMU_BEGINS_FINE": f'"{begins_fine}"',
        "FMU_STIFF_FINE": f'"{stiff_fine}"',
        "FMU_EXCHANGE": int(not exchange_obstacle(source)),
        "FMU_CONDITIONS": len(conditions(source)),
        "FMU_JUMPS": len(jumps(source)),
        "FMU_LEAST_CLEARANCE": repr(LEAST_CLEARANCE),
    }
    lines = ["/* What the FMU's functions must know of this scene. */", "#define FMU_AT_LEAST(n) ((n) > 0 ? (n) : 1)"]
    lines += [f"#define {name} {value}" for name, value in defines.items()]
    lines += [
        _c_array("double", "fmu_defaults", [repr(float(slot.default)) for slot in source.slots]),
        _c_array("double", "fmu_start", [repr(float(x)) for x in (*start.q, *start.v)]),
        _c_array("int", "fmu_gains", gains),
        _c_array("int", "fmu_plays", plays),
        _c_array("int", "fmu_sizes", [f"{{{x}, {y}}}" for x, y in sizes], "[2]"),
        _c_array("unsigned char", "fmu_is_angle", angles),
        _c_array("int", "fmu_jumps", jumps(source)),
        _c_array("int", "fmu_outputs", [f"{{{part}, {column}}}" for part, column in places], "[2]"),
    ]
    return "\n".join([*lines, *_condition_tables(source)]) + "\n"


def _condition_tables(source: KernelSource) -> list[str]:
    """Return the C tables of parameters and of their conditions.

    A condition relates a parameter to a constant plus a sum of other parameters (conditions.c).
    """
    slots = [
        f"{{{_c_string(slot.address)}, {_c_string(slot.unit)}, {int(slot.follows)}, {int(bool(slot.words))}}}"
        for slot in source.slots
    ]
    rows: list[str] = []
    bounds: list[int] = []
    for one in conditions(source):
        number = 0.0 if isinstance(one.bound, str) else float(one.bound)
        message = _c_string(f"{one.message}; expected {expected(source, one.address)}")
        place = source.place[one.address]
        rows.append(f'{{{place}, {len(bounds)}, {len(one.addresses)}, "{one.relation}", {number!r}, {message}}}')
        bounds += [source.place[address] for address in one.addresses]
    return [
        _c_array(
            "struct { const char *address, *unit; int follows, chosen; }", "fmu_slots", slots or ['{"", "", 0, 0}']
        ),
        _c_array(
            "struct { int slot, first, count; const char *relation; double bound; const char *message; }",
            "fmu_conditions",
            rows or ['{0, 0, 0, "<", 0.0, ""}'],
        ),
        _c_array("int", "fmu_bounds", bounds),
        _c_array("char *const", "fmu_joints", [_c_string(joint.name) for joint in source.clearances]),
    ]


def _c_string(text: str) -> str:
    """Return a text as a string literal of C."""
    return json.dumps(text, ensure_ascii=False)


def _c_array(kind: str, name: str, values: Sequence[object], more: str = "") -> str:
    """Return a static array of C; `more`: further dimensions. An empty array gets one element that is not read."""
    cells = [str(value) for value in values] or ["{0, 0}" if more else "0"]
    rows = [", ".join(cells[k : k + 8]) for k in range(0, len(cells), 8)]
    body = ",\n    ".join(rows)
    return f"static const {kind} {name}[]{more} = {{\n    {body}}};"
