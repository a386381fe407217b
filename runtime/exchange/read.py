"""Which program a file is of, and the mechanism file that is made of it."""

from __future__ import annotations

import json
import os
from pathlib import Path

from gudgeon.errors import InputError, InputErrors
from gudgeon.exchange.linkage import Linkage
from gudgeon.exchange.mechanism_yaml import mechanism_text
from gudgeon.exchange.pmks import BEGIN, address_in, of_old_pmks, of_pmks
from gudgeon.exchange.pylinkage import of_pylinkage
from gudgeon.files.reading import MAX_BYTES, read_named

KNOWN = "JSON of pylinkage (Linkage.to_json, mechanism_to_json), or a text with a link that PMKS+ shares"


def read_linkage(file: str | os.PathLike[str]) -> Linkage:
    """The linkage in a file of pylinkage or PMKS+. Raises InputError where it is neither, or holds what is not read."""
    data = read_named(file, MAX_BYTES, hint=f"name a file: {KNOWN}")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{file} is no text", hint=f"expected {KNOWN}") from error
    try:
        address = None if text.lstrip()[:1] in ("{", "[") else address_in(text)
        if address is None:
            return of_pylinkage(_json(text))
        return (of_old_pmks if address.startswith(BEGIN) else of_pmks)(address, Path(file).stem)
    except InputError as error:
        raise InputError(f"{os.fspath(file)}: {error.message}", hint=error.hint) from error


def mechanism_of(file: str | os.PathLike[str]) -> str:
    """The text of gudgeon's own file for what is in it; what was not said there is told in its first lines.

    Raises InputError where the file is refused, or where the format refuses what is made of it.
    """
    from gudgeon.generator.reader.read import read_mechanism

    linkage = read_linkage(file)
    try:
        text = mechanism_text(linkage)
        read_mechanism(text.encode(), os.fspath(file))
    except InputError as error:
        first = error.errors[0] if isinstance(error, InputErrors) else error
        raise InputError(f"{os.fspath(file)}: {first.message}", hint=first.hint) from error
    return text


def _json(text: str) -> object:
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError("it is neither JSON nor a text with a link of PMKS+", hint=f"expected {KNOWN}") from error
