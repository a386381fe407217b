"""Invalid mechanism files as rows: a patch of a valid file, the class of the error, its place.

To add a mistake, add a row. `tests/reader/test_mistakes.py` reads each of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gudgeon.errors import (
    BadNameError,
    BadValueError,
    CycleError,
    ExpressionError,
    InputError,
    JoinError,
    LimitError,
    MissingKeyError,
    NotYamlError,
    UnitError,
    UnknownKeyError,
    UnknownNameError,
)
from tests.scenes import patched

Patch = Mapping[str, str]
BASE = (Path(__file__).with_name("valid") / "double_pendulum.yaml").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Mistake:
    """One invalid file.

    name: of the test, and of the file in messages.
    patch: new text by old text, each of which is in BASE once; or the whole text of the file.
    error: class of the error.
    place: line and column of the error, "line:column".
    message: a part of the message.
    """

    name: str
    patch: Patch | str
    error: type[InputError]
    place: str
    message: str = ""

    @property
    def file(self) -> str:
        return f"{self.name}.yaml"

    @property
    def data(self) -> bytes:
        """Return the bytes of the file. A surrogate in a patch stands for a byte that is not UTF-8."""
        text = self.patch if isinstance(self.patch, str) else patched(BASE, *self.patch.items())
        return text.encode("utf-8", "surrogateescape")


def before(section: str, lines: str) -> dict[str, str]:
    """Return the patch that inserts lines in front of a section: the last entries of the section above."""
    return {f"\n{section}:": f"\n{lines}\n{section}:"}


def at_end(lines: str) -> dict[str, str]:
    """Return the patch that appends lines to BASE."""
    last = BASE.splitlines(keepends=True)[-1]
    return {last: last + lines}


# Joint A slides with play.
GUIDE = {
    "A: {revolute: [L1.head, L2.tail]}": "A: {translational: [L1.head, L2.tail], axis: [1, 0]}",
    "{A: {bearing: pin,": "{A: {guide: way,",
    "\ncontacts:": """
guides:
  way: {gap: c, half_length: 20 mm, half_height: 10 mm, guide_material: steel, slider_material: steel}
