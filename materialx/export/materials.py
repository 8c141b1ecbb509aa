"""Writes a material to a document of MaterialX; ``exporting`` calls it for each one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ...compiler.ir.leaves import Texture
from ...compiler.ir.shader import Shader
from ...compiler.semantics.equations.reads import Where
from ...compiler.semantics.inheritance.records import Definition as Declared
from ...compiler.semantics.shading.assembly import Setting
from ...compiler.semantics.state.scope import OUTERMOST
from ...compiler.syntax import ast
from ..model import Definition
from ..values import numbers_of
from .closures import ASKED, LitColor, MixedColor, SurfaceColor, emission, surface_of
from .expressions import At, Later
from .images import picture_of
from .meanings import ExportedSurface, Meanings
from .nodes import Nodes, write
from .own import OwnDefinitions, link
from .surfaces import ALONG, TURNED, Root, root_of, turned
from .unsayable import UnsayableError
from .values import Constant, Linked, Picture, Value, vector

_NO_SURFACE = (
    "extend a model of std.models or one that `burnish import` writes; or write its graph as "
    "JSON: `--format json`"
)


class MaterialWriter:
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
        self._root = root_of(self._record.chain)
        self._lit = None if self._root is None or self._root.definition else self._closures()
        self._told: list[UnsayableError] = []

    @property
    def is_surface(self) -> bool:
        """True if it is a surface that is lit; all else is a colour."""
        return self._root is not None and bool(self._root.definition or self._lit)

    @property
    def has_alpha(self) -> bool:
        """True if the material says how far it covers."""
        return self._record.at("alpha", OUTERMOST).level == 0

    def written(self, beside_surfaces: bool) -> list[UnsayableError]:
        """Write the material; gives what cannot be said.

        Of a document with surfaces, nothing else is drawn: ``beside_surfaces``, a colour becomes a
        surface without light.
        """
        root = self._root
        if root is None:
            declaration = self._record.symbol.declaration
            assert isinstance(declaration, ast.Record)
            text = f"`{self._record.name}` extends no surface of MaterialX"
            return [UnsayableError(text, _NO_SURFACE, declaration.name.span)]
        self._check(root)
        is_shown = not self.is_surface and not beside_surfaces
        name = self._document.createValidChildName(self._record.name)
        graph = self._document.addNodeGraph(name if is_shown else f"NG_{name}")
        nodes = Nodes(graph)
        try:
            surface = ExportedSurface(self._setting.surface, self._pictures(), self._own)
        except UnsayableError as error:
            return [*self._told, error]
        meanings = Meanings(surface, nodes)
        if root.definition is not None:
            self._extended(root, root.definition, name, meanings, nodes)
        elif is_shown:
            self._shown(meanings, nodes)
        else:
            self._drawn(name, meanings, nodes)
        nodes.prune()
        nodes.ordered(
            name for name, definitions in sorted(self._record.definitions.items(), key=_place)
            if isinstance(definitions[0].member, ast.Param)
        )  # fmt: skip
        if not graph.getOutputs():
            self._document.removeChild(graph.getName())
        return self._told

    def _pictures(self) -> Mapping[str, Picture]:
        found = {}
        for name, definitions in self._record.definitions.items():
            member = definitions[0].member
            if isinstance(member, ast.Texture) and self._is_own(definitions[0]):
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
            known = name in root.slots or name == ALONG
            if above is not None and not known and not self._is_shown(root, name):
                self._tell(UnsayableError(
                    f"`{name}` is computed by `{above.owner.name}`, and is no input of "
                    f"`{root.definition.category if root.definition else 'a surface'}`",
                    "set inputs of the model", definition.member.name.span,
                ))  # fmt: skip

    def _is_own(self, definition: Declared) -> bool:
        """True for what stands before the model: the material's, of its bases and mixins."""
        return self._root is not None and definition.level < self._root.level

    def _is_shown(self, root: Root, name: str) -> bool:
        return root.definition is None and name in ("color", "alpha")

    def _own_slots(self, root: Root) -> Iterator[tuple[str, Declared]]:
        """The slots that the material sets itself, or a base of its own."""
        for name, definitions in self._record.definitions.items():
            if definitions[0].level < root.level and isinstance(definitions[0].member, ast.Slot):
                yield name, definitions[0]

    def _extended(
        self, root: Root, definition: Definition, name: str, meanings: Meanings, nodes: Nodes
    ) -> None:
        """A surface with the inputs that the material sets."""
        shader = self._document.addNode(
            definition.category, self._document.createValidChildName(f"SR_{name}"), "surfaceshader"
        )
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
        material = self._material(name)
        material.addInput("surfaceshader", "surfaceshader").setNodeName(shader.getName())

    def _material(self, name: str) -> Any:
        """The node of the material itself, with its comment."""
        made = self._document.addNode("surfacematerial", name, "material")
        declaration = self._record.symbol.declaration
        assert isinstance(declaration, ast.Record)
        if declaration.doc:
            made.setAttribute("doc", " ".join(declaration.doc.split()))
        return made

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
            if not input_name and slot != ALONG:
                continue
            try:
                kind = root.definition.inputs[input_name].type if input_name else "vector2"
                value = meanings.slot(slot, wanted=kind)
                if not input_name:
                    input_name, kind, value = TURNED, "float", turned(nodes, value)
                value = nodes.converted(value, kind)
                if slot in own or _differs(root, input_name, value):
                    yield slot, input_name, value
            except UnsayableError as error:
                if slot in own:
                    error.span = error.span or member.span
                    self._tell(error, slot)

    def _closures(self) -> LitColor | MixedColor | None:
        """The closures that the material's colour is made of; nothing if it is not."""
        member = self._record.at("color", OUTERMOST).member
        if not isinstance(member, ast.Slot) or member.value is None:
            return None
        return surface_of(member.value, self._where)

    @property
    def _where(self) -> Where:
        """The surroundings of the text of the material's colour."""
        owner = self._record.at("color", OUTERMOST).owner
        return Where(owner.module, self._setting.surface, self._setting.surface)

    def _drawn(self, name: str, meanings: Meanings, nodes: Nodes) -> None:
        """A surface of closures, or one without light."""
        try:
            if self._lit is not None:
                surface = self._surface(self._lit, meanings, nodes)
            else:
                surface = self._unlit(meanings, nodes)
        except UnsayableError as error:
            self._tell(error, "color")
            return
        graph = nodes.element
        link(nodes, graph.addOutput("out", "surfaceshader"), surface, "surfaceshader")
        shown = self._material(name).addInput("surfaceshader", "surfaceshader")
        shown.setAttribute("nodegraph", graph.getName())

    def _lit_surface(
        self, found: SurfaceColor, meanings: Meanings, nodes: Nodes
    ) -> tuple[Value, Value | None]:
        """The node of a surface, and its opacity if it has any."""
        expressions, at = meanings.expressions, At(self._where, {})
        if isinstance(found, MixedColor):
            return self._mixed(found, meanings, nodes)
        if not isinstance(found, LitColor):
            color = {"emission_color": expressions.value(found, at, "color3")}
            return nodes.node("surface_unlit", color, "surfaceshader", must=True), None
        function = found.closures.declaration
        assert isinstance(function, ast.Function)
        own: dict[str, Value | Later] = {function.arguments[0].name.text: ASKED}
        inside = At(Where(found.closures.module, self._setting.surface), {})
        inputs = {"bsdf": expressions.body(function, inside, own, "BSDF")}
        sent = [expressions.value(each, at, "EDF") for each in found.emission]
        if sent:
            inputs["edf"] = emission(nodes, sent)
        if found.opacity is not None:
            inputs["opacity"] = expressions.value(found.opacity, at, "float")
        return nodes.node("surface", inputs, "surfaceshader", must=True), inputs.get("opacity")

    def _mixed(
        self, found: MixedColor, meanings: Meanings, nodes: Nodes
    ) -> tuple[Value, Value | None]:
        """Two surfaces side by side, and the opacity of both."""
        back, front = (
            self._lit_surface(side, meanings, nodes) for side in (found.back, found.front)
        )
        amount = meanings.expressions.value(found.amount, At(self._where, {}), "float")
        sides = {"bg": back[0], "fg": front[0], "mix": amount}
        surface = nodes.node("mix", sides, "surfaceshader", must=True)
        if back[1] is None and front[1] is None:
            return surface, None
        one = vector((1,), "float")
        return surface, nodes.node(
            "mix", {"bg": back[1] or one, "fg": front[1] or one, "mix": amount}, "float"
        )

    def _surface(self, found: SurfaceColor, meanings: Meanings, nodes: Nodes) -> Value:
        """The node of a surface whose opacity is the material's."""
        alpha = meanings.slot("alpha") if self.has_alpha else None
        surface, opacity = self._lit_surface(found, meanings, nodes)
        if alpha != opacity:
            raise UnsayableError(
                "the surface has another opacity than the material's `alpha`", "set both alike"
            )
        return surface

    def _unlit(self, meanings: Meanings, nodes: Nodes) -> Value:
        """The node of a surface that shows a colour without light."""
        if self._record.at("alpha", OUTERMOST).level == 0:
            raise UnsayableError(
                "beside surfaces, a colour has no alpha in MaterialX",
                f"write it to a document of its own: `--material {self._record.name}`",
            )
        color = {"emission_color": meanings.slot("color")}
        return nodes.node("surface_unlit", color, "surfaceshader", must=True)

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
