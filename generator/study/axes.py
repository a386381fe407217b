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
    """Return the numbers that all runs share, and the dimensions of `parameters:` and `zip:`."""
    fixed, axes = dict[Text, Text](), list[Axis]()
    for key, node in _section_entries(reader, root, "parameters"):
        with reader.collect():
            if isinstance(node, Text):
                fixed[key] = text(node, f"parameters.{key}", key, _VALUES)
            else:
                name = dimension_name(key, "parameter")
                axes.append(Axis(name, key.where, {key: _read_numbers(reader, node, f"parameters.{key}", key)}))
    for name, group in _section_entries(reader, root, "zip"):
        with reader.collect():
            axes.append(_read_zip(reader, name, mapping(group, f"zip.{name}", name)))
    return fixed, axes


def _section_entries(reader: Reader, root: Map, section: str) -> Iterator[tuple[Text, Any]]:
    """Yield name and node of each entry of a section; nothing if the section is empty."""
    with reader.collect():
        if section in root and not (isinstance(root[section], Text) and root[section].is_nothing):
            yield from mapping(root[section], section, root.key(section)).pairs()


def _read_numbers(reader: Reader, node: Any, owner: str, key: Text) -> Numbers:
    """Read the values of a parameter: a list, or a range from … to … with a count."""
    if not isinstance(node, Map):
        return Numbers(texts(node, owner, key, _VALUES))
    if not check_keys(reader, node, _RANGE, owner, _RANGE[:3]):
        return Numbers(())
    ends = tuple(text(node[name], f"{owner}.{name}", node.key(name), "a number") for name in ("from", "to"))
    count = whole(node["count"], f"{owner}.count", node.key("count"), 2)
    return Numbers(ends, count, _read_spacing(node, owner))


def _read_spacing(node: Map, owner: str) -> str:
    """Return the spacing of a range, linear by default."""
    if "spacing" not in node:
        return LINEAR
    return word(node["spacing"], f"{owner}.spacing", node.key("spacing"), (LINEAR, GEOMETRIC))


def _read_zip(reader: Reader, name: Text, group: Map) -> Axis:
    """Read an entry of `zip`: parameters that vary together, all with the same number of values."""
    called = label(name, "zip") if name == "run" else dimension_name(name, "zip")
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
    return Axis(called, name.where, columns, grouped=True)


def read_draw(reader: Reader, root: Map) -> Draw | None:
    """Read `draw:`, random points in parameter space; None if the file has none."""
    if "draw" not in root:
        return None
    with reader.collect():
        node = mapping(root["draw"], "draw", root.key("draw"))
        known = ("count", "seed", "method", "parameters")
        if check_keys(reader, node, known, "draw", ("count", "parameters")):
            drawn = mapping(node["parameters"], "draw.parameters", node.key("parameters"))
            if not drawn:
                raise BadValueError("draw.parameters is empty", drawn.where, "expected {c: {mean: …, std: …}}")
            count = whole(node["count"], "draw.count", node.key("count"))
            method = word(node["method"], "draw.method", node.key("method"), DRAWN) if "method" in node else DRAWN[0]
            for key in drawn.names():
                dimension_name(key, "parameter")
            numbers = {key: _read_spread(reader, key, below) for key, below in drawn.pairs()}
            return Draw(count, seed(node, "draw"), method, numbers, tuple(map(str, numbers)))
    return None


def _read_spread(reader: Reader, key: Text, found: Any) -> Spread:
    """Read the distribution of a drawn parameter: normal, uniform or geometric."""
    owner = f"draw.parameters.{key}"
    node = mapping(found, owner, key)
    normal = "mean" in node or "std" in node
    needed, known = (("mean", "std"), ("mean", "std")) if normal else (("from", "to"), _SPREAD[2:])
    if normal and (strange := next((name for name in node.names() if name in _SPREAD[2:]), None)):
        message = f"{owner} has both a mean and {strange}"
        raise UnknownKeyError(message, strange.where, "expected mean and std (normal), or from and to (uniform)")
    if not node:
        raise BadValueError(f"{owner} is empty", node.where, "expected mean and std, or from and to")
    if not check_keys(reader, node, known, owner, needed):
        return Spread(NORMAL, (key, key))
    first, second = (text(node[name], f"{owner}.{name}", node.key(name), "a number") for name in needed)
    kind = NORMAL if normal else GEOMETRIC if _read_spacing(node, owner) == GEOMETRIC else UNIFORM
    return Spread(kind, (first, second))


