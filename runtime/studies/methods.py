"""Which methods `gudgeon bench` measures in a scene, and why others are left out."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase
from importlib.util import find_spec

from gudgeon.contract.methods import CHOOSING, INTEGRATORS, STAGED
from gudgeon.errors import BadValueError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.integrators.peers.sundials_steppers import INSTALL
from gudgeon.language.wanted import listed
from gudgeon.simulation.simulation import Simulation

ADAPTIVE = (*CHOOSING, "auto")


def adaptive(simulation: Simulation) -> bool:
    """Whether a method that chooses its step fits a scene."""
    return bool(set(CHOOSING) & set(simulation.source.methods))


def choice(simulation: Simulation, wanted: Sequence[str] | None, quick: bool) -> tuple[list[str], list[str]]:
    """Methods that fit a scene, of those wanted (names, or patterns such as "scipy:*"), and why others are left out.

    By default all; with `quick` without the cross-checks, which take long. BadValueError for a name that is none.
    """
    own = (*(name for name in INTEGRATORS if name not in CHOOSING), *ADAPTIVE)
    every = (*own, *python_driver.NAMES)
    usual = own if quick else every
    wanted = usual if wanted is None else listed(wanted, "methods", str, "a list of names of methods")
    named = [m for m in every if any(fnmatchcase(m, text) for text in wanted)]
    for text in wanted:
        if not any(fnmatchcase(method, text) for method in every):
            raise BadValueError(f"method {text!r}: expected some of {', '.join(every)}, or a pattern such as 'scipy:*'")
    reason = python_driver.unfit(simulation.source)
    found, left_out = [], []
    for method in named:
        package = method.partition(":")[0]
        source, asked = simulation.source, method in STAGED and wanted is not usual
        there = (*source.methods, *(STAGED if asked and not source.no_slopes else ()))
        fits = method in there if method in CHOOSING else adaptive(simulation)
        if method in ADAPTIVE and not fits:
            continue
        if method in python_driver.NAMES and reason:
            left_out.append(f"{package}:* left out: {reason}")
        elif method in python_driver.SUNDIALS and find_spec("sksundae") is None:
            left_out.append(f"sundials:* left out: scikit-sundae is not installed ({INSTALL})")
        else:
            found.append(method)
    if not found:
        told = list(dict.fromkeys(left_out)) or [f"scene {simulation.source.scene!r} takes a fixed step only: rk4"]
        raise BadValueError("none of the methods fits", hint="; ".join(told))
    return found, list(dict.fromkeys(left_out))
