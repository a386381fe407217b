"""Writes the tables of docs/laws.md that help to choose a force law: geometry, use and limit of each law."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from gudgeon.generator.kinds.laws.law import Law

# Role: column heads after the law.
_COLUMNS: Mapping[str, tuple[str, ...]] = {
    "normal": ("geometry", "use", "run stops at"),
    "friction": ("use", "property"),
    "film": ("geometry", "use", "valid for"),
    "mixed": ("weight $b$ of the dry force", "valid for"),
}
_CYLINDERS = ("pin in a hole, parallel axes", "contacts that are narrow compared with the radii")
_TENTH = r"$\delta = R_i/10$"
# Law: cells of its row.
_CHOICE: Mapping[str, tuple[str, ...]] = {
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
    "johnson": (*_CYLINDERS, r"$\delta = 0.5\,c$"),
    "esdu_78035": (*_CYLINDERS, r"$\delta = 3.7\,c$"),
    "expression": ("any", "measured or computed elastic forces", "key `deepest`, by default $R_i/10$"),
    "newton_restitution": (
        "rigid surfaces",
        "impacts far shorter than all other motion; no force during an impact",
        "–",
    ),
    "modified_coulomb": ("no friction below $v_0$, constant above $v_1$", "creeps below $v_1$"),
    "coulomb": ("one coefficient and one characteristic slip", "creeps below $v_0$"),
    "stribeck": ("static friction falls to kinetic friction, decay $v_s$", "creeps below $v_0$"),
    "bengisu_akay": ("static friction at $v_0$, then a decay $v_d$", "creeps below $v_0$"),
    "brown_mcphee": ("smooth peak of static friction near $v_0$", "creeps below $v_0$"),
    "threlfall": ("exponential rise, constant above $v_r$", "creeps below $v_r$"),
    "dahl": ("sticking by the deflection of bristles", "static and kinetic friction are equal"),
    "lugre": (
        "sticking, with static and kinetic friction",
        r"passive at constant $F_n$ where $\sigma_1 \le 4 g_v/\lvert v_t\rvert$",
    ),
    "pinkus_sternlicht": (
        r"long bearing, $L/(2R_j) \gg 1$",
        "half film; comparison with Chen, Gao and Wang (2022)",
        r"$\lvert\omega_s\rvert \gg \lvert\dot\varepsilon\rvert$",
    ),
    "finite_length": ("finite length, open ends", "Reynolds' condition", "$L/(2R_j)$ from 0.1 to 3"),
    "ocvirk": ("short bearing", "half film or full film, with squeeze", "$L/(2R_j) < 1/2$"),
    "christensen": (
        "fraction of the area in contact; three times differentiable",
        "heights with a nearly normal distribution",
    ),
    "greenwood_tripp": (
        r"load of the asperities, as a fraction of that at $\Lambda = 0$; its slope jumps at $\Lambda = 0$",
        "heights with a normal distribution",
    ),
}


def describe_choice_of_laws(laws_by_role: Mapping[str, Iterable[Law]]) -> Iterator[str]:
    """Yield the Markdown lines of a table for each role: a row for each law, with a link to its section.

    A law without an entry in _CHOICE has its title in the first column.
    """
    yield from ("## Choice of a law", "")
    yield (
        "The tables list the laws by the key of a contact, with the geometry and the use of each law. A run stops where"
        " the law of its normal force is no longer valid. It also stops at a penetration of $R_i/10$ if that is smaller"
        " than the limit of the law. In a guide, the half-height of the slider plus the gap replaces $R_i$."
    )
    yield from ("", "All friction laws are for any geometry, and both laws of mixed lubrication for rough surfaces.")
    for role, laws in laws_by_role.items():
        columns = _COLUMNS[role]
        yield from ("", f"Laws of the key `{role}`:", "")
        yield from (f"| `law` | {' | '.join(columns)} |", "|" + "---|" * (1 + len(columns)))
        for law in laws:
            cells = _CHOICE.get(law.name, (law.title, *["–"] * (len(columns) - 1)))
            yield f"| [`{law.name}`](#{law.name}) | {' | '.join(cells)} |"
    yield ""
