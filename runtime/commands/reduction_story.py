"""How a scene's equations became what is integrated, as `check -v` shows it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.ledger import Story
from gudgeon.contract.ledger_words import ledger_lines, outcome

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text


def tell(
    scenes: Mapping[str, KernelSource], rest: Callable[[KernelSource], Iterable[tuple[str, str]]]
) -> Iterator[Text | Table]:
    """Scene by scene the ledger, what it comes to, and `rest` below; of a ledger told before what differs."""
    from rich.text import Text

    known: list[tuple[str, list[tuple[int, int, str]], list[tuple[str, str]]]] = []
    for scene, source in scenes.items():
        ledger, lines = list(ledger_lines(source)), [*outcome(source), *rest(source)]
        same = next((other for other in known if other[1] == ledger), None)
        if same:
            lines = [line for line in lines if line not in same[2]]
            yield Text(f"scene {scene}: as {same[0]}{', but' if lines else ''}", style="bold")
        else:
            known.append((scene, ledger, lines))
            yield Text(f"scene {scene}", style="bold")
        yield _table([] if same else ledger, lines)


def _table(ledger: Sequence[tuple[int, int, str]], lines: Iterable[tuple[str, str]]) -> Table:
    """Without rules; the ledger's columns are as wide in a table without one."""
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, show_header=bool(ledger))
    for name in ("coordinates", "rows"):
        table.add_column(name, justify="right", no_wrap=True, min_width=len(name))
    table.add_column()
    for n, m, text in ledger:
        table.add_row(f"{n:,}", f"{m:,}", Text(text))
    for name, text in lines:
        table.add_row(name, "", Text(text))
    table.add_row()
    return table


def story_data(story: Story) -> dict[str, Any]:
    """For scripts: the story, with the coordinates and rows that each step leaves."""
    left = [{"coordinates left": n, "rows left": m} for _, n, m in story.ledger()]
    data = asdict(story)
    data["steps"] = [step | counts for step, counts in zip(data["steps"], left, strict=True)]
    return data
