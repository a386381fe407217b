"""A scene as an FMU: FMI 3.0, Co-Simulation, its sources with it and a binary for this machine (engine/fmi).

Parameters are the scene's numbers, outputs all series that are columns of what C computes. The engine's own loops
integrate between communication points, each of which ends a step; contacts and events are located on the way.
https://fmi-standard.org/docs/3.0.2/
"""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax.saxutils import quoteattr

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import FINE
from gudgeon.errors import BadValueError, BuildError
from gudgeon.files.writing import write_bytes
from gudgeon.integrators.adaptive import FELT_BY_FILMS, RTOL, begins_with, integrated_angles, stiff_of
from gudgeon.integrators.kinematic import REACH
from gudgeon.language.units import DIMENSIONLESS, parse_unit
from gudgeon.loading import compiler
from gudgeon.loading.engine import engine_files
from gudgeon.model.parameters import GAINS
from gudgeon.model.sizes import size_places
from gudgeon.results.series import catalogue

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation

TIME, TOLERANCE, PARAMETERS, OUTPUTS = 0, 1, 16, 1 << 20  # value references, as engine/fmi/fmi3.c has them
PARTS = ("q", "v", "work", "memory", "a", "multipliers", "reactions", "torques", "clearance", "series", "friction",
         "energy", "power", "drift")  # fmt: skip
WIDTHS = {"reactions": 3, "clearance": 10, "friction": 2}
UNITS = ("scene.c", "engine/engine.c", "engine/fmi/fmi3.c")  # what is compiled
WHEN = (1980, 1, 1, 0, 0, 0)  # of files in the archive: the same bytes each time


def write_fmu(simulation: Simulation, target: str | os.PathLike[str]) -> None:
    """Write the FMU of a scene. Raises BuildError where the C does not compile, BadValueError for what cannot go."""
    write_bytes(target, fmu_bytes(simulation))


def fmu_bytes(simulation: Simulation) -> bytes:
    """The archive. Without a compiler it has the sources alone."""
    source = simulation.source
    if source.contours or source.cdef:
        raise BadValueError("a scene whose bearings have contours does not go into an FMU: they are no numbers of it")
    name = re.sub(r"\W", "_", f"{source.mechanism}_{source.scene}", flags=re.ASCII)
    texts = {**source.files, **_engine(), "fmu.h": _header(simulation)}
    files = {
        "modelDescription.xml": _description(source, name).encode(),
        "sources/buildDescription.xml": _build(name).encode(),
        **{f"sources/{path}": text.encode() for path, text in texts.items()},
    }
    if compiler.is_there():
        files[f"binaries/{_platform()}/{name}{'.dylib' if sys.platform == 'darwin' else '.so'}"] = _binary(texts)
    room = io.BytesIO()
    with zipfile.ZipFile(room, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, WHEN), data, zipfile.ZIP_DEFLATED)
    return room.getvalue()


def _engine() -> dict[str, str]:
    return {path: text for path, text in engine_files().items() if not path.endswith(".py")}


def _platform() -> str:
    machine = {"arm64": "aarch64", "amd64": "x86_64"}.get(os.uname().machine.lower(), os.uname().machine)
    return f"{machine}-{'darwin' if sys.platform == 'darwin' else 'linux'}"


def _binary(texts: Mapping[str, str]) -> bytes:
    """The library for any processor of this kind."""
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


def outputs(source: KernelSource) -> Iterator[tuple[str, str, int, int, str]]:
    """Name, unit, part (−1: states of contacts), column, meaning of each series that is a column."""
    open_ = {f"{name}.{last}" for name in source.indeterminate for last in ("Fx", "Fy", "M", "torque", "force")}
    open_ |= {f"lambda.{row.name}" for row in source.rows if row.owner in source.indeterminate}
    for name, series in catalogue(source).items():
        if name in open_:
            continue
        if series.stored is not None:
            part, column = series.stored
        elif series.evaluated is not None:
            part, index = series.evaluated
            row, column = index if len(index) == 2 else (0, index[0])
            column += row * WIDTHS.get(part, 0)
        else:
            continue
        yield name, series.unit, -1 if part == "state" else PARTS.index(part), column, series.meaning


def parameters(source: KernelSource) -> Iterator[tuple[int, str, str, float]]:
    """Place, address, unit and default of each number that may be set; not those that are chosen by a word."""
    for k, slot in enumerate(source.slots):
        if not slot.words:
            yield k, slot.address, slot.unit, slot.default


