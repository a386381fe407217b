"""Curves and branches in the document: by name, with primes for derivatives, and a table of what they are; as cases."""

from __future__ import annotations

import pytest

from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_html, render_equations_tex, render_equations_text
from tests.targets_latex.equations_reader import equations, sections, value

TEXT = b"""format: gudgeon/1
name: n
curves: {lift_1: {points: [[0, 0], [1, 2], [3, 0]], x: s, y: mm, extrapolate: none}}
bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {g: {translational: [ground.O, a.origin], axis: [0, 1]}}
drives: {d: {coordinate: a.y, value: lift_1(t)}}
"""


def test_a_curve_is_shown_by_name_with_its_derivatives_and_told() -> None:
    model = derive_scene(TEXT, "n.yaml", "ideal")
    text, tex, html = render_equations_text(model), render_equations_tex(model), render_equations_html(model)
    assert "= lift_1'(t)" in text and "= lift_1''(t)" in text
    assert r"\mathrm{lift\_1}''\left(t\right)" in tex
    for shown in (text, tex, html):
        assert "cubic spline through 3 points, natural ends" in " ".join(shown.split())


def test_a_where_is_shown_as_cases_and_says_what_it_is() -> None:
    """It was a unit step times a difference."""
    law = b"1 mm*where(t < 0.3 s, t/(1 s), where(t >= 0.5 s, 1, 4*mod(t, 0.4 s)/(1 s)))**2"
    model = derive_scene(TEXT.replace(b"lift_1(t)", b'"' + law + b'"'), "n.yaml", "ideal")
    text, tex, html = render_equations_text(model), render_equations_tex(model), render_equations_html(model)
    (shown,) = (right for lines in sections(text).values() for left, right in equations(lines) if left == "f_d")
    for t in (0.0, 0.2, 0.3, 0.35, 0.45, 0.5, 0.7):
        branch = t if t < 0.3 else 1.0 if t >= 0.5 else 4.0 * (t % 0.4)
        assert value(shown, {"t": t}) == pytest.approx(1e-3 * branch**2, rel=1e-14)
    assert r"\begin{cases} t & t < 0.3 \\ \begin{cases}" in tex and "H(" not in text and r"H\left" not in tex
    assert "<mtable" in html and "unit step" not in text
