"""The command ``burnish export``: writes materials for other programs.

The graph of any material becomes a JSON document.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import click

from .console import show
from .options import file_argument, pass_option, rig_option, search_option
from .terminal import FAILED, print_output

STDOUT = "-"
FORMATS = ("json",)


class ExportRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    output: str
    """A file, or ``-``."""
    form: str | None
    """One of ``FORMATS``; by default the ending of the file's name."""
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]


@click.command()
@file_argument
@click.option(
    "-o", "--output", metavar="FILE", default=STDOUT, show_default=True,
    help="The file to write: a name that ends in .json, or `-` to print it.",
)  # fmt: skip
@click.option(
    "--format", "form", type=click.Choice(FORMATS), help="By default what FILE's name says.",
)  # fmt: skip
@click.option("--material", metavar="NAME", help="The material of the file; by default, all.")
@rig_option
@pass_option
@search_option
def export(**chosen: Any) -> None:
    """Write the materials of FILE for other programs.

    As JSON, it is the graph of each material's own equations, as `burnish graph` draws it: nodes
    with the numbers of the nodes that they read. `burnish schema graph` prints the schema.

    \b
    Example:
        burnish export plastic.burnish -o plastic.json
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    request = ExportRequest(**chosen)
    _insist_on_another_file(request)
    _form(request)
    try:
        _deliver(request, _json(request))
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)


def _insist_on_another_file(request: ExportRequest) -> None:
    """Raise ``BadParameter`` if the output would overwrite the file that is read."""
    with suppress(OSError):
        if request.output != STDOUT and request.file.samefile(request.output):
            raise click.BadParameter("it is FILE itself", param_hint="--output")


def _form(request: ExportRequest) -> str:
    """The requested format, by name or by the ending of the file's name."""
    if request.form is not None:
        return request.form
    ending = Path(request.output).suffix.removeprefix(".")
    if ending not in FORMATS:
        endings = _or([f".{form}" for form in FORMATS])
        message = f"`{request.output}` does not end in {endings}; say which --format"
        raise click.BadParameter(message, param_hint="--output")
    return ending


def _or(words: Sequence[str]) -> str:
    return " or ".join(words)


def _json(request: ExportRequest) -> str:
    from ..api import entry_points as api
    from ..compiler.documents.writing import to_text
    from .graph.document import equations_document

    found = api.equations(
        request.file, material=request.material, rig=request.rig, pass_=request.pass_,
        search_path=request.search_path,
    )  # fmt: skip
    return to_text(equations_document(found))


def _deliver(request: ExportRequest, text: str) -> None:
    if request.output == STDOUT:
        print_output(text.removesuffix("\n"))
        return
    from .output import unwritable, write_file

    path = Path(request.output)
    try:
        write_file(path, text.encode())
    except OSError as error:
        raise unwritable(path, error.strerror or str(error)) from error
