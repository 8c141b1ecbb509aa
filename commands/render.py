"""``burnish render``: draws materials and frames with the reference or with real drivers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..compiler.budget import allowed, raised
from .console import remark, say
from .failures import errors_as_messages, fail
from .options import (
    BACKGROUND,
    answer_option,
    budget_option,
    check_device,
    device_option,
    environment_option,
    exposure_option,
    eye_option,
    file_argument,
    floor_option,
    hoist_option,
    instances_option,
    look_at_option,
    mesh_option,
    native_stages_option,
    pairs,
    pass_option,
    plain_option,
    rig_option,
    scene_option,
    search_option,
    tone_option,
    turn_option,
    values_option,
    variant_option,
)
from .subjects import EVERYTHING, LARGEST, Color, RenderRequest, Subject
from .terminal import FAILED

if TYPE_CHECKING:
    from ..targets.runner.routes import Route
    from ..targets.runner.sheet import Panel

REFERENCE = "reference"
OF_A_PIXEL = 600
"""The approximate bytes that the reference needs for each pixel of a plain picture."""
LARGEST_SHEET = 2**27
"""The most pixels of all pictures on a sheet together."""


def _names(_context: click.Context, _option: click.Parameter, given: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in given.split(",") if name.strip())


def _size(context: click.Context, _option: click.Parameter, given: str) -> tuple[int, int]:
    found = re.fullmatch(r"([0-9]+)(?:x([0-9]+))?", given)
    if not found:
        raise click.BadParameter(f"'{given}' is neither like 512 nor like 640x480")
    size = int(found[1]), int(found[2] or found[1])
    if not all(1 <= side <= LARGEST for side in size):
        raise click.BadParameter(f"a side has 1 to {LARGEST} pixels")
    # A user who names a size has the memory for it; the budget limits what files ask for.
    needed = size[0] * size[1] * OF_A_PIXEL
    context.with_resource(raised({"memory": allowed("memory") + needed}))
    return size


def _color(_context: click.Context, _option: click.Parameter, given: str) -> Color:
    from ..targets.runner.instances.literals import color_lanes

    lanes = color_lanes(given)
    if lanes is None:
        raise click.BadParameter(f"'{given}' is no colour, which would be '#b5651d'")
    red, green, blue, *alpha = lanes
    return red, green, blue, alpha[0] if alpha else 1.0


@click.command()
@file_argument
@click.option(
    "-o", "--output", metavar="PICTURE", type=click.Path(path_type=Path),
    help="The file to write: .png, .jpg or another image format; .exr and .hdr keep the numbers. "
    "By default it is called like FILE, and lies in the current folder: `plastic.png`.",
)  # fmt: skip
@click.option(
    "--on", metavar="ROUTE,…", default=REFERENCE, show_default=True, callback=_names,
    help="The routes to draw with: `reference`, those that `burnish doctor` lists, or `all`.",
)  # fmt: skip
@device_option
@budget_option
@mesh_option
@floor_option
@scene_option
@variant_option
@environment_option
@eye_option
@look_at_option
@turn_option
@instances_option
@click.option(
    "--size", metavar="N[xM]", default="512", callback=_size, show_default=True,
    help="Pixels of the picture, or of each picture on a sheet.",
)  # fmt: skip
@values_option
@plain_option
@click.option(
    "--steps", metavar="N", default=1, show_default=True, type=click.IntRange(1, 100_000),
    help="The number of times that kernels run; --again passes results to the next run.",
)  # fmt: skip
@click.option(
    "--again", metavar="BUFFER=RESULT", multiple=True, callback=pairs,
    help="The result that a buffer holds in the next step; may be given many times.",
)  # fmt: skip
@click.option(
    "--background", metavar="COLOR", default=BACKGROUND, show_default=True, callback=_color,
    help="The colour behind the mesh.",
)  # fmt: skip
@exposure_option
@tone_option
@click.option(
    "--samples", type=click.Choice(("1", "4")), default="1", show_default=True,
    callback=lambda _context, _option, given: int(given),
    help="The samples of a pixel: 4 smooth the edges of a material, as `burnish view` does.",
)  # fmt: skip
@click.option(
    "--frames", metavar="N", default=1, show_default=True, type=click.IntRange(1, 10_000),
    help="The number of times that a frame is drawn, one after the other.",
)  # fmt: skip
@click.option(
    "--target", metavar="NAME",
    help="The render target to show, if not the first; or the output of a frame, instead of all.",
)  # fmt: skip
@click.option(
    "--material", metavar="NAME",
    help="Only this material, kernel or frame, instead of all in the file.",
)  # fmt: skip
@rig_option
@pass_option
@search_option
@hoist_option
@native_stages_option
@answer_option
def render(file: Path, output: Path | None, **chosen: Any) -> None:
    """Draw the materials or the frames of FILE.

    The reference, which needs no GPU, defines what the picture must be. Other routes draw the
    emitted shaders with real compilers and drivers. Pictures of several materials, frames, outputs,
    rigs or routes are put side by side on a sheet.

    The command sets up a scene with a camera, lights and a studio around them; --set changes it. If
    the first comment of FILE has a command that draws it, its options hold here, too, unless this
    command line has them. Values are written as

    \b
        power=32                     a number; also 40deg, true
        base=#ff8800                 a colour; or base=1,0.25,0 in linear light
        torch.axis=0,-1,0            a part of a light, or of a structure
        lamps.count=2                how many lights of an array are switched on
        Clay.base=#ff8800            of several materials that have such a parameter, that of one
        'lamps[0].place=0,2,1'       a part of one light of an array
        albedo=bricks.png            a texture: of colours or of numbers, as it is declared;
                                     srgb:bricks.png or linear:bricks.png says it here
        sky=px.png,nx.png,…          a cube's faces +x, -x, +y, -y, +z, -z; or layers, slices
        sky=panorama.hdr             or a cube of one picture of all directions, in floats
        lamp.profile=lamp.ies        how bright a lamp is in each direction (IES LM-63)
        lamps=lamps.json             the elements of a buffer

    Kernels over buffers draw nothing. But a `buffer` has the elements of the `result` that is
    called like it, of a kernel in the same file, which the reference runs. For simulations, --steps
    runs it again and again; --again says which buffers continue with the written result.

    A file that declares frames shows their outputs: pictures of the whole frame, with a model of
    each material. For frames that evolve, --frames draws several: as numbered pictures, or as one
    that moves if the output ends in .gif or .webp. With --scene, the objects of a glTF file
    are drawn, each with the material that is called as in that file, or with the only one. Its
    numbers and pictures set the parameters and textures of `std.gltf`; its lights are those of the
    rig, and its first camera sees it all.

    FILE may also be a plan that `burnish compile` has written, NAME.plan.json: routes draw it from
    the files beside it alone, without the source.

    \b
    Example:
        burnish render plastic.burnish -o plastic.png
        burnish render deferred.burnish -o deferred.png --set exposure=2
        burnish render deferred.burnish -o helmet.png --scene helmet.glb
        burnish render plastic.burnish -o torus.png --mesh torus --set power=200
        burnish render plastic.burnish -o sheet.png --on all --size 256
        burnish render cloth.burnish -o cloth.png --steps 50 --again now=after --again before=now
    """
    from .as_asked import named_options, wishes

    request = RenderRequest(file=file, output=output or _usual_output(file), **chosen)
    context = click.get_current_context()
    wished = wishes(request, named_options(context), max(request.size), context.command)
    if wished.note:
        remark("note", wished.note)
    with errors_as_messages():
        _render(request._replace(**wished.options))


def _usual_output(file: Path) -> Path:
    """The picture of a file for which the command line names none: `plastic.png`."""
    from ..targets.runner.frames.plan_files import is_plan

    stem = file.name.removesuffix("".join(file.suffixes[-2:])) if is_plan(file) else file.stem
    return Path(f"{stem}.png")


def _render(request: RenderRequest) -> None:
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain
    from .lacking import tell_lacking_tools
    from .panels import panels
    from .picture_files import pages, write_pages
    from .progress import Progress
    from .subjects import subjects

    _check_output(request.output)
    routes = _routes(request.on)
    _check_reference(request, routes)
    drivers = [route for route in routes if route is not None]
    check_device(request.device, drivers)
    with (
        Progress("drawing") as progress,
        Runner(drivers, device=request.device) as runner,
        Toolchain() as toolchain,
    ):
        tell_lacking_tools(drivers, runner, fatal=not request.draws_everything)
        found = subjects(request, drivers, progress.tell)
        tell_lacking_features(found, drivers)
        size = _checked_size(found, len(routes), request.output)
        drawn = list(panels(found, routes, request, runner, toolchain, progress))
    written = write_pages(list(pages(drawn, len(routes), size)), request.output)
    further = f" to {written[-1].name}" if len(written) > 1 else ""
    say(f"{'; '.join(subject.label for subject in found)}: {written[0]}{further}")
    _tell_failures(panel for times in drawn for panel in times[0])


def _check_reference(request: RenderRequest, routes: Sequence[Route | None]) -> None:
    """Raise ``UsageError`` if the reference shall draw something that only routes can draw."""
    from ..targets.runner.frames.plan_files import is_plan

    if None not in routes:
        return
    if is_plan(request.file):
        raise click.UsageError(
            f"the reference draws what a source means, and {request.file.name} is a plan: name "
            "routes, as in `--on lavapipe`"
        )
    if request.native_stages:
        raise click.UsageError(
            "--native-stages is for routes, and the reference draws without such stages: name "
            "routes, as in `--on lavapipe`"
        )


def _check_output(path: Path) -> None:
    """End the command if the file cannot be written, before drawing, which may take long.

    Raises ``PictureError`` for an unknown image format.
    """
    from ..targets.runner.pictures import check_format
    from .output import obstacle

    check_format(path)
    if reason := obstacle(path.parent, path.name):
        fail(f"cannot write `{path}`: {reason}")


def _routes(names: Sequence[str]) -> list[Route | None]:
    """The routes to draw with; ``None`` is the reference. Raises ``UnknownRouteError``."""
    from ..targets.runner.routes import select

    own = [None] if {REFERENCE, EVERYTHING} & set(names) else []
    others = select(name for name in names if name != REFERENCE)
    if not own and not others:
        raise click.UsageError("--on names no route")
    return [*own, *others]


def tell_lacking_features(subjects: Sequence[Subject], routes: Sequence[Route]) -> None:
    """Report the routes that cannot draw a subject, and the reasons."""
    from ..targets.runner.subject import lacking

    for subject, route in product(subjects, routes):
        if problem := lacking(subject.host.shaders, route):
            remark("note", f"{subject.label} is not drawn by {route.name}: {problem}")


def _checked_size(subjects: Sequence[Subject], routes: int, output: Path) -> tuple[int, int]:
    """The size of a picture on a sheet. Kernels and frames may have pictures of other sizes.

    Raises ``UsageError`` for a sheet that is too large, or in a format for numbers: captions and
    borders have none.
    """
    from ..targets.runner.pictures import keeps_numbers

    count = routes * sum(len(each.outputs) for each in subjects)
    width, height = (max(each.size[axis] for each in subjects) for axis in range(2))
    if count * width * height > LARGEST_SHEET:
        raise click.UsageError(
            f"a sheet of {count} pictures of {width} x {height} pixels is too large: "
            "choose a smaller --size, or fewer routes"
        )
    if count > 1 and keeps_numbers(output):
        raise click.UsageError(
            f"`{output}` keeps the numbers of one picture, and there are {count}: name one "
            "--material, --rig, --pass, --target and route"
        )
    return width, height


def _tell_failures(drawn: Iterable[Panel]) -> None:
    """Report errors of drawing, and end the command if any picture is missing because of them."""
    from .panels import BROKEN

    # All outputs of a subject share the panel that says why they are missing.
    failures = dict.fromkeys(panel for panel in drawn if panel.problem == BROKEN)
    for panel in failures:
        remark("error", f"{', '.join(panel.titles)}: {panel.note}".replace("\n", "\n  "))
    if failures:
        click.get_current_context().exit(FAILED)
