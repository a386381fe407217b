"""All is derived before any text: a program that is made gives the same text again and again, and nothing new."""

from __future__ import annotations

from pathlib import Path

import pytest

from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive
from gudgeon.generator.targets.c.emit import emit
from tests.slow import slow_but

MECHANISMS = Path(__file__).parents[2] / "mechanisms"
SCENES = [
    ("nine_bar_press", "lubricated", "reduced"), ("slider_crank", "dry", "full"), ("shaker", "ideal", "reduced"),
    ("nine_bar_press", "ideal", "full"), ("four_bar", "ideal", "reduced"),
]  # fmt: skip


@pytest.mark.parametrize("of", slow_but(SCENES[1:3], SCENES), ids="-".join)
def test_printing_derives_nothing(of: tuple[str, str, str]) -> None:
    """Slots and symbols are as many behind the print as before it, and the second print is the first one."""
    name, scene, formulation = of
    file = MECHANISMS / f"{name}.yaml"
    program = make_program(derive(file.read_bytes(), file.name, scene), formulation)
    model, own = program.model, program.integrated.system.model
    before = [len(x) for x in (model.slots.entries, model.slots.derived, model.symbols.info, own.symbols.info)]
    first = emit(program)
    assert before == [len(x) for x in (model.slots.entries, model.slots.derived, model.symbols.info, own.symbols.info)]
    assert emit(program) == first


def test_what_is_derived_too_late_is_told() -> None:
    file = MECHANISMS / "slider_crank.yaml"
    program = make_program(derive(file.read_bytes(), file.name, "dry"))
    for model in (program.model, program.integrated.system.model):
        with pytest.raises(AssertionError, match="late: derived after the program was made"):
            model.symbols.new("late")
        with pytest.raises(AssertionError, match="late"):
            model.slots.derive("late", 1 / (model.masses[0] + 17))
        with pytest.raises(AssertionError, match="a corner after the program"):
            model.symbols.switches.side("", model.q[0] - 17)
