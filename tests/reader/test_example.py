"""Example: a file is read to a Mechanism, whose values are in SI units and carry their place.

A mistake is one row of `tests/mechanisms/invalid.py`: a patch, the class of the error, its place.
"""

from __future__ import annotations

import pytest

from gudgeon.errors import UnitError
from gudgeon.generator.reader.read import read_mechanism
from tests.mechanisms.invalid import BASE
from tests.scenes import patched


def test_scenes_of_a_file_by_name() -> None:
    assert set(read_mechanism(BASE.encode(), "base.yaml").scenes) == {"ideal", "dry", "fast"}


def test_a_mass_in_metres_is_refused_at_its_place() -> None:
    text = patched(BASE, ("mass: 0.142 kg", "mass: 142 mm"))
    with pytest.raises(UnitError, match=r"^base\.yaml:10:29: "):
        read_mechanism(text.encode(), "base.yaml")
