"""The engine's own sines, powers and logarithms: against mpmath, and the same bits from every compiler."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from cffi import FFI
from numpy.typing import NDArray

from gudgeon.loading import compiler
from gudgeon.loading.cache import get_default_cache
from gudgeon.loading.engine import ENGINE, build_include_flags
from gudgeon.web.module import FLAGS
from tests.web.node import needs_node, node

HERE = Path(__file__).parent
NAMES = ("pow", "exp", "log", "sin", "cos", "asin")
EXACT: dict[str, Callable[[Any, Any], Any]] = {
    "pow": mpmath.power,
    "exp": lambda x, y: mpmath.exp(x),
    "log": lambda x, y: mpmath.log(x),
    "sin": lambda x, y: mpmath.sin(x),
    "cos": lambda x, y: mpmath.cos(x),
    "asin": lambda x, y: mpmath.asin(x),
}
WITHIN = {"pow": 0.56, "exp": 0.52, "log": 0.52, "sin": 0.8, "cos": 0.8, "asin": 0.75}  # units in the last place
Array = NDArray[np.float64]
Values = Callable[[str, Array, Array], Array]


@pytest.fixture(scope="module")
def values(tmp_path_factory: pytest.TempPathFactory) -> Values:
    """`values` of functions.c, compiled with the flags of a scene."""
    library = tmp_path_factory.mktemp("functions") / "functions.so"
    line = [*compiler.find_compiler(), *compiler.build_flags(False), *build_include_flags(), "-shared"]
    subprocess.run([*line, str(HERE / "functions.c"), "-o", str(library), "-lm"], check=True)
    ffi = FFI()
    ffi.cdef("void values(int which, long n, const double *x, const double *y, double *out);")
    lib = ffi.dlopen(str(library))

    def call(name: str, x: Array, y: Array) -> Array:
        out = np.empty_like(x)
        pointers = (ffi.from_buffer("double[]", array) for array in (x, y, out))
        lib.values(NAMES.index(name), len(x), *pointers)
        return out

    return call


def ranges(n: int) -> dict[str, list[tuple[Array, Array]]]:
    """Arguments of each: wide ones, and those where digits cancel."""
    rng = np.random.default_rng(15)
    near, small = rng.uniform(-1.0, 1.0, n), 10.0 ** rng.uniform(-12.0, -1.0, n)
    wide, exponents = 2.0 ** rng.uniform(-60.0, 60.0, n), rng.uniform(-9.0, 9.0, n)
    turns = rng.uniform(-9e4, 9e4, n)
    close = np.nextafter(1.0 - 2.0 ** -rng.uniform(30.0, 53.0, n), 0.0)
    beside_one = [
        (x, np.clip(76.0 * exponents / np.abs(np.log(x)), -1e18, 1e18))
        for x in (close, 2.0 - close, 1.0 + 0.04 * np.abs(near))
    ]
    beside = np.rint(turns) * (np.pi / 2)  # sines or cosines that are nearly zero
    return {
        "pow": [
            (wide, exponents),
            (1.0 + 0.02 * near, 3e4 * exponents / 9.0),
            (wide, np.full(n, 1.5)),
            (wide, np.full(n, 0.5)),
            *beside_one,
        ],
        "exp": [(690.0 * near, exponents), (small, exponents)],
        "log": [(wide, exponents), (1.0 + 0.4 * near, exponents), (1.0 + near * small, exponents)],
        "sin": [(turns, exponents), (beside, exponents), (5.0 * near, exponents)],
        "cos": [(turns, exponents), (beside, exponents), (5.0 * near, exponents)],
        "asin": [
            (near, exponents),
            (near * small, exponents),
            (1.0 - small, exponents),
            (0.5 + 0.03 * np.abs(near), exponents),
        ],
    }


@pytest.mark.parametrize("name", NAMES)
def test_they_are_right_to_the_last_place(name: str, values: Values) -> None:
    with mpmath.workprec(200):
        for x, y in ranges(250)[name]:
            found = values(name, x, y)
            for a, b, value in zip(x.tolist(), y.tolist(), found.tolist(), strict=True):
                exact = EXACT[name](mpmath.mpf(a), mpmath.mpf(b))
                off = abs(mpmath.mpf(value) - exact) / mpmath.mpf(float(np.spacing(abs(float(exact)))))
                assert off < WITHIN[name], (a, b)


def test_what_is_beyond_them_is_the_librarys(values: Values) -> None:
    """Zeros, infinities, negative bases, numbers too small to be normal, results that overflow."""
    x = np.array([0.0, np.inf, -2.0, -2.0, 5e-324, 1e300, 1e-300, np.nan, 1.0, 2.0])
    y = np.array([0.5, -1.0, 3.0, 0.5, 0.5, 2.0, 2.0, 0.0, np.nan, np.inf])
    expected = [0.0, 0.0, -8.0, np.nan, 2.2227587494850775e-162, np.inf, 0.0, 1.0, 1.0, np.inf]
    np.testing.assert_array_equal(values("pow", x, y), expected)
    ends = np.array([-np.inf, np.inf, 1e3, -1e3, np.nan, 0.0])
    np.testing.assert_array_equal(values("exp", ends, ends), [0.0, np.inf, np.inf, 0.0, np.nan, 1.0])
    ends = np.array([0.0, -1.0, np.inf, 5e-324, 1.0])
    np.testing.assert_array_equal(values("log", ends, ends), [-np.inf, np.nan, np.inf, -744.4400719213812, 0.0])
    ends = np.array([np.inf, np.nan, 0.0])
    np.testing.assert_array_equal(values("sin", ends, ends), [np.nan, np.nan, 0.0])
    ends = np.array([1.0, -1.0, 1.5, 0.0])
    np.testing.assert_array_equal(values("asin", ends, ends), [np.pi / 2, -np.pi / 2, np.nan, 0.0])


@needs_node
def test_bits_are_those_of_a_page(values: Values, tmp_path: Path) -> None:
    """A hundred thousand arguments each, what Node computes beside what this machine's compiler made."""
    ziglang = pytest.importorskip("ziglang", reason="the extra web is not installed: no compiler for pages")
    zig, module = Path(ziglang.__file__).with_name("zig"), tmp_path / "functions.wasm"
    requested = ["-Wl,--export=values", *build_include_flags(), str(HERE / "functions.c"), "-o", str(module)]
    kept = {"ZIG_GLOBAL_CACHE_DIR": str(get_default_cache().root / "zig"), "ZIG_LOCAL_CACHE_DIR": str(tmp_path)}
    # from the test's folder, as of a scene: from one that zig lies in it takes its C library for another, a minute more
    line, env = [str(zig), "cc", *FLAGS, *requested], {**compiler.build_environment(), **kept}
    subprocess.run(line, cwd=tmp_path, check=True, capture_output=True, env=env)
    for name, pairs in ranges(100_000).items():
        x, y = (np.concatenate(arrays) for arrays in zip(*pairs, strict=True))
        np.concatenate([x, y]).tofile(tmp_path / "in")
        program = [str(node()), str(HERE / "functions.js"), str(module), str(tmp_path / "in"), str(tmp_path / "out")]
        subprocess.run(program, check=True)
        made = np.fromfile(tmp_path / "out").reshape(len(NAMES), -1)[NAMES.index(name)]
        assert np.array_equal(made.view("i8"), values(name, x, y).view("i8")), name


