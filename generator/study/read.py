"""Reads a study file, or a mapping in Python, into a StudyFile; all errors are reported at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gudgeon.contract.methods import KINEMATIC, OFFERED
from gudgeon.errors import BadNameError, BadValueError, Location, MissingKeyError
from gudgeon.generator.format.sections import FORMAT as MECHANISM
from gudgeon.generator.format.shapes import missing_key, unknown_key
from gudgeon.generator.reader.collector import Reader, TooManyErrors
from gudgeon.generator.study.axes import read_choices, read_draw, read_parameters, read_starts
from gudgeon.generator.study.claims import read_claims
from gudgeon.generator.study.parts import (
    check_keys,
    label,
    mapping,
    read_about,
    read_titles,
    read_wear,
    text,
    texts,
    word,
    written,
)
from gudgeon.generator.study.settings import apply_settings, plain_texts, short_name, tree_of
from gudgeon.generator.study.spec import (
    CONTACTS,
    CROSSINGS,
    DEVIATIONS,
    FOLLOWED,
    FORMAT,
    RESERVED,
    SAMPLES,
    STATISTICS,
    STEPS,
    Claims,
    Measure,
    StudyFile,
    StudySet,
    Window,
    Written,
)
from gudgeon.generator.yaml import Map, Text, kind_of, parse_yaml
from gudgeon.language.names import unknown_name

_SET = "value of "  # prefix of locations of values from the command line


def check_names(reader: Reader, study: StudyFile, root: Map) -> None:
    """Collect an error for each name of the dataset that is reserved or used twice."""
    numbers = [*study.fixed, *(key for axis in study.axes for key in axis.columns)]
    numbers += list(study.draw.numbers) if study.draw else []
    seen: dict[str, Text] = {}
    for key in numbers:
        called = short_name(str(key))
        if called in seen:
            with reader.collect():
                message = f"{str(key)[:60]!r} is said twice"
                raise BadNameError(message, key.where, f"expected once; the first is at {seen[called].where}")
        seen.setdefault(called, key)
    twice = set(_check_choices(reader, study, seen))
    groups = [Text.make(axis.name, axis.where) for axis in study.axes if axis.grouped]
    used = {str(key): ("a number of the runs", key) for key in numbers}
    for what, key in _dataset_names(study, root, groups):
        own = key in RESERVED and not (key == "run" and key in groups)
        if (key in used or own) and key not in twice:
            with reader.collect():
                by, first = (
                    (used[key][0], f"the first is at {_location_text(used[key][1].where)}") if key in used else ("", "")
                )
                message = f"the name {str(key)[:60]!r} is taken, by {by or 'the dataset itself'}"
                raise BadNameError(message, key.where, f"take another one{first and ': '}{first}")
        used.setdefault(str(key), (what, key))


def _dataset_names(study: StudyFile, root: Map, groups: list[Text]) -> Iterator[tuple[str, Text]]:
    """Yield (what it is, name) for the dataset's names that are not parameters."""
    yield from (("numbers that go together", key) for key in groups)
    yield from (("a choice", Text.make(choice.name, choice.where)) for choice in study.choices)
    if isinstance(root.get("measures"), Map):
        yield from (("a measure", key) for key in root.part("measures").names())
    yield from (("a series that is kept", key) for key in study.keep)


def _check_choices(reader: Reader, study: StudyFile, given: dict[str, Text]) -> Iterator[str]:
    """Yield the names of choices that change a parameter which all runs are given; an error is collected for each."""
    for choice in study.choices:
        apply_settings = (short_name(address) for own in choice.options.values() for address in own)
        both = next((key for key in apply_settings if key in given), None)
        if both is None:
            continue
        yield choice.name
        first = given[both].where
        with reader.collect():
            gives = _location_text(first) if first.file.startswith(_SET) else f"a number, at {first},"
            what = f"choices: {both}" if choice.name == both else f"choices: {choice.name}, by {both},"
            message = f"{what[:120]} varies what {gives[:120]} gives to all runs"
            raise BadNameError(
                message, choice.where, "leave one of the two out: what is set for all runs does not vary"
            )


