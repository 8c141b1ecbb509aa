"""Surface models as terms, for surfaces that are mixed: their inputs are arguments by name.

A material extends one model and sets its slots, but a mix has two. So each side of a mix is a call,
``standard_surface(metalness = 1)``, which gives a ``SurfaceLook`` of ``std.mtlx.asking``. The terms
of a model stand in a file of their own, ``materialx/mixed_CATEGORY.burnish``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .constants import constant, property_named
from .definitions import FOLDER, Functions, Read, arguments_of, declared, function_name
from .expressions import Binary, Call, Expression, Member, Name, Number, flat, laid_out, splat
from .leaves import network as network_of
from .leaves.catalogue import catalogue, module_of
from .model import Definition, Node, Port
from .names import Names, part_name, slot_name
from .places import Function, Sampling, Scope
from .problems import UnsupportedError
from .surfaces import is_connected, root
from .texts import Equation, File, equations, one_line, wrapped
from .values import BARE, zero

LOOK = "SurfaceLook"
_ASKED = Name("asked")


class SurfaceTerm(NamedTuple):
    """The term of a model: its name, its file, and its arguments by the inputs that they are."""

    name: str
    file: File
    arguments: Mapping[str, str]


class SurfaceTerms:
    """The terms of models of an import, each written once."""

    def __init__(self, functions: Functions, own: File) -> None:
        self._functions, self._own = functions, own
        self._terms: dict[Definition, SurfaceTerm | None] = {}

    def term(self, definition: Definition) -> SurfaceTerm | None:
        """The term of a model; nothing if it is made of more than one surface of closures."""
        if definition not in self._terms:
            self._terms[definition] = self._written(definition)
        return self._terms[definition]

    def _written(self, definition: Definition) -> SurfaceTerm | None:
        file = self._own
        if definition.is_library:
            category = slot_name(definition.category)
            file = self._functions.file(
                f"{FOLDER}/mixed_{category}",
                f"//! The surface `{definition.category}` of MaterialX as a term, "
                "for surfaces that are mixed.",
            )
        try:
            lines = _Writer(self._functions, file, definition)
        except UnsupportedError:
            return None
        file.declarations += lines.declarations
        return SurfaceTerm(lines.name, file, lines.arguments)


class _Writer:
    """The declarations of one model: what it scatters by what is asked, the light of the rig that
    it scatters, and its look."""

    def __init__(self, functions: Functions, file: File, definition: Definition) -> None:
        self._functions, self._file, self._definition = functions, file, definition
        self.arguments = {
            name: argument
            for name, argument in arguments_of(definition, self._names()).items()
            if definition.inputs[name].type in BARE
        }
        self.name = file.names.fresh(function_name(definition.category))
        self._bsdf, self._lit = (
            file.names.fresh(f"{self.name}_{word}") for word in ("bsdf", "lit")
        )
        self._asking: list[str] = []
        """The arguments that closures are made of."""
        self.declarations = self._declarations()

    def _names(self) -> Names:
        return Names((), {*catalogue(), *self._functions.called_by(self._definition)})

    def _library(self, name: str) -> str:
        return self._file.imported(module_of(name), name)

    def _surface(
        self, asked: Expression | None, words: tuple[str, ...]
    ) -> tuple[_Texts, list[Expression], bool]:
        """The values of some inputs of the model's surface, with the parts that they are made of,
        and true if light passes through its closures."""
        definition = self._definition
        texts = _Texts(self._functions, self._file, self._names())
        arguments_of(definition, texts.names)
        assert definition.graph is not None
        network = network_of(texts, asked)
        bound = Read({name: Name(argument) for name, argument in self.arguments.items()})
        scope = Scope(definition.graph, bound=bound)
        found = root(network, next(iter(definition.graph.outputs.values())), scope)
        if found is None or found[0].category != "surface" or not is_connected(found[0], "bsdf"):
            raise UnsupportedError(f"{definition.category} is no surface of closures")
        node, place = found
        read = [word for word in words if word in node.inputs]
        with network.counted():
            for word in read:
                network.input(node, word, place)
        values = [network.input(node, word, place) for word in words]
        if asked is not None:
            self._asking = [self.arguments[name] for name in self.arguments if name in bound.read]
        return texts, values, network.transmits

    def _declarations(self) -> list[str]:
        texts, (scattered,), transmits = self._surface(_ASKED, ("bsdf",))
        bare = [
            pair for name, pair in self._pairs().items() if self.arguments[name] in self._asking
        ]
        asked = f"asked: {self._library('Asked')}"
        bsdf = _declaration(
            "What the surface scatters, by what is asked.",
            declared("term", self._bsdf, [asked, *bare]), texts.without_last_name(scattered), texts,
        )  # fmt: skip
        question = Call(self._library("by_light"), (Name("light.to_light"), Name("to_eye")))
        lit = _declaration(
            "The light of the rig that it scatters.",
            declared("term", self._lit, bare, " per light"),
            Binary("*", Name("pi * light.diffuse"), self._response(question)),
        )
        return [self._look(transmits), bsdf, lit]

    def _look(self, transmits: bool) -> str:
        texts, (emitted, opacity), _ = self._surface(None, ("edf", "opacity"))
        color: Expression = Call(self._lit, tuple(map(Name, self._asking)))
        for question in ("from_everywhere", "passing") if transmits else ("from_everywhere",):
            asked = Call(self._library(question), (Name("to_eye"), Name("ambient_light")))
            color = Binary("+", color, self._response(asked))
        if splat(emitted) != 0:
            color = Binary("+", color, emitted)
        if opacity != Number(1.0):
            color = Binary("*", opacity, color)
        pairs = [
            f"{pair} = {flat(self._default(self._definition.inputs[name]))}"
            for name, pair in self._pairs().items()
        ]
        return _declaration(
            self._definition.hints.get("doc", ""), declared("term", self.name, pairs),
            Call(self._library(LOOK), (color, opacity)), texts,
        )  # fmt: skip

    def _response(self, question: Expression) -> Expression:
        """What the surface scatters to a question."""
        return Member(Call(self._bsdf, (question, *map(Name, self._asking))), "response")

    def _pairs(self) -> dict[str, str]:
        """The arguments with their types, by the inputs that they are."""
        return {
            name: f"{argument}: {BARE[self._definition.inputs[name].type]}"
            for name, argument in self.arguments.items()
        }

    def _default(self, port: Port) -> Expression:
        texts = _Texts(self._functions, self._file, self._names())
        if port.geometry:
            return property_named(texts, port.geometry)
        return texts.parameter(None, port)


def _declaration(doc: str, head: str, value: Expression, texts: _Texts | None = None) -> str:
    last = head.rpartition("\n")[2]
    lines = [f"/// {line}" for line in wrapped(one_line(doc), 110) if line]
    lines.append(f"{head} {laid_out(value, len(last) + 1, 0)}")
    if texts is not None and texts.rows:
        lines += ["where {", *equations(texts.rows), "}"]
    return "\n".join(lines)


class _Texts:
    """The ``Texts`` of a model's terms: parts behind ``where``."""

    def __init__(self, functions: Functions, file: File, names: Names) -> None:
        self._functions, self._file, self.names = functions, file, names
        self.structures = functions.structures
        self.rows: list[Equation] = []

    def without_last_name(self, value: Expression) -> Expression:
        if self.rows and value == Name(self.rows[-1].name):
            return self.rows.pop().value or value
        return value

    def surface(self, slot: str) -> Expression:
        return Name(slot)

    def parameter(self, _scope: Scope | None, port: Port) -> Expression:
        return zero(port.type) if port.value is None else constant(self, port, port.type)

    def texture(self, _port: Port, _sampling: Sampling, _node: Node) -> Expression | None:
        raise UnsupportedError("a model reads no files")

    def tiles(self, _file: str) -> tuple[int, ...]:
        return ()

    def read(self, texture: str, place: Expression) -> Expression:
        return Call(texture, (place,))

    def text(self, name: str) -> str:
        raise UnsupportedError(f"the text '{name}' of a model is known to no shader")

    def attribute(self, _name: str, _kind: str, _doc: str) -> str:
        raise UnsupportedError("a model reads nothing but its inputs of a mesh")

    def function(self, definition: Definition) -> Function | None:
        place = self._functions.place(definition)
        if place is None:
            return None
        self._file.imported_from(place.file, place.function.name)
        return place.function

    def library(self, name: str) -> str:
        return self._file.imported(module_of(name), name)

    def part(self, name: str, value: Expression, node: Node) -> Expression:
        fresh = self.names.fresh(part_name(name, value))
        self.rows.append(Equation(fresh, value, doc=one_line(node.hints.get("doc", ""))))
        return Name(fresh)
