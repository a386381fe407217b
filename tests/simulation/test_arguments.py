"""Arguments of `simulate` that are none, and spellings that it shares with the command line."""

from __future__ import annotations

import warnings
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.kernel_source import RuntimeParameter
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language.quantities import parse_quantity
from gudgeon.model.parameters import insert_space_before_unit, parse_plain_number, read_parameter_value
from gudgeon.studies.runs import Setting
from tests.programs import needs_compiler
from tests.pump import Gudgeon

pytestmark = needs_compiler


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rtol": "x"}, "rtol is 'x': expected a number from 1e-14 to less than 1"),
        ({"rtol": float("nan")}, "expected a number from"),
        ({"rtol": 1e-16}, "smaller tolerances are below rounding errors"),
        ({"rtol": 2.0}, "expected a number from"),
        ({"rtol": 1e-6, "method": "rk4"}, "no tolerance"),
        ({"rtol": 1e-6, "step": 1e-3}, "leave out rtol"),
        ({"rtol": 1e-6, "step": 1e-3, "method": "dop853"}, "no tolerance"),
        ({"method": "kinematic"}, "use auto"),
        ({"step": "5 furlongs"}, "furlong"),
    ],
)
def test_what_is_refused(options: dict[str, Any], message: str) -> None:
    pendulum = gudgeon.load("pendulum")
    with pytest.raises(BadValueError if "furlongs" not in str(options) else gudgeon.InputError) as caught:
        pendulum.simulate(0.01, **options)
    assert message in str(caught.value)
    if "method" not in options and "step" not in options:
        with pytest.raises(BadValueError):
            pendulum.simulate_many({}, 0.01, **options)


def test_a_unit_may_follow_its_number_at_once() -> None:
    pendulum = gudgeon.load("pendulum")
    glued, apart, number = (pendulum.simulate("0.01s", step=step, output=5) for step in ("500us", "500 us", 5e-4))
    assert (glued.q == apart.q).all() and (glued.q == number.q).all()
    assert [insert_space_before_unit(text) for text in ("0.5mm", "0.5 mm", "2*pi rad/s", "1e-3m", "7")] == [
        "0.5 mm",
        "0.5 mm",
        "2*pi rad/s",
        "1e-3 m",
        "7",
    ]


def test_a_long_text_is_looked_at_once() -> None:
    """Not once for each pair of its digits, which a million of them would not end in years."""
    for text in ("9" * 10**6, "1." + "0" * 10**6 + "!", "1" + " " * 10**6 + "2"):
        assert insert_space_before_unit(text) == text


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
    assert Setting("auto", 1e-13).refine(100.0).value == 1e-14
    assert Setting("rk4", 1e-13).refine(100.0).value == pytest.approx(1e-15)


def test_numbers_are_texts_too() -> None:
    pendulum = gudgeon.load("pendulum")
    plain = pendulum.simulate(1e-3, output=4, rtol=1e-9, parameters={"g": 1e-9})
    text = pendulum.simulate("1e-3", output=4, rtol="1e-9", parameters={"g": "1e-9"})
    assert text.q.tobytes() == plain.q.tobytes() and text.parameters["g"] == 1e-9
    stepped = pendulum.simulate("1e-3", output=4, step="1e-6")
    assert stepped.q.tobytes() == pendulum.simulate(1e-3, output=4, step=1e-6).q.tobytes()
    batch = pendulum.simulate_many({"g": ["1e-9", "9.81 m/s^2"]}, "1e-3", output=4, rtol="1e-9")
    assert batch[0].q.tobytes() == plain.q.tobytes()


