"""Write the declarations of the engine's headers for Python and JavaScript (run by `make generated`).

- runtime/loading/declared.py: cffi's tables of the functions in engine/scene/calls.h
- runtime/contract/boundary.py and runtime/web/boundary.js: the names of engine/boundary.h
"""

from __future__ import annotations

import ast
import json
import re
import tempfile
import textwrap
from pathlib import Path

from cffi import FFI

from gudgeon.loading.cache import compute_digest
from gudgeon.loading.engine import list_all_declarations

ROOT = Path(__file__).resolve().parent.parent
BOUNDARY = ROOT / "engine" / "boundary.h"
HEAD = '''"""Declarations of the engine's functions, parsed by cffi: written by tools/declared.py (`make generated`)."""

from _cffi_backend import FFI

SHA256 = "{of}"  # SHA-256 of these declarations
ffi = FFI(
    "gudgeon",
'''
WIDTH, LINE = 112, 120
IN_JAVASCRIPT = ("Status", "Capacity", "Count", "Residual", "Peak", "ImpactColumn", "Work")


def make_ffi_module() -> str:
    """Return the text of runtime/loading/declared.py."""
    declarations = list_all_declarations()
    lines = [HEAD.format(of=compute_digest([declarations]))]
    for name, value in _find_ffi_arguments(declarations).items():
        if isinstance(value, tuple):
            entries = "".join(f"        {_format_entry(entry)},\n" for entry in value)
            whole = f"    {name}=({_format_entry(value[0])},),\n" if len(value) == 1 else ""
            lines.append(whole if 0 < len(whole) <= LINE else f"    {name}=(\n{entries}    ),\n")
        elif isinstance(value, bytes):
            rows = "".join(f'        "{row}"\n' for row in textwrap.wrap(value.hex(), WIDTH - 4))
            lines.append(f"    {name}=bytes.fromhex(\n{rows}    ),\n")
        else:
            lines.append(f"    {name}={value:#06x},\n")
    return "".join([*lines, ")\n"])


def read_enumerations() -> dict[str, dict[str, int]]:
    """Return the enumerators of each enumeration of engine/boundary.h, by increasing value."""
    text = BOUNDARY.read_text(encoding="utf-8")
    ffi = FFI()
    ffi.cdef("".join(f"{line}\n" for line in text.splitlines() if not line.startswith("#")))
    tags = re.findall(r"^enum (\w+)", text, re.MULTILINE)
    members = {name: ffi.typeof(f"enum {name}").relements for name in tags}
    return {name: dict(sorted(values.items(), key=lambda member: member[1])) for name, values in members.items()}


def read_constants() -> dict[str, str]:
    """Return the floating-point constants of engine/boundary.h."""
    return dict(re.findall(r"^#define (\w+) ([-+.\de]+)$", BOUNDARY.read_text(encoding="utf-8"), re.MULTILINE))


def list_column_names(members: dict[str, int]) -> list[str]:
    """Return the names of an enumeration of columns without their prefix; [] for any other enumeration.

    The last enumerator of an enumeration of columns is their number, N_….
    """
    *names, last = members
    return [name.split("_", 1)[1] for name in names] if last.startswith("N_") else []


def make_python_boundary() -> str:
    """Return the text of runtime/contract/boundary.py."""
    lines = ['"""Constants of engine/boundary.h for Python: written by tools/declared.py."""', ""]
    lines += ["from typing import Final", "", *(f"{name}: Final = {value}" for name, value in read_constants().items())]
    for name, members in read_enumerations().items():
        lines += ["", f"# enum {name}", *(f"{member}: Final = {value}" for member, value in members.items())]
        if names := list_column_names(members):
            whole = f"{_list_name(name)} = ({', '.join(f'{one!r}' for one in names)})".replace("'", '"')
            rows = [f"{_list_name(name)} = (", *(f'    "{one}",' for one in names), ")"]
            lines += [whole] if len(names) > 1 and len(whole) <= LINE else rows
    return "\n".join([*lines, ""])


def make_javascript_boundary() -> str:
    """Return the text of runtime/web/boundary.js.

    It has the names that scripts of the folder use, and counts of columns.
    """
    lines = ["/* Constants of engine/boundary.h for JavaScript: written by tools/declared.py. */"]
    lines += ["const Boundary = {"]
    known, web = read_enumerations(), ROOT / "runtime" / "web"
    scripts = "".join(file.read_text(encoding="utf-8") for file in sorted(web.glob("*.js")))
    used = set(re.findall(r"\bBoundary\.(\w+)", scripts))
    used.update(*(re.findall(r"\w+", several) for several in re.findall(r"{([^{}]*)} = Boundary\b", scripts)))
    for name in IN_JAVASCRIPT:
        names, message = list_column_names(known[name]), dict[str, object](known[name])
        if names:
            message = {list(known[name])[-1]: len(names), _list_name(name): names}
        lines += [f"    {member}: {json.dumps(value)}," for member, value in message.items() if member in used]
    return "\n".join([*lines, "};", ""])


def _list_name(name: str) -> str:
    """Return the name of the list of an enumeration's names: IMPACT_COLUMN_NAMES for ImpactColumn."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).upper() + "_NAMES"


def _find_ffi_arguments(declarations: str) -> dict[str, object]:
    """Return the keyword arguments that cffi's generated module for these declarations passes to FFI."""
    ffi = FFI()
    ffi.cdef(declarations)
    ffi.set_source("gudgeon", None, compiler_verbose=0)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "module.py")
        ffi.emit_python_code(str(file))
        tree = ast.parse(file.read_text(encoding="utf-8"))
    (call,) = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    return {str(keyword.arg): ast.literal_eval(keyword.value) for keyword in call.keywords}


def _format_entry(entry: object) -> str:
    """Return bytes, a number, or a tuple of bytes as Python code in lines of at most WIDTH columns."""
    if not isinstance(entry, tuple):
        return _format_literal(entry)
    whole = f"({', '.join(map(_format_literal, entry))},)"
    if len(whole) <= WIDTH:
        return whole
    return "(\n" + "".join(f"            {_format_literal(part)},\n" for part in entry) + "        )"


def _format_literal(value: object) -> str:
    """Return a value as a Python literal; bytes in double quotes."""
    return repr(value) if not isinstance(value, bytes) else 'b"' + repr(value)[2:-1].replace('"', "\\x22") + '"'


FILES = {
    ROOT / "runtime" / "loading" / "declared.py": make_ffi_module,
    ROOT / "runtime" / "contract" / "boundary.py": make_python_boundary,
    ROOT / "runtime" / "web" / "boundary.js": make_javascript_boundary,
}

if __name__ == "__main__":
    for path, text in FILES.items():
        path.write_text(text(), encoding="utf-8")
