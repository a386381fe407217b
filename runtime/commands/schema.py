"""Run `gudgeon schema`: print the format of mechanism files, or of study files, for editors and validators."""

from __future__ import annotations

from gudgeon.language.text_output import print_json


def print_schema(study: bool = False) -> int:
    """Print the JSON Schema (draft 2020-12) of mechanism files, or with `study` of study files; return the exit code.

    Registered user-defined laws are included.
    """
    if study:
        from gudgeon.generator.study.schema import make_study_schema

        print_json(make_study_schema())
    else:
        from gudgeon.generator.targets.json_schema import make_schema

        print_json(make_schema())
    return 0
