"""Contains the letters of the theory in a scene's documents, with their meaning; user-defined names give way to them.

The sketches of joint types and force elements contain such letters, too.
"""

from __future__ import annotations

import inspect
import re
import unicodedata
from collections.abc import Iterable, Iterator

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Step
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.kinds.forces.force_type import ElementType, element_types
from gudgeon.generator.kinds.joints.joint_type import JointType, joint_types
from gudgeon.generator.targets.latex.letters import Name, letter, of_latex
from gudgeon.generator.targets.latex.play_letters import given, joint_letters, laws_of, names, result, sign_of

_RAISED = str.maketrans(dict.fromkeys("²³⁰¹⁻", " "))


def sketch_of(of: JointType | ElementType) -> list[str]:
    """Return the description of a joint type or force element: a line, then its sketch."""
    summary, _, rest = inspect.cleandoc(of.doc or "").partition("\n")
    return [summary, *rest.strip("\n").splitlines()]


def letters_of(lines: list[str]) -> Iterator[str]:
    """Return the letters that stand alone in a sketch, with subscripts; those with dots also without them.

    No part of a drawing ("o---"), no initial ("L. C. Bo"), no article.
    """
    alone = re.compile(r"(?<![\w.'-])(?!(?:a|A|I) [a-z]{2})([^\W\d_]\u0307?\u0307?(?:_\w+)?)(?![\w.'-])")
    for line in lines:
        for found in alone.findall(unicodedata.normalize("NFD", line).translate(_RAISED)):
            yield from dict.fromkeys((found, found.replace("\u0307", "")))


PHI, NU, GAMMA = Name(r"\Phi", "Φ"), Name(r"\nu", "ν"), Name(r"\gamma", "γ")
LAMBDA, PHI_Q = Name(r"\lambda", "λ"), Name(r"\Phi_{q}", "Φ_q")


def indexed(of: Name, index: int) -> Name:
    """Return a component of a vector; they count from 1."""
    return Name(f"{of.latex}_{{{index}}}", f"{of.text}_{index}")


def theory(model: Model) -> dict[str, str]:
    """Return the meaning of each letter of the theory, by its plain text."""
    found: dict[str, str] = {}
    for text, meaning in _letters(model):
        found.setdefault(text, meaning)
    found.pop("t", None)  # time everywhere
    return found


def _letters(model: Model) -> Iterator[tuple[str, str]]:
    """Yield the letters of the theory with their meaning."""
    yield from (("n", "number of coordinates"), ("q", "coordinates"), ("x", "an axis"), ("y", "an axis"))
    yield from (("M", "mass matrix"), ("g", "generalized forces"), ("a", "accelerations, in the C"))
    yield from ((f"g_{k}", "a generalized force") for k in range(1, 1 + len(model.q)))
    if model.rows:
        yield from _of_rows(model)
    values = [*(e for row in model.rows for e in (row.phi, row.nu, row.gamma)), *model.symbols.definitions.values()]
    if any(sp.sympify(value).has(sp.Heaviside) for value in values):
        yield "H", "unit step"
    yield from ((name, "a curve of the file") for name in model.scene.mechanism.curves)
    for clearance in model.clearances:
        message = f"a letter of {clearance.kind} {clearance.name} with play"
        yield from ((text, message) for text in _of_play(model, clearance))
    yield from _of_forces(model)
    yield from ((letter("z", event.name).text, f"event {event.name}") for event in model.events)
    for kind in dict.fromkeys(joint.kind for joint in model.scene.mechanism.joints.values()):
        yield from _of_sketch(joint_types()[kind])


def _of_rows(model: Model) -> Iterator[tuple[str, str]]:
    """Yield the letters of constraint equations."""
    for name, what in (
        (PHI, "constraints"),
        (LAMBDA, "multipliers"),
        (NU, "right sides of velocities"),
        (GAMMA, "right sides of accelerations"),
    ):
        yield name.text, what
        yield from ((indexed(name, k).text, f"one of the {what}") for k in range(1, 1 + len(model.rows)))
    yield from ((f"Φ_{by}", "a derivative of the constraints") for by in ("q", "t", "qt", "tt"))


def _of_forces(model: Model) -> Iterator[tuple[str, str]]:
    """Yield the letters of force elements and friction."""
    for name, applied in model.elements.items():
        if applied.loads.potential != 0:
            yield letter("V", name).text, f"potential energy of {name}"
    for friction in model.frictions:
        for base in ("v", "gamma"):
            yield letter(base, friction.name).text, f"slip of {friction.name}"
        columns = (letter("J", friction.name, str(k)) for k in range(1, 1 + len(model.q)))
        yield from ((name.text, f"slip of {friction.name}") for name in columns)
    for kind in dict.fromkeys(applied.element.kind for applied in model.elements.values()):
        yield from _of_sketch(element_types()[kind])


def _of_sketch(of: JointType | ElementType) -> Iterator[tuple[str, str]]:
    """Yield the letters of a sketch."""
    return ((text, f"in the sketch: {of.title}") for text in letters_of(sketch_of(of)))


def _of_play(model: Model, clearance: Clearance) -> Iterator[str]:
    """Yield the letters of a joint with play: its parameters, laws and steps."""
    shown = {contact.stored, *_symbols(_steps(clearance))}
    may_be = names(clearance)
    yield from (
        name.text for symbol, name in joint_letters(model, clearance).items() if symbol in shown or symbol not in may_be
    )
    for equations, use in laws_of(model, clearance):
        yield from (of_latex(sign_of(parameter)).text for parameter, _ in given(equations, use))
    yield from ("i", "j", "n")
    if clearance.normal is not None and clearance.film is not None:
        yield from ("d", "f", "b")
    if clearance.contour:
        yield from ("W", "F", "w")


def _steps(clearance: Clearance) -> Iterator[Step]:
    """Yield the steps that a joint with play has."""
    yield from (
        Step(symbol, sp.Integer(0))
        for symbol in (contact.e_x, contact.e_y, contact.de_x, contact.de_y, contact.omega_i, contact.omega_j)
    )
    if clearance.contour:
        yield Step(contact.theta_i, contact.steep)
    yield from contact.gap(clearance)
    if clearance.normal is not None:
        yield from (*contact.before_dry(clearance), *contact.pressing(clearance), *contact.after_dry(clearance))
    if clearance.film is not None:
        yield from (*contact.before_film(clearance, clearance.film), *contact.after_film(clearance.film))
    yield from contact.resultant(clearance)
    for equations in clearance.laws:
        yield from (Step(result(equations, name), sp.sympify(step)) for name, step in equations.steps.items())


def _symbols(steps: Iterable[Step]) -> Iterator[sp.Symbol]:
    """Yield the symbols of steps."""
    for step in steps:
        yield step.symbol
        yield from sp.sympify(step.value).free_symbols
