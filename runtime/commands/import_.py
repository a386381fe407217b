"""Run `gudgeon import`: convert a linkage of another program into a mechanism file."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.outcome import report_note, report_written_file
from gudgeon.commands.progress import show_status_line
from gudgeon.errors import InputError
from gudgeon.exchange.read import convert_to_mechanism
from gudgeon.files.writing import write_text

MAX_ASSEMBLED_BODIES = 40  # bodies up to which the assembly is checked at once, which takes seconds


def import_linkage(file: Path, target: Path | None) -> int:
    """Run `gudgeon import`: convert a linkage and write it to `target`, or to NAME.yaml here; return the exit code.

    NAME is that of the mechanism. Notes of the conversion, and the next commands, are printed. Raises InputError if the
    target exists, the file cannot be read, or the linkage does not assemble.
    """
    text = convert_to_mechanism(file)
    is_assembly_checked = _check_assembly(text, file)
    name = next(line.partition(": ")[2] for line in text.splitlines() if line.startswith("name: "))
    target = target or Path(f"{name}.yaml")
    if target.is_symlink() or target.exists():
        raise InputError(f"{target} already exists", hint="name another file with --out")
    write_text(target, text)
    for line in (line for line in text.splitlines()[1:] if line.startswith("# ")):
        report_note(line[2:])
    report_written_file("mechanism", target)
    if not is_assembly_checked:
        report_note(f"More than {MAX_ASSEMBLED_BODIES} bodies: the assembly was not checked.")
    report_note(f"next: gudgeon check {target} -v, gudgeon draw {target}, gudgeon run {target}")
    return 0


def _check_assembly(text: str, file: Path) -> bool:
    """Return True if all scenes of the mechanism text assemble, False for more than MAX_ASSEMBLED_BODIES bodies.

    Raises InputError if a scene does not assemble; `file` is for its message.
    """
    from gudgeon.commands.assembly_report import assemble_scenes
    from gudgeon.generator.reader.read import read_mechanism

    mechanism = read_mechanism(text.encode(), str(file))
    if len(mechanism.bodies) > MAX_ASSEMBLED_BODIES:
        return False
    with show_status_line(quiet=False):
        failed = assemble_scenes(mechanism, branches=False).errors
    for problem in failed.values():
        message, _, hint = str(problem).partition("\n")
        raise InputError(f"{file}: its linkage does not assemble: {message}", hint=hint.strip()) from problem
    return True
