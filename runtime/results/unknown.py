"""Names that a scene's results do not have: why, and the nearest that there are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import UnknownNameError
from gudgeon.language.suggestions import near
from gudgeon.language.wanted import told
from gudgeon.results.series import MASSLESS_HINT, catalogue, missing, without_masses

if TYPE_CHECKING:
    from gudgeon.results.series import Series


def unknown_series(
    source: KernelSource, known: Mapping[str, Series], name: Any, parameters: Iterable[str]
) -> UnknownNameError:
    """The error for a name that `known`, the results of a scene, does not have; it names the nearest."""
    if not isinstance(name, str):
        return UnknownNameError(f"nothing is named {told(name)}", hint="a name is a text: run.names lists all")
    if name in parameters:
        alike = ", ".join(path for path in known if path.rpartition(".")[2] == name)
        hint = f'its value is run.parameters["{name}"]' + (f"; series: {alike}" if alike else "")
        return UnknownNameError(f"{name!r} is a parameter, no series", hint=hint)
    if name in source.outputs:
        lacking = ", ".join(missing(source, source.outputs[name], known))
        hint = "a joint's play, contact and reaction have results only in the scenes that have them"
        hint = MASSLESS_HINT if source.massless else hint
        return UnknownNameError(f"output {name!r} needs {lacking}, which scene {source.scene!r} lacks", hint=hint)
    if (why := without_masses(source)) and name in catalogue(replace(source, massless=())):
        return UnknownNameError(f"{name!r} is not known: {why}", hint=MASSLESS_HINT)
    found = near(name, known)
    hint = f"nearest: {', '.join(found)}" if found else "run.names lists all names"
    return UnknownNameError(f"the scene {source.scene!r} has nothing named {name!r}", hint=hint)


def check_series(source: KernelSource, names: Iterable[Any]) -> tuple[str, ...]:
    """Names of series of a scene, each once. Raises UnknownNameError."""
    known, wanted = catalogue(source), list(names)
    for name in wanted:
        if not isinstance(name, str) or name not in known:
            raise unknown_series(source, known, name, parameter_names(source))
    return tuple(dict.fromkeys(wanted))


def parameter_names(source: KernelSource) -> set[str]:
    """Addresses of a scene's numbers, of parameters their short names too."""
    addresses = {slot.address for slot in source.slots}
    return addresses | {address.removeprefix("parameters.") for address in addresses}
