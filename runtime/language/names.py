"""Names: what may be one, what is nearest to a mistyped one, and whether two things share one."""

from __future__ import annotations

import keyword
import re

from gudgeon.errors import BadNameError, Location
from gudgeon.language.tree import FUNCTIONS

MAX_LENGTH = 64
LABEL = "[A-Za-z_][A-Za-z0-9_]{0,63}"  # of what a study names: windows, measures, parts, claims
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)

# What names a thing of the file, and nothing in C: emitted code calls it otherwise (generator/symbols/symbols.py).
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

# What no expression could tell from something else.
RESERVED: dict[str, str] = {
    "t": "it is time in expressions",
    "pi": "it is a number in expressions",
    "ground": "it is the frame",
    "energy": "it heads names of results",
    "work": "it heads names of results",
}
# Words of YAML and Python that look like values or operators: an expression takes none of them for a name.
WORDS = frozenset(
    ("true", "false", "null", "yes", "no", "on", "off", "inf", "nan", "True", "False", "None")
    + ("and", "or", "not", "in", "is", "if", "else", "lambda", "for", "await", "yield")
)


def check_name(name: str, what: str, where: Location | None) -> None:
    """Raise BadNameError unless `name` can name a thing: a free identifier of at most 64 characters."""
    check_label(name, what, where)
    reason = RESERVED.get(name) if what not in ("point", "mechanism") else None  # no expression has these alone
    if what in ("parameter", "output", "curve", "expression"):  # the others stand in expressions with a dot only
        reason = "it is a function of expressions" if name in FUNCTIONS else reason
        reason = "an expression takes it for no name" if name in WORDS else reason
    if what == "output" and name == "time":
        reason = "it is the axis of results"
    if name.startswith("gudgeon") or "__" in name:
        reason = "names that begin with 'gudgeon' or hold '__' are kept for emitted code"
    if reason:
        raise BadNameError(
            f"{name!r} cannot name this {what}: {reason}", where, f"expected another name, such as {name}1"
        )


def check_label(name: str, what: str, where: Location | None) -> None:
    """Raise BadNameError unless `name` is an identifier of at most 64 characters.

    It is enough for what no expression and no C identifier is called by alone: scenes, materials, bearings, contacts.
    """
    if not IDENTIFIER.fullmatch(name):
        hint = "expected a letter, then letters, digits or '_', in ASCII"
        if IDENTIFIER.fullmatch(plain := name.replace("-", "_").replace(" ", "_")):
            hint += f", such as {plain}"
        if "=" in name and IDENTIFIER.fullmatch(plain := name.partition("=")[0].strip()):
            hint = f"a value stands behind a colon: {plain}:{name.partition('=')[2].partition('=')[0].rstrip()}"
        raise BadNameError(f"{name[:MAX_LENGTH]!r} cannot name this {what}: it is no identifier", where, hint)
    if len(name) > MAX_LENGTH:
        raise BadNameError(
            f"the name of this {what} has {len(name)} characters", where, f"expected at most {MAX_LENGTH}"
        )


class Namespace:
    """Bodies, joints, drives, forces and outputs share one namespace: a result is indexed by their names."""

    def __init__(self) -> None:
        self._taken: dict[str, tuple[str, Location]] = {}
        self.twice: set[str] = set()

    def add(self, name: str, what: str, where: Location) -> None:
        """Raise BadNameError if the name cannot be, or if something else has it."""
        check_name(name, what, where)
        if name in self._taken:
            other, place = self._taken[name]
            self.twice.add(str(name))
            hint = "expected a name of its own: bodies, joints, drives, forces and outputs share one namespace"
            raise BadNameError(f"{name!r} names two things: this {what}, and the {other} at {place}", where, hint)
        self._taken[name] = what, where
