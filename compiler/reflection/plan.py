"""The plan of a frame as one JSON document: ``plan.schema.json`` describes it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..diagnostics.source import Span
from ..ir.frame import (
    Drawn,
    Elements,
    FrameShader,
    FromHost,
    Given,
    Image,
    KernelStep,
    Previous,
    RenderStep,
    Use,
)
from ..ir.leaves import Resource
from ..ir.shader import ResourceInfo
from ..ir.types import Texture
from ..planning.barriers import Barrier, BufferBarrier, Waiting
from ..planning.plan import Copy, Plan, PlannedStep, Target
from ..planning.textures import Shape
from .buffers import buffer_row
from .parameters import Places, light_rows, parameter_row
from .values import steps

VERSION = 1
"""Grows when a host that executes plans has to change."""


def plan_document(plan: Plan) -> dict[str, Any]:
    """Everything that a host needs to draw a frame, but for the reflections of its shaders."""
    return _Document(plan).rows()


class _Document:
    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._frame = plan.frame
        self._shaders: Mapping[FrameShader, int] = {
            shader: number for number, shader in enumerate(self._frame.shaders)
        }
        self._previous = {kept.left: kept.previous for kept in plan.kept}
        self._values = {node: n for n, node in enumerate(dict.fromkeys(self._frame.values))}
        """Equal values are one node, and one row."""

    def rows(self) -> dict[str, Any]:
        frame = self._frame
        names = frozenset(info.parameter.name for info in frame.parameters)
        return {
            "plan": VERSION,
            "frame": frame.name,
            "doc": frame.doc,
            "source": _place(frame.span),
            "rig": frame.rig,
            "parameters": [parameter_row(info, names, Places(())) for info in frame.parameters],
            "lights": light_rows(frame.parameters),
            "host_textures": [_host_texture_row(info) for info in frame.resources],
            "host_buffers": [
                {**buffer_row(info), "count": info.buffer.count.name, "stages": []}
                for info in frame.buffers
            ],
            "sources": dict(self._sources()),
            "models": [
                {
                    "name": models.name,
                    "materials": list(models.materials),
                    "doc": models.doc,
                    "source": _place(models.span),
                }
                for models in frame.models
            ],
            "shaders": [_shader_row(shader) for shader in frame.shaders],
            "values": [
                {"representation": str(value.type), "steps": steps(value)} for value in self._values
            ],
            "textures": list(self._texture_rows()),
            "results": list(self._result_rows()),
            "steps": [self._step_row(planned) for planned in self._plan.steps],
            "end": _waiting_rows(self._plan.end),
            "kept": list(self._kept_rows()),
            "outputs": [
                {
                    "name": output.name,
                    "result": output.source.name,
                    "texture": self._texture(output.source),
                    "doc": output.doc,
                    "source": _place(output.span),
                }
                for output in frame.outputs
            ],
        }

    # --- what there is ---

    def _sources(self) -> Iterator[tuple[str, dict[str, Any]]]:
        """Where everything is declared that the host sets."""
        frame = self._frame
        for info in frame.parameters:
            yield info.parameter.name, _place(info.span)
        for texture in frame.resources:
            yield texture.resource.name, _place(texture.span)
        for buffer in frame.buffers:
            yield buffer.buffer.name, _place(buffer.span)

    def _texture_rows(self) -> Iterator[dict[str, Any]]:
        for texture in self._plan.textures:
            shape = texture.shape
            yield {
                "format": shape.format,
                "dimension": shape.dimension,
                "size": self._size_row(shape),
                "layers": shape.layers,
                "levels": shape.levels,
                "samples": shape.samples,
                "uses": list(texture.uses),
                "kept": texture.kept,
                "results": [each.name for each in texture.images],
            }

    def _size_row(self, shape: Shape) -> dict[str, Any]:
        if isinstance(shape.size, str):
            return {"value": None, "extent_of": shape.size, "level": shape.halved}
        return {"value": self._values[shape.size], "extent_of": None, "level": shape.halved}

    def _value(self, number: int) -> int:
        """The row of one of the frame's values."""
        return self._values[self._frame.values[number]]

    def _optional(self, number: int | None) -> int | None:
        return None if number is None else self._value(number)

    def _result_rows(self) -> Iterator[dict[str, Any]]:
        numbers = {planned.step: n for n, planned in enumerate(self._plan.steps)}
        steps_ = self._frame.steps
        lifetimes = self._plan.lifetimes
        for left, first in lifetimes.first.items():
            last = min(lifetimes.last[left], len(steps_) - 1)
            yield {
                "name": left.name,
                "kind": "buffer" if isinstance(left, Elements) else "texture",
                "texture": self._texture(left),
                "first": numbers[steps_[first]],
                "last": numbers[steps_[last]],
                "doc": left.doc,
                "source": _place(left.span),
            }

    def _kept_rows(self) -> Iterator[dict[str, Any]]:
        for kept in self._plan.kept:
            yield {
                "result": kept.left.name,
                "texture": kept.texture,
                "previous": kept.previous,
            }

    def _texture(self, left: Image | Elements) -> int | None:
        return self._plan.texture_of.get(left) if isinstance(left, Image) else None

    # --- what is done ---

    def _step_row(self, planned: PlannedStep) -> dict[str, Any]:
        waiting = _waiting_rows(planned.waiting)
        match planned.step:
            case Copy() as copy:
                return {
                    "kind": "copy",
                    **waiting,
                    "only_first": planned.only_first,
                    "from": {"result": copy.image.name, "texture": self._texture(copy.image)},
                    "to": {"result": copy.into.name, "texture": self._texture(copy.into)},
                }
            case RenderStep() as step:
                return {
                    "kind": "draw",
                    "name": step.name,
                    "pass": step.pass_name,
                    **waiting,
                    "only_first": planned.only_first,
                    "continues": planned.continues,
                    "targets": [self._target_row(target) for target in planned.targets],
                    "depth": planned.depth and self._target_row(planned.depth),
                    "viewport": self._optional(step.viewport),
                    "scissor": self._optional(step.scissor),
                    "blend_constant": self._optional(step.blend_constant),
                    "draws": [self._drawn_row(drawn) for drawn in step.draws],
                    "source": _place(step.span),
                }
            case KernelStep() as step:
                return {
                    "kind": "run",
                    "name": step.name,
                    **waiting,
                    "only_first": planned.only_first,
                    **self._use_row(step.use),
                    "images": [
                        {"name": name, "result": image.name, "texture": self._texture(image)}
                        for name, image in step.images.items()
                    ],
                    "buffers": [
                        {"name": name, "result": elements.name}
                        for name, elements in step.buffers.items()
                    ],
                    "source": _place(step.span),
                }

    def _target_row(self, target: Target) -> dict[str, Any]:
        attachment = target.attachment
        texture, layer, level = target.place
        return {
            "name": attachment.target,
            "result": attachment.image.name,
            "texture": texture,
            "layer": layer,
            "level": level,
            "load": "load" if target.loads else "clear",
            "clear": None if target.loads else self._optional(attachment.clear),
            "store": target.stores,
            "resolve": _resolve_row(target),
            "over": attachment.over and attachment.over.name,
            **({"stencil": _stencil_row(target)} if target.has_stencil else {}),
        }

    def _drawn_row(self, drawn: Drawn) -> dict[str, Any]:
        return {
            "models": drawn.models or None,
            "vertices": None if drawn.vertices is None else self._value(drawn.vertices),
            "light": drawn.light or None,
            "uses": [{"material": use.material or None, **self._use_row(use)}
                     for use in drawn.uses],
        }  # fmt: skip

    def _use_row(self, use: Use) -> dict[str, Any]:
        return {
            "shader": self._shaders[use.shader],
            "inputs": [self._input_row(given) for given in use.given],
        }

    def _input_row(self, given: Given) -> dict[str, Any]:
        source = given.source
        if isinstance(source, int):
            return {"name": given.name, "value": self._value(source)}
        if isinstance(source, Previous):
            assert source.of is not None
            initial = source.initially
            if initial is not None and source.of not in self._previous:
                return {"name": given.name, **self._read_row(initial)}
            return {
                "name": given.name,
                "previous": source.of.name,
                "texture": self._previous[source.of],
                "initially": None if initial is None else self._read_row(initial),
            }
        return {"name": given.name, **self._read_row(source)}

    def _read_row(self, source: Image | Elements | FromHost) -> dict[str, Any]:
        if isinstance(source, FromHost):
            return {"host": source.name}
        return {"result": source.name, "texture": self._texture(source)}


