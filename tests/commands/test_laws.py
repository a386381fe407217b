"""`gudgeon laws`: all of them in a table without SymPy; of one, equations that give what the law gives."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from gudgeon.commands.law_plot import make_law_figure
from gudgeon.generator.field import NUMBER
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, FACTORS, SOURCES
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_bundled_laws, find_laws_of_role
from gudgeon.generator.marked_text import MarkedText, get_markdown
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.latex.document import Equation
from gudgeon.generator.targets.latex.law import GIVEN, derive_equation_variants, print_equation
from gudgeon.generator.targets.latex.law_page import list_laws_of_role, make_example, print_laws_page
from gudgeon.generator.targets.latex.law_symbols import list_symbol_rows
from gudgeon.generator.targets.latex.letters import make_name_from_latex
from tests.equations.one_law import PAIR, Evaluator
from tests.kinds.own import example, forgotten
from tests.oracles.dry import delivered
from tests.pump import Gudgeon
from tests.slow import slow_but
from tests.targets_latex.equations_reader import dots_apart, evaluate, rows, sections, width

NAMES = [name for role in RESULTS for name in find_laws_of_role(role)]
STATES = {  # of what laws read, by the letter; z lies within what bristles take
    "delta": 3e-5,
    "ratio": -0.4,
    "deltadot": 0.02,
    "F_n": 700.0,
    "v_t": -0.03,
    "z": 2e-5,
    "epsilon": 0.6,
    "w_n": -3.0,
    "w_t": 4.0,
    "held_force": 81.0,
}
NUMBERS = {"dahl": {"presliding": 1e-4}, "modified_coulomb": {"v0": 0.01, "v1": 0.05}}
DRAWN = {"hertz", "expression", "lugre", "ocvirk", "christensen", "newton_restitution"}
LETTERS = {"held_force": "λ_n", "delta": "δ", "deltadot": dots_apart("δ̇"), "epsilon": "ε"}
NO_SYMPY = """
import sys
from gudgeon.cli import app
app(["laws"], standalone_mode=False)
assert "sympy" not in sys.modules
"""


page_of_laws = cache(print_laws_page)  # seconds


@pytest.fixture(autouse=True)
def alone() -> Iterator[None]:
    with forgotten():
        yield


def test_the_table_has_every_law_and_every_name(call: Gudgeon) -> None:
    done = call("laws")
    words = done.stdout.replace(",", " ").split()
    assert done.exit_code == 0 and {*NAMES, *RESULTS} <= {*words}
    listed = json.loads(call("laws", "--json").stdout)
    found = {role: [law["law"] for law in some] for role, some in listed.items()}
    assert found == {role: [law.name for law in find_bundled_laws().values() if law.role == role] for role in RESULTS}
    hertz = next(law for law in listed["normal"] if law["law"] == "hertz")
    assert [*RESULTS] == [*listed] and "flores" in hertz["also"]


def test_the_table_waits_for_no_sympy() -> None:
    done = subprocess.run([sys.executable, "-c", NO_SYMPY], capture_output=True, text=True, check=True)
    assert "hertz" in done.stdout


def law_of(name: str) -> Law:
    return next(some[name] for role in RESULTS if name in (some := find_laws_of_role(role)))


def merged(first: Sequence[Equation], changed: Sequence[Equation]) -> list[str]:
    """The lines of both; of two with the same left side the changed one."""
    return [f"  {line}" for line in {one.left.text: print_equation(one) for one in (*first, *changed)}.values()]


@pytest.mark.parametrize("name", NAMES)
def test_what_is_read_is_what_the_law_gives(name: str) -> None:
    """The written equations, for every choice of one key, against the law's own function."""
    law = law_of(name)
    numbers = {own.name: 0.31 + 0.07 * k for k, own in enumerate(law.parameters)} | NUMBERS.get(law.name, {})
    state = {key: STATES[key] for key in law.variables}
    known = {make_name_from_latex(own.symbol).text: numbers[own.name] for own in law.parameters}
    known |= {key.replace("nu", "ν"): value for key, value in vars(PAIR).items()}
    known |= {LETTERS.get(key, key): value for key, value in state.items()}
    if "ratio" in state:  # it is written as a fraction
        known[dots_apart("δ̇") + "⁻"] = STATES["deltadot"] / STATES["ratio"]
    first, *others = derive_equation_variants(law, name)
    for form in (first, *others):
        changed = ((), ()) if form is first else (form.constants, form.evaluated)
        letters = {
            make_name_from_latex(own.symbol).text for own in law.parameters if form.selected.get(own.name) == GIVEN
        }
        constants = [one for one in first.constants if one.left.text not in letters]  # what is given follows from none
        read = evaluate([*merged(constants, changed[0]), *merged(first.evaluated, changed[1])], known)
        selected = dict(law.also.get(name, {})) | {key: x for key, x in form.selected.items() if x != GIVEN}
        given = {
            own.name: numbers[own.name]
            for own in law.parameters
            if own.required or own.default is not None or own.name in form.selected
        }
        alone = Evaluator(law.name, given, **selected)
        got = alone(*(state[symbol] for symbol in alone.reads))
        called_here = {key: of.text for key, of in form.used}
        results = [read[called_here[result]] if result in called_here else 0.0 for result in RESULTS[law.role]]
        assert results == pytest.approx(got, rel=1e-12), form.selected


