"""How large a file may be that is read."""

from __future__ import annotations

MAX_BYTES = 1 << 20  # of a mechanism file