def _header(simulation: Simulation) -> str:
    """fmu.h: what engine/fmi/fmi3.c must know."""
    source, compiled = simulation.source, simulation.compiled
    start = simulation.start()
    methods = {rtol: (begins_with(source, rtol), stiff_of(source, rtol)) for rtol in (2.0 * FINE, 0.5 * FINE)}
    (begins, stiff), (begins_fine, stiff_fine) = methods.values()
    gains = [source.place[name] for name in GAINS if name in source.place]
    sizes, plays = size_places(source), [joint.clearance for joint in source.clearances]
    angles = [int(x) for x in integrated_angles(source)] if source.tree or source.formulation == "full" else []
    places = [(part, column) for _, _, part, column, _ in outputs(source)]
    defines: dict[str, object] = {
        "FMU_TOKEN": f'"{token(source)}"', "FMU_SLOTS": max(len(source.slots), 1), "FMU_NUMBERS": max(compiled.n_p, 1),
        "FMU_SLOTS_USED": len(source.slots), "FMU_OUTPUTS": len(places), "FMU_GAINS": len(gains),
        "FMU_SIZES": len(sizes), "FMU_PLAYS": len(plays), "FMU_RTOL": repr(RTOL), "FMU_FINE": repr(FINE),
        "FMU_FILM": int(any(joint.film for joint in source.clearances)), "FMU_FELT": repr(FELT_BY_FILMS),
        "FMU_BEYOND": int(bool(compiled.beyond)), "FMU_REACH": repr(REACH), "FMU_AUTOMATIC": int(not source.explicit),
        "FMU_BEGINS": f'"{begins}"', "FMU_STIFF": f'"{stiff}"', "FMU_BEGINS_FINE": f'"{begins_fine}"',
        "FMU_STIFF_FINE": f'"{stiff_fine}"',
    }  # fmt: skip
    lines = ["/* What the FMU's functions must know of this scene. */", "#define FMU_AT_LEAST(n) ((n) > 0 ? (n) : 1)"]
    lines += [f"#define {name} {value}" for name, value in defines.items()]
    lines += [
        _table("double", "fmu_defaults", [repr(float(slot.default)) for slot in source.slots]),
        _table("double", "fmu_start", [repr(float(x)) for x in (*start.q, *start.v)]),
        _table("int", "fmu_gains", gains), _table("int", "fmu_sizes", sizes), _table("int", "fmu_plays", plays),
        _table("unsigned char", "fmu_is_angle", angles),
        _table("int", "fmu_outputs", [f"{{{part}, {column}}}" for part, column in places], "[2]"),
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def _table(kind: str, name: str, values: Sequence[object], more: str = "") -> str:
    """An empty one holds a number that nobody reads."""
    cells = [str(value) for value in values] or ["{0, 0}" if more else "0"]
    rows = [", ".join(cells[k : k + 8]) for k in range(0, len(cells), 8)]
    body = ",\n    ".join(rows)
    return f"static const {kind} {name}[]{more} = {{\n    {body}}};"


def token(source: KernelSource) -> str:
    """By which a library knows that a description is its own."""
    parts = [source.mechanism, source.scene, *(part for item in sorted(source.files.items()) for part in item)]
    return "{" + sha256("\0".join(parts).encode()).hexdigest()[:32] + "}"


def _unit_name(unit: str) -> str:
    return f" unit={quoteattr(unit)}" if unit else ""


def _units(names: set[str]) -> list[str]:
    """Each unit by exponents of m, kg and s; angles are told apart by their name."""
    found = []
    for name in sorted(names - {""}):
        parsed = parse_unit(name)
        of = parsed[0].dimension if parsed else DIMENSIONLESS
        exponents = {"kg": of.mass, "m": of.length, "s": of.time, "rad": Fraction(name.startswith("rad"))}
        base = "".join(f' {si}="{e}"' for si, e in exponents.items() if e)
        whole = all(e.denominator == 1 for e in exponents.values())
        found.append(f"    <Unit name={quoteattr(name)}>{f'<BaseUnit{base}/>' if whole else ''}</Unit>")
    return found


def _description(source: KernelSource, name: str) -> str:
    """modelDescription.xml."""
    told, numbers = list(outputs(source)), list(parameters(source))
    units = {unit for _, unit, *_ in told} | {unit for _, _, unit, _ in numbers} | {"s"}
    variables = [
        f'    <Float64 name="time" valueReference="{TIME}" causality="independent" variability="continuous" unit="s"/>',
        f'    <Float64 name="relative_tolerance" valueReference="{TOLERANCE}" causality="parameter" variability="fixed"'
        f' start="{RTOL!r}" description="of a step; docs/methods.md of gudgeon says of what"/>',
    ]
    variables += [
        f'    <Float64 name={quoteattr(address)} valueReference="{PARAMETERS + k}" causality="parameter"'
        f' variability="fixed" start="{float(default)!r}"{_unit_name(unit)}/>'
        for k, address, unit, default in numbers
    ]
    variables += [
        f'    <Float64 name={quoteattr(series)} valueReference="{OUTPUTS + k}" causality="output"'
        f' variability="continuous" initial="calculated"{_unit_name(unit)} description={quoteattr(meaning)}/>'
        for k, (series, unit, _, _, meaning) in enumerate(told)
    ]
    structure = [f'    <Output valueReference="{OUTPUTS + k}"/>' for k in range(len(told))]
    structure += [f'    <InitialUnknown valueReference="{OUTPUTS + k}"/>' for k in range(len(told))]
    title = quoteattr(source.title or source.mechanism)
    return "\n".join([
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<fmiModelDescription fmiVersion="3.0" modelName={quoteattr(name)} instantiationToken="{token(source)}"',
        f'  description={title} generationTool="gudgeon" variableNamingConvention="flat">',
        f'  <CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true"',
        '    canGetAndSetFMUState="true" canSerializeFMUState="false"/>',
        "  <UnitDefinitions>", *_units(units), "  </UnitDefinitions>",
        f'  <DefaultExperiment startTime="0" tolerance="{RTOL!r}"/>',
        "  <ModelVariables>", *variables, "  </ModelVariables>",
        "  <ModelStructure>", *structure, "  </ModelStructure>",
        "</fmiModelDescription>", "",
    ])  # fmt: skip


def _build(name: str) -> str:
    """sources/buildDescription.xml."""
    return "\n".join([
        '<?xml version="1.0" encoding="UTF-8"?>', '<fmiBuildDescription fmiVersion="3.0">',
        f'  <BuildConfiguration modelIdentifier="{name}">',
        '    <SourceFileSet language="C11" compilerOptions="-ffp-contract=off">',
        *(f'      <SourceFile name="{unit}"/>' for unit in UNITS),
        '      <IncludeDirectory name="."/>', "    </SourceFileSet>", '    <Library name="m" external="true"/>',
        "  </BuildConfiguration>", "</fmiBuildDescription>", "",
    ])  # fmt: skip
