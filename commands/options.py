"""Arguments and options that several commands share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.decorators import FC

from .compile_options import HOIST, INCLUDE, NATIVE_STAGES, PASS, RIG, Option

if TYPE_CHECKING:
    from ..targets.runner.routes import Route

file_argument = click.argument("file", type=click.Path(path_type=Path))


def option(row: Option) -> Callable[[FC], FC]:
    """What click needs to know of an option."""
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
    help="What the routes `vulkan` and `wgpu` draw with: a part of a device's name, or its number; "
    "by default the first GPU.",
)  # fmt: skip
rig_option = option(RIG)
pass_option = option(PASS)
search_option = option(INCLUDE)
hoist_option = option(HOIST)
native_stages_option = option(NATIVE_STAGES)
instances_option = click.option(
    "--instances", metavar="N", default=4, show_default=True, type=click.IntRange(1, 10_000),
    help="How often to draw the mesh, if the material distinguishes instances.",
)  # fmt: skip
format_option = click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="Text for people or JSON for programs.",
)


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
