"""Plain geometry of drawings, and where names may stand, against brute force."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

pytest.importorskip("matplotlib")

from gudgeon.drawing.arrows import find_round_number  # noqa: E402
from gudgeon.drawing.labels import count_crossings, find_best_position, find_overlaps  # noqa: E402
from gudgeon.drawing.shapes import (  # noqa: E402
    compute_convex_hull,
    compute_hatching,
    compute_rectangle,
    compute_rounded_outline,
    compute_zigzag,
)

PLACES = arrays(float, st.tuples(st.integers(1, 9), st.just(2)), elements=st.integers(-50, 50).map(float))


def signed(outline: np.ndarray, place: np.ndarray) -> np.ndarray:
    """To which side of each edge a place lies, m: positive inside of a convex outline that goes round to the left."""
    edges = np.roll(outline, -1, axis=0) - outline
    away = place - outline
    return (edges[:, 0] * away[:, 1] - edges[:, 1] * away[:, 0]) / np.maximum(np.hypot(*edges.T), 1e-300)


@settings(deadline=None)
@given(PLACES)
def test_a_plate_holds_each_of_its_points_with_a_margin(places: np.ndarray) -> None:
    """Discs of the radius about every point lie within, up to the sagitta of the arcs; the outline is no further off
    than the radius from the hull of the points."""
    radius = 3.0
    outline = compute_rounded_outline(list(places), radius)
    for place in places:
        assert signed(outline, place).min() > 0.95 * radius
    away = np.hypot(*(outline[:, None] - compute_convex_hull(list(places))[None]).transpose(2, 0, 1)).min(axis=1)
    np.testing.assert_allclose(away, radius, rtol=1e-12)  # each point of it is on an arc about a corner


@settings(deadline=None)
@given(PLACES)
def test_the_hull_is_convex_and_holds_all(places: np.ndarray) -> None:
    corners = compute_convex_hull(list(places))
    assert {tuple(c) for c in corners} <= {tuple(p) for p in places}
    if len(corners) > 2:
        assert min(signed(corners, place).min() for place in places) > -1e-9


@settings(deadline=None)
@given(
    arrays(float, (4,), elements=st.floats(-10, 10)),
    arrays(float, (2,), elements=st.floats(-10, 10)),
    arrays(float, (2,), elements=st.floats(0.1, 5)),
)
def test_lines_through_a_box_are_found(segment: np.ndarray, corner: np.ndarray, size: np.ndarray) -> None:
    """Against points along the line; a line that only grazes the box may count either way."""
    box = np.array([*corner, *(corner + size)])
    along = segment[:2] + np.linspace(0.0, 1.0, 4001)[:, None] * (segment[2:] - segment[:2])
    depth = np.minimum(along - box[:2], box[2:] - along).min(axis=1).max()
    found = count_crossings(box, segment[None]) > 0.0
    assert found == (depth > 0.0) or abs(depth) < 1e-2


def test_boxes_that_overlap() -> None:
    boxes = np.array([[0.0, 0.0, 2.0, 1.0], [5.0, 5.0, 6.0, 6.0]])
    used = np.array([[1.9, 0.9, 3.0, 3.0], [2.0, 0.0, 3.0, 1.0], [5.2, 5.2, 5.3, 5.3]])
    assert find_overlaps(boxes, used).tolist() == [[True, False, False], [False, False, True]]


@settings(deadline=None)
@given(st.floats(1e-9, 1e9))
def test_round_numbers(most: float) -> None:
    found = find_round_number(most)
    assert found <= most * (1 + 1e-9) and most < 2.5 * found * (1 + 1e-9)
    assert f"{found:.6e}"[0] in "125" and float(f"{found:.0e}") == pytest.approx(found, rel=1e-12)


def test_symbols_join_what_they_should() -> None:
    a, b = np.array([1.0, 2.0]), np.array([4.0, 6.0])
    coil = compute_zigzag(a, b, 0.5, 5, 0.1)
    assert (coil[0] == a).all() and (coil[-1] == b).all()
    across = (coil - a) @ np.array([-0.8, 0.6])
    assert abs(across).max() == pytest.approx(0.5) and across.sum() == pytest.approx(0.0, abs=1e-12)
    into = np.array([0.8, -0.6])
    for stroke in compute_hatching(a, b, into, 0.4):
        foot = (stroke[0] - a) @ np.array([-0.8, 0.6])
        assert foot == pytest.approx(0.0, abs=1e-12) and (stroke[1] - stroke[0]) @ into > 0.0
    corners = compute_rectangle(a, np.array([0.6, 0.8]), 2.0, 1.0)
    assert corners.mean(axis=0) == pytest.approx(a) and np.hypot(*(corners - a).T) == pytest.approx(5**0.5)


def test_a_leader_crosses_no_other() -> None:
    """A name in a full place: two walls leave ways out on both sides, and over one of these another leader runs."""
    walls = np.array([[x, -60.0, x, 60.0] for x in (-8.0, -4.0, 4.0, 8.0)])
    at, half, room = np.zeros(2), np.array([6.0, 4.0]), np.array([-200.0, -200.0, 200.0, 200.0])
    nothing = np.zeros((0, 4))
    free = find_best_position(at, half, 0.0, 0.0, 1.0, walls, nothing, room, nothing)
    assert free is not None and abs(free[0]) > 14.0
    side = float(np.sign(free[0]))
    other = np.array([[side * 10.0, -150.0, side * 10.0, 150.0]])
    moved = find_best_position(at, half, 0.0, 0.0, 1.0, walls, nothing, room, other)
    assert moved is not None and side * moved[0] < 0.0
