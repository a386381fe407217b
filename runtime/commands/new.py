"""Run `gudgeon new`: write the first file of a mechanism or of a study, with comments."""

from __future__ import annotations

import re
from pathlib import Path

from gudgeon.commands.outcome import report_note, report_written_file
from gudgeon.errors import BadNameError, BadValueError, InputError
from gudgeon.files.writing import write_text
from gudgeon.language.names import check_name
from gudgeon.loading.shipped import PACKAGE, find_shipped_file

TEMPLATE, OF_STUDY = (PACKAGE / "templates" / name for name in ("new.yaml", "study.yaml"))
NAME = re.compile(r"^name: .*$", re.MULTILINE)


def create_mechanism_file(name: str, like: str | None) -> int:
    """Write NAME.yaml from the template, or from a shipped mechanism `like`, and return the exit code.

    Raises BadNameError, UnknownNameError for `like`, InputError if the file exists. `like` None: the template.
    """
    name = name.removesuffix(".yaml")
    _check_new_name(name, "mechanism")
    source = TEMPLATE if like is None else find_shipped_file(like)
    target = _find_new_path(name)
    text = NAME.sub(f"name: {name}", source.read_text(encoding="utf-8"), count=1)
    if like is not None:
        text = f"# Begun from {like}, which comes with gudgeon. What follows is told of that one.\n{text}"
    write_text(target, text)
    report_written_file("mechanism", target)
    report_note(f"next: gudgeon check {target} -v, gudgeon draw {target}, gudgeon run {target}")
    return 0


def create_study_file(name: str, like: str | None) -> int:
    """Write NAME.yaml from the study template, and return the exit code.

    Raises BadValueError for `like`, which is for mechanisms only, BadNameError, and InputError if the file exists.
    `like` must be None.
    """
    if like is not None:
        raise BadValueError("--like is of mechanisms", hint="gudgeon new NAME --study begins a study; then edit it")
    name = name.removesuffix(".yaml")
    _check_new_name(name, "study")
    target = _find_new_path(name)
    write_text(target, OF_STUDY.read_text(encoding="utf-8"))
    report_written_file("study", target)
    report_note(f"next: gudgeon study {target} --runs, gudgeon study {target}, gudgeon study report {name}.study")
    return 0


def _find_new_path(name: str) -> Path:
    """Return the path of NAME.yaml. Raises InputError if it exists."""
    target = Path(f"{name}.yaml")
    if target.is_symlink() or target.exists():
        raise InputError(f"{target} is there already", hint="take another name, or another folder")
    return target


def _check_new_name(name: str, kind: str) -> None:
    """Raise BadNameError if a mechanism or study cannot have the name, or YAML reads it as another type."""
    if name.endswith(".yml"):
        raise BadNameError(f"{name!r}: expected a name without .yaml", None, "the file is called after it")
    check_name(name, kind, None)
    if name.lower() in ("true", "false", "null"):
        raise BadNameError(f"{name!r} cannot name this {kind}: YAML takes it for a value", None, f"such as {name}1")
