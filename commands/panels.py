"""Draws the pictures of ``burnish render``: one panel for each subject and route."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import click

from .console import remark
from .progress import Progress
from .subjects import Subject, target_number

if TYPE_CHECKING:
    from ..targets.runner.render import Floats
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner
    from ..targets.runner.sheet import Panel
    from ..targets.toolchain import Toolchain

_UNDEFINED = "the pixels that use it are not defined"
NOT_RUN = "not run"
"""The title of a panel whose route lacks its tools, or a feature that the material needs."""
BROKEN = "failed"
"""The title of a panel for which a compiler, a driver or the reference failed."""


def check_single(count: int, path: Path) -> None:
    """Refuse a sheet in a format for numbers: its captions and borders have none."""
    from ..targets.runner.pictures import keeps_numbers

    if count > 1 and keeps_numbers(path):
        raise click.UsageError(
            f"`{path}` keeps the numbers of one picture, and there are {count}: name one "
            "--material, --rig, --pass, --target and route"
        )


def panels(
    subjects: Sequence[Subject],
    routes: Sequence[Route | None],
    target: str | None,
    runner: Runner,
    progress: Progress,
) -> Iterator[Panel]:
    """A panel for each subject and route, one row per subject; the route ``None`` is the reference.

    ``target`` names the render target to show. If something could not be drawn, its panel says so;
    if there is only one panel, its ``CodeError``, ``DriverError`` or ``UndrawableError`` is raised.
    """
    from ..targets.runner.codes import CodeError
    from ..targets.runner.drivers.device import DriverError
    from ..targets.runner.kernels import UndrawableError
    from ..targets.runner.sheet import Panel
    from ..targets.toolchain import Toolchain

    pairs = list(product(subjects, routes))
    with Toolchain() as toolchain:
        for done, (subject, route) in enumerate(pairs):

            def tell(share: float, done: int = done) -> None:
                progress.tell((done + share) / len(pairs))

            titles = (*subject.titles, route.name if route else "reference")
            problem = _problem(subject, route, runner) if route else None
            if problem:
                yield Panel(titles, problem, None, NOT_RUN)
                continue
            try:
                note, targets = _drawn(subject, route, runner, toolchain, tell)
            except (CodeError, DriverError, UndrawableError) as error:
                if len(pairs) == 1:
                    raise
                yield Panel(titles, str(error), None, BROKEN)
            else:
                yield _panel(titles, note, subject, targets, target)
            tell(1)


def _problem(subject: Subject, route: Route, runner: Runner) -> str | None:
    """The reason why a route cannot draw a material, or ``None``."""
    from ..targets.runner.subject import lacking

    return runner.problem(route) or lacking([subject.material], route)


def _drawn(
    subject: Subject,
    route: Route | None,
    runner: Runner,
    toolchain: Toolchain,
    tell: Callable[[float], None],
) -> tuple[str, tuple[Floats, ...]]:
    """The name of the device that drew, and the render targets' contents."""
    from ..targets.runner.render import by_reference, by_route

    if route is None:
        targets, broken = by_reference(subject.material, subject.state, tell)
        for value in broken:
            remark(
                "warning",
                f"{subject.label}: `{value}` is promised not to be zero, and is: {_UNDEFINED}",
            )
        return "float64", targets
    device = runner.device(route)
    targets = by_route(subject.material, subject.state, route, runner, toolchain)
    return device.title, targets


def _panel(
    titles: tuple[str, ...],
    note: str,
    subject: Subject,
    targets: Sequence[Floats],
    wanted: str | None,
) -> Panel:
    from ..targets.runner.pictures import to_image
    from ..targets.runner.sheet import Panel

    reflection = subject.material.reflection
    number = target_number(reflection, wanted)
    lanes = _LANES[reflection.targets[number].representation]
    shown = to_image(targets[number], lanes=lanes)
    return Panel(titles, note, shown, numbers=targets[number], lanes=lanes)


_LANES = {"float": 1, "vec2": 2, "vec4": 4}
