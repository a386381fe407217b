"""The list of commands in `gudgeon --help`."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup

WHOLE = 1000  # letters: more than any sentence has


class Commands(TyperGroup):
    """Of each its first sentence, whole, which may be lines long; typer cuts it where a line ends."""

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Writes the section."""
        every = ((name, self.get_command(ctx, name)) for name in self.list_commands(ctx))
        told = [(name, one.get_short_help_str(WHOLE)) for name, one in every if one and not one.hidden]
        with formatter.section("Commands"):
            formatter.write_dl(told)
