"""One design tried: its runs against the independent simulator, against themselves in other forms, and by closed forms.

A tolerance follows from the run: how far it is from the same run with a thirtieth of the tolerance. What that says of a
chaotic motion soon is nothing; its beginning is compared all the same.
"""

from __future__ import annotations

import re
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import gudgeon
from gudgeon.errors import AssemblyError, GudgeonError, InputError
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.random_machines import closed_forms, oracle
from tests.random_machines.design import CODE_NAMES, UNIT_NAMES, Design
from tests.random_machines.draw import draw, other_numbers

SAMPLES = 400
SLACK = 100.0  # times how far a tighter run is away
LEAST = 1e-7  # of the size: nothing is compared more closely
ORACLE_SLACK = 10.0  # times how far the independent simulator is from itself with ten times its tolerance
TIGHTER = 0.03
LOOSE = 1e-7  # rtol that the error for an unbounded second rate names
UNITS = (2.0, 3.0, 1.5)  # of length, mass and time
ANGLE = 0.4


@dataclass
class Failure:
    """What differs, and the file that shows it."""

    seed: int
    family: str
    what: str
    text: str

    def __str__(self) -> str:
        return f"seed {self.seed} ({self.family}): {self.what}"


@dataclass
class Tally:
    """How many machines were tried, what was compared how often, and what failed."""

    counts: Counter[str] = field(default_factory=Counter)
    failures: list[Failure] = field(default_factory=list)

    def __str__(self) -> str:
        return ", ".join(f"{count} {what}" for what, count in sorted(self.counts.items()))


class Difference(AssertionError):
    """Two things that should agree do not."""


class Trial:
    """A design in a folder; `check` notes what fails."""

    def __init__(self, design: Design, folder: Path, tally: Tally) -> None:
        self.design, self.folder, self.tally = design, folder, tally
        self.rng = np.random.default_rng([7, design.seed])

    def load(self, text: str, name: str, formulation: str = "reduced") -> Simulation:
        file = self.folder / f"{name}_{self.design.seed}.yaml"
        file.write_text(text, encoding="utf-8")
        return gudgeon.load(file, self.design.scene, formulation=formulation, quick=False)

    def check(self, what: str, design: Design, work: Callable[[], None]) -> None:
        """Count it; note a failure with the file as it stands for itself."""
        if what in design.without:
            return
        self.tally.counts[what] += 1
        try:
            work()
        except oracle.Unknown:
            self.tally.counts[what] -= 1
        except (InputError, Difference, GudgeonError) as error:
            self.note(f"{what}: {error}", design)
        except Exception:
            self.note(f"{what}: {traceback.format_exc(limit=-3)}", design)

    def note(self, what: str, design: Design) -> None:
        text = design.with_values(design.numbers.plain())
        self.tally.failures.append(Failure(design.seed, design.family, what, text))

    def run(self, simulation: Simulation, design: Design, values: Mapping[str, float], **options: Any) -> Result:
        options = {"output": SAMPLES, "rtol": design.rtol} | options
        return simulation.simulate(options.pop("t_end", design.t_end), parameters=dict(values), **options)

    def everything(self, machines: int) -> None:
        """All relations, turned over among so many machines of the design."""
        try:
            simulation = self.load(self.design.text(), "machine")
        except GudgeonError as error:
            self.tally.counts["designs refused"] += 1
            if not isinstance(error, InputError | AssemblyError):
                self.note(f"load: {error}", self.design)
            return
        self.tally.counts["designs"] += 1
        tried = [self.design, *(other_numbers(self.design, self.rng) for _ in range(machines - 1))]
        for k, design in enumerate(tried):
            self.tally.counts["machines"] += 1
            try:
                base = Base(self, simulation, design)
            except GudgeonError as error:
                self.stopped(simulation, design, error)
                continue
            self.check("closed form", design, partial(closed_forms.check, base.design, base.run, Difference))
            for what, relation in RELATIONS[k % 2 :: 2]:
                self.check(what, design, partial(relation, base))
            if k == 0:
                for what, relation in DERIVED if self.rng.random() < 0.5 else DERIVED[1:2]:
                    self.check(what, design, partial(relation, base))
            if k < (1 if "scenes" in design.file else 2):
                self.check("oracle", design, partial(simulated, base))

    def stopped(self, simulation: Simulation, design: Design, error: GudgeonError) -> None:
        """A run that ends early has to be right about it: the independent simulator stops there, too."""
        self.tally.counts["machines that stop"] += 1
        partial = getattr(error, "partial", None)
        if "oracle" in design.without or partial is None or len(partial.t) < 1:
            return

        def leads_over() -> None:
            """Next to an unbounded second rate time has too few digits for tight tolerances: looser ones lead over."""
            self.run(simulation, design, design.numbers.plain(), rtol=LOOSE)

        def goes_on() -> None:
            message = [float(t) for t in re.findall(r"t = ([-+.e\d]+\d)", str(error))]
            times = np.linspace(
                0.0, min(design.t_end, 1.02 * max([partial.t[-1], *message]) + 0.01 * design.t_end), 200
            )
            try:
                machine, who = oracle.Machine(design.file, design.numbers.plain(), design.scene), "the oracle"
                goes = oracle.goes_on(machine, times, partial.q[0], partial.v[0])
            except oracle.Unknown:
                absolute, who = self.load(self.design.text(), "machine", "full"), "the full formulation"
                try:
                    goes = bool(len(self.run(absolute, design, design.numbers.plain(), t_end=times[-1]).t))
                except GudgeonError:
                    goes = False
            if goes:
                raise Difference(f"the run stops, {who} goes on to {times[-1]:.6g} s: {error}")

        self.check("stops", design, leads_over if "grows beyond all bounds" in str(error) else goes_on)


