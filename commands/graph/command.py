"""The command line of ``burnish graph``: options, formats, and writing the output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from ...compiler.diagnostics.display import harmless_lines
from ..console import show
from ..failures import errors_as_messages, fail
from ..options import (
    each_once,
    file_argument,
    narrowed_option,
    pass_option,
    pixel,
    rig_option,
    search_option,
)
from ..single_output import STDOUT, deliver, insist_on_another_file
from ..terminal import FAILED

if TYPE_CHECKING:
    from ...api.compiled import CompiledFrame, CompiledMaterial
    from ...compiler.diagnostics.source import Span
    from ...compiler.semantics.equations.model import Equations
    from .model import Picture

    Subject = CompiledMaterial | CompiledFrame | Equations
    """A program, a frame, or the equations of a material."""

FORMATS = ("svg", "dot", "text")
LARGEST = 600
"""The largest number of boxes in a picture; people cannot read more."""


class GraphRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    output: str
    """A file, or ``-``."""
    form: str | None
    """One of ``FORMATS``; by default the ending of the file's name, or else ``text``."""
    program: bool
    why: bool
    error: tuple[int, int] | None
    case: str
    everything: bool
    material: str | None
    shader: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool
    values: tuple[tuple[str, str], ...]

    @property
    def is_of_programs(self) -> bool:
        """True if something is asked for that only the program of a material has."""
        return self.program or self.why or self.everything or self.error is not None


@click.command()
@file_argument
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    default=STDOUT,
    show_default=True,
    help="The file to write: a name that ends in .svg or .dot, or `-` to print it.",
)
@click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    help="A picture, a text for Graphviz, or one for people; by default what FILE's name says.",
)
@click.option(
    "--program", is_flag=True,
    help="Of a material, the optimised program: each value, by the stage that computes it.",
)  # fmt: skip
@click.option("--why", is_flag=True, help="Instead, say why guards went, and why others stay.")
@click.option(
    "--error", metavar="X,Y", callback=pixel,
    help="Colour each value of the program by its part in the error of this pixel of `conform`'s "
    "pictures.",
)  # fmt: skip
@click.option(
    "--case", metavar="NAME", default="defaults", show_default=True,
    help="The scene of `conform` in which the pixel is.",
)  # fmt: skip
@click.option(
    "--all", "everything", is_flag=True, help="Every value of the program, and not only named ones."
)
@click.option("--material", metavar="NAME", help="The material or frame of the file that is shown.")
@click.option(
    "--shader", metavar="NAME",
    help="Of a frame, the graph of one of its shaders, as `Deferred.Toned`.",
)  # fmt: skip
@rig_option
@pass_option
@search_option
@click.option(
    "--hoist/--no-hoist",
    default=True,
    help="Let the host compute values that depend on parameters only, or the shader.",
    show_default=True,
)
@narrowed_option
def graph(**chosen: Any) -> None:
    """Show the equations of the materials of FILE, their programs, or the steps of its frames.

    Data flow from left to right: from parameters and textures through the operations of each
    equation to the pass that draws. Whatever a base or the library declares is one box. In a
    browser, point at a box to see where it is written.

    With `--program`, boxes are values of the optimised program. The host, the stages, functions and
    loops each have a border of their own, and a shield marks a value that keeps a guard. With
    `--set`, as for `burnish compile`, it is the program of a version that serves some values only.

    Of a frame, boxes are steps with what they leave to each other. A time line says what each
    texture holds from step to step.

    \b
    Example:
        burnish graph plastic.burnish
        burnish graph plastic.burnish -o plastic.svg
        burnish graph plastic.burnish --program
        burnish graph plastic.burnish --program --set shininess=8
        burnish graph plastic.burnish --why
        burnish graph plastic.burnish --error 36,28 -o error.svg
        burnish graph deferred.burnish -o deferred.svg
        burnish graph deferred.burnish --shader Deferred.Toned
    """
    from ...compiler.diagnostics.diagnostic import CompileError

    request = GraphRequest(**{**chosen, "values": each_once(chosen["values"])})
    _check_values(request)
    insist_on_another_file(request.file, request.output)
    try:
        _deliver(request, _subjects(request))
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)


def _check_values(request: GraphRequest) -> None:
    """Raise ``UsageError`` where values of parameters would change nothing of what is shown."""
    if request.values and not request.is_of_programs:
        raise click.UsageError(
            "--set narrows what the program serves, and equations stay as they are: add --program "
            "or --why"
        )
    if request.values and request.error is not None:
        raise click.UsageError(
            "--error shows the error of the whole material, which --set makes a version of: leave "
            "out one"
        )


def _parts(material: CompiledMaterial, request: GraphRequest) -> Mapping[Span, float] | None:
    """The parts that expressions have in the error of the pixel, if there is one."""
    if request.error is None:
        return None
    with errors_as_messages():
        from ...targets.conformance.seen import PixelError
        from .errors import parts

        try:
            return parts(material, request.error, request.case)
        except PixelError as error:
            fail(str(error))


