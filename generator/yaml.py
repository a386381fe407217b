"""Commas in parentheses: `{value: smooth_step(t, 0, 1 s)}` holds one value for its reader, and three for YAML.

In a mapping or list in brackets YAML ends a plain text at every comma. An expression leaves no parenthesis open,
so a text that does is put together with those behind it, as they stand in the source, until its parentheses match.
(In a mapping the pieces behind it are keys without values, which the format never has.)

YAML bytes to a tree of text, lists and mappings that know their places; nothing is constructed.

ruamel.yaml scans and parses; its events are composed here, because only so are the bounds on depth,
size and aliases in force while the file is read, and because a scalar must stay the text that the
user wrote: `1e-4`, `on` and `012` mean what our expressions say, not what YAML says.
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

from gudgeon.errors import InputError, LimitError, Location, NotYamlError, UnknownKeyError, together
from gudgeon.files.reading import MAX_BYTES
from gudgeon.language.names import YAML_NULL

MOST_PIECES = 512  # more than the 1000 characters that an expression may have can be cut into
MOST_OPEN = 60  # in a list, of which a long one is looked through from each of its texts


class Events:
    """ruamel's events, one after the other; `whole` puts together what commas have cut."""

    def __init__(self, events: Iterator[Any], text: str) -> None:
        self._events, self._text = events, text
        self._ahead: deque[Any] = deque()

    def __iter__(self) -> Iterator[Any]:
        return self

    def __next__(self) -> Any:
        return self._ahead.popleft() if self._ahead else next(self._events)

    def whole(self, event: Any, in_mapping: bool) -> Any:
        """`event`, a value in brackets, with the pieces behind it that belong into its parentheses."""
        if not _is_plain(event) or _open(event.value) <= 0:
            return event
        still_open, taken, last = _open(event.value), 0, event
        for _ in range(MOST_PIECES):
            piece = self._peek(taken)
            if not _is_plain(piece) or in_mapping and not _is_nothing(self._peek(taken + 1)):
                break
            still_open, last, taken = still_open + _open(piece.value), piece, taken + 1 + in_mapping
            if still_open <= 0 or still_open > MOST_OPEN and not in_mapping:
                break
        if still_open > 0 and not in_mapping:  # these may be the components of a vector, one of them broken
            return event
        for _ in range(taken):
            self._ahead.popleft()
        event.value = self._text[event.start_mark.index : last.end_mark.index]
        event.end_mark = last.end_mark
        return event

    def _peek(self, index: int) -> Any:
        """The event behind `index` others; None at the end."""
        while len(self._ahead) <= index:
            try:
                self._ahead.append(next(self._events))
            except StopIteration:
                return None
        return self._ahead[index]


def _is_plain(event: Any) -> bool:
    return isinstance(event, ScalarEvent) and event.style is None and event.anchor is None and event.tag is None


def _is_nothing(event: Any) -> bool:
    """Whether a key stands without a value: it was none."""
    return _is_plain(event) and event.start_mark.index == event.end_mark.index


def _open(text: str) -> int:
    """Parentheses that `text` opens and does not close."""
    return text.count("(") - text.count(")")


NO_MERGE = "merge keys ('<<') are no part of the format"
MERGED = "write the keys out; a contact, or a scene, takes those of another one by extends: NAME"
MAX_DEPTH = 24
MAX_NODES = 100_000  # aliases counted as what they stand for
MAX_TAG = 10_000  # characters: the time that ruamel takes for one grows with their square
MOST_TWICE = 50  # keys given twice that are told
_TAG = re.compile(rf"!\S{{{MAX_TAG}}}")
# what ruamel raises on hostile text besides its own errors: "%YAML 1.13" fails an assertion
_OF_RUAMEL = (ValueError, RecursionError, LookupError, AttributeError, TypeError, AssertionError, ArithmeticError)


class Text(str):
    """A scalar: its text and the place of its first character (behind the quote of a quoted one)."""

    where: Location
    plain: bool  # neither quoted nor a block: an empty plain scalar is nothing at all
    one_line: bool

    @staticmethod
    def make(text: str, where: Location, plain: bool = True, one_line: bool = True) -> Text:
        made = Text(text)
        made.where, made.plain, made.one_line = where, plain, one_line
        return made

    @property
    def is_nothing(self) -> bool:
        """Whether YAML reads it as null."""
        return self.plain and self in YAML_NULL


