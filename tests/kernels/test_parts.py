"""Long kernels cut into parts: the same numbers, bit for bit, whatever the parts' size."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.ir import sine_groups
from gudgeon.generator.ir import split as parts
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import Number, make_input_argument, make_output_argument
from gudgeon.generator.ir.split import order_statements_near_readers
from gudgeon.generator.ir.statements import Call, Declare, Instruction, Statement
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol
from gudgeon.generator.targets.c import functions, printer
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.mechanisms.n_four_bar import text
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.slow import slow_but

WORKS = [
    ("slider_crank", "dry", "reduced"),
    ("belt_block", "ideal", "reduced"),
    ("n_four_bar", "ideal", "reduced"),
    ("n_four_bar", "ideal", "full"),
    ("nine_bar_press", "lubricated", "reduced"),
    ("andrews_squeezer", "ideal", "reduced"),
]


def simulation(name: str, scene: str, formulation: str, n: int = 0) -> Simulation:
    """Derived and compiled now."""
    file = find_shipped_file(name)
    data = text(n).encode() if n else file.read_bytes()
    source = generate_kernel_source(data, str(file), scene, None, formulation)
    return Simulation(CompiledModel(source, compile_kernels(source)), file)


def shorten(monkeypatch: pytest.MonkeyPatch) -> None:
    """Everything is long, and has many angles."""
    monkeypatch.setattr(sine_groups, "_MAX_VECTORS", 1)
    for name, value in (("_MAX_LINES", 30), ("_MAX_PART_LINES", 17), ("_MIN_PART_LINES", 5)):
        monkeypatch.setattr(parts, name, value)


@needs_compiler
@pytest.mark.parametrize("of", slow_but(WORKS[:2], WORKS), ids="-".join)
def test_runs_are_the_same_bit_for_bit(of: tuple[str, str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    whole = simulation(*of)
    shorten(monkeypatch)
    cut = simulation(*of)
    assert "_part_2(" in "".join(cut.source.files.values()) and whole.source.files != cut.source.files
    for method in ("dop853", "rodas5p"):
        one, two = (s.simulate(5e-3, output=5, method=method) for s in (whole, cut))
        assert np.array_equal(one.q, two.q) and np.array_equal(one.v, two.v)
        assert one.diagnostics.right_hand_sides == two.diagnostics.right_hand_sides


@needs_compiler
@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_a_pivot_that_vanishes_within_a_part_is_dealt_with_as_before(
    formulation: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # the cranks lie on the ground line: rows depend on each other, and what solves the system then is jumped to
    whole = simulation("n_four_bar", "ideal", formulation, 2)
    shorten(monkeypatch)
    cut = simulation("n_four_bar", "ideal", formulation, 2)
    q = np.zeros(15)
    q[0:15:3] = [*(i + 0.5 for i in range(3)), 1.5, 2.5]
    v = np.zeros(15)
    v[1:9:3], v[2:9:3], v[10::3] = -0.5, -1.0, -1.0
    y = np.concatenate([q, v])
    one, two = (s.rhs(0.0, y) for s in (whole, cut))
    assert np.isfinite(one).all() and abs(one[15:]).max() > 0.1
    assert np.array_equal(one, two)


def test_statements_stand_near_what_reads_them() -> None:
    # two pairs of values, computed first and read last: each pair moves to what reads it
    defines = ["a", "b", "c", "d", "ab", "cd", ""]
    reads = [frozenset(names.split()) for names in ("x", "y", "x", "y", "a b", "c d", "ab cd")]
    assert order_statements_near_readers(reads, defines) == [0, 1, 4, 2, 3, 5, 6]


@pytest.mark.parametrize("seed", range(5))
def test_every_statement_comes_once_and_behind_what_it_reads(seed: int) -> None:
    draw = np.random.default_rng(seed)
    needs = [set(draw.integers(0, k, size=3).tolist()) if k else set() for k in range(300)]
    order = order_statements_near_readers(
        [frozenset(f"x{j}" for j in own) for own in needs], [f"x{k}" for k in range(300)]
    )
    place = {k: n for n, k in enumerate(order)}
    assert sorted(order) == list(range(300)) and order != sorted(order)
    assert all(place[j] < place[k] for k, own in enumerate(needs) for j in own)


def test_a_short_kernel_is_its_only_part() -> None:
    kernel = Kernel(
        "f", (), (make_output_argument("x"),), (Section("", (Statement(StorageLocation("x")[0], sp.Float(1)),)),)
    )
    assert parts.split_kernel(kernel) == (kernel,)


def test_what_declares_calls_or_jumps_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    shorten(monkeypatch)
    a, b = (
        [sp.Symbol(f"a{k}", real=True) for k in range(40)],
        [StoredSymbol(StorageLocation("b")[k]) for k in range(2)],
    )
    first = Statement("a0", StorageLocation("x")[0])
    front: tuple[Instruction, ...] = (Declare(Number.INTEGER, "b", (2,)), Call("fill", (), (StorageLocation("b"),)))
    plain = [first, *(Statement(f"a{k}", a[k - 1] + b[k % 2]) for k in range(1, 40))]
    last = Statement(StorageLocation("y")[0], a[39] + a[3])
    kernel = Kernel(
        "f", (), (make_input_argument("x"), make_output_argument("y")), (Section("", (*front, *plain, last)),)
    )
    # every statement but the first reads b, which only the call knows: nothing may move
    assert parts.split_kernel(kernel) == (kernel,)
    front = (Declare(Number.REAL, "c", (2,)), Call("fill", (), (StorageLocation("c"),)))
    c = [StoredSymbol(StorageLocation("c")[k]) for k in range(2)]
    free = [first, *(Statement(f"a{k}", a[k - 1] * (k + 1) + c[k % 2]) for k in range(1, 40))]
    *pieces, main = parts.split_kernel(Kernel("f", (), kernel.arguments, (Section("", (*front, *free, last)),)))
    assert [piece.name for piece in pieces] == ["f_part_1", "f_part_2", "f_part_3"]
    kept = [line for section in main.sections for line in section.statements if not isinstance(line, Statement)]
    assert [functions.LinePrinter(printer.CPrinter()).print_instruction(line).strip() for line in kept] == [
        "double passed[3];",
        "double c[2];",
        "fill(c);",
        *(f"f_part_{k}(x, y, c, passed);" for k in (1, 2, 3)),
    ]
