"""Build a shared library from C text: compile and link it, store it in the cache, and open it with library.py.

If the cache has the library, only `_cffi_backend` is imported: neither cffi's parser nor subprocess.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from threading import Lock

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BuildError
from gudgeon.loading import compiler
from gudgeon.loading.background_compilation import BackgroundCompilation, build_command_lines
from gudgeon.loading.cache import Cache, WriteFiles, compute_digest, get_default_cache, get_private_cache, warn_once
from gudgeon.loading.compiler import start_compiler, wait_for_compiler
from gudgeon.loading.engine import compute_engine_digest, list_scene_texts
from gudgeon.loading.library import Library, open_bundled_library, open_library
from gudgeon.loading.optimized_library import SOURCE, UNOPTIMIZED_KIND, OptimizedLibrary, may_compile_in_background
from gudgeon.waiting.cancellation import report_work
from gudgeon.waiting.programs import Programs

LIBRARY = "kernels.so"  # file name of the library in an entry of the cache
REQUIRED_FUNCTION = "gudgeon_prepare"  # a function that every scene's library has
_libraries: dict[str, Library] = {}
_lock = Lock()


def compile_kernels(
    source: KernelSource,
    *,
    portable: bool = False,
    rebuild: bool = False,
    cache: Cache | None = None,
    background: BackgroundCompilation | None = None,
    quick: bool = False,
) -> Library:
    """Return the library of a kernel source, compiled if the cache lacks it; without a compiler, the wheel's.

    portable: use no instructions that only this CPU has. rebuild: compile even if the cache has it. background: parts
    that may be under way already. quick: if the cache has none, an unoptimized library may serve while the
    optimized one is made (optimized_library.py). Raises BuildError without a compiler, or if compiling or loading
    fails.
    """
    cache = cache or get_default_cache()
    try:
        command = compiler.find_compiler()
    except BuildError:
        if not rebuild and (bundled := open_bundled_library(source)):
            return bundled
        raise
    flags = (*compiler.build_flags(portable, command), *compiler.build_link_flags())
    key = compute_library_key(source, command, flags, compiler.describe_compiler(command, cache), portable)
    with _lock:
        loaded = None if rebuild else _libraries.get(key)
    if loaded:
        if not quick:
            loaded.lib.wait_for_optimized_library()
        return loaded

    def build(folder: Path, unoptimized: bool = False, background: BackgroundCompilation | None = background) -> None:
        """Build the library in a folder, and report that this takes a while.

        `background`: a compilation whose parts are reused; None: all parts are compiled here.
        """
        with (
            report_work(f"compiling {source.mechanism}, scene {source.scene}"),
            BackgroundCompilation(portable, cache) as no_background,
        ):
            _build_library(source, folder, portable, background or no_background, cache, rebuild, unoptimized)

    library = _compile_unoptimized_library(source, portable, cache, key, build) if quick and not rebuild else None
    if library is None:
        entry = cache.fetch("libraries", key, build, renew=rebuild)
        try:
            library = _open_entry(entry, source.cdef)
        except ImportError as error:  # whole, and yet it cannot be mapped
            library = _rebuild_or_copy_library(key, entry, source.cdef, cache, build, error)
    with _lock:
        return _libraries.setdefault(key, library)


def _compile_unoptimized_library(
    source: KernelSource, portable: bool, cache: Cache, key: str, build: Callable[..., None]
) -> Library | None:
    """Build an unoptimized library, start another process that builds the optimized one (`key`), and return the first.

    Return None if the optimized library must be awaited: if no process may or can be started, the cache cannot be used,
    the library cannot be loaded, or the cache has an unoptimized library already. In the last case the other process is
    running or has failed.
    """
    if not may_compile_in_background(cache) or cache.has_folder("libraries", key):
        return None
    command = compiler.find_compiler()
    flags = (*compiler.build_flags(portable, command, unoptimized=True), *compiler.build_link_flags())
    library_key = compute_library_key(source, command, flags, compiler.describe_compiler(command, cache), portable)
    if cache.has_folder(UNOPTIMIZED_KIND, library_key):
        return None

    def build_unoptimized_library(folder: Path) -> None:
        """Build the unoptimized library in a folder, and store its source for the other process."""
        build(folder, True)
        for name in source.files:
            (folder / name).unlink()
        (folder / SOURCE).write_bytes(source.to_json().encode())

    entry = cache.fetch(UNOPTIMIZED_KIND, library_key, build_unoptimized_library)
    if not entry.is_relative_to(cache.root):
        return None
    optimized_library = OptimizedLibrary(
        cache, key, lambda folder: build(folder, background=None), lambda entry: _open_entry(entry, source.cdef)
    )
    try:
        library = _open_entry(entry, source.cdef)
    except ImportError:  # the caller reports it for the optimized library
        return None
    if not optimized_library.start_process(entry, portable):
        return None
    library.lib.set_pending_library(optimized_library)
    return library


def is_compiled(source: KernelSource, *, portable: bool = False) -> bool:
    """Return whether `compile_kernels` finds the optimized library of a source in memory or in the cache.

    Raises BuildError without a compiler.
    """
    cache, command = get_default_cache(), compiler.find_compiler()
    flags = (*compiler.build_flags(portable, command), *compiler.build_link_flags())
    key = compute_library_key(source, command, flags, compiler.describe_compiler(command, cache), portable)
    return key in _libraries or cache.has_entry("libraries", key)


def compute_library_key(
    source: KernelSource, command: tuple[str, ...], flags: tuple[str, ...], compiler_description: str, portable: bool
) -> str:
    """Return the library's cache key: a digest of texts, flags and compiler, and of the CPU unless `portable`."""
    cpu, texts = "" if portable else compiler.describe_cpu(), list_scene_texts(source)
    key_parts = [
        source.main,
        source.cdef,
        *command,
        *flags,
        *(flag for more in compiler.UNIT_FLAGS.values() for flag in more),
    ]
    return compute_digest(["library/6", *key_parts, compiler_description, cpu, compute_engine_digest(), *texts])


