"""The controls of a frame in ``burnish view``: what a person can set, with its range and comment.

Everything here comes from the plan and the reflections. The page makes a slider, a colour picker or
another field from each row, and ``FrameHost.set`` takes the row's name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...compiler.documents.plan import DrawStep, FramePlan
from ...compiler.documents.values import LightRow, ParameterRow
from ..runner.frames.host import FrameHost
from ..runner.instances.declared import TextureDeclaration
from ..runner.instances.host_values import HostValues
from ..runner.instances.shapes import Elements, Members, Numbers, Shape, shape_of

_VIEW_ROLES = frozenset(
    ("world_to_clip", "eye", "object_to_world", "pose", "morph", "size", "number")
)
"""The roles of the parameters that the page and the scene set by themselves."""
_MOST_ELEMENTS = 16
"""An array of more numbers than this is data, which nobody sets by hand."""
_NUMBERS = re.compile(r"\[[0-9]+\]")
_STOPS = (-8.0, 8.0)
"""The exposures that a slider offers."""
_PER_FRAME = "frame"
"""The group of the parameters that change from frame to frame."""


def controls(host: FrameHost) -> list[dict[str, Any]]:
    """A row for each number, vector, colour and texture that a person can set.

    What nothing reads has no row. Parameters of one name have one row if they are set together:
    those of several shaders of a material, and of the rig. Those of several materials are told
    apart, as ``Clay.base``. ``inherited_from`` names the declaration that brings one, if it is not
    the section's own.
    """
    found: dict[str, dict[str, Any]] = {}
    of_shaders = sorted(_of_shaders(host), key=lambda each: each["section"] == host.plan.rig)
    for control in (*_of_frame(host), *_by_owner(host.plan, of_shaders), *_of_lights(host)):
        known = found.setdefault(control["name"], control)
        if control["section"] not in known["section"].split(", "):
            known["section"] += f", {control['section']}"
    return list(found.values())


def _by_owner(plan: FramePlan, controls: Sequence[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """The controls of shaders; a name that several materials have gets that of its owner before."""
    materials = {use.material for step in plan.steps for use in step.uses}
    owners: dict[str, set[str]] = {}
    for control in controls:
        if control["section"] in materials:
            owners.setdefault(control["name"], set()).add(control["section"])
    for control in controls:
        is_shared = len(owners.get(control["name"], ())) > 1 and control["section"] in materials
        owned = f"{control['section']}.{control['name']}"
        yield {**control, "name": owned} if is_shared else control


def _belongs(row: ParameterRow, lights: Sequence[LightRow]) -> bool:
    """True if a parameter belongs to a light, or is the number of lights."""
    return any(row.name in (*each.parameters, each.count) for each in lights)


def of_development(
    plan: FramePlan, exposure: float, tone: str, tones: Sequence[str]
) -> list[dict[str, Any]]:
    """The rows for what a screen shows of a picture's light; none of a plan without pictures.

    They are called like the options of the command line, which no parameter can be.
    """
    if all(row.texture is None for row in plan.outputs):
        return []
    shared = {
        "section": "Screen", "inherited_from": None, "is_light": False, "element": None,
    }  # fmt: skip
    return [
        {
            **shared, "name": "--exposure", "doc": "Each stop doubles the light.",
            "kind": "number", "type": "float", "range": _STOPS, "value": exposure,
        },
        {
            **shared, "name": "--tone", "doc": "How bright light is brought onto the screen.",
            "kind": "choice", "type": "tone", "choices": tones, "value": tone,
        },
    ]  # fmt: skip


# --- frames --------------------------------------------------------------------------------------


def _of_frame(host: FrameHost) -> Iterator[dict[str, Any]]:
    plan = host.plan
    for row in plan.parameters:
        if not _belongs(row, plan.lights):
            yield from _of_parameter(row, host.values, plan.frame)
    for texture in plan.host_textures:
        yield _texture(texture, host.values, plan.frame)


def _of_lights(host: FrameHost) -> Iterator[dict[str, Any]]:
    """The lights of the rig, one after the other; of an array first how many there are."""
    rows = {row.name: row for row in host.plan.parameters}
    for light in host.plan.lights:
        counted = [light.count] if light.count else []
        for name in (*counted, *light.parameters):
            for control in _of_parameter(rows[name], host.values, light.name, is_light=True):
                within = control["name"].partition("]")[0]
                if within != control["name"]:
                    index = int(within.rpartition("[")[2])
                    control["element"] = {"count": light.count, "index": index}
                yield control


# --- shaders -------------------------------------------------------------------------------------


def _of_shaders(host: FrameHost) -> Iterator[dict[str, Any]]:
    """The parameters and textures of each shader that neither the frame nor the scene sets."""
    given = _given(host.plan)
    for number, instance in enumerate(host.instances):
        reflection = instance.reflection
        titles = _titles(host.plan, number)
        needed = set(instance.needed)
        counters = {row.count for row in reflection.buffers}
        for row in reflection.parameters:
            name = row.name
            if name in given.get(number, ()) or name in counters or name not in needed:
                continue
            if _belongs(row, reflection.lights):
                continue
            is_of_rig = row.group == "rig"
            section = reflection.rig if is_of_rig else titles
            base = None if is_of_rig else _base(row.declared_by, section)
            for control in _of_parameter(row, instance, section):
                yield {**control, "inherited_from": base}
        for texture in reflection.textures:
            if texture.stages and texture.name not in given.get(number, ()):
                control = _texture(texture, instance, titles)
                yield {**control, "inherited_from": _base(texture.declared_by, titles)}


def _base(declared_by: str | None, material: str) -> str | None:
    """The base, mixin or pass that brings a parameter to a material; ``None`` if it is its own."""
    return None if declared_by == material else declared_by


def _given(plan: FramePlan) -> Mapping[int, frozenset[str]]:
    """For each shader the names that the frame sets wherever it is used."""
    found: dict[int, frozenset[str]] = {}
    for step in plan.steps:
        for use in step.uses:
            names = frozenset(row.name for row in use.inputs)
            found[use.shader] = found.get(use.shader, names) & names
    return found


def _titles(plan: FramePlan, shader: int) -> str:
    """The title of each shader's section: its material, or else its pass or kernel."""
    for step in plan.steps:
        for use in step.uses:
            if use.shader == shader and isinstance(step, DrawStep):
                return use.material or step.pass_
            if use.shader == shader:
                return plan.shaders[shader].name.rpartition(".")[2]
    return plan.frame


