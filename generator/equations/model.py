"""The derived equations of one scene, from which the C code is emitted and which Python programs can read.

Every member is in the derived symbols of the geometry (cos θ, arms, drive angles), except the properties Phi, Phi_q,
nu, gamma, M and g, which are written out in q, q̇, t and parameters.
The events of the user are here as well: a run records the time at which an expression of t and the motion crosses
zero, or ends there. A crossing is a change of sign: "rising" from below zero to above it, "falling" in the other
direction, "both" either. A zero that is touched without a change of sign is not an event. A run does not cross a zero
on which it starts, so that it resumes from the state at which an event ended another run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import sympy as sp

from gudgeon.errors import BadValueError
from gudgeon.generator.equations.constraints import Constraints, Row
from gudgeon.generator.equations.fields import MotionNameResolver
from gudgeon.generator.equations.geometry import BodySymbols, Geometry
from gudgeon.generator.equations.loads import AppliedElement, Friction, make_applied_element, make_friction
from gudgeon.generator.equations.play import Clearance, make_clearances
from gudgeon.generator.equations.user_defined_laws import check_user_defined_laws
from gudgeon.generator.ir.finite_slopes import convert_to_heaviside_form
from gudgeon.generator.mechanism import EventSpec, Joint, Quantity, Scene
from gudgeon.generator.symbols.from_expressions import convert_quantity_to_sympy
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.symbols import Symbols
from gudgeon.language.units import make_dimension

SIGNS = {"rising": 1, "falling": -1, "both": 0}


@dataclass(frozen=True)
class Event:
    """An event of the user; `expression` is in t and the symbols of bodies and points, action is "record" or "stop"."""

    name: str
    expression: sp.Expr
    action: str
    direction: str


def make_event(event: EventSpec, geometry: Geometry, t: sp.Symbol) -> Event:
    """Return an event of the user with its expression in the symbols of a geometry; `t` is the symbol of time.

    Raise BadValueError for an expression with an infinite, undefined or imaginary constant.
    """
    expression = convert_quantity_to_sympy(event.zero, MotionNameResolver(geometry, t))
    return Event(event.name, expression, event.action, event.direction)


def check_event_varies(event: EventSpec, derived_event: Event, geometry: Geometry, t: sp.Symbol) -> None:
    """Raise BadValueError if the expression of a user's event depends on neither time nor motion after expansion.

    `derived_event`: the event as derived; `geometry`: that of the absolute coordinates.
    """
    motion_symbols = {t, *(symbol for body in geometry.bodies.values() for symbol in (*body.q, *body.v))}
    if not geometry.symbols.expand_definitions(derived_event.expression).free_symbols & motion_symbols:
        message, hint = f"{event.zero.address} never changes: its terms cancel", "expected an expression that varies"
        raise BadValueError(message, event.zero.where, hint)


class NotatedMatrix(sp.Matrix):
    """A matrix whose printed form (str, repr, sympy.latex, notebooks) uses the notation that `letters` gives."""

    letters: Callable[[], Any] | None = None  # returns an object with latex(matrix) and text(matrix)

    def _latex(self, printer: Any) -> str:
        """Return the LaTeX text of the matrix, which sympy.latex asks for."""
        return str(self.letters().latex(self) if self.letters else printer._print_MatrixBase(self))

    def _sympystr(self, printer: Any) -> str:
        """Return the plain text of the matrix, which SymPy's printer asks for."""
        return str(self.letters().text(self) if self.letters else printer._print_MatrixBase(self))

    def __str__(self) -> str:
        """Return the matrix in its notation, or as SymPy prints it without one."""
        return repr(self) if self.letters else super().__str__()


def set_notation(matrix: sp.Matrix, find_printer: Callable[[], Any] | None) -> NotatedMatrix:
    """Return a matrix with the same entries that prints in a notation.

    `find_printer` returns the printer of the notation; None: the matrix prints as SymPy does.
    """
    result = NotatedMatrix._fromrep(matrix._rep)
    result.letters = find_printer
    return result


