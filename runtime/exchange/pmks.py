"""Read (parse) the URLs that PMKS+ (https://pmksplus.com) shares; such a URL encodes the whole mechanism.

After "?" follow, separated by dots, flags, decimal and whole settings, units, a part for each joint, an empty part, a
part for each link, an empty part, and forces. Numbers are in thousandths to the base 64; a leading 0 makes a number
negative. Until June 2023 joints and links had no names, and a part with names by id could precede the joints.

Links that PMKS+ shared until April 2023 are plain text, which PMKS+ itself no longer reads (`read_old_pmks`). After "?"
follow `j=` and a line for each joint, `&l=` and a line for each link, `&f=` and forces, `&s=` and settings; commas
separate the values of a line. The columns changed over the years: their number decides how they are read.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from urllib.parse import unquote

from gudgeon.errors import InputError
from gudgeon.exchange.linkage import MAX_NUMBER, Body, Drive, Line, Linkage, Point

DIGITS = {digit: k for k, digit in enumerate("0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-")}
MAX_DIGITS = 12  # digits of a number to the base 64
PRISMATIC, INPUT, GROUNDED = 1, 2, 4  # bits of a joint's flags
CLOCKWISE, GRAVITY = 1, 2  # bits of the flags of the mechanism
LENGTH_UNITS = ((0.0254, "m"), (1.0, "cm"), (1.0, "m"))  # (factor, unit) by the first digit of the units: inch, cm, m
PISTON, ROOT = "P", "Y"
OLD_LINK_PREFIX = "j="
OLD_LINK_HINT = "the link is from PMKS+ before April 2023: draw the linkage in the present PMKS+ and share it again"
UNITS = {
    "cm": (1.0, "cm"),
    "m": (1.0, "m"),
    "metric": (1.0, "cm"),
    "si": (1.0, "m"),
    "inch": (0.0254, "m"),
    "in": (0.0254, "m"),
    "english": (0.0254, "m"),
    "mm": (1.0, "mm"),
}


@dataclass
class SpecialJoints:
    """Names of driven joints, and directions (rad) of sliders, of one mechanism of PMKS+."""

    inputs: list[str] = field(default_factory=list)
    sliders: dict[str, float] = field(default_factory=dict)


def find_query(text: str) -> str | None:
    """Return the decoded query (after "?") of the first URL of PMKS+ in a text; None if there is none.

    The query ends before the first space, bracket or quotation mark."""
    for link in text.split():
        start = link.find("://")
        host = link.find("pmks", start)
        question_mark = link.find("?", host)
        if start > 0 and host > 0 and question_mark > 0:
            query = link[question_mark + 1 :]
            end = min((position for position in map(query.find, "<>()[]\"'`") if position >= 0), default=len(query))
            return unquote(query[:end])
    return None


def read_pmks(query: str, name: str = "pmks") -> Linkage:
    """Return the linkage of a link of PMKS+; `query`: the text after the question mark, `name`: of the mechanism.

    Inches become metres, since gudgeon has no inches. Gravity is 9.81 m/s² downwards if the link has it; forces are
    omitted. Assumptions are among the notes. Raises InputError for text that PMKS+ does not write.
    """
    sections = query.split(".")
    if len(sections) < 5:
        raise InputError("the link of PMKS+ has too few parts", hint="copy the complete link from Share")
    flags, _, integer_settings, unit_settings = sections[:4]
    scale, unit = LENGTH_UNITS[min(_decode_digits(unit_settings[:1] or "1"), len(LENGTH_UNITS) - 1)]
    linkage, special_joints = Linkage(name, unit, has_unit=True), SpecialJoints()
    joints, links, forces = _split_sections(sections[4:])
    for joint in joints:
        _read_joint(linkage, joint, special_joints, scale)
    flag_bits = _decode_digits(flags)
    rate = (
        _decode_integer(integer_settings.partition(",")[0]) * math.pi / 30.0 * (-1.0 if flag_bits & CLOCKWISE else 1.0)
    )
    _read_links(linkage, links, special_joints, scale)
    add_input_drives(linkage, special_joints, rate)
    linkage.notes.append("masses are assumed to be in kg, moments of inertia in kg m^2")
    if flag_bits & GRAVITY:
        linkage.gravity = 0.0, -9.81
    if any("," in force for force in forces):
        linkage.notes.append("forces of the file are omitted")
    return linkage


def _split_sections(parts: Sequence[str]) -> tuple[list[str], list[str], list[str]]:
    """Return the parts of joints, of links and of forces, three lists; an empty part ends each section.

    A part with names by id, which old links have before the joints, is skipped. Raises InputError for a truncated link.
    """
    sections: list[list[str]] = [[]]
    for part in parts:
        if part:
            sections[-1].append(part)
        else:
            sections.append([])
    if not sections[0]:  # no names by id, or no joints
        del sections[0]
    elif len(sections) > 1:
        first_cells, cells_of_links = (
            sections[0][0].split(","),
            {cell for link in sections[1] for cell in link.split(",")},
        )
        if len(first_cells) % 2 == 0 and first_cells[0][1:] not in cells_of_links:
            del sections[0][0]
    if len(sections) < 3 or not sections[0]:
        raise InputError("the link of PMKS+ is truncated", hint="copy the complete link from Share")
    return sections[0], sections[1], sections[2]


def _decode_digits(text: str) -> int:
    """Return the value of digits to the base 64, such as flags with one bit each; 0 for no digits.

    Raises InputError for any other character.
    """
    value = 0
    for digit in text:
        if digit not in DIGITS:
            raise InputError(f"{digit!r} is not a digit of PMKS+", hint="copy the complete link from Share")
        value = 64 * value + DIGITS[digit]
    return value


def _decode_integer(text: str) -> int:
    """Return a whole number to the base 64; a leading 0 makes it negative.

    Raises InputError for too many digits.
    """
    if len(text) > MAX_DIGITS:
        raise InputError(f"{text[:MAX_DIGITS]}… has {len(text)} digits, expected at most {MAX_DIGITS}")
    value = _decode_digits(text)
    return -value if len(text) > 1 and text[0] == "0" else value


def _decode_decimal(text: str) -> float:
    """Return a number that is given in thousandths."""
    return _decode_integer(text) / 1000.0


def _read_joint(linkage: Linkage, text: str, special_joints: SpecialJoints, scale: float) -> None:
    """Read the part of a joint and add it to the linkage; a slider or an input is also added to `special_joints`.

    Its cells: flags and id, name (not in old links), x, y, direction (rad) of a slider. `scale` converts positions.
    Raises InputError.
    """
    cells = text.split(",")
    if len(cells) == 4:
        cells.insert(1, "")
    if len(cells) != 5 or len(cells[0]) < 2:
        raise InputError(f"{text[:60]!r} is not a joint of PMKS+")
    flags, name = _decode_digits(cells[0][0]), cells[0][1:]
    try:
        x, y, angle = map(_decode_decimal, cells[2:])
    except InputError as error:
        raise InputError(f"joint {name}: {error.message}", hint=error.hint) from error
    add_joint(linkage, name, (scale * x, scale * y), bool(flags & GROUNDED))
    if flags & PRISMATIC:
        special_joints.sliders[name] = angle
    if flags & INPUT:
        special_joints.inputs.append(name)


def add_joint(linkage: Linkage, name: str, position: Point, is_grounded: bool) -> None:
    """Add a joint at a position, to the ground too if `is_grounded`.

    Raises InputError if the name is used.
    """
    if name in linkage.positions:
        raise InputError(f"two joints are called {name}")
    linkage.positions[name] = position
    if is_grounded:
        linkage.ground[name] = position


@dataclass
class _Link:
    """Values of a link; `parts`: ids of the links that are welded to form it."""

    is_root: bool
    kind: str
    name: str
    mass: float
    inertia: float
    com: Point
    joints: list[str]
    parts: list[str]


def _read_link(text: str) -> _Link:
    """Return the values of a link from its part of the query.

    Its cells: whether it is a root, kind, id, name (not in old links), mass, moment of inertia, centre of mass, colour,
    joints, an empty cell, the links that are welded to form it. Raises InputError.
    """
    cells = text.split(",")
    colour_index = next((k for k in (5, 6) if len(cells) > k and _is_colour(cells[k])), 6)
    first_cell, number_cells, other_cells = cells[0], cells[colour_index - 4 : colour_index], cells[colour_index + 1 :]
    if len(first_cell) < 3 or len(number_cells) < 4 or "" not in other_cells:
        raise InputError(f"{text[:60]!r} is not a link of PMKS+")
    try:
        mass, inertia, x, y = map(_decode_decimal, number_cells)
    except InputError as error:
        raise InputError(f"link {first_cell[2:]}: {error.message}", hint=error.hint) from error
    empty_index = other_cells.index("")
    joints, parts = list(dict.fromkeys(other_cells[:empty_index])), [part for part in other_cells[empty_index:] if part]
    return _Link(first_cell[0] == ROOT, first_cell[1], first_cell[2:], mass, inertia, (x, y), joints, parts)


def _is_colour(text: str) -> bool:
    """Return whether a text is a hexadecimal colour of 3 or 6 digits, such as "fa0"."""
    return len(text) in (3, 6) and all(digit in "0123456789abcdefABCDEF" for digit in text)


def _read_links(linkage: Linkage, link_texts: Sequence[str], special_joints: SpecialJoints, scale: float) -> None:
    """Read the parts of all links and add the bodies and pistons of the root links to the linkage.

    Other links are only parts of welded links: a root link without mass gets theirs. Raises InputError.
    """
    links = [_read_link(text) for text in link_texts]
    by_name = {link.name: link for link in links}
    roots = [link for link in links if link.is_root]
    if len({link.name for link in roots}) < len(roots):
        name = next(link.name for link in roots if by_name[link.name] is not link)
        raise InputError(f"two links are called {name}")
    for link in roots:
        check_joints_exist(linkage, link.name, link.joints)
        if link.kind == PISTON:
            _add_piston(linkage, link, special_joints)
            continue
        if link.parts and not link.mass:
            _combine_welded_parts(link, [by_name[part] for part in link.parts if part in by_name])
        com = scale * link.com[0], scale * link.com[1]
        add_link(linkage, link.name, link.joints, link.mass, link.inertia, com, special_joints)


def check_joints_exist(linkage: Linkage, name: str, joints: Sequence[str]) -> None:
    """Raise InputError for the first joint of a link that the linkage does not have."""
    for joint in joints:
        if joint not in linkage.positions:
            raise InputError(f"link {name}: no joint is called {joint}")


def add_link(
    linkage: Linkage,
    name: str,
    joints: Sequence[str],
    mass: float,
    inertia: float,
    com: Point,
    special_joints: SpecialJoints,
) -> None:
    """Add a body at the positions of its joints, driven joints first.

    A mass or moment of inertia of 0 counts as not specified; `com` is ignored without a mass. A note is added if only
    the moment of inertia is 0. Raises InputError for negative or huge values.
    """
    for quantity, value in (("mass", mass), ("moment of inertia", inertia)):
        if not 0.0 <= value <= MAX_NUMBER:
            raise InputError(f"link {name}: its {quantity} is {value:g}, expected a number above 0")
    joints = sorted(joints, key=lambda joint: joint not in special_joints.inputs)
    positions = {joint: linkage.positions[joint] for joint in joints}
    linkage.add_body(Body(name, positions, mass or None, inertia or None, com if mass else None))
    if mass and not inertia:
        linkage.notes.append("missing moments of inertia are those of slender bars")


def _combine_welded_parts(link: _Link, parts: Sequence[_Link]) -> None:
    """Set mass, centre of mass and moment of inertia of a link to those of its welded parts.

    The link is changed in place. If the parts have no mass, only its mass is set, to 0; its moment of inertia is set
    only if all parts have one.
    """
    link.mass = sum(part.mass for part in parts)
    if not link.mass:
        return
    x, y = (sum(part.mass * part.com[k] for part in parts) / link.mass for k in (0, 1))
    link.com = x, y
    if all(part.inertia for part in parts):
        parallel_axis_terms = (part.mass * ((part.com[0] - x) ** 2 + (part.com[1] - y) ** 2) for part in parts)
        link.inertia = sum(part.inertia for part in parts) + sum(parallel_axis_terms)


def add_input_drives(linkage: Linkage, special_joints: SpecialJoints, rate: float) -> None:
    """Add a drive for each driven joint: links against the ground, or two links against each other.

    `rate` is in rad/s. A note is added for two links. Raises InputError for driven sliders, other joints, and a link
    that two inputs drive.
    """
    for joint in special_joints.inputs:
        bodies, is_grounded = linkage.bodies_by_point.get(joint, []), joint in linkage.ground
        if joint in special_joints.sliders:
            raise InputError(f"joint {joint}: driven sliders are not supported", hint="remove its input")
        if is_grounded and bodies:
            drives = [Drive(body, rate) for body in bodies]
        elif not is_grounded and len(bodies) == 2:
            drives = [Drive(bodies[1], rate, bodies[0])]
            linkage.notes.append(f"the input at {joint} turns {bodies[1].name} relative to {bodies[0].name}")
        else:
            joined_text = "no link" if not bodies else "one link" if len(bodies) == 1 else f"{len(bodies)} links"
            raise InputError(
                f"joint {joint}: it is an input of {joined_text}, expected two links, or links and the ground",
                hint="choose as input a joint of two links, or one at the ground",
            )
        for drive in drives:
            if any(
                drive.body is existing.body and drive.relative_to is existing.relative_to for existing in linkage.drives
            ):
                raise InputError(f"link {drive.body.name}: two inputs drive it", hint="keep one of them")
        linkage.drives += drives


def _add_piston(linkage: Linkage, link: _Link, special_joints: SpecialJoints) -> None:
    """Add the line of a piston's pin through its slider; the mass of the piston is omitted, with a note.

    Raises InputError unless the piston has one slider, fixed to the ground and not driven, and one pin.
    """
    sliders = [joint for joint in link.joints if joint in special_joints.sliders]
    pins = [joint for joint in link.joints if joint not in special_joints.sliders]
    if len(sliders) != 1 or len(pins) != 1:
        raise InputError(f"piston {link.name}: expected a slider and a pin")
    slider, pin = sliders[0], pins[0]
    if slider in special_joints.inputs:
        raise InputError(f"piston {link.name}: driven sliders are not supported", hint="remove its input")
    if slider not in linkage.ground:
        message = f"piston {link.name}: sliders on moving links are not supported"
        raise InputError(message, hint="ground the slider")
    linkage.lines.append(
        Line(pin, slider, None, (math.cos(special_joints.sliders[slider]), math.sin(special_joints.sliders[slider])))
    )
    linkage.notes.append(f"the mass of piston {link.name} is omitted: its pin slides in a slot")


def read_old_pmks(query: str, name: str = "pmks") -> Linkage:
    """Return the linkage of a link from before April 2023; `query`: the text after the question mark.

    Raises InputError, with a hint to share the linkage again, for text that such links do not contain.
    """
    try:
        return _read_old_link(query, name)
    except InputError as error:
        raise InputError(error.message, hint=error.hint or OLD_LINK_HINT) from error


def _read_old_link(query: str, name: str) -> Linkage:
    """Return the linkage of a link from before April 2023: settings, joints, links, and the drives of its inputs.

    Raises InputError for text that such links do not contain.
    """
    parts = dict(part.split("=", 1) for part in query.split("&") if "=" in part)
    settings = [cell.strip() for cell in parts.get("s", "").split(",")]
    if len(settings) < 4 or settings[3].lower() not in UNITS:
        raise InputError(f"its settings are {parts.get('s', '')!r}, expected a speed, a direction, gravity and a unit")
    scale, unit = UNITS[settings[3].lower()]
    linkage, old_joints = Linkage(name, unit, has_unit=True), SpecialJoints()
    for line in filter(str.strip, parts.get("j", "").splitlines()):
        _read_old_joint(linkage, line.strip(), old_joints, scale)
    for line in filter(str.strip, parts.get("l", "").splitlines()):
        cells = line.strip().split(",")
        if len(cells) < 6:
            raise InputError(f"{line[:60]!r} is not a link of PMKS+")
        mass, inertia, x, y = (_read_number(cells[k], f"link {cells[0]}") for k in (1, 2, 3, 4))
        joints = list(dict.fromkeys(filter(None, cells[5].split("|"))))
        check_joints_exist(linkage, cells[0], joints)
        add_link(linkage, cells[0], joints, mass, inertia, (scale * x, scale * y), old_joints)
    rate = _read_number(settings[0], "the speed") * math.pi / 30.0
    add_input_drives(linkage, old_joints, -rate if settings[1] == "true" else rate)
    linkage.notes.append("masses are assumed to be in kg, moments of inertia in kg m^2")
    if settings[2] == "true":
        linkage.gravity = 0.0, -9.81
    if parts.get("f", "").strip():
        linkage.notes.append("forces of the file are omitted")
    return linkage


def _read_old_joint(linkage: Linkage, line: str, special_joints: SpecialJoints, scale: float) -> None:
    """Read the line of a joint and add it to the linkage; a driven one is also added to `special_joints`.

    Its cells: id, x, y, links, kind (R, P), grounded (t, f), angle, friction, driven (t, f). From 2022 on: id, x, y,
    links, kind and grounded in one cell ("Rt"), driven. Raises InputError, also for sliders.
    """
    cells = line.rstrip(",").split(",")
    name = cells[0]
    if len(cells) == 6 and len(cells[4]) == 2:
        kind, grounded_flag, driven_flag = cells[4][0], cells[4][1], cells[5]
    elif len(cells) >= 9:
        kind, grounded_flag, driven_flag = cells[4], cells[5], cells[8]
    else:
        raise InputError(f"{line[:60]!r} is not a joint of PMKS+")
    if kind != "R":
        raise InputError(f"joint {name}: sliders of such links are not supported", hint=OLD_LINK_HINT)
    if grounded_flag not in ("t", "f") or driven_flag not in ("t", "f"):
        raise InputError(f"joint {name}: expected t or f for whether it is grounded and driven")
    x, y = (_read_number(cells[k], f"joint {name}") for k in (1, 2))
    add_joint(linkage, name, (scale * x, scale * y), grounded_flag == "t")
    if driven_flag == "t":
        special_joints.inputs.append(name)


def _read_number(text: str, owner: str) -> float:
    """Return a decimal number of a text as float, without underscores and at most MAX_NUMBER.

    Raises InputError, whose message begins with `owner`.
    """
    try:
        value = float(text) if "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not abs(value) <= MAX_NUMBER:
        raise InputError(f"{owner}: {text[:40]!r}: expected a number up to {MAX_NUMBER:g}")
    return value
