"""What is fuzzed: bytes in; a value or an InputError at a place in the text comes out, and soon."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path

from gudgeon.errors import InputError, InputErrors, Location
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.parser import check_dimension, parse
from gudgeon.language.tree import evaluate, from_json, iterate_names, to_json
from gudgeon.language.units import DIMENSIONLESS, LENGTH, TIME, Dimension
from tests.mechanisms.invalid import MISTAKES

HERE = Location("f", 1, 1)
KNOWN: Mapping[str, Dimension | None] = {"t": TIME, "a": LENGTH, "b": None, "L1.x": LENGTH, "k": DIMENSIONLESS}
LONGEST = 2.0  # s, for any input; a thousand times what a file of this size takes

_TOKENS = (
    "+ - * / ** ( ) , . 0 1 2 9e307 1e-308 12.5 .5 1e 0x 1_0 pi t a b k L1.x sin( atan2( smooth_step( ramp( min( sqrt("
    " mm deg kg N*m 1/s m^2 rad/s Hz in rpm __class__ lambda if [ ] { } ' \" # ~ \\ \t \u2212 \u00b5m \u03c0"
)
TOKENS = tuple(_TOKENS.split(" "))
_YAML_TOKENS = (
    ": |\n|  |- |[|]|{|}|, |'|\"|&x |*x|!!python/object |<<: |? |> |%YAML 1.1|---\n|...\n|~|\t|# |format: gudgeon/1\n|"
    "name: n\n|bodies:\n|joints:\n|drives:\n|forces:\n|ground:\n|start: |guess: |scenes:\n|play: |outputs: |"
    "events:\n|zero: |direction: |action: |"
    "parameters:\n|"
    "extends: |length: |mass: |inertia: |points: |com: |revolute: |rigid: |gear: |distance: |point_on_line: |"
    "spring_damper: |torque: |force: |angle: |coordinate: |value: |radii: |carrier: |axis: |ground.O|L1.head|L2.tail|"
    "L1|ideal|contact: |bearing: |normal: |law: |lankarani_nikravesh|1 kg|2 mm|-1|0|t|\ufeff|\x00|\u2028"
)
YAML_TOKENS = tuple(_YAML_TOKENS.split("|"))

SMALL = b"""format: gudgeon/1
name: n
parameters: {r: 2 mm, k: r}
bodies: {L1: {length: r, mass: 1 kg, inertia: 1, points: {p: [1, 2]}}, S: {mass: 1, inertia: 2, com: [0, r]}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, L1.tail]}, g: {gear: [L1, S], radii: [1, 2]}}
drives: {d: {angle: L1, value: sin(2*pi*t)}}
forces: {s: {spring_damper: [ground.O, S.origin], stiffness: 1}, f: {force: L1.p, value: [1, -S.vx]}}
start: {guess: {S.x: 1}}
materials: {m: {E: 1, nu: 0.3}}
bearings: {p: {radius: 1, clearance: 0.1, length: 1, bearing_material: m, journal_material: m}}
contacts: {c: {normal: {law: lankarani_nikravesh, restitution: 0.9}}, e: {extends: c}}
events: {w: {zero: L1.p.y - r, direction: rising}, z: {zero: t - 1, action: stop}}
scenes: {x: {play: {O: {bearing: p, contact: e}}}, y: {extends: x, parameters: {r: 1}, events: {w: {zero: S.omega}}}}
outputs: {o: s.F - O.Fx}
"""


def expression(data: bytes) -> None:
    """The parser, the dimension check, the evaluation and the JSON of whatever was accepted."""
    try:
        tree = parse(data.decode("utf-8", "replace"), HERE)
        check_dimension(tree, LENGTH, KNOWN.get, HERE)
    except InputError as error:
        _check_place(error, data)
        return
    value = evaluate(tree, lambda path: 0.5)
    again = evaluate(from_json(to_json(tree)), lambda path: 0.5)
    assert value == again or math.isnan(value) and math.isnan(again)
    assert all(name.path for name in iterate_names(tree))


def reader(data: bytes) -> None:
    """The whole reader."""
    try:
        mechanism = read_mechanism(data, "f")
    except InputErrors as error:
        for one in error.errors:
            _check_place(one, data)
    except InputError as error:
        _check_place(error, data)
    else:
        assert mechanism.bodies and "ideal" in mechanism.scenes


def _check_place(error: InputError, data: bytes) -> None:
    """An error is classified, has words, and stands in the text."""
    assert type(error) is not InputError or "broken exponent" in error.message
    assert error.message and len(error.message) < 1500
    assert error.where is not None and error.where.file == "f"
    lines = len(data.decode("utf-8", "replace").splitlines()) + 1
    assert 1 <= error.where.line <= lines + 1 and error.where.column >= 1


def timed(target: Callable[[bytes], None], data: bytes) -> None:
    """The target, and no longer than `LONGEST` on the processor."""
    begin = time.process_time()
    target(data)
    assert time.process_time() - begin < LONGEST, f"{time.process_time() - begin:.1f} s"


def files() -> list[bytes]:
    """Mechanism files to begin with: the shipped, the valid and the invalid."""
    valid = sorted((Path(__file__).resolve().parents[1] / "mechanisms" / "valid").glob("*.yaml"))
    shipped = sorted(Path(str(resources.files("gudgeon.mechanisms"))).glob("*.yaml"))
    invalid = [mistake.data for mistake in sorted(MISTAKES, key=lambda mistake: mistake.file)]
    texts = [*(path.read_bytes() for path in valid), *invalid, *(path.read_bytes() for path in shipped)]
    return [SMALL, *(text for text in texts if len(text) < 4000)]


EXPRESSIONS = (
    "80 mm",
    "-39.52 deg + omega * t",
    "2*pi rad/s",
    "-(a + b)**2 / 3",
    "atan2(a, 2 m) * -k**-0.5",
    "smooth_step(t, 0, 1 s)",
    "min(max(a, 1 mm), 3*L1.x)",
    "1e-308",
    "1 N*m*s/rad",
    "hypot(a, a) + (3 m)**2/a",
)

TARGETS: Mapping[str, tuple[Callable[[bytes], None], tuple[str, ...], Callable[[], list[bytes]]]] = {
    "expression": (expression, TOKENS, lambda: [text.encode() for text in EXPRESSIONS]),
    "reader": (reader, YAML_TOKENS, files),
}
