"""Reads a study file, or a mapping in Python, into a StudyFile; all errors are reported at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gudgeon.contract.methods import KINEMATIC, OFFERED
from gudgeon.errors import BadNameError, BadValueError, Location, MissingKeyError
from gudgeon.generator.format.sections import FORMAT as MECHANISM
from gudgeon.generator.format.shapes import make_missing_key_error, make_unknown_key_error
from gudgeon.generator.reader.collector import Reader, TooManyErrors
from gudgeon.generator.study.axes import read_choices, read_draw, read_starts, read_varied_parameters
from gudgeon.generator.study.claims import read_claims
from gudgeon.generator.study.parts import (
    check_keys,
    check_label_of_entry,
    check_mapping_node,
    check_text_node,
    check_texts,
    check_word,
    parse_study_expression,
    read_about,
    read_titles,
    read_wear,
)
from gudgeon.generator.study.settings import apply_set_options, build_tree, convert_to_texts, remove_section_name
from gudgeon.generator.study.spec import (
    CONTACTS,
    CROSSINGS,
    DEPRECATED_STATISTICS,
    DEVIATIONS,
    FORMAT,
    NEIGHBOUR_STATISTICS,
    RESERVED,
    SAMPLES,
    STATISTICS,
    STEPS,
    Claims,
    Measure,
    ParsedExpression,
    StudyFile,
    StudySet,
    Window,
)
from gudgeon.generator.yaml import Map, Text, describe_node, parse_yaml
from gudgeon.language.deprecations import warn_deprecated
from gudgeon.language.names import make_unknown_name_error

_SET = "value of "  # prefix of locations of values from the command line


def check_dataset_names(reader: Reader, study: StudyFile, root: Map) -> None:
    """Collect an error for each name of a study's dataset that is reserved or used twice.

    Checked are parameters, zips, choices, measures and stored series of one part. `root` is the part's tree.
    """
    parameter_keys = [*study.fixed, *(key for axis in study.axes for key in axis.columns)]
    parameter_keys += list(study.draw.distributions) if study.draw else []
    first_keys: dict[str, Text] = {}
    for key in parameter_keys:
        parameter_name = remove_section_name(str(key))
        if parameter_name in first_keys:
            with reader.collect_errors():
                message = f"{str(key)[:60]!r} is given twice"
                raise BadNameError(
                    message, key.where, f"expected once; the first is at {first_keys[parameter_name].where}"
                )
        first_keys.setdefault(parameter_name, key)
    refused_choices = set(_find_conflicting_choices(reader, study, first_keys))
    groups = [Text.make_text(axis.name, axis.where) for axis in study.axes if axis.grouped]
    users_of_names = {str(key): ("a parameter of the runs", key) for key in parameter_keys}
    for kind, key in _iterate_dataset_names(study, root, groups):
        is_reserved = key in RESERVED and not (key == "run" and key in groups)
        if (key in users_of_names or is_reserved) and key not in refused_choices:
            with reader.collect_errors():
                user, location_text = (
                    (users_of_names[key][0], f"the first is at {_format_location(users_of_names[key][1].where)}")
                    if key in users_of_names
                    else ("", "")
                )
                message = f"the name {str(key)[:60]!r} is already used, by {user or 'the dataset itself'}"
                raise BadNameError(message, key.where, f"choose another name{location_text and ': '}{location_text}")
        users_of_names.setdefault(str(key), (kind, key))


def _iterate_dataset_names(study: StudyFile, root: Map, zip_keys: list[Text]) -> Iterator[tuple[str, Text]]:
    """Yield (kind, name) for each name of the dataset but parameters: groups of `zip`, choices, measures, series."""
    yield from (("parameters that vary together", key) for key in zip_keys)
    yield from (("a choice", Text.make_text(choice.name, choice.where)) for choice in study.choices)
    if isinstance(root.get("measures"), Map):
        yield from (("a measure", key) for key in root.get_mapping("measures").list_keys())
    yield from (("a stored series", key) for key in study.keep)


def _find_conflicting_choices(reader: Reader, study: StudyFile, keys_of_parameters: dict[str, Text]) -> Iterator[str]:
    """Yield the names of choices that change a parameter which is set for all runs.

    An error is collected for each. `keys_of_parameters` maps the parameters of all runs to the keys that set them.
    """
    for choice in study.choices:
        parameter_names = (
            remove_section_name(address) for overrides in choice.options.values() for address in overrides
        )
        shared_name = next((key for key in parameter_names if key in keys_of_parameters), None)
        if shared_name is None:
            continue
        yield choice.name
        location = keys_of_parameters[shared_name].where
        with reader.collect_errors():
            setting_phrase = (
                _format_location(location) if location.file.startswith(_SET) else f"a number, at {location},"
            )
            choice_phrase = (
                f"choices: {shared_name}"
                if choice.name == shared_name
                else f"choices: {choice.name}, by {shared_name},"
            )
            message = f"{choice_phrase[:120]} varies a parameter that {setting_phrase[:120]} sets for all runs"
            raise BadNameError(
                message, choice.where, "remove one of the two: a parameter that is set for all runs does not vary"
            )


def _format_location(location: Location) -> str:
    """Return where a name was used first as text: a location in a file, or an argument of the command line."""
    return location.file.removeprefix(_SET) if location.file.startswith(_SET) else str(location)


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
FILE_KEYS = ("format", "parts", "claims", "titles", "about")  # keys of a file, which its parts do not have
PART_KEYS = tuple(key for key in KEYS if key not in FILE_KEYS)
ONLY_PART = ""  # name of the only part of a file without parts
AUTO, MAX_TITLE = "auto", 200
WINDOW_STATISTICS = (*SAMPLES, DEVIATIONS[0], *CONTACTS, *CROSSINGS, *NEIGHBOUR_STATISTICS)
SERIES_STATISTICS = (*SAMPLES, *STEPS, *DEVIATIONS)  # statistics that can subtract the series of another scene


def read_study(data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None) -> StudyFile:
    """Return the study of a file without parts; arguments and errors as `read_studies`."""
    return read_studies(data, file, settings).parts[ONLY_PART]


def read_studies(
    data: bytes | Mapping[str, Any], file: str = "", settings: Mapping[str, str] | None = None
) -> StudySet:
    """Return the studies of a file, given as bytes or as a mapping in Python, with its claims and titles.

    `settings` are values for all runs that override the file's; `file` is its name for messages. Raises an InputError
    at file:line:column, or InputErrors with all errors. `settings` None: values of the file only.
    """
    reader = Reader(file)
    root = parse_yaml(data, file, reader.errors, FORMAT) if isinstance(data, bytes) else build_tree(data)
    if not isinstance(root, Map):
        raise BadValueError(f"the study is {describe_node(root)}", hint="expected a mapping")
    claims, titles, about = Claims(), dict[str, str](), tuple[str, ...]()
    try:
        _check_format(root, isinstance(data, bytes))
        parts_or_none = {
            name: _read_part(reader, node, file, settings or {}, owner)
            for name, owner, node in _split_parts(reader, root)
        }
        claims, titles = read_claims(reader, root), read_titles(reader, root, parts_or_none)
        about = read_about(reader, root)
    except TooManyErrors:
        parts_or_none = {}
    reader.errors = list(
        {str(error): error for error in reader.errors}.values()
    )  # parts repeat the errors of shared keys
    reader.raise_errors()
    parts = {name: part for name, part in parts_or_none.items() if part is not None}
    title = str(root["title"]) if "title" in root else ""
    return StudySet(file, title, parts, "parts" in root, claims, titles, about)


def _split_parts(reader: Reader, root: Map) -> Iterator[tuple[str, str, Map]]:
    """Yield name, owner for messages, and keys of each part; keys of a part override those of the file.

    A file without `parts` has one part, named ONLY_PART. Errors are collected for unknown keys and invalid parts.
    """
    if "parts" not in root:
        yield ONLY_PART, "the study", root
        return
    common_entries = [(key, node) for key, node in root.list_entries() if key not in FILE_KEYS]
    unknown_keys = [key for key, _ in common_entries if key not in PART_KEYS]
    reader.errors.extend(make_unknown_key_error(key, KEYS, "the study") for key in unknown_keys)
    with reader.collect_errors():
        parts_node = check_mapping_node(root["parts"], "parts", root.find_key("parts"))
        if not parts_node:
            raise BadValueError(
                "parts is empty", root.find_key("parts").where, "expected {clearance: {…}, material: {…}}"
            )
        for name, node in parts_node.list_entries():
            with reader.collect_errors():
                part_node = check_mapping_node(node, f"parts.{name}", name)
                inherited_entries = [
                    (key, value) for key, value in common_entries if key not in part_node and key not in unknown_keys
                ]
                yield (
                    check_label_of_entry(name, "part"),
                    f"parts.{name}",
                    Map.make_map([*inherited_entries, *part_node.list_entries()], part_node.where),
                )


def _check_format(root: Map, is_required: bool) -> None:
    """Raise an InputError unless the format is that of study files; without a format only if it is `is_required`."""
    if "format" not in root:
        if is_required:
            raise MissingKeyError("no format", root.where, f"expected the key format: {FORMAT}")
    elif root["format"] != FORMAT:
        is_mechanism_file = root["format"] == MECHANISM
        remark = "; this file is a mechanism: run it with `gudgeon run FILE`" if is_mechanism_file else ""
        message = f"format is {describe_node(root['format'])}"
        raise BadValueError(message, root.find_key("format").where, f"expected {FORMAT}{remark}")


def _read_part(reader: Reader, root: Map, file: str, settings: Mapping[str, str], part_name: str) -> StudyFile | None:
    """Return one study, or one part of a file with several; None if `mechanism` is missing.

    `part_name` names the part in messages; `settings` are values of `--set`. Errors are collected; what cannot be read
    gets its default.
    """
    if not check_keys(reader, root, KEYS if part_name == "the study" else PART_KEYS, part_name, ("mechanism",)):
        return None
    parameters = apply_set_options(*read_varied_parameters(reader, root), read_draw(reader, root), settings)
    starts, choices = read_starts(reader, root), read_choices(reader, root)
    title = mechanism = Text.make_text("", root.where)
    is_single_scene, scenes = True, (*[Text.make_text("ideal", root.where)],)
    with reader.collect_errors():
        mechanism = check_text_node(
            root["mechanism"], "mechanism", root.find_key("mechanism"), "a file next to this one, or a name"
        )
    with reader.collect_errors():
        title = check_text_node(root["title"], "title", root.find_key("title"), "a line") if "title" in root else title
        if len(title) > MAX_TITLE or not title.isprintable():
            hint = f"expected one line of at most {MAX_TITLE} visible characters"
            raise BadValueError(f"the title has {len(title)} characters", title.where, hint)
    with reader.collect_errors():
        if "scenes" in root:
            scenes = _require_unique_names(
                check_texts(root["scenes"], "scenes", root.find_key("scenes"), "names of scenes"), "scene"
            )
            is_single_scene = isinstance(root["scenes"], Text)
    times = {name: _read_expression(reader, root, name) for name in ("t_end", "output", "step")}
    windows = _read_windows(reader, root)
    measures, keep = _read_measures(reader, root, windows), _read_stored_series(reader, root)
    with reader.collect_errors():
        if not (root.get("measures") or root.get("keep")):
            hint = "expected measures: {peak: {peak: slider.ax}}, or keep: [slider.x]"
            raise MissingKeyError(f"{part_name} has neither measures nor keep", root.where, hint)
    study = StudyFile(
        file,
        str(title),
        mechanism,
        scenes,
        is_single_scene,
        tuple(choices),
        parameters.fixed,
        parameters.axes,
        parameters.draw,
        starts,
        times["t_end"],
        times["output"],
        times["step"],
        windows,
        measures,
        keep,
        _read_method(reader, root),
        _read_rtol(reader, root),
        _read_stop_at_events(reader, root),
        _select_result_settings(root) | {"settings": dict(sorted(settings.items()))},
        read_wear(reader, root),
        parameters.left_out,
    )
    check_dataset_names(reader, study, root)
    return study


def _select_result_settings(root: Map) -> dict[str, Any]:
    """Return the tree as plain texts without the keys that do not affect the results: claims, titles and about."""
    return {key: value for key, value in convert_to_texts(root).items() if key not in ("claims", "titles", "about")}


def _require_unique_names(names: tuple[Text, ...], kind: str) -> tuple[Text, ...]:
    """Return the names if each occurs once.

    Raises BadNameError at the first that is given twice; `kind` is the noun for the names in the message.
    """
    for k, name in enumerate(names):
        if name in names[:k]:
            raise BadNameError(f"the {kind} {str(name)[:60]!r} is given twice", name.where, "expected each name once")
    return names


def _read_expression(reader: Reader, root: Map, name: str) -> ParsedExpression | None:
    """Return the parsed expression at the key `name` of a part, such as t_end; None if it is missing or wrong.

    The error of a wrong one is collected.
    """
    with reader.collect_errors():
        return parse_study_expression(root[name], name, root.find_key(name)) if name in root else None
    return None


def _read_method(reader: Reader, root: Map) -> Text:
    """Return the integration method, `auto` by default; an error is collected for an unknown one."""
    with reader.collect_errors():
        if "method" in root:
            name = check_word(root["method"], "method", root.find_key("method"), (*OFFERED, KINEMATIC))
            return Text.make_text(name, root["method"].where)
    return Text.make_text(AUTO, root.where)


def _read_rtol(reader: Reader, root: Map) -> Text | None:
    """Return the tolerance as text; None if it is not given or wrong. The error is collected."""
    with reader.collect_errors():
        return (
            check_text_node(root["rtol"], "rtol", root.find_key("rtol"), "a tolerance: 1e-8")
            if "rtol" in root
            else None
        )
    return None


def _read_stop_at_events(reader: Reader, root: Map) -> bool:
    """Return the value of the key `stop` (true or false): whether runs stop at events; true without the key.

    An error is collected for any other value, and true is returned.
    """
    with reader.collect_errors():
        return (
            "stop" not in root or check_word(root["stop"], "stop", root.find_key("stop"), ("true", "false")) == "true"
        )
    return True


def _read_windows(reader: Reader, root: Map) -> dict[str, Window]:
    """Return the named windows of time; errors are collected.

    The ends of a window are expressions; None is the begin or the end of the run.
    """
    windows: dict[str, Window] = {}
    with reader.collect_errors():
        node = (
            check_mapping_node(root["windows"], "windows", root.find_key("windows"))
            if "windows" in root
            else root.get_mapping("windows")
        )
        for name, value in node.list_entries():
            with reader.collect_errors():
                address = f"windows.{name}"
                window_node = check_mapping_node(value, address, name)
                check_keys(reader, window_node, ("from", "to"), address)
                if not window_node:
                    raise BadValueError(f"{address} is empty", window_node.where, "expected from:, to:, or both")
                ends = [
                    parse_study_expression(window_node[key], f"{address}.{key}", window_node.find_key(key))
                    if key in window_node
                    else None
                    for key in ("from", "to")
                ]
                windows[check_label_of_entry(name, "window")] = Window(*ends)
    return windows


def _read_measures(reader: Reader, root: Map, windows: Mapping[str, Window]) -> tuple[Measure, ...]:
    """Return the measures, NAME: {STATISTIC: SERIES, window: NAME}, in the order of the file; errors are collected.

    `windows` are the windows that measures may name. It is an error if measures subtract more than one other scene.
    """
    measures = []
    with reader.collect_errors():
        node, key = root.get_mapping("measures"), "measures"
        entries = check_mapping_node(node, key, root.find_key(key)) if key in root else node
        for name, value in entries.list_entries():
            with reader.collect_errors():
                measures.append(_read_measure(name, check_mapping_node(value, f"measures.{name}", name), windows, root))
                _check_single_reference_scene(measures)
    return tuple(measures)


def _check_single_reference_scene(measures: Sequence[Measure]) -> None:
    """Raise BadValueError if statistics of all steps subtract series of different scenes.

    Statistics of samples in a window do not count. Only the last measure is compared with the first.
    """
    reference_scenes = [
        measure.reference_scene
        for measure in measures
        if measure.reference_scene is not None and measure.statistic not in WINDOW_STATISTICS
    ]
    if reference_scenes and reference_scenes[-1] != reference_scenes[0]:
        message = f"statistics of all steps subtract both scene {reference_scenes[0]} and scene {reference_scenes[-1]}"
        raise BadValueError(
            message, reference_scenes[-1].where, f"expected from: {reference_scenes[0]}, or a statistic of samples"
        )


def _read_measure(name: Text, node: Map, windows: Mapping[str, Window], root: Map) -> Measure:
    """Return one measure: statistic, series, window and the scene whose series is subtracted. Raises an InputError.

    `root` is the part's tree, whose windows may contain errors.
    """
    address, known_keys = f"measures.{name}", (*STATISTICS, *DEPRECATED_STATISTICS, "window", "from")
    if unknown_keys := [key for key in node.list_keys() if key not in known_keys]:
        raise make_unknown_key_error(unknown_keys[0], known_keys, address)
    selected = [key for key in node.list_keys() if key in (*STATISTICS, *DEPRECATED_STATISTICS)]
    if len(selected) != 1:
        message = f"{address} has {'no statistic' if not selected else f'both {selected[0]} and {selected[1]}'}"
        raise BadValueError(message, name.where, f"expected one of: {', '.join(STATISTICS)}")
    (statistic,) = selected
    expected_text = "the name of a series, a joint or an event, or a section"
    source_name = check_text_node(node[statistic], f"{address}.{statistic}", statistic, expected_text)
    if statistic in DEPRECATED_STATISTICS:
        new_name, deprecation = DEPRECATED_STATISTICS[statistic]
        warn_deprecated(deprecation)
        statistic = Text.make_text(new_name, statistic.where)
    window = ""
    if "window" in node:
        window_name = check_text_node(
            node["window"], f"{address}.window", node.find_key("window"), "the name of a window"
        )
        if statistic not in WINDOW_STATISTICS:
            hint = f"remove window, or use a statistic of samples: {', '.join(SAMPLES)}"
            raise BadValueError(
                f"{address}: {statistic} is a statistic of all steps of a run, and has no window",
                window_name.where,
                hint,
            )
        if window_name not in root.get("windows", ()):
            raise make_unknown_name_error("window", window_name, windows, window_name.where)
        window = str(window_name)
    return Measure(
        check_label_of_entry(name, "measure"),
        str(statistic),
        source_name,
        window,
        _read_reference_scene(name, node, statistic),
    )


def _read_reference_scene(name: Text, node: Map, statistic: Text) -> Text | None:
    """Return the scene whose series a measure subtracts, the value of its key `from`; None if there is none.

    Raises an InputError if a deviation has no scene, or if the statistic is not one of a series.
    """
    address = f"measures.{name}"
    if "from" not in node:
        if statistic in DEVIATIONS:
            raise make_missing_key_error("from", node.where, address)
        return None
    if statistic not in SERIES_STATISTICS:
        hint = f"remove from, or use one of: {', '.join(SERIES_STATISTICS)}"
        raise BadValueError(f"{address}: {statistic} is not a statistic of a series", node.find_key("from").where, hint)
    return check_text_node(node["from"], f"{address}.from", node.find_key("from"), "the name of a scene")


def _read_stored_series(reader: Reader, root: Map) -> tuple[Text, ...]:
    """Return the names of series that are stored for each run (key `keep`); () if there are none.

    Errors are collected.
    """
    with reader.collect_errors():
        if "keep" in root and root["keep"] != []:
            return _require_unique_names(
                check_texts(root["keep"], "keep", root.find_key("keep"), "names of series"), "series"
            )
    return ()
