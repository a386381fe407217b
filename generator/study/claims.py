"""Reads `claims:` of a study file: published numbers and trends, each with the runs that it concerns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gudgeon.errors import BadNameError, BadValueError
from gudgeon.generator.format.shapes import missing_key, unknown_key
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import check_keys, label, line, mapping, place_of, text, texts, whole
from gudgeon.generator.study.spec import (
    ALONG,
    BETWEEN,
    COUNTED,
    COUNTS,
    KINDS,
    SAME,
    Claims,
    NumberClaim,
    Selection,
    TrendClaim,
    Trial,
)
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.names import unknown_name
from gudgeon.language.shown import counted

KEYS = ("source", "numbers", "trends")
NUMBER = ("figure", "says", "measure", "part", "at", "value", "beside", "note", "heading")
MESSAGES = ("says", "figure", "note", "heading")  # keys that every trend may have
COMMON = ("measure", "part", "at")
MORE = {
    "grows_along": ("by",),
    "alike_along": ("within",),
    "spreads_along": ("more_than",),
    "larger": ("than", "by"),
    "most_lowered": ("from", "to"),
    "exceeds": ("by",),
    "near": ("within",),
}
NEEDED = {"alike_along": "within", "spreads_along": "more_than", "larger": "than", "near": "within"}
TRIAL = tuple(dict.fromkeys((*KINDS, *COMMON, *(key for keys in MORE.values() for key in keys))))
TREND = (*MESSAGES, *TRIAL, "all", "not_computed")


def read_claims(reader: Reader, root: Map) -> Claims:
    """Read the claims of a study file; empty Claims if it makes none."""
    if "claims" not in root:
        return Claims()
    with reader.collect():
        node = mapping(root["claims"], "claims", root.key("claims"))
        check_keys(reader, node, KEYS, "claims")
        source = ""
        with reader.collect():
            source = line(node, "source", "claims")
        numbers, trends = list[NumberClaim](), list[TrendClaim]()
        for name, below in _claim_entries(reader, node, "numbers"):
            with reader.collect():
                numbers.append(_read_number(reader, name, mapping(below, f"claims.numbers.{name}", name)))
        for name, below in _claim_entries(reader, node, "trends"):
            with reader.collect():
                trends.append(_read_trend(name, mapping(below, f"claims.trends.{name}", name)))
        _check_names_once(reader, [*(one.name for one in numbers), *(one.name for one in trends)])
        _check_references(reader, numbers)
        return Claims(source, tuple(numbers), tuple(trends))
    return Claims()


def _claim_entries(reader: Reader, node: Map, section: str) -> Sequence[tuple[Text, Any]]:
    """Return the entries of a section of claims, none if the section is missing or wrong."""
    with reader.collect():
        if section in node:
            return mapping(node[section], f"claims.{section}", node.key(section)).pairs()
    return ()


def _check_names_once(reader: Reader, names: Sequence[Text]) -> None:
    """Collect an error for each claim whose name was used before."""
    for k, name in enumerate(names):
        if name in names[:k]:
            first = names[names.index(name)].where
            reader.errors.append(BadNameError(f"claim {str(name)[:60]!r} is there twice", name.where, f"once: {first}"))


def _read_number(reader: Reader, name: Text, node: Map) -> NumberClaim:
    """Read a claim about one number."""
    owner = f"claims.numbers.{name}"
    label(name, "claim")
    if not check_keys(reader, node, NUMBER, owner, ("measure",)):
        raise missing_key("measure", node.where, owner)
    measure = text(node["measure"], f"{owner}.measure", node.key("measure"), "the name of a measure")
    value = text(node["value"], f"{owner}.value", node.key("value"), "a number") if "value" in node else None
    beside = text(node["beside"], f"{owner}.beside", node.key("beside"), "a name") if "beside" in node else None
    if value is not None and beside is not None:
        raise BadValueError(f"{owner} has both value and beside", node.key("beside").where, "expected one of both")
    figure, says, note, heading = (line(node, key, owner) for key in ("figure", "says", "note", "heading"))
    return NumberClaim(name, figure, measure, _read_selection(node, owner, name), value, says, note, beside, heading)


def _check_references(reader: Reader, numbers: Sequence[NumberClaim]) -> None:
    """Collect an error unless the claim that a number refers to (`beside`) exists and has the same measure."""
    measures = {str(one.name): one.measure for one in numbers}
    for one in numbers:
        with reader.collect():
            other = one.beside
            if other is None:
                continue
            if other not in measures:
                raise unknown_name("number", other, list(measures), other.where)
            if measures[other] != one.measure:
                message = f"{other} is about {measures[other]}, {one.name} about {one.measure}"
                raise BadValueError(message, other.where, "expected a number of the same measure")


def _read_selection(node: Map, owner: str, where: Text) -> Selection:
    """Read `part` and `at`: the runs that a claim concerns."""
    part = text(node["part"], f"{owner}.part", node.key("part"), "the name of a part") if "part" in node else None
    at = _read_values(mapping(node["at"], f"{owner}.at", node.key("at")), f"{owner}.at") if "at" in node else {}
    return Selection(part, at, where)


def _read_values(node: Map, owner: str) -> dict[Text, Text]:
    """Read a mapping of coordinates to single values."""
    return {key: text(value, f"{owner}.{key}", key, "one value") for key, value in node.pairs()}


def _read_other_selection(node: Map, key: str, owner: str, base: Selection) -> Selection:
    """Read the selection at a key, {part: …, c: 0.3 mm}, merged over the selection `base` of the trend."""
    own = mapping(node[key], f"{owner}.{key}", node.key(key))
    values = _read_values(own, f"{owner}.{key}")
    part = next((value for name, value in values.items() if name == "part"), base.part)
    kept = {name: value for name, value in base.at.items() if name not in values}
    return Selection(part, kept | {name: value for name, value in values.items() if name != "part"}, node.key(key))


def _read_trend(name: Text, node: Map) -> TrendClaim:
    """Read a claim about a trend, with its trials or the reason why it is not computed."""
    owner = f"claims.trends.{name}"
    label(name, "claim")
    figure, says, note, heading = (line(node, key, owner) for key in ("figure", "says", "note", "heading"))
    if strange := [key for key in node.names() if key not in TREND]:
        raise unknown_key(strange[0], TREND, owner)
    why = line(node, "not_computed", owner)
    own = Map.make([(key, below) for key, below in node.pairs() if key not in MESSAGES], node.where)
    if why:
        if extra := [key for key in own.names() if key != "not_computed"]:
            raise BadValueError(f"{owner} is not computed, and has {extra[0]}", extra[0].where, "expected one of both")
        return TrendClaim(name, figure, says, (), why, note, heading)
    return TrendClaim(name, figure, says, tuple(_read_trials(name, own, owner)), "", note, heading)


def _read_trials(name: Text, node: Map, owner: str) -> list[Trial]:
    """Read the trials of a trend: one, or each of `all`, whose keys override those next to `all`."""
    if "all" not in node:
        return [_read_trial(name, node, owner)]
    every = node["all"]
    if not isinstance(every, Items) or not every:
        raise BadValueError(f"{owner}.all is {kind_of(every)}", node.key("all").where, "expected a list of trials")
    found = []
    for k, below in enumerate(every):
        own = mapping(below, f"{owner}.all[{k}]", node.key("all"))
        if strange := [key for key in own.names() if key not in TRIAL]:
            raise unknown_key(strange[0], TRIAL, f"{owner}.all[{k}]")
        kept = [(key, value) for key, value in node.pairs() if key != "all" and key not in own]
        found.append(_read_trial(name, Map.make([*kept, *own.pairs()], own.where), f"{owner}.all[{k}]"))
    return found


def _read_trial(name: Text, node: Map, owner: str) -> Trial:
    """Read one trial: its kind, measures, selections and limits. Raises an InputError."""
    selected = [key for key in node.names() if key in KINDS]
    if len(selected) != 1:
        message = f"{owner} has {'nothing to judge it by' if not selected else f'both {selected[0]} and {selected[1]}'}"
        hint = f"expected one of: {', '.join((*KINDS, 'all', 'not_computed'))}"
        raise BadValueError(message, place_of(node, name), hint)
    kind, known = selected[0], (selected[0], *COMMON, *MORE.get(selected[0], ()))
    if strange := [key for key in node.names() if key not in known]:
        raise unknown_key(strange[0], known, owner)
    if (needed := NEEDED.get(kind)) and needed not in node:
        raise missing_key(needed, node.where, owner)
    base = _read_selection(node, owner, kind)
    if kind == COUNTS:
        counts = _read_counts(mapping(node[kind], f"{owner}.{kind}", kind), f"{owner}.{kind}")
        return Trial(kind, (), base, kind, counts=counts)
    if "measure" not in node:
        raise missing_key("measure", node.where, owner)
    measures = texts(node["measure"], f"{owner}.measure", node.key("measure"), "names of measures")
    by = next(
        (text(node[key], f"{owner}.{key}", node.key(key), "a number") for key in ("by", "within") if key in node), None
    )
    if kind in BETWEEN:
        return _read_comparison(node, owner, kind, measures, base, by)
    of = text(node[kind], f"{owner}.{kind}", kind, "a dimension" if kind in ALONG else "a measure or a number")
    others = (
        texts(node["more_than"], f"{owner}.more_than", node.key("more_than"), "measures")
        if "more_than" in node
        else (of,)
        if kind in SAME
        else ()
    )
    if kind == "spreads_along" and len(others) != len(measures):
        raise BadValueError(
            f"{owner}.more_than has {counted(len(others), 'name')}",
            node.key("more_than").where,
            f"expected as many as measure: {len(measures)}",
        )
    return Trial(kind, measures, base, of, None, others, by)


def _read_comparison(
    node: Map, owner: str, kind: Text, measures: tuple[Text, ...], base: Selection, by: Text | None
) -> Trial:
    """Read a trial that compares two selections."""
    if kind == "larger":
        return Trial(
            kind,
            measures,
            _read_other_selection(node, kind, owner, base),
            kind,
            _read_other_selection(node, "than", owner, base),
            (),
            by,
        )
    if lacking := [key for key in ("from", "to") if key not in node]:
        raise missing_key(lacking[0], node.where, owner)
    others = texts(node[kind], f"{owner}.{kind}", kind, "other measures, which are lowered less")
    return Trial(
        kind,
        measures,
        _read_other_selection(node, "from", owner, base),
        kind,
        _read_other_selection(node, "to", owner, base),
        others,
    )


def _read_counts(node: Map, owner: str) -> dict[Text, int]:
    """Read the expected counts of bodies, joints and others in a scene."""
    if strange := [key for key in node.names() if key not in COUNTED]:
        raise unknown_key(strange[0], COUNTED, owner)
    return {key: whole(value, f"{owner}.{key}", key, 0) for key, value in node.pairs()}
