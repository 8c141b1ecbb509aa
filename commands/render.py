"""``burnish render``: pictures of a material, by the reference or by real drivers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .console import show
from .failures import fail, told
from .options import file_argument, pass_option, rig_option, search_option
from .progress import Progress

if TYPE_CHECKING:
    from ..api import CompiledMaterial
    from ..targets.runner.instance import Instance
    from ..targets.runner.pictures import Panel
    from ..targets.runner.render import Floats
    from ..targets.runner.routes import Route
    from ..targets.runner.shots import Shot

REFERENCE = "reference"
EVERYTHING = "all"
LARGEST = 8192
MESHES = ("sphere", "plane", "cube", "torus")
BACKGROUND = "#1b1d21"


class Request(NamedTuple):
    """What the command line asks for."""

    file: Path
    output: Path
    on: str
    mesh: str
    size: tuple[int, int]
    values: tuple[tuple[str, str], ...]
    background: str
    target: str | None
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]


def _size(_context: click.Context, _option: click.Parameter, given: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d+)(?:x(\d+))?", given)
    if not found:
        raise click.BadParameter(f"'{given}' is neither 512 nor 640x480")
    size = int(found[1]), int(found[2] or found[1])
    if not all(1 <= side <= LARGEST for side in size):
        raise click.BadParameter(f"a side has 1 to {LARGEST} pixels")
    return size


def _pairs(
    _context: click.Context, _option: click.Parameter, given: Sequence[str]
) -> tuple[tuple[str, str], ...]:
    for text in given:
        if not re.match(r"[^=]+=", text):
            raise click.BadParameter(f"'{text}' is not NAME=VALUE")
    return tuple(
        (name.strip(), value.strip()) for name, _, value in (t.partition("=") for t in given)
    )


@click.command()
@file_argument
@click.option(
    "-o", "--output", metavar="PICTURE", required=True, type=click.Path(path_type=Path),
    help="The file to write, .png or another image format.",
)  # fmt: skip
@click.option(
    "--on", metavar="ROUTE,…", default=REFERENCE, show_default=True,
    help="What draws: `reference`, routes as `burnish doctor` lists them, or `all`.",
)  # fmt: skip
@click.option("--mesh", type=click.Choice(MESHES), default="sphere", show_default=True)
@click.option(
    "--size", metavar="N[xM]", default="512", callback=_size, show_default=True,
    help="Pixels of the picture, or of each one on a sheet.",
)  # fmt: skip
@click.option(
    "--set", "values", metavar="NAME=VALUE", multiple=True, callback=_pairs,
    help="A parameter or a texture; may be given many times.",
)  # fmt: skip
@click.option(
    "--background", metavar="COLOR", default=BACKGROUND, show_default=True,
    help="What is behind the mesh.",
)  # fmt: skip
@click.option("--target", metavar="NAME", help="The render target to show, if not the first.")
@click.option("--material", metavar="NAME", help="Only this material, instead of all in the file.")
@rig_option
@pass_option
@search_option
def render(**chosen: Any) -> None:
    """Draw the materials of FILE.

    The reference needs no GPU. It defines what a picture has to be, and the other routes are
    Burnish's texts on real compilers and drivers. Of several materials or routes the picture is a
    sheet: a row for each material, a column for each route.

    A scene with a camera and lights is set up by itself; `--set` comes after it. Values are
    written like `power=32`, `base=#ff8800`, `torch.axis=0,-1,0`, `torch.outer=40deg`,
    `lamps.count=2`, `lamps[0].place=0,2,1`, `albedo=picture.png`, `albedo=srgb:photo.jpg`.

    \b
    Example:
        burnish render plastic.burnish -o plastic.png
        burnish render plastic.burnish -o torus.png --mesh torus --set power=200
        burnish render plastic.burnish -o sheet.png --on all --size 256
    """
    request = Request(**chosen)
    with told():
        _render(request)


def _render(request: Request) -> None:
    from ..targets.runner.pictures import save, sheet

    routes = _routes(request.on)
    materials = _materials(request, [route for route in routes if route is not None])
    shots = [(material, _shot(material, request)) for material in materials]
    total = len(shots) * len(routes)
    with Progress("drawing") as progress:

        def tell(done: int) -> Callable[[float], None]:
            return lambda share: progress.tell((done + share) / total)

        panels = list(_panels(shots, routes, request, tell))
    only = panels[0]
    if total == 1:
        if only.image is None:
            fail(f"{only.title}: {only.note}")
            return
        save(only.image, request.output)
    else:
        rows = [panels[at : at + len(routes)] for at in range(0, total, len(routes))]
        save(sheet(rows, request.size), request.output)
    click.echo(f"{', '.join(material.name for material in materials)}: {request.output}")


def _routes(text: str) -> list[Route | None]:
    """What draws; ``None`` is the reference. Raises ``UnknownRouteError``."""
    from ..targets.runner.routes import select

    names = [name.strip() for name in text.split(",") if name.strip()]
    own = [None] if {REFERENCE, EVERYTHING} & set(names) else []
    others = select(name for name in names if name != REFERENCE)
    if not own and not others:
        raise click.UsageError("--on names no route")
    return [*own, *others]


def _materials(request: Request, routes: Sequence[Route]) -> tuple[CompiledMaterial, ...]:
    from .. import api

    result = api.compile(
        request.file,
        sorted({route.profile for route in routes}),
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
    )
    show(result.diagnostics)
    return result.materials


def _shot(material: CompiledMaterial, request: Request) -> Shot:
    from ..targets.runner.meshes import mesh
    from ..targets.runner.scene import Scene
    from ..targets.runner.shots import take

    instance = material.instance()
    shot = take(instance, mesh(request.mesh), Scene(), request.size, _color(request.background))
    _apply(request, instance)
    return shot


def _apply(request: Request, instance: Instance) -> None:
    for name, text in request.values:
        instance.set_text(name, text)


def _color(text: str) -> tuple[float, float, float, float]:
    """A colour literal as linear light."""
    from ..targets.runner.textures import Texture

    red, green, blue, alpha = Texture.solid(text).linear()[0][0, 0].tolist()
    return red, green, blue, alpha


def _panels(
    shots: Sequence[tuple[CompiledMaterial, Shot]],
    routes: Sequence[Route | None],
    request: Request,
    tell: Callable[[int], Callable[[float], None]],
) -> Iterator[Panel]:
    """A panel for each material and route, in rows of materials."""
    from ..targets.runner.pictures import Panel, to_image
    from ..targets.runner.render import by_reference, by_route
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain

    wanted = [route for route in routes if route is not None]
    with Runner(wanted) as runner, Toolchain() as toolchain:
        for number, (material, shot, route) in enumerate(
            (material, shot, route) for material, shot in shots for route in routes
        ):
            progress = tell(number)
            if route is None:
                title, note = f"{material.name}: reference", "float64"
                targets = by_reference(material, shot, progress)
            elif problem := runner.problem(route):
                yield Panel(f"{material.name}: {route.name}", problem, None)
                continue
            else:
                device = runner.device(route)
                title, note = f"{material.name}: {route.name}", f"{device.name} {device.version}"
                targets = by_route(material, shot, route, runner, toolchain)
            progress(1.0)
            yield Panel(title, note, to_image(_chosen(material, targets, request.target)))


def _chosen(material: CompiledMaterial, targets: tuple[Floats, ...], wanted: str | None) -> Floats:
    names = [row["name"] for row in material.reflection["targets"]]
    if wanted is None:
        return targets[0]
    if wanted not in names:
        raise click.UsageError(
            f"{material.name} writes no target '{wanted}', but {', '.join(names)}"
        )
    return targets[names.index(wanted)]
