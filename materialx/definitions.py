"""Definitions of nodes that are graphs of others, as functions of Burnish.

All definitions of a category go to one file, ``materialx/CATEGORY.burnish``, whichever of them a
document uses: so two documents that are imported into one folder agree on what is in it. A
definition of the document itself stands in the document's file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from ..stdlib.builtins import BUILTINS
from .expressions import Call, Expression, Name, flat, laid_out
from .leaves import network as network_of
from .leaves import row_of
from .leaves.application import SUFFIXES
from .leaves.catalogue import catalogue, module_of
from .model import Definition, Graph, Node, Port
from .names import Names, part_name, record_name, slot_name
from .networks import Network
from .places import Function, NeedsSurfaceError, NeedsTextsError, Sampling, Scope
from .problems import UnsupportedError
from .structures import Structures, structure_text
from .texts import Equation, File, equations, one_line, wrapped
from .units import measured
from .values import ASKED, BARE, CLOSURES, literal, zero

FOLDER = "materialx"
"""The folder beside an imported file that has what is derived from MaterialX's own library."""


class Place(NamedTuple):
    """A function and the file that has it."""

    function: Function
    file: File


class Functions:
    """The functions of an import, each written once, in the files that they belong to."""

    def __init__(
        self,
        own: File,
        known: Callable[[str], Iterable[Definition]],
        structures: Structures,
        tiles: Callable[[str], tuple[int, ...]] = lambda _file: (),
    ) -> None:
        self.files: dict[str, File] = {}
        self.structures, self.tiles = structures, tiles
        self._own, self._known = own, known
        self._places: dict[Definition, Place | None] = {}
        self._signatures: dict[tuple[str, str, tuple[str, ...]], tuple[str, Function]] = {}

    def place(self, definition: Definition) -> Place | None:
        """Where the function for a definition is; nothing if it has to
        be written out at each use."""
        if definition not in self._places:
            self._places[definition] = None
            if definition.is_library:
                for other in self._known(definition.category):
                    self._places.setdefault(other, None)
                    self._write_if_possible(other)
            else:
                self._places[definition] = self._written(definition)
        return self._places[definition]

    def file(self, path: str, heading: str) -> File:
        """A file of the folder, made at the first use."""
        if path not in self.files:
            self.files[path] = File(path, heading=heading, is_whole=True)
        return self.files[path]

    def is_shared(self, definition: Definition, name: str) -> bool:
        """True for an input that all definitions of a category have, with one type.

        The others choose between functions of one name, so no call may leave them out.
        """
        others = self._known(definition.category) if definition.is_library else [definition]
        types = {
            BARE.get(each.inputs[name].type) if name in each.inputs else None for each in others
        }
        return len(types) == 1

    def called_by(self, definition: Definition) -> set[str]:
        """The names of functions that the bodies for all definitions of a category may call: their
        arguments are called alike."""
        others = self._known(definition.category) if definition.is_library else [definition]
        graphs = [each.graph for each in (definition, *others) if each.graph is not None]
        nodes = [node for graph in graphs for node in graph.nodes.values()]
        return {slot_name(node.category) for node in nodes if row_of(node) is None}

    def _write_if_possible(self, definition: Definition) -> None:
        try:
            self._places[definition] = self._written(definition)
        except UnsupportedError:
            # It is told where a node needs this definition, which then is written out.
            self._places[definition] = None

    def _written(self, definition: Definition) -> Place | None:
        graph = definition.graph
        if graph is None or not all(map(self._is_value, definition.outputs.values())):
            return None
        file = self._own
        if definition.is_library:
            path = f"{FOLDER}/{slot_name(definition.category)}"
            file = self.file(
                path,
                f"//! The node `{definition.category}` of MaterialX, "
                "as its own library defines it.",
            )
        for is_term in (False, True):
            try:
                body = _Body(self, file, definition, graph, is_term)
                return Place(self._declared(file, body), file)
            except NeedsSurfaceError:
                continue
            except NeedsTextsError:
                return None
        return None

    def _is_value(self, port: Port) -> bool:
        return port.type in BARE or self.structures.has(port.type)

    def _declared(self, file: File, body: _Body) -> Function:
        """Write a function, unless the file has the same one already."""
        name = body.result_function.name
        key = (file.path, name, tuple(body.argument_types()))
        text = body.declaration(name)
        known = self._signatures.get(key)
        if known is not None and known[0] != text:
            name += SUFFIXES.get(body.result, f"_{body.result}") or "_float"
            key, text = (file.path, name, key[2]), body.declaration(name)
            known = self._signatures.get(key)
        if known is not None:
            return known[1]
        function = body.result_function._replace(name=name)
        self._signatures[key] = (text, function)
        if body.structure:
            file.helper(body.structure_name, body.structure)
        file.helper(name, text)
        return function


