"""Shows a single material as a frame: a plan of one step that draws it, or runs it.

Hosts have one road only, which is that of plans. ``burnish view`` takes it for materials, kernels
and passes that capture; who writes an engine can do the same with any reflection.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ....compiler.ir.shader import Shader
from ..capturing import give_elements
from ..codes import ShaderFile
from ..meshes import MESHES, farthest_first
from ..scene import Scene, declared_as, with_inputs
from ..scene_state import CLEAR, Color, set_up
from ..subject import Subject
from .checks.rows import PlanError
from .host import VERSION, FrameHost, Row
from .scenery import WHOLE, Model, Scenery

STEP = "shown"
"""The name of the step."""
SIZE = f"{STEP}.size"
"""The parameter with the size of the picture. A material may have a ``size`` of its own."""

_DEPTH = "depth"
_DEPTH_FORMATS = {False: "depth32f", True: "depth32f_stencil8"}
"""Without and with stencil values."""
_NEW = "undefined"
"""What a texture is used as before anything is drawn to it."""
_PLACE: Row = {"file": "", "line": 1, "column": 1, "length": 0}
"""Nobody has written the plan."""
_IVEC2 = {"type": "ivec2", "representation": "ivec2"}


@dataclass(frozen=True, slots=True)
class SingleFrame:
    """A frame with one shader."""

    name: str
    plan: Row
    shaders: Sequence[Subject]

    @property
    def plan_of_reference(self) -> Row:
        """The same: what one step leaves shares nothing."""
        return self.plan


@dataclass(frozen=True, slots=True)
class _Renamed:
    """A material under the name that frames give their shaders."""

    subject: Subject
    name: str
    reflection: Row

    @property
    def files(self) -> Sequence[ShaderFile]:
        """The emitted texts."""
        return self.subject.files

    @property
    def lacking(self) -> Mapping[str, str]:
        """For profiles without texts, the reason."""
        return self.subject.lacking

    @property
    def shader(self) -> Shader:
        """What the material means."""
        return self.subject.shader

    def emitted(self, profile: str) -> Shader:
        """What the texts for a profile compute."""
        return self.subject.emitted(profile)


def single_frame(subject: Subject, background: Color = CLEAR) -> SingleFrame:
    """The frame that shows a material on all models of the scene, or what a kernel writes; it has
    an output for each render target, image or buffer. ``background`` is what its first target is
    cleared to, unless its pass says so.

    Raises ``PlanError`` for what leaves nothing that a host could get: a pass that captures
    vertices by a stream output.
    """
    reflection = subject.reflection
    if not (reflection["targets"] or reflection["results"]):
        raise PlanError(f"{subject.name} draws no picture")
    is_kernel = reflection["extent"] is not None
    parts = [subject.name, reflection["pass"], subject.name]
    name = ".".join(part for part in parts if part)
    shader = _Renamed(subject, name, {**reflection, "material": name})
    parameters = [_size_row(), *_parameters_of_lights(reflection)]
    plan = {
        "plan": VERSION,
        "frame": subject.name,
        "doc": reflection["doc"],
        "source": _PLACE,
        "rig": reflection["rig"],
        "parameters": parameters,
        "lights": [_own(reflection, row) for row in reflection["lights"]],
        "host_textures": [],
        "host_buffers": [],
        "sources": {row["name"]: _PLACE for row in parameters},
        "models": [] if is_kernel else [_models_row(subject)],
        "shaders": [_shader_row(shader)],
        "values": [_size_value()],
        "textures": [],
        "results": [],
        "steps": [],
        "end": {},
        "kept": [],
        "outputs": [],
    }
    _add_images(plan, reflection, is_kernel=is_kernel)
    _add_buffers(plan, reflection)
    plan["steps"] = [_run(plan) if is_kernel else _draw(plan, subject, background)]
    use = "image" if is_kernel else "target"
    pictures, buffers = _outputs(plan)
    plan["end"] = {
        "barriers": [_barrier(row["texture"], use, "sampled") for row in pictures],
        "buffer_barriers": [_buffer_barrier(row, "written", "read") for row in buffers],
    }
    return SingleFrame(subject.name, plan, (shader,))


# --- what the host sets --------------------------------------------------------------------------


def _size_row() -> Row:
    return {
        **_IVEC2,
        "name": SIZE, "range": [1.0, 16384.0], "default": [512, 512],
        "doc": "Of what is shown, in pixels", "library": declared_as("size"), "role": "size",
        "group": "frame", "block": None, "offset": None, "size": 8,
        "layout": {"stored": "ivec2", "kind": "int", "lanes": 2}, "members": [], "count": None,
    }  # fmt: skip


def _size_value() -> Row:
    step = {"op": "parameter", "type": "ivec2", "parameter": SIZE, "args": []}
    return {"representation": "ivec2", "steps": [step]}


def _parameters_of_lights(reflection: Row) -> list[Row]:
    """What is set of the lights, under the names that a frame has for them."""
    lights = reflection["lights"]
    names = {name for row in lights for name in (*row["parameters"], row["count"])}
    return [
        {**row, "name": _short(reflection, row["name"]), "block": None, "offset": None}
        for row in reflection["parameters"]
        if row["name"] in names
    ]


def _own(reflection: Row, light: Row) -> Row:
    count = light["count"]
    return {
        **light,
        "name": _short(reflection, light["name"]),
        "count": count and _short(reflection, count),
        "parameters": [_short(reflection, name) for name in light["parameters"]],
    }


def _short(reflection: Row, name: str) -> str:
    """The name of something of the rig, without the rig's name."""
    return name.removeprefix(f"{reflection['rig']}.")


