"""Gives what is drawn the light that surrounds it: a studio, unless the command line asks for more.

``render`` and ``view`` call it for every subject. ``conform`` does not: its cases keep the values
that the language declares.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from .console import remark
from .options import STUDIO

if TYPE_CHECKING:
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.instances.declared import TextureDeclaration
    from ..targets.runner.instances.host_values import HostValues
    from ..targets.runner.textures.environments import Environment


def surround(hosts: Iterable[FrameHost], asked: str) -> None:
    """Set cube maps of colours to an environment, and light from everywhere to its mean.

    To be called before values of the command line are set, which win. Raises ``PictureError`` and
    ``BudgetError`` for the file of an environment.
    """
    from ..targets.runner.textures.environments import environment

    found = environment(asked)
    if found is None:
        return
    for host in hosts:
        for values, taken in _owners(host):
            _surround(values, found, taken)


def tell_surroundings(hosts: Sequence[FrameHost], asked: str, given: Iterable[str]) -> None:
    """Note the cube maps that show an environment nobody has asked for."""
    if asked != STUDIO:
        return
    shown = {
        row.name
        for host in hosts
        for values, taken in _owners(host)
        for row in _cubes(values, taken)
    }
    for name in sorted(shown.difference(given)):
        remark("note", (
            f"`{name}` is a small studio: --environment sky or --set {name}=PANORAMA.hdr sets "
            "another"
        ))  # fmt: skip


def _owners(host: FrameHost) -> Iterator[tuple[HostValues, frozenset[str]]]:
    """The values of a frame and of its shaders, with the names that the frame sets."""
    yield host.values, frozenset()
    inputs: list[set[str]] = [set() for _ in host.instances]
    for step in host.plan.steps:
        for use in step.uses:
            inputs[use.shader] |= {row.name for row in use.inputs}
    for instance, names in zip(host.instances, inputs, strict=True):
        yield instance, frozenset(names)


def _surround(values: HostValues, found: Environment, taken: frozenset[str]) -> None:
    from ..targets.runner.scene import takes_mean_radiance

    for texture in _cubes(values, taken):
        is_array = texture.dimension == "cube_array"
        values.set(texture.name, found.texture.as_array() if is_array else found.texture)
    for row in values.declared.parameters:
        if takes_mean_radiance(row) and row.name not in taken:
            values.set(row.name, found.mean)


def _cubes(values: HostValues, taken: frozenset[str]) -> Iterator[TextureDeclaration]:
    """The cube maps of colours, and arrays of them, that a shader reads and the host binds, and no
    step of a light."""
    from ..compiler.documents.drawing import TextureRow

    for row in values.declared.textures:
        is_cube = row.dimension in ("cube", "cube_array")
        is_light = is_cube and (row.sample, row.intent) == ("float", "color")
        is_missing = isinstance(row, TextureRow) and (row.brought or not row.stages)
        if is_light and not is_missing and row.name not in taken:
            yield row
