"""Reads YAML bytes into a tree of texts, lists and mappings with locations; no Python objects are constructed.

ruamel.yaml scans and parses. Its events are composed here, so that limits of depth, size and aliases hold while the
file is read, and scalars stay the texts of the user: `1e-4`, `on` and `012` are expressions, not YAML values.

In brackets, YAML ends a plain text at every comma: `{value: smooth_step(t, 0, 1 s)}` becomes three texts. A text with
an open parenthesis is therefore joined with those after it, as they stand in the source, until parentheses match. (In
a mapping the pieces after it are keys without values, which the format never has.)
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator
from typing import Any, TypeAlias

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)
from ruamel.yaml.reader import ReaderError

from gudgeon.errors import InputError, LimitError, Location, NotYamlError, UnknownKeyError, combine_errors
from gudgeon.files.reading import MAX_BYTES
from gudgeon.language.names import YAML_NULL

MAX_PIECES = 512  # texts that are joined: more than an expression of 1000 characters can contain
MAX_OPEN_PARENTHESES = 60  # open parentheses in a list: bounds the time for long lists


class Events:
    """Iterate over ruamel's events with a lookahead; `join_pieces` joins texts that commas have split."""

    def __init__(self, events: Iterator[Any], text: str) -> None:
        self._events, self._text = events, text
        self._ahead: deque[Any] = deque()

    def __iter__(self) -> Iterator[Any]:
        """Return the iterator itself."""
        return self

    def __next__(self) -> Any:
        """Return the next event."""
        return self._ahead.popleft() if self._ahead else next(self._events)

    def join_pieces(self, event: Any, in_mapping: bool) -> Any:
        """Return `event`, a value in brackets, joined with the texts after it that belong into its parentheses.

        Example: `{value: ramp(t, 0, 1 s)}`, which YAML splits at the commas. `in_mapping`: the value is in a mapping
        in braces, where each further piece is a key without value. The joined events are consumed and `event` is
        changed. It is returned unchanged if its parentheses match. A list item is also unchanged if its parentheses
        stay open after all pieces: it may be a broken component of a vector.
        """
        if not _is_plain_scalar(event) or _count_open_parentheses(event.value) <= 0:
            return event
        n_open, n_pieces, last_piece = _count_open_parentheses(event.value), 0, event
        for _ in range(MAX_PIECES):
            piece = self._peek_event(n_pieces)
            if not _is_plain_scalar(piece) or in_mapping and not _is_missing_value(self._peek_event(n_pieces + 1)):
                break
            n_open, last_piece, n_pieces = (
                n_open + _count_open_parentheses(piece.value),
                piece,
                n_pieces + 1 + in_mapping,
            )
            if n_open <= 0 or n_open > MAX_OPEN_PARENTHESES and not in_mapping:
                break
        if n_open > 0 and not in_mapping:  # these may be the components of a vector, one of them broken
            return event
        for _ in range(n_pieces):
            self._ahead.popleft()
        event.value = self._text[event.start_mark.index : last_piece.end_mark.index]
        event.end_mark = last_piece.end_mark
        return event

    def _peek_event(self, index: int) -> Any:
        """Return the event after `index` further ones without consuming it; 0 is the next event. None at the end."""
        while len(self._ahead) <= index:
            try:
                self._ahead.append(next(self._events))
            except StopIteration:
                return None
        return self._ahead[index]


def _is_plain_scalar(event: Any) -> bool:
    """Return whether an event is a plain scalar without quotes, anchor and tag."""
    return isinstance(event, ScalarEvent) and event.style is None and event.anchor is None and event.tag is None


def _is_missing_value(event: Any) -> bool:
    """Return whether an event is the missing value of a key, an empty plain scalar."""
    return _is_plain_scalar(event) and event.start_mark.index == event.end_mark.index


def _count_open_parentheses(text: str) -> int:
    """Return the number of parentheses that `text` opens minus the number that it closes."""
    return text.count("(") - text.count(")")


