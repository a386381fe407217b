"""Define display texts of a study: titles of its quantities, values typeset as the file writes them, descriptions."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gudgeon.files.writing import open_atomic, read_regular_file
from gudgeon.language.plot_units import format_superscript, format_unit
from gudgeon.studies.ensemble.parameter_values import GEOMETRIC

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import ParameterValues
    from gudgeon.studies.ensemble.plan import Plans

NAMES_FILE = "names.json"
_PI = re.compile(r"^([-+]?)(?:pi|π)(?=\s)")  # alone, without a number before it
_QUANTITY = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(?:[eE]([-+]?\d+))?\s*(\*\s*pi|\*?\s*π)?\s+([A-Za-zµΩ°][^\s()]*)")
MAX_SPACED_VALUES = 1000  # values of a range for which texts are formatted
ZERO_TOL = 1e-12  # values of a range below this fraction of the largest one are 0


class Names(NamedTuple):
    """Display texts of a study.

    titles: {name: title}. values: {part: {coordinate: (text, …)}}, typeset numbers with units of the file. about:
    paragraphs on the whole study.
    """

    titles: Mapping[str, str]
    values: Mapping[str, Mapping[str, tuple[str, ...]]]
    about: tuple[str, ...] = ()


EMPTY_NAMES = Names({}, {})


def _match_quantity(text: str) -> re.Match[str] | None:
    """Return the match of a number with a unit (groups: number, exponent of ten, π, unit), or None for another text.

    "3*pi rad/s" gives ("3", None, "*pi", "rad/s"); "pi rad/s" has the number 1.
    """
    return _QUANTITY.fullmatch(_PI.sub(r"\g<1>1*pi", text.strip()))


def typeset_quantity(text: str) -> str:
    """Return a number with a unit in typographic form: "3*pi rad/s" as "3π rad/s", "1e-6 m" as "10⁻⁶ m".

    "" for any other text, such as an expression.
    """
    match = _match_quantity(text)
    if match is None:
        return ""
    number, power, pi, unit = match.groups()
    number = number[:-1] if pi and number in ("1", "-1") and not power else number
    if power:
        number = (
            f"10{format_superscript(str(int(power)))}"
            if float(number) == 1.0
            else f"{number}·10{format_superscript(str(int(power)))}"
        )
    unit_text = format_unit(re.sub(r"^u(?=[a-zA-Z])", "µ", unit))
    return f"{number.replace('-', '−')}{'π' if pi else ''} {unit_text}"


def _format_spaced_values(parameter_values: ParameterValues) -> tuple[str, ...]:
    """Return the texts of the values of a range, evenly or geometrically spaced, in the common unit of its two ends.

    The ends are as in the file. Empty if the ends are not numbers with the same unit, or for more than
    MAX_SPACED_VALUES values.
    """
    ends = [_match_quantity(text) for text in parameter_values.texts]
    units_of_ends = {(bool(end[3]), end[4]) for end in ends if end}
    if None in ends or len(units_of_ends) > 1 or parameter_values.count > MAX_SPACED_VALUES:
        return ()
    ((pi, unit),) = units_of_ends
    first, last = (float(f"{end[1]}e{end[2] or 0}") for end in ends if end)
    spaced_values = (np.geomspace if parameter_values.spacing == GEOMETRIC else np.linspace)(
        first, last, parameter_values.count
    )
    spaced_values[np.abs(spaced_values) < ZERO_TOL * np.abs(spaced_values).max()] = 0.0
    inner_texts = (f"{value:.6g}{'*pi' if pi else ''} {unit}" for value in spaced_values[1:-1])
    return str(parameter_values.texts[0]), *inner_texts, str(parameter_values.texts[1])


def collect_display_names(plans: Plans) -> Names:
    """Return the titles, typeset values and paragraphs of a study file, for the report.

    A coordinate has texts only if the file writes all its values as numbers with units.
    """
    values: dict[str, dict[str, tuple[str, ...]]] = {}
    for part, plan in plans.by_part.items():
        texts_by_name: dict[str, tuple[str, ...]] = {str(name): (str(text),) for name, text in plan.study.fixed.items()}
        for axis in plan.study.axes:
            texts_by_name |= {
                str(name): _format_spaced_values(texts_of_column)
                if texts_of_column.count
                else tuple(map(str, texts_of_column.texts))
                for name, texts_of_column in axis.columns.items()
            }
        typeset_texts = {name: tuple(map(typeset_quantity, texts)) for name, texts in texts_by_name.items()}
        values[part] = {name: texts for name, texts in typeset_texts.items() if texts and all(texts)}
    return Names(plans.file.titles, values, plans.file.about)


def write_display_names(folder: Path, plans: Plans) -> None:
    """Write the display texts of a study as names.json into its folder; they do not affect the runs.

    An existing file is replaced. Raises OutputError.
    """
    with open_atomic(folder / NAMES_FILE) as file:
        file.write(json.dumps(collect_display_names(plans)._asdict(), indent=1, ensure_ascii=False).encode())


def read_display_names(folder: Path) -> Names:
    """Return the display texts from the folder of a study; all are empty if names.json is missing or damaged."""
    try:
        data = read_regular_file(folder / NAMES_FILE)
        document = {} if data is None else json.loads(data)
        titles = {str(name): str(title) for name, title in document.get("titles", {}).items()}
        values = {
            part: {name: tuple(map(str, texts)) for name, texts in texts_of_part.items()}
            for part, texts_of_part in document.get("values", {}).items()
        }
        about = tuple(map(str, document.get("about", ())))
    except (OSError, ValueError, AttributeError, TypeError, RecursionError):
        return EMPTY_NAMES
    return Names(titles, values, about)
