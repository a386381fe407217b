"""Every public argument with values that it was not made for: an error of gudgeon's that names it, or a good use."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError, GudgeonError, InputError
from gudgeon.results.figures.run_plots import Plot
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies import axes, bench, box
from gudgeon.studies import map as maps
from gudgeon.studies.runs import Error
from tests.programs import needs_compiler

pandas = pytest.importorskip("pandas", reason="a Series of pandas is one of the values")
pytestmark = needs_compiler


def odd_values() -> dict[str, Any]:
    values: dict[str, Any] = {
        "None": None,
        "text": "x",
        "no text": "",
        "bytes": b"",
        "tuple": (1,),
        "list": [],
        "nested": [[1], [2, 3]],
        "dict": {},
        "numbered": {1: 2},
        "mapped": {"x": None},
        "huge": 10**400,
        "nan": float("nan"),
        "inf": float("inf"),
        "-1": -1,
        "True": True,
        "object": object(),
        "0-d": np.array(3),
        "empty": np.zeros(0),
        "complex": 1j,
        "path": Path("x"),
        "function": lambda *_: None,
        "texts": np.array(["a", "b"]),
        "objects": np.array([None, 1], dtype=object),
        "days": np.datetime64("2020-01-01"),
        "set": {1},
        "type": int,
        "generator": (one for one in range(0)),
        "vast": np.broadcast_to(0.0, (10**12,)),
        "zero": "\0",
        "lone": "\ud800",
        "long": "x" * 10**5,
        "iterator": iter([{}]),
        "lapse": np.timedelta64(5, "s"),
        "array's type": np.float64,
        "0-d lapse": np.array(np.timedelta64(5)),
        "thing": SimpleNamespace(columns=3, final=None),
    }
    return values | {"series": pandas.Series({"x": 1.0}), "table": pandas.DataFrame({"x": [1.0, 2.0]})}


@pytest.fixture(scope="module")
def pendulum() -> Simulation:
    return gudgeon.load("pendulum")


@pytest.fixture(scope="module")
def run(pendulum: Simulation) -> Result:
    return pendulum.simulate(0.01, output=2)


@pytest.fixture(scope="module")
def batch(pendulum: Simulation) -> Any:
    return pendulum.simulate_many([{}, {}], 0.01, output=2)


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def refused_or_used(
    call: Callable[[Any], object], documented: tuple[type[Exception], ...] = (), but: tuple[str, ...] = ()
) -> None:
    """`call` with every odd value; fails with all that came out of it and is no error of gudgeon's."""
    raw = []
    for name, value in odd_values().items():
        if name in but:
            continue
        try:
            call(value)
        except GudgeonError:
            pass
        except Exception as error:
            if isinstance(error, documented):
                continue
            raw.append(f"{name}: {type(error).__name__}: {str(error)[:200]}")
    assert not raw, "\n".join(raw)


RUN: dict[str, Any] = {"t_end": 0.01, "output": 2}
ARGUMENTS = (
    "t_end",
    "output",
    "method",
    "rtol",
    "step",
    "parameters",
    "start",
    "progress",
    "horizon",
    "stop",
    "peaks",
    "against",
)


CALLED = {"progress": ("type", "array's type")}  # int(0.0, "a text") fails in the caller's own function


@pytest.mark.parametrize("name", ARGUMENTS)
def test_simulate(pendulum: Simulation, name: str) -> None:
    refused_or_used(lambda value: pendulum.simulate(**(RUN | {name: value})), but=CALLED.get(name, ()))


@pytest.mark.parametrize(
    "name",
    [
        "parameters",
        *(n for n in ARGUMENTS if n not in ("start", "horizon", "parameters")),
        "threads",
        "side_by_side",
        "keep",
        "start",
    ],
)
def test_simulate_many(pendulum: Simulation, name: str) -> None:
    good = {"parameters": [{}]} | RUN
    refused_or_used(lambda value: pendulum.simulate_many(**(good | {name: value})), but=CALLED.get(name, ()))


