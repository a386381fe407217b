"""Compare results of gudgeon with the equations of published programs that draw results but print no numbers.

    python -m benchmarks.clearance.compare_published [NAME …]

The output has a line for each number in README.md: what is compared, the number there, the number now. The equations
are in drawn.py. A run takes a minute or two; the exit code is 1 if a number differs.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from scipy.integrate import solve_ivp

import gudgeon
from benchmarks.clearance import drawn, rotors
from benchmarks.clearance.cases import cases
from benchmarks.clearance.drawn import Rates
from benchmarks.clearance.second import ending

HERE = Path(__file__).resolve().parent
WHIRLS = 0.4  # eccentricity over the gap, after 0.3 s, when the rotor has risen from its fall
LAST_DIGITS = 8  # runs whose viscosities differ by 3e-15 of them
ITS_OWN = {"method": "BDF", "rtol": 1e-6, "atol": 1e-6}  # how Nowald integrates, m and m/s


@dataclass(frozen=True)
class Figure:
    """A number of a comparison in README.md, and its present value.

    within: factor by which it may differ if rounding errors decide it; 1 if all printed digits must agree.
    """

    what: str
    printed: str
    now: float
    within: float = 1.0

    @property
    def now_printed(self) -> str:
        """Return the present value with as many digits as in README.md."""
        digits = self.printed.partition("e")[0].partition(".")[2]
        if self.printed == "0":
            return f"{self.now:.0e}" if self.now else "0"
        if "e" not in self.printed:
            return f"{self.now:.{len(digits)}f}"
        mantissa, exponent = f"{self.now:.{len(digits)}e}".split("e")
        return f"{mantissa}e{int(exponent)}"

    @property
    def holds(self) -> bool:
        """Return whether the present value agrees."""
        if self.within == 1.0:
            return self.now_printed == self.printed
        return 1.0 / self.within < self.now / float(self.printed) < self.within


def found(rates: Rates, y: Any, times: np.ndarray, **how: Any) -> np.ndarray:
    """Return y (N, times) of equations y' = f(t, y); DOP853 at 1e-13 by default. Raises ValueError."""
    how = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-16} | how
    run = solve_ivp(rates, (0.0, float(times[-1])), y, t_eval=times, **how)
    if run.status < 0:
        raise ValueError(run.message)
    return np.asarray(run.y)


