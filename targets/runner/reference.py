"""Shots drawn by the reference."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from ...compiler.ir.leaves import Attribute
from ...compiler.ir.node import reachable
from ...compiler.ir.shader import Shader
from ...compiler.ir.types import scalar_kind, width
from ...compiler.reference.picture import Expected, Geometry, RasterRules, Texels, draw
from .drivers.wire import to_json
from .shots import Shot
from .store import Store, digest, digest_of_sources

STORE = "expected"
"""The name of the store that keeps what the reference has drawn."""

Progress = Callable[[float], None]
"""Is told the part that is done, from 0 to 1."""


def expected(
    shader: Shader, shot: Shot, rules: RasterRules, progress: Progress | None = None
) -> Expected:
    """What a shot has to look like, always drawn anew."""
    instance = shot.instance
    return draw(
        shader,
        instance.values(),
        {name: Texels(tuple(texture.linear())) for name, texture in instance.textures().items()},
        _whole(shot.geometry(), shader),
        rules,
        shot.clear,
        progress,
    )


def _whole(geometry: Geometry, shader: Shader) -> Geometry:
    """With numbers for vertex inputs that the compiler has proven needless, as nothing binds them.

    Should it be wrong, they show.
    """
    attributes = dict(geometry.attributes)
    for node in reachable(shader.roots):
        if isinstance(node.data, Attribute) and node.data.name not in attributes:
            shape = geometry.vertex_count, width(node.data.type)
            numbers = np.rint(100 * np.sin(np.arange(np.prod(shape)))).reshape(shape)
            whole = scalar_kind(node.data.type) != "float"
            attributes[node.data.name] = np.abs(numbers).astype(np.int64) if whole else numbers
    return replace(geometry, attributes=attributes)


def remembered(shader: Shader, shot: Shot, rules: RasterRules, store: Store) -> Expected:
    """The same, from the store if the reference has drawn it before."""
    name = _digest(shader, shot, rules)
    kept = store.read(name)
    if kept is not None:
        found: Expected = pickle.loads(kept)
        return found
    made = expected(shader, shot, rules)
    store.write(name, pickle.dumps(made, pickle.HIGHEST_PROTOCOL))
    return made


def _digest(shader: Shader, shot: Shot, rules: RasterRules) -> str:
    """Everything that the picture depends on."""
    kinds = [(name, str(values.dtype)) for name, values in shot.attributes.items()]
    drawn = json.dumps([to_json(shot.draw()), kinds])
    values = repr(shot.instance.values())
    return digest(_code_digest(), np.__version__, _graph_text(shader), repr(rules), values, drawn)


def _graph_text(shader: Shader) -> str:
    """Everything that the reference reads of a shader."""
    nodes = map(repr, reachable(shader.roots))
    results = [
        (r.kind, r.stage.name, r.value.id, r.state and (r.state.format, r.state.blend))
        for r in shader.results
    ]
    return "\n".join([*nodes, repr(results)])


@cache
def _code_digest() -> str:
    """Changes with the code that says what a program means, and what a texture's bytes do."""
    root, here = Path(__file__).parents[2], Path(__file__).parent
    folders = (root / "compiler", root / "stdlib", here / "textures")
    return digest(digest_of_sources(*folders), Path(__file__).read_bytes())