@pytest.mark.parametrize("where", ["a run", "a batch", "a column", "the start"])
def test_a_parameter(pendulum: Simulation, where: str) -> None:
    address = pendulum.source.parameters[0].address
    calls: dict[str, Callable[[Any], object]] = {
        "a run": lambda value: pendulum.simulate(**RUN, parameters={address: value}),
        "a batch": lambda value: pendulum.simulate_many([{address: value}], **RUN),
        "a column": lambda value: pendulum.simulate_many({address: value}, **RUN),
        "the start": lambda value: pendulum.start({address: value}),
    }
    refused_or_used(calls[where])


@pytest.mark.parametrize(
    "field",
    ["mechanism", "scene", "t", "q", "v", "state", "memory", "parameters", "sha256", "overrides", "formulation"],
)
def test_a_state(pendulum: Simulation, run: Result, field: str) -> None:
    refused_or_used(lambda value: pendulum.simulate(0.02, output=2, start=replace(run.final, **{field: value})))


CALLS: dict[str, tuple[str, ...]] = {
    "rhs": ("t", "y", "memory"),
    "jacobian": ("t", "y", "memory"),
    "phi": ("t", "q"),
    "phi_q": ("t", "q"),
    "nu": ("t", "q"),
    "gamma": ("t", "q", "v"),
    "start": ("parameters",),
}


@pytest.mark.parametrize(("method", "name"), [(method, name) for method, names in CALLS.items() for name in names])
def test_equations(pendulum: Simulation, method: str, name: str) -> None:
    n = pendulum.compiled.n
    good: dict[str, Any] = {
        "t": 0.0,
        "y": np.zeros(2 * n),
        "q": np.zeros(n),
        "v": np.zeros(n),
        "memory": None,
        "parameters": None,
    }
    given = {argument: good[argument] for argument in CALLS[method]}
    refused_or_used(lambda value: getattr(pendulum, method)(**(given | {name: value})))


COMPILED: dict[str, tuple[str, ...]] = {
    "rhs": ("t", "y", "p", "discrete_states"),
    "jacobian": ("t", "y", "p", "discrete_states"),
    "evaluate": ("t", "q", "v", "discrete_states", "p"),
    "solve_newton_system": ("t", "y", "p", "eta", "s", "r", "discrete_states"),
    "prepare": ("given", "is_given"),
    "mass": ("p",),
    "closed_phi": ("t", "q", "p"),
    "closed_gamma": ("t", "q", "v", "p"),
    "start_values": ("p",),
    "close_linkage": ("t", "p", "size"),
}


@pytest.mark.parametrize(("method", "name"), [(method, name) for method, names in COMPILED.items() for name in names])
def test_compiled(pendulum: Simulation, method: str, name: str) -> None:
    compiled = pendulum.full.compiled
    n, slots = compiled.n, len(compiled.source.parameters)
    good: dict[str, Any] = {
        "t": 0.0,
        "y": np.zeros(2 * n),
        "q": np.zeros(n),
        "v": np.zeros(n),
        "discrete_states": None,
        "p": pendulum.full.p,
        "eta": 1.0,
        "s": 0.0,
        "r": np.zeros(2 * n + 3),
        "size": 1.0,
        "given": np.zeros(slots),
        "is_given": np.zeros(slots),
    }
    if method == "evaluate":
        good |= {"t": [0.0], "q": np.zeros((1, n)), "v": np.zeros((1, n)), "discrete_states": np.zeros((1, 1))}
    given = {argument: good[argument] for argument in COMPILED[method]}
    refused_or_used(lambda value: getattr(compiled, method)(**(given | {name: value})))


@pytest.mark.parametrize("name", ["mechanism", "scene", "overrides", "formulation", "portable", "regenerate"])
def test_load(name: str) -> None:
    good: dict[str, Any] = {"mechanism": "pendulum"}
    refused_or_used(lambda value: gudgeon.load(**(good | {name: value})))


def test_an_override() -> None:
    refused_or_used(lambda value: gudgeon.load("pendulum", overrides={"bodies.rod.mass": value}))


