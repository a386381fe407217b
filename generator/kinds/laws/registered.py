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

from gudgeon.errors import BadNameError, InputError, LawError, Location, shorten_path
from gudgeon.files.reading import MAX_BYTES, read_user_file
from gudgeon.generator.field import FLAG, NUMBER, RELATIONS, WORD, Bound, Field
from gudgeon.generator.kinds.laws.law import RESULTS, USER_LAWS, Law, State, find_bundled_laws
from gudgeon.language.argument_checks import check_path
from gudgeon.language.names import check_label, format_name_hint
from gudgeon.language.units import Dimension

_EXAMPLE_HINT = "docs/describing.md has a complete example"


@dataclass(frozen=True)
class Origin:
    """Represent where a law comes from: its path as given, and its absolute path; "" for a law made in Python.

    `key`: SHA-256 of the file and of modules next to it that it imports, else of its derived equations; "": not
    computed.
    """

    display_path: str
    file: str
    key: str


ORIGINS: dict[str, Origin] = {}  # of the laws in USER_LAWS, by name


def register(law: str | os.PathLike[str] | Law) -> Law:
    """Register a user-defined force law for every mechanism that is read afterwards, and return it.

    law: a Python file that exports `LAW`, which is run, or a Law. A law of the same origin is replaced.
    Raises LawError, an InputError, for a file that cannot be read, fails or has no LAW, a name that another law has,
    and a wrong declaration; the results of `build` are checked when a scene uses it.
    """
    registered_law, origin = (
        (law, Origin("", "", "")) if isinstance(law, Law) else _load_law_file(check_path(law, "law"))
    )
    try:
        _check_law_declaration(registered_law, origin)
    except LawError as error:
        raise LawError(f"{format_law_prefix(registered_law.name, origin)}{error.message}", hint=error.hint) from None
    except Exception as error:  # a field of an unexpected type
        hint = f"check the types of the declaration's fields: {_EXAMPLE_HINT}"
        name = getattr(registered_law, "name", None)
        raise LawError(
            f"{format_law_prefix(name, origin)}the declaration is invalid: {format_exception(error)}", hint=hint
        ) from error
    USER_LAWS[registered_law.name], ORIGINS[registered_law.name] = registered_law, origin
    return registered_law


def format_law_prefix(name: object, origin: Origin | None) -> str:
    """Return the beginning of an error about a law: its file and name, each if it is known."""
    file = f"{origin.display_path}: " if origin is not None and origin.display_path else ""
    return f"{file}law {name}: " if isinstance(name, str) else file


def find_law_key(name: str) -> str:
    """Return the key of a user-defined law, a SHA-256 of its content; "" if there is none of that name.

    The key of a law without a file is computed at the first call and stored.
    """
    if name not in USER_LAWS:
        return ""
    if not ORIGINS[name].key:
        from gudgeon.generator.kinds.laws.built import compute_law_key

        ORIGINS[name] = replace(ORIGINS[name], key=compute_law_key(USER_LAWS[name]))
    return ORIGINS[name].key


def find_error_location(error: BaseException, file: str) -> Location | None:
    """Return the location in a file at which an exception arose; None if it arose elsewhere.

    That is the last line of the traceback in the file, or the location of a SyntaxError.
    """
    if isinstance(error, SyntaxError) and error.filename == file:
        return Location(file, error.lineno or 1, error.offset or 1)
    lines = [line for frame, line in traceback.walk_tb(error.__traceback__) if frame.f_code.co_filename == file]
    return Location(file, lines[-1], 1) if lines else None


