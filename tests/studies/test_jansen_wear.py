"""studies/jansen_wear.yaml and its leg: Jansen's own, closed at every phase; its runs are `make study-jansen`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from ruamel.yaml import YAML

import gudgeon
from gudgeon.generator.study.read import read_studies
from gudgeon.generator.study.schema import make_study_schema
from tests.programs import needs_compiler
from tests.slow import slow_but

FILE = Path(__file__).parents[2] / "studies" / "jansen_wear.yaml"


def test_it_is_read_whole() -> None:
    """What the paper prints is compared, none of it is fitted: trends say which are ours."""
    claims = read_studies(FILE.read_bytes(), str(FILE)).claims
    values = {str(one.name): str(one.value) for one in claims.numbers}
    assert values == {"N1": "48 N", "N2": "104 N", "N3": "426 N", "N4": "10 deg", "N5": "10 deg"}
    assert not any(one.not_computed for one in claims.trends)
    jsonschema = pytest.importorskip("jsonschema")
    study = YAML(typ="safe").load(FILE.read_text(encoding="utf-8"))
    assert not list(jsonschema.Draft202012Validator(make_study_schema()).iter_errors(study))


@needs_compiler
@pytest.mark.parametrize("starts", slow_but([8], [8, 16]))
def test_the_leg_is_jansens_at_every_phase(starts: int) -> None:
    """Ten times the gallery's: at each of these starts it is assembled as the other one gets there."""
    leg, other = gudgeon.load(FILE.with_name("jansen_leg_play.yaml")), gudgeon.load("jansen_leg")
    turn = other.simulate(1.0, output=starts)
    for k in range(starts):
        start = leg.simulate(0.01, output=1, parameters={"phase": 2 * np.pi * k / starts})
        assert 0.1 * start["lower.R.x"][0] == pytest.approx(turn["lower.R.x"][k], abs=1e-9)
        assert 0.1 * start["lower.R.y"][0] == pytest.approx(turn["lower.R.y"][k], abs=1e-9)
