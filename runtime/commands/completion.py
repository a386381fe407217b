"""Propose completions in a shell: mechanisms, their scenes, methods, laws."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import typer

from gudgeon.contract.methods import OFFERED


def files(incomplete: str) -> list[str]:
    """Return completions of a file name: shipped mechanisms, YAML files and folders that begin with the text,
    sorted.
    """
    from gudgeon.loading.shipped import shipped

    folder, _, begun = incomplete.rpartition("/")
    found = [] if folder else [name for name in shipped() if name.startswith(begun)]
    with suppress(OSError), os.scandir(f"{folder}/" if folder or incomplete.startswith("/") else ".") as entries:
        for entry in entries:
            if entry.name.startswith(begun) and not entry.name.startswith("."):
                whole = incomplete.removesuffix(begun) + entry.name
                if entry.is_dir():
                    found.append(f"{whole}/")
                elif entry.name.endswith((".yaml", ".yml")):
                    found.append(whole)
    return sorted(found)


def scenes(context: typer.Context, incomplete: str) -> list[str]:
    """Return completions of a scene name, from the mechanism on the command line; "ideal" alone if it cannot be
    read.
    """
    from gudgeon.generator.yaml import parse_yaml
    from gudgeon.loading.shipped import shipped, shipped_file

    found = {"ideal"}
    with suppress(Exception):
        name = str(context.params.get("file") or context.args[0])  # args: after an option without value
        path = shipped_file(name) if name in shipped() else Path(name)
        found |= {str(scene) for scene in parse_yaml(path.read_bytes(), name).part("scenes").names()}
    return sorted(scene for scene in found if scene.startswith(incomplete))


def methods(incomplete: str) -> list[str]:
    """Return the integration methods that begin with the text."""
    return [method for method in OFFERED if method.startswith(incomplete)]


def laws(incomplete: str) -> list[str]:
    """Return completions of a law name: contact, friction and film laws with this beginning, alternative names
    included.
    """
    from gudgeon.generator.kinds.laws.law import RESULTS, called

    return sorted(name for role in RESULTS for name in called(role) if name.startswith(incomplete))
