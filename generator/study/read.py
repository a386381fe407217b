"""A study file, or a mapping of Python, to a StudyFile: all mistakes at once, each at its place."""

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
from gudgeon.generator.study.settings import plain, short, tree_of, varied
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

_SET = "value of "  # where what the command line sets was read


def check_names(reader: Reader, study: StudyFile, root: Map) -> None:
    """All mistakes at once."""
    numbers = [*study.fixed, *(key for axis in study.axes for key in axis.columns)]
    numbers += list(study.draw.numbers) if study.draw else []
    seen: dict[str, Text] = {}
    for key in numbers:
        called = short(str(key))
        if called in seen:
            with reader.collect():
                told = f"{str(key)[:60]!r} is said twice"
                raise BadNameError(told, key.where, f"expected once; the first is at {seen[called].where}")
        seen.setdefault(called, key)
    twice = set(_check_choices(reader, study, seen))
    groups = [Text.make(axis.name, axis.where) for axis in study.axes if axis.grouped]
    used = {str(key): ("a number of the runs", key) for key in numbers}
    for what, key in _names(study, root, groups):
        own = key in RESERVED and not (key == "run" and key in groups)
        if (key in used or own) and key not in twice:
            with reader.collect():
                by, first = (used[key][0], f"the first is at {_place(used[key][1].where)}") if key in used else ("", "")
                told = f"the name {str(key)[:60]!r} is taken, by {by or 'the dataset itself'}"
                raise BadNameError(told, key.where, f"take another one{first and ': '}{first}")
        used.setdefault(str(key), (what, key))


def _names(study: StudyFile, root: Map, groups: list[Text]) -> Iterator[tuple[str, Text]]:
    """What the dataset calls by names of the file's beside numbers, and what it is."""
    yield from (("numbers that go together", key) for key in groups)
    yield from (("a choice", Text.make(choice.name, choice.where)) for choice in study.choices)
    if isinstance(root.get("measures"), Map):
        yield from (("a measure", key) for key in root.part("measures").names())
    yield from (("a series that is kept", key) for key in study.keep)


def _check_choices(reader: Reader, study: StudyFile, given: dict[str, Text]) -> Iterator[str]:
    """Names of choices that change what runs are given as a number too: one of the two would do nothing."""
    for choice in study.choices:
        varied = (short(address) for own in choice.options.values() for address in own)
        both = next((key for key in varied if key in given), None)
        if both is None:
            continue
        yield choice.name
        first = given[both].where
        with reader.collect():
            gives = _place(first) if first.file.startswith(_SET) else f"a number, at {first},"
            what = f"choices: {both}" if choice.name == both else f"choices: {choice.name}, by {both},"
            told = f"{what[:120]} varies what {gives[:120]} gives to all runs"
            raise BadNameError(told, choice.where, "leave one of the two out: what is set for all runs does not vary")


def _place(where: Location) -> str:
    """Where a name stands first: in a file, or on the command line."""
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
WHOLE = ("format", "parts", "claims", "titles", "about")  # of a file, not of its parts
PART = tuple(key for key in KEYS if key not in WHOLE)
ALONE = ""  # the name of a study that is all of its file
AUTO, MAX_TITLE = "auto", 200
WINDOWED = (*SAMPLES, DEVIATIONS[0], *CONTACTS, *CROSSINGS, *FOLLOWED)
OF_SERIES = (*SAMPLES, *STEPS, *DEVIATIONS)  # what may be less another scene's


def read_study(data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None) -> StudyFile:
    """The same of a file without parts."""
    return read_studies(data, file, settings).parts[ALONE]


def read_studies(
    data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None
) -> StudySet:
    """What the bytes of a file say, or a mapping; `settings` are numbers of all runs, over its own.

    Raises an InputError at file:line:column, or InputErrors with all that are wrong.
    """
    reader = Reader(file)
    root = parse_yaml(data, file, reader.errors, FORMAT) if isinstance(data, bytes) else tree_of(data)
    if not isinstance(root, Map):
        raise BadValueError(f"the study is {kind_of(root)}", hint="expected a mapping")
    claims, titles, about = Claims(), dict[str, str](), tuple[str, ...]()
    try:
        _check_format(root, isinstance(data, bytes))
        found = {name: _read(reader, node, file, settings or {}, owner) for name, owner, node in _parts(reader, root)}
        claims, titles = read_claims(reader, root), read_titles(reader, root, found)
        about = read_about(reader, root)
    except TooManyErrors:
        found = {}
    reader.errors = list({str(error): error for error in reader.errors}.values())  # parts share what the file says
    reader.raise_errors()
    parts = {name: part for name, part in found.items() if part is not None}
    title = str(root["title"]) if "title" in root else ""
    return StudySet(file, title, parts, "parts" in root, claims, titles, about)


def _parts(reader: Reader, root: Map) -> Iterator[tuple[str, str, Map]]:
    """Name, owner and keys of each part: its own over those of the file, each whole."""
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
    if "format" not in root:
        if needed:
            raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    elif root["format"] != FORMAT:
        is_mechanism = root["format"] == MECHANISM
        more = "; this file is a mechanism, which `gudgeon run FILE` runs" if is_mechanism else ""
        told = f"format is {kind_of(root['format'])}"
        raise BadValueError(told, root.key("format").where, f"expected {FORMAT}{more}")


