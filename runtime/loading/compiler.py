"""Find and call the C compiler, and choose its flags; identify the machine on which a library runs."""

from __future__ import annotations

import errno
import os
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import cache as remember
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.errors import BadValueError, BuildError
from gudgeon.loading.cache import Cache, compute_digest, get_default_cache
from gudgeon.loading.engine import build_include_flags
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess

# hint for messages
INSTALL_COMPILER = (
    "install one — Debian, Ubuntu: apt-get install gcc libc6-dev; Fedora: dnf install gcc; "
    "macOS: xcode-select --install; a wheel of 100 MB: pip install 'gudgeon[cc]' — or name it in $CC"
)

# -O2 with vectorized loops, which gcc before 12 has only from -O3 on. Statements outside loops are not vectorized: gcc
# 12 would combine the sum of one product with the difference of another.
# Never -ffast-math: it deletes the isnan tests. No contraction to fused multiply-adds, so that gcc and clang
# round alike. errno is not used after sqrt, and without it sqrt is one instruction.
FLAGS = (
    "-O2",
    "-fno-tree-slp-vectorize",
    "-ftree-loop-vectorize",
    "-std=c11",
    "-fPIC",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-Werror=implicit-function-declaration",  # else an undeclared function would be assumed to return int
)
# After these, for some units. The time loops are many small functions that are inlined into each other: a batch of dry
# presses takes 4 % less time, and 4 % less again by -O2 in place of -O1 for the rest. Formulas of lanes are long:
# instructions are scheduled over more than the processor's window (3 % of that batch).
UNIT_FLAGS = {
    "loops": ("-O3",),
    "lanes": ("-fschedule-insns", "-fschedule-insns2", "-fsched-pressure"),
}

GCC_FLAGS = frozenset(("-fno-tree-slp-vectorize", "-ftree-loop-vectorize"))  # flags that only gcc has
# For zig's clang: no run-time checks, which it adds without an optimization level, as for linking; and the baseline CPU
# in place of this machine's, which -march=native after it overrides.
ZIG_FLAGS = ("-fno-sanitize=undefined", "-mcpu=baseline")

# flags that change results, which $CC may not contain
INEXACT_FLAGS = frozenset(
    (
        "-ffast-math",
        "-Ofast",
        "-funsafe-math-optimizations",
        "-ffinite-math-only",
        "-fassociative-math",
        "-freciprocal-math",
        "-fno-signed-zeros",
    )
)
# messages of compilers on a full disk, and their error numbers
DISK_FULL_MESSAGES = {
    "No space left on device": errno.ENOSPC,
    "Disk quota exceeded": errno.EDQUOT,
    "File too large": errno.EFBIG,
    "File size limit exceeded": errno.EFBIG,
}


def build_flags(portable: bool, command: tuple[str, ...] = (), unoptimized: bool = False) -> tuple[str, ...]:
    """Return the compiler's flags for a command; `portable` leaves out those that bind the library to this CPU.

    unoptimized: no optimization (-O0); the compiler then needs a third of the time. Results are the same, since the
    order of sums is the same at every level. Zig and unoptimized compilations do not get GCC_FLAGS.
    """
    machine = os.uname().machine
    native = "-mcpu=native" if machine in ("arm64", "aarch64") else "-march=native"
    named: tuple[str, ...] = FLAGS
    if unoptimized or _is_zig(command):
        named = tuple(("-O0" if unoptimized and flag == "-O2" else flag) for flag in FLAGS if flag not in GCC_FLAGS)
    return (*named, *(() if portable else (native,)))


def _add_unit_flags(flags: tuple[str, ...], unit: str) -> tuple[str, ...]:
    """Return `flags` and the flags of UNIT_FLAGS for a unit: time loops ("loops"), lanes ("lanes"), scene code ("").

    They are added only to GCC's flags.
    """
    return (*flags, *(UNIT_FLAGS.get(unit, ()) if set(flags) >= GCC_FLAGS else ()))


def _is_zig(command: tuple[str, ...]) -> bool:
    """Return whether the compiler is zig's."""
    return bool(command) and Path(command[0]).name == "zig"


def build_link_flags() -> tuple[str, ...]:
    """Return the flags that make a shared library of object files."""
    return ("-dynamiclib",) if sys.platform == "darwin" else ("-shared",)


def find_compiler() -> tuple[str, ...]:
    """Return the compiler's command: $CC (may contain options), the first of cc, gcc, clang on PATH, or zig's.

    Raises BuildError if there is none, BadValueError for an invalid $CC.
    """
    import shlex
    import shutil

    try:
        named = shlex.split(os.environ.get("CC", ""))
    except ValueError as error:
        raise BadValueError(f"$CC is {os.environ['CC']!r}: {error}", hint="name a compiler, or unset it") from error
    if wrong := sorted(INEXACT_FLAGS.intersection(named)):
        hint = "leave it out: with it, NaN is not detected, and sums have another order"
        raise BadValueError(f"$CC has {', '.join(wrong)}", hint=hint)
    for command in [named] if named else [["cc"], ["gcc"], ["clang"]]:
        if program := shutil.which(command[0]):
            return (os.path.abspath(program), *command[1:])  # absolute, since it runs in other folders
    if not named:
        with suppress(ImportError):
            return (str(find_zig()), "cc", *ZIG_FLAGS)
    expected = f"the compiler in $CC, {named[0]!r}, was not found" if named else "no C compiler found (cc, gcc, clang)"
    raise BuildError(f"{expected}\n  {INSTALL_COMPILER}")


