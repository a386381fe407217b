"""What comes with gudgeon: the mechanism files, and the kernels that were generated from them.

`generated/<mechanism>/` holds the KernelSource of each scene (generated_scenes.py). With it an unmodified shipped
mechanism needs no derivation. Files in `mechanisms/gallery/` are found by name as those beside it are, and are derived
where they are loaded: no C of them is kept.
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
STUDY = b"format: gudgeon-study/"


def shipped() -> tuple[str, ...]:
    """The names of the mechanisms that come with gudgeon, sorted."""
    return tuple(sorted(path.stem for folder in (MECHANISMS, GALLERY) for path in folder.glob("*.yaml")))


def generated() -> tuple[str, ...]:
    """Those whose C comes with gudgeon too, sorted."""
    return tuple(sorted(path.stem for path in MECHANISMS.glob("*.yaml")))


def shipped_studies() -> dict[str, Path]:
    """Files of the studies that come with gudgeon, by name; mechanisms that they bring along stand beside them."""
    found = sorted(STUDIES.glob("*.yaml"))
    return {path.stem: path.resolve() for path in found if STUDY in path.read_bytes()}


def shipped_file(name: str) -> Path:
    """The file of a shipped mechanism. Raises UnknownNameError, which names the nearest and all.

    InputError where none are installed.
    """
    names = shipped()
    if name in names:
        file = next(path for folder in (MECHANISMS, GALLERY) if (path := folder / f"{name}.yaml").exists())
        return file.resolve()  # in a clone the package has links: show the real file
    raise _unknown("mechanism", name, names)


def shipped_study(name: str) -> Path:
    """The file of a shipped study. Raises UnknownNameError, InputError as shipped_file."""
    found = shipped_studies()
    if name in found:
        return found[name]
    raise _unknown("study", name, tuple(found))


def _unknown(what: str, name: str, names: tuple[str, ...]) -> InputError:
    if not names:
        told = f"this installation of gudgeon is not whole: it has no {what.replace('y', 'ie')}s"
        return InputError(told, hint="install it anew; in a clone `make run` or `sh tools/setup all,web` does it")
    from gudgeon.language.names import nearest

    guess = nearest(name, names)
    return UnknownNameError(
        f"no {what} {name!r} comes with gudgeon" + (f"; did you mean {guess!r}?" if guess else ""),
        hint=f"there are: {', '.join(names)}; a file of your own needs a '/' or '.yaml' in its name",
    )


def committed_header(mechanism: str, scene: str) -> str:
    """The model.h that is committed for a scene, whatever bytes of YAML it was made from; "" where there is none."""
    if not (mechanism.isidentifier() and scene.isidentifier()):
        return ""
    try:
        return (GENERATED / mechanism / scene / HEADER).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""


def committed(mechanism: str, scene: str, sha256: str) -> KernelSource | None:
    """The committed kernels of a shipped mechanism's scene, if they were made from these very bytes of YAML."""
    if not (mechanism.isidentifier() and scene.isidentifier()):
        return None  # a name must not walk out of the folder
    source = read_scene(GENERATED / mechanism, scene)
    return source if source and source.sha256 == sha256 else None
