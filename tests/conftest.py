"""A slider and a crank with prescribed motion: results without a compiler."""

from __future__ import annotations

import gc
import os
import signal
from collections import Counter
from collections.abc import Callable, Generator
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer.testing
from hypothesis.internal.conjecture import providers
from typer.testing import CliRunner

from gudgeon.cli import app
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import (
    BodyInfo,
    DriveInfo,
    EquationInfo,
    JointInfo,
    KernelSource,
    PointInfo,
    RuntimeParameter,
)
from gudgeon.integrators.trajectory import IMPACT_DTYPE
from gudgeon.model.evaluation import MotionSeries
from gudgeon.results.diagnostics import Diagnostics, Peak
from gudgeon.results.results import Result
from tests import quick
from tests.pump import TEXT, Gudgeon

# A shell's background jobs ignore Ctrl-C, and so would tests of it and the programs that they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Hypothesis draws, beside its own, constants of the modules that are loaded: what a test sees would depend on which
# tests the same process ran before it.
assert callable(providers._get_local_constants)
providers._get_local_constants = providers.Constants  # an empty set of them

# The command line is made of its functions once, not at each call of it in a test.
assert callable(typer.testing._get_command)
typer.testing._get_command = cache(typer.testing._get_command)

quick.install()
os.environ["GUDGEON_QUICK"] = "0"  # nothing is compiled behind a test, or behind programs that it starts
FIRST = ("test_functions.py", "test_generated.py", "test_site.py")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Files of many tests first, so that workers end together; before them what is long in one test.

    What needs zig's C library, which takes a minute to build, is the very first: later two workers would wait for it.
    """
    tests = Counter(item.path for item in items)
    items.sort(key=lambda item: (*(item.path.name != name for name in FIRST), -tests[item.path]))


def pytest_collection_finish() -> None:
    """Modules and tests stay: what is looked for in them again and again takes a tenth of the time of a derivation."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, Any, Any]:
    """Fixtures of every scope are within it."""
    as_users = item.get_closest_marker("optimized") is not None or "slow or" in item.config.option.markexpr
    with quick.compiled(as_users, item.get_closest_marker("plain") is not None):
        return (yield)


OMEGA, RADIUS, CLEARANCE = 2 * np.pi, 0.08, 0.3e-3
FREE, IMPACT, CONTACT = 0, 1, 2


def make_source(scene: str) -> KernelSource:
    play = scene != "ideal"
    slots = [
        RuntimeParameter("parameters.omega", "rad/s", OMEGA, False, (0, 0, -1)),
        RuntimeParameter("bodies.L1.length", "m", RADIUS, False, (1, 0, 0)),
        RuntimeParameter("parameters.c", "m", CLEARANCE, False, (1, 0, 0)),
    ]
    ideal_joint = JointInfo("A", "revolute", 0, 1, "S9.origin", (3, 4))
    guide = JointInfo("guide", "translational", -1, 1, "S9.origin", (1, 2))
    rows = [
        EquationInfo("crank.angle", "crank", "drive", "rad"),
        *(EquationInfo(f"guide.{name}", "guide", "joint", unit) for name, unit in (("offset", "m"), ("angle", "rad"))),
    ]
    rows += [] if play else [EquationInfo("A.x", "A", "joint", "m"), EquationInfo("A.y", "A", "joint", "m")]
    return KernelSource(
        mechanism="slider",
        scene=scene,
        title="A slider",
        sha256="0" * 64,
        files={"slider.c": "/* δ̇⁻ */\n" * 9000},
        main="slider.c",
        cdef="",
        coordinates=tuple(f"{body}.{c}" for body in ("L1", "S9") for c in ("x", "y", "theta")),
        bodies=(BodyInfo("L1", 0), BodyInfo("S9", 3)),
        points=(
            PointInfo("L1.head", 0, 3, -1),
            PointInfo("L1.tail", 0, 3, -1, sign_x=-1),
            PointInfo("S9.origin", 1, -1, -1),
            PointInfo("ground.O1", -1, 1, -1),
        ),
        equations=tuple(rows),
        joints=(guide,) if play else (guide, ideal_joint),
        drives=(DriveInfo("crank", 0, "rad"),),
        clearances=(ClearanceInfo("A", 0, 1, "S9.origin", True, False, 2, {"K": 4}),) if play else (),
        series=(),
        start_equations=(),
        start_guess=(),
        start_set=(),
        start_rates=(),
        frictions=(),
        pivots=(),
        start_pivots=(),
        rate_jumps=(),
        indeterminate=(),
        parameters=tuple(slots),
        derived=("half_L1", "A.K"),
        conditions=(),
        outputs={"lift": ["+", "S9.y", RADIUS], "speed": ["*", "omega", ["/", "bodies.L1.length", 2.0]]},
        simulate={},
        operations={"rhs": 100},
        notes=("no gravity: no potential energy",),
        gravity=False,
    )


@dataclass
class FakeEvaluation:
    a: Any
    multipliers: Any
    reactions: Any
    torques: Any
    clearance: Any
    series: Any
    energy: Any
    drift: Any


