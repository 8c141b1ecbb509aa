"""The functions of ``std.mtlx``, read from the library itself.

A leaf of MaterialX that is more than a line has a function there with the name of its category and
the names of its inputs. So a leaf needs no row of its own here.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from types import MappingProxyType
from typing import NamedTuple

from ...compiler.library import FOLDER
from ...compiler.syntax import ast
from ..expressions import Expression, Given, Member, Name, call_with, flat
from ..library_files import declarations
from ..names import slot_name
from ..networks import Application
from ..problems import UnsupportedError
from .application import SUFFIXES

PACKAGE = "mtlx"
_SPELLED = MappingProxyType({"in": ("value", "x", "color", "height"), "mix": ("amount",)})
"""Inputs whose names are words of Burnish, and the names that arguments have in place of them."""
OF_SURFACE = MappingProxyType({
    "to_eye": "to_eye",
    "position": "position_world",
    "normal": "normal_world",
})  # fmt: skip
"""What functions take of the surface where their nodes have no such input."""


class Leaf(NamedTuple):
    """A function of the library: where it is, and what its arguments are called."""

    module: str
    arguments: tuple[str, ...]
    defaults: frozenset[str] = frozenset()
    """The arguments that may be left out."""
    types: tuple[str, ...] = ()
    """The types of the arguments, but for what stands in brackets."""

    def members(self, argument: str) -> tuple[str, ...]:
        """The members of the enumeration that an argument is of; none if it is of another type."""
        return enumerations().get(self.type_of(argument), ())

    def type_of(self, argument: str) -> str:
        """The type of an argument."""
        return self.types[self.arguments.index(argument)]


@cache
def catalogue() -> MappingProxyType[str, Leaf]:
    """All functions and terms of ``std.mtlx`` by their names; of overloads, the longest."""
    found: dict[str, Leaf] = {}
    for path in sorted((FOLDER / PACKAGE).glob("*.burnish")):
        for declaration in declarations(f"{PACKAGE}/{path.name}"):
            leaf = Leaf(f"std.{PACKAGE}.{path.stem}", ())
            if isinstance(declaration, ast.Function):
                leaf = _leaf(leaf.module, declaration)
            known = found.get(declaration.name.text)
            if known is None or len(known.arguments) < len(leaf.arguments):
                found[declaration.name.text] = leaf
    return MappingProxyType(found)


def _leaf(module: str, declaration: ast.Function) -> Leaf:
    arguments = declaration.arguments
    defaults = frozenset(
        argument.name.text for argument in arguments if argument.default is not None
    )
    names = tuple(argument.name.text for argument in arguments)
    return Leaf(module, names, defaults, tuple(argument.type.name.text for argument in arguments))


@cache
def enumerations() -> MappingProxyType[str, tuple[str, ...]]:
    """The members of all enumerations of ``std.mtlx``, by their names."""
    found = {
        declaration.name.text: tuple(member.name.text for member in declaration.members)
        for path in sorted((FOLDER / PACKAGE).glob("*.burnish"))
        for declaration in declarations(f"{PACKAGE}/{path.name}")
        if isinstance(declaration, ast.Enumeration)
    }
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
    given = [
        Given(
            argument,
            _argument(node, leaf, argument),
            argument in leaf.defaults and _is_default(node, argument),
        )
        for argument in leaf.arguments
    ]
    call = call_with(node.texts.library(name), given)
    if not node.output:
        return call
    return node.network.member(call, node.node, slot_name(node.output), node.scope)


def _is_default(node: Application, argument: str) -> bool:
    name = _input_of(node, argument)
    return bool(name) and node.network.is_default(node.node, name)


def _argument(node: Application, leaf: Leaf, argument: str) -> Expression:
    if argument == "asked":
        if node.network.asked is None:
            raise UnsupportedError("a closure can only be part of a surface")
        return node.network.asked
    name = _input_of(node, argument)
    if not name:
        return node.texts.surface(OF_SURFACE[argument])
    if leaf.members(argument):
        return _member(node, leaf, argument, name)
    if node.input_type(name) == "filename":
        texture = node.texture(name)
        assert texture is not None, "nodes without their files have their defaults"
        return texture
    return node.input(name)


def _input_of(node: Application, argument: str) -> str:
    """The input for an argument; empty for what functions take of the surface."""
    assert node.node.definition is not None
    name = input_named(node.node.definition.inputs, argument)
    if not name and argument not in OF_SURFACE:
        raise AssertionError(f"{node.node.category} has no input for '{argument}'")
    return name


def input_named(inputs: Iterable[str], argument: str) -> str:
    """The one of some inputs that an argument of a function is for; empty if it is for none."""
    if argument in inputs:
        return argument
    for name in inputs:
        if slot_name(name) == argument:
            return name
    for name, others in _SPELLED.items():
        if argument in others and name in inputs:
            return name
    return ""


def _member(node: Application, leaf: Leaf, argument: str, name: str) -> Expression:
    """The member of an enumeration for an input that is a word, or the number of one."""
    of, members = leaf.type_of(argument), leaf.members(argument)
    if not _is_default(node, name):  # Only what is written is imported.
        node.library(of)
    if node.input_type(name) != "string":
        value = node.input(name)
        text = flat(value)
        if isinstance(value, Name) and text.isdecimal() and int(text) < len(members):
            return Member(Name(of), members[int(text)])
        return Name(f"({text} as {of})")
    word = node.static(name) or members[0]
    if word not in members:
        raise UnsupportedError(f"'{word}' is none of {', '.join(members)}")
    if name == "scatter_mode" and word != members[0]:
        node.network.transmits = True
    return Member(Name(of), word)
