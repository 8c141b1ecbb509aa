"""A digest of everything by which a device places the faces of a draw, and finds their depths.

Two shaders with invariant positions place the same vertices at the same places, to the last bit, if
both do the same with the same numbers. ``copies.py`` asks for this, so that depths of two draws are
known to be equal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import blake2b
from typing import Any

import numpy as np

from ....support.frozen import changed
from ...ir.leaves import Attribute, Buffer, Parameter, Texture
from ...ir.node import Binder, Formal, Node, formals_of
from ...ir.operations import INPUT
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION
from ..namespace import Lanes
from ..storage_buffers import Contents
from .scene import Geometry, RasterRules, Texels


def placing_of(
    shader: Shader,
    values: Mapping[str, Lanes],
    textures: Mapping[str, Texels],
    geometry: Geometry,
    rules: RasterRules,
) -> bytes | None:
    """The digest of a draw.

    It is ``None`` where a device may place the faces otherwise than another draw of the same.
    """
    if not shader.render_state.is_invariant:
        return None
    held = _Held(values, textures, geometry)
    nodes = list(_in_order([result.value for result in shader.results_of(CLIP_POSITION)]))
    if any(map(held.is_rounded, nodes)):
        return None
    depth = shader.render_state.depth
    bias = depth.bias, depth.slope_bias, depth.bias_clamp
    screen = rules.width, rules.height, rules.port, rules.samples
    counts = geometry.vertex_count, geometry.instance_count, geometry.triangles.shape
    found = blake2b(repr((bias, screen, counts, shader.render_state.fill)).encode())
    found.update(geometry.triangles.tobytes())
    for part in _written(nodes, held):
        found.update(part)
    return found.digest()


def _in_order(roots: Sequence[Node]) -> Iterator[Node]:
    """All nodes below ``roots``, in the order in which they are needed.

    So it does not depend on the rest of the graph.
    """
    seen: set[Node] = set()
    pending = list(roots)[::-1]
    while pending:
        node = pending.pop()
        if node in seen:
            continue
        missing = [operand for operand in node.operands if operand not in seen]
        if missing:
            pending += [node, *missing[::-1]]
        else:
            seen.add(node)
            yield node


def _written(nodes: Sequence[Node], held: _Held) -> Iterator[bytes]:
    """The operations and their operands by number, and the content of the leaves."""
    numbers: dict[Node, int] = {}
    variables: dict[Formal, int] = {}
    for number, node in enumerate(nodes):
        numbers[node] = number
        own = (node.data,) if isinstance(node.data, Formal) else formals_of(node)
        bound = [variables.setdefault(formal, len(variables)) for formal in own]
        operands = [numbers[operand] for operand in node.operands]
        yield repr((node.op, str(node.type), bound, operands)).encode()
        yield from held.data_of(node)


class _Held:
    """The content of the leaves of a draw, as bytes."""

    def __init__(
        self, values: Mapping[str, Lanes], textures: Mapping[str, Texels], geometry: Geometry
    ) -> None:
        self._values = values
        self._textures = textures
        self._geometry = geometry

    def is_rounded(self, node: Node) -> bool:
        """True if a node is a texture that the device itself has drawn.

        Another texture may have other numbers there, though here they are the same.
        """
        return isinstance(node.data, Texture) and bool(self._textures[node.data.name].low)

    def data_of(self, node: Node) -> Iterator[bytes]:
        """The data of a node besides its operation; of a leaf, the value that the device finds."""
        match node.data:
            case Parameter():
                yield from _of_value(self._values[node.data.name])
            case Attribute():
                yield from _of_value(self._geometry.attributes[node.data.name])
            case Texture():
                yield repr(changed(node.data, name="")).encode()
                texels = self._textures[node.data.name]
                yield from _of_value((texels.levels, texels.is_srgb, texels.stored))
            case Buffer():
                yield from _of_value(self._values[node.data.name])
            case Binder():
                yield repr(changed(node.data, formals=None)).encode()
            case Formal():
                pass
            case _:
                yield (INPUT.data(node).name if node.op == "input" else repr(node.data)).encode()


def _of_value(value: Any) -> Iterator[bytes]:
    if isinstance(value, Contents):
        # A kernel's result is the same for all who read it, and for nobody else.
        yield value.data if value.ends is None else value.written.bytes
    elif isinstance(value, tuple | list):
        yield b"("
        for part in value:
            yield from _of_value(part)
        yield b")"
    elif isinstance(value, np.ndarray):
        yield repr((value.shape, str(value.dtype))).encode()
        yield np.ascontiguousarray(value).tobytes()
    else:
        yield repr(value).encode()