def _load_law_file(path_as_given: str | os.PathLike[str]) -> tuple[Law, Origin]:
    """Run a law's file as Python and return its law and origin. Raises LawError.

    The module stays in sys.modules, unless it fails. Its prints go to stderr. The key covers modules next to it that it
    imports.
    """
    display_path, hint = shorten_path(path_as_given), f"expected a Python file that exports LAW; {_EXAMPLE_HINT}"
    if not os.fspath(path_as_given):
        raise LawError("the path of a law's file is empty: ''", hint=hint)
    try:
        data = read_user_file(path_as_given, MAX_BYTES, "the law", hint)
    except InputError as error:
        raise LawError(error.message, error.where, error.hint) from error
    digest = hashlib.sha256(data)
    module = ModuleType(f"gudgeon_law_{digest.hexdigest()[:16]}")
    module.__file__ = os.path.abspath(path_as_given)
    sys.modules[module.__name__] = module  # a dataclass looks for its own module
    try:
        with redirect_stdout(sys.stderr):  # its prints are not part of a command's output
            exec(compile(data, display_path, "exec"), module.__dict__)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        sys.modules.pop(module.__name__, None)
        location = find_error_location(error, display_path) or Location(display_path, 1, 1)
        raise LawError(f"the law cannot be read: {format_exception(error)}", location) from error
    law = getattr(module, "LAW", None)
    if not isinstance(law, Law):
        fault = "no LAW" if law is None else f"a LAW of type {type(law).__name__}"
        raise LawError(
            f"{display_path} has {fault}", hint=f"expected LAW = Law(name=…, role=…, build=build); {_EXAMPLE_HINT}"
        )
    for imported in _iterate_imported_modules(module, {module}):
        digest.update(Path(str(imported.__file__)).read_bytes())
    return law, Origin(display_path, str(module.__file__), digest.hexdigest())


def format_exception(error: BaseException) -> str:
    """Return a Python error as one line: its type and, if there is one, its text; only the type if str(error) fails."""
    try:
        text = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
    except Exception:  # the text of the error itself fails
        text = ""
    return f"{type(error).__name__}{': ' if text else ''}{text}"


def _iterate_imported_modules(module: ModuleType, visited: set[ModuleType]) -> Iterator[ModuleType]:
    """Yield the user's modules that a law's file imports, directly or through others.

    Modules of Python, installed ones and gudgeon's are left out. `visited` contains the modules that are skipped, and
    gets those that were found.
    """
    installed = tuple(sysconfig.get_paths()[name] for name in ("stdlib", "platstdlib", "purelib", "platlib"))
    for value in list(vars(module).values()):
        imported = value if isinstance(value, ModuleType) else sys.modules.get(getattr(value, "__module__", None) or "")
        if imported is None or imported in visited:
            continue
        visited.add(imported)
        file = getattr(imported, "__file__", None)
        if file and not imported.__name__.startswith("gudgeon") and not os.path.abspath(file).startswith(installed):
            yield imported
            yield from _iterate_imported_modules(imported, visited)


def _check_law_declaration(law: Law, origin: Origin) -> None:
    """Raise LawError for a wrong declaration, or a name that another law has.

    A registered law of the same name and origin may be replaced.
    """
    for name in ("name", "title", "source", "validity", "properties"):
        _require_condition(isinstance(getattr(law, name), str), f"its {name} is not a text")
    check_law_name(law.name, "law")
    for law_name in (law.name, *law.also):
        bundled_names = {name for other in find_bundled_laws().values() for name in (other.name, *other.also)}
        _require_condition(
            law_name not in bundled_names, f"{law_name} is the name of a law of gudgeon", "choose another name"
        )
        other_user_laws = [other for other in USER_LAWS.values() if other.name != law.name]
        _require_condition(
            all(law_name not in (other.name, *other.also) for other in other_user_laws),
            f"{law_name} is the name of another registered law",
        )
    known_origin = ORIGINS.get(law.name)
    if known_origin is not None and known_origin.file != origin.file:
        origin_text = f"from {known_origin.display_path}" if known_origin.display_path else "from Python"
        raise LawError(f"another law of this name is registered {origin_text}", hint="give one of them another name")
    _require_condition(law.role in RESULTS, f"unknown role {law.role!r}", format_name_hint(str(law.role), RESULTS))
    _require_condition(
        callable(law.build), "its build is not a function", "expected build(inputs), which returns its forces by name"
    )
    _check_keys_of_law(law)


