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
    staged: bool = False  # its stages are found together; a library has it where there is a film, or somebody asked


METHODS = (
    Method("rk4", "s", fixed=True),
    Method("dop853", "o"),
    Method("dopri5", "d"),
    Method("rodas5p", "^", slopes=True),
    Method("radau5", "v", slopes=True, staged=True),
    Method("radau9", ">", slopes=True, staged=True),
    Method("taylor", "*", smooth=True),
)
SMOOTH = tuple(method.name for method in METHODS if method.smooth)
STAGED = tuple(method.name for method in METHODS if method.staged)
INTEGRATORS = tuple(method.name for method in METHODS if not (method.smooth or method.staged))  # every library's
ON_DEMAND = (*SMOOTH, *STAGED)  # for which a scene may be derived once more
CHOOSING = tuple(method.name for method in METHODS if not method.fixed and not method.smooth)  # their step
EXPLICIT, STIFF = "dop853", "rodas5p"  # what `auto` chooses from as it goes; stiff ones of films: STAGED
FINE = 3e-7  # tolerances below it are for the second of STAGED
ADAPTIVE = "adaptive"  # a name of ours for that
KINEMATIC = "kinematic"  # follows the rows where no freedom is left
STAGES = "stages"  # the reduced formulation with what STAGED need
NEED_SLOPES = (*(method.name for method in METHODS if method.slopes), ADAPTIVE)
OFFERED = ("auto", *CHOOSING, *SMOOTH, *(method.name for method in METHODS if method.fixed))  # to integrate
