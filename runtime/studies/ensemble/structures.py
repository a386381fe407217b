"""Which libraries a study needs: its mechanism, each scene with each combination of options."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gudgeon.errors import InputError
from gudgeon.files.reading import MAX_BYTES, read_beside
from gudgeon.loading.find import find_mechanism

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import StudyFile
    from gudgeon.generator.yaml import Text


class Structure(NamedTuple):
    """What a library is of."""

    mechanism: str
    scene: str
    overrides: tuple[tuple[str, str], ...]


def mechanism_of(study: StudyFile) -> str:
    """The shipped mechanism's name, or the path of a file; one that a study file names lies beside it or below."""
    name = str(study.mechanism)
    is_file = "/" in name or name.endswith((".yaml", ".yml"))
    try:
        if not is_file:
            find_mechanism(name)
            return name
        if not study.file:
            return str(Path(name).absolute())
        read_beside(study.file, name, MAX_BYTES)
        return str((Path(study.file).parent / name).absolute())
    except InputError as error:
        message = error.message.replace("the table ", "").replace("path to a table", "path to a mechanism")
        hint = "expected a YAML file in the study's folder or below, or the name of a shipped mechanism"
        raise type(error)(message, study.mechanism.where, error.hint if not is_file else hint) from None


def structures(study: StudyFile) -> Iterator[tuple[Text, dict[str, Text], tuple[tuple[str, str], ...]]]:
    """Every scene with every combination of options: what these set, as it is written and as it is asked for."""
    choices = [list(choice.options.values()) for choice in study.choices]
    for scene, chosen in itertools.product(study.scenes, itertools.product(*choices)):
        texts = {address: text for own in chosen for address, text in own.items()}
        yield scene, texts, tuple(sorted((address, str(text)) for address, text in texts.items()))


def origins(study: StudyFile) -> list[Text]:
    return list(dict.fromkeys(one.origin for one in study.measures if one.origin is not None))


def structures_of(studies: Iterable[StudyFile]) -> list[Structure]:
    """What `resolve` of these loads, each once, in its order; nothing of a study whose mechanism is not to be found."""
    found: dict[Structure, None] = {}
    for study in studies:
        try:
            mechanism = mechanism_of(study)
        except InputError:  # told where it is resolved
            continue
        for scene, _, overrides in structures(study):
            for name in (*origins(study), scene):
                found[Structure(mechanism, str(name), overrides)] = None
    return list(found)