def _location_text(where: Location) -> str:
    """Return where a name was used first: a location in a file, or an argument of the command line."""
    return where.file.removeprefix(_SET) if where.file.startswith(_SET) else str(where)


KEYS = (
    "format",
    "title",
    "mechanism",
    "scenes",
    "choices",
    "parameters",
    "zip",
    "draw",
    "starts",
    "t_end",
    "output",
    "step",
    "method",
    "rtol",
    "stop",
    "wear",
    "windows",
    "measures",
    "keep",
    "parts",
    "claims",
    "titles",
    "about",
)
WHOLE = ("format", "parts", "claims", "titles", "about")  # keys of a file, which its parts do not have
PART = tuple(key for key in KEYS if key not in WHOLE)
ALONE = ""  # name of the only part of a file without parts
AUTO, MAX_TITLE = "auto", 200
WINDOWED = (*SAMPLES, DEVIATIONS[0], *CONTACTS, *CROSSINGS, *FOLLOWED)
OF_SERIES = (*SAMPLES, *STEPS, *DEVIATIONS)  # statistics that can subtract the series of another scene


def read_study(data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None) -> StudyFile:
    """Read a study file without parts; arguments and errors as `read_studies`."""
    return read_studies(data, file, settings).parts[ALONE]


def read_studies(
    data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None
) -> StudySet:
    """Read the studies of a file from its bytes or a mapping; `settings` are values for all runs that override it.

    Raises an InputError at file:line:column, or InputErrors with all errors.
    """
    reader = Reader(file)
    root = parse_yaml(data, file, reader.errors, FORMAT) if isinstance(data, bytes) else tree_of(data)
    if not isinstance(root, Map):
        raise BadValueError(f"the study is {kind_of(root)}", hint="expected a mapping")
    claims, titles, about = Claims(), dict[str, str](), tuple[str, ...]()
    try:
        _check_format(root, isinstance(data, bytes))
        found = {
            name: _read_part(reader, node, file, settings or {}, owner)
            for name, owner, node in _split_parts(reader, root)
        }
        claims, titles = read_claims(reader, root), read_titles(reader, root, found)
        about = read_about(reader, root)
    except TooManyErrors:
        found = {}
    reader.errors = list(
        {str(error): error for error in reader.errors}.values()
    )  # parts repeat the errors of shared keys
    reader.raise_errors()
    parts = {name: part for name, part in found.items() if part is not None}
    title = str(root["title"]) if "title" in root else ""
    return StudySet(file, title, parts, "parts" in root, claims, titles, about)


def _split_parts(reader: Reader, root: Map) -> Iterator[tuple[str, str, Map]]:
    """Yield name, owner for messages, and keys of each part; keys of a part override those of the file."""
    if "parts" not in root:
        yield ALONE, "the study", root
        return
    common = [(key, node) for key, node in root.pairs() if key not in WHOLE]
    strange = [key for key, _ in common if key not in PART]
    reader.errors.extend(unknown_key(key, KEYS, "the study") for key in strange)
    with reader.collect():
        every = mapping(root["parts"], "parts", root.key("parts"))
        if not every:
            raise BadValueError("parts is empty", root.key("parts").where, "expected {clearance: {…}, material: {…}}")
        for name, node in every.pairs():
            with reader.collect():
                own = mapping(node, f"parts.{name}", name)
                kept = [(key, below) for key, below in common if key not in own and key not in strange]
                yield label(name, "part"), f"parts.{name}", Map.make([*kept, *own.pairs()], own.where)


def _check_format(root: Map, needed: bool) -> None:
    """Raise an InputError unless the format is that of study files."""
    if "format" not in root:
        if needed:
            raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    elif root["format"] != FORMAT:
        is_mechanism = root["format"] == MECHANISM
        more = "; this file is a mechanism, which `gudgeon run FILE` runs" if is_mechanism else ""
        message = f"format is {kind_of(root['format'])}"
        raise BadValueError(message, root.key("format").where, f"expected {FORMAT}{more}")


