"""The command ``burnish bind``: writes the binding of materials in the language of a host."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import click

from ..bindings.registry import names
from .compile_options import MATERIAL, SET, TARGET, name_and_value
from .console import show
from .options import (
    each_once,
    hoist_option,
    option,
    pass_option,
    rig_option,
    search_option,
)
from .single_output import STDOUT, deliver, insist_on_another_file, insist_on_own
from .terminal import FAILED


class BindRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    files: tuple[Path, ...]
    language: str
    output: str
    """A file, or ``-``."""
    targets: tuple[str, ...]
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    values: tuple[str, ...]
    hoist: bool
    namespace: str
    embed: bool


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@click.option(
    "--lang", "language", required=True, type=click.Choice(names()),
    help="The language of the host.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="FILE", default=STDOUT, show_default=True,
    help="The file to write, or `-` to print it. A file that has this content is left untouched.",
)  # fmt: skip
@option(TARGET)
@option(MATERIAL)
@rig_option
@pass_option
@search_option
@option(SET)
@hoist_option
@click.option(
    "--namespace", metavar="NAME", default="",
    help="The namespace of the binding, in languages that have any; by default the first FILE's "
    "name.",
)  # fmt: skip
@click.option("--embed", is_flag=True, help="Put the texts of the shaders into the binding.")
def bind(**chosen: Any) -> None:
    """Write what a host sets, computes and binds, in the host's own language.

    A binding has a type for each block of the materials of each FILE, with the defaults, ranges and
    comments of its parameters; functions that compute the blocks of derived values; and tables of
    bindings, textures, samplers, vertex inputs and targets for each profile. Blocks that are alike
    in several materials are one. Give the same options as to `burnish compile`, which writes the
    shaders. docs/bindings.md has a small host for each language.

    \b
    Example:
        burnish bind plastic.burnish --lang python -o plastic_binding.py
        burnish bind materials/*.burnish --lang cpp --namespace scene -o materials.hpp
        burnish bind plastic.burnish --lang c --namespace scene -o plastic.h
        burnish bind plastic.burnish --lang python --target wgsl --embed -o plastic_binding.py
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    each_once(chosen["values"])
    request = BindRequest(**chosen)
    for file in request.files:
        insist_on_another_file(file, request.output)
    try:
        insist_on_own(request.output, "Made by `burnish bind`", "burnish bind")
        _deliver(request.output, _text(request))
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)


def _text(request: BindRequest) -> str:
    """The binding. Raises ``CompileError``, and ``BadParameter`` for a name that there is not."""
    from ..api import binding as api
    from ..targets.selection import DEFAULT

    targets = [name for names in request.targets for name in names.split(",")] or DEFAULT
    _insist_on_namespace(request)
    return api.bind(
        request.files, request.language, targets, material=request.material, rig=request.rig,
        pass_=request.pass_, search_path=request.search_path,
        values=dict(map(name_and_value, request.values)), hoist=request.hoist,
        namespace=request.namespace, embed=request.embed,
    )  # fmt: skip


def _insist_on_namespace(request: BindRequest) -> None:
    """Raise ``BadParameter`` for a namespace that there cannot be."""
    from ..api import binding as api

    try:
        api.namespace_of(request.namespace, api.host_language(request.language), ("",))
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--namespace") from None


def _deliver(output: str, text: str) -> None:
    """Print a text, or write it to a file that does not have it already."""
    if output == STDOUT:
        deliver(output, text)
        return
    path = Path(output)
    if path.is_symlink() or not path.is_file() or path.read_bytes() != text.encode():
        deliver(output, text)
