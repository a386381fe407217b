"""Saving where there is no room, and Ctrl-C meanwhile: the older file whole, no handle left, the next save works."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("h5py")

from gudgeon.errors import OutputError  # noqa: E402
from gudgeon.results.files import hdf5  # noqa: E402
from gudgeon.results.files.netcdf import build_tables  # noqa: E402
from gudgeon.results.results import Result, read  # noqa: E402
from tests.slow import slow_but  # noqa: E402

FILE_SIZE_LIMIT_HINT = """
import os, resource, sys
from pathlib import Path
from gudgeon.errors import OutputError
from gudgeon.results.results import read

path = Path(sys.argv[1])
run, older, told, count = read(path), path.read_bytes(), 0, int(sys.argv[2])
for k in range(count):
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(older) * k // count, resource.RLIM_INFINITY))
    try:
        run.save(path)
    except OutputError as error:
        told += "File too large" in str(error)
    assert path.read_bytes() == older and os.listdir(path.parent) == [path.name]
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
run.save(path)
assert path.read_bytes() == older
print(told)
"""


@pytest.mark.parametrize("count", slow_but([10], [10, 50]))
def test_a_limit_of_many_sizes_kills_nothing(count: int, run: Result, tmp_path: Path) -> None:
    """In a process of its own, for HDF5 died at its end."""
    run.save(tmp_path / "run.nc")
    line = [sys.executable, "-c", FILE_SIZE_LIMIT_HINT, str(tmp_path / "run.nc"), str(count)]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{count}\n", "")


@pytest.mark.slow
def test_a_disk_that_fills_at_fifty_sizes(run: Result, tmp_path: Path) -> None:
    """A file system in memory with room for a share of the file beside the older one; it is freed, and again."""
    disk = tmp_path / "disk"
    disk.mkdir()
    run.save(tmp_path / "run.nc")
    size = (tmp_path / "run.nc").stat().st_size
    for k in range(50):
        pages = 2 * (size // 4096 + 1)  # for the older file and what is missing of the new one
        mount = ["mount", "-t", "tmpfs", "-o", f"size={4096 * pages}", "tmpfs", str(disk)]
        if subprocess.run(mount, capture_output=True).returncode:
            pytest.skip("file systems cannot be mounted here")
        try:
            run.save(disk / "run.nc")
            older = (disk / "run.nc").read_bytes()
            filler = disk / "filler"
            filler.write_bytes(bytes(4096 + (size - 8192) * k // 50))
            with pytest.raises(OutputError, match="No space left"):
                run.save(disk / "run.nc")
            assert (disk / "run.nc").read_bytes() == older and len(os.listdir(disk)) == 2
            filler.unlink()
            (disk / "run.nc").unlink()
            run.save(disk / "run.nc")
            assert (disk / "run.nc").read_bytes() == older
        finally:
            subprocess.run(["umount", str(disk)], check=True)


def test_memory_that_ends_while_a_file_is_laid_out_is_an_error(
    run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """HDF5 closes what it opened: the next save works."""
    run.save(tmp_path / "run.nc")
    older, write = (tmp_path / "run.nc").read_bytes(), hdf5._create_dataset
    calls = 0

    def create(*arguments: object) -> object:
        nonlocal calls
        calls += 1
        if calls == 20:
            raise MemoryError
        return write(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(hdf5, "_create_dataset", create)
    with pytest.raises(MemoryError):
        run.save(tmp_path / "run.nc")
    assert (tmp_path / "run.nc").read_bytes() == older and os.listdir(tmp_path) == ["run.nc"]
    run.save(tmp_path / "run.nc")
    assert (tmp_path / "run.nc").read_bytes() == older


def interrupt_after(seconds: float, work: Callable[[], None]) -> bool:
    """Whether Ctrl-C so long after the beginning was raised.

    Python drops what is raised while it calls gc.callbacks, and a library of the tests' own has one there: taken away.
    """
    before = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    callbacks = gc.callbacks[:]
    gc.callbacks.clear()
    begin = time.perf_counter()
    try:
        signal.setitimer(signal.ITIMER_REAL, max(seconds, 1e-5))
        work()
        while time.perf_counter() < begin + seconds + 10.0:  # a signal that comes behind its end
            pass
    except KeyboardInterrupt:
        return True
    finally:
        signal.signal(signal.SIGALRM, before)
        gc.callbacks.extend(callbacks)
    return False


@pytest.mark.parametrize("count", slow_but([10], [10, 50]))
def test_an_interrupt_is_never_swallowed(count: int, run: Result, tmp_path: Path) -> None:
    """Ctrl-C at many moments of a save: raised, the file the older or the new one, the next save works."""
    path, stops = tmp_path / "run.nc", 0
    run.save(path)
    whole = path.read_bytes()
    begin = time.perf_counter()
    run.save(path)
    length = time.perf_counter() - begin
    for k in range(count):
        path.write_bytes(b"older")
        assert interrupt_after(1.1 * length * k / count, lambda: run.save(path))
        assert path.read_bytes() in (b"older", whole) and os.listdir(tmp_path) == ["run.nc"]
        stops += path.read_bytes() == b"older"
    assert stops > 0
    run.save(path)
    assert path.read_bytes() == whole and read(path).t[-1] == run.t[-1]


def test_saving_takes_no_memory_for_the_numbers(make: Callable[..., Result]) -> None:
    """What is held besides the result is what describes it, far less than the file."""
    image, _ = hdf5._lay_out_file(list(build_tables(make(samples=20_000))))
    assert image.size > 5_000_000 and len(image._pages) * hdf5.PAGE_BYTES < 500_000
