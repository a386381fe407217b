"""Compute fields of dataclasses at their first use (lazy evaluation), for results that callers read in part only."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any, Protocol, TypeVar

Class = TypeVar("Class", bound=type)
Instance = TypeVar("Instance")
_PROVIDER = "_provider"  # key of an instance's dictionary: the object that computes its deferred fields


class Provider(Protocol):
    """Compute the deferred fields of one instance: it has a method without arguments for each name in `fields`."""

    fields: tuple[str, ...]


class _DeferredField:
    """Compute a field at its first use: a descriptor that Python calls if the instance does not have the value."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, instance: Any, owner: type) -> Any:
        """Return the value of the field and store it in the instance. Raises AttributeError if there is none."""
        compute = None if instance is None else find_deferred_function(instance, self.name)
        if compute is None:
            raise AttributeError(f"{owner.__name__!r} has no value of {self.name!r}")
        return instance.__dict__.setdefault(self.name, compute())  # of two threads both get the same object


def defer_fields(*names: str) -> Callable[[Class], Class]:
    """Allow `make_with_deferred_fields` to defer the fields `names` of a dataclass; a class decorator."""

    def add_descriptors(cls: Class) -> Class:
        for name in names:
            setattr(cls, name, _DeferredField(name))
        return cls

    return add_descriptors


def make_with_deferred_fields(cls: type[Instance], values: Mapping[str, Any], provider: Provider) -> Instance:
    """Return an instance of a dataclass with the `values` of its fields; `provider` computes the others.

    A field is computed at its first use, at most once in a thread. `values` and `provider` must cover all fields.
    """
    instance = cls.__new__(cls)
    instance.__dict__.update(values)
    instance.__dict__[_PROVIDER] = provider
    return instance


def replace_fields(instance: Instance, **changes: Any) -> Instance:
    """Return a copy of a dataclass instance with changed fields; other fields that are deferred stay deferred."""
    provider: Provider | None = instance.__dict__.get(_PROVIDER)
    if provider is None:
        return replace(instance, **changes)  # type: ignore[type-var]
    names = {field.name for field in fields(instance)}  # type: ignore[arg-type]
    values = {name: value for name, value in instance.__dict__.items() if name in names} | changes
    return make_with_deferred_fields(type(instance), values, provider)


def find_deferred_function(instance: object, name: str) -> Callable[[], Any] | None:
    """Return the function without arguments that computes a deferred field; None if it was computed or is not deferred.

    Cached properties with deferred values call this function too.
    """
    provider: Provider | None = instance.__dict__.get(_PROVIDER)
    if provider is None or name in instance.__dict__ or name not in provider.fields:
        return None
    function: Callable[[], Any] = getattr(provider, name)
    return function


def read_deferred_fields(instance: object) -> dict[str, Any]:
    """Return the values of all deferred fields of an instance by name, computed now if they have not been."""
    provider: Provider | None = instance.__dict__.get(_PROVIDER)
    return {} if provider is None else {name: getattr(instance, name) for name in provider.fields}
