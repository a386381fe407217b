"""Bytes to tree: places, aliases, bounds; whatever the bytes, a tree or an InputError."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gudgeon.errors import InputError, LimitError, Location, NotYamlError
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.yaml import MAX_BYTES, MAX_DUPLICATES, MAX_NODES, MAX_TAG, Map, Text, parse_yaml


def test_places_count_characters() -> None:
    tree = parse_yaml("title: \u00fc\u00df\nk: {\u00e9: 'quoted', b: [1, \"2\"]}\n".encode(), "f")
    assert tree["title"].where == Location("f", 1, 8)
    assert tree["k"].find_key("b").where == Location("f", 2, 18)
    assert tree["k"]["\u00e9"].where == Location("f", 2, 9)  # behind the quote
    assert [item.where.column for item in tree["k"]["b"]] == [22, 26]


def test_scalars_stay_text() -> None:
    tree = parse_yaml(b"a: 1e-4\nb: on\nc: 012\nd: 2020-01-01\ne: ~\nf: '~'\n", "f")
    assert [tree[key] for key in "abcd"] == ["1e-4", "on", "012", "2020-01-01"]
    assert tree["e"].is_null and not tree["f"].is_null


def test_byte_order_mark_is_no_character() -> None:
    assert parse_yaml(b"\xef\xbb\xbfa: 1", "f").find_key("a").where == Location("f", 1, 1)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("{a: f(t, 0, 0) * 2, b: 1}", {"a": "f(t, 0, 0) * 2", "b": "1"}),
        ("{a: f(t,0 , g(1, 2) ), b: 1}", {"a": "f(t,0 , g(1, 2) )", "b": "1"}),
        ("{a: [max(1, 2), min(3, 4)]}", {"a": ["max(1, 2)", "min(3, 4)"]}),
        ("{a: [(1, 2]}", {"a": ["(1", "2"]}),  # a vector with a broken component
        ("{a: (1, 2, b: 3}", {"a": "(1, 2", "b": "3"}),
        ("{a: f(1, 2)), b: 3}", {"a": "f(1, 2))", "b": "3"}),
        ("{a: 'f(1', b: 2}", {"a": "f(1", "b": "2"}),
        ('{a: "f(1, 2)", b: 2}', {"a": "f(1, 2)", "b": "2"}),
        ("{a: &x f(1, b): 2}", {"a": "f(1", "b)": "2"}),
        ("{a: (1, [2]: 3, b: 1}", None),
    ],
)
def test_commas_in_parentheses(text: str, value: object) -> None:
    """One value for an expression's reader, where YAML sees several."""
    if value is None:
        with pytest.raises(NotYamlError):
            parse_yaml(f"k: {text}\n".encode(), "f")
    else:
        assert parse_yaml(f"k: {text}\n".encode(), "f")["k"] == value


def test_as_many_commas_as_a_long_expression_may_have() -> None:
    """Behind the 64th one the rest were keys that are unknown, or a missing parenthesis."""
    long = "max(" + "max(t,0)+" * 100 + "t,0)"
    assert parse_yaml(f"k: {{a: {long}, b: [{long}, 1]}}\n".encode(), "f")["k"] == {"a": long, "b": [long, "1"]}


def test_commas_keep_their_place_in_the_source() -> None:
    tree = parse_yaml("k: {\u00fc: 1, a: f(t,  0 , 1 s), b: x}\n".encode(), "f")
    assert (tree["k"]["a"], tree["k"]["a"].where) == ("f(t,  0 , 1 s)", Location("f", 1, 14))
    assert tree["k"].find_key("b").where == Location("f", 1, 30)


def test_alias_is_its_anchor() -> None:
    tree = parse_yaml(b"a: &x {k: 1}\nb: *x\n", "f")
    assert tree["b"] is tree["a"]


def test_alias_bomb_is_counted_not_expanded() -> None:
    """Eleven levels of ten stand for 10¹¹ values; nothing near that many is ever made."""
    levels = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    levels += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 11)]
    with pytest.raises(LimitError, match=f"at most {MAX_NODES}"):
        parse_yaml("\n".join(levels).encode(), "f")


@pytest.mark.parametrize("text", ["%YAML 1.13", "%YAML 1.3\n---\na: 1", "%YAML 9.9\n--- {}", "%TAG ! !\n---\n!a b"])
def test_directives(text: str) -> None:
    with pytest.raises(NotYamlError):
        parse_yaml(text.encode(), "f")


@pytest.mark.parametrize("text", ["%YAML 1." + "1" * 5000 + "\n---\na: 1", 'a: "\\U00110000"', 'a: "\\Uffffffff"'])
def test_what_the_library_cannot_convert_is_told_in_our_words(text: str) -> None:
    with pytest.raises(NotYamlError, match="a directive or an escape cannot be read") as message:
        parse_yaml(text.encode(), "f")
    assert len(str(message.value)) < 300


