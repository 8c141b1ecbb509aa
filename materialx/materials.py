"""Renderables of a document as materials of Burnish."""

from __future__ import annotations

from typing import NamedTuple

from .definitions import Functions
from .displacements import BASE, KIND, MIXIN, displaced, displaced_slots, displacement
from .expressions import Call, Expression, Member, Name, flat
from .heirs import Heirs, Written
from .leaves import network as network_of
from .leaves.catalogue import module_of
from .members import SURFACE, Members
from .mixes import Mixes
from .model import Graph, Node, Port
from .models import Model, Models
from .names import record_name, slot_name
from .networks import Network
from .places import Scope
from .problems import UnsupportedError
from .surfaces import surface_root
from .texts import Equation, File, equations, one_line, wrapped
from .values import CLOSURES, LANES

_NOTHING = Equation("color", Call("vec3", (Name("0"),)), doc="No surface is connected")
"""The look of a material without a surface: MaterialX draws it black."""


class Renderable(NamedTuple):
    """Something of a document that is drawn by itself: a material, a surface, or an output of a
    graph."""

    path: str
    name: str
    port: Port
    """What is drawn, as an input of nobody: a link to a node or to an output of a graph."""
    graph: Graph
    doc: str = ""


class Material(NamedTuple):
    """A material that was written: its name, the files of its textures by their maps, and what of
    its node is left out."""

    name: str
    path: str
    files: dict[str, tuple[str, ...]]
    """One file for each texture, or one for each of its layers."""
    left_out: tuple[str, ...] = ()
    is_displaced: bool = False
    """True if points are moved, which MaterialX's own GLSL does not do."""


class Materials:
    """Writes the materials of one document to its file."""

    def __init__(self, file: File, functions: Functions, models: Models) -> None:
        self._file, self._functions, self._models = file, functions, models
        self._heirs = Heirs()

    def written(self, renderable: Renderable) -> Material:
        """Write a material. Raises ``UnsupportedError``, and then has written nothing."""
        before = frozenset(self._file.declarations)
        try:
            base, members, rows, is_displaced = self._converted(renderable)
        except UnsupportedError:
            # Functions may be read by others that follow.
            others = before | self._file.helpers.keys()
            self._file.keep(lambda text: text in others)
            raise
        bases = self._bases(base, is_displaced)
        self._file.names.take([base])
        name = self._file.names.fresh(record_name(renderable.name))
        terms = [text for text in self._file.declarations if text not in before]
        self._file.keep(lambda text: text in before)
        rows = members.inlined(rows, terms)
        text = self._declaration(renderable, Written(name, bases, members.rows() + rows), members)
        self._file.declarations += [text, *terms]
        left_out = _left_out(renderable)
        return Material(name, renderable.path, members.files, left_out, is_displaced)

    def _declaration(self, renderable: Renderable, whole: Written, members: Members) -> str:
        """The text of a material: of one that inherits, what differs."""
        port, graph = renderable.port, renderable.graph
        ancestor = self._heirs.ancestor(port, graph, whole)
        if whole.base not in (SURFACE, BASE):
            self._heirs.add(port, graph, whole)
        others = ancestor.members if ancestor is not None else []
        kept = [row for row in whole.members if row not in others]
        lines = members.lines(kept)
        color = equations([row for row in kept if row not in members.rows()])
        lines += ["", *color] if lines and color else color
        doc = [
            f"/// {line}" for words in _words(renderable) for line in wrapped(one_line(words), 110)
        ]
        head = f"material {whole.name} : {ancestor.name if ancestor else whole.base} {{"
        return "\n".join([*doc, head, *lines, "}"] if lines else [*doc, f"{head}}}"])

    def _bases(self, base: str, is_displaced: bool) -> str:
        """What the header of a material names, which is imported."""
        if base != SURFACE:
            if is_displaced:
                self._file.imported(module_of(MIXIN), MIXIN)
            return f"{base} + {MIXIN}" if is_displaced else base
        name = BASE if is_displaced else SURFACE
        return self._file.imported(module_of(name), name)

    def _converted(self, renderable: Renderable) -> tuple[str, Members, list[Equation], bool]:
        """The base of a material, its members, the slots of the base that it sets, and true if it
        is displaced."""
        scope = Scope(renderable.graph)
        network = network_of(Members(self._file, self._functions, ()))
        moving = displacement(network, renderable.port, scope)
        taken = frozenset[str]() if moving is None else displaced_slots()
        base, members, rows = self._look(renderable, scope, taken)
        if moving is not None:
            rows.append(displaced(members, moving))
        return base, members, rows, moving is not None

    def _look(
        self, renderable: Renderable, scope: Scope, taken: frozenset[str]
    ) -> tuple[str, Members, list[Equation]]:
        """The base of a material, its members, and what it looks like."""
        port = renderable.port
        members = Members(self._file, self._functions, taken)
        network = network_of(members)
        if port.type == KIND:
            return SURFACE, members, [_NOTHING]
        if port.type not in ("surfaceshader", "material"):
            value = self._counted(network, port, scope)
            return SURFACE, members, _as_colors(members, value, port.type)
        found = surface_root(network, port, scope, enter=False)
        if found is None:
            return SURFACE, members, [_NOTHING]
        node, place = found
        model = self._models.model(node.definition) if node.definition is not None else None
        if model is not None:
            return model.name, *self._extended(model, node, place, taken)
        entered = surface_root(network, port, scope)
        if entered is None:
            return SURFACE, members, [_NOTHING]
        mixes = Mixes(members, network, self._models.term, slot_name(renderable.name))
        look = mixes.shown(*entered)
        rows = [Equation("color", members.without_last_name(look.color))]
        if look.alpha is not None:
            rows.append(Equation("alpha", look.alpha))
        return SURFACE, members, rows

    def _counted(self, network: Network, port: Port, scope: Scope) -> Expression:
        with network.counted():
            network.value(port, scope)
        return network.value(port, scope)

    def _extended(
        self, model: Model, node: Node, scope: Scope, taken: frozenset[str]
    ) -> tuple[Members, list[Equation]]:
        """The slots of a model that a node sets."""
        self._file.imported_from(model.file, model.name)
        members = Members(self._file, self._functions, model.taken | taken)
        network = network_of(members)
        names = [name for name in node.inputs if name in model.slots]
        with network.counted():
            for name in names:
                network.input(node, name, scope)
        rows = []
        for name in names:
            slot = model.slots[name]
            value: Expression | None = network.input(node, name, scope)
            if value is not None and slot in ("normal", "tangent"):
                value = _unit(value, members)
            if value is not None and model.defaults.get(slot) != flat(value):
                doc = one_line(node.inputs[name].hints.get("doc", ""))
                rows.append(Equation(slot, value, doc=doc))
        return members, rows


