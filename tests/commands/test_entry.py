"""The command `gudgeon` as a process: streams that are closed or full, encodings, SIGTERM."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import typer.main
from typer.models import CommandInfo

import gudgeon
from gudgeon import cli
from gudgeon.cli import get_command_name
from tests.programs import needs_compiler
from tests.pump import Gudgeon
from tests.slow import slow_but

START = "from gudgeon.entry import main; main()"
TERMINATED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGTERM, signal.SIG_DFL)  # whoever runs the tests may have it ignored
from gudgeon.integrators import single_run
from gudgeon.waiting import cancellation
cancellation.POLL_INTERVAL_S, real, looks = 0.0, single_run.SingleRun._poll_and_report_progress, []

def look(*arguments):
    looks.append(0)
    if len(looks) == 30:
        os.kill(os.getpid(), signal.SIGTERM)
    real(*arguments)

single_run.SingleRun._poll_and_report_progress = look
"""

LATE = """
class Late:  # goes when Python has let go of all handlers, where a Ctrl-C that comes now would kill
    def __del__(self, kill=os.kill, process=os.getpid(), number=signal.SIGINT):
        kill(process, number)

sys.late = Late()
"""


def gudgeon_process(line: str, folder: Path, before: str = "", **environment: str) -> subprocess.CompletedProcess[str]:
    """A line of a shell, in which `gudgeon` is the command."""
    code = before + START
    return subprocess.run(
        ["sh", "-c", 'gudgeon() { "$PYTHON" -c "$START" "$@"; }; ' + line],
        cwd=folder,
        capture_output=True,
        text=True,
        encoding="utf-8",
        env={**os.environ, "PYTHON": sys.executable, "START": code, **environment},
    )


def test_help_waits_for_no_rich(tmp_path: Path) -> None:
    """Most of .4 s went into laying it out; the same of a wrong option. With a table rich is there."""
    message = "import atexit, sys; atexit.register(lambda: print('with rich' if 'rich' in sys.modules else 'plain'));"
    for words, code, end in (("run --help", 0, "plain"), ("run --nope", 2, "plain"), ("laws", 0, "with rich")):
        done = gudgeon_process(f"gudgeon {words}", tmp_path, message)
        assert (done.returncode, done.stdout.splitlines()[-1]) == (code, end)


