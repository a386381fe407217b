"""A disk that fills at so many sizes, under each command that writes: what is lost, left behind or killed.

`python -m tests.files.full_disk TASK FOLDER COUNT`, where FOLDER is a small file system of its own that may be filled
(test_full_disk.py makes one); prints one line of JSON. For each size of free room, from none to more than what is
needed, an older version lies there and a newer one is to be written, by a process of its own. Then each file is the
older or the newer one, whole; nothing else is there; the process has ended by itself, with 0 only if all is written and
else with a sentence on the disk; and with room again the same succeeds.

A task is a function that is given a folder and the number of the version, and ends as a command does.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from tests.pump import TEXT
from tests.tiny import tiny

Act = Callable[[Path, int], None]
PAGE = 4096
TASKS: dict[str, Callable[[Path], Act]] = {}


def task(make: Callable[[Path], Act]) -> Callable[[Path], Act]:
    """A task by the name of its function, which does in a folder with room what need not be done again and again."""
    TASKS[make.__name__] = make
    return make


def command(*words: object) -> None:
    """A command as the user types it, in this process."""
    from gudgeon.cli import main

    sys.argv = ["gudgeon", *map(str, words)]
    main()


def pumps(room: Path) -> list[Path]:
    """Two versions of a file; their scenes are in the cache."""
    paths = [room / f"{k}" / "pump.yaml" for k in range(2)]
    for k, path in enumerate(paths):
        path.parent.mkdir()
        path.write_text(TEXT.replace("A pump", f"Pump {k}").replace("20 rad/s", f"{20 + k} rad/s"))
    return paths


@task
def emit(room: Path) -> Act:
    from gudgeon.commands.common import read_scene_names
    from gudgeon.loading.kernel_sources import find_kernel_source

    paths = pumps(room)
    for path in paths:
        for scene in read_scene_names(str(path)):
            find_kernel_source(path.read_bytes(), path, scene)
    return lambda folder, k: command("emit", paths[k], "-o", folder / "c", "--scene", "worn")


@task
def equations(room: Path) -> Act:
    from gudgeon.generator import pipeline

    paths = pumps(room)
    kept = {path.read_bytes(): pipeline.derive_scene(path.read_bytes(), str(path), "ideal") for path in paths}
    pipeline.derive_scene = lambda data, *_: kept[data]
    return lambda folder, k: command("equations", paths[k], "-o", folder / "x.tex")


@task
def table_and_figure(room: Path) -> Act:
    """`gudgeon bench` once all is measured: a CSV file and a picture beside it."""
    import gudgeon
    from gudgeon.studies.bench import measure_scene
    from gudgeon.studies.show.bench import report_bench

    simulation = gudgeon.load("pendulum")
    found = [
        measure_scene(simulation, [0.01 / (k + 1)], [1e-6], t_end=0.1, quick=True, methods=["rk4"]) for k in range(2)
    ]
    return lambda folder, k: report_errors(lambda: report_bench(simulation.source, [found[k]], folder / "x.csv", None))


@task
def draw_run_figure(room: Path) -> Act:
    import gudgeon
    from gudgeon.results.figures.plots import draw_run_figure, save_figure

    run = gudgeon.load("pendulum").simulate(1.0)
    pictures = [draw_run_figure({"ideal": run}, {}, [name]) for name in list(run.names)[:2]]
    return lambda folder, k: report_errors(lambda: save_figure(pictures[k], folder / "x.png"))


@task
def save(room: Path) -> Act:
    """A result over an older one, as NetCDF; all that is computed at saving is computed before."""
    import gudgeon

    pendulum, folder = gudgeon.load("pendulum"), room / "computed"
    folder.mkdir()
    runs = [pendulum.simulate(1.0 + k, output=200 * (k + 1)) for k in range(2)]
    for k, run in enumerate(runs):
        run.save(folder / f"{k}.nc")
    return lambda folder, k: report_errors(lambda: runs[k].save(folder / "run.nc"))


@task
def study(room: Path) -> Act:
    """A study beside an older one: its blocks stay, and with room again it goes on from them."""
    import gudgeon
    from gudgeon.studies.ensemble import resolve

    resolve.MAX_BLOCK_RUNS = 1
    file = {"mechanism": "pendulum", "parameters": {"g": [5, 7, 9]}, "t_end": "0.1 s", "output": 500, "keep": ["bob.x"]}
    gudgeon.study(file)
    return lambda folder, k: report_errors(lambda: gudgeon.study(file, folder / f"{k}.study").save(folder / "study.nc"))


@task
def compile(room: Path) -> Act:
    """A cache without room: the library is had all the same, from a temporary folder, and that is told."""
    return lambda folder, k: report_errors(lambda: compiled(folder, k))


@task
def compile_nowhere(room: Path) -> Act:
    """Neither the cache nor the temporary folder has room."""

    def act(folder: Path, k: int) -> None:
        tempfile.tempdir = os.environ["TMPDIR"] = str(folder / "tmp")
        report_errors(lambda: compiled(folder, k))

    return act


def compiled(folder: Path, k: int) -> None:
    from gudgeon.loading import build
    from gudgeon.loading.cache import Cache, is_entry_complete

    (folder / "tmp").mkdir(exist_ok=True)
    assert build.compile_kernels(tiny(3 + k), cache=Cache(folder / "cache")).lib.scale(1.0) == 3.0 + k
    assert all(is_entry_complete(entry) for entry in folder.glob("cache/libraries/*"))


def report_errors(act: Callable[[], object]) -> None:
    """As the command line does: an error of ours is a sentence and an exit code."""
    from gudgeon.commands.outcome import report_errors

    report_errors(act)()


def child(act: Callable[[], object]) -> tuple[int, str]:
    """Exit status (a signal is negative) and what is told on stderr, by a process that ends as any does."""
    with tempfile.TemporaryFile() as specified:
        process = os.fork()
        if process == 0:
            import typer

            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.dup2(specified.fileno(), 2)
            try:
                act()
            except typer.Exit as end:
                sys.exit(end.exit_code)
            sys.exit(0)  # with everything that is done at exit
        status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        specified.seek(0)
        return status, specified.read().decode(errors="replace")


def contents(folder: Path) -> dict[str, bytes]:
    """Files with their bytes; of a cache the names of its entries, whose bytes depend on where they were made."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if name.startswith("cache/"):
            if name.startswith(("cache/aside/", "cache/libraries/")) and name.count("/") == 2:
                found[name] = b""
        elif path.is_file():
            found[name] = path.read_bytes()
        elif name.startswith("tmp/"):
            found[name] = b""
    return found


