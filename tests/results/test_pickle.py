"""Results, states, batches and errors go to other processes and come back whole: every series bit for bit."""

from __future__ import annotations

import copy
import os
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon import errors
from gudgeon.errors import GudgeonError, InputErrors, Location, SolverError
from gudgeon.loading import declared
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler
SCENES: list[tuple[str, str, dict[str, Any]]] = [
    ("nine_bar_press", "dry", {"parameters": {"c": "0.4 mm"}}),
    ("slider_crank", "ideal", {}),
    ("belt_block", "ideal", {"step": 1e-3}),
    ("pendulum", "ideal", {"method": "scipy:DOP853"}),
]


def thawed(thing: Any) -> list[Any]:
    return [pickle.loads(pickle.dumps(thing)), copy.deepcopy(thing), copy.copy(thing)]


def assert_same(one: Result, other: Result) -> None:
    assert list(one.names) == list(other.names)
    for name in one.names:
        assert one[name].tobytes() == other[name].tobytes(), name
        assert not other[name].flags.writeable
    for name in ("p", "given", "is_given", "impacts", "events", "a"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    assert str(one.diagnostics) == str(other.diagnostics) and one.source == other.source
    assert dict(one.parameters) == dict(other.parameters) and dict(one.constants) == dict(other.constants)


@pytest.mark.parametrize("requested", ["before", "after"])
@pytest.mark.parametrize(("name", "scene", "options"), SCENES)
def test_a_result(name: str, scene: str, options: dict[str, Any], requested: str, tmp_path: Path) -> None:
    run = gudgeon.load(name, scene=scene).simulate(0.012, output=12, **options)
    if requested == "before":  # series and what they follow from are stored
        assert len([run[series] for series in run.names])
    else:
        run.__dict__.pop("evaluation", None)  # as of a run of more samples than are kept at hand
    for other in thawed(run):
        assert_same(run, other)
        assert other.final.q.tobytes() == run.final.q.tobytes()
    run.save(tmp_path / "run.nc")
    for other in thawed(Result.load(tmp_path / "run.nc")):
        assert_same(run, other)


@pytest.mark.parametrize(("name", "scene", "options"), SCENES[:3])
def test_a_state_goes_on_as_before(name: str, scene: str, options: dict[str, Any]) -> None:
    simulation = gudgeon.load(name, scene=scene)
    state = simulation.simulate(0.012, output=1, **options).final
    step = {"step": options["step"]} if "step" in options else {}
    whole = simulation.simulate(0.02, output=2, start=state, **step)
    for other in thawed(state):
        assert dict(other.parameters) == dict(state.parameters)
        with pytest.raises(TypeError):
            other.parameters["c"] = 1.0
        assert simulation.simulate(0.02, output=2, start=other, **step).q.tobytes() == whole.q.tobytes()


@pytest.mark.parametrize(
    ("name", "scene", "column", "options"),
    [
        ("nine_bar_press", "lubricated", "c", {"method": "rk4", "step": 2e-5}),
        ("nine_bar_press", "lubricated", "c", {"rtol": 1e-5}),
        ("pendulum", "ideal", "length", {"method": "scipy:DOP853"}),
    ],
)
def test_a_batch(name: str, scene: str, column: str, options: dict[str, Any]) -> None:
    simulation = gudgeon.load(name, scene=scene)
    batch = simulation.simulate_many({column: [0.6e-3, -1.0, 0.8e-3]}, 1e-3, output=3, **options)
    series = "S9.y" if name == "nine_bar_press" else "bob.x"
    for other in thawed(batch):
        assert isinstance(other, Batch) and len(other) == 3 and [f.run for f in other.failures] == [1]
        for name in ("t", "q", "v", "work", "state", "peaks", "samples"):
            assert getattr(other, name).tobytes() == getattr(batch, name).tobytes()
        assert_same(batch[2], other[2])
        assert other[series].tobytes() == batch[series].tobytes()
        with pytest.raises(GudgeonError, match="clearance|parameters.c|rod") as caught:
            other[1]
        assert str(caught.value) == str(batch.failures[0].error)


def test_what_a_failed_run_had_reached() -> None:
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    with pytest.raises(SolverError) as caught:
        simulation.simulate(5e-3, output=10, method="rk4", step=4e-4, parameters={"c": 0.1e-3})
    for other in thawed(caught.value):
        assert type(other) is type(caught.value) and str(other) == str(caught.value)
        assert other.time == caught.value.time and other.outside_model == caught.value.outside_model
        assert_same(caught.value.partial, other.partial)


def every(kind: type[GudgeonError]) -> list[type[GudgeonError]]:
    return [kind, *(found for below in kind.__subclasses__() for found in every(below))]


@pytest.mark.parametrize("kind", [k for k in every(GudgeonError) if k.__module__ == errors.__name__])
def test_every_error(kind: type[GudgeonError]) -> None:
    where = Location("a.yaml", 3, 4)
    if kind is InputErrors:
        error: GudgeonError = InputErrors([errors.UnitError("two", where, "a hint"), errors.BadValueError("one")])
    elif kind is errors.OutputError:
        error = errors.OutputError("a/run.nc", "no space")
    elif issubclass(kind, errors.InputError):
        error = kind("what", where, "hint")
    else:
        error = kind("what", 0.5, "row") if issubclass(kind, SolverError) else kind("what")
    for other in thawed(error):
        assert type(other) is kind and str(other) == str(error) and other.args == error.args
        assert {k: str(v) for k, v in vars(other).items()} == {k: str(v) for k, v in vars(error).items()}


def test_a_pool_of_new_processes() -> None:
    """`simulate` of a simulation that went there, its result back here, its `final` there again."""
    press = gudgeon.load("nine_bar_press", scene="dry")
    plain = press.simulate(0.01, output=10, parameters={"c": 0.4e-3})
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        there = pool.submit(press.simulate, 0.01, output=10, parameters={"c": 0.4e-3}).result()
        rest = pool.submit(press.simulate, 0.012, output=2, start=there.final).result()
        batch = pool.submit(press.simulate_many, {"c": [0.4e-3, 0.5e-3]}, 0.01, output=10).result()
        with pytest.raises(GudgeonError, match="expected a time after the start"):
            pool.submit(press.simulate, -1.0).result()
        film = gudgeon.load("nine_bar_press", scene="lubricated")
        options: dict[str, Any] = {"method": "rk4", "step": 4e-4, "parameters": {"c": 0.1e-3}}
        with pytest.raises(SolverError) as caught:
            pool.submit(film.simulate, 5e-3, output=10, **options).result()
    for name in plain.names:
        assert there[name].tobytes() == plain[name].tobytes() == batch[0][name].tobytes()
    assert rest.q.tobytes() == press.simulate(0.012, output=2, start=plain.final).q.tobytes()
    assert np.isfinite(caught.value.partial["S9.y"]).all()


def test_joblib() -> None:
    joblib = pytest.importorskip("joblib")
    pendulum = gudgeon.load("pendulum")
    runs = joblib.Parallel(n_jobs=2)(
        joblib.delayed(pendulum.simulate)(0.1, output=4, parameters={"g": g}) for g in (1.62, 9.81)
    )
    for g, run in zip((1.62, 9.81), runs, strict=True):
        assert_numbers(run, pendulum.simulate(0.1, output=4, parameters={"g": g}))


def assert_numbers(one: Result, other: Result) -> None:
    for name in one.names:
        assert one[name].tobytes() == other[name].tobytes()


def test_a_library_that_is_not_in_the_cache_there_is_compiled_again(tmp_path: Path) -> None:
    run = gudgeon.load("pendulum").simulate(0.1, output=4)
    run.__dict__.pop("evaluation", None)
    (tmp_path / "run.pickle").write_bytes(pickle.dumps(run))
    code = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb'))['energy.kinetic'].tobytes().hex())"
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "run.pickle")],
        env={**os.environ, "GUDGEON_CACHE": str(tmp_path / "cache")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == run["energy.kinetic"].tobytes().hex()


def test_pickles_of_another_version_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    batch = gudgeon.load("bouncing_ball").simulate_many({"bodies.ball.mass": [1.0, 2.0]}, 0.1, output=3)
    pickled = pickle.dumps(batch)
    monkeypatch.setattr(declared, "SHA256", "of other declarations")
    with pytest.raises(GudgeonError, match="written by another version of gudgeon"):
        pickle.loads(pickled)
