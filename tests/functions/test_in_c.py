"""Every function that expressions may use in C: numbers, vectors, ranges, and in a scene that is compiled and run."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.targets.c.lanes_printer import LanesPrinter
from gudgeon.generator.targets.c.printer import CPrinter
from gudgeon.generator.targets.c.ranges_printer import RangesPrinter
from gudgeon.language.functions import FUNCTIONS, Function
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import ENGINE, build_include_flags
from tests.functions.table import (
    Array,
    draw,
    every_function,
    in_sympy,
    interval,
    names,
    values,
)
from tests.programs import needs_compiler

C = """#include <float.h>
#include <math.h>
#include <stddef.h>
enum { RATE_JUMPS = 0 };
#include "engine/scene/numbers.h"
#include "engine/watch/ranges.h"
"""
LANES = '#include "engine/batch/lane_functions.h"\n'


def c_code() -> str:
    """Values, vectors and bounds of each function, by its number."""
    of_lanes = (ENGINE / "batch" / "lanes.h").read_text(encoding="utf-8")
    text = [C, of_lanes[of_lanes.index("#if defined(__AVX512F__)") : of_lanes.index('#include "lane')], LANES]
    plain = Readable(())
    for k, function in enumerate(FUNCTIONS.values()):
        for kind, printer in (("double", CPrinter), ("Lanes", LanesPrinter), ("Interval", RangesPrinter)):
            named = "".join(f"    const {kind} {name} = x[{i}];\n" for i, name in enumerate(names(function)))
            value = printer(plain).doprint(in_sympy(function))
            text.append(f"static {kind} {kind}_{k}(const {kind} *x)\n{{\n{named}    return {value};\n}}\n")
    for kind in ("double", "Lanes", "Interval"):
        cases = ", ".join(f"{kind}_{k}" for k in range(len(FUNCTIONS)))
        text.append(f"static {kind} (*const of_{kind}[])(const {kind} *) = {{{cases}}};\n")
    return (
        "".join(text)
        + """
double value(int k, const double *x) { return of_double[k](x); }
double lane(int k, const double *x, int n, int at)
{
    Lanes all[4];
    for (int i = 0; i < n; i++)
        all[i] = broadcast(x[i]) + 0.01, all[i][at % LANES] = x[i];
    return of_Lanes[k](all)[at % LANES];
}
void bounds(int k, const double *from, const double *way, int n, double *out)
{
    Interval all[4];
    for (int i = 0; i < n; i++)
        all[i] = (Interval){min_of(from[i], from[i] + way[i]), max_of(from[i], from[i] + way[i]), way[i], way[i], 0};
    const Interval y = of_Interval[k](all);
    out[0] = y.lo, out[1] = y.hi, out[2] = y.min_slope, out[3] = y.max_slope, out[4] = y.may_be_undefined;
}
"""
    )


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    folder = tmp_path_factory.mktemp("functions")
    (folder / "f.c").write_text(c_code())
    flags = ["-O1", "-std=c11", "-Wall", "-Wextra", "-Werror", "-Wno-unused-function", "-ffp-contract=off"]
    line = [*find_compiler(), *flags, "-fPIC", "-shared", *build_include_flags(), "f.c", "-lm", "-o", "f.so"]
    subprocess.run(line, cwd=folder, check=True)
    found = ctypes.CDLL(str(folder / "f.so"))
    found.value.restype = found.lane.restype = ctypes.c_double
    return found


def array(row: Array) -> Any:
    return (ctypes.c_double * len(row))(*row)


@needs_compiler
@every_function
def test_c_for_numbers_and_vectors(function: Function, library: ctypes.CDLL) -> None:
    """Vectors give the same bits in each of their lanes."""
    k, arguments = list(FUNCTIONS).index(function.name), draw(function)
    found = [library.value(k, array(row)) for row in arguments]
    np.testing.assert_allclose(found, values(function, arguments), rtol=1e-13, atol=1e-14)
    lanes = [library.lane(k, array(row), len(row), at) for at, row in enumerate(arguments)]
    np.testing.assert_array_equal(lanes, found)


@needs_compiler
@every_function
def test_ranges_hold_values_and_slopes(function: Function, library: ctypes.CDLL) -> None:
    """Along straight lines, some of which leave the domain."""
    k, begins, ends = list(FUNCTIONS).index(function.name), draw(function), draw(function)[::-1]
    share, out, wide = np.linspace(0.0, 1.0, 101), (ctypes.c_double * 5)(), []
    rng = np.random.default_rng(3)
    for begin, end in zip(begins, ends, strict=True):
        way = (end - begin) * rng.choice([1.0, 0.1, 1.3])
        if function.divides:
            way[-1] = 0.0
        found = values(function, begin + share[:, None] * way)
        library.bounds(k, array(begin), array(way), len(way), out)
        low, high, down, up, partly = out
        is_number, slack = np.isfinite(found), 1e-12
        assert partly or is_number.all()
        inner = found[is_number]
        assert low - slack <= inner.min() and inner.max() <= high + slack
        rises = np.diff(found)[is_number[1:] & is_number[:-1]] / share[1]
        if function.jump_order != 0:  # jumps are corners, which have bounds of their own
            assert down - 1e-9 <= rises.min() + slack / share[1] and rises.max() - slack / share[1] <= up + 1e-9
        if function.bounds and is_number.all():
            wide.append((high - low) / max(np.ptp(found), 1e-9))
    assert not wide or np.median(wide) < 1.1


def scene_of_all() -> bytes:
    """A pendulum whose torques call the functions, each with its arguments well within its domain."""
    calls = []
    for function in FUNCTIONS.values():
        low, high = interval(function)
        arguments = [
            f"{(low + high) / 2 + 0.05 * k:g} + {(high - low) / 7:g}*sin(bob.theta + {k})"
            for k in range(len(function.arguments))
        ]
        calls.append(function.format_call(*arguments[:-1], "0.7" if function.divides else arguments[-1]))
    forces = "\n".join(f"  f{k}: {{torque: bob, value: 0.1 N*m * {call}}}" for k, call in enumerate(calls))
    outputs = "\n".join(f"  out{k}: {call}" for k, call in enumerate(calls))
    events = "\n".join(f"  event{k}: {{zero: 100 + {call}}}" for k, call in enumerate(calls))
    return f"""
format: gudgeon/1
name: all_functions
gravity: [0, -9.81]
bodies: {{bob: {{length: 1, mass: 1 kg, inertia: 0.1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{pivot: {{revolute: [ground.O, bob.tail]}}}}
start: {{guess: {{bob.theta: 0.4}}, rates: {{bob.omega: 0.3 rad/s}}}}
forces:
{forces}
outputs:
{outputs}
events:
{events}
""".encode()


@needs_compiler
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_scene_with_every_function(formulation: str, tmp_path: Path) -> None:
    """It is compiled, runs alone and in a batch to the same bits; the torques in C are the outputs of NumPy."""
    path = tmp_path / "all_functions.yaml"
    path.write_bytes(scene_of_all())
    scene = gudgeon.load(path, formulation=formulation)
    run = scene.simulate(0.3, output=6)
    assert np.isfinite(run.q).all()
    torque = 0.1 * sum(run[f"out{k}"] for k in range(len(FUNCTIONS))) - 9.81 * 0.5 * np.cos(run["bob.theta"])
    np.testing.assert_allclose((0.1 + 0.25) * run["bob.alpha"], torque, rtol=1e-12)
    batch = scene.simulate_many([{"gravity.y": y} for y in (-9.81, -9.0, -8.0)], 0.3, output=6)
    np.testing.assert_array_equal(batch.q[0], run.q)
