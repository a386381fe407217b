"""Contains readers that all parts of a study file share, and reads its titles, its description and its wear."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from gudgeon.errors import BadNameError, BadValueError, MissingKeyError
from gudgeon.generator.format.shapes import missing_key, unknown_key
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.spec import RESERVED, WEAR_LAWS, StudyFile, WearRounds, Written
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import LABEL, check_not_null, known_hint, nearest, unknown_name
from gudgeon.language.parser import parse

MAX_COUNT, MAX_SEED = 1_000_000, 2**63 - 1
MOST_TEXT = 1000  # characters of a descriptive text
_WHOLE = re.compile(r"0|[1-9][0-9]{0,18}")


def mapping(node: Any, owner: str, where: Any) -> Map:
    """Return the node if it is a mapping. Raises BadValueError."""
    if not isinstance(node, Map):
        raise BadValueError(f"{owner} is {kind_of(node)}", place_of(node, where), "expected a mapping")
    return node


def place_of(node: Any, otherwise: Any) -> Any:
    """Return the location of a node; for an empty node, that of its key `otherwise`."""
    nothing = isinstance(node, Text) and node.is_nothing
    return otherwise.where if nothing else getattr(node, "where", otherwise.where)


def check_keys(reader: Reader, node: Map, known: Sequence[str], owner: str, needed: Sequence[str] = ()) -> bool:
    """Return whether all needed keys are present; an error is collected for each missing and each unknown key."""
    strange = [key for key in node.names() if key not in known]
    reader.errors.extend(unknown_key(key, known, owner) for key in strange)
    meant, missing = {nearest(key, known) for key in strange}, [name for name in needed if name not in node]
    reader.errors.extend(missing_key(name, node.where, owner) for name in missing if name not in meant)
    return not missing


def text(node: Any, owner: str, where: Any, what: str = "a number or a text") -> Text:
    """Return the node if it is a nonempty text on one line. Raises BadValueError."""
    if not isinstance(node, Text) or node.is_nothing or not node.one_line:
        message = "stands on several lines" if isinstance(node, Text) and not node.one_line else f"is {kind_of(node)}"
        raise BadValueError(f"{owner} {message}", place_of(node, where), f"expected {what}")
    return node


def line(node: Map, key: str, owner: str) -> str:
    """Return the descriptive text at a key on one line; "" if there is none. Raises BadValueError."""
    return words(node[key], f"{owner}.{key}", node.key(key)) if key in node else ""


def words(found: Any, owner: str, where: Any) -> str:
    """Return a node as a descriptive text on one line. Raises BadValueError."""
    if not isinstance(found, Text) or found.is_nothing:
        raise BadValueError(f"{owner} is {kind_of(found)}", place_of(found, where), "expected a text")
    joined = " ".join(found.split())
    if len(joined) > MOST_TEXT or not joined.isprintable():
        raise BadValueError(f"{owner} has {len(joined)} characters", found.where, f"at most {MOST_TEXT}, visible")
    return joined


def texts(node: Any, owner: str, where: Any, what: str) -> tuple[Text, ...]:
    """Return the texts of a nonempty list, or a text alone. Raises BadValueError."""
    if isinstance(node, Text):
        return (text(node, owner, where, what),)
    if not isinstance(node, Items) or not node:
        raise BadValueError(
            f"{owner} is {'an empty list' if node == [] else kind_of(node)}", place_of(node, where), f"expected {what}"
        )
    return tuple(text(one, f"{owner}[{k}]", node, what) for k, one in enumerate(node))


def word(node: Any, owner: str, where: Any, words: Iterable[str]) -> str:
    """Return the node if it is one of the allowed words. Raises BadValueError."""
    known, found = list(words), text(node, owner, where, "a word")
    if found not in known:
        raise BadValueError(f"{owner} is {kind_of(found)}", found.where, known_hint(found, known, 20))
    return str(found)


def whole(node: Any, owner: str, where: Any, least: int = 1, most: int = MAX_COUNT) -> int:
    """Return a whole number from `least` to `most`. Raises BadValueError."""
    what = f"a whole number from {least} to {most}"
    found = text(node, owner, where, what)
    if not _WHOLE.fullmatch(found) or not least <= int(found) <= most:
        raise BadValueError(f"{owner} is {kind_of(found)}", found.where, f"expected {what}")
    return int(found)


def seed(node: Map, owner: str) -> int:
    """Return the seed of the random numbers of a section, 0 by default."""
    return whole(node["seed"], f"{owner}.seed", node.key("seed"), 0, MAX_SEED) if "seed" in node else 0


def label(name: Text, what: str) -> str:
    """Return the name of an option, window or measure if it is allowed. Raises BadNameError."""
    if not re.fullmatch(LABEL, name):
        hint = "expected letters, digits and _ in ASCII, at most 64, no digit first"
        raise BadNameError(f"{str(name)[:60]!r} cannot name a {what}", name.where, hint)
    check_not_null(name, f"a {what}", name.where)
    return str(name)


def dimension_name(name: Text, what: str) -> str:
    """Return the name of a dimension of the dataset if it is allowed. Raises BadNameError for a reserved one."""
    if name in RESERVED:
        hint = "take another name" if what != "parameter" else f"write parameters.{name}"
        raise BadNameError(f"{str(name)!r} is what the study's dataset calls something of its own", name.where, hint)
    return label(name, what) if what != "parameter" else str(name)


def written(node: Any, owner: str, where: Any) -> Written:
    """Parse an expression, whose dimension is not yet known. Raises InputError at its column."""
    found = text(node, owner, where, "an expression: 2*pi/omega")
    return Written(parse(found, found.where), found)


MOST = 80  # characters


def read_titles(reader: Reader, root: Map, parts: Mapping[str, StudyFile | None]) -> dict[str, str]:
    """Return the titles of names in the study's parts; an error is collected for an unknown name."""
    found: dict[str, str] = {}
    with reader.collect():
        node = mapping(root["titles"], "titles", root.key("titles")) if "titles" in root else root.part("titles")
        known = list(dict.fromkeys(name for key, part in parts.items() if part for name in (key, *_titled_names(part))))
        for name, below in node.pairs():
            with reader.collect():
                if name not in known and None not in parts.values():
                    raise unknown_name("name", name, known, name.where)
                title = text(below, f"titles.{name}", name, "a line")
                if len(title) > MOST or not title.isprintable():
                    hint = f"expected one line of at most {MOST} characters that can be seen"
                    raise BadValueError(f"titles.{name} has {len(title)} characters", title.where, hint)
                found[str(name)] = str(title)
    return found


