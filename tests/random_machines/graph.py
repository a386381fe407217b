"""A random linkage of tests/oracles/random_mechanism.py as a design: more drives, drag, extreme inertias, events."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.linkage_joints import CoordinateDrive, Distance, DistanceDrive, Gear, PointOnLine, Rigid
from tests.oracles.linkage_loads import Force, RotationalSpring, Spring, Torque
from tests.oracles.numpy_linkage import GROUND, Drive, End, Revolute, Translational
from tests.oracles.random_linkage import Case
from tests.random_machines.design import Design
from tests.random_machines.numbers import (
    ACCELERATION,
    FORCE,
    INERTIA,
    LENGTH,
    MASS,
    MOMENT,
    NONE,
    RATE,
    TIME,
    Dims,
    Numbers,
)


def _body(k: int) -> str:
    return "ground" if k == GROUND else f"b{k}"


class Graph:
    """Writes the parts of a case with parameters for numbers."""

    def __init__(self, case: Case, rng: np.random.Generator) -> None:
        self.case, self.rng, self.n = case, rng, Numbers()
        self.points: dict[str, dict[str, list[str]]] = {}
        self.com = rng.uniform(-0.1, 0.1, (len(case.linkage.bodies), 2))
        self.curves: dict[str, Any] = {}
        self.without: set[str] = set()

    def end(self, end: End) -> str:
        name = _body(end.body)
        own = self.points.setdefault(name, {})
        at = np.array(end.at) + (0.0 if end.body == GROUND else self.com[end.body])
        own[f"p{len(own)}"] = self.n.vector(at, LENGTH, name, point=True)
        return f"{name}.p{len(own) - 1}"

    def ends(self, part: Any) -> list[str]:
        return [self.end(part.first), self.end(part.second)]

    def between(self, first: int, second: int, angle: float) -> str:
        """An angle θ_second − θ_first."""
        return self.n.add(angle, flips=True, turns=(second != GROUND) - (first != GROUND))

    def joint(self, joint: Any) -> dict[str, Any]:
        if isinstance(joint, Gear):
            radii = [self.n.add(abs(r), LENGTH) for r in joint.radii]
            bodies = [_body(joint.first.body), _body(joint.second.body)]
            return {"gear": bodies, "radii": radii, "carrier": _body(joint.carrier), "internal": joint.radii[1] < 0}
        ends = self.ends(joint)
        if isinstance(joint, Revolute):
            return {"revolute": ends}
        if isinstance(joint, Distance):
            return {"distance": ends, "length": self.n.add(joint.length, LENGTH)}
        if isinstance(joint, PointOnLine):
            line = self.n.vector(np.array(joint.direction), NONE, _body(joint.second.body))
            return {"point_on_line": ends, "direction": line}
        angle = self.between(joint.first.body, joint.second.body, joint.angle)
        if isinstance(joint, Rigid):
            return {"rigid": ends, "angle": angle}
        assert isinstance(joint, Translational)
        axis = self.n.vector(np.array(joint.axis), NONE, _body(joint.first.body))
        return {"translational": ends, "axis": axis, "angle": angle}

    def value(self, now: str, dims: Dims, flips: bool, law: Any) -> str:
        """What is `now` at t = 0, about."""

        def part(x: float, more: Dims = NONE) -> str:
            return self.n.add(x, (dims[0] + more[0], dims[1], dims[2] + more[2]), flips)

        text, rate = f"{now} + {part(law.b, RATE)}*t", self.n.add(law.w, RATE)
        kind, start = self.rng.integers(8), self.n.add(float(self.rng.uniform(0.1, 0.4)), TIME)
        if kind <= 1:
            return f"{text} + {part(law.c)}*sin({rate}*t)"
        if kind == 2:
            return f"{text} + {part(law.c)}*smooth_step(t, {start}, {self.n.add(0.2, TIME)})"
        if kind == 3:
            return f"{text} + where(t < {start}, 0*{part(law.c)}, {part(law.c)}*({rate}*(t - {start}))**2)"
        if kind == 4:
            self.curves["lift"] = {"points": [[0, 0], [1, 0.5], [2, 1], [4, -0.3], [6, 0]], "ends": "periodic"}
            return f"{text} + {part(law.c)}*lift({rate}*t)"
        if kind == 5:  # a second rate without bounds
            return f"{text} + {part(0.3 * law.c)}*abs({rate}*(t - {start}))**1.5"
        if kind == 6:  # its rate jumps
            self.without.add("oracle")
            return f"{text} + {part(law.c)}*ramp(t, {start}, {self.n.add(0.3, TIME)})"
        return f"{text} + {part(law.c)}*(1 - cos({rate}*t))*exp(-{rate}*t)"

    def drive(self, drive: Any) -> dict[str, Any]:
        if isinstance(drive, Drive):
            now = self.between(drive.reference, drive.body, drive.law.value(0.0))
            alone = drive.reference == GROUND
            target = _body(drive.body) if alone else [_body(drive.body), _body(drive.reference)]
            return {"angle": target, "value": self.value(now, NONE, True, drive.law)}
        if isinstance(drive, CoordinateDrive):
            which = ("x", "y", "theta")[drive.which]
            dims = NONE if drive.which == 2 else LENGTH
            self.without |= {"rotate"} if drive.which < 2 else set()
            now = self.n.add(drive.law.value(0.0), dims, drive.which > 0, int(drive.which == 2))
            value = self.value(now, dims, drive.which > 0, drive.law)
            return {"coordinate": f"{_body(drive.body)}.{which}", "value": value}
        assert isinstance(drive, DistanceDrive)
        now = self.n.add(drive.law.value(0.0), LENGTH)
        return {"distance": self.ends(drive), "value": self.value(now, LENGTH, False, drive.law)}

    def load(self, load: Any) -> dict[str, Any]:
        if isinstance(load, Spring):
            numbers = {
                "stiffness": (load.stiffness, (0, 1, -2)),
                "free_length": (load.free_length, LENGTH),
                "damping": (load.damping, (0, 1, -1)),
            }
            return {"spring_damper": self.ends(load), **{key: self.n.add(x, d) for key, (x, d) in numbers.items()}}
        if isinstance(load, RotationalSpring):
            bodies = [_body(load.first), _body(load.second)]
            free = self.between(load.first, load.second, load.free_angle)
            own = {"stiffness": self.n.add(load.stiffness, MOMENT), "damping": self.n.add(load.damping, (2, 1, -1))}
            return {"rotational_spring_damper": bodies, "free_angle": free, **own}
        if isinstance(load, Force):
            at, name = self.end(load.at), _body(load.at.body)
            if self.rng.random() < 0.5:  # a drag that grows with the square of the speed
                c = self.n.add(abs(load.x.constant), (-1, 1, 0))
                speed = f"hypot({at}.vx, {at}.vy)"
                return {"force": at, "value": [f"-{c}*{speed}*{at}.{v}" for v in ("vx", "vy")], "axes": "ground"}
            axes = "body" if load.in_body else "ground"
            frame = name if load.in_body else "ground"
            pair = self.n.vector(np.array([load.x.constant, load.y.constant]), FORCE, frame)
            wave = f"(1 + {self.n.add(0.5)}*sin({self.n.add(load.x.w, RATE)}*t))"
            return {"force": at, "value": [f"{x}*{wave}" for x in pair], "axes": axes}
        assert isinstance(load, Torque)
        name, alone = _body(load.first), load.second == GROUND
        target = name if alone else [name, _body(load.second)]
        rate = f"{name}.omega" if alone else f"({name}.omega - {_body(load.second)}.omega)"
        c, f = self.n.add(0.05 * abs(load.value.constant), (2, 1, 0)), self.n.add(load.value.constant)
        if self.rng.random() < 0.5:
            return {"torque": target, "value": f"-{c}*abs({rate})*{rate}"}
        wave = self.n.add(1.0, flips=True)
        return {"torque": target, "value": f"-0.5 N*m*{f}*{wave}*cos({self.n.add(3.0, RATE)}*t)"}

    def design(self, seed: int) -> Design:
        case, linkage = self.case, self.case.linkage
        bodies: dict[str, Any] = {}
        extreme = self.rng.random() < 0.2
        for k, part in enumerate(linkage.bodies):
            inertia = part.inertia * (10.0 ** self.rng.uniform(-9.0, 2.0) if extreme else 1.0)
            own = {"mass": self.n.add(part.mass, MASS), "inertia": self.n.add(inertia, INERTIA)}
            bodies[f"b{k}"] = {**own, "com": self.n.vector(self.com[k], LENGTH, f"b{k}", point=True)}
        file: dict[str, Any] = {"gravity": self.n.vector(np.array(linkage.gravity), ACCELERATION), "bodies": bodies}
        parts = {
            "joints": (linkage.joints, self.joint, "j"),
            "drives": (linkage.drives, self.drive, "d"),
            "forces": (linkage.loads, self.load, "f"),
        }
        sections = {
            name: {f"{letter}{k}": write(x) for k, x in enumerate(of)} for name, (of, write, letter) in parts.items()
        }
        for name, points in self.points.items():
            if name == "ground":
                file["ground"] = points
            else:
                bodies[name]["points"] = points
        if self.curves:
            file["curves"] = self.curves
        file |= {name: section for name, section in sections.items() if section}
        guess: dict[str, str] = {}
        for k in range(len(linkage.bodies)):
            x, y, theta = case.q[3 * k : 3 * k + 3]
            pair = self.n.vector(np.array([x, y]), LENGTH, point=True)
            guess |= {f"b{k}.x": pair[0], f"b{k}.y": pair[1], f"b{k}.theta": self.n.add(theta, flips=True, turns=1)}
        file["start"] = {"guess": guess}
        file["events"] = {"turns": {"zero": "b0.omega"}}
        if "-0.5 N*m" in str(sections["forces"]):
            self.without.add("units")
        return Design("graph", seed, file, self.n, 0.6, without=frozenset(self.without))