def _subjects(request: GraphRequest) -> Sequence[Subject]:
    """The subjects to show: the frames of the file, one shader of them, or its materials."""
    from ...api import entry_points as api

    result = api.compile(
        request.file,
        (),
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
        hoist=request.hoist,
        values=dict(request.values),
    )
    show(result.diagnostics)
    if not result.frames:
        if request.shader is not None:
            raise click.UsageError(
                "--shader is for frames, and there is none in the file: --material chooses among "
                "materials"
            )
        return result.materials if request.is_of_programs else _equations(request, result.materials)
    if request.shader is not None:
        return [_named(request.shader, result.materials)]
    if request.why:
        return result.materials
    given = {"--error": request.error, "--all": request.everything, "--program": request.program}
    for option, value in given.items():
        if value:
            raise click.UsageError(f"{option} is about one shader of a frame: name it by --shader")
    return result.frames


def _equations(request: GraphRequest, shaders: Sequence[CompiledMaterial]) -> Sequence[Subject]:
    """The equations of materials, and the programs of kernels."""
    from ...api import entry_points as api
    from ...compiler.ir.stages import COMPUTED

    if all(shader.shader.chain == COMPUTED for shader in shaders):
        return shaders
    found = api.equations(
        request.file,
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
    )
    own = {each.name: each for each in found}
    return [own.get(shader.name, shader) for shader in shaders]


def _named(name: str, shaders: Sequence[CompiledMaterial]) -> CompiledMaterial:
    names = [shader.name for shader in shaders]
    if name not in names:
        from ...compiler.diagnostics.nearest import suggestion

        hint = suggestion(name, names) or f"there are {', '.join(names)}"
        raise click.BadParameter(f"there is no shader `{name}`: {hint}", param_hint="--shader")
    return shaders[names.index(name)]


def _deliver(request: GraphRequest, subjects: Sequence[Subject]) -> None:
    from ...api.compiled import CompiledFrame

    form = _form(request)
    if form != "text" and len(subjects) > 1:
        names = ", ".join(subject.name for subject in subjects)
        kind = "frame" if isinstance(subjects[0], CompiledFrame) else "material"
        message = f"a picture shows one {kind}, and there are {names}; choose one"
        raise click.BadParameter(message, param_hint="--material")
    text = "\n".join(_written(subject, request, form) for subject in subjects)
    if form == "text":
        text = harmless_lines(text)
    deliver(request.output, text)


def _form(request: GraphRequest) -> str:
    """The requested format, by name or by the ending of the file's name."""
    if request.why:
        if request.error is not None:
            raise click.UsageError("proofs have no pixel: --why goes without --error")
        if request.form not in (None, "text"):
            raise click.UsageError("proofs are text: --why goes with no other --format")
        return "text"
    ending = Path(request.output).suffix.removeprefix(".")
    known = {"svg": "svg", "dot": "dot", "gv": "dot", "txt": "text"}
    if request.form is None and request.output != STDOUT and ending not in known:
        message = f"`{request.output}` ends in none of .svg, .dot, .txt; say which --format"
        raise click.BadParameter(message, param_hint="--output")
    return request.form or known.get(ending, "text")


def _written(subject: Subject, request: GraphRequest, form: str) -> str:
    from ...api.compiled import CompiledMaterial

    if request.why and isinstance(subject, CompiledMaterial):
        from .why import written

        title = f"{subject.name}, pass {subject.shader.pass_name}, rig {subject.shader.rig_name}"
        return written(title, subject.proofs)
    parts = _parts(subject, request) if isinstance(subject, CompiledMaterial) else None
    found = picture_of(subject, everything=request.everything, parts=parts)
    if form == "text":
        from .text import written as as_text

        return as_text(found)
    if form == "dot":
        from .dot import written as as_dot

        return as_dot(found)
    return _drawn(subject.name, found)


def picture_of(
    subject: Subject,
    *,
    everything: bool = False,
    parts: Mapping[Span, float] | None = None,
) -> Picture:
    """The contents of the picture of a frame, of a material's equations, or of a program.

    For the options of a program see ``program_picture``.
    """
    from ...api.compiled import CompiledFrame, CompiledMaterial

    if isinstance(subject, CompiledFrame):
        from .frame import frame_picture

        return frame_picture(subject)
    if not isinstance(subject, CompiledMaterial):
        from .equations import equations_picture

        return equations_picture(subject)
    from .program import program_picture

    return program_picture(subject.shader, subject.staged, everything=everything, parts=parts)


def as_svg(subject: Subject) -> str:
    """The picture of a frame, of a material's equations, or of a program, for ``burnish gallery``.

    Raises ``CompileError`` if it is too large to be read.
    """
    return _drawn(subject.name, picture_of(subject))


def _drawn(name: str, found: Picture) -> str:
    """The picture as SVG; raises ``CompileError`` if it has too many boxes."""
    from ...compiler.diagnostics import rules
    from ...compiler.diagnostics.diagnostic import CompileError, Report
    from .svg import drawn

    count = len(found.boxes)
    if count > LARGEST:
        report = Report()
        report.add(rules.TOO_LARGE_TO_DRAW, None, name=name, count=count, limit=LARGEST)
        raise CompileError(report.diagnostics)
    return drawn(found)
