"""The function of the outputs: reactions, drive torques, results of force elements and energies."""

from __future__ import annotations

import sympy as sp

from gudgeon.contract.boundary import N_REACTION_COLUMNS, REACTION_COLUMN_NAMES, ENERGY_kinetic, ENERGY_potential
from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.signatures import PARAMETERS, STATE, ZERO, make_input_argument, make_output_argument
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import Joint
from gudgeon.generator.symbols.storage import StorageLocation


def make_outputs_kernel(model: Model) -> Kernel:
    """Return the kernel of reactions, drive torques, element results and energies from q, q̇ and λ.

    Reactions (F_x, F_y, M on the second body) are written for each joint without play. The torque of a drive is −λ, and
    0 if its equation was left out as redundant.
    """
    builder = KernelBuilder(
        model.symbols,
        "outputs",
        [
            "Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),",
            "drive torques on the driven body, kinetic and potential energy.",
        ],
    )
    multiplier: dict[str, sp.Expr] = {}
    builder.begin_section("multipliers")
    for row_index, row in enumerate(model.rows):
        multiplier[row.name] = builder.append_local(
            f"multiplier_{row.name.replace('.', '_')}", StorageLocation("lambda")[row_index]
        )
    builder.begin_section("reactions")
    rows_by_owner: dict[str, list[Row]] = {}
    for row in model.rows:
        rows_by_owner.setdefault(row.owner, []).append(row)
    for j, joint in enumerate(find_constraining_joints(model)):
        for k, value in enumerate(_compute_reaction(model, joint, rows_by_owner.get(joint.name, []), multiplier)):
            target = StorageLocation("reactions")[N_REACTION_COLUMNS * j + k]
            builder.append_store(target, value, f"{joint.name}.{REACTION_COLUMN_NAMES[k]}")
    for d, name in enumerate(model.scene.mechanism.drives):
        builder.append_store(StorageLocation("torques")[d], -multiplier.get(name, ZERO), f"{name}")
    for k, (name, (value, _)) in enumerate(list_force_element_series(model).items()):
        builder.append_store(StorageLocation("series")[k], value, name)
    builder.begin_section("energy")
    kinetic = sp.Add(*(m * v**2 / 2 for m, v in zip(model.masses, model.v, strict=True)))
    builder.append_store(StorageLocation("energy")[ENERGY_kinetic], kinetic)
    gx, gy = model.gravity
    gravity_energies = (-body.mass * (gx * body.x + gy * body.y) for body in model.bodies)
    potentials = (element.loads.potential for element in model.elements.values())
    builder.append_store(StorageLocation("energy")[ENERGY_potential], sp.Add(*gravity_energies, *potentials))
    results = (make_output_argument(name) for name in ("reactions", "torques", "series", "energy"))
    return builder.build_kernel((*STATE, PARAMETERS, make_input_argument("lambda"), *results))


def list_force_element_series(model: Model) -> dict[str, tuple[sp.Expr, str]]:
    """Return the output series of all force elements by name: {"coil.F": (expression, unit)}."""
    return {
        f"{name}.{series_name}": value
        for name, element in model.elements.items()
        for series_name, value in element.loads.series.items()
    }


def find_constraining_joints(model: Model) -> list[Joint]:
    """Return the joints that constrain the motion, those without play, in the order of the file."""
    return [joint for joint in model.scene.mechanism.joints.values() if joint.name not in model.scene.play]


def _compute_reaction(
    model: Model, joint: Joint, rows: list[Row], multiplier: dict[str, sp.Expr]
) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Return the force (F_x, F_y) in N on the second body and the moment about the joint's point, from −Φ_qᵀ λ.

    `rows`: the equations of the joint; `multiplier`: λ by equation. If the second body is the ground, the result is
    minus the forces and moments on all other bodies of the joint. The point is that of the first or second body, by
    type.
    """
    first, second = model.geometry.find_point(joint.first), model.geometry.find_point(joint.second)
    kind = find_joint_types()[joint.kind]
    point = first if kind.reaction_at == "first" else second
    sign, bodies = 1, [second.body]
    if second.body is None:
        other_bodies = [joint.options[name] for name in kind.third_body_fields]  # a gear's carrier
        sign, bodies = -1, [first.body, *(model.geometry.bodies.get(name) for name in other_bodies)]
    wrench = [ZERO, ZERO, ZERO]
    for body in bodies:
        if body is not None:
            body_wrench = [-sum((row.phi_q.get(q, ZERO) * multiplier[row.name] for row in rows), ZERO) for q in body.q]
            arm = point.arm if point.body is body else (point.x - body.x, point.y - body.y)
            body_wrench[2] = sp.expand(body_wrench[2] - (arm[0] * body_wrench[1] - arm[1] * body_wrench[0]))
            wrench = [
                component + sign * body_component for component, body_component in zip(wrench, body_wrench, strict=True)
            ]
    return wrench[0], wrench[1], wrench[2]
