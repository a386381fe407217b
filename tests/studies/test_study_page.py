"""Run the study and the Python of docs/studies.md, read its fragments and those of claims.md, check their tables."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ruamel.yaml import YAML

import gudgeon
from gudgeon.errors import InputError
from gudgeon.generator.study.read import KEYS, read_studies, read_study
from gudgeon.generator.study.schema import make_study_schema
from gudgeon.generator.study.spec import COUNTED_PARTS, KINDS, SAMPLING_METHODS, STATISTICS
from gudgeon.studies.ensemble.names import collect_display_names, typeset_quantity
from gudgeon.studies.ensemble.resolve import MAX_BLOCK_RUNS
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.test_tutorials import missing

jsonschema = pytest.importorskip("jsonschema")
DOCS = Path(__file__).parents[2] / "docs"
PAGE = "".join((DOCS / name).read_text(encoding="utf-8") for name in ("studies.md", "claims.md"))


def blocks(language: str) -> list[str]:
    """Return all fenced blocks of the page in that language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def block(language: str) -> str:
    """Return the page's example in that language: the first block."""
    return blocks(language)[0]


@needs_compiler
def test_its_file_and_its_python(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wristpin.yaml").write_text(block("yaml"), encoding="utf-8")
    names: dict[str, object] = {}
    exec(block("python"), names)
    assert missing(block("text"), capsys.readouterr().out) == []
    found = names["study"].dataset  # type: ignore[attr-defined]
    assert dict(found["peak_ax"].sizes) == {"scene": 2, "c": 3, "omega": 3, "start": 4}
    assert names["study"].failed == 0 and Path("wristpin.nc").exists()  # type: ignore[attr-defined]
    np.testing.assert_allclose(found["t_last"].sel(scene="ideal")[0, :, 0], 4 * np.pi / found["omega"], rtol=1e-5)


def test_every_key_statistic_and_method_is_on_the_page() -> None:
    words = set(re.findall(r"[A-Za-z_]\w*", PAGE))
    assert {*KEYS, *STATISTICS, *SAMPLING_METHODS, *KINDS, *COUNTED_PARTS} <= words
    assert f"{MAX_BLOCK_RUNS} at most" in PAGE


def test_the_schema_takes_its_file_and_refuses_others() -> None:
    """All keys of the reader, its words, and nothing beside them."""
    whole = make_study_schema()
    jsonschema.Draft202012Validator.check_schema(whole)
    assert set(whole["properties"]) == set(KEYS)
    study = YAML(typ="safe").load(block("yaml"))
    check = jsonschema.Draft202012Validator(whole)
    assert not list(check.iter_errors(study))
    wrong: list[dict[str, Any]] = [
        {"mechansim": "a"},
        {"starts": {"count": 0}},
        {"measures": {"a": {"finale": "b"}}},
        {"windows": {"1": {}}},
        {"measures": {"a": {"max_of_steps": "b", "window": "c"}}},
        {"draw": {"count": 2}},
        {"method": "rk5"},
    ]
    for own in wrong:
        assert list(check.iter_errors(study | own)), own
    quoted = {
        "draw": {"count": 3, "method": "sobol", "parameters": {"c": {"mean": 1, "std": "1 mm"}}},
        "zip": {"run": {"c": [1, 2]}},
        "choices": {"a.b": ["x"], "law": {"one": {"a.b": 1}}},
    }
    assert not list(check.iter_errors(study | quoted))


def test_its_fragments_are_read() -> None:
    """Parts and claims, each with the rest of a file."""
    parts, claims = blocks("yaml")[1:]
    head = "format: gudgeon-study/1\nmechanism: slider_crank\nscenes: [ideal, dry]\n"
    assert set(read_studies(f"{head}{parts}".encode(), "parts.yaml").parts) == {"clearance", "speed"}
    measures = "measures: {peak_ax: {peak_of_steps: slider.ax}}\n"
    found = read_studies(f"{head}{measures}{claims}".encode(), "claims.yaml").claims
    assert [len(found.numbers), len(found.trends)] == [1, 4] and found.source
    assert len(blocks("python")) == 2


@needs_compiler
def test_the_claims_print_what_is_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The claims of claims.md belong to the study of studies.md."""
    monkeypatch.chdir(tmp_path)
    study, *_, claims = blocks("yaml")
    Path("wristpin.yaml").write_text(study + claims, encoding="utf-8")
    exec(blocks("python")[1], {})
    assert missing(blocks("text")[-1], capsys.readouterr().out) == []


def test_what_it_quotes_is_read() -> None:
    quoted = [text for text in re.findall(r"`((?:zip|draw|choices): \{[^`]*\})`", PAGE) if "…" not in text]
    quoted.append("starts: {count: 2, " + re.findall(r"`(ensembles: \{[^`]*\})`", PAGE)[0] + "}")
    assert len(quoted) == 6
    for text in quoted:
        read_study(f"format: gudgeon-study/1\nmechanism: pendulum\nkeep: [bob.x]\n{text}\n".encode(), "quoted.yaml")


@needs_compiler
def test_people_read_titles_and_numbers_as_they_are_written(tmp_path: Path) -> None:
    """On the page, in a figure; a title of what the file has not is told at its place."""
    own = {
        "mechanism": "pendulum",
        "parameters": {"length": ["10 cm", "2e-1 m"], "g": [1.62, 9.81]},
        "t_end": "1 ms",
        "output": 4,
        "measures": {"low": {"min": "bob.y"}},
        "titles": {"low": "lowest <place>", "length": "ℓ"},
        "about": ["a pendulum & more", "in two\nparagraphs"],
        "claims": {"numbers": {"N1": {"measure": "low", "at": {"length": "0.1 m", "g": 9.81}, "value": "1 mm"}}},
    }
    study = gudgeon.study(own, tmp_path / "s")
    page = re.sub(r"<[^>]*>", " ", re.sub(r"<svg.*?</svg>", "", study.report().to_html(), flags=re.DOTALL))
    assert "lowest &lt;place&gt;, ℓ = 10 cm, g = 9.81" in page and "10 cm, 2·10⁻¹ m" in page
    assert page.index("In short") < page.index("a pendulum &amp; more") < page.index("1 printed number:")
    names = gudgeon.load_study(tmp_path / "s").names
    assert names.titles["length"] == "ℓ" and names.about == ("a pendulum & more", "in two paragraphs")
    plot: Any = study.plot
    ax = plot.measure("low", "length", "g")
    assert [tick.get_text() for tick in ax.get_xticklabels()] == ["10 cm", "2·10⁻¹ m"]
    assert plot.measure("low", "g", at={"length": 0.19}).get_title().endswith(": ℓ = 2·10⁻¹ m")
    assert study.claims.numbers["at"].tolist() == ["length 0.1 m, g 9.81 m/s²"]  # as the claim writes it
    assert ax.get_xlabel() == "ℓ" and ax.get_ylabel().startswith("lowest <place> [")
    with pytest.raises(InputError, match=r"titles.lwo(.|\n)*did you mean 'low'"):
        gudgeon.study(own | {"titles": {"lwo": "x"}})
    for about, message in (([], "a list"), ({}, "a mapping"), ("x" * 1001, "1001 characters")):
        with pytest.raises(InputError, match=f"about (is|has) {message}"):
            gudgeon.study(own | {"about": about})


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("3*pi rad/s", "3π rad/s"),
        ("0.6 mm", "0.6 mm"),
        ("1e-4 m/s", "10⁻⁴ m/s"),
        ("-9.81 m/s^2", "−9.81 m/s²"),
        ("pi rad/s", "π rad/s"),
        ("-pi rad/s", "−π rad/s"),
        ("pi", ""),
        ("pin rad/s", ""),
        ("5 um", "5 µm"),
        ("9.81", ""),
        ("2*c", ""),
        ("aluminium", ""),
    ],
)
def test_a_number_as_people_write_it(text: str, shown: str) -> None:
    assert typeset_quantity(text) == shown


@pytest.mark.parametrize(
    ("row", "shown"),
    [
        ({"from": "60 rpm", "to": "2.4e2 rpm", "count": 3}, ("60 rpm", "150 rpm", "2.4·10² rpm")),
        (
            {"from": "pi rad/s", "to": "8*pi rad/s", "count": 4, "spacing": "geometric"},
            ("π rad/s", "2π rad/s", "4π rad/s", "8π rad/s"),
        ),
        ({"from": "60 rpm", "to": "8*pi rad/s", "count": 3}, ()),
        ({"from": 1, "to": "60 rpm", "count": 3}, ()),
    ],
)
@needs_compiler
def test_a_row_is_shown_in_the_unit_of_its_ends(row: dict[str, Any], shown: tuple[str, ...]) -> None:
    """What is between is that of the runs; without a unit that both have in SI."""
    study = {"mechanism": "slider_crank", "parameters": {"omega": row}, "measures": {"x": {"max": "slider.x"}}}
    plans = resolve_plans(study)
    assert collect_display_names(plans).values[""].get("omega", ()) == shown
    for text, omega in zip(shown, plans.by_part[""].parameter_dimensions[0].columns["omega"], strict=False):
        message = text.replace("2.4·10²", "240").replace("π", "*pi")
        number, _, unit = message.partition(" ")
        value = float(number.removesuffix("*pi") or 1) * (math.pi if "pi" in message else 1.0)
        assert value * {"rpm": math.pi / 30, "rad/s": 1.0}[unit] == pytest.approx(omega, rel=1e-6)