class _Body:
    """The body of a function while it is written: the ``Texts`` of its network."""

    def __init__(
        self, functions: Functions, file: File, definition: Definition, graph: Graph, is_term: bool
    ) -> None:
        self._functions, self._file = functions, file
        self._definition, self._is_term = definition, is_term
        outputs = definition.outputs
        self.result = next(iter(outputs.values())).type
        is_closure = any(
            port.type in ASKED for port in (*outputs.values(), *definition.inputs.values())
        )
        # An argument would hide a function of its name that the body calls.
        self._names = Names((), {*catalogue(), *functions.called_by(definition)})
        self._arguments = {
            name: Name(argument) for name, argument in arguments_of(definition, self._names).items()
        }
        bound = Read(self._arguments)
        self._parts: list[Equation] = []
        network = network_of(self, Name("asked") if is_closure else None)
        scope = Scope(graph, bound=bound)
        with network.counted():
            for _ in self._results(network, scope):
                pass
        values = dict(self._results(network, scope))
        members = {name: slot_name(name) for name in outputs} if len(outputs) > 1 else {}
        self.structure = self.structure_name = ""
        if members:
            self._value = self._with_members(members, values)
            self._type = self.structure_name
        else:
            self._type = self._type_of(next(iter(outputs.values())))
            self._value = self._without_last_name(next(iter(values.values())))
        used = {
            name: self._arguments[name].text for name in definition.inputs if name in bound.read
        }
        defaults = frozenset(
            name
            for name in used
            if functions.is_shared(definition, name)
            and self._default(definition.inputs[name]) is not None
        )
        name = function_name(definition.category or definition.name)
        self.result_function = Function(name, used, is_term, is_closure, defaults, members)

    def _with_members(
        self, members: Mapping[str, str], values: Mapping[str, Expression]
    ) -> Expression:
        """All results as one structure, whose declaration is made, too."""
        types = tuple(map(self._type_of, self._definition.outputs.values()))
        self.structure_name = self._file.structure(record_name(self._definition.category), types)
        rows = zip(members.values(), types, strict=True)
        self.structure = structure_text(self.structure_name, rows)
        return Call(self.structure_name, tuple(values.values()))

    def _type_of(self, port: Port) -> str:
        return self._functions.structures.type(port.type, bare=True)

    def _default(self, port: Port) -> Expression | None:
        """The constant that an input has if nothing sets it; nothing if that is a place or a
        direction of the surface."""
        if port.geometry or port.value is None or port.type in CLOSURES:
            return None
        if self.structures.has(port.type):
            return self.structures.value(port.value, port.type)
        return measured(port, port.type) if port.type in BARE else None

    def _without_last_name(self, value: Expression) -> Expression:
        """The result itself, where it is a part that nothing else reads."""
        if self._parts and value == Name(self._parts[-1].name):
            return self._parts.pop().value or value
        return value

    def _results(self, network: Network, scope: Scope) -> Iterator[tuple[str, Expression]]:
        for name, port in self._definition.outputs.items():
            inner = scope.graph.outputs.get(name) or next(iter(scope.graph.outputs.values()))
            yield name, network.value(inner, scope, port)

    def argument_types(self) -> Iterator[str]:
        """The types of the arguments, as they are written."""
        if self.result_function.is_closure:
            yield "Asked"
        for name in self.result_function.inputs:
            port = self._definition.inputs[name]
            yield "texture2d" if port.type == "filename" else self._type_of(port)

    def declaration(self, name: str) -> str:
        """The declaration, with its parts."""
        pairs = ["asked: Asked"] if self.result_function.is_closure else []
        types = list(self.argument_types())[len(pairs) :]
        for (input_name, argument), kind in zip(
            self.result_function.inputs.items(), types, strict=True
        ):
            default = self._default(self._definition.inputs[input_name])
            has_default = input_name in self.result_function.defaults and default is not None
            pairs.append(
                f"{argument}: {kind}{f' = {flat(default)}' if has_default and default else ''}"
            )
        kind = "term" if self._is_term else "fn"
        result = "" if self._is_term else f" -> {self._type}"
        head = declared(kind, name, pairs, result)
        last = head.rpartition("\n")[2]
        value = laid_out(self._value, len(last) + 1, 0)
        if "\n" in value and not isinstance(self._value, Call):
            value = f"\n    {laid_out(self._value, 4, 1)}"
        doc = [
            f"/// {line}"
            for line in wrapped(one_line(self._definition.hints.get("doc", "")), 110)
            if line
        ]
        lines = [*doc, f"{head} {value}".replace(" \n", "\n")]
        if self._parts:
            lines += ["where {", *equations(self._parts), "}"]
        if self.result_function.is_closure:
            self._file.imported("std.mtlx.asking", "Asked")
            self._file.imported("std.mtlx.asking", "Bsdf")
        return "\n".join(lines)

    # ---- The ``Texts`` of the network

    def surface(self, slot: str) -> Expression:
        if not self._is_term:
            raise NeedsSurfaceError
        return Name(slot)

    @property
    def structures(self) -> Structures:
        return self._functions.structures

    def parameter(self, _scope: Scope, port: Port) -> Expression:
        if self.structures.has(port.type):
            return self.structures.value(port.value, port.type)
        return zero(port.type) if port.value is None else literal(port.value, port.type)

    def texture(self, _port: Port, _sampling: Sampling, _node: Node) -> Expression | None:
        raise NeedsTextsError

    def tiles(self, _file: str) -> tuple[int, ...]:
        raise NeedsTextsError

    def read(self, texture: str, place: Expression) -> Expression:
        return Call(texture, (place,))

    def text(self, _name: str) -> str:
        raise NeedsTextsError

    def attribute(self, _name: str, _kind: str, _doc: str) -> str:
        raise NeedsTextsError

    def function(self, definition: Definition) -> Function | None:
        place = self._functions.place(definition)
        if place is None:
            return None
        if place.function.sees_surface and not self._is_term:
            raise NeedsSurfaceError
        self._file.imported_from(place.file, place.function.name)
        return place.function

    def library(self, name: str) -> str:
        return self._file.imported(module_of(name), name)

    def part(self, name: str, value: Expression, node: Node) -> Expression:
        fresh = self._names.fresh(part_name(name, value))
        self._parts.append(Equation(fresh, value, doc=one_line(node.hints.get("doc", ""))))
        return Name(fresh)


