"""Taylor series of the motion in coordinates of a tree: which scenes have them, and why others do not."""

from __future__ import annotations

from gudgeon.errors import BadValueError
from gudgeon.generator.ir.series import Series, series_of
from gudgeon.generator.ir.series_rules import NoSeries
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kernels.reduced import DYNAMICS

NAME = "taylor"


def taylor_series(program: Program) -> Series:
    """Of accelerations and powers. Raises BadValueError where the motion is not smooth."""
    try:
        return _series(program)
    except NoSeries as why:
        raise BadValueError(f"method 'taylor' is for smooth motion: {why}", hint="use auto") from None


def _series(program: Program) -> Series:
    model, tree = program.model, program.tree
    if tree is None or not program.integrates:
        raise NoSeries("nothing is integrated in coordinates of a tree")
    if model.clearances:
        raise NoSeries(f"joint {model.clearances[0].name} has play, whose contacts come and go")
    if model.frictions:
        raise NoSeries(f"the friction of {model.frictions[0].name} may stick")
    if tree.chains:
        raise NoSeries("drives lead a chain of bodies through a loop of its own")
    if model.symbols.switches.count or program.integrated.system.model.symbols.switches.count:
        raise NoSeries("an expression has corners (where, abs, min, max, sign, mod, ramp)")
    if program.integrated.jumps:
        raise NoSeries("the rate of a drive may jump")
    dynamics = next(kernel for kernel in tree.plain if kernel.name == DYNAMICS)
    return series_of(dynamics, _place, NAME)


def _place(target: str) -> str:
    """Where a result goes: what other functions tell of a state nobody wants here."""
    return target.removeprefix("aside->") if target.startswith(("a[", "aside->power[")) else ""
