"""``burnish compile``: compiles files and writes shader texts and reflections to disk."""

from __future__ import annotations

from typing import Any

import click

from .compilation import succeeds
from .compile_options import OPTIONS, CompileRequest
from .options import each_once, files_argument, option
from .results import Question
from .terminal import FAILED


def _with_options(command: click.decorators.FC) -> click.decorators.FC:
    for row in reversed(OPTIONS):
        command = option(row)(command)
    return command


@click.command("compile")
@files_argument
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
        burnish compile materials/*.burnish --bindings engine.toml -o build/
        burnish compile plastic.burnish --target glsl --emit spirv --optimize -o build/
        burnish compile materials/*.burnish -o build/
        burnish compile car.burnish --set coat_weight=0 --set specular_roughness=0.3..0.5 -o build/
        burnish compile plastic.burnish --emit functions --slots tint,normal --target wgsl -o build/
    """
    each_once(chosen["values"])
    request = CompileRequest(**chosen)
    if request.contradiction is not None:
        raise click.UsageError(request.contradiction)
    context = click.get_current_context()
    if watch:
        from .watch import watch as repeat

        further = () if request.bindings is None else (request.bindings,)
        repeat(request.files, request.search_path, lambda: succeeds(request, None), further)
    elif not succeeds(request, context.obj if isinstance(context.obj, Question) else None):
        context.exit(FAILED)