# --- rows ----------------------------------------------------------------------------------------


def _texture(row: TextureDeclaration, instance: HostValues, section: str) -> dict[str, Any]:
    return {
        "name": row.name, "section": section, "inherited_from": None,
        "is_light": False, "element": None,
        "doc": row.doc,
        "kind": "texture", "type": row.type, "dimension": row.dimension,
        "sample": row.sample, "intent": row.intent, "value": row.default,
        "is_given": instance.get(row.name) is not None,
    }  # fmt: skip


def _of_parameter(
    row: ParameterRow, instance: HostValues, section: str, *, is_light: bool = False
) -> Iterator[dict[str, Any]]:
    if row.role in _VIEW_ROLES:
        return
    for name, shape in _parts(row.name, shape_of(row), section if is_light else None):
        value = instance.get(name)
        if value is not None and not _is_read(row, name):
            continue  # But for a value that hosts need, as there is no default.
        yield {
            "name": name, "section": section, "inherited_from": None,
            "is_light": is_light, "element": None,
            "doc": shape.doc or (row.doc if name == row.name else ""),
            "kind": _kind(shape), "type": shape.type, "lanes": shape.lanes,
            "columns": shape.columns, "whole": shape.kind in ("int", "uint"),
            "range": shape.range, "value": value,
            **({"choices": shape.choices} if shape.choices else {}),
            "is_timed": row.group == _PER_FRAME and shape.lanes == 1 and shape.range is None,
        }  # fmt: skip


def _is_read(row: ParameterRow, part: str) -> bool:
    """True if a part of a parameter, ``lamps[2].place``, is read: the same of all elements."""
    if row.read is None:
        return True
    name = _NUMBERS.sub("", part)
    return any(f"{name}.".startswith(f"{read}.") for read in row.read)


def _parts(name: str, shape: Shape, light: str | None) -> Iterator[tuple[str, Numbers]]:
    """The numbers, vectors and matrices that a value consists of, with their names."""
    pending = [(name, shape)]
    while pending:
        own, found = pending.pop()
        match found:
            case Numbers():
                yield own, found
            case Members(members=members):
                pending += [(f"{own}.{each.name}", each.shape) for each in reversed(members)]
            case Elements(element=element, count=count):
                if count <= _MOST_ELEMENTS or own == light:
                    pending += [(f"{own}[{n}]", element) for n in reversed(range(count))]


def _kind(shape: Numbers) -> str:
    """The kind of field by which a person sets a number, vector or matrix."""
    if shape.columns:
        return "matrix"
    if shape.choices:
        return "member"
    if shape.kind == "bool":
        return "checkbox" if shape.lanes == 1 else "checkboxes"
    if shape.meaning in ("rgb", "rgba"):
        return "color"
    if shape.meaning in ("direction", "normal"):
        return "direction"
    if shape.meaning == "angle":
        return "angle"
    return "number" if shape.lanes == 1 else "vector"
