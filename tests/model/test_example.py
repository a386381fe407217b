"""Example: a compiled scene before it runs: the parameters of a run and what follows from them."""

from __future__ import annotations

from pathlib import Path

import pytest

from gudgeon.errors import InputError
from tests.programs import needs_compiler
from tests.scenes import Load, loader

pytestmark = needs_compiler
TEXT = """
parameters: {r: 0.1 m, d: 2*r}
bodies: {disc: {mass: 2 kg, inertia: 3 kg*m^2}}
ground: {O: [d, 0]}
joints: {pin: {revolute: [ground.O, disc.origin]}}
"""


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


def test_a_parameter_follows_another(load: Load) -> None:
    run = load(TEXT).simulate(1e-3, output=1, parameters={"r": 0.3})
    assert run.parameters["d"] == pytest.approx(0.6) and run["disc.x"][0] == pytest.approx(0.6)


def test_an_unknown_parameter_is_refused(load: Load) -> None:
    with pytest.raises(InputError, match="did you mean"):
        load(TEXT).simulate(1e-3, output=1, parameters={"disc.mas": 0.3})
