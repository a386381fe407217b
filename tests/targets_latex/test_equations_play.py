"""The joints with play, read back from the text: what is written there must give the compiled library's forces."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest

from gudgeon.generator.equations.model import Model
from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_all_laws, find_laws_of_role
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text
from gudgeon.loading.build import compile_kernels
from gudgeon.model.compiled import CompiledModel
from tests.equations.models import numeric
from tests.oracles import ideal_press
from tests.programs import needs_compiler
from tests.slow import slow_but
from tests.targets_latex.equations_reader import dots_apart, equations, evaluate, numbers, rows, sections, state, value
from tests.targets_latex.test_equations import PRESS

NORMAL = "{law: lankarani_nikravesh, restitution: 0.9, geometry: external}"
FRICTION = "    friction: {law: modified_coulomb, mu: 0.15, v0: 1e-4 m/s, v1: 1e-3 m/s}\n"
FILM = "{law: pinkus_sternlicht, viscosity: 100 cP}"
NAN = float("nan")
# one bob on a pin: a law's equations are the same in any mechanism
BOB = (
    """format: gudgeon/1
name: bob
bodies: {bob: {length: 0.3 m, mass: 0.4 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, bob.tail]}}
"""
    + PRESS[PRESS.index("materials:") : PRESS.index("bodies:")]
    + PRESS[PRESS.index("bearings:") : PRESS.index("scenes:")].replace("clearance: c", "clearance: 0.3 mm")
    + "scenes: {lubricated: {play: {A: {bearing: pin, contact: oil}}}}\n"
)
STORED = dots_apart("δ̇") + "⁻"
# (text to replace in the press's file, by what)
FILM_S = [(FILM, FILM[:-1] + ", shear: true, angular_velocity: relative, extra_clearance: 8 um}")]
DRY_S = [
    (NORMAL, NORMAL.replace("external", "internal") + "\n    clip_ratio: true"),
    ("journal_material: aluminium", "journal_material: steel_45"),
]
VARIANTS = {
    "as it is": [],
    "as printed": [(FILM, FILM[:-1] + ", as_printed: true}")],
    "film's options": FILM_S,
    "dry options": DRY_S,
    "all options": FILM_S + DRY_S,
    "no friction": [(FRICTION, "")],
}


def changed(variant: str) -> str:
    text = PRESS
    for old, new in VARIANTS[variant]:
        assert old in text
        text = text.replace(old, new)
    return text


@cache
def model_of(variant: str, scene: str) -> Model:
    return derive_scene(changed(variant).encode(), "press.yaml", scene)


@cache
def text_of(variant: str, scene: str) -> str:
    return render_equations_text(model_of(variant, scene))


@cache
def read(variant: str, scene: str) -> dict[str, list[str]]:
    return sections(text_of(variant, scene))


@cache
def library_of(variant: str, scene: str) -> tuple[CompiledModel, np.ndarray]:
    source = generate_c(model_of(variant, scene))
    library = CompiledModel(source, compile_kernels(source))
    return library, library.prepare(np.zeros(len(source.parameters)), np.zeros(len(source.parameters), dtype=bool))


def joint_numbers(document: dict[str, list[str]], joint: str) -> dict[str, float]:
    """The table of a joint's numbers: letter, value behind the last "="."""
    lines = document[f"Joint {joint}: parameters"]
    return {cells[0]: float(cells[3].split(" = ")[-1]) for cells in rows(lines) if len(cells) == 5 and "." in cells[2]}


def joint_forces(
    document: dict[str, list[str]], joint: str, known: dict[str, float], stored: float
) -> dict[str, float]:
    """Everything about one joint in the order of the document; `stored` is δ̇⁻, NaN while open."""
    twin = re.search(r"those of joint (\w+),", " ".join(document[f"Joint {joint}: force"]))
    laws_of = twin[1] if twin else joint
    known = known | joint_numbers(document, laws_of)
    known = evaluate(document[f"Joint {laws_of}: parameters"], known)
    known = evaluate(document[f"Joint {joint} with play"], known)
    if twin:  # the gap is written down with the laws
        gap = [line for line in document[f"Joint {laws_of} with play"] if not re.match(r"  (e.?_[xy]|ω_[ij]) = ", line)]
        known = evaluate(gap, known)
    known[STORED] = known[dots_apart("δ̇")] if np.isnan(stored) else stored  # "is 1"
    dry = document.get(f"Joint {laws_of}: dry contact")
    if dry is not None and known["δ"] > 0.0:  # "the contact acts while δ > 0"
        known = evaluate(dry, known)
    elif dry is not None:
        known |= dict.fromkeys(["F_n", "F_t", "M_i", "M_j", "F_td", "M_id", "M_jd"], 0.0)
    known = evaluate(document.get(f"Joint {laws_of}: film", []), known)
    return evaluate(document[f"Joint {laws_of}: force"], known)


