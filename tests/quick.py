"""Libraries of mechanisms that one test alone has are compiled by TinyCC, or without optimization where there is none.

That takes a thirtieth of the time, or a third. Numbers are the same: sums are made in the order of the text at every
level and by every compiler (no -ffast-math, no contraction). What is shipped is compiled as users have it, and so is
everything in tests marked `optimized` (they run long, or are about the compiler) and where slow tests are asked for;
in tests marked `plain`, which ask for a few numbers of many scenes, shipped ones are compiled like all others.
Keys of the cache hold command and flags: nothing is taken for something else.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from functools import cache, wraps
from hashlib import sha256
from pathlib import Path
from typing import Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading import build, compiler
from gudgeon.loading import kernel_sources as sources
from gudgeon.loading.shipped import MECHANISMS
from gudgeon.simulation import from_file

TCC_OR_CC = Path(__file__).with_name("tcc-or-cc")
_ALL = ContextVar("all", default="")
_QUICK = ContextVar("quick", default=False)


def plain(flags: tuple[str, ...]) -> tuple[str, ...]:
    """The same flags without optimization."""
    return ("-O0", *(flag for flag in flags if not flag.startswith("-O")))


@contextmanager
def compiled(as_users: bool, all_plain: bool) -> Iterator[None]:
    """In here everything is compiled as users have it, or nothing; neither: see above."""
    token = _ALL.set("as users" if as_users else "plain" if all_plain else "")
    try:
        yield
    finally:
        _ALL.reset(token)


def optimized() -> AbstractContextManager[None]:
    """Everything that is compiled in here is compiled as users have it."""
    return compiled(True, False)


def _is_plain() -> bool:
    return (_ALL.get() or ("plain" if _QUICK.get() else "")) == "plain"


@cache
def _shipped() -> frozenset[str]:
    return frozenset(sha256(file.read_bytes()).hexdigest() for file in MECHANISMS.glob("*.yaml"))


@contextmanager
def _decided(digest: str, changed: bool) -> Iterator[None]:
    token = _QUICK.set(changed or digest not in _shipped())
    try:
        yield
    finally:
        _QUICK.reset(token)


def _of_source(call: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(call)
    def decided(source: KernelSource, **options: Any) -> Any:
        with _decided(source.sha256, bool(source.overrides)):
            return call(source, **options)

    return decided


def install() -> None:
    """From now on in this process; once, before tests take these functions by name."""
    flags, find, load_bytes = compiler.build_flags, compiler.find_compiler, from_file.load_bytes
    hashed, own_hash = sources.compute_generator_hash, cache(sources.compute_generator_hash)

    @wraps(find)
    def decided_compiler() -> tuple[str, ...]:
        found = find()
        return (str(TCC_OR_CC), *found) if _is_plain() and len(found) == 1 and "CC" not in os.environ else found

    @wraps(flags)
    def decided_flags(portable: bool, command: tuple[str, ...] = (), unoptimized: bool = False) -> tuple[str, ...]:
        found = flags(portable, command, unoptimized)
        return plain(found) if _is_plain() else found

    @wraps(load_bytes)
    def decided_load(data: bytes, *arguments: Any, **options: Any) -> Any:
        with _decided(sha256(data).hexdigest(), bool(options.get("overrides"))):
            return load_bytes(data, *arguments, **options)

    @wraps(hashed)
    def decided_hash(package: Path = sources.PACKAGE) -> str:
        """The generator does not change while its tests run."""
        return own_hash() if package == sources.PACKAGE else hashed(package)

    sources.compute_generator_hash = decided_hash
    compiler.build_flags, compiler.find_compiler, from_file.load_bytes = decided_flags, decided_compiler, decided_load
    build.compile_kernels = from_file.compile_kernels = _of_source(build.compile_kernels)
    build.is_compiled = _of_source(build.is_compiled)
