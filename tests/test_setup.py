"""tools/setup: what is installed is known by its contents; an install on top of it is noticed. pip is a stand-in."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
pytestmark = pytest.mark.skipif(not shutil.which("sh") or not shutil.which("cksum"), reason="no shell")

# keeps a record; a strict editable install leaves links, any other one leaves something else in their place
PYTHON = """#!/bin/sh
echo "$@" >>log
site=.venv/lib/python3.11/site-packages
case "$*" in
*editable_mode=strict*)
    mkdir -p "$site" build/__editable__.gudgeon/gudgeon
    rm -f "$site"/__editable__*
    echo "$PWD/build/__editable__.gudgeon" >"$site/__editable__.gudgeon-0.pth" ;;
*--editable*)
    echo "import finder" >"$site/__editable__.gudgeon-0.pth" ;;
esac
"""


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    for name in ("tools/setup", "pyproject.toml", "constraints.txt", "runtime/__init__.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    for name in ("generator", "templates", "generated", "mechanisms"):
        (tmp_path / name).mkdir()
    python = tmp_path / ".venv/bin/python"
    python.parent.mkdir(parents=True)
    python.write_text(PYTHON)
    python.chmod(0o755)
    return tmp_path


def setup(clone: Path, extras: str = "all", **other: str) -> list[str]:
    """What python was asked to do this time."""
    (clone / "log").write_text("")
    environment = {**os.environ, "CC": "sh", "VENV": ".venv", **other}
    subprocess.run(["sh", "tools/setup", extras], cwd=clone, env=environment, check=True, capture_output=True)
    return (clone / "log").read_text().splitlines()


def links(lines: list[str]) -> list[str]:
    return [line for line in lines if "editable_mode=strict" in line]


def test_what_is_there_is_not_installed_again(clone: Path) -> None:
    assert len(links(setup(clone))) == 1
    assert setup(clone) == []
    (clone / "runtime/new.py").touch()
    assert len(links(setup(clone))) == 1
    assert setup(clone) == []


def test_tests_hold_what_a_run_needs(clone: Path) -> None:
    setup(clone, "all,test")
    assert setup(clone, "all") == setup(clone, "all,test") == []


def test_where_there_is_no_compiler_one_is_installed(clone: Path, tmp_path: Path) -> None:
    tools = tmp_path / "tools-alone"
    tools.mkdir()
    for name in ("sh", "dirname", "cat", "cksum", "tr", "find", "sort", "grep", "uname", "mkdir", "rm"):
        (tools / name).symlink_to(str(shutil.which(name)))
    asked = setup(clone, CC="", PATH=str(tools))
    assert [".[cc,all]" in line for line in links(asked)] == [True] and setup(clone, CC="", PATH=str(tools)) == []
    assert ".[all]" in "".join(links(setup(clone)))  # one has come


def test_another_install_on_top_is_noticed_and_mended(clone: Path) -> None:
    """`pip install -e '.[bench]'` makes links that know the modules and not the mechanisms."""
    setup(clone)
    subprocess.run([".venv/bin/python", "-m", "pip", "install", "--editable", ".[bench]"], cwd=clone, check=True)
    assert len(links(setup(clone))) == 1
    assert setup(clone) == []


def test_links_to_nowhere_are_noticed(clone: Path) -> None:
    setup(clone)
    shutil.rmtree(clone / "build")
    assert len(links(setup(clone))) == 1


def test_links_into_another_clone_are_noticed(clone: Path) -> None:
    setup(clone)
    (clone / ".venv/lib/python3.11/site-packages/__editable__.gudgeon-0.pth").write_text("/elsewhere/build/x\n")
    assert len(links(setup(clone))) == 1
