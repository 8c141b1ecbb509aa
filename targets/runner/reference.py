"""Draws with the reference, and keeps its pictures in a store.

``conform`` calls ``remembered`` for single shaders; ``frames/by_reference.py`` draws frames.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.budget import check
from ...compiler.ir.leaves import Attribute, Parameter
from ...compiler.ir.node import Formal, Node, formals_of, reachable
from ...compiler.ir.shader import Shader
from ...compiler.ir.types import Array, Struct, scalar_kind, width
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, Geometry, RasterRules, Texels, draw
from ...compiler.reference.storage_buffers import Contents
from .drivers.texels import TEXELS
from .drivers.wire import to_json
from .instances.derived import Inputs, computed
from .instances.instance import Instance
from .instances.shapes import shape_of
from .kept_arrays import dumped_arrays, loaded_arrays
from .kept_pictures import Rules, kept
from .scene_state import SceneState
from .store import Store, digest, digest_of_sources

STORE = "expected"
"""The name of the store that keeps the reference's pictures."""

Floats = NDArray[np.float64]

_BYTES_OF_TEXEL = 100
"""Bytes that the reference takes for each texel of all levels, with the bounds of what devices
read, as measured."""


def expected(
    shader: Shader,
    state: SceneState,
    rules: RasterRules,
    errors: Errors | None = None,
) -> Expected:
    """The picture that every driver must draw; always computed again.

    With the ``errors`` of functions, it has the bounds of a driver's picture.
    """
    return _stacked(
        [
            draw(
                shader,
                values_for(shader, layer.instance),
                texels_of(layer.instance),
                geometry_for(shader, layer.geometry()),
                rules,
                layer.clear,
                errors,
                layer.blend_constant,
            )
            for layer in state.layers or (state,)
        ]
    )


def _stacked(pictures: Sequence[Expected]) -> Expected:
    """The reference's layers as one picture, the rows of the first one on top."""
    if len(pictures) == 1:
        return pictures[0]
    return Expected(
        _stacked_targets([picture.targets for picture in pictures]),
        np.concatenate([picture.covered for picture in pictures]),
        np.concatenate([picture.undecided for picture in pictures]),
        _stacked_targets([picture.low for picture in pictures]),
        _stacked_targets([picture.high for picture in pictures]),
        np.concatenate([picture.layers for picture in pictures]),
        frozenset().union(*(picture.counted for picture in pictures)),
    )


def _stacked_targets(pictures: Sequence[Sequence[Floats]]) -> tuple[Floats, ...]:
    return tuple(np.concatenate(layers) for layers in zip(*pictures, strict=True))


def values_for(
    shader: Shader, instance: Instance, written: Mapping[str, Contents] | None = None
) -> dict[str, Any]:
    """The values of a shader's parameters, and the contents of its buffers, for the reference.

    ``written`` are the contents of buffers that kernels have written, of which the instance has the
    bytes only. A value that a host sets is exactly a float32. The emitted program also reads
    derived parameters, whose values are given before they are rounded, as that is their meaning.
    """
    values = instance.values()
    values |= {name: Contents(held.bound) for name, held in instance.buffers().items()}
    values |= {name: held for name, held in (written or {}).items() if held.data}
    read = [node.data for node in reachable(shader.roots) if isinstance(node.data, Parameter)]
    wanted = [parameter for parameter in read if parameter.derived]
    if not wanted:
        return values
    shapes = {row.name: shape_of(row) for row in instance.reflection.parameters}
    rows = computed(instance.reflection.derived, Inputs(shapes, values))
    found = {row.name: value for row, _shape, value in rows}
    return values | {parameter.name: _derived(parameter, found) for parameter in wanted}


def _derived(parameter: Parameter, found: Mapping[str, Any]) -> Any:
    """The value of a derived parameter; a table has one in ``found`` for each member."""
    if parameter.name in found or not isinstance(parameter.type, Array):
        return found[parameter.name]
    assert isinstance(parameter.type.element, Struct)
    columns = [found[f"{parameter.name}.{name}"] for name, _type in parameter.type.element.members]
    return tuple(zip(*columns, strict=True))


def texels_of(instance: Instance) -> dict[str, Texels]:
    """The texels of all textures, by name. Raises ``BudgetError`` where reading these takes too
    much memory."""
    textures = instance.textures()
    count = sum(len(level) // TEXELS[each.format].size for each in textures.values()
                for level in each.levels)  # fmt: skip
    check("memory", count * _BYTES_OF_TEXEL, "what the reference reads of textures takes")
    return {
        name: Texels(
            tuple(texture.linear()),
            is_srgb=texture.format.endswith("-srgb"),
            stored="fixed" if "unorm" in texture.format else "float",
        )
        for name, texture in textures.items()
    }


