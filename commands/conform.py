"""``burnish conform``: checks that all backends draw the meaning of a material."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .answering import collector
from .compared import ConformRequest
from .console import Styled, remark, say
from .failures import errors_as_messages
from .options import (
    answer_option,
    budget_option,
    check_device,
    device_option,
    each_once,
    hoist_option,
    narrowed_option,
    native_stages_option,
    pass_option,
    pixel,
    rig_option,
    search_option,
)
from .stopping import Stopping
from .terminal import FAILED
from .verdicts import Table, passed, print_summary, write_report

if TYPE_CHECKING:
    from ..targets.runner.routes import Route
    from .conform_run import Run


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, metavar="FILE…")
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
    "--measure", is_flag=True,
    help="Instead of comparing files, measure how precisely the devices of --routes filter "
    "textures (by default of `vulkan,opengl,wgpu`), and keep it for later runs on these devices.",
)  # fmt: skip
@click.option(
    "--golden", metavar="FOLDER", type=click.Path(path_type=Path),
    help="Instead of drawing, write between which numbers each pixel lies on every device that "
    "keeps the promises of --routes (by default of `vulkan,opengl,wgpu`), and what to draw: "
    "`burnish judge` compares any picture with it.",
)  # fmt: skip
@click.option(
    "--seed", type=int, default=0, show_default=True,
    help="The seed of random parameters, textures and vertex inputs.",
)  # fmt: skip
@click.option(
    "--scheduler", metavar="ADDRESS",
    help="Have the workers of a farm compile and draw, which Dask's scheduler at this address "
    "knows, such as tcp://10.0.0.7:8786.",
)  # fmt: skip
@rig_option
@pass_option
@search_option
@hoist_option
@native_stages_option
@narrowed_option
@answer_option
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

    What is guaranteed of a device of this machine is little. --measure draws ramps, levels and
    cubes on it, which takes seconds, and finds how it rounds: then its pictures are held against
    that first, and only where they leave it against what is guaranteed. What was found is kept by
    driver, device and version, so measure again after an update of the driver.

    --golden draws nothing, and needs neither compilers nor devices. It writes the bounds of what
    any device of the routes may draw, for each case, with the reference, the texts, the bytes of
    all blocks, meshes and textures, and golden.json, which names them. By default they hold for
    every device that keeps what Vulkan, OpenGL and WebGPU promise; with --routes for fewer, which
    may be narrower. Existing files of the same names are replaced, all or none.

    With --native-stages, routes draw with the stages that their target has for primitives, and what
    the reference draws is the same: a route whose target has no such stage is not run.

    With --set, as for `burnish compile`, routes draw a version that serves some values only, and it
    is compared with the meaning of the whole material, drawn with such values.

    With --scheduler, other machines do the work: `dask scheduler` runs on one of them, and `dask
    worker ADDRESS --nworkers 1` on each that draws. They need no disk in common, but the same
    Burnish, and the drivers of the routes: a worker without them is told, and gets nothing. What a
    worker had begun that dies is done again elsewhere, and rows are the same as without a farm.

    \b
    Example:
        burnish conform plastic.burnish
        burnish conform car.burnish --set coat_weight=0 --set specular_roughness=0.3..0.5
        burnish conform materials/*.burnish --routes lavapipe,chromium --report build/conformance
        burnish conform --measure --routes vulkan,wgpu --device nvidia
        burnish conform plastic.burnish --routes vulkan,wgpu --device nvidia
        burnish conform plastic.burnish --golden golden/
        burnish conform materials/*.burnish --routes lavapipe --scheduler tcp://10.0.0.7:8786
        burnish conform plastic.burnish --explain 36,28 --case stretched --routes lavapipe:glsl
    """
    request = ConformRequest(**{**chosen, "values": each_once(chosen["values"])})
    _check_options(request)
    with Stopping() as stopping, errors_as_messages():
        _check_folder(request.report)
        _check_folder(request.golden)
        routes = _routes(request)
        if request.measure:
            with stopping.at_once():
                _measure(request, routes)
        elif request.golden is not None:
            with stopping.at_once():
                _write_golden(request, routes, request.golden, stopping)
        elif request.explain is None:
            _judge(request, routes, stopping)
        else:
            with stopping.at_once():
                _explain(request, routes, stopping, request.explain)


def _check_options(request: ConformRequest) -> None:
    """Raise ``UsageError`` for options that would have no effect together."""
    _check_farm(request)
    if request.measure:
        _check_measuring(request)
        return
    if not request.files:
        raise click.UsageError("Missing argument 'FILE…'.")
    if request.golden is not None:
        _check_golden(request)
        return
    if request.explain is not None and request.values:
        raise click.UsageError(
            "--explain shows the whole material, which --set makes a version of: leave out one"
        )
    if request.explain is None:
        if request.case is not None:
            raise click.UsageError("--case names the scene of a pixel: it goes with --explain")
        return
    for option, given in (("--report", request.report), ("--strict", request.strict)):
        if given:
            raise click.UsageError(
                f"{option} is about verdicts, which --explain does not give: leave out one of them"
            )


