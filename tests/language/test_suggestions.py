"""What a name that does not exist most likely stands for."""

from __future__ import annotations

import pytest

from gudgeon.language.names import find_near_names, find_nearest_name, make_missing_name_error

ADDRESSES = (
    "omega",
    "c",
    "bodies.crank.mass",
    "bodies.crank.length",
    "bodies.rod.length",
    "bearings.wrist.clearance",
    "bearings.wrist.length",
    "bearings.main.clearance",
    "contacts.dry.friction.v1",
    "parameters.omega",
)


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("wrist.c", "bearings.wrist.clearance"),
        ("crank.len", "bodies.crank.length"),
        ("clearence", "bearings.main.clearance"),
        ("OMGA", "omega"),
        ("rod.lenght", "bodies.rod.length"),
        ("wrst.clearance", "bearings.wrist.clearance"),
        ("bearings.wrist.clear", "bearings.wrist.clearance"),
        ("bodies.crank.mass.x", "bodies.crank.mass"),
    ],
)
def test_the_near_address_stands_first(name: str, first: str) -> None:
    """By the whole of it and by its last parts; capitals decide nothing."""
    assert find_nearest_name(name, ADDRESSES) == find_near_names(name, ADDRESSES)[0] == first


def test_what_is_far_from_all_is_told_as_that() -> None:
    assert find_near_names("tappet.lift", ADDRESSES) == find_near_names("", ADDRESSES) == []
    assert "there are: omega, c" in str(make_missing_name_error("no number 'tappet.lift'", "tappet.lift", ADDRESSES))
