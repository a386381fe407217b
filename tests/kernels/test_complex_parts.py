"""Newton's matrix at a complex step: the kernel of both parts beside the same kernel in complex numbers."""

from __future__ import annotations

import random
from collections import defaultdict
from functools import cache
from typing import Any

import pytest
import sympy as sp

from gudgeon.generator.ir.complex_parts import convert_to_complex
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Call, Guard, Statement
from gudgeon.generator.ir.values import Conditional
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.symbols.storage import Key, StorageLocation, find_value_key
from gudgeon.loading.shipped import find_shipped_file
from tests.slow import slow_but

ETA = complex(0.31, -0.42)
SCENES = (("nine_bar_press", "lubricated"), ("slider_crank_spring", "ideal"), ("andrews_squeezer", "ideal"))


class Memory(defaultdict[Key, Any]):
    """Numbers by their place; one that nobody wrote is made up, the same for the same name."""

    def __missing__(self, name: Key) -> float:
        self[name] = random.Random(str(name)).uniform(0.5, 1.5)
        return self[name]


def value_of(value: Any, memory: Memory) -> complex:
    match value:
        case StorageLocation():
            return memory[value]
        case Conditional():
            assert value.test.relation == "!=" and value.test.bound == (0.0,)
            return value_of(value.then if value_of(value.test.value, memory) != 0 else value.otherwise, memory)
    names = {symbol: memory[find_value_key(symbol)] for symbol in value.free_symbols}
    function = sp.lambdify(list(names), value, [{"ComparedMagnitude": abs}, "math"])
    return complex(function(*names.values()))


def run(kernel: Kernel, memory: Memory, called: dict[str, Kernel]) -> None:
    for line in (line for section in kernel.sections for line in section.statements):
        match line:
            case Statement():
                found = value_of(line.value, memory)
                memory[line.target] = found if found.imag else found.real
            case Call():
                run(called[line.function], memory, called)


@cache
def kernels_of(name: str, scene: str) -> tuple[Kernel, Kernel, Kernel]:
    file = find_shipped_file(name)
    newton = make_program(derive_scene(file.read_bytes(), str(file), scene)).methods.newton  # type: ignore[union-attr]
    return newton.factor_kernel, newton.substitute_kernel, newton.solve_kernel


@pytest.mark.parametrize("of", slow_but(SCENES[1:2], SCENES), ids="-".join)
def test_both_parts_are_those_of_the_complex_numbers(of: tuple[str, str]) -> None:
    plain = kernels_of(*of)
    twins = tuple(
        convert_to_complex(kernel, ("eta", "r", "u", "x", StorageLocation("lin")["lu"]), ("s",)) for kernel in plain
    )
    one, two = Memory(eta=ETA, s=0.0), Memory(eta=ETA.real, eta_i=ETA.imag)
    read = {
        find_value_key(s)
        for section in plain[2].sections
        for x in section.statements
        for e in x.expressions
        for s in e.free_symbols
    }
    sizes = {int(key.path[0]) for key in read if isinstance(key, StorageLocation) and key.base == "r"}
    for k in range(max(sizes) + 1):
        r = complex(random.Random(k).uniform(-1, 1), random.Random(-k - 1).uniform(-1, 1))
        one[StorageLocation("r")[k]] = r
        two[StorageLocation("r")[2 * k]], two[StorageLocation("r")[2 * k + 1]] = r.real, r.imag
    for kernels, memory in ((plain, one), (twins, two)):
        by_name = {kernel.name: kernel for kernel in kernels}
        run(kernels[0], memory, by_name)
        run(kernels[2], memory, by_name)
    found = {
        k: complex(two[StorageLocation("u")[2 * k]], two[StorageLocation("u")[2 * k + 1]])
        for k in range(max(sizes) + 1)
    }
    exact = {k: complex(one[StorageLocation("u")[k]]) for k in found}
    scale = max(map(abs, exact.values()))
    assert scale > 1e-3 and max(abs(u.imag) for u in exact.values()) > 1e-3 * scale
    assert max(abs(found[k] - exact[k]) for k in found) < 1e-10 * scale
    assert any(isinstance(x, Guard) for section in twins[0].sections for x in section.statements)


def test_a_pivot_is_judged_by_the_size_of_both_parts() -> None:
    """|Re| + |Im| is compared with the share of the same of what it is measured by, in one number."""
    factor = convert_to_complex(kernels_of("nine_bar_press", "lubricated")[0], ("eta", StorageLocation("lin")["lu"]))
    lines = [line for section in factor.sections for line in section.statements]
    locals_ = {line.target for line in lines if isinstance(line, Statement) and line.declared_local}
    for guard in (line for line in lines if isinstance(line, Guard)):
        bound = [x for x in guard.test.bound if isinstance(x, sp.Basic)]  # type: ignore[union-attr]
        assert all(x.is_Symbol and x.name in locals_ for x in (guard.test.value, *bound))  # type: ignore[union-attr]


def test_what_has_no_counterpart_is_told() -> None:
    x, eta = sp.symbols("x eta")
    of = Kernel("f", (), (), (Section("", (Statement("y", sp.sin(x * eta)),)),))
    with pytest.raises(ValueError, match="no complex counterpart"):
        convert_to_complex(of, ("eta",))