@pytest.mark.parametrize("name", NAMES)
def test_all_about_one(name: str, call: Gudgeon) -> None:
    law, done = law_of(name), call("laws", name)
    text = " ".join(done.stdout.split())
    assert done.exit_code == 0 and law.title in text and (law.reference or law.source) in text and "probe_" not in text
    assert max(map(width, done.stdout.splitlines())) <= 100
    message = json.loads(call("laws", name, "--json").stdout)
    assert [key["key"] for key in message["keys"]] == [own.name for own in law.list_fields_of_name(name)]
    assert message["law"] == law.name and message["role"] == law.role and message["validity"] == law.validity
    lines = sections(done.stdout)
    assert [f"  {line}" for line in message["equations"]] == [line for line in lines["Equations"] if " = " in line]
    found = {cells[0]: cells for cells in rows(lines["Numbers"]) if len(cells) == 6}
    for own in law.list_fields_of_name(name):
        assert own.name in (found if own.kind == NUMBER else " ".join(lines["Options"]))
    assert found[next(own.name for own in law.parameters)][1] == make_name_from_latex(law.parameters[0].symbol).text


def test_dampings_are_cited(call: Gudgeon) -> None:
    """Each is somebody's: under its own name that source alone, in the page what it delivers by the oracle."""
    flores = " ".join(call("laws", "flores").stdout.split())
    assert "soft materials in multibody dynamics" in flores and "Gonthier" not in flores
    johnson = " ".join(call("laws", "johnson").stdout.split())
    assert all(" ".join(source.split()) in johnson for source in SOURCES.values())
    assert {*SOURCES} == {*DISSIPATION.values} - {"none"}
    rows = dict(re.findall(r"^\| `(\w+)` \| .*? \| ([\d.]+ \| [\d.]+ \| [\d.]+) \|", page_of_laws(), re.MULTILINE))
    for name, factor in FACTORS.items():
        if name != "none":
            expected = [delivered(float(factor(c_e))) for c_e in (0.9, 0.7, 0.5)]
            assert [float(x) for x in rows[name].split(" | ")] == pytest.approx(expected, abs=5.1e-5), name


def test_a_film_tells_its_shear_torque_and_what_is_nothing_without_it() -> None:
    first, *others = derive_equation_variants(law_of("pinkus_sternlicht"), "pinkus_sternlicht")
    assert [form.selected for form in others if form.equations] == [{"as_printed": True}, {"shear": True}]
    assert not [one for one in first.equations if print_equation(one).endswith(" = 0")]