# --- what is drawn -------------------------------------------------------------------------------


def _models_row(subject: Subject) -> Row:
    return {"name": WHOLE, "materials": [subject.name], "doc": "", "source": _PLACE}


def _shader_row(subject: Subject) -> Row:
    reflection = subject.reflection
    return {
        "name": subject.name, "reflection": f"{subject.name}.json",
        "pass": reflection["pass"] or None, "rig": reflection["rig"] or None,
    }  # fmt: skip


def _add_images(plan: dict[str, Any], reflection: Row, *, is_kernel: bool) -> None:
    """Add a texture, a result and an output for each render target or image."""
    layers = (reflection["draw"] or {}).get("layers")
    for number, target in enumerate(reflection["targets"]):
        result = f"{STEP}.{target['name']}"
        use = "image" if is_kernel else "target"
        plan["textures"].append({
            "format": target["format"],
            "dimension": "2d_array" if layers else "2d",
            "size": {
                "value": None if is_kernel else 0,
                "extent_of": STEP if is_kernel else None,
                "level": 0,
            },
            "layers": layers["count"] if layers else 1, "levels": 1, "samples": 1,
            "uses": [use, "sampled"], "kept": False, "results": [result],
        })  # fmt: skip
        _add_output(plan, target, number)


def _add_buffers(plan: dict[str, Any], reflection: Row) -> None:
    """Add a result and an output for each buffer that a kernel writes."""
    for row in reflection["results"]:
        _add_output(plan, row, None)


def _add_output(plan: dict[str, Any], row: Row, texture: int | None) -> None:
    result = f"{STEP}.{row['name']}"
    plan["results"].append(_result_row(result, texture, row["doc"]))
    plan["outputs"].append({
        "name": row["name"], "result": result, "texture": texture, "doc": row["doc"],
        "source": _PLACE,
    })  # fmt: skip


def _result_row(name: str, texture: int | None, doc: str) -> Row:
    return {
        "name": name, "kind": "buffer" if texture is None else "texture", "texture": texture,
        "first": 0, "last": 0, "doc": doc, "source": _PLACE,
    }  # fmt: skip


def _draw(plan: dict[str, Any], subject: Subject, background: Color) -> Row:
    reflection, outputs = subject.reflection, list(plan["outputs"])
    layers = reflection["draw"]["layers"]
    targets = [_target(row["name"], row["texture"], layers, store=True) for row in outputs]
    targets[0]["clear"] = _value(plan, background) if any(background) else None
    for target, row in zip(targets, reflection["targets"], strict=True):
        if row["clear"] is not None:
            target["clear"] = _value(plan, row["clear"])
    depth = None
    state = reflection["render_state"]
    if state["samples"] > 1:
        _draw_samples(plan, targets, state["samples"])
    stencil = state["stencil"] is not None
    if state[_DEPTH]["write"] or state[_DEPTH]["compare"] != "always":
        depth = _target(_DEPTH, len(plan["textures"]), layers, store=False)
        if state[_DEPTH]["clear"] is not None:
            depth["clear"] = _value(plan, [state[_DEPTH]["clear"]])
        if stencil:
            depth["stencil"] = {"load": "clear", "store": False, "clear": 0}
        plan["textures"].append({
            **plan["textures"][0],
            "format": _DEPTH_FORMATS[stencil],
            "samples": state["samples"],
            "uses": [_DEPTH],
            "results": [depth["result"]],
        })  # fmt: skip
        found = depth["texture"] if state["samples"] == 1 else None
        plan["results"].append(_result_row(depth["result"], found, ""))
    return {
        "kind": "draw", "name": STEP, "pass": reflection["pass"], "only_first": False,
        "barriers": [
            *(_barrier(number, _NEW, "target") for row in targets for number in _drawn_to(row)),
            *([_barrier(depth["texture"], _NEW, _DEPTH)] if depth else []),
        ],
        "buffer_barriers": [],
        "targets": targets,
        "depth": depth,
        "viewport": None, "scissor": None, "blend_constant": None,
        "draws": [{
            "models": WHOLE, "vertices": None, "light": None,
            "uses": [{"material": subject.name, "shader": 0, "inputs": []}],
        }],
        "source": _PLACE,
    }  # fmt: skip


