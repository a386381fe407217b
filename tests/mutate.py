"""Mutants of equations, laws, reduction, methods' numbers, starts and results: do the tests that belong to them notice?

    python -m tests.mutate [--count 40] [--seed 1] [--group constraints ...] [--only 3 17] [--processes 2]

Works in a clone of its own, without generated/: shipped mechanisms are derived by what is mutated. A mutant is one
change of one line: another operator or comparison, another whole number, a sign, the last digit of a method's
coefficient. Which there are is drawn by the seed; for each the tests of its group run, in their order, until one fails.
What survives is printed, to be read: a test is missing there, or the change means nothing. Those that were read and
mean nothing are in MEANS_NOTHING, with the reason: they are told, not run and not counted.
No group has a test that compares texts with kept ones (generated/, docs/): it would notice every change of a name.
"""

from __future__ import annotations

import argparse
import io
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SECONDS = 3600.0  # of the tests of one mutant, at most: what runs longer was noticed


def _tests(folder: str, *names: str) -> tuple[str, ...]:
    return tuple(f"tests/{folder}/test_{name}.py" for name in names)


# What is mutated, and the tests that belong to it: those first that are quick and likely to notice
GROUPS = {
    "constraints": (
        ("generator/equations/constraints.py", "generator/equations/geometry.py", "generator/kinds/joints/*.py"),
        (
            *_tests("equations", "derivation", "random_linkages"),
            *_tests("reader", "fields", "read_kinds"),
            *_tests("kernels", "pivots", "jacobian"),
            *_tests("equations", "forces", "events", "roots"),
            *_tests("reader", "whole_format"),
            *_tests("reduction", "reduction"),
            *_tests("simulation", "massless"),
            *_tests("integrators", "guide"),
            *_tests("results", "reactions"),
        ),
    ),
    "dynamics": (
        (
            "generator/kernels/dynamics.py",
            "generator/solvers/kkt.py",
            "generator/equations/loads.py",
            "generator/equations/system.py",
        ),
        (
            *_tests("kernels", "pivots"),
            *_tests("equations", "random_linkages", "forces", "events", "mixed"),
            *_tests("reduction", "reduction", "redundancy"),
            *_tests(
                "kernels",
                "jacobian",
                "finite_drives",
                "finite_slopes",
                "far_quotients",
                "complex_parts",
                "parts",
                "wholes",
                "jacobian_contacts",
            ),
            *_tests("integrators", "friction", "newton_restitution", "guide"),
        ),
    ),
    "laws": (
        ("generator/kinds/laws/*.py",),
        (
            *_tests("reader", "fields"),
            *_tests("equations", "every_law", "friction_laws", "cylinders", "mixed", "short_film", "expression_law"),
            *_tests("reynolds", "finite_length", "closed_forms", "deviations", "frames"),
            *_tests("kinds", "own_laws"),
            *_tests("integrators", "impact", "film_settles", "newton_restitution"),
            *_tests("assembly", "journals"),
        ),
    ),
    "reduction": (
        ("generator/reduction/*.py",),
        (
            *_tests("reduction", "reduction", "redundancy", "driven_chains", "reduced_hard", "story"),
            *_tests(
                "kernels",
                "tree_jacobian",
                "finite_drives",
                "far_quotients",
                "finite_slopes",
                "complex_parts",
                "parts",
                "wholes",
            ),
        ),
    ),
    "methods": (
        (
            "engine/scalar_simd/dop853.h",
            "engine/scalar_simd/rodas5p.h",
            "engine/scalar_simd/radau.h",
            "engine/methods/rodas5p.c",
        ),
        _tests("integrators", "tables", "radau", "methods"),
    ),
    "starts": (
        (
            "runtime/assembly/closure.py",
            "runtime/assembly/guess_warnings.py",
            "runtime/assembly/mobility.py",
            "runtime/assembly/journals.py",
            "runtime/assembly/rank.py",
        ),
        (
            *_tests("assembly", "start", "journals", "assemblies", "far_starts", "large"),
            *_tests("simulation", "many_starts", "massless", "restart"),
            *_tests("integrators", "guide"),
        ),
    ),
    "results": (
        (
            "runtime/results/series.py",
            "runtime/results/peaks.py",
            "runtime/results/wear.py",
            "runtime/results/motion.py",
            "runtime/results/samples.py",
            "runtime/model/arrays.py",
        ),
        (
            *_tests("results", "results", "reactions", "at_events", "motion", "batch_series", "drift"),
            *_tests("model", "arrays", "array_forms"),
            *_tests("simulation", "peaks", "wear", "wear_loop"),
        ),
    ),
}
SWAPS = {
    "+": "-",
    "-": "+",
    "*": "/",
    "/": "*",
    "<": "<=",
    "<=": "<",
    ">": ">=",
    ">=": ">",
    "==": "!=",
    "!=": "==",
    "and": "or",
    "or": "and",
    "True": "False",
    "False": "True",
    "not": "",
}
# As they are told, but for the line's number: why no number can differ
MEANS_NOTHING = {
    "generator/equations/geometry.py:39: '1' -> '2': ZERO, ONE = sp.Integer(0), sp.Integer(1)": "masses in place of none: another metric, in which a linkage without freedom closes to the same position",
    "generator/equations/geometry.py:35: '0' -> '1': opposite_name is not None and local_vector[0].could_extract_minus_sign()": "which of two opposite arms has symbols, the other being their negatives",
    "generator/solvers/kkt.py:32: '0' -> '1': threshold = max(thresholds[0], EARLY) if is_early else thresholds[0]": "EARLY is more than either share",
    "generator/kernels/dynamics.py:73: '0' -> '1': b: dict[int, sp.Expr] = {k: f for k, f in enumerate(forces) if f != 0}": "a force that is 0 is written as 0",
    "generator/reduction/geometry.py:99: '1' -> '2': parent, child, sign = (first, second, 1) if second.body == body else (second, first, -1)": "a slide's coordinate in another unit: the same motion",
    "generator/reduction/multiple_joints.py:63: '1' -> '2': signs[other.name] = 1 if first in connected else -1": "of a share only the sign is printed",
    "runtime/assembly/closure.py:99: '4' -> '5': for _ in range((N_RANDOM_STARTS if len(guess) <= MANY_COORDINATES else N_RANDOM_STARTS // 4) // 2):": "how many starts are tried",
    "generator/reduction/tree.py:64: '+' -> '-': depth_of_body[neighbour] = depth_of_body[body] + 1": "where chains are cut, so which trees are among the candidates",
    "generator/reduction/tree.py:66: '1' -> '2': depth_of_body[neighbour] = depth_of_body[body] + 1": "where chains are cut, so which trees are among the candidates",
    "runtime/assembly/guess_warnings.py:38: '+' -> '-': difference = (difference + np.pi) % (2.0 * np.pi) - np.pi if is_angle else difference": "the same remainder",
    "generator/reduction/tree.py:33: '24' -> '25': _MAX_COORDINATES_FOR_EXCHANGE = 24  # free angles of a tree that exchanges of joints may improve": "which tree is taken: every tree has the same motion",
    "runtime/model/arrays.py:13: 'not' -> '': and not values.flags.c_contiguous": "which of two ways an array is copied on",
}
COEFFICIENT = re.compile(r"\d\.\d{12,}")