def full(disk: Path, free: int) -> Path:
    """Fill the file system but for so many bytes."""
    filler = disk / "filler"
    with filler.open("wb") as file:
        there = os.statvfs(disk)
        os.posix_fallocate(file.fileno(), 0, max(there.f_bavail * there.f_frsize - free, 1))
    return filler


def versions(disk: Path, room: Path, act: Act) -> tuple[dict[str, bytes], dict[str, bytes], int]:
    """What both versions leave where there is room, and a size that is enough to write the second over the first."""
    folder = disk / "work"
    found = []
    for k in range(2):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for version in range(k + 1):
            status, specified = child(lambda version=version: act(folder, version))  # type: ignore[misc]
            assert status == 0, specified
        found.append(contents(folder))
        if k == 0:
            shutil.copytree(folder, room / "older")
    return found[0], found[1], 2 * sum(-(-len(data) // PAGE) * PAGE for data in found[1].values()) + (1 << 17)


def sizes(top: int, count: int) -> Iterator[int]:
    """The first pages one by one, then evenly to the top."""
    first = min(count // 2, 12)
    yield from (k * PAGE for k in range(first))
    yield from (first * PAGE + k * (top - first * PAGE) // (count - first) for k in range(count - first))


def check(
    disk: Path, room: Path, act: Act, free: int, older: dict[str, bytes], newer: dict[str, bytes]
) -> tuple[int, list[str]]:
    """The exit status at this much room, and what is wrong."""
    folder, wrong = disk / "work", []
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(room / "older", folder)
    filler = full(disk, free)
    status, specified = child(lambda: act(folder, 1))
    there = contents(folder)
    if status < 0 or "Traceback" in specified or "Exception ignored" in specified:
        wrong.append(f"{free}: ended with {status}: {specified[-300:]}")
    if status == 0 and there != newer and "not stored" not in specified:
        wrong.append(f"{free}: says that all is written, and it is not")
    if status != 0 and not ("No space left" in specified or "nothing can be written" in specified):
        wrong.append(f"{free}: does not say why: {specified[-300:]}")
    for name in older.keys() | there.keys():
        if name not in there:
            wrong += [f"{free}: {name} is lost"] if name not in newer or name in older.keys() & newer.keys() else []
        elif there[name] not in (older.get(name), newer.get(name)) and not name.endswith("emitted.sha256"):
            wrong.append(f"{free}: {name} is neither the older nor the newer")
    filler.unlink()
    status_again, specified = child(lambda: act(folder, 1))
    if status_again != 0 or contents(folder) != newer:
        wrong.append(f"{free}: with room again: {status_again}, {specified[-300:]}")
    return status, wrong


def fill(name: str, disk: Path, count: int) -> dict[str, Any]:
    """All sizes of a task: how many failed for want of room, how many succeeded, what is wrong."""
    owner, room = os.getpid(), Path(tempfile.mkdtemp())
    try:
        act = TASKS[name](room)
        older, newer, top = versions(disk, room, act)
        found = [check(disk, room, act, free, older, newer) for free in sizes(top, count)]
    finally:
        if os.getpid() == owner:  # a child ends through here too
            shutil.rmtree(room)
    statuses, wrong = [status for status, _ in found], [text for _, texts in found for text in texts]
    return {
        "task": name,
        "sizes": count,
        "refused": sum(s != 0 for s in statuses),
        "written": statuses.count(0),
        "signals": sum(s < 0 for s in statuses),
        "wrong": wrong,
    }


if __name__ == "__main__":
    print(json.dumps(fill(sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]))))
