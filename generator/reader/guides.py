"""What goes with play in a translational joint: laws of contact that hold for a corner on a flat wall."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.errors import BadValueError, MissingKeyError
from gudgeon.generator.kinds.laws.law import called, laws
from gudgeon.generator.mechanism.mechanism import Contact, Guide
from gudgeon.generator.yaml.tree import Map


def check_guide(joint: str, guide: Guide, contact: Contact, use: Map) -> None:
    """Raise unless the contact is one of corners that press on flat walls, without a film and a contour."""
    where = use["contact"].where
    if "contour" in use:
        told = f"the contour of {joint} is one of a guide: contours are those of bearings"
        raise BadValueError(told, use.key("contour").where, "expected no contour")
    if contact.film is not None:
        told = f"contact {contact.name} of {joint} has a film, whose laws are those of a journal in its bearing"
        raise BadValueError(told, where, "expected a contact without a film: guides have dry contact alone")
    normal = contact.normal
    if normal is None:
        return
    if laws()[normal.law].in_hole:
        fit = sorted(name for name, law in called("normal").items() if not law.in_hole)
        told = f"contact {contact.name} of {joint} has {normal.law}, a law of a pin in a hole"
        raise BadValueError(told, where, f"expected one of a corner on a wall: {', '.join(fit)}")
    if "geometry" in normal.options and guide.corner_radius is None:
        told = f"guide {guide.name} of {joint} has no corner_radius, from which {normal.law} takes its stiffness"
        able = any(own.name == "stiffness" for own in laws()[normal.law].fields)
        also = "stiffness" if able else f"a law that needs none ({', '.join(sorted(_of_sharp_corners()))})"
        hint = f"expected corner_radius in guides.{guide.name}, or {also} in contacts.{contact.name}.normal"
        raise MissingKeyError(told, use["guide"].where, hint)


def _of_sharp_corners() -> Iterator[str]:
    """Laws of corners on walls that take no stiffness from radii, or one of the file instead."""
    for name, law in laws().items():
        if law.role == "normal" and not law.in_hole and law.name == name:
            if "geometry" in law.instead:
                yield f"{name} with {law.instead['geometry']}"
            elif all(own.name != "geometry" for own in law.fields):
                yield name
