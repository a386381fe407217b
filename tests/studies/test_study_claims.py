"""Claims of a study: verdicts of pendulums whose answers are known, mistakes at their places."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
from ruamel.yaml import YAML

import gudgeon
from gudgeon.errors import GudgeonError, InputError, InputErrors
from gudgeon.generator.study.schema import make_study_schema
from gudgeon.studies.ensemble import claims
from gudgeon.studies.ensemble.claim_tables import JudgedClaims
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.pump import Gudgeon
from tests.scenes import patched

TEXT = """\
format: gudgeon-study/1
mechanism: pendulum
output: 10
measures:
  x: {final: bob.x}
  drop: {final: bob.y}
  a: {final: bob.ay}
parts:
  grid:
    t_end: 1 ms
    parameters: {length: [2 m, 1 m], g: [1.62, 9.81]}
  noisy:
    t_end: 1 ms
    parameters: {length: [1 m, 1.1 m, 1.2 m]}
    starts: {count: 16, seed: 5, ensembles: {near: {relative: {length: 1e-6}}, far: {absolute: {length: 0.5 m}}}}
claims:
  source: somebody, somewhere
  numbers:
    N1: {figure: Fig 1, part: grid, measure: x, at: {length: 100 cm, g: 9.81}, value: 2 m, note: twice ours}
    N2: {figure: Fig 1, part: noisy, measure: x, at: {length: 1.1 m}, value: 110 cm}
    N3: {part: grid, measure: a, at: {length: 1 m, g: 1.62}, says: ours alone, beside: N4}
    N4: {part: grid, measure: a, at: {length: 1 m, g: 9.81}}
  trends:
    T1: {says: "=x grows with length", part: grid, measure: x, grows_along: length}
    T2: {says: x grows with g, part: grid, measure: x, grows_along: g}
    T3: {says: x hardly depends on g, part: grid, measure: x, alike_along: g, within: 1e-3}
    T4: {part: grid, measure: x, larger: {length: 2 m}, than: {length: 1 m}, by: 1.5}
    T5: {part: noisy, measure: x, grows_along: length}
    T6: {part: grid, measure: x, exceeds: drop, at: {g: 9.81}}
    T7: {part: grid, measure: a, near: -9.81 m/s^2, within: 0.01, at: {g: 9.81}}
    T8: {part: grid, measure: a, below: -5 m/s^2}
    T9: {part: grid, counts: {bodies: 1, joints: 1, drives: 0, freedoms: 2, rows: 1, coordinates: 3, play: 0}}
    T10: {says: a photograph, not_computed: nobody measures a photograph}
    T11: {part: grid, measure: x, spreads_along: length, more_than: drop}
    T12: {part: grid, measure: a, most_lowered: x, from: {g: 9.81}, to: {g: 1.62}}
    T13: {part: grid, all: [{measure: x, grows_along: length}, {measure: x, larger: {part: noisy, length: 1.2 m},
          than: {g: 1.62, length: 1 m}}]}
    T14: {part: grid, measure: x, above: 1.5 m, at: {length: 1 m}, heading: ours}
