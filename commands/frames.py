"""Draws frames for ``burnish render``: one picture, numbered pictures, or one that moves.

``render.py`` calls ``render_frames`` for files that declare frames.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .console import remark, show
from .failures import fail
from .progress import Progress
from .subjects import Request

if TYPE_CHECKING:
    from PIL.Image import Image

    from ..api import CompiledFrame
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.render import Floats
    from ..targets.runner.routes import Route

MOVING = frozenset((".gif", ".webp", ".apng"))
"""The endings of files that hold many pictures."""
DURATION = 40
"""For how many milliseconds such a file shows each of them."""


def has_frames(request: Request) -> bool:
    """Whether a command line is about the frames of a file."""
    from .. import api

    return api.has_frames(request.file, material=request.material, search_path=request.search_path)


def render_frames(request: Request, chosen: Sequence[Route | None]) -> None:
    """Draw the frame of the file, or the one that ``--material`` names; the route ``None`` is the
    reference."""
    routes = _those_that_draw(chosen, request)
    frame = _compiled(request, routes)
    outputs = _outputs(frame, request.target)
    host = _host(frame, request)
    with Progress("drawing") as progress:
        rows = [
            _beside([_image(each) for each in pictures])
            for pictures in zip(*_columns(frame, request, routes, outputs, progress), strict=True)
        ]
    written = _save(rows, request.output)
    further = f" to {written[-1].name}" if len(written) > 1 else ""
    click.echo(f"{frame.name}: {written[0]}{further}")


def _compiled(request: Request, routes: Sequence[Route | None]) -> CompiledFrame:
    """The only frame of the file, with texts for the routes."""
    from .. import api

    profiles = sorted({route.profile for route in routes if route is not None})
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
    frame: CompiledFrame,
    request: Request,
    routes: Sequence[Route | None],
    outputs: Sequence[str],
    progress: Progress,
) -> Iterator[list[Floats]]:
    """For each route and output what it shows, frame after frame."""
    from ..targets.runner.frames.by_route import draw_frames
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain
    from .lacking import tell_lacking_tools

    drivers = [route for route in routes if route is not None]
    with Runner(drivers, device=request.device) as runner, Toolchain() as toolchain:
        tell_lacking_tools(drivers, runner, fatal=True)
        for done, route in enumerate(routes):
            if route is None:
                drawn = list(_by_reference(frame, request, outputs, progress))
            else:
                drawn = draw_frames(_host(frame, request), route, runner, toolchain, request.frames)
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
    frame: CompiledFrame, request: Request, outputs: Sequence[str], progress: Progress
) -> Iterator[dict[str, Floats]]:
    from ..targets.runner.frames.by_reference import ReferenceFrames

    drawing = ReferenceFrames(_host(frame, request))
    for number in range(request.frames):
        drawing.draw(_within(progress, number, request.frames))
        yield {name: drawing.output(name).levels[0][0] for name in outputs}


def _host(frame: CompiledFrame, request: Request) -> FrameHost:
    """The frame with a scene and all values set."""
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.scenery import in_a_row

    tags = {row["name"]: row["materials"] for row in frame.plan["models"]}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, request.mesh), request.size)
    for name, text in request.values:
        host.set_text(name, text)
    return host


def _outputs(frame: CompiledFrame, wanted: str | None) -> list[str]:
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


def _image(layers: Floats) -> Image:
    """The first level of a texture: its layers, or faces, side by side."""
    import numpy as np

    from ..targets.runner.pictures import to_image

    return to_image(np.concatenate(list(layers), axis=1), lanes=layers.shape[-1])


def _beside(images: Sequence[Image]) -> Image:
    """Pictures next to each other."""
    from PIL import Image as Pictures

    whole = Pictures.new("RGB", (sum(i.width for i in images), max(i.height for i in images)))
    left = 0
    for image in images:
        whole.paste(image, (left, 0))
        left += image.width
    return whole


def _save(pictures: Sequence[Image], path: Path) -> list[Path]:
    """Write one picture, one file that moves, or numbered pictures; all of them or none."""
    from ..targets.runner.pictures import encoded

    if len(pictures) == 1 or path.suffix.lower() in MOVING:
        further: Mapping[str, Any] = {}
        if len(pictures) > 1:
            further = {
                "save_all": True, "append_images": pictures[1:], "duration": DURATION, "loop": 0,
            }  # fmt: skip
        return _write(path.parent, {path.name: encoded(pictures[0], path, **further)})
    digits = max(len(str(len(pictures) - 1)), 3)
    names = [f"{path.stem}-{number:0{digits}}{path.suffix}" for number in range(len(pictures))]
    files = {name: encoded(each, path) for name, each in zip(names, pictures, strict=True)}
    return _write(path.parent, files)


def _write(folder: Path, files: Mapping[str, bytes]) -> list[Path]:
    from .output import write_file
    from .replacing import replace_all

    try:
        if len(files) == 1:
            ((name, content),) = files.items()
            write_file(folder / name, content)
        else:
            replace_all(str(folder), files)
    except OSError as error:
        fail(f"cannot write `{error.filename or folder}`: {error.strerror or error}")
    return [folder / name for name in files]
