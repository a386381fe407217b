"""Every generated function fills the arrays that it is to fill: sizes of model.h against the indices that are assigned.

An index that is counted and not assigned is memory that nobody has written. The C is read, not run: parts into which a
long function was cut count to the function that calls them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import STAGES
from gudgeon.errors import GudgeonError
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from tests.fuzz.scenes import random_file
from tests.slow import slow_but

MECHANISMS = Path(gudgeon.__file__).resolve().parents[1] / "mechanisms"
FILES = (*sorted(MECHANISMS.glob("*.yaml")), *sorted((MECHANISMS / "gallery").glob("*.yaml")))
OWN = Path(__file__).parent / "watched"
DEFINED = re.compile(r"^[\w ()]*?(?:int|void|double)\s+(\w+)\([^{;]*?\)\n\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)
ASSIGNED = re.compile(r"(?<![\w.>])((?:rhs->|lin->)?\w+)\[(\d+)\](?:\.\w+)* =(?!=)")
RESULT = re.compile(r"&(rhs->\w+)\[(\d+)\]")  # of a call
SWITCH, JOINT = (
    re.compile(r"branch_of\(branch,\s+g,\s+(\d+),"),
    re.compile(r"for \(int k = (\d+); k < (\d+); k\+\+\)\s+g\[k\]"),
)
RIGHT_HAND_SIDE = {
    "a": "N_Q",
    "rhs->power": "3",
    "rhs->event": "N_USER_EVENTS",
    "rhs->clearance": "N_CLEARANCES",
    "rhs->friction": "N_FRICTIONS",
}
ABSOLUTE = {"all_q": "N_Q", "all_v": "N_Q"}
FILLED: Mapping[str, Mapping[str, str]] = {
    "mass_matrix": {"m": "N_Q"},
    "constraints": {"phi": "N_ALL_ROWS"},
    "velocity_rhs": {"nu": "N_ALL_ROWS"},
    "acceleration_rhs": {"gamma_rows": "N_ALL_ROWS"},
    "start_values": {"guess": "N_GUESS", "set": "N_SET", "rates": "N_RATES + N_ECCENTRICITIES"},
    "outputs": {"torques": "N_DRIVES", "series": "N_SERIES"},
    "dynamics": RIGHT_HAND_SIDE | {"rhs->lambda": "N_ROWS", "rhs->phi": "N_ROWS", "rhs->phi_dot": "N_ROWS"},
    "reduced_dynamics": RIGHT_HAND_SIDE | {"a": "N_X", "rhs->lambda": "N_LOOPS"},
    "expand": ABSOLUTE,
    "reduce_state": {"s": "N_X + N_DEPENDENT", "s_rate": "N_X + N_DEPENDENT"},
    "reduce_accelerations": {"a": "N_X"},
    "closures": {"out": "N_LOOPS"},
    "closure_rates": {"out": "N_LOOPS"},
    "reduced_project": {"x": "N_X"},
    "tree_multipliers": {"closing": "N_LOOPS"},
    "compute_loop_step": {"step": "N_DEPENDENT", "bend": "N_DEPENDENT"},
    "compute_third_loop_rates": {"out": "N_DEPENDENT"},
    "linearize": {"lin->value": "N_VALUES"},
    "newton_factor": {"lin->lu": "N_FACTORS"},
    "newton_factor_complex": {"lin->lu": "2 * N_FACTORS"},
    "compute_closure_step": {"dq": "N_X", "dv": "N_X"},
    "close_step": {"step": "N_X", "rates": "N_X"},
    "compute_body_motion": ABSOLUTE | {"all_a": "N_Q", "a": "N_X"},
    "project": {"x": "N_Q"},
    "time_terms": {"out": "N_TERMS"},
    "monitored_functions": {"rhs->event": "N_USER_EVENTS"},
    "bound_monitored_functions": {"out": "N_MONITORED"},
}


class Emitted:
    """The C of a scene: bodies of its functions, sizes and tables of its model.h."""

    def __init__(self, source: KernelSource) -> None:
        self.header = header = source.files["model.h"]
        self.sizes = {name: int(value) for name, value in re.findall(r"#define (\w+) (-?\d+)\b", header)}
        watched = re.search(r"monitored_event\[\] = \{([^}]*)\}", header)
        assert bool(watched) == bool(self.sizes["INTEGRATES"])
        self.watched = [int(x) for x in watched[1].split(",")] if watched else []
        texts = {name: text for name, text in source.files.items() if name.endswith(".c") and name != "lanes.c"}
        self.bodies = {name: body for text in texts.values() for name, body in DEFINED.findall(text)}
        self.text = "\n".join(texts.values())

    def body(self, name: str) -> str:
        """With those of the parts that it calls."""
        found, waiting = {name}, [name]
        while waiting:
            called = re.findall(r"\b(\w+)\(", self.bodies[waiting.pop()])
            new = {other for other in called if other in self.bodies and other.startswith(name)} - found
            found |= new
            waiting += new
        return "\n".join(self.bodies[other] for other in sorted(found))

    def size(self, of: str) -> int:
        return int(eval(re.sub(r"\b[A-Z]\w+", lambda m: str(self.sizes.get(m[0], 0)), of)))

    def missing(self) -> Iterator[str]:
        """Arrays of which something that is counted is not assigned."""
        for name in FILLED.keys() & self.bodies.keys():
            body = self.body(name)
            assigned = {(array, int(k)) for pattern in (ASSIGNED, RESULT) for array, k in pattern.findall(body)}
            for array, of in FILLED[name].items():
                if left := [k for k in range(self.size(of)) if (array, k) not in assigned]:
                    yield f"{name}: {array}{left} of {of}"
        yield from self._switches()

    def _switches(self) -> Iterator[str]:
        """Of the right-hand side that is integrated all of them, of what is watched along a step the scene's own."""
        if not self.sizes["INTEGRATES"]:
            return
        first, count = self.sizes["N_CLEARANCES"], self.sizes["N_SWITCHES"]
        main = "reduced_dynamics" if self.sizes["TREE"] else "dynamics"
        joints = {k for a, b in JOINT.findall(self.text) for k in range(int(a), int(b))}
        unused = re.search(r"short unused_switch\[\] = \{([^}]*)\}", self.header)
        joints |= {int(k) for k in unused[1].split(",")} if unused else set()  # NaN in motion()
        message = joints | {
            int(k)
            for name in (main, "evaluate_loop_switching_functions")
            if name in self.bodies
            for k in SWITCH.findall(self.body(name))
        }
        if left := sorted(set(range(count)) - message):
            yield f"{main}: rhs->g{left} of N_SWITCHES"
        own = {k - first for k in self.watched if first <= k < first + count} if self.sizes["N_MONITORED"] else set()
        if "monitored_functions" in self.bodies:
            assigned = {int(k) for array, k in ASSIGNED.findall(self.body("monitored_functions")) if array == "rhs->g"}
            if left := sorted(own - assigned):
                yield f"monitored_functions: rhs->g{left} of N_MONITORED"


def check(data: bytes, name: str, scene: str, formulation: str) -> None:
    assert list(Emitted(generate_kernel_source(data, name, scene, formulation=formulation)).missing()) == []


@pytest.mark.parametrize("formulation", ["reduced", "full", STAGES])
@pytest.mark.parametrize(
    "file",
    slow_but([f for f in FILES if f.stem in ("shaker", "guided_slider_crank")], FILES),
    ids=lambda file: file.stem,
)
def test_mechanisms(file: Path, formulation: str) -> None:
    for scene in read_mechanism(file.read_bytes(), file.name).scenes:
        check(file.read_bytes(), file.name, scene, formulation)


@pytest.mark.parametrize("first", slow_but([0], range(0, 200, 20)))
def test_random_files(first: int) -> None:
    checked = 0
    for seed in range(first, first + 20):
        made = random_file(seed)
        try:
            mechanism = read_mechanism(made.text.encode(), "fuzz.yaml")
        except GudgeonError:
            continue
        for formulation in ("reduced", "full"):
            check(made.text.encode(), "fuzz.yaml", made.scene, formulation)
        checked += bool(mechanism)
    assert checked > 10