def _resolve_row(target: Target) -> dict[str, Any] | None:
    if target.resolved is None:
        return None
    at = target.attachment
    return {"texture": target.resolved, "layer": at.layer, "level": at.level}


def _stencil_row(target: Target) -> dict[str, Any]:
    load = "load" if target.loads else "clear"
    return {"load": load, "store": target.stores_stencil, "clear": 0}


def _waiting_rows(waiting: Waiting) -> dict[str, Any]:
    return {
        "barriers": [{"texture": each.texture, **_from_to(each)} for each in waiting.textures],
        "buffer_barriers": [
            {"result": each.elements.name, **_from_to(each)} for each in waiting.buffers
        ],
    }


def _from_to(barrier: Barrier | BufferBarrier) -> dict[str, Any]:
    return {"from": barrier.before, "to": barrier.after, "only_first": barrier.only_first}


def _shader_row(shader: FrameShader) -> dict[str, Any]:
    made = shader.shader
    return {
        "name": shader.name,
        "reflection": f"{shader.name}.json",
        "pass": made.pass_name or None,
        "rig": made.rig_name or None,
    }


def _host_texture_row(info: ResourceInfo) -> dict[str, Any]:
    resource: Resource = info.resource
    assert isinstance(resource.type, Texture)
    return {
        "name": resource.name,
        "type": str(resource.type),
        "dimension": resource.type.dimension,
        "sample": resource.type.sample,
        "group": resource.group,
        "default": resource.default,
        "doc": info.doc,
    }


def _place(span: Span) -> dict[str, Any]:
    """Where something is declared: lines and columns count from 1."""
    line, column = span.source.position(span.start)
    return {
        "file": span.source.name_in_outputs,
        "line": line,
        "column": column,
        "length": span.end - span.start,
    }