NO_NUMBERS = (
    "1_0",
    "\uff11",
    "1e-400",
    "1e400",
    "nan",
    "inf",
    "",
    "  ",
    "1e",
    "0x10",
    "1,5",
    "1 0",
    "1e5e5",
    "٣",
    "1e-9 x",
)


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_text_that_is_no_number_in_a_file_is_none_anywhere(text: str, call: Gudgeon) -> None:
    pendulum = gudgeon.load("pendulum")
    for options in ({"parameters": {"g": text}}, {"t_end": text}, {"step": text}, {"rtol": text}):
        with pytest.raises(gudgeon.InputError):
            pendulum.simulate(**options)
    with pytest.raises(gudgeon.InputError):
        gudgeon.load("pendulum", overrides={"parameters.g": text})
    lines = [["--set", f"g={text}"], ["--t-end", text], ["--step", text], ["--rtol", text]]
    for line in lines if text == NO_NUMBERS[0] else lines[:1]:
        assert call("run", "pendulum", "--output", "2", *line).exit_code == 2, line


@pytest.mark.parametrize("text", ["1_0", "\uff11", "٣", "1e1", "-1", "1.5"])
def test_a_count_is_what_a_file_takes(text: str, call: Gudgeon) -> None:
    """--output 1_0 was ten."""
    for line in (["run", "pendulum", "--output"], ["map", "pendulum", "--range", "g=1..2", "--box"]):
        done = call(*line, text)
        assert done.exit_code == 2 and "whole number" in done.stderr, done.output


def test_an_end_and_times_that_end_elsewhere_are_refused() -> None:
    """t_end was ignored beside times of output."""
    pendulum, times = gudgeon.load("pendulum"), np.linspace(0.0, 0.3, 4)
    for simulate in (pendulum.simulate, lambda *end, **options: pendulum.simulate_many({}, *end, **options)):
        with pytest.raises(BadValueError, match=r"t_end is 0\.5 s, and the times of output end at 0\.3 s"):
            simulate("500 ms", output=times)
    whole = pendulum.simulate(output=times)
    for end in (0.3, "300 ms", 0.1 + 0.2):
        assert pendulum.simulate(end, output=times).q.tobytes() == whole.q.tobytes()


def test_a_number_is_what_the_file_makes_of_it() -> None:
    """The quick way of a bare number and the file's parser have one opinion."""
    rng, slot = np.random.default_rng(5), RuntimeParameter("x", "", 0.0, False, (0, 0, 0))
    pieces = ["0", "1", "9", "00", ".", "e", "E", "-", "+", "400", "308", "1e-324", "5e-324", "_", " ", "1.5", "٣"]
    count = 0
    for _ in range(1500):
        text = "".join(rng.choice(pieces, rng.integers(1, 6)))
        quick = parse_plain_number(text)
        try:
            slow: float | None = parse_quantity(insert_space_before_unit(text), slot.address, slot.dimension)
        except gudgeon.InputError:
            slow = None
        if quick is not None:
            count += 1
            assert slow is not None and quick.hex() == slow.hex(), text
        if slow is None:
            with pytest.raises(gudgeon.InputError):
                read_parameter_value(text, slot)
    assert count > 200


def test_a_number_that_is_set_twice_is_told(call: Gudgeon) -> None:
    pendulum = gudgeon.load("pendulum")
    twice: dict[str, float | str] = {"g": 1.0, "parameters.g": 2.0}
    with pytest.raises(BadValueError, match="parameters.g is given twice: as 'g' and as 'parameters.g'"):
        pendulum.simulate(0.01, parameters=twice)
    with pytest.raises(BadValueError, match="given twice"):
        pendulum.simulate_many({name: [value] for name, value in twice.items()}, 0.01)
    for settings in (("g=1", "g=2"), ("g=1", "parameters.g=2"), ("g=1", "g=1")):
        for command in ("run", "bench", "map"):
            line = [part for setting in settings for part in ("--set", setting)]
            done = call(command, "pendulum", *line)
            assert done.exit_code == 2 and f"this parameter is set already, by --set {settings[0]}" in done.output


