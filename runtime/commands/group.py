"""The commands of `gudgeon` together: which of them are made, and their list in `gudgeon --help`."""

from __future__ import annotations

import sys
from copy import copy
from typing import Any

from typer import Typer
from typer.core import TyperGroup
from typer.models import CommandInfo

WHOLE = 1000  # letters: more than any sentence has


class Commands(TyperGroup):
    """Of each its first sentence, whole, which may be lines long; typer cuts it where a line ends."""

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Writes the section."""
        every = ((name, self.get_command(ctx, name)) for name in self.list_commands(ctx))
        told = [(name, one.get_short_help_str(WHOLE)) for name, one in every if one and not one.hidden]
        with formatter.section("Commands"):
            formatter.write_dl(told)


def name_of(one: CommandInfo) -> str:
    """What is typed to call it."""
    return str(one.name or getattr(one.callback, "__name__", ""))


def asked_for(app: Typer) -> Typer:
    """Of a command line that begins with one of the commands that one alone: to read all options takes 30 ms."""
    named = [one for one in app.registered_commands if sys.argv[1:2] == [name_of(one)]]
    alone = copy(app)
    alone.registered_commands = named or app.registered_commands
    return alone