NO_MERGE = "merge keys ('<<') are not part of the format"
MERGE_HINT = "write the keys out; a contact or a scene inherits the keys of another one by extends: NAME"
MAX_DEPTH = 24
MAX_NODES = 100_000  # aliases count as the nodes that they stand for
MAX_TAG = 10_000  # characters: the time that ruamel takes for one grows with their square
MAX_DUPLICATES = 50  # reported keys that are given twice
_TAG = re.compile(rf"!\S{{{MAX_TAG}}}")
# errors that ruamel raises on hostile text in addition to its own: "%YAML 1.13" fails an assertion
_RUAMEL_ERRORS = (ValueError, RecursionError, LookupError, AttributeError, TypeError, AssertionError, ArithmeticError)


class Text(str):
    """Represent a scalar: its text and the location of its first character, after the quote of a quoted one."""

    where: Location
    plain: bool  # neither quoted nor a block: an empty plain scalar is nothing at all
    one_line: bool

    @staticmethod
    def make_text(text: str, location: Location, plain: bool = True, one_line: bool = True) -> Text:
        """Return a text with its location and style.

        `plain`: it stands without quotes; `one_line`: it begins and ends in the same line of the file.
        """
        node = Text(text)
        node.where, node.plain, node.one_line = location, plain, one_line
        return node

    @property
    def is_null(self) -> bool:
        """Return whether YAML reads the text as null: a plain scalar that is empty, ~ or null."""
        return self.plain and self in YAML_NULL


class Map(dict[str, Any]):
    """Represent a mapping whose keys are Text, so that keys have locations, too."""

    where: Location

    @staticmethod
    def make_map(items: Any, location: Location) -> Map:
        """Return a mapping of `items` (a mapping, or pairs of key and value), with its location in the file."""
        node = Map(items)
        node.where = location
        return node

    def find_key(self, name: str) -> Text:
        """Return the key itself as it stands in the file, with its location.

        Raises StopIteration if there is no such key.
        """
        return next(key for key in self.list_keys() if key == name)

    def list_entries(self) -> list[tuple[Text, Any]]:
        """Return keys and values as a list, in the order of the file."""
        return [(key, self[key]) for key in self.list_keys()]

    def get_mapping(self, name: str) -> Map:
        """Return the mapping at a key; an empty one if there is no such key."""
        return self[name] if name in self else Map.make_map((), self.where)

    def list_keys(self) -> list[Text]:
        """Return the keys as Text, in the order of the file; keys that are plain strings are left out."""
        return [key for key in self if isinstance(key, Text)]


class Items(list[Any]):
    """Represent a sequence."""

    where: Location

    @staticmethod
    def make_items(items: Any, location: Location) -> Items:
        """Return a sequence of `items` with its location in the file."""
        node = Items(items)
        node.where = location
        return node


Node: TypeAlias = Text | Map | Items


def parse_yaml(
    data: bytes, file: str, duplicate_errors: list[InputError] | None = None, expected_format: str = "gudgeon/1"
) -> Map:
    """Return the mapping that a file contains, as a tree of Map, Items and Text with locations.

    `expected_format` is for messages. Raises LimitError for too many bytes, levels or nodes, NotYamlError for other
    contents, and UnknownKeyError for keys that are given twice. With `duplicate_errors` these errors are appended to
    that list instead of raised.
    """
    if len(data) > MAX_BYTES:
        raise LimitError(f"a file of {len(data)} bytes", Location(file, 1, 1), f"expected at most {MAX_BYTES}")
    text = _decode_file(data, file)
    if long_tag := _TAG.search(text):
        hint, location = "expected plain text, lists and mappings", _find_location_after(text[: long_tag.start()], file)
        raise LimitError(f"a tag of more than {MAX_TAG} characters", location, hint)
    composer = _Composer(text, file)
    try:
        root = composer.compose_document()
    except YAMLError as error:
        raise _translate_error(error, text, file) from None
    except _RUAMEL_ERRORS:
        hint = "check the characters after % and after backslashes in double quotes"
        raise NotYamlError("not YAML: a directive or an escape cannot be read", Location(file, 1, 1), hint) from None
    key_errors = composer.key_errors[:MAX_DUPLICATES]
    if duplicate_errors is not None:
        duplicate_errors += key_errors
    elif key_errors:
        raise combine_errors(key_errors)
    hint = f"expected a mapping that begins with format: {expected_format}"
    if root is None or isinstance(root, Text) and root.is_null:
        raise NotYamlError("the file is empty", Location(file, 1, 1), hint)
    if not isinstance(root, Map):
        raise NotYamlError(f"the file contains {describe_node(root)}", root.where, hint)
    return root


