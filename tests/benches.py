"""Imported for what it does: `benchmarks` becomes a package by name, for the root stays off sys.path."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import sys
from pathlib import Path

if "benchmarks" not in sys.modules:
    spec = importlib.machinery.ModuleSpec("benchmarks", None, is_package=True)
    spec.submodule_search_locations = [str(Path(__file__).resolve().parents[1] / "benchmarks")]
    sys.modules["benchmarks"] = importlib.util.module_from_spec(spec)
