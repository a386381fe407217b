"""Expressions that grow, overflow or divide by zero: refused at their place, or C that compiles; either soon."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputError, LimitError
from gudgeon.generator.pipeline import derive_scene, generate_kernel_source
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags

FILE = """format: gudgeon/1
name: n
parameters: {two: 2, wait: 0 s}
bodies: {a: {length: 1, mass: 1, inertia: 1}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}}
"""
T = "1 rad/s * t"


def drive(value: str) -> str:
    return f"{FILE}drives: {{d: {{angle: a, value: {value}}}}}\n"


def torque(value: str) -> str:
    return f"{FILE}forces: {{f: {{torque: a, value: 1 N*m * {value}}}}}\n"


REFUSED: list[tuple[str, type[InputError]]] = [
    (drive(f"{T} * 10**10**10"), BadValueError),
    (drive(f"{T} + 9e307 * 10"), BadValueError),
    (drive("t / 0"), BadValueError),
    (drive(f"{T} / (two - 2)"), BadValueError),
    (drive(f"{T} + sqrt(-two)"), BadValueError),
    (drive(f"{T} + (-8)**(1/3)"), BadValueError),
    (drive(f"1 / (sin({T}) * 0)"), BadValueError),
    (drive(f"1 / ({T} - {T})"), BadValueError),
    (drive("ramp(t, 1 s, wait)"), BadValueError),
    (drive("smooth_step(" * 12 + T + ", 0, 1)" * 12), LimitError),
    (torque("1 / (a.theta - a.theta)"), BadValueError),
    (torque("exp(1000)**a.theta"), BadValueError),
    (drive(f"{T} * two**1000 * 2**-2000"), BadValueError),
    (torque("ramp(a.theta, 0, 0)"), BadValueError),
    (f"{FILE}outputs: {{o: a.y / (two - 2)}}\n", BadValueError),
    (f"{FILE}gravity: [0, two**10**10]\n", BadValueError),
    (
        f"{FILE}scenes: {{s: {{parameters: {{two: 0}}}}}}\ndrives: {{d: {{angle: a, value: {T} / two}}}}\n",
        BadValueError,
    ),
]


@pytest.mark.parametrize(("text", "kind"), REFUSED, ids=lambda value: str(value).replace(FILE, "").strip()[:60])
def test_refused(text: str, kind: type[InputError]) -> None:
    with pytest.raises(kind) as caught:
        generate_kernel_source(text.encode(), "f", "ideal")
    where = caught.value.where
    assert where is not None and where.line == 7  # the scene's, where it is the scene that divides by zero


COMPILED = [
    drive(f"{T} + (1/3)**1e14"),
    drive(f"{T} * two**1000 * (2**-1000)**0.9"),
    drive(f"{T} * 1e300 * 1e300 / 1e300"),
    drive(f"(((({T} + 1)**24 + 1)**24 + 1)**24)**24"),  # overflows at once: the run will say so
    drive(f"log({T})"),
    drive(f"sqrt({T})"),
    drive(f"asin(2 + {T})"),
    drive("ramp(" * 2 + T + ", 0.1, 1)" * 2),
    drive(f"abs(sin({T})) + ramp(t, 0, 1 s) + min(t, 2 s) * max(t, 1 s) * 1 1/s * 1 1/s"),
    torque("a.theta * 1e300 * 1e300"),
    torque("(-1 - a.theta**2)**0.5 * log(-abs(a.theta))"),
    torque("a.theta**a.theta * exp(-a.theta**2)**2**2**2"),
    torque("abs(sign(a.theta)) * min(a.theta, max(a.theta, -a.theta)) * (a.theta + a.omega * 1 s)**24"),
]
DEEPER = [
    drive("smooth_step(" * 2 + T + ", 0.1, 1)" * 2),
    drive("ramp(" * 3 + T + ", 0.1, 2)" * 3),
    drive("sin(" * 15 + T + ")" * 15),
    drive("ramp(" * 5 + T + ", 0.1, 2)" * 5),
    drive("sin(" * 40 + T + ")" * 40),
]


@pytest.mark.parametrize("texts", [COMPILED, pytest.param(DEEPER, marks=pytest.mark.slow)], ids=["each", "deeper"])
def test_compiled(texts: list[str], tmp_path: Path) -> None:
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", build_include_flags()[-1]]
    for number, text in enumerate(texts):
        source = generate_kernel_source(text.encode(), "f", "ideal")
        folder = tmp_path / str(number)
        folder.mkdir()
        for name, part in source.files.items():
            (folder / name).write_text(part)
        engine = ["engine/engine.c"] if number == 0 else []  # of which nothing is the file's but sizes
        mains = [source.main, *engine, *([source.lane_file] if source.lane_file else [])]
        units = [f"unit_{kind}.c" for kind in range(len(mains))]
        for unit, name in zip(units, mains, strict=True):
            (folder / unit).write_text(f'#include "{name}"\n')
        done = subprocess.run([*find_compiler(), *flags, "-I.", *units], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[:2000]


def test_thousands_of_parameters_may_be_defined_through_each_other() -> None:
    """None of them is read by recursion."""
    text = (Path(gudgeon.__file__).resolve().parents[1] / "mechanisms" / "pendulum.yaml").read_text(encoding="utf-8")
    chain = "".join(f"  p{k}: 1 * p{k + 1}\n" for k in range(1500)) + "  p1500: 1 m\n"
    text = text.replace("  length: 1 m\n", f"  length: p0\n{chain}")
    slots = derive_scene(text.encode(), "x.yaml", "ideal").parameter_table
    assert slots.entries["parameters.length"].default == 1.0
    assert list(slots.entries)[:3] == ["parameters.g", "parameters.p1500", "parameters.p1499"]
