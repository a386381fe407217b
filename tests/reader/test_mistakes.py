"""Every mistake has a file of its own, an error class and an exact place."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from gudgeon.errors import (
    BadNameError,
    BadValueError,
    CycleError,
    ExpressionError,
    InputError,
    JoinError,
    LimitError,
    Location,
    MissingKeyError,
    NotYamlError,
    UnitError,
    UnknownKeyError,
    UnknownNameError,
)
from gudgeon.generator.reader.read import read_mechanism

INVALID = Path(__file__).resolve().parents[1] / "mechanisms" / "invalid"

# file, class, line, column
MISTAKES: list[tuple[str, type[InputError], int, int]] = [
    ("alias_bomb", LimitError, 8, 10),
    ("alias_of_itself", NotYamlError, 3, 17),
    ("angle_division", ExpressionError, 19, 24),
    ("attribute_access", ExpressionError, 21, 37),
    ("axis_missing", MissingKeyError, 16, 6),
    ("axis_without_direction", BadValueError, 16, 51),
    ("clearance_too_large", BadValueError, 21, 35),
    ("clearance_too_large_in_scene", BadValueError, 31, 40),
    ("comments_only", NotYamlError, 1, 1),
    ("comparison", ExpressionError, 17, 35),
    ("contour_of_seconds", UnitError, 29, 63),
    ("contour_of_words", BadValueError, 29, 44),
    ("contour_too_deep", BadValueError, 29, 63),
    ("contour_too_short", BadValueError, 29, 44),
    ("contour_with_film", BadValueError, 29, 44),
    ("cyclic_extends", CycleError, 24, 14),
    ("cyclic_parameters", CycleError, 6, 6),
    ("cyclic_parameters_in_scene", CycleError, 32, 44),
    ("density_zero", BadValueError, 8, 41),
    ("division_by_zero", BadValueError, 10, 16),
    ("dotted_name_for_parameter", ExpressionError, 21, 35),
    ("drive_of_ground", JoinError, 17, 18),
    ("drive_twice", JoinError, 18, 3),
    ("drive_without_value", MissingKeyError, 17, 10),
    ("drive_wrong_dimension", UnitError, 17, 29),
    ("duplicate_key", UnknownKeyError, 11, 3),
    ("duplicate_name", BadNameError, 17, 3),
    ("empty_file", NotYamlError, 1, 1),
    ("event_at_rest_in_scene", BadValueError, 31, 45),
    ("event_in_ideal_broken", UnknownNameError, 28, 35),
    ("event_never_changes", BadValueError, 33, 22),
    ("event_of_a_result", ExpressionError, 33, 22),
    ("event_unknown_action", BadValueError, 33, 37),
    ("event_unknown_key", UnknownKeyError, 33, 29),
    ("event_unknown_name", UnknownNameError, 33, 22),
    ("event_unknown_part", UnknownNameError, 33, 30),
    ("event_unknown_word", BadValueError, 33, 40),
    ("event_unlike_sum", UnitError, 33, 35),
    ("event_without_zero", MissingKeyError, 33, 15),
    ("expression_on_two_lines", ExpressionError, 17, 29),
    ("format_missing", MissingKeyError, 1, 1),
    ("format_of_the_future", BadValueError, 1, 9),
    ("friction_speeds_swapped", BadValueError, 25, 67),
    ("friction_without_direction", BadValueError, 19, 58),
    ("ground_to_ground", JoinError, 14, 29),
    ("hertz", UnitError, 5, 12),
    ("infinite", ExpressionError, 10, 16),
    ("joint_to_itself", JoinError, 15, 27),
    ("lambda", ExpressionError, 17, 32),
    ("law_in_wrong_role", BadValueError, 26, 35),
    ("law_number_missing", MissingKeyError, 25, 15),
    ("list_for_number", BadValueError, 10, 16),
    ("material_without_nu", MissingKeyError, 22, 96),
    ("merge_key", UnknownKeyError, 11, 8),
    ("missing_body", UnknownNameError, 15, 27),
    ("missing_point", UnknownNameError, 15, 30),
    ("name_no_identifier", BadNameError, 17, 3),
    ("name_of_a_function", BadNameError, 32, 11),
    ("negative_inertia", BadValueError, 11, 49),
    ("negative_mass", BadValueError, 11, 30),
    ("mixed_with_printed_film", BadValueError, 26, 99),
    ("mixed_without_film", MissingKeyError, 26, 30),
    ("no_bodies", MissingKeyError, 1, 1),
    ("not_a_mapping", NotYamlError, 1, 1),
    ("not_utf8", NotYamlError, 3, 9),
    ("not_yaml", NotYamlError, 3, 1),
    ("number_for_mapping", BadValueError, 8, 10),
    ("octal", ExpressionError, 10, 16),
    ("output_broken", BadValueError, 30, 36),
    ("peaks_of_play_elsewhere", BadValueError, 28, 24),
    ("peaks_unknown_name", UnknownNameError, 31, 42),
    ("peaks_without_names", BadValueError, 31, 31),
    ("guide_left_out", MissingKeyError, 31, 15),
    ("guide_with_film", BadValueError, 31, 37),
    ("guide_with_law_of_a_hole", BadValueError, 31, 37),
    ("guide_without_radius", MissingKeyError, 31, 23),
    ("play_in_guide", BadValueError, 29, 16),
    ("play_in_ideal", BadValueError, 31, 3),
    ("point_without_body", BadValueError, 15, 27),
    ("poisson_ratio", BadValueError, 8, 27),
    ("restitution_above_one", BadValueError, 24, 53),
    ("scene_material_in_ideal", BadValueError, 31, 3),
    ("scene_material_of_nothing", UnknownNameError, 31, 36),
    ("scene_material_without_E", MissingKeyError, 32, 67),
    ("scene_unknown_material", UnknownNameError, 31, 67),
    ("set_and_guessed", BadValueError, 20, 9),
    ("shape_material_and_density", BadValueError, 11, 71),
    ("shape_material_without_density", MissingKeyError, 11, 71),
    ("shape_unknown_material", UnknownNameError, 11, 71),
    ("start_play_of_a_slider", BadValueError, 20, 14),
    ("start_play_of_no_scene", BadValueError, 20, 10),
    ("start_play_of_time", ExpressionError, 20, 18),
    ("start_play_one_number", BadValueError, 20, 17),
    ("start_play_unknown_joint", UnknownNameError, 20, 10),
    ("start_play_unknown_key", UnknownKeyError, 20, 14),
    ("start_play_wrong_unit", UnitError, 20, 40),
    ("pulls_with_friction", BadValueError, 25, 15),
    ("start_unknown_coordinate", UnknownNameError, 19, 14),
    ("step_zero", BadValueError, 30, 34),
    ("string_in_expression", ExpressionError, 17, 37),
    ("subscript", ExpressionError, 17, 35),
    ("t_end_negative", BadValueError, 30, 23),
    ("tab", NotYamlError, 24, 1),
    ("tag", NotYamlError, 10, 16),
    ("three_points", BadValueError, 15, 17),
    ("time_in_constant", ExpressionError, 21, 39),
    ("title_with_comment", BadValueError, 3, 8),
    ("too_deep", LimitError, 3, 32),
    ("transition_and_mixed", BadValueError, 26, 92),
    ("transition_missing", MissingKeyError, 26, 3),
    ("transition_zero", BadValueError, 26, 86),
    ("two_documents", NotYamlError, 33, 1),
    ("two_joint_types", UnknownKeyError, 15, 37),
    ("two_spaces_before_unit", ExpressionError, 10, 20),
    ("unclosed_bracket", NotYamlError, 4, 11),
    ("underscore_in_number", ExpressionError, 10, 17),
    ("unknown_contact_in_scene", UnknownNameError, 29, 39),
    ("unknown_extends", UnknownNameError, 26, 18),
    ("unknown_joint_in_scene", UnknownNameError, 29, 12),
    ("unknown_joint_type", UnknownKeyError, 15, 7),
    ("unknown_key", UnknownKeyError, 10, 23),
    ("unknown_law", UnknownNameError, 25, 21),
    ("unknown_material", UnknownNameError, 21, 96),
    ("unknown_name", UnknownNameError, 21, 35),
    ("unknown_option", BadValueError, 24, 68),
    ("unknown_parameter_in_scene", UnknownNameError, 31, 37),
    ("unknown_result", UnknownNameError, 32, 24),
    ("unknown_section", UnknownKeyError, 18, 1),
    ("unknown_unit", UnitError, 10, 19),
    ("unlike_sum", UnitError, 10, 24),
    ("value_missing", BadValueError, 6, 5),
    ("vector_of_three", BadValueError, 3, 10),
    ("viscosity_zero", BadValueError, 26, 65),
    ("wrong_unit", UnitError, 10, 29),
    ("yaml_null", BadValueError, 10, 16),
    ("yaml_true", ExpressionError, 10, 16),
]

# what was expected, or the nearest name, in the message of some of them
WORDS = {
    "wrong_unit": "expected a mass (kg), got a length (m)",
    "drive_wrong_dimension": "expected a pure number or an angle (rad), got a rate or an angular velocity (rad/s)",
    "unknown_key": "did you mean 'mass'?",
    "missing_body": "did you mean 'L2'?",
    "missing_point": "did you mean 'tail'?",
    "unknown_name": "did you mean 'omega'?",
    "unknown_unit": "did you mean 'mm'?",
    "unknown_law": "did you mean 'modified_coulomb'?",
    "cyclic_parameters": "c → d → e → c",
    "cyclic_extends": "dry → oil → dry",
    "duplicate_name": "the joint at duplicate_name.yaml:15:3",
    "duplicate_key": "expected once; the first is at duplicate_key.yaml:10:3",
    "clearance_too_large": "expected < bearings.pin.radius = 0.015 m",
    "clearance_too_large_in_scene": "in scene fast",
    "negative_mass": "-0.284 kg: a mass is positive",
    "negative_inertia": "a moment of inertia is not negative",
    "event_at_rest_in_scene": "scenes.fast.events.top.zero never changes",
    "event_never_changes": "expected an expression of t, or of coordinates and velocities",
    "event_of_a_result": "a result that follows from the forces",
    "event_unknown_name": "did you mean 'L2.vy'?",
    "event_unknown_word": "expected one of: both, rising, falling",
    "hertz": "write 1 rev/s or 1 1/s: they differ by 2*pi",
    "two_spaces_before_unit": "write ",
    "scene_material_of_nothing": "did you mean 'bearings.pin.journal_material'?",
    "scene_material_without_E": "material foam has no E and no nu",
    "shape_unknown_material": "did you mean 'steel'?",
    "start_play_of_no_scene": "no scene gives O play",
    "tab": "indent with spaces",
}


@pytest.mark.parametrize(("name", "kind", "line", "column"), MISTAKES, ids=[m[0] for m in MISTAKES])
def test_mistake(name: str, kind: type[InputError], line: int, column: int) -> None:
    path = INVALID / f"{name}.yaml"
    with pytest.raises(InputError) as caught:
        read_mechanism(path.read_bytes(), path.name)
    error = caught.value
    assert type(error) is kind  # one mistake, one error
    assert error.where == Location(path.name, line, column)
    assert error.exit_code == 2
    assert str(error).startswith(f"{path.name}:{line}:{column}: ")
    assert WORDS.get(name, "") in str(error)
    assert re.search("expected|did you mean|write|use |there are no|indent|cannot be reached", str(error))


def test_every_file_is_in_the_table() -> None:
    assert sorted(path.stem for path in INVALID.glob("*.yaml")) == sorted(m[0] for m in MISTAKES)


def test_words_belong_to_files() -> None:
    assert set(WORDS) <= {m[0] for m in MISTAKES}


CONSTANT = """format: gudgeon/1
name: m
parameters: {{d: 0, e: 1, a: {value}}}
bodies: {{b: {{length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, b.tail]}}}}
drives: {{m: {{angle: b, value: 1 rad/s * t}}}}
"""


@pytest.mark.parametrize("value", [
    "ramp(1, 0, 0)", "smooth_step(1 s, 0 s, 0 s)", "smooth_step(1, 0, d)", "smooth_step(1, 0, e-e)", "min(1/0, 1)",
    "max(1, log(0))", "where(sqrt(-1) < 1, 2, 3)", "1/(1/0)", "atan(1/d)", "exp(-1/d)", "sign(1/0)", "(1/0)**0",
    "smooth_step(1, 0, 1/0)", "2 - 3*atan(e + 1/d)", "where(e < 0, sqrt(-1), 3)", "where(e < 0, 1/0, 3)",
])  # fmt: skip
def test_a_constant_has_no_part_that_is_not_finite(value: str) -> None:
    """SymPy raised ValueError for extremes of 1/0, and the others had values such as atan(1/0) = pi/2."""
    with pytest.raises(BadValueError, match=r"m\.yaml:3:\d+: parameters\.a (has a part that )?is (-?inf|nan)"):
        read_mechanism(CONSTANT.format(value=value).encode(), "m.yaml")


@pytest.mark.parametrize("value", ["where(0 < d, 1/d, 7)", "smooth_step(1, 0, e)", "where(e < 2, atan(e), log(d))"])
def test_a_branch_that_is_not_picked_may_be_infinite(value: str) -> None:
    assert read_mechanism(CONSTANT.format(value=value).encode(), "m.yaml").parameters["a"]


@pytest.mark.parametrize("number", ["0." + "3" * 5000, "1" * 5000, "0" * 20 + "." + "1" * 5000 + "e-3 m"])
def test_a_number_has_at_most_so_many_characters(number: str) -> None:
    """Python raised ValueError from 4300 digits on."""
    with pytest.raises(ExpressionError, match=r"m\.yaml:3:\d+: "):
        read_mechanism(CONSTANT.format(value=number).encode(), "m.yaml")
    long = read_mechanism(CONSTANT.format(value="0." + "3" * 900).encode(), "m.yaml")
    assert long.parameters["a"]
