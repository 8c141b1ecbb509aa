"""Prints functions that an engine calls: ``compiling_functions.py`` calls ``emit_functions``.

The text has no entry points and binds nothing. What a function needs from outside is an argument:
values of the surface, parameters, textures with their samplers. ``emitter.py`` prints whole
shaders; the statements in between are printed by the same modules.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Literal

from ...compiler.ir.leaves import Argument
from ...compiler.ir.node import Node, bare
from ...compiler.ir.program import Function, Stage, StageName
from ...compiler.ir.types import Type
from ...support.frozen import frozen
from ..legalise.legal import Legal
from ..legalise.resource_arguments import Passed
from .comments import comment_line, comment_lines
from .context import Context
from .declarations import Declarations
from .expressions import Expressions
from .function_names import FunctionNames, name_functions, slots_of
from .group_functions import GroupFunctions
from .leaves import LeafPrinter
from .natives import EmittedFunction, Natives
from .origins import Marks
from .statements import Statements
from .templates import FUNCTIONS, renderer
from .texture_declarations import helpers, opening_lines
from .views import FunctionFileView, PartView
from .wrapping import wrapped

_WORD = re.compile(r"[A-Za-z_]\w*")


@frozen
class EmittedPart:
    """A structure or a function of a text, which an engine can also take by itself."""

    name: str
    text: str
    needs: tuple[str, ...]
    """The other parts that it names, and those that these need: each behind what it needs."""


@frozen
class EmittedArgument:
    """An argument in a text."""

    name: str
    type: str
    given: str
    """The argument or the texture by its name in the program."""
    kind: Literal["value", "texture", "sampler"]
    """What it is; a texture with its sampler in one is a texture."""


@frozen
class EmittedSignature:
    """How a function is called in a text."""

    name: StageName
    """Its name in the program."""
    part: EmittedPart
    arguments: tuple[EmittedArgument, ...]
    returns: str
    """The type of what it returns."""
    members: tuple[str, ...]
    """The members of the structure that it returns, in the order of its slots; else none."""
    handed_on: str | None = None
    """The argument, by its name in the program, that it returns as it is; ``None`` for others."""


@frozen
class FunctionEmission:
    """The text of all functions for one profile, and its parts."""

    text: str
    requires: tuple[str, ...]
    """Directives that have to stand at the beginning of the engine's own text."""
    helpers: tuple[EmittedPart, ...]
    """Structures and functions that the others need, in the order of the text."""
    functions: tuple[EmittedSignature, ...]


def emit_functions(legal: Legal, docs: dict[str, str], prefix: str) -> FunctionEmission:
    """Print the functions of a program; ``docs`` are the doc comments of slots, by name."""
    return _FunctionEmitter(legal, docs, prefix).emission()


