"""Functions of time with two derivatives, and the names that expressions of a mechanism file may use."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline


@dataclass(frozen=True)
class Jet:
    """A value with its first and second derivative by time."""

    x: float
    d: float = 0.0
    dd: float = 0.0

    def chain(self, f: float, f1: float, f2: float) -> Jet:
        """f(self), whose value and derivatives by its argument are given."""
        return Jet(f, f1 * self.d, f1 * self.dd + f2 * self.d**2)

    def __add__(self, other: Any) -> Jet:
        o = jet(other)
        return Jet(self.x + o.x, self.d + o.d, self.dd + o.dd)

    def __neg__(self) -> Jet:
        return Jet(-self.x, -self.d, -self.dd)

    def __sub__(self, other: Any) -> Jet:
        return self + -jet(other)

    def __rsub__(self, other: Any) -> Jet:
        return jet(other) - self

    def __mul__(self, other: Any) -> Jet:
        o = jet(other)
        return Jet(self.x * o.x, self.d * o.x + self.x * o.d, self.dd * o.x + 2.0 * self.d * o.d + self.x * o.dd)

    def __pow__(self, k: float) -> Jet:
        if self.x == 0.0 and k < 2.0:
            return self.chain(0.0, 0.0 if k > 1.0 else math.inf, 0.0)  # the second derivative may be unbounded here
        return self.chain(self.x**k, k * self.x ** (k - 1.0), k * (k - 1.0) * self.x ** (k - 2.0))

    def __truediv__(self, other: Any) -> Jet:
        return self * jet(other) ** -1.0

    def __rtruediv__(self, other: Any) -> Jet:
        return jet(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __lt__(self, other: Any) -> bool:
        return self.x < jet(other).x

    def __gt__(self, other: Any) -> bool:
        return self.x > jet(other).x

    def __le__(self, other: Any) -> bool:
        return self.x <= jet(other).x

    def __ge__(self, other: Any) -> bool:
        return self.x >= jet(other).x

    def __abs__(self) -> Jet:
        return -self if self.x < 0.0 else self


def jet(x: Any) -> Jet:
    return x if isinstance(x, Jet) else Jet(float(x))


def _lifted(f: Callable[[float], tuple[float, float, float]]) -> Callable[[Any], Any]:
    """A function of numbers as one of jets; where it is given numbers it gives them."""

    def lifted(x: Any) -> Any:
        return x.chain(*f(x.x)) if isinstance(x, Jet) else f(float(x))[0]

    return lifted


def _tanh(x: float) -> tuple[float, float, float]:
    y = math.tanh(x)
    return y, 1.0 - y * y, -2.0 * y * (1.0 - y * y)


def _ramp(t: Any, start: Any, duration: Any) -> Any:
    s = (t - start) / duration
    return 0.0 * t if s <= 0.0 else (0.0 * t + 1.0 if s >= 1.0 else s)


def _smooth_step(t: Any, start: Any, duration: Any) -> Any:
    s = _ramp(t, start, duration)
    return 10.0 * s**3 - 15.0 * s**4 + 6.0 * s**5


def _mod(a: Any, b: Any) -> Any:
    x, y = jet(a).x, jet(b).x
    return a - math.floor(x / y) * b


def _power_of(x: Any, y: Any) -> Any:
    return (x**2 + y**2) ** 0.5


FUNCTIONS: dict[str, Any] = {
    "sin": _lifted(lambda x: (math.sin(x), math.cos(x), -math.sin(x))),
    "cos": _lifted(lambda x: (math.cos(x), -math.sin(x), -math.cos(x))),
    "exp": _lifted(lambda x: (math.exp(x),) * 3),
    "tanh": _lifted(_tanh),
    "sqrt": lambda x: x**0.5,
    "hypot": _power_of,
    "abs": abs,
    "sign": lambda x: float(np.sign(x)),
    "min": min,
    "max": max,
    "where": lambda condition, a, b: a if condition else b,
    "ramp": _ramp,
    "smooth_step": _smooth_step,
    "mod": _mod,
    "pi": math.pi,
}


def curve(points: list[list[float]], ends: str) -> Callable[[Any], Any]:
    """A cubic spline of the file: periodic, natural, clamped or not_a_knot."""
    x, y = np.array(points).T
    spline = CubicSpline(x, y, bc_type=ends.replace("_", "-"), extrapolate="periodic" if ends == "periodic" else True)
    return _lifted(lambda at: tuple(float(spline(at, k)) for k in range(3)))  # type: ignore[return-value, arg-type]


class Expression:
    """What stands in a file, evaluated with names: numbers, jets, or bodies with attributes."""

    def __init__(self, text: str, known: Mapping[str, Any]) -> None:
        self.code, self.known = compile(str(text), "expression", "eval"), dict(known)

    def __call__(self, **names: Any) -> Any:
        return eval(self.code, {"__builtins__": {}}, {**FUNCTIONS, **self.known, **names})  # of our own files alone

    def value(self, t: float) -> float:
        return jet(self(t=Jet(t, 1.0))).x

    def rate(self, t: float) -> float:
        return jet(self(t=Jet(t, 1.0))).d

    def acceleration(self, t: float) -> float:
        return jet(self(t=Jet(t, 1.0))).dd
