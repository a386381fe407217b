"""The hand-written dense C press (tests/oracles/press_dense.c), compiled on first use and called by ctypes.

Choices that the golden values depend on:

- Runs start concentric (e = 0) with the ideal velocities, all constraints satisfied.
- F is hypot(F_n, F_t): the friction share is about 1 % of a dry peak.
- A step that begins free uses δ̇/δ̇⁻ = 1 in all four stages; the onset is accepted at the end of the step, where
  δ̇⁻ is stored until a step ends with δ < 0.
- Film: at the journal's centre on both bodies, ω_s = ω_i + ω_j − 2ψ̇, S with the journal's radius.
- Dry forces: at Q_k = r_k + R_k n on each body (`common_point=False`) or both at one point in the middle of the
  penetration (`common_point=True`, which conserves angular momentum exactly). The golden values do not tell
  them apart: at a step of 1e-6 s the first contacts are 6.763915 ms and 7.378010 (common point 7.378015) ms, the
  first peaks 174.9663 (174.9660) N and 175.9416 (175.9390) N, a difference of at most 1.5e-5 relative.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from .ideal_press import PressData, motion

SOURCE = Path(__file__).with_name("press_dense.c")
FLAGS = ("-std=gnu11", "-O3", "-march=native", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC")
_EIGHT = ctypes.c_double * 8
_SCALARS = (
    "l5",
    "hx",
    "hy",
    "gravity",
    "theta1",
    "theta4",
    "omega1",
    "omega4",
    "alpha",
    "beta",
    "radius",
    "clearance",
    "width",
    "young",
    "poisson",
    "exponent",
    "restitution",
    "mu",
    "v0",
    "v1",
    "floor",
    "viscosity",
    "transition",
    "conformal",
    "film",
    "common_point",
)


class _Press(ctypes.Structure):
    _fields_ = [(name, _EIGHT) for name in ("length", "mass", "inertia")] + [(n, ctypes.c_double) for n in _SCALARS]


class Contact(ctypes.Structure):
    """Force on the journal (N), moments on both bodies (N·m), e, δ (m), δ̇ (m/s), δ̇/δ̇⁻."""

    _fields_ = [
        (name, ctypes.c_double) for name in ("fx", "fy", "moment_i", "moment_j", "e", "delta", "deltadot", "ratio")
    ]


class Watch(ctypes.Structure):
    """First contact (s, interpolated), first peak and greatest force (N), stored δ̇⁻, number of onsets, closed now."""

    _fields_ = [(name, ctypes.c_double) for name in ("first_contact", "first_peak", "peak", "stored")] + [
        (name, ctypes.c_int) for name in ("onsets", "closed")
    ]


@dataclass(frozen=True)
class Press:
    """Data of the press with play; SI. `film=True` for the lubricated scene."""

    geometry: PressData = field(default_factory=PressData)
    mass: tuple[float, ...] = (0.142, 0.284, 0.396, 0.142, 0.204, 0.277, 0.341, 0.112)
    inertia: tuple[float, ...] = (3.030e-4, 1.479e-3, 4.042e-3, 3.029e-4, 3.683e-3, 3.076e-3, 2.558e-3, 2.320e-4)
    gravity: float = 9.81
    alpha: float = 50.0
    beta: float = 50.0
    radius: float = 0.015
    clearance: float = 0.3e-3
    width: float = 0.040
    young: float = 70e9
    poisson: float = 0.3
    exponent: float = 1.5
    restitution: float = 0.9
    mu: float = 0.15
    v0: float = 1e-4
    v1: float = 1e-3
    floor: float = 1e-6
    viscosity: float = 0.1
    transition: float = 5e-6
    conformal: bool = False
    film: bool = False
    common_point: bool = False

    def at_speed(self, omega: float) -> Press:
        """The same press with ω1 = ω (rad/s) and ω4 = −ω."""
        return replace(self, geometry=replace(self.geometry, omega1=omega, omega4=-omega))


@dataclass(frozen=True)
class Run:
    """N samples: t (N,), q, v, a (N, 24), force (N, 2, 2) on the journals of A and B, e (N, 2); and two Watches."""

    t: np.ndarray
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    force: np.ndarray
    e: np.ndarray
    watch: tuple[Watch, Watch]


@cache
def _library() -> Any:
    """Compiled into a temporary folder; raises RuntimeError where there is no C compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        raise RuntimeError("the dense oracle needs a C compiler")
    folder = tempfile.mkdtemp(prefix="press_dense_")
    target = Path(folder) / "press_dense.so"
    subprocess.run([compiler, *FLAGS, str(SOURCE), "-o", str(target), "-lm"], check=True, capture_output=True)
    library = ctypes.CDLL(str(target))
    shutil.rmtree(folder)  # the loaded library stays mapped
    library.press_seconds_per_rhs.restype = ctypes.c_double
    return library


