"""Where the command `gudgeon` begins: Ctrl-C, SIGTERM and a standard output that takes nothing are told in a word.

SIGTERM, with which batch systems and `timeout` end a program, and SIGHUP, with which a terminal that is closed does,
are answered as Ctrl-C is: what was computed is saved, and no compiler is left behind.
"""

from __future__ import annotations

import codecs
import errno
import gc
import os
import signal
import sys

from gudgeon.waiting.ctrl_c import ENDING, INTERRUPTED, is_the_program, last_word, nothing_more

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


def main() -> None:
    """The entry point of the command `gudgeon`."""
    _streams()
    is_the_program()
    os.environ["MPLBACKEND"] = "agg"  # nothing is shown in a window, whatever is set
    ended: list[int] = []

    def terminate(number: int, _: object) -> None:
        ended.append(number)
        signal.raise_signal(signal.SIGINT)

    for number in ENDING:
        if signal.getsignal(number) is signal.SIG_DFL and callable(signal.getsignal(signal.SIGINT)):
            signal.signal(number, terminate)
    try:
        _run()
    except SystemExit as end:
        nothing_more()  # a command that says itself what an interrupt left ends here too
        sys.exit(128 + ended[0] if ended and end.code == INTERRUPTED else end.code)


def _run() -> None:
    try:
        from gudgeon.cli import main

        try:
            main()
        finally:
            sys.stdout.flush()
            gc.freeze()  # the process ends: what is left need not be looked through for garbage before that
    except KeyboardInterrupt:
        last_word()
        sys.exit(INTERRUPTED)
    except OSError as error:
        if error.filename is not None or error.errno not in (*FULL, errno.EPIPE):
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is still to be written goes nowhere
        if error.errno != errno.EPIPE:  # a reader that has enough needs no word
            print(f"error: cannot write standard output: {error.strerror}", file=sys.stderr)
        sys.exit(1)


def _streams() -> None:
    """One that is closed leads nowhere, lest a file take its number; what its encoding lacks is escaped."""
    codecs.register_error("gudgeon", _escaped)
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w" if number else "r"))  # noqa: SIM115
        elif number and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="gudgeon")


def _escaped(error: UnicodeError) -> tuple[str, int]:
    """Characters as JSON has them, so that a document stays one."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    units = error.object[error.start : error.end].encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[k]:02x}{units[k + 1]:02x}" for k in range(0, len(units), 2)), error.end
