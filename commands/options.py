"""Arguments and options that several commands share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.decorators import FC

from .compile_options import HOIST, INCLUDE, NATIVE_STAGES, PASS, RIG, Option

if TYPE_CHECKING:
    from ..targets.runner.routes import Route

MESHES = ("sphere", "plane", "cube", "torus", "cylinder", "capsule", "knot")
BACKGROUND = "#1b1d21"
"""The colour behind a mesh."""

file_argument = click.argument("file", type=click.Path(path_type=Path))


def option(row: Option) -> Callable[[FC], FC]:
    """The click decorator for an option's row."""
    if row.off:
        flags = f"{row.names[0]}/{row.off}"
        return click.option(flags, row.field, default=True, help=row.help, show_default=True)
    if not row.metavar:
        return click.option(*row.names, row.field, is_flag=True, help=row.help)
    return click.option(
        *row.names, row.field, metavar=row.metavar, required=row.required, multiple=row.many,
        type=click.Path(path_type=Path) if row.is_path else None, help=row.help,
    )  # fmt: skip


device_option = click.option(
    "--device", metavar="NAME", default="",
    help="The device of the routes `vulkan`, `opengl` and `wgpu`: a part of its name, or its "
    "number; by default the first GPU.",
)  # fmt: skip
rig_option = option(RIG)
pass_option = option(PASS)
search_option = option(INCLUDE)
hoist_option = option(HOIST)
native_stages_option = option(NATIVE_STAGES)
instances_option = click.option(
    "--instances", metavar="N", default=4, show_default=True, type=click.IntRange(1, 10_000),
    help="The number of instances of the mesh, if the material distinguishes them.",
)  # fmt: skip
scene_option = click.option(
    "--scene", metavar="MODEL", type=click.Path(path_type=Path),
    help="A glTF 2.0 file, .gltf or .glb, whose objects are drawn instead of meshes.",
)  # fmt: skip
mesh_option = click.option(
    "--mesh", type=click.Choice(MESHES), default="sphere", show_default=True,
    help="The mesh to draw.",
)  # fmt: skip
format_option = click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="Text for people or JSON for programs.",
)


def pairs(
    _context: click.Context, _option: click.Parameter, given: Sequence[str]
) -> tuple[tuple[str, str], ...]:
    """The callback of an option whose values are like ``power=32``."""
    found = []
    for text in given:
        name, _, value = (part.strip() for part in text.partition("="))
        if not name or not value:
            raise click.BadParameter(f"'{text}' is not NAME=VALUE")
        found.append((name, value))
    return tuple(found)


def _each_once(
    context: click.Context, option_: click.Parameter, given: Sequence[str]
) -> tuple[tuple[str, str], ...]:
    """The callback of ``--set``: of two values for one name, neither is certainly meant."""
    found = pairs(context, option_, given)
    known: dict[str, str] = {}
    for name, value in found:
        if name in known:
            raise click.BadParameter(f"'{name}' is set twice, to {known[name]} and to {value}")
        known[name] = value
    return found


values_option = click.option(
    "--set", "values", metavar="NAME=VALUE", multiple=True, callback=_each_once,
    help="A parameter or a texture, or that of one material, as Clay.base; may be given many "
    "times.",
)  # fmt: skip


def _raise_limits(context: click.Context, _option: click.Parameter, given: Sequence[str]) -> None:
    """The callback of ``--budget``: limits are raised until the command ends."""
    from ..compiler.budget import LIMITS, amount_of, raised

    limits = {}
    for name, text in pairs(context, _option, given):
        if name not in LIMITS:
            from ..compiler.diagnostics.nearest import suggestion

            hint = suggestion(name, LIMITS) or f"there are {', '.join(LIMITS)}"
            raise click.BadParameter(f"there is no limit '{name}': {hint}")
        try:
            limits[name] = amount_of(text)
        except ValueError as error:
            raise click.BadParameter(str(error)) from error
    context.with_resource(raised(limits))


budget_option = click.option(
    "--budget", metavar="LIMIT=AMOUNT", multiple=True, expose_value=False, callback=_raise_limits,
    help="Allow received data to take more than usual, such as memory=4G; may be given many "
    "times. A command that meets a limit names it.",
)  # fmt: skip


def check_device(device: str, routes: Iterable[Route]) -> None:
    """Raise ``UsageError`` if a device was named, and no route can choose one."""
    from ..targets.runner.routes import DEVICE_ROUTES

    if device and not any(route.name in DEVICE_ROUTES for route in routes):
        raise click.UsageError(f"--device is for the routes {', '.join(DEVICE_ROUTES)}")


def pixel(
    _context: click.Context, _option: click.Parameter, given: str | None
) -> tuple[int, int] | None:
    """The callback of an option whose value is a pixel, such as ``36,28``."""
    if given is None:
        return None
    found = re.fullmatch(r"\s*([0-9]+)\s*,\s*([0-9]+)\s*", given)
    if not found:
        raise click.BadParameter(f"'{given}' is no pixel, which would be like 36,28")
    return int(found[1]), int(found[2])
