"""The C of runs side by side: which kernels and templates it is made of (rk4 in the reduced formulation)."""

from __future__ import annotations

from collections.abc import Callable

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.solvers.contact_slopes import in_place
from gudgeon.generator.targets.c import lanes_printer
from gudgeon.generator.targets.c.curves import curves_code
from gudgeon.generator.targets.c.model_header import deepest
from gudgeon.generator.targets.c.play import braced, call_of_film, calls_of_dry

MAIN = "lanes.c"
_WANTED = ("closures", "closure_rates", "reduced_dynamics", "closing_step")


def lanes_code(program: Program, render: Callable[..., str]) -> dict[str, str]:
    """The file: kernels as the single runs have them, before sines are put side by side."""
    assert program.tree and program.methods
    model = program.model
    pins = [*map(lanes_printer.kernel, program.laws), *(_pin(pin, render, model.law_states) for pin in program.pins)]
    kernels = (*program.tree.plain, program.methods.plain_closing)
    wanted = [kernel for kernel in kernels if kernel.name in _WANTED]
    parameters = [model.slots.field(symbol) for symbol in model.slots.members()]
    text = "\n".join([*pins, *map(lanes_printer.motion_kernel, wanted)])
    curves = bool(curves_code(model.scene.mechanism.curves, (text,)))
    return {MAIN: render("lanes.c.jinja", parameters=parameters, deepest=_deepest(model), kernels=text, curves=curves)}


def _deepest(model: Model) -> list[str]:
    """As model.h has it."""
    return [lanes_printer.expression(in_place(model, deepest(clearance))) for clearance in model.clearances]


def _pin(pin: Pin, render: Callable[..., str], states: int) -> str:
    """What happens round the laws of a joint; `states` of laws are as many for each."""
    clearance = pin.clearance
    steps = ("gap", "before_dry", "after_dry", "before_film", "after_film", "share")
    parts = {name: lanes_printer.statements(getattr(pin, name)) for name in steps}
    if clearance.normal is not None:
        parts["dry_law"] = calls_of_dry(pin, "lanes_max_of(delta, all_of(0.0))", "Lanes", sides=False)
    if clearance.film is not None:
        parts["film_law"] = call_of_film(pin, "Lanes", sides=False)
    return render(
        "play/lane_pin.c.jinja", joint=clearance.name, dry=clearance.normal is not None,
        film=clearance.film is not None, ratio_name="unclipped" if clearance.clip_ratio else "ratio",
        rates=braced("rate", clearance, states, "all_of(0.0)"), still=braced("", clearance, states, "all_of(0.0)"),
        states=states, **parts,
    )  # fmt: skip
