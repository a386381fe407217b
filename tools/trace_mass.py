"""Print the functions that pass on the mass of a body, from reading the YAML file to the mass matrix.

usage: .venv/bin/python tools/trace_mass.py
A function passes it on if it returns the value in any form: text, token, tree, quantity, symbol.
Functions that only read it are counted.
"""

from __future__ import annotations

import sys
from types import FrameType
from typing import Any

import sympy as sp

from gudgeon.generator.equations.model import make_model
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.reader.read import read_scene
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.language.tokens import Token
from gudgeon.language.tree import Number
from gudgeon.loading.kernel_sources import find_mechanism, read_bytes

FILE, ADDRESS, SYMBOL = "slider_crank", "bodies.crank.mass", "crank_mass_"
WRITTEN, MARKED, VALUE = b"0.3 kg", "0.31415 kg", 0.31415
FLOAT = sp.Float(VALUE, 17)


def is_mass(value: Any) -> bool:
    """Return whether a value is the mass in one of its forms."""
    match value:
        case str():
            return value == MARKED
        case float() | sp.Float():
            return value in (VALUE, FLOAT)
        case Number():
            return value.value == VALUE
        case Token():
            return value.text == MARKED
        case Quantity() | ParameterEntry():
            return value.address == ADDRESS
        case sp.Symbol():
            return value.name == SYMBOL
    return isinstance(value, tuple) and any(map(is_mass, value))


def main() -> None:
    """Read a scene, derive its equations, and print the functions that pass the mass on."""
    file = find_mechanism(FILE)
    data = read_bytes(file).replace(WRITTEN, MARKED.encode(), 1)
    passed: dict[str, int] = {}
    read: set[str] = set()

    def profile(frame: FrameType, event: str, value: Any) -> None:
        """Record a function that returns the mass or reads it; a callback of sys.setprofile."""
        module, function = frame.f_globals.get("__name__", ""), frame.f_code.co_qualname
        if module.startswith("gudgeon.") and not function.endswith(">"):
            name = f"{module.removeprefix('gudgeon.')}: {function}"
            if event == "return" and is_mass(value):
                passed[name] = passed.get(name, 0) + 1
            elif event == "return" and any(map(is_mass, list(frame.f_locals.values()))):
                read.add(name)

    def derive() -> Any:
        """Derive the masses of the scene."""
        return make_model(read_scene(data, str(file), "ideal")).masses

    derive()  # completes deferred imports
    sys.setprofile(profile)
    derive()
    sys.setprofile(None)
    for name, count in passed.items():
        print(f"{count:3} {name}")
    packages = {name.partition(":")[0].rpartition(".")[0] for name in passed}
    print(f"{len(passed)} functions return it {sum(passed.values())} times, {len(packages)} packages;", end=" ")
    print(f"{len(read - passed.keys())} more read it")


if __name__ == "__main__":
    main()
