"""What is lit with a row is what computes it: lit lines of the emitted C are run alone, and one by one disturbed."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
import subprocess
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.targets.latex import render_equations_html
from gudgeon.generator.targets.latex.trace import HighlightIndex, list_yaml_tokens, make_highlight_index
from tests.equations.models import random_state
from tests.slow import slow_but
from tests.web.node import browser

FILE = resources.files("gudgeon.mechanisms").joinpath("nine_bar_press.yaml")
ARRAYS = {"constraints": "phi", "velocity_rhs": "nu", "acceleration_rhs": "gamma_rows", "jacobian": "phi_q"}
SCENES = slow_but(["lubricated"], ["ideal", "dry", "lubricated"])  # the last has what the others have
FUNCTIONS: dict[str, Any] = {
    "cos": math.cos,
    "sin": math.sin,
    "sqrt": math.sqrt,
    "PI": math.pi,
    "fabs": abs,
    "max_of": max,
    "min_of": min,
}


@cache
def model_of(scene: str) -> Model:
    return derive_scene(FILE.read_bytes(), str(FILE), scene)


@cache
def traced(scene: str) -> HighlightIndex:
    return make_highlight_index(model_of(scene))


@cache
def page(scene: str) -> str:
    pytest.importorskip("latex2mathml")
    return render_equations_html(model_of(scene))


class Numbers(dict[str, float]):
    """p: any number will do, the same for a name whenever it is asked for."""

    def __missing__(self, name: str) -> float:
        self[name] = float(np.random.default_rng(list(name.encode())).uniform(0.3, 2.0))
        return self[name]


def statements(found: HighlightIndex, file: str, function: str) -> Iterator[tuple[range, str, str]]:
    """Lines, target and value of each assignment of a function of the C, read as text."""
    lines = found.source.files[file].split("\n")
    first = next(k for k, text in enumerate(lines, 1) if re.search(rf"\b{function}\(.*[^;]$", text) and text[0] != " ")
    text, begin = "", 0
    for number in range(first + 1, len(lines) + 1):
        line = re.sub(r"/\*.*?\*/", "", lines[number - 1]).strip()
        if lines[number - 1] == "}":
            return
        if not text:
            begin = number
        text = f"{text} {line}".strip()
        if text.endswith(";"):
            if match := re.fullmatch(r"(?:const double )?([\w\[\]>-]+) = (.*);", text):
                yield range(begin, number + 1), match[1], match[2].replace("p->", "p.")
            text = ""
        elif text.endswith(("{", ":", "}")) or not text:
            text = ""


def run(
    code: Collection[tuple[range, str, str]], lit: Collection[int], state: dict[str, Any], changed: int = 0
) -> dict[str, float]:
    """What the lit statements alone give; `changed`: the line whose value is made a little larger."""
    known = {**FUNCTIONS, **state}
    found: dict[str, float] = {}
    for lines, target, value in code:
        if lines[-1] not in lit:
            continue
        value = re.sub(r"p\.(\w+)", r"p['\1']", value)
        result = eval(value, {"__builtins__": {}}, known) + (1e-3 if changed in lines else 0.0)  # the C is our own
        known[target] = found[target] = result
    return found


def state_of(found: HighlightIndex) -> dict[str, Any]:
    t, q, v = random_state(found.model, 5)
    return {"t": t + 0.37, "q": q, "v": v + 0.7, "p": Numbers()}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("function", ARRAYS)
def test_lit_lines_are_those_that_compute_a_row(scene: str, function: str) -> None:
    """Without all others its values are the same to the last bit; and none of them may be left out or changed."""
    found = traced(scene)
    code, state = list(statements(found, "constraints.c", function)), state_of(found)
    whole = run(code, range(1, 10**6), state)
    array = ARRAYS[function]
    place = {row.name: k for k, row in enumerate(found.model.all_rows)}
    n = len(found.model.q)
    for number, row in enumerate(found.model.rows, 1):
        r = place[row.name]
        columns = range(r * n, (r + 1) * n) if function == "jacobian" else range(r, r + 1)
        own = {f"{array}[{k}]" for k in columns} & set(whole)
        tokens = found.lines["constraints.c"]
        expected = (f"row-{number}", f"entry-{number}-")
        lit = {k for k, of in tokens.items() if any(t == expected[0] or t.startswith(expected[1]) for t in of)}
        lit &= {k for lines, _, _ in code for k in lines}
        alone = run(code, lit, state)
        assert own and {name: alone[name] for name in own} == {name: whole[name] for name in own}, row.name
        for lines, target, _ in code:
            if lines[-1] in lit:
                disturbed = run(code, lit, state, lines[0])
                assert any(disturbed[name] != whole[name] for name in own), (row.name, target)


@pytest.mark.parametrize("scene", SCENES)
def test_an_entry_lights_its_own_lines_alone(scene: str) -> None:
    found = traced(scene)
    code, state = list(statements(found, "constraints.c", "jacobian")), state_of(found)
    place = {row.name: k for k, row in enumerate(found.model.all_rows)}
    whole = run(code, range(1, 10**6), state)
    for number, row in enumerate(found.model.rows, 1):
        for q in row.phi_q:
            column = found.model.q.index(q)
            token, name = f"entry-{number}-{column + 1}", f"phi_q[{place[row.name] * len(found.model.q) + column}]"
            lit = {k for k, of in found.lines["constraints.c"].items() if token in of}
            alone = run(code, lit, state)
            assert alone[name] == whole[name]
            assert [target for target in alone if target.startswith("phi_q[")] == [name]


@pytest.mark.parametrize("scene", SCENES)
def test_lit_lines_of_the_textbooks_function(scene: str) -> None:
    """dynamics.c: what a row contributes to the right-hand side, from the lit lines alone."""
    found = traced(scene)
    code, state = list(statements(found, "dynamics.c", "dynamics")), state_of(found)
    for number, row in enumerate(found.model.rows, 1):
        lit = {k for k, of in found.lines["dynamics.c"].items() if f"row-{number}" in of}
        own = [(lines, target, value) for lines, target, value in code if not target.startswith("rhs->lambda[")]
        name = row.name.replace(".", "_")
        alone = run(own, lit, state)
        assert {f"phi_{name}_", f"phi_dot_{name}_", f"rhs_{name}_"} <= set(alone)
        numbers = {
            s: state["p"][found.model.parameter_table.find_member_name(s)]
            for s in found.model.parameter_table.list_symbols()
        }
        at = {**dict(zip(found.model.q, state["q"], strict=True)), **numbers, found.model.t: state["t"]}
        explicit = found.model.symbols.definitions
        value = row.phi
        while free := {s: explicit[s] for s in value.free_symbols if s in explicit and s not in numbers}:
            value = value.xreplace(free)
        assert alone[f"phi_{name}_"] == pytest.approx(float(value.subs(at)), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("scene", SCENES)
def test_names_and_numbers_are_those_of_the_scene_that_runs(scene: str) -> None:
    source: KernelSource = generate_c(derive_scene(FILE.read_bytes(), str(FILE), scene))
    assert traced(scene).source == replace(source, reference={})


def test_lines_of_the_file() -> None:
    """A number's line lights what hangs on it, a joint's its rows: told by hand for the press."""
    found, text = traced("lubricated"), FILE.read_text(encoding="utf-8").splitlines()
    tokens = list_yaml_tokens(found.model, found)

    def line(start: str) -> frozenset[str]:
        (number,) = [k for k, own in enumerate(text, 1) if own.strip().startswith(start)]
        assert f"yaml-{number}" in tokens[number]
        return tokens[number]

    assert {token for token in line("O4: {rev") if token.startswith("row-")} == {"row-3", "row-4"}
    assert {token for token in line("l5:") if token.startswith("row-")} == {"row-4"}
    assert {"row-19", "drive-crank1"} <= line("crank1:") and "row-20" not in line("crank1:")
    assert {token for token in line("omega:") if token.startswith("row-")} == {"row-19", "row-20"}
    assert {"body-L3", "entry-7-9", "entry-8-9", "row-7", "row-8"} <= line("L3:")
    assert "row-3" not in line("L3:")
    assert "law-oil" in line("film:") and "law-oil" in line("pin:")


VOID = {"meta", "link", "br"}


class Reader(HTMLParser):
    """Elements, whether they are closed in order, and what stands in data-of."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def carried(text: str) -> dict[str, Any]:
    """What the page holds packed."""
    packed = re.search(r'id="gudgeon-c">([^<]*)<', text)
    assert packed
    found: dict[str, Any] = json.loads(gzip.decompress(base64.b64decode(packed[1])))
    return found


