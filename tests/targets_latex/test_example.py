"""Example: equations of a scene as text; their values are compared with a formula on paper."""

from __future__ import annotations

from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text

TEXT = b"""
format: gudgeon/1
name: disc
title: A disc on a pin
bodies: {disc: {mass: 1 kg, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
"""


def test_a_document_has_its_title() -> None:
    model = derive_scene(TEXT, "disc.yaml", "ideal")
    for document in (render_equations_text(model), render_equations_tex(model)):
        assert "A disc on a pin" in document