def _words(renderable: Renderable) -> list[str]:
    """What a document says about a material, its surface, and the graphs that this reads: each
    once. Sides of a mix have slots for their own words."""
    graph, link = renderable.graph, renderable.port.link
    found = {renderable.doc: None}
    waiting = [link] if link is not None else []
    seen = set(waiting)
    for link in waiting:  # The list grows on the way.
        if node := graph.nodes.get(link.node):
            found[node.hints.get("doc", "")] = None
            if node.type in ("material", "surfaceshader", *CLOSURES) and node.category != "mix":
                below = dict.fromkeys(port.link for port in node.inputs.values() if port.link)
                waiting += [each for each in below if each not in seen]
                seen.update(below)
        elif group := graph.graphs.get(link.graph):
            found[group.hints.get("doc", "")] = None
    return [words for words in found if words]


def _left_out(renderable: Renderable) -> tuple[str, ...]:
    """The inputs of a material's node that Burnish does not draw."""
    link = renderable.port.link
    node = renderable.graph.nodes.get(link.node) if link is not None else None
    inputs = node.inputs if node is not None else {}
    return tuple(name for name in ("backsurfaceshader", "volumeshader") if name in inputs)


def _unit(value: Expression, members: Members) -> Expression | None:
    """A direction of length one; nothing for what the surface has anyway."""
    if value in (Name("normal_world"), Name("tangent_world")):
        return None
    whole = members.value_of(value)
    if isinstance(whole, Call) and whole.name in ("normalize", "normalmap"):
        return value
    return Call("normalize", (value,))


def _as_colors(members: Members, value: Expression, kind: str) -> list[Equation]:
    """A value of any type as a picture shows it: one number is grey, and a fourth one is alpha."""
    if kind.startswith("matrix"):
        # MaterialX's generators show black in place of what is no colour.
        return [Equation("color", Call("vec3", (Name("0"),)))]
    if kind in ("integer", "boolean"):
        value = Call("float", (value,))
    lanes = LANES.get(kind, 1 if kind in ("integer", "boolean") else 0)
    if not lanes:
        raise UnsupportedError(f"a {kind} cannot be shown")
    if lanes == 4:
        if not isinstance(value, Name):
            value = members.part("shown", value)
        return [Equation("color", Member(value, "rgb")), Equation("alpha", Member(value, "a"))]
    value = members.without_last_name(value)
    if lanes == 3:
        return [Equation("color", value)]
    return [Equation("color", Call("vec3", (value,) if lanes == 1 else (value, Name("0"))))]
