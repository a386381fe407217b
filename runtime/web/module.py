"""Compile a scene's C and the engine to a WebAssembly module, with zig from a Python wheel.

The module is a reactor: it has functions and a memory, and no main. simulator.js calls the functions of calls.h as
Python does. The only import is the time of day, for polling a cancellation.
"""

from __future__ import annotations

import os
import re
import shutil
from importlib.metadata import version
from pathlib import Path

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import KINEMATIC
from gudgeon.errors import BadValueError, BuildError
from gudgeon.loading.cache import Cache, compute_digest, get_default_cache
from gudgeon.loading.compiler import build_environment, find_zig, wait_for_compiler
from gudgeon.loading.engine import UNIT, build_include_flags, compute_engine_digest, select_declarations
from gudgeon.waiting.cancellation import report_work
from gudgeon.waiting.programs import Programs

MODULE = "simulator.wasm"
# functions that simulator.js calls if the scene has them
EXPORTED_FUNCTIONS = (
    "prepare",
    "mass",
    "phi",
    "phi_q",
    "nu",
    "start_values",
    "start",
    "continuation",
    "evaluate",
    "run_size",
    "run_start",
    "run_enable_end_events",
    "run_events",
    "run_impacts",
    "run_report",
    "run_sample",
    "method",
    "adaptive_setup",
    "adaptive_run",
    "kinematic_size",
    "kinematic_begin",
    "kinematic_restart",
    "kinematic_progress",
    "kinematic_set_recording",
    "kinematic",
    "kinematic_works",
    "kinematic_events",
)
KINEMATIC_EXPORTED_FUNCTIONS = ("rhs",)  # further functions for scenes without degrees of freedom
# No contraction to fused multiply-adds and no fast math, as for libraries (loading/compiler.py). Without unrolled loops
# a module is a tenth shorter. The stack has the usual size of programs; zig places it first in memory, so that an
# overflow traps instead of overwriting data.
FLAGS = (
    "-target",
    "wasm32-wasi",
    "-mexec-model=reactor",
    "-O2",
    "-fno-unroll-loops",
    "-msimd128",
    "-std=c11",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fno-sanitize=undefined",
    "-fvisibility=hidden",
    "-DAUDITS=0",
    "-Werror=implicit-function-declaration",
    "-s",
    "-Wl,--gc-sections",
    "-Wl,-z,stack-size=8388608",
    "-Wl,--export=malloc",
    "-Wl,--export=free",
)


def compile_simulator(source: KernelSource, *, cache: Cache | None = None) -> bytes:
    """Return the WebAssembly module of a scene from the cache, or compile it; the first compilation takes a minute.

    Raises BuildError if the compiler is missing or the C does not compile, BadValueError for scenes that the engine
    does not run.
    """
    if source.cdef:
        raise BadValueError(f"{source.mechanism}/{source.scene} has no simulator: the engine does not run this scene")
    compiler, cache = _find_zig(), cache or get_default_cache()
    command = [
        str(compiler),
        "cc",
        *FLAGS,
        *_list_export_options(source),
        *build_include_flags(),
        source.main,
        str(UNIT),
        "-o",
        MODULE,
    ]
    key_parts = [text for name in sorted(source.files) for text in (name, source.files[name])]
    key = compute_digest(["web/1", version("ziglang"), *command[1:], compute_engine_digest(), *key_parts])

    def build(folder: Path) -> None:
        """Compile the module into a folder of the cache."""
        with report_work(f"compiling {source.mechanism}, scene {source.scene}, for pages"):
            _compile_module(source, command, folder)

    return (cache.fetch("web", key, build) / MODULE).read_bytes()


def _find_zig() -> Path:
    """Return the path of the compiler zig.

    Raises BuildError with the command that installs it if its wheel is missing.
    """
    try:
        return find_zig()
    except ImportError as error:
        raise BuildError(
            "the compiler zig for simulators in pages is not installed\n"
            "  install it, a wheel of 100 MB: pip install 'gudgeon[web]'"
        ) from error


def _list_export_options(source: KernelSource) -> list[str]:
    """Return the linker options that export the functions that simulator.js calls, if the scene declares them."""
    declared_functions = set(re.findall(r"\bgudgeon_(\w+)\(", select_declarations(source)))
    needed_functions = EXPORTED_FUNCTIONS + (KINEMATIC_EXPORTED_FUNCTIONS if source.methods == (KINEMATIC,) else ())
    return [f"-Wl,--export=gudgeon_{name}" for name in needed_functions if name in declared_functions]


def _compile_module(source: KernelSource, command: list[str], folder: Path) -> None:
    """Write the C files into the folder and compile the module there.

    zig stores its C library next to the cache entries, for all scenes. Raises BuildError.
    """
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    zig_cache = os.environ.get("ZIG_GLOBAL_CACHE_DIR") or str(folder.parents[1] / "zig")
    cache_folders = {
        "ZIG_GLOBAL_CACHE_DIR": zig_cache,
        "ZIG_LOCAL_CACHE_DIR": str(folder / "zig"),
        "TMPDIR": str(folder),
    }
    with Programs() as programs:
        try:
            process = programs.start(command, folder, {**build_environment(), **cache_folders})
        except OSError as error:
            raise BuildError(f"zig cannot be run: {error}\n  reinstall it: pip install 'gudgeon[web]'") from error
        if build_error := wait_for_compiler(programs, process, folder / MODULE):
            raise build_error
    shutil.rmtree(folder / "zig", ignore_errors=True)