def _open_entry(entry: Path, cdef: str) -> Library:
    """Open the library in the folder of a cache entry.

    Raise ImportError if it cannot be loaded, or if a scene's library lacks REQUIRED_FUNCTION. `cdef`: declarations, ""
    for those of the engine.
    """
    library = open_library(entry / LIBRARY, cdef)
    if not cdef and not hasattr(library.lib, REQUIRED_FUNCTION):
        raise ImportError(f"{entry / LIBRARY} has no function {REQUIRED_FUNCTION}")
    return library


def _rebuild_or_copy_library(
    key: str, entry: Path, cdef: str, cache: Cache, build: WriteFiles, error: ImportError
) -> Library:
    """Build a library that could not be loaded again, or copy it to a temporary folder with a warning; return it open.

    `error`: the error of the first attempt. Raises BuildError if the library cannot be loaded after that either.
    """
    private, root = get_private_cache(), entry.parents[1]
    if not _is_noexec(root):  # the library may be damaged
        try:
            entry = cache.fetch("libraries", key, build, renew=True)
            return _open_entry(entry, cdef)
        except ImportError as again:
            error = again
    if not entry.is_relative_to(private.root):
        try:
            library = _open_entry(private.fetch("libraries", key, lambda folder: _copy_library(entry, folder)), cdef)
        except ImportError as again:
            error = again
        else:
            why = "is mounted noexec" if _is_noexec(root) else f"cannot be loaded from ({error})"
            copied = f"libraries are copied to {private.root} at each start"
            do = "Set GUDGEON_CACHE to a folder whose programs may be run"
            warn_once(f"the cache folder {root} {why}: {copied}. {do}.", f"{root}: run")
            return library
    command = " ".join(compiler.find_compiler())
    message = f"the compiler {command} ended without an error, but its library cannot be loaded: {error}"
    hint = "set CC to a compiler for this machine, such as CC=gcc"
    if _is_noexec(private.root):
        message = f"the compiled library cannot be loaded: {error}"
        hint = f"{private.root} is mounted noexec: set GUDGEON_CACHE or TMPDIR to a folder that is not"
    raise BuildError(f"{message}\n  {hint}") from error


def _is_noexec(folder: Path) -> bool:
    """Return whether the file system forbids to execute files in a folder; False where that is unknown (macOS)."""
    return bool(os.statvfs(folder).f_flag & getattr(os, "ST_NOEXEC", 0))


def _copy_library(entry: Path, folder: Path) -> None:
    """Copy the library of a cache entry to a folder."""
    (folder / LIBRARY).write_bytes((entry / LIBRARY).read_bytes())


def build_portable_library(folder: Path, source: KernelSource, cache: Cache) -> Path:
    """Compile the portable library of a source for the processor that $CC compiles for; return its path in `folder`."""
    with BackgroundCompilation(True, cache) as no_background:
        _build_library(source, folder, True, no_background, cache, False, False)
    return folder / LIBRARY


def _build_library(
    source: KernelSource,
    folder: Path,
    portable: bool,
    background: BackgroundCompilation,
    cache: Cache,
    renew: bool,
    unoptimized: bool,
) -> None:
    """Write the C files into the folder, compile the scene's own parts, and link them with the shared object files.

    All parts are compiled in parallel; those that `background` has begun are used. Object files are removed at the end.
    Raises the first error of a compiler (BuildError, or OSError for a full disk).
    """
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    command_lines = build_command_lines(source, portable, unoptimized)
    parts_in_background = {
        name
        for name, command_line in command_lines.items()
        if background.is_compiling(name, command_line, source.files)
    }
    with Programs() as programs:
        compilations = [
            (start_compiler(programs, command_line, folder), name)
            for name, command_line in command_lines.items()
            if name not in parts_in_background
        ]
        shared = background.list_shared_objects(source, unoptimized)
        for part in shared:
            background.start_shared_object(part)
        objects = [str(part.fetch_file(portable, cache, background, renew)) for part in shared]
        for name in parts_in_background:
            if not background.fetch_object(folder / name, command_lines[name], source.files):
                compilations.append(
                    (start_compiler(programs, command_lines[name], folder), name)
                )  # compiled again here, so that its error is reported
        failed = [
            finished
            for process, name in compilations
            if (finished := wait_for_compiler(programs, process, folder / name))
        ]
        link = [*compiler.find_compiler(), *compiler.build_link_flags(), *command_lines, *objects, "-o", LIBRARY, "-lm"]
        if not failed and (
            finished := wait_for_compiler(programs, start_compiler(programs, link, folder), folder / LIBRARY)
        ):
            failed = [finished]
        if failed:
            raise failed[0]
    for name in command_lines:
        (folder / name).unlink()