def test_of_a_command_that_is_asked_for_its_options_alone_are_read(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    read = list[str]()
    made = typer.main.get_command_from_info

    def noted(command_info: CommandInfo, **options: Any) -> Any:
        read.append(get_command_name(command_info))
        return made(command_info, **options)

    monkeypatch.setattr("typer.main.get_command_from_info", noted)
    for arguments, expected in (["map", "-h"], ["map"]), (["import", "-h"], ["import"]), (["-h"], ["run", "map"]):
        read.clear()
        monkeypatch.setattr("sys.argv", ["gudgeon", *arguments])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        assert ended.value.code == 0 and capsys.readouterr().out.startswith("Usage: gudgeon")
        assert {*expected} <= {*read} and (len(read) == 1) == (len(arguments) == 2)
    monkeypatch.setattr("sys.argv", ["gudgeon", "rum"])
    with pytest.raises(SystemExit):
        cli.main()
    assert "'run'" in capsys.readouterr().err  # is meant: all are known


CLOSED = (">&-", ">&- 2>&-", "<&- >&- 2>&-")


@pytest.mark.parametrize("closed", slow_but(CLOSED[2:], CLOSED))
def test_streams_that_are_closed(closed: str, tmp_path: Path) -> None:
    done = gudgeon_process(f"gudgeon check pendulum {closed}", tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert gudgeon_process(f"gudgeon check nobody.yaml {closed}", tmp_path).returncode == 2


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_standard_output_without_room(tmp_path: Path) -> None:
    for line in ("gudgeon laws > /dev/full", "gudgeon schema > /dev/full"):  # by Rich, and plain
        done = gudgeon_process(line, tmp_path)
        assert done.returncode == 1
        assert done.stderr == "error: cannot write standard output: No space left on device\n"


WITHOUT = """\
import sys
sys.modules[sys.argv[1]] = None
sys.argv = ["gudgeon", *sys.argv[2:]]
from gudgeon.entry import main
main()
"""


def without(package: str, line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """The command where a package is not installed."""
    words = [sys.executable, "-c", WITHOUT, package, *line.split()]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True)


def test_a_package_that_is_not_installed_is_told_with_what_brings_it(tmp_path: Path) -> None:
    done = without("matplotlib", "draw four_bar -o x.svg", tmp_path)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "error: figures need matplotlib: pip install 'gudgeon[plot]'\n"


@pytest.mark.slow
@needs_compiler
def test_a_page_that_was_written_without_its_compiler_is_told(tmp_path: Path) -> None:
    done = without("ziglang", "equations four_bar -o x.html", tmp_path)
    assert (done.returncode, done.stdout) == (0, "wrote x.html\n")
    assert done.stderr.startswith("warning: this page contains one run") and "gudgeon[web]" in done.stderr


def test_a_reader_that_has_enough(tmp_path: Path) -> None:
    done = gudgeon_process("{ gudgeon schema; echo $? >&2; } | head -n 1", tmp_path)
    assert done.stdout == "{\n" and done.stderr in ("0\n", "1\n")


def test_what_an_encoding_lacks_is_escaped_as_in_json(call: Gudgeon, tmp_path: Path) -> None:
    line = "gudgeon check pendulum -v"
    done = gudgeon_process(line, tmp_path, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, "") and "\\u03a6_q" in done.stdout
    found = [
        json.loads(gudgeon_process(f"{line} --json", tmp_path, PYTHONIOENCODING="ascii").stdout),
        json.loads(call(*line.split()[1:], "--json").stdout),
    ]
    for message in (scene for document in found for scene in document["scenes"].values()):
        assert message.pop("seconds")  # the only thing that two derivations tell otherwise
    assert found[0] == found[1] and "non-zeros of Φ_q" in found[0]["scenes"]["ideal"]


@needs_compiler
@pytest.mark.parametrize("ending", slow_but(["SIGTERM"], ["SIGTERM", "SIGHUP"]))
def test_signals_that_end_a_program_keep_what_was_computed(ending: str, tmp_path: Path) -> None:
    line = "gudgeon run pendulum --scene ideal --method dop853 --out out"
    gudgeon.load("pendulum", "ideal")  # compiled before: who asks without a pause waits for no compiler
    done = gudgeon_process(line, tmp_path, TERMINATED.replace("SIGTERM", ending))
    assert done.returncode == 128 + getattr(signal, ending), done.stderr
    assert done.stderr.startswith("interrupted: the computed results are shown and saved; ideal ends at")
    assert gudgeon.Result.load(tmp_path / "out/pendulum_ideal.nc").diagnostics.interrupted
    assert not list((tmp_path / "out").glob(".*"))


@pytest.mark.slow
@needs_compiler
def test_a_second_ctrl_c_while_python_ends_leaves_the_exit_code(tmp_path: Path) -> None:
    gudgeon.load("pendulum", "ideal")
    code = TERMINATED.replace("os.getpid(), signal.SIGTERM", "os.getpid(), signal.SIGINT") + LATE + START
    words = ["run", "pendulum", "--scene", "ideal", "--out", "out"]
    done = subprocess.run([sys.executable, "-c", code, *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 130 and done.stderr.startswith("interrupted: the computed results"), done.stderr
    code = TERMINATED + LATE + START
    words = ["check", "pendulum"]
    done = subprocess.run([sys.executable, "-c", code, *words], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_as_a_module(tmp_path: Path) -> None:
    """`python -m gudgeon`, where no script is on the path."""
    line = [sys.executable, "-m", "gudgeon", "--version"]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout == f"gudgeon {gudgeon.__version__}\n"


@pytest.mark.parametrize(
    ("no_color", "term", "red"),
    [(None, "xterm", True), ("", "xterm", True), ("1", "xterm", False), (None, "dumb", False)],
)
def test_errors_are_red_where_somebody_looks_and_wants_it(
    no_color: str | None, term: str, red: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from gudgeon.commands.outcome import print_error
    from gudgeon.errors import GudgeonError

    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", term)
    if no_color is not None:
        monkeypatch.setenv("NO_COLOR", no_color)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    print_error(GudgeonError("no"))
    assert capsys.readouterr().err == ("\033[31merror:\033[0m no\n" if red else "error: no\n")


@pytest.mark.parametrize("is_terminal", [True, False])
def test_a_bar_is_shown_on_a_terminal_alone(
    is_terminal: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And not where a command is asked to be quiet, or for JSON."""
    from gudgeon.commands.progress import show_progress_bars

    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal, raising=False)
    for quiet in (False, True):
        with show_progress_bars(quiet) as bar:
            report = bar("study")
            assert (report is not None) == (is_terminal and not quiet)
            if report:
                report(0.5, "3 of 6 runs")
        out, err = capsys.readouterr()
        assert out == "" and ("3 of 6 runs" in err) == (is_terminal and not quiet)
