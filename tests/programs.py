"""Programs that some tests need: without them they are skipped; where CI runs, which has them all, they fail."""

from __future__ import annotations

import os
import shutil
from typing import Any

import pytest

needs_compiler = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")


def missing(message: str) -> Any:
    """A skip; where CI runs a failure."""
    return pytest.fail(message) if os.environ.get("CI") else pytest.skip(message)
