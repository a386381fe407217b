"""What cffi makes of the engine's declarations, as runtime/loading/declared.py (run by `make generated`)."""

from __future__ import annotations

import ast
import tempfile
import textwrap
from pathlib import Path

from cffi import FFI

from gudgeon.loading.cache import digest
from gudgeon.loading.engine import all_declarations

FILE = Path(__file__).resolve().parent.parent / "runtime" / "loading" / "declared.py"
HEAD = '''"""What cffi makes of the engine's declarations: written by tools/declared.py (`make generated`)."""

from _cffi_backend import FFI

OF = "{of}"  # SHA-256 of these declarations
ffi = FFI(
    "gudgeon",
'''
WIDTH = 112


def text() -> str:
    """The file."""
    declarations = all_declarations()
    lines = [HEAD.format(of=digest([declarations]))]
    for name, value in _arguments(declarations).items():
        if isinstance(value, tuple):
            entries = "".join(f"        {_printed(entry)},\n" for entry in value)
            lines.append(f"    {name}=(\n{entries}    ),\n")
        elif isinstance(value, bytes):
            rows = "".join(f'        "{row}"\n' for row in textwrap.wrap(value.hex(), WIDTH - 4))
            lines.append(f"    {name}=bytes.fromhex(\n{rows}    ),\n")
        else:
            lines.append(f"    {name}={value:#06x},\n")
    return "".join([*lines, ")\n"])


def _arguments(declarations: str) -> dict[str, object]:
    """What cffi's own module for these declarations hands to FFI, by keyword."""
    ffi = FFI()
    ffi.cdef(declarations)
    ffi.set_source("gudgeon", None, compiler_verbose=0)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "module.py")
        ffi.emit_python_code(str(file))
        tree = ast.parse(file.read_text(encoding="utf-8"))
    (call,) = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    return {str(keyword.arg): ast.literal_eval(keyword.value) for keyword in call.keywords}


def _printed(entry: object) -> str:
    """Bytes, a number, or a tuple of bytes, in lines of the house's width."""
    if not isinstance(entry, tuple):
        return _literal(entry)
    whole = f"({', '.join(map(_literal, entry))},)"
    if len(whole) <= WIDTH:
        return whole
    return "(\n" + "".join(f"            {_literal(part)},\n" for part in entry) + "        )"


def _literal(value: object) -> str:
    return repr(value) if not isinstance(value, bytes) else 'b"' + repr(value)[2:-1].replace('"', "\\x22") + '"'


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
