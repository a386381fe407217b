"""Measure the time of one evaluation of each force law in C, in ns, as scenes call it.

    python -m benchmarks.laws [NAME ...]    # from the repository's root, with gudgeon installed

Each law is compiled in a scene of one journal, with the flags of a run and the values with which it is plotted
(`gudgeon laws NAME --plot`), and called at 256 random states in turn; the smallest time of some rounds counts. It
includes reading the states and adding up the results; the column "nothing" has the time of these alone.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from gudgeon.commands.law_plot import list_default_parameters
from gudgeon.generator.kernels.program import Program, make_program
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_bundled_laws
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.targets.c.functions import print_shared_call, print_statements
from gudgeon.loading.compiler import build_flags, find_compiler
from gudgeon.loading.engine import build_include_flags

SCENE = """
format: gudgeon/1
name: alone
bodies: {{journal: {{mass: 0.2 kg, inertia: 1e-4 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, journal.origin]}}}}
materials: {{steel: {{E: 207 GPa, nu: 0.3}}}}
bearings: {{pin: {{radius: 10 mm, clearance: 0.1 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}}}
contacts: {{it: {{{contact}}}}}
scenes: {{alone: {{play: {{A: {{bearing: pin, contact: it}}}}}}}}
"""
# Ranges of the random variables in SI; internal states of laws as z.
DRAWN = {
    "delta": (0.0, 5e-6),
    "ratio": (-1.0, 1.0),
    "deltadot": (-0.1, 0.1),
    "F_n": (1.0, 1000.0),
    "v_t": (-0.05, 0.05),
    "epsilon": (0.01, 0.95),
    "w_n": (-10.0, 10.0),
    "w_t": (-10.0, 10.0),
    "z": (-1e-5, 1e-5),
}
STATES, COUNT, ROUNDS = 256, 400_000, 7
HARNESS = """
#include "scene.c"
#include <stdio.h>
#include <time.h>

static double seconds_now(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(void)
{
    static const double low[] = {%(low)s}, high[] = {%(high)s};
    static double x[%(states)d][%(width)d], given[%(slots)d], g[AT_LEAST_ONE(N_SWITCHES)];
    static unsigned char is_given[%(slots)d];
    static Parameters numbers;
    const Parameters *p = &numbers;
    const double *side = NULL;
    double best = INFINITY, sum = 0.0, out[8] = {0.0};
    unsigned long long seed = 1;
    prepare(given, is_given, &numbers);
    for (int i = 0; i < %(states)d; i++)
        for (int k = 0; k < %(width)d; k++) {
            seed = 6364136223846793005ULL * seed + 1442695040888963407ULL;
            x[i][k] = low[k] + (high[k] - low[k]) * (double)(seed >> 11) * 0x1p-53;
        }
    (void)p, (void)side, (void)g;
    for (int round = 0; round < %(rounds)d; round++) {
        const double begun = seconds_now();
        for (long i = 0; i < %(count)d; i++) {
            const double *at = x[i %% %(states)d];
            (void)at;
            %(call)s
            sum += %(sum)s;
        }
        best = fmin(best, seconds_now() - begun);
    }
    printf("%%.17g %%.17g\\n", 1e9 * best / %(count)d, sum);
    return 0;
}
"""


def contact(law: Law) -> str:
    """Return the YAML text of a contact with the law; friction and mixed laws get the other laws that they need."""
    keys = "".join(f", {name}: {value!r}" for name, value in list_default_parameters(law).items())
    below = "normal: {law: hertz, stiffness: 1e9}, " if law.role in ("friction", "mixed") else ""
    below += "film: {law: ocvirk, viscosity: 0.1}, " if law.role == "mixed" else ""
    return f"{below}{law.role}: {{law: {law.name}{keys}}}"


def scene(law: Law) -> bytes:
    """Return a mechanism file of a journal in its bearing, with the law."""
    return SCENE.format(contact=contact(law)).encode()


def call_of(program: Program, law: Law) -> tuple[str, list[str]]:
    """Return the call in C with arguments from `at`, and the names of these variables."""
    pin = program.joints[0]
    if law.role == "mixed":
        return f"const double delta = at[0];\n{print_statements(pin.blend)}\nout[0] = share;", ["delta"]
    own: SharedFunctionCall = pin.laws[law.role]
    names = [a.name for a in own.kernel.arguments if a.name in law.variables]
    results = [f"&out[{k}]" for k in range(len(law.results))]
    return print_shared_call(own, [f"at[{k}]" for k in range(len(names))], results), names


def harness(call: str, names: list[str], results: int, slots: int) -> str:
    """Return the C program that times a call and prints ns, then the sum of its results."""
    low, high = (", ".join(repr(DRAWN.get(name, DRAWN["z"])[k]) for name in names) for k in (0, 1))
    return HARNESS % {
        "low": low,
        "high": high,
        "states": STATES,
        "width": len(names),
        "slots": max(slots, 1),
        "rounds": ROUNDS,
        "count": COUNT,
        "call": call,
        "sum": " + ".join(f"out[{k}]" for k in range(results)),
    }


def timed(law: Law, folder: Path) -> tuple[float, float]:
    """Return the ns of one evaluation, and of the loop without it. Raises RuntimeError for non-finite results."""
    model = derive_scene(scene(law), f"{law.name}.yaml", "alone")
    source, program = generate_c(model), make_program(model)
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    call, names = call_of(program, law)
    found = []
    for what, results in ((call, len(law.results)), ("out[0] = at[0];", 1)):
        (folder / "time.c").write_text(harness(what, names, results, len(source.slots)), encoding="utf-8")
        message = [
            *find_compiler(),
            *build_flags(portable=False),
            *build_include_flags(),
            "time.c",
            "-lm",
            "-o",
            "time",
        ]
        subprocess.run(message, cwd=folder, check=True, capture_output=True, text=True)
        done = subprocess.run([str(folder / "time")], check=True, capture_output=True, text=True)
        spent, total = map(float, done.stdout.split())
        if not math.isfinite(total):
            raise RuntimeError(f"{law.name}: no finite number is computed")
        found.append(spent)
    return found[0], found[1]


def has_function(law: Law) -> bool:
    """Return whether the law has a function: rigid contacts have none."""
    return not law.rigid


def lines(names: list[str]) -> Iterator[str]:
    """Yield the lines of the table by role."""
    yield f"  {'role':<9}{'law':<24}{'ns':>7}{'nothing':>9}"
    some = [law for law in find_bundled_laws().values() if (not names or law.name in names) and has_function(law)]
    for law in sorted(some, key=lambda one: ([*RESULTS].index(one.role), one.name)):
        with tempfile.TemporaryDirectory() as folder:
            own, nothing = timed(law, Path(folder))
        yield f"  {law.role:<9}{law.name:<24}{own:7.1f}{nothing:9.1f}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="laws; all, if none is named")
    for line in lines(parser.parse_args().names):
        print(line, flush=True)