def read_about(reader: Reader, root: Map) -> tuple[str, ...]:
    """Return the paragraphs of `about:`, which is a text or a list of texts."""
    with reader.collect():
        if "about" not in root:
            return ()
        found = root["about"]
        every = list(found) if isinstance(found, Items) and found else [found]
        return tuple(words(one, "about", root.key("about")) for one in every)
    return ()


def _titled_names(part: StudyFile) -> Iterator[str]:
    """Yield the names of a part that may have a title, such as scenes, measures, ensembles and varied parameters."""
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


KEYS = ("joints", "rounds", "k", "hardness", "scale", "law")
MOST_ROUNDS = 1000


def read_wear(reader: Reader, root: Map) -> WearRounds | None:
    """Read `wear:`, the rounds of wear before the measured runs; None if there are none."""
    if "wear" not in root:
        return None
    with reader.collect():
        node = mapping(root["wear"], "wear", root.key("wear"))
        if not check_keys(reader, node, KEYS, "wear", KEYS[:3]):
            return None
        joints = texts(node["joints"], "wear.joints", node.key("joints"), "names of joints")
        rounds = whole(node["rounds"], "wear.rounds", node.key("rounds"), 1, MOST_ROUNDS)
        law = word(node["law"], "wear.law", node.key("law"), WEAR_LAWS) if "law" in node else WEAR_LAWS[0]
        k, hardness, scale = (_number_text(node, name) for name in ("k", "hardness", "scale"))
        if k is None:
            raise MissingKeyError("wear has no k", node.where, "expected k: 1e-4, and hardness: 1 GPa")
        return WearRounds(joints, rounds, k, hardness, scale, law)
    return None


def _number_text(node: Map, name: str) -> Text | None:
    """Return the text of a number of `wear`, None if it is not given."""
    return text(node[name], f"wear.{name}", node.key(name), "a number") if name in node else None
