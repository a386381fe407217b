"""`gudgeon schema`: the format of mechanism files, or of study files, for editors and validators."""

from __future__ import annotations

import json


def print_schema(study: bool = False) -> int:
    """The JSON Schema (draft 2020-12), written from the reader's own shapes, to standard output."""
    if study:
        from gudgeon.generator.study.schema import schema
    else:
        from gudgeon.generator.targets.json_schema import schema

    print(json.dumps(schema(), indent=1, ensure_ascii=False))
    return 0
