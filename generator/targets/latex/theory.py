"""Lists the symbols that a document of equations reserves, with their meanings; user-defined names must differ.

The sketches of joint types and force elements contain such symbols, too.
"""

from __future__ import annotations

import inspect
import re
import unicodedata
from collections.abc import Iterable, Iterator

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Assignment
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.kinds.forces.force_type import ElementType, find_element_types
from gudgeon.generator.kinds.joints.joint_type import JointType, find_joint_types
from gudgeon.generator.targets.latex.letters import Formula, make_name_from_latex, make_symbol_name
from gudgeon.generator.targets.latex.play_letters import (
    get_latex_symbol,
    get_result_symbol,
    list_joint_laws,
    list_specified_parameters,
    name_contact_variables,
    name_joint_symbols,
)

_SUPERSCRIPTS_TO_SPACES = str.maketrans(dict.fromkeys("²³⁰¹⁻", " "))


def read_sketch(type_: JointType | ElementType) -> list[str]:
    """Return the docstring of a joint type or force element as lines: its first line, then the lines of the sketch."""
    summary, _, sketch = inspect.cleandoc(type_.doc or "").partition("\n")
    return [summary, *sketch.strip("\n").splitlines()]


def find_sketch_symbols(lines: list[str]) -> Iterator[str]:
    """Yield the symbols in the lines of a joint type's or force element's sketch, in their order and with repetitions.

    A symbol is one letter, with dots (time derivatives) and a subscript if it has them, such as "θ_i". A symbol with
    dots is also yielded without them. A letter next to a letter, digit, ".", "-" or "'" is not a symbol ("o---",
    "L. C. Bo"), and neither is "a", "A" or "I" before a word.
    """
    symbol = re.compile(r"(?<![\w.'-])(?!(?:a|A|I) [a-z]{2})([^\W\d_]\u0307?\u0307?(?:_\w+)?)(?![\w.'-])")
    for line in lines:
        for text in symbol.findall(unicodedata.normalize("NFD", line).translate(_SUPERSCRIPTS_TO_SPACES)):
            yield from dict.fromkeys((text, text.replace("\u0307", "")))


PHI, NU, GAMMA = Formula(r"\Phi", "Φ"), Formula(r"\nu", "ν"), Formula(r"\gamma", "γ")
LAMBDA, PHI_Q = Formula(r"\lambda", "λ"), Formula(r"\Phi_{q}", "Φ_q")


def name_component(vector: Formula, index: int) -> Formula:
    """Return the name of a component of a vector; components count from 1."""
    return Formula(f"{vector.latex}_{{{index}}}", f"{vector.text}_{index}")


def collect_theory_symbols(model: Model) -> dict[str, str]:
    """Return {plain text of a symbol: meaning} of the theory in a scene's document; user-defined names avoid these.

    A symbol with several meanings has the first one. The time t is left out, since a user cannot define it.
    """
    meanings: dict[str, str] = {}
    for text, meaning in _list_theory_symbols(model):
        meanings.setdefault(text, meaning)
    meanings.pop("t", None)
    return meanings


def _list_theory_symbols(model: Model) -> Iterator[tuple[str, str]]:
    """Yield (plain text of a symbol, meaning) of all reserved symbols of a scene's document; symbols may repeat.

    They are those of constraint equations, unit step, curves, joints with play, force elements, events and sketches, as
    far as the scene has them.
    """
    yield from (("n", "number of coordinates"), ("q", "coordinates"), ("x", "an axis"), ("y", "an axis"))
    yield from (("M", "mass matrix"), ("g", "generalized forces"), ("a", "accelerations, in the C"))
    yield from ((f"g_{k}", "a generalized force") for k in range(1, 1 + len(model.q)))
    if model.rows:
        yield from _list_constraint_symbols(model)
    values = [*(e for row in model.rows for e in (row.phi, row.nu, row.gamma)), *model.symbols.definitions.values()]
    if any(sp.sympify(value).has(sp.Heaviside) for value in values):
        yield "H", "unit step"
    yield from ((name, "a curve of the file") for name in model.scene.mechanism.curves)
    for clearance in model.clearances:
        meaning = f"a symbol of {clearance.kind} {clearance.name} with play"
        yield from ((text, meaning) for text in _list_clearance_symbols(model, clearance))
    yield from _list_force_element_symbols(model)
    yield from ((make_symbol_name("z", event.name).text, f"event {event.name}") for event in model.events)
    for kind in dict.fromkeys(joint.kind for joint in model.scene.mechanism.joints.values()):
        yield from _list_sketch_symbols(find_joint_types()[kind])


