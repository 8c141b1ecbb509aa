"""Draws a material of Burnish in a setting, and asks the reference about the picture.

The lights of the setting are a rig that is added to the file's text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...api.entry_points import CompiledMaterial, compile
from ...compiler.documents.reflection import Reflection
from ...compiler.documents.representations import kind_of, lanes_of
from ...compiler.reflection.roles import scene_names
from ...targets.conformance.bounds import bounds_of
from ...targets.conformance.compare import Comparison, compare
from ...targets.runner.binding import pipeline
from ...targets.runner.codes import CodeError, compile_one
from ...targets.runner.drivers.device import DriverError
from ...targets.runner.exact import Exact
from ...targets.runner.frames.states import draw_states
from ...targets.runner.instances.instance import Instance
from ...targets.runner.instances.shapes import WHOLE
from ...targets.runner.instances.values import ParameterError
from ...targets.runner.meshes import Mesh, MeshError
from ...targets.runner.reference import expected
from ...targets.runner.routes import Route
from ...targets.runner.runner import Runner
from ...targets.runner.scene import inputs_of_mesh, takes_mean_radiance
from ...targets.runner.scene_state import SceneState, set_up
from ...targets.runner.textures.kinds import PictureError
from ...targets.toolchain import Toolchain
from .images import NamedImage
from .records import FidelityError
from .settings import BACKGROUND, Setting, whole

Floats = NDArray[np.float64]
Values = Mapping[str, Any]
"""Values of parameters and textures by name. Texts are written as on a command line."""

CLOCK = "std.mtlx.surface.MaterialXSurface"
"""The declaration of the library whose parameters are the time and the number of the frame."""
DECAY = "decay_rate"
POINT = "MaterialXPoint"
_WRAPPING = f"""burnish 1

import "{{file}}".{{{{{{material}}}}}}
import std.lights.{{{{Directional, Point}}}}

/// Fades with a power of the distance and one, as MaterialX's lights do.
light {POINT} : Point {{{{
    param {DECAY} : float in 0..16 = 2
    falloff = 1 / pow(length(to_place) + 1, {DECAY})
}}}}

rig MaterialXLights {{{{
{{lights}}
}}}}

