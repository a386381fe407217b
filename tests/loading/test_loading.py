"""Names and files, the model's key, and where a kernel source comes from."""

from __future__ import annotations

import lzma
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, LimitError, UnknownNameError
from gudgeon.files.reading import MAX_BYTES
from gudgeon.loading import shipped
from gudgeon.loading.cache import Cache
from gudgeon.loading.generated_scenes import ARCHIVE, read_scene, read_scenes, write_scenes
from gudgeon.loading.kernel_sources import (
    compute_generator_hash,
    compute_model_key,
    derive_kernel_source,
    find_kernel_source,
    find_mechanism,
    read_bytes,
)
from gudgeon.loading.shipped import PACKAGE, find_shipped_file
from tests.tiny import tiny

DATA = b"name: tiny\n"
READABLE = ("tiny.c",)


@pytest.fixture
def generator(monkeypatch: pytest.MonkeyPatch) -> list[tuple[bytes, str, str, Mapping[str, object]]]:
    """Stands in for the generator: what it was asked for is kept, the answer is tiny()."""
    requested: list[tuple[bytes, str, str, Mapping[str, object]]] = []

    def read_scene(
        data: bytes, file: str, scene: str, overrides: Mapping[str, object], seconds: object
    ) -> SimpleNamespace:
        requested.append((data, file, scene, overrides))
        return SimpleNamespace(scene=scene, sha256=sha256(data).hexdigest(), mechanism=SimpleNamespace(bodies={}))

    def generate_c(read: SimpleNamespace, formulation: str, seconds: object, begun: object) -> KernelSource:
        return tiny(scene=read.scene, sha256=read.sha256)

    stands_in: dict[str, dict[str, Any]] = {
        "reader.read": {"read_scene": read_scene, "overrides_change_scene": lambda *_: True},
        "pipeline": {"derive_equations": lambda read, seconds: read, "generate_c": generate_c},
    }
    for name, functions in stands_in.items():
        module = ModuleType(f"gudgeon.generator.{name}")
        vars(module).update(functions)
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return requested


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


