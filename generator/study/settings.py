"""Numbers that are set for all runs of a study, `--set`, over what its file says of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from gudgeon.generator.study.spec import Axis, Draw, Numbers
from gudgeon.generator.study.tree import tree_of
from gudgeon.generator.yaml.tree import Text

DRAW = "draw"


class Varied(NamedTuple):
    """What all runs have, what varies, and what of the file does not because it is set."""

    fixed: Mapping[Text, Text]
    axes: tuple[Axis, ...]
    draw: Draw | None
    left_out: tuple[Axis, ...] = ()


def short(name: str) -> str:
    """A parameter may be called with its section or without."""
    return name.removeprefix("parameters.")


def varied(fixed: Mapping[Text, Text], axes: Sequence[Axis], draw: Draw | None, settings: Mapping[str, str]) -> Varied:
    """The file's numbers under those that are set: its values of these go, whether they vary or not.

    What goes together with them, in a zip or a draw, stays as it is.
    """
    given = {short(name) for name in settings}
    own = tree_of({f"--set {name}": value for name, value in settings.items()})
    found = {key: value for key, value in fixed.items() if short(key) not in given}
    found |= {Text.make(key.removeprefix("--set "), key.where): value for key, value in own.items()}
    split = [(axis, {key: numbers for key, numbers in axis.columns.items() if short(key) in given}) for axis in axes]
    kept = (replace(axis, columns={key: numbers for key, numbers in axis.columns.items() if key not in gone})
            for axis, gone in split)  # fmt: skip
    left_out = [replace(axis, columns=gone) for axis, gone in split if gone]
    if draw is not None and (drawn := {key: one for key, one in draw.numbers.items() if short(key) in given}):
        columns = {key: Numbers(spread.ends, draw.count) for key, spread in drawn.items()}
        left_out.append(Axis(DRAW, next(iter(drawn)).where, columns, grouped=True))
        others = {key: spread for key, spread in draw.numbers.items() if key not in drawn}
        draw = replace(draw, numbers=others) if others else None
    return Varied(found, tuple(axis for axis in kept if axis.columns), draw, tuple(left_out))
