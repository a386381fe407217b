"""Reads the dimensions of a study: parameters and zips, random draws, perturbed starts, choices of structure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gudgeon.errors import BadValueError, UnknownKeyError
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import check_keys, dimension_name, label, mapping, seed, text, texts, whole, word
from gudgeon.generator.study.spec import (
    DRAWN,
    GEOMETRIC,
    LINEAR,
    NORMAL,
    UNIFORM,
    Axis,
    Choice,
    Deviation,
    Draw,
    Numbers,
    Spread,
    Starts,
)
from gudgeon.generator.yaml import Items, Map, Text

_VALUES = "a number, a list of numbers, or {from: …, to: …, count: …}"
_RANGE = ("from", "to", "count", "spacing")
_SPREAD = ("mean", "std", "from", "to", "spacing")
_STARTS = ("count", "seed", "distribution", "relative", "absolute", "ensembles")
ENSEMBLE = "all"  # name of the ensemble if the file names none


def read_parameters(reader: Reader, root: Map) -> tuple[dict[Text, Text], list[Axis]]:
    """Return the numbers that all runs share, and the dimensions of `parameters:` and `zip:`.

    A single value is shared by all runs; a list or range is a dimension. Errors are collected.
    """
    shared_values, axes = dict[Text, Text](), list[Axis]()
    for key, node in _iterate_section_entries(reader, root, "parameters"):
        with reader.collect():
            if isinstance(node, Text):
                shared_values[key] = text(node, f"parameters.{key}", key, _VALUES)
            else:
                name = dimension_name(key, "parameter")
                axes.append(Axis(name, key.where, {key: _read_numbers(reader, node, f"parameters.{key}", key)}))
    for name, group in _iterate_section_entries(reader, root, "zip"):
        with reader.collect():
            axes.append(_read_zip(reader, name, mapping(group, f"zip.{name}", name)))
    return shared_values, axes


def _iterate_section_entries(reader: Reader, root: Map, section: str) -> Iterator[tuple[Text, Any]]:
    """Yield name and node of each entry of a section; nothing if the section is missing or empty.

    An error is collected if the section is not a mapping, or if the caller's block raises.
    """
    with reader.collect():
        if section in root and not (isinstance(root[section], Text) and root[section].is_nothing):
            yield from mapping(root[section], section, root.key(section)).pairs()


def _read_numbers(reader: Reader, node: Any, address: str, key: Text) -> Numbers:
    """Return the values of a parameter: a list, or a range from … to … with a count and a spacing.

    No values are returned if a key is missing, whose error is collected. Raises BadValueError for another node.
    """
    if not isinstance(node, Map):
        return Numbers(texts(node, address, key, _VALUES))
    if not check_keys(reader, node, _RANGE, address, _RANGE[:3]):
        return Numbers(())
    end_values = tuple(text(node[name], f"{address}.{name}", node.key(name), "a number") for name in ("from", "to"))
    count = whole(node["count"], f"{address}.count", node.key("count"), 2)
    return Numbers(end_values, count, _read_spacing(node, address))


def _read_spacing(node: Map, address: str) -> str:
    """Return the spacing of a range, linear by default. Raises BadValueError for an unknown word."""
    if "spacing" not in node:
        return LINEAR
    return word(node["spacing"], f"{address}.spacing", node.key("spacing"), (LINEAR, GEOMETRIC))


def _read_zip(reader: Reader, name: Text, group: Map) -> Axis:
    """Return the dimension of an entry of `zip`: parameters that vary together, all with the same number of values.

    Raises BadValueError for lists of different lengths and an empty entry, BadNameError for a reserved name.
    """
    dimension = label(name, "zip") if name == "run" else dimension_name(name, "zip")
    columns = {key: _read_numbers(reader, node, f"zip.{name}.{key}", key) for key, node in group.pairs()}
    lengths = {key: numbers.count or len(numbers.texts) for key, numbers in columns.items()}
    if len(set(lengths.values())) > 1 and 0 not in lengths.values():
        lengths_text = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise BadValueError(
            f"zip.{name}: lists of different lengths: {lengths_text}", name.where, "as many values in each"
        )
    if not columns:
        raise BadValueError(f"zip.{name} is empty", name.where, "expected numbers with lists: {c: […], omega: […]}")
    for key in columns:
        dimension_name(key, "parameter")
    return Axis(dimension, name.where, columns, grouped=True)


def read_draw(reader: Reader, root: Map) -> Draw | None:
    """Return `draw:`, random points in parameter space; None if the file has none or it is wrong.

    Errors are collected.
    """
    if "draw" not in root:
        return None
    with reader.collect():
        node = mapping(root["draw"], "draw", root.key("draw"))
        known_keys = ("count", "seed", "method", "parameters")
        if check_keys(reader, node, known_keys, "draw", ("count", "parameters")):
            parameters = mapping(node["parameters"], "draw.parameters", node.key("parameters"))
            if not parameters:
                raise BadValueError("draw.parameters is empty", parameters.where, "expected {c: {mean: …, std: …}}")
            count = whole(node["count"], "draw.count", node.key("count"))
            method = word(node["method"], "draw.method", node.key("method"), DRAWN) if "method" in node else DRAWN[0]
            for key in parameters.names():
                dimension_name(key, "parameter")
            distributions = {key: _read_distribution(reader, key, value) for key, value in parameters.pairs()}
            return Draw(count, seed(node, "draw"), method, distributions, tuple(map(str, distributions)))
    return None


def _read_distribution(reader: Reader, key: Text, value: Any) -> Spread:
    """Return the distribution of a drawn parameter: normal, uniform or geometric.

    A placeholder is returned if a key is missing, whose error is collected. Raises an InputError for contradicting
    keys.
    """
    address = f"draw.parameters.{key}"
    node = mapping(value, address, key)
    is_normal = "mean" in node or "std" in node
    required_keys, known_keys = (("mean", "std"), ("mean", "std")) if is_normal else (("from", "to"), _SPREAD[2:])
    if is_normal and (extra_key := next((name for name in node.names() if name in _SPREAD[2:]), None)):
        message = f"{address} has both a mean and {extra_key}"
        raise UnknownKeyError(message, extra_key.where, "expected mean and std (normal), or from and to (uniform)")
    if not node:
        raise BadValueError(f"{address} is empty", node.where, "expected mean and std, or from and to")
    if not check_keys(reader, node, known_keys, address, required_keys):
        return Spread(NORMAL, (key, key))
    first_value, second_value = (
        text(node[name], f"{address}.{name}", node.key(name), "a number") for name in required_keys
    )
    kind = NORMAL if is_normal else GEOMETRIC if _read_spacing(node, address) == GEOMETRIC else UNIFORM
    return Spread(kind, (first_value, second_value))


def read_starts(reader: Reader, root: Map) -> Starts | None:
    """Return `starts:`, perturbed starts of each run; None if the file has none or it is wrong. Errors are collected.

    Deviations without named ensembles form one ensemble, ENSEMBLE.
    """
    if "starts" not in root:
        return None
    with reader.collect():
        node = mapping(root["starts"], "starts", root.key("starts"))
        if not check_keys(reader, node, _STARTS, "starts", ("count",)):
            return None
        has_ensembles, deviation_keys = (
            "ensembles" in node,
            [key for key in node.names() if key in ("relative", "absolute")],
        )
        if has_ensembles and deviation_keys:
            message = f"starts has both ensembles and {deviation_keys[0]}"
            raise UnknownKeyError(message, deviation_keys[0].where, "write it into an ensemble of its own")
        ensembles = (
            _read_ensembles(reader, node)
            if has_ensembles
            else {ENSEMBLE: _read_deviations(reader, node, "starts", _STARTS)}
        )
        distributions, key = (UNIFORM, NORMAL), "distribution"
        kind = word(node[key], f"starts.{key}", node.key(key), distributions) if key in node else UNIFORM
        count = whole(node["count"], "starts.count", node.key("count"))
        return Starts(count, seed(node, "starts"), kind, ensembles, has_ensembles)
    return None


def _read_ensembles(reader: Reader, node: Map) -> dict[str, Mapping[Text, Deviation]]:
    """Return the named ensembles of perturbed starts, each with its deviations by parameter. Raises an InputError."""
    ensembles = {}
    for name, value in mapping(node["ensembles"], "starts.ensembles", node.key("ensembles")).pairs():
        address = f"starts.ensembles.{name}"
        ensembles[label(name, "ensemble")] = _read_deviations(
            reader, mapping(value, address, name), address, _STARTS[3:5]
        )
    if not ensembles:
        raise BadValueError("starts.ensembles is empty", node.key("ensembles").where, "expected {near: {relative: …}}")
    return ensembles


def _read_deviations(reader: Reader, node: Map, address: str, known_keys: tuple[str, ...]) -> Mapping[Text, Deviation]:
    """Return relative and absolute deviations by parameter.

    Raises BadValueError if there are none or a parameter has both. Errors of unknown keys, those not in `known_keys`,
    are collected.
    """
    check_keys(reader, node, known_keys, address)
    deviations: dict[Text, Deviation] = {}
    for kind in ("relative", "absolute"):
        if kind in node:
            for key, size in mapping(node[kind], f"{address}.{kind}", node.key(kind)).pairs():
                if key in deviations:
                    message = f"{address}: the size of {key} is relative and absolute"
                    raise BadValueError(message, key.where, "expected one of both")
                deviations[key] = Deviation(kind == "relative", text(size, f"{address}.{kind}.{key}", key, "a size"))
    if not deviations:
        hint = "expected relative: {omega: 1e-6}, or absolute: {c: 1 um}: the size decides, so it is yours to say"
        raise BadValueError(f"{address} does not say what is off, and by how much", node.where, hint)
    return deviations


def read_choices(reader: Reader, root: Map) -> list[Choice]:
    """Return `choices:`, dimensions of structure: an address with its values, or named options of several overrides.

    Errors are collected; wrong choices are left out.
    """
    choices = []
    for key, node in _iterate_section_entries(reader, root, "choices"):
        with reader.collect():
            if isinstance(node, (Text, Items)):
                values = texts(node, f"choices.{key}", key, "a list of what may stand there")
                choices.append(Choice(str(key), key.where, {str(value): {str(key): value} for value in values}))
                if len(set(values)) < len(values):
                    raise BadValueError(f"choices.{key} has a value twice", key.where, "expected each once")
                continue
            options = {}
            for name, value in mapping(node, f"choices.{key}", key).pairs():
                overrides = mapping(value, f"choices.{key}.{name}", name)
                options[label(name, "option")] = {
                    str(address): text(value, f"choices.{key}.{name}.{address}", address)
                    for address, value in overrides.pairs()
                }
            if not options:
                raise BadValueError(f"choices.{key} is empty", key.where, "expected options with their overrides")
            choices.append(Choice(dimension_name(key, "choice"), key.where, options))
    return choices