def test_a_law_of_ones_own(call: Gudgeon, tmp_path: Path) -> None:
    example(tmp_path)
    done = call("laws", "dashpot", "--laws", "dashpot.py")
    assert done.exit_code == 0 and "F_n = δ·K + δ̇·D" in done.stdout and "W. Goldsmith, Impact (1960)" in done.stdout
    listed = json.loads(call("laws", "--json", "--laws", "dashpot.py").stdout)
    assert listed["normal"][-1] == {"law": "dashpot", "also": [], "title": "A spring and a dashpot"}


def test_a_misspelt_name_is_told_with_the_nearest(call: Gudgeon) -> None:
    done = call("laws", "florres")
    assert done.exit_code == 2 and "unknown law 'florres'" in done.stderr and "did you mean 'flores'?" in done.stderr


@pytest.mark.parametrize("name", slow_but(DRAWN, NAMES))
def test_every_law_is_drawn(name: str, call: Gudgeon, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    done = call("laws", name, "--plot", "law.svg")
    if law_of(name).rigid:
        assert done.exit_code == 2 and f"{name} has no curve" in done.stderr
        return
    assert done.exit_code == 0, done.output
    text = (tmp_path / "law.svg").read_text("utf-8")
    assert "<svg" in text and text.count('id="line2d_') > 2


def lines_of(name: str, **numbers: float | str) -> list[np.ndarray]:
    """x and y as drawn."""
    return [np.array(line.get_data()) for line in make_law_figure(law_of(name), name, numbers).axes[0].lines]


def test_what_is_drawn_is_the_law() -> None:
    """In the units of its axes: Kelvin and Voigt's lines, Brown and McPhee's peak, Ocvirk's steady force."""
    x, y = lines_of("kelvin_voigt", stiffness=1e8, damping=2e3)[0]  # µm, N, approached at .1 m/s
    np.testing.assert_allclose(y, 1e8 * 1e-6 * x + 200.0, rtol=1e-12)
    x, y = lines_of("brown_mcphee", mu=0.2, mu_s=0.5, v0="2 mm/s")[0]
    assert y[np.argmin(abs(x + 2.0))] == pytest.approx(0.2 * np.tanh(4.0) + 0.3, rel=1e-3)
    (eps, radial), (_, along), *_ = lines_of("ocvirk", viscosity=0.1)
    unit, square = 0.1 * 9.9e-3 * 0.02**3 / 1e-8, 1.0 - eps**2
    np.testing.assert_allclose(radial, unit * eps**2 / square**2, rtol=1e-9)
    np.testing.assert_allclose(along, np.pi * unit * eps / (4.0 * square**1.5), rtol=1e-9)


def test_curves_that_are_one_are_drawn_once() -> None:
    """Without dissipation approach and parting are alike; with the usual restitution they lie apart by 1 ± a."""
    assert len(lines_of("johnson", restitution=1.0)) == len(lines_of("liu", dissipation="none")) == 1
    (_, closing), (_, resting), (_, parting) = lines_of("hertz")
    np.testing.assert_allclose(closing, 1.15 * resting, rtol=1e-12)
    np.testing.assert_allclose(parting, 0.85 * resting, rtol=1e-12)
    titles = [make_law_figure(law_of(name), name, {}).axes[0].get_title() for name in ("hertz", "kelvin_voigt")]
    assert ["m/s" in title for title in titles] == [False, True]


def test_bristles_that_have_gone_far_slide() -> None:
    """Fastest, after .1 mm at about that slip: LuGre's steady −F_n g, Dahl's Coulomb force."""
    _, (v_t, force) = lines_of("lugre", mu=0.1, mu_s=0.3, v_s=0.01)  # mm/s
    steady = 0.1 + 0.2 * np.exp(-9.0)
    assert force[np.argmax(v_t)] == pytest.approx(-steady, rel=0.01)
    _, (v_t, force) = lines_of("dahl", mu=0.1, presliding="20 um")
    assert force[np.argmax(v_t)] == pytest.approx(-0.1, rel=0.01)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("lugre --plot x.svg --set viscosity=1", "unknown key of lugre 'viscosity'"),
        ("flores --plot x.svg --set restitution=1.5", "restitution is 1.5: expected <= 1"),
        ("flores --plot x.svg --set geometry=round", "'round'"),
        ("flores --set restitution=.5", "--plot needs the name of a law"),
        ("--plot x.svg", "--plot needs the name of a law"),
        ("flores --json --plot x.svg", "--plot needs the name of a law"),
        ("flores --plot x.txt", ".svg"),
        ("dahl --plot x.svg --set 'presliding=2 s'", "presliding"),
        ("flores --plot x.svg --set stiffness=1N/m", "expected a stiffness by Hertz (N/m^1.5), got a stiffness (N/m)"),
        ("dahl --plot x.svg --set presliding=1e-300", "z cannot be integrated; its rate overflows"),
        ("lugre --plot x.svg --set v_s=1e300", "z cannot be integrated"),
        ("stribeck --plot x.svg --set v_s=1e300", "F_t/F_n is not finite at any point"),
        ("ocvirk --plot x.svg --set extra_clearance=1e300", "all forces are 0"),
    ],
)
def test_what_cannot_be_drawn(line: str, message: str, call: Gudgeon) -> None:
    done = call("laws", *shlex.split(line))
    assert done.exit_code == 2 and message in done.stderr, done.output