def kept(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return times (s) and e (m; times, joints, axes) of a case's file, up to its horizon."""
    data = xr.load_dataset(HERE / "data" / f"{name}.nc", engine="h5netcdf")
    there = data.time.values <= data.attrs["horizon"]
    return data.time.values[there], data.e.values[there]


def ours(name: str, times: np.ndarray, **parameters: float) -> Any:
    """Return a run of gudgeon beyond the horizon, or with other parameters."""
    case = cases()[name]
    return gudgeon.load(case.file, case.scene).simulate(
        float(times[-1]), output=times, parameters=parameters, rtol=1e-12, method="radau9" if case.is_film else "dop853"
    )


def far(a: np.ndarray, b: np.ndarray, unit: float) -> np.ndarray:
    """Return the distances of points (times, 2), over `unit`."""
    return np.asarray(np.hypot(*(a - b).T) / unit)


def film_difference(eps: float) -> float:
    """Return the largest relative difference of forces between Nowald's film and the quadrature of the second code, at
    ε.
    """
    law, film, turning, most = rotors.rigid_rotor()[0].joints[0].law, drawn.SMALL, 700.0, 0.0
    e = film.gap * eps * np.array([math.cos(0.4), math.sin(0.4)])
    for speed in (0.0, 10.0, 1000.0):
        for angle in np.linspace(0.0, 2.0 * math.pi, 25):
            rate = film.gap * speed * np.array([math.cos(angle), math.sin(angle)])
            expected = law(e, rate, 0.0, turning).force
            most = max(most, float(np.hypot(*(2.0 * film.force(e, rate, turning) - expected)) / np.hypot(*expected)))
    return most


def whirls_from(film: drawn.Film, times: np.ndarray, **how: Any) -> float:
    """Return the time in s at which the rotor begins to whirl."""
    y = found(lambda t, y: drawn.rigid_rotor(t, y, film), np.zeros(4), times, **how)
    return float(times[(times > 0.3) & (np.hypot(y[0], y[1]) > WHIRLS * film.gap)][0])


def rotor_rigid() -> Iterator[Figure]:
    """Yield the comparisons of the rigid rotor."""
    yield Figure(
        "Nowald's film and a quadrature, of the force, ε 0.01 to 0.95",
        "3e-8",
        max(map(film_difference, (0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95))),
    )
    times, e = kept("rotor_rigid")
    early = times <= 0.3
    y = found(drawn.rigid_rotor, np.zeros(4), times[early], rtol=1e-10)
    yield Figure(
        "his rigid rotor by his equations, to 0.3 s, by c", "2e-9", far(y[:2].T, e[early, 0], 15e-6).max(), 3.0
    )
    times, film = np.linspace(0.0, 0.9, 9001), drawn.SMALL
    films = [replace(film, viscosity=film.viscosity * (1.0 + 3e-15 * k)) for k in range(LAST_DIGITS)]
    began = [whirls_from(one, times, **ITS_OWN) for one in films]
    yield Figure(
        "it whirls as he integrates, s, the first of eight that differ in last digits", "0.66", min(began), 1.05
    )
    yield Figure("the last of them, s", "0.71", max(began), 1.05)
    yield Figure("it whirls by his equations, s", "0.83", whirls_from(film, times, rtol=1e-10))
    run = ours("rotor_rigid", times)
    whirls = np.hypot(run["bearings.ex"], run["bearings.ey"]) > WHIRLS * film.gap
    yield Figure("it whirls by gudgeon, s", "0.83", float(times[(times > 0.3) & whirls][0]))


def rotor_elastic() -> Iterator[Figure]:
    """Yield the comparison of the elastic rotor."""
    times = np.linspace(0.0, 0.6, 601)
    y, run = found(drawn.elastic_rotor, np.full(8, 1e-10), times, **ITS_OWN), ours("rotor_elastic", times)
    own = np.stack([run["bearings.ex"], run["bearings.ey"]], -1)
    yield Figure("his elastic rotor as he integrates, to 0.6 s, by c", "5e-4", far(y[:2].T, own, 15e-6).max(), 1.3)


def rotor_floating_ring() -> Iterator[Figure]:
    """Yield the comparisons of the rotor in floating rings."""
    times, e = kept("rotor_floating_ring")
    y = found(drawn.floating_ring, np.full(13, 1e-10), times, method="Radau", rtol=1e-8, atol=1e-12)
    k, run = int(np.argmin(abs(times - 0.3))), ours("rotor_floating_ring", times)
    shaft = 2.0 * math.pi * 300.0 * times[k]
    yield Figure("the ring's speed by the shaft's at 0.3 s by his equations", "0.113", y[12, k] / shaft)
    yield Figure("and here", "0.110", run["ring.omega"][k] / shaft)
    yield Figure("the outer film's journal, to 1 s, by c", "0.024", far(y[4:6].T, e[:, 0], 70e-6).max())


def carried(load: float) -> float:
    """Return the load that Ocvirk's film carries where mobility comes to rest under a constant load, over that load."""
    speed, length, diameter, gap = 2000.0 / 60.0 * 2.0 * math.pi, 0.0254, 0.0635, 35.56e-6
    y = found(drawn.mobility(lambda t: load, 0.5), [0.1, 0.1], np.array([0.0, 1.0]), method="Radau", rtol=1e-9)
    eps = float(np.hypot(*y[:, -1]))
    unit = 4.16e-3 * speed * diameter * length**3 / (8.0 * gap**2)
    return unit * eps / (1.0 - eps**2) ** 2 * math.sqrt(16.0 * eps**2 + math.pi**2 * (1.0 - eps**2)) / load


def engine_bearing() -> Iterator[Figure]:
    """Yield the comparisons of the engine's bearing."""
    gas, c, times = rotors.engine_bearing()[0].linkage.loads[0], 35.56e-6, np.linspace(0.0, 0.12, 1201)
    begun, second = 0.1 * np.array([math.cos(1.5), math.sin(1.5)]), times >= 0.06
    orbits = {
        share: found(
            drawn.mobility(lambda t: gas.forces(t, np.zeros(3), np.zeros(3))[0], share),
            begun,
            times,
            method="Radau",
            rtol=1e-8,
            atol=1e-10,
        )[:, second].T
        for share in (0.5, 1.0)
    }
    runs = [ours("engine_bearing", times, mass=mass) for mass in (1.0, 0.1)]
    heavy, light = (np.stack([run["main.ex"], run["main.ey"]], -1)[second] / c for run in runs)
    for who, orbit, eps, thin in (
        ("mobility, half the crank's speed", orbits[0.5], "0.821", "6.38"),
        ("these equations", heavy, "0.819", "6.45"),
        ("mobility, the whole speed", orbits[1.0], "0.745", "9.08"),
    ):
        largest = float(np.hypot(*orbit.T).max())
        yield Figure(f"{who}: largest ε of the second period", eps, largest)
        yield Figure(f"{who}: least film, µm", thin, 1e6 * c * (1.0 - largest))
    yield Figure(
        "orbits of mobility and of these equations, second period, by c", "0.014", far(orbits[0.5], heavy, 1.0).max()
    )
    yield Figure("what Ocvirk's film carries where mobility rests under 2 kN, of that", "0.979", carried(2e3))
    yield Figure("orbits with 0.1 kg and 1 kg, second period, by c", "0.007", far(light, heavy, 1.0).max())


def rotor_stator() -> Iterator[Figure]:
    """Yield the comparisons of the rotor in its stator."""
    times, e = kept("rotor_stator")
    begun, early = [0.01, 0.0, 0.0, 0.0], times <= 20e-3 + 1e-9
    y = found(drawn.stator(False), begun, 1e3 * times[early])
    yield Figure(
        "force along the line of middles, to 20 ms, by the gap",
        "2e-11",
        far(y[:2].T, 1e3 * e[early, 0], 1.0).max(),
        5.0,
    )
    one, two = (found(drawn.stator(beside), begun, np.array([0.0, 5.0]))[:2, 1] for beside in (False, True))
    yield Figure("force as at 0c5a3ade, at 5 ms, by the gap", "0.14", float(np.hypot(*(one - two))))


def whirling(collar: drawn.Collar, times: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the positions of the collar's centre (times, 2) in m, and the time of its first contact in s.

    The integration is split where contacts begin and end.
    """
    y, t, touches, pieces, first = collar.start(), 0.0, False, [], math.inf
    while t < times[-1]:
        event = ending(lambda t, y: y[0] - collar.gap, -1.0 if touches else 1.0)
        run = solve_ivp(
            collar.rates(touches),
            (t, float(times[-1])),
            y,
            "DOP853",
            events=event,
            rtol=1e-13,
            atol=1e-16,
            t_eval=times[times >= t],
        )
        if len(run.t):
            pieces.append(run.y.T[:, :2])
        if not run.t_events[0].size:
            break
        t, y, touches = float(run.t_events[0][0]), run.y_events[0][0], not touches
        first = min(first, t)
    r, theta = np.concatenate(pieces).T
    return np.stack([r * np.cos(theta), r * np.sin(theta)], -1), first


def drill_collar() -> Iterator[Figure]:
    """Yield the comparisons of the drill collar."""
    (times, e), gap, end = kept("drill_collar"), drawn.Collar.gap, 5.6
    times, e = np.append(times[times < end], end), e[times < end, 0]
    own, first = whirling(drawn.Collar(1e-3), times)
    yield Figure("to the first contact, by c", "1e-12", far(own[:-1], e, gap)[times[:-1] < first].max(), 5.0)
    yield Figure("first contact, s", "4.26", first)
    times = np.append(times, 6.0)
    runs = (ours("drill_collar", times, **{"contacts.rock.friction.v0": v0}) for v0 in (1e-3, 1e-5))
    broad, sharp = (np.stack([run["borehole.ex"], run["borehole.ey"]], -1) for run in runs)
    yield Figure("at 5.6 s, by c", "1e-4", far(own, broad[:-1], gap)[-1])
    apart = far(broad, sharp, gap)
    yield Figure("v0 of 1e-5 m/s and of 1e-3 m/s, to 5.6 s, by c", "0", apart[:-1].max())
    yield Figure("and at 6 s", "3e-3", apart[-1])


COMPARED: dict[str, Callable[[], Iterator[Figure]]] = {
    one.__name__: one
    for one in (rotor_rigid, rotor_elastic, rotor_floating_ring, engine_bearing, rotor_stator, drill_collar)
}


def main() -> int:
    """Run the comparisons from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(COMPARED))
    options = parser.parse_args()
    if unknown := set(options.names) - set(COMPARED):
        parser.error(f"nothing is called {', '.join(sorted(unknown))}; there are {', '.join(COMPARED)}")
    missed = 0
    for name in options.names or COMPARED:
        for figure in COMPARED[name]():
            missed += not figure.holds
            print(f"{name}: {figure.what}: {figure.printed}, now {figure.now_printed}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
