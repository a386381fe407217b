"""What a page says of drift where it shows none at first: why constraints hold, and Python in which they drift."""

from __future__ import annotations

import json
from string import Template

from gudgeon.contract.methods import KINEMATIC
from gudgeon.loading.shipped import shipped, shipped_file
from gudgeon.simulation.simulation import Simulation

SOLVED = "The drives leave no freedom: Φ = 0 is solved at each sample, so that no constraint drifts."
KEPT = (
    " Method rk4 integrates a = Φ_q⁻¹ (γ − 2α Φ̇ − β² Φ) instead, with all rows kept: Φ drifts (its trace is Phi.max),"
    " or is held by Baumgarte’s terms, whose α and β are shown then."
)
EVENTS = " Its rows are not integrated on this page, for its events are looked for along the solved motion alone."
HELD = (
    "Here the joints of the tree hold by themselves. The full formulation, in which all rows of Φ, those of the drives"
    " too, drift or are held by Baumgarte’s terms, is not on this page."
)
# a = Φ_q⁻¹ (γ − 2 α Φ̇ − β² Φ): a driven mechanism with its rows kept, as a student would integrate it
INTEGRATED = Template("""import gudgeon, numpy as np

sim = gudgeon.load($loaded).full
model, run, alpha, beta = sim.model.numpy(), sim.simulate(), 0, 0  # Baumgarte: 5, 5
p, n, h, y = model.prepare(), model.n, run.t[-1] / 1000, np.r_[run.q[0], run.v[0]]

def rate(t, y):
    q, v = y[:n], y[n:]
    J, drift = model.phi_q(t, q, p), 2 * alpha * (model.phi_q(t, q, p) @ v - model.nu(t, q, p))
    a = model.gamma(t, q, v, p) - drift - beta**2 * model.phi(t, q, p)
    return np.r_[v, np.linalg.lstsq(J, a)[0]]

for t in h * np.arange(1000):  # rk4
    k1 = rate(t, y)
    k2 = rate(t + h / 2, y + h / 2 * k1)
    k3 = rate(t + h / 2, y + h / 2 * k2)
    y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(t + h, y + h * k3))
print(np.abs(model.phi(t + h, y[:n], p)).max())
""")
RUN = Template("""import gudgeon

sim = gudgeon.load($loaded).full
run = sim.simulate(method="rk4", parameters={"gains": 0})  # Baumgarte's terms off
print(run["Phi.max"].max())
""")


def told(simulation: Simulation, carried: bool) -> dict[str, str] | None:
    """{note, code} of a scene; None where the page itself has a formulation that drifts. `carried`: the full one."""
    if simulation.source.methods == (KINEMATIC,):
        note, code = SOLVED + (EVENTS if simulation.source.events else KEPT), INTEGRATED
    elif simulation.source.formulation == "reduced" and not carried:
        note, code = HELD, RUN
    else:
        return None
    return {"note": note, "code": code.substitute(loaded=loaded(simulation))}


def drifts(simulation: Simulation) -> bool:
    """Whether rk4 of a page integrates all rows of the scene, which Baumgarte's terms hold then."""
    return simulation.source.formulation != "reduced" or simulation.source.methods == (KINEMATIC,)


def loaded(simulation: Simulation) -> str:
    """What `gudgeon.load` is given: the name of a shipped file or that of the user's, without its folder; the scene."""
    name = simulation.file.stem
    own = name not in shipped() or not simulation.file.samefile(shipped_file(name))
    return ", ".join(json.dumps(one) for one in (simulation.file.name if own else name, simulation.source.scene))
