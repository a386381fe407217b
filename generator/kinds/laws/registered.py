"""Registers user-defined laws: a file that exports `LAW`, like the files of this folder, or a Law made in Python.

Such a file is run as Python, so that only the command line and Python name it, never a mechanism file. A scene that
uses a law is cached under the law's key: an edited law is derived anew.
"""

from __future__ import annotations

import hashlib
import math
import os
import sys
import sysconfig
import traceback
from collections.abc import Iterator, Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any, TypeGuard

from gudgeon.errors import BadNameError, InputError, LawError, Location, shortened
from gudgeon.files.reading import MAX_BYTES, read_named
from gudgeon.generator.field import FLAG, NUMBER, RELATIONS, WORD, Bound, Field
from gudgeon.generator.kinds.laws.law import RESULTS, USER_LAWS, Law, State, bundled_laws
from gudgeon.language.argument_checks import path
from gudgeon.language.names import check_label, known_hint
from gudgeon.language.units import Dimension

WHOLE = "docs/describing.md has one whole"


@dataclass(frozen=True)
class Origin:
    """Represent where a law comes from: its path as given, and its absolute path; "" for a law made in Python.

    `key`: SHA-256 of the file and of modules next to it that it imports, else of its derived equations; "": not
    computed.
    """

    typed: str
    file: str
    key: str


ORIGINS: dict[str, Origin] = {}  # of the laws in OWN


def register(law: str | os.PathLike[str] | Law) -> Law:
    """Register a user-defined force law for every mechanism that is read afterwards, and return it.

    law: a Python file that exports `LAW`, which is run, or a Law. A law of the same origin is replaced.
    Raises LawError, an InputError, for a file that cannot be read, fails or has no LAW, a name that another law has,
    and a wrong declaration; the results of `build` are checked when a scene uses it.
    """
    own, origin = (law, Origin("", "", "")) if isinstance(law, Law) else _load_file(path(law, "law"))
    try:
        _check_declaration(own, origin)
    except LawError as error:
        raise LawError(f"{prefix(own.name, origin)}{error.message}", hint=error.hint) from None
    except Exception as error:  # a field of a type that nobody thought of
        hint = f"what each of its fields may be: {WHOLE}"
        name = getattr(own, "name", None)
        raise LawError(f"{prefix(name, origin)}its declaration is none: {message(error)}", hint=hint) from error
    USER_LAWS[own.name], ORIGINS[own.name] = own, origin
    return own


def prefix(name: object, origin: Origin | None) -> str:
    """Return the beginning of an error about a law: its file and name."""
    file = f"{origin.typed}: " if origin is not None and origin.typed else ""
    return f"{file}law {name}: " if isinstance(name, str) else file


def key_of(name: str) -> str:
    """Return the key of a user-defined law, a SHA-256 of its content; "" if there is none of that name."""
    if name not in USER_LAWS:
        return ""
    if not ORIGINS[name].key:
        from gudgeon.generator.kinds.laws.built import key_of_law

        ORIGINS[name] = replace(ORIGINS[name], key=key_of_law(USER_LAWS[name]))
    return ORIGINS[name].key


def place_in(error: BaseException, file: str) -> Location | None:
    """Return the location in a file at which an error arose; None if it arose elsewhere."""
    if isinstance(error, SyntaxError) and error.filename == file:
        return Location(file, error.lineno or 1, error.offset or 1)
    lines = [line for frame, line in traceback.walk_tb(error.__traceback__) if frame.f_code.co_filename == file]
    return Location(file, lines[-1], 1) if lines else None


def _load_file(typed: str | os.PathLike[str]) -> tuple[Law, Origin]:
    """Run a law's file and return its law. Raises LawError."""
    shown, hint = shortened(typed), f"expected a Python file that exports LAW; {WHOLE}"
    if not os.fspath(typed):
        raise LawError("a law's file has no name: ''", hint=hint)
    try:
        data = read_named(typed, MAX_BYTES, "the law", hint)
    except InputError as error:
        raise LawError(error.message, error.where, error.hint) from error
    digest = hashlib.sha256(data)
    module = ModuleType(f"gudgeon_law_{digest.hexdigest()[:16]}")
    module.__file__ = os.path.abspath(typed)
    sys.modules[module.__name__] = module  # a dataclass looks for its own module
    try:
        with redirect_stdout(sys.stderr):  # what it prints is no part of what a command prints
            exec(compile(data, shown, "exec"), module.__dict__)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        sys.modules.pop(module.__name__, None)
        place = place_in(error, shown) or Location(shown, 1, 1)
        raise LawError(f"the law cannot be read: {message(error)}", place) from error
    law = getattr(module, "LAW", None)
    if not isinstance(law, Law):
        what = "no LAW" if law is None else f"a LAW of type {type(law).__name__}"
        raise LawError(f"{shown} has {what}", hint=f"expected LAW = Law(name=…, role=…, build=build); {WHOLE}")
    for other in _imported_modules(module, {module}):
        digest.update(Path(str(other.__file__)).read_bytes())
    return law, Origin(shown, str(module.__file__), digest.hexdigest())


def message(error: BaseException) -> str:
    """Return a Python error as one line."""
    try:
        text = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
    except Exception:  # its own words fail
        text = ""
    return f"{type(error).__name__}{': ' if text else ''}{text}"


