"""No name that the reader accepts clashes with emitted code, with C or with its headers' macros."""

from __future__ import annotations

import keyword
import re
import subprocess
import sysconfig
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadNameError
from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.kinds.laws.law import RESULTS, VARIABLES
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.names import RESERVED, WORDS, YAML_NULL, check_name
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags, read_engine_files
from tests.slow import slow_but

VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"
HEADERS = ("Python.h", "math.h", "float.h", "limits.h", "stddef.h", "stdint.h", "stdlib.h", "string.h", "errno.h")
INCLUDES = "".join(f"#include <{header}>\n" for header in HEADERS)

# Keywords of C11, C17 and C23, and of the GNU dialect:
_C_KEYWORDS = """
alignas alignof asm auto bool break case char complex const constexpr continue default do double else
enum extern false float for goto if imaginary inline int long nullptr register restrict return short
signed sizeof static static_assert struct switch thread_local true typedef typeof typeof_unqual union
unsigned void volatile while linux unix
"""

# Functions, macros and types of the headers that emitted code includes.
_C_LIBRARY = """
main NULL EOF NAN INFINITY HUGE_VAL errno assert offsetof size_t ptrdiff_t wchar_t
int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t
FILE stdin stdout stderr printf fprintf sprintf snprintf scanf puts putchar getchar fopen fclose
malloc calloc realloc free abort exit atexit system getenv qsort bsearch labs div rand srand
memcpy memmove memset memcmp strlen strcpy strcat strcmp strncmp
acos asin atan atan2 cos sin tan acosh asinh atanh cosh sinh tanh exp exp2 expm1 frexp ilogb ldexp
log log10 log1p log2 logb modf scalbn scalbln cbrt fabs hypot pow sqrt erf erfc lgamma tgamma
ceil floor nearbyint rint lrint lround round trunc fmod remainder remquo copysign nan nextafter
nexttoward fdim fmax fmin fma isnan isinf isfinite isnormal signbit fpclassify
time clock signal raise setjmp longjmp I
"""
NOT_IN_CODE = frozenset((*_C_LIBRARY.split(), *_C_KEYWORDS.split(), *keyword.kwlist))

# names that people would try: locals of emitted code, C's own, and what looks like both
_TRIED = """
q v p a y dy e nx ny F W tx ty delta deltadot ratio rhs contact discrete out phi nu gamma lambda_ given is_given
mass_L1 inverse_a_mass N_Q N_ROWS N_ALL_ROWS Integrator ContactState Parameters Clearance RhsOutputs Impact Workspace
dot rates outputs
clearance_A normal_A_force dry_A film_A max_of min_of sign_of prepare dynamics project constraints jacobian
DBL_MAX FLT_EPSILON FP_NAN M_PI M_E INT_MAX LONG_BIT SEEK_SET HUGE_VALF EINVAL R_OK BUFSIZ RAND_MAX
y0 y1 yn j0 j1 jn gammaf drem significand scalb random index read write link unix_ linux_ i386 st_atime si_pid
Py_None PyObject Py_True METH_O T_INT alpha beta two_alpha beta_squared time cos_theta_a sin_theta_a a_mass a_x b_omega
par_t par_q par_y t_2 time_2 alpha_2 guess set_ R_j_pin multiplier_A_x phi_A_x rhs_A_x step_A_x r_A_x weight_a_y
"""
TRIED = tuple(_TRIED.split())


def accepted(name: str) -> bool:
    try:
        check_name(name, "parameter", None)
    except BadNameError:
        return False
    return True


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path_factory.getbasetemp() / "cache"))