contacts:""",
}
BODIES = BASE[BASE.index("bodies:") : BASE.index("ground:")]
OIL = BASE[BASE.index("  oil:") : BASE.index("scenes:")]
FILM = "film: {law: pinkus_sternlicht, viscosity: 100 cP}, transition: 5 um"
INERTIA = "mass: 0.284 kg, inertia: 1.479e-3 kg*m^2"
FIRST_ALIAS = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n"
BOMB = FIRST_ALIAS + "".join(f"a{i}: &a{i} [{', '.join(9 * [f'*a{i - 1}'])}]\n" for i in range(1, 10))

MISTAKES = (
    Mistake("alias_bomb", f"format: gudgeon/1\nname: bomb\n{BOMB}", LimitError, "8:10"),
    Mistake("alias_of_itself", "format: gudgeon/1\nname: loop\nbodies: &b {L1: *b}\n", NotYamlError, "3:17"),
    Mistake("angle_division", {"theta: -10 deg": "theta: pi/4 deg"}, ExpressionError, "19:24"),
    Mistake("attribute_access", {"clearance: c": "clearance: c.__class__"}, ExpressionError, "21:37"),
    Mistake("axis_missing", before("drives", "  B: {translational: [ground.O1, L2.head]}"), MissingKeyError, "16:6"),
    Mistake(
        "axis_without_direction",
        before("drives", "  B: {translational: [ground.O1, L2.head], axis: [0, 0]}"),
        BadValueError,
        "16:51",
    ),
    Mistake(
        "clearance_too_large",
        {"c: 0.3 mm": "c: 15 mm"},
        BadValueError,
        "21:35",
        "expected < bearings.pin.radius = 0.015 m",
    ),
    Mistake("clearance_too_large_in_scene", {"omega: 8*pi rad/s": "c: 20 mm"}, BadValueError, "31:40", "in scene fast"),
    Mistake("comments_only", "# nothing yet\n", NotYamlError, "1:1"),
    Mistake("comparison", {"omega * t": "omega == t"}, ExpressionError, "17:35"),
    Mistake(
        "contour_of_seconds", {"contact: dry": "contact: dry, contour: [0, 0, 0, 1 s, 0, 0, 0, 0]"}, UnitError, "29:63"
    ),
    Mistake("contour_of_words", {"contact: dry": "contact: dry, contour: round"}, BadValueError, "29:44"),
    Mistake(
        "contour_too_deep",
        {"contact: dry": "contact: dry, contour: [0, 0, 0, 20 mm, 0, 0, 0, 0]"},
        BadValueError,
        "29:63",
    ),
    Mistake("contour_too_short", {"contact: dry": "contact: dry, contour: [0, 10 um, 0]"}, BadValueError, "29:44"),
    Mistake("contour_with_film", {"contact: dry": "contact: oil, contour: 64"}, BadValueError, "29:44"),
    Mistake("cyclic_extends", {"    normal:": "    extends: oil\n    normal:"}, CycleError, "24:14", "dry → oil → dry"),
    Mistake("cyclic_parameters", {"c: 0.3 mm": "c: 2 * d\n  d: e / 3\n  e: c"}, CycleError, "6:6", "c → d → e → c"),
    Mistake(
        "cyclic_parameters_in_scene",
        before("materials", "  omega2: -omega") | {"omega: 8*pi rad/s": "omega: 2 * omega2"},
        CycleError,
        "32:44",
    ),
    Mistake("density_zero", {"nu: 0.3": "nu: 0.3, density: 0"}, BadValueError, "8:41"),
    Mistake("division_by_zero", {"length: 80 mm": "length: 80 mm / 0"}, BadValueError, "10:16"),
    Mistake("dotted_name_for_parameter", {"clearance: c": "clearance: L1.theta"}, ExpressionError, "21:35"),
    Mistake("drive_of_ground", {"angle: L1": "angle: ground"}, JoinError, "17:18"),
    Mistake("drive_twice", before("start", "  crank2: {angle: [L1, ground], value: 0}"), JoinError, "18:3"),
    Mistake("drive_without_value", {", value: omega * t": ""}, MissingKeyError, "17:10"),
    Mistake(
        "drive_wrong_dimension",
        {"omega * t": "omega"},
        UnitError,
        "17:29",
        "expected a pure number or an angle (rad), got a rate or an angular velocity (rad/s)",
    ),
    Mistake(
        "duplicate_key",
        {"L2: {length": "L1: {length"},
        UnknownKeyError,
        "11:3",
        "expected once; the first is at duplicate_key.yaml:10:3",
    ),
    Mistake("duplicate_name", {"crank:": "A:"}, BadNameError, "17:3", "the joint at duplicate_name.yaml:15:3"),
    Mistake("empty_file", "", NotYamlError, "1:1"),
    Mistake(
        "event_at_rest_in_scene",
        {"extends: dry, parameters": "extends: dry, events: {top: {zero: ground.O1.x}}, parameters"},
        BadValueError,
        "31:45",
        "scenes.fast.events.top.zero never changes",
    ),
    Mistake(
        "event_in_ideal_broken",
        {"scenes:": "scenes:\n  ideal: {events: {top: {zero: L2.omegas}}}"},
        UnknownNameError,
        "28:35",
    ),
    Mistake(
        "event_never_changes",
        at_end("events: {top: {zero: omega - 3 rad/s}}\n"),
        BadValueError,
        "33:22",
        "expected an expression of t, or of coordinates and velocities",
    ),
    Mistake(
        "event_of_a_result",
        at_end("events: {top: {zero: A.F - 10 N}}\n"),
        ExpressionError,
        "33:22",
        "a result that follows from the forces",
    ),
    Mistake("event_unknown_action", at_end("events: {top: {zero: L2.vy, action: halt}}\n"), BadValueError, "33:37"),
    Mistake("event_unknown_key", at_end("events: {top: {zero: L2.vy, way: falling}}\n"), UnknownKeyError, "33:29"),
    Mistake(
        "event_unknown_name",
        at_end("events: {top: {zero: L3.vy, direction: falling}}\n"),
        UnknownNameError,
        "33:22",
        "did you mean 'L2.vy'?",
    ),
    Mistake("event_unknown_part", at_end("events: {top: {zero: L2.head.vz}}\n"), UnknownNameError, "33:30"),
    Mistake(
        "event_unknown_word",
        at_end("events: {top: {zero: L2.vy, direction: down}}\n"),
        BadValueError,
        "33:40",
        "expected one of: both, rising, falling",
    ),
    Mistake(
        "event_unlike_sum", at_end("events: {limit: {zero: L1.omega - 20 m/s, action: stop}}\n"), UnitError, "33:35"
    ),
    Mistake("event_without_zero", at_end("events: {top: {action: stop}}\n"), MissingKeyError, "33:15"),
    Mistake("expression_on_two_lines", {"omega * t": "omega\n      * t"}, ExpressionError, "17:29"),
    Mistake("format_missing", {"format: gudgeon/1\n": ""}, MissingKeyError, "1:1"),
    Mistake("format_of_the_future", {"gudgeon/1": "gudgeon/2"}, BadValueError, "1:9"),
    Mistake(
        "friction_speeds_swapped", {"v0: 1e-4 m/s, v1: 1e-3 m/s": "v0: 1e-3 m/s, v1: 1e-4 m/s"}, BadValueError, "25:67"
    ),
    Mistake(
        "friction_without_direction",
        before(
            "start",
            "forces:\n  belt: {dry_friction: [ground.O1, L2.head], direction: [0, 0], static: 2 N, kinetic: 1 N}",
        ),
        BadValueError,
        "19:58",
    ),
    Mistake("ground_to_ground", {"O1, L1.tail": "O1, ground.O1"}, JoinError, "14:29"),
    Mistake("guide_left_out", GUIDE | {"guide: way, ": ""}, MissingKeyError, "31:15"),
    Mistake("guide_with_film", GUIDE | {"contact: dry": "contact: oil"}, BadValueError, "31:37"),
    Mistake("guide_with_law_of_a_hole", GUIDE | {"law: lankarani_nikravesh": "law: liu"}, BadValueError, "31:37"),
    Mistake("guide_without_radius", GUIDE, MissingKeyError, "31:23"),
    Mistake(
        "hertz", {"omega: 2*pi rad/s": "omega: 1 Hz"}, UnitError, "5:12", "write 1 rev/s or 1 1/s: they differ by 2*pi"
    ),
    Mistake("infinite", {"length: 80 mm": "length: 1e400"}, ExpressionError, "10:16"),
    Mistake("joint_to_itself", {"L1.head, L2.tail": "L1.head, L1.tail"}, JoinError, "15:27"),
    Mistake("lambda", {"value: omega * t": "'value': 'lambda t: t'"}, ExpressionError, "17:32"),
    Mistake("law_in_wrong_role", {"law: pinkus_sternlicht": "law: modified_coulomb"}, BadValueError, "26:35"),
    Mistake("law_number_missing", {"mu: 0.15, ": ""}, MissingKeyError, "25:15"),
    Mistake("list_for_number", {"length: 80 mm": "length: [80 mm]"}, BadValueError, "10:16"),
    Mistake(
        "material_without_nu",
        before("bodies", "  tin: {E: 50 GPa}") | {"journal_material: steel": "journal_material: tin"},
        MissingKeyError,
        "22:96",
    ),
    Mistake("merge_key", {"L2: {": "L2: {<<: {}, "}, UnknownKeyError, "11:8"),
    Mistake("missing_body", {"L1.head, L2.tail": "L1.head, L3.tail"}, UnknownNameError, "15:27", "did you mean 'L2'?"),
    Mistake(
        "missing_point", {"L1.head, L2.tail": "L1.head, L2.tial"}, UnknownNameError, "15:30", "did you mean 'tail'?"
    ),
    Mistake(
        "mixed_with_printed_film",
        {"}, transition: 5 um": ", as_printed: true}, mixed: {law: christensen, roughness: 1 um}"},
        BadValueError,
        "26:99",
    ),
    Mistake("mixed_without_film", {FILM: "mixed: {law: christensen, roughness: 1 um}"}, MissingKeyError, "26:30"),
    Mistake("name_no_identifier", {"crank:": "crank-1:"}, BadNameError, "17:3"),
    Mistake("name_of_a_function", {"tip:": "sin:"}, BadNameError, "32:11"),
    Mistake(
        "negative_inertia",
        {"inertia: 1.479e-3 kg*m^2": "inertia: -1e-4"},
        BadValueError,
        "11:49",
        "a moment of inertia is not negative",
    ),
    Mistake(
        "negative_mass", {"mass: 0.284 kg": "mass: -0.284 kg"}, BadValueError, "11:30", "-0.284 kg: a mass is positive"
    ),
    Mistake("no_bodies", {BODIES: ""}, MissingKeyError, "1:1"),
    Mistake("not_a_mapping", "- format\n- name\n", NotYamlError, "1:1"),
    Mistake("not_utf8", {"gravity:": "title: M\udcfcller\ngravity:"}, NotYamlError, "3:9"),
    Mistake("not_yaml", "format: gudgeon/1\nname: 'open\n", NotYamlError, "3:1"),
    Mistake("number_for_mapping", {"steel: {E: 206 GPa, nu: 0.3}": "steel: 206 GPa"}, BadValueError, "8:10"),
    Mistake("octal", {"length: 80 mm": "length: 0o120"}, ExpressionError, "10:16"),
    Mistake("output_broken", {"t_end: 1 s": "t_end: 1 s, output: 10.5"}, BadValueError, "30:36"),
    Mistake("peaks_of_play_elsewhere", {"scenes:": "scenes:\n  ideal: {peaks: [A.F, A.Fn]}"}, BadValueError, "28:24"),
    Mistake(
        "peaks_unknown_name",
        {"extends: dry, parameters": "extends: dry, peaks: [L2.ay, L2.az], parameters"},
        UnknownNameError,
        "31:42",
    ),
    Mistake(
        "peaks_without_names",
        {"extends: dry, parameters": "extends: dry, peaks: {L2: ay}, parameters"},
        BadValueError,
        "31:31",
    ),
    Mistake(
        "play_in_guide",
        {"revolute: [L1.head, L2.tail]": "translational: [L1.head, L2.tail], axis: [1, 0]"},
        BadValueError,
        "29:16",
    ),
    Mistake("play_in_ideal", {"fast:": "ideal:"}, BadValueError, "31:3"),
    Mistake("point_without_body", {"L1.head, L2.tail": "L1.head, L2"}, BadValueError, "15:27"),
    Mistake("poisson_ratio", {"nu: 0.3": "nu: 0.5"}, BadValueError, "8:27"),
    Mistake(
        "pulls_with_friction",
        {"law: lankarani_nikravesh, restitution: 0.9": "law: flores, restitution: 0.9, pulls: true", OIL: ""},
        BadValueError,
        "25:15",
    ),
    Mistake("restitution_above_one", {"restitution: 0.9": "restitution: 1.1"}, BadValueError, "24:53"),
    Mistake(
        "scene_material_in_ideal",
        {
            "fast: {extends: dry, parameters:": "ideal: {materials:",
            "omega: 8*pi rad/s": "bearings.pin.journal_material: steel",
        },
        BadValueError,
        "31:3",
    ),
    Mistake(
        "scene_material_of_nothing",
        {"parameters: {omega: 8*pi rad/s}": "materials: {bearings.pin.journal_metal: steel}"},
        UnknownNameError,
        "31:36",
        "did you mean 'bearings.pin.journal_material'?",
    ),
    Mistake(
        "scene_material_without_E",
        {
            "  steel:": "  foam: {density: 30 kg/m^3}\n  steel:",
            "parameters: {omega: 8*pi rad/s}": "materials: {bearings.pin.journal_material: foam}",
        },
        MissingKeyError,
        "32:67",
        "material foam has no E and no nu",
    ),
    Mistake(
        "scene_unknown_material",
        {"parameters: {omega: 8*pi rad/s}": "materials: {bearings.pin.journal_material: bronze}"},
        UnknownNameError,
        "31:67",
    ),
    Mistake("set_and_guessed", before("bearings", "  set: {L2.theta: 10 deg}"), BadValueError, "20:9"),
    Mistake(
        "shape_material_and_density",
        {
            "nu: 0.3": "nu: 0.3, density: 7850 kg/m^3",
            INERTIA: "shape: {bar: 20 mm, thickness: 5 mm, material: steel, density: 7850 kg/m^3}",
        },
        BadValueError,
        "11:71",
    ),
    Mistake(
        "shape_material_without_density",
        {INERTIA: "shape: {bar: 20 mm, thickness: 5 mm, material: steel}"},
        MissingKeyError,
        "11:71",
    ),
    Mistake(
        "shape_unknown_material",
        {INERTIA: "shape: {bar: 20 mm, thickness: 5 mm, material: steal}"},
        UnknownNameError,
        "11:71",
        "did you mean 'steel'?",
    ),
    Mistake(
        "start_play_of_a_slider",
        GUIDE
        | before("bearings", "  play: {A: {e: [0.1 mm, 0]}}")
        | {"law: lankarani_nikravesh": "law: hertz, stiffness: 1e9"},
        BadValueError,
        "20:14",
    ),
    Mistake(
        "start_play_of_no_scene",
        before("bearings", "  play: {O: {e: [0.1 mm, 0]}}"),
        BadValueError,
        "20:10",
        "no scene gives O play",
    ),
    Mistake("start_play_of_time", before("bearings", "  play: {A: {e: [t * 1 mm/s, 0]}}"), ExpressionError, "20:18"),
    Mistake("start_play_one_number", before("bearings", "  play: {A: {e: 0.1 mm}}"), BadValueError, "20:17"),
    Mistake("start_play_unknown_joint", before("bearings", "  play: {Z: {e: [0, 0]}}"), UnknownNameError, "20:10"),
    Mistake(
        "start_play_unknown_key", before("bearings", "  play: {A: {velocity: [0, 2 mm/s]}}"), UnknownKeyError, "20:14"
    ),
    Mistake(
        "start_play_wrong_unit",
        before("bearings", "  play: {A: {e: [0.1 mm, 0], rate: [0, 2 mm]}}"),
        UnitError,
        "20:40",
    ),
    Mistake("start_unknown_coordinate", {"L2.theta": "L2.phi"}, UnknownNameError, "19:14"),
    Mistake("step_zero", {"step: 1e-6 s": "step: 0 s"}, BadValueError, "30:34"),
    Mistake("string_in_expression", {"omega * t": 'omega * "t"'}, ExpressionError, "17:37"),
    Mistake("subscript", {"value: omega * t": "value: 'omega[0] * t'"}, ExpressionError, "17:35"),
    Mistake("t_end_negative", {"t_end: 1 s": "t_end: -1 s"}, BadValueError, "30:23"),
    Mistake("tab", {"    normal": "\tnormal"}, NotYamlError, "24:1", "indent with spaces"),
    Mistake("tag", {"length: 80 mm": "length: !!python/object/apply:os.system [ls]"}, NotYamlError, "10:16"),
    Mistake("three_points", {"L1.head, L2.tail": "L1.head, L2.tail, L2.head"}, BadValueError, "15:17"),
    Mistake("time_in_constant", {"clearance: c": "clearance: c * t"}, ExpressionError, "21:39"),
    Mistake("title_with_comment", {"gravity:": "title: a */ b\ngravity:"}, BadValueError, "3:8"),
    Mistake("too_deep", f"format: gudgeon/1\nname: deep\ntitle: {'[' * 200}{']' * 200}\n", LimitError, "3:32"),
    Mistake(
        "transition_and_mixed",
        {"transition: 5 um": "transition: 5 um, mixed: {law: christensen, roughness: 1 um}"},
        BadValueError,
        "26:92",
    ),
    Mistake("transition_missing", {", transition: 5 um": ""}, MissingKeyError, "26:3"),
    Mistake("transition_zero", {"transition: 5 um": "transition: 0 um"}, BadValueError, "26:86"),
    Mistake("two_documents", at_end(f"---\n{BASE}"), NotYamlError, "33:1"),
    Mistake(
        "two_joint_types",
        {"[L1.head, L2.tail]": "[L1.head, L2.tail], translational: [L1.head, L2.tail]"},
        UnknownKeyError,
        "15:37",
    ),
    Mistake("two_spaces_before_unit", {"length: 80 mm": "length: 80  mm"}, ExpressionError, "10:20", "write "),
    Mistake("unclosed_bracket", {"m/s^2]": "m/s^2"}, NotYamlError, "4:11"),
    Mistake("underscore_in_number", {"length: 80 mm": "length: 1_000"}, ExpressionError, "10:17"),
    Mistake("unknown_contact_in_scene", {"contact: dry": "contact: dri"}, UnknownNameError, "29:39"),
    Mistake("unknown_extends", {"oil: {extends: dry": "oil: {extends: dri"}, UnknownNameError, "26:18"),
    Mistake("unknown_joint_in_scene", {"play: {A:": "play: {B:"}, UnknownNameError, "29:12"),
    Mistake("unknown_joint_type", {"A: {revolute:": "A: {revolut:"}, UnknownKeyError, "15:7"),
    Mistake("unknown_key", {"80 mm, mass:": "80 mm, masse:"}, UnknownKeyError, "10:23", "did you mean 'mass'?"),
    Mistake(
        "unknown_law",
        {"law: modified_coulomb": "law: modified_columb"},
        UnknownNameError,
        "25:21",
        "did you mean 'modified_coulomb'?",
    ),
    Mistake("unknown_material", {"journal_material: steel": "journal_material: steal"}, UnknownNameError, "21:96"),
    Mistake(
        "unknown_name",
        {"clearance: c": "clearance: omga * 1e-3 m*s"},
        UnknownNameError,
        "21:35",
        "did you mean 'omega'?",
    ),
    Mistake("unknown_option", {"restitution: 0.9": "restitution: 0.9, geometry: inside"}, BadValueError, "24:68"),
    Mistake("unknown_parameter_in_scene", {"parameters: {omega:": "parameters: {omega1:"}, UnknownNameError, "31:37"),
    Mistake("unknown_result", {"tip: L2.head.x": "tip: L2.head.z"}, UnknownNameError, "32:24"),
    Mistake("unknown_section", {"start:": "begin:"}, UnknownKeyError, "18:1"),
    Mistake("unknown_unit", {"length: 80 mm": "length: 80 mmm"}, UnitError, "10:19", "did you mean 'mm'?"),
    Mistake("unlike_sum", {"length: 80 mm": "length: 80 mm + 1 kg"}, UnitError, "10:24"),
    Mistake("value_missing", {"c: 0.3 mm": "c:"}, BadValueError, "6:5"),
    Mistake("vector_of_three", {"-9.81 m/s^2": "-9.81 m/s^2, 0"}, BadValueError, "3:10"),
    Mistake("viscosity_zero", {"viscosity: 100 cP": "viscosity: 0"}, BadValueError, "26:65"),
    Mistake(
        "wrong_unit", {"mass: 0.142 kg": "mass: 142 mm"}, UnitError, "10:29", "expected a mass (kg), got a length (m)"
    ),
    Mistake("yaml_null", {"length: 80 mm": "length: ~"}, BadValueError, "10:16"),
    Mistake("yaml_true", {"length: 80 mm": "length: true"}, ExpressionError, "10:16"),
)