def tables() -> dict[str, list[list[float]]]:
    """Those of powers.h."""
    text = (ENGINE / "scene" / "powers.h").read_text(encoding="utf-8")
    bodies = re.findall(r"double (\w+)\[POWER_TABLE_ROWS\]\[\d\] = \{(.*?)\n\};", text, re.DOTALL)
    rows = {name: re.findall(r"\{([^{}]*)\}", body) for name, body in bodies}
    return {name: [[float.fromhex(x) for x in row.split(",")] for row in found] for name, found in rows.items()}


def test_tables_are_logarithms_and_powers() -> None:
    """To 90 bits: -log c in two numbers, of which the first has no bit below 2^-42; 2^(j/128) in two."""
    found = tables()
    assert {name: len(rows) for name, rows in found.items()} == {"log_table": 128, "exp_table": 128}
    with mpmath.workprec(200):
        for c, high, low in found["log_table"]:
            assert high * 2.0**42 == round(high * 2.0**42) and c * 2.0**12 == round(c * 2.0**12)
            assert abs(mpmath.mpf(high) + low + mpmath.log(c)) < 2.0**-96
        for j, (power, missing) in enumerate(found["exp_table"]):
            exact = mpmath.power(2, mpmath.mpf(j) / 128)
            assert power == float(exact)
            assert abs((exact - power) / exact - missing) < 2.0**-104


@pytest.mark.skipif(shutil.which("objdump") is None, reason="no objdump is installed")
def test_no_product_and_sum_are_fused(tmp_path: Path) -> None:
    """Neither in the engine nor in what is emitted for dry contacts, where gcc 12's vectorizer would."""
    from gudgeon.loading.kernel_sources import derive_kernel_source
    from gudgeon.loading.shipped import find_shipped_file

    file = find_shipped_file("slider_crank")
    source = derive_kernel_source(file.read_bytes(), file, "dry")
    for name, text in source.files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    line = [*compiler.find_compiler(), *compiler.build_flags(False), *build_include_flags(), "-c"]
    for unit, made in ((source.main, "scene.o"), (str(ENGINE / "engine.c"), "engine.o")):
        subprocess.run([*line, unit, "-o", made], cwd=tmp_path, check=True)
        done = subprocess.run(["objdump", "-d", made], cwd=tmp_path, check=True, capture_output=True, text=True)
        assert re.findall(r"\s(vfn?m(?:add|sub)\w*|fn?m(?:add|sub)|fml[as])\s", done.stdout) == []
