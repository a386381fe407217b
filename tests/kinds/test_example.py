"""Example: what a joint, a law or a force element declares of itself is complete.

A new kind is one file in a folder of `generator/kinds`; tests over all kinds find it by themselves.
"""

from __future__ import annotations

import pytest

from gudgeon.generator.field import RELATIONS
from gudgeon.generator.kinds.laws.law import Law, find_all_laws


@pytest.mark.parametrize("law", find_all_laws().values(), ids=lambda law: law.name)
def test_the_defaults_of_a_law_are_within_their_bounds(law: Law) -> None:
    for field in law.parameters:
        for bound in field.bounds:
            if isinstance(field.default, float) and not isinstance(bound.limit, str):
                assert RELATIONS[bound.relation](field.default, bound.limit), field.name
