"""Events: what a file's and a scene's entries become, and the values that the emitted dynamics gives them."""

from __future__ import annotations

import json
import subprocess
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from gudgeon.contract.kernel_source import EventInfo, KernelSource
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.generator.pipeline import derive_scene, generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.latex import render_equations_text
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags, parse_sizes

SLIDER = resources.files("gudgeon.mechanisms").joinpath("slider_crank.yaml").read_text(encoding="utf-8")
EVENTS = """
events:
  reach: {zero: crank.head.x - 2 * c, direction: rising}
  lift: {zero: rod.head.vy - 3 m/s + slider.y / (t + 1 s)}
  corner: {zero: abs(rod.theta) - 0.3 * crank.omega / omega, direction: falling, action: stop}
"""
IN_SCENE = "events: {reach: {zero: t - 1}, late: {zero: t - 2 s, action: stop}}\n    simulate: {t_end: 0.2 s,"


def file(events: str = EVENTS, in_scene: str = "simulate: {t_end: 0.2 s,") -> bytes:
    text = SLIDER.replace("simulate: {t_end: 0.2 s,", in_scene)
    assert in_scene in text
    return (text + events).encode()


def test_a_scene_has_the_events_of_the_file_and_its_own() -> None:
    further = b"  further: {extends: dry, events: {lift: {zero: t}}}\n\noutputs:"
    data = file(in_scene=IN_SCENE).replace(b"\noutputs:", further)
    scenes = read_mechanism(data, "slider.yaml").scenes
    assert list(scenes["ideal"].events) == ["reach", "lift", "corner"]
    assert list(scenes["dry"].events) == ["reach", "lift", "corner", "late"]
    addresses = [event.zero.address for event in scenes["further"].events.values()]
    assert addresses == [
        "scenes.dry.events.reach.zero",
        "scenes.further.events.lift.zero",
        "events.corner.zero",
        "scenes.dry.events.late.zero",
    ]
    words = [(event.direction, event.action) for event in scenes["further"].events.values()]
    assert words == [("both", "record"), ("both", "record"), ("falling", "stop"), ("both", "stop")]


def test_an_override_changes_an_event_and_makes_none() -> None:
    mechanism = read_mechanism(file(), "slider.yaml", {"events.corner.action": "record"})
    assert mechanism.scenes["ideal"].events["corner"].action == "record"
    with pytest.raises(UnknownNameError, match="unknown address"):
        read_mechanism(file(), "slider.yaml", {"events.other.zero": "t"})


def test_the_runtime_is_told() -> None:
    source = generate_kernel_source(file(), "slider.yaml", "dry")
    assert source.events == (
        EventInfo("reach", "record", "rising"),
        EventInfo("lift", "record", "both"),
        EventInfo("corner", "stop", "falling"),
    )
    assert KernelSource.from_json(source.to_json()) == source
    older = {key: value for key, value in json.loads(source.to_json()).items() if key != "events"}
    assert KernelSource.from_json(json.dumps(older)) == replace(source, events=())


def test_terms_that_cancel_are_refused_at_their_place() -> None:
    data = file("events: {still: {zero: crank.x - crank.x + c}}\n")
    with pytest.raises(BadValueError, match="never changes: its terms cancel") as caught:
        derive_scene(data, "slider.yaml", "ideal")
    assert caught.value.where is not None and caught.value.where.column == len("events: {still: {zero: ") + 1


def test_a_scene_without_events_has_no_code_for_them() -> None:
    source = generate_kernel_source(file(""), "slider.yaml", "ideal")
    assert parse_sizes(source)["N_USER_EVENTS"] == 0 and "watched.c" not in source.files
    assert not any("event[" in text for text in source.files.values())