@dataclass
class FakeCompiled:
    """Stands for a compiled library: smooth made-up forces, and a count of the calls."""

    source: KernelSource
    calls: list[int] = field(default_factory=list)
    may_drive_acceleration_jump: bool = False

    def prepare(self, given: Any, is_given: Any) -> Any:
        return np.where(is_given, given, 0.0)

    def evaluate_motion_series(self, series: MotionSeries, counts: Any, columns: Any, p: Any) -> Any:
        x, y = (sign * p[k] if k >= 0 else 0.0 for k, sign in ((series.x, series.sign_x), (series.y, series.sign_y)))
        arms: tuple[Any, Any, Any] = (complex(x, y), 0.0, 0.0)
        origins = [column[:, 0] + 1j * column[:, 1] for column in columns] or [np.zeros(sum(counts))]
        if columns:
            theta, omega, alpha = (*(column[:, 2] for column in columns), 0.0, 0.0)[:3]
            arm = complex(x, y) * np.exp(1j * theta)
            arms = arm, 1j * omega * arm, (1j * alpha - omega**2) * arm
        place = origins[-1] + arms[series.order]
        return place.imag if series.axis else place.real

    def evaluate(self, t: Any, q: Any, v: Any, memory: Any, p: Any) -> FakeEvaluation:
        self.calls.append(len(t))
        n, s = len(t), self.source
        waves = np.sin(np.outer(t, 1.0 + np.arange(40)))
        clearance = np.zeros((n, len(s.clearances), 10))
        for k in range(len(s.clearances)):
            e = p[2] * (0.4 + 0.7 * np.abs(np.sin(9 * t)))
            angle = 5 * t + np.sin(20 * t)
            clearance[:, k, 4], clearance[:, k, 5], clearance[:, k, 6] = e * np.cos(angle), e * np.sin(angle), e
            clearance[:, k, 9] = e - p[2]
            force = p[4] * np.maximum(e - p[2], 0.0) ** 1.5
            clearance[:, k, 0], clearance[:, k, 1] = -force * np.cos(angle), -force * np.sin(angle)
            clearance[:, k, 2], clearance[:, k, 7], clearance[:, k, 8] = force, waves[:, 0], waves[:, 1]
        return FakeEvaluation(
            np.zeros_like(q),
            waves[:, : len(s.equations)],
            waves[:, : 3 * len(s.joints)].reshape(n, len(s.joints), 3),
            waves[:, : len(s.drives)],
            clearance,
            waves[:, :0],
            waves[:, :2] ** 2,
            1e-12 * waves[:, :2] ** 2,
        )


def make_run(scene: str = "dry", samples: int = 201, t_end: float = 1.0) -> Result:
    """The crank turns with ω; with play the slider lags by a ripple of the size of the clearance."""
    source = make_source(scene)
    w, t = OMEGA, np.linspace(0.0, t_end, samples)
    p = np.array([w, RADIUS, CLEARANCE, RADIUS / 2, 1e10])
    q, v, a = (np.zeros((samples, 6)) for _ in range(3))
    half = RADIUS / 2
    q[:, :3] = np.stack([half * np.cos(w * t), half * np.sin(w * t), w * t], 1)
    v[:, :3] = np.stack([-half * w * np.sin(w * t), half * w * np.cos(w * t), np.full(samples, w)], 1)
    a[:, :3] = np.stack([-half * w**2 * np.cos(w * t), -half * w**2 * np.sin(w * t), np.zeros(samples)], 1)
    ripple = 0.0 if scene == "ideal" else CLEARANCE
    rate = 50.0
    q[:, 3], q[:, 5] = 0.5, np.pi / 2
    q[:, 4] = RADIUS * np.sin(w * t) + ripple * np.sin(rate * t)
    v[:, 4] = RADIUS * w * np.cos(w * t) + ripple * rate * np.cos(rate * t)
    a[:, 4] = -RADIUS * w**2 * np.sin(w * t) - ripple * rate**2 * np.sin(rate * t)
    play = len(source.clearances)
    onsets = [(0, 0.11, 0.12, 0.3, 40.0, 0.115), (0, 0.46, np.nan, 0.2, 30.0, 0.47)]
    impacts = np.array(onsets[: 2 * play], IMPACT_DTYPE)
    state = np.where(np.sin(9 * t) > 0.86, CONTACT, FREE).astype(np.int8)[:, None][:, :play]
    peaks = (Peak("A", 40.0, 0.115, 1.1 * CLEARANCE, 0.11, 38.0),) if play else ()
    diagnostics = Diagnostics(
        "rk4" if play else "kinematic",
        1e-5 if play else np.nan,
        100000 * play,
        400000 * play,
        2 * play,
        1e-12,
        1e-11,
        3e-9,
        0.4,
        np.nan,
        np.inf if play else np.nan,
        0,
        peaks,
        0.5,
        0.5,
        False,
        ("a note",),
    )
    return Result(
        compiled=FakeCompiled(source),  # type: ignore[arg-type]
        source=source,
        p=p,
        given=np.array([0.0, 0.0, CLEARANCE]),
        is_given=np.array([False, False, True]),
        t=t,
        q=q,
        v=v,
        accelerations=a,
        state=state,
        memory=np.where(state > 0, 0.25, np.nan),
        work=np.stack([t, 0 * t, -0.5 * t], 1),
        impacts=impacts,
        diagnostics=diagnostics,
    )


@pytest.fixture
def make() -> Callable[..., Result]:
    return make_run


@pytest.fixture
def run() -> Result:
    return make_run()


@pytest.fixture
def ideal() -> Result:
    return make_run("ideal")


@pytest.fixture
def stripped(run: Result) -> Result:
    """As if a file held nothing but what the integrator stored."""
    return replace(run, compiled=None, stored={})


@pytest.fixture
def pump(tmp_path: Path) -> str:
    path = tmp_path / "pump.yaml"
    path.write_text(TEXT)
    return str(path)


@pytest.fixture
def no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """`gudgeon run` draws nothing: a picture takes longer than a short run."""
    monkeypatch.setattr("gudgeon.commands.run._draw_picture", lambda *_: None)


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gudgeon:
    """Runs `gudgeon …` in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: CliRunner().invoke(app, list(arguments))
