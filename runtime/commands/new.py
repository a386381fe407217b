"""Run `gudgeon new`: write the first file of a mechanism or of a study, with comments."""

from __future__ import annotations

import re
from pathlib import Path

from gudgeon.commands.outcome import report_note, report_written_file
from gudgeon.errors import BadNameError, BadValueError, InputError
from gudgeon.files.writing import write_text
from gudgeon.language.names import check_name
from gudgeon.loading.shipped import PACKAGE, find_shipped_file

MECHANISM_TEMPLATE, STUDY_TEMPLATE = (PACKAGE / "templates" / name for name in ("new.yaml", "study.yaml"))
NAME = re.compile(r"^name: .*$", re.MULTILINE)


def create_mechanism_file(name: str, like: str | None) -> int:
    """Write NAME.yaml from the template, or from a shipped mechanism `like`, and return the exit code.

    Raises BadNameError, UnknownNameError for `like`, InputError if the file exists. `like` None: the template.
    """
    name = name.removesuffix(".yaml")
    _check_new_name(name, "mechanism")
    source = MECHANISM_TEMPLATE if like is None else find_shipped_file(like)
    target = _find_new_path(name)
    text = NAME.sub(f"name: {name}", source.read_text(encoding="utf-8"), count=1)
    if like is not None:
        text = f"# Copied from {like}, which comes with gudgeon. The comments below describe that mechanism.\n{text}"
    write_text(target, text)
    report_written_file("mechanism", target)
    report_note(f"next: gudgeon check {target} -v, gudgeon draw {target}, gudgeon run {target}")
    return 0


def create_study_file(name: str, like: str | None) -> int:
    """Write NAME.yaml from the study template, report it and the next commands, and return the exit code.

    Raises BadValueError unless `like` is None, BadNameError, and InputError if the file exists.
    """
    if like is not None:
        raise BadValueError("--like needs a mechanism", hint="gudgeon new NAME --study writes a study; then edit it")
    name = name.removesuffix(".yaml")
    _check_new_name(name, "study")
    target = _find_new_path(name)
    write_text(target, STUDY_TEMPLATE.read_text(encoding="utf-8"))
    report_written_file("study", target)
    report_note(f"next: gudgeon study {target} --runs, gudgeon study {target}, gudgeon study report {name}.study")
    return 0


def _find_new_path(name: str) -> Path:
    """Return the path of NAME.yaml. Raises InputError if it exists."""
    target = Path(f"{name}.yaml")
    if target.is_symlink() or target.exists():
        raise InputError(f"{target} already exists", hint="choose another name or another folder")
    return target


def _check_new_name(name: str, kind: str) -> None:
    """Raise BadNameError for a name with .yml, one that is not an identifier, and one that YAML reads as a value.

    `kind`: "mechanism" or "study", for the message.
    """
    if name.endswith(".yml"):
        raise BadNameError(f"{name!r}: expected a name without suffix", None, "the file becomes NAME.yaml")
    check_name(name, kind, None)
    if name.lower() in ("true", "false", "null"):
        message = f"{name!r} cannot be the name of a {kind}: YAML reads it as a value"
        raise BadNameError(message, None, f"for example {name}1")
