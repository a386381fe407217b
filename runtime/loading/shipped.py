"""Find the mechanisms, studies and generated C that come with gudgeon.

`generated/<mechanism>/` holds the KernelSource of each scene (generated_scenes.py), so that unmodified mechanisms need
no derivation. Files in `mechanisms/gallery/` are found by name too, but their C is not stored.
"""

from __future__ import annotations

from pathlib import Path

from gudgeon.contract.kernel_source import HEADER, KernelSource
from gudgeon.errors import InputError, UnknownNameError
from gudgeon.loading.generated_scenes import read_scene

PACKAGE = Path(__file__).parents[1]
MECHANISMS = PACKAGE / "mechanisms"
GALLERY = MECHANISMS / "gallery"
STUDIES = PACKAGE / "study_files"
GENERATED = PACKAGE / "generated"
STUDY = b"format: gudgeon-study/"  # text that marks the file of a study


def list_shipped_mechanisms() -> tuple[str, ...]:
    """Return the names of the mechanisms that come with gudgeon, sorted."""
    return tuple(sorted(path.stem for folder in (MECHANISMS, GALLERY) for path in folder.glob("*.yaml")))


def list_generated_scenes() -> tuple[str, ...]:
    """Return the names of the mechanisms whose C comes with gudgeon too, sorted."""
    return tuple(sorted(path.stem for path in MECHANISMS.glob("*.yaml")))


def _list_shipped_studies() -> dict[str, Path]:
    """Return the files of the studies that come with gudgeon, by name."""
    paths = sorted(STUDIES.glob("*.yaml"))
    return {path.stem: path.resolve() for path in paths if STUDY in path.read_bytes()}


def find_shipped_file(name: str) -> Path:
    """Return the path of a shipped mechanism's YAML file, by name, with links resolved.

    Raises UnknownNameError with the nearest name, or InputError if none are installed.
    """
    names = list_shipped_mechanisms()
    if name in names:
        file = next(path for folder in (MECHANISMS, GALLERY) if (path := folder / f"{name}.yaml").exists())
        return file.resolve()  # in a clone the package has links: show the real file
    raise _build_unknown_name_error("mechanism", name, names)


def find_shipped_study(name: str) -> Path:
    """Return the file of a shipped study. Raise UnknownNameError or InputError as `find_shipped_file`."""
    paths = _list_shipped_studies()
    if name in paths:
        return paths[name]
    raise _build_unknown_name_error("study", name, tuple(paths))


def _build_unknown_name_error(kind: str, name: str, names: tuple[str, ...]) -> InputError:
    """Build the error for an unknown name of a mechanism or study (`kind`), with the nearest of `names`.

    Without any names, it is an InputError for an incomplete installation.
    """
    if not names:
        message = f"this installation of gudgeon is incomplete: it has no {kind.replace('y', 'ie')}s"
        return InputError(message, hint="install it again; in a clone, run `make run` or `sh tools/setup all,web`")
    from gudgeon.language.names import find_nearest_name

    guess = find_nearest_name(name, names)
    return UnknownNameError(
        f"no {kind} {name!r} comes with gudgeon" + (f"; did you mean {guess!r}?" if guess else ""),
        hint=f"there are: {', '.join(names)}; a file of your own needs a '/' or '.yaml' in its name",
    )


def read_committed_header(mechanism: str, scene: str) -> str:
    """Return the committed model.h of a scene for any version of its YAML; "" without one or for an invalid name.

    It predicts the engine's sizes, so that the engine can be compiled during a derivation.
    """
    if not (mechanism.isidentifier() and scene.isidentifier()):
        return ""
    try:
        return (GENERATED / mechanism / scene / HEADER).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""


def read_committed_source(mechanism: str, scene: str, sha256: str) -> KernelSource | None:
    """Return the committed kernel source of a shipped scene; None unless its YAML file has this SHA-256."""
    if not (mechanism.isidentifier() and scene.isidentifier()):
        return None  # a name must not lead out of the folder
    source = read_scene(GENERATED / mechanism, scene)
    return source if source and source.sha256 == sha256 else None
