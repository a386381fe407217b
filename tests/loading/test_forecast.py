"""The forecast of a long derivation: printed for many bodies only, and it grows with their number."""

from __future__ import annotations

import pytest

from gudgeon.loading.forecast import announce_long_derivation, forecast_derivation


def test_a_small_mechanism_is_not_announced(capsys: pytest.CaptureFixture[str]) -> None:
    announce_long_derivation("press", 12)
    assert capsys.readouterr() == ("", "")


def test_a_large_mechanism_is_announced_on_the_standard_error(capsys: pytest.CaptureFixture[str]) -> None:
    announce_long_derivation("chain", 400)
    seconds, megabytes = forecast_derivation(400)
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("note: deriving chain with 400 bodies takes about ")
    assert f"{seconds:.0f} s" in err and f"{megabytes:,.0f} MB" in err


def test_the_forecast_grows_with_the_number_of_bodies() -> None:
    forecasts = [forecast_derivation(n) for n in (1, 10, 100, 1000)]
    assert forecasts == sorted(forecasts)
    assert all(a[1] < b[1] for a, b in zip(forecasts, forecasts[1:], strict=False))
