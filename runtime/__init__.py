"""gudgeon: planar linkages whose joints may have play, from YAML to a compiled simulator.

    >>> import gudgeon
    >>> engine = gudgeon.load("engine.yaml", scene="worn")
    >>> run = engine.simulate(t_end=1.0, output=1000)

Names are imported when they are first asked for (PEP 562): `import gudgeon` alone costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False  # type checkers take it for true; `typing` would double the time of this import
if TYPE_CHECKING:
    from gudgeon.errors import (
        AssemblyError,
        AuditError,
        BuildError,
        CacheError,
        GudgeonError,
        InputError,
        NonFiniteError,
        OutputError,
        SingularError,
        SolverError,
    )
    from gudgeon.exchange.fmu import write_fmu
    from gudgeon.generator.kinds.laws.registered import register
    from gudgeon.results.batch import Batch
    from gudgeon.results.files.export import join
    from gudgeon.results.results import Result
    from gudgeon.simulation.examine import examine
    from gudgeon.simulation.from_file import load
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.simulation.wear import wear
    from gudgeon.simulation.wear_loop import wear_loop
    from gudgeon.studies.ensemble.finished import Study
    from gudgeon.studies.ensemble.study import load_study, study

__version__ = "0.1.0"

_HOME = {
    "load": "simulation.from_file",
    "examine": "simulation.examine",
    "wear": "simulation.wear",
    "wear_loop": "simulation.wear_loop",
    "join": "results.files.export",
    "write_fmu": "exchange.fmu",
    "register": "generator.kinds.laws.registered",
    "study": "studies.ensemble.study",
    "load_study": "studies.ensemble.study",
    "Study": "studies.ensemble.finished",
    "Simulation": "simulation.simulation",
    "Result": "results.results",
    "Batch": "results.batch",
    "GudgeonError": "errors",
    "InputError": "errors",
    "AssemblyError": "errors",
    "AuditError": "errors",
    "SolverError": "errors",
    "SingularError": "errors",
    "NonFiniteError": "errors",
    "BuildError": "errors",
    "CacheError": "errors",
    "OutputError": "errors",
}  # public name -> module of its owner

__all__ = [
    "AssemblyError",
    "AuditError",
    "Batch",
    "BuildError",
    "CacheError",
    "GudgeonError",
    "InputError",
    "NonFiniteError",
    "OutputError",
    "Result",
    "Simulation",
    "SingularError",
    "SolverError",
    "Study",
    "__version__",
    "examine",
    "join",
    "load",
    "load_study",
    "register",
    "study",
    "wear",
    "wear_loop",
    "write_fmu",
]


def __getattr__(name: str) -> object:
    """Import a public name of gudgeon at its first use (PEP 562), and cache it in the module.

    Raises AttributeError for other names. Ctrl-C is raised after the import.
    """
    if name not in _HOME:
        raise AttributeError(f"module 'gudgeon' has no attribute {name!r}")
    from gudgeon.waiting.ctrl_c import DelayedCtrlC

    with DelayedCtrlC() as ctrl_c:  # NumPy half imported could not be imported again
        value = getattr(import_module(f"gudgeon.{_HOME[name]}"), name)
    ctrl_c.raise_delayed()
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the names of the module, including those not yet imported."""
    return sorted({*globals(), *__all__})
