"""Start the command `gudgeon`: handle Ctrl-C, SIGTERM, SIGHUP and a broken standard output with short messages.

SIGTERM (from batch systems and `timeout`) and SIGHUP (from a closed terminal) are treated as Ctrl-C: computed results
are saved, and no compiler is left running.
"""

from __future__ import annotations

import codecs
import errno
import gc
import os
import signal
import sys

from gudgeon.waiting.ctrl_c import ENDING, INTERRUPTED, declare_program, ignore_ctrl_c, print_interrupted

WRITE_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)  # of standard output, reported in one line


def main() -> None:
    """Run the command `gudgeon`, as its entry point, and exit with its code.

    SIGTERM and SIGHUP are treated as Ctrl-C and give the exit code 128 + number, unless their default action was
    changed before. Matplotlib opens no windows.
    """
    _prepare_streams()
    declare_program()
    os.environ["MPLBACKEND"] = "agg"  # matplotlib opens no windows
    ended: list[int] = []

    def terminate(number: int, _: object) -> None:
        """Record a signal and treat it as Ctrl-C."""
        ended.append(number)
        signal.raise_signal(signal.SIGINT)

    for number in ENDING:
        if signal.getsignal(number) is signal.SIG_DFL and callable(signal.getsignal(signal.SIGINT)):
            signal.signal(number, terminate)
    try:
        _run_command()
    except SystemExit as end:
        ignore_ctrl_c()  # the command has already reported the interruption
        sys.exit(128 + ended[0] if ended and end.code == INTERRUPTED else end.code)


def _run_command() -> None:
    """Run the command line; exit with a short message after Ctrl-C or an error of standard output.

    The exit code is INTERRUPTED after Ctrl-C and 1 after an error of standard output. A reader that closes the pipe
    early gets no message. Other errors are passed on.
    """
    try:
        from gudgeon.cli import main

        try:
            main()
        finally:
            sys.stdout.flush()
            gc.freeze()  # the process ends: no need to search for garbage
    except KeyboardInterrupt:
        print_interrupted()
        sys.exit(INTERRUPTED)
    except OSError as error:
        if error.filename is not None or error.errno not in (*WRITE_ERRORS, errno.EPIPE):
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # discards the rest of the output
        if error.errno != errno.EPIPE:  # no message if the reader closed the pipe
            print(f"error: cannot write standard output: {error.strerror}", file=sys.stderr)
        sys.exit(1)


def _prepare_streams() -> None:
    """Replace closed standard streams by the null device; escape characters of output that its encoding lacks.

    Called once at the start of the process.
    """
    codecs.register_error("gudgeon", _escape_as_json)
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w" if number else "r"))  # noqa: SIM115
        elif number and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="gudgeon")


def _escape_as_json(error: UnicodeError) -> tuple[str, int]:
    """Return JSON escapes (\\u03a6) for characters that cannot be encoded, and the position after them.

    An error handler for codecs.register_error: a JSON document stays valid. Errors of decoding are raised.
    """
    if not isinstance(error, UnicodeEncodeError):
        raise error
    units = error.object[error.start : error.end].encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[k]:02x}{units[k + 1]:02x}" for k in range(0, len(units), 2)), error.end