RESULT: dict[str, Callable[[Result, Any], object]] = {
    "[]": lambda run, value: run[value],
    "in": lambda run, value: value in run,
    "unit": lambda run, value: run.unit(value),
    "meaning": lambda run, value: run.meaning(value),
    "peak": lambda run, value: run.peak(value),
    "peak_error": lambda run, value: run.peak_error(value),
    "events_of": lambda run, value: run.events_of(value),
    "value_of": lambda run, value: run.value_of(value),
    "to_xarray": lambda run, value: run.to_xarray(value),
    "save": lambda run, value: run.save(value),
    "save's attributes": lambda run, value: run.save("x.nc", value),
    "one attribute": lambda run, value: run.save("x.nc", {"by": value}),
    "peak of a joint": lambda run, value: run.diagnostics.peak(value),
    "load": lambda run, value: Result.load(value),
}


@pytest.mark.parametrize("name", RESULT)
def test_a_result(run: Result, name: str) -> None:
    refused_or_used(lambda value: RESULT[name](run, value))


@pytest.mark.parametrize("name", ["series", "orbit", "path", "mechanism"])
def test_a_plot(run: Result, name: str) -> None:
    pytest.importorskip("matplotlib")
    refused_or_used(lambda value: getattr(Plot(run), name)(value))


def test_the_orbit_of_a_joint() -> None:
    pytest.importorskip("matplotlib")
    worn = gudgeon.load("slider_crank", "dry").simulate(1e-3, output=2)
    refused_or_used(lambda value: Plot(worn).orbit(value))


@pytest.mark.parametrize("name", ["gudgeon", "title", "", "a" * 300, "a\nb"])
def test_what_a_file_is_read_by_is_not_written_over(run: Result, name: str) -> None:
    with pytest.raises(BadValueError, match="is not a valid name"):
        run.save("x.nc", {name: "mine"})
    run.save("x.nc", {"by": "me"})
    assert Result.load("x.nc").source == run.source


@pytest.mark.parametrize("name", ["series", "forces", "mechanism", "path"])
def test_axes_of_a_plot(run: Result, name: str) -> None:
    figure = pytest.importorskip("matplotlib.figure").Figure()
    given: Any = {"series": ["bob.x"], "path": ["bob"]}.get(name, ())
    refused_or_used(lambda value: getattr(Plot(run), name)(*given, ax=value))
    for wrong in (figure, figure.subplots(1, 2), figure.add_subplot(projection="3d"), figure.add_subplot(polar=True)):
        with pytest.raises(BadValueError, match="ax is"):
            getattr(Plot(run), name)(*given, ax=wrong)


def test_points_of_an_animation(run: Result) -> None:
    pytest.importorskip("matplotlib")
    refused_or_used(lambda value: run.animate(points=value, seconds=0.1, rate=20))


def test_one_name_is_a_list_of_one(pendulum: Simulation) -> None:
    """Names of NumPy's come back as plain texts."""
    assert set(pendulum.simulate_many([{}], 0.01, output=2, keep="bob.x").kept) == {"t", "bob.x"}
    (one,) = pendulum.simulate(0.01, output=2, peaks=np.array(["bob.x"])).diagnostics.extremes
    assert one.name == "bob.x" and type(one.name) is str
    with pytest.raises(BadValueError, match="t has no peaks"):
        pendulum.simulate(0.01, output=2, peaks=["t"])


def test_a_batch_by_number_and_name(batch: Any) -> None:
    refused_or_used(lambda value: batch[value], (IndexError,))
    refused_or_used(batch.partial, (IndexError,))
    with pytest.raises(BadValueError, match="a run of a batch is 'x': expected its number"):
        batch.partial("x")
    refused_or_used(lambda value: batch.to_xarray(value))
    refused_or_used(lambda value: batch.peak(value))


BENCH = ("steps", "tolerances", "t_end", "parameters", "quick", "methods", "progress")


