"""C text to a loaded library: cffi writes the wrapper, our own compiler command builds it, the cache keeps it.

On a hit nothing but `_cffi_backend` is imported: neither cffi's parser nor subprocess.
"""

from __future__ import annotations

import errno
from importlib.machinery import ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from threading import Lock
from types import ModuleType

from gudgeon import compiler
from gudgeon.cache import Cache, default_cache, digest, private_cache
from gudgeon.errors import BuildError
from gudgeon.kernel_source import KernelSource

LIBRARY = "kernels.so"
_modules: dict[str, ModuleType] = {}
_lock = Lock()


def compile_kernels(
    source: KernelSource, *, portable: bool = False, rebuild: bool = False, cache: Cache | None = None
) -> ModuleType:
    """The library of a kernel source, compiled if the cache has none; the module has `ffi` and `lib`.

    portable: no instructions that only this CPU has. rebuild: compile even if the cache has it.
    Raises BuildError if there is no compiler or no Python.h, or if the C does not compile or load.
    """
    cache = cache or default_cache()
    command = compiler.find_compiler()
    key = library_key(source, command, compiler.flags(portable), compiler.identity(command, cache), portable)
    with _lock:
        if key in _modules and not rebuild:
            return _modules[key]
    entry = cache.fetch("libraries", key, lambda folder: _build(source, key, portable, folder), renew=rebuild)
    try:
        module = _open(key, entry)
    except ImportError as error:  # whole, and yet it cannot be mapped: a folder mounted noexec
        if entry.is_relative_to(private_cache().root):
            raise BuildError(f"the compiled library cannot be loaded: {error}") from error
        entry = private_cache().fetch("libraries", key, lambda folder: _build(source, key, portable, folder))
        try:
            module = _open(key, entry)
        except ImportError as again:
            raise BuildError(f"the compiled library cannot be loaded: {again}") from error
    with _lock:
        return _modules.setdefault(key, module)


def library_key(
    source: KernelSource, command: tuple[str, ...], flags: tuple[str, ...], identity: str, portable: bool
) -> str:
    """Everything that decides the library's bytes or whether this machine can run them."""
    texts = [part for name in sorted(source.files) for part in (name, source.files[name])]
    cpu = "" if portable else compiler.cpu()
    return digest(["library/1", source.main, source.cdef, *command, *flags, identity, cpu, *texts])


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


def _build(source: KernelSource, key: str, portable: bool, folder: Path) -> None:
    """Write the C files and the wrapper into the folder and compile them there."""
    from cffi import FFI

    includes = compiler.include_folders()
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    ffi = FFI()
    ffi.cdef(source.cdef)
    ffi.set_source(_name(key), f'#include "{source.main}"', compiler_verbose=0)
    ffi.emit_c_code(str(folder / "wrapper.c"))
    _compile([*compiler.find_compiler(), *compiler.flags(portable)], includes, folder)


def _compile(command: list[str], includes: tuple[str, ...], folder: Path) -> None:
    import subprocess

    line = [*command, *(f"-I{path}" for path in includes), "wrapper.c", "-o", LIBRARY, "-lm"]
    try:
        done = subprocess.run(
            line,
            cwd=folder,
            env=compiler.plain(),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
        )
    except OSError as error:
        raise BuildError(f"the compiler {command[0]} cannot be run: {error}\n  {compiler.INSTALL_COMPILER}") from error
    if done.returncode == 0 and (folder / LIBRARY).is_file():
        return
    said = (done.stderr or done.stdout).strip()
    if "No space left on device" in said:
        raise OSError(errno.ENOSPC, "no space left for the compiler")
    first = "\n  ".join(said.splitlines()[:8]) or "it said nothing"
    hint = f"\n  {compiler.INSTALL_HEADERS}" if "Python.h" in said else ""
    raise BuildError(f"the C compiler failed (exit status {done.returncode}): {' '.join(line)}\n  {first}{hint}")
