"""The wheel and the sdist, installed and run outside the checkout under every Python that there is.

    python -m tests.packages [--python python3.12 ...]

Packages come out of a bare environment: a home of its own, a path with nothing but what was installed. From the wheel
of this machine the press runs without a compiler, by what it carries; from the sdist, which is made into a wheel on
the way, a linkage of its own goes through derivation and the compiler. Under the first Python every command is called
once with the lowest versions that pyproject.toml allows (tests/minimum.py).
"""

from __future__ import annotations

import argparse
import platform
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PYTHONS = ("python3.11", "python3.12", "python3.13", "python3.14")
LINKAGE = """\
format: gudgeon/1
name: own
gravity: [0, -9.81 m/s^2]
bodies: {rod: {length: 1 m, mass: 1 kg, inertia: 0.08333333333333333 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, rod.tail]}}
freedoms: 1
scenes: {ideal: {simulate: {t_end: 1 s, output: 11}}}
"""
MOVED = "import numpy as np, gudgeon; run = gudgeon.load({}).simulate({}, output=2); assert {}"
FALLS = "abs(run['rod.omega'][-1] ** 2 + 3 * 9.81 * np.sin(run['rod.theta'][-1])) < 1e-6"  # by energy


def there_are() -> list[str]:
    """One of each version, on the path or among pyenv's; a name on the path may be a shim with nothing behind it."""
    found = []
    for name in PYTHONS:
        kept = sorted(Path.home().glob(f".pyenv/versions/*/bin/{name}"))
        for path in (shutil.which(name), *map(str, kept)):
            if path and subprocess.run([path, "-c", "import venv"], capture_output=True, check=False).returncode == 0:
                found.append(path)
                break
    return found


def copy_sources(folder: Path) -> Path:
    """Copy what a package is built from, links as what they lead to, so that nothing is left in the checkout."""
    shutil.copytree(ROOT / "src", folder / "src")
    for name in ("pyproject.toml", "LICENSE", "README.md"):
        shutil.copy(ROOT / name, folder / name)
    return folder


def sdist(folder: Path) -> Path:
    """Build the sdist in a folder."""
    copy = copy_sources(folder / "house")
    code = f"import setuptools.build_meta as b; b.build_sdist({str(folder)!r})"
    subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=copy, check=True, capture_output=True)
    (made,) = folder.glob("*.tar.gz")
    return made


def wheel(folder: Path) -> Path:
    """Of this machine, with the press compiled."""
    carried = [str(folder), "--machine", platform.machine(), "--mechanism", "nine_bar_press"]
    subprocess.run([sys.executable, str(ROOT / "tools/wheels.py"), *carried], check=True, capture_output=True)
    (made,) = folder.glob("*.whl")
    return made


class Place:
    """An environment of one Python, outside; what runs there sees no compiler unless it is lent the path."""

    def __init__(self, python: str, folder: Path) -> None:
        self.folder, self.home = folder, folder / "home"
        self.home.mkdir(parents=True)
        subprocess.run([python, "-m", "venv", str(folder / "env")], check=True)

    def install(self, *what: str) -> None:
        """By pip, with the settings of it that hold here."""
        program = str(self.folder / "env/bin/python")
        pip = [program, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "--no-compile"]
        subprocess.run([*pip, *what], cwd=self.home, check=True)

    def run(self, command: Sequence[str], path: str = "") -> str:
        """What it prints; raises RuntimeError with what it said where it fails."""
        bare = {"HOME": str(self.home), "PATH": f"{self.folder / 'env/bin'}{path and ':' + path}", "LC_ALL": "C.UTF-8"}
        bare["GUDGEON_QUICK"] = "0"  # nothing goes on where the folder is taken away
        program = str(self.folder / "env/bin" / command[0])
        line = [program, *command[1:]]
        done = subprocess.run(line, cwd=self.home, env=bare, capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def runs_without_a_compiler(self) -> str:
        """The version, and the press; a mechanism of one's own is refused with a sentence."""
        specified = self.run(["gudgeon", "--version"])
        self.run(["gudgeon", "run", "nine_bar_press", "--t-end", "5 ms"])
        for scene in ("dry", "lubricated"):
            self.run(["python", "-c", MOVED.format(f"'nine_bar_press', '{scene}'", 5e-3, "run.t[-1] == 5e-3")])
        (self.home / "own.yaml").write_text(LINKAGE, encoding="utf-8")
        try:
            self.run(["gudgeon", "run", "own.yaml"])
        except RuntimeError as error:
            assert "no C compiler" in str(error) and "Traceback" not in str(error), error
        else:
            raise AssertionError("a compiler was found on a path that has none")
        return specified.strip()

    def runs_with_one(self, path: str) -> None:
        """A linkage of one's own, derived and compiled."""
        (self.home / "own.yaml").write_text(LINKAGE, encoding="utf-8")
        self.run(["gudgeon", "run", "own.yaml"], path)
        self.run(["python", "-c", MOVED.format("'own.yaml'", 0.5, FALLS)], path)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--python", nargs="+", default=there_are())
    requested = parser.parse_args().python
    compiler = str(Path(shutil.which("cc") or "/usr/bin/cc").parent)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        made, source = wheel(folder / "wheel"), sdist(folder / "sdist")
        print(f"{made.name}  {made.stat().st_size / 1e6:.2f} MB\n{source.name}  {source.stat().st_size / 1e6:.2f} MB")
        for k, python in enumerate(requested):
            place = Place(python, folder / str(k))
            place.install("--constraint", str(ROOT / "constraints.txt"), str(made))
            specified = place.runs_without_a_compiler()
            place.install("--no-deps", "--force-reinstall", str(source))
            place.runs_with_one(compiler)
            print(f"{python}: {specified}: the wheel without a compiler, the sdist with one", flush=True)
        from tests.minimum import try_every_command

        versions = try_every_command(requested[0], folder / "minimum", source, compiler)
        print(f"{requested[0]}: every command with {versions}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
