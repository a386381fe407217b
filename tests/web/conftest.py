"""Fixtures of the tests of pages."""

from tests.web.chromium import chromium, opened, press

__all__ = ["chromium", "opened", "press"]
