"""The documentation's pages as a site, without those of the gallery that run: no warning, all pages, the search."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.web.node import needs_node, node

ROOT = Path(__file__).parents[1]
TERMS: dict[str, list[str]] = tomllib.loads((ROOT / "docs/search_terms.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the site."""
    folder = tmp_path_factory.mktemp("site")
    line = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-t", "text", "-b", "html"]
    line += map(str, ("-d", folder / "kept", ROOT / "docs", folder))
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder


def test_the_site_is_built_without_a_warning(site: Path) -> None:
    pages = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in (ROOT / "docs").rglob("*.md")}
    assert all((site / page).is_file() for page in pages)
    reference = (site / "reference.html").read_text(encoding="utf-8")
    assert 'id="gudgeon.load"' in reference and 'id="gudgeon.simulation.simulation.Simulation.simulate"' in reference


def test_links_between_pages_stay_links(site: Path) -> None:
    """Links to files of the sources become text, links to pages in other folders do not."""
    recipes = (site / "recipes/index.html").read_text(encoding="utf-8")
    assert 'href="../tutorials/adding_a_law.html"' in recipes and 'href="../contributing.html"' in recipes
    contributing = (site / "contributing.html").read_text(encoding="utf-8")
    assert 'href="recipes/law.html"' in contributing and "engine/README" not in contributing


@needs_node
def test_the_search_shows_the_right_page_first(site: Path) -> None:
    """Terms of the field, by Sphinx's own script; a page that is renamed has both names in search_terms.toml."""
    assert len(TERMS) >= 40
    line = [str(node()), str(ROOT / "tests/search.js"), str(site), *TERMS]
    found = json.loads(subprocess.run(line, capture_output=True, text=True, check=True).stdout)
    first = {term: pages[0] if pages else "nothing" for term, pages in zip(TERMS, found, strict=True)}
    assert {term: page for term, page in first.items() if page not in TERMS[term]} == {}


@needs_node
@pytest.mark.parametrize(
    ("query", "page"),
    [
        ("restitution", ("physics", "limits", "laws")),
        ("how to install", ("installing",)),
        ("tolerance", ("methods", "error_control")),
        ("lyapunov", ("predictability", "methods")),
        ("add a joint", ("recipes/joint",)),
        ("hertz", ("laws", "physics")),
    ],
)
def test_parts_of_terms_find_pages_too(site: Path, query: str, page: tuple[str, ...]) -> None:
    """Within the first five."""
    line = [str(node()), str(ROOT / "tests/search.js"), str(site), query]
    (found,) = json.loads(subprocess.run(line, capture_output=True, text=True, check=True).stdout)
    assert set(found) & set(page), found


def test_formulas_are_mathml_and_no_page_loads_a_script_from_elsewhere(site: Path) -> None:
    laws = (site / "laws.html").read_text(encoding="utf-8")
    assert laws.count('<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">') >= 30
    for page in site.rglob("*.html"):
        assert not re.search(r"<script[^>]*src=\"(https?:)?//", page.read_text(encoding="utf-8")), page
