"""Arguments and options that several commands share."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.decorators import FC

from .answering import begin
from .compile_options import FORMAT, HOIST, INCLUDE, NATIVE_STAGES, PASS, RIG, SET, Option

if TYPE_CHECKING:
    from ..targets.runner.routes import Route

MESHES = ("sphere", "plane", "floor", "cube", "torus", "cylinder", "capsule", "knot")
FARTHEST = 1e6
"""The largest coordinate of a camera."""
STUDIO = "studio"
"""The light from all around that is computed unless another is asked for."""
BACKGROUND = "#1b1d21"
"""The colour behind a mesh."""
TONES = ("none", "reinhard", "hable", "aces_narkowicz", "aces", "agx", "khronos_neutral")
"""The ways to bring bright light onto a screen: functions of ``std.tone_mapping``, or to cut it
off."""

file_argument = click.argument("file", type=click.Path(path_type=Path))
files_argument = click.argument(
    "files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…"
)


def option(row: Option) -> Callable[[FC], FC]:
    """The click decorator for an option's row."""
    if row.off:
        flags = f"{row.names[0]}/{row.off}"
        return click.option(flags, row.field, default=True, help=row.help, show_default=True)
    if not row.metavar:
        return click.option(*row.names, row.field, is_flag=True, help=row.help)
    if row.choices:
        return click.option(
            *row.names, row.field, type=click.Choice(row.choices), default=row.choices[0],
            show_default=True, help=row.help,
        )  # fmt: skip
    default: dict[str, Any] = {}
    if row.default is not None:  # To click, no value is one as well.
        default = {"default": row.default, "show_default": True}
    return click.option(
        *row.names, row.field, metavar=row.metavar, required=row.required, multiple=row.many,
        type=click.Path(path_type=Path) if row.is_path else None, help=row.help, **default,
    )  # fmt: skip


device_option = click.option(
    "--device", metavar="NAME", default="",
    help="The device of the routes `vulkan`, `opengl` and `wgpu`: a part of its name, or its "
    "number; by default the first GPU.",
)  # fmt: skip
messages_option = option(FORMAT)
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
variant_option = click.option(
    "--variant", metavar="NAME",
    help="The variant in which the materials of --scene are shown, of those that the file has.",
)  # fmt: skip
environment_option = click.option(
    "--environment", metavar="WHAT", default=STUDIO, show_default=True,
    help="The light from all around: `studio`, `sky`, `none`, or the file of a panorama "
    "(.hdr, .exr, .png …).",
)  # fmt: skip


def _place(
    _context: click.Context, _option: click.Parameter, given: str | None
) -> tuple[float, float, float] | None:
    """The callback of an option whose value is a point, such as ``0,1.5,4``."""
    if given is None:
        return None
    point = point_of(given)
    if point is None:
        raise click.BadParameter(f"'{given}' is no point, which would be like 0,1.5,4")
    return point


