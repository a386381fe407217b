"""Run `gudgeon schema`: print the format of mechanism files, or of study files, for editors and validators."""

from __future__ import annotations

from gudgeon.language.shown import print_json


def print_schema(study: bool = False) -> int:
    """Print the JSON Schema (draft 2020-12) of mechanism files, or of study files with `study`; return the exit
    code.
    """
    if study:
        from gudgeon.generator.study.schema import schema
    else:
        from gudgeon.generator.targets.json_schema import schema

    print_json(schema())
    return 0