@pytest.mark.parametrize("name", BENCH)
def test_bench(pendulum: Simulation, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As far as the measuring itself, which takes its time."""
    found = bench.SceneBench("", 1.0, "", (), (), Error(), 0.0, ())
    monkeypatch.setattr(bench, "_measure_settings", lambda *_: found)
    good: dict[str, Any] = {"t_end": 0.01, "quick": True}
    refused_or_used(lambda value: bench.measure_scene(pendulum, **(good | {name: value})))


STRESS = ("axes", "method", "value", "t_long", "t_short", "parameters", "limits", "quick", "progress")
BOX = ("ranges", "count", "setting", "t_long", "parameters", "limits", "addresses", "quick", "progress")


class _NoPool:
    """Judges nothing."""

    def __class_getitem__(cls, _: object) -> type[_NoPool]:
        return cls

    def __init__(self, *_: object) -> None: ...

    def __enter__(self) -> _NoPool:
        return self

    def __exit__(self, *_: object) -> None: ...

    def map_in_threads(self, _: object, jobs: Any) -> list[None]:
        return [None] * len(jobs)


@pytest.mark.parametrize("name", STRESS)
def test_map(pendulum: Simulation, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maps, "TaskPool", _NoPool)
    good: dict[str, Any] = {"quick": True}
    refused_or_used(lambda value: maps.compute_verdict_map(pendulum, **(good | {name: value})))


@pytest.mark.parametrize("name", BOX)
def test_stress_box(pendulum: Simulation, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maps, "TaskPool", _NoPool)
    ranges = [box.Range(pendulum.source.parameters[0].address, 1.0, 2.0)]
    good: dict[str, Any] = {"ranges": ranges, "count": 2}
    refused_or_used(lambda value: maps.compute_verdict_box(pendulum, **(good | {name: value})))


def test_axes(pendulum: Simulation) -> None:
    address = pendulum.source.parameters[0].address
    refused_or_used(lambda value: axes.make_axis(pendulum, value, [1.0]))
    refused_or_used(lambda value: axes.make_axis(pendulum, address, value))
    refused_or_used(lambda value: axes.make_axis(pendulum, address, [1.0], value))
    refused_or_used(lambda value: axes.parse_axis(pendulum, value))
    refused_or_used(lambda value: box.Range(address, value, 1.0))


def test_what_is_told(pendulum: Simulation) -> None:
    """Each by its name, with what was given and what was expected."""
    vast = np.broadcast_to(0.0, (10**12,))
    y = np.zeros(2 * pendulum.compiled.n)
    refused: list[tuple[Callable[[], object], str]] = [
        (lambda: pendulum.simulate(0.01, output=vast), "output has 1000000000000 entries: expected 100000000 at most"),
        (lambda: pendulum.simulate(0.01, output=0.5), "output is 0.5: expected a whole number of intervals, 1 to"),
        (lambda: pendulum.simulate(0.01, output={}), "output is dict '{}': expected real numbers"),  # type: ignore[arg-type]
        (lambda: pendulum.simulate_many([{}], threads=np.timedelta64(5)), "threads is timedelta64"),  # type: ignore[arg-type]
        (lambda: gudgeon.load("a\nb.yaml"), "cannot read a\\nb.yaml: No such file"),
        (lambda: Result.load("a\nb.nc"), "there is no file a\\nb.nc"),
        (lambda: Result.load(os.devnull), f"cannot read {os.devnull}: it is a device, not a file"),
        (lambda: Result.load("."), "cannot read .: it is a folder, not a file"),
        (lambda: gudgeon.register("a\nb.py"), "cannot read the law a\\nb.py: No such file"),
        (lambda: gudgeon.register(""), "the path of a law's file is empty"),
        (lambda: gudgeon.register("/dev/zero"), "cannot read the law /dev/zero: it is a device, not a file"),
        (lambda: pendulum.rhs(None, y), "t: 'None' is not one real number"),  # type: ignore[arg-type]
        (lambda: pendulum.rhs(10**400, y), "t: "),
        (lambda: pendulum.simulate(0.01, stop="no"), "stop is 'no': expected True or False"),  # type: ignore[arg-type]
        (lambda: pendulum.simulate(True), "t_end: 'True' is not one real number"),
        (lambda: pendulum.simulate(0.01, step=True), "step: 'True' is not one real number"),
        (lambda: pendulum.simulate(output=[0.0, True]), "output[1] is True: expected a time (s)"),
        (lambda: pendulum.simulate_many([{}, {}], [0.1, True]), "run 1: t_end: 'True' is not one real number"),
        (lambda: pendulum.simulate(0.01, parameters=np.zeros(0)), "parameters is a ndarray: expected a mapping"),  # type: ignore[arg-type]
        (lambda: pendulum.simulate(0.01, parameters={1: 2.0}), "parameters: its key 1 is not a text"),  # type: ignore[dict-item]
        (lambda: pendulum.simulate_many(None), "parameters: expected a mapping for every run"),  # type: ignore[arg-type]
        (lambda: pendulum.simulate_many({"g": [[1], [2, 3]]}), "parameters: g is list [[1], [2, 3]]: expected one"),
        (lambda: pendulum.simulate_many([{}], threads="two"), "threads is 'two': expected a number"),  # type: ignore[arg-type]
    ]
    for call, message in refused:
        with pytest.raises(InputError) as caught:
            call()
        assert message in str(caught.value)


def test_a_series_of_pandas_is_a_mapping(pendulum: Simulation) -> None:
    address = pendulum.source.parameters[0].address
    value = float(pendulum.p[0]) * 1.25
    series, plain = (
        pendulum.simulate(0.1, output=2, parameters=p) for p in (pandas.Series({address: value}), {address: value})
    )
    assert series.parameters[address] == value
    assert (series.q == plain.q).all()
    with pytest.raises(InputError, match="repeats a name"):
        pendulum.simulate(0.1, parameters=pandas.Series([1.0, 2.0], index=[address, address]))


@pytest.mark.parametrize(
    ("code", "rate", "message"),
    [
        (2, np.nan, r"start.memory\[0\] of joint \w+ is nan while start.state\[0\] is 2: expected the approach speed"),
        (1, np.nan, "is nan while"),
        (0, 1.0, r"is 1 m/s while start.state\[0\] is 0 \(free\)"),
        (2, np.inf, "is inf while"),
        (0, -np.inf, "is -inf m/s while"),
    ],
)
def test_a_state_that_contradicts_itself(code: int, rate: float, message: str) -> None:
    crank = gudgeon.load("slider_crank", "dry")
    final = crank.simulate(1e-3, output=1).final
    codes, memory = final.state.copy(), final.memory.copy()
    codes[0], memory[0] = code, rate
    with pytest.raises(InputError, match=message):
        crank.simulate(2e-3, output=1, start=replace(final, state=codes, memory=memory))
    codes[0], memory[0] = 0, np.nan
    crank.simulate(2e-3, output=1, start=replace(final, state=codes, memory=memory))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["map", "slider_crank", "--scene", "dry", "--axis", "c=1..2:0"], "a whole number of values after ':'"),
        (["map", "slider_crank", "--scene", "dry", "--axis", "c=1..2:"], "a whole number of values after ':'"),
        (["map", "slider_crank", "--scene", "dry", "--axis", "c=1,2:3"], "after a range low..high only"),
        (["bench", "pendulum", "--methods", ""], "--methods '': expected names of methods"),
        (["bench", "pendulum", "--methods", " , "], "expected names of methods"),
        *[
            ([command, "pendulum", "--out", ""], "'': expected a name")
            for command in ("run", "emit", "equations", "bench", "map")
        ],
        (["bench", "pendulum", "--csv", ""], "'': expected a name"),
    ],
)
def test_odd_options(arguments: list[str], message: str) -> None:
    shown = CliRunner().invoke(app, arguments)
    assert shown.exit_code == 2
    assert message in " ".join(shown.output.split())
    assert not list(Path().iterdir())


@pytest.mark.parametrize("number", [np.complex128(1 + 2j), np.complex64(1 + 2j), np.array(1 + 2j)])
def test_an_imaginary_part_is_not_dropped(pendulum: Simulation, number: Any) -> None:
    """NumPy's own complex numbers become real ones with a warning: a run to 1 s, or with g = 1, was made of them."""
    with pytest.raises(BadValueError, match="t_end"):
        pendulum.simulate(number)
    with pytest.raises(BadValueError, match="g"):
        pendulum.simulate(0.01, parameters={"g": number})
    with pytest.raises(BadValueError, match="g"):
        pendulum.simulate_many({"g": [number, 9.81]}, 0.01)
