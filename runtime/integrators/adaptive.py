"""Methods that choose their step, with located events and projection (engine/methods/adaptive.c).

- `dop853`: explicit, order 8, dense output of order 7 (E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary
  Differential Equations I, 1993, section II.5).
- `dopri5`: explicit, order 5, dense output of order 4 (J. R. Dormand, P. J. Prince, 1980; engine/both/runge_kutta.h).
- `rodas5p`: Rosenbrock, order 5, L-stable, exact Jacobian, dense output of order 4 (G. Steinebach, BIT 63:27, 2023).
- `taylor`: the motion's own series, of an order by the tolerance, for smooth motion (engine/methods/taylor.c).
- `radau5`, `radau9`: Radau IIA of orders 5 and 9, L-stable, exact Jacobian, dense output of order 4
  (engine/both/radau.h).
- `auto`: the explicit one and a stiff one, by what the steps measure: explicit until h ρ(J) reaches its bound of
  stability for some steps, stiff until h ρ(J) is so small that the explicit method would need no more steps. The stiff
  one is `rodas5p`, in a scene with films `radau5`, at tolerances below FINE `radau9`: a film's force bends so much with
  the journal's place that a method which is linear in each step has to take many.

The error of a step is controlled component by component: lengths to rtol · L, angles to rtol · L/S, velocities
to rtol times the largest speed of their kind so far. S is the mechanism's size; L is S in a scene without play
and the smallest radial clearance in a scene with play, since what happens in the play decides the motion.
A film's force follows the journal's speed in its bearing, L/S of the links' speeds: where there is a film, rtol of
velocities is FELT_BY_FILMS · L/S at most, or their errors throw the journal about and steps are lost on that.
The force itself is looked at, too: Newton's iterations of `radau5` and `radau9` end once no film's force changes by
more than FORCE_FOUND · rtol of it, and between the ends of steps motion is the collocation polynomial, whose
accelerations do not magnify errors of velocities.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import angles
from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.contract.methods import ADAPTIVE, CHOOSING, EXPLICIT, FINE, KINEMATIC, STAGED, STIFF
from gudgeon.errors import BadValueError, InputError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import number
from gudgeon.model.sizes import mechanism_sizes

RTOL = 1e-8  # of a plain run
FELT_BY_FILMS = 0.015  # share of the speeds within a film that an error of velocities may be
SMALLEST = 1e-14  # rounding would be controlled below it


def tolerance(rtol: float | str | None, method: str, fixed: bool) -> float:
    """The tolerance of a step. Raises BadValueError for one that is none, or that nobody would look at."""
    if rtol is None:
        return RTOL
    if method == "rk4" or (fixed and method != "kinematic"):
        raise BadValueError(
            f"method {method!r} with a fixed step has no tolerance",
            hint=f"leave out rtol; or leave out step and take {', '.join(('auto', *CHOOSING))}",
        )
    try:
        value = number(rtol, Slot("rtol", "", 0.0, False, (0, 0, 0)))
    except InputError:
        value = math.nan
    if not SMALLEST <= value < 1.0:
        told = f"{value:g}" if math.isfinite(value) else repr(rtol)
        raise BadValueError(
            f"rtol is {told}: expected a share from {SMALLEST:g} to 1, such as 1e-8",
            hint="below that rounding would be controlled" if 0.0 < value < 1.0 else "",
        )
    return value


def stiff_of(source: KernelSource, rtol: float) -> str:
    """The stiff method of `auto`."""
    return STAGED[rtol < FINE] if source.stages and _has_film(source) else STIFF


def begins_with(source: KernelSource, rtol: float = RTOL) -> str:
    """The first method of `auto`: a film is stiff from rest on (physics.md, section 4)."""
    if KINEMATIC in source.methods:
        return KINEMATIC
    return stiff_of(source, rtol) if _has_film(source) and not source.explicit else EXPLICIT


def _has_film(source: KernelSource) -> bool:
    return any(joint.film for joint in source.clearances)


def choice_of(compiled: CompiledModel, method: str, rtol: float) -> tuple[int, int]:
    """For gudgeon_adaptive_setup: C's numbers of the method that begins, and of the stiff one that it may change to;

    0: it may not change.
    """
    if method != ADAPTIVE:
        return int(compiled.lib.gudgeon_method(method.encode())), 0
    names = begins_with(compiled.source, rtol), stiff_of(compiled.source, rtol)
    first, stiff = (int(compiled.lib.gudgeon_method(name.encode())) for name in names)
    return first, stiff


def lengths(compiled: CompiledModel, p: Array) -> tuple[Array, Array]:
    """L and S of the module's text (m), (...)."""
    size = mechanism_sizes(compiled.source, p)
    play = p[..., [joint.clearance for joint in compiled.source.clearances]]
    least = np.where(play > 0.0, play, np.inf).min(axis=-1, initial=np.inf)
    return np.where(np.isfinite(least), least, size), size


def integrated_angles(source: KernelSource) -> NDArray[np.bool_]:
    """Which coordinates of what is integrated are angles, (n_x,)."""
    if source.formulation == "reduced":  # a tree's angles have the names of bodies, its slides "guide.slide", "L3.x"
        return np.array(["." not in name for name in source.tree], dtype=bool)
    return angles(source)


def tolerances(compiled: CompiledModel, p: Array, rtol: float) -> tuple[Array, Array]:
    """Tolerances of a step, (..., 2 n_x): of coordinates, of velocities a unit of speed; L and L/S, (..., 2).

    `p` (..., n_slots + n_derived) has the parameters of one run, or of several.
    """
    source = compiled.source
    length, size = lengths(compiled, p)
    is_angle = integrated_angles(source)
    of_q = rtol * np.where(is_angle, (length / size)[..., None], length[..., None])
    of_v = np.minimum(rtol, FELT_BY_FILMS * length / size if _has_film(source) else rtol)
    of_speed = np.broadcast_to(of_v[..., None], of_q.shape)
    return np.concatenate([of_q, of_speed], axis=-1), np.stack([length, length / size], axis=-1)
