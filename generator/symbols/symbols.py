"""The symbols of a model: one C name each, where the name lives, and how it is differentiated.

A derived symbol (`cos_theta_L7`, the arm `arm_L7_head_x`, a drive's `crank1_angle`) stands for an
expression and knows its derivatives. Differentiation goes by the chain rule over these symbols, so
that Φ_q and γ come out in the words of the geometry and need no search for common subexpressions.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from functools import cache

import sympy as sp

from gudgeon.generator.kinds.laws.law import house
from gudgeon.generator.symbols.corners import Switches
from gudgeon.generator.symbols.derivatives import derivative, symbols_of
from gudgeon.language.names import NOT_IN_CODE

# What emitted code itself calls its functions, arguments and locals (tests/targets_c/test_names_in_c.py finds them).
_WORDS = """
t q v y p g f b x a dy phi nu gamma e nx ny tx ty out given is_given latch memory pivot status scale aside
delta deltadot ratio F_n F_t v_t epsilon w_n w_t root W factor rows force rhs powers dependent
reactions torques series max_of min_of sign_of solve_dependent errno stdin stdout stderr signgam
side side_of
r Four FourBits sines_and_cosines many_sines_and_cosines turned_by_library
expand reduce_state reduce_accelerations solve_by_absolute all_q all_v all_a s s_rate whole closure
e_x e_y de_x de_y de_t omega_i omega_j n_x n_y stored a_i a_j share F_r T0 F_x F_y F_along_n F_along_t M_i M_j
theta_i beta_i u_x u_y worn worn_slope worn_bend beta_rate slant steep F_N F_e de_n across lean by_angle
eta eta_row eta_stick lin r s u x depth unclipped dF value slope film
close_step arrive step rates worst factor_block solve_block
Lanes LaneBits LaneParameters LaneRun LaneAside LaneLatch LanePinForce LaneClearance all_of any_of pick rare
chain_step chain_rates chain_third chain_corners chain_directions row most bend
finite_slope just_ahead just_behind
sine_of cosine_of asine_of exp_of log_of power_of
"""
_TAKEN = (NOT_IN_CODE - {"time"}).union(_WORDS.split())  # each model has a symbol of that name first: t


@cache
def _letters() -> frozenset[str]:
    """What the laws of the house call what they are given and what they give: their functions' own names."""
    return frozenset(name for law in house().values() for name in (*law.variables, *law.results))


# Object-like macros of the C and Python headers: most have no small letter; `A_K` is short for the K of joint A.
_MACRO = re.compile(
    r"M_E|METH_O|[A-Z0-9]+_H|(?![A-Z0-9]+_[A-Z]$)[A-Z0-9_]+|N_[A-Z]|Py[A-Z_]\w*"
    r"|M_(1_PI|2_PI|2_SQRT|E|LN|LOG|PI|SQRT)\w*|(PRI|SCN)[dioux]\w*|[LP]_(ctermid|cuserid|tmp)\w*"
    r"|(sa|si|st|sched|math)_\w+"
)
# Functions that are called where a parameter of that name is a local; parts of a clearance joint's force.
_FUNCTION = re.compile(
    r"(angles|sines|cosines)_(\d+|of(_\d+)?)|(clearance|tangent)_\w+|\w*newton_substitute|side_\d+|lanes_\w+"
    r"|(F_along_[nt]|M_[ij])_(dry|film)"
)


def is_in_code(name: str) -> bool:
    """Whether emitted C has a name for something of its own; short ones in capitals, K or S, are nobody's macros."""
    macro = len(name) > 2 and _MACRO.fullmatch(name)
    return bool(name in _TAKEN or macro or _FUNCTION.fullmatch(name))


@dataclass(frozen=True)
class SymbolInfo:
    """`home` is the C text that reads the symbol; empty for a local of its kernel."""

    home: str
    meaning: str
    unit: str