def declared(kind: str, name: str, pairs: list[str], result: str = "") -> str:
    """The head of a function with its arguments, on one line or in several."""
    head = f"{kind} {name}({', '.join(pairs)}){result} ="
    return head if len(head) <= 110 else f"{kind} {name}(\n{_filled(pairs)}\n){result} ="


def function_name(category: str) -> str:
    """The name of the functions for a category, unless there are others with the same arguments."""
    name = slot_name(category)
    return f"mx_{name}" if name in BUILTINS else name


def arguments_of(definition: Definition, names: Names) -> dict[str, str]:
    """The names of arguments for all inputs of a definition, by the inputs."""
    return {name: names.fresh(slot_name(name)) for name in definition.inputs}


class Read(dict[str, Expression]):
    """The arguments of a function, which remember which of them are read."""

    def __init__(self, arguments: Mapping[str, Expression]) -> None:
        super().__init__(arguments)
        self.read: set[str] = set()

    def __getitem__(self, name: str) -> Expression:
        self.read.add(name)
        return super().__getitem__(name)


def _filled(pairs: list[str]) -> str:
    """The arguments of a function in lines."""
    lines = ["   "]
    for place, pair in enumerate(pairs):
        piece = f" {pair}," if place < len(pairs) - 1 else f" {pair}"
        if len(lines[-1]) + len(piece) > 110:
            lines.append("   ")
        lines[-1] += piece
    return "\n".join(lines)
