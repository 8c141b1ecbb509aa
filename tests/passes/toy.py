"""Shaders made by hand, of stages that the language need not have."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.shader import AttributeInfo, Notes, ParameterInfo, Result, Shader
from burnish.compiler.ir.stages import StageRow
from burnish.compiler.ir.types import Type

HERE = Span(Source("toy.burnish", ""), 0, 0)


class Toy:
    """The leaves and notes of a shader that is made by hand."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.notes = Notes()
        self.attributes: list[AttributeInfo] = []
        self.parameters: list[ParameterInfo] = []

    def attribute(self, name: str, type_: Type) -> Node:
        leaf = Attribute(name, type_)
        self.attributes.append(AttributeInfo(leaf, str(type_), "", HERE))
        return self.graph.node("attribute", type_, (), leaf)

    def parameter(self, name: str, type_: Type) -> Node:
        leaf = Parameter(name, type_, "material")
        self.parameters.append(ParameterInfo(leaf, str(type_), "", HERE))
        return self.graph.node("parameter", type_, (), leaf)

    def call(self, name: str, type_: Type, *operands: Node) -> Node:
        return self.graph.node("call", type_, operands, name)

    def named(self, name: str, value: Node) -> Node:
        self.notes.names[value.id] = name
        return value

    def shader(self, results: Sequence[Result], *chain: StageRow, **more: Any) -> Shader:
        return Shader(
            name="Toy", doc="", pass_name="P", rig_name="R", graph=self.graph, notes=self.notes,
            parameters=tuple(self.parameters), textures=(), attributes=tuple(self.attributes),
            results=tuple(results), chain=chain, **more,
        )  # fmt: skip
