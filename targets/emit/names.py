"""The final names of everything that a program declares outside of functions.

They are decided once for all stages of a program. So stages that are matched by name agree, and the
reflection lists the names of the text. Blocks are named first, since hosts see their names most: of
two equal names, the later one gets a suffix.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache

from ...compiler.ir.leaves import Argument
from ...compiler.ir.node import Node
from ...compiler.ir.program import Field, Function, Program, Stage, StageName
from ...compiler.ir.stages import TARGET
from ...support.frozen import EMPTY, frozen
from ..description.shading_language import Language
from .namer import Namer
from .own_words import taken_words


@frozen
class Names:
    """The final names. Most tables are looked up by the name that the program suggests."""

    blocks: Mapping[str, str]
    variables: Mapping[str, str]
    """The variable of each block, in languages where members are read through one."""
    members: Mapping[tuple[str, str], str]
    """The names of members, by block (or struct) and member."""
    structs: dict[str, str]
    buffers: Mapping[str, str]
    buffer_blocks: Mapping[str, str]
    """The interface block around each buffer, by buffer, in languages that have interface
    blocks."""
    images: Mapping[str, str]
    textures: Mapping[str, str]
    samplers: Mapping[str, str]
    """The names of samplers, by texture; only textures that are read by a sampler have one.

    Textures that share a sampler have the same name here.
    """
    attributes: Mapping[str, str]
    semantics: Mapping[str, str]
    """The semantic of each attribute in the text, in languages that have semantics."""
    varyings: Mapping[str, str]
    points: Mapping[str, str]
    """The name of a control point's varying, which one stage hands on and the next one reads."""
    render_targets: Mapping[str, str]
    functions: Mapping[tuple[StageName, Node], str]
    """The names of functions, by stage and the function's body."""
    common: Namer
    """The scope around all functions: locals of any stage must not hide its names."""
    arguments: Mapping[Argument, str] = EMPTY
    """The names of arguments of the functions that an engine calls."""

    def member(self, block: str, member: str) -> str:
        """The identifier of a block's or struct's member."""
        return self.members[block, member]

    def function(self, stage: StageName, body: Node) -> str:
        """The function of a stage whose body is ``body``."""
        return self.functions[stage, body]

    def locals(self, own: Iterable[str]) -> Namer:
        """A namer for the body of a function; ``own`` are its stage's global variables."""
        return self.common.inner(own)


def name_program(program: Program, language: Language, sampler_owners: Mapping[str, str]) -> Names:
    """Decide the names of ``program`` in a language.

    ``sampler_owners`` says by the sampler of which texture each texture is read.
    """
    return _Naming(program, language).names(sampler_owners)


_INDEX = re.compile(r"[0-9]*$")


def _semantics(language: Language, attributes: Iterable[Field]) -> dict[str, str]:
    """The semantic of each attribute; the later of two that would be equal names its location.

    Direct3D ignores case, and takes a missing index as 0: ``a`` and ``A0`` are the same for it.
    """
    found: dict[str, str] = {}
    taken: set[tuple[str, int]] = set()
    for field in attributes:
        semantic = language.semantic("attribute", field.name, field.location)
        stem, index = _INDEX.sub("", semantic).upper(), _INDEX.search(semantic)
        key = stem, int(index[0] or 0) if index else 0
        is_taken = bool(semantic) and key in taken
        found[field.name] = f"{semantic}_AT{field.location}_" if is_taken else semantic
        taken.add(key)
    return found