def geometry_for(shader: Shader, geometry: Geometry) -> Geometry:
    """The geometry with arbitrary numbers for inputs that the compiler has proven unnecessary.

    Nothing binds these inputs. If the compiler were wrong, the picture would show it.
    """
    attributes = dict(geometry.attributes)
    for node in reachable(shader.roots):
        if isinstance(node.data, Attribute) and node.data.name not in attributes:
            shape = geometry.vertex_count, width(node.data.type)
            numbers = np.rint(100 * np.sin(np.arange(np.prod(shape)))).reshape(shape)
            whole = scalar_kind(node.data.type) != "float"
            attributes[node.data.name] = np.abs(numbers).astype(np.int64) if whole else numbers
    return replace(geometry, attributes=attributes)


@dataclass(frozen=True, slots=True)
class Program:
    """A shader, with the text of everything that the reference reads of it, as a key."""

    shader: Shader
    text: str

    @classmethod
    def of(cls, shader: Shader) -> Program:
        """The program of a shader; making its text takes a while."""
        return cls(shader, graph_text(shader))


def remembered(
    program: Program,
    state: SceneState,
    rules: RasterRules,
    store: Store,
    errors: Errors | None = None,
) -> Expected:
    """The expected picture, from the store if the reference has drawn it before."""
    return kept(
        store, rules, partial(_digest, program, state, errors),
        partial(expected, program.shader, state, rules, errors), dumped=dumped, loaded=loaded,
    )  # fmt: skip


def dumped(picture: Expected) -> bytes:
    """A picture as bytes, from which ``loaded`` makes it again."""
    ends = *picture.targets, *picture.low, *picture.high
    parts = picture.covered, picture.undecided, picture.layers, *ends
    return dumped_arrays(sorted(picture.counted), parts)


def loaded(data: bytes) -> Expected:
    """The picture that was dumped."""
    counted, (covered, undecided, layers, *floats) = loaded_arrays(data)
    count = len(floats) // 3
    targets, low, high = (tuple(floats[i * count :][:count]) for i in range(3))
    rules = frozenset(map(tuple, counted))
    return Expected(targets, covered, undecided, low, high, layers, counted=rules)


def _digest(program: Program, state: SceneState, errors: Errors | None, rules: Rules) -> str:
    """A digest of everything that the picture depends on, as far as the rules say it."""
    kinds = [(name, str(values.dtype)) for name, values in state.attributes.items()]
    first, *others = state.draws()
    draws = [to_json(first), *(to_json(each.blocks) for each in others)]
    drawn = json.dumps([draws, state.clear, state.blend_constant, kinds])
    allowed, values = repr((rules, errors)), repr(state.instance.values())
    return digest(code_digest(), np.__version__, program.text, allowed, values, drawn)


def graph_text(shader: Shader) -> str:
    """Everything that the reference reads of a shader, as text."""
    numbers: dict[Formal, int] = {}
    nodes = [_node_text(node, numbers) for node in reachable(shader.roots)]
    results = [(r.kind, r.stage.name, r.value.id, r.state) for r in shader.results]
    return "\n".join([*nodes, repr(results), repr(shader.render_state)])


def _node_text(node: Node, numbers: dict[Formal, int]) -> str:
    """A node with all of its data, and the variables of opened binders by number: several may have
    the same name."""
    formals = (node.data,) if isinstance(node.data, Formal) else formals_of(node)
    known = [numbers.setdefault(formal, len(numbers)) for formal in formals]
    operands = [operand.id for operand in node.operands]
    return f"{node.id} {node.op} {operands} {node.type} {node.data!r} {known}"


@cache
def code_digest() -> str:
    """A digest of the code that defines the meaning of graphs and textures.

    The code that makes the graph of a shader does not count, since the graph itself is part of the
    key.
    """
    root, here = Path(__file__).parents[2], Path(__file__).parent
    compiler = root / "compiler"
    folders = (root / "stdlib", compiler / "ir", compiler / "reference", here / "textures")
    own = (here / name for name in (Path(__file__).name, "kept_arrays.py"))
    return digest(digest_of_sources(*folders), *(path.read_bytes() for path in own))
