"""What an engine is called with when it draws a frame, by Burnish's own host of plans.

A program in a host's language draws each of ``drawings`` by its binding, with an engine that writes
down its calls: for each model or vertices that are drawn, and each kernel, a list of the shader's
name, its textures and buffers, and the bytes of its blocks before and after ``give``. ``wrong``
compares them with what ``FrameHost`` computes for the same values.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

from burnish.bindings.frames.model import Dispatch, Frame, Pass, Use
from burnish.compiler.documents.plan import DrawStep, RunStep
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.frames.step_draws import Read, StepDraw, StepDraws
from burnish.targets.runner.instances.blocks import write
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.instances.shapes import shape_of
from burnish.targets.runner.instances.values import filled

from .kit import compiled_frames, difference

SIZE = 96, 61


class Drawing(NamedTuple):
    """A frame, drawn once."""

    frame: Frame
    values: dict[str, Any]
    """The values of its parameters, by the words of their fields, in lanes and columns."""
    models: list[dict[str, Any]]
    """The models of the scene: ``material`` and ``tags``."""
    first: bool


@cache
def drawings() -> tuple[Drawing, ...]:
    """All frames of the examples: the first frame, and the one after it where it differs."""
    return tuple(
        Drawing(frame, _values(frame, _host(number)), _models(_host(number)), first)
        for number, (frame, _) in enumerate(compiled_frames())
        for first in ((True, False) if frame.asks_for_first else (True,))
    )


@cache
def _host(number: int) -> FrameHost:
    frame, compiled = compiled_frames()[number]
    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for row in tags.values() for each in row))
    host = FrameHost(compiled, in_a_row(materials, tags, "torus"), SIZE)
    for row in frame.plan.parameters:
        if row.range is not None and row.representation == "float" and row.group != "rig":
            low, high = row.range
            host.set(row.name, low + 0.37 * (high - low))
    for light in frame.plan.lights:
        if light.count is not None:
            host.values.set(light.count, 2)
    host.begin(3)
    return host


def _values(frame: Frame, host: FrameHost) -> dict[str, Any]:
    """The values of the frame's parameters; those that no scene gives are left out."""
    rows = {row.name: row for row in frame.plan.parameters}
    found = {}
    for field in frame.parameters.structure.fields:
        value = host.values._values.get(field.name) if field.name in rows else None
        if value is not None:
            found[field.word] = filled(shape_of(rows[field.name]), value)
    return found


def _models(host: FrameHost) -> list[dict[str, Any]]:
    return [
        {"material": each.material, "tags": ["scene", *sorted(each.tags)]}
        for each in host.scenery.models
    ]


# -- what is expected ------------------------------------------------------------------------------


def wrong(drawing: Drawing, calls: list[list[Any]]) -> str:
    """How the calls differ from those that Burnish's own host would make; empty if they agree."""
    number = [frame.name for frame, _ in compiled_frames()].index(drawing.frame.name)
    expected = list(_calls(drawing, _host(number)))
    for at, (one, other) in enumerate(zip(expected, calls, strict=False)):
        if reason := _differs(one, other):
            return f"{drawing.frame.name}, call {at}: {reason}"
    return "" if len(expected) == len(calls) else f"{len(calls)} calls, not {len(expected)}"


