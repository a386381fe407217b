"""Writes the table of docs/laws.md that helps to choose a force law: geometry, use and limit of each law."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from gudgeon.generator.kinds.laws.law import Law

_CYLINDERS = ("pin in a hole, parallel axes", "contacts that are narrow compared with the radii")
_TENTH = r"$\delta \le R_i/10$"
# Law: geometry, use, limit.
_CHOICE: Mapping[str, tuple[str, str, str]] = {
    "lankarani_nikravesh": ("spheres, by `geometry`", "comparison with publications, $c_e$ near 1", _TENTH),
    "hertz": (
        "spheres, or a given stiffness",
        "impacts with any $c_e$: `dissipation: exact` delivers it",
        _TENTH,
    ),
    "kelvin_voigt": ("any, by a given stiffness", "the same restitution at every speed", _TENTH),
    "liu": (
        "pin in a hole, parallel axes",
        r"conforming cylinders, $\delta$ up to some clearances",
        _TENTH,
    ),
    "johnson": (*_CYLINDERS, r"$\delta \le 0.5\,c$"),
    "esdu_78035": (*_CYLINDERS, r"$\delta \le 3.7\,c$"),
    "expression": (
        "any",
        "measured or computed elastic forces",
        r"$\delta$ up to the key `deepest`, by default $R_i/10$",
    ),
    "newton_restitution": ("rigid surfaces", "impacts far shorter than all other motion", "no force during an impact"),
    "modified_coulomb": ("any", "no friction below $v_0$, constant above $v_1$", "creeps below $v_1$"),
    "coulomb": ("any", "one coefficient and one characteristic slip", "creeps below $v_0$"),
    "stribeck": ("any", "static friction falls to kinetic friction, decay $v_s$", "creeps below $v_0$"),
    "bengisu_akay": ("any", "static friction at $v_0$, then a decay $v_d$", "creeps below $v_0$"),
    "brown_mcphee": ("any", "smooth peak of static friction near $v_0$", "creeps below $v_0$"),
    "threlfall": ("any", "exponential rise, constant above $v_r$", "creeps below $v_r$"),
    "dahl": ("any", "sticking by the deflection of bristles", "static and kinetic friction are equal"),
    "lugre": (
        "any",
        "sticking, with static and kinetic friction",
        r"dissipative where $\sigma_1 \le 4 g_v/\lvert v_t\rvert$",
    ),
    "pinkus_sternlicht": (
        r"long bearing, $L/(2R_j) \gg 1$",
        "half film; comparison with Chen, Gao and Wang (2022)",
        r"$\lvert\omega_s\rvert \gg \lvert\dot\varepsilon\rvert$",
    ),
    "finite_length": ("finite length, open ends", "Reynolds' condition", "$L/(2R_j)$ from 0.1 to 3"),
    "ocvirk": ("short bearing", "half film or full film, with squeeze", "$L/(2R_j) < 1/2$"),
    "christensen": (
        "rough surfaces",
        "film and contact share the area; $b$ is three times differentiable",
        "heights with a nearly normal distribution",
    ),
    "greenwood_tripp": (
        "rough surfaces",
        r"load of the asperities; the slope of $b$ jumps at $\Lambda = 0$",
        "heights with a normal distribution",
    ),
}


def describe_choice_of_laws(laws_by_role: Mapping[str, Iterable[Law]]) -> Iterator[str]:
    """Yield the Markdown lines of the table: a row for each law, with a link to its section.

    A law without an entry in _CHOICE has its title as use.
    """
    yield from ("## Choice of a law", "")
    yield (
        "The limit of a normal force is the penetration at which a run stops. A run also stops at $R_i/10$ if that is"
        " smaller. In a guide, the half-height of the slider plus the gap replaces $R_i$."
    )
    yield from ("", "| key | `law` | geometry | use | limit |", "|" + "---|" * 5)
    for role, laws in laws_by_role.items():
        for law in laws:
            geometry, use, limit = _CHOICE.get(law.name, ("–", law.title, "–"))
            yield f"| `{role}` | [`{law.name}`](#{law.name}) | {geometry} | {use} | {limit} |"
    yield ""