"""


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> gudgeon.Study:
    path = tmp_path_factory.mktemp("claims") / "s.yaml"
    path.write_text(TEXT)
    return gudgeon.study(path, path.with_suffix(".study"))


@needs_compiler
def test_a_pendulum_that_is_let_go_level(found: gudgeon.Study) -> None:
    """After a millisecond x = l, y ≈ −g t²/2 and its acceleration −g; what follows is told of each ensemble."""
    trends = found.claims.trends.set_index("claim")
    verdicts = {name: tuple(dict.fromkeys(trends.loc[[name], "alone"])) for name in trends.index.unique()}
    holds, fails = ("holds",), ("fails",)
    assert verdicts == {
        "T1": holds,
        "T2": fails,
        "T3": holds,
        "T4": holds,
        "T5": ("holds", "undecided"),
        "T6": holds,
        "T7": holds,
        "T8": fails,
        "T9": holds,
        "T10": ("not computed",),
        "T11": holds,
        "T12": holds,
        "T13": ("holds", "undecided"),
        "T14": fails,
    }, verdicts
    assert trends.loc["T5", "ensemble"].tolist() == ["near", "far"] and not trends.loc["T5", "agreed"].any()
    assert set(trends.loc["T5", "verdict"]) == {"undecided"} and set(trends.loc["T1":"T4", "agreed"]) == {True}
    assert trends.loc["T1", "ensemble"] == "" and trends.loc["T10", "note"] == "nobody measures a photograph"
    x = found.parts["noisy"].dataset["x"].sel(ensemble="far").values
    pairs = [np.mean(x[k + 1][None, :] > x[k][:, None]) for k in range(2)]
    row = trends.loc["T5"].set_index("ensemble").loc["far"]
    assert row["probability"] == pytest.approx(min(pairs), rel=1e-15)
    chain = [a < b < c for a, b, c in itertools.product(*x)]
    assert row["chance"] == pytest.approx(np.mean(chain), rel=1e-15)


@needs_compiler
def test_numbers_beside_the_printed_ones(found: gudgeon.Study, tmp_path: Path) -> None:
    numbers = found.claims.numbers.set_index("claim")
    row = numbers.loc["N1"]
    assert row["median"] == pytest.approx(1.0, rel=1e-6) and row["deviation"] == pytest.approx(-50.0, abs=1e-3)
    assert (row["printed"], row["unit"], row["n"], row["note"]) == (2.0, "m", 1, "twice ours")
    far = numbers.loc["N2"].set_index("ensemble").loc["far"]
    x = found.parts["noisy"].dataset["x"].sel(ensemble="far")[1].values
    assert [far[name] for name in ("q25", "median", "q75")] == np.quantile(x, [0.25, 0.5, 0.75]).tolist()
    assert far["n"] == 16 and "length 1.1 m" in far["at"]
    assert math.isnan(numbers.loc["N3", "printed"]) and math.isnan(numbers.loc["N4", "deviation"])
    assert numbers.loc["N3", "deviation"] == pytest.approx(100 * (1.62 / 9.81 - 1), rel=1e-5)
    assert numbers["beside"].tolist() == ["", "", "", "N4", ""]
    off = sorted(abs(numbers.loc["N2", "deviation"]))  # of N2, with two ensembles, the median; N3 is beside another one
    message = f"2 printed numbers: half of the computed values deviate by {(50.0 + sum(off) / 2) / 2:.3g} % or less"
    assert found.claims.totals()[-1] == message
    assert found.claims.source == "somebody, somewhere"
    again = gudgeon.load_study(found.folder).claims
    assert again.trends.equals(found.claims.trends) and again.numbers.equals(found.claims.numbers)
    table = pandas.read_csv(found.folder / "claims_trends.csv")
    assert len(table) == len(again.trends)
    assert table["says"][0] == "'=x grows with length" and again.trends["says"][0] == "=x grows with length"


@pytest.mark.parametrize(
    ("medians", "off", "message"),
    [
        ([2.0, 3.0], [5.0, -7.0], "2 printed numbers: half of the computed values deviate by 6 % or less"),
        ([2.0, math.nan], [5.0, math.nan], "2 printed numbers, 1 of them computed: the computed value deviates by 5 %"),
        ([math.nan, math.nan], [math.nan, math.nan], "2 printed numbers: none could be computed"),
        ([math.nan], [math.nan], "1 printed number: none could be computed"),
        ([2.0], [math.nan], "1 printed number: a printed 0 has no relative deviation"),
    ],
)
def test_what_could_not_be_computed_is_off_by_nothing(medians: list[float], off: list[float], message: str) -> None:
    """NaN, of runs that failed, is in no median of deviations."""
    names = [f"N{k}" for k in range(len(off))]
    numbers = pandas.DataFrame({"claim": names, "printed": 1.0, "median": medians, "deviation": off})
    assert JudgedClaims(numbers, pandas.DataFrame(), "").totals() == [message]


@needs_compiler
def test_published_numbers_are_marks(found: gudgeon.Study) -> None:
    """N1 is 2 m at 1 m and 9.81 m/s²: on the line of that length, and nowhere where another one is picked."""
    pytest.importorskip("matplotlib")
    plot: Any = found.parts["grid"].plot
    ax = plot.measure("x", "g", "length", published=True)
    assert [line.get_xydata().tolist() for line in ax.lines if line.get_marker() == "*"] == [[[9.81, 2.0]]]
    mark = next(line for line in ax.lines if line.get_marker() == "*")
    assert mark.get_color() == ax.lines[1].get_color() != ax.lines[0].get_color()
    assert len(plot.measure("x", "g", at={"length": 2.0}, published=True).lines) == 1
    assert len(plot.measure("x", "g", at={"length": 1.0}, published=True).lines) == 2
    assert len(plot.measure("x", "g", published=True).lines) == 1  # a median of both lengths: N1 is about one
    assert found.parts["noisy"].claims.numbers["claim"].unique().tolist() == ["N2"]


@needs_compiler
def test_claims_decide_no_run(found: gudgeon.Study, tmp_path: Path, call: Gudgeon) -> None:
    """What is claimed may be edited: the runs that are there are judged again."""
    before = (found.folder / "grid" / "study.nc").stat().st_mtime_ns
    path = found.folder.with_suffix(".yaml")
    path.write_text(path.read_text().replace("above: 1.5 m", "above: 0.5 m"))
    again = gudgeon.study(path, found.folder)
    assert again.claims.trends.set_index("claim").loc["T14", "verdict"] == "holds"
    assert (found.folder / "grid" / "study.nc").stat().st_mtime_ns == before
    done = call("study", str(path), "--out", str(found.folder), "--json")
    assert len(json.loads(done.output)["claims"]["trends"]) == len(again.claims.trends)
    totals = ["13 trends: 8 hold, 2 fail, 2 undecided, 1 not computed", "1 trend of “ours”: 1 holds"]
    assert again.claims.totals()[:2] == totals
    assert "\n".join(again.claims.totals()) in call("study", str(path), "--out", str(found.folder)).output
    with pytest.raises(GudgeonError, match="has no claims"):
        _ = gudgeon.study({"mechanism": "pendulum", "t_end": 1e-3, "output": 1, "keep": ["bob.x"]}).claims


BAD = [  # in place of what, what; line and words of the message
    ("part: grid, measure: x, at: {length: 100", "measure: x, at: {length: 100", "19:5", "expected part: one of grid"),
    ("part: grid, measure: x, at: {length: 100", "part: grit, measure: x, at: {length: 100", "19:31", "unknown"),
    ("length: 100 cm", "length: 3 m", "19:62", "expected one of: 2, 1 (m)"),
    ("length: 100 cm", "lenght: 3 m", "19:54", "unknown coordinate"),
    ("length: 100 cm", "length: 1 kg", "19:62", "a length"),
    ("value: 2 m,", "value: 2 kg,", "19:87", "a length"),
    ("{length: 100 cm, g: 9.81}", "{length: 100 cm}", "19:5", "select one value in at: of g (2)"),
    ("measure: x, grows_along: g}", "measure: q, grows_along: g}", "25:53", "unknown measure 'q'"),
    ("grows_along: g}", "grows_along: mass}", "25:69", "unknown coordinate"),
    ("measure: x, grows_along: g}", "measure: x, grows_along: g, at: {g: 9.81}}", "25:69", "one value here"),
    ("grows_along: g}", "falls_along: g}", "25:56", "falls_along"),
    ("grows_along: g}", "grows_along: g, above: 3}", "25:9", "both grows_along and above"),
    ("alike_along: g, within: 1e-3", "alike_along: g", "26:9", "has no within"),
    ("than: {length: 1 m}, by", "than: {g: 9.81}, by", "27:34", "select different runs"),
    ("near: -9.81 m/s^2", "near: -9.81 m", "30:40", "an acceleration"),
    ("{bodies: 1,", "{bodeis: 1,", "32:31", "did you mean 'bodies'"),
    ("not_computed: nobody", "above: 3, not_computed: nobody", "33:31", "expected one of the two"),
    ("more_than: drop", "more_than: [drop, x]", "34:58", "expected as many"),
    ("from: {g: 9.81}, to", "to", "35:10", "has no from"),
    ("all: [{measure: x, grows", "all: [{measure: x, says: q, grows", "36:42", "says"),
    ("    T14:", "    T1:", "38:5", "given twice"),
    ("    T14:", "    N1:", "38:5", "is given twice"),
    ("    N3:", "    3N:", "21:5", "letters, digits"),
    ("source: somebody, somewhere", "source: []", "17:11", "a list"),
    ("says: ours alone, beside: N4", "beside: N9", "21:70", "unknown number 'N9'"),
    ("says: ours alone, beside: N4", "beside: N1", "21:70", "expected a number of the same measure"),
    ("says: ours alone, beside: N4", "value: 3, beside: N4", "21:72", "both value and beside"),
]


@needs_compiler
@pytest.mark.parametrize(("old", "new", "place", "words"), BAD, ids=[f"{k}" for k in range(len(BAD))])
def test_a_mistake_is_told_at_its_place(old: str, new: str, place: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    path.write_text(patched(TEXT, (old, new)))
    with pytest.raises(InputError) as message:
        resolve_plans(path)
    assert str(message.value).startswith(f"{path}:{place}") and words in str(message.value), str(message.value)


@needs_compiler
@pytest.mark.parametrize(
    ("some", "most"),
    [
        (50, 1000),
        pytest.param(500, claims.MAX_COMPARED, marks=pytest.mark.slow),
    ],
)
def test_a_claim_compares_no_more_than_can_be_judged(some: int, most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Any two of 50 values are 1225 pairs, of 500 124 750; the same values one by one are few, a million too many."""
    monkeypatch.setattr(claims, "MAX_COMPARED", most)
    study: dict[str, Any] = {"mechanism": "pendulum", "measures": {"x": {"final": "bob.x"}}}
    for count, kind, words in (
        (some, "alike_along", f"more than {most} pairs"),
        (some, "grows_along", ""),
        (10**6, "grows_along", "1000000 combinations"),
    ):
        trend = {"says": "?", "measure": "x", kind: "g"} | ({"within": 0.1} if kind == "alike_along" else {})
        row = {"from": 1, "to": 2, "count": count}
        given = study | {"parameters": {"g": row}, "claims": {"source": "s", "trends": {"T": trend}}}
        if not words:
            assert resolve_plans(given).runs == count
            continue
        with pytest.raises(InputError, match=words):
            resolve_plans(given)


@needs_compiler
def test_all_mistakes_of_claims_at_once(tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    path.write_text(
        TEXT.replace("value: 2 m", "value: 2 kg")
        .replace("grows_along: g", "grows_along: q")
        .replace("-9.81 m/s^2", "-9.81 m")
    )
    with pytest.raises(InputErrors) as message:
        resolve_plans(path)
    assert [str(error).split(":")[1] for error in message.value.errors] == ["19", "25", "30"], str(message.value)


def test_the_schema_takes_what_is_read() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    check = jsonschema.Draft202012Validator(make_study_schema())
    study = YAML(typ="safe").load(TEXT)
    assert not list(check.iter_errors(study))
    wrong: list[dict[str, Any]] = [
        {"grow_along": "c"},
        {"at": "c"},
        {"measure": []},
        {"counts": {"bodies": 1.5}},
        {"all": []},
    ]
    for trend in wrong:
        study["claims"]["trends"]["T1"] = trend
        assert list(check.iter_errors(study)), trend
