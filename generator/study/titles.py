"""What people read of a study beside its names: `titles:` in place of them, `about:` above all of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gudgeon.errors import BadValueError
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import mapping, text, words
from gudgeon.generator.study.spec import StudyFile
from gudgeon.generator.yaml.tree import Items, Map
from gudgeon.language.suggestions import unknown_name

MOST = 80  # characters


def read_titles(reader: Reader, root: Map, parts: Mapping[str, StudyFile | None]) -> dict[str, str]:
    """{name: title} of what the file's parts have; an error is collected for a name that none has."""
    found: dict[str, str] = {}
    with reader.collect():
        node = mapping(root["titles"], "titles", root.key("titles")) if "titles" in root else root.part("titles")
        known = list(dict.fromkeys(name for key, part in parts.items() if part for name in (key, *_names(part))))
        for name, below in node.pairs():
            with reader.collect():
                if name not in known and None not in parts.values():
                    raise unknown_name("name", name, known, name.where)
                told = text(below, f"titles.{name}", name, "a line")
                if len(told) > MOST or not told.isprintable():
                    hint = f"expected one line of at most {MOST} characters that can be seen"
                    raise BadValueError(f"titles.{name} has {len(told)} characters", told.where, hint)
                found[str(name)] = str(told)
    return found


def read_about(reader: Reader, root: Map) -> tuple[str, ...]:
    """Paragraphs: a text, or a list of them."""
    with reader.collect():
        if "about" not in root:
            return ()
        found = root["about"]
        every = list(found) if isinstance(found, Items) and found else [found]
        return tuple(words(one, "about", root.key("about")) for one in every)
    return ()


def _names(part: StudyFile) -> Iterator[str]:
    """Scenes, measures, series, ensembles, choices and what varies, with its words."""
    yield from map(str, (*part.scenes, *part.keep, *part.fixed))
    yield from (one.name for one in part.measures)
    yield from ("ensemble", "start", *part.starts.ensembles) if part.starts else ()
    yield from map(str, part.draw.numbers if part.draw else ())
    for choice in part.choices:
        yield from (choice.name, *choice.options)
    for axis in (*part.axes, *part.left_out):
        yield axis.name
        for name, numbers in axis.columns.items():
            yield from map(str, (name, *numbers.texts))
