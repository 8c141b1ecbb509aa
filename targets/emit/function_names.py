"""The final names of functions that an engine calls, and of all that they need.

Everything that a text declares begins with a name of its own, such as that of the material. So one
file of an engine can have the functions of several materials.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from ...compiler.ir.node import Node
from ...compiler.ir.program import Program, Stage, StageName
from ...support.frozen import frozen
from ..description.shading_language import Language
from .namer import Namer
from .names import Names, snake
from .own_words import taken_words


@frozen
class FunctionNames:
    """The final names of a text of functions."""

    names: Names
    entries: Mapping[StageName, str]
    """The functions that an engine calls."""
    results: Mapping[StageName, str]
    """The structures that functions of several slots return."""
    members: Mapping[tuple[StageName, str], str]
    """The members of these, by function and slot."""
    helpers: Mapping[str, str]
    """The helper functions of the language, by the names that it gives them."""


def name_functions(
    program: Program, language: Language, sampler_owners: Mapping[str, str], prefix: str
) -> FunctionNames:
    """Decide all names; those of functions begin with ``prefix`` in small letters."""
    module = Namer(taken_words(language), language.fixed_names)
    small, large = snake(prefix), _capitals(prefix)

    def declared(name: str) -> str:
        return module.declare(f"{small}_{name}")

    entries = {stage.name: declared(stage.name) for stage in program.stages}
    results = {
        stage.name: module.declare(f"{large}{_capitals(stage.name)}")
        for stage in program.stages
        if len(stage.results) > 1
    }
    structs = {s.name: module.declare(f"{large}{_capitals(s.name)}") for s in program.structs}
    helpers = {name: declared(name) for name in language.helpers}
    functions = dict(_functions(program, declared))
    arguments = module.inner()
    leaves = dict.fromkeys(info.leaf for stage in program.stages for info in stage.arguments)
    named = {leaf: arguments.declare(leaf.name) for leaf in leaves}
    textures = {texture.name: arguments.declare(texture.name) for texture in program.textures}
    samplers = {
        name: arguments.declare(f"{textures[name]}_sampler")
        for name, owner in sampler_owners.items()
        if name == owner
    }
    names = Names(
        blocks={}, variables={}, members=dict(_members(program, language)), structs=structs,
        buffers={}, buffer_blocks={}, images={}, textures=textures,
        samplers={name: samplers[owner] for name, owner in sampler_owners.items()},
        attributes={}, semantics={}, varyings={}, points={}, render_targets={},
        functions=functions, common=module, arguments=named,
    )  # fmt: skip
    return FunctionNames(names, entries, results, dict(_slots(program, language)), helpers)


def _capitals(name: str) -> str:
    """A name whose words begin with capitals, without underscores: ``PlasticSurface``."""
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


def _functions(
    program: Program, declared: Callable[[str], str]
) -> Iterator[tuple[tuple[StageName, Node], str]]:
    """The names of helper functions; two that call one body share it."""
    found: dict[Node, str] = {}
    for stage in program.stages:
        for function in stage.functions:
            if function.body not in found:
                found[function.body] = declared(function.name)
            yield (stage.name, function.body), found[function.body]


def _members(program: Program, language: Language) -> Iterator[tuple[tuple[str, str], str]]:
    for struct in program.structs:
        scope = Namer(taken_words(language))
        for name, _type in struct.members:
            yield (struct.name, name), scope.declare(name)


def _slots(program: Program, language: Language) -> Iterator[tuple[tuple[StageName, str], str]]:
    for stage in program.stages:
        scope = Namer(taken_words(language))
        for name in slots_of(stage):
            yield (stage.name, name), scope.declare(name)


def slots_of(stage: Stage) -> tuple[str, ...]:
    """The slots that a function returns."""
    return tuple(output.field.name for output in stage.results if output.field is not None)