def _calls(drawing: Drawing, host: FrameHost) -> Iterator[list[Any]]:
    frame, first = drawing.frame, drawing.first
    host.begin(3)
    host.kernels.clear()
    draws = StepDraws(host)
    runs = [step for step in frame.plan.steps if isinstance(step, RunStep)]
    for run in runs:
        draws.kernel(run, is_first=first)
    sizes = [list(host.size_of(number)) for number in range(len(frame.textures))]
    yield ["begin", sizes]
    for step in frame.steps:
        if step.row.only_first and not first:
            continue
        if isinstance(step, Pass):
            yield from _pass(step, host, draws, first)
        elif isinstance(step, Dispatch):
            draw = draws.kernel(step.row, is_first=first)
            images = {name: texture.number for name, texture in step.images}
            group = draw.state.instance.reflection.work_group
            sides = (*draw.state.instance.image_size(), 1)
            assert group is not None
            groups = [-(-side // one) for side, one in zip(sides, group, strict=True)]
            yield ["dispatch", _used(step.use, draw), groups, images]
        else:
            yield ["copy", step.row.copied.texture, step.row.into.texture]
    yield ["end"]


def _pass(step: Pass, host: FrameHost, draws: StepDraws, first: bool) -> Iterator[list[Any]]:
    row = step.row
    assert isinstance(row, DrawStep)
    state = host.state_of(row)
    uses = {id(use): use for use in step.uses}
    by_shader = {use.shader.name: use for use in uses.values()}
    for layer in range(step.layers):
        attachments = [
            [
                each.row.texture,
                each.row.layer if step.layers == 1 else layer,
                each.row.level,
                each.row.load,
                list(host.clear_of(each.row)),
                each.row.store,
            ]
            for each in (*step.targets, *((step.depth,) if step.depth else ()))
        ]
        viewport = None if row.viewport is None else state.viewport
        scissor = None if row.scissor is None else state.scissor
        constant = None if row.blend_constant is None else list(state.blend_constant)
        yield ["pass", row.name, attachments, viewport, scissor, constant]
        for draw in draws.of(row, is_first=first):
            shader = host.plan.shaders[draw.shader].name
            use = by_shader[shader]
            if use.layer is not None:
                draw.state.instance.set(use.layer[1].name, layer)
            vertices = None if use.material is not None else len(draw.state.triangles)
            yield ["draw", _used(use, draw), vertices]
        yield ["end pass"]


class _Used(NamedTuple):
    shader: str
    reads: dict[str, Read]
    instance: Instance
    use: Use


def _used(use: Use, draw: StepDraw) -> _Used:
    return _Used(use.shader.name, dict(draw.reads), draw.state.instance, use)


def _differs(expected: list[Any], found: list[Any]) -> str:
    if expected[0] != found[0]:
        return f"{found[0]} instead of {expected[0]}"
    for one, other in zip(expected[1:], found[1:], strict=True):
        reason = _use_differs(one, other) if isinstance(one, _Used) else _numbers_differ(one, other)
        if reason:
            return f"{expected[0]}: {reason}"
    return ""


def _numbers_differ(one: Any, other: Any) -> str:
    if isinstance(one, list | tuple) and isinstance(other, list) and len(one) == len(other):
        return next(filter(None, map(_numbers_differ, one, other)), "")
    if isinstance(one, float) and isinstance(other, int | float):
        return (
            "" if math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-9) else f"{other} is not {one}"
        )
    return "" if one == other else f"{other} is not {one}"


def _use_differs(used: _Used, found: list[Any]) -> str:
    """How a use differs from what is given: its shader, its reads, and the bytes of its blocks.

    These are those that a host sets, in the order of the material's, before and after.
    """
    shader, reads, before, after = found
    if shader != used.shader:
        return f"{shader} is not {used.shader}"
    textures = {name: read.texture for name, read in used.reads.items() if read.texture is not None}
    read = {name: each["texture"] for name, each in reads.items() if "texture" in each}
    if read != textures:
        return f"{shader} reads {read}, not {textures}"
    given = [block for block in used.use.shader.blocks if block.derivation is None]
    expected = {block.name: bytearray(bytes_) for block, bytes_ in zip(given, before, strict=True)}
    fields = [(give.block, give.field) for give in used.use.gives]
    for block, field in (*fields, *((used.use.layer,) if used.use.layer else ())):
        row = next(r for r in used.instance.reflection.parameters if r.name == field.name)
        value = filled(shape_of(row), used.instance._values[field.name])
        write(expected[block.name], field.offset, shape_of(row), value)
    for name, bytes_ in zip(expected, after, strict=True):
        if reason := difference(bytes(expected[name]), bytes(bytes_)):
            return f"{shader}, {name}: {reason}"
    return ""
