"""C text to a loaded library: cffi writes the wrapper, our own compiler command builds it, the cache keeps it.

On a hit nothing but `_cffi_backend` is imported: neither cffi's parser nor subprocess.
"""

from __future__ import annotations

import errno
import os
import signal
from importlib.machinery import ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from threading import Lock
from types import ModuleType
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BuildError
from gudgeon.loading import compiler
from gudgeon.loading.ahead import HEADER, OBJECT, Ahead, unit_line
from gudgeon.loading.cache import Cache, Make, default_cache, digest, private_cache, tell_once
from gudgeon.loading.engine import UNIT, declarations, engine_digest
from gudgeon.waiting.imports import CFFI, whole
from gudgeon.waiting.programs import Programs
from gudgeon.waiting.working import working

if TYPE_CHECKING:
    import subprocess

LIBRARY = "kernels.so"
SCENE, LOOPS, WRAPPER = "scene.o", OBJECT, "wrapper.o"
ASKS = 'extern "Python" int gudgeon_python_asks(void *);\n'  # what C calls to ask Python (integrators/asking.py)
FULL = {
    "No space left on device": errno.ENOSPC, "Disk quota exceeded": errno.EDQUOT, "File too large": errno.EFBIG,
    "File size limit exceeded": errno.EFBIG,
}  # fmt: skip
_modules: dict[str, ModuleType] = {}
_lock = Lock()


def compile_kernels(
    source: KernelSource, *, portable: bool = False, rebuild: bool = False, cache: Cache | None = None,
    ahead: Ahead | None = None,
) -> ModuleType:  # fmt: skip
    """The library of a kernel source, compiled if the cache has none; the module has `ffi` and `lib`.

    portable: no instructions that only this CPU has. rebuild: compile even if the cache has it.
    ahead: where the engine may be under way already.
    Raises BuildError if there is no compiler or no Python.h, or if the C does not compile or load.
    """
    cache = cache or default_cache()
    command = compiler.find_compiler()
    flags = (*compiler.flags(portable), *compiler.link_flags())
    key = library_key(source, command, flags, compiler.identity(command, cache), portable)
    with _lock:
        if key in _modules and not rebuild:
            return _modules[key]

    def build(folder: Path) -> None:
        with working(f"compiling {source.mechanism}, scene {source.scene}"):
            _build(source, key, portable, folder, ahead)

    entry = cache.fetch("libraries", key, build, renew=rebuild)
    try:
        module = _open(key, entry)
    except ImportError as error:  # whole, and yet it cannot be mapped
        module = _open_elsewhere(key, entry, build, error)
    with _lock:
        return _modules.setdefault(key, module)


def library_key(
    source: KernelSource, command: tuple[str, ...], flags: tuple[str, ...], identity: str, portable: bool
) -> str:
    """Everything that decides the library's bytes or whether this machine can run them."""
    texts = [part for name in sorted(source.files) for part in (name, source.files[name])]
    cpu = "" if portable else compiler.cpu()
    return digest(
        ["library/4", source.main, source.cdef, ASKS, *command, *flags, identity, cpu, engine_digest(), *texts]
    )


def _name(key: str) -> str:
    return f"_gudgeon_{key[:16]}"


def _open(key: str, entry: Path) -> ModuleType:
    name, path = _name(key), str(entry / LIBRARY)
    loader = ExtensionFileLoader(name, path)
    spec = spec_from_file_location(name, path, loader=loader)
    assert spec is not None  # a loader was given
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


def _open_elsewhere(key: str, entry: Path, build: Make, error: ImportError) -> ModuleType:
    """The library from a temporary folder: a copy, or where that does not load either, built anew. Told."""
    private = private_cache()
    if not entry.is_relative_to(private.root):
        root = entry.parents[1]
        why = "is mounted noexec" if _noexec(root) else f"cannot be loaded from ({error})"
        copied = f"what is compiled is copied to {private.root} at each start"
        do = "Set GUDGEON_CACHE to a folder whose programs may be run"
        tell_once(f"the cache folder {root} {why}: {copied}. {do}.", f"{root}: run")
        for make, renew in ((lambda folder: _copy(entry, folder), False), (build, True)):
            try:
                return _open(key, private.fetch("libraries", key, make, renew=renew))
            except ImportError as again:
                error = again
                if _noexec(private.root):
                    break
    hint = ""
    if _noexec(private.root):
        hint = f"\n  {private.root} is mounted noexec: set GUDGEON_CACHE or TMPDIR to a folder that is not"
    raise BuildError(f"the compiled library cannot be loaded: {error}{hint}") from error