material Shown : {{material}} {{{{
{{equations}}
}}}}
"""
_STILL = "    displacement_vector = vec3(0)"
"""The equation that lets ``std.mtlx.displacement`` move nothing."""


@dataclass(frozen=True, eq=False, slots=True)
class OwnPicture:
    """A picture of Burnish, and all that its bounds follow from."""

    picture: Floats
    """(height, width, 4), the top row first."""
    material: CompiledMaterial
    state: SceneState
    route: Route
    runner: Runner

    def within_bounds(self) -> Comparison:
        """The verdict of ``burnish conform`` about the picture: every lane of it lies where the
        reference says that it may. This takes seconds."""
        device = self.runner.device(self.route)
        exact = Exact.of(self.material)
        for bounds in bounds_of(self.state, self.route, device):
            program = exact.emitted(self.route.profile)
            wanted = expected(program, self.state, bounds.rules, bounds.errors)
            steps = [np.spacing(np.abs(self.picture).astype(np.float32)).astype(float)]
            found = compare([self.picture], wanted, wanted.targets, steps, bounds.level)
            if not found.wrong:
                break
        return found


def draw_own(
    source: Path | str, material: str, setting: Setting, values: Values,
    search_path: Sequence[Path], route: Route, runner: Runner, toolchain: Toolchain,
    *, is_still: bool = False,
) -> OwnPicture:  # fmt: skip
    """Compile a material, and draw it in a setting on a route; with ``is_still``, its displacement
    moves nothing. Raises ``FidelityError`` and ``CompileError``."""
    text = partial(wrapped, material=material, setting=setting, is_still=is_still)
    compiled = _compiled(source, text, search_path, route.profile)
    instance = compiled.instance()
    try:
        _set_values(instance, values)
        _set_clock(instance, setting)
        _set_light(instance, setting)
        mesh = _with_primvars(setting, compiled.reflection)
        state = set_up(instance, mesh, setting.scene, setting.size, BACKGROUND)
        exact = Exact.of(compiled)
        codes = compile_one(route, compiled.files, toolchain)
        bound = pipeline(exact.reflection, route, codes)
        (outcome,) = draw_states(exact, [state], route, bound, runner)
    except (ParameterError, PictureError, MeshError, CodeError, DriverError) as error:
        raise FidelityError(f"{material} cannot be drawn: {error}") from None
    return OwnPicture(outcome.pictures[0], compiled, state, route, runner)


def _compiled(
    source: Path | str, text_with: Callable[[str], str], search_path: Sequence[Path], profile: str
) -> CompiledMaterial:
    """The material of a text that is told the name of the file that it imports."""
    with ExitStack() as owned:
        if isinstance(source, Path):
            file = source.resolve()
        else:
            folder = owned.enter_context(TemporaryDirectory(prefix="burnish-"))
            file = Path(folder) / "shown.burnish"
            file.write_text(source, "utf-8")
        text = text_with(file.name)
        folders = [file.parent, *search_path]
        (compiled,) = compile(text, (profile,), search_path=folders, keep_graphs=True).materials
    return compiled


def wrapped(file: str, material: str, setting: Setting, is_still: bool) -> str:
    """The text of a file that shows a material of another one under the lights of a setting."""
    kinds = {"directional": "Directional", "point": POINT}
    lights = "\n".join(f"    {lamp.name} : {kinds[lamp.kind]}" for lamp in setting.lamps)
    equations = _STILL if is_still else ""
    return _WRAPPING.format(file=file, material=material, lights=lights, equations=equations)


def _set_values(instance: Instance, values: Values) -> None:
    """Set what is given. An image that is not there leaves the texture as it is."""
    rows = {row.name: row for row in instance.declared.textures}
    for name, value in values.items():
        if isinstance(value, NamedImage):
            is_srgb = name in rows and rows[name].intent == "color"
            dimension = rows[name].dimension if name in rows else "2d"
            texture = value.texture(is_srgb=is_srgb, dimension=dimension)
            if texture is not None:
                instance.set(name, texture)
        elif isinstance(value, str):
            instance.set_text(name, value)
        else:
            instance.set(name, value)


def _set_light(instance: Instance, setting: Setting) -> None:
    """Let the lights of the setting decay as MaterialX's do, and let them be the only ones."""
    for parameter in instance.declared.parameters:
        if takes_mean_radiance(parameter):
            instance.set(parameter.name, (0.0, 0.0, 0.0))
    for row in instance.declared.lights:
        if f"{row.name}.{DECAY}" in row.parameters:
            instance.set(f"{row.name}.{DECAY}", setting.decay)


def _set_clock(instance: Instance, setting: Setting) -> None:
    """Set the time and the number of the frame of a material that was imported."""
    clock = {f"{CLOCK}.time": setting.time, f"{CLOCK}.frame": setting.frame}
    for parameter in instance.declared.parameters:
        if parameter.library in clock:
            instance.set(parameter.name, clock[parameter.library])


def _with_primvars(setting: Setting, reflection: Reflection) -> Mesh:
    """The mesh with the same patterns as MaterialX's side for the inputs that it lacks."""
    roles, mesh = scene_names()["attributes"], setting.mesh
    further = {
        row.name: _channel(setting, row.name, row.representation)
        for row in inputs_of_mesh(reflection)
        if roles.get(row.name, row.name) not in mesh.channels
    }
    return replace(mesh, channels={**mesh.channels, **further})


def _channel(setting: Setting, name: str, representation: str) -> NDArray[Any]:
    values = setting.channel(name, lanes_of(representation))
    return whole(values).astype(np.int64) if kind_of(representation) in WHOLE else values
