"""From C text to a loaded library: what decides its key, what goes wrong, and what a process killed leaves."""

from __future__ import annotations

import os
import select
import shutil
import signal
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from gudgeon.errors import BadValueError, BuildError
from gudgeon.loading import build, compiler
from gudgeon.loading.build import LIBRARY, compile_kernels, compute_library_key
from gudgeon.loading.cache import Cache, get_private_cache
from gudgeon.loading.library import Library
from tests.tiny import SEEN, tiny

# the real compiler behind a script that logs versions (V) and compiles of a scene (C), not the link (L)
SCRIPT = """#!/bin/sh
case "$*" in *--version*) kind=V ;; *kernels.so*) kind=L ;; *) kind=C ;; esac
[ $kind = L ] || echo $kind >>"{log}"
{extra}
exec {real} "$@"
"""
CHILD = """
from gudgeon.loading.build import compile_kernels
from tests.tiny import tiny
print(compile_kernels(tiny()).lib.scale(4.0))
"""
ROOT = Path(__file__).parents[2]


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cache:
    """An empty cache, also of the child processes; no library of another test is remembered."""
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(build, "_libraries", {})
    return Cache(tmp_path / "cache")


@pytest.fixture
def fake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Path]:
    """Puts a script in $CC; the path of its log comes back."""
    real = compiler.find_compiler()[0]

    def write(extra: str = "") -> Path:
        script, log = tmp_path / "cc.sh", tmp_path / "cc.log"
        script.write_text(SCRIPT.format(log=log, extra=extra, real=real))
        script.chmod(0o755)
        monkeypatch.setenv("CC", str(script))
        log.touch()
        return log

    return write


