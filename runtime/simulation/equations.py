"""The equations of a loaded scene as functions, with the file's numbers: NumPy in and out."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import prepare
from gudgeon.results.shown import Shown

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation


class Equations(Shown):
    """What a Simulation evaluates without running."""

    compiled: CompiledModel

    @property
    def full(self) -> Simulation:
        """The same scene in absolute coordinates."""
        raise NotImplementedError

    @property
    def p(self) -> Array:
        """Every run-time number with the file's defaults: slots, then derived; a copy."""
        return self._defaults.copy()

    @cached_property
    def _defaults(self) -> Array:
        return prepare(self.compiled, {})[0]

    def rhs(self, t: float, y: ArrayLike, memory: ArrayLike | None = None) -> Array:
        """ẏ = (q̇, q̈), (2n,), at y = (q, q̇), with the file's defaults; see CompiledModel.rhs."""
        return self.compiled.rhs(t, y, self._defaults, memory)[: 2 * self.compiled.n]

    def jacobian(self, t: float, y: ArrayLike, memory: ArrayLike | None = None) -> Array:
        """∂ẏ/∂y, (2n, 2n), of `rhs` at y = (q, q̇), with the file's defaults; exact, SI.

        Rows and columns are (q, q̇), positions in m, angles in rad, time in s. Contacts, corners of min, max, abs
        and sign, and modes of friction stay as they are at y; `memory` as in CompiledModel.rhs.
        Raises SingularError where constraint rows depend on each other, ValueError where nothing is integrated.
        """
        full = self.full
        return full.compiled.jacobian(t, y, full._defaults, memory)[0][: 2 * full.compiled.n, : 2 * full.compiled.n]

    def phi(self, t: float, q: ArrayLike) -> Array:
        """Φ(q, t), (m,)."""
        return self.compiled.phi(t, q, self._defaults)

    def phi_q(self, t: float, q: ArrayLike) -> Array:
        """Φ_q, (m, n)."""
        return self.compiled.phi_q(t, q, self._defaults)

    def nu(self, t: float, q: ArrayLike) -> Array:
        """ν = −Φ_t, (m,)."""
        return self.compiled.nu(t, q, self._defaults)

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike) -> Array:
        """γ, (m,)."""
        return self.compiled.gamma(t, q, v, self._defaults)

    def mass(self) -> Array:
        """Diagonal of M, (n,)."""
        return self.compiled.mass(self._defaults)