@pytest.mark.parametrize("scene", SCENES)
def test_a_page_is_well_formed_and_every_token_leads_somewhere(scene: str) -> None:
    text = page(scene)
    reader = Reader()
    reader.feed(text)
    assert reader.open == [] and len(text.encode()) <= 200_000
    count = Counter(token for _, own in reader.elements for token in (own.get("data-of") or "").split())
    for file in carried(text)["of"].values():
        count.update(token for of in file for token in of.split())
    model = traced(scene).model
    expected = {f"row-{k}" for k in range(1, 1 + len(model.rows))} | {f"body-{body.name}" for body in model.bodies}
    assert expected <= set(count)
    alone = {token for token, k in count.items() if k == 1}
    assert not [token for token in alone if not token.startswith(("yaml-", "name-", "number-", "sum-"))]
    picks = {token for _, own in reader.elements for token in (own.get("data-pick") or "").split()}
    assert picks <= set(count)


ASKED = """<pre id="told"></pre><script>
addEventListener("load", () => setTimeout(() => {
    const n = %d, told = {}, lines = () => [...document.querySelectorAll("#gudgeon-lines .line")];
    for (const token of %s) {
        gudgeonHighlighting.highlight([token]);
        told[token] = lines().map((line) => line.dataset.location);
    }
    const equation = document.querySelector('.equation[data-pick="row-3"]'), key = (key) => equation.dispatchEvent(
        new KeyboardEvent("keydown", {key, bubbles: true}));
    gudgeonHighlighting.highlight([]);
    key("Enter");
    told.keyed = document.querySelectorAll(".highlighted").length && equation.classList.contains("highlighted");
    key("Escape");
    told.dark = document.querySelectorAll(".highlighted").length;
    equation.click();
    told.clicked = equation.classList.contains("highlighted");
    equation.click();
    told.again = document.querySelectorAll(".highlighted").length;
    const state = {sim: null, run: {series: (name) => [name === "lambda.O4.x" ? 7.5 : 0]}, k: 0, t: 0, p: [],
        q: new Float64Array(n).fill(0.25), v: new Float64Array(n)};
    document.dispatchEvent(new CustomEvent("gudgeon:state", {detail: state}));
    const at = (name) => gudgeonValues.formatValue(gudgeonValues.getValue(name));
    told.values = [at("q.3"), at("phi.18"), at("lambda.3"), at("phi_q.3.10")];
    told.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
    document.getElementById("told").textContent = JSON.stringify(told);
}, 500));
</script>"""


