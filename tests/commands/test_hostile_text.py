"""What a file calls itself is text: in tables, figures, terminals, pages and errors; and it loses no results."""

from __future__ import annotations

import io
import json
import sys
import unicodedata
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.language.text_output import escape_invisible, format_figure_title, format_one_line, make_plain_console
from gudgeon.results.reports import comparison
from gudgeon.results.reports.comparison import build_tables, compute_scene_report
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.pump import TEXT, Gudgeon, written
from tests.slow import slow_but

TITLES = (
    "[/]",
    "[bold]x[/foo]",
    "[link=https://x]y[/link]",
    "[[bold]",
    "a $^$ b",
    "$$",
    "$\\input{x}$",
    "\\$x$",
    ":bomb: [red]",
    "{0} %s",
    "</title><script>",
    "\u0639\u0631\u0628\u064a \u05d0",
    "x" * 5000,
    "a\u001b[31mb",
    "a\u202eb\u2066c",
    "a\nb\rc\x00",
)

SHOWN = [title for title in TITLES if title in ("a $^$ b", "$\\input{x}$", "a\nb\rc\x00") or len(title) > 999]
# all that the reader lets through, in one
NASTY = "[/] [bold]x[/foo] [link=https://x]y[/link] a $^$ b :bomb: </title><b> %s {0} it's"
TITLE = "A pump with a worn wrist pin"


def is_safe(text: str) -> bool:
    """Nothing that a terminal obeys, but for the ends of lines."""
    return all(c == "\n" or unicodedata.category(c) not in ("Cc", "Cf", "Zl", "Zp") for c in text)


@pytest.mark.parametrize("title", TITLES)
def test_a_title_is_text_in_tables(title: str, run: Result, ideal: Result) -> None:
    out = io.StringIO()
    console = make_plain_console(200, file=out, force_terminal=True, color_system="truecolor")
    for table in build_tables(title, [compute_scene_report(run, ideal, ["S9.y"])], 200):
        console.print(table)
    text = out.getvalue()
    assert "\x1b]8" not in text and "\u202e" not in text  # neither a link nor a turned line
    assert format_one_line(title)[:40] in text.replace("\n", "")


@pytest.mark.parametrize("title", slow_but(SHOWN, TITLES))
def test_a_title_is_text_in_figures(title: str, run: Result, ideal: Result) -> None:
    pytest.importorskip("matplotlib")
    from gudgeon.results.figures.plots import draw_run_figure

    picture: Any = draw_run_figure(
        {"dry": replace(run, source=replace(run.source, title=title), stored={})}, ideal, ["S9.y"]
    )
    shown, is_mathematics = picture._suptitle._preprocess_math(picture._suptitle.get_text())
    assert not is_mathematics
    assert shown.replace("\n", "").replace(" ", "") == format_one_line(title).replace(" ", "")
    picture.draw_without_rendering()


@pytest.mark.parametrize("title", TITLES)
def test_what_is_shown_can_be_shown(title: str) -> None:
    assert is_safe(escape_invisible(title)) and is_safe(format_one_line(title)) and is_safe(format_figure_title(title))
    assert "\n" not in format_one_line(title) and len(format_one_line(title)) <= 240
    assert len(format_figure_title(title, 60).splitlines()) <= 5


def test_text_that_only_looks_odd_stays_as_it_is() -> None:
    for text in ("10\u00a0N, δ̇⁻ → 3 µm", "नमस्ते", "می\u200cروم", "👩\u200d🔧", "[mm] $5"):
        assert escape_invisible(text) == format_one_line(text) == text


@needs_compiler
def test_commands_show_a_title_as_it_stands(call: Gudgeon, tmp_path: Path) -> None:
    (tmp_path / "nasty.yaml").write_text(TEXT.replace(TITLE, json.dumps(NASTY)))
    short = ("--scene", "worn", "--t-end", "1e-4")
    commands = {
        "check": ("nasty.yaml", "-v"),
        "run": ("nasty.yaml", *short),
        "map": ("nasty.yaml", *short, "--quick", "--axis", "rtol=1e-6"),
        "bench": ("nasty.yaml", *short, "--quick", "--methods", "dop853"),
    }
    for command, arguments in commands.items():
        done = call(command, *arguments)
        assert done.exit_code == 0, (command, done.output)
        assert is_safe(done.stdout) and "Traceback" not in done.stderr
        if command in ("check", "run"):
            words = done.stdout.replace("\n", " ").split()
            assert all(word in words for word in NASTY.split())
    assert {"out/pump_worn.nc", "out/pump.png", "out/pump_map.png", "out/pump_bench.png"} <= written(tmp_path)
    assert Result.load(tmp_path / "out/pump_worn.nc").source.title == NASTY


