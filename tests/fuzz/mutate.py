"""A small mutation fuzzer for where atheris is not installed; the same seed tries the same inputs."""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Sequence
from types import FrameType
from typing import Any

LONGEST_INPUT = 4000


class Mutator:
    """Inputs that grow from seeds: bytes changed, tokens put in, pieces moved between two inputs."""

    def __init__(self, seeds: Sequence[bytes], tokens: Sequence[str], seed: int) -> None:
        self.corpus = list(seeds)
        self._tokens = [token.encode("utf-8", "surrogatepass") for token in tokens]
        self._random = random.Random(seed)

    def next(self) -> bytes:
        """A new input."""
        rng = self._random
        data = bytearray(rng.choice(self.corpus))
        for _ in range(rng.choice((1, 1, 2, 3, 8))):
            self._change(data)
        return bytes(data[:LONGEST_INPUT])

    def _change(self, data: bytearray) -> None:
        rng = self._random
        i = rng.randrange(len(data) + 1)
        j = min(len(data), i + rng.choice((1, 1, 2, 5, 20)))
        match rng.randrange(7):
            case 0:
                data[i:j] = b""
            case 1:
                data[i:i] = rng.choice(self._tokens)
            case 2:
                data[i:j] = rng.choice(self._tokens)
            case 3:
                data[i:i] = data[i:j] * rng.choice((1, 2, 40))
            case 4:
                other = rng.choice(self.corpus)
                k = rng.randrange(len(other) + 1)
                data[i:j] = other[k : k + rng.choice((3, 10, 60))]
            case 5:
                data[i:i] = bytes([rng.randrange(256)])
            case 6 if i < len(data):
                data[i] ^= 1 << rng.randrange(8)


def run(
    target: Callable[[bytes], None], seeds: Sequence[bytes], tokens: Sequence[str], count: int, seed: int = 0
) -> int:
    """Try `count` inputs; those that reach new lines of gudgeon are kept to grow from. Returns how many were kept.

    What an input raises is raised, the input with it.
    """
    mutator, lines = Mutator(seeds, tokens, seed), _Lines()
    for _ in range(count):
        data = mutator.next()
        try:
            new = lines.of(target, data)
        except Exception as error:
            raise AssertionError(f"{type(error).__name__}: {error} for the input {data!r}") from error
        if new:
            mutator.corpus.append(data)
    return len(mutator.corpus) - len(seeds)


class _Lines:
    """Which lines of gudgeon a call reaches first."""

    def __init__(self) -> None:
        self._seen: set[tuple[Any, int]] = set()

    def of(self, target: Callable[[bytes], None], data: bytes) -> int:
        before, old = len(self._seen), sys.gettrace()
        if before == 0 or len(data) % 8 == 0:  # tracing costs ten times the call
            sys.settrace(self._trace)
        try:
            target(data)
        finally:
            sys.settrace(old)
        return len(self._seen) - before

    def _trace(self, frame: FrameType, event: str, _: Any) -> Any:
        if "gudgeon" not in frame.f_globals.get("__name__", ""):
            return None
        self._seen.add((frame.f_code, frame.f_lineno))
        return self._trace
