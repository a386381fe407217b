"""Recognize the program that wrote a file, and convert its linkage into a mechanism file."""

from __future__ import annotations

import json
import os
from pathlib import Path

from gudgeon.errors import InputError, InputErrors
from gudgeon.exchange.linkage import Linkage
from gudgeon.exchange.mechanism_yaml import write_mechanism_text
from gudgeon.exchange.pmks import OLD_LINK_PREFIX, find_query, read_old_pmks, read_pmks
from gudgeon.exchange.pylinkage import read_pylinkage
from gudgeon.files.reading import MAX_BYTES, read_user_file

KNOWN_FORMATS = "JSON of pylinkage (Linkage.to_json, mechanism_to_json), or a text with a shared link of PMKS+"


def read_linkage(file: str | os.PathLike[str]) -> Linkage:
    """Return the linkage in a file of pylinkage or PMKS+; the contents decide which.

    Raises InputError for other files and unsupported contents, LimitError for large files.
    """
    data = read_user_file(file, MAX_BYTES, hint=f"name a file: {KNOWN_FORMATS}")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{file} is not a UTF-8 text", hint=f"expected {KNOWN_FORMATS}") from error
    try:
        query = None if text.lstrip()[:1] in ("{", "[") else find_query(text)
        if query is None:
            return read_pylinkage(_parse_json(text))
        return (read_old_pmks if query.startswith(OLD_LINK_PREFIX) else read_pmks)(query, Path(file).stem)
    except InputError as error:
        raise InputError(f"{os.fspath(file)}: {error.message}", hint=error.hint) from error


def convert_to_mechanism(file: str | os.PathLike[str]) -> str:
    """Return the text of a mechanism file for the linkage in a file; its first lines list the assumptions.

    Raises InputError if the file is refused, or if the mechanism format refuses the result.
    """
    from gudgeon.generator.reader.read import read_mechanism

    linkage = read_linkage(file)
    try:
        text = write_mechanism_text(linkage)
        read_mechanism(text.encode(), os.fspath(file))
    except InputError as error:
        first_error = error.errors[0] if isinstance(error, InputErrors) else error
        raise InputError(f"{os.fspath(file)}: {first_error.message}", hint=first_error.hint) from error
    return text


def _parse_json(text: str) -> object:
    """Return the parsed JSON of a text.

    Raises InputError for text that is not JSON or is nested too deeply.
    """
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(
            "it is neither JSON nor a text with a link of PMKS+", hint=f"expected {KNOWN_FORMATS}"
        ) from error