def _check_farm(request: ConformRequest) -> None:
    """Raise ``UsageError`` for what is done by this machine alone."""
    for given, option in (
        (request.measure, "--measure"),
        (request.golden, "--golden"),
        (request.explain, "--explain"),
    ):
        if request.scheduler is not None and given:
            raise click.UsageError(
                f"--scheduler compares on other machines, and {option} works on this one: leave "
                "out one of them"
            )


def _check_golden(request: ConformRequest) -> None:
    """Raise ``UsageError`` for what has no effect where nothing is drawn."""
    for given, option in (
        (request.report, "--report"),
        (request.strict, "--strict"),
        (request.explain, "--explain"),
        (request.case, "--case"),
        (request.device, "--device"),
        (request.native_stages, "--native-stages"),
        (request.values, "--set"),
    ):
        if given:
            raise click.UsageError(
                f"--golden draws nothing, so {option} has no effect: leave out one of them"
            )


def _check_measuring(request: ConformRequest) -> None:
    """Raise ``UsageError`` for what has no effect where devices are measured."""
    for given, what in (
        (request.files, "a FILE"),
        (request.report, "--report"),
        (request.strict, "--strict"),
        (request.explain, "--explain"),
        (request.case, "--case"),
        (request.golden, "--golden"),
        (request.rig, "--rig"),
        (request.pass_, "--pass"),
        (request.native_stages, "--native-stages"),
        (request.values, "--set"),
    ):
        if given:
            raise click.UsageError(
                f"--measure compares nothing, so {what} has no effect: leave out one of them"
            )


def _check_folder(folder: Path | None) -> None:
    """Raise ``CompileError`` if a folder cannot be written, before drawing, which may take long."""
    from .output import obstacle, unwritable

    if folder is not None and (reason := obstacle(folder)):
        raise unwritable(folder, reason)


def _routes(request: ConformRequest) -> Sequence[Route]:
    from ..targets.runner.routes import select

    routes = select([_wanted(request)])
    if not routes:
        raise click.UsageError("--routes names no route")
    check_device(request.device, routes)
    return routes


def _wanted(request: ConformRequest) -> str:
    """The names of the routes; those that draw the same on every machine need no measuring, and
    what is promised of them is known by drawing with them."""
    from ..targets.runner.routes import ALL, DEVICE_DRIVERS

    is_usual = (request.measure or request.golden is not None) and request.routes == ALL
    return ",".join(DEVICE_DRIVERS) if is_usual else request.routes


def _measure(request: ConformRequest, routes: Sequence[Route]) -> None:
    """Measure the devices of the routes."""
    from .measure import measure

    measure(routes, request.device, named=request.routes != "all")


def _write_golden(
    request: ConformRequest, routes: Sequence[Route], folder: Path, stopping: Stopping
) -> None:
    """Write a golden folder."""
    from .golden import write_golden

    write_golden(request, routes, folder, stopping)


def _judge(request: ConformRequest, routes: Sequence[Route], stopping: Stopping) -> None:
    """Draw everything, and print and write the verdicts: of what is known, if a signal or an error
    ends the run early."""
    from .conform_run import Run

    table = Table(routes)
    run = Run(request, routes, stopping, table.add)
    with stopping.later():
        try:
            with stopping.at_once():
                run.draw()
        finally:
            if run.total is not None or stopping.asked:
                _give_verdicts(request, run, table)
        if not passed(run.rows, asked=request.routes != "all", strict=request.strict):
            click.get_current_context().exit(FAILED)


def _give_verdicts(request: ConformRequest, run: Run, table: Table) -> None:
    """Print and write what is known."""
    from ..targets.conformance.summary import Unfinished

    rows = run.rows
    unfinished = None if len(rows) == run.total else Unfinished(len(rows), run.total)
    if (collected := collector()) is not None:
        from ..compiler.documents.answer import ConformAnswer
        from ..targets.conformance.report import as_json

        collected.find(ConformAnswer(report=as_json(rows, unfinished, strict=request.strict)))
    try:
        table.end(rows)
        print_summary(rows, unfinished, strict=request.strict)
    finally:
        if request.report is not None:
            write_report(request.report, rows, unfinished, strict=request.strict)


def _explain(
    request: ConformRequest, routes: Sequence[Route], stopping: Stopping, pixel: tuple[int, int]
) -> None:
    """Explain one pixel of every material; then report the materials where that failed."""
    from ..targets.conformance.explaining import explanation_lines
    from ..targets.conformance.seen import PixelError
    from ..targets.conformance.summary import by_material
    from .conform_run import Run

    run = Run(request, routes, stopping)
    run.draw()
    own = by_material(run.rows)
    unexplained = []
    for label, material in run.subjects:
        try:
            lines = list(explanation_lines(material, own[label], request.seed, pixel, request.case))
        except PixelError as error:
            unexplained.append(f"{label}: {error}" if len(run.subjects) > 1 else str(error))
            continue
        say(Styled(label, is_bold=True))
        for line in lines:
            say(f"  {line}".rstrip())
        say()
    for text in unexplained:
        remark("error", text)
    if unexplained:
        click.get_current_context().exit(FAILED)
