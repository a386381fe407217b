"""What takes seconds before anything runs, deriving and compiling, tells whoever listens that it is under way."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar

Teller = Callable[[str], AbstractContextManager[None]]  # what is done -> what surrounds it

_teller: ContextVar[Teller | None] = ContextVar("teller", default=None)


def working(text: str) -> AbstractContextManager[None]:
    """Surrounds what takes a while; nothing where nobody listens."""
    teller = _teller.get()
    return teller(text) if teller else nullcontext()


@contextmanager
def told_to(teller: Teller) -> Iterator[None]:
    """While the block runs `teller` surrounds what takes a while in it, in this thread."""
    token = _teller.set(teller)
    try:
        yield
    finally:
        _teller.reset(token)
