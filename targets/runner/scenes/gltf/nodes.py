"""Walks over the nodes of a glTF file: finds their transforms to world space, and their tags.

Nodes form trees, however deep. A file that says otherwise is refused. Tags are handed down, so
there may be many more of them than in the file, and they are counted.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .....compiler.budget import Tally
from ...cameras import Matrix
from ..records import SceneError
from .schema import Extras, File, Node


@dataclass(frozen=True, eq=False, slots=True)
class Placed:
    """A node in the world."""

    number: int
    node: Node
    to_world: Matrix
    tags: frozenset[str]
    """The node's own tags, and those of the nodes above it."""

    @property
    def name(self) -> str:
        """The node's name, or its number if it has none."""
        return self.node.name or f"node {self.number}"


def placed_nodes(file: File, path: Path, memory: Tally) -> list[Placed]:
    """The nodes of the file's scene, each before those below it.

    Raises ``SceneError``, and ``BudgetError`` if they take too much.
    """
    _check_parents(file)
    memory.add(len(file.nodes) * _BYTES_OF_NODE)
    tags = Tally("values", f"handing down the tags of {path} takes")
    return list(_walk(file, _roots(file), tags))


_BYTES_OF_NODE = 1000
"""Bytes that placing a node takes, as measured."""


def _check_parents(file: File) -> None:
    """Raise ``SceneError`` if a node has two parents; so the nodes below a root form a tree."""
    parents: dict[int, int] = {}
    for number, node in enumerate(file.nodes):
        for child in node.children:
            if child >= len(file.nodes):
                raise SceneError(f"node {number}: there is no node {child}")
            if child in parents:
                raise SceneError(
                    f"node {child} has two parents, nodes {parents[child]} and {number}"
                )
            parents[child] = number
    seen: dict[int, int] = {}
    for start in range(len(file.nodes)):
        at = start
        while at in parents and at not in seen:
            seen[at] = start
            at = parents[at]
        if at in parents and seen.get(at) == start:
            raise SceneError(f"node {at} is below itself")


def _roots(file: File) -> tuple[int, ...]:
    """The roots of the scene to show; all roots of a file without scenes."""
    below = {child for node in file.nodes for child in node.children}
    if not file.scenes:
        return tuple(number for number in range(len(file.nodes)) if number not in below)
    wanted = file.scene or 0
    if wanted >= len(file.scenes):
        raise SceneError(f"there is no scene {wanted}")
    roots = file.scenes[wanted].nodes
    for root in roots:
        if root >= len(file.nodes):
            raise SceneError(f"scene {wanted}: there is no node {root}")
        if root in below:
            raise SceneError(f"scene {wanted}: node {root} is no root, as it has a parent")
    if len(set(roots)) < len(roots):
        raise SceneError(f"scene {wanted}: it names a node twice")
    return roots


def _walk(file: File, roots: tuple[int, ...], handed_down: Tally) -> Iterator[Placed]:
    waiting: list[tuple[int, Matrix, frozenset[str]]] = [
        (root, np.eye(4), frozenset()) for root in reversed(roots)
    ]
    while waiting:
        number, above, inherited = waiting.pop()
        node = file.nodes[number]
        own = _own_transform(node, number)
        with np.errstate(all="ignore"):
            to_world = above @ own
        if not (np.abs(to_world) < _LARGEST).all():
            raise SceneError(f"node {number}: its place in the world is not finite")
        if (own[3] != _AFFINE).any():
            raise SceneError(f"node {number}: its matrix is no move, turn or scale")
        tags = inherited
        if isinstance(node.extras, Extras) and not inherited.issuperset(node.extras.tags):
            tags = inherited.union(node.extras.tags)
            handed_down.add(len(tags))
        yield Placed(number, node, to_world, tags)
        waiting += [(child, to_world, tags) for child in reversed(node.children)]


_AFFINE = np.array([0.0, 0.0, 0.0, 1.0])
"""The last row of every transform that a node can have."""
_LARGEST = float(np.finfo(np.float32).max)


def _own_transform(node: Node, number: int) -> Matrix:
    """The transform from a node to the one above it."""
    if node.matrix is not None:
        return np.array(node.matrix).reshape(4, 4).T
    x, y, z, w = _unit(node.rotation, number)
    turn = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    transform = np.eye(4)
    transform[:3, :3] = turn * np.array(node.scale)
    transform[:3, 3] = node.translation
    return transform


def _unit(rotation: tuple[float, float, float, float], number: int) -> NDArray[np.float64]:
    with np.errstate(over="ignore"):
        length = float(np.linalg.norm(rotation))
    if not 0.5 < length < 2:
        raise SceneError(
            f"node {number}: its rotation is a quaternion of length {length:.3g}, not 1"
        )
    return np.array(rotation) / length
