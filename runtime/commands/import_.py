"""`gudgeon import`: a linkage of another program becomes a mechanism's file."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.written import note, wrote
from gudgeon.errors import InputError
from gudgeon.exchange.read import mechanism_of
from gudgeon.files.writing import write_text


def import_linkage(file: Path, target: Path | None) -> int:
    """Write the mechanism's file, beside where one is or where `target` says. InputError where it is there already."""
    text = mechanism_of(file)
    name = next(line.partition(": ")[2] for line in text.splitlines() if line.startswith("name: "))
    target = target or Path(f"{name}.yaml")
    if target.is_symlink() or target.exists():
        raise InputError(f"{target} is there already", hint="name another file with --out")
    write_text(target, text)
    for line in (line for line in text.splitlines()[1:] if line.startswith("# ")):
        note(line[2:])
    wrote("mechanism", target)
    note(f"next: gudgeon check {target} -v, gudgeon draw {target}, gudgeon run {target}")
    return 0
