"""Views of the structs, uniform blocks and textures that a program declares outside of its stages.

Each view is made once for a program, even if several of its texts have the declaration. The emitter
and ``stage.py`` ask for those that a text or a stage needs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property

from ...compiler.ir.leaves import Resource
from ...compiler.ir.program import Block, Stage, StoredMember
from ...compiler.ir.types import Struct
from ..description.shading_language import BindingKind
from ..legalise.bindings import Bindings, BindingSlot
from ..legalise.resource_arguments import Passed
from .comments import comment_line
from .context import Context
from .views import BlockView, MemberView, StructView, TextureView


class Declarations:
    """Makes and keeps the views for the texts of one program."""

    def __init__(self, context: Context, bindings: Bindings) -> None:
        self._context = context
        self._names = context.names
        self._types = context.types
        self._bindings = bindings

    def structs(self, stages: Iterable[Stage]) -> list[StructView]:
        """The structs that members of blocks use in these stages."""
        used = dict.fromkeys(
            struct for block in self._blocks_of(stages) for struct in block.structs
        )
        return [self._struct(struct) for struct in used]

    def blocks(self, stages: Iterable[Stage]) -> list[BlockView]:
        """The blocks that any of the stages reads, in the order of the program."""
        return [self._blocks[block.name] for block in self._blocks_of(stages)]

    def textures(self, stages: Iterable[Stage]) -> list[TextureView]:
        """The textures that any of the stages reads, each followed by its sampler."""
        read = {resource for stage in stages for resource in stage.resources}
        return [
            view
            for resource in self._context.program.resources
            if resource in read
            for view in self._textures[resource.name]
        ]

    def parameters(self, passed: Passed) -> list[str]:
        """The parameters by which a function receives blocks, textures and samplers."""
        forms, declaration = self._context.language.forms, self._context.language.types.declaration
        declared = [self._blocks[name].argument for name in passed.blocks]
        declared += [
            declaration.format(type=view.type, name=view.name)
            for name in passed.textures
            for view in self._textures[name]
        ]
        return [forms.parameter.format(typed=typed) for typed in declared]

    def arguments(self, passed: Passed) -> list[str]:
        """The arguments for these parameters: everything has the same name in every function."""
        return [
            *(self._blocks[name].variable for name in passed.blocks),
            *(view.name for name in passed.textures for view in self._textures[name]),
        ]

    def _blocks_of(self, stages: Iterable[Stage]) -> list[Block]:
        read = {block.name for stage in stages for block in stage.blocks}
        return [block for block in self._context.program.blocks if block.name in read]

    @cached_property
    def _blocks(self) -> dict[str, BlockView]:
        return {block.name: self._block(block) for block in self._context.program.blocks}

    @cached_property
    def _textures(self) -> dict[str, tuple[TextureView, ...]]:
        resources = self._context.program.resources
        return {resource.name: tuple(self._texture(resource)) for resource in resources}

    def _struct(self, struct: Struct) -> StructView:
        members = tuple(
            MemberView(self._types.declare_stored(self._names.member(struct.name, name), type_))
            for name, type_ in struct.members
        )
        return StructView(self._names.structs[struct.name], members)

    def _block(self, block: Block) -> BlockView:
        slot = self._bindings.blocks[block.name]
        return BlockView(
            name=self._names.blocks[block.name],
            variable=self._names.variables.get(block.name, ""),
            slot=slot,
            register=self._register("block", slot),
            argument=self._argument(block),
            members=tuple(self._member(block, member) for member in block.members),
        )

    def _argument(self, block: Block) -> str:
        return self._context.language.forms.block_argument.format(
            type=self._names.blocks[block.name], name=self._names.variables.get(block.name, "")
        )

    def _member(self, block: Block, member: StoredMember) -> MemberView:
        name = self._names.member(block.name, member.name)
        return MemberView(self._types.declare_stored(name, member.type), comment_line(member.doc))

    def _texture(self, resource: Resource) -> Iterable[TextureView]:
        """A texture and its sampler, or both in one."""
        names, types = self._names, self._context.textures
        slot = self._bindings.textures[resource.name]
        combined = self._context.profile.samplers.combined
        spell: Callable[[Resource], str] = types.combined if combined else types.texture
        register = self._register("texture", slot)
        yield TextureView(names.textures[resource.name], spell(resource), slot, register)
        if not combined and resource.name in names.samplers:
            slot = self._bindings.samplers[resource.name]
            yield TextureView(
                names.samplers[resource.name],
                types.sampler(resource),
                slot,
                self._register("sampler", slot),
            )

    def _register(self, kind: BindingKind, slot: BindingSlot) -> str:
        return self._context.language.register(kind, slot.binding)
