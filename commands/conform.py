"""``burnish conform``: whether all backends draw what a material means."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .console import FAILED, show, wants_color
from .failures import told
from .options import pass_option, rig_option, search_option
from .progress import Progress

if TYPE_CHECKING:
    from ..api import CompiledMaterial
    from ..targets.conformance.rows import Row
    from ..targets.runner.routes import Route

COLORS = {"agrees": "green", "differs": "red", "failed": "red", "not run": "yellow"}


class Request(NamedTuple):
    """What the command line asks for."""

    files: tuple[Path, ...]
    routes: str
    report: Path | None
    seed: int
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@click.option(
    "--routes", metavar="ROUTE,…", default="all", show_default=True,
    help="Ways to a picture, as `burnish doctor` lists them: `lavapipe`, `chromium:webgpu`, ….",
)  # fmt: skip
@click.option(
    "--report", metavar="FOLDER", type=click.Path(path_type=Path),
    help="Where to put report.json and index.html, with pictures of what differs.",
)  # fmt: skip
@click.option(
    "--seed", type=int, default=0, show_default=True,
    help="Where parameters, textures and vertex inputs are drawn from.",
)  # fmt: skip
@rig_option
@pass_option
@search_option
def conform(**chosen: Any) -> None:
    """Draw the materials of each FILE by every route, and compare with the reference.

    All rigs and passes that a file declares are drawn, unless --rig and --pass name one.

    A route is one way from Burnish's text to a picture: a compiler and a driver. Each material is
    drawn in several scenes, with default and drawn values. The exit code is 1 if any route
    disagrees with the reference, or fails; what lacks its tools is `not run`, which is no pass:
    the exit code is 1, too, if such a route was asked for by name, or nothing was run at all.

    \b
    Example:
        burnish conform plastic.burnish
        burnish conform materials/*.burnish --routes lavapipe,chromium --report build/conformance
    """
    request = Request(**chosen)
    with told():
        rows = _rows(request)
        _tell(rows)
        if request.report is not None:
            _write(request.report, rows)
        if not _passed(rows, asked=request.routes != "all"):
            click.get_current_context().exit(FAILED)


def _rows(request: Request) -> list[Row]:
    from ..targets.conformance.conform import conform as run
    from ..targets.runner.routes import select
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain

    routes = select([request.routes])
    if not routes:
        raise click.UsageError("--routes names no route")
    subjects = [
        (_label(path, material, variant), material)
        for path in request.files
        for variant in _variants(path, request)
        for material in _materials(path, request, variant, routes)
    ]
    with Runner(routes) as runner, Toolchain() as toolchain, Progress("comparing") as progress:
        return run(
            subjects, routes, runner, toolchain,
            seed=request.seed, done=lambda done, total: progress.tell(done / total),
        )  # fmt: skip


Variant = tuple[str | None, str | None]
"""Names of a rig and a pass; ``None`` is the library's."""


def _variants(path: Path, request: Request) -> list[Variant]:
    """All under which the file's materials are drawn, as far as the command line leaves a choice."""
    from .. import api

    found = api.variants(path, search_path=request.search_path)
    chosen = [(request.rig or rig, request.pass_ or pass_) for rig, pass_ in found]
    return list(dict.fromkeys(chosen))


def _label(path: Path, material: CompiledMaterial, variant: Variant) -> str:
    return " × ".join([f"{path.name}: {material.name}", *filter(None, variant)])


def _materials(
    path: Path, request: Request, variant: Variant, routes: Sequence[Route]
) -> tuple[CompiledMaterial, ...]:
    from .. import api

    result = api.compile(
        path,
        sorted({route.profile for route in routes}),
        rig=variant[0],
        pass_=variant[1],
        search_path=request.search_path,
    )
    show(result.diagnostics)
    return result.materials


def _tell(rows: Sequence[Row]) -> None:
    from ..targets.conformance.report import counted, details, drawn_by, table

    cells = list(table(rows))
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    color = wants_color(sys.stdout)
    for line in cells:
        *plain, status = (cell.ljust(width) for cell, width in zip(line, widths, strict=True))
        shown = click.style(status.rstrip(), fg=COLORS.get(line[-1]))
        click.echo("  ".join([*plain, shown]), color=color)
    click.echo()
    for line_ in drawn_by(rows):
        click.echo(line_)
    for row in rows:
        if row.status != "not run":
            for line_ in details(row):
                click.echo(f"{row.material}, {row.route.name}: {line_}", err=True)
    click.echo(counted(rows))


def _passed(rows: Sequence[Row], *, asked: bool) -> bool:
    statuses = [row.status for row in rows]
    if "differs" in statuses or "failed" in statuses or "agrees" not in statuses:
        return False
    return not (asked and "not run" in statuses)


def _write(folder: Path, rows: Sequence[Row]) -> None:
    import json

    from ..targets.conformance.report import as_json, page
    from .output import write_all

    data = json.dumps(as_json(rows), indent=2, ensure_ascii=False) + "\n"
    write_all(folder, {"report.json": data, "index.html": page(rows)})
    click.echo(f"report: {folder / 'index.html'}")
