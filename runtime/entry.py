"""Where the command `gudgeon` begins: Ctrl-C is told in a word, also while its command line is imported."""

from __future__ import annotations

import sys


def main() -> None:
    """The entry point of the command `gudgeon`."""
    try:
        from gudgeon.cli import main

        main()
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        sys.exit(130)
