"""Statements that repeat are found, and parts that are equal but for their operands are printed once."""

from __future__ import annotations

import itertools
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import gudgeon
import tests.benches  # noqa: F401
from benchmarks.peers.chains import written
from gudgeon.generator.ir import repeats
from gudgeon.generator.ir.repeats import MIN_REPETITIONS, divide_into_repeats
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.targets.c import emit, equal_parts, long_sums
from gudgeon.model.compiled import Array
from tests.kernels.test_parts import shorten, simulation
from tests.programs import needs_compiler
from tests.slow import slow_but
from tests.targets_c.test_c_compiles import FLAGS, compile_c, write


def split_sequence(shapes: list[int], max_length: int, min_length: int) -> list[tuple[tuple[int, ...], bool]]:
    """Return the groups of a sequence with their shapes."""
    groups = divide_into_repeats(shapes, max_length, min_length)
    ends = list(itertools.accumulate(length for length, _ in groups))
    assert ends[-1] == len(shapes)
    return [
        (tuple(shapes[end - length : end]), is_repeated)
        for end, (length, is_repeated) in zip(ends, groups, strict=True)
    ]


def test_a_period_is_found_between_other_statements() -> None:
    period = list(range(20))
    shapes = [97, 98, *period * 12, 99]
    groups = split_sequence(shapes, 30, 5)
    repeated = Counter(group for group, is_repeated in groups if is_repeated)
    assert sum(len(group) * n for group, n in repeated.items()) >= len(shapes) - 2 * len(period)
    assert len(repeated) <= 3 and groups[0] == ((97, 98), False)


def test_nothing_repeats_in_different_statements() -> None:
    assert divide_into_repeats(range(50), 30, 5) == [(50, False)]


@pytest.mark.parametrize("seed", range(5))
def test_groups_have_their_lengths_and_occur_often_enough(seed: int) -> None:
    shapes = np.random.default_rng(seed).integers(0, 4, size=600).tolist()
    groups = split_sequence(shapes, 12, 4)
    repeated = Counter(group for group, is_repeated in groups if is_repeated)
    assert repeated and all(4 <= len(group) <= 12 and n >= MIN_REPETITIONS for group, n in repeated.items())
    assert not any(not a[1] and not b[1] for a, b in itertools.pairwise(groups))


@needs_compiler
@pytest.mark.parametrize("formulation", slow_but(["reduced"], ["reduced", "full"]))
def test_equal_parts_are_printed_once_and_give_the_same_bits(formulation: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shorten(monkeypatch)
    monkeypatch.setattr(long_sums, "_MAX_TERMS", 12)
    joined = simulation("n_four_bar", "ideal", formulation, 6)
    for module in (repeats, equal_parts):
        monkeypatch.setattr(module, "MIN_REPETITIONS", 10**6)
    monkeypatch.setattr(long_sums, "_MAX_TERMS", 10**6)
    apart = simulation("n_four_bar", "ideal", formulation, 6)
    texts = ["".join(s.source.files.values()) for s in (joined, apart)]
    assert ["_rows[] = {" in text and "partial_sum_1" in text for text in texts] == [True, False]
    for method in ("dop853", "rodas5p"):
        one, two = (s.simulate(5e-3, output=5, method=method) for s in (joined, apart))
        assert np.array_equal(one.q, two.q) and np.array_equal(one.v, two.v)
        assert all(np.array_equal(one[name], two[name]) for name in ("A1.Fx", "energy.kinetic"))


@needs_compiler
def test_start_parameters_are_compared_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    # a batch with two starts: runs of equal start parameters share one start
    starts = [1.4, 1.4, 1.5]
    results = list[Array]()
    for limit in (emit.MAX_INLINE_COMPARISONS, 1):
        monkeypatch.setattr(emit, "MAX_INLINE_COMPARISONS", limit)
        four_bars = simulation("n_four_bar", "ideal", "reduced", 2)
        assert ("indices[]" in "".join(four_bars.source.files.values())) == (limit == 1)
        results.append(four_bars.simulate_many({"start.set.crank0.theta": starts}, 5e-3, output=2).q)
    assert np.array_equal(results[0], results[1]) and not np.array_equal(results[0][0], results[0][2])


@needs_compiler
def test_equal_parts_of_a_taylor_series_compile(tmp_path: Path) -> None:
    source = generate_kernel_source(written(24, (0.0,) * 24).encode(), "chain.yaml", "ideal", None, "taylor")
    assert "const int *table_row, " in source.files["taylor.c"]
    main = write(source, tmp_path)
    compile_c("cc", main, [*FLAGS, "-fsyntax-only"])


@needs_compiler
@pytest.mark.slow
def test_a_chain_of_256_links_keeps_its_energy(tmp_path: Path) -> None:
    n = 256
    file = tmp_path / "chain.yaml"
    file.write_text(written(n, tuple(0.5 * k for k in range(n))), encoding="utf-8")
    chain = gudgeon.load(file)
    source = chain.compiled.source.files
    # two bars more need no more code, only rows of tables: 512 equations of 3 to 4 kB each would be unrolled
    assert "_rows[] = {" in source["dynamics.c"] and len(source["dynamics.c"]) < 1_000_000
    run = chain.simulate(0.1, output=10)
    energy = run["energy.kinetic"] + run["energy.potential"]
    assert run["energy.kinetic"][-1] > 1.0 and np.ptp(energy) < 1e-7 * run["energy.kinetic"][-1]
