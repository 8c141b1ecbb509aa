"""Functions that are nodes: those of ``std.mtlx``, and those in files of the folder ``materialx``,
which importing writes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from ...compiler.semantics.names.modules import Symbol
from ..definitions import FOLDER, Functions, arguments_of
from ..known import categories, known
from ..leaves.catalogue import OF_SURFACE, catalogue, input_named
from ..names import Names
from ..structures import Structures
from ..texts import File
from .closures import ASKED
from .enumerations import word
from .nodes import Input
from .table import leaf_category
from .unsayable import UnsayableError
from .values import Picture, Value


class Callee(NamedTuple):
    """A category of nodes, and the inputs that the arguments of its function are."""

    category: str
    named: Mapping[str, str]
    """The inputs by the arguments; empty for what nodes read of the surface by themselves."""
    words: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    """The words by the inputs that are words: members of enumerations, in their order."""

    def inputs(self, given: Mapping[str, Value], slot: Callable[[str], Value]) -> dict[str, Input]:
        """The inputs of a node for the arguments of a call. Raises ``UnsayableError``."""
        found: dict[str, Input] = {}
        for argument, value in given.items():
            name = self.named.get(argument, "")
            if value == ASKED:
                continue
            if not name:
                if argument not in OF_SURFACE or value != slot(OF_SURFACE[argument]):
                    raise UnsayableError(
                        f"`{self.category}` reads the surface by itself, and no other `{argument}`"
                    )
                continue
            found[name] = word(name, value, self.words[name]) if name in self.words else value
            if isinstance(value, Picture):
                found |= self._sampled(name, value)
        return found

    def gives(self, kind: str) -> bool:
        """True if there are nodes of the category with results of a type."""
        outputs = (port.type for each in known(self.category) for port in each.outputs.values())
        return kind in outputs

    @property
    def is_closure(self) -> bool:
        """True if its nodes scatter light."""
        return self.gives("BSDF")

    def _sampled(self, name: str, picture: Picture) -> Mapping[str, str]:
        """The inputs that say how a texture is sampled, unless the node has it so by itself."""
        inputs = set(self.named.values())
        if picture.settings.keys() <= inputs:
            return picture.settings
        if picture.settings != _inside(self.category, name):
            raise UnsayableError(
                f"`{self.category}` says by itself how `{picture.name}` is continued and filtered",
                "leave out `wrap` and `filter`",
            )
        return {}


def _inside(category: str, name: str) -> Mapping[str, str]:
    """How the graph of a node samples a file that it is given."""
    for definition in known(category):
        for node in definition.graph.nodes.values() if definition.graph is not None else ():
            if any(port.interface == name for port in node.inputs.values()):
                own = {word: port.value for word, port in node.inputs.items()}
                usual = {
                    "uaddressmode": "periodic",
                    "vaddressmode": "periodic",
                    "filtertype": "linear",
                }
                return {
                    word: value for word, default in usual.items()
                    if (value := own.get(word) or default) != default
                }  # fmt: skip
    return {}


def leaf_of(symbol: Symbol) -> Callee | None:
    """The node for a function of ``std.mtlx``."""
    if not symbol.module.is_standard:
        return None
    category = leaf_category(symbol.module.import_path, symbol.name)
    if not category:
        return None
    leaf = catalogue()[symbol.name]
    kinds = {port.name: port.type for each in known(category) for port in each.inputs.values()}
    named = {argument: input_named(kinds, argument) for argument in leaf.arguments}
    words = {
        name: members
        for argument, name in named.items()
        if kinds.get(name) == "string" and (members := leaf.members(argument))
    }
    return Callee(category, named, words)


def node_of(symbol: Symbol) -> Callee | None:
    """The node for a function of an imported file."""
    path = symbol.module.path
    if symbol.module.is_standard or path is None or path.parent.name != FOLDER:
        return None
    own = File("")
    functions = Functions(own, known, Structures(own, {}))
    for category in categories().get(path.stem, ()):
        named: dict[str, str] = {}
        for definition in known(category):
            names = Names((), {*catalogue(), *functions.called_by(definition)})
            rows = arguments_of(definition, names)
            named |= {argument: name for name, argument in rows.items()}
        return Callee(category, named)
    return None