class Base:
    """A run and how far it can be trusted: (N,) m or rad."""

    def __init__(self, trial: Trial, simulation: Simulation, design: Design) -> None:
        self.trial, self.simulation, self.design = trial, simulation, design
        self.values = design.numbers.plain()
        self.run = trial.run(simulation, design, self.values)
        self.series = self.of(self.run)
        self.slack = np.full(len(self.run.t), LEAST * design.size)
        if self.run.source.degrees_of_freedom > 0:
            other = self.of(trial.run(simulation, design, self.values, rtol=max(TIGHTER * design.rtol, 1e-13)))
            if len(other) == len(self.series):
                off = np.max([abs(wrapped(self.series[name] - other[name], name)) for name in self.series], axis=0)
                self.slack = np.maximum(self.slack, SLACK * np.maximum.accumulate(off))

    def of(self, run: Result, names: Mapping[str, str] | None = None) -> dict[str, np.ndarray]:
        """x, y and theta of every body; `names`: what the bodies are called there."""
        bodies = self.design.bodies()
        called = names or {name: name for name in bodies}
        return {f"{body}.{axis}": run[f"{called[body]}.{axis}"] for body in bodies for axis in ("x", "y", "theta")}

    def agree(self, other: Mapping[str, np.ndarray], slack: float = 1.0) -> None:
        """Raise Difference where the other motion is away by more than the slack."""
        for name, mine in self.series.items():
            theirs = other[name]
            n = min(len(mine), len(theirs))
            off = abs(wrapped(mine[:n] - theirs[:n], name))
            wrong = off > slack * self.slack[:n]
            if wrong.any() or not np.isfinite(theirs).all() or len(mine) != len(theirs):
                k = int(np.argmax(wrong)) if wrong.any() else n - 1
                values = f"{float(mine[k])!r} and {float(theirs[k])!r}"
                raise Difference(f"{name} at {self.run.t[k]:.6g} s: {values}, expected within {self.slack[k]:.2g}")


def wrapped(x: np.ndarray, name: str) -> np.ndarray:
    """Differences of angles that are turns apart are none."""
    return (x + np.pi) % (2.0 * np.pi) - np.pi if name.endswith("theta") else x


def mirrored(base: Base) -> None:
    values = base.design.numbers.mirrored()
    found = base.of(base.trial.run(base.simulation, base.design, values))
    base.agree({name: x if name.endswith(".x") else -x for name, x in found.items()})


def rotated(base: Base) -> None:
    found = base.of(base.trial.run(base.simulation, base.design, base.design.numbers.rotated(ANGLE)))
    c, s = np.cos(ANGLE), np.sin(ANGLE)
    back: dict[str, np.ndarray] = {}
    for body in base.design.bodies():
        x, y = found[f"{body}.x"], found[f"{body}.y"]
        back |= {f"{body}.x": c * x + s * y, f"{body}.y": c * y - s * x}
        back[f"{body}.theta"] = found[f"{body}.theta"] - ANGLE
    base.agree(back)