def _read(reader: Reader, root: Map, file: str, settings: Mapping[str, str], owner: str) -> StudyFile | None:
    if not check_keys(reader, root, KEYS if owner == "the study" else PART, owner, ("mechanism",)):
        return None
    numbers = varied(*read_parameters(reader, root), read_draw(reader, root), settings)
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
            scenes = _once(texts(root["scenes"], "scenes", root.key("scenes"), "names of scenes"), "scene")
            one = isinstance(root["scenes"], Text)
    times = {name: _written(reader, root, name) for name in ("t_end", "output", "step")}
    windows = _windows(reader, root)
    measures, keep = _measures(reader, root, windows), _keep(reader, root)
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
        _method(reader, root),
        _rtol(reader, root),
        _stop(reader, root),
        _said(root) | {"settings": dict(sorted(settings.items()))},
        read_wear(reader, root),
        numbers.left_out,
    )
    check_names(reader, found, root)
    return found


def _said(root: Map) -> dict[str, Any]:
    """What decides the results: not what is claimed of them."""
    return {key: said for key, said in plain(root).items() if key not in ("claims", "titles", "about")}


def _once(names: tuple[Text, ...], what: str) -> tuple[Text, ...]:
    for k, name in enumerate(names):
        if name in names[:k]:
            raise BadNameError(f"the {what} {str(name)[:60]!r} is given twice", name.where, "expected each once")
    return names


def _written(reader: Reader, root: Map, name: str) -> Written | None:
    with reader.collect():
        return written(root[name], name, root.key(name)) if name in root else None
    return None


def _method(reader: Reader, root: Map) -> Text:
    with reader.collect():
        if "method" in root:
            name = word(root["method"], "method", root.key("method"), (*OFFERED, KINEMATIC))
            return Text.make(name, root["method"].where)
    return Text.make(AUTO, root.where)


def _rtol(reader: Reader, root: Map) -> Text | None:
    with reader.collect():
        return text(root["rtol"], "rtol", root.key("rtol"), "a tolerance: 1e-8") if "rtol" in root else None
    return None


def _stop(reader: Reader, root: Map) -> bool:
    with reader.collect():
        return "stop" not in root or word(root["stop"], "stop", root.key("stop"), ("true", "false")) == "true"
    return True


def _windows(reader: Reader, root: Map) -> dict[str, Window]:
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


def _measures(reader: Reader, root: Map, windows: Mapping[str, Window]) -> tuple[Measure, ...]:
    """NAME: {STATISTIC: SERIES, window: NAME}."""
    found = []
    with reader.collect():
        node, key = root.part("measures"), "measures"
        every = mapping(node, key, root.key(key)) if key in root else node
        for name, below in every.pairs():
            with reader.collect():
                found.append(_measure(name, mapping(below, f"measures.{name}", name), windows, root))
                _check_one_origin(found)
    return tuple(found)


def _check_one_origin(measures: Sequence[Measure]) -> None:
    """Over all steps a run goes beside one other scene."""
    origins = [one.origin for one in measures if one.origin is not None and one.statistic not in WINDOWED]
    if origins and origins[-1] != origins[0]:
        told = f"over all steps runs go beside scene {origins[0]} and scene {origins[-1]}"
        raise BadValueError(told, origins[-1].where, f"expected from: {origins[0]}, or a statistic of samples")


def _measure(name: Text, node: Map, windows: Mapping[str, Window], root: Map) -> Measure:
    owner, known = f"measures.{name}", (*STATISTICS, "window", "from")
    if strange := [key for key in node.names() if key not in known]:
        raise unknown_key(strange[0], known, owner)
    chosen = [key for key in node.names() if key in STATISTICS]
    if len(chosen) != 1:
        told = f"{owner} has {'no statistic' if not chosen else f'both {chosen[0]} and {chosen[1]}'}"
        raise BadValueError(told, name.where, f"expected one of: {', '.join(STATISTICS)}")
    (statistic,) = chosen
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
    return Measure(label(name, "measure"), str(statistic), of, window, _origin(name, node, statistic))


def _origin(name: Text, node: Map, statistic: Text) -> Text | None:
    """The scene whose series is subtracted."""
    owner = f"measures.{name}"
    if "from" not in node:
        if statistic in DEVIATIONS:
            raise missing_key("from", node.where, owner)
        return None
    if statistic not in OF_SERIES:
        hint = f"leave it out, or take one of: {', '.join(OF_SERIES)}"
        raise BadValueError(f"{owner}: {statistic} is of no series", node.key("from").where, hint)
    return text(node["from"], f"{owner}.from", node.key("from"), "the name of a scene")


def _keep(reader: Reader, root: Map) -> tuple[Text, ...]:
    with reader.collect():
        if "keep" in root and root["keep"] != []:
            return _once(texts(root["keep"], "keep", root.key("keep"), "names of series"), "series")
    return ()