def has_compiler() -> bool:
    """Return whether there is a compiler."""
    try:
        return bool(find_compiler())
    except BuildError:
        return False


def find_zig() -> Path:
    """Return the path of the compiler zig from the package ziglang.

    Raise ImportError if it is not installed or executable.
    """
    import ziglang

    program = Path(ziglang.__file__).with_name("zig")
    if not os.access(program, os.X_OK):
        raise ImportError(f"{program} is not executable")
    return program


def describe_compiler(command: tuple[str, ...], cache: Cache) -> str:
    """Return compiler, version, machine and C library as text, for the cache keys of libraries.

    The version is cached on disk by path, size and time of every program in the command, since running it is slow.
    """
    import shutil

    programs = [os.path.realpath(program_path) for word in command if (program_path := shutil.which(word))]
    stats = [os.stat(program) for program in programs]
    key = compute_digest(
        [*command, *(f"{p} {s.st_size} {s.st_mtime_ns}" for p, s in zip(programs, stats, strict=True))]
    )
    entry = cache.fetch("compilers", key, lambda folder: _write_version(command, folder))
    return "\n".join([*command, (entry / "version").read_text(), *_describe_machine()])


def read_compiler_version() -> str:
    """Return the first line of the compiler's version; without a compiler, "none: the library came with gudgeon"."""
    try:
        command = find_compiler()
        return describe_compiler(command, get_default_cache()).split("\n")[len(command)]
    except BuildError:
        return "none: the library came with gudgeon"


def _write_version(command: tuple[str, ...], folder: Path) -> None:
    """Run the compiler and write its version into `folder`, as a cache entry. Raise BuildError if it cannot be run."""
    try:
        with Programs() as programs:
            answer, _ = programs.wait(programs.start([*command, "--version"], None, build_environment()))
    except OSError as error:
        raise BuildError(f"the compiler {' '.join(command)} cannot be run: {error}\n  {INSTALL_COMPILER}") from error
    (folder / "version").write_text(answer or "unknown")


def _describe_machine() -> tuple[str, ...]:
    """Return operating system, processor architecture and C library."""
    libc = os.confstr("CS_GNU_LIBC_VERSION") if "CS_GNU_LIBC_VERSION" in os.confstr_names else ""
    return sys.platform, os.uname().machine, libc or ""


@remember
def describe_cpu() -> str:
    """Return model and instruction sets of this machine's CPU as text, for keys of libraries that are not portable.

    The text is cached. On Linux it has lines of /proc/cpuinfo of the first core, on macOS the name of the processor.
    """
    if sys.platform == "darwin":
        import subprocess

        return subprocess.run(["sysctl", "-n", "machdep.cpu.brand_string"], capture_output=True, text=True).stdout
    expected = ("vendor_id", "cpu family", "model", "stepping", "flags", "CPU ", "Features")
    lines = []
    with open("/proc/cpuinfo", errors="replace") as file:
        for line in file:
            if not line.strip():
                break  # the first core represents all: reading hundreds of cores takes milliseconds
            if line.startswith(expected):
                lines.append(line.strip())
    return "\n".join(lines)


def build_environment() -> dict[str, str]:
    """Return the environment for the compiler: English messages, which are parsed, and zig's cache folder."""
    return {"ZIG_GLOBAL_CACHE_DIR": str(get_default_cache().root / "zig"), **os.environ, "LC_ALL": "C"}


def build_unit_command(
    portable: bool, files: Sequence[str], output_file: str, unoptimized: bool = False, unit: str = ""
) -> tuple[str, ...]:
    """Return the command line that compiles `files` to the object file `output_file`, with hidden symbols.

    `unit` adds flags as in `_add_unit_flags`; `unoptimized`: without optimization.
    """
    command = find_compiler()
    options = _add_unit_flags(build_flags(portable, command, unoptimized), unit)
    return (*command, *options, "-fvisibility=hidden", *build_include_flags(), "-c", *files, "-o", output_file)


def start_compiler(programs: Programs, command_line: Sequence[str], folder: Path) -> subprocess.Popen[str]:
    """Start a compiler in a folder, which also gets its temporary files; return the process.

    Raise BuildError if it cannot run.
    """
    environment = {**build_environment(), "TMPDIR": str(folder)}  # its temporary files are removed with the folder
    try:
        return programs.start([*command_line], folder, environment)
    except OSError as error:
        raise BuildError(f"the compiler {command_line[0]} cannot be run: {error}\n  {INSTALL_COMPILER}") from error


def wait_for_compiler(programs: Programs, process: subprocess.Popen[str], output_file: Path) -> Exception | None:
    """Wait for a compiler; return None if it wrote `output_file`, else the error.

    The error is an OSError for a full disk or file-size limit, so that another folder is tried; else BuildError with
    its first lines.
    """
    out, err = programs.wait(process)
    if process.returncode == 0 and output_file.is_file():
        return None
    specified = (err or out).strip()
    for text, code in DISK_FULL_MESSAGES.items():
        if text in specified:
            return OSError(code, f"the compiler reported: {text}")
    if process.returncode == -signal.SIGXFSZ:
        return OSError(errno.EFBIG, "the compiler was stopped by a limit on the size of files (ulimit -f)")
    first = "\n  ".join(specified.splitlines()[:8]) or "it printed nothing"
    line = " ".join(map(str, process.args))  # type: ignore[arg-type]
    message = f"failed (exit status {process.returncode})"
    if process.returncode == 0:
        message = f"ended without an error, but did not write {output_file.name}"
    return BuildError(f"the C compiler {message}:\n  {first}\n  called as {line}")
