"""Each part of the integrator is written by the files alone that the head comment of its struct names.

A part is a struct in a header of the engine whose head comment says `Written by: FILE, ...` and, where runs go side by
side in lanes, `Copied by: FILE, ...`; a name that ends with a slash is a folder. These count as writes of a field of a
part: assignments, increments, its name in an initializer, and its address or its array where others may write through
it. The last is a pointer that is not const, unless it has the type of a part, for then its uses are checked.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ENGINE = Path(__file__).parents[2] / "engine"
FILES = sorted(file for file in ENGINE.rglob("*.[ch]"))
STRUCT = re.compile(r"/\*(?P<head>(?:(?!\*/).)*)\*/\ntypedef struct \{\n(?P<body>.*?)^\} (?P<name>\w+);", re.S | re.M)
OWNERS = re.compile(r"(?:Written|Copied) by:(.*?)\.(?=\s|$)", re.S)
FUNCTION = re.compile(r"^(?!return|else|typedef)\w[\w ]*[ *](\w+(?:\(\w+\))?)\(([^{};]*?)\)\s*[{;]", re.M)
INDEX = r"(?:\[[^\[\]]*(?:\[[^\[\]]*\][^\[\]]*)*\])"
TAIL = rf"(?P<tail>(?:{INDEX}|(?:\.|->)\w+)*)"
BASE = rf"(?:\(\([^()]*\)\w+\)|\w+)(?:{INDEX}|(?:\.|->)\w+)*?(?:\.|->)"
WRITES = re.compile(r"\s*(?:=(?!=)|[-+*/%&|^]=|<<=|>>=|\+\+|--)")
LIBRARY = {"memcpy": "void *to, const void *from, size_t n", "memset": "void *to, int value, size_t n"}
LIBRARY["memmove"] = LIBRARY["memcpy"]


@dataclass(frozen=True)
class Part:
    """A struct with an owner."""

    name: str
    owners: tuple[str, ...]
    arrays: frozenset[str]

    def is_owned_by(self, file: str) -> bool:
        return any(file == owner or (owner.endswith("/") and file.startswith(owner)) for owner in self.owners)


@dataclass(frozen=True)
class Function:
    """Its parameters, and the files that declare or define it."""

    params: str
    files: list[str]


def bare(text: str) -> str:
    """The text without comments and strings; lines stay where they are."""
    return re.sub(r'/\*.*?\*/|"(?:\\.|[^"\\\n])*"', lambda found: "\n" * found[0].count("\n"), text, flags=re.S)


def read_parts(texts: dict[str, str]) -> dict[str, Part]:
    """Parts by the names of their types."""
    found = {}
    for text in texts.values():
        for struct in STRUCT.finditer(text):
            lists = [names.replace("*", " ").split(",") for names in OWNERS.findall(struct["head"])]
            if lists:
                owners = tuple(name.strip() for names in lists for name in names)
                arrays = frozenset(re.findall(r"(\w+)\[", bare(struct["body"])))
                found[struct["name"]] = Part(struct["name"], owners, arrays)
    return found


def read_fields(texts: dict[str, str], parts: dict[str, Part]) -> dict[str, Part]:
    """Fields of the integrator that are parts."""
    body = next(struct["body"] for struct in STRUCT.finditer(texts["run/run.h"]) if struct["name"] == "Integrator")
    return {name: parts[kind] for kind, name in re.findall(r"^    (\w+) (\w+);", bare(body), re.M) if kind in parts}


def read_functions(texts: dict[str, str]) -> dict[str, Function]:
    """Functions by their names."""
    found = {name: Function(params, []) for name, params in LIBRARY.items()}
    for file, text in texts.items():
        for name, params in FUNCTION.findall(bare(text)):
            found.setdefault(name, Function(params, [])).files.append(file)
    return found


def argument_of(before: str, functions: dict[str, Function]) -> tuple[str, list[str]] | None:
    """The parameter for which an argument stands after this text, and files of the function; None without a call."""
    depth = index = 0
    for place in range(len(before) - 1, -1, -1):
        letter = before[place]
        if letter in ")]}":
            depth += 1
        elif letter in "([{" and depth:
            depth -= 1
        elif letter == "(":
            name = re.search(r"(\w+(?:\(\w+\))?)\s*$", before[:place])
            known = functions.get(name[1]) if name else None
            params = known.params.split(",") if known else []
            return (params[index], known.files) if known and index < len(params) else None
        elif letter in "{};":
            return None
        elif letter == "," and not depth:
            index += 1
    return None


def lets_write(before: str, part: Part, parts: dict[str, Part], functions: dict[str, Function]) -> bool:
    """Whether a pointer that stands after this text goes where the field may be written unseen."""
    declared = re.search(r"([\w ]+?)\*\s*(?:const )?\w+ = $", before)
    target, files = (declared[1], []) if declared else argument_of(before, functions) or ("", [])
    known = "const" in target or any(re.search(rf"\b{name}\b", target) for name in parts)
    return not (known or any(part.is_owned_by(file) for file in files))


def is_of_another_struct(place: str, text: str) -> bool:
    """Whether the pointer at the beginning of a place is declared as one to something else than an integrator."""
    name = re.match(r"(\w+)->\w+", place)
    kinds = re.findall(rf"(\w+) \*(?:const )?{name[1]}\b", text) if name else []
    return bool(kinds) and not {"Integrator", "IntegratorOf", "LaneIntegrator", "Moving"} & set(kinds)


def writes(
    text: str, fields: dict[str, Part], parts: dict[str, Part], functions: dict[str, Function]
) -> Iterator[tuple[int, str, Part]]:
    """Places in a file, as offsets, where a field of a part is written."""
    pointers = {name: parts[kind] for kind, name in re.findall(rf"(?<!const )\b({'|'.join(parts)}) \*(\w+)", text)}
    whole = {**{f"{BASE}(?P<field>{'|'.join(fields)})\\b{TAIL}": fields}}
    if pointers:
        whole[rf"(?<![\w.>])(?P<field>{'|'.join(pointers)})(?=->){TAIL}"] = pointers
    for pattern, of in whole.items():
        for found in re.finditer(pattern, text):
            part, before = of[found["field"]], text[: found.start()]
            if of is fields and is_of_another_struct(found[0], text):
                continue
            is_array = found["tail"].split(".")[-1].lstrip("->") in part.arrays and "[" not in found["tail"]
            is_address = bool(re.search(r"(?:[(,=?:!;{]|&&|return)\s*&$", before))
            if WRITES.match(text, found.end()) or re.search(r"(?:\+\+|--)\s*$", before):
                yield found.start(), found[0], part
            elif is_address and (found["tail"] or argument_of(before, functions)):
                if lets_write(before[:-1], part, parts, functions):
                    yield found.start(), found[0], part
            elif is_array and re.search(r"[(,=]\s*$", before) and re.match(r"\s*[,;)+]", text[found.end() :]):
                in_call = argument_of(before, functions) is not None or before.endswith("= ")
                if in_call and lets_write(before, part, parts, functions):
                    yield found.start(), found[0], part
    for found in re.finditer(rf"[{{,]\s*\.(?P<field>{'|'.join(fields)}) = ", text):
        yield found.start(), found[0].strip(), fields[found["field"]]


TEXTS = {file.relative_to(ENGINE).as_posix(): file.read_text(encoding="utf-8") for file in FILES}
PARTS = read_parts(TEXTS)
FIELDS = read_fields(TEXTS, PARTS)
FUNCTIONS = read_functions(TEXTS)


def strangers(file: str, text: str) -> list[str]:
    """Writes in a file that does not own what it writes."""
    text = bare(text)
    return [
        f"{file}:{text.count(chr(10), 0, place) + 1}: {lvalue} is of {part.name}, which {', '.join(part.owners)} write"
        for place, lvalue, part in writes(text, FIELDS, PARTS, FUNCTIONS)
        if not part.is_owned_by(file)
    ]


@pytest.mark.parametrize("file", TEXTS)
def test_parts_are_written_by_their_owners(file: str) -> None:
    assert not strangers(file, TEXTS[file])


def test_owners_exist_and_every_field_of_the_integrator_has_one() -> None:
    assert len(FIELDS) >= 14
    for part in PARTS.values():
        for owner in part.owners:
            assert any(file == owner or (owner.endswith("/") and file.startswith(owner)) for file in TEXTS), owner
    run = next(struct for struct in STRUCT.finditer(TEXTS["run/run.h"]) if struct["name"] == "Integrator")
    state = re.search(r"State:(.*?)\.", run["head"], re.S)
    assert state is not None
    declared = re.sub(r"\[[^\]]*\]|^#.*$", "", bare(run["body"]), flags=re.M)
    names = {name.strip(" *") for line in re.findall(r"\w+ ([^;]+);", declared) for name in line.split(",")}
    assert names - set(FIELDS) == {name.strip(" *\n") for name in state[1].split(",")}


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("run->contacts.n_records = 0;", "Contacts"),
        ("run->contacts.records[run->contacts.n_records++] = contact;", "Contacts"),
        ("flow->run[i]->control.attempt.is_open |= 1;", "StepControl"),
        ("--side->x.counts.steps;", "Counts"),
        ("((Integrator *)memory)->events.stop = stop;", "EventList"),
        ("memcpy(run->norm.speed, speed, sizeof speed);", "ErrorNorm"),
        ("double *h = &run->control.h;", "StepControl"),
        ("frexp(x, &run->choice.n_opposing_steps);", "MethodChoice"),
        ("*run = (Integrator){.t = t, .roots = {.suppressed_switch = -1}};", "RootFinding"),
        ("static void f(StepControl *control) { control->h = 1.0; }", "StepControl"),
        ("if (run->contacts.n_records == 0 && run->control.h <= 1.0) return;", None),
        ("memcpy(speed, run->norm.speed, sizeof speed);", None),
        ("const double *weight = run->norm.weight; const double h = run->control.h;", None),
        ("newton_solve(&run->newton.linear, h, 0.0, mean, error);", None),
        ("/* run->control.h = 1.0; */", None),
    ],
)
def test_writes_are_found(line: str, found: str | None) -> None:
    message = strangers("run/stranger.c", f"static void g(Integrator *run)\n{{\n    {line}\n}}\n")
    assert bool(message) == bool(found) and all(f"is of {found}," in row for row in message)
