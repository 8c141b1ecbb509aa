"""Views of a program's declarations outside of stages: structs, blocks, buffers and textures.

Each view is made once for a program, even if several of its texts have the declaration. The emitter
and ``stage.py`` ask for those that a text or a stage needs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...compiler.ir.leaves import Buffer, Texture
from ...compiler.ir.program import Block, Image, Stage, StoredMember
from ...compiler.ir.storage import stored_type, structs_in
from ...compiler.ir.types import RuntimeArray, Struct
from ...support.frozen import cached_property
from ..description.binding_scheme import BindingKind
from ..legalise.bindings import Bindings, BindingSlot
from ..legalise.resource_arguments import Passed
from .comments import comment_line
from .context import Context
from .views import BlockView, BufferView, ImageView, MemberView, StructView, TextureView


class Declarations:
    """Makes and keeps the views for the texts of one program."""

    def __init__(self, context: Context, bindings: Bindings) -> None:
        self._context = context
        self._names = context.names
        self._types = context.types
        self._bindings = bindings

    def structs(self, stages: Iterable[Stage]) -> list[StructView]:
        """The structs that blocks and buffers use in these stages."""
        stages = list(stages)
        stored = (stored_type(buffer.type) for stage in stages for buffer in stage.buffers)
        used = {struct for block in self._blocks_of(stages) for struct in block.structs}
        used.update(structs_in(stored))
        return [self._struct(struct) for struct in self._context.program.structs if struct in used]

    def blocks(self, stages: Iterable[Stage]) -> list[BlockView]:
        """The blocks that any of the stages reads, in the order of the program."""
        return [self._blocks[block.name] for block in self._blocks_of(stages)]

    def buffers(self, stages: Iterable[Stage]) -> list[BufferView]:
        """The storage buffers that any of the stages reads."""
        read = {buffer for stage in stages for buffer in stage.buffers}
        return [self._buffers[b.name] for b in self._context.program.buffers if b in read]

    def images(self, stages: Iterable[Stage]) -> list[ImageView]:
        """The images that any of the stages writes."""
        return [self._image(image) for stage in stages for image in stage.images]

    def textures(self, stages: Iterable[Stage]) -> list[TextureView]:
        """The textures that any of the stages reads, each followed by its sampler.

        A sampler that several of them share follows the first.
        """
        read = {texture for stage in stages for texture in stage.textures}
        textures = (texture for texture in self._context.program.textures if texture in read)
        return self._views(texture.name for texture in textures)

    def parameters(self, passed: Passed) -> list[str]:
        """The parameters by which a function receives blocks, buffers, textures and samplers."""
        forms, declaration = self._context.language.forms, self._context.language.types.declaration
        declared = [self._blocks[name].argument for name in passed.blocks]
        declared += [self._buffers[name].argument for name in passed.buffers]
        declared += [
            declaration.format(type=view.type, name=view.name)
            for view in self._views(passed.textures)
        ]
        return [forms.parameter.format(typed=typed) for typed in declared]

    def arguments(self, passed: Passed) -> list[str]:
        """The arguments for these parameters: everything has the same name in every function."""
        return [
            *(self._blocks[name].variable for name in passed.blocks),
            *(self._buffers[name].name for name in passed.buffers),
            *(view.name for view in self._views(passed.textures)),
        ]

    def _views(self, textures: Iterable[str]) -> list[TextureView]:
        """Some textures by name with their samplers, each of which comes once."""
        views = (view for name in textures for view in self._textures[name])
        return list({view.name: view for view in views}.values())

    def _blocks_of(self, stages: Iterable[Stage]) -> list[Block]:
        read = {block.name for stage in stages for block in stage.blocks}
        return [block for block in self._context.program.blocks if block.name in read]

    @cached_property
    def _blocks(self) -> dict[str, BlockView]:
        return {block.name: self._block(block) for block in self._context.program.blocks}

    @cached_property
    def _buffers(self) -> dict[str, BufferView]:
        return {buffer.name: self._buffer(buffer) for buffer in self._context.program.buffers}

    @cached_property
    def _textures(self) -> dict[str, tuple[TextureView, ...]]:
        textures = self._context.program.textures
        return {texture.name: tuple(self._texture(texture)) for texture in textures}

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
            pushed=block.name == self._bindings.push_constants,
        )

    def _argument(self, block: Block) -> str:
        return self._context.language.forms.block_argument.format(
            type=self._names.blocks[block.name], name=self._names.variables.get(block.name, "")
        )

    def _member(self, block: Block, member: StoredMember) -> MemberView:
        name = self._names.member(block.name, member.name)
        typed = self._types.declare_stored(name, member.type)
        return MemberView(typed, comment_line(member.doc), member.parameter is None)

    def _buffer(self, buffer: Buffer) -> BufferView:
        name, stored = self._names.buffers[buffer.name], stored_type(buffer.type)
        slot = self._bindings.buffers[buffer.name]
        assert isinstance(stored, RuntimeArray)
        element = self._types.type(stored.element)
        forms, is_written = self._context.language.forms, buffer in self._context.program.written
        is_scattered = buffer in self._context.program.scattered
        if is_scattered:
            element = forms.atomic.format(type=element)
        argument = forms.written_argument if is_written else forms.buffer_argument
        return BufferView(
            name=name,
            block=self._names.buffer_blocks.get(buffer.name, ""),
            element=element,
            slot=slot,
            register=self._register("written" if is_written else "buffer", slot),
            argument=argument.format(type=element, name=name),
            written=is_written,
            scattered=is_scattered,
        )

    def _image(self, image: Image) -> ImageView:
        slot = self._bindings.images[image.name]
        return ImageView(
            name=self._names.images[image.name],
            type=self._context.language.images[image.format],
            format=image.format,
            slot=slot,
            register=self._register("image", slot),
        )

    def _texture(self, texture: Texture) -> Iterable[TextureView]:
        """A texture and its sampler, or both in one."""
        names, types = self._names, self._context.textures
        slot = self._bindings.textures[texture.name]
        combined = self._context.profile.samplers.combined
        spell: Callable[[Texture], str] = types.combined if combined else types.texture
        register = self._register("texture", slot)
        yield TextureView(names.textures[texture.name], spell(texture), slot, register)
        if not combined and texture.name in names.samplers:
            slot = self._bindings.samplers[texture.name]
            yield TextureView(
                names.samplers[texture.name],
                types.sampler(texture),
                slot,
                self._register("sampler", slot),
            )

    def _register(self, kind: BindingKind, slot: BindingSlot) -> str:
        return self._context.language.register(kind, slot.binding)