def scaled(base: Base) -> None:
    values = base.design.numbers.scaled(UNITS)
    run = base.trial.run(base.simulation, base.design, values, t_end=base.design.t_end * UNITS[2])
    base.agree({name: x / (1.0 if name.endswith("theta") else UNITS[0]) for name, x in base.of(run).items()})


def moved(base: Base) -> None:
    shifts = {
        name: base.trial.rng.uniform(-0.05, 0.05, 2)
        for name, body in base.design.file["bodies"].items()
        if "length" not in body and "com" in body
    }
    if shifts:
        base.agree(base.of(base.trial.run(base.simulation, base.design, base.design.numbers.moved(shifts))))


def cut(base: Base) -> None:
    """A run that ends midway and goes on has the same end."""
    half = base.trial.run(base.simulation, base.design, base.values, output=SAMPLES // 2, t_end=base.design.t_end / 2)
    rest = base.simulation.simulate(base.design.t_end, output=SAMPLES // 2, rtol=base.design.rtol, start=half.final)
    first, second = base.of(half), base.of(rest)
    base.agree({name: np.concatenate([first[name], second[name][1:]]) for name in first})


def batch(base: Base) -> None:
    """A batch gives each run bit for bit, beside others."""
    others = [base.values, other_numbers(base.design, base.trial.rng).numbers.plain(), base.values]
    columns = {name: [values[name] for values in others] for name in base.values}
    many = base.simulation.simulate_many(columns, base.design.t_end, output=SAMPLES, rtol=base.design.rtol, threads=1)
    failed = {one.run: one.error for one in many.failures}
    for k in (0, 2):
        if k in failed:
            raise Difference(f"run {k} of the batch fails, alone it does not: {failed[k]}")
        if not (np.array_equal(many[k].q, base.run.q) and len(many[k].impacts) == len(base.run.impacts)):
            raise Difference(f"run {k} of a batch is not the run alone, by {abs(many[k].q - base.run.q).max():.3g}")


def again(base: Base) -> None:
    """The same call gives the same bits."""
    if not np.array_equal(base.trial.run(base.simulation, base.design, base.values).q, base.run.q):
        raise Difference("the same run again differs")


def methods(base: Base) -> None:
    """Another method that the scene accepts gives the same motion."""
    method = str(base.trial.rng.choice(base.design.accepted_methods()))
    if base.run.source.degrees_of_freedom > 0:
        base.agree(base.of(base.trial.run(base.simulation, base.design, base.values, method=method)), 10.0)


def contacts(base: Base) -> None:
    """No penetration outside the contacts that are listed, no force of a dry law there."""
    play = base.design.file.get("scenes", {}).get(base.design.scene, {}).get("play", {})
    pins = [name for name, entry in play.items() if "bearing" in entry]
    if not pins:
        return
    run = base.trial.run(base.simulation, base.design, base.values, output=4000)
    joints = [joint.joint for joint in run.source.clearances]
    for name in pins:
        own = run.impacts[run.impacts["joint"] == joints.index(name)]
        ends = np.where(np.isnan(own["t_off"]), np.inf, own["t_off"])
        inside = ((run.t[:, None] >= own["t_on"] - 1e-9) & (run.t[:, None] <= ends + 1e-9)).any(axis=1)
        clearance = base.values[str(base.design.file["bearings"]["pin"]["clearance"])]
        deep = np.where(inside, 0.0, run[f"{name}.delta"])
        if deep.max() > 1e-4 * clearance:
            k = int(deep.argmax())
            raise Difference(f"{name}.delta is {deep[k]:.3g} m at {run.t[k]:.8g} s outside every contact")


def renamed(base: Base) -> None:
    names = UNIT_NAMES if base.trial.rng.random() < 0.5 else CODE_NAMES
    text, bodies, parameters = base.design.renamed(base.trial.rng, names)
    try:
        simulation = base.trial.load(text, "renamed")
    except InputError as error:
        if any(name in str(error) for name in (*names, "random_machine")):  # it says which name cannot be
            return
        raise
    values = {parameters[name]: x for name, x in base.values.items()}
    base.agree(base.of(base.trial.run(simulation, base.design, values), bodies))


def full(base: Base) -> None:
    simulation = base.trial.load(base.design.text(), "machine", "full")
    run = base.trial.run(simulation, base.design, base.values)
    base.agree(base.of(run), 10.0)
    few, many = (one.diagnostics.steps for one in (base.run, run))
    if many > 30 * few + 1000:
        raise Difference(f"{few} steps, and {many} in absolute coordinates")


def split(base: Base) -> None:
    body = str(base.trial.rng.choice(base.design.bodies()))
    simulation = base.trial.load(base.design.split(body), "split")
    base.agree(base.of(base.trial.run(simulation, base.design, base.values)))


def simulated(base: Base) -> None:
    """The independent simulator, as far as the motion can be followed; its contacts come at the same times."""
    machine = oracle.Machine(base.design.file, base.values, base.design.scene)
    if base.run.source.degrees_of_freedom == 0:
        base.agree(_series(base, oracle.positions(machine, base.run.t, base.run.q[0])))
        return
    trusted = base.slack < 1e-2 * base.design.size if not machine.pins else base.slack < 1e-5
    n = max(int(np.argmin(trusted)) if not trusted.all() else len(trusted), 8)
    try:
        moved = oracle.simulate(machine, base.run.t[:n], base.run.q[0], base.run.v[0])
    except ArithmeticError as error:
        raise oracle.Unknown("a motion that its fixed steps do not follow") from error
    n = len(moved.q)
    part = replace_samples(base, n)
    try:
        part.agree(_series(base, moved.q))
    except Difference:
        part.slack = part.slack + ORACLE_SLACK * oracle_error(machine, base, moved.q)
        part.agree(_series(base, moved.q))
    mine = [t for t in base.run.impacts["t_on"] if t < base.run.t[n - 1]]
    moved.contacts = [(name, t) for name, t in moved.contacts if t < base.run.t[n - 1]]
    if machine.pins and len(mine) != len(moved.contacts):
        theirs = [round(t, 7) for _, t in moved.contacts]
        raise Difference(f"{len(mine)} contacts at {np.round(mine, 7)[:6]}, by the oracle {theirs[:6]}")


def oracle_error(machine: oracle.Machine, base: Base, q: np.ndarray) -> np.ndarray:
    """Estimate the error of the independent simulator's q (N, n) up to each sample, (N,) in m or rad.

    The estimate is the distance from the same motion with ten times the tolerance, which costs as much as the motion:
    it is made only where the two simulators differ. Errors are large where a force has switching points inside steps.
    """
    loose = oracle.simulate(machine, base.run.t[: len(q)], base.run.q[0], base.run.v[0], 10.0 * oracle.RTOL).q
    off = np.full(len(q), np.inf)
    off[: len(loose)] = np.maximum.accumulate(abs(loose - q[: len(loose)]).max(axis=1))
    return off


def replace_samples(base: Base, n: int) -> Base:
    """The first n samples of a run."""
    part = object.__new__(Base)
    part.__dict__ |= base.__dict__ | {"series": {k: x[:n] for k, x in base.series.items()}, "slack": base.slack[:n]}
    return part


def _series(base: Base, q: np.ndarray) -> dict[str, np.ndarray]:
    names = [f"{body}.{axis}" for body in base.design.bodies() for axis in ("x", "y", "theta")]
    return dict(zip(names, q.T, strict=True))


RELATIONS: list[tuple[str, Callable[[Base], None]]] = [
    ("mirror", mirrored),
    ("rotate", rotated),
    ("units", scaled),
    ("move origins", moved),
    ("cut", cut),
    ("batch", batch),
    ("again", again),
    ("methods", methods),
    ("contacts", contacts),
]
DERIVED: list[tuple[str, Callable[[Base], None]]] = [("full", full), ("rename", renamed), ("split", split)]


def try_seeds(
    seeds: Iterator[int] | range,
    folder: Path,
    machines: int = 8,
    family: str | None = None,
    report: Callable[[Tally], None] | None = None,
) -> Tally:
    """Try the design of each seed with so many sets of numbers."""
    tally = Tally()
    for seed in seeds:
        Trial(replace(draw(seed, family)), folder, tally).everything(machines)
        if report:
            report(tally)
    return tally