@dataclass(frozen=True)
class Mutant:
    """One change: what stands from one place of a file to another becomes another text."""

    group: str
    file: str
    line: int
    start: int
    end: int
    text: str

    def made(self, source: str) -> str:
        """The whole file with it."""
        lines = source.splitlines(keepends=True)
        old = lines[self.line - 1]
        lines[self.line - 1] = old[: self.start] + self.text + old[self.end :]
        return "".join(lines)

    def message(self, source: str) -> str:
        """One line for people."""
        line = source.splitlines()[self.line - 1]
        change = f"{line[self.start : self.end]!r} -> {self.text!r}"
        return f"{self.file}:{self.line}:{self.start + 1}: {change}: {line.strip()}"

    def nothing(self, source: str) -> str:
        """Why it means nothing, if that is known."""
        return MEANS_NOTHING.get(self.message(source).replace(f":{self.line}:", ":", 1), "")


def of_python(group: str, file: str, source: str) -> Iterator[Mutant]:
    """Operators, words and whole numbers; not in texts, annotations and imports."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        line = token.line.strip()
        if line.startswith(("from ", "import ", "@", "def ", "class ")) or "->" in line:
            continue
        (row, start), (_, end) = token.start, token.end
        if token.type in (tokenize.OP, tokenize.NAME) and token.string in SWAPS:
            if token.string in "*" and re.search(r"\(\*|, \*|\[\*|\*\*", token.line[max(0, start - 2) : end + 1]):
                continue  # an unpacking
            yield Mutant(group, file, row, start, end, SWAPS[token.string])
        elif token.type == tokenize.NUMBER and token.string.isdigit():
            yield Mutant(group, file, row, start, end, str(int(token.string) + 1))


def of_c(group: str, file: str, source: str) -> Iterator[Mutant]:
    """Coefficients of methods, off by some 1e-6 of themselves."""
    for row, line in enumerate(source.splitlines(), 1):
        for found in COEFFICIENT.finditer(line):
            at = found.start() + 8
            digit = str((int(line[at]) + 3) % 10)
            yield Mutant(group, file, row, at, at + 1, digit)


def mutants(groups: list[str], count: int, seed: int) -> list[Mutant]:
    """As many of each group, drawn."""
    drawn = random.Random(seed)
    found: list[Mutant] = []
    for group in groups:
        every: list[Mutant] = []
        for pattern in GROUPS[group][0]:
            for path in sorted(ROOT.glob(pattern)):
                name, source = path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")
                every += (of_python if path.suffix == ".py" else of_c)(group, name, source)
        found += drawn.sample(every, min(len(every), -(-count // len(groups))))
    return found


def without_line() -> list[str]:
    """What of MEANS_NOTHING is of no line any more."""
    parts = {message: (message.split(":", 1)[0], message.split(": ", 2)[2]) for message in MEANS_NOTHING}
    return [message for message, (file, line) in parts.items() if line not in (ROOT / file).read_text(encoding="utf-8")]


def failed(group: str, folder: Path, processes: int) -> bool:
    """Whether a test of the group does, or nothing can be imported. FileNotFoundError where there is no such test."""
    command = [".venv/bin/pytest", "-q", "-x", "-p", "no:cacheprovider"]
    if processes > 1:
        command += ["-n", str(processes), "--dist", "loadfile", "--no-loadscope-reorder"]
    environment = os.environ | {"GUDGEON_CACHE": str(folder / "build/mutants")}
    try:
        done = subprocess.run(
            [*command, *GROUPS[group][1]],
            cwd=folder,
            env=environment,
            timeout=SECONDS,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        return True
    if done.returncode in (pytest.ExitCode.USAGE_ERROR, pytest.ExitCode.NO_TESTS_COLLECTED):
        raise FileNotFoundError(f"tests of {group}: {' '.join(GROUPS[group][1])}")
    return done.returncode != 0


def noticed(mutant: Mutant, folder: Path, processes: int) -> bool:
    """Whether a test of its group fails with it."""
    file = folder / mutant.file
    source = file.read_text(encoding="utf-8")
    file.write_text(mutant.made(source), encoding="utf-8")
    try:
        return failed(mutant.group, folder, processes)
    finally:
        file.write_text(source, encoding="utf-8")


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--group", nargs="+", choices=GROUPS, default=list(GROUPS))
    parser.add_argument("--only", nargs="+", type=int, help="of those that are drawn, by their numbers")
    parser.add_argument("--processes", type=int, default=2, help="for the tests of one mutant")
    options = parser.parse_args()
    for message in without_line():
        print(f"MEANS_NOTHING has no such line any more: {message}")
    survived, nothing, run = list[str](), list[str](), 0
    drawn = mutants(options.group, options.count, options.seed)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "gudgeon"
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(folder)], check=True)
        subprocess.run(["sh", "tools/setup", "all,test"], cwd=folder, check=True)
        shutil.rmtree(folder / "generated")
        for group in options.group:
            if failed(group, folder, options.processes):
                raise SystemExit(f"tests of {group} fail without any mutant: {' '.join(GROUPS[group][1])}")
            print(f"tests of {group} pass without a mutant", flush=True)
        for k, mutant in enumerate(drawn, 1):
            if options.condition and k not in options.condition:
                continue
            source = (folder / mutant.file).read_text(encoding="utf-8")
            message, why = mutant.message(source), mutant.nothing(source)
            if why:
                nothing.append(f"{message}: {why}")
                print(f"{k}/{len(drawn)} NOTHING  {nothing[-1]}", flush=True)
                continue
            run, seen = run + 1, noticed(mutant, folder, options.processes)
            print(f"{k}/{len(drawn)} {'noticed ' if seen else 'SURVIVED'} {message}", flush=True)
            survived += [] if seen else [message]
    print(f"\n{run - len(survived)} of {run} were noticed, and {len(nothing)} mean nothing; what survived:")
    print("\n".join(survived))
    return 0


if __name__ == "__main__":
    sys.exit(main())