@pytest.fixture
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder of committed kernels with those of tiny/ideal, made from DATA; its title tells it apart."""
    monkeypatch.setattr(shipped, "GENERATED", tmp_path / "generated")
    source = tiny(title="committed", sha256=sha256(DATA).hexdigest())
    write_scenes(tmp_path / "generated" / "tiny", [source], READABLE)


# which file


def test_a_name_is_shipped_and_a_path_is_a_path(tmp_path: Path) -> None:
    assert find_mechanism("nine_bar_press").name == "nine_bar_press.yaml"
    assert find_mechanism("mine.yaml") == Path("mine.yaml")
    assert find_mechanism("folder/mine") == Path("folder/mine")
    assert find_mechanism(tmp_path / "mine") == tmp_path / "mine"


def test_an_unknown_name_is_told_the_nearest_and_all() -> None:
    with pytest.raises(
        UnknownNameError, match=r"(?s)did you mean 'nine_bar_press'\?.*there are: .*nine_bar_press"
    ) as e:
        find_shipped_file("nine_bar_pres")
    assert e.value.exit_code == 2


def test_a_name_never_leaves_the_folder() -> None:
    with pytest.raises(UnknownNameError):
        find_shipped_file("../mechanisms/nine_bar_press")


def test_a_file_that_cannot_be_read_is_bad_input(tmp_path: Path) -> None:
    for path in (tmp_path / "absent.yaml", tmp_path):
        with pytest.raises(InputError, match="cannot read"):
            read_bytes(path)


@pytest.mark.parametrize("what", ["/dev/zero", "pipe", "socket", "/proc/self/fd", "sparse", "endless", "zero byte"])
def test_only_regular_files_within_a_limit_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str) -> None:
    """Nothing that has no end or keeps us waiting is opened, and a large file is refused before it is read."""
    path = Path(what) if what.startswith("/") else tmp_path / "x.yaml"
    if what == "pipe":
        os.mkfifo(path)
    elif what == "socket":
        monkeypatch.chdir(tmp_path)  # a socket's path is short
        socket.socket(socket.AF_UNIX).bind(path.name)
    elif what == "sparse":
        path.touch()
        os.truncate(path, 1 << 40)
    elif what == "endless":  # a regular file that says that it is empty, as those of /proc do
        path.write_bytes(bytes(MAX_BYTES + 2))
        real, found = os.fstat, os.stat(path)
        empty = os.stat_result([*found[:6], 0, *found[7:10]])
        monkeypatch.setattr(os, "fstat", lambda fd: empty if real(fd).st_ino == found.st_ino else real(fd))
    elif what == "zero byte":
        path = tmp_path / "x\0.yaml"
    opened: list[str] = []
    real_open = os.open

    def watched(path: str, *args: Any, **kwargs: Any) -> int:
        opened.append(str(path))
        return real_open(path, *args, **kwargs)

    monkeypatch.setattr(os, "open", watched)
    with pytest.raises(LimitError if what in ("sparse", "endless") else InputError) as caught:
        read_bytes(path)
    assert caught.value.exit_code == 2
    assert not opened or what in ("sparse", "endless", "zero byte")


def test_a_pipe_in_place_of_a_file_is_refused(tmp_path: Path) -> None:
    """As bash makes one: gudgeon check <(cat x.yaml). A file is read more than once."""
    reading, writing = os.pipe()
    try:
        with pytest.raises(InputError, match="(?s)a pipe.*to a file first"):
            read_bytes(Path(f"/dev/fd/{reading}"))
    finally:
        os.close(reading)
        os.close(writing)


# the key


def test_the_key_changes_with_every_question() -> None:
    base = compute_model_key(DATA, "dry", {"a": 1.0}, "full")
    others = [
        compute_model_key(DATA + b" ", "dry", {"a": 1.0}, "full"),
        compute_model_key(DATA, "wet", {"a": 1.0}, "full"),
        compute_model_key(DATA, "dry", {"a": 2.0}, "full"),
        compute_model_key(DATA, "dry", {"a": "1.0"}, "full"),
        compute_model_key(DATA, "dry", {"b": 1.0}, "full"),
        compute_model_key(DATA, "dry", {}, "full"),
        compute_model_key(DATA, "dry", {"a": 1.0}, "reduced"),
    ]
    assert len({base, *others}) == 1 + len(others)


def test_the_order_of_overrides_does_not_matter() -> None:
    assert compute_model_key(DATA, "dry", {"a": 1.0, "b": 2.0}, "full") == compute_model_key(
        DATA, "dry", {"b": 2.0, "a": 1.0}, "full"
    )


def test_overrides_that_a_scene_does_not_read_derive_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another scene's law; and what is derived with them would be the same to the byte."""
    file = find_mechanism("nine_bar_press")
    data, law = read_bytes(file), {"contacts.oil.film.as_printed": "true"}
    plainly = derive_kernel_source(data, file, "dry", law)
    with monkeypatch.context() as patched:
        patched.setattr(
            "gudgeon.loading.kernel_sources.derive_kernel_source", lambda *_, **__: pytest.fail("it was derived")
        )
        source, origin = find_kernel_source(data, file, "dry", overrides=law, cache=Cache(tmp_path))
        assert origin == "generated" and source.overrides == tuple(sorted(law.items()))
        assert replace(source, overrides=()) == plainly
        with pytest.raises(pytest.fail.Exception, match="it was derived"):
            find_kernel_source(data, file, "lubricated", overrides=law, cache=Cache(tmp_path))


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A copy of what the generator's hash reads."""
    copy = tmp_path / "gudgeon"
    for name in ("generator", "templates", "language", "contract"):
        shutil.copytree(PACKAGE / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def test_a_byte_of_generator_or_template_changes_the_key(package: Path) -> None:
    base = compute_generator_hash(package)
    assert base == compute_generator_hash()
    files = [*package.joinpath("generator").rglob("*.py"), *package.rglob("*.jinja")]
    files += [*package.joinpath("language").glob("*.py"), *package.joinpath("contract").glob("*.py")]
    assert len(files) > 10
    for path in files:
        text = path.read_bytes()
        path.write_bytes(text + b"\n")
        assert compute_generator_hash(package) != base, path
        path.write_bytes(text)
    first = next(package.rglob("*.jinja"))
    first.rename(first.with_name("renamed.jinja"))
    assert compute_generator_hash(package) != base


def test_what_the_generator_does_not_read_leaves_the_key(package: Path) -> None:
    base = compute_generator_hash(package)
    (package / "generator" / "__pycache__").mkdir()
    (package / "generator" / "__pycache__" / "x.cpython-311.pyc").write_bytes(b"x")
    (package / "generator" / "notes.txt").write_text("x")
    for path in package.rglob("*.py"):
        path.touch()
    assert compute_generator_hash(package) == base


def test_an_installation_without_mechanisms_says_that_it_is_not_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gudgeon.loading.shipped.list_shipped_mechanisms", lambda: ())
    with pytest.raises(InputError, match=r"incomplete.*\n.*make run"):
        find_shipped_file("four_bar")


# where it comes from


def test_derived_once_then_from_the_cache(cache: Cache, generator: list[object], kept: None) -> None:
    first = find_kernel_source(b"other", Path("other.yaml"), "dry", overrides={"a": 1.0}, cache=cache)
    again = find_kernel_source(b"other", Path("other.yaml"), "dry", overrides={"a": 1.0}, cache=cache)
    assert (first[1], again[1]) == ("derived", "cache")
    assert first[0] == again[0]
    assert generator == [(b"other", "other.yaml", "dry", {"a": 1.0})]


def test_the_scene_by_default_is_ideal(cache: Cache, generator: list[object]) -> None:
    assert find_kernel_source(DATA, Path("x.yaml"), cache=cache)[0].scene == "ideal"


def test_committed_kernels_need_no_generator(cache: Cache, generator: list[object], kept: None) -> None:
    source, origin = find_kernel_source(DATA, Path("tiny.yaml"), cache=cache)
    assert (source.title, origin, generator) == ("committed", "generated", [])


@pytest.mark.parametrize(
    ("data", "scene", "requested"),
    [
        (DATA + b"#", "ideal", {}),  # another file
        (DATA, "dry", {}),  # a scene that is not there
        (DATA, "../tiny/ideal", {}),  # a name that walks
        (DATA, "ideal", {"overrides": {"a": 1.0}}),
        (DATA, "ideal", {"regenerate": True}),
    ],
)
def test_committed_kernels_are_for_exactly_what_they_were_made_from(
    cache: Cache, generator: list[object], kept: None, data: bytes, scene: str, requested: dict[str, object]
) -> None:
    _, origin = find_kernel_source(data, Path("tiny.yaml"), scene, cache=cache, **requested)  # type: ignore[arg-type]
    assert (origin, len(generator)) == ("derived", 1)


def test_regenerate_replaces_what_the_cache_has(cache: Cache, generator: list[object]) -> None:
    for _ in range(2):
        assert find_kernel_source(DATA, Path("x.yaml"), cache=cache, regenerate=True)[1] == "derived"
    assert len(generator) == 2
    assert find_kernel_source(DATA, Path("x.yaml"), cache=cache)[1] == "cache"


def test_an_unknown_formulation_is_bad_input(cache: Cache) -> None:
    with pytest.raises(BadValueError, match="formulation"):
        find_kernel_source(DATA, Path("x.yaml"), formulation="minimal", cache=cache)


# the committed form


def test_written_and_read_back(tmp_path: Path) -> None:
    sources = [tiny(title="Gelenk über Öl", simulate={"t_end": 1.0}), tiny(scene="dry")]
    write_scenes(tmp_path, sources, READABLE)
    assert read_scenes(tmp_path) == sources


def test_a_text_is_stored_once_and_as_a_file_where_a_person_reads_it(tmp_path: Path) -> None:
    texts = {**tiny().files, "model.h": "/* ideal */\n", "lanes.c": "/* vectors */\n"}
    sources = [tiny(files=texts), tiny(scene="dry", files={**texts, "model.h": "/* dry */\n"})]
    write_scenes(tmp_path, sources, (*READABLE, "model.h"))
    files = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file())
    assert files == [ARCHIVE, "dry/model.h", "ideal/model.h", "ideal/tiny.c"]
    assert read_scenes(tmp_path) == sources


