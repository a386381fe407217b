"""Memoize functions of a scene and its parameter values: a cache of their results for calls with the same values."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from threading import Lock
from typing import Any, TypeVar

import numpy as np

from gudgeon.contract.kernel_source import CACHED_VALUES

Value = TypeVar("Value")
# of one scene, of all functions together; the oldest is dropped first, but those that depend on the scene alone stay
MAX_ENTRIES = 256
MAX_BYTES = 1 << 16  # of an array in a key: calls with larger arrays are not cached
_LOCK = Lock()
_EMPTY: dict[Any, Any] = {}  # the cache of an owner without one; as a value: not cached


def _replace_lock() -> None:
    """Replace the lock in a forked process, in which the thread that held it at the fork does not exist."""
    global _LOCK
    _LOCK = Lock()


os.register_at_fork(after_in_child=_replace_lock)


def cache_by_values(function: Callable[..., Value]) -> Callable[..., Value]:
    """Cache the results of a function by the values of its arguments; a decorator.

    The first argument owns the cache: a CompiledModel, a KernelSource or another object with attributes. The others,
    positional only, are arrays, which are compared byte by byte, or values that are equal and of the same type. Calls
    with values that cannot be compared by a hash are not cached; nor are exceptions. Results are shared between calls:
    callers must not change them.
    """
    return _cache_by_key(function, None)


def cache_selected_values(
    select: Callable[..., tuple[Any, ...]],
) -> Callable[[Callable[..., Value]], Callable[..., Value]]:
    """Return a decorator as `cache_by_values` for functions that depend on a part of their arguments only.

    `select` returns that part, from the same arguments: the values that are compared.
    """
    return lambda function: _cache_by_key(function, select)


def _cache_by_key(
    function: Callable[..., Value], select: Callable[..., tuple[Any, ...]] | None
) -> Callable[..., Value]:
    """Cache the results of a function by the values of its arguments, or of what `select` returns for them."""
    name = f"{function.__module__}.{function.__name__}"

    @wraps(function)
    def get_cached_result(owner: Any, *arguments: Any) -> Value:
        """Return the cached result, or call the function and cache its result.

        Arguments are compared by type and value, arrays by shape, type and bytes. Nothing is cached for arrays of more
        than MAX_BYTES and arguments without a hash; beyond MAX_ENTRIES the oldest results are removed.
        """
        entry: Any = name
        if arguments:
            key: list[Any] = [name]
            for argument in arguments if select is None else select(owner, *arguments):
                if type(argument) is np.ndarray:
                    if argument.nbytes > MAX_BYTES:
                        return function(owner, *arguments)
                    key += argument.shape, argument.dtype.char, argument.tobytes()
                else:
                    key += type(argument), argument
            entry = tuple(key)
        cache: dict[Any, Value] = owner.__dict__.get(CACHED_VALUES, _EMPTY)
        try:
            value: Any = cache.get(entry, _EMPTY)  # without the lock, which only guards changes
        except TypeError:  # an argument has no hash
            return function(owner, *arguments)
        if value is not _EMPTY:
            return value
        value = function(owner, *arguments)
        with _LOCK:
            cache = owner.__dict__.setdefault(CACHED_VALUES, {})
            while len(cache) >= MAX_ENTRIES and (oldest := next((x for x in cache if type(x) is tuple), None)):
                del cache[oldest]
            cache[entry] = value
        return value

    return get_cached_result
