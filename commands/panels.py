"""Draws the subjects of ``burnish render`` and of the gallery by any route, as panels of sheets."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING

from ..compiler.budget import check
from .console import remark
from .progress import Progress
from .subjects import RenderRequest, Subject

if TYPE_CHECKING:
    from ..compiler.documents.plan import FramePlan
    from ..targets.runner.frames.by_reference import Floats
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner
    from ..targets.runner.sheet import Panel
    from ..targets.toolchain import Toolchain

_UNDEFINED = "the pixels that use it are not defined"
NOT_RUN = "not run"
"""The title of a panel whose route lacks its tools, or a feature that the frame needs."""
BROKEN = "failed"
"""The title of a panel for which a compiler, a driver or the reference failed."""
_OF_A_PIXEL = 4
"""Bytes of an image in memory."""

Times = list[list["Panel"]]
"""For each time that a subject is drawn, a panel for each of its outputs."""


def panels(
    subjects: Sequence[Subject],
    routes: Sequence[Route | None],
    request: RenderRequest,
    runner: Runner,
    toolchain: Toolchain,
    progress: Progress,
) -> Iterator[Times]:
    """The panels of each subject by each route, one subject after the other; the route ``None`` is
    the reference.

    If something could not be drawn, its panels say so, all of them one and the same; if there is
    only one subject and route, its ``CodeError``, ``DriverError``, ``PlanError`` or
    ``UndrawableError`` is raised. Raises ``BudgetError`` if there is no room for all pictures.
    """
    from ..targets.runner.codes import CodeError
    from ..targets.runner.drivers.device import DriverError
    from ..targets.runner.frames.checking import PlanError
    from ..targets.runner.kernels import UndrawableError
    from ..targets.runner.sheet import Panel

    pairs = list(product(subjects, routes))
    for done, (subject, route) in enumerate(pairs):

        def tell(share: float, done: int = done) -> None:
            progress.tell((done + share) / len(pairs))

        titles = (*subject.titles, _name(route))
        if route is not None and (problem := _problem(subject, route, runner)):
            yield _without_picture(Panel(titles, problem, None, NOT_RUN), subject, request)
            continue
        times: Times = []
        try:
            note = "float64" if route is None else runner.device(route).title
            for pictures in _pictures(subject, route, request.frames, runner, toolchain, tell):
                times.append(_shown(subject, pictures, _name(route), note, request))
                _check_room(times[0], len(pairs) * request.frames)
        except (CodeError, DriverError, PlanError, UndrawableError) as error:
            if len(pairs) == 1:
                raise
            yield _without_picture(Panel(titles, str(error), None, BROKEN), subject, request)
        else:
            yield times
        tell(1)


def _name(route: Route | None) -> str:
    return route.name if route else "reference"


def _problem(subject: Subject, route: Route, runner: Runner) -> str | None:
    """The reason why a route cannot draw a subject, or ``None``."""
    from ..targets.runner.subject import lacking

    return runner.problem(route) or lacking(subject.host.shaders, route)


def _without_picture(panel: Panel, subject: Subject, request: RenderRequest) -> Times:
    """The same panel in place of all pictures of a subject."""
    return [[panel] * len(subject.outputs)] * request.frames


# --- pictures ------------------------------------------------------------------------------------


def _pictures(
    subject: Subject,
    route: Route | None,
    count: int,
    runner: Runner,
    toolchain: Toolchain,
    tell: Callable[[float], None],
) -> Iterator[Mapping[str, Floats]]:
    """The outputs of a subject by name, each time that it is drawn: (layers, height, width, lanes).

    Raises ``CodeError``, ``DriverError``, ``PlanError``, ``UndrawableError`` and ``BudgetError``.
    """
    from ..targets.runner.frames.plan_files import told_contradictions
    from ..targets.web_host.drawing import draw_frames

    with told_contradictions(subject.host.frame):
        if route is None:
            yield from _by_reference(subject, count, tell)
        else:
            yield from draw_frames(subject.host, route, runner, toolchain, count)


def _by_reference(
    subject: Subject, count: int, tell: Callable[[float], None]
) -> Iterator[Mapping[str, Floats]]:
    from ..targets.runner.frames.by_reference import ReferenceFrames

    drawing = ReferenceFrames(subject.host)
    for number in range(count):

        def tell_part(share: float, number: int = number) -> None:
            tell((number + share) / count)

        drawing.draw(tell_part)
        yield {name: drawing.output(name).levels[0][0] for name in subject.outputs}
    for value in drawing.broken_promises():
        remark(
            "warning",
            f"{subject.label}: `{value}` is promised not to be zero, and is: {_UNDEFINED}",
        )


def _shown(
    subject: Subject, pictures: Mapping[str, Floats], route: str, note: str, request: RenderRequest
) -> list[Panel]:
    """The panels of one time: with images, or with numbers if that is what the file keeps.

    Layers, or faces, stand one below the other.
    """
    import numpy as np

    from ..targets.runner.pictures import keeps_numbers, to_image
    from ..targets.runner.sheet import Panel
    from .developing import Development

    development = Development(request.exposure, request.tone)
    found = []
    for output, titles in subject.outputs.items():
        pixels, lanes = np.concatenate(list(pictures[output])), _lanes(subject.host.plan, output)
        has_numbers = keeps_numbers(request.output)
        image = None if has_numbers else to_image(pixels, lanes, development.applied)
        numbers = pixels if has_numbers else None
        found.append(Panel((*titles, route), note, image, numbers=numbers, lanes=lanes))
    return found


def _lanes(plan: FramePlan, output: str) -> int:
    """The number of lanes of an output's format."""
    from ..compiler.ir.formats import DEPTH_WORDS, TARGET_FORMATS
    from ..compiler.ir.types import width

    texture = plan.output_texture(output)
    assert texture is not None, "it is a picture"
    name = plan.textures[texture].format
    return 1 if name in DEPTH_WORDS else width(TARGET_FORMATS[name].type)


def _check_room(panels: Iterable[Panel], times: int) -> None:
    """Raise ``BudgetError`` if there is no room for ``times`` as many panels.

    They are kept until all files are written together, with a copy of them in a file.
    """
    sizes = []
    for panel in panels:
        width, height = panel.image.size if panel.image else (0, 0)
        numbers = 0 if panel.numbers is None else panel.numbers.nbytes
        sizes.append(2 * (width * height * _OF_A_PIXEL + numbers))
    check("memory", times * sum(sizes), f"{times * len(sizes)} pictures need")
