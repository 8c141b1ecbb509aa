"""``burnish corpus``: writes operands, results and bounds of each operation, for other programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from .. import __version__
from .console import say
from .failures import errors_as_messages, needed
from .options import answer_option


@click.command()
@click.option(
    "-o", "--output", metavar="FOLDER", default="corpus", show_default=True,
    type=click.Path(path_type=Path),
    help="The folder for index.json, and a file for each operation; created if needed.",
)  # fmt: skip
@click.option(
    "--seed", metavar="N", default=1, show_default=True, type=click.IntRange(0, 2**32 - 1),
    help="Another seed draws other operands; those at the ends of domains stay.",
)  # fmt: skip
@click.option(
    "--only", metavar="NAME,…", multiple=True,
    help="Only these operations, by their names or signs, such as sin or `/`; may be given many "
    "times.",
)  # fmt: skip
@answer_option
def corpus(output: Path, seed: int, only: Sequence[str]) -> None:
    """Write a corpus to test the arithmetic of a compiler, an interpreter or a backend with.

    For each builtin function and operator of the language there is a file with operands, the exact
    result, the float32 nearest to it, and for each platform (WGSL, Vulkan, Direct3D, OpenGL, OpenGL
    ES) the interval in which the result of a conforming device lies. Numbers are written as their
    bits. A program that reads JSON needs neither a GPU nor Burnish to test itself with it.

    docs/corpus.md has a short checker; `burnish schema corpus` prints the JSON Schema.
    All files are written, or none. The same seed makes the same files.

    \b
    Example:
        burnish corpus -o corpus
        burnish corpus --only sin,cos,pow --only '%' -o build/corpus --seed 7
    """
    try:
        from ..targets.conformance.corpus.making import make
        from ..targets.conformance.corpus.operands import OPERATIONS
    except ModuleNotFoundError as error:
        needed(error)
    from .output import obstacle, unwritable, write_all
    from .progress import Progress

    names = _chosen(only, {name: row.operator for name, row in OPERATIONS.items()})
    with errors_as_messages():
        if reason := obstacle(output):
            raise unwritable(output, reason)
        with Progress("corpus") as progress:
            texts = make(names, seed, f"burnish {__version__}", progress.tell)
        write_all(output, texts)
    size = sum(len(text.encode()) for text in texts.values())
    count = f"{len(names)} operation{'s' if len(names) > 1 else ''}"
    say(f"{count}, {size / 1e6:.1f} MB: {output / 'index.json'}")


def _chosen(only: Sequence[str], known: Mapping[str, str]) -> list[str]:
    """The names of the wanted operations, in the order of the manual; all if none is named.

    ``known`` has their signs. The sign ``-`` is that of two operations.
    """
    from ..compiler.diagnostics.nearest import suggestion

    wanted = {word.strip() for text in only for word in text.split(",")} - {""}
    if only and not wanted:
        raise click.BadParameter("it names no operation", param_hint="--only")
    for word in sorted(wanted - known.keys() - set(known.values())):
        hint = suggestion(word, known) or "docs/builtins.md lists them"
        raise click.BadParameter(f"there is no operation '{word}': {hint}", param_hint="--only")
    return [name for name, sign in known.items() if not only or wanted & {name, sign}]
