"""Bodies linked by joints, as a graph, and paths through it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism.mechanism import GROUND, Joint


@dataclass(frozen=True)
class Link:
    """A body with the one that places it: `joint` None is a body that moves freely (two slides of its own)."""

    body: str
    parent: str
    joint: Joint | None = None

    @property
    def slides(self) -> bool:
        """Whether the body is carried along an axis."""
        return self.joint is not None and len(joint_types()[self.joint.kind].carries) == 1

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the slides that the link brings."""
        if self.joint is None:
            return f"{self.body}.x", f"{self.body}.y"
        return (f"{self.joint.name}.slide",) if self.slides else ()

    @property
    def rows(self) -> tuple[str, ...]:
        """Rows of Φ that hold by themselves."""
        if self.joint is None:
            return ()
        return tuple(f"{self.joint.name}.{row}" for row in joint_types()[self.joint.kind].carries)


def path(links: Iterable[Link], body: str) -> list[Link]:
    """The links from the root to a body."""
    by_body = {link.body: link for link in links}
    found: list[Link] = []
    while body != GROUND:
        found.append(by_body[body])
        body = by_body[body].parent
    return found[::-1]