def list_start_values(model: Model) -> dict[str, list[tuple[Quantity, int]]]:
    """Return the quantities of `guess`, `set` and `rates` in the file's start by these keys, each with a sign.

    Eccentricities of journals are appended to `set`, their rates to `rates`. The sign of sliders is −1 and that of all
    others 1: the kernel of the start stores sign · value.
    """
    start, eccentricities = model.scene.mechanism.start, find_eccentricity_rows(model)
    slider_names = {c.joint.name for c in model.clearances if c.wall}
    signs = [-1 if model.all_rows[k].owner in slider_names else 1 for k, _, _ in eccentricities]
    return {
        "guess": [(quantity, 1) for quantity in start.guess.values()],
        "set": [
            *((quantity, 1) for quantity in start.set.values()),
            *((e, sign) for (_, e, _), sign in zip(eccentricities, signs, strict=True)),
        ],
        "rates": [
            *((quantity, 1) for quantity in start.rates.values()),
            *((rate, sign) for (_, _, rate), sign in zip(eccentricities, signs, strict=True)),
        ],
    }


def find_eccentricity_rows(model: Model) -> list[tuple[int, Quantity, Quantity]]:
    """Return (index, e, ė) of each equation of Φ that the start violates by the eccentricity of a journal.

    Φ of such a joint is r_i − r_j = −e (physics.md, section 2), so that Φ + e = 0 and Φ_q v = ν − ė. Φ of a slider is
    its offset or tilt itself; `list_start_values` changes the sign. Joints for which the file gives no start are left
    out.
    """
    starts, result = model.scene.mechanism.start.play, []
    for name in model.scene.play:
        rows = [k for k, row in enumerate(model.all_rows) if row.owner == name and name in starts]
        result += [(k, starts[name].e[axis], starts[name].rate[axis]) for axis, k in enumerate(rows)]
    return result


@dataclass(frozen=True)
class Redundancy:
    """Names of redundant equations to leave out, and of joints or drives with indeterminate multipliers."""

    dropped: tuple[str, ...] = ()
    indeterminate: tuple[str, ...] = ()


NEGLIGIBLE_INERTIA_FRACTION = (
    1e-6  # of J + Σ m s² over the joints of a body: smaller inertia about one joint is negligible
)
DEFAULT_BAUMGARTE_GAIN = 50.0  # 1/s, both gains (physics.md, section 1)
STICK_GAIN_ADDRESS = "baumgarte.stick"


