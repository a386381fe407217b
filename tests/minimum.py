"""Every command once, with the lowest versions of what gudgeon depends on that pyproject.toml allows.

    python -m tests.minimum [--python python3.11]

`make packages` does it under the first Python that there is. A command without a call here is an AssertionError.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from gudgeon.cli import app, get_command_name
from tests.packages import LINKAGE, ROOT, Place, sdist, there_are

STUDY = """\
format: gudgeon-study/1
mechanism: own.yaml
t_end: 0.1 s
output: 10
measures: {w: {max: rod.omega}}
parameters: {bodies.rod.length: [0.9 m, 1 m]}
"""
# What is called of each command; a file that is named behind it has to be there at the end.
CALLS = {
    "run": [["run", "own.yaml", "--t-end", "0.1", "--report"]],
    "check": [["check", "own.yaml", "-v"]],
    "emit": [["emit", "own.yaml", "-o", "c"], ["emit", "own.yaml", "-o", "own.fmu", "--scene", "ideal"]],
    "equations": [["equations", "own.yaml", "-o", name] for name in ("x.html", "x.tex", "x.txt", "x.ipynb")],
    "laws": [["laws"], ["laws", "flores"], ["laws", "flores", "--plot", "flores.svg"]],
    "new": [["new", "fresh", "--like", "slider_crank"]],
    "import": [["import", "bar.json", "-o", "bar.yaml"]],
    "exercise": [["exercise", "four_bar", "-o", "sheet.html"]],
    "draw": [["draw", "own.yaml", "-o", name] for name in ("x.svg", "x.png", "x.pdf", "x.dxf")],
    "schema": [["schema"]],
    "bench": [["bench", "own.yaml", "--quick", "--t-end", "0.1", "--methods", "dop853,rk4"]],
    "map": [["map", "own.yaml", "--quick", "--t-end", "0.1", "--axis", "rtol=1e-6..1e-4:2"]],
    "study": [["study", "own_study.yaml", "--out", "own.study"], ["study", "report", "own.study"]],
}
RESULTS = """\
import gudgeon
run = gudgeon.load("own.yaml").simulate(0.1, output=10)
run.plot("rod.omega").savefig("plot.png")
run.to_xarray().to_netcdf("x.nc", engine="h5netcdf")
run.to_dataframe().to_csv("frame.csv")
run.save("run.nc")
gudgeon.Result.load("run.nc")
"""


def try_every_command(python: str, folder: Path, source: Path, compiler: str) -> str:
    """Install the sdist with the lowest versions and call each command; returns the versions that are not transitive.

    Raises RuntimeError with what a call printed where it fails.
    """
    minimums = subprocess.run(
        [sys.executable, str(ROOT / "tools/minimums.py"), "all"], check=True, capture_output=True, text=True
    ).stdout
    folder.mkdir()
    (folder / "minimums.txt").write_text(minimums, encoding="utf-8")
    place = Place(python, folder / "place")
    place.install("--constraint", str(folder / "minimums.txt"), f"gudgeon[all] @ {source.as_uri()}")
    place.run(["python", "-m", "pip", "check"])
    write_inputs(place.home)
    for calls in CALLS.values():
        for call in calls:
            printed = place.run(["gudgeon", *call], compiler)
            assert not printed.startswith("gudgeon "), f"gudgeon {' '.join(call)} prints its version alone"
    words = [word for calls in CALLS.values() for call in calls for word in call[2:]]
    missing = [word for word in words if re.fullmatch(r"\w+\.[a-z]+", word) and not (place.home / word).exists()]
    assert not missing, f"the commands end well and do not write {', '.join(missing)}"
    place.run(["python", "-c", RESULTS], compiler)
    try:
        place.run(["gudgeon", "check", "--nonsense"])
    except RuntimeError as error:
        assert "exit status 2" in str(error) and "Traceback" not in str(error), error
    return " ".join(minimums.split())


def write_inputs(home: Path) -> None:
    """What the calls read."""
    (home / "own.yaml").write_text(LINKAGE, encoding="utf-8")
    (home / "own_study.yaml").write_text(STUDY, encoding="utf-8")
    stored = json.loads((ROOT / "tests/data/exchange/pylinkage_fourbar.json").read_text(encoding="utf-8"))
    (home / "bar.json").write_text(json.dumps(stored["file"]), encoding="utf-8")


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--python", default=there_are()[0])
    commands = {get_command_name(one) for one in app.registered_commands if not one.hidden}
    assert commands == set(CALLS), f"no call of {commands ^ set(CALLS)}"
    compiler = str(Path(shutil.which("cc") or "/usr/bin/cc").parent)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        print(try_every_command(parser.parse_args().python, folder / "0", sdist(folder / "sdist"), compiler))
    return 0


if __name__ == "__main__":
    sys.exit(main())
