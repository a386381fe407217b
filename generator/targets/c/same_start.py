"""When the starts of two runs are the same: when nothing that closing the linkage reads of their numbers differs."""

from __future__ import annotations

from collections.abc import Iterable

from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.symbols.storage import PARAMETERS, Place


def same_start(called: Iterable[Kernel]) -> str:
    """The function that tells it, of the kernels that a start calls (engine/scene/start.c).

    Where they read tables, or hand over all numbers, no two are.
    """
    lines = [line for kernel in called for section in kernel.sections for line in section.statements]
    read = [name for line in lines for name in _numbers(line)]
    names = [*dict.fromkeys(read)]
    tests = "\n        && ".join(f"same_number(p->{name}, other->{name})" for name in names)
    known = all(name.isidentifier() for name in names)
    body = f"    return {tests};\n" if known and tests else f"    (void)p, (void)other;\n    return {int(known)};\n"
    return (
        "\n/* Whether a start with these numbers is that with the others: what closing the linkage reads. */\n"
        f"int same_start(const Parameters *p, const Parameters *other)\n{{\n{body}}}\n"
    )


def _numbers(line: Line) -> list[str]:
    """What a line reads of Parameters; "" is all of it."""
    if isinstance(line, Statement) and isinstance(line.value, Place) and line.value.is_parameter:
        return [line.value.member]
    return [""] if PARAMETERS in line.reads else []
