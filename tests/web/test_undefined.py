"""Pages refuse parameters that make an expression undefined as it is written, as Python does."""

from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path

import numpy as np

import gudgeon
from gudgeon.language.tree import from_json
from gudgeon.language.undefined_parts import DIVIDING, find_undefined_part
from gudgeon.web.page import read_file
from tests.scenes import loader
from tests.web.node import in_node, needs_node, node

# trees of files' expressions: they hold parameters d and e, and t, which is no parameter
TREES = [
    ["cos", ["acos", "d"]],
    ["+", ["*", ["acos", "d"], 0.0], 1.0],
    ["**", ["sqrt", "d"], 2.0],
    ["/", "d", "d"],
    ["/", 1.0, ["/", 1.0, "d"]],
    ["*", ["/", "t", "d"], "e"],
    ["-", ["log", "d"]],
    ["mod", "e", "d"],
    ["mod", ["*", "t", "e"], "d"],
    ["ramp", "t", "e", "d"],
    ["atan", ["/", "e", "d"]],
    ["exp", ["-", ["/", 1.0, "d"]]],
    ["where", "d", 1.0, 2.0, ["log", ["-", "d", 1.0]]],
    ["where", ["sqrt", "d"], 1.0, 2.0, 3.0],
    ["where", "d", "e", ["/", "t", "d"], ["sqrt", "e"]],
    ["*", 0.0, ["where", "t", "d", ["log", "e"], 1.0]],
]
VALUES = (-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0)


@needs_node
def test_undefined_parts_are_those_of_python(tmp_path: Path) -> None:
    cases = [(tree, {"d": d, "e": e}) for tree in TREES for d in VALUES for e in VALUES]
    program = "\n".join(
        (
            read_file("run.js"),
            read_file("undefined_parts.js"),
            f"const cases = {json.dumps(cases)}, divides = {json.dumps(sorted(DIVIDING))};",
            "const found = cases.map(([tree, known]) => findUndefinedPart(tree, known, divides));",
            "console.log(JSON.stringify(found.map((value) => (value === undefined ? 'defined' : String(value)))));",
        )
    )
    (tmp_path / "cases.js").write_text(program, encoding="utf-8")
    run = subprocess.run([node() or "", str(tmp_path / "cases.js")], capture_output=True, text=True, check=True)
    specified = {"defined": None, "NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
    found = [specified[one] for one in json.loads(run.stdout)]
    with np.errstate(all="ignore"):
        expected = [find_undefined_part(from_json(tree), known) for tree, known in cases]
    wrong = [case for case, a, b in zip(cases, found, expected, strict=True) if str(a) != str(b)]
    assert wrong == [] and 0 < sum(one is None for one in expected) < len(cases)


@needs_node
def test_a_page_refuses_what_a_run_refuses(tmp_path: Path) -> None:
    """The formula that C has for cos(acos(d)) is d."""
    text = """\
    parameters: {d: 0.5, a: "cos(acos(d))"}
    bodies: {b: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {O: [0, 0]}
    joints: {A: {revolute: [ground.O, b.tail]}}
    drives: {m: {angle: b, value: "a*1 rad/s*t"}}
    """
    bar: gudgeon.Simulation = loader(tmp_path)(text)
    options = {"t_end": 1.0, "output": 2}
    runs = [{"parameters": {"d": d}, "options": options} for d in (0.7, 2.0)]
    good, refused = in_node(bar, tmp_path, [*runs])
    assert not good.error and "parameters.a has a part that is NaN with d = 2" in refused.error
