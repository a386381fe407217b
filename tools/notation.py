"""Write docs/notation.md: letter, YAML key, series and C name of each quantity, from the declarations.

Letters of a joint with play are those of the LaTeX target, units and series those of a result, keys and letters of the
laws' parameters those of their declarations. The paper is X. Chen, S. Gao, T. Wang, Nonlinear Dynamics (2022),
doi 10.1007/s11071-022-07478-4; where its letter is another one, the table has it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import sympy as sp

from gudgeon.generator.equations import contact_steps as steps
from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.format.sections import BEARING, BODY, CONTACT, GUIDE, MATERIAL
from gudgeon.generator.kinds.laws.law import RESULTS, find_bundled_laws
from gudgeon.generator.targets.latex.letters import make_symbol_name
from gudgeon.generator.targets.latex.notation import get_field_letter
from gudgeon.generator.targets.latex.play import PAIR
from gudgeon.generator.targets.latex.play_letters import NAMES, get_latex_symbol
from gudgeon.language.units import find_si_unit
from gudgeon.results.series import CLEARANCE

PAGE = Path(__file__).resolve().parents[1] / "docs" / "notation.md"
LEAD = """# Notation

One letter, one sign and one unit for each quantity, in the paper, the equations, YAML, Python and C. A teacher finds
here which name in the generated C belongs to a letter on the blackboard. `make tables` writes this page from the
declarations.

All values are in SI units, angles in radians. `JOINT`, `BODY` and `NAME` stand for names of the file.
"""
SYSTEM = (
    ("q", "coordinates of all bodies: x, y, θ of each", "q", "`run.q`", "`q`", "m, rad"),
    ("v = \\dot q", "their rates", "\\dot q", "`run.v`", "`v`", "m/s, rad/s"),
    ("a = \\ddot q", "their second rates", "\\ddot q", "`run.a`", "`a`", "m/s², rad/s²"),
    ("M", "mass matrix, diagonal", "M", "`numpy().mass_matrix`", "`mass_matrix`", "kg, kg·m²"),
    ("\\Phi", "constraint equations", "\\Phi", "`numpy().phi`", "`constraints`", "m, rad"),
    ("\\Phi_q", "Jacobian of the constraints", "\\Phi_q", "`numpy().phi_q`", "`jacobian`", ""),
    ("\\nu = -\\Phi_t", "right-hand side of the velocity equation", "\\upsilon", "`numpy().nu`", "`velocity_rhs`", ""),
    ("\\gamma", "right-hand side of the acceleration equation", "\\gamma", "`numpy().gamma`", "`acceleration_rhs`", ""),
    ("\\lambda", "Lagrange multipliers of the constraints", "\\lambda", "`lambda.ROW`", "`rhs->lambda`", "N, N·m"),
)
PLAY = {  # series: symbol of the equations, the paper's letter
    "Fx": (steps.F_x, ""),
    "Fy": (steps.F_y, ""),
    "Fn": (sp.Symbol("F_n", real=True), "F_n"),
    "Ft": (steps.F_along_t, "F_t"),
    "ex": (steps.e_x, "e_x"),
    "ey": (steps.e_y, "e_y"),
    "e": (steps.e, "e"),
    "deltadot": (steps.deltadot, "\\dot\\delta"),
    "vt": (steps.v_t, "v_t"),
    "delta": (steps.delta, "\\delta"),
}  # series of CLEARANCE
C_MEMBER = {"Fn": "F_n", "Ft": "F_t", "vt": "v_t"}
SECTIONS = (
    ("bearings.NAME", BEARING),
    ("scenes.SCENE.play.JOINT.guide", GUIDE),
    ("materials.NAME", MATERIAL),
    ("bodies.BODY", BODY),
    ("contacts.NAME", CONTACT),
)
IN_LAWS = {field: sign for field, sign, _ in PAIR}  # letters of a bearing in the laws
IN_PAPER = {
    "bearings.NAME.clearance": "r",
    "bearings.NAME.radius": "R_i",
    "bearings.NAME.length": "L",
    "materials.NAME.E": "E",
    "materials.NAME.nu": "\\nu",
    "bodies.BODY.mass": "m",
    "bodies.BODY.inertia": "J",
    "bodies.BODY.length": "L",
}


def notation() -> str:
    """Return the page: the equations of motion, a joint with play, parameters of the file, parameters of the laws."""
    head = ("letter", "quantity", "in the paper", "Python", "C", "unit")
    lines = [LEAD, "## Equations of motion", ""]
    lines += _table(head, ((f"${row[0]}$", row[1], f"${row[2]}$", *row[3:]) for row in SYSTEM))
    lines += [
        "",
        "## A joint with play",
        "",
        "Of each joint with play; n points from the bearing's centre to the journal's,",
    ]
    lines += ["t is n turned by +90°. C has the values in `rhs->clearance[i]`.", ""]
    lines += _table(head, _of_play())
    lines += [
        "",
        "## Parameters of the file",
        "",
        "Python: `parameters={KEY: value}`. In C `model.h` declares each parameter, with its key in a comment.",
        "",
    ]
    parameter_head = ("letter", "quantity", "in the paper", "YAML and Python", "unit")
    lines += _table(parameter_head, (row for path, record in SECTIONS for row in _of_record(path, record)))
    lines += ["", "## Parameters of the laws", ""]
    lines += _table(("letter", "quantity", "law", "YAML and Python", "unit"), _of_laws())
    return "\n".join([*lines, ""])


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    head = tuple(head)
    return [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]


def _of_play() -> Iterator[tuple[str, ...]]:
    for name, (_, unit, meaning) in CLEARANCE.items():
        symbol, paper = PLAY[name]
        shown = NAMES[symbol].latex if symbol in NAMES else "F_t"
        yield (
            f"${shown}$",
            meaning,
            f"${paper}$" * bool(paper),
            f"`JOINT.{name}`",
            f"`{C_MEMBER.get(name, name)}`",
            unit,
        )


def _of_record(path: str, record: Field) -> Iterator[tuple[str, ...]]:
    for field in record.fields:
        if field.kind == NUMBER:
            key = f"{path}.{field.name}"
            own = make_symbol_name(get_field_letter(field.name)).latex
            shown = IN_LAWS.get(field.name, own) if record is BEARING else own
            paper = IN_PAPER.get(key, "")
            yield f"${shown}$", field.meaning, f"${paper}$" * bool(paper), f"`{key}`", _unit(field)


def _of_laws() -> Iterator[tuple[str, ...]]:
    for role in RESULTS:
        for law in find_bundled_laws().values():
            for field in law.parameters if law.role == role else ():
                key = f"contacts.NAME.{role}.{field.name}"
                yield (
                    f"${get_latex_symbol(field)}$",
                    field.meaning,
                    f"`{law.name}`",
                    f"`{key}`",
                    _unit(field),
                )


def _unit(field: Field) -> str:
    return (find_si_unit(field.dimension) if field.dimension is not None else "") or ""


if __name__ == "__main__":
    PAGE.write_text(notation(), encoding="utf-8")
