"""Curves in the document: by name, with primes for derivatives, and a table of what they are."""

from __future__ import annotations

from gudgeon.generator.pipeline import derive
from gudgeon.generator.targets.latex import equations_html, equations_tex, equations_text

TEXT = b"""format: gudgeon/1
name: n
curves: {lift_1: {points: [[0, 0], [1, 2], [3, 0]], x: s, y: mm, extrapolate: none}}
bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {g: {translational: [ground.O, a.origin], axis: [0, 1]}}
drives: {d: {coordinate: a.y, value: lift_1(t)}}
"""


def test_a_curve_is_shown_by_name_with_its_derivatives_and_told() -> None:
    model = derive(TEXT, "n.yaml", "ideal")
    text, tex, html = equations_text(model), equations_tex(model), equations_html(model)
    assert "= lift_1'(t)" in text and "= lift_1''(t)" in text
    assert r"\mathrm{lift\_1}''\left(t\right)" in tex
    for shown in (text, tex, html):
        assert "cubic spline through 3 points, natural ends" in " ".join(shown.split())
