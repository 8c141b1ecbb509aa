"""The command ``burnish example``: writes an example that comes with Burnish into a folder."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import click

from .console import say
from .giving_out import give_out
from .options import answer_option
from .shipped import EXAMPLES, chosen, say_groups

_OF_PROJECTS = "hosts/"
"""The folder of what `burnish new` makes projects of."""
_COMMENT = re.compile(r"^//!(.*)$", re.MULTILINE)
_FILE = re.compile(r"[\w./-]+\.\w+")


@click.command()
@click.argument("name", required=False, metavar="[NAME]")
@click.option(
    "-o", "out", default=".", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="The folder to write to; by default, the current one.",
)  # fmt: skip
@click.option("--path", "as_path", is_flag=True, help="Print where it is, and write nothing.")
@answer_option
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

    found = {
        group.title: {
            each.name.removesuffix(".burnish"): each.what
            for each in group.files
            if not each.name.startswith(_OF_PROJECTS)
        }
        for group in catalogue(EXAMPLES)
    }
    listed = {title: rows for title, rows in found.items() if rows}
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
    contents = {path: (EXAMPLES / path).read_bytes() for path in sorted(_needed(file))}
    give_out(
        out, contents, "is there already, and nothing was written",
        "move it away, or name another folder: `-o FOLDER`",
    )  # fmt: skip
    written = out / file.relative_to(EXAMPLES)
    say(f"To see it: burnish render {written}, or burnish view {written}")


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
