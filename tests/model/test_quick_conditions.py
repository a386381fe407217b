"""The quick test of parameter values agrees with the one that says what is wrong."""

from __future__ import annotations

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError
from gudgeon.model.parameters import check_parameter_values, has_valid_values


def is_accepted(source: gudgeon.Simulation, p: np.ndarray, is_given: np.ndarray) -> bool:
    """Whether the full check raises no error."""
    try:
        check_parameter_values(source.source, p, is_given)
    except BadValueError:
        return False
    return True


@pytest.mark.parametrize("mechanism", ["nine_bar_press", "four_bar", "slider_crank", "andrews_squeezer", "belt_block"])
def test_both_checks_accept_the_same_values(mechanism: str) -> None:
    """Each parameter is zero, negated, tiny, huge, not a number; derived values follow from it."""
    simulation = gudgeon.load(mechanism)
    source, compiled, accepted = simulation.source, simulation.compiled, set()
    defaults = np.array([slot.default for slot in source.parameters])
    for k, slot in enumerate(source.parameters):
        if slot.words:
            continue
        for value in (0.0, -defaults[k], 1e-300, 1e300, np.nan, np.inf, 3.0 * defaults[k]):
            given, is_given = np.zeros(len(defaults)), np.zeros(len(defaults), bool)
            given[k], is_given[k] = value, True
            with np.errstate(all="ignore"):
                p = compiled.prepare(given, is_given)
                quick = has_valid_values(source, p, is_given)
                assert quick == is_accepted(simulation, p, is_given), (slot.address, value)
            accepted.add(quick)
    assert accepted == {True, False}
