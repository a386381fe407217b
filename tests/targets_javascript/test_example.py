"""Example: what is written for a page is JavaScript that Node reads."""

from __future__ import annotations

import subprocess

from gudgeon.generator.kernels.program import make_program
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.javascript.module import print_equations_script
from tests.web.node import needs_node, node

TEXT = b"""
format: gudgeon/1
name: disc
bodies: {disc: {mass: 1 kg, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
"""


@needs_node
def test_equations_are_a_script() -> None:
    text = print_equations_script(make_program(derive_scene(TEXT, "disc.yaml", "ideal")))
    done = subprocess.run([node() or "", "--check", "-"], input=text, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
