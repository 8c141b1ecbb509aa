"""The command ``burnish bind``: writes the binding of materials in the languages of hosts."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from ..bindings.registry import names
from .compile_options import (
    BINDINGS,
    CACHE,
    DEPFILE,
    DEPFILE_TARGET,
    FLIP_Y,
    FORMAT,
    HOIST,
    INCLUDE,
    MATERIAL,
    NATIVE_STAGES,
    PASS,
    RIG,
    SET,
    SINGLE_FILE,
    TARGET,
    CompileRequest,
)
from .options import each_once, option
from .single_output import STDOUT, deliver, insist_on_another_file, insist_on_own
from .terminal import FAILED

if TYPE_CHECKING:
    from .bound_files import Bound

_OF_TEXTS = (
    TARGET, MATERIAL, RIG, PASS, INCLUDE, SET, SINGLE_FILE, FLIP_Y, HOIST, BINDINGS, NATIVE_STAGES,
)  # fmt: skip
"""The options by which `burnish compile` makes other texts."""


class BindRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    files: tuple[Path, ...]
    languages: tuple[str, ...]
    output: str
    """A file, a folder, or ``-``."""
    namespace: str
    embed: bool
    depfile: str | None
    depfile_target: str | None
    form: str
    cache: bool
    compile: CompileRequest
    """How the texts are compiled."""

    @property
    def is_folder(self) -> bool:
        """True if the output is a folder, with a file for each language."""
        is_named_so = self.output.endswith(("/", os.sep)) or Path(self.output).is_dir()
        return len(self.languages) > 1 or (self.output != STDOUT and is_named_so)

    @property
    def contradiction(self) -> str | None:
        """What is wrong with options that go with each other; ``None`` if nothing is."""
        if self.output == STDOUT and self.is_folder:
            return "several languages are several files: -o names the folder for them"
        if self.output == STDOUT and self.form in ("json", "sarif"):
            return f"--format {self.form} prints a document: name a file for the binding with -o"
        if self.output == STDOUT and self.depfile is not None and self.depfile_target is None:
            return "--depfile with -o - has no outputs to speak of: say what, by --depfile-target"
        if self.depfile == STDOUT:
            return "--depfile is a file: what is printed is the binding"
        if self.depfile is None and self.depfile_target is not None:
            return "--depfile-target is a name in the file of --depfile, which is not given"
        return None


def _with_options(command: click.decorators.FC) -> click.decorators.FC:
    for row in reversed(_OF_TEXTS):
        command = option(row)(command)
    return command


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@click.option(
    "--lang", "languages", required=True, multiple=True, type=click.Choice(names()),
    help="The language of the host; may be given several times.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="FILE|FOLDER", default=STDOUT, show_default=True,
    help="The file to write, or `-` to print it; or a folder, in which each language has a file, "
    "named like the first FILE. A file that has this content is left untouched.",
)  # fmt: skip
@_with_options
@click.option(
    "--namespace", metavar="NAME", default="",
    help="The namespace of the binding, in languages that have any; by default the first FILE's "
    "name.",
)  # fmt: skip
@click.option("--embed", is_flag=True, help="Put the texts of the shaders into the binding.")
@option(DEPFILE)
@option(DEPFILE_TARGET)
@option(FORMAT)
@option(CACHE)
def bind(**chosen: Any) -> None:
    """Write what a host sets, computes and binds, in the host's own language.

    A binding has a type for each block of the materials of each FILE, with the defaults, ranges and
    comments of its parameters; functions that compute the blocks of derived values; and tables of
    bindings, textures, samplers, vertex inputs and targets for each profile. Blocks that are alike
    in several materials are one. Give the same options as to `burnish compile`, which writes the
    shaders. docs/bindings.md has a small host for each language.

    A FILE may be a folder: then all files below it are meant that declare a material, a kernel or a
    frame. A FILE that declares several rigs is bound with each of them, unless --rig names one.

    \b
    Example:
        burnish bind plastic.burnish --lang python -o plastic_binding.py
        burnish bind materials --lang cpp --namespace scene -o materials.hpp
        burnish bind materials --lang cpp --lang typescript -o bindings/
        burnish bind plastic.burnish --lang c --namespace scene -o plastic.h
        burnish bind plastic.burnish --lang python --target wgsl --embed -o plastic_binding.py
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    each_once(chosen["values"])
    options = {row.field: chosen.pop(row.field) for row in _OF_TEXTS}
    chosen["languages"] = tuple(dict.fromkeys(chosen["languages"]))
    request = BindRequest(
        **chosen, compile=CompileRequest(files=(), output="", **options)
    )  # fmt: skip
    if request.contradiction is not None:
        raise click.UsageError(request.contradiction)
    if not request.is_folder:
        for file in request.files:
            insist_on_another_file(file, request.output)
    _insist_on_namespace(request)
    made: Bound | None = None
    try:
        for path in _paths(request).values():
            insist_on_own(path, "Made by `burnish bind`", "burnish bind")
        made = _bound(request)
        _deliver(request, made)
    except CompileError as error:
        _tell(request, (*(made.diagnostics if made else ()), *error.diagnostics))
        click.get_current_context().exit(FAILED)


