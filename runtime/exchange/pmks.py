"""Shared links of PMKS+ (https://pmksplus.com), which hold the whole mechanism in their address.

Behind "?" stand, parted by dots, flags, decimal and whole settings, units, then a part for each joint, nothing, a part
for each link, nothing, and forces. Numbers are in thousandths to the base 64; a 0 in front makes one negative.
"""

from __future__ import annotations

import math
import re

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import Body, Drive, Line, Linkage

ADDRESS = re.compile(r"https?://\S*pmks\S*?\?([\w.,~%-]+)")
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
PRISMATIC, INPUT, GROUNDED = 1, 2, 4  # of a joint's flags
CLOCKWISE, GRAVITY = 1, 2  # of those in front
LENGTHS = ((0.0254, "m"), (1.0, "cm"), (1.0, "m"))  # of the first digit of the units: inches, cm, m
PISTON = "P"


def of_pmks(address: str, name: str = "pmks") -> Linkage:
    """A linkage from what stands behind the question mark. Raises InputError for what PMKS+ does not write.

    Inches, which are no unit of gudgeon's, become metres.
    """
    head, _, rest = address.partition("..")
    parts = head.split(".")
    if len(parts) < 5:
        raise InputError("the address has too few parts", hint="take the whole link that Share gives")
    flags, _, whole, units, *joints = parts
    scale, unit = LENGTHS[min(_digit(units[:1] or "1"), len(LENGTHS) - 1)]
    linkage = Linkage(name, unit, measured=True)
    inputs, sliders = set[str](), dict[str, float]()
    for joint in joints:
        _joint(linkage, joint, inputs, sliders, scale)
    rpm = float(_integer(whole.split(",")[0]))
    settings = _packed(flags)
    rate = rpm * math.pi / 30.0 * (-1.0 if settings & CLOCKWISE else 1.0)
    links, _, forces = rest.partition("..")
    for link in filter(None, links.split(".")):
        _link(linkage, link, inputs, sliders, rate, scale)
    linkage.notes.append("its masses are taken for kg, moments of inertia for kg m^2")
    if settings & GRAVITY:
        linkage.gravity = 0.0, -9.81
    if forces.strip(".") and "," in forces:
        linkage.notes.append("forces of the file are left out")
    return linkage


def _digit(text: str) -> int:
    found = DIGITS.find(text)
    if found < 0 or not text:
        raise InputError(f"{text!r} is no digit of PMKS+")
    return found


def _packed(text: str) -> int:
    """Flags, a bit each."""
    total = 0
    for digit in text:
        total = 64 * total + _digit(digit)
    return total


def _integer(text: str) -> int:
    total = _packed(text)
    return -total if len(text) > 1 and text[0] == "0" else total


def _decimal(text: str) -> float:
    return _integer(text) / 1000.0


def _joint(linkage: Linkage, text: str, inputs: set[str], sliders: dict[str, float], scale: float) -> None:
    """Flags and id, name, x, y, angle (rad) of a slider's way."""
    cells = text.split(",")
    if len(cells) < 5 or len(cells[0]) < 2:
        raise InputError(f"{text!r} is no joint of PMKS+")
    flags, name = _digit(cells[0][0]), cells[0][1:]
    linkage.positions[name] = scale * _decimal(cells[2]), scale * _decimal(cells[3])
    if flags & PRISMATIC:
        sliders[name] = _decimal(cells[4])
    if flags & GROUNDED:
        linkage.ground[name] = linkage.positions[name]
    if flags & INPUT:
        inputs.add(name)


def _link(
    linkage: Linkage, text: str, inputs: set[str], sliders: dict[str, float], rate: float, scale: float
) -> None:  # fmt: skip
    """Whether it is a link of its own, its kind, id, name, mass, moment of inertia, centre of mass, colour, joints."""
    cells = text.split(",")
    if len(cells) < 9 or len(cells[0]) < 3:
        raise InputError(f"{text!r} is no link of PMKS+")
    if cells[0][0] == "N":  # welded into another one
        return
    kind, name = cells[0][1], cells[0][2:]
    joints = cells[7 : cells.index("", 7) if "" in cells[7:] else None]
    unknown = [joint for joint in joints if joint not in linkage.positions]
    if unknown:
        raise InputError(f"link {name}: no joint is called {unknown[0]}")
    mass, inertia = _decimal(cells[2]) or None, _decimal(cells[3]) or None
    if kind == PISTON:
        _piston(linkage, joints, sliders, name, inputs)
        return
    joints.sort(key=lambda joint: joint not in inputs)
    com = scale * _decimal(cells[4]), scale * _decimal(cells[5])
    body = Body(name, {joint: linkage.positions[joint] for joint in joints}, mass, inertia, com)
    linkage.bodies.append(body)
    if joints[0] in inputs and joints[0] in linkage.ground:
        linkage.drives.append(Drive(name, joints[0], rate))


def _piston(linkage: Linkage, joints: list[str], sliders: dict[str, float], name: str, inputs: set[str]) -> None:
    """Its pin keeps to the way of its slider, which is fixed to the ground."""
    way = next((joint for joint in joints if joint in sliders), None)
    pin = next((joint for joint in joints if joint not in sliders), None)
    if way is None or pin is None:
        raise InputError(f"piston {name}: expected a slider and a pin")
    if way in inputs:
        raise InputError(f"piston {name}: a slider that is driven is not read", hint="drive it in gudgeon's file")
    linkage.ground[way] = linkage.positions[way]
    linkage.lines.append(Line(pin, way, None, (math.cos(sliders[way]), math.sin(sliders[way]))))
    linkage.notes.append(f"the mass of piston {name} is left out: its pin runs in a slot")
