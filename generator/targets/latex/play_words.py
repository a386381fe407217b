"""Sentences about a joint with play: what no equation says of its bearing, its contact and its laws."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.targets.latex.document import Block, paragraph
from gudgeon.generator.targets.latex.kinematics import equation
from gudgeon.generator.targets.latex.letters import Name, letter
from gudgeon.language.plot_units import quantity as in_unit

if TYPE_CHECKING:
    from gudgeon.generator.targets.latex.play import JointWithPlay


def contour(joint: JointWithPlay) -> Iterator[Block]:
    """The bearing's angle, and what W is."""
    clearance = joint.clearance
    assert clearance.contour
    yield equation(contact.theta_i, joint.notation.expand(clearance.first.theta), joint.notation, joint.of)
    yield paragraph(
        f"The bearing is no circle: w is how much deeper it is, {clearance.contour.count} depths at equal angles from "
        f"the x axis of {clearance.joint.first.body} on, between them polynomials of degree five with two continuous "
        "derivatives. F acts along the gradient of ", Name(r"\delta", "δ"), ", whose length is ",
        joint.notation.math(contact.steep), ": an elastic force keeps the energy."
    )  # fmt: skip


def corner(name: str, guide: str, slider: str) -> Block:
    """Which corner of a slider it is, and what its letters mean."""
    which = name.rpartition(".")[2]
    front, upper = "front" in which, "upper" in which
    return paragraph(
        f"The guide i goes through {guide}, the slider j is in its middle at {slider}. This corner is"
        f" {'in front, along' if front else 'at the rear, against'} the axis, at the wall to the"
        f" {'left' if upper else 'right'} of it, whose outward normal is n; (e_x, e_y) leads from the guide's point to"
        " the centre of the corner's radius, e is what that lies nearer to the wall than in the middle."
    )


def rigid(joint: JointWithPlay, stored: Name) -> Block:
    """What becomes of surfaces that do not give, where they meet and while they touch."""
    assert joint.clearance.normal is not None
    e, v_0 = (joint.notation.math(sp.sympify(joint.clearance.normal.numbers[n])) for n in ("restitution", "threshold"))
    rubs = joint.clearance.friction is not None
    along = (
        "; friction then brings the slip behind it to rest, as far as its coefficient there times the impulse lets it"
        " and energy is not gained, and no parting changes by that"
    ) * rubs
    return paragraph(
        "Its surfaces do not give. Where they meet at the rate ", stored, ", a blow along n parts them with ", e,
        " times that, or leaves them together where that is less than ", v_0, "; all rows and contacts that are closed"
        f" bear it{along}. A contact that is closed has the force ",
        Name(r"\lambda \geq 0,\ \ddot{\delta} \leq 0,\ \lambda \ddot{\delta} = 0", "λ ≥ 0, δ̈ ≤ 0, λ δ̈ = 0"), ".",
    )  # fmt: skip


def onset(joint: JointWithPlay, stored: Name) -> Block:
    """When a contact acts, and what is kept of its onset."""
    floor = joint.model.slots.entries[f"contacts.{joint.play.contact.name}.velocity_floor"].default
    return paragraph(
        "It acts while ", Name(r"\delta > 0", "δ > 0"), ". ", stored, " is the speed of approach at the onset, "
        f"at least {in_unit(floor, 'm/s')}, kept until separation; before an onset is accepted ",
        Name(r"\dot{\delta} / ", "δ̇ / "), stored, " counts as 1.",
    )  # fmt: skip


def told_states(law: Law) -> Iterator[Block]:
    """What each inner state of a law is."""
    for state in law.states:
        told = f" is the {state.meaning}, 0 at each onset, and integrated with the motion while in contact."
        yield paragraph(letter(state.name), told)


def as_word(value: str | bool) -> str:
    return str(value).lower() if isinstance(value, bool) else value
