"""Packages that are imported late, each wholly: one that Ctrl-C left half imported would fail until Python ends."""

from __future__ import annotations

from importlib import import_module

from gudgeon.waiting.ctrl_c import CtrlC

RUNTIME = ("numpy", "gudgeon.simulation.simulation")
GENERATOR = ("numpy", "mpmath", "sympy", "pydantic", "jinja2", "ruamel.yaml", "gudgeon.generator.pipeline")
CFFI = ("cffi", "pycparser", "cffi.cparser", "cffi.recompiler")
SPARSE = ("numpy", "scipy.sparse", "scipy.sparse.linalg")


def whole(*names: str) -> None:
    """Import modules; Ctrl-C is raised between two of them."""
    for name in names:
        with CtrlC() as ctrl_c:
            import_module(name)
        ctrl_c.take()
