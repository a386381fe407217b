"""Defines the interface of a force law: its parameters, its equations, its source and the limits of its use.

Each other file of this folder is one law and exports `LAW`.

Law files import no SymPy at the top: reading a YAML file needs a law's parameters and options, not its equations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from gudgeon.errors import BadValueError
from gudgeon.generator.field import NUMBER, RELATIONS, Field
from gudgeon.generator.kinds import iterate_declarations


@dataclass(frozen=True)
class PairSymbols:
    """Contain the symbols of journal j in bearing i: radii R_i, R_j, radial clearance c, length L, E and ν.

    For a slider's corner at a wall of its guide: R_i = ∞, R_j is the corner's radius, c the gap; there is no L.
    """

    R_i: Any
    R_j: Any
    c: Any
    L: Any
    E_i: Any
    nu_i: Any
    E_j: Any
    nu_j: Any


@dataclass(frozen=True)
class LawInputs:
    """Contain the arguments of a law's `build`: its parameters, the pair, and the variables of its role.

    `derive(name, expression, meaning)` returns the symbol of a constant that is computed once a run;
    `keep_unevaluated(x)` keeps SymPy from expanding x (symbols/unevaluated.py).
    """

    parameters: Mapping[str, Any]
    options: Mapping[str, str | bool]
    pair: PairSymbols
    variables: Mapping[str, Any]
    derive: Callable[[str, Any, str], Any]
    keep_unevaluated: Callable[[Any], Any] = lambda x: x


# The variables of the laws of a role.
VARIABLES: Mapping[str, tuple[str, ...]] = {
    "normal": ("delta", "ratio"),  # δ > 0 (m), δ̇/δ̇⁻
    "friction": ("F_n", "v_t"),  # normal force (N), slip (m/s)
    "film": ("epsilon", "w_n", "w_t"),  # ε < 1, effective squeeze velocity over c (1/s)
    "mixed": ("delta",),  # δ > 0 (m)
}
# Further variables of the role that a law may read.
OPTIONAL_VARIABLES: Mapping[str, tuple[str, ...]] = {"normal": ("deltadot",)}  # δ̇ (m/s)
CONSTRAINT_VARIABLES = (
    "held_force",
)  # N, a law of rigid surfaces reads it instead: the constraint force that keeps e = c
RESULTS: Mapping[str, tuple[str, ...]] = {
    "normal": ("F_n",),
    "friction": ("F_t",),
    "film": ("F_r", "F_t", "T0"),
    "mixed": ("share",),  # of the dry contact: 0 at δ = 0, never falling, 1 where no film is left
}
# Constant that a mixed law may derive: the film's clearance, between the mean surfaces.
MEAN_CLEARANCE = "mean_clearance"
# Constant that a normal law may derive: the penetration (m) beyond which it is not valid and a run stops.
MAX_PENETRATION = "deepest"
# Constant that a law with an internal state may derive: the deflection (m) at which its friction slides. It scales
# errors of the state; without it the lengths of the linkage scale them.
BREAKAWAY = "breakaway"
# Fraction of the clearance at which a force that is not a power law has the stiffness for the default step.
SECANT_DEPTH = 0.05


@dataclass(frozen=True)
class State:
    """Declare an internal state of a law, a length (m), 0 at each onset and integrated while in contact.

    `build` reads it as a variable of that name and returns its rate (m/s) as `<name>_rate`.
    """

    name: str
    meaning: str


@dataclass(frozen=True)
class Limits:
    """Contain the numerical limits of a film law's validity, with which a run's report compares the run."""

    l_over_d: tuple[float, float] = (0.0, math.inf)
    epsilon: float = 1.0
    slow_squeeze: bool = False  # whether it follows its film only for |ω_s| ≫ |ε̇|


@dataclass(frozen=True)
class Law:
    """Declare a force law. `build(inputs: LawInputs)` returns the RESULTS of its role by name, in SymPy.

    Local abbreviations precede them under their own names, in the order of use.
    """

    name: str
    role: str  # "normal", "friction", "film" or "mixed": the key under a contact in the YAML
    title: str
    source: str
    validity: str  # limits of its use, clauses with "; " between them
    fields: tuple[Field, ...]  # the keys in addition to `law`
    build: Callable[..., Any]
    states: tuple[State, ...] = ()
    also: Mapping[str, Mapping[str, str]] = field(default_factory=dict)  # aliases -> the options that they fix
    instead: Mapping[str, str] = field(
        default_factory=dict
    )  # option -> number: the option has an effect only without the number
    equation: tuple[str, ...] = ()  # LaTeX, a line each: the law as its source writes it, for docs/laws.md
    reference: str = ""  # the verified source: author, title, journal, year, doi
    limits: Limits = Limits()  # of a film
    properties: str = ""  # what the law does, clauses with "; " between them
    in_hole: bool = False  # only for a pin in a hole: the law reads the radial clearance or the length of the pin
    rigid: bool = False  # rigid surfaces: impacts, and contacts that are constraints (engine/run/impacts.c)

    @property
    def variables(self) -> tuple[str, ...]:
        """Return the names of the variables of `build`: those of its role, those outside it, internal states."""
        return (*VARIABLES[self.role], *self.optional_variables, *(state.name for state in self.states))

    @property
    def optional_variables(self) -> tuple[str, ...]:
        """Return the variables that `build` may read in addition to those of its role."""
        return CONSTRAINT_VARIABLES if self.rigid else OPTIONAL_VARIABLES.get(self.role, ())

    @property
    def results(self) -> tuple[str, ...]:
        """Return the names of the results of `build`: those of its role, then rates of internal states."""
        return (*RESULTS[self.role], *(f"{state.name}_rate" for state in self.states))

    @property
    def parameters(self) -> tuple[Field, ...]:
        """Return the law's numbers: run-time parameters `contacts.<contact>.<role>.<name>`."""
        return tuple(law_field for law_field in self.fields if law_field.kind == NUMBER)

    @property
    def expressions(self) -> tuple[Field, ...]:
        """Return the law's keys that are expressions of a variable and thus no run-time parameters."""
        return tuple(law_field for law_field in self.parameters if law_field.varies)

    @property
    def options(self) -> tuple[Field, ...]:
        """Return the law's structural options: words, and flags with the values False and True."""
        return tuple(law_field for law_field in self.fields if law_field.kind != NUMBER)

    def check_bounds(self, values: Mapping[str, float]) -> None:
        """Raise BadValueError for a value outside the law's bounds; `values` maps keys of the law to numbers.

        A bound by another key that is missing in `values` is not checked.
        """
        for field_of_law in self.fields:
            for bound in field_of_law.bounds if field_of_law.name in values else ():
                value, limit = values[field_of_law.name], values.get(bound.limit, bound.limit)  # type: ignore[arg-type]
                if not isinstance(limit, str) and not RELATIONS[bound.relation](value, limit):
                    hint = f"expected {bound.relation} {bound.limit} ({field_of_law.meaning})"
                    raise BadValueError(f"{field_of_law.name} is {value:g}: {hint}")

    def list_fields_of_name(self, name: str) -> tuple[Field, ...]:
        """Return the keys of the law under one of its names, its own or an alias (`also`).

        An alias fixes some options, which are left out, and requires the restitution. Raises KeyError for an unknown
        name.
        """
        if name == self.name:
            return self.fields
        return tuple(
            replace(field_of_law, default=None, required=True) if field_of_law.name == "restitution" else field_of_law
            for field_of_law in self.fields
            if field_of_law.name not in self.also[name]
        )


USER_LAWS: dict[str, Law] = {}  # user-defined laws (registered.py)


@cache
def find_bundled_laws() -> Mapping[str, Law]:
    """Return the laws in this folder by name; the files are imported once."""
    return {law.name: law for law in iterate_declarations("gudgeon.generator.kinds.laws", "LAW", Law)}


def find_all_laws() -> Mapping[str, Law]:
    """Return all laws by name: those in this folder and user-defined ones."""
    return {**find_bundled_laws(), **USER_LAWS}


def find_laws_of_role(role: str) -> Mapping[str, Law]:
    """Return the laws of a role by each of their names and aliases: bundled laws first, then user-defined ones."""
    laws_by_name: dict[str, Law] = {}
    for laws_of_source in (find_bundled_laws(), USER_LAWS):
        laws_of_role = {law.name: law for law in laws_of_source.values() if law.role == role}
        laws_by_name |= laws_of_role | {name: law for law in laws_of_role.values() for name in law.also}
    return laws_by_name
