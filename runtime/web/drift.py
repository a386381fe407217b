"""Explain on a scene's web page why its constraints do not drift, with Python code of a run in which they drift."""

from __future__ import annotations

import json
from string import Template

import numpy as np

from gudgeon.contract.methods import KINEMATIC
from gudgeon.loading.shipped import find_shipped_file, list_shipped_mechanisms
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation

STEPS_PER_TURN = 60  # steps of rk4 per period at which the drift is visible
KINEMATIC_NOTE = "The scene has no degrees of freedom: Φ = 0 is solved at each sample, so that no constraint drifts."
RK4_NOTE = (
    " The method rk4 integrates a = Φ_q⁻¹ (γ − 2α Φ̇ − β² Φ) instead: Φ drifts (series Phi.max), unless Baumgarte’s"
    " terms limit it. Their gains α and β are then shown. The step is so long that the drift is visible: it grows with"
    " each turn."
)
EVENTS_NOTE = " The page does not offer rk4, because it searches events along the solved motion only."
REDUCED_NOTE = (
    "In the reduced formulation, the joints of the tree cannot drift. This page does not contain the full formulation,"
    " in which all rows of Φ drift or are limited by Baumgarte’s terms: the C of the scene takes {size} kB, more than"
    " the limit of {max_size} kB. gudgeon.load({loaded}).full.to_html() is a page of the full formulation."
)
# a = Φ_q⁻¹ (γ − 2 α Φ̇ − β² Φ): all constraint equations integrated, as a student would do it
RK4_CODE = Template("""import gudgeon, numpy as np

sim = gudgeon.load($loaded).full
model, run, steps = sim.model.numpy(), sim.simulate(), $steps
p, n, h = model.prepare(), model.n, run.t[-1] / steps

def rate(t, y, gain):  # gain: alpha and beta of Baumgarte's terms
    q, v = y[:n], y[n:]
    J, drift = model.phi_q(t, q, p), 2 * gain * (model.phi_q(t, q, p) @ v - model.nu(t, q, p))
    a = model.gamma(t, q, v, p) - drift - gain**2 * model.phi(t, q, p)
    return np.r_[v, np.linalg.lstsq(J, a)[0]]

for gain in 0, $gains:  # phi drifts; is limited; grows with 1 / h, since 2 gain h must stay small
    y, worst = np.r_[run.q[0], run.v[0]], 0
    for t in h * np.arange(5 * steps):  # rk4, for five times as long
        k1 = rate(t, y, gain)
        k2 = rate(t + h / 2, y + h / 2 * k1, gain)
        k3 = rate(t + h / 2, y + h / 2 * k2, gain)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(t + h, y + h * k3, gain))
        worst = max(worst, np.abs(model.phi(t + h, y[:n], p)).max())
    print(gain, worst)
# without drift: sim.simulate() solves phi = 0; with degrees of freedom, method="dop853" projects onto it
""")
FULL_CODE = Template("""import gudgeon

sim = gudgeon.load($loaded).full
for gain in 0, 5:  # of Baumgarte's terms: off, on
    print(gain, sim.simulate(method="rk4", parameters={"gains": gain})["Phi.max"].max())
print(sim.simulate()["Phi.max"].max())  # projected onto Phi = 0 after each step
""")


def compute_drift_step(run: Result) -> float:
    """Return the step (s) of rk4 at which constraint drift of a driven mechanism is visible: a sixtieth of a period.

    The period is 2π over the largest angular velocity of the run, at most its duration. Baumgarte gains of about
    0.1/step then limit the drift.
    """
    max_rates = [float(np.abs(run.v[:, body.index + 2]).max()) for body in run.source.bodies]
    period = 2.0 * np.pi / max([*max_rates, 1e-300])
    return min(period, float(run.t[-1] - run.t[0])) / STEPS_PER_TURN


def explain_missing_drift(
    simulation: Simulation, run: Result, module_size: int, max_module_size: int
) -> dict[str, str] | None:
    """Return {"note", "code"}: why constraints do not drift on the page of a scene, and Python code in which they do.

    None if the page has a formulation in which they drift. run: at the file's values. module_size: bytes of the
    scene's module. max_module_size: above it, the page has no second module with the full formulation.
    """
    replacements = dict[str, str]()
    if simulation.source.methods == (KINEMATIC,):
        note, code = KINEMATIC_NOTE + (EVENTS_NOTE if simulation.source.events else RK4_NOTE), RK4_CODE
        replacements = _format_step_and_gains(run)
    elif simulation.source.formulation == "reduced" and module_size > max_module_size:
        note, code = (
            REDUCED_NOTE.format(
                size=round(module_size / 1e3),
                max_size=round(max_module_size / 1e3),
                loaded=format_load_arguments(simulation),
            ),
            FULL_CODE,
        )
    else:
        return None
    return {"note": note, "code": code.substitute(replacements, loaded=format_load_arguments(simulation))}


def _format_step_and_gains(run: Result) -> dict[str, str]:
    """Return the substitutions of RK4_CODE: the number of steps, and two Baumgarte gains, 0.1/h and an unstable 1/h."""
    period_step, duration = compute_drift_step(run), float(run.t[-1] - run.t[0])
    n_steps = max(1, round(duration / period_step))
    return {"steps": str(n_steps), "gains": f"{0.1 * n_steps / duration:.1g}, {n_steps / duration:.3g}"}


def has_drift(simulation: Simulation) -> bool:
    """Return whether rk4 on the page integrates all constraint equations, with Baumgarte's terms."""
    return simulation.source.formulation != "reduced" or simulation.source.methods == (KINEMATIC,)


def format_load_arguments(simulation: Simulation) -> str:
    """Return the arguments of `gudgeon.load` as text: file and scene.

    The file is the name of a shipped mechanism, or of the user's file without its folder.
    """
    name = simulation.file.stem
    is_own_file = name not in list_shipped_mechanisms() or not simulation.file.samefile(find_shipped_file(name))
    return ", ".join(
        json.dumps(argument) for argument in (simulation.file.name if is_own_file else name, simulation.source.scene)
    )