class _Naming:
    """Declares names in the order of the file."""

    def __init__(self, program: Program, language: Language) -> None:
        self._program = program
        self._language = language
        self._reserved = taken_words(language)
        self._module = Namer(self._reserved, (*language.fixed_names, *self._supplied_parameters()))

    def names(self, sampler_owners: Mapping[str, str]) -> Names:
        """Decide all names. Those that hosts see are declared first."""
        program = self._program
        blocks = {block.name: self._declare(block.name) for block in program.blocks}
        variables = self._variables(blocks)
        members = dict(self._members())
        structs = {name: self._declare(name) for name in self._structs()}
        buffers = {buffer.name: self._declare(buffer.name) for buffer in program.buffers}
        buffer_blocks = {
            name: self._declare(f"{final[:1].upper()}{final[1:]}Buffer")
            for name, final in (buffers if self._language.buffer_blocks else {}).items()
        }
        images = {image.name: self._declare(image.name) for image in program.images}
        textures = {item.name: self._declare(item.name) for item in program.textures}
        own_samplers = {
            name: self._declare(f"{textures[name]}_sampler")
            for name, owner in sampler_owners.items()
            if name == owner
        }
        fields = self._fields()
        return Names(
            blocks=blocks,
            variables=variables,
            members=members,
            structs=structs,
            buffers=buffers,
            buffer_blocks=buffer_blocks,
            images=images,
            textures=textures,
            samplers={name: own_samplers[owner] for name, owner in sampler_owners.items()},
            attributes=fields.attributes,
            semantics=_semantics(self._language, program.vertex_inputs),
            varyings=fields.varyings,
            points=fields.points,
            render_targets=fields.render_targets,
            functions=self._functions(fields),
            common=self._module,
        )

    def _supplied_parameters(self) -> Iterator[str]:
        """The pipeline's values that are parameters of an entry point, as resources may be, too."""
        for stage in self._program.stages:
            for supplied in stage.row.inputs:
                row = self._language.inputs.get(supplied.name)
                if row is not None and row.read == "{name}":
                    yield supplied.name

    def _declare(self, wanted: str) -> str:
        return self._module.declare(wanted)

    def _variables(self, blocks: Mapping[str, str]) -> dict[str, str]:
        if self._language.global_members:
            return {}
        return {name: self._declare(snake(final)) for name, final in blocks.items()}

    def _members(self) -> Iterator[tuple[tuple[str, str], str]]:
        for block in self._program.blocks:
            scope = Namer(self._reserved)
            declare = self._declare if self._language.global_members else scope.declare
            for member in block.members:
                yield (block.name, member.name), self._of_host(member.name) or declare(member.name)
        for struct in self._program.structs:
            scope = Namer(self._reserved)
            for name, _type in struct.members:
                yield (struct.name, name), scope.declare(name)

    def _of_host(self, name: str) -> str:
        """The name that a host has for a value; empty if it has none."""
        found = self._language.host_names.get(name, "")
        if found:
            self._module.take(found)
        return found

    def _structs(self) -> Iterable[str]:
        return dict.fromkeys(struct.name for struct in self._program.structs)

    def _fields(self) -> _Fields:
        """Names of inputs and outputs, which are global variables or members of structs."""
        language, program = self._language, self._program
        shared = self._module.inner() if language.global_fields else None
        supplied = [name for stage in program.stages for name in stage.builtin_inputs]
        taken = () if shared else supplied

        def declare(fields: Iterable[Field], prefix: str = "") -> dict[str, str]:
            namer = shared or Namer(self._reserved, (*taken, *language.fixed_names))
            names = dict.fromkeys(field.name for field in fields)
            return {name: namer.declare(prefix + name) for name in names}

        attributes = {
            name: self._of_host(name) or given
            for name, given in declare(program.vertex_inputs).items()
        }
        outputs = [output for stage in program.stages for output in stage.results]
        written = [out.field for out in outputs if out.field and out.kind == TARGET]
        delivered = [out.field for out in outputs if out.field and out.kind != TARGET]
        handed_on = [field for stage in program.stages for field in stage.handed_on]
        return _Fields(
            attributes=attributes,
            varyings=declare(delivered, language.varying_prefix),
            points=declare(handed_on, language.point_prefix),
            render_targets=declare(written, language.output_prefix),
        )

    def _functions(self, fields: _Fields) -> dict[tuple[StageName, Node], str]:
        taken = (
            *fields.attributes.values(),
            *fields.varyings.values(),
            *fields.points.values(),
            *fields.render_targets.values(),
        )
        namer = self._module.inner(taken)
        found: dict[tuple[StageName, Node], str] = {}
        for stage, function in _all_functions(self._program):
            name = namer.declare(function.name)
            found[stage.name, function.body] = name
            self._module.take(name)
        return found


@frozen
class _Fields:
    """The names of stage inputs and outputs."""

    attributes: dict[str, str]
    varyings: dict[str, str]
    points: dict[str, str]
    render_targets: dict[str, str]


def _all_functions(program: Program) -> Iterator[tuple[Stage, Function]]:
    for stage in program.stages:
        for function in stage.functions:
            yield stage, function


@lru_cache(maxsize=1024)
def snake(name: str) -> str:
    """A name in small letters, with underscores between its words."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