def _noexec(folder: Path) -> bool:
    """Whether the file system forbids to run what is in it; False where it does not say (macOS)."""
    return bool(os.statvfs(folder).f_flag & getattr(os, "ST_NOEXEC", 0))


def _copy(entry: Path, folder: Path) -> None:
    (folder / LIBRARY).write_bytes((entry / LIBRARY).read_bytes())


def _build(source: KernelSource, key: str, portable: bool, folder: Path, ahead: Ahead | None) -> None:
    """Write the C files and the wrapper into the folder, compile them there, each on its own, and link them.

    The scene and the engine are under way while cffi is imported and writes its wrapper. What the wrapper does is to
    convert arguments, which no optimizer makes faster.
    """
    command, includes = compiler.find_compiler(), compiler.include_folders()
    flags = [*command, *compiler.flags(portable)]
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    units = {SCENE: source.main} if source.cdef else {SCENE: source.main, LOOPS: str(UNIT)}
    lines = {name: unit_line(command, portable, unit, name) for name, unit in units.items()}
    early, header = None if source.cdef else ahead, source.files.get(HEADER, "")
    with Programs() as programs:
        under_way = {LOOPS} if early and early.is_under_way(header, lines[LOOPS]) else set()
        made = [(_begin(programs, line, folder), name) for name, line in lines.items() if name not in under_way]
        whole(*CFFI)
        from cffi import FFI

        ffi = FFI()
        calls = declarations(source)
        ffi.cdef(calls + ASKS)
        ffi.set_source(_name(key), f"#include <stddef.h>\n{calls}", compiler_verbose=0)
        ffi.emit_c_code(str(folder / "wrapper.c"))
        paths = (f"-I{path}" for path in includes)
        wrapper = _begin(programs, [*flags, "-O0", *paths, "-c", "wrapper.c", "-o", WRAPPER], folder)
        made.append((wrapper, WRAPPER))
        if under_way and early and not early.take(header, lines[LOOPS], folder / LOOPS):
            made.append((_begin(programs, lines[LOOPS], folder), LOOPS))  # here it says what is wrong
        failed = [finished for process, name in made if (finished := _finish(programs, process, folder / name))]
        link = [*command, *compiler.link_flags(), *units, WRAPPER, "-o", LIBRARY, "-lm"]
        if not failed and (finished := _finish(programs, _begin(programs, link, folder), folder / LIBRARY)):
            failed = [finished]
        if failed:
            raise failed[0]
    for name in (*units, WRAPPER):
        (folder / name).unlink()


def _begin(programs: Programs, line: list[str], folder: Path) -> subprocess.Popen[str]:
    """A compiler under way in the folder."""
    environment = {**compiler.plain(), "TMPDIR": str(folder)}  # what it writes in between belongs to the entry too
    try:
        return programs.begin(line, folder, environment)
    except OSError as error:
        raise BuildError(f"the compiler {line[0]} cannot be run: {error}\n  {compiler.INSTALL_COMPILER}") from error


def _finish(programs: Programs, process: subprocess.Popen[str], made: Path) -> Exception | None:
    """Wait; what to raise where it failed: OSError for a full disk (another folder is tried then), else BuildError."""
    out, err = programs.wait(process)
    if process.returncode == 0 and made.is_file():
        return None
    said = (err or out).strip()
    for text, code in FULL.items():
        if text in said:
            return OSError(code, f"the compiler said: {text}")
    if process.returncode == -signal.SIGXFSZ:
        return OSError(errno.EFBIG, "the compiler was stopped by a limit on the size of files (ulimit -f)")
    first = "\n  ".join(said.splitlines()[:8]) or "it said nothing"
    hint = f"\n  {compiler.INSTALL_HEADERS}" if "Python.h" in said else ""
    line = " ".join(map(str, process.args))  # type: ignore[arg-type]
    return BuildError(f"the C compiler failed (exit status {process.returncode}): {line}\n  {first}{hint}")
