"""Functions of a material's author as definitions of the document, or written out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Protocol

from ...compiler.semantics.equations.reads import Where
from ...compiler.semantics.names.modules import Symbol
from ...compiler.syntax import ast
from ..known import categories
from .expressions import At, Expressions, Later
from .nodes import Nodes, several, write
from .unsayable import ReadsMaterialError, UnsayableError
from .values import SAME_LANES, Constant, Linked, Several, Value, lanes_of, retyped, type_named


class Caller(Protocol):
    """The meanings of names where functions are called, and inside them."""

    expressions: Expressions

    def within(self, nodes: Nodes) -> Caller:
        """The meanings in the body of a function, which has a graph of its own."""


class OwnDefinition:
    """A definition that was written: its category, the types of its inputs and of its outputs."""

    def __init__(
        self, category: str, inputs: Mapping[str, str], outputs: Mapping[str, str]
    ) -> None:
        self.category, self.inputs, self.outputs = category, inputs, outputs


class OwnDefinitions:
    """The definitions of one document, each written once for all types that it is used with."""

    def __init__(self, document: Any) -> None:
        self._document = document
        self._made: dict[tuple[object, ...], OwnDefinition | None] = {}

    def applied(
        self, outer: Caller, symbol: Symbol, given: Mapping[str, Value], at: At, wanted: str
    ) -> Value:
        """The value of a call: a node of a definition, or the function written out."""
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        kinds = {
            argument.name.text: _kind(function, argument, given.get(argument.name.text), wanted)
            for argument in function.arguments
        }
        key = (symbol, tuple(kinds.items()), tuple(given), wanted)
        if key not in self._made:
            self._made[key] = self._defined(outer, symbol, kinds, at, wanted)
        found = self._made[key]
        if found is None:
            return self._written_out(outer, symbol, given, at, wanted)
        nodes = outer.expressions.nodes
        inputs = {name: nodes.converted(value, kinds[name]) for name, value in given.items()}
        if len(found.outputs) == 1:
            (kind,) = found.outputs.values()
            return nodes.plain(found.category, kind, inputs)
        return several(nodes.plain(found.category, "multioutput", inputs), found.outputs)

    def _written_out(
        self, outer: Caller, symbol: Symbol, given: Mapping[str, Value], at: At, wanted: str
    ) -> Value:
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        inside = _inside(at, symbol)
        own: dict[str, Value | Later] = {}
        for argument in function.arguments:
            name = argument.name.text
            if name in given:
                own[name] = _argument(given[name], argument.type)
            elif argument.default is not None:
                own[name] = outer.expressions.value(
                    argument.default, replace(inside, own=dict(own))
                )
        return outer.expressions.body(function, inside, own, wanted)

    def _defined(
        self, outer: Caller, symbol: Symbol, kinds: Mapping[str, str], at: At, wanted: str
    ) -> OwnDefinition | None:
        """A new definition; nothing if the function has to be written out."""
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        if not all(kinds.values()):
            return None
        graph = self._document.addNodeGraph(
            self._document.createValidChildName(f"NG_{symbol.name}")
        )
        try:
            return self._written(outer, symbol, kinds, at, wanted, graph)
        except (ReadsMaterialError, UnsayableError) as error:
            self._document.removeChild(graph.getName())
            if isinstance(error, UnsayableError):
                raise
            return None

    def _written(
        self, outer: Caller, symbol: Symbol, kinds: Mapping[str, str], at: At, wanted: str,
        graph: Any,
    ) -> OwnDefinition | None:  # fmt: skip
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        inner = outer.within(Nodes(graph))
        own: dict[str, Value | Later] = {
            name: Linked(kind, interface=name) for name, kind in kinds.items()
        }
        inside = _inside(at, symbol)
        value = inner.expressions.body(function, inside, own, wanted)
        members = value.members if isinstance(value, Several) else {"out": value}
        outputs: dict[str, str] = {}
        for name, member in members.items():
            if not isinstance(member, Constant | Linked):
                raise ReadsMaterialError
            kind = wanted if SAME_LANES.get(wanted) == member.type else member.type
            if isinstance(member, Constant) and kind == "integer" and member.is_whole:
                kind = "float"
            link(inner.expressions.nodes, graph.addOutput(name, kind), member, kind)
            outputs[name] = kind
        self._declare(function, inner, inside, kinds, outputs, graph)
        return OwnDefinition(_category(symbol.name), kinds, outputs)

    def _declare(
        self, function: ast.Function, inner: Caller, inside: At, kinds: Mapping[str, str],
        outputs: Mapping[str, str], graph: Any,
    ) -> None:  # fmt: skip
        document, category = self._document, _category(function.name.text)
        name = document.createValidChildName(graph.getName().replace("NG_", "ND_", 1))
        kind = "multioutput" if len(outputs) > 1 else next(iter(outputs.values()))
        definition = document.addNodeDef(name, kind, category)
        for argument in function.arguments:
            default = None
            if argument.default is not None:
                default = inner.expressions.value(argument.default, inside)
            own_kind = kinds[argument.name.text]
            value = retyped(default, own_kind) if isinstance(default, Constant) else None
            if value is None:
                definition.addInput(argument.name.text, own_kind)
            else:
                write(definition, argument.name.text, value)
        for output, own_kind in outputs.items():
            if definition.getOutput(output) is None:
                definition.addOutput(output, own_kind)
        doc = " ".join(function.doc.split())
        if doc:
            definition.setAttribute("doc", doc)
        graph.setAttribute("nodedef", name)


def link(nodes: Nodes, output: Any, value: Value, kind: str) -> None:
    """Let an output of a graph have a value, by a node."""
    found = nodes.converted(value, kind)
    if not isinstance(found, Linked) or found.interface:
        found = nodes.plain("constant", kind, {"value": found})
    output.setNodeName(found.node)
    if found.output:
        output.setOutputString(found.output)


def _argument(value: Value, written: ast.TypeName) -> Value:
    """A constant that is given has the type of its argument."""
    kind = type_named(written)
    found = retyped(value, kind) if isinstance(value, Constant) and kind else None
    same = isinstance(value, Constant) and SAME_LANES.get(value.type) == kind
    return value if found is None or same else found


def _inside(at: At, symbol: Symbol) -> At:
    return replace(at, where=Where(symbol.module, at.where.surface), own={})


def _kind(function: ast.Function, argument: ast.Argument, value: Value | None, wanted: str) -> str:
    """The type of an input: as it is declared, or a colour where one is given or wanted."""
    kind = type_named(argument.type)
    if isinstance(value, Several) or (
        value is not None and not isinstance(value, Constant | Linked)
    ):
        return ""
    is_generic = argument.type.name.text in {each.name.text for each in function.type_parameters}
    if is_generic and value is not None:
        kind = "float" if value.type == "integer" else value.type
    if kind not in SAME_LANES:
        return kind
    if value is None:
        return wanted if wanted == SAME_LANES[kind] else kind
    if isinstance(value, Constant) and len(value.numbers) == 1:
        return kind
    if isinstance(value, Constant) and wanted == SAME_LANES[kind]:
        return wanted
    return value.type if lanes_of(value.type) == lanes_of(kind) else kind


def _category(name: str) -> str:
    """The category of an own definition, which is none of the library's."""
    return f"own_{name}" if name in categories() else name
