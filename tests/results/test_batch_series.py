"""Series of a batch: evaluated run by run in threads, of an Evaluation only what a name needs, to the same bits."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import UnknownNameError
from gudgeon.model.baumgarte import select_motion_values
from gudgeon.model.evaluation import FIELD_NAMES
from gudgeon.results.batch import Batch
from gudgeon.results.results import EvaluatedSamples, Result
from gudgeon.results.series import get_catalogue
from tests.programs import needs_compiler
from tests.pump import TEXT as PUMP
from tests.valve import valve

pytestmark = needs_compiler
EVERY_KIND = Path(__file__).parent.parent / "mechanisms" / "valid" / "every_kind.yaml"
OUTPUTS = "outputs: {hit: B.F * piston.vx, run: 2 * piston.ax, both: B.F * c + energy.kinetic}\n"


@pytest.fixture(scope="module", params=["worn", "every kind", "friction", "kinematic"])
def batch(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Batch:
    """Play, outputs of all sorts and a run that fails; elements and frictions; without a freedom."""
    folder = tmp_path_factory.mktemp("series")
    if request.param == "worn":
        (folder / "pump.yaml").write_text(PUMP + OUTPUTS)
        columns: dict[str, Any] = {"c": [2e-4, 3e-4, -1.0, 4e-4]}
        return gudgeon.load(folder / "pump.yaml", "worn").simulate_many(columns, 0.02, output=30, threads=3)
    if request.param == "every kind":
        return gudgeon.load(EVERY_KIND).simulate_many({"parameters.k": [3000.0, 5000.0]}, 0.1, output=10)
    if request.param == "friction":
        belt = gudgeon.load("belt_block")
        slot = next(slot for slot in belt.source.parameters if slot.default)
        return belt.simulate_many({slot.address: slot.default * np.array([1.0, 1.1])}, 1.0, output=20)
    return valve(folder, kinematic=True).simulate_many({"w": [5.0, 7.0]}, 1.0, output=10)


def test_every_series_has_the_bits_of_the_run(batch: Batch) -> None:
    for name in get_catalogue(batch.source):
        values = batch[name]
        assert values.shape == (len(batch), batch.t.shape[-1])
        for i in range(len(batch)):
            run, done = batch.partial(i), int(batch.samples[i])
            assert np.isnan(values[i, done:]).all()
            if run is not None:
                assert values[i, :done].tobytes() == np.asarray(run[name], dtype=float).tobytes(), name


def test_what_is_not_needed_is_not_evaluated(batch: Batch, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither a whole result nor, of a position, anything in C; of the rest no other part is touched."""
    monkeypatch.setattr(type(batch.result), "__call__", None)
    known, requested = get_catalogue(batch.source), list[frozenset[str]]()
    plain = EvaluatedSamples.evaluation.func  # type: ignore[attr-defined]

    def noted(run: EvaluatedSamples) -> object:
        requested.append(run.evaluation_fields)
        return plain(run)

    monkeypatch.setattr(EvaluatedSamples, "evaluation", property(noted))
    first = batch.result.build_run_samples(0, FIELD_NAMES)
    stored = set() if first is None or first.accelerations is None else {"a"}  # by a method that Python drives
    for name in known:
        requested.clear()
        found = batch[name]
        assert set(requested) <= {known[name].evaluation_fields} and known[name].evaluation_fields <= FIELD_NAMES, name
        assert bool(requested) == bool(known[name].evaluation_fields - stored), name
        assert found.shape == (len(batch), batch.t.shape[-1])


def test_parts_that_nobody_wanted_have_no_row(batch: Batch) -> None:
    run = batch.partial(0)
    assert run is not None and run.compiled is not None
    p = select_motion_values(run.compiled, run.diagnostics.method, run.p)
    for parts in (frozenset[str](), {"a"}, {"clearance", "drift"}, {"reactions"}):
        found = run.compiled.evaluate(run.t, run.q, run.v, run.memory, p, field_names=parts)
        whole = run.evaluation
        for name in FIELD_NAMES:
            values = getattr(found, name)
            assert len(values) in (0, len(run.t)) and (name not in parts or len(values))
            assert not len(values) or values.tobytes() == getattr(whole, name).tobytes()


def test_a_name_that_there_is_not(batch: Batch) -> None:
    for call in (lambda: batch["energy.kinetik"], lambda: batch.to_dataframe(["energy.kinetik"])):
        with pytest.raises(UnknownNameError, match="energy"):
            call()


def test_a_catalogue_is_made_once_a_source_and_goes_with_it() -> None:
    first, second = gudgeon.load("four_bar"), gudgeon.load("four_bar")
    assert get_catalogue(first.source) is get_catalogue(first.source)
    assert list(get_catalogue(first.source)) == list(get_catalogue(second.source))
    from gudgeon.results.series import _catalogues

    third = replace(second.source)  # one that no thread that compiles it knows
    assert list(get_catalogue(third)) == list(get_catalogue(first.source))
    key = id(third)
    assert key in _catalogues
    del third
    get_catalogue(gudgeon.load("pendulum").source)  # whoever comes next sees that it is gone
    assert key not in _catalogues or _catalogues[key][0]() is not None


def test_results_from_threads_are_those_made_alone() -> None:
    """Whole runs in threads of the caller's: every array and series."""
    press = gudgeon.load("nine_bar_press", "dry")
    clearances = np.linspace(3e-4, 8e-4, 6).tolist()

    def one(c: float) -> Result:
        return press.simulate(0.02, output=50, rtol=1e-6, parameters={"c": c})

    with ThreadPoolExecutor(3) as pool:
        together = list(pool.map(one, clearances))
    for c, run in zip(clearances, together, strict=True):
        alone = one(c)
        for name in ("t", "q", "v", "a", "state", "memory", "work", "impacts"):
            assert getattr(run, name).tobytes() == getattr(alone, name).tobytes(), name
        assert run["A.F"].tobytes() == alone["A.F"].tobytes()
        assert run.diagnostics.notes == alone.diagnostics.notes
