"""Draws frames for ``burnish render``: one picture, numbered pictures, or one that moves.

``render.py`` calls ``render_frames`` for files that declare frames.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..compiler.documents.plan import FramePlan
from .console import remark, say, show
from .failures import fail
from .frame_files import Shown, check_kept, write_pictures
from .panels import check_single
from .progress import Progress
from .subjects import RenderRequest

if TYPE_CHECKING:
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.scenery import Scenery
    from ..targets.runner.frames.subjects import PlannedFrame
    from ..targets.runner.render import Floats
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain


def has_frames(request: RenderRequest) -> bool:
    """True if a command line asks for the frames of a file, or for a plan."""
    from ..api import entry_points as api
    from ..targets.runner.frames.plan_files import is_plan

    return is_plan(request.file) or api.has_frames(
        request.file, material=request.material, search_path=request.search_path
    )


def render_frames(request: RenderRequest, chosen: Sequence[Route | None]) -> None:
    """Draw the frame of the file, or the one that ``--material`` names; the route ``None`` is the
    reference."""
    from ..targets.runner.frames.plan_files import told_contradictions
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain
    from .lacking import tell_lacking_tools

    frame = _planned(request, chosen)
    routes = those_that_have_all(frame, chosen)
    outputs = frame_outputs(frame, request.target)
    with told_contradictions(frame):
        made = host_maker(frame, request)
    check_single(len(routes) * len(outputs), request.output)
    drivers = [route for route in routes if route is not None]
    with (
        Progress("drawing") as progress,
        Runner(drivers, device=request.device) as runner,
        Toolchain() as toolchain,
        told_contradictions(frame),
    ):
        tell_lacking_tools(drivers, runner, fatal=True)
        rows: list[list[Shown]] = [[] for _ in range(request.frames)]
        for done, route in enumerate(routes):
            drawn = draw_by(route, made, request, runner, toolchain, progress)
            for row, pictures in zip(rows, drawn, strict=True):
                own = [Shown.of(pictures[name], request.output) for name in outputs]
                check_kept(own, len(routes) * request.frames)
                row.extend(own)
            progress.tell((done + 1) / len(routes))
    written = write_pictures(rows, request.output)
    further = f" to {written[-1].name}" if len(written) > 1 else ""
    say(f"{frame.name}: {written[0]}{further}")


def _planned(request: RenderRequest, routes: Sequence[Route | None]) -> PlannedFrame:
    """The frame of a plan, or the only one of the file, with texts for the routes."""
    from ..api import entry_points as api
    from ..targets.runner.frames.plan_files import is_plan, read_frame
    from ..targets.runner.job_sizes import check_work

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
        search_path=request.search_path, hoist=request.hoist, partial=request.draws_everything,
    )  # fmt: skip
    show(result.diagnostics)
    if len(result.frames) > 1:
        known = ", ".join(frame.name for frame in result.frames)
        fail(f"the file has several frames: choose one of {known} by --material")
    frame = result.frames[0]
    for shader in frame.shaders:
        check_work(shader.shader)
    return frame


def host_maker(frame: PlannedFrame, request: RenderRequest) -> Callable[[], FrameHost]:
    """A function that makes the host of each route, with the scene and values of a request."""
    made = partial(_host, frame, request, scenery_of(frame.plan, request.mesh, request.scene))
    _tell_unused_lamps(made())
    return made


def draw_by(
    route: Route | None,
    made: Callable[[], FrameHost],
    request: RenderRequest,
    runner: Runner,
    toolchain: Toolchain,
    progress: Progress,
) -> Iterable[Mapping[str, Floats]]:
    """The outputs, by name, of all frames that a request asks for, one frame after the other; the
    route ``None`` is the reference."""
    from ..targets.web_host.drawing import draw_frames

    if route is None:
        return _by_reference(made(), request, progress)
    return draw_frames(made(), route, runner, toolchain, request.frames)


def those_that_have_all(
    frame: PlannedFrame, routes: Sequence[Route | None]
) -> Sequence[Route | None]:
    """The routes without those whose profiles lack something that a shader needs: such a shader
    has been compiled for the others only."""
    from ..targets.runner.subject import lacking

    found = []
    for route in routes:
        problem = route and lacking(frame.shaders, route)
        if route is None or problem is None:
            found.append(route)
        else:
            remark("note", f"{frame.name} is not drawn by {route.name}: {problem}")
    return found


def _by_reference(
    host: FrameHost, request: RenderRequest, progress: Progress
) -> Iterator[dict[str, Floats]]:
    from ..targets.runner.frames.by_reference import ReferenceFrames

    outputs = [row.name for row in host.plan.outputs if row.texture is not None]
    drawing = ReferenceFrames(host)
    for number in range(request.frames):
        drawing.draw(_within(progress, number, request.frames))
        yield {name: drawing.output(name).levels[0][0] for name in outputs}


def scenery_of(plan: FramePlan, mesh: str, scene: Path | None) -> Scenery:
    """The scene to draw: a model of each material with a mesh, or the objects of a file."""
    from ..targets.runner.frames.scenery import in_a_row

    tags = {row.name: row.materials for row in plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    if scene is None:
        return in_a_row(materials, tags, mesh)
    from ..targets.runner.frames.staging import staged
    from ..targets.runner.scenes.gltf.reading import read_gltf

    file = read_gltf(scene)
    for note in file.notes:
        remark("note", f"{scene}: {note}")
    return staged(file, materials, list(tags))


def _tell_unused_lamps(host: FrameHost) -> None:
    from ..targets.runner.scenes.notes import Notes

    notes = Notes()
    for name in host.unused_lamps():
        notes.add(f"the light {name!r} of the scene", " is left out: the rig has no place for it")
    for note in notes.told():
        remark("note", note)


def _host(frame: PlannedFrame, request: RenderRequest, scenery: Scenery) -> FrameHost:
    """The frame with a scene and all values set."""
    from ..targets.runner.frames.host import FrameHost

    host = FrameHost(frame, scenery, request.size)
    for name, text in request.values:
        host.set_text(name, text)
    return host


def frame_outputs(frame: PlannedFrame, wanted: str | None) -> list[str]:
    """The outputs to show: the named one, or all that are pictures."""
    names = [row.name for row in frame.plan.outputs if row.texture is not None]
    if wanted is None:
        if not names:
            fail(f"{frame.name} has no output that is a picture")
        return names
    if wanted not in names:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(wanted, names) or f"it has {', '.join(f'`{n}`' for n in names)}"
        fail(f"{frame.name} has no output `{wanted}`: {hint}")
    return [wanted]


def _within(progress: Progress, number: int, total: int) -> Callable[[float], None]:
    return lambda share: progress.tell((number + share) / total)
