"""A scene's equations as a Python module, and its functions for arrays."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import N_WORK
from gudgeon.errors import ArrayError, BadValueError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.start import apart_rows
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.statements import Guard
from gudgeon.generator.ir.values import Test, Threshold
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.numpy.curves import with_curves
from gudgeon.generator.targets.numpy.layout import WIDTH, docstring, remark
from gudgeon.generator.targets.numpy.play import CONTOUR, pin
from gudgeon.generator.targets.numpy.printer import function
from gudgeon.language.quantities import number_of_text
from gudgeon.language.suggestions import unknown, unknown_name
from gudgeon.language.wanted import mapping, number_of

Array = NDArray[np.float64]
_ABOUT = (
    "Its equations as functions, to be read: results go into the last arguments. Numbers are SI (m, kg, s, N, N*m), "
    "angles rad; t is the time. p has a field a number, in the order of prepare(), which fills it: beside each is its "
    "address in the file. q are the positions of the bodies' centres of mass and their angles, v are the rates of q:"
)


class _Doubles(SimpleNamespace):
    """Numbers that are divided as C divides them: by 0 there is no exception, for `where` may not pick the result."""

    def __setattr__(self, name: str, value: object) -> None:
        super().__setattr__(name, np.float64(value) if type(value) is float else value)


class ClosedLinkage:
    """Φ, Φ_q, ν, γ, M of the closed linkage (joints with play closed, redundant rows kept), in NumPy.

    `source` is the text of the functions; n coordinates, m rows. t in s, q (n,), v (n,) in m, rad and their rates;
    p is what `prepare` gives.
    """

    def __init__(self, model: Model) -> None:
        kernels = [closed_linkage.mass_kernel(model), *closed_linkage.row_kernels(model),
                   closed_linkage.start_kernel(model), closed_linkage.prepare_kernel(model)]  # fmt: skip
        self.model, self.n, self.m = model, len(model.q), len(model.all_rows)
        text = "\n\n\n".join(map(function, kernels)) + "\n"
        self.source = f"{_head(model)}\n\n\n{with_curves(model.scene.mechanism.curves, text)}{text}"
        self.functions = _defined(self.source)

    def prepare(self, given: Mapping[str, float | str] | None = None) -> SimpleNamespace:
        """Every number of a run by its name: those that are given, the others by default, what follows.

        given: {address or parameter name: a float in SI, or "0.5 mm", of a choice a name}, as `simulate` takes them.
        Raises UnknownNameError with the nearest; BadValueError for what is no number, or given by two spellings.
        """
        found = self._given(mapping(given, "given", "{address or parameter name: a float in SI, or '0.5 mm'}"))
        p = self._prepared(found)
        follow = self._chosen(found, p)
        return self._prepared(follow | found) if follow else p

    def _prepared(self, found: Mapping[str, float]) -> SimpleNamespace:
        addresses = self.model.slots.entries
        p = _Doubles(**{name: [0.0] * len(table) for name, table in self.model.slots.tables.items()})
        values = [found.get(address, 0.0) for address in addresses]
        with np.errstate(all="ignore"):
            self.functions["prepare"](values, [address in found for address in addresses], p)
        return SimpleNamespace(**{name: float(x) if isinstance(x, np.float64) else x for name, x in vars(p).items()})

    def _chosen(self, found: Mapping[str, float], p: SimpleNamespace) -> dict[str, float]:
        """Numbers of what is chosen by name, a material, as p has them."""
        slots, follow = self.model.slots, dict[str, float]()
        for choice in (address for address in found if slots.entries[address].words):
            name = slots.entries[choice].words[int(found[choice])]
            for address in slots.entries:
                if address.startswith(f"{choice}."):
                    own = slots.entries[f"materials.{name}.{address.removeprefix(f'{choice}.')}"]
                    follow[address] = getattr(p, slots.field(own.symbol))
        return follow

    def _given(self, given: Mapping[str, float | str]) -> dict[str, float]:
        """By full addresses, in SI."""
        entries, found = self.model.slots.entries, dict[str, float]()
        for name, value in given.items():
            address = name if name in entries else f"parameters.{name}"
            if address not in entries:
                known = (*(a.removeprefix("parameters.") for a in entries), *entries)
                raise unknown(f"no number of this scene has the address {name!r}", name, tuple(dict.fromkeys(known)))
            if address in found:
                raise BadValueError(f"{address} is given twice, once as {name!r}", hint="give it once")
            if words := entries[address].words:
                if not isinstance(value, str) or value.strip() not in words:
                    raise unknown_name(f"choice of {address}", str(value).strip(), words, None)
                found[address] = float(words.index(value.strip()))
                continue
            of = entries[address].dimension
            exponents = float(of.length), float(of.mass), float(of.time)
            number = number_of_text(value, address, exponents) if isinstance(value, str) else value
            found[address] = number_of(number, address)
        return found

    def _filled(self, what: str, size: int, *arguments: Any) -> Array:
        out = np.zeros(size)
        with np.errstate(all="ignore"):
            self.functions[what](*arguments, out)
        return out

    def mass(self, p: SimpleNamespace) -> Array:
        """The diagonal of M, (n,)."""
        return self._filled("mass_matrix", self.n, p)

    def phi(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """Φ(q, t), (m,), m and rad."""
        return self._filled("constraints", self.m, t, _list(q), p)

    def phi_q(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """∂Φ/∂q, (m, n)."""
        return self._filled("jacobian", self.m * self.n, t, _list(q), p).reshape(self.m, self.n)

    def nu(self, t: float, q: ArrayLike, p: SimpleNamespace) -> Array:
        """ν = −Φ_t, (m,): Φ_q v = ν."""
        return self._filled("velocity_rhs", self.m, t, _list(q), p)

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: SimpleNamespace) -> Array:
        """γ, (m,): Φ_q a = γ."""
        return self._filled("acceleration_rhs", self.m, t, _list(q), _list(v), p)

    def start_values(self, p: SimpleNamespace) -> tuple[Array, Array, Array]:
        """What the file's start guesses, sets, and gives as rates; behind the last two what it says of journals."""
        start, apart = self.model.scene.mechanism.start, len(apart_rows(self.model))
        sizes = (len(start.guess), len(start.set) + apart, len(start.rates) + apart)
        guess, fixed, rates = (np.zeros(size) for size in sizes)
        with np.errstate(all="ignore"):
            self.functions["start_values"](p, guess, fixed, rates)
        return guess, fixed, rates


