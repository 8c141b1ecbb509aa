"""Whether what Godot computes of a surface lies inside the bounds of its meaning.

A probe is the shader of a material, without lights, that shows one of the values which it gives to
Godot: ``ROUGHNESS`` as grey, a normal as a colour. The reference draws the slot in the same scene,
as a target of a pass, with the bounds of what devices may make of it; ``compare`` judges, as it
does for ``burnish conform``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.api.compiling_engines import functions_for
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.values import ParameterRow
from burnish.compiler.reference.bounds.errors import Errors
from burnish.engines import known
from burnish.engines.godot.shader import shader
from burnish.engines.godot.values import ROLES, TABLES
from burnish.engines.surface import Given, Surface, UnfitError
from burnish.engines.values import Output
from burnish.targets.conformance.bounds import precise, rules_of
from burnish.targets.conformance.compare import Comparison
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.conformance.judging import Compared
from burnish.targets.conformance.sample import sample_textures, sample_values
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.meshes import Mesh, torus
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .godot import FORMATS, Picture

SIZE = (40, 32)
SEED = 7
ROUTE = ROUTES["lavapipe:glsl"]
"""The route whose driver Godot draws with, too."""
LAVAPIPE = DRIVERS[ROUTE.driver]
DEVICE = Device(ROUTE.driver, "", subpixel_bits=8, subtexel_bits=8, mip_bits=8)
FILTERS = replace(LAVAPIPE.assumed, fixed_bits=7)
"""What it may make of textures. Of the samplers that Godot makes, it filters textures of eight bits
in eight bits, with several roundings; of those that our routes make, in floats."""

TURNED = np.array([
    [1.1, -0.5, 0.0, 0.1], [0.35, 0.5, 0.0, -0.15], [0.0, 0.0, 0.9, 0.2], [0.0, 0.0, 0.0, 1.0],
])  # fmt: skip
"""The object's transform: it is turned, and scaled differently along each axis."""

SHOWN = {
    "ALBEDO": ("ALBEDO", "{slot}"),
    "METALLIC": ("vec3(METALLIC)", "vec3({slot})"),
    "ROUGHNESS": ("vec3(ROUGHNESS)", "vec3({slot})"),
    "CLEARCOAT": ("vec3(CLEARCOAT)", "vec3({slot})"),
    "CLEARCOAT_ROUGHNESS": ("vec3(CLEARCOAT_ROUGHNESS)", "vec3({slot})"),
    "EMISSION": ("EMISSION", "{slot}"),
    "AO": ("vec3(AO)", "vec3({slot})"),
    "ALPHA": ("vec3(probed_alpha)", "vec3({slot})"),
    "NORMAL": (
        "(INV_VIEW_MATRIX * vec4(NORMAL, 0.0)).xyz * 0.5 + 0.5",
        "normalize(vec3({slot})) * 0.5 + 0.5"
    ),
}  # fmt: skip
"""How Godot's values are shown, and how the same is written of a slot in a pass."""

Floats = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Probe:
    """One value of a surface in one scene."""

    label: str
    picture: Picture
    material: burnish.CompiledMaterial
    state: SceneState

    def judged(self, got: Floats) -> Comparison:
        """Compare what Godot has drawn with the bounds."""
        rules = rules_of(self.state, DEVICE, LAVAPIPE, FILTERS, bottom_up=False)
        shader = self.material.shader
        allowed = expected(shader, self.state, rules, Errors(ROUTE.platforms))
        meant = expected(shader, self.state, precise(rules), None)
        compared = Compared.of([got], allowed, meant, ["rgba16f"], lambda: allowed)
        return compared.comparison("guaranteed")


def probes_of(file: Path, material: str) -> Iterator[Probe]:
    """A probe for each value that a material gives Godot.

    Raises ``CompileError`` and ``UnfitError``.
    """
    engine = known.load("godot")
    for each in functions_for(engine, file, material=material):
        surface = Surface(each.document, each.files[0].emission)
        own = CUSTOM.search(shader(surface))
        if own is not None:
            raise UnfitError(material, f"the meshes that are drawn have no `{own[1]}`")
        yield from _probes(file, surface, shader(surface))


def _probes(file: Path, surface: Surface, text: str) -> Iterator[Probe]:
    for output in TABLES.lit if surface.is_lit else TABLES.unlit:
        name, _, assigned = output.statement.partition(" ")
        slot = _slot_of(surface, output)
        if assigned.startswith("=") and slot is not None:
            yield _probe(file, surface, text, name, slot)


