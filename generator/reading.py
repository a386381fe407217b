"""The first stages, which import no SymPy: YAML → Mechanism → Scene, and what of its C can be foreseen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter

from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism.scene import Scene, make_scene
from gudgeon.generator.reader.read import read_mechanism

Overrides = Mapping[str, str | float | bool]
Seconds = dict[str, float]


def read_scene(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Scene:
    """One scene of a mechanism file."""
    with stage("reading", seconds):
        return make_scene(read_mechanism(data, file, overrides), scene)


def counted_freedoms(scene: Scene) -> int:
    """3 bodies − rows (M. Grübler, Civilingenieur 29, 1883), drives among the rows; play opens two of a joint."""
    mechanism, rows = scene.mechanism, {kind: len(joint.row_names) for kind, joint in joint_types().items()}
    held = sum(rows[joint.kind] for joint in mechanism.joints.values()) + len(mechanism.drives)
    return 3 * len(mechanism.bodies) - held + 2 * len(scene.play)


def has_loops(scene: Scene) -> bool:
    """Whether rows are left when every body hangs on another by the joints that are closed."""
    kinds = joint_types()
    closed = [kinds[joint.kind] for name, joint in scene.mechanism.joints.items() if name not in scene.play]
    return len(closed) > len(scene.mechanism.bodies) or not all(kind.carries for kind in closed)


@contextmanager
def stage(name: str, seconds: Seconds | None) -> Iterator[None]:
    """A stage of the compiler, which notes how long it took where somebody wants to know."""
    begun = perf_counter()
    yield
    if seconds is not None:
        seconds[name] = perf_counter() - begun
