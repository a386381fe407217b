"""Example: a mechanism is drawn at its start; shapes of the sketch are found by the name of the part."""

from __future__ import annotations

from gudgeon.drawing.sketch import make_sketch
from tests.drawing.drawn import ROOT, drawn


def test_every_body_and_joint_is_drawn() -> None:
    one = drawn(ROOT / "mechanisms/slider_crank.yaml")
    sketch = make_sketch(one.configuration)
    for kind, names in (("body", one.mechanism.bodies), ("joint", one.mechanism.joints)):
        assert all(sketch.of(f"{kind} {name}") for name in names)
