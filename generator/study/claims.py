"""Reads `claims:` of a study file: published numbers and trends, each with the runs that it concerns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gudgeon.errors import BadNameError, BadValueError
from gudgeon.generator.format.shapes import make_missing_key_error, make_unknown_key_error
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import (
    check_integer_node,
    check_keys,
    check_label_of_entry,
    check_mapping_node,
    check_text_node,
    check_texts,
    find_node_location,
    read_line,
)
from gudgeon.generator.study.spec import (
    COUNTED_PARTS,
    COUNTS,
    KINDS,
    MEASURE_COMPARISONS,
    SELECTION_COMPARISONS,
    TRENDS_ALONG_DIMENSION,
    Claims,
    NumberClaim,
    Selection,
    TrendClaim,
    TrendStatement,
)
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.text_output import format_count

KEYS = ("source", "numbers", "trends")
NUMBER_CLAIM_KEYS = ("figure", "says", "measure", "part", "at", "value", "beside", "note", "heading")
DESCRIPTIVE_KEYS = ("says", "figure", "note", "heading")  # keys that every trend may have
SELECTION_KEYS = ("measure", "part", "at")
FURTHER_KEYS_OF_KIND = {
    "grows_along": ("by",),
    "alike_along": ("within",),
    "spreads_along": ("more_than",),
    "larger": ("than", "by"),
    "most_lowered": ("from", "to"),
    "exceeds": ("by",),
    "near": ("within",),
}
REQUIRED_KEY_OF_KIND = {"alike_along": "within", "spreads_along": "more_than", "larger": "than", "near": "within"}
STATEMENT_KEYS = tuple(
    dict.fromkeys((*KINDS, *SELECTION_KEYS, *(key for keys in FURTHER_KEYS_OF_KIND.values() for key in keys)))
)
TREND_KEYS = (*DESCRIPTIVE_KEYS, *STATEMENT_KEYS, "all", "not_computed")


def read_claims(reader: Reader, root: Map) -> Claims:
    """Return the claims of a study file and their source, the key `source`; empty Claims if the file makes none.

    Errors are collected. Wrong claims are left out. Names of claims must be unique.
    """
    if "claims" not in root:
        return Claims()
    with reader.collect_errors():
        node = check_mapping_node(root["claims"], "claims", root.find_key("claims"))
        check_keys(reader, node, KEYS, "claims")
        source = ""
        with reader.collect_errors():
            source = read_line(node, "source", "claims")
        numbers, trends = list[NumberClaim](), list[TrendClaim]()
        for name, value in _list_claim_entries(reader, node, "numbers"):
            with reader.collect_errors():
                numbers.append(
                    _read_number_claim(reader, name, check_mapping_node(value, f"claims.numbers.{name}", name))
                )
        for name, value in _list_claim_entries(reader, node, "trends"):
            with reader.collect_errors():
                trends.append(_read_trend_claim(name, check_mapping_node(value, f"claims.trends.{name}", name)))
        _collect_repeated_claim_names(reader, [*(claim.name for claim in numbers), *(claim.name for claim in trends)])
        _check_claim_references(reader, numbers)
        return Claims(source, tuple(numbers), tuple(trends))
    return Claims()


def _list_claim_entries(reader: Reader, node: Map, section: str) -> Sequence[tuple[Text, Any]]:
    """Return the entries (name, node) of a section of claims, none if the section is missing or wrong.

    The error is collected.
    """
    with reader.collect_errors():
        if section in node:
            return check_mapping_node(node[section], f"claims.{section}", node.find_key(section)).list_entries()
    return ()


def _collect_repeated_claim_names(reader: Reader, names: Sequence[Text]) -> None:
    """Collect an error for each claim whose name was used before, with the location of the first one."""
    for k, name in enumerate(names):
        if name in names[:k]:
            first_location = names[names.index(name)].where
            reader.errors.append(
                BadNameError(
                    f"claim {str(name)[:60]!r} is given twice",
                    name.where,
                    f"expected once; the first is at {first_location}",
                )
            )


def _read_number_claim(reader: Reader, name: Text, node: Map) -> NumberClaim:
    """Return a claim about one published number, such as {measure: peak, value: 12 N}. Raises an InputError.

    It may have a value to compare with, or the name of another claim (key `beside`), not both.
    """
    address = f"claims.numbers.{name}"
    check_label_of_entry(name, "claim")
    if not check_keys(reader, node, NUMBER_CLAIM_KEYS, address, ("measure",)):
        raise make_missing_key_error("measure", node.where, address)
    measure = check_text_node(node["measure"], f"{address}.measure", node.find_key("measure"), "the name of a measure")
    value = (
        check_text_node(node["value"], f"{address}.value", node.find_key("value"), "a number")
        if "value" in node
        else None
    )
    reference_claim = (
        check_text_node(node["beside"], f"{address}.beside", node.find_key("beside"), "a name")
        if "beside" in node
        else None
    )
    if value is not None and reference_claim is not None:
        raise BadValueError(
            f"{address} has both value and beside", node.find_key("beside").where, "expected one of the two"
        )
    figure, says, note, heading = (read_line(node, key, address) for key in ("figure", "says", "note", "heading"))
    return NumberClaim(
        name, figure, measure, _read_selection(node, address, name), value, says, note, reference_claim, heading
    )


def _check_claim_references(reader: Reader, numbers: Sequence[NumberClaim]) -> None:
    """Collect an error unless the claim that a number refers to (`beside`) exists and has the same measure."""
    measures = {str(claim.name): claim.measure for claim in numbers}
    for claim in numbers:
        with reader.collect_errors():
            reference_claim = claim.reference_claim
            if reference_claim is None:
                continue
            if reference_claim not in measures:
                raise make_unknown_name_error("number", reference_claim, list(measures), reference_claim.where)
            if measures[reference_claim] != claim.measure:
                message = (
                    f"{reference_claim} has the measure {measures[reference_claim]}, {claim.name} has {claim.measure}"
                )
                raise BadValueError(message, reference_claim.where, "expected a number of the same measure")


def _read_selection(node: Map, address: str, location_text: Text) -> Selection:
    """Return the runs that a claim concerns, from its keys `part` and `at: {c: 0.1 mm}`. Raises an InputError.

    `location_text` has the location of the selection. Without these keys, all runs are selected.
    """
    part = (
        check_text_node(node["part"], f"{address}.part", node.find_key("part"), "the name of a part")
        if "part" in node
        else None
    )
    coordinate_values = (
        _read_coordinate_values(check_mapping_node(node["at"], f"{address}.at", node.find_key("at")), f"{address}.at")
        if "at" in node
        else {}
    )
    return Selection(part, coordinate_values, location_text)


def _read_coordinate_values(node: Map, address: str) -> dict[Text, Text]:
    """Return a mapping of coordinates to single values, as texts. Raises BadValueError for another node."""
    return {key: check_text_node(value, f"{address}.{key}", key, "one value") for key, value in node.list_entries()}


def _read_compared_selection(node: Map, key: str, address: str, base_selection: Selection) -> Selection:
    """Return the selection at a key, {part: …, c: 0.3 mm}, merged over the selection `base_selection` of the trend.

    Raises an InputError.
    """
    selection_node = check_mapping_node(node[key], f"{address}.{key}", node.find_key(key))
    values = _read_coordinate_values(selection_node, f"{address}.{key}")
    part = next((value for name, value in values.items() if name == "part"), base_selection.part)
    inherited_values = {name: value for name, value in base_selection.at.items() if name not in values}
    return Selection(
        part, inherited_values | {name: value for name, value in values.items() if name != "part"}, node.find_key(key)
    )


def _read_trend_claim(name: Text, node: Map) -> TrendClaim:
    """Return a claim about a trend, with its statements or the reason why it is not computed. Raises an InputError."""
    address = f"claims.trends.{name}"
    check_label_of_entry(name, "claim")
    figure, says, note, heading = (read_line(node, key, address) for key in ("figure", "says", "note", "heading"))
    if unknown_keys := [key for key in node.list_keys() if key not in TREND_KEYS]:
        raise make_unknown_key_error(unknown_keys[0], TREND_KEYS, address)
    reason = read_line(node, "not_computed", address)
    statement_node = Map.make_map(
        [(key, value) for key, value in node.list_entries() if key not in DESCRIPTIVE_KEYS], node.where
    )
    if reason:
        if extra_keys := [key for key in statement_node.list_keys() if key != "not_computed"]:
            raise BadValueError(
                f"{address} has both not_computed and {extra_keys[0]}", extra_keys[0].where, "expected one of the two"
            )
        return TrendClaim(name, figure, says, (), reason, note, heading)
    return TrendClaim(
        name, figure, says, tuple(_read_trend_statements(name, statement_node, address)), "", note, heading
    )


def _read_trend_statements(name: Text, node: Map, address: str) -> list[TrendStatement]:
    """Return the statements of a trend: one, or each element of the list `all`, which inherits the keys next to `all`.

    Raises an InputError for an unknown key or an empty list.
    """
    if "all" not in node:
        return [_read_trend_statement(name, node, address)]
    statement_nodes = node["all"]
    if not isinstance(statement_nodes, Items) or not statement_nodes:
        raise BadValueError(
            f"{address}.all is {describe_node(statement_nodes)}",
            node.find_key("all").where,
            "expected a list of trials",
        )
    statements = []
    for k, node_in_list in enumerate(statement_nodes):
        statement_node = check_mapping_node(node_in_list, f"{address}.all[{k}]", node.find_key("all"))
        if unknown_keys := [key for key in statement_node.list_keys() if key not in STATEMENT_KEYS]:
            raise make_unknown_key_error(unknown_keys[0], STATEMENT_KEYS, f"{address}.all[{k}]")
        inherited_entries = [
            (key, value) for key, value in node.list_entries() if key != "all" and key not in statement_node
        ]
        statements.append(
            _read_trend_statement(
                name,
                Map.make_map([*inherited_entries, *statement_node.list_entries()], statement_node.where),
                f"{address}.all[{k}]",
            )
        )
    return statements


def _read_trend_statement(name: Text, node: Map, address: str) -> TrendStatement:
    """Return one statement of a trend, such as {grows_along: c, measure: peak}. Raises an InputError.

    Exactly one key of KINDS is its kind; the value of that key is a dimension, measure, number or selection. The value
    of `by` or `within` is a factor or a tolerance.
    """
    selected = [key for key in node.list_keys() if key in KINDS]
    if len(selected) != 1:
        message = (
            f"{address} has {'nothing to judge it by' if not selected else f'both {selected[0]} and {selected[1]}'}"
        )
        hint = f"expected one of: {', '.join((*KINDS, 'all', 'not_computed'))}"
        raise BadValueError(message, find_node_location(node, name), hint)
    kind, known_keys = selected[0], (selected[0], *SELECTION_KEYS, *FURTHER_KEYS_OF_KIND.get(selected[0], ()))
    if unknown_keys := [key for key in node.list_keys() if key not in known_keys]:
        raise make_unknown_key_error(unknown_keys[0], known_keys, address)
    if (required_key := REQUIRED_KEY_OF_KIND.get(kind)) and required_key not in node:
        raise make_missing_key_error(required_key, node.where, address)
    base_selection = _read_selection(node, address, kind)
    if kind == COUNTS:
        counts = _read_expected_counts(check_mapping_node(node[kind], f"{address}.{kind}", kind), f"{address}.{kind}")
        return TrendStatement(kind, (), base_selection, kind, counts=counts)
    if "measure" not in node:
        raise make_missing_key_error("measure", node.where, address)
    measures = check_texts(node["measure"], f"{address}.measure", node.find_key("measure"), "names of measures")
    factor_or_tolerance = next(
        (
            check_text_node(node[key], f"{address}.{key}", node.find_key(key), "a number")
            for key in ("by", "within")
            if key in node
        ),
        None,
    )
    if kind in SELECTION_COMPARISONS:
        return _read_comparison(node, address, kind, measures, base_selection, factor_or_tolerance)
    comparison_text = check_text_node(
        node[kind],
        f"{address}.{kind}",
        kind,
        "a dimension" if kind in TRENDS_ALONG_DIMENSION else "a measure or a number",
    )
    other_measures = (
        check_texts(node["more_than"], f"{address}.more_than", node.find_key("more_than"), "measures")
        if "more_than" in node
        else (comparison_text,)
        if kind in MEASURE_COMPARISONS
        else ()
    )
    if kind == "spreads_along" and len(other_measures) != len(measures):
        raise BadValueError(
            f"{address}.more_than has {format_count(len(other_measures), 'name')}",
            node.find_key("more_than").where,
            f"expected as many as measure: {len(measures)}",
        )
    return TrendStatement(kind, measures, base_selection, comparison_text, None, other_measures, factor_or_tolerance)


def _read_comparison(
    node: Map, address: str, kind: Text, measures: tuple[Text, ...], base_selection: Selection, factor: Text | None
) -> TrendStatement:
    """Return a statement that compares two selections of runs; `kind` is "larger" or "most_lowered".

    `base_selection` is the selection of the trend, `factor` the value of `by` or None. Raises an InputError if a
    selection is missing.
    """
    if kind == "larger":
        return TrendStatement(
            kind,
            measures,
            _read_compared_selection(node, kind, address, base_selection),
            kind,
            _read_compared_selection(node, "than", address, base_selection),
            (),
            factor,
        )
    if missing_keys := [key for key in ("from", "to") if key not in node]:
        raise make_missing_key_error(missing_keys[0], node.where, address)
    other_measures = check_texts(node[kind], f"{address}.{kind}", kind, "other measures, which are lowered less")
    return TrendStatement(
        kind,
        measures,
        _read_compared_selection(node, "from", address, base_selection),
        kind,
        _read_compared_selection(node, "to", address, base_selection),
        other_measures,
    )


def _read_expected_counts(node: Map, address: str) -> dict[Text, int]:
    """Return the expected counts of bodies, joints and others in a scene, by key.

    Raises an InputError for an unknown key.
    """
    if unknown_keys := [key for key in node.list_keys() if key not in COUNTED_PARTS]:
        raise make_unknown_key_error(unknown_keys[0], COUNTED_PARTS, address)
    return {key: check_integer_node(value, f"{address}.{key}", key, 0) for key, value in node.list_entries()}
