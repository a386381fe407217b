"""The drift over time: the rows of Φ and Φ̇ at each sample, whatever integrates them, and without stabilisation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gudgeon.results.results import Result, read
from tests.programs import needs_compiler
from tests.valve import valve

WAYS: list[tuple[str, dict[str, Any]]] = [
    ("reduced", {}),
    ("full", {}),
    ("reduced", {"method": "rk4", "step": 1e-3}),
    ("full", {"method": "rk4", "step": 1e-3}),
    ("full", {"method": "rodas5p"}),
    ("full", {"method": "scipy:RK45"}),
]


def rows(run: Result) -> tuple[np.ndarray, np.ndarray]:
    """Largest |Φ| and |Φ_q q̇ − ν| of each sample, from the functions of the constraints themselves."""
    library = run.compiled
    assert library is not None
    found = [
        (library.phi(t, q, run.p), library.phi_q(t, q, run.p) @ v - library.nu(t, q, run.p))
        for t, q, v in zip(run.t, run.q, run.v, strict=True)
    ]
    phi, phi_dot = (np.array([np.abs(pair[k]).max() for pair in found]) for k in range(2))
    return phi, phi_dot


@needs_compiler
@pytest.mark.parametrize(("formulation", "options"), WAYS, ids=str)
def test_the_drift_is_that_of_the_rows(formulation: str, options: dict[str, Any], tmp_path: Path) -> None:
    run = valve(tmp_path, formulation=formulation).simulate(2.0, output=50, **options)
    phi, phi_dot = rows(run)
    np.testing.assert_allclose(run["Phi.max"], phi, rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(run["Phi_dot.max"], phi_dot, rtol=1e-9, atol=1e-13)
    assert (run.unit("Phi.max"), run.unit("Phi_dot.max")) == ("", "")


@needs_compiler
def test_the_drift_of_a_scene_without_a_freedom(tmp_path: Path) -> None:
    run = valve(tmp_path, kinematic=True).simulate(2.0, output=50)
    np.testing.assert_allclose(run["Phi.max"], rows(run)[0], rtol=1e-9, atol=1e-14)


@needs_compiler
def test_without_gains_it_grows_and_ends_at_what_diagnostics_tell(tmp_path: Path) -> None:
    """rk4 in the full formulation, a sample at each step, so that no step is between them; with gains it stays."""
    simulation = valve(tmp_path, formulation="full")
    gains = {"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0}
    options: dict[str, Any] = {"output": np.arange(401) * 5e-3, "method": "rk4", "step": 5e-3}
    free, held = (simulation.simulate(parameters=given, **options) for given in (gains, {}))
    assert free["Phi.max"].max() == pytest.approx(free.diagnostics.phi_max, rel=1e-6)
    assert held["Phi.max"].max() == pytest.approx(held.diagnostics.phi_max, rel=1e-6)
    growth = [run["Phi.max"][-40:].mean() / run["Phi.max"][20:60].mean() for run in (free, held)]
    assert growth[0] > 4.0 and growth[1] < 2.0, growth


def test_a_file_from_before_the_drift_is_read_and_written_again(run: Result, tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    run.save(tmp_path / "run.nc")
    with h5py.File(tmp_path / "run.nc", "r+") as file:
        del file["Phi.max"], file["Phi_dot.max"]
    back = read(tmp_path / "run.nc")
    np.testing.assert_array_equal(back["S9.y"], run["S9.y"])
    with pytest.raises(Exception, match="lacks the series"):
        back["Phi.max"]
    back.save(tmp_path / "again.nc")
    assert read(tmp_path / "again.nc")["A.F"].tobytes() == run["A.F"].tobytes()
