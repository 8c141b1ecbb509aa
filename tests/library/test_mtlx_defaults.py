"""The defaults of ``std.mtlx`` against those of the inputs of MaterialX's nodes."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import pytest

from burnish.compiler import library
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.semantics.names.standard_library import import_path
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from .materialx import libraries
from .truth import truth

Numbers = tuple[float, ...]
Defaults = dict[tuple[str, str], set[str]]


def defaults(path: Path) -> Iterator[tuple[str, str, str]]:
    """The function, the argument and the default of each argument of a file that has one."""
    for declaration in parse(Source(path.name, path.read_text("utf-8")), Report()).declarations:
        if isinstance(declaration, ast.Function):
            for argument in declaration.arguments:
                if argument.default is not None:
                    text = argument.default.span.text
                    yield declaration.name.text, argument.name.text, text


def files() -> list[Path]:
    """The files of ``std.mtlx``, of the library that is tested."""
    return sorted((library.FOLDER / "mtlx").glob("*.burnish"))


@cache
def inputs() -> tuple[Defaults, Defaults]:
    """The defaults of each input of each node, whose names are in lower case; and their words."""
    found: Defaults = defaultdict(set)
    words: Defaults = defaultdict(set)
    for name in ("stdlib/stdlib_defs.mtlx", "pbrlib/pbrlib_defs.mtlx"):
        for node in ElementTree.parse(libraries() / name).iter("nodedef"):
            for each in node.iter("input"):
                if "value" in each.attrib:
                    key = node.attrib["node"], each.attrib["name"].lower()
                    found[key].add(each.attrib["value"])
                    words[key].add(word(each))
    return found, words


def word(each: ElementTree.Element) -> str:
    """The word for an input's default, of those that it has for its values; or the default."""
    value, choices = each.attrib["value"], each.attrib.get("enum", "").split(",")
    numbered = each.attrib.get("enumvalues", "").split(",")
    return (choices[numbered.index(value)] if value in numbered else value).strip().lower()


def numbers(text: str) -> Numbers:
    """The numbers in a value; one, if all of them are equal, and 0 or 1 for a condition."""
    text = re.sub(r"\bvec\d", "", text.replace("true", "1").replace("false", "0"))
    lanes = tuple(float(number) for number in re.findall(r"[-+.\d][-+.\de]*", text))
    return lanes[:1] if len(set(lanes)) == 1 else lanes


NAMES = {
    f"{import_path(path, library.FOLDER)}.{function}": (path.name, function)
    for path in files()
    for function, _, _ in defaults(path)
    if any(node == re.sub(r"_vec\d$", "", function) for node, _ in inputs()[0])
}


@truth(*NAMES)
@pytest.mark.parametrize("name", sorted(NAMES))
def test_defaults_are_those_of_materialx(name: str) -> None:
    file, function = NAMES[name]
    node = re.sub(r"_vec\d$", "", function)
    for each, argument, default in defaults(library.FOLDER / "mtlx" / file):
        if each == function:
            values, words = (known[node, argument.lower()] for known in inputs())
            if member := re.fullmatch(r"[A-Z]\w+\.(\w+)", default):
                assert words == {member[1].lower()}, f"{function}: {argument}"
            else:
                assert set(map(numbers, values)) == {numbers(default)}, f"{function}: {argument}"