def read_starts(reader: Reader, root: Map) -> Starts | None:
    """Read `starts:`, perturbed starts of each run; None if the file has none."""
    if "starts" not in root:
        return None
    with reader.collect():
        node = mapping(root["starts"], "starts", root.key("starts"))
        if not check_keys(reader, node, _STARTS, "starts", ("count",)):
            return None
        named, alone = "ensembles" in node, [key for key in node.names() if key in ("relative", "absolute")]
        if named and alone:
            message = f"starts has both ensembles and {alone[0]}"
            raise UnknownKeyError(message, alone[0].where, "write it into an ensemble of its own")
        ensembles = (
            _read_ensembles(reader, node) if named else {ENSEMBLE: _read_deviations(reader, node, "starts", _STARTS)}
        )
        kinds, key = (UNIFORM, NORMAL), "distribution"
        kind = word(node[key], f"starts.{key}", node.key(key), kinds) if key in node else UNIFORM
        count = whole(node["count"], "starts.count", node.key("count"))
        return Starts(count, seed(node, "starts"), kind, ensembles, named)
    return None


def _read_ensembles(reader: Reader, node: Map) -> dict[str, Mapping[Text, Deviation]]:
    """Read the named ensembles of perturbed starts, each with its deviations by parameter."""
    found = {}
    for name, below in mapping(node["ensembles"], "starts.ensembles", node.key("ensembles")).pairs():
        owner = f"starts.ensembles.{name}"
        found[label(name, "ensemble")] = _read_deviations(reader, mapping(below, owner, name), owner, _STARTS[3:5])
    if not found:
        raise BadValueError("starts.ensembles is empty", node.key("ensembles").where, "expected {near: {relative: …}}")
    return found


def _read_deviations(reader: Reader, node: Map, owner: str, known: tuple[str, ...]) -> Mapping[Text, Deviation]:
    """Read relative and absolute deviations by parameter. Raises BadValueError if there are none."""
    check_keys(reader, node, known, owner)
    found: dict[Text, Deviation] = {}
    for kind in ("relative", "absolute"):
        if kind in node:
            for key, size in mapping(node[kind], f"{owner}.{kind}", node.key(kind)).pairs():
                if key in found:
                    message = f"{owner}: the size of {key} is relative and absolute"
                    raise BadValueError(message, key.where, "expected one of both")
                found[key] = Deviation(kind == "relative", text(size, f"{owner}.{kind}.{key}", key, "a size"))
    if not found:
        hint = "expected relative: {omega: 1e-6}, or absolute: {c: 1 um}: the size decides, so it is yours to say"
        raise BadValueError(f"{owner} does not say what is off, and by how much", node.where, hint)
    return found


def read_choices(reader: Reader, root: Map) -> list[Choice]:
    """Read `choices:`, dimensions of structure: an address with its values, or named options of several overrides."""
    found = []
    for key, node in _section_entries(reader, root, "choices"):
        with reader.collect():
            if isinstance(node, (Text, Items)):
                values = texts(node, f"choices.{key}", key, "a list of what may stand there")
                found.append(Choice(str(key), key.where, {str(value): {str(key): value} for value in values}))
                if len(set(values)) < len(values):
                    raise BadValueError(f"choices.{key} has a value twice", key.where, "expected each once")
                continue
            options = {}
            for name, below in mapping(node, f"choices.{key}", key).pairs():
                own = mapping(below, f"choices.{key}.{name}", name)
                options[label(name, "option")] = {
                    str(address): text(value, f"choices.{key}.{name}.{address}", address)
                    for address, value in own.pairs()
                }
            if not options:
                raise BadValueError(f"choices.{key} is empty", key.where, "expected options with their overrides")
            found.append(Choice(dimension_name(key, "choice"), key.where, options))
    return found
