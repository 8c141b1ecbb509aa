"""Exports the materials of a file as a document, and tells what MaterialX cannot say of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from ...compiler.ir.leaves import Texture
from ...compiler.ir.shader import Shader
from ...compiler.semantics.inheritance.records import Definition as Declared
from ...compiler.semantics.shading.assembly import Setting
from ...compiler.semantics.state.scope import OUTERMOST
from ...compiler.syntax import ast
from ..library import library
from ..values import numbers_of
from .images import picture_of
from .meanings import Meanings, Surface
from .nodes import Nodes, write
from .own import OwnDefinitions, link
from .surfaces import Root, root_of, turned
from .unsayable import UnsaidError, UnsayableError
from .values import Constant, Linked, Picture, Value

VERSION = "1.39"


class Exported(NamedTuple):
    """A document as a text, and the materials that are in it."""

    text: str
    materials: Sequence[str]


def exported(
    materials: Sequence[tuple[Setting, Shader]], file_of: Callable[[str, ast.Texture], str]
) -> Exported:
    """Write materials, which have been checked, to one document.

    ``file_of`` gives the file of a material's texture. Raises ``UnsaidError`` with all that has no
    meaning in MaterialX.
    """
    import MaterialX

    document = MaterialX.createDocument()
    document.setVersionString(VERSION)
    own = OwnDefinitions(document)
    told: list[UnsayableError] = []
    for setting, shader in materials:
        told += _Material(document, own, setting, shader, file_of).written()
    if told:
        raise UnsaidError(told)
    document.setDataLibrary(library())
    is_valid, reason = document.validate()
    assert is_valid, reason
    return Exported(
        MaterialX.writeToXmlString(document),
        [setting.surface.record.name for setting, _shader in materials],
    )


class _Material:
    """One material while it is written."""

    def __init__(
        self,
        document: Any,
        own: OwnDefinitions,
        setting: Setting,
        shader: Shader,
        file_of: Callable[[str, ast.Texture], str],
    ) -> None:
        self._document, self._own, self._setting = document, own, setting
        self._record = setting.surface.record
        self._colors = {
            info.leaf.name for info in shader.textures
            if info.intent == "color" and isinstance(info.leaf, Texture)
        }  # fmt: skip
        self._file_of = file_of
        self._told: list[UnsayableError] = []

    def written(self) -> list[UnsayableError]:
        """Write the material; gives what cannot be said."""
        root = root_of(self._record.chain)
        if root is None:
            declaration = self._record.symbol.declaration
            assert isinstance(declaration, ast.Record)
            return [
                UnsayableError(
                    f"`{self._record.name}` extends no surface of MaterialX",
                    "extend a model of std.models or one that `burnish import` writes; "
                    "or write its graph as JSON: `--format json`",
                    declaration.name.span,
                )
            ]
        self._check(root)
        name = self._document.createValidChildName(self._record.name)
        graph = self._document.addNodeGraph(f"NG_{name}" if root.definition is not None else name)
        nodes = Nodes(graph)
        try:
            surface = Surface(self._setting.surface, self._pictures(), self._own)
        except UnsayableError as error:
            return [*self._told, error]
        meanings = Meanings(surface, nodes)
        if root.definition is None:
            self._shown(meanings, nodes)
        else:
            self._extended(root, name, meanings, nodes)
        nodes.prune()
        if not graph.getOutputs():
            self._document.removeChild(graph.getName())
        return self._told

    def _pictures(self) -> Mapping[str, Picture]:
        found = {}
        for name, definitions in self._record.definitions.items():
            member = definitions[0].member
            if isinstance(member, ast.Texture) and not definitions[0].owner.module.is_standard:
                file = self._file_of(self._record.name, member)
                found[name] = picture_of(member, file, name in self._colors)
        return found

    def _check(self, root: Root) -> None:
        """Tell of members that no document has."""
        for statement in self._record.statements:
            if statement.level < root.level:
                self._tell(UnsayableError(
                    "MaterialX has surfaces only: no pixels are dropped and no triangles are made",
                    "leave it out", statement.member.span,
                ))  # fmt: skip
        for name, definition in self._own_slots(root):
            above = self._record.above(name, root.level - 1)
            known = name in root.slots or name == "anisotropy_direction"
            if above is not None and not known and not self._is_shown(root, name):
                self._tell(UnsayableError(
                    f"`{name}` is computed by `{above.owner.name}`, and is no input of "
                    f"`{root.definition.category if root.definition else 'a surface'}`",
                    "set inputs of the model", definition.member.name.span,
                ))  # fmt: skip

    def _is_shown(self, root: Root, name: str) -> bool:
        return root.definition is None and name in ("color", "alpha")

    def _own_slots(self, root: Root) -> Iterator[tuple[str, Declared]]:
        """The slots that the material sets itself, or a base of its own."""
        for name, definitions in self._record.definitions.items():
            if definitions[0].level < root.level and isinstance(definitions[0].member, ast.Slot):
                yield name, definitions[0]

    def _extended(self, root: Root, name: str, meanings: Meanings, nodes: Nodes) -> None:
        """A surface with the inputs that the material sets."""
        definition = root.definition
        assert definition is not None
        doc = self._record.symbol.declaration.doc
        shader = self._document.addNode(
            definition.category, self._document.createValidChildName(f"SR_{name}"), "surfaceshader"
        )
        if definition.hints.get("version"):
            shader.setVersionString(definition.hints["version"])
        for slot, input_name, value in self._inputs(root, meanings, nodes):
            kind = definition.inputs[input_name].type
            if isinstance(value, Constant):
                write(shader, input_name, nodes.converted(value, kind))
            else:
                output = nodes.element.addOutput(
                    nodes.element.createValidChildName(f"{slot}_out"), kind
                )
                link(nodes, output, value, kind)
                found = shader.addInput(input_name, kind)
                found.setAttribute("nodegraph", nodes.element.getName())
                found.setOutputString(output.getName())
        material = self._document.addNode("surfacematerial", name, "material")
        if doc:
            material.setAttribute("doc", " ".join(doc.split()))
        material.addInput("surfaceshader", "surfaceshader").setNodeName(shader.getName())

    def _inputs(
        self, root: Root, meanings: Meanings, nodes: Nodes
    ) -> Iterator[tuple[str, str, Value]]:
        """The slots that the surface gets, with the inputs that they are, and their values."""
        own = dict(self._own_slots(root))
        assert root.definition is not None
        for slot, definitions in sorted(self._record.definitions.items(), key=_place):
            member = definitions[0].member
            if slot not in own and not (root.is_standard and slot in root.slots):
                continue
            input_name = root.slots.get(slot, "")
            if not input_name and slot != "anisotropy_direction":
                continue
            try:
                kind = root.definition.inputs[input_name].type if input_name else "vector2"
                value = meanings.slot(slot, wanted=kind)
                if not input_name:
                    found = turned(nodes, slot, value)
                    assert found is not None
                    input_name, value = found
                    kind = "float"
                value = nodes.converted(value, kind)
                if slot in own or _differs(root, input_name, value):
                    yield slot, input_name, value
            except UnsayableError as error:
                if slot in own:
                    error.span = error.span or member.span
                    self._tell(error, slot)

    def _shown(self, meanings: Meanings, nodes: Nodes) -> None:
        """The colour that a material shows, as the output of a graph."""
        slot = "color"
        try:
            shown = meanings.slot(slot)
            if self._record.at("alpha", OUTERMOST).level == 0:
                slot = "alpha"
                shown = _with_alpha(nodes, shown, meanings.slot(slot))
            kind = type_of(shown)
            link(nodes, nodes.element.addOutput("out", kind), shown, kind)
        except UnsayableError as error:
            self._tell(error, slot)

    def _tell(self, error: UnsayableError, slot: str = "") -> None:
        error.slot = error.slot or slot
        self._told.append(error)


def _place(row: tuple[str, tuple[Declared, ...]]) -> tuple[int, int]:
    """Bases first, and otherwise the order of the text."""
    first = row[1][0]
    return -first.level, first.member.span.start


def _differs(root: Root, name: str, value: Value) -> bool:
    """True if a slot that the material leaves alone has another default than the input."""
    assert root.definition is not None
    port = root.definition.inputs[name]
    if not isinstance(value, Constant):
        return False
    if port.value is None:
        return False
    if value.type == "boolean":
        return value.text != port.value
    return list(value.numbers) != numbers_of(port.value)


def _with_alpha(nodes: Nodes, color: Value, alpha: Value) -> Value:
    """A colour with its coverage; both may be lanes of one value."""
    whole = nodes.whole(color, alpha)
    if whole is not None:
        return whole
    return nodes.node("combine2", {"in1": color, "in2": alpha}, "color4", must=True)


def type_of(value: Value) -> str:
    """The type of what is shown."""
    if isinstance(value, Constant | Linked):
        return "color3" if value.type == "vector3" and isinstance(value, Constant) else value.type
    raise UnsayableError("this is no colour")