def _bound(request: BindRequest) -> Bound:
    """What all files have become. Raises ``CompileError`` with all errors."""
    from ..compiler.diagnostics.diagnostic import CompileError
    from .bound_files import bound

    made = bound(request.files, request.compile, use_cache=request.cache)
    if not made.files:
        folders = " and ".join(f"`{folder}`" for folder in request.files)
        raise click.UsageError(f"no file in {folders} declares a material, a kernel or a frame")
    if made.inputs is None:
        raise CompileError(made.diagnostics)
    return made


def _insist_on_namespace(request: BindRequest) -> None:
    """Raise ``BadParameter`` for a namespace that there cannot be."""
    from ..api import binding as api

    try:
        api.namespaces_of(request.namespace, request.languages, ("",))
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--namespace") from None


def _paths(request: BindRequest) -> Mapping[str, str]:
    """The path of the output for each language."""
    from ..api.binding import host_language
    from .bound_files import stem_of

    if not request.is_folder:
        return dict.fromkeys(request.languages, request.output)
    stem = stem_of(request.files[0])
    return {
        name: os.path.join(request.output, f"{stem}.{host_language(name).extension}")  # noqa: PTH118
        for name in request.languages
    }


def _deliver(request: BindRequest, made: Bound) -> None:
    """Write the binding in all languages, and tell of it. Raises ``CompileError``."""
    from ..api import binding as api
    from ..bindings.writing import written
    from .bound_files import binding_of

    names_of_files = [each.name for each in made.files]
    spaces = api.namespaces_of(request.namespace, request.languages, names_of_files)
    texts = {
        name: written(
            binding_of(made, spaces[name], embed=request.embed), api.host_language(name)
        )
        for name in request.languages
    }  # fmt: skip
    paths = _paths(request)
    rule = _depfile(request, made, paths)
    if request.is_folder:
        from .output import write_all

        write_all(
            Path(request.output), {Path(path).name: texts[name] for name, path in paths.items()}
        )
    else:
        deliver(request.output, texts[request.languages[0]])
    if request.depfile is not None:
        deliver(request.depfile, rule)
    _tell(request, made.diagnostics, paths, made)


def _depfile(request: BindRequest, made: Bound, paths: Mapping[str, str]) -> str:
    """The text for ``--depfile``; empty without it."""
    if request.depfile is None or made.inputs is None:
        return ""
    from .depfiles import depfile_of

    outputs = [path for path in paths.values() if path != STDOUT]
    targets = outputs if request.depfile_target is None else [request.depfile_target]
    return depfile_of(request.depfile, targets, outputs, made.files, made.inputs)


def _tell(
    request: BindRequest,
    diagnostics: Sequence[Any],
    paths: Mapping[str, str] | None = None,
    made: Bound | None = None,
) -> None:
    """Print messages, and the document that is asked for."""
    from ..compiler.documents.answer import BindAnswer, BoundFileRow
    from .console import print_rendered
    from .depfiles import files_read
    from .message_forms import document, messages
    from .terminal import print_output

    print_rendered(messages(request.form, diagnostics))
    found, written = None, list[str]()
    if paths is not None and made is not None and made.inputs is not None:
        written = [*paths.values(), *([request.depfile] if request.depfile else [])]
        found = BindAnswer(
            outputs=tuple(BoundFileRow(path=path, language=name) for name, path in paths.items()),
            read=tuple(files_read(made.inputs, made.files)),
            missing=tuple(p for p, content in made.inputs.contents.items() if content is None),
        )
    code = 0 if paths is not None else FAILED
    text = document(
        request.form, "bind", diagnostics, exit_code=code, written=written, found=found
    )  # fmt: skip
    if request.form == "text" and request.is_folder and paths is not None:
        text = "".join(f"{path}\n" for path in paths.values())
    print_output(text)
