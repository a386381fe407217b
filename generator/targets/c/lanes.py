"""The C of runs side by side: which kernels and templates it is made of (rk4 in the reduced formulation)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels.laws import law_kernels
from gudgeon.generator.solvers.contact_slopes import in_place, unlatched
from gudgeon.generator.targets.c import lanes_printer
from gudgeon.generator.targets.c.play import has_transition, lines
from gudgeon.generator.targets.c.time_loops import deepest

MAIN = "lanes.c"
_GUARDED = {
    contact.n_x: "pick(e > 0.0, e_x * inverse_e, all_of(1.0))",
    contact.n_y: "pick(e > 0.0, e_y * inverse_e, all_of(0.0))",
}  # fmt: skip
_WANTED = ("closures", "closure_rates", "reduced_dynamics", "closing_step")


def has_lanes(model: Model) -> bool:
    """Where friction may stick, rows come and go by run: these scenes are run one by one."""
    return not model.frictions


def lanes_code(
    model: Model, kernels: Sequence[Kernel], counts: Mapping[str, int], render: Callable[..., str]
) -> dict[str, str]:
    """The files; `kernels` as the single runs have them, before sines are put side by side."""
    pins = [_pin(model, clearance, render) for clearance in model.clearances]
    motions = [lanes_printer.motion_kernel(kernel) for kernel in kernels if kernel.name in _WANTED]
    parameters = [entry.symbol.name for entry in model.slots.entries.values()]
    parameters += [symbol.name for symbol in model.slots.derived]
    functions, of_two = lanes_printer.FUNCTIONS, lanes_printer.FUNCTIONS_OF_TWO
    return {
        "lanes.h": render(
            "batch/lanes.h.jinja", functions=functions, functions_of_two=of_two, vector="Lanes", bits="LaneBits",
            given="angle", overflows=any("lanes_finite_slope(" in motion for motion in motions),
        ),
        MAIN: render(
            "batch/lanes.c.jinja", **counts, parameters=parameters, kernels="\n".join([*pins, *motions]),
            deepest=_deepest(model),
        ),
    }  # fmt: skip


def _deepest(model: Model) -> list[str]:
    """As run.c has it: a tenth of each bearing's radius."""
    values = [in_place(model, deepest(clearance)) for clearance in model.clearances]
    return [lanes_printer.expression(value) for value in values] or ["all_of(0.0)"]


def _pin(model: Model, clearance: Clearance, render: Callable[..., str]) -> str:
    """Law functions, then the joint's own."""
    name, film, dry = clearance.name, clearance.film, clearance.normal is not None

    def text(steps: Sequence[contact.Step]) -> str:
        return lines(model, steps, name, _GUARDED, lanes_printer.statement)

    parts: dict[str, Any] = {"before_dry": "", "after_dry": "", "before_film": "", "after_film": "", "share": ""}
    if dry:
        parts["before_dry"] = text([unlatched(step) for step in contact.before_dry(clearance)])
        parts["after_dry"] = text(contact.after_dry())
    if film is not None:
        parts["before_film"] = text(contact.before_film(clearance, film))
        parts["after_film"] = text(contact.after_film(film))
    if has_transition(clearance):
        parts["share"] = text([contact.blend(clearance, closed=True)])
    laws = [lanes_printer.kernel(kernel) for kernel in law_kernels(model, clearance)]
    pin = render(
        "batch/lane_pin.c.jinja", joint=name, dry=dry, film=film is not None, gap=text(contact.gap(clearance)),
        ratio_name="unclipped" if clearance.clip_ratio else "ratio", **parts,
    )  # fmt: skip
    return "\n".join([*laws, pin])