def describe_node(node: object) -> str:
    """Return a phrase for a node: "a mapping", "a list", "nothing" for null and other objects, or its quoted text."""
    if isinstance(node, Map):
        return "a mapping"
    if isinstance(node, Items):
        return "a list"
    if isinstance(node, Text) and not node.is_null:
        return repr(str(node)[:60])
    return "nothing"


def _decode_file(data: bytes, file: str) -> str:
    """Return the UTF-8 bytes of a file as text without a byte order mark.

    Raises NotYamlError at the first invalid byte.
    """
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        location = _find_location_after(data[: error.start].decode("utf-8"), file)
        raise NotYamlError(
            f"byte 0x{data[error.start]:02x} is not UTF-8", location, "expected a UTF-8 text file"
        ) from None


def _find_location_after(leading_text: str, file: str) -> Location:
    """Return the location directly after the text with which a file begins."""
    return Location(file, leading_text.count("\n") + 1, len(leading_text.rpartition("\n")[2]) + 1)


def _translate_error(error: YAMLError, text: str, file: str) -> NotYamlError:
    """Return ruamel's error as a NotYamlError with its location, in gudgeon's words for tabs.

    text: the file's text, for the location of a character that YAML does not allow. An error without a location is
    located at the begin of the file. Messages are cut at 500 characters.
    """
    if isinstance(error, ReaderError):
        location = _find_location_after(text[: error.position], file)
        return NotYamlError(f"character {text[error.position : error.position + 1]!r} is not allowed in YAML", location)
    if not isinstance(error, MarkedYAMLError):
        return NotYamlError(f"not YAML: {error}"[:500], Location(file, 1, 1))
    mark = error.problem_mark or error.context_mark
    location = Location(file, mark.line + 1, mark.column + 1) if mark else Location(file, 1, 1)
    problem = str(error.problem or error.context or "")
    if "'\\t'" in problem:
        return NotYamlError("a tab where YAML expects spaces", location, "indent with spaces")
    context = f" ({error.context})" if error.context and error.problem else ""
    if context and error.context_mark and error.context_mark.line != (mark.line if mark else -1):
        context_location = Location(file, error.context_mark.line + 1, error.context_mark.column + 1)
        context = f" ({error.context} that begins at {context_location})"
    return NotYamlError(
        f"not YAML: {problem}{context}"[:500],
        location,
        "a text that contains ': ', ' #' or begins with @ % ` needs quotes",
    )


