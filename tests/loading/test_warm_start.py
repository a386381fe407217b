"""A warm start imports nothing that only a derivation, a compile, a file or a picture needs."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

CODE = """
import sys
import gudgeon
linkage = gudgeon.load("slider_crank", scene="dry", overrides={overrides})
run = linkage.simulate(t_end=1e-3, output=2)
print(linkage.loading.origin, *sys.modules)
"""
HEAVY = {
    "sympy",
    "jinja2",
    "pydantic",
    "ruamel",
    "ruamel.yaml",
    "pint",
    "cffi",
    "pycparser",
    "subprocess",
    "filelock",
    "xarray",
    "matplotlib",
    "scipy",
    "typer",
    "rich",
    "numpy.polynomial",
    "gudgeon.generator",
    "gudgeon.language.units",
    "gudgeon.assembly.closure",
}


def start(cache: Path, overrides: str = "None") -> tuple[str, set[str]]:
    """Where the kernels came from and what a new process had imported after a short run."""
    done = subprocess.run(
        [sys.executable, "-c", CODE.format(overrides=overrides)],
        env={**os.environ, "GUDGEON_CACHE": str(cache)},
        capture_output=True,
        text=True,
        check=True,
    )
    origin, *modules = done.stdout.split()
    return origin, set(modules)


def test_warm_start_imports_only_what_runs_and_a_shipped_mechanism_needs_no_sympy_even_cold(tmp_path: Path) -> None:
    origin, modules = start(tmp_path)
    assert origin == "generated"
    assert modules & {"sympy", "jinja2", "pydantic", "ruamel.yaml", "pint", "cffi", "pycparser"} == set()
    origin, modules = start(tmp_path)
    assert origin == "cache"
    assert modules & HEAVY == set()


def test_a_derivation_does_import_them(tmp_path: Path) -> None:
    """The check on the check: were the names wrong, the tests above could not fail."""
    origin, modules = start(tmp_path, "{'parameters.c': 0.4e-3}")
    assert origin == "derived"
    assert modules >= {"sympy", "jinja2", "ruamel.yaml", "filelock"}
    assert not modules & {"pydantic", "pint", "cffi", "pycparser"}


MISTAKE = """
import sys
import gudgeon
try:
    gudgeon.load({file!r})
except gudgeon.errors.InputError as error:
    print(error.where.line, *sys.modules)
"""


def test_a_mistake_in_a_file_is_told_before_sympy_is_imported(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("format: gudgeon/1\nname: mine\nbodies: {rod: {length: 1 kg}}\n")
    line = [sys.executable, "-c", MISTAKE.format(file=str(file))]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=True)
    where, *modules = done.stdout.split()
    assert where == "3" and "ruamel.yaml" in modules and "sympy" not in modules
