"""Write an exercise sheet of a scene as two documents: questions, and questions with solutions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp

from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.targets.latex.document import (
    Block,
    Document,
    Equation,
    Section,
    Sketch,
    make_paragraph,
    make_row,
    make_tables,
)
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.mechanism import (
    format_drive_value,
    format_point,
    list_field_rows,
    make_mechanism_sections,
)
from gudgeon.generator.targets.latex.notation import Notation, make_notation
from gudgeon.generator.targets.latex.theory import read_sketch
from gudgeon.generator.targets.latex.values import ValueFormatter, get_unit
from gudgeon.generator.targets.latex.write import append_paper_section, prepend_symbols_section
from gudgeon.language.text_output import format_one_line
from gudgeon.language.tree import Number
from gudgeon.teaching.draw_parameters import ROUNDING_TOL

if TYPE_CHECKING:
    from gudgeon.generator.equations.constraints import Row
    from gudgeon.generator.equations.model import Model
    from gudgeon.generator.mechanism import Drive, Scene
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.teaching.draw_parameters import ExerciseData

GIVEN_SECTIONS = ("Bodies", "Ground", "Curves", "Parameters")  # sections of the equations page without answers
MAX_OPERATIONS = 60  # of an expression that a solution shows


@dataclass(frozen=True)
class Question:
    """A question and its solution; `numbers` are the answers in SI units by name."""

    title: str
    requested: tuple[Block, ...]
    solved: tuple[Block, ...]
    numbers: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Subject:
    """Data of all questions: a scene's equations, notation, drawn parameter values, selected constraint equations."""

    model: Model
    notation: Notation
    simulation: Simulation
    exercise: ExerciseData
    rng: np.random.Generator
    owners: tuple[str, ...]  # joints and drives whose constraint equations the questions treat

    @property
    def selected_rows(self) -> list[tuple[int, Row]]:
        """Return the constraint equations of the joints and drives in `owners`, with their numbers, from 1."""
        return [(k, row) for k, row in enumerate(self.model.rows, 1) if row.owner in self.owners]

    def format_number(self, x: float, digits: int = 4, scale: float = 0.0, uncertainty: float = 0.0) -> Formula:
        """Return a number as text and LaTeX, rounded to significant digits.

        It is 0 below ROUNDING_TOL times `scale`, the size of similar numbers, and below half the `uncertainty` from the
        rounded data. The uncertainty also limits the printed digits.
        """
        if abs(x) <= max(ROUNDING_TOL * scale, 0.5 * uncertainty):
            return Formula("0", "0")
        if uncertainty > 0.0:
            digits = min(digits, max(1, math.floor(math.log10(abs(x))) - math.ceil(math.log10(uncertainty)) + 1))
        short = float(f"{x:.{digits}g}")
        return self.notation.format_expression(sp.Integer(0) if short == 0.0 else sp.Float(short, 17))

    def make_equation(self, left: Formula | sp.Symbol, right: sp.Expr) -> Equation:
        """Return the equation left = right in the notation of the document."""
        name = left if isinstance(left, Formula) else self.notation.format_expression(left)
        return Equation(name, self.notation.format_terms(self.notation.expand_symbols(right)))

    def make_value_equation(
        self, left: Formula, x: float, unit: str = "", scale: float = 0.0, uncertainty: float = 0.0
    ) -> Equation:
        """Return the equation left = number unit; scale, uncertainty: as for format_number()."""
        number = self.format_number(x, scale=scale, uncertainty=uncertainty)
        sign = unit.replace("²", "^{2}").replace(" ", r" \, ")
        return Equation(left, (Formula(rf"{number.latex} \; \mathrm{{{sign}}}", f"{number.text} {unit}".rstrip()),))


def make_subject(model: Model, simulation: Simulation, exercise_data: ExerciseData, seed: int) -> Subject:
    """Return the subject of a sheet; its questions treat at most two joints and one drive, drawn from the seed."""
    rng = np.random.default_rng([seed, 1])
    owners_by_kind = {
        kind: list(dict.fromkeys(r.owner for r in model.rows if r.kind == kind)) for kind in ("joint", "drive")
    }
    selected = [
        name
        for kind, max_count in (("joint", 2), ("drive", 1))
        for name in np.array(owners_by_kind[kind], object)[
            sorted(rng.permutation(len(owners_by_kind[kind]))[:max_count])
        ]
    ]
    return Subject(model, make_notation(model), simulation, exercise_data, rng, tuple(selected))


def list_units(scene: Scene) -> dict[str, tuple[str, float]]:
    """Return the unit in the file and its value in SI, by address, of parameters, masses, inertias and lengths.

    Values without a unit, zeros and expressions are left out.
    """
    bodies, units = scene.mechanism.bodies.values(), dict[str, tuple[str, float]]()
    for quantity in (*scene.parameters.values(), *(x for b in bodies for x in (b.mass, b.inertia, b.length))):
        number = quantity.value if quantity is not None else None
        if quantity is not None and isinstance(number, Number) and number.value and (unit := get_unit(number)):
            units[quantity.address] = unit, number.value / float(number.text.strip().removesuffix(unit))
    return units


