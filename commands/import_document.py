"""The command ``burnish import``: turns documents of MaterialX into materials of Burnish."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from .console import remark, say
from .failures import fail, insist_on_materialx
from .giving_out import give_out
from .options import answer_option
from .terminal import FAILED

if TYPE_CHECKING:
    from ..materialx.archives import Source
    from ..materialx.importing import Imported


@click.command(name="import")
@click.argument("file", metavar="FILE.mtlx", type=click.Path(path_type=Path))
@click.option(
    "-o", "out", default=".", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="The folder to write to; by default, the current one.",
)  # fmt: skip
@click.option(
    "--images", "image_folders", multiple=True, metavar="FOLDER",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="A further folder with pictures that the document names; can be given several times.",
)  # fmt: skip
@click.option("--partial", is_flag=True, help="Convert what can be converted, and tell the rest.")
@click.option(
    "--check", "checked", is_flag=True,
    help="Compare what is written with MaterialX's own pictures; the command fails if any differ.",
)  # fmt: skip
@click.option("--force", is_flag=True, help="Replace files that are there with other contents.")
@answer_option
def import_(
    file: Path,
    out: Path,
    image_folders: tuple[Path, ...],
    partial: bool,
    checked: bool,
    force: bool,
) -> None:
    """Turn the materials of FILE, a document of MaterialX or an archive of one with its pictures
    (`chair.mtlx.zip`), into a file of Burnish.

    Each material of the document becomes one of Burnish that extends the surface model it names,
    such as OpenPBR, and sets the slots that differ. What MaterialX's own library defines, models
    and nodes, is written beside it, into the folder `materialx`; pictures into `textures`.

    What has no meaning in Burnish is told by its node and line, and then nothing is written at all,
    unless --partial is given. Files that are there already with other contents stay as they are.

    With --check, both are drawn by one driver, llvmpipe, in one scene: the document by the GLSL
    that MaterialX generates for it, and what was written here.

    \b
    Example:
        burnish import chair.mtlx -o chair/
        burnish import chair.mtlx.zip -o chair/
        burnish import wood.mtlx --images ../Images
        burnish import scene.mtlx --partial
        burnish import chair.mtlx -o chair/ --check
    """
    insist_on_materialx("read")
    from ..materialx.archives import unpacked

    with _messages(), unpacked(file, image_folders) as source:
        found = _imported(source)
        _tell(found, partial)
        if not found.materials:
            fail(f"`{file}` has no material, surface or output that could be drawn")
        _write(found, out, force)
        if checked and not _is_faithful(found, out / found.main, source):
            click.get_current_context().exit(FAILED)


def _tell(found: Imported, partial: bool) -> None:
    """Say what is not converted; ends the command if anything is not, unless that is wanted."""
    for problem in found.problems:
        is_fatal = problem.is_error and not partial
        remark("error" if is_fatal else "warning" if problem.is_error else "note", str(problem))
    if any(problem.is_error for problem in found.problems) and not partial:
        remark("note", "nothing is written; --partial writes the rest")
        click.get_current_context().exit(FAILED)


def _is_faithful(found: Imported, main: Path, source: Source) -> bool:
    from .import_check import is_faithful

    return is_faithful(found, main, source.document, source.image_folders)


def _imported(source: Source) -> Imported:
    from ..materialx.importing import imported

    return imported(source.document, image_folders=source.image_folders)


@contextmanager
def _messages() -> Iterator[None]:
    """For a ``with``: a document that cannot be read ends the command with a message."""
    from ..materialx.outline import DocumentError
    from ..targets.runner.files import FileError

    try:
        yield
    except DocumentError as error:
        place, _, text = str(error).partition(" error: ")
        fail(f"{place} {text}" if text else str(error))
    except FileError as error:
        fail(str(error))


def _write(found: Imported, out: Path, force: bool) -> None:
    give_out(
        out, found.files, "is there already with other contents, and nothing was written",
        "name another folder, `-o FOLDER`, or replace what is there: `--force`", force,
    )  # fmt: skip
    names = ", ".join(material.name for material in found.materials[:6])
    more = f" and {len(found.materials) - 6} more" if len(found.materials) > 6 else ""
    main = shlex.quote(str(out / found.main))
    say(f"{names}{more}. To see it: burnish render {main}, or burnish view {main}")
