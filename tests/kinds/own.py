"""Laws of one's own for tests: the example of docs/describing.md, and a registry that forgets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from gudgeon.generator.kinds.laws.law import USER_LAWS
from gudgeon.generator.kinds.laws.registered import ORIGINS

PAGE = Path(__file__).parents[2] / "docs/describing.md"


def example_text() -> str:
    """dashpot.py, as it is printed there."""
    (block,) = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return str(block)


def example(folder: Path) -> Path:
    """dashpot.py in a folder."""
    (folder / "dashpot.py").write_text(example_text(), encoding="utf-8")
    return folder / "dashpot.py"


@contextmanager
def forgotten() -> Iterator[None]:
    """Whatever is registered within is forgotten afterwards."""
    laws, origins = dict(USER_LAWS), dict(ORIGINS)
    try:
        yield
    finally:
        USER_LAWS.clear()
        USER_LAWS.update(laws)
        ORIGINS.clear()
        ORIGINS.update(origins)