def _check_keys_of_law(law: Law) -> None:
    """Raise LawError for wrong fields, states or options of a law; names must be unique."""
    _require_condition(
        all(isinstance(field_of_law, Field) for field_of_law in law.fields),
        "a field is not a Field",
        "expected number(…), word(…), flag(…)",
    )
    kinds = {field_of_law.name: field_of_law.kind for field_of_law in law.fields}
    names = [
        *(field_of_law.name for field_of_law in law.fields),
        *(state.name for state in law.states if isinstance(state, State)),
    ]
    for name in names:
        check_law_name(name, "number or option")
        _require_condition(name != "law" and names.count(name) == 1, f"{name!r} names two keys")
    for field_of_law in law.fields:
        is_usable = field_of_law.kind in (NUMBER, WORD, FLAG) and not field_of_law.varies
        _require_condition(
            is_usable,
            f"{field_of_law.name} is not a key of a law",
            "expected number(…) without `varies`, word(…) or flag(…)",
        )
        _check_declared_field(field_of_law, kinds)
    _require_condition(
        all(isinstance(state, State) for state in law.states), "a state is not a State", "expected State(name, meaning)"
    )
    _require_condition(not law.rigid, "the law is rigid", "only newton_restitution of gudgeon can be rigid")
    _require_condition(
        law.role == "friction" or not law.states,
        "the law has internal states",
        "only laws of friction can have internal states",
    )
    option_names = {field_of_law.name for field_of_law in law.options}
    _require_condition(
        {key for choices in law.also.values() for key in choices} <= option_names,
        "`also` sets a key that is not an option",
    )
    _require_condition(
        {*law.instead} <= option_names and {*law.instead.values()} <= {*kinds},
        "`instead` names a key that the law does not have",
    )


def _check_declared_field(declaration: Field, kinds: Mapping[str, str]) -> None:
    """Raise LawError for a wrong declaration of a key; defaults that name other keys are checked with the file.

    `kinds` maps all keys of the law to their kinds.
    """
    for attribute in ("meaning", "symbol", "otherwise"):
        _require_condition(
            isinstance(getattr(declaration, attribute), str), f"the {attribute} of {declaration.name} is not a text"
        )
    if declaration.kind != NUMBER:
        allowed_words = declaration.values
        _require_condition(
            isinstance(allowed_words, tuple)
            and len(allowed_words) > 0
            and all(isinstance(x, (str, bool)) for x in allowed_words),
            f"the words of {declaration.name} are not a tuple of words",
            "expected word(name, meaning, (words, …), default)",
        )
        is_allowed = declaration.default in allowed_words and isinstance(declaration.default, (str, bool))
        _require_condition(
            is_allowed,
            f"the default of {declaration.name} is {declaration.default!r}",
            format_name_hint(str(declaration.default), map(str, allowed_words)),
        )
        return
    message = f"the dimension of {declaration.name} is {declaration.dimension!r}"
    hint = "expected one of gudgeon.language.units: FORCE, STIFFNESS, …, dimension(mass=1, time=-2); None allows any"
    _require_condition(declaration.dimension is None or isinstance(declaration.dimension, Dimension), message, hint)
    has_bounds = isinstance(declaration.bounds, tuple) and all(isinstance(bound, Bound) for bound in declaration.bounds)
    _require_condition(
        has_bounds,
        f"the bounds of {declaration.name} are not a tuple of Bound",
        'expected bounds=POSITIVE, or (Bound(">=", 1.0), …)',
    )
    default = declaration.default
    expected = "expected a number in SI units, or no default and required=True"
    _require_condition(
        default is None or _is_finite_number(default), f"the default of {declaration.name} is {default!r}", expected
    )
    for bound in declaration.bounds:
        limit = bound.limit
        if isinstance(limit, str):
            _require_condition(limit in kinds, f"a bound of {declaration.name} names a key that the law does not have")
        _require_condition(
            bound.relation in RELATIONS and (isinstance(limit, str) or _is_finite_number(limit)),
            f"a bound of {declaration.name} is invalid: {bound.relation!r} {limit!r}",
            f"expected Bound(relation, limit), with {' '.join(RELATIONS)} and a number or a key",
        )
        if _is_finite_number(default) and not isinstance(limit, str):
            is_satisfied = RELATIONS[bound.relation](default, limit)
            _require_condition(
                is_satisfied,
                f"the default of {declaration.name} is {default!r}, which violates its bound {bound.relation} "
                f"{limit!r}",
            )


def _is_finite_number(value: object) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check_law_name(name: Any, kind: str) -> None:
    """Raise LawError unless the name is an identifier that emitted code does not reserve (without "__").

    `name`: that of a law, of a number or of an option; `kind`: which of them, for messages.
    """
    _require_condition(isinstance(name, str), f"the name of a {kind} is not a text")
    try:
        check_label(name, kind, None)
    except BadNameError as error:
        raise LawError(error.message, hint=error.hint) from None
    is_reserved = "__" in name
    _require_condition(not is_reserved, f"{name!r} is reserved for emitted code", "choose another name")


def _require_condition(condition: bool, message: str, hint: str = "") -> None:
    """Raise LawError with a message and a hint unless a condition holds."""
    if not condition:
        raise LawError(message, hint=hint)
