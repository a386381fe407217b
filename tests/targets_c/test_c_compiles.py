"""The emitted C: no warning under gcc and clang, clean under the address and undefined-behaviour sanitizers."""

from __future__ import annotations

import platform
import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from cffi import FFI

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.loading.engine import build_include_flags, parse_sizes, select_declarations
from gudgeon.loading.shipped import find_shipped_file, list_generated_scenes
from tests.slow import slow_but

METHODS, VALID = (Path(__file__).parents[1] / "mechanisms" / folder for folder in ("methods", "valid"))
FLAGS = ["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", *build_include_flags()]
WIDTHS = ([], ["-mavx2"], ["-mavx512f"]) if platform.machine() in ("x86_64", "AMD64") else ([],)  # 2, 4, 8 lanes
COMPILERS = [name for name in ("gcc", "clang") if shutil.which(name)]
SCENES = [
    (name, scene)
    for name in list_generated_scenes()
    for scene in read_mechanism(find_shipped_file(name).read_bytes(), name, None).scenes
]
WIDEST = ("nine_bar_press", "lubricated")  # under every width of vectors; the others under the first
# Friction, a motion without freedom; and under the sanitizers play and what hangs on a driven chain.
TYPICAL = ("belt_block", "ideal"), ("four_bar", "ideal")

# Reads p, then t, q, v of a start; prints how a short run went. The scene is included, not linked.
INTEGRATE = r"""
#include <stdio.h>
static int go(const double *p, const double *y)
{
    void *run = calloc(1, gudgeon_run_size());
    const double t[2] = {0.0, 4000 * STEP};
    double latched[2 * (N_CLEARANCES + N_FRICTIONS + 1)], now[2 * N_S], numbers[N_IMPACT_COLUMNS * MAX_LISTED];
    signed char state[2 * (N_CLEARANCES + 1)];
    int joints[MAX_LISTED], status = 0;
    long done = 0;
    for (int i = 0; i <= N_CLEARANCES + N_FRICTIONS; i++)
        latched[i] = NAN;
    double scale[2 * N_X], least[2] = {1e-4, 1e-3};
    for (int k = 0; k < 2 * N_X; k++)
        scale[k] = 1e-8;
    gudgeon_run_start(run, p, 0.0, y, latched);
    gudgeon_adaptive_setup(run, gudgeon_method("rk4"), 0, scale, least, STEP);
    while (done < 2 && !status) {
        status = gudgeon_adaptive_run(run, p, 2, t, 4000, now, latched, state, &done);
        if (status == EVENTS_FULL)
            status = gudgeon_run_impacts(run, 0, MAX_LISTED, numbers, joints) < 0;
    }
    gudgeon_run_impacts(run, 1, MAX_LISTED, numbers, joints);
    gudgeon_run_sample(run, p, now, latched, state);
    free(run);
    return status;
}
"""
FOLLOW = r"""
#include <stdio.h>
static int go(const double *p, const double *y)
{
    double t[101], q[101 * N_Q], v[101 * N_Q], a[101 * N_Q], work[101 * N_WORK] = {0.0}, phi = 0.0, phi_dot = 0.0;
    long steps = 0, done = 0;
    static KinematicRun course;
    for (int i = 0; i <= 100; i++)
        t[i] = 0.01 * i;
    for (int k = 0; k < N_Q; k++) {
        q[k] = y[k];
        v[k] = y[N_Q + k];
    }
    gudgeon_kinematic_begin(&course, 0.05, 0.1, t[100], NULL, NULL, 0.0);
    const int status = gudgeon_kinematic(&course, 100, t, p, q, v, a, &phi, &phi_dot, &steps, &done);
    return status ? status : gudgeon_kinematic_works(&course, 100, t, p, q, v, work, &done);
}
"""
MAIN = r"""
int main(int argc, char **argv)
{
    static double p[sizeof(Parameters) / sizeof(double)], y[N_S];
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    if (!file || fread(p, sizeof p, 1, file) != 1 || fread(y, sizeof y, 1, file) != 1)
        return 99;
    fclose(file);
    return go(p, y);
}
"""


WHOLE = '#include "scene.c"\n#include "engine/engine.c"\n'


def write(source: KernelSource, folder: Path) -> Path:
    for name, text in source.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / source.main


def compile_c(compiler: str, file: Path, flags: Sequence[str], libraries: Sequence[str] = ()) -> None:
    done = subprocess.run([compiler, *flags, file.name, *libraries], cwd=file.parent, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:4000]


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("of", slow_but(TYPICAL, SCENES), ids="-".join)
def test_no_warning(compiler: str, of: tuple[str, str], tmp_path: Path) -> None:
    source = gudgeon.load(*of).source
    main = write(source, tmp_path)
    for part in ("0", *map(str, source.compilation_units)):
        compile_c(compiler, main, [*FLAGS, f"-DPART={part}", "-c", "-o", "scene.o"])
    engine = ["-Wshadow", "-Wconversion", "-Wmissing-prototypes"]
    (tmp_path / "loops.c").write_text('#include "engine/engine.c"\n', encoding="utf-8")
    compile_c(compiler, tmp_path / "loops.c", [*FLAGS, *engine, "-c", "-o", "loops.o"])
    if source.lane_file:
        for width in WIDTHS if of == WIDEST else WIDTHS[:1]:
            compile_c(compiler, tmp_path / source.lane_file, [*FLAGS, *width, "-c", "-o", "lanes.o"])


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_no_warning_about_any_shipped_scene(name: str, scene: str, tmp_path: Path) -> None:
    """Of what one compiler sees without optimizing."""
    source = gudgeon.load(name, scene).source
    main = write(source, tmp_path)
    for file in (main, *([tmp_path / source.lane_file] if source.lane_file else [])):
        compile_c(COMPILERS[0], file, [*FLAGS, "-fsyntax-only"])


