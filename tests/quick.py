"""Libraries of mechanisms that one test alone has are compiled without optimization: that takes a third of the time.

Numbers are the same: sums are made in the order of the text at every level (no -ffast-math, no contraction). What is
shipped is compiled as users have it, and so is everything in tests marked `optimized` (they run long, or are about the
compiler) and where slow tests are asked for. Keys of the cache hold the flags: nothing is taken for something else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, wraps
from hashlib import sha256
from typing import Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading import build, compiler
from gudgeon.loading.shipped import MECHANISMS
from gudgeon.simulation import from_file

_ALL_OPTIMIZED = ContextVar("all_optimized", default=False)
_QUICK = ContextVar("quick", default=False)


def plain(flags: tuple[str, ...]) -> tuple[str, ...]:
    """The same flags without optimization."""
    return ("-O0", *(flag for flag in flags if not flag.startswith("-O")))


@contextmanager
def optimized(wanted: bool = True) -> Iterator[None]:
    """Everything that is compiled in here is compiled as users have it."""
    token = _ALL_OPTIMIZED.set(wanted)
    try:
        yield
    finally:
        _ALL_OPTIMIZED.reset(token)


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
    flags, load_bytes = compiler.flags, from_file.load_bytes

    @wraps(flags)
    def decided_flags(portable: bool, command: tuple[str, ...] = (), quick: bool = False) -> tuple[str, ...]:
        found = flags(portable, command, quick)
        return plain(found) if _QUICK.get() and not _ALL_OPTIMIZED.get() else found

    @wraps(load_bytes)
    def decided_load(data: bytes, *arguments: Any, **options: Any) -> Any:
        with _decided(sha256(data).hexdigest(), bool(options.get("overrides"))):
            return load_bytes(data, *arguments, **options)

    compiler.flags, from_file.load_bytes = decided_flags, decided_load
    build.compile_kernels = from_file.compile_kernels = _of_source(build.compile_kernels)
    build.is_compiled = _of_source(build.is_compiled)
