"""``burnish compile``: compiles files and writes shader texts and reflections to disk."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from .compilation import succeeds
from .compile_options import OPTIONS, CompileRequest
from .options import each_once, option
from .results import Question
from .terminal import FAILED


def _with_options(command: click.decorators.FC) -> click.decorators.FC:
    for row in reversed(OPTIONS):
        command = option(row)(command)
    return command


@click.command("compile")
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@_with_options
@click.option("--watch", is_flag=True, help="Compile again whenever a source changes.")
def compile_(watch: bool, **chosen: Any) -> None:
    """Compile the materials of each FILE.

    Each becomes FOLDER/<Material>.<vert|frag>.<hlsl|glsl|wgsl> and FOLDER/<Material>.json, which
    tells a host what to bind where. If anything is wrong in any file, nothing is written. Many
    files are compiled in several processes.

    \b
    Example:
        burnish compile plastic.burnish -o build/
        burnish compile plastic.burnish --target wgsl,glsl:es300 --validate -o build/
        burnish compile plastic.burnish --target wgsl --single-file -o - | less
        burnish compile materials/*.burnish -o build/
        burnish compile car.burnish --set coat_weight=0 --set specular_roughness=0.3..0.5 -o build/
        burnish compile plastic.burnish --emit functions --slots tint,normal --target wgsl -o build/
    """
    each_once(chosen["values"])
    request = CompileRequest(**chosen)
    if request.misfit:
        raise click.UsageError(request.misfit)
    if request.why and request.prints:
        raise click.UsageError("--why prints reasons: it goes with a folder, not with -o -")
    context = click.get_current_context()
    if watch:
        from .watch import watch as repeat

        repeat(request.files, request.search_path, lambda: succeeds(request, None))
    elif not succeeds(request, context.obj if isinstance(context.obj, Question) else None):
        context.exit(FAILED)
