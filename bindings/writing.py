"""Fills the skeleton of a language in: the text of a binding."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..compiler.documents.writing import to_json
from .fields import Numbers, Pad, Structure
from .folding import folded
from .host_language import HostLanguage
from .model import Binding, Block, Frame, Material
from .printer import single
from .spelling import Spelling

if TYPE_CHECKING:
    from jinja2 import Environment


_PLACEHOLDER = re.compile("\0(\\d+)\0")
"""A number between two NUL characters, which no file of Burnish has."""


def written(binding: Binding, language: HostLanguage) -> str:
    """The text of a binding in one language."""
    spelling = spelling_of(binding, language)
    printer = language.printer()
    printer.spelling = spelling
    derivations = {
        block.name: tuple(printer.statements(block.derivation.statements, printer.INDENT))
        for block in binding.blocks
        if block.derivation is not None
    }
    helpers = [
        (each, tuple(printer.statements(each.statements, printer.INDENT)))
        for each in binding.helpers
    ]
    embedded: list[str] = []
    template = _environment(language.skeleton.parent).get_template(language.skeleton.name)
    text = template.render(
        binding=binding, spelling=spelling, derivations=derivations, helpers=helpers,
        used=printer.used, printer=printer, kinds=_kinds(binding), uses=_Uses(binding),
        deriving=deriving, to_json=to_json, single=single, is_pad=_is_pad,
        is_structure=_is_structure,
        embedded=partial(_placeholder, embedded), headline=_headline(binding),
        **language.texts(binding, spelling),
    )  # fmt: skip
    return _embedded(folded(text, language.style), embedded).rstrip("\n") + "\n"


def _placeholder(embedded: list[str], text: str) -> str:
    """A word in place of an embedded text, as its lines stay as they are."""
    embedded.append(text)
    return f"\0{len(embedded) - 1}\0"


def _embedded(text: str, embedded: list[str]) -> str:
    """The text with embedded ones in place of their words."""
    return _PLACEHOLDER.sub(lambda found: embedded[int(found[1])], text) if embedded else text


def deriving(block: Block) -> str:
    """The name of the function that computes a derived block: ``derive Rig``."""
    return f"derive.{block.name.removesuffix('Derived').replace('DerivedFrom', '')}"


def blocks_of(material: Material) -> str:
    """The name of the type that has all blocks of a material: ``Plastic Blocks``."""
    return f"{material.name}.Blocks"


def table_of(frame: Frame) -> str:
    """The name of the constant that says what a frame is made of: ``Shadows frame``."""
    return f"{frame.name}.frame"


def drawing(frame: Frame) -> str:
    """The name of the function that draws a frame: ``draw Shadows``."""
    return f"draw.{frame.name}"


def _headline(binding: Binding) -> str:
    """A line that says what the text is about."""
    names = [each.name for each in binding.materials]
    shown = ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
    return f"{shown}: what a host sets, computes and binds."


def spelling_of(binding: Binding, language: HostLanguage) -> Spelling:
    """The names of a binding; those of the whole text are given before variables get theirs."""
    spelling = Spelling(language.manner, binding.namespace)
    for structure in _structures(binding):
        for field in structure.fields:
            spelling.member(field.word)  # A user's own names come before those beside them.
    for structure in binding.structures:
        spelling.type(structure.name)
    for block in binding.blocks:
        for name in (block.name, *block.aliases):
            spelling.type(name)
        if block.derivation is not None:
            spelling.function(deriving(block))
    for enumeration in binding.enumerations:
        spelling.enumeration(enumeration.name)
    for helper in binding.helpers:
        spelling.function(helper.name)
    for material in binding.materials:
        spelling.constant(material.name)
        spelling.type(blocks_of(material))
    for frame in binding.frames:
        spelling.constant(table_of(frame))
        spelling.function(drawing(frame))
    return spelling


def _is_pad(part: object) -> bool:
    return isinstance(part, Pad)


def _is_structure(type_: object) -> bool:
    return isinstance(type_, Structure)


def _structures(binding: Binding) -> Iterator[Structure]:
    yield from binding.structures
    for block in binding.blocks:
        yield block.structure


def _kinds(binding: Binding) -> list[Numbers]:
    """The types of numbers that fields have, each once, in the order of their size."""
    found = {
        field.type: None
        for structure in _structures(binding)
        for field in structure.fields
        if isinstance(field.type, Numbers)
    }
    return sorted(found, key=lambda each: (each.columns, each.lanes, each.stored_lanes, each.kind))


class _Uses:
    """What occurs in a binding, so that a skeleton leaves out what nothing needs."""

    def __init__(self, binding: Binding) -> None:
        fields = [field for each in _structures(binding) for field in each.fields]
        self.arrays = any(field.capacity for field in fields)
        self.counters = any(field.counter for field in fields)
        self.parts = any(isinstance(field.type, Structure) for field in fields)
        self.units = any(field.is_unit for field in fields)
        self.choices = any(field.choices for field in fields)
        self.kernels = any(each.reflection.extent is not None for each in binding.materials)


@cache
def _environment(folder: Path) -> Environment:
    """The environment of the skeletons in a folder; one may include others."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    return Environment(
        loader=FileSystemLoader(folder),
        autoescape=False, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
