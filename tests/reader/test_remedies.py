"""What a message proposes is accepted."""

from __future__ import annotations

import re

import pytest

from gudgeon.errors import BadNameError, BadValueError
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import RESERVED, WORDS, check_name

WHAT = ("body", "joint", "drive", "force", "parameter", "output", "curve", "expression", "point", "mechanism")
TRIED = (
    *RESERVED,
    *FUNCTIONS,
    *WORDS,
    "time",
    "a__b",
    "a___b__c",
    "my-pin",
    "my pin",
    "a - b",
    "a--b",
    "pin-",
    "gudgeon_pin",
    "gudgeon",
    "gudgeon pin",
    "x" * 40 + "-" + "y" * 40,
)


@pytest.mark.parametrize("what", WHAT)
def test_a_name_that_is_proposed_is_accepted(what: str) -> None:
    refused = 0
    for name in TRIED:
        try:
            check_name(name, what, None)
        except BadNameError as error:
            refused += 1
            if found := re.search(r"such as (\S+)$", error.hint):
                check_name(found[1], what, None)
    assert refused >= 5


def test_a_gudgeon_pin_is_a_pin() -> None:
    for what in WHAT:
        check_name("gudgeon_pin", what, None)


def test_one_point_is_not_several() -> None:
    text = """
format: gudgeon/1
name: one
bodies: {a: {length: 1 m, mass: 1 kg, inertia: auto}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [a.tail]}}
"""
    with pytest.raises(BadValueError, match="revolute has 1 point\n") as error:
        read_mechanism(text.encode(), "one.yaml")
    assert error.value.hint == "expected two points: [L1.head, L2.tail]"
    read_mechanism(text.replace("[a.tail]", "[ground.O, a.tail]").encode(), "one.yaml")
