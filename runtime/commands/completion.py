"""Propose completions in a shell: mechanisms, their scenes, methods, laws."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import typer

from gudgeon.contract.methods import OFFERED


def complete_files(incomplete: str) -> list[str]:
    """Return completions of a file name, sorted: shipped mechanisms, YAML files and folders that begin with the text.

    Shipped mechanisms are offered for a name without folder. Hidden entries are left out; folders end in "/". A folder
    that cannot be read gives none.
    """
    from gudgeon.loading.shipped import list_shipped_mechanisms

    folder, _, prefix = incomplete.rpartition("/")
    file_names = [] if folder else [name for name in list_shipped_mechanisms() if name.startswith(prefix)]
    with suppress(OSError), os.scandir(f"{folder}/" if folder or incomplete.startswith("/") else ".") as entries:
        for entry in entries:
            if entry.name.startswith(prefix) and not entry.name.startswith("."):
                completion = incomplete.removesuffix(prefix) + entry.name
                if entry.is_dir():
                    file_names.append(f"{completion}/")
                elif entry.name.endswith((".yaml", ".yml")):
                    file_names.append(completion)
    return sorted(file_names)


def complete_scenes(context: typer.Context, incomplete: str) -> list[str]:
    """Return completions of a scene name, from the mechanism on the command line, with "ideal"; only "ideal" if the
    file cannot be read.
    """
    from gudgeon.generator.yaml import parse_yaml
    from gudgeon.loading.shipped import find_shipped_file, list_shipped_mechanisms

    scene_names = {"ideal"}
    with suppress(Exception):
        name = str(context.params.get("file") or context.args[0])  # args: after an option without value
        path = find_shipped_file(name) if name in list_shipped_mechanisms() else Path(name)
        scene_names |= {str(scene) for scene in parse_yaml(path.read_bytes(), name).get_mapping("scenes").list_keys()}
    return sorted(scene for scene in scene_names if scene.startswith(incomplete))


def complete_methods(incomplete: str) -> list[str]:
    """Return the integration methods that begin with the text."""
    return [method for method in OFFERED if method.startswith(incomplete)]


def complete_laws(incomplete: str) -> list[str]:
    """Return completions of a law name: contact, friction and film laws with this beginning, alternative names
    included.
    """
    from gudgeon.generator.kinds.laws.law import RESULTS, find_laws_of_role

    return sorted(name for role in RESULTS for name in find_laws_of_role(role) if name.startswith(incomplete))
