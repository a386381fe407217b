"""A kernel source of three lines of C, written by hand: what the build needs, without a generator."""

from __future__ import annotations

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.reduction_log import ReductionLog

SEEN = "#pragma GCC visibility push(default)\n"  # a library hides what does not say this


def tiny(factor: int = 2, **changes: object) -> KernelSource:
    """A source whose library has `double scale(double)`, which multiplies by `factor`."""
    fields: dict[str, object] = {
        "mechanism": "tiny",
        "scene": "ideal",
        "title": "",
        "sha256": "0" * 64,
        "files": {
            "tiny.c": f'#include "tiny.h"\n{SEEN}double scale(double x) {{ return FACTOR * x; }}\n',
            "tiny.h": f"#define FACTOR {factor}\n",
        },
        "main": "tiny.c",
        "cdef": "double scale(double x);",
        "outputs": {},
        "simulate": {},
        "operations": {},
        "gravity": False,
        "reduction_log": ReductionLog(),
    }
    for name in KernelSource.__dataclass_fields__:
        fields.setdefault(name, ())
    return KernelSource(**{**fields, **changes})  # type: ignore[arg-type]
