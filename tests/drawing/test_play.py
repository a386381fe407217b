"""Joints with play, drawn at their start: where journals and sliders are, to which scale."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.drawing.insets import compute_eccentricity, compute_magnification  # noqa: E402
from gudgeon.drawing.shapes import Disc, Line, unit_vector  # noqa: E402
from gudgeon.drawing.sketch import make_sketch  # noqa: E402
from tests.drawing.drawn import ROOT, drawn  # noqa: E402
from tests.integrators.test_guide import ARM, HEAD, ORACLE, C  # noqa: E402


def test_a_journal_is_drawn_where_it_is_at_the_scale_that_is_told() -> None:
    """Against the eccentricity that the start is given, and the clearance of the file."""
    text = (ROOT / "mechanisms/slider_crank.yaml").read_text()
    text = text.replace("start:\n", "start:\n  play: {wristpin: {e: [0.05 mm, -0.12 mm]}}\n")
    configuration = drawn(text).configuration
    e = compute_eccentricity(configuration, "wristpin")
    assert e == pytest.approx([5e-5, -1.2e-4], abs=1e-12)
    sketch = make_sketch(configuration)
    by_role = {s.role: s for s in sketch.of("inset wristpin") if isinstance(s, Disc)}
    times = compute_magnification(configuration, "wristpin", sketch.unit)
    assert by_role["journal"].centre - by_role["hole"].centre == pytest.approx(times * e)
    assert by_role["clearance"].radius == pytest.approx(times * 2e-4)
    assert by_role["hole"].radius - by_role["journal"].radius == pytest.approx(times * 2e-4)  # the gap is to scale
    assert "touching" not in by_role
    message = next(label.text for label in sketch.labels if label.part == "inset wristpin")
    assert f"×{times:g}" in message and "e/c = 0.65" in message
    assert any(f"×{times:g}" in note and "0.2 mm" in note for note in sketch.notes)


@pytest.mark.parametrize(("share", "role"), [(0.999, "journal"), (1.001, "touching")])
def test_a_journal_that_begins_in_the_wall_is_red(share: float, role: str) -> None:
    """e = share · c, 3-4-5."""
    text = (ROOT / "mechanisms/slider_crank.yaml").read_text()
    x, y = 0.12 * share, -0.16 * share  # mm, of 0.2 mm
    configuration = drawn(
        text.replace("start:\n", f"start:\n  play: {{wristpin: {{e: [{x} mm, {y} mm]}}}}\n")
    ).configuration
    assert {"journal", "touching"} & {s.role for s in make_sketch(configuration).of("inset wristpin")} == {role}


def test_a_slider_is_drawn_between_its_walls_where_it_is() -> None:
    """A slot on an arm that is turned: corners' ways to their walls are the oracle's, at the told scale."""
    text = (HEAD + ARM).replace("tilt_rate: 6 rad/s", "tilt: 2.5e-3, offset: 0.15 mm")
    configuration = drawn(text).configuration
    delta = [one[0] for one in ORACLE.contacts(np.array([configuration.q[2], *configuration.q[3:6], *[0.0] * 4]))]
    assert sorted(np.sign(delta)) == [-1.0, -1.0, -1.0, 1.0]
    sketch = make_sketch(configuration)
    times, up = compute_magnification(configuration, "way", sketch.unit), np.array([-np.sin(0.2), np.cos(0.2)])
    shapes = sketch.of("inset way")
    heights = [shape.points @ up for shape in shapes if isinstance(shape, Line) and shape.role == "bearing"]
    discs = [shape for shape in shapes if isinstance(shape, Disc)]
    for disc, depth, role in zip(discs, delta, ("touching", *["journal"] * 3), strict=True):
        upper = disc in (discs[0], discs[2])
        gap = heights[0].min() - disc.centre @ up if upper else disc.centre @ up - heights[1].max()
        assert gap == pytest.approx(-times * depth, abs=1e-12) and disc.role == role
    message = next(label.text for label in sketch.labels if label.part == "inset way")
    assert f"×{times:g}" in message and f"e/c = {max(delta) / C + 1:.2f}" in message
    assert any(f"×{times:g}" in note and "gap 0.2 mm on each side" in note for note in sketch.notes)
    block = next(shape.points for shape in sketch.of("body block") if isinstance(shape, Line))
    assert unit_vector(block[1] - block[0]) == pytest.approx([np.cos(0.2025), np.sin(0.2025)])
    assert {"guide", "channel"} <= {shape.role for shape in sketch.of("body arm")}


def test_a_play_as_large_as_the_mechanism_needs_no_inset() -> None:
    sketch = make_sketch(drawn(ROOT / "mechanisms/bouncing_ball.yaml").configuration)
    (circle,) = [s for s in sketch.of("joint fall") if s.role == "clearance"]
    assert isinstance(circle, Disc) and circle.radius == 1.0 and not sketch.of("inset fall")
