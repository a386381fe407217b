"""Contains readers that all parts of a study file share, and reads its titles, its description and its wear."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from gudgeon.errors import BadNameError, BadValueError, MissingKeyError
from gudgeon.generator.format.shapes import make_missing_key_error, make_unknown_key_error
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.spec import RESERVED, WEAR_LAWS, ParsedExpression, StudyFile, WearRounds
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.names import LABEL, check_not_null, find_nearest_name, format_name_hint, make_unknown_name_error
from gudgeon.language.parser import parse

MAX_COUNT, MAX_SEED = 1_000_000, 2**63 - 1
MAX_TEXT_LENGTH = 1000  # characters of a descriptive text
_DECIMAL_DIGITS = re.compile(r"0|[1-9][0-9]{0,18}")


def check_mapping_node(node: Any, address: str, key: Any) -> Map:
    """Return the node if it is a mapping; `key` has the location for an error at an empty node.

    Raises BadValueError.
    """
    if not isinstance(node, Map):
        raise BadValueError(f"{address} is {describe_node(node)}", find_node_location(node, key), "expected a mapping")
    return node


def find_node_location(node: Any, key: Any) -> Any:
    """Return the location of a node; for an empty node, or one without a location, that of the key before it."""
    is_null = isinstance(node, Text) and node.is_null
    return key.where if is_null else getattr(node, "where", key.where)


def check_keys(
    reader: Reader, node: Map, known_keys: Sequence[str], address: str, required_keys: Sequence[str] = ()
) -> bool:
    """Return whether all required keys are present; an error is collected for each missing and each unknown key.

    A missing key is not reported if an unknown key resembles it, as a probable misspelling. `address` is the mapping's
    address.
    """
    unknown_keys = [key for key in node.list_keys() if key not in known_keys]
    reader.errors.extend(make_unknown_key_error(key, known_keys, address) for key in unknown_keys)
    similar_keys, missing_keys = (
        {find_nearest_name(key, known_keys) for key in unknown_keys},
        [name for name in required_keys if name not in node],
    )
    reader.errors.extend(
        make_missing_key_error(name, node.where, address) for name in missing_keys if name not in similar_keys
    )
    return not missing_keys


def check_text_node(node: Any, address: str, key: Any, expected_text: str = "a number or a text") -> Text:
    """Return the node if it is a nonempty text on one line.

    Raises BadValueError; `expected_text` says what was expected.
    """
    if not isinstance(node, Text) or node.is_null or not node.one_line:
        message = "is on several lines" if isinstance(node, Text) and not node.one_line else f"is {describe_node(node)}"
        raise BadValueError(f"{address} {message}", find_node_location(node, key), f"expected {expected_text}")
    return node


def read_line(node: Map, key: str, address: str) -> str:
    """Return the descriptive text at a key on one line; "" if there is none. Raises BadValueError."""
    return check_paragraph(node[key], f"{address}.{key}", node.find_key(key)) if key in node else ""


def check_paragraph(node: Any, address: str, key: Any) -> str:
    """Return a node as a descriptive text on one line, with single spaces.

    Raises BadValueError for other nodes, and for more than MAX_TEXT_LENGTH or invisible characters.
    """
    if not isinstance(node, Text) or node.is_null:
        raise BadValueError(f"{address} is {describe_node(node)}", find_node_location(node, key), "expected a text")
    joined = " ".join(node.split())
    if len(joined) > MAX_TEXT_LENGTH or not joined.isprintable():
        raise BadValueError(
            f"{address} has {len(joined)} characters",
            node.where,
            f"expected at most {MAX_TEXT_LENGTH} visible characters",
        )
    return joined


def check_texts(node: Any, address: str, key: Any, expected_text: str) -> tuple[Text, ...]:
    """Return the texts of a nonempty list, or a text alone, as a tuple. Raises BadValueError for another node.

    address: of the node, in messages; key: the key before it, which locates an empty node; expected_text: what was
    expected, for the message.
    """
    if isinstance(node, Text):
        return (check_text_node(node, address, key, expected_text),)
    if not isinstance(node, Items) or not node:
        raise BadValueError(
            f"{address} is {'an empty list' if node == [] else describe_node(node)}",
            find_node_location(node, key),
            f"expected {expected_text}",
        )
    return tuple(check_text_node(item, f"{address}[{k}]", node, expected_text) for k, item in enumerate(node))


def check_word(node: Any, address: str, key: Any, allowed_words: Iterable[str]) -> str:
    """Return the node as text if it is one of the allowed words. Raises BadValueError, with the nearest word."""
    known_words, word_node = list(allowed_words), check_text_node(node, address, key, "a word")
    if word_node not in known_words:
        raise BadValueError(
            f"{address} is {describe_node(word_node)}", word_node.where, format_name_hint(word_node, known_words, 20)
        )
    return str(word_node)


def check_integer_node(node: Any, address: str, key: Any, minimum: int = 1, maximum: int = MAX_COUNT) -> int:
    """Return a whole number from `minimum` to `maximum` that is written in decimal digits. Raises BadValueError."""
    expected_text = f"a whole number from {minimum} to {maximum}"
    digits = check_text_node(node, address, key, expected_text)
    if not _DECIMAL_DIGITS.fullmatch(digits) or not minimum <= int(digits) <= maximum:
        raise BadValueError(f"{address} is {describe_node(digits)}", digits.where, f"expected {expected_text}")
    return int(digits)


def read_seed(node: Map, address: str) -> int:
    """Return the seed of the random numbers of a section, 0 by default. Raises BadValueError."""
    return (
        check_integer_node(node["seed"], f"{address}.seed", node.find_key("seed"), 0, MAX_SEED) if "seed" in node else 0
    )


def check_label_of_entry(name: Text, kind: str) -> str:
    """Return the name of an option, window or measure if it is allowed. Raises BadNameError.

    Allowed are ASCII letters, digits and _, at most 64 characters without a digit first; null is not. `kind` is the
    noun in the message.
    """
    if not re.fullmatch(LABEL, name):
        hint = "expected letters, digits and _ in ASCII, at most 64, no digit first"
        raise BadNameError(f"{str(name)[:60]!r} cannot name a {kind}", name.where, hint)
    check_not_null(name, f"a {kind}", name.where)
    return str(name)


def check_dimension_name(name: Text, kind: str) -> str:
    """Return the name of a dimension of the dataset if it is allowed. Raises BadNameError for a reserved one.

    `kind` is the noun in the message; the name of a "parameter" may be any address.
    """
    if name in RESERVED:
        hint = "choose another name" if kind != "parameter" else f"write parameters.{name}"
        raise BadNameError(f"{str(name)!r} is a reserved name of the study's dataset", name.where, hint)
    return check_label_of_entry(name, kind) if kind != "parameter" else str(name)


def parse_study_expression(node: Any, address: str, key: Any) -> ParsedExpression:
    """Parse an expression and return it with its text; its dimension is not yet known.

    Raises InputError at its column.
    """
    expression_text = check_text_node(node, address, key, "an expression: 2*pi/omega")
    return ParsedExpression(parse(expression_text, expression_text.where), expression_text)


MAX_TITLE_LENGTH = 80  # characters


def read_titles(reader: Reader, root: Map, parts: Mapping[str, StudyFile | None]) -> dict[str, str]:
    """Return the titles of names in the study's parts; an error is collected for an unknown name or an invalid title.

    Unknown names are accepted if a part could not be read (None).
    """
    titles: dict[str, str] = {}
    with reader.collect_errors():
        node = (
            check_mapping_node(root["titles"], "titles", root.find_key("titles"))
            if "titles" in root
            else root.get_mapping("titles")
        )
        known_names = list(
            dict.fromkeys(name for key, part in parts.items() if part for name in (key, *_iterate_titled_names(part)))
        )
        for name, value in node.list_entries():
            with reader.collect_errors():
                if name not in known_names and None not in parts.values():
                    raise make_unknown_name_error("name", name, known_names, name.where)
                title = check_text_node(value, f"titles.{name}", name, "a line")
                if len(title) > MAX_TITLE_LENGTH or not title.isprintable():
                    hint = f"expected one line of at most {MAX_TITLE_LENGTH} visible characters"
                    raise BadValueError(f"titles.{name} has {len(title)} characters", title.where, hint)
                titles[str(name)] = str(title)
    return titles


def read_about(reader: Reader, root: Map) -> tuple[str, ...]:
    """Return the paragraphs of `about:`, which is a text or a list of texts; () if there are none.

    Errors are collected.
    """
    with reader.collect_errors():
        if "about" not in root:
            return ()
        node = root["about"]
        paragraphs = list(node) if isinstance(node, Items) and node else [node]
        return tuple(check_paragraph(paragraph, "about", root.find_key("about")) for paragraph in paragraphs)
    return ()


def _iterate_titled_names(part: StudyFile) -> Iterator[str]:
    """Yield the names of a part that may have a title, such as scenes, measures, ensembles and varied parameters."""
    yield from map(str, (*part.scenes, *part.keep, *part.fixed))
    yield from (measure.name for measure in part.measures)
    yield from ("ensemble", "start", *part.starts.ensembles) if part.starts else ()
    yield from map(str, part.draw.distributions if part.draw else ())
    for choice in part.choices:
        yield from (choice.name, *choice.options)
    for axis in (*part.axes, *part.left_out):
        yield axis.name
        for name, numbers in axis.columns.items():
            yield from map(str, (name, *numbers.texts))


KEYS = ("joints", "rounds", "k", "hardness", "scale", "law")
MAX_ROUNDS = 1000


def read_wear(reader: Reader, root: Map) -> WearRounds | None:
    """Return `wear:`, the rounds of wear before the measured runs; None if there are none.

    Keys: joints, rounds, k; optional hardness, scale and law (default WEAR_LAWS[0]). None also if a key is missing or
    wrong. Errors are collected.
    """
    if "wear" not in root:
        return None
    with reader.collect_errors():
        node = check_mapping_node(root["wear"], "wear", root.find_key("wear"))
        if not check_keys(reader, node, KEYS, "wear", KEYS[:3]):
            return None
        joints = check_texts(node["joints"], "wear.joints", node.find_key("joints"), "names of joints")
        rounds = check_integer_node(node["rounds"], "wear.rounds", node.find_key("rounds"), 1, MAX_ROUNDS)
        law = check_word(node["law"], "wear.law", node.find_key("law"), WEAR_LAWS) if "law" in node else WEAR_LAWS[0]
        k, hardness, scale = (_read_number_text(node, name) for name in ("k", "hardness", "scale"))
        if k is None:
            raise MissingKeyError("wear has no k", node.where, "expected k: 1e-4, and hardness: 1 GPa")
        return WearRounds(joints, rounds, k, hardness, scale, law)
    return None


def _read_number_text(node: Map, name: str) -> Text | None:
    """Return the text of a number of `wear`, None if it is not given. Raises BadValueError."""
    return check_text_node(node[name], f"wear.{name}", node.find_key(name), "a number") if name in node else None
