"""Commas in parentheses: `{value: smooth_step(t, 0, 1 s)}` holds one value for its reader, and three for YAML.

In a mapping or list in brackets YAML ends a plain text at every comma. An expression leaves no parenthesis open,
so a text that does is put together with those behind it, as they stand in the source, until its parentheses match.
(In a mapping the pieces behind it are keys without values, which the format never has.)
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

from ruamel.yaml.events import ScalarEvent

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