class _Composer:
    """Compose the tree from ruamel's events while counting nodes and depth."""

    def __init__(self, text: str, file: str) -> None:
        """Begin before the first event of `text`; `file` is the name for locations."""
        self.events = Events(YAML(typ="safe", pure=True).parse(text), text)
        self.file = file
        self.anchors: dict[str, Node] = {}
        self.sizes: dict[int, int] = {}  # id of an anchored node -> nodes in it, aliases expanded
        self.nodes = 0
        self.key_errors: list[InputError] = []

    def compose_document(self) -> Node | None:
        """Return the root node of the document; None if there is none. Raises NotYamlError at a second document."""
        root, documents = None, 0
        for event in self.events:
            if isinstance(event, DocumentStartEvent):
                documents += 1
                if documents > 1:
                    raise NotYamlError(
                        "the file contains a second document",
                        self.find_location(event),
                        "expected one document per file",
                    )
            elif isinstance(event, (ScalarEvent, SequenceStartEvent, MappingStartEvent, AliasEvent)):
                root = self.compose_node(event, 0)
        return root

    def find_location(self, event: Any, shift: int = 0) -> Location:
        """Return the location at which an event begins, moved to the right by `shift` columns."""
        return Location(self.file, event.start_mark.line + 1, event.start_mark.column + 1 + shift)

    def find_location_after_key(self, key: Any) -> Location:
        """Return the location directly after the colon of a key."""
        return Location(self.file, key.end_mark.line + 1, key.end_mark.column + 2)

    def count_nodes(self, n_nodes: int, event: Any) -> None:
        """Add `n_nodes` to the number of nodes read so far. Raises LimitError at `event` if there are too many."""
        self.nodes += n_nodes
        if self.nodes > MAX_NODES:
            message = (
                "the file is too large once its aliases are expanded"
                if n_nodes > 1
                else "the file contains too many values"
            )
            raise LimitError(message, self.find_location(event), f"expected at most {MAX_NODES} values")

    def compose_node(self, event: Any, depth: int) -> Node:
        """Return the node that begins with `event`, a Text, Items or Map; with an anchor it is stored for aliases.

        `depth`: its level, 0 for the root. Raises LimitError for too many levels or nodes, NotYamlError for a tag and
        for what the format does not allow.
        """
        if isinstance(event, AliasEvent):
            return self.resolve_alias(event)
        if depth > MAX_DEPTH:
            raise LimitError("nested too deeply", self.find_location(event), f"expected at most {MAX_DEPTH} levels")
        tag = getattr(event, "tag", None)
        if tag is not None:
            raise NotYamlError(
                f"the tag {str(tag)[:60]!r}", self.find_location(event), "expected plain text, lists and mappings"
            )
        nodes_before = self.nodes
        self.count_nodes(1, event)
        if isinstance(event, ScalarEvent):
            location = self.find_location(event, int(event.style in ("'", '"')))
            one_line = event.start_mark.line == event.end_mark.line
            node: Node = Text.make_text(event.value, location, event.style is None, one_line)
        elif isinstance(event, SequenceStartEvent):
            node = self.compose_sequence(event, depth)
        else:
            node = self.compose_mapping(event, depth)
        if event.anchor is not None:  # stored after its contents: a node cannot contain itself
            self.anchors[event.anchor] = node
            self.sizes[id(node)] = self.nodes - nodes_before
        return node

    def resolve_alias(self, event: Any) -> Node:
        """Return the node for which an alias stands; its nodes are counted again.

        Raises NotYamlError without an anchor before it.
        """
        if event.anchor not in self.anchors:
            hint = "expected the anchor before the alias, and not around it"
            raise NotYamlError(f"the alias *{event.anchor[:60]} has no anchor", self.find_location(event), hint)
        node = self.anchors[event.anchor]
        self.count_nodes(self.sizes[id(node)], event)
        return node

    def compose_sequence(self, event: Any, depth: int) -> Items:
        """Return the sequence that begins with `event`, with its items composed.

        `depth`: the level of the sequence. Raises what `compose_node` raises.
        """
        items = Items.make_items((), self.find_location(event))
        while not isinstance(item_event := next(self.events), SequenceEndEvent):
            items.append(
                self.compose_node(
                    self.events.join_pieces(item_event, False) if event.flow_style else item_event, depth + 1
                )
            )
        return items

    def compose_mapping(self, event: Any, depth: int) -> Map:
        """Return the mapping that begins with `event`; errors of its keys are appended to `key_errors`.

        A repeated key is an error, and its first value counts. The merge key "<<" is an error, too. To go on, the
        entries of a mapping under it are added for keys that this mapping lacks; other values under it, such as a list
        of mappings, are dropped. `depth`: the level of the mapping. Raises NotYamlError for a key that is not a scalar.
        """
        node, merged_entries = Map.make_map((), self.find_location(event)), dict[str, Any]()
        while not isinstance(key_event := next(self.events), MappingEndEvent):
            key = self.compose_node(key_event, depth + 1)
            if not isinstance(key, Text):
                raise NotYamlError(f"{describe_node(key)} as a key", key.where, "expected a name as the key")
            value_event = next(self.events)
            value = self.compose_node(
                self.events.join_pieces(value_event, True) if event.flow_style else value_event, depth + 1
            )
            if isinstance(value, Text) and not value and value.plain and not event.flow_style:
                value.where = self.find_location_after_key(
                    key_event
                )  # an empty value has the location of the next node
            if key == "<<":
                self.key_errors.append(UnknownKeyError(NO_MERGE, key.where, MERGE_HINT))
                merged_entries = value if isinstance(value, Map) else {}  # the entries are merged as intended
            elif key in node:
                first = node.find_key(key).where
                self.key_errors.append(
                    UnknownKeyError(
                        f"{str(key)!r} is given twice", key.where, f"expected once; the first is at {first}"
                    )
                )
            else:
                node[key] = value
        node.update({name: value_event for name, value_event in merged_entries.items() if name not in node})
        return node