def _draw_samples(plan: dict[str, Any], targets: Sequence[dict[str, Any]], samples: int) -> None:
    """Have targets drawn with several samples, which are resolved to what they were drawn to."""
    for target in targets:
        resolved = target["texture"]
        target["resolve"] = {"texture": resolved, "layer": 0, "level": 0}
        target["texture"], target["store"] = len(plan["textures"]), False
        plan["textures"].append(
            {**plan["textures"][resolved], "samples": samples, "uses": ["target"]}
        )


def _drawn_to(target: Row) -> Iterator[int]:
    """The textures to which something is written."""
    yield target["texture"]
    if target["resolve"] is not None:
        yield target["resolve"]["texture"]


def _target(name: str, texture: int, layers: Row | None, *, store: bool) -> dict[str, Any]:
    return {
        "name": name, "result": f"{STEP}.{name}", "texture": texture,
        "layer": None if layers else 0, "level": 0, "load": "clear", "clear": None, "store": store,
        "resolve": None, "over": None,
    }  # fmt: skip


def _value(plan: dict[str, Any], lanes: Sequence[float]) -> int:
    """The number of a new value of the plan: a constant."""
    steps: list[Row] = [
        {"op": "constant", "type": "float", "value": float(lane), "args": []} for lane in lanes
    ]
    if len(lanes) > 1:
        type_ = f"vec{len(lanes)}"
        steps.append({"op": "vector", "type": type_, "args": list(range(len(lanes)))})
    plan["values"].append({"representation": steps[-1]["type"], "steps": steps})
    return len(plan["values"]) - 1


def _run(plan: dict[str, Any]) -> Row:
    images, buffers = _outputs(plan)
    return {
        "kind": "run", "name": STEP, "only_first": False, "shader": 0, "inputs": [],
        "barriers": [_barrier(row["texture"], _NEW, "image") for row in images],
        "buffer_barriers": [_buffer_barrier(row, _NEW, "written") for row in buffers],
        "images": [{key: row[key] for key in ("name", "result", "texture")} for row in images],
        "buffers": [{key: row[key] for key in ("name", "result")} for row in buffers],
        "source": _PLACE,
    }  # fmt: skip


def _outputs(plan: dict[str, Any]) -> tuple[list[Row], list[Row]]:
    """Those that are pictures, and those that are buffers."""
    rows: list[Row] = plan["outputs"]
    pictures = [row for row in rows if row["texture"] is not None]
    return pictures, [row for row in rows if row["texture"] is None]


def _barrier(texture: int, before: str, after: str) -> Row:
    return {"texture": texture, "from": before, "to": after, "only_first": False}


def _buffer_barrier(row: Row, before: str, after: str) -> Row:
    return {"result": row["result"], "from": before, "to": after, "only_first": False}


def captures(frame: SingleFrame) -> bool:
    """Whether it captures the vertices of a mesh, which ``give_captured`` gives it."""
    return frame.shaders[0].reflection["capture"] is not None


def give_captured(host: FrameHost, mesh: str, instances: int) -> None:
    """Give a kernel that captures the vertices of a mesh, in the scene of a material."""
    (instance,) = host.instances
    whole = with_inputs(instance.reflection, MESHES[mesh](), instances)
    give_elements(set_up(instance, whole, Scene(), host.size))


def single_scenery(frame: SingleFrame, mesh: str, instances: int) -> Scenery:
    """A mesh with the material, and the camera and lights that ``burnish render`` has for it."""
    reflection = frame.shaders[0].reflection
    if not frame.plan["models"]:
        return Scenery(())
    scene = Scene()
    whole = with_inputs(reflection, MESHES[mesh](), instances)
    if any(row["blend"] is not None for row in reflection["targets"]):
        whole = farthest_first(whole, scene.camera.eye)
    return Scenery((Model(whole, frame.name, scene.object_to_world),), scene)