class _FunctionEmitter:
    def __init__(self, legal: Legal, docs: dict[str, str], prefix: str) -> None:
        self._program, self._language = legal.program, legal.language
        self._named = name_functions(
            legal.program, legal.language, legal.bindings.sampler_owners, prefix
        )
        self._docs = docs
        self._context = Context(legal, self._named.names, False)
        self._declarations = Declarations(self._context, legal.bindings)
        self._marks = Marks(legal.language.forms)

    def emission(self) -> FunctionEmission:
        """The text and its parts."""
        printers = [
            _FunctionPrinter(self._context, self._declarations, self._named, stage, self._docs)
            for stage in self._program.stages
        ]
        found: dict[str, tuple[str, ...]] = dict(self._structs())
        found |= self._language_helpers()
        for printer in printers:
            found |= printer.helpers(found)
        own = {printer.name: printer.function() for printer in printers}
        parts = _parts({**found, **own})
        signatures = [printer.signature(parts[printer.name]) for printer in printers]
        header = self._header()
        view = FunctionFileView(
            header, [PartView(lines) for lines in (*found.values(), *own.values())]
        )
        text, _ = wrapped(
            renderer(FUNCTIONS)(view, self._language.forms, self._context.profile, False)
        )
        return FunctionEmission(
            text, self._requires(), tuple(parts[name] for name in found), tuple(signatures)
        )

    def _header(self) -> list[str]:
        shader = self._program.shader
        title = comment_line(f"{shader.name}: functions, by Burnish.", "//")
        needed = [comment_line(f"The file needs: {line}", "//") for line in self._requires()]
        return [title, *comment_lines(shader.doc, "//"), *needed]

    def _requires(self) -> tuple[str, ...]:
        natives = [native for stage in self._program.stages for native in stage.natives]
        reads = [read for stage in self._program.stages for read in stage.reads]
        profile = self._context.profile
        lines = opening_lines(profile, self._context.textures, natives, reads, ())
        return tuple(line for line in lines if line not in profile.defaults)

    def _structs(self) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The structures of arguments, and of what functions of several slots return."""
        names, types = self._named.names, self._context.types
        for struct in self._program.structs:
            members = (types.declare(names.member(struct.name, n), t) for n, t in struct.members)
            yield self._struct(names.structs[struct.name], members)
        for stage in self._program.stages:
            if stage.name in self._named.results:
                values = zip(slots_of(stage), stage.roots, strict=True)
                typed = (
                    types.declare(self._named.members[stage.name, name], value.type)
                    for name, value in values
                )
                yield self._struct(self._named.results[stage.name], typed)

    def _struct(self, name: str, members: Iterable[str]) -> tuple[str, tuple[str, ...]]:
        forms = self._language.forms
        lines = (f"    {member}{forms.member_end}" for member in members)
        return name, (f"struct {name} {{", *lines, forms.struct_end)

    def _language_helpers(self) -> dict[str, tuple[str, ...]]:
        """The helper functions of the language that reads call, under names of this text."""
        reads = [read for stage in self._program.stages for read in stage.reads]
        texts = helpers(self._language, self._context.textures, reads)
        found: dict[str, tuple[str, ...]] = {}
        for text in texts:
            name = next(word for word in _WORD.findall(text) if word in self._named.helpers)
            lines = tuple(_renamed(text, self._named).split("\n"))
            known = found.get(self._named.helpers[name], ())
            found[self._named.helpers[name]] = (*known, *lines)
        return found


def _renamed(text: str, named: FunctionNames) -> str:
    """A text that calls helper functions of the language by their names in this text."""
    return _WORD.sub(lambda word: named.helpers.get(word[0], word[0]), text)


def _parts(found: dict[str, tuple[str, ...]]) -> dict[str, EmittedPart]:
    """The parts of a text by name; each needs only parts before it."""
    made: dict[str, EmittedPart] = {}
    for name, lines in found.items():
        code = "\n".join(line for line in lines if not line.lstrip().startswith("//"))
        words = set(_WORD.findall(code)) & made.keys()
        needed = {inner for word in words for inner in (*made[word].needs, word)}
        text, _ = wrapped("\n".join(lines))
        made[name] = EmittedPart(name, text, tuple(each for each in made if each in needed))
    return made


class _FunctionPrinter:
    """Prints one function that an engine calls, and those that it calls itself."""

    def __init__(
        self,
        context: Context,
        declarations: Declarations,
        named: FunctionNames,
        stage: Stage,
        docs: dict[str, str],
    ) -> None:
        self._context, self._declarations = context, declarations
        self._named, self._stage, self._docs = named, stage, docs
        self._forms, self._types = context.language.forms, context.types
        self._marks = Marks(context.language.forms)
        self._leaves = LeafPrinter(context, stage)
        self._functions = {
            function.body: EmittedFunction(
                named.names.function(stage.name, function.body),
                declarations.arguments(context.passed(stage.name, function.body)),
            )
            for function in stage.functions
        }
        groups = GroupFunctions(context, stage, self._marks)
        self._natives = Natives(context, self._leaves, self._functions, groups)
        self.name = named.entries[stage.name]

    # --- functions that it calls -----------------------------------------------------------------

    def helpers(self, known: dict[str, tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        """The functions that it calls, but for those that other functions call as well."""
        return {
            self._functions[function.body].name: self._helper(function)
            for function in self._stage.functions
            if self._functions[function.body].name not in known
        }

    def _helper(self, function: Function) -> tuple[str, ...]:
        passed = self._context.passed(self._stage.name, function.body)
        namer = self._named.names.locals(self._declarations.arguments(passed))
        expressions = self._expressions()
        names = [namer.declare(formal.name) for formal, _type in function.parameters]
        for name, (formal, _type) in zip(names, function.parameters, strict=True):
            expressions.formals[formal] = name
        statements = Statements(self._context, expressions, namer, _unmarked)
        own = [
            self._forms.parameter.format(typed=self._types.declare(name, type_))
            for name, (_formal, type_) in zip(names, function.parameters, strict=True)
        ]
        head = self._forms.function.format(
            type=self._types.type(function.value.type),
            name=self._functions[function.body].name,
            parameters=", ".join([*self._declarations.parameters(passed), *own]),
        )
        lines = statements.lines(function.region)
        returned = self._forms.return_.format(value=expressions.text(function.value))
        return self._text(comment_lines(function.doc), head, [*lines, returned])

    # --- the function itself ---------------------------------------------------------------------

    def function(self) -> tuple[str, ...]:
        """The function as lines."""
        own = [argument.name for argument in self._arguments()]
        namer = self._named.names.locals(own)
        expressions = self._expressions()
        statements = Statements(self._context, expressions, namer, _unmarked)
        lines = statements.lines(self._stage.region)
        typed = [
            self._types.declare(self._named.names.arguments[info.leaf], info.leaf.type)
            for info in self._stage.arguments
        ]
        head = self._forms.function.format(
            type=self._returned(),
            name=self.name,
            parameters=", ".join([
                *(self._forms.parameter.format(typed=each) for each in typed),
                *self._declarations.parameters(self._passed()),
            ]),
        )  # fmt: skip
        lines += self._return(expressions, namer.declare("result"))
        return self._text(self._comments(), head, lines)

    def signature(self, part: EmittedPart) -> EmittedSignature:
        """How the function is called."""
        members: tuple[str, ...] = ()
        if self._stage.name in self._named.results:
            members = tuple(
                self._named.members[self._stage.name, slot] for slot in slots_of(self._stage)
            )
        return EmittedSignature(
            self._stage.name, part, tuple(self._arguments()), self._returned(), members,
            self._handed_on(),
        )  # fmt: skip

    def _handed_on(self) -> str | None:
        """The argument that the function returns, if it computes nothing."""
        first, *others = self._stage.roots
        leaf = bare(first).data
        return leaf.name if isinstance(leaf, Argument) and not others else None

    def _arguments(self) -> Iterator[EmittedArgument]:
        names = self._named.names
        for info in self._stage.arguments:
            type_ = self._type(info.leaf.type)
            yield EmittedArgument(names.arguments[info.leaf], type_, info.leaf.name, "value")
        owners = {name: texture for texture, name in names.samplers.items()}
        owners |= {name: texture for texture, name in names.textures.items()}
        for view in self._declarations.textures((self._stage,)):
            kind: Literal["texture", "sampler"] = (
                "texture" if view.name in names.textures.values() else "sampler"
            )
            yield EmittedArgument(view.name, view.type, owners[view.name], kind)

    def _type(self, type_: Type) -> str:
        """The type of an argument as a text has it where nothing is declared."""
        return self._types.declare("", type_).strip().strip(":").strip()

    def _passed(self) -> Passed:
        return Passed(textures=tuple(texture.name for texture in self._stage.textures))

    def _returned(self) -> str:
        struct = self._named.results.get(self._stage.name)
        return struct or self._types.type(self._stage.roots[0].type)

    def _return(self, expressions: Expressions, name: str) -> list[str]:
        """The last statements: of several slots, the members of a structure are assigned."""
        struct = self._named.results.get(self._stage.name)
        values = [expressions.text(output.value) for output in self._stage.results]
        if struct is None:
            return [self._forms.return_.format(value=values[0])]
        declared = self._context.language.types.declaration.format(type=struct, name=name)
        members = (self._named.members[self._stage.name, slot] for slot in slots_of(self._stage))
        return [
            self._forms.variable.format(typed=declared),
            *(
                self._forms.assign.format(name=f"{name}.{member}", value=value)
                for member, value in zip(members, values, strict=True)
            ),
            self._forms.return_.format(value=name),
        ]

    def _comments(self) -> list[str]:
        """The doc comments of the slots, and of the arguments."""
        slots = slots_of(self._stage)
        lines: list[str] = []
        for slot in slots:
            doc = self._docs.get(slot, "")
            lines += comment_lines(doc if len(slots) == 1 or not doc else f"{slot}: {doc}")
        names = self._named.names
        told = [(names.arguments[info.leaf], info.doc) for info in self._stage.arguments]
        infos = {info.leaf.name: info for info in self._context.program.shader.textures}
        told += [
            (names.textures[texture.name], infos[texture.name].doc)
            for texture in self._stage.textures
        ]
        return lines + [comment_line(f"{name}: {doc}", "///") for name, doc in told if doc]

    # --- both ------------------------------------------------------------------------------------

    def _expressions(self) -> Expressions:
        return Expressions(self._context, self._leaves, self._natives, self._functions)

    def _text(self, comments: Iterable[str], head: str, lines: Iterable[str]) -> tuple[str, ...]:
        found = (*comments, head, *(f"    {line}" for line in lines), self._forms.end)
        return tuple(_renamed(line, self._named) for line in found)


def _unmarked(text: str, _node: Node) -> str:
    """A statement without a mark: the text has no source map."""
    return text
