"""A scene's equations as a Python module, and its functions for arrays."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.numpy.play import pin
from gudgeon.generator.targets.numpy.printer import function

Array = NDArray[np.float64]
_HEAD = '"""The equations of a scene."""\n\nimport numpy as np'


class ClosedLinkage:
    """Φ, Φ_q, ν, γ, M of the closed linkage (joints with play closed, redundant rows kept), in NumPy.

    `source` is the text of the functions; n coordinates, m rows. t in s, q (n,), v (n,) in m, rad and their rates;
    p is what `prepare` gives.
    """

    def __init__(self, model: Model) -> None:
        kernels = [closed_linkage.mass_kernel(model), *closed_linkage.row_kernels(model),
                   closed_linkage.start_kernel(model), closed_linkage.prepare_kernel(model)]  # fmt: skip
        self.model, self.n, self.m = model, len(model.q), len(model.all_rows)
        self.source = "\n\n\n".join([_HEAD, *map(function, kernels)]) + "\n"
        self.functions = _defined(self.source)

    def prepare(self, given: Mapping[str, float] | None = None) -> SimpleNamespace:
        """Every number of a run by its name: those given by their addresses, the others by default, what follows."""
        addresses = list(self.model.slots.entries)
        if given and (unknown := set(given) - set(addresses)):
            raise KeyError(f"no number has the address {sorted(unknown)[0]!r}")
        values = [float((given or {}).get(address, 0.0)) for address in addresses]
        p = SimpleNamespace()
        self.functions["prepare"](values, [address in (given or {}) for address in addresses], p)
        return p

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
        """What the file's start guesses, sets, and gives as rates."""
        start = self.model.scene.mechanism.start
        guess, fixed, rates = (np.zeros(len(group)) for group in (start.guess, start.set, start.rates))
        with np.errstate(all="ignore"):
            self.functions["start_values"](p, guess, fixed, rates)
        return guess, fixed, rates


class NumPyModel(ClosedLinkage):
    """All of it, with the absolute formulation's right-hand side; joints with play, their laws and forces as well.

    What C does beyond it stays there: no corner is held over a step, a pivot that vanishes is told.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program.model)
        parts = [*map(function, program.laws), *map(pin, program.pins), function(program.dynamics)]
        self.program = program
        self.source += "\n\n" + "\n\n\n".join(parts) + "\n"
        self.functions = _defined(self.source)

    def dynamics(
        self, t: float, q: ArrayLike, v: ArrayLike, p: SimpleNamespace, latches: ArrayLike = (), modes: ArrayLike = (),
        states: ArrayLike = 0.0,
    ) -> SimpleNamespace:  # fmt: skip
        """Accelerations a (n,), multipliers `lambda_`, forces `clearance`, powers: [M Φ_qᵀ; Φ_q 0][a; λ] = [g; γ − …].

        `latches` (joints with play,): rate (m/s) with which a contact closed, NaN while it is open; `modes`
        (frictions,): 0 stick, ±1 slip; `states` (joints with play, most states of a law): the laws' inner states, m,
        whose rates are `clearance[i].state_rate`. `status` is 0, or the number of the pivot that vanished.
        """
        model = self.model
        rates = np.resize(np.asarray([*np.atleast_1d(latches), np.nan], dtype=float), len(model.clearances))
        bent = np.broadcast_to(np.asarray(states, dtype=float), (len(model.clearances), model.law_states)).tolist()
        memory = SimpleNamespace(
            latch=[SimpleNamespace(closed=bool(x == x), deltadot_minus=float(x), state=z)
                   for x, z in zip(rates, bent, strict=True)],
            mode=np.resize(np.asarray([*np.atleast_1d(modes), 0.0], dtype=float), len(model.frictions)).tolist(),
        )  # fmt: skip
        m = len(model.rows)
        aside = SimpleNamespace(
            a=np.zeros(self.n), lambda_=np.zeros(m), phi=np.zeros(m), phi_dot=np.zeros(m), power=np.zeros(3),
            event=np.zeros(len(model.events)),
            clearance=[SimpleNamespace(state_rate=[0.0] * model.law_states) for _ in model.clearances],
            friction=[SimpleNamespace() for _ in model.frictions], status=0,
        )  # fmt: skip
        with np.errstate(all="ignore"):
            aside.status = self.functions["dynamics"](t, _list(q), _list(v), memory, p, aside.a, aside)
        return aside


def _list(values: ArrayLike) -> list[float]:
    """Plain numbers: their arithmetic is quicker than that of entries of an array."""
    return np.asarray(values, dtype=float).tolist()


def _defined(source: str) -> dict[str, Any]:
    """The functions of a text that this target has written."""
    names: dict[str, Any] = {}
    exec(compile(source, "<equations>", "exec"), names)
    return names
