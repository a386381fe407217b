"""Links that PMKS+ shared until April 2023: plain text, which PMKS+ itself no longer reads.

After "?" stand `j=` and a line for each joint, `&l=` and a line for each link, `&f=` and forces, `&s=` and settings;
a line's values stand between commas. Its columns changed over the years: what is read is told apart by their number.
"""

from __future__ import annotations

import math

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import MAX_NUMBER, Linkage
from gudgeon.exchange.pmks import Joints, add_link, drive_inputs, place_joint, refuse_unknown

BEGIN = "j="
REMEDY = "this link is of PMKS+ before April 2023: draw the linkage in today's PMKS+ and share it from there"
UNITS = {"cm": (1.0, "cm"), "m": (1.0, "m"), "metric": (1.0, "cm"), "si": (1.0, "m"), "inch": (0.0254, "m"),
         "in": (0.0254, "m"), "english": (0.0254, "m"), "mm": (1.0, "mm")}  # fmt: skip


def of_old_pmks(address: str, name: str = "pmks") -> Linkage:
    """A linkage from what stands after the question mark. Raises InputError for what is not in such links."""
    try:
        return _read(address, name)
    except InputError as error:
        raise InputError(error.message, hint=error.hint or REMEDY) from error


def _read(address: str, name: str) -> Linkage:
    parts = dict(part.split("=", 1) for part in address.split("&") if "=" in part)
    settings = [cell.strip() for cell in parts.get("s", "").split(",")]
    if len(settings) < 4 or settings[3].lower() not in UNITS:
        raise InputError(f"its settings are {parts.get('s', '')!r}, expected a speed, a direction, gravity and a unit")
    scale, unit = UNITS[settings[3].lower()]
    linkage, found = Linkage(name, unit, measured=True), Joints()
    for line in filter(str.strip, parts.get("j", "").splitlines()):
        _joint(linkage, line.strip(), found, scale)
    for line in filter(str.strip, parts.get("l", "").splitlines()):
        cells = line.strip().split(",")
        if len(cells) < 6:
            raise InputError(f"{line[:60]!r} is no link of PMKS+")
        mass, inertia, x, y = (_number(cells[k], f"link {cells[0]}") for k in (1, 2, 3, 4))
        joints = list(dict.fromkeys(filter(None, cells[5].split("|"))))
        refuse_unknown(linkage, cells[0], joints)
        add_link(linkage, cells[0], joints, mass, inertia, (scale * x, scale * y), found)
    rate = _number(settings[0], "the speed") * math.pi / 30.0
    drive_inputs(linkage, found, -rate if settings[1] == "true" else rate)
    linkage.notes.append("its masses are taken for kg, moments of inertia for kg m^2")
    if settings[2] == "true":
        linkage.gravity = 0.0, -9.81
    if parts.get("f", "").strip():
        linkage.notes.append("forces of the file are left out")
    return linkage


def _joint(linkage: Linkage, line: str, found: Joints, scale: float) -> None:
    """Id, x, y, links, kind, whether it is grounded, angle, friction, whether it is driven.

    From 2022 on: id, x, y, links, kind and whether it is grounded in one, whether it is driven.
    """
    cells = line.rstrip(",").split(",")
    name = cells[0]
    if len(cells) == 6 and len(cells[4]) == 2:
        kind, grounded, driven = cells[4][0], cells[4][1], cells[5]
    elif len(cells) >= 9:
        kind, grounded, driven = cells[4], cells[5], cells[8]
    else:
        raise InputError(f"{line[:60]!r} is no joint of PMKS+")
    if kind != "R":
        raise InputError(f"joint {name}: a slider of such a link is not read", hint=REMEDY)
    if grounded not in ("t", "f") or driven not in ("t", "f"):
        raise InputError(f"joint {name}: expected t or f for whether it is grounded and driven")
    x, y = (_number(cells[k], f"joint {name}") for k in (1, 2))
    place_joint(linkage, name, (scale * x, scale * y), grounded == "t")
    if driven == "t":
        found.inputs.append(name)


def _number(text: str, whose: str) -> float:
    try:
        value = float(text) if "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not abs(value) <= MAX_NUMBER:
        raise InputError(f"{whose}: {text[:40]!r} is no number of a linkage")
    return value