class NumPyModel(ClosedLinkage):
    """All of it, with the absolute formulation's right-hand side; joints with play, their laws and forces as well.

    What C does beyond it stays there: no corner is held over a step, a pivot that vanishes is told.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program.model)
        contours = [CONTOUR] * any(own.clearance.contour is not None for own in program.pins)
        laws = [*contours, *map(function, program.laws), *map(pin, program.pins)]
        parts = [*_thresholds(program.dynamics), *laws, function(program.dynamics)]
        self.program = program
        text = "\n\n\n".join(parts) + "\n"
        curves = with_curves(program.model.scene.mechanism.curves, text, self.source)
        self.source += f"\n\n{curves}{text}"
        self.functions = _defined(self.source)

    def dynamics(
        self, t: float, q: ArrayLike, v: ArrayLike, p: SimpleNamespace, latches: ArrayLike = (), modes: ArrayLike = (),
        states: ArrayLike = 0.0,
    ) -> SimpleNamespace:  # fmt: skip
        """Accelerations a (n,), multipliers `lambda_`, forces `clearance`, powers: [M Φ_qᵀ; Φ_q 0][a; λ] = [g; γ − …].

        `latches` (joints with play,): rate (m/s) with which a contact closed, NaN while it is open; none given: all
        are open; the force of a closed one whose surfaces do not give is NaN, for only a run finds it. `modes`
        (frictions,): 0 stick, ±1 slip with that sign; a scene with friction that may stick must be given them, for
        only a run finds out which it is. `states` (joints with play, most states of a law): the laws' inner states, m,
        whose rates are `clearance[i].state_rate`. `status` is 0, or the number of the pivot that vanished. Raises
        ArrayError for another number of latches or modes.
        """
        model = self.model
        rates = _one_each("latches", latches, [c.name for c in model.clearances], [np.nan] * len(model.clearances))
        bent = np.broadcast_to(np.asarray(states, dtype=float), (len(model.clearances), model.law_states)).tolist()
        memory = SimpleNamespace(
            latch=[SimpleNamespace(closed=bool(x == x), deltadot_minus=float(x), force=np.nan, state=z)
                   for x, z in zip(rates, bent, strict=True)],
            mode=_one_each("modes", modes, [friction.name for friction in model.frictions]),
        )  # fmt: skip
        m = len(model.rows)
        aside = SimpleNamespace(
            a=np.zeros(self.n), lambda_=np.zeros(m), phi=np.zeros(m), phi_dot=np.zeros(m), power=np.zeros(N_WORK),
            event=np.zeros(len(model.events)),
            clearance=[SimpleNamespace(state_rate=[0.0] * model.law_states) for _ in model.clearances],
            friction=[SimpleNamespace() for _ in model.frictions], status=0,
        )  # fmt: skip
        with np.errstate(all="ignore"):
            aside.status = self.functions["dynamics"](t, _list(q), _list(v), memory, p, aside.a, aside)
        return aside


def _head(model: Model) -> str:
    """What the text is of, and how its vectors are ordered."""
    mechanism = model.scene.mechanism
    title = f"{mechanism.title or mechanism.name}: scene {model.scene.name} of the mechanism {mechanism.name}."
    about = [*textwrap.wrap(title, WIDTH - 7), "", *textwrap.wrap(_ABOUT, WIDTH - 7), ""]
    info = model.symbols.info
    about += [
        f"    q[{3 * k}:{3 * k + 3}], v[{3 * k}:{3 * k + 3}]: {', '.join(info[q].meaning for q in body.q)}"
        for k, body in enumerate(model.bodies)
    ]
    return "\n".join([*docstring(about), "", "import numpy as np"])


def _thresholds(kernel: Kernel) -> list[str]:
    """Those that its tests name, as a part of the text; none of no names."""
    tests = (line.test for section in kernel.sections for line in section.statements if isinstance(line, Guard))
    bounds = (x for test in tests if isinstance(test, Test) and not test.of_itself for x in test.bound)
    limits = {x.name: float(x) for x in bounds if isinstance(x, Threshold)}
    head = remark("A row fails where less than such a share of it is left by the others.")
    return ["\n".join([*head, *(f"{name} = {value!r}" for name, value in sorted(limits.items()))])] if limits else []


def _one_each(what: str, values: ArrayLike, names: list[str], none: list[float] | None = None) -> list[float]:
    """A number each; `none`: those where nothing is given."""
    found = np.asarray(values, dtype=float)
    if found.shape == (0,) and none is not None:
        return none
    if found.shape != (len(names),):
        told = f"{what} of shape {found.shape}: expected ({len(names)},)"
        raise ArrayError(told, hint=f"one each for {', '.join(names)}" if names else "this scene has none")
    return _list(found)


def _list(values: ArrayLike) -> list[float]:
    """Plain numbers: their arithmetic is quicker than that of entries of an array."""
    return np.asarray(values, dtype=float).tolist()


def _defined(source: str) -> dict[str, Any]:
    """The functions of a text that this target has written."""
    names: dict[str, Any] = {}
    exec(compile(source, "<equations>", "exec"), names)
    return names