def test_the_examples_of_the_page_are_read() -> None:
    """Friction needs a normal law, mixed lubrication also a film."""
    others = {"normal": "normal: {law: hertz}", "film": "film: {law: ocvirk, viscosity: 1 cP}"}
    needed = {"friction": ["normal"], "mixed": ["normal", "film"]}
    contacts = ""
    for law in find_bundled_laws().values():
        lines = {role: others[role] for role in needed.get(law.role, ())} | {law.role: make_example(law)}
        contacts += "".join([f"  {law.name}:\n", *(f"    {line}\n" for line in lines.values())])
    text = (Path(__file__).resolve().parents[2] / "mechanisms" / "nine_bar_press.yaml").read_text("utf-8")
    assert read_mechanism(text.replace("contacts:\n", f"contacts:\n{contacts}", 1).encode(), "press.yaml", None).scenes


def test_marked_text_has_a_plain_form_in_ascii() -> None:
    text = MarkedText(r"Gümbel, $\lvert\omega_s\rvert \gg \lvert\dot\varepsilon\rvert$, 1–2")
    assert text == "Guembel, |omega_s| >> |d epsilon/dt|, 1-2" and "ü" in get_markdown(text)
    assert get_markdown("plain") == "plain"
    with pytest.raises(ValueError, match="no plain form"):
        MarkedText("µ")


def test_the_page_of_laws_is_current() -> None:
    """`make tables` writes it, a heading a law."""
    page = (Path(__file__).resolve().parents[2] / "docs" / "laws.md").read_text("utf-8")
    assert page.partition("<!-- Below: `make tables`. -->\n\n")[2] == page_of_laws()
    assert re.findall(r"^### `(\w+)`$", page, re.MULTILINE) == [
        law.name for role in RESULTS for law in list_laws_of_role(role)
    ]


def test_the_page_of_laws_defines_each_symbol_of_an_equation() -> None:
    """A table of symbols leaves out those of keys; a letter that no table defines is an error."""
    rows = [*list_symbol_rows([r"F_n = K \delta^n + F_{\mathrm{el}}"], "hertz", ["K", "n"])]
    assert [row.split(" | ")[0] for row in rows[2:-1]] == ["| $F_n$", r"| $F_{\text{el}}$", r"| $\delta$"]
    with pytest.raises(ValueError, match="does not define the symbol Q_1"):
        list(list_symbol_rows([r"F_n = Q_1 \delta"], "hertz"))
    assert "defines all symbols" not in page_of_laws() and "$L/(2R_j)$" in page_of_laws()
