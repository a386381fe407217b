"""Define rotors, an engine's bearing and a drill string that reference programs simulate independently of gudgeon.

This file owns their force laws, loads and initial states.

The film of a short bearing is integrated by quadrature, without the line of centres. With u(φ) radially outwards
the gap is h = c − e·u, and seen from a frame that turns with the mean of both surfaces it closes with the velocity
w = ė − ½ (ω_i + ω_j) (e turned +90°): along the axis the pressure is a parabola, and over the half w·u > 0, where it is
above that of the ends,

    F = −μ R_j L³ ∫ (w·u) u/h³ dφ    on the journal.

F. W. Ocvirk, NACA TN 2808 (1952), with squeeze; nothing in it is singular at e = 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from benchmarks.clearance.second import Joint, Pin, Second
from tests.oracles.numpy_linkage import GROUND, TURN, Body, Drive, End, Linkage, Load, Play, Wave, Wrench, place, rows

NODES, WEIGHTS = np.polynomial.legendre.leggauss(160)
QUARTER = math.pi / 2.0


@dataclass
class Begun(Second):
    """A machine that starts from given coordinates and velocities, which satisfy the constraints."""

    def start(self, guess: np.ndarray) -> np.ndarray:
        """Return the state. Raises ValueError if the drives have other values."""
        q, v = np.split(np.array(guess, dtype=float), 2)
        found = rows(self.linkage, 0.0, q, v)
        if max(abs(found.phi).max(initial=0.0), abs(found.phi_q @ v - found.nu).max(initial=0.0)) > 1e-14:
            raise ValueError("drives are elsewhere at the start")
        return np.concatenate([q, v])


@dataclass(frozen=True)
class Short(Pin):
    """Film of a short bearing with its `viscosity`; e < c."""

    def __call__(self, e: np.ndarray, rate: np.ndarray, omega_i: float, omega_j: float) -> Wrench:
        """Return the force on the journal and both torques."""
        w = rate - 0.5 * (omega_i + omega_j) * (TURN @ e)
        angle = math.atan2(w[1], w[0]) + QUARTER * NODES
        u = np.array([np.cos(angle), np.sin(angle)])
        journal, speed = self.radius - self.clearance, float(np.hypot(*w))
        pressed = QUARTER * WEIGHTS * speed * np.cos(QUARTER * NODES) / (self.clearance - e @ u) ** 3
        force = -self.viscosity * journal * self.width**3 * (u @ pressed)
        turning = float(e[0] * force[1] - e[1] * force[0])
        if not self.shear:
            return Wrench(force, -turning, 0.0)
        gap = math.sqrt(self.clearance**2 - float(e @ e))
        torque = 2.0 * math.pi * self.viscosity * journal**3 * self.width / gap * (omega_j - omega_i)
        return Wrench(force, torque - turning / 2.0, -torque - turning / 2.0)


@dataclass(frozen=True)
class Elastic(Pin):
    """Linear spring without damping, friction μ tanh(slip/`sliding`)."""

    sliding: float = math.inf

    def _dry(self, e: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, ...]:
        """Return radial and tangential force, and both torques."""
        delta = e - self.clearance
        if delta <= 0.0:
            return 0.0, 0.0, 0.0, 0.0
        arm_i, arm_j = self.radius + delta / 2.0, self.radius - self.clearance - delta / 2.0
        slip = v_t + omega_j * arm_j - omega_i * arm_i
        normal = self.stiffness * delta
        tangential = -self.mu * math.tanh(slip / self.sliding) * normal
        return -normal, tangential, -arm_i * tangential, arm_j * tangential


@dataclass(frozen=True)
class Shaft:
    """Isotropic spring and damper between two points: k and d (N/m, N s/m)."""

    first: End
    second: End
    k: float
    d: float

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the generalized forces."""
        one, two = place(self.first, q, v), place(self.second, q, v)
        return np.asarray((one.r_q - two.r_q).T @ (self.k * (two.r - one.r) + self.d * (two.v - one.v)))

    def potential(self, q: np.ndarray) -> float:
        """Return the potential energy, which is not used: 0."""
        return 0.0


