"""Fixtures of the tests of pages."""

from tests.web.chromium import chromium, opened, opened_once, press

__all__ = ["chromium", "opened", "opened_once", "press"]
