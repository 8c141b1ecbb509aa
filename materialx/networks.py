"""Turns the nodes of a graph into expressions, and gives names to what is used more than once.

A ``Network`` walks from an output to all that it depends on. Graphs within graphs are entered
through ``Scope``s, which say what the inputs of a graph are worth; a definition that becomes a
function of Burnish is not entered but called. A network is walked twice: the first time counts how
often each value is used, and the second time writes those down as parts that are used again.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from .constants import LINEAR, constant, decoded, property_named
from .expressions import Expression, Given, Member, Name, call_with, flat, is_simple
from .file_inputs import FileInputs, files_of, gives_color, is_srgb
from .links import check_type, output_of
from .model import Node, Port
from .names import slot_name
from .places import Function, Scope, Texts
from .problems import UnsupportedError
from .unknown_nodes import no_definition
from .values import ASKED, CLOSURES, LANES, literal, zero

LONG = 80
"""Expressions longer than this become parts, in characters."""


class Network:
    """Expressions for the nodes of a graph and of the graphs inside it."""

    def __init__(
        self,
        row_of: Callable[[Node], Row | None],
        texts: Texts,
        asked: Expression | None = None,
        outer: Network | None = None,
    ) -> None:
        self._row_of = row_of
        self.texts, self.asked, self.outer = texts, asked, outer
        self.files = FileInputs(self)
        self._uses: Counter[tuple[Scope, str, str]] = Counter()
        self._values: dict[tuple[Scope, str, str], Expression] = {}
        self._inner: dict[tuple[Scope, str], Scope] = {}
        self._open: set[tuple[Scope, str, str]] = set()
        self._counting = False
        self.transmits = False
        """True if a closure was met through which light passes."""

    def counted(self) -> Counting:
        """For a ``with``: values that are asked for in it are only counted."""
        return Counting(self)

    def value(self, port: Port, scope: Scope, wanted: Port | None = None) -> Expression:
        """The value of an input or output; ``wanted`` is what the definition says of it."""
        wanted = wanted or port
        if port.interface:
            return self._interface(port.interface, scope, wanted)
        if port.link is not None:
            return self._linked(port, scope)
        if wanted.geometry:
            return self.geometry(wanted.geometry)
        return self._constant(port if port.value is not None else wanted, port.type)

    def _constant(self, port: Port, kind: str) -> Expression:
        if kind in ASKED:
            return Name(self.texts.library("clear_bsdf"))
        if self.texts.structures.has(kind):
            return self.texts.structures.value(port.value, kind)
        if port.value is None or (kind in CLOSURES and not port.value):
            return zero(kind)
        return constant(self.texts, port, kind)

    def geometry(self, name: str) -> Expression:
        return property_named(self.texts, name)

    def _interface(self, name: str, scope: Scope, wanted: Port) -> Expression:
        if scope.bound is not None:
            if name not in scope.bound:
                raise UnsupportedError(f"the graph {scope.graph.name} has no input '{name}'")
            return scope.bound[name]
        if scope.node is not None and scope.outer is not None:
            return self.input(scope.node, name, scope.outer)
        port = scope.graph.inputs.get(name)
        if port is None:
            raise UnsupportedError(f"the graph {scope.graph.path} has no input '{name}'")
        if port.link is not None and scope.outer is not None:
            return self.value(port, scope.outer)
        geometry = port.geometry or wanted.geometry
        if port.value is None and geometry:
            return self.geometry(geometry)
        return self.texts.parameter(scope, port)

    def _linked(self, port: Port, scope: Scope) -> Expression:
        link = port.link
        assert link is not None
        if link.graph:
            inner = self.group(link.graph, scope)
            return self._followed(output_of(inner.graph, link.output), inner)
        if not link.node:
            return self._followed(output_of(scope.graph, link.output), scope)
        node = scope.graph.nodes.get(link.node)
        if node is not None:
            check_type(node, link.output, port)
            return self.output(node, link.output, scope)
        if link.node in scope.graph.graphs:
            inner = self.group(link.node, scope)
            return self._followed(output_of(inner.graph, link.output), inner)
        raise UnsupportedError(f"there is no node '{link.node}'")

    def _followed(self, port: Port, scope: Scope) -> Expression:
        """The value of an output of a graph."""
        key = (scope, "", port.name)
        if key in self._open:
            raise UnsupportedError(f"the output '{port.name}' depends on itself", scope.graph.path)
        self._open.add(key)
        try:
            return self.value(port, scope)
        finally:
            self._open.discard(key)

    def group(self, name: str, scope: Scope) -> Scope:
        """The scope of a graph that groups nodes, beside the nodes of ``scope``."""
        found: Scope | None = scope
        while found is not None and name not in found.graph.graphs:
            found = found.outer
        if found is None:
            raise UnsupportedError(f"there is no graph '{name}'")
        key = (found, name)
        root = self.outer or self
        if key not in root._inner:
            root._inner[key] = Scope(found.graph.graphs[name], found)
        return root._inner[key]

    def entered(self, node: Node, scope: Scope) -> Scope:
        """The scope of the graph that a node stands for, where it is written out."""
        assert node.definition is not None and node.definition.graph is not None
        key = (scope, f"/{node.name}")
        root = self.outer or self
        if key not in root._inner:
            around: Scope | None = scope
            while around is not None:
                if around.node is not None and around.node.definition == node.definition:
                    raise UnsupportedError(
                        f"the definition {node.definition.name} contains itself", node.path
                    )
                around = around.outer
            root._inner[key] = Scope(node.definition.graph, scope, node)
        return root._inner[key]

    def input(self, node: Node, name: str, scope: Scope) -> Expression:
        """The value of a node's input, or its default."""
        assert node.definition is not None
        wanted = node.definition.inputs.get(name)
        port = node.inputs.get(name) or wanted
        if port is None:
            raise UnsupportedError(f"{node.category} has no input '{name}'", node.path)
        try:
            return self.value(port, scope, wanted)
        except UnsupportedError as error:
            error.path = error.path or node.path
            raise

    def output(self, node: Node, output: str, scope: Scope) -> Expression:
        """The value of an output of a node."""
        if self.outer is not None and node.output_type(output) not in CLOSURES:
            return self.outer.output(node, output, scope)
        output = node.output(output)
        key = (scope, node.name, output)
        self._uses[key] += self._counting
        if key in self._values:
            return self._values[key]
        if key in self._open:
            raise UnsupportedError("this node depends on itself", node.path)
        self._open.add(key)
        try:
            found = self._named(key, node, self._computed(node, output, scope))
        except UnsupportedError as error:
            error.path = error.path or node.path
            raise
        finally:
            self._open.discard(key)
        self._values[key] = found
        return found

    def _named(self, key: tuple[Scope, str, str], node: Node, value: Expression) -> Expression:
        if self._counting or is_simple(value):
            return value
        if self._uses[key] > 1 or len(flat(value)) > LONG:
            return self.texts.part(slot_name(node.name), value, node)
        return value

    def _computed(self, node: Node, output: str, scope: Scope) -> Expression:
        if node.definition is None:
            raise UnsupportedError(no_definition(node), node.path)
        default = self._default_without_file(node, scope)
        if default is not None:
            return default
        row = self._row_of(node)
        if row is not None:
            return self._decoded(row(Application(self, node, output, scope)), node, scope)
        if node.definition.graph is None:
            raise UnsupportedError(
                f"{node.category} has no meaning for renderers of the kind of Burnish", node.path
            )
        function = self.texts.function(node.definition)
        if function is None or not self.files.can_be_called(node, scope):
            inner = self.entered(node, scope)
            outputs = inner.graph.outputs
            port = outputs[output] if output else next(iter(outputs.values()))
            found = self.value(port, inner)
            return found if output else self._decoded(found, node, scope)
        return self._application(function, node, output, scope)

    def _application(self, function: Function, node: Node, output: str, scope: Scope) -> Expression:
        given = [
            Given(
                argument,
                self._argument(node, name, scope),
                name in function.defaults and self.is_default(node, name),
            )
            for name, argument in function.inputs.items()
        ]
        if function.is_closure:
            if self.asked is None:
                raise UnsupportedError("a closure can only be part of a surface", node.path)
            self.transmits = True
            given.insert(0, Given("asked", self.asked))
        call = call_with(function.name, given)
        if not output:
            return self._decoded(call, node, scope)
        return self.member(call, node, function.members[output], scope)

    def member(self, whole: Expression, node: Node, name: str, scope: Scope) -> Expression:
        """A member of the structure that a node with several outputs
        gives, which is written once."""
        key = (scope, node.name, "*")
        if key not in self._values:
            self._values[key] = (
                whole if self._counting else self.texts.part(slot_name(node.name), whole, node)
            )
        return Member(self._values[key], name)

    def is_default(self, node: Node, name: str) -> bool:
        """True if an input has the value that its definition gives it."""
        assert node.definition is not None
        wanted = node.definition.inputs[name]
        port = node.inputs.get(name, wanted)
        if port.link is not None or port.interface or wanted.geometry:
            return False
        return port is wanted or is_same(port, wanted)

    def _argument(self, node: Node, name: str, scope: Scope) -> Expression:
        assert node.definition is not None
        if node.definition.inputs[name].type != "filename":
            return self.input(node, name, scope)
        found = self.files.texture(node, name, scope)
        assert found is not None, "nodes without their files have their defaults"
        return found

    def _default_without_file(self, node: Node, scope: Scope) -> Expression | None:
        """The default of a leaf that reads a file, if none is named. A graph has its own leaves."""
        assert node.definition is not None
        files = files_of(node)
        if node.definition.graph is not None or all(
            self.files.texture(node, name, scope) is not None for name in files
        ):
            return None
        for name in ("default", "fallback"):
            if name in node.definition.inputs:
                return self.input(node, name, scope)
        raise UnsupportedError(f"the input '{files[0]}' names no file", node.path)

    def _decoded(self, value: Expression, node: Node, scope: Scope) -> Expression:
        """The value of a node that reads a file of colours which nobody has decoded yet."""
        assert node.definition is not None
        if not gives_color(node):
            return value
        for name, port in node.definition.inputs.items():
            if port.type == "filename":
                space = self.files.space(node, name, scope)
                if (
                    space
                    and not is_srgb(space)
                    and self.files.texture(node, name, scope) is not None
                ):
                    return decoded(self.texts, value, space)
        return value

    def static(self, node: Node, name: str, scope: Scope) -> str:
        """The text of an input that no shader computes, such as the name of a space."""
        assert node.definition is not None
        port = node.inputs.get(name) or node.definition.inputs.get(name)
        if port is None:
            return ""
        if port.interface:
            if scope.bound is not None:
                return self.texts.text(port.interface)
            if scope.node is not None and scope.outer is not None:
                return self.static(scope.node, port.interface, scope.outer)
            port = scope.graph.inputs.get(port.interface, port)
        return port.value or ""