def make_sheets(subject: Subject, questions: Sequence[Question], seed: int) -> tuple[Document, Document]:
    """Return two documents: the sheet of questions, and the same with solutions and the drawn parameter values."""
    mechanism, scene = subject.model.scene.mechanism, subject.model.scene.name
    facts = (("mechanism ", mechanism.name, f", scene {scene}, seed {seed}"),)
    title = format_one_line(mechanism.title or mechanism.name)
    given_sections = tuple(_build_given_sections(subject))
    question_sections = tuple(Section(f"{k}. {x.title}", x.requested) for k, x in enumerate(questions, 1))
    solution_sections = tuple(_build_solution_sections(k, question) for k, question in enumerate(questions, 1))
    value_section = Section("Parameter values", tuple(_build_repetition_blocks(subject)))
    notation = subject.notation
    sheet = Document(
        f"Exercise: {title}",
        facts,
        append_paper_section(prepend_symbols_section((*given_sections, *question_sections), notation)),
    )
    sections = append_paper_section(
        prepend_symbols_section((*given_sections, *sum(solution_sections, ()), value_section), notation)
    )
    return sheet, replace(sheet, title=f"Solutions: {title}", sections=sections)


def _build_solution_sections(k: int, question: Question) -> tuple[Section, ...]:
    """Return the sections of question k and of its solution."""
    return Section(f"{k}. {question.title}", question.requested), Section("Solution", question.solved, 2)


def _build_given_sections(subject: Subject) -> list[Section]:
    """Return the sections with bodies, points, joints, drives, forces and parameters, each with its symbol."""
    model, notation = subject.model, subject.notation
    sections = {
        section.title: section
        for section in make_mechanism_sections(model, notation)
        if section.title in GIVEN_SECTIONS
    }
    joints = Section("Joints and drives", tuple(_build_joint_blocks(subject)))
    forces = [Section("Gravity and forces", blocks)] if (blocks := tuple(_build_force_blocks(subject))) else []
    last = [title for title in ("Curves", "Parameters") if title in sections]
    first = [sections[title] for title in sections if title not in last]
    return [*first, joints, *forces, *(sections[title] for title in last)]


def _build_joint_blocks(subject: Subject) -> list[Block]:
    """Return tables of joints and drives, and a sketch of each type of joint, without constraint equations."""
    model, values = subject.model, ValueFormatter(subject.model, subject.notation)
    mechanism, rows = model.scene.mechanism, []
    for joint in mechanism.joints.values():
        joint_type = find_joint_types()[joint.kind]
        ends = [format_point(ref, joint_type.joins) for ref in (joint.first, joint.second)]
        rows.append(
            make_row(joint.name, joint_type.title + (", has play" if joint.name in model.scene.play else ""), *ends)
        )
    blocks = make_tables(make_row("joint", "type", "first", "second"), rows)
    fields = [row for joint in mechanism.joints.values() for row in list_field_rows(joint, values)]
    blocks += make_tables(make_row("joint", "field", "value"), fields)
    driven = [
        make_row(drive.name, _format_driven_quantity(drive), format_drive_value(model, subject.notation, drive.name))
        for drive in mechanism.drives.values()
    ]
    blocks += make_tables(make_row("drive", "prescribes", "value"), driven, (2,)) + values.pop_long_expressions()
    for kind in dict.fromkeys(joint.kind for joint in mechanism.joints.values()):
        summary, *lines = read_sketch(find_joint_types()[kind])
        blocks += [make_paragraph(summary), Sketch(tuple(lines))]
    return blocks


def _build_force_blocks(subject: Subject) -> list[Block]:
    """Return gravity and tables of the force elements as blocks; [] if there are neither."""
    model, values = subject.model, ValueFormatter(subject.model, subject.notation)
    gravity, elements = model.scene.mechanism.gravity, [e.element for e in model.elements.values()]
    blocks = make_tables(make_row("gravity"), [make_row(values.format_vector(gravity))]) if gravity is not None else []
    kinds = {element.name: find_element_types()[element.kind] for element in elements}
    rows = [
        make_row(e.name, kinds[e.name].title, " and ".join(format_point(x, kinds[e.name].targets) for x in e.targets))
        for e in elements
    ]
    blocks += make_tables(make_row("element", "type", "acts on"), rows)
    blocks += make_tables(
        make_row("element", "field", "value"), [r for e in elements for r in list_field_rows(e, values)]
    )
    return blocks + values.pop_long_expressions()


def _format_driven_quantity(drive: Drive) -> str:
    """Return what a drive prescribes, as text: "angle of crank against frame" or "distance of A.P and B.Q"."""
    kind, points = drive.kind, drive.points
    if kind == "distance":
        return "distance of " + " and ".join(f"{p.body}.{p.point}" for p in points)
    quantity = "angle" if kind == "angle" else drive.coordinate
    reference = drive.reference
    return f"{quantity} of {drive.body}" + (f" against {reference}" if reference else "")


def _build_repetition_blocks(subject: Subject) -> list[Block]:
    """Return a paragraph that lists the drawn parameter values and the time of the sheet, to repeat the run."""
    exercise = subject.exercise
    if not exercise.parameters:
        return [make_paragraph(f"All values are those of the file; the time is {exercise.t:g} s.")]
    value_texts = [f"{address} = {x}" for address, x in exercise.parameters.items()]
    return [
        make_paragraph(f"Drawn: {', '.join(value_texts)}; the time is {exercise.t:g} s. Other values are the file's.")
    ]
