"""The last cells of a notebook: numbers for the derived functions, NumPy's beside them, then the compiled run."""

from __future__ import annotations

from collections.abc import Iterator

from gudgeon.generator.equations.model import Model

Cell = tuple[str, str]


def run_cells(model: Model, mechanism: str) -> Iterator[Cell]:
    """Each comparison asserts: a notebook that ran to its end agreed."""
    massless = any(body.lacks for body in model.scene.mechanism.bodies.values())
    plain = not (model.clearances or model.frictions)
    yield (
        "markdown",
        (
            "## The same functions in NumPy\n\n`model.numpy()` is the plainest form of what the emitted C computes; "
            "`model.numpy().source` is its text. At the start both say the same."
        ),
    )
    if model.rows:
        yield "code", _functions(model, massless)
        yield "code", _numpy(model, mechanism)
    else:
        yield "code", _loaded(model, mechanism)
    yield "markdown", "## The compiled simulator\n\nThe same equations as C, integrated or solved at each sample."
    yield "code", "run = simulation.simulate()\nrun"
    if model.rows:
        yield "code", _compiled(model, massless, plain)


def _functions(model: Model, massless: bool) -> str:
    parts = ["Phi", "Phi_q", "nu", "gamma"] if massless else ["Phi", "Phi_q", "nu", "gamma", "M", "g"]
    return (
        "def function(matrix):\n"
        '    """In numbers, of t, q and q̇."""\n'
        '    instants = {"DiracDelta": lambda *_: 0.0}  # a jump of a rate lasts for no time\n'
        '    compiled = sp.lambdify((t, [*q], [*v]), matrix.subs(numbers), [instants, "numpy"])\n'
        "    return lambda t, q, v: np.array(compiled(t, q, v), float)\n\n\n"
        f"derived = {{name: function(matrix) for name, matrix in dict({', '.join(f'{x}={x}' for x in parts)}).items()}}"
    )


def _loaded(model: Model, mechanism: str) -> str:
    return (
        "import gudgeon\n\n"
        f"simulation = gudgeon.load({mechanism!r}, {model.scene.name!r})\n"
        "in_numpy = simulation.model.numpy()\n"
        "print(in_numpy.source[:2000])"
    )


def _numpy(model: Model, mechanism: str) -> str:
    """NumPy's rows are those of the closed linkage, with joints that have play here and rows that say nothing new."""
    kept = [row.name for row in model.rows]
    rows = [k for k, row in enumerate(model.all_rows) if row.name in kept]
    return (
        "import gudgeon\n\n"
        f"simulation = gudgeon.load({mechanism!r}, {model.scene.name!r})\n"
        "in_numpy = simulation.model.numpy()\n"
        "p, start = in_numpy.prepare(), simulation.start()\n"
        f"rows = {rows}  # of the linkage with all joints closed\n\n"
        "for name, theirs in (\n"
        '    ("Phi", in_numpy.phi(0.0, start.q, p)),\n'
        '    ("Phi_q", in_numpy.phi_q(0.0, start.q, p)),\n'
        '    ("nu", in_numpy.nu(0.0, start.q, p)),\n'
        '    ("gamma", in_numpy.gamma(0.0, start.q, start.v, p)),\n'
        "):\n"
        "    ours = derived[name](0.0, start.q, start.v)\n"
        "    theirs = np.asarray(theirs)[rows].reshape(ours.shape)\n"
        '    print(f"{name}: {np.abs(ours - theirs).max():.1e} apart at most")\n'
        "    assert np.allclose(ours, theirs, rtol=1e-9, atol=1e-9 * (1 + np.abs(theirs).max()))"
    )


def _compiled(model: Model, massless: bool, plain: bool) -> str:
    head = (
        "end = float(run.t[-1])\n"
        'entries, right = derived["Phi_q"](end, run.q[-1], run.v[-1]), derived["gamma"](end, run.q[-1], run.v[-1])\n'
    )
    if massless:
        return head + (
            "a = np.linalg.lstsq(entries, right[:, 0], rcond=None)[0]  # no masses: drives determine all\n"
            'print(f"q̈ at {end:g} s: {np.abs(a - run.a[-1]).max():.1e} apart at most")\n'
            "assert np.allclose(a, run.a[-1], rtol=1e-6, atol=1e-6 * (1 + np.abs(a).max()))"
        )
    if not plain:
        return head + (
            "theirs = simulation.phi_q(end, run.q[-1])\n"
            'print(f"Φ_q at {end:g} s: {np.abs(entries - theirs).max():.1e} apart at most")\n'
            "assert np.allclose(entries, theirs, rtol=1e-9, atol=1e-9 * (1 + np.abs(theirs).max()))"
        )
    return head + (
        'mass, forces = derived["M"](end, run.q[-1], run.v[-1]), derived["g"](end, run.q[-1], run.v[-1])\n'
        "system = np.block([[mass, entries.T], [entries, np.zeros((len(entries), len(entries)))]])\n"
        "solved = np.linalg.solve(system, np.concatenate([forces[:, 0], right[:, 0]]))\n"
        "a = solved[: len(mass)]  # behind them the multipliers λ\n"
        'print(f"q̈ at {end:g} s: {np.abs(a - run.a[-1]).max():.1e} apart at most, of {np.abs(a).max():.3g}")\n'
        "assert np.allclose(a, run.a[-1], rtol=1e-6, atol=1e-6 * (1 + np.abs(a).max()))"
    )
