"""Whether all that a study's dataset holds is called so once, and a number of the runs is given or varied once."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import BadNameError, Location
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.settings import short
from gudgeon.generator.study.spec import RESERVED, StudyFile
from gudgeon.generator.yaml.tree import Map, Text

_SET = "value of "  # where what the command line sets was read


def check_names(reader: Reader, study: StudyFile, root: Map) -> None:
    """All mistakes at once."""
    numbers = [*study.fixed, *(key for axis in study.axes for key in axis.columns)]
    numbers += list(study.draw.numbers) if study.draw else []
    seen: dict[str, Text] = {}
    for key in numbers:
        called = short(str(key))
        if called in seen:
            with reader.collect():
                told = f"{str(key)[:60]!r} is said twice"
                raise BadNameError(told, key.where, f"expected once; the first is at {seen[called].where}")
        seen.setdefault(called, key)
    twice = set(_check_choices(reader, study, seen))
    groups = [Text.make(axis.name, axis.where) for axis in study.axes if axis.grouped]
    used = {str(key): ("a number of the runs", key) for key in numbers}
    for what, key in _names(study, root, groups):
        own = key in RESERVED and not (key == "run" and key in groups)
        if (key in used or own) and key not in twice:
            with reader.collect():
                by, first = (used[key][0], f"the first is at {_place(used[key][1].where)}") if key in used else ("", "")
                told = f"the name {str(key)[:60]!r} is taken, by {by or 'the dataset itself'}"
                raise BadNameError(told, key.where, f"take another one{first and ': '}{first}")
        used.setdefault(str(key), (what, key))


def _names(study: StudyFile, root: Map, groups: list[Text]) -> Iterator[tuple[str, Text]]:
    """What the dataset calls by names of the file's beside numbers, and what it is."""
    yield from (("numbers that go together", key) for key in groups)
    yield from (("a choice", Text.make(choice.name, choice.where)) for choice in study.choices)
    if isinstance(root.get("measures"), Map):
        yield from (("a measure", key) for key in root.part("measures").names())
    yield from (("a series that is kept", key) for key in study.keep)


def _check_choices(reader: Reader, study: StudyFile, given: dict[str, Text]) -> Iterator[str]:
    """Names of choices that change what runs are given as a number too: one of the two would do nothing."""
    for choice in study.choices:
        varied = (short(address) for own in choice.options.values() for address in own)
        both = next((key for key in varied if key in given), None)
        if both is None:
            continue
        yield choice.name
        first = given[both].where
        with reader.collect():
            gives = _place(first) if first.file.startswith(_SET) else f"a number, at {first},"
            what = f"choices: {both}" if choice.name == both else f"choices: {choice.name}, by {both},"
            told = f"{what[:120]} varies what {gives[:120]} gives to all runs"
            raise BadNameError(told, choice.where, "leave one of the two out: what is set for all runs does not vary")


def _place(where: Location) -> str:
    """Where a name stands first: in a file, or on the command line."""
    return where.file.removeprefix(_SET) if where.file.startswith(_SET) else str(where)
