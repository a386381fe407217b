"""Reasons and values of a map in words."""

from __future__ import annotations

from collections.abc import Sequence

from gudgeon.language.plot_units import quantity
from gudgeon.studies.axes import Axis
from gudgeon.studies.map import VerdictBox, VerdictMap
from gudgeon.studies.runs import Setting
from gudgeon.studies.words import clearance, seconds

PASCAL = {"kg/m/s^2": "Pa", "kg/m/s": "Pa*s"}  # what only base units are known of
# what a cell's label may begin with, and what that says; told where a cell has it
LABELS = {
    "at": "at: when the run failed", "energy": "energy: residual, or it comes from nowhere",
    "motion": "motion: coordinates off by, of the size",
    "force": "force: a joint's force off by, of its peak",
    "path": "path: a journal's path off by, of the clearance",
    "through": "through: a journal left its bearing",
    "lost": "lost: a contact was", "|Φ|": "|Φ|: constraints open", "?": "?: the finer run fails", "–": "–: not judged",
    "δ": "δ: penetration beyond half the clearance or a hundredth of the bearing's radius",
}  # fmt: skip


def value(axis: Axis, x: float) -> str:
    """A value on an axis as people say it."""
    if axis.words:
        return axis.words[int(x)]
    if axis.name == "clearance":
        return clearance(x)
    if axis.name == "rtol":
        return str(Setting("auto", x))
    return seconds(x) if axis.unit == "s" else quantity(x, PASCAL.get(axis.unit, axis.unit), 3)


def explain(found: Sequence[VerdictMap]) -> str:
    """What stands in the cells, of all that may stand there what does; two to a line."""
    used = {cell.label.split(" ")[0] for scene in found for cell in scene.cells}
    told = dict.fromkeys(text for word, text in LABELS.items() if word in used)
    parts = ["a number: largest error against a finer run, over the time compared", *told]
    return "\n".join(" · ".join(parts[k : k + 2]) for k in range(0, len(parts), 2))


def compared(found: VerdictMap | VerdictBox) -> str:
    """Over what the errors are, and against what: with dry contacts runs can be compared over the first few alone."""
    finer = "a 10× shorter step" if found.setting.fixed else "a 100× tighter tolerance"
    ends = [cell.compared for cell in found.cells if cell.compared == cell.compared]
    shortest, longest = (seconds(end) for end in (min(ends, default=0.0), max(ends, default=0.0)))
    over = shortest if shortest == longest else f"{shortest} … {longest}"
    return f"errors over the first {over}, against {finer}" if ends else f"nothing to compare with {finer}"
