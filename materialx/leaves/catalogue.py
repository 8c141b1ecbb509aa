"""The functions of ``std.mtlx``, read from the library itself.

A leaf of MaterialX that is more than a line has a function there with the name of its category and
the names of its inputs. So a leaf needs no row of its own here.
"""

from __future__ import annotations

from functools import cache
from types import MappingProxyType
from typing import NamedTuple

from ...compiler.diagnostics.diagnostic import Report
from ...compiler.library import FOLDER
from ...compiler.library_trees import parse_library
from ...compiler.syntax import ast
from ...compiler.syntax.load import load_source
from ..expressions import Call, Expression, Name
from ..names import slot_name
from ..problems import Unsupported
from .application import SUFFIXES, Application

PACKAGE = "mtlx"
_SPELLED = MappingProxyType({"in": ("value", "x", "color"), "mix": ("amount",)})
"""Inputs whose names are words of Burnish, and the names that arguments have in place of them."""
_WORDS = MappingProxyType({
    "scatter_mode": ("R", "T", "RT"),
    "mode": ("conty_kulla", "zeltner"),
})  # fmt: skip
"""Inputs that are words, in the order of the numbers that functions of ``std.mtlx`` take for them."""


_OF_SURFACE = MappingProxyType({
    "to_eye": "view_world",
    "position": "position_world",
    "normal": "normal_world",
})  # fmt: skip
"""What functions take of the surface where their nodes have no such input."""


class Leaf(NamedTuple):
    """A function of the library: where it is, and what its arguments are called."""

    module: str
    arguments: tuple[str, ...]


@cache
def catalogue() -> MappingProxyType[str, Leaf]:
    """All functions and terms of ``std.mtlx`` by their names; of overloads, the longest."""
    found: dict[str, Leaf] = {}
    for path in sorted((FOLDER / PACKAGE).glob("*.burnish")):
        for declaration in parse_library(load_source(path, Report()), Report()).declarations:
            if isinstance(declaration, ast.Import):
                continue
            arguments: tuple[str, ...] = ()
            if isinstance(declaration, ast.Function):
                arguments = tuple(argument.name.text for argument in declaration.arguments)
            leaf = Leaf(f"std.{PACKAGE}.{path.stem}", arguments)
            known = found.get(declaration.name.text)
            if known is None or len(known.arguments) < len(arguments):
                found[declaration.name.text] = leaf
    return MappingProxyType(found)


def module_of(name: str) -> str:
    """The module of ``std.mtlx`` that declares a name."""
    return catalogue()[name].module


def leaf_named(category: str, kind: str) -> str:
    """The name of the function for nodes of a category and a type; empty if there is none."""
    for name in (category + SUFFIXES.get(kind, ""), category):
        if name in catalogue():
            return name
    return ""


def application(node: Application) -> Expression:
    """A node as a call of its function, with its inputs by their names."""
    name = leaf_named(node.node.category, node.type)
    leaf = catalogue()[name]
    arguments = tuple(_argument(node, argument) for argument in leaf.arguments)
    call = Call(node.texts.library(name), arguments)
    if not node.output:
        return call
    return node.network.member(call, node.node, slot_name(node.output), node.scope)


def _argument(node: Application, argument: str) -> Expression:
    if argument == "asked":
        if node.network.asked is None:
            raise Unsupported("a closure can only be part of a surface")
        return node.network.asked
    name = _input_of(node, argument)
    if not name:
        return node.texts.surface(_OF_SURFACE[argument])
    if node.input_type(name) == "string":
        return _word(node, name)
    if node.input_type(name) == "filename":
        texture = node.texture(name)
        return texture if texture is not None else Name("nothing")
    return node.input(name)


def _input_of(node: Application, argument: str) -> str:
    """The input for an argument; empty for what functions take of the surface."""
    assert node.node.definition is not None
    inputs = node.node.definition.inputs
    if argument in inputs:
        return argument
    for name, others in _SPELLED.items():
        if argument in others and name in inputs:
            return name
    if argument in _OF_SURFACE:
        return ""
    raise AssertionError(f"{node.node.category} has no input for '{argument}'")


def _word(node: Application, name: str) -> Expression:
    words = _WORDS[name]
    word = node.static(name) or words[0]
    if word not in words:
        raise Unsupported(f"'{word}' is none of {', '.join(words)}")
    if name == "scatter_mode" and word != words[0]:
        node.network.transmits = True
    return Name(str(words.index(word)))
