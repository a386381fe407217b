"""The page of a study: all of its numbers, of failed runs, of one run, of what is hostile; and the command for it."""

from __future__ import annotations

import json
import os
import re
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pandas
import pytest
from typer.testing import CliRunner

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.cli import app  # noqa: E402
from gudgeon.errors import GudgeonError  # noqa: E402
from gudgeon.studies.ensemble.claim_tables import JudgedClaims  # noqa: E402
from gudgeon.studies.show import pictures  # noqa: E402
from gudgeon.studies.show.claims import build_claims_sections  # noqa: E402
from gudgeon.studies.show.pictures import PageFigures  # noqa: E402
from gudgeon.studies.show.study_data import StudyData
from gudgeon.studies.show.study_page import StudyReport  # noqa: E402
from tests.programs import needs_compiler  # noqa: E402
from tests.studies.test_study_plots import OSCILLATOR  # noqa: E402

pytestmark = needs_compiler
HOSTILE = "</title><script>alert(1)</script> $x$ &"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Runs of their own lengths, a third of them without a stiffness that the mass could have."""
    place = tmp_path_factory.mktemp("report")
    (place / "mass.yaml").write_text(OSCILLATOR, encoding="utf-8")
    gudgeon.study(
        {
            "title": HOSTILE,
            "mechanism": str(place / "mass.yaml"),
            "parameters": {"k": [100, 400], "bodies.load.mass": [1, 4, -1]},
            "starts": {"count": 5, "seed": 1, "relative": {"x0": 0.1}},
            "t_end": "0.1 m/x0*1 s",
            "output": 20,
            "measures": {"far": {"max": "load.x"}, "fast": {"peak": "load.vx"}},
            "keep": ["load.x"],
        },
        place / "mass.study",
    )
    return place / "mass.study"


@pytest.fixture(scope="module")
def page(folder: Path) -> str:
    return gudgeon.load_study(folder).report().to_html()


def check(page: str) -> list[ElementTree.Element]:
    """Nothing from elsewhere, nothing that runs, no name twice; its pictures."""
    assert not re.search(r"<script|<link|<img|@import|\ssrc=|url\((?!#)|\son\w+=", page)
    assert not re.search(r'href="(?!#|data:image/png;base64)', page)
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert len(ids) == len(set(ids)) and set(re.findall(r'href="#([^"]*)"|url\(#([^)]*)\)', page)) is not None
    for one, other in re.findall(r'href="#([^"]*)"|url\(#([^)]*)\)', page):
        assert (one or other) in ids
    return [ElementTree.fromstring(svg) for svg in re.findall(r"<svg.*?</svg>", page, re.DOTALL)]


def test_a_page_has_the_studys_numbers(folder: Path, page: str) -> None:
    study = gudgeon.load_study(folder)
    assert study.failed == 10 and "30 runs (k 2 × bodies.load.mass 3 × start 5), 10 failed" in page
    from matplotlib import pyplot

    kept = pyplot.get_fignums()
    assert page == gudgeon.load_study(folder).report().to_html()  # the same bytes, without a date
    assert pyplot.get_fignums() == kept  # a page's figures are shown nowhere else
    q1, middle, q3 = np.quantile(study.dataset["fast"].values[1, 0], (0.25, 0.5, 0.75))
    assert f"<td>{middle:.4g} ({q1:.4g} … {q3:.4g})</td>" in page
    assert "<td>10</td>" in page and "k = 100 kg/s²" in page  # of what, and the first of them
    assert f"gudgeon {gudgeon.__version__}" in page


def test_it_is_whole_by_itself_and_what_it_quotes_is_text(page: str) -> None:
    pictures = check(page)
    assert len(pictures) >= 4 and "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    for name in ("Varied quantities", "Failed runs", "Measures", "Figures", "Series"):
        assert f"<h2>{name}</h2>" in page
    assert "prefers-color-scheme: dark" in page and "@media print" in page and "width=device-width" in page


def test_one_run_and_one_that_failed_have_pages(tmp_path: Path) -> None:
    one = gudgeon.study({"mechanism": "pendulum", "t_end": 0.1, "output": 5, "measures": {"low": {"min": "bob.y"}}})
    page = one.report().to_html()
    check(page)
    assert "1 run, none failed" in page and f"<td>{1e3 * float(one.dataset['low']):.5g}</td>" in page
    (tmp_path / "mass.yaml").write_text(OSCILLATOR, encoding="utf-8")
    none = gudgeon.study(
        {
            "mechanism": str(tmp_path / "mass.yaml"),
            "parameters": {"bodies.load.mass": [-1, -2]},
            "measures": {"far": {"max": "load.x"}},
            "keep": ["load.x"],
        }
    )
    assert none.failed == 2
    page = none.report().to_html()
    check(page)
    assert "2 failed" in page and "<td>–</td>" in page


def test_claims_and_parts_are_shown_where_there_are_any(folder: Path) -> None:
    """Of an object that has them: tables of pandas, and studies by name."""
    study = gudgeon.load_study(folder)
    row = {
        "claim": "<i>peak</i>",
        "figure": "Fig 3",
        "says": "",
        "part": "one",
        "at": "c 0.3 mm",
        "measure": "peak",
        "unit": "m",
        "printed": 2.5e-3,
        "ensemble": "near",
        "n": 5,
        "q25": 1.9e-3,
        "median": 2e-3,
        "q75": 2.1e-3,
        "deviation": -20.0,
        "note": "a & b",
    }
    far = row | {"ensemble": "far", "median": 3e-3, "q25": 2e-3, "q75": 4e-3, "deviation": 20.0}
    lone = row | {"claim": "N2", "ensemble": "", "n": 1, "figure": "", "printed": np.nan, "deviation": 4.21}
    trend = {"claim": "T1", "figure": "", "says": "it grows", "note": ""}
    judged = [
        trend
        | {
            "ensemble": name,
            "verdict": "undecided",
            "alone": alone,
            "probability": odds,
            "low": odds,
            "high": high,
            "chance": 0.5,
            "agreed": False,
        }
        for name, alone, odds, high in (("near", "holds", 0.9, 0.9), ("far", "fails", 0.2, 0.3))
    ]
    tables = pandas.DataFrame([row, far, lone]), pandas.DataFrame(judged)
    claims = JudgedClaims(*tables, "a paper & more")
    whole: Any = SimpleNamespace(claims=claims, parts={"one": study, "two": study})
    parts = {name: StudyData(study) for name in whole.parts}
    (heading, inside), (trends, judgement), (ours, alone) = build_claims_sections(whole, parts, PageFigures())
    assert (heading, trends, ours) == ("Published numbers", "Published trends", "Computed only")
    assert "&lt;i&gt;peak" in inside
    cells = "2.5 mm", "2 mm (1.9 … 2.1)", "3 mm (2 … 4)", "−20.0 … +20.0 %"
    assert "".join(f"<td>{cell.replace(' mm', chr(160) + 'mm')}</td>" for cell in cells) in inside
    assert "<td>c 0.3 mm</td><td>one</td><td>2\u00a0mm, +4.2 %</td>" in alone  # in no ensemble, beside another
    assert inside.count("<figure>") == 1 and "Fig 3: peak" in inside and "not drawn" not in inside
    assert (
        "ensembles disagree: near holds, far fails" in judgement
        and "<td>0.9, 0.2 (0.2 … 0.3)</td><td>0.5</td>" in judgement
    )
    assert "a paper &amp; more" in inside and "a &amp; b" in inside
    page = StudyReport(whole).to_html()
    check(page)
    assert "<h2>Part two</h2>" in page and "<h2>two: Measures</h2>" in page and "Published numbers" in page

    class NoClaims:
        @property
        def claims(self) -> Any:
            raise GudgeonError("none")

    nothing: Any = NoClaims()
    assert (
        build_claims_sections(nothing, parts, PageFigures()) == [] == build_claims_sections(study, parts, PageFigures())
    )


def test_claims_stand_under_headings_and_where_the_source_has_them(folder: Path) -> None:
    """What is drawn without a number is in its place; a heading takes its own; nothing stands in an empty column."""
    study = gudgeon.load_study(folder)
    row = {
        "claim": "N1",
        "figure": "Fig 3",
        "says": "",
        "part": "",
        "at": "one place",
        "measure": "far",
        "unit": "rad",
        "printed": 0.5,
        "ensemble": "near",
        "n": 5,
        "q25": 0.1,
        "median": 0.2,
        "q75": 0.3,
        "deviation": -60.0,
        "note": "",
        "heading": "",
    }
    other = row | {"ensemble": "wide", "deviation": -60.04}
    drawn_only = row | {"claim": "D1", "printed": np.nan, "deviation": np.nan, "ensemble": "", "n": 1}
    ours = drawn_only | {"claim": "U1", "figure": "", "says": "not so", "note": "why", "heading": "Not <printed>"}
    trend = {
        "claim": "X1",
        "figure": "",
        "says": "it holds",
        "note": "",
        "heading": "Not <printed>",
        "ensemble": "",
        "verdict": "holds",
        "alone": "holds",
        "probability": 1.0,
        "low": 1.0,
        "high": 1.0,
        "chance": 1.0,
        "agreed": True,
    }
    claims = JudgedClaims(pandas.DataFrame([row, other, drawn_only, ours]), pandas.DataFrame([trend]), "")
    whole: Any = SimpleNamespace(claims=claims, parts={"": study})
    pictures = PageFigures()
    (heading, inside), (own, below) = build_claims_sections(whole, {"": StudyData(study)}, pictures)
    assert (heading, own) == ("Published numbers", "Not <printed>")
    assert inside.index("<td>N1</td>") < inside.index("<td>D1</td>") and "<td>28.65°</td>" in inside
    assert "<td>−60.0 %</td>" in inside and ">note</th>" not in inside  # both round to it
    assert "<td>not so</td>" in below and "<td>why</td>" in below and "<td>it holds</td>" in below
    ((_, draw),) = pictures.figures
    ax: Any = draw()
    assert [word.get_text() for word in ax.get_xticklabels()] == ["N1\none place", "D1\none place"]
    labels = [word.get_text() for word in ax.get_legend().get_texts()]
    assert sorted(labels) == ["computed, one run", "near", "printed", "wide"]


def test_processes_draw_what_this_one_would(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same bytes; and where a figure cannot be drawn, that is told in its place."""
    from gudgeon.results.figures.run_plots import create_axes

    def drawn(k: int) -> Any:
        if k == 5:
            raise GudgeonError("nothing to draw")
        ax = create_axes(3.0, 2.0)
        ax.plot([0.0, 1.0], [0.0, k])
        return ax

    shown = PageFigures()
    places = "".join(
        shown.add_placeholder(f"p-{k}", partial(drawn, k)) for k in range(pictures.MIN_FIGURES_FOR_PROCESSES)
    )
    monkeypatch.setattr(pictures, "count_available_threads", lambda: 1)
    here = shown.insert_figures(places)
    monkeypatch.setattr(pictures, "count_available_threads", lambda: 2)
    assert shown.insert_figures(places) == here
    monkeypatch.setattr(pictures, "_send_drawn_figures", lambda connection, figures: os._exit(1))  # a process that dies
    assert shown.insert_figures(places) == here
    assert here.count("<svg") == pictures.MIN_FIGURES_FOR_PROCESSES - 1 and "not drawn: nothing to draw" in here


def test_the_command_writes_a_page(folder: Path, page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    target = str(tmp_path / "page.html")
    message = CliRunner().invoke(app, ["study", "report", str(folder), "--out", target, "--json"])
    assert message.exit_code == 0 and json.loads(message.stdout)["files"]["report"] == target
    assert Path(target).read_text(encoding="utf-8") == page
    message = CliRunner().invoke(app, ["study", "report", str(folder)])
    assert message.exit_code == 0 and folder.with_suffix(".html").read_text(encoding="utf-8") == page
    for wrong, why in (
        (["report"], "the folder is missing"),
        (["report", "none.study"], "not a study folder"),
        (["mass.yaml", "x"], "expected one file"),
        (["mass.yaml", "--out", "x.html"], "expected a folder"),
        (["report", str(folder), "--out", "page.txt"], "ends in .html"),
    ):
        message = CliRunner().invoke(app, ["study", *wrong])
        assert message.exit_code == 2 and why in message.stderr, message.stderr
