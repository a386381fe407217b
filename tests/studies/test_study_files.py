"""Study files with mistakes: each is told at its place, with what was expected; several are told at once."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.errors import InputError, InputErrors, NotYamlError, UnknownNameError
from gudgeon.generator.study.read import read_study
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.pump import Gudgeon
from tests.scenes import patched

pytestmark = needs_compiler
GOOD = """\
format: gudgeon-study/1
mechanism: pendulum
parameters:
  g: [9.81, 20]
t_end: 1 s
windows:
  late: {from: t_end/2}
measures:
  y: {final: bob.y, window: late}
"""
OPTIONS = f"{{{', '.join(f'o{k}: {{bodies.bob.mass: {k + 1}}}' for k in range(9))}}}"
ROW = "{from: 1, to: 2, count: 100000}"
BAD = [  # in place of what, what; line:column and words of the message
    ("gudgeon-study/1", "gudgeon/1", "1:1", "a mechanism: run it with `gudgeon run FILE`"),
    ("mechanism:", "mechansim:", "2:1", "did you mean 'mechanism'"),
    ("pendulum", "pendlum", "2:12", "pendulum"),
    ("pendulum", "../pendulum.yaml", "2:12", "study's folder or below"),
    ("pendulum", "/etc/passwd.yaml", "2:12", "study's folder or below"),
    ("[9.81, 20]", "[]", "4:6", "an empty list"),
    ("[9.81, 20]", "[9.81, 9.81]", "4:13", "is repeated"),
    ("[9.81, 20]", "[9.81, 20 kg]", "4:13", "an acceleration"),
    ("[9.81, 20]", "[9.81, length]", "4:13", "the name 'length' in a value of a study"),
    ("[9.81, 20]", "[9.81, __import__('os')]", "4:13", "attributes of Python"),
    ("[9.81, 20]", "[9.81, 0/0]", "4:13", "finite"),
    ("[9.81, 20]", "{from: 1, to: 2}", "4:6", "has no count"),
    ("[9.81, 20]", "{from: 1, to: 2, count: 1}", "4:30", "a whole number from 2"),
    ("[9.81, 20]", "{from: 1, to: 2, count: 1e9}", "4:30", "a whole number from 2"),
    ("[9.81, 20]", "{from: -1e308, to: 1e308, count: 3}", "4:25", "exceed the largest floating-point number"),
    ("[9.81, 20]", f"{ROW}\n  length: {ROW}", "4:3", "10000000000 runs"),
    ("[9.81, 20]", "{from: -1, to: 2, count: 3, spacing: geometric}", "4:13", "both ends positive"),
    ("[9.81, 20]", "{from: 1, to: 2, count: 3, spacing: log}", "4:42", "linear, geometric"),
    ("  g:", "  G:", "4:3", "did you mean 'g'"),
    ("  g:", "  start:", "4:3", "write parameters.start"),
    ("1 s", "1 kg", "5:8", "a time"),
    ("1 s", "1 s / omega", "5:14", "unknown name (in scene ideal) 'omega'"),
    ("1 s", "2*pi*sqrt(length/", "5:25", "expected"),
    ("t_end/2", "t_end/length", "7:16", "a time"),
    ("late: {from: t_end/2}", "late: {}", "7:9", "expected from:, to:, or both"),
    ("late: {from", "1ate: {from", "7:3", "letters, digits"),
    ("final", "finale", "9:7", "did you mean 'final'"),
    ("bob.y,", "bob.z,", "9:14", "nearest: bob"),
    ("window: late", "window: lat", "9:29", "unknown window 'lat'"),
    ("final: bob.y, window: late", "max_of_steps: bob.y, window: late", "9:36", "and has no window"),
    ("final: bob.y, window: late", "impacts: rod", "9:16", "unknown joint with play"),
    ("final: bob.y, window: late", "crossings: top", "9:18", "unknown event"),
    ("y: {final", "run: {final", "9:3", "the name 'run' is already used, by the dataset itself"),
    ("y: {final", "g: {final", "9:3", "the name 'g' is already used, by a parameter of the runs"),
    ("  y: {final: bob.y, window: late}", "  {}", "1:1", "has neither measures nor keep"),
    ("t_end: 1 s", "scenes: [ideal, idael]", "5:17", "idael"),
    ("t_end: 1 s", "scenes: [ideal, ideal]", "5:17", "twice"),
    ("y: {final", "Null: {final", "9:3", "no value"),
    ("t_end: 1 s", "zip: {Null: {length: [1, 2], g: [1, 2]}}", "5:7", "such as Null1"),
    ("t_end: 1 s", "keep: [bob.q]", "5:8", "bob"),
    ("t_end: 1 s", "method: rk5", "5:9", "rk4"),
    ("t_end: 1 s", "rtol: 1e-8 m", "5:7", "a pure number"),
    ("t_end: 1 s", "stop: maybe", "5:7", "true, false"),
    ("t_end: 1 s", "zip: {speed: {length: [1, 2], g: [1]}}", "5:7", "length has 2, g has 1"),
    ("t_end: 1 s", "zip: {speed: {g: [1, 2]}}", "5:15", "is given twice"),
    ("t_end: 1 s", "draw: {count: 3, parameters: {length: {mean: 1 m}}}", "5:39", "has no std"),
    ("t_end: 1 s", "draw: {count: 3, parameters: {length: {mean: 1 m, std: -1 m}}}", "5:56", "positive"),
    ("t_end: 1 s", "draw: {count: 3, parameters: {length: {from: 2 m, to: 1 m}}}", "5:55", "from < to"),
    ("t_end: 1 s", "draw: {count: 3, parameters: {length: {mean: 1 m, to: 1 m}}}", "5:51", "mean and std"),
    ("t_end: 1 s", "draw: {count: 0, parameters: {length: {from: 1, to: 2}}}", "5:15", "a whole number from 1"),
    ("t_end: 1 s", "draw: {count: 3, method: lhs, parameters: {length: {from: 1, to: 2}}}", "5:26", "sobol"),
    ("t_end: 1 s", "draw: {count: 3, seed: 1.5, parameters: {length: {from: 1, to: 2}}}", "5:24", "a whole number"),
    ("t_end: 1 s", "starts: {count: 3}", "5:9", "starts has no deviations"),
    ("t_end: 1 s", "starts: {count: 3, relative: {g: 0}}", "5:34", "positive"),
    ("t_end: 1 s", "starts: {count: 3, relative: {q: 1}}", "5:31", "unknown parameter 'q'"),
    ("t_end: 1 s", "starts: {count: 3, absolute: {length: 1 kg}}", "5:39", "a length"),
    (
        "t_end: 1 s",
        "draw: {count: 3, parameters: {length: {from: -1e308, to: 1e308}}}",
        "5:58",
        "largest floating-point number",
    ),
    ("t_end: 1 s", f"choices: {{{', '.join(f'c{k}: {OPTIONS}' for k in range(5))}}}", "5:11", "59049 scenes"),
    ("t_end: 1 s", "choices: {g: [1, 2]}", "5:11", "choices: g varies a parameter that a number, at "),
    (
        "t_end: 1 s",
        "choices: {moon: {a: {parameters.g: 1.6}}}",
        "5:11",
        "choices: moon, by g, varies a parameter that a number,",
    ),
    ("t_end: 1 s", "choices: {bodies.bob.masss: [1 kg]}", "5:30", "masss"),
    ("t_end: 1 s", "choices: {heavy: {a: {bodies.bob.mass: -1 kg}}}", "5:40", "positive"),
    ("t_end: 1 s", f"title: {'x' * 201}", "5:8", "at most 200"),
    ("t_end: 1 s", 'title: "a\\0b"', "5:9", "visible characters"),
    ("t_end: 1 s", "output: 1 s", "5:9", "a pure number"),
    ("t_end: 1 s", "t_end: 0 s", "5:8", "t_end is 0\n  expected a positive time"),
    ("t_end: 1 s", "t_end: 1 s/0", "5:8", "a positive time"),
    ("t_end: 1 s", "output: 0.4", "5:9", "a number of intervals from 1"),
    ("t_end: 1 s", "output: 1e9", "5:9", "a number of intervals from 1"),
    ("t_end: 1 s", "step: -1 ms", "5:7", "a positive time"),
    ("from: t_end/2", "from: 2*t_end", "7:16", "is from 2 s to 1 s"),
    ("from: t_end/2", "to: -1 s", "7:14", "expected a part of the run"),
]


def test_what_a_choice_varies_is_not_set_for_all_runs(tmp_path: Path) -> None:
    """Else its options, each with a library of its own, would all be the same."""
    path = tmp_path / "s.yaml"
    path.write_text(GOOD.replace("t_end: 1 s", "t_end: 1 s\nchoices: {bodies.bob.mass: [1 kg, 2 kg]}"))
    words = (
        "s.yaml:6:11: choices: bodies.bob.mass varies a parameter that --set bodies.bob.mass sets for all runs\n"
        "  remove one of"
    )
    with pytest.raises(InputError, match=words):
        resolve_plans(path, {"bodies.bob.mass": "3 kg"})


@pytest.mark.parametrize(("old", "new", "place", "words"), BAD, ids=[f"{k}" for k in range(len(BAD))])
def test_a_mistake_is_told_at_its_place(old: str, new: str, place: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    path.write_text(patched(GOOD, (old, new)))
    with pytest.raises(InputError) as message:
        resolve_plans(path)
    assert str(message.value).startswith(f"{path}:{place}: "), str(message.value)
    assert words in str(message.value), str(message.value)
    assert message.value.hint or "expected" in str(message.value), str(message.value)


def test_all_mistakes_of_a_file_at_once(call: Gudgeon, tmp_path: Path) -> None:
    (tmp_path / "s.yaml").write_text(GOOD.replace("final", "finale").replace("[9.81, 20]", "{}").replace("1 s", "1 z"))
    with pytest.raises(InputErrors) as message:
        resolve_plans("s.yaml" if Path("s.yaml").exists() else tmp_path / "s.yaml")
    assert len(message.value.errors) >= 3 and re.findall(r"s.yaml:(\d+):", str(message.value)) == sorted(
        re.findall(r"s.yaml:(\d+):", str(message.value))
    )
    done = call("study", "s.yaml")
    assert done.exit_code == 2 and not (tmp_path / "s.study").exists()


def test_what_is_no_study(tmp_path: Path, call: Gudgeon) -> None:
    for text in ("", "- a", "a: [", "a: &x [*x]"):
        with pytest.raises(NotYamlError):
            read_study(text.encode(), "s.yaml")
    with pytest.raises(NotYamlError, match="begins with format: gudgeon-study/1"):
        read_study(b"- a", "s.yaml")
    for study in ({}, {"mechanism": 3}, {"mechanism": "pendulum", "keep": [object()]}, 3, None):
        with pytest.raises(InputError):
            gudgeon.study(study)  # type: ignore[arg-type]
    deep: dict[str, object] = {}
    deep["parameters"] = deep
    with pytest.raises(InputError, match="deep"):
        gudgeon.study(deep)
    assert call("study", "nothing.yaml").exit_code == 2
    assert call("study", "pendulum").exit_code == 2
    (tmp_path / "s.yaml").write_text(GOOD)
    for command in ("run", "check"):
        done = call(command, str(tmp_path / "s.yaml"))
        assert done.exit_code == 2 and "s.yaml:1:9: " in done.output and "`gudgeon study FILE`" in done.output


def test_a_mapping_is_told_by_its_addresses() -> None:
    with pytest.raises(InputError, match=r"value of parameters.g\[1\]:1:1: "):
        gudgeon.study({"mechanism": "pendulum", "parameters": {"g": [1, "2 kg"]}, "keep": ["bob.y"]})


def test_a_link_out_of_the_folder_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "p.yaml").write_text(Path(gudgeon.load("pendulum").file).read_text())
    study = tmp_path / "here" / "s.yaml"
    study.parent.mkdir()
    study.write_text(GOOD.replace("pendulum", "p.yaml"))
    (study.parent / "p.yaml").symlink_to(tmp_path / "there" / "p.yaml")
    with pytest.raises(InputError, match="s.yaml:2:12: .*link"):
        resolve_plans(study)
    (study.parent / "p.yaml").unlink()
    (study.parent / "p.yaml").write_bytes((tmp_path / "there" / "p.yaml").read_bytes())
    assert resolve_plans(study).runs == 2


@needs_compiler
def test_a_study_that_comes_with_gudgeon_is_found_by_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As mechanisms are; a file of that name in the folder counts before it."""
    monkeypatch.chdir(tmp_path)
    plans = resolve_plans("lubricated_10000")
    assert plans.by_part[""].runs == 10_000
    with pytest.raises(UnknownNameError, match="did you mean 'chen_2022'"):
        resolve_plans("chen_2023")
    with pytest.raises(UnknownNameError, match="no study 'jansen_leg_play'"):  # a mechanism that one brings along
        resolve_plans("jansen_leg_play")
    with pytest.raises(InputError, match="cannot read"):
        resolve_plans("chen_2022.yaml")
    Path("lubricated_10000").write_text("format: gudgeon-study/1\nmechanism: pendulum\nmeasures: {x: {final: bob.x}}\n")
    assert resolve_plans("lubricated_10000").by_part[""].runs == 1