def test_written_twice_is_the_same_bytes_and_nothing_stays(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    write_scenes(one, [tiny()], READABLE)
    write_scenes(two, [tiny(files={**tiny().files, "old.h": ""}), tiny(scene="old")], (*READABLE, "old.h"))
    write_scenes(two, [tiny()], READABLE)

    def contents(folder: Path) -> dict[str, bytes]:
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    assert contents(one) == contents(two)


def test_an_archive_of_another_compressor_is_left_as_it_is(tmp_path: Path) -> None:
    """Versions of liblzma write other bytes: a commit changes with the contents alone."""
    write_scenes(tmp_path, [tiny()], READABLE)
    path = tmp_path / ARCHIVE
    other = lzma.compress(lzma.decompress(path.read_bytes()), check=lzma.CHECK_CRC32)
    path.write_bytes(other)
    write_scenes(tmp_path, [tiny()], READABLE)
    assert path.read_bytes() == other
    write_scenes(tmp_path, [tiny(title="another")], READABLE)
    assert path.read_bytes() != other


def test_damaged_committed_kernels_count_as_none(tmp_path: Path) -> None:
    assert read_scene(tmp_path / "absent", "ideal") is None
    write_scenes(tmp_path, [tiny()], READABLE)
    path = tmp_path / ARCHIVE
    whole = path.read_bytes()
    for damaged in (b"", whole[:-20], b"{" + whole, lzma.compress(b"{"), lzma.compress(b"[]")):
        path.write_bytes(damaged)
        assert read_scene(tmp_path, "ideal") is None
    text = lzma.decompress(whole)
    unknown = text.replace(rb"\"title\"", rb"\"titel\"")  # a field that this version does not know
    assert unknown != text
    path.write_bytes(lzma.compress(unknown))
    assert read_scene(tmp_path, "ideal") is None
    path.write_bytes(whole)
    assert read_scene(tmp_path, "ideal") == tiny() and read_scene(tmp_path, "dry") is None
    (tmp_path / "ideal" / "tiny.c").unlink()
    assert read_scene(tmp_path, "ideal") is None


def test_a_stored_source_of_another_version_is_made_anew(
    cache: Cache, generator: list[object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The hash of kernel_source.py is in the key, so the same key never holds another version's form."""
    find_kernel_source(DATA, Path("x.yaml"), cache=cache)
    monkeypatch.setattr("gudgeon.loading.kernel_sources.compute_generator_hash", lambda: "another")
    assert find_kernel_source(DATA, Path("x.yaml"), cache=cache)[1] == "derived"


# the front door


def test_every_public_name_is_there() -> None:
    missing = [name for name in gudgeon.__all__ if name not in ("Simulation", "Result") and not hasattr(gudgeon, name)]
    assert missing == []
    assert set(gudgeon.__all__) <= set(dir(gudgeon))
    with pytest.raises(AttributeError, match="no attribute 'lod'"):
        gudgeon.lod  # noqa: B018


def test_importing_gudgeon_imports_nothing_else() -> None:
    code = "import sys; import gudgeon; print(*sys.modules)"
    out = subprocess.run(
        [sys.executable, "-S", "-c", code],
        text=True,
        capture_output=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ).stdout
    heavy = {"typing", "numpy", "json", "pathlib", "gudgeon.errors", "gudgeon.loading.kernel_sources", "sympy"}
    assert heavy & set(out.split()) == set()


def test_a_name_is_never_hidden_by_a_module() -> None:
    """`import gudgeon.load` would put a module where the function is, if there were one."""
    for name in gudgeon.__all__:
        assert not (PACKAGE / f"{name}.py").exists(), name


def test_replace_keeps_the_tiny_source_a_kernel_source() -> None:
    assert KernelSource.from_json(tiny().to_json()) == replace(tiny())


def test_a_ramp_before_a_body_that_must_follow_is_noted(tmp_path: Path) -> None:
    text = """
format: gudgeon/1
name: arm
bodies: {A: {length: 1 m, mass: 1 kg, inertia: 0.1}, B: {length: 1 m, mass: 1 kg, inertia: 0.1}}
ground: {O: [0, 0]}
joints: {H: {revolute: [ground.O, A.tail]}, K: {revolute: [A.head, B.tail]}}
drives: {m: {angle: A, value: "STEP(t, 0.1 s, 1 s) * 90 deg"}}
"""
    noted = {}
    for step in ("ramp", "smooth_step"):
        file = tmp_path / f"{step}.yaml"
        file.write_text(text.replace("STEP", step))
        noted[step] = any("may jump" in note for note in gudgeon.load(file).source.notes)
    assert noted == {"ramp": True, "smooth_step": False}
