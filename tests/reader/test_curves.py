"""The section `curves:`: points, tables, what is refused and where it is told."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from gudgeon.errors import InputError
from gudgeon.generator.mechanism import Mechanism
from gudgeon.generator.reader.read import read_mechanism

TEXT = """format: gudgeon/1
name: n
curves: {{lift: {{{curve}}}}}
bodies: {{a: {{length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, a.tail]}}}}
drives: {{d: {{angle: a, value: "{value}"}}}}
"""
POINTS = "points: [[0, 0], [90, 1], [180, 0.5], [270, 0]]"
PAIRS = "points: [[0, 1], [1, 2]]"


def read(folder: Path, curve: str, value: str = "lift(t)", **overrides: str) -> Mechanism:
    file = folder / "n.yaml"
    given = {address.replace("__", "."): text for address, text in overrides.items()}
    return read_mechanism(TEXT.format(curve=curve, value=value).encode(), str(file), given)


def test_points_have_the_units_of_their_columns(tmp_path: Path) -> None:
    curve = read(tmp_path, f"{POINTS}, x: deg, y: deg", "lift(1 rad/s * t)").curves["lift"]
    np.testing.assert_allclose(curve.x, np.radians([0, 90, 180, 270]), rtol=1e-16)
    assert curve.evaluate(np.pi / 2) == np.radians(1.0)
    assert (curve.ends, curve.extrapolate, curve.unit) == ("natural", "none", "rad")


@pytest.mark.parametrize(
    "text",
    [
        "x,y\n0,0\n90,1\n180,0.5\n270,0\n",
        "0;0\n90;1\n180;.5\n270;0",
        "\ufeffangle\tlift\r\n# measured\r\n0\t0\r\n\r\n 90 \t 1e0\r\n180\t+0.5\r\n270\t0\r\n",
    ],
)
def test_a_table_is_as_good_as_points(tmp_path: Path, text: str) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "lift.csv").write_bytes(text.encode())
    table = read(tmp_path, "table: data/lift.csv, x: deg, y: deg", "lift(1 rad/s * t)").curves["lift"]
    written = read(tmp_path, f"{POINTS}, x: deg, y: deg", "lift(1 rad/s * t)").curves["lift"]
    assert (table.x, table.coefficients) == (written.x, written.coefficients)


REFUSED = [
    (PAIRS, "lift(t, t)", r"takes 1 argument, got 2"),
    (PAIRS, "lift", r"'lift' is a curve"),
    (PAIRS, "lift(2 s)", r"curve lift is called at 2, outside its range, from 0 to 1"),
    (f"{PAIRS}, x: mm", "lift(t)", r"curve lift is over a length \(m\), got"),
    (f"{PAIRS}, y: mm", "lift(t)", r"expected .*, got a length"),
    (f"{PAIRS}, x: parsec", "lift(t)", r"'parsec', which is not a unit"),
    (f"{PAIRS}, ends: smooth", "lift(t)", r"expected one of|natural"),
    (f"{PAIRS}, ends: not_a_knot", "lift(t)", r"has 2 points"),
    ("points: [[0, 1], [1, 2], [2, 3]], ends: periodic", "lift(t)", r"is periodic and ends at 3"),
    ("points: [[0, 1], [1, 2], [2, 1]], ends: periodic, extrapolate: hold", "lift(t)", r"remove the key extrapolate"),
    ("points: [[0, 1]]", "lift(t)", r"has 1 point"),
    ("points: []", "lift(t)", r"has 0 points"),
    ("points: [[0, 1], [0, 2]]", "lift(t)", r"x is 0 after 0"),
    ("points: [[1, 1], [0, 2]]", "lift(t)", r"x is 0 after 1"),
    ("points: [[0, 1], [1, r]]", "lift(t)", r"'r' is not a number"),
    ("points: [[0, 1], [1, 2 mm]]", "lift(t)", r"'2 mm' is not a number"),
    ("points: [[0, nan], [1, 2]]", "lift(t)", r"'nan' is not a number"),
    ("points: [[0, 1e200], [1, 2]]", "lift(t)", r"out of range"),
    ("points: [[0, 1, 2], [1, 2]]", "lift(t)", r"components"),
    ("points: 3", "lift(t)", r"a list of points"),
    (f"{PAIRS}, table: a.csv", "lift(t)", r"both points and a table"),
    ("x: mm", "lift(t)", r"neither points nor a table"),
]


@pytest.mark.parametrize(("curve", "value", "message"), REFUSED, ids=[message[:25] for _, _, message in REFUSED])
def test_what_is_refused(tmp_path: Path, curve: str, value: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(tmp_path, curve, value)


def test_a_curve_stands_where_numbers_vary_and_has_a_name_of_its_own(tmp_path: Path) -> None:
    text = TEXT.format(curve=PAIRS, value="lift(t)")
    for change, message in (
        (("length: 1 m", "length: lift(0)"), "a curve is allowed in drives"),
        (("name: n\n", "name: n\nparameters: {lift: 3}\n"), "names this curve and a parameter"),
        (("lift:", "sin:"), "it is a function"),
        (("lift(t)", "lfit(t)"), "did you mean 'lift'"),
    ):
        with pytest.raises(InputError, match=message):
            read_mechanism(text.replace(*change).encode(), str(tmp_path / "n.yaml"))


def test_points_cannot_be_overridden(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="a number of a curve"):
        read(tmp_path, PAIRS, curves__lift__points__x__y="3")
    assert read(tmp_path, PAIRS, curves__lift__ends="clamped").curves["lift"].ends == "clamped"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"0,1\n1,two\n", r"lift\.csv:2:3: 'two' is not a number"),
        (b"x,y\nx,y\n0,1\n", r"lift\.csv:2:1: 'x' is not a number"),
        (b"0,1\n 1 , 2,3\n", r"lift\.csv:2:1: 3 columns"),
        (b"0,1\n1\n", r"lift\.csv:2:1: 1 column in"),
        (b"0;1\n1;2,5\n", r"lift\.csv:2:3: '2,5' is not a number"),
        (b"0,1\n\xff,2\n", r"lift\.csv:2:1: byte 0xff"),
        (b"0,1\n2,1\n1,1\n", r"lift\.csv:3:1: .* x is 1 after 2"),
        (b"", r"has 0 points"),
        (b"\x00\x00", r"1 column in"),
        (b"0,1\n1," + b"9" * 5000 + b"\n", r"is not a number"),
        (b"0,1\n1,1e999\n", r"lift\.csv:2:3: .*out of range"),
        *(
            (first + b"\n90,1\n200,2\n", r"lift\.csv:1:\d: '.*' is not a number")
            for first in (
                b"nan,nan",
                b"inf,-inf",
                b"0 mm,0 mm",
                b"--1,.",
                "\u22121,\u22122".encode(),
                b"(1),(2)",
                b'"-1","-2"',
                "\u20131,\u20132".encode(),
                "\u0661,\u0662".encode(),
                "\u00bd,\u00be".encode(),
                b"$1,$2",
                b"(inf),-nan",
                "\u221e,\u2212\u221e".encode(),
                b"-,-",
                b",",
            )
        ),
        (b"0,=1+1\n", r"is not a number"),
    ],
)
def test_what_is_wrong_in_a_table_is_told_at_its_place(tmp_path: Path, data: bytes, message: str) -> None:
    (tmp_path / "lift.csv").write_bytes(data)
    with pytest.raises(InputError, match=message):
        read(tmp_path, "table: lift.csv")


def test_a_table_that_is_too_large_is_refused(tmp_path: Path) -> None:
    with (tmp_path / "lift.csv").open("wb") as file:
        file.truncate(68_000_000)
    with pytest.raises(InputError, match="a table of 68000000 bytes"):
        read(tmp_path, "table: lift.csv")


@pytest.mark.parametrize(("rows", "line"), [("5,1\n4,1\n", 2), ("5,one\n", 1)])
def test_what_is_wrong_in_a_long_table_is_told_at_its_place(tmp_path: Path, rows: str, line: int) -> None:
    """Tables of more than a megabyte are read at once; what is wrong in one is looked for row by row."""
    (tmp_path / "lift.csv").write_text("x,y\n" + "".join(f"{k - 130_000},0.25\n" for k in range(130_000)) + rows)
    with pytest.raises(InputError, match=rf"lift\.csv:{130_001 + line}:"):
        read(tmp_path, "table: lift.csv")


@pytest.mark.parametrize(
    "first",
    [
        '"angle","lift"',
        "x1,y2",
        ",lift",
        "\u03b8 [\u00b0],%",
        "influence,nanometre",
        "(angle),lift / 2",
        "\u89d2,\u5347\u7a0b",
    ],
)
def test_a_header_has_a_letter_before_digits(tmp_path: Path, first: str) -> None:
    (tmp_path / "lift.csv").write_text(f"{first}\n0,1\n1,2\n2,1\n", encoding="utf-8")
    assert read(tmp_path, "table: lift.csv").curves["lift"].x == (0.0, 1.0, 2.0)


@pytest.mark.parametrize("first", ["nan,nan", "\u0661,\u0662", "-,-"])
def test_a_long_table_has_the_same_headers_as_a_short_one(tmp_path: Path, first: str) -> None:
    """Whatever had no ASCII digit was left out as a header of a table of more than a megabyte."""
    rows = "".join(f"{k},{k % 3}.5\n" for k in range(140_000))
    (tmp_path / "lift.csv").write_text(f"{first}\n{rows}", encoding="utf-8")
    with pytest.raises(InputError, match=r"lift\.csv:1:1:"):
        read(tmp_path, "table: lift.csv")


@pytest.mark.parametrize(
    "name",
    [
        "../a.csv",
        "/etc/passwd",
        "x/../../a.csv",
        "./a.csv",
        "x//a.csv",
        "''",
        "a\\b.csv",
        "link.csv",
        "linked/a.csv",
        "pipe",
        "folder",
        "none.csv",
        "a.csv/b",
        "a" * 300,
    ],
)
def test_no_file_outside_the_folder_is_read(tmp_path: Path, name: str) -> None:
    home = tmp_path / "home"
    (home / "folder").mkdir(parents=True)
    for file in (tmp_path / "a.csv", home / "a.csv"):
        file.write_text("0,1\n1,2\n")
    (home / "link.csv").symlink_to(tmp_path / "a.csv")
    (home / "linked").symlink_to(tmp_path)
    os.mkfifo(home / "pipe")
    assert read(home, "table: a.csv").tables.keys() == {"a.csv"}
    with pytest.raises(InputError, match="not a path to a table|cannot read the table"):
        read(home, f"table: {name}")