def is_same(port: Port, wanted: Port) -> bool:
    """True if an input has the constant of another one, however it is written."""
    is_encoded = port.type.startswith("color") and port.color_space.lower() not in LINEAR
    if port.unit or wanted.unit or is_encoded:
        return False
    if port.value is None or wanted.value is None or port.type not in LANES:
        return port.value == wanted.value
    return literal(port.value, port.type) == literal(wanted.value, port.type)


@dataclass(frozen=True)
class Application:
    """One output of one node, with what is asked for to write it."""

    network: Network
    node: Node
    output: str
    scope: Scope

    @property
    def texts(self) -> Texts:
        return self.network.texts

    @property
    def type(self) -> str:
        """The type of the output."""
        return self.node.output_type(self.output)

    def input(self, name: str) -> Expression:
        """The value of an input, or its default."""
        return self.network.input(self.node, name, self.scope)

    def inputs(self, *names: str) -> tuple[Expression, ...]:
        return tuple(map(self.input, names))

    def input_type(self, name: str) -> str:
        """The type of an input, as the definition has it."""
        assert self.node.definition is not None
        return self.node.definition.inputs[name].type

    def has(self, name: str) -> bool:
        """True if the node sets an input: by a value, a node or an input of its graph."""
        return name in self.node.inputs

    def static(self, name: str) -> str:
        """The text of an input that no shader computes."""
        return self.network.static(self.node, name, self.scope)

    def texture(self, name: str) -> Expression | None:
        """The texture of an input of the type ``filename``; nothing if no file is named."""
        return self.network.files.texture(self.node, name, self.scope)

    def library(self, name: str) -> str:
        """A name of ``std.mtlx``, which is imported."""
        return self.texts.library(name)


Row = Callable[[Application], Expression]
"""How nodes of a category are written."""


class Counting:
    """While it lasts, a network counts uses and writes nothing; afterwards it knows what it knew
    before."""

    def __init__(self, network: Network) -> None:
        self._networks = [network, *([network.outer] if network.outer is not None else [])]
        self._kept = [dict(network._values) for network in self._networks]

    def __enter__(self) -> None:
        for network in self._networks:
            network._counting = True

    def __exit__(self, *_: object) -> None:
        for network, kept in zip(self._networks, self._kept, strict=True):
            network._counting = False
            network._values = kept
