"""``burnish compile``: compiles a file and writes shader texts and reflections to disk."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .console import FAILED, rendered, show
from .options import file_argument, hoist_option, pass_option, rig_option, search_option
from .results import STDOUT, Output, Question, keep, print_output

if TYPE_CHECKING:
    from ..api import CompiledMaterial, CompileResult
    from ..compiler.diagnostics.diagnostic import Diagnostic


class Request(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    targets: tuple[str, ...]
    """Empty for the default ones."""
    output: str
    """A folder, or ``-``."""
    validate: bool
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool
    flip_y: bool
    single_file: bool
    line_directives: bool
    cache: bool


def _split(_context: click.Context, _option: click.Parameter, given: Iterable[str]) -> Any:
    return tuple(name for names in given for name in names.split(","))


@click.command("compile")
@file_argument
@click.option(
    "-t",
    "--target",
    "targets",
    metavar="NAME[:PROFILE],…",
    multiple=True,
    callback=_split,
    help="What to write; see `burnish targets`. Default: the first profile of every target that is "
    "not marked as unproven there; `all` means every profile.",
)
@click.option(
    "-o",
    "--output",
    metavar="FOLDER",
    required=True,
    help="Where to put the files; created if needed. `-` prints the shaders instead.",
)
@click.option("--material", metavar="NAME", help="Only this material, instead of all in the file.")
@rig_option
@pass_option
@search_option
@click.option("--validate", is_flag=True, help="Have the real compilers check the texts.")
@click.option("--watch", is_flag=True, help="Compile again whenever a source changes.")
@click.option("--single-file", is_flag=True, help="All stages in one text: vs_main and fs_main.")
@click.option("--flip-y", is_flag=True, help="Turn the picture upside down, to draw into textures.")
@click.option(
    "--line-directives",
    is_flag=True,
    help="Write #line directives, so that other tools name lines of the material in messages.",
)
@hoist_option
@click.option(
    "--cache/--no-cache",
    default=True,
    help="Write again what was compiled before if nothing has changed, or compile in any case.",
    show_default=True,
)
def compile_(watch: bool, **chosen: Any) -> None:
    """Compile the materials of FILE.

    Each becomes FOLDER/<Material>.<vert|frag>.<hlsl|glsl|wgsl> and FOLDER/<Material>.json, which
    tells a host what to bind where. If anything is wrong, nothing is written.

    \b
    Example:
        burnish compile plastic.burnish -o build/
        burnish compile plastic.burnish --target wgsl,glsl:es300 --validate -o build/
        burnish compile plastic.burnish --target wgsl --single-file -o - | less
    """
    request = Request(**chosen)
    if watch:
        from .watch import watch as repeat

        repeat(request.file, request.search_path, lambda: _succeeds(request))
    elif not _succeeds(request):
        click.get_current_context().exit(FAILED)


def _succeeds(request: Request) -> bool:
    """Compile once and report what was found; returns whether there was any output."""
    from ..compiler.diagnostics.diagnostic import CompileError

    warnings: tuple[Diagnostic, ...] = ()
    try:
        result = _compiled(request)
        warnings = result.diagnostics
        if request.validate:
            _insist_on_acceptance(result)
        output = _output(request, result)
        _deliver(output)
    except CompileError as error:
        show((*warnings, *error.diagnostics))
        return False
    show(warnings)
    question = click.get_current_context().obj
    if isinstance(question, Question):
        keep(question, output, result.inputs)
    return True


def _compiled(request: Request) -> CompileResult:
    from .. import api
    from ..targets.selection import DEFAULT

    return api.compile(
        request.file,
        request.targets or DEFAULT,
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
        hoist=request.hoist,
        flip_y=request.flip_y,
        single_file=request.single_file,
        line_directives=request.line_directives,
    )


def _output(request: Request, result: CompileResult) -> Output:
    """What the command line asks for: files in a folder, or shaders on standard output."""
    warnings = rendered(result.diagnostics)
    if request.output == STDOUT:
        files = [file for material in result.materials for file in material.files]
        headings = (f"// ======== {file.name}\n" if len(files) > 1 else "" for file in files)
        printed = (heading + file.text for heading, file in zip(headings, files, strict=True))
        return Output(STDOUT, {}, "".join(printed), warnings)
    texts: dict[str, str] = {}
    lines = []
    for material in result.materials:
        reflection = f"{material.name}.json"
        texts |= {file.name: file.text for file in material.files}
        texts[reflection] = _reflection_text(material)
        shaders = f"{len(material.files)} shaders and {reflection}"
        lines.append(f"{material.name}: {shaders} in {request.output}\n")
    lines += _remarks_on_languages(result)
    return Output(request.output, texts, "".join(lines), warnings)


def _remarks_on_languages(result: CompileResult) -> Iterator[str]:
    """A line for each language of the texts that is marked as unproven."""
    from ..targets import registry

    names = (file.target for material in result.materials for file in material.files)
    for target in map(registry.load, dict.fromkeys(names)):
        if target.unproven:
            yield f"texts in {target.title}: {target.unproven}\n"


def _deliver(output: Output) -> None:
    """Write the files and print what there is to print, or raise ``CompileError``."""
    from .output import unwritable, write_all

    if output.folder != STDOUT:
        write_all(Path(output.folder), output.texts)
    try:
        print_output(output.printed)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise unwritable(Path("standard output"), error.strerror or str(error)) from error


def _insist_on_acceptance(result: CompileResult) -> None:
    """Raise ``CompileError`` unless the downstream compilers accept every text."""
    from ..compiler.diagnostics.diagnostic import CompileError
    from .validate import validate

    found = validate(file for material in result.materials for file in material.files)
    if any(diagnostic.severity == "error" for diagnostic in found):
        raise CompileError(found)
    show(found)


def _reflection_text(material: CompiledMaterial) -> str:
    import json

    return json.dumps(material.reflection, indent=2, ensure_ascii=False) + "\n"
