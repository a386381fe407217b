"""`gudgeon draw`: what is written where, and what is told."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

pytest.importorskip("matplotlib")

from tests.pump import Gudgeon  # noqa: E402

OPEN = """format: gudgeon/1
name: open
bodies:
  crank: {length: 40 mm}
  bar: {length: 60 mm}
ground: {A: [0, 0], B: [180 mm, 0]}
joints:
  A: {revolute: [ground.A, crank.tail]}
  P: {revolute: [crank.head, bar.tail]}
  B: {revolute: [ground.B, bar.head]}
"""


def test_the_start_of_a_shipped_mechanism(call: Gudgeon, tmp_path: Path) -> None:
    """By default below out/, by its name and scene; the same bytes again; numbers may be set."""
    done = call("draw", "four_bar")
    assert done.exit_code == 0 and done.output == "wrote out/four_bar_ideal.svg\n"
    first = (tmp_path / "out/four_bar_ideal.svg").read_bytes()
    assert b'id="joint-B0"' in first and b"<dc:date>" not in first
    call("draw", "four_bar", "-o", "again.svg")
    assert (tmp_path / "again.svg").read_bytes() == first
    assert call("draw", "four_bar", "--set", "bodies.coupler.length=110mm", "-o", "other.svg").exit_code == 0
    assert (tmp_path / "other.svg").read_bytes() != first


@pytest.mark.parametrize(
    ("suffix", "magic"), [("png", b"\x89PNG"), pytest.param("pdf", b"%PDF", marks=pytest.mark.slow)]
)
def test_at_a_time_of_the_motion(suffix: str, magic: bytes, call: Gudgeon, tmp_path: Path) -> None:
    done = call("draw", "slider_crank", "--scene", "dry", "--at", "5ms", "-o", f"x.{suffix}")
    assert done.exit_code == 0, done.output
    assert (tmp_path / f"x.{suffix}").read_bytes().startswith(magic)


def test_at_its_first_time_it_is_the_start(call: Gudgeon, tmp_path: Path) -> None:
    """Suffixes in capitals are the same."""
    assert (
        call("draw", "four_bar", "-o", "x.svg").exit_code
        == call("draw", "four_bar", "--at", "0", "-o", "X.SVG").exit_code
    )
    assert (tmp_path / "X.SVG").read_bytes() == (tmp_path / "x.svg").read_bytes()


@pytest.mark.parametrize("address", ["pendulum --set joints.rod.length", "slider_crank --set bodies.rod.length"])
def test_lengths_that_cannot_be_drawn(address: str, call: Gudgeon) -> None:
    done = call("draw", *f"{address}=1e300m".split(), "-o", "x.svg")
    assert done.exit_code == 1 and "overflow" not in done.output and done.stderr.startswith("error: "), done.output


def test_branches_are_those_that_check_lists(call: Gudgeon, tmp_path: Path) -> None:
    assert call("draw", "four_bar", "--branches", "-o", "x.svg").exit_code == 0
    listed = re.findall(r"^  \d  (\{.*?\})", call("check", "four_bar", "--branches").stdout, re.M)
    svg = (tmp_path / "x.svg").read_text()
    assert len(listed) == 2 and len(re.findall(r'<g id="axes_', svg)) == 2
    assert all(guess in svg for guess in listed)  # text beside its glyphs, as a comment


def test_what_does_not_close_is_drawn_and_then_told(call: Gudgeon, tmp_path: Path) -> None:
    (tmp_path / "open.yaml").write_text(OPEN)
    drawn, checked = call("draw", "open.yaml", "-o", "x.svg"), call("check", "open.yaml")
    assert drawn.exit_code == checked.exit_code == 1 and drawn.stdout == "wrote x.svg\n"
    assert drawn.stderr == checked.stderr and "cannot be assembled" in drawn.stderr
    assert 'id="gap-P"' in (tmp_path / "x.svg").read_text()


def test_masses_are_not_asked_for(call: Gudgeon, tmp_path: Path) -> None:
    """Nothing is simulated at the start; what may move is shown."""
    (tmp_path / "x.yaml").write_text(OPEN.replace("  B: {revolute: [ground.B, bar.head]}\n", ""))
    assert call("draw", "x.yaml", "-o", "x.svg").exit_code == 0
    assert 'id="free-crank"' in (tmp_path / "x.svg").read_text()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("four_bar --scene worn", "no scene 'worn'"),
        ("four_bar --set bodies.crank.len=3mm", "nearest: bodies.crank.length"),
        ("four_bar --set bodies.crank.mass=-1kg", "a mass is positive"),
        ("four_bar --at 1kg", "expected a time"),
        ("four_bar --at=-1s", "--at is -1 s: expected 0 s or more"),
        ("four_bar --at 1e30s", "--at is 1e+30 s: expected 1e+18 s at most"),
        ("four_bar --at 1s --branches", "leave one of them out"),
        ("four_bar -o x.svg/", "this is a folder"),
        ("four_bar -o x.gif", ".svg, .png, .pdf or .dxf"),
        ("four_baar", "four_bar"),
    ],
)
def test_what_cannot_be_is_told(line: str, message: str, call: Gudgeon, tmp_path: Path) -> None:
    done = call("draw", *line.split())
    assert done.exit_code == 2 and message in done.stderr, done.output
    assert not list(tmp_path.rglob("*.svg"))
