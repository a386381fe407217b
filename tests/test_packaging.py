"""What is installed is what is here: packages, data, pins."""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
import tomllib
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest
from ruamel.yaml import YAML

import gudgeon
from gudgeon.cli import app, get_command_name
from tests.minimum import CALLS
from tests.packages import PYTHONS, copy_sources

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def pins() -> dict[str, str]:
    lines = [line for line in (ROOT / "constraints.txt").read_text().splitlines() if not line.startswith("#")]
    return {normal(name): pin for name, pin in (line.split("==") for line in lines)}


def test_every_folder_with_python_is_a_package() -> None:
    """Without an __init__.py it would be missing from the wheel."""
    python = {
        place: {name for name in names if name.endswith(".py")}
        for place, _, names in os.walk(ROOT / "src", followlinks=True)
    }
    assert len(python) > 40
    assert [place for place, names in python.items() if names and "__init__.py" not in names] == []


def test_everything_asked_for_is_pinned() -> None:
    requested = [*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]]
    for extra in PROJECT["project"]["optional-dependencies"].values():
        requested += extra
    names = {normal(re.match(r"[\w.-]+", line)[0]) for line in requested} - {"gudgeon"}  # type: ignore[index]
    assert names - set(pins()) == set()


def test_pins_are_names_and_versions_alone() -> None:
    text = (ROOT / "constraints.txt").read_text()
    assert "//" not in text and "@" not in text
    assert all(re.fullmatch(r"[0-9][0-9a-z.]*", pin) for pin in pins().values())


def test_the_pinned_versions_are_those_in_use() -> None:
    """Under other versions the byte-for-byte tests would speak of something else."""
    wrong = {name: (version(name), pin) for name in ("sympy", "jinja2") if version(name) != (pin := pins()[name])}
    assert wrong == {}


# Extras that are asked for by name alone: not on every platform, large, or for few.
BY_NAME = {"cover", "bench", "web", "cc", "dask", "site"}


def test_all_holds_every_extra_of_a_user() -> None:
    extras = PROJECT["project"]["optional-dependencies"]
    held = set(re.findall(r"[\w-]+", extras["all"][0].partition("[")[2]))
    assert held == set(extras) - {"all", "test", *BY_NAME}


def test_the_wheel_holds_templates_mechanisms_and_generated(tmp_path: Path) -> None:
    if int(version("setuptools").split(".")[0]) < 77:
        pytest.skip("needs the pinned setuptools (make test)")
    copy = copy_sources(tmp_path / "house")
    code = f"import setuptools.build_meta as b; b.build_wheel({str(tmp_path)!r})"
    subprocess.run([sys.executable, "-c", code], cwd=copy, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    held = set(zipfile.ZipFile(wheel).namelist())
    kinds = (".py", ".typed", ".js", ".css", ".html", ".jinja", ".yaml", ".c", ".h", ".xz", ".md")
    source = copy / "src"
    expected = {path.relative_to(source).as_posix() for path in (source / "gudgeon").rglob("*") if path.suffix in kinds}
    assert expected - held == set()
    stray = {name for name in held - expected if ".dist-info/" not in name}
    assert stray == set()


def imported(folder: str) -> set[str]:
    """The packages that files in a folder import, inside functions too."""
    found: set[str] = set()
    for file in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module:
                found.add(node.module.partition(".")[0])
    return found - sys.stdlib_module_names - {"gudgeon"}


def requested(lines: list[str]) -> set[str]:
    return {re.match(r"[\w.-]+", line)[0].lower() for line in lines}  # type: ignore[index]


PACKAGES = {"ruamel": "ruamel.yaml", "sksundae": "scikit-sundae"}  # where the package has another name
BESIDE = {"h5netcdf"}  # with it xarray opens our files


def test_what_is_asked_for_is_what_is_imported() -> None:
    """A dependency that does nothing goes; what is imported is a dependency, or an extra of its own."""
    project = PROJECT["project"]
    used = {PACKAGES.get(name, name) for name in imported("runtime") | imported("generator")}
    extras = project["optional-dependencies"]
    optional = set().union(
        *(requested(extras[name]) for name in set(extras) - {"all", "test", "bench", "site", "cover"})
    )
    assert requested(project["dependencies"]) - used == set()
    assert optional - used == BESIDE
    assert used - requested(project["dependencies"]) - optional == {
        "scikit-sundae",
        "_cffi_backend",
    }  # a peer; cffi's own


def test_the_pythons_that_are_told_are_those_that_are_tried() -> None:
    """By `make packages`, from the oldest that is asked for."""
    message = re.findall(r"Python :: (3\.\d+)", "\n".join(PROJECT["project"]["classifiers"]))
    assert [f"python{one}" for one in message] == list(PYTHONS)[: len(message)]
    assert PROJECT["project"]["requires-python"] == f">={message[0]}"


def test_who_cites_is_told_the_version_and_the_licence_that_there_are() -> None:
    """CITATION.cff, codemeta.json and the newest heading of CHANGELOG.md say what the package says."""
    project = PROJECT["project"]
    cited = YAML(typ="safe").load(ROOT / "CITATION.cff")
    meta = json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))
    assert cited["version"] == meta["version"] == gudgeon.__version__
    assert cited["title"] == meta["name"] == project["name"] and meta["description"] == project["description"]
    assert cited["license"] == project["license"] and meta["license"].endswith("/" + project["license"])
    assert [one["name"] for one in cited["authors"]] == [one["name"] for one in meta["author"]]
    assert [one["name"] for one in project["authors"]] == [one["name"] for one in cited["authors"]]
    assert cited["keywords"] == meta["keywords"] == project["keywords"]
    newest = re.search(r"^## (\S+?),? ", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    assert newest and newest[1] == gudgeon.__version__


def test_every_dependency_has_a_lowest_version_that_is_tried() -> None:
    """`make packages` installs it (tests/minimum.py) and calls each command that there is."""
    lines = [sys.executable, str(ROOT / "tools/minimums.py"), *PROJECT["project"]["optional-dependencies"]]
    lowest = dict(line.split("==") for line in subprocess.check_output(lines, text=True).splitlines())
    pinned = pins()
    for name, minimum in lowest.items():
        numbers = [[int(part) for part in text.split(".")] for text in (minimum, pinned[normal(name)])]
        assert numbers[0] <= numbers[1], f"{name} is pinned below its lowest version"
    assert set(CALLS) == {get_command_name(one) for one in app.registered_commands if not one.hidden}