@dataclass(frozen=True)
class Model:
    """Φ(q, t) = 0 and M q̈ + Φ_qᵀ λ = g for one scene; shapes: q (n,), Φ (m,).

    Nothing changes a model after `make_model`. A program derives its functions on a copy of its own (`copy_mutable`).
    """

    scene: Scene
    symbols: Symbols
    parameter_table: ParameterTable
    geometry: Geometry
    constraints: Constraints
    all_rows: tuple[Row, ...]  # the closed linkage: joints with play closed, as the start needs it
    rows: tuple[Row, ...]  # constraint equations of joints without play and of drives
    clearances: tuple[Clearance, ...]
    elements: Mapping[str, AppliedElement]  # the section `forces`
    frictions: tuple[Friction, ...]  # elements of dry friction, which may stick
    redundancy: Redundancy  # constraint equations that were left out
    gravity: tuple[sp.Expr, sp.Expr]
    baumgarte: tuple[sp.Symbol, sp.Symbol]
    events: tuple[Event, ...] = ()  # zero crossings that the user requests
    targets: Mapping[str, Callable[[Model], Any]] = field(default_factory=dict)  # of generator/targets

    def remove_redundant_rows(self, redundancy: Redundancy) -> Model:
        """Return the model of the same scene without its redundant constraint equations."""
        remaining_rows = tuple(row for row in self.rows if row.name not in redundancy.dropped)
        return replace(self, rows=remaining_rows, redundancy=redundancy)

    def copy_mutable(self) -> Model:
        """Return a copy whose symbols and derived parameters one program may extend; this model stays unchanged."""
        symbols = self.symbols.copy_mutable()
        return replace(
            self, symbols=symbols, parameter_table=self.parameter_table.copy_mutable().copy_for_symbols(symbols)
        )

    def freeze(self) -> None:
        """Make every table of the model read only."""
        for tables in (self.symbols, self.parameter_table, self.geometry, self.constraints):
            tables.freeze()

    @property
    def bodies(self) -> tuple[BodySymbols, ...]:
        """Return the symbols of all bodies in the order of the file."""
        return tuple(self.geometry.bodies.values())

    @cached_property
    def q(self) -> tuple[sp.Symbol, ...]:
        """Return the coordinates (x, y, θ of each body's centre of mass), in the order of the file."""
        return tuple(symbol for body in self.bodies for symbol in body.q)

    @cached_property
    def v(self) -> tuple[sp.Symbol, ...]:
        """Return the velocities q̇ in the order of q."""
        return tuple(symbol for body in self.bodies for symbol in body.v)

    @property
    def t(self) -> sp.Symbol:
        """Return the symbol of time."""
        return self.constraints.t

    @property
    def degrees_of_freedom(self) -> int:
        """Return the number of coordinates minus the number of constraint equations."""
        return len(self.q) - len(self.rows)

    @property
    def law_states(self) -> int:
        """Return the number of internal states (bristle states) per joint with play: the largest of all its joints."""
        return max((len(clearance.states) for clearance in self.clearances), default=0)

    @property
    def rigid(self) -> tuple[str, ...]:
        """Return the names of the joints with play whose surfaces are rigid."""
        return tuple(clearance.name for clearance in self.clearances if clearance.rigid)

    @property
    def rigid_with_friction(self) -> tuple[str, ...]:
        """Return the names of the joints with play whose surfaces are rigid and have friction."""
        return tuple(clearance.name for clearance in self.clearances if clearance.rigid and clearance.friction)

    @property
    def has_intermittent_constraints(self) -> bool:
        """Return whether some constraint equations are active only at times: stiction of friction, or a rigid contact.

        The constraints are then intermittent (unilateral contact, variable structure); constraint equations that depend
        on time do not count. The right-hand side then reports a vanishing pivot instead of solving the dependent
        equations.
        """
        return bool(self.frictions or self.rigid)

    def compute_squared_arms(self, body: str) -> tuple[sp.Expr, ...]:
        """Return s_x² and s_y² of all joint points of a body as one tuple, s from its centre of mass to the point.

        A point of several joints is counted once.
        """
        mechanism, local = self.scene.mechanism, self.geometry.local_vectors
        ends = [end for joint in mechanism.joints.values() for end in (joint.first, joint.second)]
        points = dict.fromkeys((end.body, end.point) for end in ends if end.body == body and (body, end.point) in local)
        return tuple(s**2 for point in points for s in local[point])

    def compute_inertia_about_joints(self, body: str) -> sp.Expr:
        """Return the sum J + Σ m s² of a body, with s from its centre of mass to each point of its joints.

        J is the moment of inertia about the centre of mass, m the mass. A point of several joints is counted once.
        """
        body_symbols = self.geometry.bodies[body]
        return sp.Add(body_symbols.inertia, *(body_symbols.mass * square for square in self.compute_squared_arms(body)))

    def has_negligible_inertia(self, body: str, joint: Joint | None) -> bool:
        """Return whether a body has nearly no moment of inertia about a joint, because its mass is lumped there.

        The moment is then less than NEGLIGIBLE_INERTIA_FRACTION of J + Σ m s² over the points of all its joints, with
        the default values of the file. With `joint` None, or a joint of other bodies, the centre of mass replaces the
        joint.
        """
        body_symbols, default = self.geometry.bodies[body], self.parameter_table.compute_default
        ends = [end for end in (joint.first, joint.second) if end.body == body] if joint else []
        arm = self.geometry.local_vectors.get((body, ends[0].point), ()) if ends else ()
        inertia = body_symbols.inertia + sp.Add(*(body_symbols.mass * s**2 for s in arm))
        return default(inertia) < NEGLIGIBLE_INERTIA_FRACTION * default(self.compute_inertia_about_joints(body))

    @cached_property
    def masses(self) -> tuple[sp.Expr, ...]:
        """Return the diagonal of M in the order of q."""
        return tuple(m for body in self.bodies for m in (body.mass, body.mass, body.inertia))

    def numpy(self) -> Any:
        """Return the equations of the model as functions in NumPy: Φ, Φ_q, ν, γ, M and the right-hand side.

        They are a NumPyModel, with their text as `source`; generator/targets/numpy/module.py lists shapes and units.
        They are derived at the first call and cached.
        """
        return self.derive_target("numpy")

    def derive_target(self, target: str) -> Any:
        """Return the equations in another language, derived once and then cached.

        `target`: a key of `targets`, such as "numpy" or "letters" (the printer in the notation of the documents). Raise
        ValueError for any other name.
        """
        if target not in self.targets:
            known_targets = ", ".join(self.targets) or "none, because the pipeline did not derive the model"
            raise ValueError(f"a model has no target {target!r}; its targets: {known_targets}")
        if target not in self._targets_cache:
            self._targets_cache[target] = self.targets[target](self)
        return self._targets_cache[target]

    @cached_property
    def _targets_cache(self) -> dict[str, Any]:
        """Return the cache of equations in other languages, by target."""
        return {}

    def _make_column(self, expressions: Iterable[sp.Expr]) -> sp.Matrix:
        """Return expressions as a printable column matrix in q, q̇, t and parameters only.

        Derived symbols are replaced by their definitions, and conditional values by Heaviside functions, which SymPy
        can print. The matrix prints in the scene's notation.
        """
        return self._make_printable_matrix(
            [convert_to_heaviside_form(self.symbols.expand_definitions(expression)) for expression in expressions]
        )

    def _make_printable_matrix(self, entries: list[Any]) -> sp.Matrix:
        """Return a matrix of entries that prints in the notation of the scene's documents, if the model knows it."""
        return set_notation(
            sp.Matrix(entries), (lambda: self.derive_target("letters")) if "letters" in self.targets else None
        )

    def _repr_latex_(self) -> str:
        """Return Φ(q, t) = 0 as LaTeX for notebooks; "" without a notation."""
        return f"$\\displaystyle {self.derive_target('letters').equation().latex}$" if "letters" in self.targets else ""

    def _repr_html_(self) -> str | None:
        """Return Φ(q, t) = 0 as HTML for notebooks; None without a notation."""
        return str(self.derive_target("letters").html()) if "letters" in self.targets else None

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Return Φ(q, t) = 0 as text, HTML and LaTeX, which notebooks ask for first; empty without a notation.

        `include`, `exclude`: arguments of Jupyter, not used.
        """
        if "letters" not in self.targets:
            return {}
        text = self.derive_target("letters").equation().text
        return {"text/plain": text, "text/html": self._repr_html_() or "", "text/latex": self._repr_latex_()}

    @cached_property
    def Phi(self) -> sp.Matrix:
        """Return Φ(q, t), (m, 1); m and rad."""
        return self._make_column(row.phi for row in self.rows)

    @cached_property
    def Phi_q(self) -> sp.Matrix:
        """Return the constraint Jacobian ∂Φ/∂q as a dense matrix, (m, n), in q, t and parameters."""
        zero = sp.Integer(0)
        return self._make_printable_matrix(
            [[self.symbols.expand_definitions(row.phi_q.get(q, zero)) for q in self.q] for row in self.rows]
        )

    @cached_property
    def nu(self) -> sp.Matrix:
        """Return ν = −Φ_t, (m, 1): Φ_q q̇ = ν."""
        return self._make_column(row.nu for row in self.rows)

    @cached_property
    def gamma(self) -> sp.Matrix:
        """Return γ, (m, 1): Φ_q q̈ = γ."""
        return self._make_column(row.gamma for row in self.rows)

    @cached_property
    def M(self) -> sp.Matrix:
        """Return the mass matrix, (n, n), diagonal: the coordinates are those of the centres of mass."""
        return self._make_printable_matrix(sp.diag(*self.masses).tolist())

    @cached_property
    def g(self) -> sp.Matrix:
        """Return the generalized applied forces, (n, 1): gravity and force elements, not those of joints with play."""
        gx, gy = self.gravity
        forces = [f for body in self.bodies for f in (body.mass * gx, body.mass * gy, sp.Integer(0))]
        for element in self.elements.values():
            element.add_generalized_forces(forces)
        return self._make_column(forces)


def make_model(scene: Scene) -> Model:
    """Derive the equations of motion of one scene and return them as a model that cannot be changed.

    Raise LawError for an inconsistent user-defined law, and BadValueError for an event that never changes or a value
    that is never finite.
    """
    check_user_defined_laws(scene)
    mechanism, symbols = scene.mechanism, Symbols()
    parameter_table = ParameterTable(scene, symbols)
    geometry = Geometry(scene, symbols, parameter_table)
    constraints = Constraints(geometry)
    rate = make_dimension(time=-1)
    baumgarte = (
        parameter_table.get_or_add_constant("baumgarte.alpha", "alpha", DEFAULT_BAUMGARTE_GAIN, rate),
        parameter_table.get_or_add_constant("baumgarte.beta", "beta", DEFAULT_BAUMGARTE_GAIN, rate),
    )
    rows = [row for joint in mechanism.joints.values() for row in constraints.derive_joint_rows(joint)]
    rows += [row for drive in mechanism.drives.values() for row in constraints.derive_drive_rows(drive)]
    clearances = [
        clearance
        for name, play in scene.play.items()
        for clearance in make_clearances(mechanism.joints[name], play, geometry, parameter_table)
    ]
    gravity = geometry.ground_vector(mechanism.gravity) if mechanism.gravity else (sp.Integer(0), sp.Integer(0))
    elements = {
        element.name: make_applied_element(element, geometry, constraints.t) for element in mechanism.forces.values()
    }
    coordinate_pairs = [(q, v) for body in geometry.bodies.values() for q, v in zip(body.q, body.v, strict=True)]
    frictions = tuple(
        make_friction(name, element.loads.slip, coordinate_pairs, constraints.t, symbols)
        for name, element in elements.items()
        if element.loads.slip
    )
    active_rows = tuple(row for row in rows if row.owner not in scene.play)
    events = tuple(make_event(event, geometry, constraints.t) for event in scene.events.values())
    for event in events:
        check_event_varies(scene.events[event.name], event, geometry, constraints.t)
    add_material_parameters(scene, parameter_table)
    model = Model(
        scene,
        symbols,
        parameter_table,
        geometry,
        constraints,
        tuple(rows),
        active_rows,
        tuple(clearances),
        elements,
        frictions,
        Redundancy(),
        gravity,
        baumgarte,
        events,
    )
    add_parameters_outside_equations(model)
    model.freeze()
    return model


def add_material_parameters(scene: Scene, parameter_table: ParameterTable) -> None:
    """Add parameters for the materials among which a run may choose, and one parameter for each choice: an index.

    The materials of a choice are those of the file that have all its properties. A choice gets no parameter if the
    equations use none of its properties.
    """
    for choice in scene.mechanism.choices.values():
        if any(quantity.address in parameter_table.entries for quantity in choice.numbers.values()):
            materials = scene.mechanism.materials.values()
            matching = [material for material in materials if choice.numbers.keys() <= material.numbers.keys()]
            for material in matching:
                for name in choice.numbers:
                    parameter_table.get_or_add_parameter(material.numbers[name])
            names = tuple(material.name for material in matching)
            parameter_table.add_choice(choice.address, names, scene.materials[choice.address])


def add_parameters_outside_equations(model: Model) -> None:
    """Add parameters for values that no equation contains: ground points, the start, and Baumgarte's gain of stick.

    The gain is added only if there is dry friction, which may stick.
    """
    for vector in model.scene.mechanism.ground.values():
        model.geometry.ground_vector(vector)
    for group in list_start_values(model).values():
        for quantity, _ in group:
            model.parameter_table.get_or_add_parameter(quantity)
    if model.frictions:
        model.parameter_table.get_or_add_constant(
            STICK_GAIN_ADDRESS, "alpha_stick", DEFAULT_BAUMGARTE_GAIN, make_dimension(time=-1)
        )


def derive_stick_baumgarte_gain(model: Model) -> sp.Expr:
    """Return 2α, in 1/s, of Baumgarte's term for the velocity constraint of sticking friction, as a derived parameter.

    α is the parameter "baumgarte.stick". Methods that project the state stabilize no other equation.
    """
    return model.parameter_table.derive_parameter(
        "two_alpha_stick", 2 * model.parameter_table.entries[STICK_GAIN_ADDRESS].symbol, "2 alpha of a stick"
    )
