"""A design: a mechanism file as nested mappings, whose numbers are parameters; and what is made of it."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from tests.random_machines.numbers import Dims, Numbers

# Names that are units, and names that generated code, laws or expressions use or have used
UNIT_NAMES = ("N", "m", "s", "g", "rad", "J", "W", "Pa", "h", "min_", "kg", "Hz", "mm", "deg")
CODE_NAMES = (
    "k",
    "next",
    "g_v",
    "root_far",
    "bent",
    "a_0_",
    "q",
    "v",
    "p",
    "t0",
    "order",
    "lane",
    "sine_0",
    "out",
    "rows",
    "eta",
    "delta",
    "mu",
    "n",
    "x_0",
    "double_",
    "memory",
    "aside",
    "main",
    "e1",
)


@dataclass
class Design:
    """`file` without its parameters; relations that do not hold for it are named in `without`.

    t_end (s); rtol: of its runs; `methods` that suit it; `chaos`: errors may grow as far as the play is wide.
    """

    family: str
    seed: int
    file: dict[str, Any]
    numbers: Numbers
    t_end: float
    scene: str = "ideal"
    rtol: float = 1e-9
    methods: tuple[str, ...] = ("auto", "dop853", "rodas5p", "radau5")
    without: frozenset[str] = frozenset()
    size: float = 1.0  # m, of the machine
    tags: frozenset[str] = field(default_factory=frozenset)

    def text(self, file: Mapping[str, Any] | None = None, name: str = "random_machine") -> str:
        """The YAML: each entry a line of JSON, which YAML contains."""
        lines = ["format: gudgeon/1", f"name: {name}"]
        for section, content in {"parameters": self.numbers.section(), **(file or self.file)}.items():
            if isinstance(content, dict):
                lines += [f"{section}:", *(f"  {key}: {json.dumps(value)}" for key, value in content.items())]
            else:
                lines.append(f"{section}: {json.dumps(content)}")
        return "\n".join(lines) + "\n"

    def with_values(self, values: Mapping[str, float], dims: Dims | None = None) -> str:
        """The YAML with other numbers: a failure's file stands for itself."""
        text = self.text()
        for name, value in values.items():
            text = re.sub(rf'(?m)^  {name}: "[^ "]+', partial(_line, name, value), text, count=1)
        return text

    def accepted_methods(self) -> tuple[str, ...]:
        """Return those of `methods` that integrate the scene (docs/choosing_a_method.md)."""
        contacts = self.file.get("contacts", {}).values()
        rigid = any(one.get("normal", {}).get("law") == "newton_restitution" for one in contacts)
        return tuple(name for name in self.methods if not rigid or name in ("auto", "rk4", "dop853"))

    def bodies(self) -> list[str]:
        return list(self.file["bodies"])

    def renamed(self, rng: np.random.Generator, names: tuple[str, ...]) -> tuple[str, dict[str, str], dict[str, str]]:
        """The file with parts in another order and other names; the new names of bodies and of parameters."""
        file = {key: _shuffled(rng, value) if isinstance(value, dict) else value for key, value in self.file.items()}
        file = {"parameters": _shuffled(rng, self.numbers.section())} | file
        things = [*self.bodies(), *(n for part in ("joints", "drives", "forces") for n in self.file.get(part, {}))]
        parameters = list(self.numbers.values)
        used = list(names)
        rng.shuffle(used)
        selected = [*things, *(str(n) for n in rng.permutation(parameters))]
        rng.shuffle(selected)
        others = dict(zip(selected, used, strict=False))
        text = self.text(file).replace("name: random_machine", "name: other_machine")
        pattern = re.compile(rf"(?<![\w.])({'|'.join(map(re.escape, others))})(?!\w)") if others else None
        head, _, body = text.partition("\n")
        body = pattern.sub(lambda found: others[found[1]], body) if pattern else body
        of_bodies, of_parameters = ({x: others.get(x, x) for x in of} for of in (self.bodies(), parameters))
        return head + "\n" + body, of_bodies, of_parameters

    def split(self, body: str) -> str:
        """The file with a body made of two that are welded at its centre of mass, each of half the mass."""
        file = {key: dict(value) if isinstance(value, dict) else value for key, value in self.file.items()}
        whole = file["bodies"][body]
        half = {key: f"({whole[key]})/2" for key in ("mass", "inertia")}
        file["bodies"] = {**file["bodies"], body: {**whole, **half}, "other_half": half}
        weld = {"rigid": [f"{body}.com", "other_half.origin"], "angle": 0.7}
        file["joints"] = {**file.get("joints", {}), "weld": weld}
        guess = file.get("start", {}).get("guess", {})
        more = {f"other_half.{axis}": guess[f"{body}.{axis}"] for axis in ("x", "y") if f"{body}.{axis}" in guess}
        if f"{body}.theta" in guess:
            more["other_half.theta"] = f"{guess[f'{body}.theta']} + 0.7"
        file["start"] = {**file.get("start", {}), "guess": {**guess, **more}}
        return self.text(file)


def _shuffled(rng: np.random.Generator, mapping: Mapping[str, Any]) -> dict[str, Any]:
    return {key: mapping[key] for key in (str(k) for k in rng.permutation(list(mapping)))}


def _line(name: str, value: float, _: re.Match[str]) -> str:
    return f'  {name}: "{value!r}'