def _slot_of(surface: Surface, output: Output) -> str | None:
    """The expression of slots that a value is made of, as the material writes it."""
    given = surface.inputs.get(output.input)
    if given is None:
        return None
    factor = surface.inputs.get(output.factor)
    form = "sqrt({})" if output.input == "squared_roughness" else "{}"
    return form.format(_rgb(given)) + ("" if factor is None else f" * {_rgb(factor)}")


def _rgb(given: Given) -> str:
    return f"{given.slot}.rgb" if given.type == "vec4" else given.slot


def _probe(file: Path, surface: Surface, text: str, name: str, slot: str) -> Probe:
    shown, written = SHOWN[name]
    source = file.read_text("utf-8") + _pass(surface, written.format(slot=slot))
    (material,) = burnish.compile(
        source,
        [ROUTE.profile],
        material=surface.name,
        pass_="Probe",
        hoist=False,
        search_path=[file.parent],
    ).materials
    mesh = torus(24, 16)
    state = _state(material.reflection, mesh)
    label = f"{file.stem}.{surface.name}.{name}"
    picture = _picture(label, surface, _probing(text, shown), mesh, state)
    return Probe(label, picture, material, state)


def _pass(surface: Surface, shown: str) -> str:
    """The pass that draws a value; it leaves out what the material's own pass leaves out."""
    drawn = surface.document.own_pass
    base = "Forward" if drawn is None else drawn.name
    return (
        f"\npass Probe : {base} {{\n    target color : rgba16f = vec4({shown}, 1)\n"
        "    raster { cull = none, samples = 1, alpha_to_coverage = false }\n}\n"
    )


CUSTOM = re.compile(r"// The mesh has `(.*)` in")
"""What a shader says of vertex inputs of its own, which the meshes here do not have."""


def _probing(text: str, shown: str) -> str:
    """The shader without lights that shows a value, and is opaque."""
    head, _, fragment = text.rpartition("void fragment() {")
    fragment = fragment.replace("    ALPHA = ", "    float probed_alpha = ")
    fragment = fragment.rstrip().removesuffix("}") + f"    ALBEDO = {shown};\n}}\n"
    head = re.sub("render_mode .*;\n", "", head)
    head = head.replace(
        "shader_type spatial;\n",
        "shader_type spatial;\nrender_mode unshaded, cull_disabled, fog_disabled;\n",
    )
    return f"{head}void fragment() {{{fragment}"


SCENE = Scene(looking(eye=(-0.7, 1.1, 2.6)), object_to_world=tuple(map(tuple, TURNED.tolist())))


def _state(reflection: Reflection, mesh: Mesh) -> SceneState:
    instance = Instance(reflection)
    sample_values(instance, SEED)
    sample_textures(instance, SEED)
    clear = (0.0, 0.0, 0.0, 0.0)
    return set_up(instance, with_inputs(reflection, mesh), SCENE, SIZE, clear)


def _picture(label: str, surface: Surface, text: str, mesh: Mesh, state: SceneState) -> Picture:
    camera = SCENE.camera
    given = {
        argument.name: surface.arguments[argument.given]
        for function in surface.emission.functions
        for argument in function.arguments
        if argument.kind == "value"
    }
    values = state.instance.values()
    rows = {row.name: row for row in state.instance.reflection.parameters}
    uniforms = {
        name: (row.representation, _part(rows, values, row.given))
        for name, row in given.items()
        if row.source == "parameter" and row.given.partition(".")[0] in values
        and row.role not in ROLES and f" {name}" in text
    }  # fmt: skip
    textures = state.instance.textures()
    bound = {
        argument.name: textures[argument.given]
        for function in surface.emission.functions
        for argument in function.arguments
        if argument.kind == "texture" and argument.given in textures
    }
    for texture in bound.values():
        if texture.format not in FORMATS:
            raise UnfitError(label, f"Godot makes no textures of the format {texture.format}")
    assert camera.fov is not None
    return Picture(
        name=label, shader=text, mesh=mesh, size=SIZE, object_to_world=TURNED,
        camera_to_world=np.linalg.inv(camera.world_to_camera), fov=math.degrees(camera.fov),
        near=camera.near, far=camera.far, values=uniforms, textures=bound,
    )  # fmt: skip


def _part(rows: Mapping[str, ParameterRow], values: Mapping[str, Any], given: str) -> Any:
    """The value of a parameter, or of a member of one: ``place.offset``."""
    name, *path = given.split(".")
    value, members = values[name], rows[name].members
    for step in path:
        (number,) = (place for place, row in enumerate(members) if row.name == step)
        value = value[number]
    return value
