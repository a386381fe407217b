"""How large a file may be that is read."""

from __future__ import annotations

MAX_BYTES = 1 << 20  # of a mechanism file
MAX_TABLE_BYTES = 1 << 26  # of a table that a curve is read from: a million points and more