class Map(dict[str, Any]):
    """A mapping; its keys are Text (see `names`), so that a key has a place, too."""

    where: Location

    @staticmethod
    def make(items: Any, where: Location) -> Map:
        made = Map(items)
        made.where = where
        return made

    def key(self, name: str) -> Text:
        """The key itself, with its place."""
        return next(key for key in self.names() if key == name)

    def pairs(self) -> list[tuple[Text, Any]]:
        """Keys and values."""
        return [(key, self[key]) for key in self.names()]

    def part(self, name: str) -> Map:
        """The mapping at a key; an empty one where there is no such key."""
        return self[name] if name in self else Map.make((), self.where)

    def names(self) -> list[Text]:
        """The keys as what they are."""
        return [key for key in self if isinstance(key, Text)]


class Items(list[Any]):
    """A sequence."""

    where: Location

    @staticmethod
    def make(items: Any, where: Location) -> Items:
        made = Items(items)
        made.where = where
        return made


Node: TypeAlias = Text | Map | Items


def parse_yaml(data: bytes, file: str, twice: list[InputError] | None = None, begins: str = "gudgeon/1") -> Map:
    """The mapping that a file holds.

    Raises NotYamlError, LimitError, or UnknownKeyError for a key that is given twice; these go to `twice`, if given.
    """
    if len(data) > MAX_BYTES:
        raise LimitError(f"a file of {len(data)} bytes", Location(file, 1, 1), f"expected at most {MAX_BYTES}")
    text = _decode(data, file)
    if long := _TAG.search(text):
        hint, where = "expected plain text, lists and mappings", _behind(text[: long.start()], file)
        raise LimitError(f"a tag of more than {MAX_TAG} characters", where, hint)
    composer = _Composer(text, file)
    try:
        root = composer.document()
    except YAMLError as error:
        raise _translate(error, text, file) from None
    except _OF_RUAMEL:
        hint = "look at what stands behind % and behind backslashes in double quotes"
        raise NotYamlError("not YAML: a directive or an escape cannot be read", Location(file, 1, 1), hint) from None
    told = composer.duplicates[:MOST_TWICE]
    if twice is not None:
        twice += told
    elif told:
        raise together(told)
    hint = f"expected a mapping that begins with format: {begins}"
    if root is None or isinstance(root, Text) and root.is_nothing:
        raise NotYamlError("the file is empty", Location(file, 1, 1), hint)
    if not isinstance(root, Map):
        raise NotYamlError(f"the file holds {kind_of(root)}", root.where, hint)
    return root


def kind_of(node: object) -> str:
    """A node in words."""
    if isinstance(node, Map):
        return "a mapping"
    if isinstance(node, Items):
        return "a list"
    if isinstance(node, Text) and not node.is_nothing:
        return repr(str(node)[:60])
    return "nothing"


def _decode(data: bytes, file: str) -> str:
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        where = _behind(data[: error.start].decode("utf-8"), file)
        raise NotYamlError(f"byte 0x{data[error.start]:02x} is no UTF-8", where, "expected a UTF-8 text file") from None


def _behind(before: str, file: str) -> Location:
    """The place right behind a text that a file begins with."""
    return Location(file, before.count("\n") + 1, len(before.rpartition("\n")[2]) + 1)


def _translate(error: YAMLError, text: str, file: str) -> NotYamlError:
    """ruamel's error in our words, with its place."""
    if isinstance(error, ReaderError):
        where = _behind(text[: error.position], file)
        return NotYamlError(f"character {text[error.position : error.position + 1]!r} is not allowed in YAML", where)
    if not isinstance(error, MarkedYAMLError):
        return NotYamlError(f"not YAML: {error}"[:500], Location(file, 1, 1))
    mark = error.problem_mark or error.context_mark
    where = Location(file, mark.line + 1, mark.column + 1) if mark else Location(file, 1, 1)
    problem = str(error.problem or error.context or "")
    if "'\\t'" in problem:
        return NotYamlError("a tab where YAML wants spaces", where, "indent with spaces")
    context = f" ({error.context})" if error.context and error.problem else ""
    if context and error.context_mark and error.context_mark.line != (mark.line if mark else -1):
        begin = Location(file, error.context_mark.line + 1, error.context_mark.column + 1)
        context = f" ({error.context} that begins at {begin})"
    return NotYamlError(
        f"not YAML: {problem}{context}"[:500], where, "a text that holds ': ', ' #' or begins with @ % ` needs quotes"
    )