def child() -> subprocess.Popen[str]:
    path = os.pathsep.join(filter(None, [os.environ.get("PYTHONPATH"), str(ROOT)]))
    return subprocess.Popen(
        [sys.executable, "-c", CHILD],
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def only_library(cache: Cache) -> Path:
    (path,) = cache.root.glob(f"libraries/*/{LIBRARY}")
    return path


def test_compiles_and_runs(cache: Cache) -> None:
    module = compile_kernels(tiny(3), cache=cache)
    assert module.lib.scale(2.0) == 6.0
    assert module.ffi.typeof(module.lib.scale).result.cname == "double"


def test_two_sources_live_side_by_side(cache: Cache) -> None:
    two, five = compile_kernels(tiny(2)), compile_kernels(tiny(5))
    assert (two.lib.scale(1.0), five.lib.scale(1.0)) == (2.0, 5.0)


def test_the_second_time_neither_compiler_nor_version_is_asked_for(
    cache: Cache, fake: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    log = fake()
    for _ in range(2):
        monkeypatch.setattr(build, "_libraries", {})  # as in a new process
        compile_kernels(tiny())
    assert log.read_text().split() == ["V", "C"]
    compile_kernels(tiny(), rebuild=True)
    assert log.read_text().split() == ["V", "C", "C"]


def test_a_changed_compiler_is_asked_and_used_again(
    cache: Cache, fake: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    log = fake('case "$*" in *--version*) echo one; exit ;; esac')
    compile_kernels(tiny())
    fake('case "$*" in *--version*) echo three; exit ;; esac')
    monkeypatch.setattr(build, "_libraries", {})
    compile_kernels(tiny())
    assert log.read_text().split() == ["V", "C", "V", "C"]


def key(portable: bool = False, **changes: object) -> str:
    requested = {
        "source": tiny(),
        "command": ("cc",),
        "flags": compiler.build_flags(portable),
        "compiler_description": "gcc 12",
        **changes,
    }
    return compute_library_key(**requested, portable=portable)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "changes",
    [
        {"source": tiny(3)},
        {"source": tiny(main="tiny.h")},
        {"source": tiny(cdef="double scale(double y);")},
        {"source": tiny(files={**tiny().files, "more.h": ""})},
        {"command": ("cc", "-m64")},
        {"flags": ("-O3",)},
        {"compiler_description": "gcc 13"},
        {"portable": True},
    ],
)
def test_the_key_changes_with_what_decides_the_library(changes: dict[str, object]) -> None:
    assert key(**changes) != key()  # type: ignore[arg-type]


def test_the_key_does_not_change_with_what_does_not() -> None:
    files = dict(reversed(list(tiny().files.items())))
    assert key(source=tiny(title="another", notes=("a note",), files=files)) == key()


def test_only_native_code_is_bound_to_the_cpu(monkeypatch: pytest.MonkeyPatch) -> None:
    native, portable = key(), key(portable=True)
    monkeypatch.setattr(compiler, "describe_cpu", lambda: "another")
    assert key() != native
    assert key(portable=True) == portable
    assert not any("native" in flag for flag in compiler.build_flags(True))
    assert any("native" in flag for flag in compiler.build_flags(False))


def test_no_flag_breaks_isnan(cache: Cache) -> None:
    files = {"nan.c": f"#include <math.h>\n{SEEN}int bad(double x) {{ return !isfinite(x) || isnan(x); }}\n"}
    module = compile_kernels(tiny(files=files, main="nan.c", cdef="int bad(double x);"))
    assert [module.lib.bad(x) for x in (1.0, float("nan"), float("inf"))] == [0, 1, 1]


def test_a_damaged_library_is_built_again(cache: Cache, fake: Callable[..., Path]) -> None:
    log = fake()
    assert child().communicate()[0] == "8.0\n"
    library = only_library(cache)
    os.truncate(library, library.stat().st_size // 2)
    assert child().communicate()[0] == "8.0\n"
    assert log.read_text().split() == ["V", "C", "C"]


@pytest.mark.parametrize("count", [6, pytest.param(32, marks=pytest.mark.slow)])
def test_processes_on_an_empty_cache_compile_once(count: int, cache: Cache, fake: Callable[..., Path]) -> None:
    log = fake()
    children = [child() for _ in range(count)]
    answers = [process.communicate() for process in children]
    assert [out for out, _ in answers] == ["8.0\n"] * count, answers
    assert sorted(log.read_text().split()) == ["C", "V"]


@pytest.fixture
def gate(tmp_path: Path) -> Iterator[Path]:
    """A compiler that finds this file tells that it runs, and then waits for good."""
    (tmp_path / "gate").touch()
    os.mkfifo(tmp_path / "running")
    os.mkfifo(tmp_path / "never")
    yield tmp_path / "gate"


def test_killed_in_the_middle_of_a_compile(cache: Cache, fake: Callable[..., Path], gate: Path) -> None:
    folder = gate.parent
    fake(f'[ $kind = C ] && [ -e "{gate}" ] && {{ echo $$ >"{folder}/running"; read x <"{folder}/never"; }}')
    running, orphan = os.open(folder / "running", os.O_RDONLY | os.O_NONBLOCK), 0
    killed = child()
    try:
        assert select.select([running], [], [], 120)[0], "the compiler was never started"
        orphan = int(os.read(running, 100))
        assert list((cache.root / "aside").iterdir())
        killed.kill()
        killed.wait()
        gate.unlink()
        # the orphaned compiler still waits in its folder; neither it nor its lock may be in the way
        again = child().communicate()
        assert again[0] == "8.0\n", again
        assert list((cache.root / "aside").iterdir()) == []
        assert only_library(cache).is_file()
    finally:
        killed.kill()
        if orphan:
            os.killpg(orphan, signal.SIGKILL)
        os.close(running)


@pytest.mark.parametrize("kind", ["C", "V", "L"])
def test_ctrl_c_ends_the_compilers_and_what_they_started(
    cache: Cache, fake: Callable[..., Path], gate: Path, kind: str
) -> None:
    """Of each program under way: scene, version, link. Their ends of the pipe are all closed at once."""
    folder = gate.parent
    waits = f'{{ exec 9>"{folder}/running"; echo $$ >&9; sleep 1000; }}'  # the sleep holds the pipe too
    fake(f"if [ $kind = {kind} ]; then {waits}; fi")
    running = os.open(folder / "running", os.O_RDONLY | os.O_NONBLOCK)
    process = child()
    try:
        assert select.select([running], [], [], 120)[0], "the compiler was never started"
        process.send_signal(signal.SIGINT)
        specified = process.communicate(timeout=120)[1]
        assert specified.rstrip().endswith("KeyboardInterrupt"), specified
        while select.select([running], [], [], 60)[0]:
            if not os.read(running, 100):
                break  # the end, which comes when nobody is left who might write
        else:
            pytest.fail("something of the compiler is left")
        assert [*cache.root.glob("aside/*"), *cache.root.glob("libraries/*")] == []
    finally:
        process.kill()
        os.close(running)


@pytest.mark.parametrize(("name", "specified"), [("", "no C compiler found"), ("no-such-cc -O0", "'no-such-cc'")])
def test_no_compiler_names_what_to_install(
    cache: Cache, monkeypatch: pytest.MonkeyPatch, name: str, specified: str
) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.setenv("CC", name)
    monkeypatch.setitem(sys.modules, "ziglang", None)  # as if it were not installed
    with pytest.raises(BuildError, match=f"(?s){specified}.*apt-get install gcc.*xcode-select.*gudgeon\\[cc\\]"):
        compile_kernels(tiny())


def test_the_wheel_is_a_compiler_where_there_is_none(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Behind those of the system, with the flags that it knows; what runs on this CPU alone stays out where asked."""
    zig = tmp_path / "zig"
    zig.touch(0o755)
    monkeypatch.setitem(sys.modules, "ziglang", SimpleNamespace(__file__=str(tmp_path / "__init__.py")))
    monkeypatch.setenv("CC", "")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    command = compiler.find_compiler()
    assert command[:2] == (str(zig), "cc")
    assert set(compiler.FLAGS) - set(compiler.build_flags(True, command)) == compiler.GCC_FLAGS
    assert "-ffp-contract=off" in compiler.build_flags(True, command) and not any(
        map(compiler.INEXACT_FLAGS.__contains__, command)
    )
    system = tmp_path / "bin" / "clang"
    system.parent.mkdir()
    system.touch(0o755)
    assert compiler.find_compiler() == (str(system),) and compiler.build_flags(True, (str(system),)) == compiler.FLAGS
    system.unlink()
    zig.unlink()  # a wheel that is not whole
    with pytest.raises(BuildError, match="no C compiler"):
        compiler.find_compiler()


@pytest.mark.slow
def test_without_a_compiler_a_mechanism_runs_by_the_wheels(tmp_path: Path) -> None:
    """The same motion as with the system's, to what another order of operations may do. A minute: zig's C library."""
    pytest.importorskip("ziglang")
    (tmp_path / "bin").mkdir()
    code = "import gudgeon; print(*gudgeon.load('pendulum').simulate(0.5, output=3).q[-1])"
    found: list[list[float]] = []
    for place in (os.environ["PATH"], str(tmp_path / "bin")):
        environment = {**os.environ, "PATH": place, "CC": "", "GUDGEON_CACHE": str(tmp_path / f"cache{len(found)}")}
        done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
        found.append([float(number) for number in done.stdout.split()])
    assert (tmp_path / "cache1" / "zig").is_dir() and not (tmp_path / "cache0" / "zig").exists()
    assert found[1] == pytest.approx(found[0], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("option", ["-ffast-math", "-Ofast"])
def test_a_compiler_that_may_not_round_is_refused(cache: Cache, monkeypatch: pytest.MonkeyPatch, option: str) -> None:
    """Without isnan a journal far outside its bearing was told of a machine that runs well."""
    monkeypatch.setenv("CC", f"cc {option}")
    with pytest.raises(BadValueError, match=rf"\$CC has {option}"):
        compile_kernels(tiny(3))


@pytest.mark.parametrize(
    ("command", "code"),
    [
        ("echo 'as: BFD: cannot write: File too large' >&2; exit 1", "File too large"),
        ("kill -XFSZ $$", "limit on the size"),
        ("echo 'Disk quota exceeded'; exit 4", "quota"),
    ],
)
def test_a_limit_that_stops_the_compiler_is_the_folders_fault(
    cache: Cache, fake: Callable[..., Path], command: str, code: str
) -> None:
    fake(f'case "$kind $PWD" in "C {cache.root}"*) {command} ;; esac')
    with pytest.warns(RuntimeWarning, match=code):
        assert compile_kernels(tiny(3)).lib.scale(1.0) == 3.0


def test_a_compiler_that_is_no_command_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "'gcc")
    with pytest.raises(BadValueError, match="(?s)CC.*No closing quotation"):
        compiler.find_compiler()


def test_wrong_c_shows_the_first_lines_and_leaves_nothing(cache: Cache) -> None:
    wrong = tiny(files={"tiny.c": "double scale(double x) { return undeclared_name; }\n"})
    with pytest.raises(BuildError, match="undeclared_name"):
        compile_kernels(wrong)
    assert list(cache.root.glob("libraries/*")) == []


def test_a_disk_that_fills_up_under_the_compiler(cache: Cache, fake: Callable[..., Path]) -> None:
    full = 'echo "ld: No space left on device" >&2; exit 1'
    fake(f'case "$kind $PWD" in "C {cache.root}"*) {full} ;; esac')
    with pytest.warns(RuntimeWarning, match="No space left"):
        assert compile_kernels(tiny()).lib.scale(1.0) == 2.0
    assert list(cache.root.glob("libraries/*")) == []


def test_a_folder_that_forbids_running_code(
    cache: Cache, fake: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a file system mounted noexec: told once, with what to do, and compiled once for all starts."""
    log = fake()
    real = build._open_entry

    def open_elsewhere(entry: Path, cdef: str) -> Library:
        if entry.is_relative_to(cache.root):
            raise ImportError("failed to map segment from shared object: Operation not permitted")
        return real(entry, cdef)

    monkeypatch.setattr(build, "_open_entry", open_elsewhere)
    monkeypatch.setattr(build, "_is_noexec", lambda folder: folder == cache.root)
    with pytest.warns(RuntimeWarning, match="(?s)noexec.*GUDGEON_CACHE") as message:
        for _ in range(2):
            monkeypatch.setattr(build, "_libraries", {})
            library = compile_kernels(tiny(7))
            assert library.lib.scale(1.0) == 7.0
            shutil.rmtree(get_private_cache().root / "libraries")  # as in a new process
    assert library.file.is_relative_to(get_private_cache().root)
    assert len(message) == 1
    assert log.read_text().split() == ["V", "C"]


def test_no_folder_where_code_may_run_says_what_to_set(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(entry: Path, cdef: str) -> Library:
        raise ImportError("failed to map segment from shared object")

    monkeypatch.setattr(build, "_open_entry", refuse)
    monkeypatch.setattr(build, "_is_noexec", lambda folder: True)
    with pytest.raises(BuildError, match="(?s)failed to map.*TMPDIR"):
        compile_kernels(tiny(13))


def test_a_library_that_loads_nowhere_is_a_build_error(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(entry: Path, cdef: str) -> Library:
        raise ImportError("wrong ELF class")

    monkeypatch.setattr(build, "_open_entry", refuse)
    with pytest.raises(BuildError, match="wrong ELF class"):
        compile_kernels(tiny(11))


@pytest.mark.parametrize("wrote", ["echo junk > $out", ": > $out", "echo hello >&2"])
def test_a_compiler_that_writes_junk_is_named(wrote: str, cache: Cache, fake: Callable[..., Path]) -> None:
    """Not the cache: no warning says so, and a compiler that was mended is asked again."""
    junk = 'for a; do [ "$last" = -o ] && out=$a; last=$a; done; case "$out" in *.so) ' + f"{wrote}; exit 0;; esac"
    fake(junk)
    message = f"(?s)compiler .*{os.environ['CC']} ended without an error.*set CC"
    message = "did not write kernels.so" if "hello" in wrote else message
    with warnings.catch_warnings(), pytest.raises(BuildError, match=message):
        warnings.simplefilter("error")
        compile_kernels(tiny(12))
    fake()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert compile_kernels(tiny(12)).lib.scale(1.0) == 12.0


def test_the_same_source_is_the_same_library(cache: Cache) -> None:
    assert compile_kernels(tiny()) is compile_kernels(replace(tiny(), title="other"))
