"""Drawings for CAD, read back by ezdxf: places against the lengths of the file, names, units, the same bytes."""

from __future__ import annotations

import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")
ezdxf = pytest.importorskip("ezdxf")

from gudgeon.drawing.dxf import encode_dxf  # noqa: E402
from gudgeon.drawing.shapes import Disc, Label, Line, Sketch  # noqa: E402
from tests.pump import Gudgeon  # noqa: E402

LENGTHS = {"crank": 40.0, "coupler": 120.0, "rocker": 80.0}  # mm, of mechanisms/four_bar.yaml


def read(path: Path) -> Any:
    document = ezdxf.readfile(path)
    assert not document.audit().has_errors
    return document


def pins(document: Any) -> dict[str, np.ndarray]:
    """Of each joint where its circle is, mm."""
    found = [e for e in document.modelspace().query("CIRCLE") if e.dxf.layer.startswith("joint ")]
    return {e.dxf.layer.removeprefix("joint "): np.array(e.dxf.center)[:2] for e in found}


def test_pins_are_as_far_apart_as_the_bars_are_long(call: Gudgeon, tmp_path: Path) -> None:
    assert call("draw", "four_bar", "-o", "x.dxf").exit_code == 0
    document = read(tmp_path / "x.dxf")
    at = pins(document)
    apart = [np.hypot(*(at[b] - at[a])) for a, b in pairwise(("A0", "A", "B", "B0"))]
    np.testing.assert_allclose(apart, list(LENGTHS.values()), rtol=1e-12)
    np.testing.assert_allclose([at["A0"], at["B0"]], [(0.0, 0.0), (100.0, 0.0)], rtol=0, atol=1e-9)
    assert document.header["$INSUNITS"] == 4 and document.header["$MEASUREMENT"] == 1
    assert {f"body {name}" for name in LENGTHS} <= {layer.dxf.name for layer in document.layers}
    for name in LENGTHS:
        assert document.modelspace().query(f"LWPOLYLINE[layer=='body {name}']")


def test_the_same_drawing_gives_the_same_bytes(call: Gudgeon, tmp_path: Path) -> None:
    for name in ("x.dxf", "Y.DXF"):
        assert call("draw", "four_bar", "-o", name).exit_code == 0
    assert (tmp_path / "x.dxf").read_bytes() == (tmp_path / "Y.DXF").read_bytes()
    classes = re.findall(r"^CLASS\n +1\n(\w+)$", (tmp_path / "x.dxf").read_text(encoding="utf-8"), re.M)
    assert classes == sorted(classes) and len(classes) > 5, "in an order that hangs on the seed of hashes"


def test_assemblies_stand_side_by_side(call: Gudgeon, tmp_path: Path) -> None:
    """Two of them: each joint has two pins, those of the ground shifted to the right by the same."""
    assert call("draw", "four_bar", "--branches", "-o", "x.dxf").exit_code == 0
    space = read(tmp_path / "x.dxf").modelspace()
    shifts = []
    for joint in ("A0", "B0"):
        first, second = (np.array(e.dxf.center)[:2] for e in space.query(f"CIRCLE[layer=='joint {joint}']"))
        shifts.append(np.abs(second - first))
    np.testing.assert_allclose(shifts[0], shifts[1], rtol=0, atol=1e-9)
    assert shifts[0][0] > 0.0 and shifts[0][1] == 0.0
    assert len(space.query("TEXT[layer=='titles']")) == 2


def sketch(*parts: str, x: float = 0.25) -> Sketch:
    shapes = [Disc(part, "pin", np.array([x, 0.5]), 0.01) for part in parts]
    line = Line(parts[0], "body", np.array([[0.0, 0.0], [x, 0.0], [x, 0.5]]), closed=True)
    labels = (Label(parts[0], "joint", "naïve, ε", np.array([0.0, 0.0])),)
    return Sketch((*shapes, line), labels, np.zeros(2), np.ones(2), 0.01)


def test_names_that_no_layer_may_have(tmp_path: Path) -> None:
    """CAD takes names for the same that differ in capitals alone, and refuses some signs."""
    path = tmp_path / "x.dxf"
    path.write_bytes(encode_dxf([sketch("joint a", "joint A", "joint a/b", "joint a|b", "Gelenk ε")], [""]))
    circles = read(path).modelspace().query("CIRCLE")
    names = [e.dxf.layer for e in circles]
    assert names == ["joint a", "joint A 2", "joint a_b", "joint a_b 2", "Gelenk ε"]
    np.testing.assert_allclose([tuple(e.dxf.center)[:2] + (e.dxf.radius,) for e in circles], 5 * [(250.0, 500.0, 10.0)])
    (line,) = read(path).modelspace().query("LWPOLYLINE")
    assert line.closed and [point[:2] for point in line.get_points()] == [(0.0, 0.0), (250.0, 0.0), (250.0, 500.0)]
    (text,) = read(path).modelspace().query("TEXT")
    assert text.dxf.text == "naïve, ε"


@pytest.mark.parametrize("x", [np.nan, np.inf])
def test_no_file_with_a_number_that_is_none(x: float) -> None:
    with pytest.raises(ValueError, match="not finite"):
        encode_dxf([sketch("joint a", x=x)], [""])


def test_without_ezdxf_it_is_told_what_to_install(
    call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import gudgeon.drawing

    monkeypatch.setitem(sys.modules, "ezdxf", None)
    monkeypatch.delitem(sys.modules, "gudgeon.drawing.dxf")
    monkeypatch.delattr(gudgeon.drawing, "dxf")
    done = call("draw", "four_bar", "-o", "x.dxf")
    assert done.exit_code == 1 and "gudgeon[plot,dxf]" in done.stderr and not (tmp_path / "x.dxf").exists()
