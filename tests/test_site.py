"""The documentation's pages as a site, without those of the gallery that run: no warning, and every page is there."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_the_site_is_built_without_a_warning(tmp_path: Path) -> None:
    line = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-t", "text", "-b", "html"]
    line += map(str, ("-d", tmp_path / "kept", ROOT / "docs", tmp_path))
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    pages = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in (ROOT / "docs").rglob("*.md")}
    assert all((tmp_path / page).is_file() for page in pages)
    reference = (tmp_path / "reference.html").read_text(encoding="utf-8")
    assert 'id="gudgeon.load"' in reference and 'id="gudgeon.simulation.simulation.Simulation.simulate"' in reference
