"""Run `gudgeon laws`: list the laws of contact, friction and film for mechanism files, or print one in full."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.commands.common import check_output_file, parse_settings, require_suffix
from gudgeon.errors import BadValueError
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.text_output import escape_invisible, format_one_line, make_plain_console, print_json
from gudgeon.language.units import find_si_unit

if TYPE_CHECKING:
    from gudgeon.generator.field import Field
    from gudgeon.generator.kinds.laws.law import Law

WIDTH = 100  # columns of the output


@dataclass(frozen=True)
class LawsRequest:
    """Arguments of the command line, as typed."""

    name: str | None
    as_json: bool
    plot: Path | None
    settings: tuple[str, ...]


def show_laws(request: LawsRequest) -> int:
    """Run `gudgeon laws`: print a table of all laws, or one law in full, or write its plot; return the exit code.

    Raises UnknownNameError, BadValueError for options that do not fit together, LawError for a user-defined law.
    """
    name = request.name
    if request.settings and request.plot is None or request.plot is not None and (name is None or request.as_json):
        raise BadValueError("--plot needs the name of a law, --set needs --plot: gudgeon laws flores --plot flores.svg")
    if name is None:
        if request.as_json:
            print_json(_build_laws_document())
        else:
            _print_law_table()
        return 0
    law = _find_law(name)
    if request.plot is not None:
        from gudgeon.commands.law_plot import SUFFIXES, plot_law

        require_suffix(request.plot, SUFFIXES)
        check_output_file("--plot", request.plot)
        plot_law(law, name, request.plot, parse_settings(request.settings))
        return 0
    if request.as_json:
        print_json(_build_law_document(law, name))
        return 0
    from gudgeon.generator.targets.latex.law import print_law

    print(escape_invisible(print_law(law, name)), end="")
    return 0


def _find_law(name: str) -> Law:
    """Return the law with this name or alternative name. Raises UnknownNameError with similar names."""
    from gudgeon.generator.kinds.laws.law import RESULTS, find_laws_of_role

    laws_by_name = {called_so: law for role in RESULTS for called_so, law in find_laws_of_role(role).items()}
    if name not in laws_by_name:
        raise make_unknown_name_error("law", name, laws_by_name, None)
    return laws_by_name[name]


def _yield_laws_by_role() -> Iterator[tuple[str, list[Law]]]:
    """Yield each role (contact, friction, film and so on) with the list of its laws.

    SymPy is not needed: the file of a law does not import it at its top.
    """
    from gudgeon.generator.kinds.laws.law import RESULTS, find_all_laws

    for role in RESULTS:
        yield role, [law for law in find_all_laws().values() if law.role == role]


def _print_law_table() -> None:
    """Print the table of all laws on stdout, grouped by role: name, title and other names of each law.

    A last line names the command that prints one law.
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    table = Table(box=SIMPLE_HEAD)
    for head in ("role", "law", "title"):
        table.add_column(head, no_wrap=head != "title")
    for role, laws in _yield_laws_by_role():
        for k, law in enumerate(laws):
            also = f"also as {', '.join(law.also)}" if law.also else ""
            title = "\n".join(filter(None, (format_one_line(law.title), also)))
            table.add_row(role if k == 0 else "", law.name, Text(title), end_section=k == len(laws) - 1)
    make_plain_console(WIDTH).print(table)
    print("gudgeon laws NAME prints equations, keys, validity and reference of one law.")


def _build_laws_document() -> dict[str, Any]:
    """Return all laws by role for `--json`."""
    return {
        role: [{"law": law.name, "also": [*law.also], "title": law.title} for law in laws]
        for role, laws in _yield_laws_by_role()
    }


def _build_law_document(law: Law, name: str) -> dict[str, Any]:
    """Return equations, keys, states, validity and reference of one law for `--json`.

    `name` is the law's name or an alternative name, by which it is called and which may fix options. Equations are
    those of the default options; "choices" has those of other options that differ.
    """
    from gudgeon.generator.targets.latex.law import derive_equation_variants, print_equation

    first, *others = (
        {"chosen": dict(variant.selected), "equations": [print_equation(equation) for equation in variant.equations]}
        for variant in derive_equation_variants(law, name)
    )
    return {
        "law": law.name,
        "called": name,
        "role": law.role,
        "title": law.title,
        "also": [*law.also],
        "chosen": dict(law.also.get(name, {})),
        "equations": first["equations"],
        "choices": [variant for variant in others if variant["equations"]],
        "keys": [_build_key_document(field) for field in law.list_fields_of_name(name)],
        "states": {state.name: state.meaning for state in law.states},
        "validity": law.validity,
        "properties": law.properties,
        "reference": law.reference or law.source,
    }


def _build_key_document(field: Field) -> dict[str, Any]:
    """Return a key of a law as a dictionary for `--json`.

    It has kind, meaning, whether it is required, and the default. A quantity also has symbol, SI unit, bounds and the
    meaning of its absence; an option has its values and their sources.
    """
    document: dict[str, Any] = {
        "key": field.name,
        "kind": field.kind,
        "meaning": field.meaning,
        "required": field.required,
        "default": field.default,
    }
    if field.values:
        return {**document, "values": [*field.values], "sources": dict(field.sources or {})}
    unit = None if field.dimension is None else find_si_unit(field.dimension)
    bounds = [[bound.relation, bound.limit] for bound in field.bounds]
    return {**document, "symbol": field.symbol, "unit": unit, "bounds": bounds, "otherwise": field.otherwise}
