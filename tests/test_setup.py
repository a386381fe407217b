"""tools/setup: what is installed is known by its contents; an install on top of it is noticed. pip is a stand-in."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
pytestmark = pytest.mark.skipif(not shutil.which("sh") or not shutil.which("cksum"), reason="no shell")

# keeps a record; an editable install puts src/ on the path, any other one copies
PYTHON = """#!/bin/sh
echo "$@" >>log
site=.venv/lib/python3.11/site-packages
mkdir -p "$site"
case "$*" in
*--editable*) echo "$PWD/src" >"$site/__editable__.gudgeon-0.pth" ;;
*"install .") rm "$site/__editable__.gudgeon-0.pth" ;;
esac
"""


def links(clone: Path) -> list[Path]:
    return [path for path in sorted((clone / "runtime").iterdir()) if path.is_symlink()]


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """Folders with the links of the checkout, and hardly anything in them."""
    for name in ("src", "runtime"):
        shutil.copytree(ROOT / name, tmp_path / name, symlinks=True, ignore=no_folders)
    for link in links(tmp_path):
        link.resolve().mkdir()
        (link / "__init__.py").touch()
    for name in ("tools/setup", "pyproject.toml", "constraints.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    python = tmp_path / ".venv/bin/python"
    python.parent.mkdir(parents=True)
    python.write_text(PYTHON)
    python.chmod(0o755)
    return tmp_path


def no_folders(place: str, names: list[str]) -> list[str]:
    """Return what copytree leaves out: folders that are no links."""
    return [name for name in names if (path := Path(place, name)).is_dir() and not path.is_symlink()]


def setup(clone: Path, extras: str = "all", **other: str) -> list[str]:
    """Run tools/setup and return what python was asked to do."""
    (clone / "log").write_text("")
    environment = {**os.environ, "CC": "sh", "VENV": ".venv", **other}
    subprocess.run(["sh", "tools/setup", extras], cwd=clone, env=environment, check=True, capture_output=True)
    return (clone / "log").read_text().splitlines()


def installs(lines: list[str]) -> list[str]:
    return [line for line in lines if "--editable" in line]


def imported(clone: Path, names: list[str]) -> list[str]:
    """Import modules from the clone and return the names of those that are there."""
    code = """if True:
        import contextlib, sys
        for name in sys.argv[1:]:
            with contextlib.suppress(ModuleNotFoundError):
                print(__import__(name, fromlist=["it"]).__name__)
    """
    environment = {**os.environ, "PYTHONPATH": str(clone / "src"), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.check_output([sys.executable, "-c", code, *names], env=environment, text=True).split()


def test_a_new_file_is_imported_without_an_installation(clone: Path) -> None:
    setup(clone)
    files, names = list[Path](), list[str]()
    for folder, package in [("runtime", "")] + [(path.resolve().name, f".{path.name}") for path in links(clone)]:
        files += [clone / folder / "new.py", clone / folder / "new_folder" / "__init__.py"]
        names += [f"gudgeon{package}.new", f"gudgeon{package}.new_folder"]
    assert len(names) == 14 and imported(clone, names) == []
    for file in files:
        file.parent.mkdir(exist_ok=True)
        file.touch()
    assert imported(clone, names) == names and setup(clone) == []
    for file in files:
        file.unlink() if file.name == "new.py" else shutil.rmtree(file.parent)
    assert imported(clone, names) == []


def test_what_is_there_is_not_installed_again(clone: Path) -> None:
    assert len(installs(setup(clone))) == 1
    assert setup(clone) == []
    file = clone / "runtime/__init__.py"
    file.write_text(file.read_text().replace('__version__ = "', '__version__ = "9.'))
    assert len(installs(setup(clone))) == 1
    assert setup(clone) == []


def test_tests_hold_what_a_run_needs(clone: Path) -> None:
    setup(clone, "all,test")
    assert setup(clone, "all") == setup(clone, "all,test") == []


def test_where_there_is_no_compiler_one_is_installed(clone: Path, tmp_path: Path) -> None:
    tools = tmp_path / "tools-alone"
    tools.mkdir()
    for name in ("sh", "dirname", "cat", "cksum", "tr", "grep", "uname", "mkdir", "rm"):
        (tools / name).symlink_to(str(shutil.which(name)))
    requested = setup(clone, CC="", PATH=str(tools))
    assert [".[cc,all]" in line for line in installs(requested)] == [True] and setup(
        clone, CC="", PATH=str(tools)
    ) == []
    assert ".[all]" in "".join(installs(setup(clone)))  # one has come


def test_other_extras_on_top_change_nothing(clone: Path) -> None:
    setup(clone)
    subprocess.run([".venv/bin/python", "-m", "pip", "install", "--editable", ".[bench]"], cwd=clone, check=True)
    assert setup(clone) == []


def test_a_copy_that_is_installed_on_top_is_replaced(clone: Path) -> None:
    setup(clone)
    subprocess.run([".venv/bin/python", "-m", "pip", "install", "."], cwd=clone, check=True)
    assert len(installs(setup(clone))) == 1
    assert setup(clone) == []


def test_an_installation_of_another_clone_is_replaced(clone: Path) -> None:
    setup(clone)
    (clone / ".venv/lib/python3.11/site-packages/__editable__.gudgeon-0.pth").write_text("/elsewhere/src\n")
    assert len(installs(setup(clone))) == 1


def test_a_copy_without_links_is_refused(clone: Path) -> None:
    (clone / "src/gudgeon").unlink()
    (clone / "src/gudgeon").write_text("../runtime")
    refused = subprocess.run(["sh", "tools/setup", "all"], cwd=clone, capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "git checkout -- src runtime" in refused.stderr
