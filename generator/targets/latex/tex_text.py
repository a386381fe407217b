"""Any text as LaTeX that can only be read as text: nothing in it is a command, all of it is ASCII."""

from __future__ import annotations

import unicodedata

from gudgeon.generator.targets.latex.letters import GREEK, greek

_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%",
    "_": r"\_", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "<": r"\textless{}", ">": r"\textgreater{}",
    "|": r"\textbar{}", '"': "''", "`": r"\textquoteleft{}", "\n": " ", "\t": " ", "\u00a0": "~",
    "–": "--", "—": "---", "’": "'", "‘": "`", "“": "``", "”": "''", "…": r"\ldots{}", "■": r"\rule{1ex}{1ex}",
    "ß": r"\ss{}", "ø": r"\o{}", "Ø": r"\O{}",
    "æ": r"\ae{}", "Æ": r"\AE{}", "œ": r"\oe{}", "ł": r"\l{}", "Ł": r"\L{}", "ı": r"\i{}",
}  # fmt: skip
_MATH = {
    **{sign: greek(name) for name, sign in GREEK.items()},
    "−": "-", "±": r"\pm", "·": r"\cdot", "×": r"\times", "≤": r"\leq", "≥": r"\geq", "≠": r"\neq", "≈": r"\approx",
    "‖": r"\Vert", "→": r"\to", "∂": r"\partial", "√": r"\surd", "°": r"{}^{\circ}", "½": r"\frac{1}{2}",
    **{sign: f"{{}}^{{{k}}}" for k, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}, "∞": r"\infty", "µ": r"\mu", "⁻": "{}^{-}",
    "ᵀ": r"{}^{\top}",
}  # fmt: skip
_MARKS = {
    "\u0300": "`", "\u0301": "'", "\u0302": "^", "\u0303": "~", "\u0304": "=", "\u0306": "u", "\u0307": ".",
    "\u0308": '"', "\u030a": "r", "\u030b": "H", "\u030c": "v", "\u0327": "c", "\u0328": "k",
}  # fmt: skip
_ACCENTS = {"\u0302": "hat", "\u0307": "dot", "\u0308": "ddot"}  # of a mathematical sign


def tex(text: str) -> str:
    """`text` in running LaTeX; a character that plain pdflatex has no sign for becomes its number."""
    return "".join(map(_character, _clusters(text)))


def sketch_line(line: str) -> str:
    """A line of a sketch: every character takes the same room."""
    return "".join(map(_sketch_character, _clusters(line)))


def _sketch_character(cluster: str) -> str:
    if cluster == " ":
        return "~"
    if cluster.isascii():  # a typewriter font has all of ASCII in its places
        return cluster if cluster.isalnum() or cluster in "()[]=+-.,:;'/*!@" else rf"\char{ord(cluster)}{{}}"
    return rf"\cell{{{tex(cluster)}}}"


def _clusters(text: str) -> list[str]:
    """Letters with the marks above them."""
    found: list[str] = []
    for character in unicodedata.normalize("NFC", text):
        if unicodedata.combining(character) and found:
            found[-1] += character
        else:
            found.append(character)
    return found


def _character(cluster: str) -> str:
    if cluster in _SPECIAL:
        return _SPECIAL[cluster]
    if cluster in _MATH:
        return f"${_MATH[cluster]}$"
    if cluster.isascii():
        return cluster if cluster.isprintable() else ""
    base, *marks = list(unicodedata.normalize("NFD", cluster))
    if len(marks) == 1 and marks[0] in _MARKS and (base in _MATH or base.isascii()):
        if base in _MATH:
            return rf"$\{_ACCENTS.get(marks[0], 'bar')}{{{_MATH[base]}}}$"
        return rf"\{_MARKS[marks[0]]}{{{_character(base)}}}"
    return "".join(f"[U+{ord(c):04X}]" for c in cluster)