class Symbols:
    """All the symbols of one model, in the order in which they were made."""

    def __init__(self, letters: Collection[str] = ()) -> None:
        """`letters`: what the laws of the scene that are the user's own call their variables and abbreviations."""
        self.info: dict[sp.Symbol, SymbolInfo] = {}
        self.definitions: dict[sp.Symbol, sp.Expr] = {}
        self.rules: dict[sp.Symbol, dict[sp.Symbol, sp.Expr]] = {}
        self.switches = Switches()
        self._names: set[str] = set()
        self._letters = frozenset(letters)
        self._shared: Symbols | None = None  # who else has the members of Parameters
        self._frozen = False
        self._numbered: dict[str, str] = {}  # names that others had before: what was wanted

    def freeze(self, frozen: bool = True) -> None:
        """From now on no name is new (a defect of the generator), nor any corner; or, thawed, they may be again."""
        self._frozen = self.switches.frozen = frozen

    def beside(self) -> Symbols:
        """Other symbols for other functions of the same library: they share the members of Parameters only."""
        other = Symbols(self._letters)
        other._shared, other.switches = self, self.switches.beside()
        for symbol, info in self.info.items():
            if info.home.startswith("p->"):
                other.adopt(symbol)
        return other

    def adopt(self, symbol: sp.Symbol) -> None:
        """Takes over a member of Parameters that was made on the other side."""
        if self._shared is not None and symbol not in self.info:
            self.info[symbol] = self._shared.info[symbol]
            self._names.add(symbol.name)
            if symbol in self._shared.definitions:
                self.definitions[symbol] = self._shared.definitions[symbol]

    def unique(self, wanted: str) -> str:
        """`wanted` as a C identifier that nothing else has."""
        assert not self._frozen, f"{wanted}: derived after the program was made"
        name = re.sub(r"\W", "_", wanted)
        taken = name in _TAKEN or name in _letters() or name in self._letters
        if taken or _MACRO.fullmatch(name) or _FUNCTION.fullmatch(name):
            name = f"par_{name}"
        candidate, count = name, 1
        while candidate in self._names:
            count += 1
            candidate = f"{name}_{count}"
        self._names.add(candidate)
        if count > 1:
            self._numbered[candidate] = name
        return candidate

    def shorter(self, used: Collection[str]) -> dict[str, str]:
        """What names that bear a number are called in a function that uses these: without it, or with the least."""
        own = [name for name in used if not self._home(name).startswith("p->")]
        numbered = sorted((name for name in own if name in self._numbered), key=lambda name: (len(name), name))
        taken = {*own} - {*numbered}
        found: dict[str, str] = {}
        for name in numbered:
            base = self._numbered[name]
            free = base not in taken and not self._is_member(base)
            found[name] = base if free else next(
                called for k in range(2, len(used) + 3) if (called := f"{base}_{k}") not in taken
            )  # fmt: skip
            taken.add(found[name])
        return {name: called for name, called in found.items() if name != called}

    def _is_member(self, name: str) -> bool:
        """Whether a number of the run has this name: the same one for something else would mislead."""
        return self._home(name) == f"p->{name}"

    def _home(self, name: str) -> str:
        info = self.info.get(sp.Symbol(name, real=True))
        return info.home if info else ""

    def new(
        self, wanted: str, home: str = "", meaning: str = "", unit: str = "", shown: str = ""
    ) -> sp.Symbol:  # fmt: skip
        """A new real symbol; `{}` in `home` stands for the C name that it gets: `shown`, or its own.

        Its own name is what terms are put in order by.
        """
        shared = self._shared if home.startswith("p->") else None
        name, called = (self._unshared(text, shared) if text else "" for text in (wanted, shown))
        symbol = sp.Symbol(name, real=True)
        self.info[symbol] = SymbolInfo(home.replace("{}", called or name), meaning, unit)
        if shared is not None:
            shared.info[symbol] = self.info[symbol]
        return symbol

    def _unshared(self, wanted: str, shared: Symbols | None) -> str:
        """A name that is new on the other side too."""
        name = self.unique(wanted)
        while shared is not None and name in shared._names:
            name = self.unique(wanted)
        if shared is not None:
            shared._names.add(name)
        return name

    def define(
        self, wanted: str, expression: sp.Expr, home: str = "", meaning: str = "", unit: str = "", shown: str = ""
    ) -> sp.Symbol:  # fmt: skip
        """A new symbol that stands for `expression`."""
        symbol = self.new(wanted, home, meaning, unit, shown)
        self.definitions[symbol] = expression
        if self._shared is not None and home.startswith("p->"):
            self._shared.definitions[symbol] = expression
        return symbol

    def diff(self, expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """d expression / d by, through the derived symbols."""
        total = sp.Integer(0)
        for symbol in sorted(symbols_of(expression), key=lambda s: s.name):
            inner = sp.Integer(1) if symbol == by else self.rules.get(symbol, {}).get(by)
            if inner is not None:
                total += derivative(expression, symbol) * inner
        return total

    def written_out(self, expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """The same through definitions, for a symbol that rules do not name: a rate that a drive prescribes."""
        total = sp.Integer(0)
        for symbol in sorted(symbols_of(expression), key=lambda s: s.name):
            known = symbol != by and symbol in self.definitions
            inner = self.written_out(self.definitions[symbol], by) if known else sp.Integer(symbol == by)
            if inner != 0:
                total += derivative(expression, symbol) * inner
        return total

    def explicit(self, expression: sp.Expr) -> sp.Expr:
        """`expression` with every derived symbol written out."""
        while found := {s: self.definitions[s] for s in expression.free_symbols if s in self.definitions}:
            expression = expression.xreplace(found)
        return expression
