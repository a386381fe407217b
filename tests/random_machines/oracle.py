"""An independent simulator: a mechanism file, read as data, in absolute coordinates by SciPy.

It shares no code with the product: expressions are evaluated by Python, drives differentiated by jets, constraints and
Newton-Euler's equations are those of tests/oracles/numpy_linkage.py, forces of contact those of laws.py.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from tests.oracles import numpy_linkage as dense
from tests.oracles.linkage_joints import CoordinateDrive, Distance, DistanceDrive, Gear, PointOnLine, Rigid
from tests.oracles.linkage_loads import RotationalSpring, Spring, turning
from tests.oracles.numpy_linkage import GROUND, Body, Drive, End, Linkage, Play, Revolute, Translational
from tests.random_machines.jets import Expression, curve
from tests.random_machines.laws import SHARES, Pin

MAX_EVALUATIONS = 4000  # of accelerations, some 300 µs each
RTOL = 1e-10
AXES = {"x": 0, "y": 1, "theta": 2}
FLOOR = 1e-6  # m/s, the least speed of approach that a contact stores
KNOWN_LAWS = (
    "hertz",
    "kelvin_voigt",
    "liu",
    "lankarani_nikravesh",
    "hunt_crossley",
    "flores",
    "gonthier",
    "lee_wang",
    "herbert_mcwhannell",
    "zhiying_qishao",
    "hu_guo",
)


class Unknown(Exception):
    """The file has something that this simulator has not, or what would take it too long."""


@dataclass(frozen=True)
class Written:
    """A force or a torque whose value is an expression of time, coordinates and velocities."""

    machine: Machine
    first: End
    second: int | None  # the other body of a torque; None: it is a force
    parts: tuple[Expression, ...]
    in_body: bool = False

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        names = self.machine.motion(q, v)
        values = np.array([part(t=t, **names) for part in self.parts], dtype=float)
        if self.second is not None:
            return turning(q.size, self.first.body, values[0]) + turning(q.size, self.second, -values[0])
        at = dense.place(self.first, q, v)
        return np.asarray(at.r_q.T @ (dense.rotation(at.angle) @ values if self.in_body else values))

    def potential(self, q: np.ndarray) -> float:
        """It stores nothing."""
        return 0.0


@dataclass
class Motion:
    """Coordinates and velocities at the times that were asked for, (N, n), and contacts as (joint, time)."""

    q: np.ndarray
    v: np.ndarray
    contacts: list[tuple[str, float]] = field(default_factory=list)


class Machine:
    """A file as a nested mapping, with the values of its parameters (SI). Raises Unknown."""

    def __init__(self, file: Mapping[str, Any], values: Mapping[str, float], scene: str = "ideal") -> None:
        self.file = file
        self.known: dict[str, Any] = dict(values)
        for name, entry in file.get("curves", {}).items():
            self.known[name] = curve(entry["points"], entry.get("ends", "natural"))
        self.names = list(file["bodies"])
        self.com = {name: self._com(entry) for name, entry in file["bodies"].items()}
        bodies = tuple(Body(self.number(b["mass"]), self._inertia(b)) for b in file["bodies"].values())
        play = file.get("scenes", {}).get(scene, {}).get("play", {})
        joints = {name: entry for name, entry in file.get("joints", {}).items() if name not in play}
        gravity = [self.number(x) for x in file.get("gravity", [0, 0])]
        self.pins = {name: self._pin(entry) for name, entry in play.items()}
        plays = tuple(Play(*self.ends(file["joints"][name]["revolute"]), pin) for name, pin in self.pins.items())
        guess = file.get("start", {}).get("guess", {})
        self.guess = np.array([self.number(guess.get(f"{n}.{axis}", 0.0)) for n in self.names for axis in AXES])
        parts = tuple(self.joint(entry) for entry in joints.values())
        drives = tuple(self.drive(entry) for entry in file.get("drives", {}).values())
        self.linkage = Linkage(bodies, parts, drives, plays, (gravity[0], gravity[1]))
        loads = tuple(self.load(entry) for entry in file.get("forces", {}).values())
        self.linkage = Linkage(bodies, parts, drives, plays, (gravity[0], gravity[1]), loads)

    def number(self, text: Any) -> float:
        return float(Expression(self.bare(text), self.known)())

    @staticmethod
    def bare(text: Any) -> str:
        """Without units in SI: "2 N*m*p3" is 2*p3."""
        return re.sub(r"(?<![\w.])(\d[\d.e+-]*) (?:[A-Za-z]+(?:[*/][A-Za-z]+)*)(?=\*p|\*\(|,|$)", r"\1", str(text))

    def expression(self, text: Any) -> Expression:
        """What stands in the file, with the parts that it names written out."""
        written = self.bare(text)
        for name, part in reversed(self.file.get("expressions", {}).items()):
            written = re.sub(rf"(?<![\w.]){name}(?![\w.])", f"({self.bare(part)})", written)
        return Expression(written, self.known)

    def _com(self, body: Mapping[str, Any]) -> np.ndarray:
        middle = [f"({body['length']})/2" if "length" in body else 0, 0]
        return np.array([self.number(x) for x in body.get("com", middle)])

    def _inertia(self, body: Mapping[str, Any]) -> float:
        if body["inertia"] == "auto":
            return self.number(body["mass"]) * self.number(body["length"]) ** 2 / 12.0
        return self.number(body["inertia"])

    def body(self, name: str) -> int:
        return GROUND if name == "ground" else self.names.index(name)

    def end(self, place: str) -> End:
        name, _, point = place.partition(".")
        if name == "ground":
            x, y = (self.number(part) for part in self.file["ground"][point])
            return End(GROUND, (x, y))
        body = self.file["bodies"][name]
        at = {"origin": [0, 0], "tail": [0, 0], "head": [body.get("length", 0), 0]} | dict(body.get("points", {}))
        local = self.com[name] if point == "com" else np.array([self.number(x) for x in at[point]])
        x, y = local - self.com[name]
        return End(self.body(name), (float(x), float(y)))

    def ends(self, places: Sequence[str]) -> tuple[End, End]:
        return self.end(places[0]), self.end(places[1])

    def joint(self, entry: Mapping[str, Any]) -> Any:
        kind = next(iter(entry))
        if kind == "gear":
            r1, r2 = (self.number(x) for x in entry["radii"])
            ring = -1.0 if entry.get("internal") else 1.0
            one, two = (End(self.body(name), (0.0, 0.0)) for name in entry["gear"])
            gear = Gear(one, two, self.body(entry["carrier"]), (r1, ring * r2), 0.0)
            return replace(gear, constant=float(gear.coefficients(self.guess.size) @ self.guess))
        one, two = self.ends(entry[kind])
        along = tuple(self.number(x) for x in entry.get("axis", entry.get("direction", [1, 0])))
        if kind == "revolute":
            return Revolute(one, two)
        if kind == "rigid":
            return Rigid(one, two, self.number(entry.get("angle", 0)))
        if kind == "distance":
            return Distance(one, two, self.number(entry["length"]))
        if kind == "point_on_line":
            return PointOnLine(one, two, (along[0], along[1]))
        turned = self.number(entry["angle"]) if "angle" in entry else float(np.arctan2(along[1], along[0]))
        return Translational(one, two, (along[0], along[1]), turned)

    def drive(self, entry: Mapping[str, Any]) -> Any:
        law = Expression(self.bare(entry["value"]), self.known)
        if "angle" in entry:
            target = entry["angle"]
            names = [target, "ground"] if isinstance(target, str) else target
            return Drive(self.body(names[0]), self.body(names[1]), law)
        if "coordinate" in entry:
            name, _, axis = entry["coordinate"].partition(".")
            return CoordinateDrive(self.body(name), AXES[axis], law)
        return DistanceDrive(*self.ends(entry["distance"]), law)

    def load(self, entry: Mapping[str, Any]) -> Any:
        kind = next(iter(entry))
        if kind == "spring_damper":
            numbers = (self.number(entry.get(key, 0)) for key in ("stiffness", "free_length", "damping"))
            return Spring(*self.ends(entry[kind]), *numbers)
        if kind == "rotational_spring_damper":
            numbers = (self.number(entry.get(key, 0)) for key in ("stiffness", "free_angle", "damping"))
            return RotationalSpring(*(self.body(name) for name in entry[kind]), *numbers)
        if kind == "force":
            parts = tuple(self.expression(text) for text in entry["value"])
            return Written(self, self.end(entry[kind]), None, parts, entry.get("axes") == "body")
        if kind == "torque":
            target = entry[kind]
            names = [target, "ground"] if isinstance(target, str) else target
            parts = (self.expression(entry["value"]),)
            return Written(self, End(self.body(names[0]), (0.0, 0.0)), self.body(names[1]), parts)
        raise Unknown(kind)

    def _pin(self, entry: Mapping[str, Any]) -> Pin:
        contact = self.file["contacts"][entry["contact"]]
        if "bearing" not in entry or "mixed" in contact or "contour" in entry:
            raise Unknown("a guide, mixed lubrication or a contour")
        normal, friction = ({k: self._choice(x) for k, x in contact.get(p, {}).items()} for p in ("normal", "friction"))
        film = contact.get("film", {})
        if normal["law"] not in KNOWN_LAWS or normal.get("dissipation") == "exact" or normal.get("pulls"):
            raise Unknown(normal["law"])
        if friction and friction["law"] not in SHARES or film and film["law"] != "pinkus_sternlicht":
            raise Unknown("a law of friction or film")
        bearing = self.file["bearings"][entry["bearing"]]
        material = self.file["materials"][bearing["bearing_material"]]
        radius, clearance, length = (self.number(bearing[key]) for key in ("radius", "clearance", "length"))
        return Pin(
            radius,
            clearance,
            length,
            self.number(material["E"]),
            self.number(material["nu"]),
            normal,
            friction,
            self.number(film["viscosity"]) if film else 0.0,
            self.number(contact.get("transition", 0)),
        )

    def _choice(self, value: Any) -> Any:
        try:
            return self.number(value)
        except (NameError, TypeError, ValueError, SyntaxError):
            return value

    def motion(self, q: np.ndarray, v: np.ndarray) -> dict[str, Any]:
        """What expressions of forces may read: bodies and their points."""
        found: dict[str, Any] = {}
        for k, name in enumerate(self.names):
            x, y, theta = q[3 * k : 3 * k + 3]
            vx, vy, omega = v[3 * k : 3 * k + 3]
            one = found[name] = SimpleNamespace(x=x, y=y, theta=theta, vx=vx, vy=vy, omega=omega)
            for point in self.file["bodies"][name].get("points", {}):
                at = dense.place(self.end(f"{name}.{point}"), q, v)
                setattr(one, point, SimpleNamespace(x=at.r[0], y=at.r[1], vx=at.v[0], vy=at.v[1]))
        return found

    def accelerations(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return dense.accelerations(self.linkage, t, q, v)[0]

    def gaps(self, q: np.ndarray, v: np.ndarray) -> list[tuple[float, float]]:
        """Penetration of each joint with play, and its rate."""
        found = []
        for play, pin in zip(self.linkage.plays, self.pins.values(), strict=True):
            one, two = dense.place(play.first, q, v), dense.place(play.second, q, v)
            e, rate = two.r - one.r, two.v - one.v
            size = float(np.hypot(*e))
            found.append((size - pin.clearance, float(e @ rate / size) if size else 0.0))
        return found


def simulate(machine: Machine, times: np.ndarray, q: np.ndarray, v: np.ndarray, rtol: float = RTOL) -> Motion:
    """The motion from a start by DOP853, which ends steps at onsets of contact and where surfaces part.

    It ends before the last time where it would take too long, after a sixth of the samples at least; else Unknown.
    """
    evaluations = 0
    pins, contacts, t, y, n = list(machine.pins.items()), [], float(times[0]), np.append(q, v), q.size
    for (_, pin), (depth, rate) in zip(pins, machine.gaps(q, v), strict=True):
        pin.stored = max(rate, FLOOR) if depth >= 0.0 else 0.0
    found, longest = [y], float(times[-1] - t) / (400.0 if pins else 40.0)
    size = min([pin.clearance for _, pin in pins] or [1.0])

    def rhs(at: float, state: np.ndarray) -> np.ndarray:
        nonlocal evaluations
        evaluations += 1
        if evaluations > MAX_EVALUATIONS:
            raise _TooLong
        return np.append(state[n:], machine.accelerations(at, state[:n], state[n:]))

    def margin(k: int, sign: float) -> Any:
        def depth(_: float, state: np.ndarray) -> float:
            return sign * machine.gaps(state[:n], state[n:])[k][0]

        depth.terminal, depth.direction = True, 1.0  # type: ignore[attr-defined]
        return depth

    while t < times[-1]:
        watched = [margin(k, -1.0 if pin.stored else 1.0) for k, (_, pin) in enumerate(pins)]
        ahead = float(times[min(len(found) + 40, len(times) - 1)])  # in pieces, so that some are there at the limit
        try:
            run = solve_ivp(
                rhs,
                (t, ahead),
                y,
                "DOP853",
                events=watched or None,
                dense_output=True,
                rtol=rtol,
                atol=rtol * size,
                max_step=longest,
            )
        except _TooLong as error:
            if len(found) < 6 or len(found) < len(times) / 6:
                raise Unknown("it takes too long") from error
            break
        if run.status < 0:
            raise ArithmeticError(run.message)
        reached = [at for at in times[len(found) :] if at <= run.t[-1]]
        found += [run.sol(at) for at in reached]
        t, y = float(run.t[-1]), run.y[:, -1]
        for k, (name, pin) in enumerate(pins):
            if run.t_events[k].size:
                t, y = float(run.t_events[k][-1]), run.y_events[k][-1]
                if pin.stored:
                    pin.stored = 0.0
                else:
                    pin.stored = max(machine.gaps(y[:n], y[n:])[k][1], FLOOR)
                    contacts.append((name, t))
                t, y = _nudged(rhs, t, y)
    rows = np.array(found)
    return Motion(rows[:, :n], rows[:, n:], contacts)


class _TooLong(Exception):
    """The budget of evaluations is spent."""


def _nudged(rhs: Any, t: float, y: np.ndarray) -> tuple[float, np.ndarray]:
    """A little behind an event, so that it is not found again."""
    h = 1e-12
    return t + h, y + h * rhs(t, y)


def positions(machine: Machine, times: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Where a machine without a degree of freedom is at each time, (N, n), by Newton's method from the one before."""
    found, v = [], np.zeros(q.size)
    q = q.copy()
    for k, t in enumerate(times):
        if k:
            r = dense.rows(machine.linkage, float(times[k - 1]), q, v)
            q = q + (t - times[k - 1]) * np.linalg.lstsq(r.phi_q, r.nu, rcond=None)[0]
        for _ in range(30):
            r = dense.rows(machine.linkage, float(t), q, v)
            step = np.linalg.lstsq(r.phi_q, -r.phi, rcond=None)[0]
            q = q + step
            if np.max(abs(step), initial=0.0) < 1e-14:
                break
        found.append(q)
    return np.array(found)


def goes_on(machine: Machine, times: np.ndarray, q: np.ndarray, v: np.ndarray) -> bool:
    """Whether the motion reaches the last time with rows that stay closed and well away from dependent."""
    r = dense.rows(machine.linkage, 0.0, q, v)
    try:
        if np.linalg.matrix_rank(r.phi_q) == q.size and not machine.pins:
            found = positions(machine, times, q)
        else:
            found = simulate(machine, times, q, v).q
    except (np.linalg.LinAlgError, ArithmeticError):
        return False
    for t, at in zip(times, found, strict=False):
        r = dense.rows(machine.linkage, float(t), at, v)
        unit = r.phi_q / np.linalg.norm(r.phi_q, axis=1, keepdims=True)
        if np.max(abs(r.phi), initial=0.0) > 1e-8 or r.phi.size and np.linalg.svd(unit, compute_uv=False)[-1] < 1e-3:
            return False
    return len(found) == len(times)
