"""The digest by which a binding in a host's language sees that it was made for other texts.

``reflection.py`` asks. Blocks have digests of their own, and groups have some of their layouts;
this one is of all that names, numbers and states of other things say in the tables of a binding.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...compiler.documents.backends import BackendRow
from ...compiler.documents.digests import layout_digest
from ...compiler.ir.program import Program
from ...compiler.ir.stages import IMAGE, TARGET
from ...compiler.ir.types import Struct


def binding_id(row: BackendRow, program: Program) -> str:
    """The digest of a row that has none yet."""
    files = [(file.stage, file.file, file.entry_point) for file in row.files]
    places = [
        (kind, name, place.identifier, place.group, place.binding)
        for kind, places in (
            ("block", row.blocks), ("buffer", row.buffers), ("image", row.images),
            ("texture", row.textures), ("sampler", row.samplers),
        )
        for name, place in places.items()
    ]  # fmt: skip
    layouts = [layout.layout_id for layout in row.layouts]
    pushed = row.push_constants and row.push_constants.block
    return layout_digest(files, places, layouts, pushed, row.front_face, *_of_material(program))


def _of_material(program: Program) -> Iterator[object]:
    """What all profiles have in common: textures, buffers, vertex inputs and targets."""
    shader = program.shader
    for info in shader.textures:
        leaf = info.leaf
        yield leaf.name, str(leaf.type), leaf.state, leaf.default, info.intent
    for each in (*shader.buffers, *shader.written):
        element = each.leaf.type.element
        yield each.leaf.name, str(element), _members(element)
    for field in program.vertex_inputs:
        yield field.name, str(field.type), field.location
    for result in (*shader.results_of(IMAGE), *shader.results_of(TARGET)):
        yield result.name, result.state and result.state.format


def _members(element: object) -> list[tuple[str, str]]:
    rows: Iterable[tuple[str, object]] = element.members if isinstance(element, Struct) else ()
    return [(name, str(type_)) for name, type_ in rows]
