"""The integrators in C: each is declared once here and, if it chooses its step, once in engine/methods/methods.c.

What the steps of a method are is C's own; here is what the rest asks: names, what they take, how they are drawn.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Method:
    """An integrator by the name that a user gives it; `marker` is its own in the picture of `gudgeon bench`."""

    name: str
    marker: str
    fixed: bool = False  # it takes a `step`, and no tolerance
    slopes: bool = False  # it takes the Jacobian: a force needs a finite slope everywhere
    smooth: bool = False  # for smooth motion alone; a library has it where somebody asked for it


METHODS = (
    Method("rk4", "s", fixed=True),
    Method("dop853", "o"),
    Method("rodas5p", "^", slopes=True),
    Method("radau5", "v", slopes=True),
    Method("radau9", ">", slopes=True),
    Method("taylor", "*", smooth=True),
)  # fmt: skip
SMOOTH = tuple(method.name for method in METHODS if method.smooth)
INTEGRATORS = tuple(method.name for method in METHODS if not method.smooth)  # that every library has
CHOOSING = tuple(method.name for method in METHODS if not method.fixed and not method.smooth)  # their step
AUTO = ("dop853", "rodas5p")  # what `auto` chooses from as it goes: the explicit one, the stiff one
ADAPTIVE = "adaptive"  # a name of ours for that
KINEMATIC = "kinematic"  # follows the rows where no freedom is left
NEED_SLOPES = (*(method.name for method in METHODS if method.slopes), ADAPTIVE)
OFFERED = ("auto", *CHOOSING, *SMOOTH, *(method.name for method in METHODS if method.fixed))  # to integrate