@needs_compiler
def test_starts_may_be_more_or_others_than_the_file_says() -> None:
    """Deviations of the first ones are those of the file's seed; without any there is nothing to be said."""
    starts: dict[str, Any] = {"count": 3, "seed": 4, "relative": {"length": 0.1}}
    none = {"mechanism": "pendulum", "t_end": 1e-3, "output": 1, "measures": {"x": {"final": "bob.x"}}}
    study = none | {"starts": starts}
    own, more, other = (
        gudgeon.study(study, starts=count, seed=seed).dataset for count, seed in ((None, None), (5, None), (None, 5))
    )
    assert own.sizes["start"] == other.sizes["start"] == 3 and more.sizes["start"] == 5
    assert (more["x"][:3] == own["x"]).all() and (other["x"] != own["x"]).all()
    specified = gudgeon.study(none | {"starts": starts | {"seed": 5}}).dataset
    assert (specified["x"] == other["x"]).all()
    with pytest.raises(InputError, match="no run has perturbed starts, whose count is given"):
        gudgeon.study(none, starts=3)
    with pytest.raises(InputError, match="starts"):
        gudgeon.study(study, starts=0)


@needs_compiler
def test_what_is_set_goes_over_rows_zips_and_draws() -> None:
    """What goes together with it is as it was, drawn points too; titles of what is left out stay names."""
    study: dict[str, Any] = {
        "mechanism": "pendulum",
        "t_end": 1e-3,
        "output": 1,
        "measures": {"x": {"final": "bob.x"}},
        "parameters": {"g": {"from": 1, "to": 9, "count": 3}},
        "draw": {
            "count": 4,
            "seed": 3,
            "parameters": {"length": {"from": 1, "to": 2}, "bodies.bob.mass": {"from": "1 kg", "to": "2 kg"}},
        },
        "titles": {"g": "gravity"},
    }
    own, less = (
        resolve_plans(study).by_part[""],
        resolve_plans(study, {"parameters.g": "3 m/s^2", "length": "5 m"}).by_part[""],
    )
    assert own.dims == ("g", "draw") and less.dims == ("draw",) and less.fixed == {"parameters.g": 3.0, "length": 5.0}
    assert set(less.parameter_dimensions[0].columns) == {"bodies.bob.mass"}
    assert (
        less.parameter_dimensions[0].columns["bodies.bob.mass"]
        == own.parameter_dimensions[1].columns["bodies.bob.mass"]
    ).all()
    assert less.notes == (
        "g is set for all runs, in place of 3 values in the study file",
        "length is set for all runs, in place of 4 values in the study file",
    )
    assert resolve_plans(study, {"length": 5, "bodies.bob.mass": 3}).by_part[""].dims == ("g",)
    both = {key: value for key, value in study.items() if key not in ("parameters", "draw", "titles")}
    both["zip"] = {"pair": {"g": [1, 2], "length": [3, 4]}}
    assert resolve_plans(both, {"g": 3}).by_part[""].dims == ("pair",)
    assert resolve_plans(both, {"g": 3, "length": 1}).by_part[""].dims == ()
