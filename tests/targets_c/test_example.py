"""Example: the C of a scene is text; a test reads it, or lets the compiler read it."""

from __future__ import annotations

from pathlib import Path

from gudgeon.generator.pipeline import generate_kernel_source
from tests.fuzz.through_c import check_syntax
from tests.programs import needs_compiler

TEXT = b"""
format: gudgeon/1
name: disc
parameters: {double: 2 kg}
bodies: {disc: {mass: double, inertia: 3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
"""


@needs_compiler
def test_a_parameter_may_have_the_name_of_a_type(tmp_path: Path) -> None:
    check_syntax(generate_kernel_source(TEXT, "disc.yaml", "ideal"), tmp_path)