class _Composer:
    """Builds the tree from ruamel's events and counts as it goes."""

    def __init__(self, text: str, file: str) -> None:
        self.events = Events(YAML(typ="safe", pure=True).parse(text), text)
        self.file = file
        self.anchors: dict[str, Node] = {}
        self.sizes: dict[int, int] = {}  # id of an anchored node -> nodes in it, aliases expanded
        self.nodes = 0
        self.duplicates: list[InputError] = []

    def document(self) -> Node | None:
        """The root of the only document; None if there is none."""
        root, documents = None, 0
        for event in self.events:
            if isinstance(event, DocumentStartEvent):
                documents += 1
                if documents > 1:
                    raise NotYamlError("a second document begins", self.place(event), "expected one document a file")
            elif isinstance(event, (ScalarEvent, SequenceStartEvent, MappingStartEvent, AliasEvent)):
                root = self.node(event, 0)
        return root

    def place(self, event: Any, shift: int = 0) -> Location:
        return Location(self.file, event.start_mark.line + 1, event.start_mark.column + 1 + shift)

    def behind(self, key: Any) -> Location:
        """Right behind the colon of a key."""
        return Location(self.file, key.end_mark.line + 1, key.end_mark.column + 2)

    def count(self, nodes: int, event: Any) -> None:
        self.nodes += nodes
        if self.nodes > MAX_NODES:
            message = "the file is too large once its aliases are expanded" if nodes > 1 else "the file holds too much"
            raise LimitError(message, self.place(event), f"expected at most {MAX_NODES} values")

    def node(self, event: Any, depth: int) -> Node:
        """The node that `event` begins."""
        if isinstance(event, AliasEvent):
            return self.alias(event)
        if depth > MAX_DEPTH:
            raise LimitError("nested too deeply", self.place(event), f"expected at most {MAX_DEPTH} levels")
        tag = getattr(event, "tag", None)
        if tag is not None:
            raise NotYamlError(
                f"the tag {str(tag)[:60]!r}", self.place(event), "expected plain text, lists and mappings"
            )
        before = self.nodes
        self.count(1, event)
        if isinstance(event, ScalarEvent):
            where = self.place(event, int(event.style in ("'", '"')))
            one_line = event.start_mark.line == event.end_mark.line
            node: Node = Text.make(event.value, where, event.style is None, one_line)
        elif isinstance(event, SequenceStartEvent):
            node = self.sequence(event, depth)
        else:
            node = self.mapping(event, depth)
        if event.anchor is not None:  # only now: a node cannot hold itself
            self.anchors[event.anchor] = node
            self.sizes[id(node)] = self.nodes - before
        return node

    def alias(self, event: Any) -> Node:
        if event.anchor not in self.anchors:
            hint = "expected its anchor before it, and not around it"
            raise NotYamlError(f"the alias *{event.anchor[:60]} has no anchor", self.place(event), hint)
        node = self.anchors[event.anchor]
        self.count(self.sizes[id(node)], event)
        return node

    def sequence(self, event: Any, depth: int) -> Items:
        items = Items.make((), self.place(event))
        while not isinstance(inner := next(self.events), SequenceEndEvent):
            items.append(self.node(self.events.whole(inner, False) if event.flow_style else inner, depth + 1))
        return items

    def mapping(self, event: Any, depth: int) -> Map:
        made, merged = Map.make((), self.place(event)), dict[str, Any]()
        while not isinstance(inner := next(self.events), MappingEndEvent):
            key = self.node(inner, depth + 1)
            if not isinstance(key, Text):
                raise NotYamlError(f"{kind_of(key)} as a key", key.where, "expected a name as the key")
            below = next(self.events)
            value = self.node(self.events.whole(below, True) if event.flow_style else below, depth + 1)
            if isinstance(value, Text) and not value and value.plain and not event.flow_style:
                value.where = self.behind(inner)  # of nothing YAML knows the next thing's place
            if key == "<<":
                self.duplicates.append(UnknownKeyError(NO_MERGE, key.where, MERGED))
                merged = value if isinstance(value, Map) else {}  # the rest is read as it is meant
            elif key in made:
                first = made.key(key).where
                self.duplicates.append(
                    UnknownKeyError(
                        f"{str(key)!r} is given twice", key.where, f"expected once; the first is at {first}"
                    )
                )
            else:
                made[key] = value
        made.update({name: below for name, below in merged.items() if name not in made})
        return made