def _read_part(reader: Reader, root: Map, file: str, settings: Mapping[str, str], owner: str) -> StudyFile | None:
    """Read one study, or one part of a file with several; None if a needed key is missing."""
    if not check_keys(reader, root, KEYS if owner == "the study" else PART, owner, ("mechanism",)):
        return None
    numbers = apply_settings(*read_parameters(reader, root), read_draw(reader, root), settings)
    starts, choices = read_starts(reader, root), read_choices(reader, root)
    title = mechanism = Text.make("", root.where)
    one, scenes = True, (*[Text.make("ideal", root.where)],)
    with reader.collect():
        mechanism = text(root["mechanism"], "mechanism", root.key("mechanism"), "a file beside this one, or a name")
    with reader.collect():
        title = text(root["title"], "title", root.key("title"), "a line") if "title" in root else title
        if len(title) > MAX_TITLE or not title.isprintable():
            hint = f"expected one line of at most {MAX_TITLE} characters that can be seen"
            raise BadValueError(f"the title has {len(title)} characters", title.where, hint)
    with reader.collect():
        if "scenes" in root:
            scenes = _check_once(texts(root["scenes"], "scenes", root.key("scenes"), "names of scenes"), "scene")
            one = isinstance(root["scenes"], Text)
    times = {name: _read_expression(reader, root, name) for name in ("t_end", "output", "step")}
    windows = _read_windows(reader, root)
    measures, keep = _read_measures(reader, root, windows), _read_keep(reader, root)
    with reader.collect():
        if not (root.get("measures") or root.get("keep")):
            hint = "expected measures: {peak: {peak: slider.ax}}, or keep: [slider.x]"
            raise MissingKeyError(f"{owner} measures nothing and keeps nothing", root.where, hint)
    found = StudyFile(
        file,
        str(title),
        mechanism,
        scenes,
        one,
        tuple(choices),
        numbers.fixed,
        numbers.axes,
        numbers.draw,
        starts,
        times["t_end"],
        times["output"],
        times["step"],
        windows,
        measures,
        keep,
        _read_method(reader, root),
        _read_rtol(reader, root),
        _read_stop(reader, root),
        _result_settings(root) | {"settings": dict(sorted(settings.items()))},
        read_wear(reader, root),
        numbers.left_out,
    )
    check_names(reader, found, root)
    return found


def _result_settings(root: Map) -> dict[str, Any]:
    """Return the tree as plain texts without the keys that do not affect the results."""
    return {key: specified for key, specified in plain_texts(root).items() if key not in ("claims", "titles", "about")}


def _check_once(names: tuple[Text, ...], what: str) -> tuple[Text, ...]:
    """Return the names if each occurs once. Raises BadNameError."""
    for k, name in enumerate(names):
        if name in names[:k]:
            raise BadNameError(f"the {what} {str(name)[:60]!r} is given twice", name.where, "expected each once")
    return names


def _read_expression(reader: Reader, root: Map, name: str) -> Written | None:
    """Read the expression at a key; None if it is missing or wrong."""
    with reader.collect():
        return written(root[name], name, root.key(name)) if name in root else None
    return None


def _read_method(reader: Reader, root: Map) -> Text:
    """Read the integration method, `auto` by default."""
    with reader.collect():
        if "method" in root:
            name = word(root["method"], "method", root.key("method"), (*OFFERED, KINEMATIC))
            return Text.make(name, root["method"].where)
    return Text.make(AUTO, root.where)


def _read_rtol(reader: Reader, root: Map) -> Text | None:
    """Read the tolerance; None if it is not given."""
    with reader.collect():
        return text(root["rtol"], "rtol", root.key("rtol"), "a tolerance: 1e-8") if "rtol" in root else None
    return None


def _read_stop(reader: Reader, root: Map) -> bool:
    """Read whether runs stop at events, true by default."""
    with reader.collect():
        return "stop" not in root or word(root["stop"], "stop", root.key("stop"), ("true", "false")) == "true"
    return True