@pytest.mark.skipif(browser() is None, reason="no Chromium is installed")
def test_light_in_a_browser(tmp_path: Path) -> None:
    """Every row of the press lights the lines that the model says, by key and click too; a phone scrolls no way."""
    found, program = traced("lubricated"), browser()
    assert program
    rows = [f"row-{k}" for k in range(1, 1 + len(found.model.rows))]
    text = page("lubricated").replace("</body>", ASKED % (len(found.model.q), json.dumps(rows)) + "</body>")
    (tmp_path / "page.html").write_text(text, encoding="utf-8")
    line = [
        program,
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--window-size=390,800",
        "--virtual-time-budget=8000",
        "--dump-dom",
        (tmp_path / "page.html").as_uri(),
    ]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120)
    message = json.loads(done.stdout.partition('<pre id="told">')[2].partition("</pre>")[0])
    listed = carried(text)["texts"]
    for k, row in enumerate(rows, 1):
        expected = {
            f"{file}:{number}"
            for file in listed
            for number, of in found.lines[file].items()
            if row in of or any(token.startswith(f"entry-{k}-") for token in of)
        }
        own = {
            f"{FILE.name}:{line}"
            for line, of in list_yaml_tokens(found.model, found).items()
            if row in of or any(token.startswith(f"entry-{k}-") for token in of)
        }
        assert {one for one in message[row] if FILE.name not in one} == expected and own <= set(message[row])
    assert message["values"] == ["0.25", "\u22121.3208", "7.5", "\u22121"]  # of guide.angle: 0.25 - pi/2
    assert (message["keyed"], message["dark"], message["clicked"], message["again"], message["wide"]) == (
        True,
        0,
        True,
        0,
        0,
    )