def _imported_modules(module: ModuleType, seen: set[ModuleType]) -> Iterator[ModuleType]:
    """Yield the user's modules that a law's file imports: not Python's, installed or gudgeon's."""
    installed = tuple(sysconfig.get_paths()[name] for name in ("stdlib", "platstdlib", "purelib", "platlib"))
    for value in list(vars(module).values()):
        other = value if isinstance(value, ModuleType) else sys.modules.get(getattr(value, "__module__", None) or "")
        if other is None or other in seen:
            continue
        seen.add(other)
        file = getattr(other, "__file__", None)
        if file and not other.__name__.startswith("gudgeon") and not os.path.abspath(file).startswith(installed):
            yield other
            yield from _imported_modules(other, seen)


def _check_declaration(law: Law, origin: Origin) -> None:
    """Raise LawError for a wrong declaration, or a name that another law has."""
    for name in ("name", "title", "source", "validity"):
        _need(isinstance(getattr(law, name), str), f"its {name} is no text")
    check_name(law.name, "law")
    for what in (law.name, *law.also):
        used = {name for other in bundled_laws().values() for name in (other.name, *other.also)}
        _need(what not in used, f"{what} is a law of gudgeon's", "give yours another name")
        others = [other for other in USER_LAWS.values() if other.name != law.name]
        _need(all(what not in (o.name, *o.also) for o in others), f"{what} is another registered law's name")
    known = ORIGINS.get(law.name)
    if known is not None and known.file != origin.file:
        whose = f"that of {known.typed}" if known.typed else "one made in Python"
        raise LawError(f"another law of this name is registered, {whose}", hint="give one of them another name")
    _need(law.role in RESULTS, f"unknown role {law.role!r}", known_hint(str(law.role), RESULTS))
    _need(callable(law.build), "its build is no function", "expected build(inputs), which returns its forces by name")
    _check_keys(law)


def _check_keys(law: Law) -> None:
    """Raise LawError for wrong fields, states or options of a law."""
    _need(all(isinstance(own, Field) for own in law.fields), "a field is none", "expected number(…), word(…), flag(…)")
    kinds = {own.name: own.kind for own in law.fields}
    names = [*(own.name for own in law.fields), *(state.name for state in law.states if isinstance(state, State))]
    for name in names:
        check_name(name, "number or option")
        _need(name != "law" and names.count(name) == 1, f"{name!r} names two keys")
    for own in law.fields:
        usable = own.kind in (NUMBER, WORD, FLAG) and not own.varies
        _need(usable, f"{own.name} is no key of a law", "expected number(…) without `varies`, word(…) or flag(…)")
        _check_field(own, kinds)
    _need(all(isinstance(state, State) for state in law.states), "a state is none", "expected State(name, meaning)")
    _need(not law.rigid, "it is rigid", "velocities jump by gudgeon's newton_restitution alone")
    _need(law.role == "friction" or not law.states, "it has inner states", "only laws of friction have them so far")
    known = {own.name for own in law.options}
    _need({key for choices in law.also.values() for key in choices} <= known, "`also` chooses what is no option")
    _need({*law.instead} <= known and {*law.instead.values()} <= {*kinds}, "`instead` names no key of the law")


def _check_field(own: Field, kinds: Mapping[str, str]) -> None:
    """Raise LawError for a wrong declaration of a key; defaults that name other keys are checked with the file."""
    for what in ("meaning", "symbol", "otherwise"):
        _need(isinstance(getattr(own, what), str), f"the {what} of {own.name} is no text")
    if own.kind != NUMBER:
        words = own.values
        _need(
            isinstance(words, tuple) and len(words) > 0 and all(isinstance(x, (str, bool)) for x in words),
            f"the words of {own.name} are none",
            "expected word(name, meaning, (words, …), default)",
        )
        fits = own.default in words and isinstance(own.default, (str, bool))
        _need(fits, f"the default of {own.name} is {own.default!r}", known_hint(str(own.default), map(str, words)))
        return
    message = f"the dimension of {own.name} is {own.dimension!r}"
    hint = "expected one of gudgeon.language.units: FORCE, STIFFNESS, …, dimension(mass=1, time=-2); None is any"
    _need(own.dimension is None or isinstance(own.dimension, Dimension), message, hint)
    some = isinstance(own.bounds, tuple) and all(isinstance(bound, Bound) for bound in own.bounds)
    _need(some, f"the bounds of {own.name} are none", 'expected bounds=POSITIVE, or (Bound(">=", 1.0), …)')
    default = own.default
    expected = "expected a number in SI units, or none: required=True"
    _need(default is None or _is_number(default), f"the default of {own.name} is {default!r}", expected)
    for bound in own.bounds:
        limit = bound.limit
        if isinstance(limit, str):
            _need(limit in kinds, f"a bound of {own.name} names no key of the law")
        _need(
            bound.relation in RELATIONS and (isinstance(limit, str) or _is_number(limit)),
            f"a bound of {own.name} is none: {bound.relation!r} {limit!r}",
            f"expected Bound(relation, limit), with {' '.join(RELATIONS)} and a number or a key",
        )
        if _is_number(default) and not isinstance(limit, str):
            met = RELATIONS[bound.relation](default, limit)
            _need(met, f"the default of {own.name} is {default!r}, its bound {bound.relation} {limit!r}")


def _is_number(value: object) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check_name(name: Any, what: str) -> None:
    """Raise LawError unless the name is an identifier that emitted code does not reserve."""
    _need(isinstance(name, str), f"the name of a {what} is no text")
    try:
        check_label(name, what, None)
    except BadNameError as error:
        raise LawError(error.message, hint=error.hint) from None
    reserved = "__" in name
    _need(not reserved, f"{name!r} is kept for emitted code", "choose another name")


def _need(fine: bool, message: str, hint: str = "") -> None:
    """Raise LawError unless a condition holds."""
    if not fine:
        raise LawError(message, hint=hint)
