"""Suggest corrections of invalid units: `3 km/(60 min)` for `3 km/h`, `2*pi` for `2pi`.

The text after a number is parsed as factors, each a symbol with a power. Symbols of other unit systems are replaced by
units of the list (units.py). A correction is suggested only if the resulting value is accepted.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction

from gudgeon.errors import (
    ExpressionError,
    InputError,
    InputErrors,
    Location,
    UnitError,
    UnknownNameError,
    combine_errors,
)
from gudgeon.language.names import find_nearest_name
from gudgeon.language.units import OTHER_WORDS, UNITS, Dimension, describe_dimension, find_symbol_dimension, find_unit

_MAX_SHOWN, _MAX_LISTED = 3, 6  # largest numbers of proposals, and of units that fit
_MAX_ALTERNATIVES = 8  # readings of one unit
_MAX_LENGTH = 2000  # characters of the longest value whose remedies are tried
# units that files lack, in units of the list
_OTHER_UNITS: Mapping[str, tuple[str, ...]] = {
    **{word: (f"1 {written}",) for word, written in OTHER_WORDS.items()},
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), ("60 min",)),
    **dict.fromkeys(("day", "days"), ("1440 min",)),
    "mins": ("1 min",),
    **dict.fromkeys(("Hz", "hz", "HZ", "cps"), ("1 rev/s", "1 1/s")),
    **dict.fromkeys(("turn", "turns", "cycle", "cycles", "revs", "revolution", "revolutions", "rot"), ("1 rev",)),
    **dict.fromkeys(("\u00b0", "degs"), ("1 deg",)),
    **dict.fromkeys(("rads", "radians"), ("1 rad", "1 rad/s")),
    **dict.fromkeys(("t", "ton", "tonne", "tonnes", "Mg"), ("1000 kg",)),
    "kgs": ("1 kg",),
    "oz": ("0.028349523125 kg",),
    "slug": ("14.5939029372 kg",),
    **dict.fromkeys(("kgf", "kp"), ("9.80665 N",)),
    **dict.fromkeys(("dyn", "dyne"), ("1e-5 N",)),
    **dict.fromkeys(("erg", "ergs"), ("1e-7 J",)),
    "cal": ("4.184 J",),
    "kcal": ("4184 J",),
    "Wh": ("3600 J",),
    "hp": ("745.69987158227 W",),
    "PS": ("735.49875 W",),
    **dict.fromkeys(("psi", "PSI"), ("6894.757293168 Pa",)),
    "ksi": ("6894757.293168 Pa",),
    "atm": ("101325 Pa",),
    "cSt": ("1 mm^2/s",),
    "St": ("100 mm^2/s",),
    **dict.fromkeys(("mi", "mile", "miles"), ("1609.344 m",)),
    **dict.fromkeys(("yd", "yard", "yards"), ("0.9144 m",)),
    **dict.fromkeys(("mil", "mils", "thou"), ("0.001 in",)),
    **dict.fromkeys(("micron", "microns"), ("1 um",)),
    **dict.fromkeys(("g0", "g_0", "gn", "g_n"), ("9.80665 m/s^2",)),
    **dict.fromkeys(("\u00c5", "angstrom"), ("0.1 nm",)),
    "mph": ("0.44704 m/s",),
    "mPas": ("1 mPa*s",),
    "kNm": ("1 kN*m",),
    "mNm": ("1 mN*m",),
    "U": ("1 rev",),
}
# SI prefixes as factors
_PREFIXES = {
    "p": "1e-12",
    "n": "1e-9",
    "u": "1e-6",
    "\u00b5": "1e-6",
    "\u03bc": "1e-6",
    "m": "1e-3",
    "c": "0.01",
    "d": "0.1",
    "da": "10",
    "h": "100",
    "k": "1000",
    "K": "1000",
    "M": "1e6",
    "G": "1e9",
}
_PLAIN = str.maketrans("\u00b5\u03bcK", "uuk")  # translation of prefixes to those of the list
_PREFIXED = ("m", "g", "s", "N", "Pa", "J", "W", "rad", "bar", "Hz", "P")
_RAISED = str.maketrans("\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207b", "0123456789-", "\u207a")

_SPEEDS = ("kph", "kmh")  # km/h, which is not a multiple of one unit
_NUMBER = re.compile(r"(?<![\w.])(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|pi(?!\w)) *")
_SYMBOL = r"(?:g_?0\b|g_n\b|[A-Za-z\u00b5\u03bc\u00b0\u00c5]+)"
_FACTOR = re.compile(
    rf"(?P<symbol>{_SYMBOL})(?P<power> *(?:\^|\*\*) *(?:\([^()]*\)|[-+]? ?[\w.]*)"
    r"|[\u207a\u207b\u2070\u00b9\u00b2\u00b3\u2074-\u2079]+|-?[0-9](?:\.5)?)?(?![\w(])"
)
_GROUP = re.compile(r"\((?P<inside>[^()]*)\) *(?:\^|\*\*) *(?P<power>\(-?[1-9]/2\)|-?[0-9.]+)")
_BETWEEN = re.compile(r" *[*/\u00b7\u22c5\u00d7] *(?!\*)|[-.](?=[A-Za-z])| per | +")
_WORD = re.compile(r"[A-Za-z][\w.]*")
_POWERS = tuple(Fraction(n, 2) for n in (4, 6, 2, 8, 3, 1, -2, -4, *range(10, 19, 2), 5, -1, -3, -6))


@dataclass(frozen=True)
class _Factor:
    """A unit symbol with its power, None if that is not a number.

    `is_sign_ambiguous`: the power may have the other sign, as m in `N/s m`.
    """

    symbol: str
    power: Fraction | None
    is_sign_ambiguous: bool = False  # m in `N/s m`


@dataclass(frozen=True)
class _Quantity:
    """A number and the text of its (invalid) unit: text[begin:end], the unit from `unit_at` on."""

    begin: int
    unit_at: int
    end: int
    number: str
    factors: tuple[_Factor, ...]


@contextmanager
def add_unit_hints(
    text: str,
    location: Location,
    check_value: Callable[[str], object],
    expected: Dimension | None,
    names: Container[str] = (),
) -> Iterator[None]:
    """Add to errors raised inside the context a hint with the correction of an invalid unit.

    text: the whole value, whose first character is at `location`. check_value(other): raises InputError unless the text
    `other` is a valid value. expected: dimension of the value, None if any. names: parameters and expressions of the
    file. Errors without a correction are raised unchanged; errors with equal hints are combined into one.
    """
    try:
        yield
    except (UnitError, ExpressionError, UnknownNameError, InputErrors) as caught:
        errors_by_hint = dict[str, InputError]()  # by hint: several errors may have the same correction
        for error in caught.errors if isinstance(caught, InputErrors) else [caught]:
            hint = _find_remedy(error, text, location, check_value, expected, names)
            errors_by_hint.setdefault(
                hint or str(error), type(error)(error.message, error.where, hint) if hint else error
            )
        raise combine_errors(errors_by_hint.values()) from None


def _find_remedy(
    error: InputError,
    text: str,
    location: Location,
    check_value: Callable[[str], object],
    expected: Dimension | None,
    names: Container[str],
) -> str:
    """Return the hint for one error: an accepted correction, a similar unit, or units of the expected dimension.

    "" if there is no quantity at its location, or if the text is longer than _MAX_LENGTH. Other arguments are those of
    `add_unit_hints`.
    """
    error_location = error.where
    if (
        error_location is None
        or (error_location.file, error_location.line) != (location.file, location.line)
        or len(text) > _MAX_LENGTH
    ):
        return ""
    quantity = _find_quantity(text, error_location.column - location.column, names)
    if quantity is None:
        return ""

    def list_accepted_proposals(proposals: Iterable[str], max_count: int) -> list[str]:
        """Return the first `max_count` proposals that give a valid value in place of the quantity, each once.

        After a division or power sign, proposals with a product get brackets. The quantity as it is written is left
        out.
        """
        before, after = text[: quantity.begin], text[quantity.end :]
        divides = before.rstrip().endswith(("/", "**"))
        bracketed = (
            f"({proposal})" if divides and re.search(r"[*(]", proposal) else proposal for proposal in proposals
        )
        fitting = (
            proposal
            for proposal in bracketed
            if proposal != written and _is_accepted(check_value, before, proposal, after, location)
        )
        return list(itertools.islice(dict.fromkeys(fitting), max_count))

    written = text[quantity.begin : quantity.end]
    for proposals, max_shown in _iterate_proposals(text, quantity, names, expected):
        if shown := list_accepted_proposals(proposals, max_shown):
            differ = ": they differ by 2*pi" if any("rev" in proposal for proposal in shown) and shown[1:] else ""
            return f"write {' or '.join(shown)}{differ}"
    guess = find_nearest_name(text[quantity.unit_at : quantity.end], UNITS, 0.6) if not quantity.factors else None
    if guess and list_accepted_proposals([f"{quantity.number} {guess}"], 1):
        return f"did you mean {guess if text[: quantity.unit_at].endswith(' ') else f'{quantity.number} {guess}'!r}?"
    if expected is not None:
        listed = list_accepted_proposals((f"{quantity.number} {proposal}" for proposal in UNITS), _MAX_LISTED)
        if units := ", ".join(proposal.removeprefix(f"{quantity.number} ") for proposal in listed):
            return f"units that fit here: {units}"
    if re.match("did you mean|write|.* is written|a power of", error.hint):  # it was not tried, and does not fit
        return f"expected {describe_dimension(expected)}" if expected else f"units are {', '.join([*UNITS][:12])}, …"
    return ""


def _is_accepted(
    check_value: Callable[[str], object], text_before: str, proposal: str, text_after: str, location: Location
) -> bool:
    """Return whether the value with this proposal is valid, or invalid only in the unit of a later number.

    text_before, text_after: text around the proposal. location: of the value.
    """
    try:
        check_value(text_before + proposal + text_after)
    except InputError as error:
        error_location, begin = error.where, len(text_before + proposal)
        blanked = " " * begin + text_after
        later = _find_quantity(blanked, error_location.column - location.column, ()) if error_location else None
        return later is not None and later.begin > begin and blanked[later.begin - 1] in " (,"
    return True


def _find_quantity(text: str, offset: int, names: Container[str]) -> _Quantity | None:
    """Return the number with its unit text that contains the character at `offset`; None if there is none.

    The unit text begins directly at the number or after "/" or "per". names: of the file, which are not units after an
    operator.
    """
    for match in _NUMBER.finditer(text, 0, offset + 1):
        begin = match.end()
        position = begin + 2 if text.startswith("1/", begin) and match[0] != match["number"] else begin
        is_divided = position > begin
        if per := re.compile(r"(?:/|per ) *").match(text, begin):
            position, is_divided = per.end(), True
        factors, end = _parse_factors(text, position, is_divided, names)
        word = _WORD.match(text, begin)
        end = end if factors else word.end() if word else begin
        if begin <= offset < end:
            return _Quantity(match.start(), begin, end, match["number"], tuple(factors))
    return None


def _parse_factors(text: str, position: int, is_divided: bool, names: Container[str]) -> tuple[list[_Factor], int]:
    """Return the factors of a unit text from `position` on, such as `kg*m/s^2`, and the offset where they end.

    is_divided: whether a division precedes the first. names: of the file, which end the unit after an operator. Parsing
    stops at the first unknown symbol. Powers include the sign of divisions and the power of parentheses; None: an
    invalid power. The symbols kph and kmh give two factors.
    """
    factors, end, below, between = list[_Factor](), position, is_divided, ""
    while True:
        sign = -1 if is_divided else 1
        group, factor = _GROUP.match(text, position), _FACTOR.match(text, position)
        if group:
            inner, inner_end = _parse_factors(group["inside"], 0, False, names)
            power = _parse_power(group["power"])
            if not inner or inner_end != len(group["inside"]) or power is None:
                return factors, end
            raised = [
                (inner_factor, None if inner_factor.power is None else inner_factor.power * power * sign)
                for inner_factor in inner
            ]
            factors += [_Factor(inner_factor.symbol, new) for inner_factor, new in raised]
        elif factor and not (factors and between in ("*", "/") and _is_name(factor[0], names)):
            power = _parse_power(factor["power"])
            power = None if power is None else sign * power
            if factor["symbol"] in _SPEEDS and power is not None:
                factors += [_Factor("km", power), _Factor("h", -power)]
            elif _list_unit_meanings(factor["symbol"]):
                factors.append(_Factor(factor["symbol"], power, bool(factors) and not between and below))
            else:
                return factors, end
        else:
            return factors, end
        end = (group or factor).end()  # type: ignore[union-attr]
        if (operator := _BETWEEN.match(text, end)) is None:
            return factors, end
        between = operator[0].strip()
        is_divided, position = between in ("/", "per"), operator.end()
        below = below or is_divided


def _is_name(symbol: str, names: Container[str]) -> bool:
    """Return whether a symbol is a name of the file, t or pi."""
    return symbol in names or symbol in ("t", "pi")


def _parse_power(text: str | None) -> Fraction | None:
    """Return the power written as ^2, **1.5, -1, ^(1/2) or in superscripts; 1 for no text, None for another text."""
    if not text:
        return Fraction(1)
    try:
        return Fraction(re.sub(r"[\^*() +]", "", text.translate(_RAISED)))
    except (ValueError, ZeroDivisionError):
        return None


def _list_unit_meanings(symbol: str) -> list[tuple[Decimal, str]]:
    """Return the possible meanings of a unit symbol, each a number and a unit of the list; [] for an unknown one.

    The first of these that knows the symbol decides: the list, other unit systems, SI prefixes, other capitals. For
    example "hour" gives [(60, "min")].
    """
    if find_symbol_dimension(symbol):
        return [(Decimal(1), symbol)]
    if symbol in _OTHER_UNITS:
        return [(Decimal(candidate.split()[0]), candidate.split()[1]) for candidate in _OTHER_UNITS[symbol]]
    for prefix in ("da", symbol[:1]):
        base_symbol = symbol.removeprefix(prefix)
        if prefix in _PREFIXES and base_symbol != symbol and base_symbol in _PREFIXED:
            if find_symbol_dimension(listed_symbol := prefix.translate(_PLAIN) + base_symbol):
                return [(Decimal(1), listed_symbol)]
            return [(Decimal(_PREFIXES[prefix]) * number, unit) for number, unit in _list_unit_meanings(base_symbol)]
    candidates = [
        candidate for candidate in (*UNITS, *_OTHER_UNITS) if candidate.lower() == symbol.lower() and len(symbol) > 1
    ]
    differences = {candidate: sum(a != b for a, b in zip(candidate, symbol, strict=True)) for candidate in candidates}
    return [
        meaning
        for candidate in candidates
        if differences[candidate] == min(differences.values())
        for meaning in _list_unit_meanings(candidate)
    ]


def _iterate_proposals(
    text: str, quantity: _Quantity, names: Container[str], expected: Dimension | None
) -> Iterator[tuple[Iterator[str], int]]:
    """Yield groups of corrections for a quantity, the likeliest first, each with the number of corrections to show.

    They are listed units and products, a difference (3 - 1 for 3-1), a product with a name, and other powers. text: the
    value that contains the quantity. names: of the file. expected: dimension of the value, None if any.
    """
    word, written = _WORD.match(text, quantity.unit_at), text[quantity.begin : quantity.end]
    product = f"{quantity.number}*{text[quantity.unit_at : quantity.end]}"
    raised = re.fullmatch(r"(.*\S) *\*\* *(\S+)", written)
    others = [f"({raised[1]})**{raised[2]}"] if raised else []
    others += [product] if word and word[0] in names else []
    others += [re.sub(rf"\^ *(?={_SYMBOL})", "*", written)]
    difference = re.sub(r"(?<=[a-z])-(?=[0-9])", " - ", written)
    others += [difference] if expected is None else []
    yield itertools.chain(_iterate_listed_units(quantity), others), _MAX_SHOWN
    yield iter([difference]), 1
    if word:
        yield iter([product]), 1
    wrong = [k for k, factor in enumerate(quantity.factors) if factor.power is None or not _is_power(factor.power)]
    if expected is not None and len(wrong) == 1:
        yield _iterate_powers(quantity, wrong[0]), 1


def _iterate_listed_units(quantity: _Quantity) -> Iterator[str]:
    """Yield the quantity in units of the list, for each combination of the meanings of its symbols.

    A factor that may belong to numerator or denominator counts in both ways. At most _MAX_ALTERNATIVES are yielded;
    nothing without factors or with an invalid power.
    """
    if not quantity.factors or any(factor.power is None for factor in quantity.factors):
        return
    alternatives = [
        [
            (meant, factor.power, k)
            for k in ((1, -1) if factor.is_sign_ambiguous else (1,))
            for meant in _list_unit_meanings(factor.symbol)
        ]
        for factor in quantity.factors
    ]
    for choice in itertools.islice(itertools.product(*alternatives), _MAX_ALTERNATIVES):
        yield _format_quantity(quantity.number, [(meant, Fraction(power or 1) * sign) for meant, power, sign in choice])


def _iterate_powers(quantity: _Quantity, factor_index: int) -> Iterator[str]:
    """Yield the quantity in units of the list with other powers of one of its factors, the likeliest first."""
    for power in _POWERS:
        factors = (
            *quantity.factors[:factor_index],
            _Factor(quantity.factors[factor_index].symbol, power),
            *quantity.factors[factor_index + 1 :],
        )
        yield from _iterate_listed_units(replace(quantity, factors=factors))


def _is_power(power: Fraction) -> bool:
    """Return whether a listed unit may have this power: ±1 to ±9, or an odd multiple of a half below 10."""
    return power != 0 and (abs(power) <= 9 and power.denominator == 1 or abs(power) < 10 and power.denominator == 2)


def _format_quantity(number: str, factors: Sequence[tuple[tuple[Decimal, str], Fraction]]) -> str:
    """Return a number times factors as an expression that the parser accepts; "pi" stays a factor of its own.

    factors: pairs of a meaning (scale, listed unit) and its power. The scale of a meaning with power 1 is multiplied
    into the number: 5 t is 5000 kg. With other powers, a scale other than 1 stays in parentheses: `(1000 kg)**2`.
    Powers that units cannot have in the list, such as fractions, are written as `(1 UNIT)**POWER`.
    """
    scale, numerator, denominator, suffix = Decimal(1), list[str](), list[str](), ""
    for (factor_scale, symbol), power in factors:
        if factor_scale != 1 and power != 1:
            base, operator = f"({factor_scale} {symbol})", "/" if power < 0 else " * "
            suffix += operator + base + (f"**{_format_power(abs(power))}" if abs(power) != 1 else "")
            continue
        scale *= factor_scale
        for sign, unit, unit_power in re.findall(rf"(^|[*/])(?:1/)?({_SYMBOL})(?:\^(\d))?", symbol):
            exponent = power * int(unit_power or 1) * (-1 if sign == "/" or symbol.startswith("1/") else 1)
            if (
                not _is_power(exponent)
                or exponent.denominator == 2
                and not find_unit(f"{unit}^{_format_power(abs(exponent))}")
            ):
                suffix += f" * (1 {unit})**{_format_power(exponent)}"
            else:
                unit_text = unit + (f"^{_format_power(abs(exponent))}" if abs(exponent) != 1 else "")
                (numerator if exponent > 0 else denominator).append(unit_text)
    value = number
    if scale != 1:
        scale *= 1 if number == "pi" else Decimal(number)
        scaled = f"{scale.normalize():{'f' if Decimal('1e-5') < scale < Decimal('1e7') else 'e'}}"
        value = f"pi * {scaled}" if number == "pi" else scaled
    written = "*".join(numerator) or ("1" if denominator else "")
    return " ".join(filter(None, (value, "/".join([written, *denominator])))) + suffix


def _format_power(power: Fraction) -> str:
    """Return the power of a unit as text: "2", "0.5" or "(1/3)"."""
    return str(power) if power.denominator == 1 else str(float(power)) if power.denominator == 2 else f"({power})"