@pytest.mark.parametrize(
    ("name", "scene"),
    [
        ("slider_crank", "ideal"),
        ("slider_crank", "dry"),
        ("belt_block", "ideal"),
        *(
            pytest.param(*scene, marks=pytest.mark.slow)
            for scene in (("nine_bar_press", "ideal"), ("nine_bar_press", "lubricated"), ("andrews_squeezer", "ideal"))
        ),
    ],
)
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_declarations_are_what_the_scene_defines(name: str, scene: str, formulation: str, tmp_path: Path) -> None:
    """Python sees only what cffi is told: prototypes and structs must be the library's."""
    file = find_shipped_file(name)
    source = generate_kernel_source(file.read_bytes(), file.name, scene, None, formulation)
    write(source, tmp_path)
    ffi = FFI()
    calls = select_declarations(source)
    ffi.cdef(calls)
    structs = re.findall(r"^} (\w+);", calls, re.MULTILINE)
    same = []
    for struct in structs:
        fields = [field for field, _ in ffi.typeof(struct).fields]
        same += [f'_Static_assert(offsetof({struct}, {f}) == offsetof(told_{struct}, {f}), "{f}");' for f in fields]
        same.append(f'_Static_assert(sizeof({struct}) == sizeof(told_{struct}), "{struct}");')
    names = [*structs, *re.findall(r"\bgudgeon_\w+(?=\()", calls)]  # defined again under other names
    message = "".join(f"#define {x} told_{x}\n" for x in names) + calls + "".join(f"#undef {x}\n" for x in names)
    (tmp_path / "both.c").write_text(WHOLE + message + "\n".join(same) + "\n", encoding="utf-8")
    compile_c(COMPILERS[0], tmp_path / "both.c", [*FLAGS, "-fsyntax-only"])


# Structure that no shipped scene has: each option of each law once.
OPTIONS: dict[str, dict[str, str | float | bool]] = {
    "as printed": {
        "contacts.wet.film.as_printed": True,
        "contacts.wet.film.shear": False,
        "contacts.wet.clip_ratio": False,
    },
    "internal, shear, relative, clipped": {},  # as it is
}


@pytest.mark.parametrize("option", slow_but(["as printed"], OPTIONS))  # test_whole_format compiles it as it is
def test_no_warning_under_any_option(option: str, tmp_path: Path) -> None:
    file = VALID / "slider_crank.yaml"
    source = generate_kernel_source(file.read_bytes(), file.name, "oiled", OPTIONS[option])
    main = write(source, tmp_path)
    compile_c(COMPILERS[0], main, [*FLAGS, "-c", "-o", "scene.o"])
    assert source.lane_file
    for width in WIDTHS[:1]:
        compile_c(COMPILERS[0], tmp_path / source.lane_file, [*FLAGS, *width, "-c", "-o", "lanes.o"])


def test_no_warning_where_there_is_taylors_method(tmp_path: Path) -> None:
    """Which shipped scenes have only when it is asked for."""
    file = METHODS / "swing.yaml"
    source = generate_kernel_source(file.read_bytes(), file.name, "ideal", None, "taylor")
    compile_c(COMPILERS[0], write(source, tmp_path), [*FLAGS, "-c", "-o", "scene.o"])
    for width in WIDTHS:
        compile_c(COMPILERS[0], tmp_path / source.lane_file, [*FLAGS, *width, "-c", "-o", "lanes.o"])


@pytest.mark.parametrize("of", slow_but((WIDEST, *TYPICAL), SCENES), ids="-".join)
def test_clean_under_the_sanitizers(of: tuple[str, str], tmp_path: Path) -> None:
    simulation = gudgeon.load(*of)
    start = simulation.start()
    state = np.concatenate([simulation.p, start.q, start.v, np.zeros(3)])
    (tmp_path / "start.bin").write_bytes(state.tobytes())
    write(simulation.source, tmp_path)
    go = INTEGRATE if parse_sizes(simulation.source)["INTEGRATES"] else FOLLOW
    driver = tmp_path / "driver.c"
    driver.write_text(f"{WHOLE}#define STEP 2e-6\n{go}{MAIN}", encoding="utf-8")
    sanitize = ["-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"]
    probe = tmp_path / "probe.c"
    probe.write_text("int main(void) { return 0; }\n")
    if subprocess.run(["gcc", *sanitize, "probe.c", "-o", "probe"], cwd=tmp_path, capture_output=True).returncode:
        pytest.skip("this compiler has no sanitizer libraries")
    compile_c("gcc", driver, [*FLAGS, *sanitize, "-o", "driver"], ["-lm"])
    done = subprocess.run(["./driver", "start.bin"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:4000]