@dataclass(frozen=True)
class Gas:
    """Force along x on body 0: F(ω t), ω in rad/s."""

    load: CubicSpline
    speed: float

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the generalized forces."""
        g = np.zeros(q.size)
        g[0] = float(self.load(math.degrees(self.speed * t)))
        return g

    def potential(self, q: np.ndarray) -> float:
        """Return the potential energy, 0."""
        return 0.0


@dataclass(frozen=True)
class Square:
    """Function of time alpha t²/2."""

    alpha: float

    def value(self, t: float) -> float:
        """Return the value at t."""
        return 0.5 * self.alpha * t * t

    def rate(self, t: float) -> float:
        """Return the first derivative at t."""
        return self.alpha * t

    def acceleration(self, t: float) -> float:
        """Return the second derivative at t."""
        return self.alpha


@dataclass(frozen=True)
class String:
    """Forces of a drill string on its collar, body 0, whose centre is `e` off its centre of mass on its x axis.

    Bending, at the centre of mass: −(k − softer T) r of the centre; drag of the mud at the centre: −drag |ṙ| ṙ; the
    pipes, from the rotary table at `speed`: −k_t (φ − Ω t) − c_t (φ' − Ω); the rock: −T, with
    T = torque (tanh b1 φ' + b2 φ'/(1 + b3 φ'²)).
    """

    e: float
    k: float
    softer: float
    drag: float
    k_t: float
    c_t: float
    speed: float
    torque: float
    b: tuple[float, float, float]

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the generalized forces."""
        phi, rate = float(q[2]), float(v[2])
        arm = self.e * np.array([math.cos(phi), math.sin(phi)])
        r, velocity = q[:2] - arm, v[:2] - rate * (TURN @ arm)
        rock = self.torque * (math.tanh(self.b[0] * rate) + self.b[1] * rate / (1.0 + self.b[2] * rate**2))
        mud = -self.drag * float(np.hypot(*velocity)) * velocity
        turning = -self.k_t * (phi - self.speed * t) - self.c_t * (rate - self.speed) - rock
        turning += float(mud[0] * arm[1] - mud[1] * arm[0])  # at the centre, about the centre of mass
        return np.array([*(mud - (self.k - self.softer * rock) * r), turning])

    def potential(self, q: np.ndarray) -> float:
        """Return the potential energy, which is not used: 0."""
        return 0.0


def begun(
    bodies: Sequence[Body],
    drives: Sequence[Drive],
    loads: Sequence[Load],
    plays: Sequence[Play],
    weight: float = 0.0,
    method: str = "DOP853",
) -> Begun:
    """Return a machine without ideal joints, with gravity `weight` (m/s²) along −y."""
    linkage = Linkage(tuple(bodies), (), tuple(drives), gravity=(0.0, -weight), loads=tuple(loads))
    joints = [Joint(play, play.law) for play in plays]  # type: ignore[arg-type]
    return Begun(linkage, joints, rtol=1e-13 if method == "DOP853" else 1e-12, method=method)


def bearing(body: int, law: Pin, at: tuple[float, float] = (0.0, 0.0)) -> Play:
    """Return play between the ground at the origin and a point of a body."""
    return Play(End(GROUND, (0.0, 0.0)), End(body, at), law)


def rigid_rotor() -> tuple[Begun, list[float]]:
    """Return the rigid rotor and its start; the journal's centre is e below the centre of mass."""
    e, c = 1e-6, 15e-6
    law = Short(radius=3.5e-3 + c, clearance=c, width=3.5e-3, viscosity=2e-2)
    drives = (Drive(0, GROUND, Square(2.0 * math.pi * 700.0)),)
    second = begun([Body(0.1, 1e-6)], drives, (), [bearing(0, law, (0.0, -e))], 9.81)
    return second, [0.0, e, 0.0, 0.0, 0.0, 0.0]


def elastic_rotor() -> tuple[Begun, list[float]]:
    """Return the elastic rotor and its start; bodies: journal and disc."""
    e, c, k, m = 1e-6, 15e-6, 1e5, 0.1
    law = Short(radius=3.5e-3 + c, clearance=c, width=3.5e-3, viscosity=2e-2)
    drives = [Drive(body, GROUND, Square(2.0 * math.pi * 500.0)) for body in (0, 1)]
    shaft = Shaft(End(0, (0.0, 0.0)), End(1, (0.0, -e)), k, 1e-2 * math.sqrt(k * m))
    second = begun([Body(1e-5, 1e-9), Body(m, 1e-6)], drives, (shaft,), [bearing(0, law)], 9.81, "Radau")
    return second, [0.0, 0.0, 0.0, 0.0, e, 0.0, *[0.0] * 6]


def floating_ring() -> tuple[Begun, list[float]]:
    """Return the rotor in floating rings and its start; bodies: journal, disc and ring."""
    e, k, m = 3e-6, 2e4, 5.0
    inner = Short(radius=12.5e-3 + 50e-6, clearance=50e-6, width=20e-3, viscosity=2e-2, shear=True)
    outer = Short(radius=20e-3 + 70e-6, clearance=70e-6, width=20e-3, viscosity=4e-2, shear=True)
    drives = [Drive(body, GROUND, Square(2.0 * math.pi * 300.0)) for body in (0, 1)]
    shaft = Shaft(End(0, (0.0, 0.0)), End(1, (0.0, -e)), k, 2e-2 * math.sqrt(k * m))
    plays = (bearing(2, outer), Play(End(2, (0.0, 0.0)), End(0, (0.0, 0.0)), inner))
    second = begun([Body(1.0, 1e-4), Body(m, 1e-2), Body(75e-3, 20e-6)], drives, (shaft,), plays, 9.81, "Radau")
    return second, [0.0, 0.0, 0.0, 0.0, e, *[0.0] * 4, *[0.0] * 9]


def engine_bearing() -> tuple[Begun, list[float]]:
    """Return the engine's bearing and its start; loads in kN by crank angle in degrees, periodic."""
    loads = [
        (-0.570621, -2.012326),
        (15.768046, -1.595861),
        (34.544827, -1.365927),
        (51.431137, -1.182637),
        (68.188551, -1.204212),
        (87.101887, -1.020913),
        (104.527875, -0.809306),
        (120.872984, -0.604367),
        (139.924246, -0.512673),
        (156.677399, -0.394341),
        (173.557215, 0.00214),
        (192.464921, 0.370316),
        (209.346919, 0.695178),
        (226.090992, 1.111646),
        (244.595321, 1.413198),
        (261.887695, 1.574837),
        (278.912488, 1.6482),
        (297.704183, 1.38846),
        (314.605203, 1.088737),
        (331.368349, 0.878955),
        (350.292845, 0.695831),
        (367.055839, 0.491044),
        (386.113492, 0.372878),
        (403.005533, 0.367959),
        (419.900923, 0.253114),
        (438.686784, 0.184913),
        (455.442879, 0.206643),
        (472.470614, 0.183404),
        (491.525375, 0.160174),
        (508.148313, 0.116946),
        (525.18665, -0.254394),
        (544.253434, -0.672362),
        (560.621675, -1.226917),
        (577.93155, -1.639896),
        (596.452872, -1.896306),
        (613.759501, -2.202689),
        (630.659151, -2.457441),
        (649.570865, -2.220844),
        (666.186194, -2.014238),
        (683.213269, -2.015825),
        (701.726729, -2.014074),
        (718.618619, -2.013995),
        (719.429379, -2.012326),
    ]
    angle, load = np.array(loads).T
    speed, c = 2000.0 / 60.0 * 2.0 * math.pi, 35.56e-6
    law = Short(radius=31.75e-3 + c, clearance=c, width=25.4e-3, viscosity=4.16e-3)
    gas = Gas(CubicSpline(angle, 1e3 * load, bc_type="periodic"), speed)
    drives = (Drive(0, GROUND, Wave(0.0, speed)),)
    second = begun([Body(1.0, 1e-3)], drives, (gas,), [bearing(0, law)], method="Radau")
    return second, [0.1 * c * math.cos(1.5), 0.1 * c * math.sin(1.5), 0.0, 0.0, 0.0, speed]


def rotor_and_stator() -> tuple[Begun, list[float]]:
    """Return the rotor in its stator and its start: the centre is at rest at a hundredth of the gap."""
    e, c, speed = 0.18e-3, 1e-3, 3100.0
    law = Elastic(radius=50e-3, clearance=c, width=10e-3, stiffness=50e6, mu=0.0)
    shaft = Shaft(End(GROUND, (0.0, 0.0)), End(0, (-e, 0.0)), 1e6, 50.0)
    drives = (Drive(0, GROUND, Wave(0.0, speed)),)
    second = begun([Body(10.0, 1e-2)], drives, (shaft,), [bearing(0, law, (-e, 0.0))])
    return second, [0.01 * c + e, 0.0, 0.0, 0.0, e * speed, speed]


def drill_collar() -> tuple[Begun, list[float]]:
    """Return section 3 of the drill collars and its start; pipes and all sections rotate."""
    young, shear, steel, mud = 220e9, 85.3e9, 7800.0, 1500.0
    pipe, first, collar = (0.140, 0.119), (0.140, 0.076), (0.171, 0.071)
    length = {"pipe": 4733.6, "first": 171.30, "second": 267.10, "third": 8.55, "last": 19.25}
    area = math.pi * (collar[0] ** 2 - collar[1] ** 2) / 4.0
    fourth = {name: d[0] ** 4 - d[1] ** 4 for name, d in (("pipe", pipe), ("first", first), ("collar", collar))}
    L, weight, speed, e = length["third"], 135e3, 105.0 * 2.0 * math.pi / 60.0, pipe[0] / 10.0
    m = steel * area * L / 2.0
    total = m + math.pi * mud * (collar[1] ** 2 + 1.7 * collar[0] ** 2) * L / 8.0
    axial = weight - steel * 9.81 * area * (length["last"] + L / 2.0)
    k = math.pi**4 * young * math.pi * fourth["collar"] / 64.0 / (2.0 * L**3) - axial * math.pi**2 / (2.0 * L)
    J = (
        steel
        * math.pi
        / 32.0
        * (
            fourth["pipe"] * length["pipe"] / 3.0
            + fourth["first"] * length["first"]
            + fourth["collar"] * (length["second"] + L + length["last"])
        )
    )
    k_t = shear * math.pi * fourth["pipe"] / 32.0 / length["pipe"]
    string = String(
        e,
        k,
        math.pi**3 / (2.0 * L**2),
        2.0 * mud * collar[0] * L / (3.0 * math.pi),
        k_t,
        0.35 * J + 0.06 * k_t,
        speed,
        weight * 0.0239,
        (1.91, 8.5, 5.47),
    )
    law = Elastic(
        radius=0.108, clearance=0.0225, width=L, stiffness=1e9, mu=0.35, v0=math.inf, v1=math.inf, sliding=1e-3
    )
    second = begun([Body(total, J)], (), (string,), [bearing(0, law, (-e, 0.0))])
    return second, [m * 9.81 * 1e-7 / k + e, *[0.0] * 5]
