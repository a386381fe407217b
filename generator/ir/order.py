"""Statements put near what reads them, so that a long kernel keeps little in mind at any time.

As derived, a kernel first computes all directions and arms, then all pivots, then all substitutions: in a long one
each value is out of the registers and of the nearest cache before it is read. Here what is asked for (tests of pivots,
results) pulls what it needs just before itself, and what can be computed from the values at hand is computed then.
Each statement stays as it is and comes behind what it reads: the numbers are the same, bit for bit.
"""

from __future__ import annotations

from collections.abc import Sequence


def nearby(reads: Sequence[frozenset[str]], defines: Sequence[str]) -> list[int]:
    """The order of statements: the k-th reads the names `reads[k]` and defines `defines[k]` ("": a result, a test)."""
    home = {name: k for k, name in enumerate(defines) if name}
    needs = [{home[name] for name in names if name in home} - {k} for k, names in enumerate(reads)]
    readers: list[list[int]] = [[] for _ in reads]
    for k, own in enumerate(needs):
        for j in own:
            readers[j].append(k)
    order: list[int] = []
    missing = [len(own) for own in needs]
    placed = [False] * len(reads)

    def place(first: int) -> None:
        ready = [first]
        while ready:
            k = ready.pop()
            if placed[k]:
                continue
            placed[k] = True
            order.append(k)
            for reader in readers[k]:
                missing[reader] -= 1
            ready += [reader for reader in reversed(readers[k]) if not missing[reader] and not placed[reader]]

    wanted = [k for k, following in enumerate(readers) if not following]
    for root in wanted:
        waiting = [root]
        while waiting:
            k = waiting[-1]
            pulled = [j for j in sorted(needs[k], reverse=True) if not placed[j]]
            if pulled and not placed[k]:
                waiting += pulled
                continue
            waiting.pop()
            if not placed[k]:
                place(k)
    return order
