"""List the published machines with joint clearance that gudgeon and independent code simulate, with sources."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from benchmarks.clearance import rotors
from benchmarks.clearance.machines import four_bar, jansen, landing_gear, press, slider_crank, slider_in_guide
from benchmarks.clearance.second import Pin, Second
from tests.oracles.numpy_linkage import Wave

HERE = Path(__file__).resolve().parent
STUDIES = HERE.parents[1] / "studies"


@dataclass(frozen=True)
class Case:
    """A machine with its parameter values. `file`, `scene`, `parameters`: as `gudgeon.load` and `simulate` take them.

    joints: those with play, as the file calls them. t_end: s, of the samples. peaks: largest forces at the joints that
    the paper prints of the first second, N. rows: a file here of rows that a code prints, journals in mm.
    """

    title: str
    source: str
    file: str
    scene: str
    joints: tuple[str, ...]
    t_end: float
    guess: Sequence[float]
    second: Second
    peaks: tuple[float | None, ...] = ()
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    rows: str = ""

    @property
    def clearance(self) -> float:
        """Return the clearance of the first joint in m."""
        return self.second.joints[0].law.clearance

    @property
    def clearances(self) -> np.ndarray:
        """Return the clearance of each joint in m."""
        return np.array([joint.law.clearance for joint in self.second.joints])

    @property
    def is_film(self) -> bool:
        """Return whether the joints are lubricated."""
        return self.second.joints[0].law.viscosity > 0.0


CHEN = "X. Chen, S. Gao, T. Wang, Nonlinear Dynamics (2022), doi 10.1007/s11071-022-07478-4"
FLORES = "P. Flores and others, Mechanism and Machine Theory 41 (2006) 247, doi 10.1016/j.mechmachtheory.2005.10.002"
FLORES_FILM = (
    "P. Flores, J. Ambrósio, J. Claro, H. Lankarani, C. Koshy, Nonlinear Dynamics 56 (2009) 277, "
    "doi 10.1007/s11071-008-9399-2"
)
WORN = (
    "Mechanism and Machine Theory 194 (2024) 105583, doi 10.1016/j.mechmachtheory.2024.105583, as "
    "github.com/PanChuguang/ALGRM-Sim sets it"
)
SICONOS = (
    "Siconos, github.com/siconos/siconos, examples/Mechanics/FourBarLinkageWith3clearance; its numbers are those of "
    "a paper's table that it does not name"
)
NOWALD = (
    "G. Nowald, github.com/gerritnowald/transient_rotordynamic, after his dissertation, TU Darmstadt 2018, "
    "https://tuprints.ulb.tu-darmstadt.de/8186"
)
STATOR = (
    "github.com/nm96/MSc_project_code, after a model of van der Heijden: a rotor with bearing clearance is that of "
    "Journal of Nonlinear Science 5 (1995) 257, doi 10.1007/BF01212957"
)
MOBILITY = (
    "P. Flores, Journal bearings subjected to dynamic loads: the analytical mobility method (2006), as "
    "github.com/ibell/pdsim sets it"
)
LOBO = "D. Lobo and others (LAVI, COPPE-UFRJ), github.com/LoboDM/Lateral-Torsional-drill-strin-dunamics"
GUIDE = (
    "P. Flores, R. Leine, C. Glocker, Multibody System Dynamics 23 (2010) 165, doi 10.1007/s11044-009-9178-y, as "
    "Siconos sets it: github.com/siconos/siconos, examples/Mechanics/SliderCrank"
)
GEAR = "github.com/PanChuguang/ALGRM-Sim: no paper is known to us"
JANSEN = "arXiv 2606.25208 (2026), doi 10.48550/arXiv.2606.25208"


def cases() -> dict[str, Case]:
    """Return all cases by name."""
    found = {}
    for name, scene, speed, c, young, t_end, peaks in (
        ("press_dry", "dry", 2.0, 0.3e-3, 70e9, 40e-3, (159.3, 79.1)),
        ("press_dry_wide", "dry", 2.0, 0.8e-3, 70e9, 60e-3, (None, 430.8)),  # 159.3 is that of 0.3 mm, printed again
        ("press_dry_steel", "dry", 3.0, 0.5e-3, 206e9, 30e-3, (482.2, 540.7)),
        ("press_lubricated", "lubricated", 3.0, 0.6e-3, 70e9, 0.1, (18.61, 15.18)),
        ("press_lubricated_faster", "lubricated", 5.0, 0.6e-3, 70e9, 0.05, (46.0, 57.81)),
        ("press_lubricated_fastest", "lubricated", 8.0, 0.6e-3, 70e9, 0.05, (170.5, 174.2)),
    ):
        second, guess = press(speed * math.pi, c, young, 0.1 if scene == "lubricated" else 0.0)
        title = f"nine-bar press, {scene}, {speed:g}π rad/s, c {1e3 * c:g} mm, E {1e-9 * young:g} GPa"
        steel = {f"bearings.pin.{part}_material": "steel_45" for part in ("bearing", "journal")} if young > 1e11 else {}
        found[name] = Case(
            title,
            CHEN,
            "nine_bar_press",
            scene,
            ("A", "B"),
            t_end,
            guess,
            second,
            peaks,
            {"omega": speed * math.pi, "c": c, **steel},
        )
    for scene, sign in (("internal", -1), ("external", 1)):
        law = Pin(radius=0.01, clearance=0.5e-3, width=0.02, young=207e9, sign=sign, mu=0.03, v0=1e-3, v1=1e-2)
        drive = Wave(0.0, 5000.0 * math.pi / 30.0)
        second, guess = slider_crank((0.3, 0.21, 0.14), (1e-4, 2.5e-4, 1e-4), law, drive)
        title = f"slider-crank, 5000 rpm, c 0.5 mm, K of {scene} spheres"
        found[f"slider_crank_{scene}"] = Case(
            title, FLORES, "flores_slider_crank", scene, ("wristpin",), 2e-3, guess, second
        )
    law = Pin(radius=0.01, clearance=0.2e-3, width=0.04, viscosity=0.4)
    second, guess = slider_crank((0.3, 0.21, 0.14), (1e-4, 2.5e-4, 1e-4), law, Wave(0.0, 5000.0 * math.pi / 30.0))
    found["slider_crank_lubricated"] = Case(
        "slider-crank, 5000 rpm, c 0.2 mm, a film of 400 cP",
        FLORES_FILM,
        str(HERE / "slider_crank_lubricated.yaml"),
        "lubricated",
        ("wristpin",),
        24e-3,
        guess,
        second,
    )
    law = Pin(
        radius=0.01, clearance=0.05e-3, width=0.015, mu=0.02, v0=1e-3, v1=5e-2, exponent=2.0, stiffness=2.31797e10
    )
    second, guess = slider_crank((0.3, 0.087, 0.14), (1e-5, 4.8037e-4, 1e-2), law, Wave(math.pi / 6.0, math.pi))
    found["slider_crank_worn"] = Case(
        "slider-crank, 30 rpm, c 0.05 mm, K and exponent given",
        WORN,
        str(HERE / "slider_crank_worn.yaml"),
        "worn",
        ("wristpin",),
        0.2,
        guess,
        second,
    )
    second, guess = landing_gear()
    found["landing_gear"] = Case(
        "landing-gear retraction, c 0.05 mm in two pins", GEAR, "landing_gear", "worn", ("A", "B"), 20e-3, guess, second
    )
    for name, joints in (("one", ("X1",)), ("two", ("X1", "X2"))):
        second, guess = jansen(len(joints))
        title = f"Jansen's leg, 60 rpm, c 0.2 mm in {name} of the crank's pins"
        found[f"jansen_leg_{name}"] = Case(
            title, JANSEN, str(STUDIES / "jansen_leg_play.yaml"), name, joints, 40e-3, guess, second
        )
    rigid, guess = four_bar()
    found["four_bar_tracking"] = Case(
        "four-bar led by a torque, rigid, c 5 mm in three joints",
        SICONOS,
        str(HERE / "four_bar_tracking.yaml"),
        "tracking",
        ("J1", "J2", "J3"),
        1.0,
        guess,
        rigid,
        rows="four_bar_tracking.csv",
    )
    for name, title, source, scene, joints, t_end, (second, guess) in (
        (
            "rotor_rigid",
            "rigid rotor in short journal bearings, run up by 700 Hz/s",
            NOWALD,
            "film",
            ("bearings",),
            0.7,
            rotors.rigid_rotor(),
        ),
        (
            "rotor_elastic",
            "Jeffcott's rotor in short journal bearings, run up by 500 Hz/s",
            NOWALD,
            "film",
            ("bearings",),
            0.5,
            rotors.elastic_rotor(),
        ),
        (
            "rotor_floating_ring",
            "Jeffcott's rotor in floating-ring bearings, run up by 300 Hz/s",
            NOWALD,
            "films",
            ("outer", "inner"),
            1.0,
            rotors.floating_ring(),
        ),
        (
            "engine_bearing",
            "engine's main bearing, 2000 rpm, under its load",
            MOBILITY,
            "film",
            ("main",),
            0.12,
            rotors.engine_bearing(),
        ),
        (
            "rotor_stator",
            "unbalanced rotor against an elastic stator",
            STATOR,
            "rub",
            ("stator",),
            40e-3,
            rotors.rotor_and_stator(),
        ),
        (
            "drill_collar",
            "drill collar in its borehole, 105 rpm, 135 kN on the bit",
            LOBO,
            "whirl",
            ("borehole",),
            6.0,
            rotors.drill_collar(),
        ),
    ):
        found[name] = Case(title, source, str(HERE / f"{name}.yaml"), scene, joints, t_end, guess, second)
    guided, guess = slider_in_guide()
    corners = tuple(f"guide.{end}_{wall}" for end in ("front", "rear") for wall in ("upper", "lower"))
    found["slider_crank_guide"] = Case(
        "slider-crank let go, rigid, 1 mm beside the slider in its guide",
        GUIDE,
        str(HERE / "slider_crank_guide.yaml"),
        "free",
        corners,
        0.2,
        guess,
        guided,
        rows="slider_crank_guide.csv",
    )
    return found