def _read_windows(reader: Reader, root: Map) -> dict[str, Window]:
    """Read the named windows of time."""
    found: dict[str, Window] = {}
    with reader.collect():
        node = mapping(root["windows"], "windows", root.key("windows")) if "windows" in root else root.part("windows")
        for name, below in node.pairs():
            with reader.collect():
                owner = f"windows.{name}"
                own = mapping(below, owner, name)
                check_keys(reader, own, ("from", "to"), owner)
                if not own:
                    raise BadValueError(f"{owner} is empty", own.where, "expected from:, to:, or both")
                ends = [written(own[k], f"{owner}.{k}", own.key(k)) if k in own else None for k in ("from", "to")]
                found[label(name, "window")] = Window(*ends)
    return found


def _read_measures(reader: Reader, root: Map, windows: Mapping[str, Window]) -> tuple[Measure, ...]:
    """Read the measures: NAME: {STATISTIC: SERIES, window: NAME}."""
    found = []
    with reader.collect():
        node, key = root.part("measures"), "measures"
        every = mapping(node, key, root.key(key)) if key in root else node
        for name, below in every.pairs():
            with reader.collect():
                found.append(_read_measure(name, mapping(below, f"measures.{name}", name), windows, root))
                _check_one_origin(found)
    return tuple(found)


def _check_one_origin(measures: Sequence[Measure]) -> None:
    """Raise BadValueError if statistics of all steps subtract series of different scenes."""
    origins = [one.origin for one in measures if one.origin is not None and one.statistic not in WINDOWED]
    if origins and origins[-1] != origins[0]:
        message = f"over all steps runs go beside scene {origins[0]} and scene {origins[-1]}"
        raise BadValueError(message, origins[-1].where, f"expected from: {origins[0]}, or a statistic of samples")


def _read_measure(name: Text, node: Map, windows: Mapping[str, Window], root: Map) -> Measure:
    """Read one measure: statistic, series, window and the scene whose series is subtracted."""
    owner, known = f"measures.{name}", (*STATISTICS, "window", "from")
    if strange := [key for key in node.names() if key not in known]:
        raise unknown_key(strange[0], known, owner)
    selected = [key for key in node.names() if key in STATISTICS]
    if len(selected) != 1:
        message = f"{owner} has {'no statistic' if not selected else f'both {selected[0]} and {selected[1]}'}"
        raise BadValueError(message, name.where, f"expected one of: {', '.join(STATISTICS)}")
    (statistic,) = selected
    what = "the name of a series, a joint or an event, or a section"
    of = text(node[statistic], f"{owner}.{statistic}", statistic, what)
    window = ""
    if "window" in node:
        at = text(node["window"], f"{owner}.window", node.key("window"), "the name of a window")
        if statistic not in WINDOWED:
            hint = f"leave it out, or take one of: {', '.join(SAMPLES)}, of samples"
            raise BadValueError(f"{owner}: {statistic} is of all steps of a run, and knows no window", at.where, hint)
        if at not in root.get("windows", ()):
            raise unknown_name("window", at, windows, at.where)
        window = str(at)
    return Measure(label(name, "measure"), str(statistic), of, window, _read_origin(name, node, statistic))


def _read_origin(name: Text, node: Map, statistic: Text) -> Text | None:
    """Read the scene whose series a measure subtracts; None if there is none."""
    owner = f"measures.{name}"
    if "from" not in node:
        if statistic in DEVIATIONS:
            raise missing_key("from", node.where, owner)
        return None
    if statistic not in OF_SERIES:
        hint = f"leave it out, or take one of: {', '.join(OF_SERIES)}"
        raise BadValueError(f"{owner}: {statistic} is of no series", node.key("from").where, hint)
    return text(node["from"], f"{owner}.from", node.key("from"), "the name of a scene")


def _read_keep(reader: Reader, root: Map) -> tuple[Text, ...]:
    """Read the names of series that are stored for each run."""
    with reader.collect():
        if "keep" in root and root["keep"] != []:
            return _check_once(texts(root["keep"], "keep", root.key("keep"), "names of series"), "series")
    return ()