@pytest.mark.parametrize("text", ["a: 1\nb: !" + "a" * 900_000 + " x", "a: 1\nb: !<" + "a" * 900_000 + "> x"])
def test_a_long_tag_is_refused_before_it_is_read(text: str) -> None:
    """The library's time for one grows with the square of its length: a minute for these."""
    with pytest.raises(LimitError, match=f"a tag of more than {MAX_TAG} characters") as message:
        parse_yaml(text.encode(), "f")
    assert message.value.where == Location("f", 2, 4)


def test_what_is_told_is_short() -> None:
    with pytest.raises(NotYamlError, match="has no anchor") as alias:
        parse_yaml(b"a: *" + b"a" * 900_000, "f")
    twice: list[InputError] = []
    parse_yaml(b"{" + b"a: 1, " * 3000 + b"b: 1}", "f", twice)
    assert len(str(alias.value)) < 300 and len(twice) == MAX_DUPLICATES


def test_too_many_bytes() -> None:
    with pytest.raises(LimitError, match="bytes"):
        parse_yaml(b"#" * (MAX_BYTES + 1), "f")


@pytest.mark.parametrize("text", ["[" * 2000, "{a: " * 2000, "- " * 2000, "? " * 2000])
def test_too_deep(text: str) -> None:
    with pytest.raises((LimitError, NotYamlError)):
        parse_yaml(text.encode(), "f")


FRAGMENTS = [
    "a",
    "b",
    ": ",
    "\n",
    "  ",
    "- ",
    "[",
    "]",
    "{",
    "}",
    ",",
    "'",
    '"',
    "&x ",
    "*x",
    "!t ",
    "|",
    ">",
    "#",
    "%",
    "---",
    "~",
    "\t",
    "?",
    "<<",
    "\\",
]


@given(
    st.one_of(
        st.binary(max_size=60), st.lists(st.sampled_from(FRAGMENTS), max_size=30).map(lambda s: "".join(s).encode())
    )
)
@settings(max_examples=300, deadline=None)
def test_any_bytes_give_a_tree_or_an_input_error(data: bytes) -> None:
    try:
        tree = parse_yaml(data, "f")
    except InputError as error:
        assert error.where is not None and error.where.line >= 1 and error.where.column >= 1
    else:
        assert isinstance(tree, Map) and all(isinstance(key, Text) for key in tree)


LINES = [
    "format: gudgeon/1",
    "name: x",
    "title: y",
    "gravity: [0, 1]",
    "parameters: {a: b, b: 1 m}",
    "parameters: [1]",
    "bodies: {L: {mass: 1, inertia: 1}}",
    "bodies: {L: {mass: a, inertia: b, length: 1 kg}, M: 3}",
    "bodies:",
    "ground: {O: [0, 0]}",
    "joints: {A: {revolute: [ground.O, L.tail]}}",
    "joints: {A: {revolute: [{}, []]}, B: []}",
    "joints: {A: {translational: [ground.O, L.origin], axis: 3, angle: []}}",
    "drives: {d: {angle: [[L]], value: {}}}",
    "drives: {d: {angle: L, value: t * 1 rad/s}}",
    "start: {guess: {L.theta: 1, L: 2}}",
    "outputs: {o: L.x + A.F}",
    "materials: {s: {E: 1, nu: 0.3}}",
    "bearings: {p: {radius: 1, clearance: 2, length: q}}",
    "contacts: {c: {normal: {law: {}}, film: {law: pinkus_sternlicht, shear: []}}}",
    "contacts: {c: {extends: c}}",
    "scenes: {s: {extends: s, play: {A: {bearing: p, contact: c}}}}",
    "scenes: {ideal: {simulate: {output: 0.5}}}",
]


@given(st.lists(st.sampled_from(LINES), max_size=14, unique_by=lambda line: line.partition(":")[0]))
@settings(max_examples=300, deadline=None)
def test_any_file_gives_a_mechanism_or_an_input_error(lines: list[str]) -> None:
    with contextlib.suppress(InputError):
        read_mechanism("\n".join(lines).encode(), "f")


@given(
    st.sampled_from(LINES[3:]).map(lambda line: line.partition(":")[0]),
    st.recursive(
        st.sampled_from(["1", "1 m", "L", "ground.O", "''", "~", "L.tail"]),
        lambda inner: st.one_of(
            st.lists(inner, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
            st.dictionaries(
                st.sampled_from(
                    ["L", "A", "mass", "revolute", "angle", "value", "law", "normal", "play", "extends", "guess"]
                ),
                inner,
                max_size=3,
            ).map(lambda items: "{" + ", ".join(f"{key}: {value}" for key, value in items.items()) + "}"),
        ),
        max_leaves=12,
    ),
)
@settings(max_examples=300, deadline=None)
def test_any_shape_in_a_section(section: str, value: str) -> None:
    base = [line for line in LINES[:2] + [LINES[6], LINES[9], LINES[10]] if not line.startswith(f"{section}:")]
    with contextlib.suppress(InputError):
        read_mechanism("\n".join([*base, f"{section}: {value}"]).encode(), "f")