def press_state(seed: int) -> tuple[float, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    m = ideal_press.motion(float(rng.uniform(0.0, 1.0)))
    return 0.0, m.q[0] + rng.normal(0.0, 1.5e-4, 24), m.v[0] + rng.normal(0.0, 0.02, 24)


COMPUTED = [("as it is", "dry"), ("dry options", "dry"), *((variant, "lubricated") for variant in VARIANTS)]


@needs_compiler
@pytest.mark.plain
@pytest.mark.parametrize("case", slow_but([("as it is", "dry"), ("all options", "lubricated")], COMPUTED), ids=" ".join)
def test_what_is_read_is_what_is_computed(case: tuple[str, str]) -> None:
    """Forces on both journals and, through M a + Φ_qᵀ λ = g + Δg, every share in the generalized forces."""
    model, document, (library, p) = model_of(*case), read(*case), library_of(*case)
    phi_q, g = (numeric(model, matrix) for matrix in (model.Phi_q, model.g))
    mass, parts = library.mass(p), set()
    base = numbers([line for title in ("Bodies", "Ground") for line in document[title]])
    for seed in range(12):
        t, q, v = press_state(seed)
        memory = [0.03, NAN] if seed % 2 else [NAN, NAN]
        got = library.evaluate([t], q[None], v[None], np.array([memory]), p)
        forces = g(t, q, v)[:, 0]
        known = base | state([body.name for body in model.bodies], q, v)
        for joint, stored, columns in zip("AB", memory, got.clearance[0], strict=True):
            found = joint_forces(document, joint, known, stored)
            scale = float(np.hypot(columns[0], columns[1]))
            assert found["F_x"] == pytest.approx(columns[0], abs=1e-9 * scale)
            assert found["F_y"] == pytest.approx(columns[1], abs=1e-9 * scale)
            for left, right in equations(document[f"Joint {joint}: contribution to g"]):
                forces[int(left[3:]) - 1] += value(right, found)
            parts.add(found["δ"] > 0.0)
        balance = mass * got.a[0] + phi_q(t, q, v).T @ got.multipliers[0]
        assert forces == pytest.approx(balance, abs=1e-9 * float(np.max(abs(forces))))
    assert parts == {True, False}


def test_the_printed_sign_is_shown() -> None:
    """Parting surfaces: the paper's sign pushes where the film pulls; approaching ones do not differ."""
    right, printed = (
        sections(render_equations_text(derive_scene(BOB.replace(FILM, film).encode(), "bob.yaml", "lubricated")))
        for film in (FILM, FILM[:-1] + ", as_printed: true}")
    )
    text = [" ".join(document["Joint A: film"]) for document in (right, printed)]
    assert "Option as_printed: false" in text[0] and "Option as_printed: true" in text[1]
    assert equations(right["Joint A: film"]) != equations(printed["Joint A: film"])
    for w_n, sign in ((1.0, 1.0), (-1.0, -1.0)):
        law = {"ε": 0.5, "w_n": w_n, "w_t": 0.3, "S": 2.0, "e": 1e-4}
        F_r = [
            evaluate([f"  {a} = {b}" for a, b in equations(d["Joint A: film"]) if a not in law], law)["F_r"]
            for d in (right, printed)
        ]
        assert F_r[0] * w_n < 0.0
        assert F_r[1] == pytest.approx(sign * F_r[0], rel=1e-14)


def test_an_ideal_scene_shows_no_force_law() -> None:
    document = read("as it is", "ideal")
    text = text_of("as it is", "ideal")
    assert not [title for title in document if title.startswith("Joint ")]
    for word in ("δ", "ε", "Lankarani", "Coulomb", "Pinkus", "bearings.", "contacts."):
        assert word not in text
    left_out = " ".join(document["Left out of this scene"])
    assert "No joint has play" in left_out and "No degree of freedom" in left_out


def test_a_dry_scene_shows_no_film() -> None:
    text = text_of("as it is", "dry")
    assert "Lankarani" in text and "Pinkus" not in text and "viscosity" not in text and "No film" in text


def test_every_number_of_a_law_is_in_its_table() -> None:
    model = derive_scene(BOB.encode(), "bob.yaml", "lubricated")
    lines = sections(render_equations_text(model))["Joint A: parameters"]
    shown = {cells[2]: cells for cells in rows(lines) if len(cells) == 5}
    play = model.scene.play["A"]
    for use in (play.contact.normal, play.contact.friction, play.contact.film):
        assert use is not None
        for parameter in find_all_laws()[use.law].parameters:
            letter, meaning, *_ = shown.pop(use.quantities[parameter.name].address)
            assert letter == parameter.symbol.replace(r"\mu", "μ") and meaning == parameter.meaning
    roles = ("bearing_material.E", "journal_material.nu", "radius")
    for address in (*(f"bearings.pin.{role}" for role in roles), "contacts.oil.transition"):
        assert shown.pop(address)


def uses() -> list[tuple[str, bool]]:
    """Every law by every name that it has; those with a number that they can do without, with it and without."""
    found = [(name, law.list_fields_of_name(name)) for role in RESULTS for name, law in find_laws_of_role(role).items()]
    return [(name, left) for name, fields in found for left in sorted({False, any(map(may_lack, fields))})]


def may_lack(own: Field) -> bool:
    return own.kind == NUMBER and own.default is None and not own.required


def bob_with(name: str, left_out: bool) -> tuple[Law, Model]:
    law = next(some[name] for role in RESULTS if name in (some := find_laws_of_role(role)))
    needed = [own for own in law.list_fields_of_name(name) if own.kind == NUMBER and own.default is None]
    kept = [(k, own) for k, own in enumerate(needed) if not (left_out and may_lack(own))]
    given = [f"{own.name}: {'1 N/m * delta' if own.varies else f'{(k + 1) * 0.1:.1f}'}" for k, own in kept]
    own = f"{{{', '.join([f'law: {name}', *given])}}}"
    place = {"normal": NORMAL, "film": FILM, "mixed": "transition: 5 um"}
    own = f"mixed: {own}" if law.role == "mixed" else own
    text = BOB.replace(place.get(law.role, FRICTION.split(": ", 1)[1].strip()), own)
    film, transition = f"    film: {FILM}\n", "    transition: 5 um\n"
    for other in {"normal": (FRICTION, film, transition), "friction": (film, transition)}.get(law.role, (FRICTION,)):
        text = text.replace(other, "")  # which it does not need
    return law, derive_scene(text.encode(), "bob.yaml", "lubricated")


@pytest.mark.parametrize(("name", "left_out"), uses())
def test_every_law_is_printed(name: str, left_out: bool) -> None:
    """A new law needs nothing here: its steps, numbers, source and validity are in the document."""
    law, model = bob_with(name, left_out)
    written = render_equations_text(model)
    shown = " ".join(written.split())
    assert (law.reference or law.source) in shown and law.validity in shown
    clearance = model.clearances[0]
    equations_of = next(one for one in clearance.laws if one.law.role == law.role)
    assert equations_of.law is law
    title = f"Joint A: {({'film': 'film', 'mixed': 'mixed lubrication'}).get(law.role, 'dry contact')}"
    lines = sections(written)
    assert len(equations(lines[title])) >= sum(step != 0 for step in equations_of.equations_by_name.values())
    numbers_of = {cells[2] for cells in rows(lines["Joint A: parameters"]) if len(cells) == 5}
    for number in law.parameters:
        message = not (left_out and may_lack(number))
        assert (f"contacts.oil.{law.role}.{number.name}" in numbers_of) == message


ONE_OF_EACH = [(name, False) for name in ("liu", "brown_mcphee", "ocvirk", "greenwood_tripp")]


@pytest.mark.parametrize("use", slow_but(ONE_OF_EACH, uses()))
def test_every_law_is_plain_latex(use: tuple[str, bool]) -> None:
    assert render_equations_tex(bob_with(*use)[1]).isascii()