def _pointer(array: np.ndarray) -> Any:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def _struct(press: Press) -> _Press:
    g = press.geometry
    fields: dict[str, float] = {n: float(getattr(g if hasattr(g, n) else press, n)) for n in _SCALARS}
    length = _EIGHT(g.l1, g.l2, g.l3, g.l4, g.l6, g.l7, g.l8, 0.0)
    return _Press(length, _EIGHT(*press.mass), _EIGHT(*press.inertia), *(fields[n] for n in _SCALARS))


def numbers(press: Press) -> np.ndarray:
    """The C structure, which is nothing but doubles, in their order."""
    return np.frombuffer(bytes(_struct(press)))


def start(press: Press, t: float = 0.0) -> np.ndarray:
    """y (48,) = (q, v) of the ideal press at t: concentric joints, ideal velocities."""
    m = motion(t, press.geometry)
    return np.concatenate([m.q[0], m.v[0]])


def rhs(
    press: Press, t: float, y: np.ndarray, stored: tuple[float, float] = (0.0, 0.0)
) -> tuple[np.ndarray, np.ndarray, tuple[Contact, Contact]]:
    """ẏ (48,), λ (20,) and the two contacts; `stored` are the impact velocities δ̇⁻, 0 for none."""
    y = np.ascontiguousarray(y, dtype=float)
    dy, multipliers, contacts = np.empty(48), np.empty(20), (Contact * 2)()
    bad = _library().press_rhs(
        ctypes.byref(_struct(press)),
        ctypes.c_double(t),
        _pointer(y),
        (ctypes.c_double * 2)(*stored),
        _pointer(dy),
        _pointer(multipliers),
        contacts,
    )
    if bad:
        raise FloatingPointError(f"no pivot in column {bad - 1} at t = {t}")
    return dy, multipliers, (contacts[0], contacts[1])


def constraints(press: Press, t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Φ and Φ̇, each (20,)."""
    y = np.ascontiguousarray(y, dtype=float)
    phi, rate = np.empty(20), np.empty(20)
    _library().press_constraints(
        ctypes.byref(_struct(press)), ctypes.c_double(t), _pointer(y), _pointer(phi), _pointer(rate)
    )
    return phi, rate


def rk4(press: Press, t_end: float, step: float, every: int = 1, y: np.ndarray | None = None, t0: float = 0.0) -> Run:
    """Classical RK4 from t0 to t_end, one sample every `every` steps, both ends included."""
    steps = round((t_end - t0) / step)
    state = start(press, t0) if y is None else np.array(y, dtype=float)
    rows = np.empty((steps // every + 1, 79))
    nan = float("nan")
    watch = (Watch * 2)(Watch(nan, nan, 0.0, 0.0, 0, 0), Watch(nan, nan, 0.0, 0.0, 0, 0))
    bad = _library().press_rk4(
        ctypes.byref(_struct(press)),
        ctypes.c_double(t0),
        _pointer(state),
        ctypes.c_double(step),
        ctypes.c_long(steps),
        ctypes.c_long(every),
        _pointer(rows),
        watch,
    )
    if bad:
        raise FloatingPointError(f"no pivot in column {bad - 1}")
    joints = rows[:, 73:].reshape(-1, 2, 3)
    return Run(
        rows[:, 0],
        rows[:, 1:25],
        rows[:, 25:49],
        rows[:, 49:73],
        joints[:, :, :2],
        joints[:, :, 2],
        (watch[0], watch[1]),
    )


def seconds_per_rhs(
    press: Press, batch: int = 20000, repeats: int = 7, t: float = 0.0, y: Sequence[float] | None = None
) -> float:
    """Least time of one right-hand side (s) over `repeats` batches, at y (48,) or at the start of the run."""
    state = start(press) if y is None else np.array(y, dtype=float)
    return float(
        _library().press_seconds_per_rhs(
            ctypes.byref(_struct(press)), ctypes.c_double(t), _pointer(state), batch, repeats
        )
    )
