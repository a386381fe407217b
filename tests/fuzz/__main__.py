"""`python -m tests.fuzz TARGET [--count N] [--seconds S]`: so many inputs, guided by coverage if atheris is there."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path


def main() -> None:
    arguments = _arguments()
    if arguments.target == "compile":
        from tests.fuzz import through_c

        through_c.main(arguments.count, arguments.seed)
        return
    try:
        import atheris
    except ImportError:
        atheris = None
    if atheris is None or arguments.plain:
        from tests.fuzz.mutate import run
        from tests.fuzz.targets import TARGETS, timed

        target, tokens, seeds = TARGETS[arguments.target]
        kept = run(lambda data: timed(target, data), seeds(), tokens, arguments.count, arguments.seed)
        print(f"{arguments.count} inputs, {kept} reached new lines; every one a value or an InputError")
        return
    with atheris.instrument_imports(include=["gudgeon"]):
        from tests.fuzz.targets import TARGETS, timed
    target, tokens, seeds = TARGETS[arguments.target]
    with tempfile.TemporaryDirectory() as folder:
        options = _prepare(Path(folder), tokens, seeds(), arguments)
        atheris.Setup([sys.argv[0], *options], lambda data: timed(target, data))
        atheris.Fuzz()


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("target", choices=("expression", "reader", "compile"))
    parser.add_argument("--count", type=int, default=None, help="inputs to try (100,000; files to compile: 10,000)")
    parser.add_argument("--seconds", type=int, default=0, help="stop after this long (atheris only)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--corpus", type=Path, default=None, help="folder to keep inputs in (atheris only)")
    parser.add_argument("--plain", action="store_true", help="mutations alone, even if atheris is there")
    arguments = parser.parse_args()
    arguments.count = arguments.count or (10_000 if arguments.target == "compile" else 100_000)
    return arguments


def _prepare(folder: Path, tokens: tuple[str, ...], seeds: list[bytes], arguments: argparse.Namespace) -> list[str]:
    """Seeds and dictionary as libFuzzer wants them; its options."""
    corpus = arguments.corpus or folder / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for number, data in enumerate(seeds):
        (corpus / f"seed{number}").write_bytes(data)
    words = ("".join(f"\\x{byte:02x}" for byte in token.encode()) for token in tokens if token)
    (folder / "words").write_text("".join(f'"{word}"\n' for word in words))
    return [
        f"-runs={arguments.count}",
        f"-max_total_time={arguments.seconds}",
        f"-seed={arguments.seed}",
        "-timeout=10",
        "-max_len=4000",
        "-rss_limit_mb=4096",
        "-print_final_stats=1",
        f"-dict={folder / 'words'}",
        f"-artifact_prefix={folder}/",
        str(corpus),
    ]


if __name__ == "__main__":
    main()