def _list_constraint_symbols(model: Model) -> Iterator[tuple[str, str]]:
    """Yield (symbol, meaning) of Φ, λ, ν and γ, of their components, and of the derivatives of Φ."""
    for name, meaning in (
        (PHI, "constraints"),
        (LAMBDA, "multipliers"),
        (NU, "right sides of velocities"),
        (GAMMA, "right sides of accelerations"),
    ):
        yield name.text, meaning
        yield from ((name_component(name, k).text, f"one of the {meaning}") for k in range(1, 1 + len(model.rows)))
    yield from ((f"Φ_{variables}", "a derivative of the constraints") for variables in ("q", "t", "qt", "tt"))


def _list_force_element_symbols(model: Model) -> Iterator[tuple[str, str]]:
    """Yield (symbol, meaning) of potential energies, of friction elements, and of the sketches of force elements."""
    for name, applied in model.elements.items():
        if applied.loads.potential != 0:
            yield make_symbol_name("V", name).text, f"potential energy of {name}"
    for friction in model.frictions:
        for base in ("v", "gamma"):
            yield make_symbol_name(base, friction.name).text, f"slip of {friction.name}"
        jacobian_entries = (make_symbol_name("J", friction.name, str(k)) for k in range(1, 1 + len(model.q)))
        yield from ((name.text, f"slip of {friction.name}") for name in jacobian_entries)
    for kind in dict.fromkeys(applied.element.kind for applied in model.elements.values()):
        yield from _list_sketch_symbols(find_element_types()[kind])


def _list_sketch_symbols(type_: JointType | ElementType) -> Iterator[tuple[str, str]]:
    """Yield (symbol, meaning) of the symbols in the sketch of a joint type or force element."""
    return ((text, f"in the sketch: {type_.title}") for text in find_sketch_symbols(read_sketch(type_)))


def _list_clearance_symbols(model: Model, clearance: Clearance) -> Iterator[str]:
    """Yield the plain text of the symbols of a joint with play: variables, parameters, laws, indices i, j, n, d, f."""
    used_symbols = {contact.stored_approach_speed, *_list_assignment_symbols(_list_clearance_assignments(clearance))}
    step_names = name_contact_variables(clearance)
    yield from (
        name.text
        for symbol, name in name_joint_symbols(model, clearance).items()
        if symbol in used_symbols or symbol not in step_names
    )
    for equations, use in list_joint_laws(model, clearance):
        yield from (
            make_name_from_latex(get_latex_symbol(parameter)).text
            for parameter, _ in list_specified_parameters(equations, use)
        )
    yield from ("i", "j", "n")
    if clearance.normal is not None and clearance.film is not None:
        yield from ("d", "f", "b")
    if clearance.contour:
        yield "d"


def _list_clearance_assignments(clearance: Clearance) -> Iterator[Assignment]:
    """Yield the equations of a joint with play from eccentricity to force, those of its laws included."""
    yield from (
        Assignment(symbol, sp.Integer(0))
        for symbol in (contact.e_x, contact.e_y, contact.de_x, contact.de_y, contact.omega_i, contact.omega_j)
    )
    if clearance.contour:
        yield Assignment(contact.theta_i, contact.gradient_length)
    yield from contact.make_gap_equations(clearance)
    if clearance.normal is not None:
        yield from (
            *contact.make_lever_arm_equations(clearance),
            *contact.make_contour_normal_force(clearance),
            *contact.make_dry_moment_equations(clearance),
        )
    if clearance.film is not None:
        yield from (
            *contact.make_film_input_equations(clearance, clearance.film),
            *contact.make_film_moment_equations(clearance.film),
        )
    yield from contact.make_resultant_equations(clearance)
    for equations in clearance.laws:
        yield from (
            Assignment(get_result_symbol(equations, name), sp.sympify(value))
            for name, value in equations.equations_by_name.items()
        )


def _list_assignment_symbols(assignments: Iterable[Assignment]) -> Iterator[sp.Symbol]:
    """Yield the symbols of assignments: each result, then the symbols in its value."""
    for assignment in assignments:
        yield assignment.symbol
        yield from sp.sympify(assignment.value).free_symbols