DRIVER = """\
#include <stdio.h>
#include "scene.c"
#include "engine/engine.c"
int main(void)
{
    static double given[1000];
    static unsigned char is_given[1000];
    Parameters p;
    double t, q[N_Q], v[N_Q], a[N_Q];
    RhsOutputs rhs;
    gudgeon_prepare(given, is_given, (double *)&p);
    while (scanf("%lf", &t) == 1) {
        for (int k = 0; k < 2 * N_Q; k++)
            if (scanf("%lf", k < N_Q ? &q[k] : &v[k - N_Q]) != 1)
                return 1;
        (void)dynamics(t, q, v, &(DiscreteState){0}, &p, a, &rhs);
        for (int i = 0; i < N_USER_EVENTS; i++)
            printf("%.17g ", rhs.event[i]);
    }
    return 0;
}
"""


def values(source: KernelSource, driver: str, states: np.ndarray, folder: Path) -> np.ndarray:
    """What a driver prints of states (N, …) that it reads."""
    for name, text in {**source.files, "driver.c": driver}.items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [*find_compiler(), "-std=c11", "-O0", *build_include_flags(), "driver.c", "-o", "driver", "-lm"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    text = "\n".join(" ".join(f"{x:.17g}" for x in state) for state in states)
    done = subprocess.run(["./driver"], cwd=folder, input=text, check=True, capture_output=True, text=True)
    return np.array(done.stdout.split(), dtype=float)


IN_TREE = DRIVER.replace("N_Q; k++", "N_X; k++").replace("k < N_Q", "k < N_X").replace("k - N_Q", "k - N_X")
BOTH = """\
        RhsOutputs tree;
        double all_q[N_Q], all_v[N_Q];
        expand(t, q, v, &p, all_q, all_v);
        (void)dynamics(t, all_q, all_v, &(DiscreteState){0}, &p, a, &rhs);
        (void)reduced_dynamics(t, q, v, &(DiscreteState){0}, &p, a, &tree);
        for (int i = 0; i < N_USER_EVENTS; i++)
            printf("%.17g %.17g ", rhs.event[i], tree.event[i]);
    }
"""


def test_both_formulations_agree(tmp_path: Path) -> None:
    """At random places of the tree, corners in the same order."""
    source = generate_kernel_source(file(), "slider.yaml", "dry")
    driver = IN_TREE[: IN_TREE.index("        (void)dynamics")] + BOTH + "    return 0;\n}\n"
    states = np.random.default_rng(5).uniform(-1.0, 1.0, (20, 1 + 2 * len(source.tree_coordinates)))
    states[:, 0] += 1.5  # t
    found = values(source, driver, states, tmp_path).reshape(20, 3, 2)
    np.testing.assert_allclose(found[..., 1], found[..., 0], rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("scene", ["ideal", "dry"])
def test_values_at_random_states(scene: str, tmp_path: Path) -> None:
    """Against the same expressions written by hand; the bars are 50 and 120 mm long, c is 0.2 mm, ω 20π rad/s."""
    states = np.random.default_rng(4).uniform(-1.0, 1.0, (20, 19))
    states[:, 0] += 1.5  # t
    t, q, v = states[:, 0], states[:, 1:10].T, states[:, 10:].T
    expected = [
        q[0] + 0.025 * np.cos(q[2]) - 2 * 0.2e-3,
        v[4] + v[5] * 0.06 * np.cos(q[5]) - 3.0 + q[7] / (t + 1.0),
        np.abs(q[5]) - 0.3 * v[2] / (20 * np.pi),
    ]
    found = values(generate_kernel_source(file(), "slider.yaml", scene), DRIVER, states, tmp_path).reshape(20, 3)
    np.testing.assert_allclose(found, np.transpose(expected), rtol=1e-13, atol=1e-14)


def test_written_equations_hold_them() -> None:
    text = render_equations_text(derive_scene(file(), "slider.yaml", "ideal"))
    assert "corner: when this expression falls through zero, the run ends:" in text
    assert "z_reach = " in text and "lift: when this expression crosses zero, the time is recorded:" in text
