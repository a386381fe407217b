"""Wear between the runs of a study: which bearings' contours deepen, by what, over how many rounds."""

from __future__ import annotations

from gudgeon.errors import MissingKeyError
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.study.parts import check_keys, mapping, text, texts, whole, word
from gudgeon.generator.study.spec import WEAR_LAWS, WearRounds
from gudgeon.generator.yaml.tree import Map, Text

KEYS = ("joints", "rounds", "k", "hardness", "scale", "law")
MOST_ROUNDS = 1000


def read_wear(reader: Reader, root: Map) -> WearRounds | None:
    """None where nothing wears."""
    if "wear" not in root:
        return None
    with reader.collect():
        node = mapping(root["wear"], "wear", root.key("wear"))
        if not check_keys(reader, node, KEYS, "wear", KEYS[:3]):
            return None
        joints = texts(node["joints"], "wear.joints", node.key("joints"), "names of joints")
        rounds = whole(node["rounds"], "wear.rounds", node.key("rounds"), 1, MOST_ROUNDS)
        law = word(node["law"], "wear.law", node.key("law"), WEAR_LAWS) if "law" in node else WEAR_LAWS[0]
        k, hardness, scale = (_number(node, name) for name in ("k", "hardness", "scale"))
        if k is None:
            raise MissingKeyError("wear has no k", node.where, "expected k: 1e-4, and hardness: 1 GPa")
        return WearRounds(joints, rounds, k, hardness, scale, law)
    return None


def _number(node: Map, name: str) -> Text | None:
    return text(node[name], f"wear.{name}", node.key(name), "a number") if name in node else None
