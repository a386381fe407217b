"""What people read of a study: words on it, titles of its names, numbers as the file writes them; in JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gudgeon.files.writing import read_regular, written
from gudgeon.language.plot_units import pretty, raised

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.plan import Plans

FILE = "names.json"
_QUANTITY = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(?:[eE]([-+]?\d+))?\s*(\*\s*pi|\*?\s*π)?\s+([A-Za-zµΩ°][^\s()]*)")


class Names(NamedTuple):
    """titles: {name: title}. values: {part: {coordinate: (text, …)}}, of numbers that all have a unit in the file.

    about: paragraphs on the whole.
    """

    titles: Mapping[str, str]
    values: Mapping[str, Mapping[str, tuple[str, ...]]]
    about: tuple[str, ...] = ()


NONE = Names({}, {})


def as_people_write(text: str) -> str:
    """ "3*pi rad/s" as "3π rad/s"; "" of what is no number with a unit."""
    found = _QUANTITY.fullmatch(text.strip())
    if found is None:
        return ""
    number, power, pi, unit = found.groups()
    if power:
        number = f"10{raised(str(int(power)))}" if float(number) == 1.0 else f"{number}·10{raised(str(int(power)))}"
    shown = pretty(re.sub(r"^u(?=[a-zA-Z])", "µ", unit))
    return f"{number.replace('-', '−')}{'π' if pi else ''} {shown}"


def names_of(plans: Plans) -> Names:
    """Of a file whose names are resolved."""
    values: dict[str, dict[str, tuple[str, ...]]] = {}
    for part, plan in plans.each.items():
        every: dict[str, tuple[str, ...]] = {str(name): (str(text),) for name, text in plan.study.fixed.items()}
        for axis in plan.study.axes:
            every |= {str(name): tuple(map(str, own.texts)) for name, own in axis.columns.items() if not own.count}
        shown = {name: tuple(map(as_people_write, texts)) for name, texts in every.items()}
        values[part] = {name: texts for name, texts in shown.items() if texts and all(texts)}
    return Names(plans.file.titles, values, plans.file.about)


def write_names(folder: Path, plans: Plans) -> None:
    """Beside the runs: names decide none of them. Raises OutputError."""
    with written(folder / FILE) as file:
        file.write(json.dumps(names_of(plans)._asdict(), indent=1, ensure_ascii=False).encode())


def read_names(folder: Path) -> Names:
    """What write_names left, NONE where there is nothing."""
    try:
        data = read_regular(folder / FILE)
        found = {} if data is None else json.loads(data)
        titles = {str(name): str(title) for name, title in found.get("titles", {}).items()}
        values = {part: {name: tuple(map(str, texts)) for name, texts in own.items()}
                  for part, own in found.get("values", {}).items()}  # fmt: skip
        about = tuple(map(str, found.get("about", ())))
    except (OSError, ValueError, AttributeError, TypeError, RecursionError):
        return NONE
    return Names(titles, values, about)
