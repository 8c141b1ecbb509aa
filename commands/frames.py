"""Draws frames for ``burnish render``: one picture, numbered pictures, or one that moves.

``render.py`` calls ``render_frames`` for files that declare frames.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from .console import remark, show
from .failures import fail
from .frame_files import write_pictures
from .panels import check_single
from .progress import Progress
from .subjects import Request

if TYPE_CHECKING:
    from ..targets.runner.frames.host import FrameHost, PlannedFrame
    from ..targets.runner.frames.scenery import Scenery
    from ..targets.runner.render import Floats
    from ..targets.runner.routes import Route


def has_frames(request: Request) -> bool:
    """Whether a command line is about the frames of a file, or a plan."""
    from .. import api
    from ..targets.runner.frames.plan_files import is_plan

    return is_plan(request.file) or api.has_frames(
        request.file, material=request.material, search_path=request.search_path
    )


def render_frames(request: Request, chosen: Sequence[Route | None]) -> None:
    """Draw the frame of the file, or the one that ``--material`` names; the route ``None`` is the
    reference."""
    routes = _those_that_draw(chosen, request)
    frame = _planned(request, routes)
    outputs = _outputs(frame, request.target)
    made = partial(_host, frame, request, _scenery(frame, request))
    _tell_unused_lamps(made())
    check_single(len(routes) * len(outputs), request.output)
    with Progress("drawing") as progress:
        columns = _columns(made, request, routes, outputs, progress)
        rows = list(zip(*columns, strict=True))
    written = write_pictures(rows, request.output)
    further = f" to {written[-1].name}" if len(written) > 1 else ""
    click.echo(f"{frame.name}: {written[0]}{further}")


def _planned(request: Request, routes: Sequence[Route | None]) -> PlannedFrame:
    """The frame of a plan, or the only one of the file, with texts for the routes."""
    from .. import api
    from ..targets.runner.frames.plan_files import is_plan, read_frame

    profiles = sorted({route.profile for route in routes if route is not None})
    if is_plan(request.file):
        if None in routes:
            raise click.UsageError(
                f"the reference draws what a source means, and {request.file.name} is a plan: name "
                "routes, as in `--on lavapipe`"
            )
        if request.material or request.rig or request.pass_:
            raise click.UsageError("a plan is of one frame and one rig: there is nothing to choose")
        return read_frame(request.file, profiles)
    result = api.compile(
        request.file, profiles, material=request.material, rig=request.rig,
        search_path=request.search_path, hoist=request.hoist,
    )  # fmt: skip
    show(result.diagnostics)
    if len(result.frames) > 1:
        known = ", ".join(frame.name for frame in result.frames)
        fail(f"the file has several frames: choose one of {known} by --material")
    return result.frames[0]


def _columns(
    made: Callable[[], FrameHost],
    request: Request,
    routes: Sequence[Route | None],
    outputs: Sequence[str],
    progress: Progress,
) -> Iterator[list[Floats]]:
    """For each route and output what it shows, frame after frame. ``made`` makes the host of a
    route."""
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain
    from ..targets.web_host.drawing import draw_frames
    from .lacking import tell_lacking_tools

    drivers = [route for route in routes if route is not None]
    with Runner(drivers, device=request.device) as runner, Toolchain() as toolchain:
        tell_lacking_tools(drivers, runner, fatal=True)
        for done, route in enumerate(routes):
            if route is None:
                drawn = list(_by_reference(made(), request, outputs, progress))
            else:
                drawn = draw_frames(made(), route, runner, toolchain, request.frames)
            progress.tell((done + 1) / len(routes))
            yield from ([pictures[name] for pictures in drawn] for name in outputs)


def _those_that_draw(routes: Sequence[Route | None], request: Request) -> Sequence[Route | None]:
    """The routes without those whose drivers draw no frames; ends the command if one was named."""
    from ..targets.runner.routes import EVERY_DRIVER

    others = [r for r in routes if r is not None and not EVERY_DRIVER[r.driver].draws_frames]
    if others:
        said = f"frames are not drawn by {', '.join(route.name for route in others)}"
        if not request.draws_everything:
            fail(said)
        remark("note", said)
    return [route for route in routes if route not in others]


def _by_reference(
    host: FrameHost, request: Request, outputs: Sequence[str], progress: Progress
) -> Iterator[dict[str, Floats]]:
    from ..targets.runner.frames.by_reference import ReferenceFrames

    drawing = ReferenceFrames(host)
    for number in range(request.frames):
        drawing.draw(_within(progress, number, request.frames))
        yield {name: drawing.output(name).levels[0][0] for name in outputs}


def _scenery(frame: PlannedFrame, request: Request) -> Scenery:
    """What there is to draw: a model of each material, or the objects of a file."""
    from ..targets.runner.frames.scenery import in_a_row

    tags = {row["name"]: row["materials"] for row in frame.plan["models"]}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    if request.scene is None:
        return in_a_row(materials, tags, request.mesh)
    from ..targets.runner.frames.staging import staged
    from ..targets.runner.scenes.gltf.reading import read_gltf

    file = read_gltf(request.scene)
    for note in file.notes:
        remark("note", f"{request.scene}: {note}")
    return staged(file, materials, list(tags))


def _tell_unused_lamps(host: FrameHost) -> None:
    for name in host.unused_lamps():
        remark("note", f"the light {name!r} of the scene is left out: the rig has no place for it")


def _host(frame: PlannedFrame, request: Request, scenery: Scenery) -> FrameHost:
    """The frame with a scene and all values set."""
    from ..targets.runner.frames.host import FrameHost

    host = FrameHost(frame, scenery, request.size)
    for name, text in request.values:
        host.set_text(name, text)
    return host


def _outputs(frame: PlannedFrame, wanted: str | None) -> list[str]:
    """The outputs to show: the named one, or all that are pictures."""
    names = [row["name"] for row in frame.plan["outputs"] if row["texture"] is not None]
    if wanted is None:
        if not names:
            fail(f"{frame.name} has no output that is a picture")
        return names
    if wanted not in names:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(wanted, names) or f"there are {', '.join(names)}"
        fail(f"{frame.name} has no output `{wanted}`: {hint}")
    return [wanted]


def _within(progress: Progress, number: int, total: int) -> Callable[[float], None]:
    return lambda share: progress.tell((number + share) / total)
