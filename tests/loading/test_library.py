"""What Python knows of a library's functions: declarations as cffi reads them, kept in a file that follows calls.h."""

from __future__ import annotations

import importlib.util
import os
import re
from pathlib import Path

import pytest
from cffi import FFI

import gudgeon
from gudgeon.loading import declared, library
from gudgeon.loading.engine import list_all_declarations, select_declarations
from tests.programs import needs_compiler

ROOT = Path(__file__).resolve().parents[2]


def test_what_is_kept_is_what_cffi_makes_of_the_engines_declarations() -> None:
    """Of the file's own text, and of types and fields as cffi's parser sees them."""
    spec = importlib.util.spec_from_file_location("declared_tool", ROOT / "tools" / "declared.py")
    assert spec is not None and spec.loader is not None
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    for path, text in tool.FILES.items():
        assert path.read_text(encoding="utf-8") == text(), path
    parsed = FFI()
    parsed.cdef(list_all_declarations())
    kept, message = declared.ffi.typeof("Batch"), parsed.typeof("Batch")
    assert [(name, field.offset, field.type.cname) for name, field in kept.fields] == [
        (name, field.offset, field.type.cname) for name, field in message.fields
    ]


@needs_compiler
@pytest.mark.parametrize("scene", ["pendulum", "four_bar"])
def test_a_library_has_what_is_declared_and_misses_the_rest(scene: str) -> None:
    simulation = gudgeon.load(scene)
    lib = simulation.compiled.lib
    expected = set(re.findall(r"\b(gudgeon_\w+)\(", select_declarations(simulation.source)))
    every = set(re.findall(r"\b(gudgeon_\w+)\(", list_all_declarations()))
    assert expected < every and {name for name in every if hasattr(lib, name)} == expected
    with pytest.raises(AttributeError, match="gudgeon_driven_loops"):
        lib.gudgeon_driven_loops  # noqa: B018


@needs_compiler
def test_a_path_that_is_no_utf8_cannot_be_opened(tmp_path: Path) -> None:
    """Told as what cannot be mapped is: the library is opened from another folder then."""
    compiled = gudgeon.load("pendulum").compiled
    file = next(each.file for each in _libraries() if each.lib is compiled.lib)
    there = tmp_path / os.fsdecode(b"x\xff.so")
    there.write_bytes(file.read_bytes())
    with pytest.raises(ImportError):
        library.open_library(there)


@needs_compiler
def test_declarations_that_are_being_edited_are_parsed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not called as they were before."""
    compiled = gudgeon.load("pendulum").compiled
    file = next(each.file for each in _libraries() if each.lib is compiled.lib)
    monkeypatch.setattr(declared, "SHA256", "another")
    library._get_engine_interface.cache_clear()
    try:
        parsed = library.open_library(file)
    finally:
        monkeypatch.undo()
        library._get_engine_interface.cache_clear()
    assert parsed.ffi is not declared.ffi and compiled.ffi is declared.ffi
    for name in ("gudgeon_ensemble", "gudgeon_evaluate"):
        kept, message = (each.ffi.typeof(getattr(each.lib, name)).cname for each in (compiled, parsed))
        assert kept == message


def _libraries() -> list[library.Library]:
    from gudgeon.loading.build import _libraries

    return list(_libraries.values())
