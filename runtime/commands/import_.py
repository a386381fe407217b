"""`gudgeon import`: a linkage of another program becomes a mechanism's file."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.progress import status_line
from gudgeon.commands.told import note, wrote
from gudgeon.errors import InputError
from gudgeon.exchange.read import mechanism_of
from gudgeon.files.writing import write_text

MAX_TRIED = 40  # bodies up to which it is tried at once whether the linkage assembles: that takes seconds


def import_linkage(file: Path, target: Path | None) -> int:
    """Write the mechanism's file, beside where one is or where `target` says. InputError where it is there already.

    Raises InputError for a file that is not read too, or for a linkage that does not assemble.
    """
    text = mechanism_of(file)
    tried = _assembles(text, file)
    name = next(line.partition(": ")[2] for line in text.splitlines() if line.startswith("name: "))
    target = target or Path(f"{name}.yaml")
    if target.is_symlink() or target.exists():
        raise InputError(f"{target} is there already", hint="name another file with --out")
    write_text(target, text)
    for line in (line for line in text.splitlines()[1:] if line.startswith("# ")):
        note(line[2:])
    wrote("mechanism", target)
    if not tried:
        note(f"More than {MAX_TRIED} bodies: whether they assemble was not tried.")
    note(f"next: gudgeon check {target} -v, gudgeon draw {target}, gudgeon run {target}")
    return 0


def _assembles(text: str, file: Path) -> bool:
    """Whether its scenes assemble: InputError where they do not, False where it is too large to try."""
    from gudgeon.commands.assembly_story import assemble_scenes
    from gudgeon.generator.reader.read import read_mechanism

    mechanism = read_mechanism(text.encode(), str(file))
    if len(mechanism.bodies) > MAX_TRIED:
        return False
    with status_line(quiet=False):
        failed = assemble_scenes(mechanism, branches=False).failed
    for problem in failed.values():
        message, _, hint = str(problem).partition("\n")
        raise InputError(f"{file}: its linkage does not assemble: {message}", hint=hint.strip()) from problem
    return True
