"""The command ``burnish export``: writes materials for other programs.

Materials that extend a surface that MaterialX knows become a document of MaterialX, and the graph
of any material a JSON document.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import click

from .console import remark, show
from .failures import insist_on_materialx
from .options import file_argument, pass_option, rig_option, search_option, values_option
from .single_output import STDOUT, deliver, insist_on_another_file
from .terminal import FAILED

if TYPE_CHECKING:
    from ..materialx.export.unsayable import UnsaidError

FORMATS = ("mtlx", "json")


class ExportRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    output: str
    """A file, or ``-``."""
    form: str | None
    """One of ``FORMATS``; by default the ending of the file's name."""
    material: str | None
    values: tuple[tuple[str, str], ...]
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]


@click.command()
@file_argument
@click.option(
    "-o", "--output", metavar="FILE", default=STDOUT, show_default=True,
    help="The file to write: a name that ends in .mtlx or .json, or `-` to print it.",
)  # fmt: skip
@click.option(
    "--format", "form", type=click.Choice(FORMATS),
    help="A document of MaterialX, or the graph of equations; by default what FILE's name says.",
)  # fmt: skip
@click.option("--material", metavar="NAME", help="The material of the file; by default, all.")
@values_option
@rig_option
@pass_option
@search_option
def export(**chosen: Any) -> None:
    """Write the materials of FILE for other programs.

    As a document of MaterialX, a material that extends an imported surface, or OpenPbr, GltfSurface
    or Principled of std.models, is that surface with a graph of nodes: parameters become its
    inputs, equations nodes, functions definitions, and textures images, with the files that --set
    or the comment of FILE names. What MaterialX cannot say is told by its place and slot, and then
    nothing is written.

    As JSON, it is the graph of each material's own equations, as `burnish graph` draws it: nodes
    with the numbers of the nodes that they read. `burnish schema graph` prints the schema.

    \b
    Example:
        burnish export chair.burnish -o chair.mtlx
        burnish export wood.burnish --set rings=rings.png -o wood.mtlx
        burnish export plastic.burnish -o plastic.json
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    request = ExportRequest(**chosen)
    insist_on_another_file(request.file, request.output)
    written = {"mtlx": _mtlx, "json": _json}[_form(request)]
    try:
        text = written(request)
        deliver(request.output, text.removesuffix("\n") if request.output == STDOUT else text)
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)


def _form(request: ExportRequest) -> str:
    """The requested format, by name or by the ending of the file's name."""
    if request.form is not None:
        return request.form
    ending = Path(request.output).suffix.removeprefix(".")
    if ending not in FORMATS:
        endings = " or ".join(f".{form}" for form in FORMATS)
        message = f"`{request.output}` does not end in {endings}; say which --format"
        raise click.BadParameter(message, param_hint="--output")
    return ending


def _mtlx(request: ExportRequest) -> str:
    insist_on_materialx("written")
    from ..materialx.export.files import export as exported
    from ..materialx.export.unsayable import UnsaidError
    from .exported_pictures import pictures_of

    out = Path() if request.output == STDOUT else Path(request.output).parent
    pictures = pictures_of(request.file, request.values, out)
    try:
        found = exported(
            request.file, material=request.material, rig=request.rig, pass_=request.pass_,
            search_path=request.search_path, file_of=pictures,
        )  # fmt: skip
    except UnsaidError as error:
        _tell(error)
    if pictures.unread:
        names = ", ".join(f"`{name}`" for name in sorted(pictures.unread))
        raise click.BadParameter(f"no texture is called {names}", param_hint="--set")
    for name, file in pictures.guessed.items():
        remark("note", (
            f"no file is known for the texture `{name}`: the document names `{file}`\n"
            f"  = help: name another one: `--set {name}=FILE`"
        ))  # fmt: skip
    return found.text


def _tell(error: UnsaidError) -> NoReturn:
    """Tell what MaterialX cannot say, and end the command."""
    for each in error.told:
        advice = f"\n  = help: {each.advice}" if each.advice else ""
        remark("error", f"{each}{advice}")
    remark("note", "nothing is written")
    click.get_current_context().exit(FAILED)


def _json(request: ExportRequest) -> str:
    if request.values:
        raise click.UsageError("--set names files of textures, which --format mtlx has")
    from ..api import entry_points as api
    from ..compiler.documents.writing import to_text
    from .graph.document import equations_document

    found = api.equations(
        request.file, material=request.material, rig=request.rig, pass_=request.pass_,
        search_path=request.search_path,
    )  # fmt: skip
    return to_text(equations_document(found))