def check_c(source: KernelSource, folder: Path) -> None:
    """Compile all of a scene's C without output, behind the headers that the wrapper includes."""
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    units = "".join(f'#include "{name}"\n' for name in (source.main, "engine/engine.c"))
    (folder / "names.c").write_text(INCLUDES + units, encoding="utf-8")
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{sysconfig.get_paths()['include']}"]
    command = [*find_compiler(), *flags, *build_include_flags(), "names.c"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    errors = [line for line in done.stderr.splitlines() if "error:" in line]
    assert done.returncode == 0, "\n".join(errors[:20])


@cache
def vocabulary() -> frozenset[str]:
    """Every identifier in the C of scenes that have everything."""
    scenes = [("slider_crank", "oiled"), ("slider_crank", "ideal"), ("double_pendulum", "dry"), ("every_kind", "ideal")]
    sources = [generate_kernel_source((VALID / f"{f}.yaml").read_bytes(), "f", scene) for f, scene in scenes]
    texts = [text for source in sources for name, text in source.files.items() if name.endswith((".c", ".h"))]
    texts += read_engine_files().values()
    words = re.findall(r"[A-Za-z]\w*", re.sub(r"/\*.*?\*/", " ", "\n".join(texts), flags=re.S))
    return frozenset(filter(accepted, words))


@cache
def macros() -> frozenset[str]:
    """The object-like macros of the headers."""
    include = f"-I{sysconfig.get_paths()['include']}"
    done = subprocess.run(
        [*find_compiler(), "-std=c11", "-dM", "-E", "-x", "c", include, "-"],
        input=INCLUDES,
        capture_output=True,
        text=True,
        check=True,
    )
    return frozenset(filter(accepted, re.findall(r"^#define ([A-Za-z]\w*) ", done.stdout, flags=re.M)))


def with_parameters(names: Iterable[str]) -> bytes:
    """A scene with everything whose forces use all of the names, in every kernel that calls helpers."""
    names = sorted(names)
    sums = [" + ".join(names[i : i + 12]) for i in range(0, len(names), 12)]
    forces = [
        f"  f{i}: {{torque: a, value: t * sign(b.omega) * max(0, min(b.x, 1)) * ({s})}}" for i, s in enumerate(sums)
    ]
    parameters = [f"  {name}: 1.5" for name in names]
    return "\n".join(
        [
            "format: gudgeon/1",
            "name: names",
            "parameters:",
            *parameters,
            "gravity: [0, -9.81]",
            "bodies: {a: {length: 1, mass: 1, inertia: 1}, b: {length: 1, mass: 1, inertia: 1}}",
            "ground: {O: [0, 0]}",
            "joints: {g: {revolute: [ground.O, a.tail]}, A: {revolute: [a.head, b.tail]}}",
            "materials: {s: {E: 1e9, nu: 0.3}}",
            "bearings: {pin: {radius: 1, clearance: 0.1, length: 1, bearing_material: s, journal_material: s}}",
            "contacts:",
            "  oil:",
            "    normal: {law: lankarani_nikravesh, restitution: 0.9}",
            "    friction: {law: modified_coulomb, mu: 0.1, v0: 1, v1: 2}",
            "    film: {law: pinkus_sternlicht, viscosity: 1}",
            "    transition: 0.01",
            "scenes: {oiled: {play: {A: {bearing: pin, contact: oil}}}}",
            "forces:",
            *forces,
        ]
    ).encode()


NAMED = ("oiled", 12), ("oiled", 1), ("ideal", 1)


@pytest.mark.parametrize("of", slow_but(NAMED[:1], NAMED), ids="{0[0]}-{0[1]}".format)
def test_parameters_named_as_emitted_code_and_macros(of: tuple[str, int], tmp_path: Path) -> None:
    """Each twelfth of them always; all of them take a minute."""
    scene, every = of
    names = vocabulary() | {name for name in TRIED if accepted(name)}
    assert {"rhs", "max_of", "Parameters", "N_ROWS", "TREE", "Real", "MAX_RUN_SCALE_S"} <= names
    message = {name for name in TRIED if accepted(name)} | {*sorted(names)[::every]}
    check_c(generate_kernel_source(with_parameters(message), "f", scene), tmp_path)


@pytest.mark.parametrize("every", slow_but([6], [6, 1]))
def test_parameters_named_as_macros_of_the_headers(every: int, tmp_path: Path) -> None:
    known = {"DBL_MAX", "FP_NAN", "INT_MAX", "Py_None"}
    assert known <= macros()
    check_c(generate_kernel_source(with_parameters(known | {*sorted(macros())[::every]}), "f", "ideal"), tmp_path)


def test_parameters_named_as_symbols_of_the_equations_do_not_change_a_number(tmp_path: Path) -> None:
    """A parameter and a symbol of one name would be one symbol: the right-hand side would be another's."""
    own = {symbol.name for symbol in vars(contact).values() if isinstance(symbol, sp.Symbol)}
    own |= {f"{name}_{part}" for name in own for part in ("dry", "film")} | {"F_r", "T0"}
    own |= {name for group in (*VARIABLES.values(), *RESULTS.values()) for name in group}
    hostile = sorted(name for name in own | set(TRIED) if accepted(name))
    assert {"n_x", "omega_i", "M_j_film", "epsilon"} <= set(hostile)
    q = np.array([0.5, 0.0, 0.0, 1.6, 0.01, 0.02])  # the journal of A is where the film hands over to the contact
    y = np.concatenate([q, [0.1, 0.2, -0.5, 0.3, -0.7, 0.4]])
    found = []
    for name, parameters in (("plain", [f"plain{i:03}" for i in range(len(hostile))]), ("hostile", hostile)):
        path = tmp_path / f"{name}.yaml"
        path.write_bytes(with_parameters(parameters))
        linkage = gudgeon.load(path, scene="oiled")
        found.append(linkage.rhs(0.3, y))
        assert np.isfinite(found[-1]).all()
    np.testing.assert_allclose(found[1], found[0], rtol=1e-11)


# Pieces that meet again when they are joined by '_': body a_b with point c, body a with point b_c.
PIECES = ("a", "b", "x", "y", "a_b", "b_x", "tail", "mass", "theta", "cos", "arm", "length", "value", "rate", "dot")
names_of_pieces = st.lists(st.sampled_from((*PIECES, "2", "inverse", "phi", "guess")), min_size=1, max_size=3).map(
    "_".join
)
distinct = st.lists(names_of_pieces.filter(accepted), min_size=14, max_size=14, unique=True)
COORDINATES = {"x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha", "origin", "com", "tail", "head"}


def clashing(names: list[str], points: list[str]) -> bytes:
    """A linkage whose bodies, points, joints, drives, forces and parameters have these names."""
    a, b, c, pivot, pin, wrist, guide, drive, spring, push, out, k, m, other = names
    p, q = points
    return f"""
format: gudgeon/1
name: clash
gravity: [0, -1]
parameters: {{{k}: 2, {m}: 1, {other}: 3}}
bodies:
  {a}: {{length: 1, mass: {m}, inertia: 1, points: {{{p}: [1, 2], {q}: [2, 1]}}}}
  {b}: {{length: 3, mass: 1, inertia: {m}, points: {{{q}: [1, 3]}}, com: [1, 0.1]}}
  {c}: {{mass: 1, inertia: 1, points: {{{p}: [0, 0.5]}}}}
ground: {{{p}: [0, 0], {q}: [0, 1]}}
joints:
  {pivot}: {{revolute: [ground.{p}, {a}.tail]}}
  {pin}: {{revolute: [{a}.head, {b}.tail]}}
  {wrist}: {{revolute: [{b}.head, {c}.origin]}}
  {guide}: {{translational: [ground.{q}, {c}.origin], axis: [1, 0]}}
drives: {{{drive}: {{angle: {a}, value: 1 + 2 rad/s * t}}}}
forces:
  {spring}: {{spring_damper: [{a}.{p}, {c}.{p}], stiffness: {k}, free_length: 0.1, damping: {other}}}
  {push}: {{force: {b}.{q}, value: ['{k} * t * {b}.{q}.vx', '{m} * {c}.vx'], axes: body}}
start: {{guess: {{{b}.theta: -0.3, {c}.x: 3}}}}
outputs: {{{out}: {spring}.F + {wrist}.Fx}}
""".encode()


@pytest.mark.parametrize("examples", slow_but([3], [3, 12]))
def test_names_that_meet_when_joined(examples: int, tmp_path: Path) -> None:
    @settings(max_examples=examples, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
    @given(names=distinct, points=st.lists(names_of_pieces.filter(accepted), min_size=2, max_size=2, unique=True))
    def compiles(names: list[str], points: list[str]) -> None:
        points = [f"{point}_" if point in COORDINATES else point for point in points]
        check_c(generate_kernel_source(clashing(names, points), "f", "ideal"), tmp_path)

    compiles()


UNUSABLE = {*WORDS, *YAML_NULL}
THINGS = sorted(name for name in NOT_IN_CODE if len(name) <= 12 and name not in FUNCTIONS and name not in UNUSABLE)


@pytest.mark.parametrize("first", slow_but([0, 84], range(0, len(THINGS) - 13, 28)))
def test_things_named_as_what_c_has(first: int, tmp_path: Path) -> None:
    """C's keywords and library name bodies, joints, drives, forces, parameters and outputs, and the mechanism."""
    names = THINGS[first : first + 14]
    data = clashing(names, ["floor", "class"]).replace(b"name: clash", f"name: {names[0]}".encode())
    check_c(generate_kernel_source(data, "f", "ideal"), tmp_path)


def test_things_named_as_what_c_has_do_not_change_a_number(tmp_path: Path) -> None:
    plain = [f"n{i}" for i in range(14)]
    named = ["free", "int", "floor", "main", "time", "double", "round", "class", "index", "y1", "def", "errno", "long"]
    named.append("I")
    found = []
    for name, names, points in (("plain", plain, ["p0", "p1"]), ("free", named, ["floor", "in"])):
        path = tmp_path / f"{name}.yaml"
        path.write_bytes(clashing(names, points).replace(b"name: clash", f"name: {name}".encode()))
        linkage, y = gudgeon.load(path), np.random.default_rng(5).uniform(-1.0, 1.0, 18)
        found.append(linkage.rhs(0.3, y))
        equations = linkage.model.numpy()
        found.append(equations.phi(0.3, y[:9], equations.prepare()))
    np.testing.assert_allclose(found[2], found[0], rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(found[3], found[1], rtol=1e-11, atol=1e-11)


def test_what_expressions_could_not_tell_apart_is_refused() -> None:
    def refuses(name: str, what: str) -> bool:
        try:
            check_name(name, what, None)
        except BadNameError:
            return True
        return False

    words = {*FUNCTIONS, *WORDS} - set(YAML_NULL)
    for what in ("body", "joint", "drive", "force", "parameter", "output"):
        assert all(refuses(name, what) for name in RESERVED)
        assert not any(refuses(name, what) for name in ("floor", "free", "int", "main", "class", "index"))
        assert refuses("time", what) == (what == "output")
        assert all(refuses(name, what) == (what in ("parameter", "output")) for name in words)
        assert all(refuses(name, what) for name in YAML_NULL)
    for what in ("point", "mechanism"):
        assert not any(refuses(name, what) for name in {*RESERVED, *words, *NOT_IN_CODE} - set(YAML_NULL))
        assert not refuses("gudgeon_x", what) and refuses("a__b", what)


def test_hostile_names_do_not_change_a_number(tmp_path: Path) -> None:
    """The same linkage under plain and under hostile names: Φ, Φ_q, γ and the right-hand side agree."""
    plain = clashing([f"n{i}" for i in range(14)], ["p0", "p1"])
    hostile = clashing(
        [
            "a_b",
            "a",
            "aside_",
            "max_of",
            "clearance_A",
            "dynamics",
            "a_b_c",
            "arm_a",
            "phi_a",
            "b_c_value",
            "out_",
            "Parameters",
            "a_b_mass",
            "inverse_a_b_mass",
        ],
        ["c", "b_c"],
    )
    rng = np.random.default_rng(5)
    q, v = rng.uniform(-1.0, 1.0, 9), rng.uniform(-1.0, 1.0, 9)
    found = []
    for name, data in (("plain", plain), ("hostile", hostile)):
        path = tmp_path / f"{name}.yaml"
        path.write_bytes(data)
        linkage = gudgeon.load(path)
        y = np.concatenate([q, v])
        found.append((linkage.phi(0.3, q), linkage.phi_q(0.3, q), linkage.gamma(0.3, q, v), linkage.rhs(0.3, y)))
    for first, second in zip(*found, strict=True):
        np.testing.assert_allclose(first, second, rtol=1e-11, atol=1e-11)
