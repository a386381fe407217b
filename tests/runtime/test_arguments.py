"""Arguments of `simulate` that are none, and spellings that it shares with the command line."""

from __future__ import annotations

from typing import Any

import pytest

import gudgeon
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.measure.work import Setting
from gudgeon.parameters import spaced
from tests.runtime.pump import needs_compiler

pytestmark = needs_compiler


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"rtol": "x"}, "rtol is 'x': expected a share from 1e-14 to 1"),
        ({"rtol": float("nan")}, "expected a share"),
        ({"rtol": 1e-16}, "rounding would be controlled"),
        ({"rtol": 2.0}, "expected a share"),
        ({"rtol": 1e-6, "method": "rk4"}, "no tolerance"),
        ({"rtol": 1e-6, "step": 1e-3}, "leave out rtol"),
        ({"rtol": 1e-6, "step": 1e-3, "method": "dop853"}, "no tolerance"),
        ({"method": "kinematic"}, "use auto"),
        ({"step": "5 furlongs"}, "furlong"),
    ],
)
def test_what_is_refused(options: dict[str, Any], told: str) -> None:
    pendulum = gudgeon.load("pendulum")
    with pytest.raises(BadValueError if "furlongs" not in str(options) else gudgeon.InputError) as caught:
        pendulum.simulate(0.01, **options)
    assert told in str(caught.value)
    if "method" not in options and "step" not in options:
        with pytest.raises(BadValueError):
            pendulum.simulate_many({}, 0.01, **options)


def test_a_unit_may_follow_its_number_at_once() -> None:
    pendulum = gudgeon.load("pendulum")
    glued, apart, number = (pendulum.simulate("0.01s", step=step, output=5) for step in ("500us", "500 us", 5e-4))
    assert (glued.q == apart.q).all() and (glued.q == number.q).all()
    assert [spaced(text) for text in ("0.5mm", "0.5 mm", "2*pi rad/s", "1e-3m", "7")] == [
        "0.5 mm", "0.5 mm", "2*pi rad/s", "1e-3 m", "7",
    ]  # fmt: skip


def test_a_scene_without_freedom_takes_any_tolerance() -> None:
    """Nothing is integrated: a loop over scenes need not know it."""
    press = gudgeon.load("nine_bar_press")
    assert (press.simulate(0.01, output=5, rtol=1e-6).q == press.simulate(0.01, output=5).q).all()


def test_a_value_outside_its_range_is_told_the_range() -> None:
    dry = gudgeon.load("nine_bar_press", scene="dry")
    with pytest.raises(BadValueError, match=r"is 1\.5: coefficient of restitution.*; expected > 0 and <= 1$"):
        dry.simulate(0.01, parameters={"contacts.dry.normal.restitution": 1.5})
    with pytest.raises(UnknownNameError, match=r"\. Structural choices"):
        dry.simulate(0.01, parameters={"zzzzzzz": 1.5})


def test_finer_settings_stop_where_rounding_begins() -> None:
    assert Setting("auto", 1e-13).finer(100.0).value == 1e-14
    assert Setting("rk4", 1e-13).finer(100.0).value == pytest.approx(1e-15)
