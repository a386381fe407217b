"""`extends:` of contacts and scenes: parents first, cycles and unknown parents told."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from gudgeon.errors import CycleError
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.yaml.tree import Map, Text
from gudgeon.language.suggestions import unknown_name


def parents_first(
    reader: Reader, what: str, section: Map, known: Iterable[str] = ()
) -> Iterator[tuple[Text, Map]]:
    """The entries of a section, each behind the one that it extends.

    What extends an unknown name or itself is told and left out; `known` are parents outside the section.
    """
    by_name = {str(name): (name, entry) for name, entry in section.pairs()}
    ready = dict.fromkeys(name for name in known if name not in by_name)  # in order, for a message shows them
    refused: set[str] = set()
    for start in by_name:
        chain: list[str] = []
        current: str | None = start
        while current is not None and current not in ready and current not in refused:
            entry = by_name[current][1]
            if current in chain:
                cycle = [*chain[chain.index(current) :], current]
                where = entry["extends"].where if "extends" in entry else by_name[current][0].where
                message = f"{what}s that extend each other: {' → '.join(cycle)}"
                reader.errors.append(CycleError(message, where, "expected one of them to extend none"))
                refused.update(chain)
                break
            chain.append(current)
            parent = entry.get("extends")
            if parent is not None and parent not in by_name and parent not in ready:
                reader.errors.append(unknown_name(what, parent, dict.fromkeys([*ready, *by_name]), parent.where))
                refused.update(chain)
                break
            current = str(parent) if parent is not None else None
        if current in refused:
            refused.update(chain)
        for name in reversed(chain):
            if name not in refused:
                ready[name] = None
                yield by_name[name]