def test_equations_hold_a_title_as_text(call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A page that carries no simulator, whose compilation takes half a minute where it is the first."""
    pytest.importorskip("latex2mathml")
    monkeypatch.setitem(sys.modules, "ziglang", None)
    (tmp_path / "nasty.yaml").write_text(TEXT.replace(TITLE, json.dumps(NASTY)))
    for suffix in ("html", "tex", "txt"):
        assert call("equations", "nasty.yaml", "-o", f"x.{suffix}").exit_code == 0
    assert "&lt;/title&gt;&lt;b&gt;" in (tmp_path / "x.html").read_text()
    assert r"a \$\textasciicircum{}\$ b" in (tmp_path / "x.tex").read_text()
    assert (tmp_path / "x.txt").read_text().startswith(NASTY)


HOSTILE = "\u001b[31m[/]\u202e\u0007\u009b1m"
PLACES = (  # in the text, and what stands there
    (TITLE, "TEXT"),
    ("name: pump", "name: TEXT"),
    ("format: gudgeon/1", "format: TEXT"),
    ("crank: {", "TEXT: {"),
    ("20 rad/s", "TEXT"),
    ("20 rad/s", "20 TEXT"),
    ("mass: 0.2 kg", "TEXT: 0.2 kg"),
    ("[ground.O,", "[TEXT,"),
    ("revolute: [ground.O", "TEXT: [ground.O"),
    ("law: lankarani_nikravesh", "law: TEXT"),
    ("crank, v", "TEXT, v"),
    ("omega * t", "omega * TEXT"),
    ("scenes:", "TEXT:"),
    ("worn: {", "TEXT: {"),
    ("bearing: pin", "bearing: TEXT"),
    ("piston.x: 0.14", "TEXT: 0.14"),
    ("geometry: external", "geometry: TEXT"),
    ("1e-4 m/s, v1", "TEXT, v1"),
)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("quoted", [True, False])
def test_errors_quote_what_a_terminal_must_not_obey(
    place: tuple[str, str], quoted: bool, call: Gudgeon, tmp_path: Path
) -> None:
    """With the controls as YAML's own escapes, and as they are."""
    before, after = place
    assert before in TEXT
    for text in (HOSTILE, "[bold]x[/foo]"):
        message = json.dumps(text) if quoted else text
        (tmp_path / "hostile.yaml").write_text(TEXT.replace(before, after.replace("TEXT", message), 1))
        done = call("check", "hostile.yaml", "-v")
        assert done.exit_code in ((0, 2) if place[0] == TITLE else (2,)), done.output
        assert is_safe(done.stdout) and is_safe(done.stderr) and "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("check", "[/].yaml"),
        ("check", "a\x1b[31m.yaml"),
        ("run", "[/foo]"),
        ("run", "four_bar", "--output", "[/]"),
        ("run", "four_bar", "--set", "[/]=1"),
        ("run", "four_bar", "--scene", "[bold]\x1b[31m"),
        ("[/]",),
    ],
)
def test_arguments_are_told_as_they_are(arguments: tuple[str, ...], call: Gudgeon) -> None:
    done = call(*arguments)
    assert done.exit_code == 2 and is_safe(done.stderr) and "Traceback" not in done.stderr


@needs_compiler
@pytest.mark.parametrize("fails", ["build_tables", "compute_scene_report", "figure"])
def test_what_cannot_be_shown_is_saved(
    fails: str, call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RuntimeError("a mistake of ours")

    if fails == "figure":
        pytest.importorskip("matplotlib")
        monkeypatch.setattr("gudgeon.results.figures.plots.draw_run_figure", fail)
    else:
        monkeypatch.setattr(comparison, fails, fail)
    done = call("run", pump, "--t-end", "0.001")
    assert isinstance(done.exception, RuntimeError)
    assert {"out/pump_ideal.nc", "out/pump_worn.nc"} <= written(tmp_path)
    assert ("Peak error against ideal" in done.stdout) == (fails == "figure")


@needs_compiler
@pytest.mark.parametrize("full", [0, 1])
def test_ctrl_c_while_results_are_saved_ends_with_130_and_says_what_is_missing(
    full: int, call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save: Callable[..., None] = gudgeon.Result.save
    saved = 0

    def interrupted(self: Result, path: Path, attributes: object) -> None:
        nonlocal saved
        if saved == full:
            raise KeyboardInterrupt
        saved += 1
        save(self, path)

    monkeypatch.setattr(gudgeon.Result, "save", interrupted)
    done = call("run", pump, "--t-end", "0.001")
    assert done.exit_code == 130, done.output
    assert ("not saved: worn" in done.stderr) == (full == 1)
    assert "neither shown nor saved" in done.stderr
    assert written(tmp_path) == ({"out/pump_ideal.nc"} if full else set())
