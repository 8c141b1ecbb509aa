"""The command ``burnish example``: writes an example that comes with Burnish into a folder."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import click

from .console import say, show
from .failures import fail
from .shipped import EXAMPLES, chosen, say_groups
from .terminal import FAILED

_COMMENT = re.compile(r"^//!(.*)$", re.MULTILINE)
_FILE = re.compile(r"[\w./-]+\.\w+")


@click.command()
@click.argument("name", required=False, metavar="[NAME]")
@click.option(
    "-o", "out", default=".", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="The folder to write to; by default, the current one.",
)  # fmt: skip
@click.option("--path", "as_path", is_flag=True, help="Print where it is, and write nothing.")
def example(name: str | None, out: Path, as_path: bool) -> None:
    """List the examples, or write the example NAME with all files that it needs.

    Imports and pictures are written beside it, in folders as the examples have them. Files that are
    there already are never changed: if one has other contents, nothing is written at all.

    \b
    Example:
        burnish example
        burnish example plastic
        burnish example frames/shadows -o scenes/
        burnish example tutorial/4_texture --path
    """
    from .catalogue import catalogue

    listed = {
        group.title: {each.name.removesuffix(".burnish"): each.what for each in group.files}
        for group in catalogue(EXAMPLES)
    }
    if name is None:
        if as_path:
            say(str(EXAMPLES))
            return
        say("Examples, each written into the current folder by `burnish example NAME`.")
        say_groups(listed)
        return
    names = [each for rows in listed.values() for each in rows]
    file = (
        EXAMPLES / f"{chosen('example', name.removeprefix('examples/'), names, '.burnish')}.burnish"
    )
    if as_path:
        say(str(file))
        return
    _write(file, out)


def _write(file: Path, out: Path) -> None:
    """Write an example and what it needs, or end the command with a message."""
    from ..compiler.diagnostics.diagnostic import CompileError
    from .output import write_tree

    contents = {path: (EXAMPLES / path).read_bytes() for path in sorted(_needed(file))}
    new = {path: content for path, content in contents.items() if not _is_there(out, path, content)}
    try:
        write_tree(out, new)
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)
    _tell(file, out, contents, new)


def _tell(file: Path, out: Path, contents: Mapping[str, bytes], new: Mapping[str, bytes]) -> None:
    for path in contents:
        say(f"{out / path}{'' if path in new else ' (was there already)'}")
    written = out / file.relative_to(EXAMPLES)
    say(f"To see it: burnish render {written}, or burnish view {written}")


def _is_there(out: Path, path: str, content: bytes) -> bool:
    """True if the file has this content already; ends the command if it has another one."""
    place = out / path
    if not os.path.lexists(place):
        return False
    if not place.is_symlink() and place.is_file() and place.read_bytes() == content:
        return True
    return fail(
        f"`{place}` is there already, and nothing was written\n"
        "  = help: move it away, or name another folder: `-o FOLDER`"
    )


def _needed(file: Path) -> set[str]:
    """The paths within the examples of a file, its imports, and what their comments name."""
    from .watch import sources

    root = EXAMPLES.resolve()
    imported = {path.resolve() for path in sources(file, ())}
    own = {path for path in imported if path.is_relative_to(root) and path.is_file()}
    named = {path for source in own for path in _named(source) if path.is_relative_to(root)}
    return {path.relative_to(root).as_posix() for path in own | named}


def _named(source: Path) -> Iterator[Path]:
    """The files that the first comment of an example names: pictures of its command."""
    for comment in _COMMENT.findall(source.read_text(encoding="utf-8")):
        for word in _FILE.findall(comment):
            path = (source.parent / word).resolve()
            if path.is_file() and path.suffix not in (".burnish", ".md"):
                yield path
