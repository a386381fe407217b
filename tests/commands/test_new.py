"""`gudgeon new`: what is written passes `check` and runs; nothing is written over."""

from __future__ import annotations

from pathlib import Path

import pytest

from gudgeon.generator.reader.read import read_mechanism
from gudgeon.loading.shipped import list_shipped_mechanisms
from tests.programs import needs_compiler
from tests.pump import Gudgeon, written


@needs_compiler
def test_the_template_is_valid_and_runs(call: Gudgeon, tmp_path: Path) -> None:
    done = call("new", "engine")
    assert done.exit_code == 0 and "wrote engine.yaml" in done.stdout
    checked = call("check", "engine.yaml")
    assert checked.stdout == (
        "valid: 3 bodies, 4 joints, 1 drive; scenes ideal, worn; degrees of freedom 0 (ideal), 2 (worn)\n"
    )
    assert call("run", "engine.yaml", "--scene", "worn", "--t-end", "0.01").exit_code == 0
    text = (tmp_path / "engine.yaml").read_text(encoding="utf-8")
    assert read_mechanism(text.encode(), "engine.yaml").name == "engine"
    assert text.count("#") > 15 and max(map(len, text.splitlines())) <= 120


@needs_compiler
def test_a_study_to_begin_with_runs(call: Gudgeon, tmp_path: Path) -> None:
    """Its trends are judged too; and it explains itself."""
    done = call("new", "play", "--study")
    assert done.exit_code == 0 and "wrote play.yaml" in done.stdout and "gudgeon study play.yaml" in done.stdout
    message = call("study", "play.yaml", "--starts", "2")
    assert (
        message.exit_code == 0
        and "18 runs (c 3 × omega 3 × start 2)" in message.stdout
        and "2 trends" in message.stdout
    )
    text = (tmp_path / "play.yaml").read_text(encoding="utf-8")
    assert text.count("#") > 12 and max(map(len, text.splitlines())) <= 120
    for line, why in (
        ("play --study", "already exists"),
        ("a --study --like four_bar", "--like needs a mechanism"),
        ("a-b --study", "a_b"),
    ):
        refused = call("new", *line.split())
        assert refused.exit_code == 2 and why in refused.stderr, refused.stderr
    assert {name.split("/")[0] for name in written(tmp_path)} == {"play.yaml", "play.study"}


def test_the_name_of_the_file_is_taken_as_that_of_the_mechanism(call: Gudgeon, tmp_path: Path) -> None:
    assert call("new", "mine.yaml").exit_code == 0 and written(tmp_path) == {"mine.yaml"}
    assert read_mechanism((tmp_path / "mine.yaml").read_bytes(), "mine.yaml").name == "mine"


@pytest.mark.parametrize("like", list_shipped_mechanisms())
def test_like_any_that_is_shipped(like: str, call: Gudgeon, tmp_path: Path) -> None:
    assert call("new", "mine", "--like", like).exit_code == 0
    assert read_mechanism((tmp_path / "mine.yaml").read_bytes(), "mine.yaml").name == "mine"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("my-engine", "my_engine"),
        ("engine.yml", "expected a name without suffix"),
        ("true", "YAML reads it"),
        ("../x", "not an identifier"),
        ("a__x", "reserved for emitted code"),
        ("crane --like double_rocke", "did you mean 'double_rocker'"),
        ("there", "already exists"),
        ("link", "already exists"),
    ],
)
def test_what_is_refused_leaves_all_as_it_was(line: str, message: str, call: Gudgeon, tmp_path: Path) -> None:
    (tmp_path / "there.yaml").write_text("mine")
    (tmp_path / "link.yaml").symlink_to("nowhere")
    done = call("new", *line.split())
    assert done.exit_code == 2 and message in done.stderr
    assert (tmp_path / "there.yaml").read_text() == "mine" and not (tmp_path / "nowhere").exists()
    assert written(tmp_path) == {"there.yaml"} or written(tmp_path) == {"there.yaml", "link.yaml"}
