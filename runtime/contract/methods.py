"""Declare the integration methods that are written in C; engine/methods/methods.c also lists the adaptive ones."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Method:
    """Describe an integrator by its public name; `marker` is its symbol in plots of `gudgeon bench`."""

    name: str
    marker: str
    fixed: bool = False  # whether it has a fixed `step` and no tolerance
    slopes: bool = False  # whether it uses the Jacobian, so that forces need finite slopes
    smooth: bool = False  # for smooth motion only; a library has it only on request
    lanes: bool = False  # whether runs go side by side in vector lanes (`lane_method` in engine/methods)
    staged: bool = False  # implicit stages solved together; a library has it with films, or on request


# all integrators in C
METHODS = (
    Method("rk4", "s", fixed=True, lanes=True),
    Method("dop853", "o", lanes=True),
    Method("dopri5", "d", lanes=True),
    Method("rodas5p", "^", slopes=True, lanes=True),
    Method("radau5", "v", slopes=True, lanes=True, staged=True),
    Method("radau9", ">", slopes=True, lanes=True, staged=True),
    Method("taylor", "*", smooth=True, lanes=True),
)
SMOOTH = tuple(method.name for method in METHODS if method.smooth)  # methods for smooth motion only
STAGED = tuple(method.name for method in METHODS if method.staged)  # methods whose stages are solved together
# methods that every library has
INTEGRATORS = tuple(method.name for method in METHODS if not (method.smooth or method.staged))
ON_DEMAND = (*SMOOTH, *STAGED)  # methods for which a scene may have to be derived again
# adaptive methods for any motion
STEP_CONTROLLED_METHODS = tuple(method.name for method in METHODS if not method.fixed and not method.smooth)
EXPLICIT, STIFF = "dop853", "rodas5p"  # methods between which `auto` switches; with films, the stiff one is from STAGED
TAYLOR = "taylor"  # method of `auto` instead of EXPLICIT where the motion is smooth and cheap to expand
FINE = 3e-7  # tolerance below which `auto` uses the second of STAGED
ADAPTIVE = "adaptive"  # internal name of the method that switches
KINEMATIC = "kinematic"  # method for linkages without degrees of freedom
IN_LANES = (*(method.name for method in METHODS if method.lanes), ADAPTIVE)  # methods that vector lanes have
STAGES = "stages"  # name of the reduced formulation with the matrices of STAGED
NEED_SLOPES = (*(method.name for method in METHODS if method.slopes), ADAPTIVE)  # methods that use the Jacobian
# methods that integrate, as command line and messages offer them
OFFERED = ("auto", *STEP_CONTROLLED_METHODS, *SMOOTH, *(method.name for method in METHODS if method.fixed))