@pytest.mark.parametrize(
    "value",
    [
        None,
        [1.0, 2.0],
        1j,
        float("nan"),
        10**400,
        b"1",
        object(),
        np.ma.masked,
        {},
        True,
        np.True_,
        np.array(True),
        5e-324,
        -1e-320,
        np.float64(2e-308),
    ],
)
def test_what_is_no_number(value: Any) -> None:
    pendulum = gudgeon.load("pendulum")
    with pytest.raises(BadValueError, match="parameters.g"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pendulum.simulate(0.01, parameters={"g": value})
    with pytest.raises(BadValueError, match="expected a mapping"):
        pendulum.simulate(0.01, parameters=[("g", 1.0)])  # type: ignore[arg-type]


@pytest.mark.parametrize("column", [[True, False], np.array([True]), np.array([2.0, True], object), [1.0, 5e-324]])
def test_columns_of_what_is_no_number(column: Any) -> None:
    """As one run is refused; "5e-324" and 5e-324 by one sentence."""
    pendulum = gudgeon.load("pendulum")
    with pytest.raises(BadValueError, match=r"run [01]: parameters\.g"):
        pendulum.simulate_many({"g": column}, 0.01)
    with pytest.raises(BadValueError, match="booleans"):
        final = pendulum.simulate(0.01).final
        pendulum.simulate(0.02, start=replace(final, v=np.ones(len(final.v), bool)))
    for least in (5e-324, "5e-324"):
        with pytest.raises(gudgeon.InputError, match=r"(?s)5e-324'? is out of range\n.*from 2\.3e-308 to 1\.7e308"):
            pendulum.simulate(0.01, parameters={"g": least})


@pytest.mark.parametrize("value", [np.float32(1.5), np.int64(3), Fraction(1, 4), Decimal("0.5"), np.array(2.0)])
def test_what_is_one(value: Any) -> None:
    run = gudgeon.load("pendulum").simulate(0.01, output=1, parameters={"g": value})
    assert run.parameters["g"] == float(value)


def calls_with_names(names: Any) -> list[tuple[str, Any]]:
    """Return each argument that takes names of series or parameters, with a call that passes `names` to it."""
    pendulum = gudgeon.load("pendulum")
    runs = {"g": [1.0, 2.0]}
    return [
        ("parameters", lambda: pendulum.prepare(names, "bob.x", t_end=0.1)),
        ("inputs", lambda: pendulum.stepper(names, "bob.x")),
        ("series", lambda: pendulum.prepare("g", names, t_end=0.1)),
        ("series", lambda: pendulum.stepper("g", names)),
        ("peaks", lambda: pendulum.prepare("g", "bob.x", t_end=0.1, peaks=names)),
        ("peaks", lambda: pendulum.simulate(0.1, peaks=names)),
        ("peaks", lambda: pendulum.simulate_many(runs, 0.1, peaks=names)),
        ("keep", lambda: pendulum.simulate_many(runs, 0.1, keep=names)),
        ("names", lambda: pendulum.simulate(0.1).to_dataframe(names)),
        ("names", lambda: pendulum.simulate_many(runs, 0.1).to_dataframe(names)),
    ]


def test_names_in_sets_are_refused() -> None:
    """A set has no order, but the order of names is that of values and series."""
    for names in ({"g", "length"}, frozenset(["bob.x"])):
        for argument, call in calls_with_names(names):
            with pytest.raises(BadValueError, match=rf"^{argument} is .*set.*a set has no order\n.*sorted\("):
                call()


def test_repeated_names_are_refused() -> None:
    for argument, call in calls_with_names(["bob.x", "bob.y", "bob.x"]):
        with pytest.raises(BadValueError, match=f"^{argument}: 'bob.x' is given twice\n"):
            call()
    with pytest.raises(BadValueError, match=r"^inputs: 'g' is given twice\n  give it once, in inputs or in fixed"):
        gudgeon.load("pendulum").stepper("g", "bob.x", fixed={"g": 1.0})


def test_stored_series_may_be_exported_by_name() -> None:
    batch = gudgeon.load("pendulum").simulate_many({"g": [1.0, 2.0]}, 0.1, output=3, keep=["bob.x"])
    assert (batch.to_xarray(["bob.x"])["bob.x"].to_numpy() == batch["bob.x"]).all()
