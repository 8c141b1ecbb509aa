"""``burnish conform``: checks that all backends draw the meaning of a material."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .compared import ConformRequest, Subjects, subjects_of
from .console import Styled, remark, say
from .failures import told
from .options import (
    budget_option,
    check_device,
    device_option,
    hoist_option,
    native_stages_option,
    pass_option,
    pixel,
    rig_option,
    search_option,
)
from .terminal import FAILED

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner

SEVERAL = 4
"""The number of materials from which on the reference draws in processes of its own."""

COLORS = {
    "agrees": "green", "differs": "red", "proves little": "yellow", "overflows": "red",
    "failed": "red", "not run": "yellow",
}  # fmt: skip


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@click.option(
    "--routes", metavar="ROUTE,…", default="all", show_default=True,
    help="Routes to draw with, as `burnish doctor` lists them: `lavapipe`, `chromium:webgpu`, ….",
)  # fmt: skip
@device_option
@budget_option
@click.option(
    "--report", metavar="FOLDER", type=click.Path(path_type=Path),
    help="The folder for index.html, a page with pictures, report.json, and junit.xml.",
)  # fmt: skip
@click.option(
    "--strict", is_flag=True, help="Also exit with 1 where a row proves little.",
)  # fmt: skip
@click.option(
    "--explain", metavar="X,Y", callback=pixel,
    help="Instead of the table, say how inexact this pixel is, and why.",
)  # fmt: skip
@click.option(
    "--case", metavar="NAME",
    help="The pixel's scene: `defaults`, `stretched`, `behind`, `inside`, or `declared` if the "
    "pass blends, masks lanes or has several samples; or the output of a frame. By default, the "
    "one where the pixel is the least certain.",
)  # fmt: skip
@click.option(
    "--seed", type=int, default=0, show_default=True,
    help="The seed of random parameters, textures and vertex inputs.",
)  # fmt: skip
@rig_option
@pass_option
@search_option
@hoist_option
@native_stages_option
def conform(**chosen: Any) -> None:
    """Draw each FILE with every route, and compare the pictures with the reference.

    A route is one way from Burnish's text to a picture: a compiler and a driver. Each material is
    drawn in several scenes, with default and random values, with every rig and every pass that its
    file declares, unless --rig and --pass name one.

    The exit code is 1 if any route differs from the reference or fails, or if a value overflows.
    `proves little` is a warning: the material magnifies rounding so much that too many of its
    pixels may have nearly any value; with --strict it counts as well. A route that lacks its tools,
    or a feature that the material needs, is `not run`. The exit code is also 1 if such a route was
    named on the command line, or if no route was run.

    --explain shows the way of the error at one pixel: its value and its bounds, what each route has
    drawn, which operations contribute how much, and where precision is lost. Pixels are counted
    from 0,0 in the upper left corner. Of a frame it says which step has made the pixel, and what
    carries the error to it.

    With --native-stages, routes draw with the stages that their target has for primitives, and what
    the reference draws is the same: a route whose target has no such stage is not run.

    \b
    Example:
        burnish conform plastic.burnish
        burnish conform materials/*.burnish --routes lavapipe,chromium --report build/conformance
        burnish conform plastic.burnish --routes vulkan,wgpu --device nvidia
        burnish conform plastic.burnish --explain 36,28 --case stretched --routes lavapipe:glsl
    """
    request = ConformRequest(**chosen)
    _check_options(request)
    with told():
        _check_report(request.report)
        routes = _routes(request)
        subjects, rows = _run(request, routes)
        if request.explain is not None:
            _explain(subjects, rows, request)
            return
        rows = _with_reasons(subjects, rows, request.seed)
        _tell(rows, strict=request.strict)
        if request.report is not None:
            _write(request.report, rows, strict=request.strict)
        if not _passed(rows, asked=request.routes != "all", strict=request.strict):
            click.get_current_context().exit(FAILED)


def _check_options(request: ConformRequest) -> None:
    """Raise ``UsageError`` for options that would have no effect together."""
    if request.explain is None:
        if request.case is not None:
            raise click.UsageError("--case names the scene of a pixel: it goes with --explain")
        return
    for option, given in (("--report", request.report), ("--strict", request.strict)):
        if given:
            raise click.UsageError(
                f"{option} is about verdicts, which --explain does not give: leave out one of them"
            )


def _check_report(folder: Path | None) -> None:
    """Raise ``CompileError`` if no report can be written, before drawing, which may take long."""
    from .output import obstacle, unwritable

    if folder is not None and (reason := obstacle(folder)):
        raise unwritable(folder, reason)


def _routes(request: ConformRequest) -> Sequence[Route]:
    from ..targets.runner.routes import select

    routes = select([request.routes])
    if not routes:
        raise click.UsageError("--routes names no route")
    check_device(request.device, routes)
    return routes


def _run(request: ConformRequest, routes: Sequence[Route]) -> tuple[Subjects, list[Row]]:
    """Compile and draw everything; the rows of a material follow each other."""
    from ..targets.conformance.conform import conform as run
    from ..targets.runner.reference_process import References
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain
    from .progress import Progress

    with (
        Runner(routes, device=request.device) as runner,
        Toolchain() as toolchain,
        Progress("comparing") as progress,
    ):
        if request.device:
            _check_named_device(runner, routes)
        subjects = subjects_of(request, routes, native_stages=False)
        _check_pixel(request, subjects)
        drawn = subjects
        if request.native_stages:
            drawn = subjects_of(request, routes, native_stages=True)
        # Processes take a while to start, which pays off for several materials.
        with References(os.cpu_count() or 1 if len(subjects) >= SEVERAL else 0) as references:
            rows = run(
                drawn, routes, runner, toolchain, seed=request.seed, draw=references.expected,
                meant=dict(subjects),
                done=lambda done, total: progress.tell(done / total),
            )  # fmt: skip
    return subjects, rows


def _check_pixel(request: ConformRequest, subjects: Subjects) -> None:
    """Raise ``BadParameter`` for a pixel that no picture has, before long drawing.

    Pictures of frames may be larger: their size is known when they are drawn.
    """
    from ..targets.conformance.explaining import check_pixel
    from ..targets.conformance.seen import PixelError
    from ..targets.runner.frames.subjects import is_shader

    if request.explain is not None and all(is_shader(subject) for _, subject in subjects):
        try:
            check_pixel(request.explain)
        except PixelError as error:
            raise click.BadParameter(str(error), param_hint="--explain") from error


def _check_named_device(runner: Runner, routes: Sequence[Route]) -> None:
    """Raise ``DriverError`` if there is no such device, instead of once for each material."""
    for route in routes:
        if runner.problem(route) is None:
            runner.device(route)


def _explain(subjects: Subjects, rows: Sequence[Row], request: ConformRequest) -> None:
    """Explain one pixel of every material; then report the materials where that failed."""
    from ..targets.conformance.explaining import explanation_lines
    from ..targets.conformance.seen import PixelError
    from ..targets.conformance.summary import by_material

    assert request.explain is not None
    own = by_material(rows)
    unexplained = []
    for label, material in subjects:
        try:
            lines = list(
                explanation_lines(material, own[label], request.seed, request.explain, request.case)
            )
        except PixelError as error:
            unexplained.append(f"{label}: {error}" if len(subjects) > 1 else str(error))
            continue
        say(Styled(label, is_bold=True))
        for line in lines:
            say(f"  {line}".rstrip())
        say()
    for text in unexplained:
        remark("error", text)
    if unexplained:
        click.get_current_context().exit(FAILED)


def _with_reasons(subjects: Subjects, rows: Sequence[Row], seed: int) -> list[Row]:
    """The rows, with reasons in the source if they differ or prove little."""
    from ..targets.conformance.explaining import with_reasons
    from ..targets.conformance.summary import by_material

    materials = dict(subjects)
    groups = by_material(rows).items()
    return [row for label, own in groups for row in with_reasons(materials[label], own, seed)]


def _tell(rows: Sequence[Row], *, strict: bool) -> None:
    from ..targets.conformance.summary import (
        by_material,
        counted,
        devices,
        is_failure,
        lacking,
        messages,
        tools,
    )  # fmt: skip

    _print_table(rows)
    for driver, device in devices(rows).items():
        say(f"drawn by {driver}: {device}")
    if versions := tools(rows):
        say(f"with {', '.join(f'{name} {version}' for name, version in versions.items())}")
    for problem, names in lacking(rows).items():
        say(f"not run by {', '.join(names)}: {problem}")
    for material, own in by_material(rows).items():
        for said, lines in messages(own):
            routes = ", ".join(row.route.name for row in said)
            heading = f"{material}, {routes}: {said[0].status}"
            failed = is_failure(said[0], strict=strict)
            remark("error" if failed else "warning", "\n  ".join([heading, *lines]))
    say(counted(rows))


def _print_table(rows: Sequence[Row]) -> None:
    """Print a heading for each material, and below it a line for each route."""
    from ..targets.conformance.summary import HEADINGS, by_material, cells

    widths = [max(map(len, column)) for column in zip(HEADINGS, *map(cells, rows), strict=True)]

    def print_line(texts: Sequence[str]) -> None:
        route, status, *others = (t.ljust(w) for t, w in zip(texts, widths, strict=True))
        say(f"  {route}  ", Styled(status, COLORS.get(texts[1])), "  ".join(["", *others]).rstrip())

    print_line(HEADINGS)
    for material, own in by_material(rows).items():
        say(Styled(material, is_bold=True))
        for row in own:
            print_line(cells(row))
    say()


def _passed(rows: Sequence[Row], *, asked: bool, strict: bool) -> bool:
    from ..targets.conformance.summary import is_failure

    if any(is_failure(row, strict=strict) for row in rows):
        return False
    statuses = {row.status for row in rows}
    return bool(statuses - {"not run"}) and not (asked and "not run" in statuses)


def _write(folder: Path, rows: Sequence[Row], *, strict: bool) -> None:
    import json

    from ..targets.conformance.junit import as_junit
    from ..targets.conformance.report import as_json, page
    from .output import write_all

    data = json.dumps(as_json(rows, strict=strict), indent=2, ensure_ascii=False) + "\n"
    tests = as_junit(rows, strict=strict)
    write_all(folder, {"report.json": data, "junit.xml": tests, "index.html": page(rows)})
    say(f"report: {folder / 'index.html'}")
