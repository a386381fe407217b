"""All is derived before any text: neither a model nor a program changes when it is printed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gudgeon.contract.methods import STAGES
from gudgeon.errors import BadValueError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.targets.c.emit import emit_scene
from gudgeon.generator.targets.latex import render_equations_text
from tests.slow import slow_but

MECHANISMS = Path(__file__).parents[2] / "mechanisms"
SCENES = [
    ("nine_bar_press", "lubricated", "reduced"),
    ("slider_crank", "dry", "full"),
    ("shaker", "ideal", "reduced"),
    ("nine_bar_press", "ideal", "full"),
    ("four_bar", "ideal", "reduced"),
]
# with play, with a Taylor series, with friction that may stick, without any freedom
ORDERS = [
    ("bouncing_ball", "damped"),
    ("pendulum", "ideal"),
    ("belt_block", "ideal"),
    ("four_bar", "ideal"),
    ("slider_crank", "dry"),
    ("shaker", "ideal"),
    ("slider_crank_spring", "ideal"),
]


def derived(name: str, scene: str) -> Model:
    """The model of a shipped scene, which nothing has printed yet."""
    file = MECHANISMS / f"{name}.yaml"
    return derive_scene(file.read_bytes(), file.name, scene)


def tables(model: Model) -> list[dict[str, Any]]:
    """Everything in a model that grew while it was derived, in its order."""
    owners = (model.symbols, model.symbols.switches, model.parameter_table, model.geometry, model.constraints)
    return [
        {name: [*value.items()] if hasattr(value, "items") else value for name, value in vars(owner).items()}
        for owner in owners
    ]


def printed(model: Model, what: str) -> Any:
    """Return what a target makes of the model, or why it does not."""
    if what == "equations":
        return render_equations_text(model)
    if what == "numpy":
        return model.numpy().source
    try:
        return generate_c(model, what)
    except BadValueError as why:
        return str(why)


@pytest.mark.parametrize("of", slow_but(ORDERS[:3], ORDERS), ids="-".join)
def test_no_text_depends_on_what_was_printed_before(of: tuple[str, str]) -> None:
    """Every target of one model, twice and in both orders, against those of models of which nothing else is printed."""
    targets = ("numpy", "taylor", "full", STAGES, "reduced", "equations")
    alone = {what: printed(derived(*of), what) for what in targets}
    model = derived(*of)
    before = tables(model)
    for what in (*targets, *reversed(targets)):
        assert printed(model, what) == alone[what], what
    assert tables(model) == before
    assert [slot.address for slot in alone["full"].parameters] == [slot.address for slot in alone["reduced"].parameters]
    assert [*model.parameter_table.entries] == [slot.address for slot in alone["reduced"].parameters]


def test_a_model_is_read_only() -> None:
    model = derived("pendulum", "ideal")
    for table in (
        model.parameter_table.entries,
        model.parameter_table.derived,
        model.symbols.info,
        model.symbols.derivative_rules,
    ):
        with pytest.raises(TypeError, match="does not support item assignment"):
            table["late"] = None  # type: ignore[assignment]
    with pytest.raises(AssertionError, match="late: derived after the tables were frozen"):
        model.symbols.add_symbol("late")
    with pytest.raises(AssertionError, match="late"):
        model.parameter_table.derive_parameter("late", 1 / (model.masses[0] + 17))
    with pytest.raises(AssertionError, match="a switching point after the tables were frozen"):
        model.symbols.switches.get_or_add_switch("", model.q[0] - 17)


@pytest.mark.parametrize("of", slow_but(SCENES[1:3], SCENES), ids="-".join)
def test_printing_derives_nothing(of: tuple[str, str, str]) -> None:
    """Slots and symbols are as many behind the print as before it, and the second print is the first one."""
    name, scene, formulation = of
    program = make_program(derived(name, scene), formulation)
    model, own = program.model, program.integrated.system.model
    before = [
        len(x)
        for x in (model.parameter_table.entries, model.parameter_table.derived, model.symbols.info, own.symbols.info)
    ]
    first = emit_scene(program)
    assert before == [
        len(x)
        for x in (model.parameter_table.entries, model.parameter_table.derived, model.symbols.info, own.symbols.info)
    ]
    assert emit_scene(program) == first


def test_what_is_derived_too_late_is_told() -> None:
    program = make_program(derived("slider_crank", "dry"))
    for model in (program.model, program.integrated.system.model):
        with pytest.raises(AssertionError, match="late: derived after the tables were frozen"):
            model.symbols.add_symbol("late")
        with pytest.raises(AssertionError, match="late"):
            model.parameter_table.derive_parameter("late", 1 / (model.masses[0] + 17))
        with pytest.raises(AssertionError, match="a switching point after the tables were frozen"):
            model.symbols.switches.get_or_add_switch("", model.q[0] - 17)