def point_of(text: str) -> tuple[float, float, float] | None:
    """The point that a text names by three finite numbers; ``None`` if it names none."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        return None
    return (x, y, z) if all(abs(lane) <= FARTHEST for lane in (x, y, z)) else None


def _turn(_context: click.Context, _option: click.Parameter, given: str) -> tuple[float, float]:
    """The callback of ``--turn``: one angle or two, in degrees."""
    parts = [part.strip().removesuffix("deg") for part in given.split(",")]
    try:
        right, up = (math.radians(float(part)) for part in [*parts, "0"][:2])
    except ValueError:
        right = math.nan
    if len(parts) > 2 or not (math.isfinite(right) and math.isfinite(up)):
        raise click.BadParameter(
            f"'{given}' is no angle in degrees, which would be like 30 or 30,10"
        )
    return right, up


def _stops(_context: click.Context, _option: click.Parameter, given: float) -> float:
    """The callback of ``--exposure``: a number, as a range alone lets what is none pass."""
    if math.isnan(given):
        raise click.BadParameter("'nan' is no number of stops, which would be like 1.5")
    return given


plain_option = click.option(
    "--plain", is_flag=True,
    help="Draw with declared values only, whatever the comment of FILE asks for.",
)  # fmt: skip
eye_option = click.option(
    "--eye", metavar="X,Y,Z", callback=_place,
    help="The place of the camera; --set eye=X,Y,Z does the same.",
)  # fmt: skip
look_at_option = click.option(
    "--look-at", metavar="X,Y,Z", callback=_place, help="The point that the camera looks at.",
)  # fmt: skip
turn_option = click.option(
    "--turn", metavar="RIGHT[,UP]", default="0", callback=_turn,
    help="The degrees by which the camera turns around what it looks at.",
)  # fmt: skip
mesh_option = click.option(
    "--mesh", type=click.Choice(MESHES), default="sphere", show_default=True,
    help="The mesh to draw.",
)  # fmt: skip
exposure_option = click.option(
    "--exposure", metavar="STOPS", default=0.0, show_default=True, type=click.FloatRange(-32, 32),
    callback=_stops,
    help="Brighten the picture; each stop doubles the light. Files of numbers keep these.",
)  # fmt: skip
tone_option = click.option(
    "--tone", type=click.Choice(TONES), default=TONES[0], show_default=True,
    help="The tone mapping that brings bright light onto a screen, by a function of "
    "std.tone_mapping; without one, light above 1 is cut off.",
)  # fmt: skip
floor_option = click.option(
    "--floor", is_flag=True,
    help="Let the mesh of a material stand on a floor, on which its shadow falls.",
)  # fmt: skip


def _begin(context: click.Context, _option: click.Parameter, form: str) -> None:
    """The callback of ``--format``: all that the command says becomes one document."""
    if form == "json" and not context.resilient_parsing:
        begin(context.info_name or "")


answer_option = click.option(
    "--format", type=click.Choice(["text", "json"]), default="text", show_default=True,
    expose_value=False, callback=_begin,
    help="Text for people, or one JSON document for programs: `burnish schema answer`.",
)  # fmt: skip


def pairs(
    _context: click.Context, _option: click.Parameter, given: Sequence[str]
) -> tuple[tuple[str, str], ...]:
    """The callback of an option whose values are like ``power=32``."""
    return _pairs(given)


def _pairs(given: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """The values of an option that are like ``power=32``. Raises ``BadParameter`` for others."""
    found = []
    for text in given:
        name, _, value = (part.strip() for part in text.partition("="))
        if not name or not value:
            raise click.BadParameter(f"'{text}' is not NAME=VALUE")
        found.append((name, value))
    return tuple(found)


def each_once(given: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """The values of ``--set``: of two values for one name, neither is certainly meant."""
    found = _pairs(given)
    known: dict[str, str] = {}
    for name, value in found:
        if name in known:
            raise click.BadParameter(f"'{name}' is set twice, to {known[name]} and to {value}")
        known[name] = value
    return found


narrowed_option = option(SET)
"""``--set`` of commands that compile: it narrows what the texts serve."""
_RANGE = re.compile(r"[-+]?\.?\d[\w.]*?\s*\.\.\s*[-+]?\.?\d[\w.]*")


def _single_values(
    _context: click.Context, _option: click.Parameter, given: Sequence[str]
) -> tuple[tuple[str, str], ...]:
    """The callback of ``--set`` of commands that draw: a picture shows one value."""
    found = each_once(given)
    for name, value in found:
        if _RANGE.fullmatch(value):
            raise click.BadParameter(
                f"'{name}={value}' is a range, and a picture shows one value: "
                "compile, conform and graph take ranges"
            )
    return found


values_option = click.option(
    "--set", "values", metavar="NAME=VALUE", multiple=True, callback=_single_values,
    help="A parameter or a texture, or that of one material, as Clay.base; may be given many "
    "times.",
)  # fmt: skip


def _raise_limits(context: click.Context, _option: click.Parameter, given: Sequence[str]) -> None:
    """The callback of ``--budget``: limits are raised until the command ends."""
    from ..compiler.budget import LIMITS, amount_of, raised

    limits = {}
    for name, text in _pairs(given):
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
