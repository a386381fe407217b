"""Reads what a study varies: parameters, alone or together, random draws, perturbed starts, variants of structure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gudgeon.errors import BadValueError, UnknownKeyError
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import (
    check_dimension_name,
    check_integer_node,
    check_keys,
    check_label_of_entry,
    check_mapping_node,
    check_text_node,
    check_texts,
    check_word,
    read_seed,
)
from gudgeon.generator.study.spec import (
    GEOMETRIC,
    LINEAR,
    NORMAL,
    SAMPLING_METHODS,
    UNIFORM,
    Axis,
    Choice,
    Deviation,
    Distribution,
    Draw,
    ParameterValues,
    Starts,
)
from gudgeon.generator.yaml import Items, Map, Text

_VALUES = "a number, a list of numbers, or {from: …, to: …, count: …}"
_RANGE_KEYS = ("from", "to", "count", "spacing")
_DISTRIBUTION_KEYS = ("mean", "std", "from", "to", "spacing")
_STARTS_KEYS = ("count", "seed", "distribution", "relative", "absolute", "ensembles")
ENSEMBLE = "all"  # name of the ensemble if the file names none


def read_varied_parameters(reader: Reader, root: Map) -> tuple[dict[Text, Text], list[Axis]]:
    """Return the values that all runs share, by address, and the dimensions (Axis) of `parameters:` and `zip:`.

    `parameters: {c: 0.1 mm, omega: [10, 20]}` gives one shared value and one dimension. A range is a dimension too,
    and so is each entry of `zip`. Values are texts of the file. Errors are collected; wrong entries are left out.
    """
    shared_values, axes = dict[Text, Text](), list[Axis]()
    for key, node in _iterate_section_entries(reader, root, "parameters"):
        with reader.collect_errors():
            if isinstance(node, Text):
                shared_values[key] = check_text_node(node, f"parameters.{key}", key, _VALUES)
            else:
                name = check_dimension_name(key, "parameter")
                axes.append(
                    Axis(name, key.where, {key: _read_parameter_values(reader, node, f"parameters.{key}", key)})
                )
    for name, group in _iterate_section_entries(reader, root, "zip"):
        with reader.collect_errors():
            axes.append(_read_zip_entry(reader, name, check_mapping_node(group, f"zip.{name}", name)))
    return shared_values, axes


def _iterate_section_entries(reader: Reader, root: Map, section: str) -> Iterator[tuple[Text, Any]]:
    """Yield name and node of each entry of a section; nothing if the section is missing or empty.

    An error is collected if the section is not a mapping.
    """
    with reader.collect_errors():
        if section in root and not (isinstance(root[section], Text) and root[section].is_null):
            yield from check_mapping_node(root[section], section, root.find_key(section)).list_entries()


def _read_parameter_values(reader: Reader, node: Any, address: str, key: Text) -> ParameterValues:
    """Return the values of a parameter: a list, or a range {from: 1, to: 5, count: 9, spacing: geometric}.

    No values are returned if a key is missing, whose error is collected. Raises BadValueError for another node.
    """
    if not isinstance(node, Map):
        return ParameterValues(check_texts(node, address, key, _VALUES))
    if not check_keys(reader, node, _RANGE_KEYS, address, _RANGE_KEYS[:3]):
        return ParameterValues(())
    end_values = tuple(
        check_text_node(node[name], f"{address}.{name}", node.find_key(name), "a number") for name in ("from", "to")
    )
    count = check_integer_node(node["count"], f"{address}.count", node.find_key("count"), 2)
    return ParameterValues(end_values, count, _read_spacing(node, address))


def _read_spacing(node: Map, address: str) -> str:
    """Return the spacing of a range, LINEAR (by default) or GEOMETRIC. Raises BadValueError for another word."""
    if "spacing" not in node:
        return LINEAR
    return check_word(node["spacing"], f"{address}.spacing", node.find_key("spacing"), (LINEAR, GEOMETRIC))


def _read_zip_entry(reader: Reader, name: Text, group: Map) -> Axis:
    """Return the dimension of an entry of `zip`, such as `pairs: {c: [1 um, 2 um], omega: [10, 20]}`.

    Its parameters vary together, and all must have the same number of values. Raises BadValueError for lists of
    different lengths and an empty entry, BadNameError for a reserved name.
    """
    dimension = check_label_of_entry(name, "zip") if name == "run" else check_dimension_name(name, "zip")
    columns = {
        key: _read_parameter_values(reader, node, f"zip.{name}.{key}", key) for key, node in group.list_entries()
    }
    lengths = {key: numbers.count or len(numbers.texts) for key, numbers in columns.items()}
    if len(set(lengths.values())) > 1 and 0 not in lengths.values():
        lengths_text = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise BadValueError(
            f"zip.{name}: lists of different lengths: {lengths_text}", name.where, "expected lists of equal length"
        )
    if not columns:
        raise BadValueError(f"zip.{name} is empty", name.where, "expected numbers with lists: {c: […], omega: […]}")
    for key in columns:
        check_dimension_name(key, "parameter")
    return Axis(dimension, name.where, columns, grouped=True)


def read_draw(reader: Reader, root: Map) -> Draw | None:
    """Return `draw:`, random points in parameter space, such as {count: 100, parameters: {c: {mean: …, std: …}}}.

    The keys count and parameters are required; the default method is the first of SAMPLING_METHODS. Parameters without
    entries, and names that a dimension cannot have, are errors. Errors are collected. Return None without `draw` or
    after an error.
    """
    if "draw" not in root:
        return None
    with reader.collect_errors():
        node = check_mapping_node(root["draw"], "draw", root.find_key("draw"))
        known_keys = ("count", "seed", "method", "parameters")
        if check_keys(reader, node, known_keys, "draw", ("count", "parameters")):
            parameters = check_mapping_node(node["parameters"], "draw.parameters", node.find_key("parameters"))
            if not parameters:
                raise BadValueError("draw.parameters is empty", parameters.where, "expected {c: {mean: …, std: …}}")
            count = check_integer_node(node["count"], "draw.count", node.find_key("count"))
            method = (
                check_word(node["method"], "draw.method", node.find_key("method"), SAMPLING_METHODS)
                if "method" in node
                else SAMPLING_METHODS[0]
            )
            for key in parameters.list_keys():
                check_dimension_name(key, "parameter")
            distributions = {key: _read_distribution(reader, key, value) for key, value in parameters.list_entries()}
            return Draw(count, read_seed(node, "draw"), method, distributions, tuple(map(str, distributions)))
    return None


def _read_distribution(reader: Reader, key: Text, value: Any) -> Distribution:
    """Return the distribution of a drawn parameter: normal, uniform or geometric.

    Keys mean or std make it normal, with both required; otherwise from and to are required, and `spacing` decides
    between uniform and geometric. If a key is missing, its error is collected and a placeholder is returned. Raises an
    InputError for an empty mapping and for contradicting keys.
    """
    address = f"draw.parameters.{key}"
    node = check_mapping_node(value, address, key)
    is_normal = "mean" in node or "std" in node
    required_keys, known_keys = (
        (("mean", "std"), ("mean", "std")) if is_normal else (("from", "to"), _DISTRIBUTION_KEYS[2:])
    )
    if is_normal and (extra_key := next((name for name in node.list_keys() if name in _DISTRIBUTION_KEYS[2:]), None)):
        message = f"{address} has both a mean and {extra_key}"
        raise UnknownKeyError(message, extra_key.where, "expected mean and std (normal), or from and to (uniform)")
    if not node:
        raise BadValueError(f"{address} is empty", node.where, "expected mean and std, or from and to")
    if not check_keys(reader, node, known_keys, address, required_keys):
        return Distribution(NORMAL, (key, key))
    first_value, second_value = (
        check_text_node(node[name], f"{address}.{name}", node.find_key(name), "a number") for name in required_keys
    )
    kind = NORMAL if is_normal else GEOMETRIC if _read_spacing(node, address) == GEOMETRIC else UNIFORM
    return Distribution(kind, (first_value, second_value))


def read_starts(reader: Reader, root: Map) -> Starts | None:
    """Return `starts:`, perturbed starts of each run, such as {count: 20, relative: {omega: 1e-6}}.

    The key count is required; the default distribution is uniform. Deviations without named ensembles form one
    ensemble, ENSEMBLE; a file with both is wrong. Errors are collected. Return None without `starts` or after an
    error.
    """
    if "starts" not in root:
        return None
    with reader.collect_errors():
        node = check_mapping_node(root["starts"], "starts", root.find_key("starts"))
        if not check_keys(reader, node, _STARTS_KEYS, "starts", ("count",)):
            return None
        has_ensembles, deviation_keys = (
            "ensembles" in node,
            [key for key in node.list_keys() if key in ("relative", "absolute")],
        )
        if has_ensembles and deviation_keys:
            message = f"starts has both ensembles and {deviation_keys[0]}"
            raise UnknownKeyError(message, deviation_keys[0].where, "write it into a separate ensemble")
        ensembles = (
            _read_ensembles(reader, node)
            if has_ensembles
            else {ENSEMBLE: _read_deviations(reader, node, "starts", _STARTS_KEYS)}
        )
        distributions, key = (UNIFORM, NORMAL), "distribution"
        kind = check_word(node[key], f"starts.{key}", node.find_key(key), distributions) if key in node else UNIFORM
        count = check_integer_node(node["count"], "starts.count", node.find_key("count"))
        return Starts(count, read_seed(node, "starts"), kind, ensembles, has_ensembles)
    return None


def _read_ensembles(reader: Reader, node: Map) -> dict[str, Mapping[Text, Deviation]]:
    """Return the named ensembles of perturbed starts, each with its deviations by parameter. Raises an InputError."""
    ensembles = {}
    for name, value in check_mapping_node(
        node["ensembles"], "starts.ensembles", node.find_key("ensembles")
    ).list_entries():
        address = f"starts.ensembles.{name}"
        ensembles[check_label_of_entry(name, "ensemble")] = _read_deviations(
            reader, check_mapping_node(value, address, name), address, _STARTS_KEYS[3:5]
        )
    if not ensembles:
        raise BadValueError(
            "starts.ensembles is empty", node.find_key("ensembles").where, "expected {near: {relative: …}}"
        )
    return ensembles


def _read_deviations(reader: Reader, node: Map, address: str, known_keys: tuple[str, ...]) -> Mapping[Text, Deviation]:
    """Return relative and absolute deviations by parameter, from {relative: {omega: 1e-6}, absolute: {c: 1 um}}.

    Raises BadValueError if there are none or a parameter has both. Errors of unknown keys, those not in `known_keys`,
    are collected.
    """
    check_keys(reader, node, known_keys, address)
    deviations: dict[Text, Deviation] = {}
    for kind in ("relative", "absolute"):
        if kind in node:
            for key, size in check_mapping_node(node[kind], f"{address}.{kind}", node.find_key(kind)).list_entries():
                if key in deviations:
                    message = f"{address}: the size of {key} is both relative and absolute"
                    raise BadValueError(message, key.where, "expected one of the two")
                deviations[key] = Deviation(
                    kind == "relative", check_text_node(size, f"{address}.{kind}.{key}", key, "a size")
                )
    if not deviations:
        hint = (
            "expected relative: {omega: 1e-6}, or absolute: {c: 1 um}: results depend on the size, which has no default"
        )
        raise BadValueError(f"{address} has no deviations", node.where, hint)
    return deviations


def read_choices(reader: Reader, root: Map) -> list[Choice]:
    """Return the dimensions of structure in `choices:`: alternatives, each a set of overrides of the mechanism.

    Two forms: `contact.law: [hertz, johnson]` (an address with its values) and `bearings: {dry: {A.film: null}}`
    (named options, each with several overrides by address). A repeated value, or a mapping without options, is an
    error. Errors are collected; wrong choices are left out.
    """
    choices = []
    for key, node in _iterate_section_entries(reader, root, "choices"):
        with reader.collect_errors():
            if isinstance(node, (Text, Items)):
                values = check_texts(node, f"choices.{key}", key, "a list of alternative values")
                choices.append(Choice(str(key), key.where, {str(value): {str(key): value} for value in values}))
                if len(set(values)) < len(values):
                    raise BadValueError(f"choices.{key} has a value twice", key.where, "expected each value once")
                continue
            options = {}
            for name, value in check_mapping_node(node, f"choices.{key}", key).list_entries():
                overrides = check_mapping_node(value, f"choices.{key}.{name}", name)
                options[check_label_of_entry(name, "option")] = {
                    str(address): check_text_node(value, f"choices.{key}.{name}.{address}", address)
                    for address, value in overrides.list_entries()
                }
            if not options:
                raise BadValueError(f"choices.{key} is empty", key.where, "expected options with their overrides")
            choices.append(Choice(check_dimension_name(key, "choice"), key.where, options))
    return choices
